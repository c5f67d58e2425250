// Carries out trees of BehaviorTree.CPP 4 with leaves that only log: every leaf of the TreeNodesModel is registered with its
// ports and their types. An action ends as the dice of the case say, a condition holds as they say.
// One argument a case, SEED:FILE; one line of JSON a case, the calls in their order and how the tree ended.
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <behaviortree_cpp/bt_factory.h>
#include <tinyxml2.h>

using BT::NodeStatus;
using std::string;

namespace {

struct Case {
  uint64_t seed = 0;
  long ticks = 0;
  int started = 0;
  std::vector<string> log;
};

// The dice of compiler/btcpp/tests/btcpp/peer.rs.
uint64_t mix(uint64_t seed, const string& text) {
  uint64_t hash = seed ^ 0xcbf29ce484222325ULL;
  for(const unsigned char byte : text) {
    hash = (hash ^ byte) * 0x0100000001b3ULL;
    hash = (hash << 5) | (hash >> 59);
  }
  return hash >> 7;
}

// With an odd seed everything is known.
uint64_t number_of(uint64_t seed, const string& query) {
  const uint64_t number = mix(seed, query) % 4;
  return number == 0 && seed % 2 == 1 ? 2 : number;
}

const std::vector<string> objects = { "mug", "cup", "bowl" };

// 1 where a fact holds, 0 where it does not, -1 where nobody knows.
int seen(uint64_t seed, const string& query) {
  const auto any = query.find("any");
  if(any != string::npos) {
    int truth = 0;
    for(const auto& object : objects) {
      auto one = query;
      one.replace(any, 3, object);
      const int of_one = seen(seed, one);
      if(of_one == 1) { return 1; }
      if(of_one == -1) { truth = -1; }
    }
    return truth;
  }
  const uint64_t number = number_of(seed, query);
  return number == 0 ? -1 : (number % 2 == 0 ? 1 : 0);
}

double reading(uint64_t seed, const string& query, bool& is_known) {
  const uint64_t number = number_of(seed, query);
  is_known = number != 0;
  return static_cast<double>(number) / 5.0;
}

string joined(const std::vector<string>& parts, const char* between) {
  string text;
  for(size_t i = 0; i < parts.size(); i++) { text += (i > 0 ? between : "") + parts[i]; }
  return text;
}

struct Model {
  string id;
  std::vector<std::pair<string, string>> inputs;  // in the order of the document, with their types
  BT::PortsList ports;
  bool has_result = false;
  string result_type;
  bool is_action = false;
};

// The value of an input port as the text that the document would have for it.
string text_of(const BT::TreeNode& node, const string& port, const string& type) {
  if(type == "std::vector<std::string>") {
    return joined(node.getInput<std::vector<string>>(port).value(), ";");
  }
  if(type == "double") {
    std::ostringstream out;
    out << node.getInput<double>(port).value();
    return out.str();
  }
  return node.getInput<string>(port).value();
}

std::vector<string> arguments(const BT::TreeNode& node, const Model& model) {
  std::vector<string> values;
  for(const auto& [port, type] : model.inputs) {
    if(port != "manner" && port != "is" && port != "than" && node.config().input_ports.count(port) > 0) {
      values.push_back(text_of(node, port, type));
    }
  }
  return values;
}

class Action : public BT::StatefulActionNode {
public:
  Action(const string& name, const BT::NodeConfig& config, const Model* model, Case* run)
    : StatefulActionNode(name, config), model_(model), run_(run) {}

  NodeStatus onStart() override {
    const string& id = model_->id;
    if(id == "fail" || id == "cannot" || id == "replan") {
      return NodeStatus::FAILURE;
    }
    run_->log.push_back(id + "(" + joined(arguments(*this, *model_), ", ") + ")");
    dice_ = mix(run_->seed, "goal " + std::to_string(++run_->started));
    end_ = run_->ticks + 1 + static_cast<long>(dice_ / 128 % 2000);
    return NodeStatus::RUNNING;
  }

