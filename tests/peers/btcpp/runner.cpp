// Runs trees of BehaviorTree.CPP with stub nodes in the world of tests/src/trees, and compares the actions that
// they start, in order, with those of Motet's engine: runner FOLDER. The stub nodes are registered by the manifest of
// each tree.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "behaviortree_cpp/bt_factory.h"
#include "tinyxml2.h"

namespace {

uint64_t hash_of(const std::string& text) {
  uint64_t hash = 0xcbf29ce484222325ull;
  for (unsigned char byte : text) hash = (hash ^ byte) * 0x100000001b3ull;
  return hash;
}

struct World {
  std::string seed;
  std::vector<std::string> actions;
  std::map<std::string, uint64_t> tried;
  std::map<std::string, bool> lit;

  bool is_lit(const std::string& lamp) {
    auto known = lit.find(lamp);
    return known != lit.end() ? known->second : hash_of(seed + "/lit/" + lamp) % 2 == 1;
  }
};

std::vector<std::string> kinds_of(const std::string& action) {
  if (action == "push" || action == "dim") return {"jam", "slip"};
  if (action == "light" || action == "find") return {"jam"};
  return {"slip"};
}

// One tick long.
class StubAction : public BT::StatefulActionNode {
 public:
  StubAction(const std::string& name, const BT::NodeConfig& config, std::string id, std::vector<std::string> inputs,
             std::shared_ptr<World> world)
      : StatefulActionNode(name, config), id_(id), inputs_(inputs), world_(world) {}

  BT::NodeStatus onStart() override {
    std::string line = id_;
    std::string lamp;
    for (const auto& input : inputs_) {
      auto value = getInput<std::string>(input);
      if (!value) throw BT::RuntimeError("no value of ", input, ": ", value.error());
      line += " " + input + "=" + value.value();
      if (value.value().rfind("lamp_", 0) == 0) lamp = value.value();
    }
    uint64_t number = hash_of(world_->seed + "/" + line + "/" + std::to_string(++world_->tried[line]));
    world_->actions.push_back(line);
    fails_ = number % 100 < 30;
    auto kinds = kinds_of(id_);
    kind_ = kinds[number / 100 % kinds.size()];
    lamp_ = lamp;
    found_ = "lamp_" + std::to_string(1 + number / 100 % 3);
    return BT::NodeStatus::RUNNING;
  }

  BT::NodeStatus onRunning() override {
    if (fails_) {
      setOutput("failure", kind_);
      return BT::NodeStatus::FAILURE;
    }
    if (id_ == "light") world_->lit[lamp_] = true;
    if (id_ == "dim") world_->lit[lamp_] = false;
    if (id_ == "find") setOutput("result", found_);
    return BT::NodeStatus::SUCCESS;
  }

  void onHalted() override {}

 private:
  std::string id_;
  std::vector<std::string> inputs_;
  std::shared_ptr<World> world_;
  bool fails_ = false;
  std::string kind_, lamp_, found_;
};

class StubCondition : public BT::ConditionNode {
 public:
  StubCondition(const std::string& name, const BT::NodeConfig& config, std::string id, std::shared_ptr<World> world)
      : ConditionNode(name, config), id_(id), world_(world) {}

  BT::NodeStatus tick() override {
    bool holds = false;
    if (id_ == "lit") {
      bool wanted = getInput<bool>("is").value();
      holds = world_->is_lit(getInput<std::string>("what").value()) == wanted;
    } else if (id_ == "level") {
      double level = double(hash_of(world_->seed + "/level/" + getInput<std::string>("of").value()) % 100) / 100.0;
      std::string is = getInput<std::string>("is").value();
      double than = getInput<double>("than").value();
      if (is == "less") holds = level < than;
      else if (is == "at_most") holds = level <= than;
      else if (is == "more") holds = level > than;
      else if (is == "at_least") holds = level >= than;
      else throw BT::RuntimeError("no comparison ", is);
    } else {
      throw BT::RuntimeError("no condition ", id_);
    }
    return holds ? BT::NodeStatus::SUCCESS : BT::NodeStatus::FAILURE;
  }

