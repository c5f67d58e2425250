//! Graphs as Python scripts, for people who read and change them: the steps as Python statements, against the
//! class `Driver` of the Python package `motet`.
//!
//! A script makes the same calls as the engine. It does one thing at a time: what runs beside something else
//! has no place in it ([`Unsayable`]). The same graph gives the same text.

mod contract;
mod term;

use std::collections::BTreeSet;

use smol_str::SmolStr;
use thiserror::Error;

use crate::model::{
    BindingId, CallNode, Ending, Graph, Handler, Kind, KindId, Node, NodeId, NodeKind, ROOT, RegionId, Term,
    Type,
};
use term::{quoted, type_name};

/// Step that a script cannot say.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
#[error("a script cannot say {what}, at `{path}`")]
pub struct Unsayable {
    /// JSON Pointer to the step, as in [`Node::path`].
    pub path: SmolStr,
    /// Description of the part of the language.
    pub what: &'static str,
}

/// Writes a valid graph as a Python script. `entities` are those of the scene, with the names of their kinds.
///
/// ```
/// let graph = motet_graph::Graph::empty("tidy_up", "hsr");
/// let script = motet_graph::python::script(&graph, &[])?;
/// assert!(script.contains("async def tidy_up(robot: Robot):"));
/// # Ok::<(), motet_graph::python::Unsayable>(())
/// ```
///
/// # Errors
///
/// A step that runs beside others: `parallel`, and a monitor that is more than a deadline. Also a name that a
/// run before has bound.
pub fn script(graph: &Graph, entities: &[(SmolStr, SmolStr)]) -> Result<String, Unsayable> {
    if let Some(given) = graph.bindings.iter().find(|binding| binding.given) {
        return Err(Unsayable { path: given.name.clone(), what: "a name that another run has bound" });
    }
    let mut writer = Writer::new(graph, entities);
    writer.region(ROOT, 1)?;
    if let Some(result) = graph.result {
        let result = writer.binding(result);
        writer.line(1, &format!("return {result}"));
    }
    Ok(writer.finish())
}

/// Deepest level of blocks: below it an invalid graph could go round in circles.
const DEEPEST: usize = crate::validate::MAX_DEPTH + 2;
/// Names that the script uses itself, and that no binding may have.
const TAKEN: &[&str] = &[
    "ANY", "Case", "Contract", "EACH", "Entity", "Entry", "Failed", "False", "MOTIONS", "Need", "None",
    "Planned", "Pose", "SCRIPT", "Robot", "Script", "Text", "True", "all_of", "and", "any_of", "arith", "as",
    "assert", "async", "await", "break", "class", "compare", "continue", "count", "def", "del", "elif",
    "else", "except", "fact", "failure", "field", "finally", "first", "for", "from", "global", "if",
    "import", "in", "is", "json", "lambda", "main", "measure", "no", "nonlocal", "not", "or", "pass",
    "planned", "raise", "range", "return", "robot", "said", "try", "while", "with", "yield",
];

struct Writer<'g> {
    graph: &'g Graph,
    /// Name of the function with the steps.
    name: String,
    /// Names of the bindings in the script.
    names: Vec<String>,
    /// Entities with their kinds, in the order in which they are heard of.
    entities: Vec<(SmolStr, KindId)>,
    /// Functions that give the contracts of calls.
    contracts: String,
    steps: String,
    /// Paths that the compiler has found, by step.
    motions: Vec<(SmolStr, String)>,
}

impl<'g> Writer<'g> {
    fn new(graph: &'g Graph, entities: &[(SmolStr, SmolStr)]) -> Self {
        let mut taken: BTreeSet<String> = TAKEN.iter().map(|name| (*name).to_owned()).collect();
        let name = free(&identifier(&graph.policy), &mut taken);
        let names = graph.bindings.iter().map(|binding| free(&identifier(&binding.name), &mut taken));
        let names = names.collect();
        let mut writer = Self {
            graph,
            name,
            names,
            entities: Vec::new(),
            contracts: String::new(),
            steps: String::new(),
            motions: Vec::new(),
        };
        let always = [("robot", "Entity"), ("user", "Person"), ("start", "Place")];
        let always = always.map(|(id, kind)| (SmolStr::new_static(id), SmolStr::new_static(kind)));
        for (id, kind) in always.iter().chain(entities) {
            let known = graph.kinds.iter().position(|known| known.name == *kind);
            if let Some(kind) = known.and_then(|index| u32::try_from(index).ok()) {
                writer.hear(id, KindId(kind));
            }
        }
        writer
    }

    /// Notes an entity; the narrowest kind of each is kept.
    fn hear(&mut self, id: &SmolStr, kind: KindId) {
        match self.entities.iter().position(|(known, _)| known == id) {
            Some(index) => {
                let graph = self.graph;
                if let Some((_, known)) = self.entities.get_mut(index)
                    && is_kind(graph, kind, *known)
                {
                    *known = kind;
                }
            }
            None => self.entities.push((id.clone(), kind)),
        }
    }