  NodeStatus onRunning() override {
    if(run_->ticks < end_) { return NodeStatus::RUNNING; }
    const uint64_t fate = dice_ / 8 % 12;
    if(fate < 4) {
      const char* kinds[] = { "timeout", "failed", "unreachable", "not_found" };
      if(config().output_ports.count("failure") > 0) { setOutput("failure", string(kinds[fate])); }
      return NodeStatus::FAILURE;
    }
    if(model_->has_result && config().output_ports.count("as") > 0) {
      if(model_->result_type == "std::vector<std::string>") {
        std::vector<string> found;
        for(uint64_t i = 0; i < dice_ % 4; i++) { found.push_back(objects[i % 3]); }
        setOutput("as", found);
      } else {
        setOutput("as", objects[dice_ % 3]);
      }
    }
    return NodeStatus::SUCCESS;
  }

  void onHalted() override {}

private:
  const Model* model_;
  Case* run_;
  uint64_t dice_ = 0;
  long end_ = 0;
};

class Condition : public BT::ConditionNode {
public:
  Condition(const string& name, const BT::NodeConfig& config, const Model* model, Case* run)
    : ConditionNode(name, config), model_(model), run_(run) {}

  NodeStatus tick() override { return holds() ? NodeStatus::SUCCESS : NodeStatus::FAILURE; }

private:
  bool holds() {
    const string& id = model_->id;
    const auto fact = [&](const string& query) { return seen(run_->seed, query); };
    if(id == "failure_is") {
      const auto kinds = ";" + getInput<string>("kinds").value() + ";";
      return kinds.find(";" + getInput<string>("of").value() + ";") != string::npos;
    }
    if(id == "can_pick") { return refused(fact("holding(any)") == 0, "failed"); }
    if(id == "can_place") {
      return refused(fact("holding(" + getInput<string>("object").value() + ")") == 1, "unreachable");
    }
    if(id == "compare_count") {
      const auto list = getInput<std::vector<string>>("of").value();
      return compared(static_cast<double>(list.size()), getInput<double>("than").value());
    }
    if(id == "compare_number") {
      return compared(getInput<double>("of").value(), getInput<double>("than").value());
    }
    if(id == "compare_value") {
      const bool same = getInput<string>("of").value() == getInput<string>("than").value();
      return same == (getInput<string>("is").value() == "equal");
    }
    bool is_known = true;
    if(id == "compare_field") {
      const auto query = getInput<string>("of").value() + "." + getInput<string>("field").value();
      const double value = reading(run_->seed, query, is_known);
      return is_known && compared(value, getInput<double>("than").value());
    }
    const auto args = joined(arguments(*this, *model_), ", ");
    if(id.rfind("compare_", 0) == 0) {
      const double value = reading(run_->seed, id.substr(8) + "(" + args + ")", is_known);
      return is_known && compared(value, getInput<double>("than").value());
    }
    if(id.rfind("is_", 0) == 0) {
      return fact(id.substr(3) + "(" + args + ")") == (getInput<string>("is").value() == "true" ? 1 : 0);
    }
    throw BT::RuntimeError("no dice for ", id);
  }

  bool refused(bool holds, const char* kind) {
    if(!holds && config().output_ports.count("failure") > 0) { setOutput("failure", string(kind)); }
    return holds;
  }

  bool compared(double left, double right) {
    const auto is = getInput<string>("is").value();
    if(is == "less") { return left < right; }
    if(is == "at_most") { return left <= right; }
    if(is == "more") { return left > right; }
    if(is == "at_least") { return left >= right; }
    return (left == right) == (is == "equal");
  }