 private:
  std::string id_;
  std::shared_ptr<World> world_;
};

// Registers a stub for each node of the manifest.
void register_stubs(BT::BehaviorTreeFactory& factory, const std::string& xml, std::shared_ptr<World> world) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.c_str()) != tinyxml2::XML_SUCCESS) throw std::runtime_error(document.ErrorStr());
  auto* model = document.RootElement()->FirstChildElement("TreeNodesModel");
  for (auto* node = model->FirstChildElement(); node; node = node->NextSiblingElement()) {
    std::string id = node->Attribute("ID");
    bool is_action = std::string(node->Name()) == "Action";
    BT::PortsList ports;
    std::vector<std::string> inputs;
    for (auto* port = node->FirstChildElement(); port; port = port->NextSiblingElement()) {
      std::string name = port->Attribute("name"), type = port->Attribute("type");
      bool is_input = std::string(port->Name()) == "input_port";
      if (!is_input) {
        ports.insert(BT::OutputPort<std::string>(name));
      } else if (const char* value = port->Attribute("default")) {
        ports.insert(type == "bool" ? BT::InputPort<bool>(name, std::string(value) == "true", "")
                                    : BT::InputPort<double>(name, std::stod(value), ""));
      } else if (type == "double") {
        ports.insert(BT::InputPort<double>(name));
      } else {
        ports.insert(BT::InputPort<std::string>(name));
      }
      if (is_input) inputs.push_back(name);
    }
    BT::TreeNodeManifest manifest{is_action ? BT::NodeType::ACTION : BT::NodeType::CONDITION, id, ports, {}};
    factory.registerBuilder(manifest, [=](const std::string& name, const BT::NodeConfig& config)
                                          -> std::unique_ptr<BT::TreeNode> {
      if (is_action) return std::make_unique<StubAction>(name, config, id, inputs, world);
      return std::make_unique<StubCondition>(name, config, id, world);
    });
  }
}

std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Actions of a run, one a line, and the way in which it ended.
std::string account_of(const std::filesystem::path& path) {
  auto world = std::make_shared<World>();
  world->seed = path.stem().string();
  std::string xml = slurp(path);
  BT::BehaviorTreeFactory factory;
  register_stubs(factory, xml, world);
  factory.registerBehaviorTreeFromText(xml);
  auto tree = factory.createTree("main");
  BT::NodeStatus status = BT::NodeStatus::RUNNING;
  for (int ticks = 0; status == BT::NodeStatus::RUNNING; ++ticks) {
    if (ticks > 100000) return "no end\n";
    status = tree.tickExactlyOnce();
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  std::string end = status == BT::NodeStatus::SUCCESS ? "done" : "failure";
  std::string ended;
  if (status == BT::NodeStatus::FAILURE && tree.rootBlackboard()->get("ended", ended) && !ended.empty() && ended != "fail") {
    end = ended;
  }
  std::string text;
  for (const auto& line : world->actions) text += line + "\n";
  return text + end + "\n";
}

}  // namespace

int main(int count, char** args) {
  if (count != 2) return 2;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(args[1])) {
    if (entry.path().extension() == ".xml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  int different = 0;
  size_t actions = 0;
  for (const auto& path : files) {
    std::string found;
    try {
      found = account_of(path);
    } catch (const std::exception& error) {
      found = std::string("error: ") + error.what() + "\n";
    }
    auto expected = slurp(std::filesystem::path(path).replace_extension(".expected"));
    actions += std::count(expected.begin(), expected.end(), '\n') - 1;
    if (found != expected) {
      ++different;
      std::cout << path << " differs\n--- engine\n" << expected << "--- BehaviorTree.CPP\n" << found;
    }
  }
  std::cout << files.size() << " trees, " << actions << " actions, " << different << " differ\n";
  return different == 0 && !files.empty() ? 0 : 1;
}