    fn binding(&self, id: BindingId) -> String {
        self.names.get(id.index()).cloned().unwrap_or_else(|| "None".to_owned())
    }

    fn binding_type(&self, id: BindingId) -> Type {
        self.graph.bindings.get(id.index()).map_or(Type::Bool, |binding| binding.ty.clone())
    }

    fn line(&mut self, level: usize, text: &str) {
        self.steps.extend(std::iter::repeat_n("    ", level));
        self.steps.push_str(text);
        self.steps.push('\n');
    }

    /// A comment of one line, whatever is in it.
    fn comment(&mut self, level: usize, text: &str) {
        let text: String = text.chars().map(|char| if char.is_control() { ' ' } else { char }).collect();
        self.line(level, &format!("# {text}"));
    }

    fn region(&mut self, id: RegionId, level: usize) -> Result<(), Unsayable> {
        let mut is_empty = true;
        let mut at = self.graph.regions.get(id.index()).and_then(|region| region.entry);
        while let Some(id) = at {
            let Some(node) = self.graph.nodes.get(id.index()) else { break };
            if level > DEEPEST {
                return Err(Unsayable { path: node.path.clone(), what: "blocks that are nested so deep" });
            }
            self.step(id, node, level)?;
            is_empty = false;
            at = node.next.filter(|next| *next > id);
        }
        if is_empty {
            self.line(level, "pass");
        }
        Ok(())
    }

    fn step(&mut self, id: NodeId, node: &Node, level: usize) -> Result<(), Unsayable> {
        let unsayable = |what| Err(Unsayable { path: node.path.clone(), what });
        match &node.kind {
            NodeKind::Call(call) => self.call(id, node, call, level),
            NodeKind::Let { binding, value } => {
                let ty = self.binding_type(*binding);
                let (name, text) = (self.binding(*binding), self.term(value, Some(&ty)));
                let value = format!("await robot.value({text}, {})", quoted(&type_name(self.graph, &ty)));
                self.line(level, &format!("{name} = {value}"));
            }
            NodeKind::Sequence { name, body } => {
                self.comment(level, name);
                self.region(*body, level)?;
            }
            NodeKind::Inline { policy, body } => {
                self.comment(level, &format!("policy {policy}"));
                self.line(level, &format!("async with robot.part() as part_{}:", id.0));
                self.region(*body, level + 1)?;
            }
            NodeKind::If { condition, then, otherwise } => {
                let condition = self.condition(condition);
                self.line(level, &format!("if await robot.test({condition}):"));
                self.region(*then, level + 1)?;
                if let Some(otherwise) = otherwise {
                    self.line(level, "else:");
                    self.region(*otherwise, level + 1)?;
                }
            }
            NodeKind::Wait { condition, within_secs } => {
                let condition = self.condition(condition);
                self.line(level, &format!("await robot.wait_until({condition}, {within_secs:?})"));
            }
            NodeKind::Delay { secs } => self.line(level, &format!("await robot.sleep({secs:?})")),
            NodeKind::Finally { body, cleanup } => {
                let name = format!("cleanup_{}", id.0);
                self.line(level, &format!("async def {name}():"));
                self.region(*cleanup, level + 1)?;
                self.line(level, &format!("async with robot.cleanup({name}):"));
                self.region(*body, level + 1)?;
            }
            NodeKind::Monitor { body, .. } => match node.kind.deadline_secs() {
                Some(secs) => {
                    self.line(level, &format!("async with robot.within({secs:?}):"));
                    self.region(*body, level + 1)?;
                }
                None => return unsayable("`monitor`, because it watches beside its block"),
            },
            NodeKind::Try { body, handlers } => {
                self.line(level, "try:");
                self.region(*body, level + 1)?;
                self.line(level, "except Failed as failure:");
                self.handlers(handlers, level + 1)?;
            }
            NodeKind::Repeat { times, body, until } => {
                self.line(level, &format!("for _ in range({times}):"));
                self.region(*body, level + 1)?;
                if let Some(until) = until {
                    let until = self.condition(until);
                    self.line(level + 1, &format!("if await robot.test({until}):"));
                    self.line(level + 2, "break");
                    self.line(level, "else:");
                    self.line(level + 1, "raise Failed(\"exhausted\")");
                }
            }
            NodeKind::Each { item, list, at_most, body } => {
                let ty = self.binding_type(*item);
                let list = self.term(list, Some(&Type::List(Box::new(ty.clone()))));
                let kind = quoted(&type_name(self.graph, &ty));
                let item = self.binding(*item);
                self.line(level, &format!("for {item} in robot.items({list}, {kind}, at_most={at_most}):"));
                self.region(*body, level + 1)?;
            }
            NodeKind::Parallel { .. } => {
                return unsayable("`parallel`, because it does several things at once");
            }
            NodeKind::End { how, of, why } => self.ending(*how, *of, why.as_ref(), level),
        }
        Ok(())
    }

