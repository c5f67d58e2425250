//! Calls: guards, deadline, retries, and the ports of the action.

use std::collections::BTreeSet;

use motet_graph::{
    Binding, CallNode, FactArg, Need, NodeId, Param, Primitive, Term, TextPart, Type, Value, Verdict,
};
use motet_stdlib::lang::builtin_failures;

use super::{Context, Exporter, sequence};
use crate::element::{Element, is_xml_char};
use crate::names::{ACCELERATION, FAILURE, NEEDS, RESULT, SPEED, can, failure_of, is_node_name, is_port};

impl Exporter<'_> {
    pub(super) fn call(&mut self, id: NodeId, path: &str, call: &CallNode, context: Context) -> Element {
        let graph = self.graph;
        let Some(primitive) = graph.primitives.get(call.primitive.index()) else {
            return self.refuse(path, "this call", "its primitive is not declared");
        };
        if !is_node_name(&primitive.name) {
            return self.refuse(
                path,
                format!("the primitive `{}`", primitive.name.escape_debug()),
                "this cannot be the name of a node of its own",
            );
        }
        self.manifest.add_action(graph, primitive, call.manner.is_some());
        let mut action = Element::new(&primitive.name);
        for (param, arg) in primitive.params.iter().zip(&call.args) {
            self.check_port(path, param);
            if let Some(value) = self.port(path, arg) {
                action = action.with(&param.name, value);
            }
        }
        if let Some(binding) = call.binds.filter(|binding| self.is_named(*binding)) {
            action = action.with(RESULT, format!("{{{}}}", self.entry(binding)));
        }
        if let Some(manner) = call.manner {
            action = action
                .with(SPEED, manner.speed.to_string())
                .with(ACCELERATION, manner.acceleration.to_string());
        }
        let mut attempt = self.guards(path, call, primitive, context);
        let is_guarded = !attempt.is_empty();
        let mut timeout = Element::new("Timeout").with("msec", self.msec(path, call.deadline_secs));
        if context.needs_kind {
            self.has_kinds = true;
            let own = failure_of(id.0);
            // A failure that the action does not name is the end of its time.
            let code = format!("{own} := '{}'", builtin_failures::TIMEOUT);
            attempt.push(Element::new("Script").with("code", code));
            action = action.with(FAILURE, format!("{{{own}}}"));
            timeout = timeout.with("_onFailure", format!("{FAILURE} := {own}"));
        }
        attempt.push(timeout.around([action]));
        let mut element = match is_guarded {
            true => Element::new("Sequence").with("name", NEEDS).around(attempt),
            false => sequence(attempt),
        };
        if call.retries > 0 {
            let attempts = u64::from(call.retries) + 1;
            element = Element::new("RetryUntilSuccessful")
                .with("num_attempts", attempts.to_string())
                .around([element]);
        }
        element
    }

    /// Conditions of the needs that are checked before the start. One node of the robot, `can_pick`,
    /// stands for those that a tree cannot say: it succeeds where the needs of the action hold for its
    /// ports.
    fn guards(
        &mut self,
        path: &str,
        call: &CallNode,
        primitive: &Primitive,
        context: Context,
    ) -> Vec<Element> {
        let (mut guards, mut unsaid) = (Vec::new(), BTreeSet::new());
        for need in call.needs.iter().filter(|need| need.verdict == Verdict::Deferred) {
            let kind = self.kind(need.failure);
            let before = self.refused.len();
            let guard = if need.each.is_none() { self.guard(path, need) } else { Element::default() };
            if need.each.is_some() || self.refused.len() > before {
                self.refused.truncate(before);
                unsaid.insert(kind);
            } else {
                guards.push(self.failing(guard, &kind, context));
            }
        }
        let Some(kind) = unsaid.first().cloned() else { return guards };
        if unsaid.len() > 1 && context.needs_kind {
            let part = format!("the needs of `{}`", primitive.name);
            self.refuse(path, part, "they fail in several ways, and a handler asks for the way");
        }
        let name = can(&primitive.name);
        self.manifest.add_need(self.graph, primitive, &name);
        let mut element = Element::new(&name);
        for (param, arg) in primitive.params.iter().zip(&call.args) {
            element = element.with(&param.name, self.port(path, arg).unwrap_or_default());
        }
        guards.push(self.failing(element, &kind, context));
        guards
    }

    /// A need that is checked before the start.
    fn guard(&mut self, path: &str, need: &Need) -> Element {
        let condition = self.condition(path, &need.condition, true);
        match &need.when {
            None => condition,
            Some(when) => {
                let premise = self.condition(path, when, true);
                let is_free = Element::new("Inverter").around([premise]);
                Element::new("Fallback").around([is_free, condition])
            }
        }
    }

    fn check_port(&mut self, path: &str, param: &Param) {
        if !is_port(&param.name) {
            let part = format!("the parameter `{}`", param.name.escape_debug());
            self.refuse(path, part, "this cannot be the name of a port");
        }
    }

    fn is_named(&self, binding: motet_graph::BindingId) -> bool {
        self.graph.bindings.get(binding.index()).is_some_and(|binding| binding.name != "_")
    }

    /// Value of a port; `None` where it is refused.
    pub(super) fn port(&mut self, path: &str, term: &Term) -> Option<String> {
        let reason = match term {
            Term::Literal(value) => match self.literal(value) {
                Ok(text) => return Some(text),
                Err(reason) => reason,
            },
            Term::Binding(binding) => {
                let is_given = |binding: &Binding| binding.given;
                if self.caught.contains(binding) {
                    "a node reports the kind of its failure and nothing else"
                } else if self.graph.bindings.get(binding.index()).is_some_and(is_given) {
                    "it is known before the run, and a tree knows nothing then"
                } else {
                    return Some(format!("{{{}}}", self.entry(*binding)));
                }
            }
            Term::Template(parts) if parts.iter().any(|part| matches!(part, TextPart::Value(..))) => {
                "a port is a fixed text or one entry of the blackboard"
            }
            Term::Each
            | Term::Field(..)
            | Term::Measure(..)
            | Term::List(_)
            | Term::Arith(..)
            | Term::Count(_)
            | Term::First(_)
            | Term::Template(_) => "a port is a literal or one entry of the blackboard",
        };
        let shown = self.names.term(term);
        self.refuse(path, format!("the value `{shown}`"), reason);
        None
    }

    /// Literal as BehaviorTree.CPP reads it.
    fn literal(&self, value: &Value) -> Result<String, &'static str> {
        let text = match value {
            Value::Bool(value) => value.to_string(),
            Value::Int(value) => value.to_string(),
            Value::Number(value) => value.to_string(),
            Value::Text(text) | Value::Entity(text) | Value::Case(text) => text.to_string(),
            Value::Pose(pose) => {
                let numbers: Vec<_> =
                    pose.xyz.iter().chain(&pose.quaternion).map(ToString::to_string).collect();
                numbers.join(";")
            }
            Value::List(items) => {
                let items: Vec<_> = items.iter().map(|item| self.literal(item)).collect::<Result<_, _>>()?;
                if items.iter().any(|item| item.contains(';')) {
                    return Err("`;` stands between the elements of a list");
                }
                items.join(";")
            }
        };
        let trimmed = text.trim();
        if trimmed.starts_with('{') && trimmed.ends_with('}') {
            return Err("braces name an entry of the blackboard");
        }
        if !text.chars().all(is_xml_char) {
            return Err("XML has none of its control characters");
        }
        Ok(text)
    }

    /// Operand of a script; `None` for what a script cannot compare.
    pub(super) fn operand(&self, term: &Term) -> Option<String> {
        match term {
            Term::Binding(binding) if self.caught.contains(binding) => None,
            Term::Binding(binding) => Some(self.entry(*binding).to_owned()),
            Term::Literal(Value::Bool(value)) => Some(value.to_string()),
            Term::Literal(Value::Int(value)) => Some(value.to_string()),
            Term::Literal(Value::Number(value)) => Some(value.to_string()),
            Term::Literal(Value::Text(text) | Value::Entity(text) | Value::Case(text)) => {
                let is_plain =
                    text.chars().all(|letter| is_xml_char(letter) && letter != '\'' && letter != '\\');
                is_plain.then(|| format!("'{text}'"))
            }
            Term::Literal(Value::Pose(_) | Value::List(_)) => None,
            Term::Each | Term::Field(..) | Term::Measure(..) | Term::List(_) | Term::Arith(..) => None,
            Term::Count(_) | Term::First(_) | Term::Template(_) => None,
        }
    }
}

/// Arguments of a fluent or a measure as terms; `None` for `any`.
pub(super) fn fact_term(arg: &FactArg) -> Option<&Term> {
    match arg {
        FactArg::Term(term) => Some(term),
        FactArg::Any => None,
    }
}

/// Type of a port in C++.
pub(super) fn cpp_type(ty: &Type) -> &'static str {
    match ty {
        Type::Bool => "bool",
        Type::Int => "int",
        Type::Number | Type::Quantity(_) => "double",
        Type::Text | Type::Pose | Type::Entity(_) | Type::Case(_) | Type::List(_) => "std::string",
    }
}