  const Model* model_;
  Case* run_;
};

void add_port(Model& model, const tinyxml2::XMLElement* port) {
  const string tag = port->Name();
  if(tag != "input_port" && tag != "output_port") { return; }
  const string name = port->Attribute("name");
  const char* written = port->Attribute("type");
  const string type = written == nullptr ? "" : written;
  const bool is_input = tag == "input_port";
  const auto direction = is_input ? BT::PortDirection::INPUT : BT::PortDirection::OUTPUT;
  const auto info = [&]() -> std::pair<string, BT::PortInfo> {
    if(type == "std::string") { return BT::CreatePort<string>(direction, name); }
    if(type == "double") { return BT::CreatePort<double>(direction, name); }
    if(type == "bool") { return BT::CreatePort<bool>(direction, name); }
    if(type == "std::vector<std::string>") { return BT::CreatePort<std::vector<string>>(direction, name); }
    if(type == "std::vector<double>") { return BT::CreatePort<std::vector<double>>(direction, name); }
    throw BT::RuntimeError("a port of the type ", type);
  };
  auto made = info();
  if(const char* standard = port->Attribute("default")) { made.second.setDefaultValue(string(standard)); }
  model.ports.insert(made);
  if(is_input) {
    model.inputs.emplace_back(name, type);
  } else if(name == "as") {
    model.has_result = true;
    model.result_type = type;
  }
}

string played(uint64_t seed, const string& file) {
  Case run;
  run.seed = seed;
  tinyxml2::XMLDocument document;
  if(document.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) { throw BT::RuntimeError(document.ErrorStr()); }
  const auto* root = document.RootElement();
  std::map<string, Model> models;
  const auto* models_root = root->FirstChildElement("TreeNodesModel");
  for(const auto* leaf = models_root->FirstChildElement(); leaf; leaf = leaf->NextSiblingElement()) {
    Model& model = models[leaf->Attribute("ID")];
    model.id = leaf->Attribute("ID");
    model.is_action = string(leaf->Name()) == "Action";
    for(const auto* port = leaf->FirstChildElement(); port; port = port->NextSiblingElement()) {
      add_port(model, port);
    }
  }
  BT::BehaviorTreeFactory factory;
  for(const auto& [id, model] : models) {
    const Model* known = &model;
    BT::TreeNodeManifest manifest;
    manifest.type = model.is_action ? BT::NodeType::ACTION : BT::NodeType::CONDITION;
    manifest.registration_ID = id;
    manifest.ports = model.ports;
    factory.registerBuilder(manifest, [known, &run](const string& name, const BT::NodeConfig& config) {
      std::unique_ptr<BT::TreeNode> node;
      if(known->is_action) {
        node = std::make_unique<Action>(name, config, known, &run);
      } else {
        node = std::make_unique<Condition>(name, config, known, &run);
      }
      return node;
    });
  }
  factory.registerBehaviorTreeFromFile(file);
  auto tree = factory.createTree(root->Attribute("main_tree_to_execute"));
  auto status = NodeStatus::RUNNING;
  while(status == NodeStatus::RUNNING) {
    status = tree.tickExactlyOnce();
    if(++run.ticks > 10'000'000) { throw BT::RuntimeError("the tree does not end"); }
  }
  run.log.emplace_back(status == NodeStatus::SUCCESS ? "success" : "failure");
  string line = "[";
  for(size_t i = 0; i < run.log.size(); i++) {
    line += (i > 0 ? ", \"" : "\"");
    for(const char byte : run.log[i]) {
      if(byte == '\n') { line += "\\n"; continue; }
      line += (byte == '"' || byte == '\\' ? string("\\") + byte : string(1, byte));
    }
    line += "\"";
  }
  return line + "]";
}

}  // namespace

int main(int count, char** args) {
  for(int i = 1; i < count; i++) {
    const string arg = args[i];
    const auto colon = arg.find(':');
    try {
      std::cout << played(std::stoull(arg.substr(0, colon)), arg.substr(colon + 1)) << std::endl;
    } catch(const std::exception& error) {
      std::cout << "[\"error: " << arg << ": " << error.what() << "\"]" << std::endl;
    }
  }
  return 0;
}