    fn handlers(&mut self, handlers: &[Handler], level: usize) -> Result<(), Unsayable> {
        let (mut word, mut is_all) = ("if", false);
        for handler in handlers {
            let kinds = handler.on.as_ref().map(|on| {
                let kinds = on.iter().filter_map(|id| self.graph.failures.get(id.index()));
                kinds.map(|kind| format!("{}, ", quoted(kind))).collect::<String>()
            });
            match kinds {
                Some(kinds) => self.line(level, &format!("{word} failure.kind in ({kinds}):")),
                None => self.line(level, if word == "if" { "if True:" } else { "else:" }),
            }
            if let Some(caught) = handler.binds {
                let (kind, text) = (self.binding(caught.kind), self.binding(caught.text));
                self.line(level + 1, &format!("{kind}, {text} = Case(failure.kind), robot.reason(failure)"));
            }
            self.region(handler.body, level + 1)?;
            if handler.on.is_none() {
                is_all = true;
                break;
            }
            word = "elif";
        }
        if !is_all {
            let at = if word == "if" { level } else { level + 1 };
            if word == "elif" {
                self.line(level, "else:");
            }
            self.line(at, "raise");
        }
        Ok(())
    }

    fn ending(&mut self, how: Ending, of: Option<NodeId>, why: Option<&Term>, level: usize) {
        let why = why.map(|why| self.term(why, Some(&Type::Text)));
        let text = match (how, of) {
            (Ending::Done, Some(of)) => format!("part_{}.done()", of.0),
            (Ending::Fail, Some(of)) => {
                let why = why.map(|why| format!("robot.words({why})")).unwrap_or_default();
                format!("part_{}.fail({why})", of.0)
            }
            (how, _) => {
                let how = match how {
                    Ending::Done => "done",
                    Ending::Fail => "failed",
                    Ending::Cannot => "cannot",
                    Ending::Replan => "replan",
                };
                let why = why.map(|why| format!(", {why}")).unwrap_or_default();
                format!("robot.end({}{why})", quoted(how))
            }
        };
        self.line(level, &text);
    }

    fn call(&mut self, id: NodeId, node: &Node, call: &CallNode, level: usize) {
        let graph = self.graph;
        let primitive = graph.primitives.get(call.primitive.index());
        let params = primitive.map_or(&[][..], |primitive| &primitive.params);
        let args = call.args.iter().zip(params);
        let args: Vec<String> = args
            .map(|(arg, param)| format!("{}: {}", quoted(&param.name), self.term(arg, Some(&param.ty))))
            .collect();
        let name = primitive.map_or("", |primitive| &primitive.name);
        let mut text = format!(
            "await robot.call({}, {{{}}}, within={:?}",
            quoted(name),
            args.join(", "),
            call.deadline_secs
        );
        if call.retries > 0 {
            text.push_str(&format!(", retry={}", call.retries));
        }
        if let Some(manner) = call.manner {
            let (speed, acceleration) = (manner.speed, manner.acceleration);
            text.push_str(&format!(", manner={{\"speed\": {speed:?}, \"acceleration\": {acceleration:?}}}"));
        }
        if let Some(contract) = self.contract(id, node, call) {
            text.push_str(&format!(", contract={contract}"));
        }
        if let Some(binding) = call.binds {
            let among = graph.bindings.get(binding.index()).map_or(&[][..], |binding| &binding.among);
            if !among.is_empty() {
                let among: String = among.iter().map(|id| format!("{}, ", quoted(id))).collect();
                text.push_str(&format!(", among=({among})"));
            }
            text = format!("{} = {text}", self.binding(binding));
        }
        self.line(level, &format!("{text})"));
    }
}

/// A name as Python has it: letters, digits and underscores of ASCII.
fn identifier(name: &str) -> String {
    let plain = |char: char| if char.is_ascii_alphanumeric() { char } else { '_' };
    let name: String = name.chars().map(plain).collect();
    if name.starts_with(|char: char| char.is_ascii_digit()) || name.is_empty() {
        format!("_{name}")
    } else {
        name
    }
}

/// A name that is not taken yet, and is from now on.
fn free(name: &str, taken: &mut BTreeSet<String>) -> String {
    let generated = ["part_", "cleanup_", "contract_"].iter().any(|stem| name.starts_with(stem));
    let stem = if generated || name == "_" { format!("its_{name}") } else { name.to_owned() };
    let mut candidates =
        std::iter::once(stem.clone()).chain((2_u64..).map(|number| format!("{stem}_{number}")));
    let name = candidates.find(|name| !taken.contains(name)).unwrap_or(stem);
    taken.insert(name.clone());
    name
}

/// True if a kind is another or below it.
fn is_kind(graph: &Graph, kind: KindId, above: KindId) -> bool {
    let parent = |id: &KindId| graph.kinds.get(id.index()).and_then(|kind: &Kind| kind.parent);
    let ancestors = std::iter::successors(Some(kind), |id| parent(id).filter(|parent| parent < id));
    ancestors.into_iter().any(|id| id == above)
}
