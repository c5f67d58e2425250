//! Steps as statements of Python.

use smol_str::SmolStr;
use thiserror::Error;

use super::term::quoted;
use super::writer::Writer;
use crate::model::{CallNode, Ending, Graph, Handler, Node, NodeId, NodeKind, ROOT, RegionId, Term, Type};

/// Step that a script cannot say.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
#[error("a script cannot say {what}, at `{path}`")]
pub struct Unsayable {
    /// JSON Pointer to the step, as in [`Node::path`].
    pub path: SmolStr,
    /// Description of the part of the language.
    pub what: &'static str,
}

/// Writes a valid graph as a Python script. `entities` are all that are known before the
/// first step, with the names of their kinds: the robot, its person, and those of the scene.
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
impl Writer<'_> {
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
                let value = format!("await robot.value({text}, {})", quoted(&self.graph.type_name(&ty)));
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
                let looks = if self.graph.hands.contains(&id) { ", looks=True" } else { "" };
                self.line(level, &format!("if await robot.test({condition}{looks}):"));
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
                let kind = quoted(&self.graph.type_name(&ty));
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
                    Ending::Fail => "fail",
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
