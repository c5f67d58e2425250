//! Steps as a line of text: what a graph's node looks like to somebody who watches it run.

use motet_graph::{
    Arithmetic, CallNode, Comparison, Condition, Ending, Fact, FactArg, FailureId, Graph, Node, NodeKind,
    Term,
};

/// A node in one line, as the text form would write it.
pub(super) fn node(graph: &Graph, node: &Node) -> String {
    match &node.kind {
        NodeKind::Call(call) => self::call(graph, call),
        NodeKind::Sequence { name, .. } => format!("sequence {name}"),
        NodeKind::Inline { policy, .. } => format!("policy {policy}"),
        NodeKind::If { condition: test, .. } => format!("if {}", condition(graph, test)),
        NodeKind::Wait { condition: test, within_secs } => {
            format!("wait until {} within {within_secs} s", condition(graph, test))
        }
        NodeKind::Monitor { watches, .. } => {
            let watched: Vec<_> = watches.iter().map(|watch| condition(graph, &watch.condition)).collect();
            format!("monitor {}", watched.join("; "))
        }
        NodeKind::Try { .. } => "try".to_owned(),
        NodeKind::Repeat { times, until: None, .. } => format!("repeat {times}"),
        NodeKind::Repeat { times, until: Some(until), .. } => {
            format!("repeat {times} until {}", condition(graph, until))
        }
        NodeKind::Each { item, list, at_most, .. } => {
            let item = graph.bindings.get(item.index()).map_or("_", |binding| binding.name.as_str());
            format!("each {item} in {} at most {at_most}", term(graph, list))
        }
        NodeKind::Parallel { .. } => "parallel".to_owned(),
        NodeKind::End { how, why, .. } => {
            let how = match how {
                Ending::Done => "done",
                Ending::Fail => "fail",
                Ending::Replan => "replan",
            };
            why.as_ref().map_or_else(|| how.to_owned(), |why| format!("{how} {}", term(graph, why)))
        }
    }
}

/// The name of a failure kind.
pub(super) fn failure(graph: &Graph, id: FailureId) -> &str {
    graph.failures.get(id.index()).map_or("failed", |name| name.as_str())
}

/// A condition.
pub(super) fn condition(graph: &Graph, test: &Condition) -> String {
    match test {
        Condition::Literal(value) => value.to_string(),
        Condition::Fact(fact) => self::fact(graph, fact),
        Condition::Compare(how, left, right) => {
            let how = match how {
                Comparison::Equal => "==",
                Comparison::Unequal => "!=",
                Comparison::Less => "<",
                Comparison::AtMost => "<=",
                Comparison::More => ">",
                Comparison::AtLeast => ">=",
            };
            format!("{} {how} {}", term(graph, left), term(graph, right))
        }
        Condition::Not(inner) => format!("not {}", nested(graph, inner)),
        Condition::All(parts) if parts.is_empty() => "true".to_owned(),
        Condition::AnyOf(parts) if parts.is_empty() => "false".to_owned(),
        Condition::All(parts) => joined(graph, parts, " and "),
        Condition::AnyOf(parts) => joined(graph, parts, " or "),
    }
}

fn joined(graph: &Graph, parts: &[Condition], word: &str) -> String {
    parts.iter().map(|part| nested(graph, part)).collect::<Vec<_>>().join(word)
}

fn nested(graph: &Graph, test: &Condition) -> String {
    let text = condition(graph, test);
    match test {
        Condition::All(parts) | Condition::AnyOf(parts) if parts.len() > 1 => format!("({text})"),
        Condition::Literal(_)
        | Condition::Fact(_)
        | Condition::Compare(..)
        | Condition::Not(_)
        | Condition::All(_)
        | Condition::AnyOf(_) => text,
    }
}

fn call(graph: &Graph, call: &CallNode) -> String {
    let name = graph.primitives.get(call.primitive.index()).map_or("?", |primitive| primitive.name.as_str());
    let text = applied(name, call.args.iter().map(|arg| term(graph, arg)));
    match call.binds.and_then(|id| graph.bindings.get(id.index())) {
        Some(binding) if binding.name != "_" => format!("let {} = {text}", binding.name),
        Some(_) | None => text,
    }
}

fn fact(graph: &Graph, fact: &Fact) -> String {
    let name = graph.fluents.get(fact.fluent.index()).map_or("?", |fluent| fluent.name.as_str());
    applied(
        name,
        fact.args.iter().map(|arg| match arg {
            FactArg::Term(arg) => term(graph, arg),
            FactArg::Any => "any".to_owned(),
        }),
    )
}

fn applied(name: &str, args: impl Iterator<Item = String>) -> String {
    format!("{name}({})", args.collect::<Vec<_>>().join(", "))
}

fn term(graph: &Graph, value: &Term) -> String {
    match value {
        Term::Literal(value) => value.to_string(),
        Term::Binding(id) => {
            graph.bindings.get(id.index()).map_or_else(|| "?".to_owned(), |binding| binding.name.to_string())
        }
        Term::Each => "each".to_owned(),
        Term::Field(of, name) => format!("{}.{name}", term(graph, of)),
        Term::Measure(id, args) => {
            let name = graph.measures.get(id.index()).map_or("?", |measure| measure.name.as_str());
            applied(name, args.iter().map(|arg| term(graph, arg)))
        }
        Term::List(items) => {
            format!("[{}]", items.iter().map(|item| term(graph, item)).collect::<Vec<_>>().join(", "))
        }
        Term::Arith(how, left, right) => {
            let how = match how {
                Arithmetic::Add => "+",
                Arithmetic::Subtract => "-",
                Arithmetic::Multiply => "*",
                Arithmetic::Divide => "/",
            };
            format!("({} {how} {})", term(graph, left), term(graph, right))
        }
    }
}
