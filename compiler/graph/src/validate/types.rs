//! Arguments and conditions: ids in range, the right number of arguments, types that fit.

use super::invalid::MAX_TERM_DEPTH;
use super::{Findings, InvalidReason};
use crate::model::{
    BindingId, CallNode, Comparison, Condition, Fact, FactArg, FailureId, Graph, KindId, Node, NodeKind,
    Reaction, Term, TextPart, Type, Value,
};
use smol_str::SmolStr;

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    for node in &graph.nodes {
        let mut types = Types { graph, node, findings, each: None };
        types.node(&node.kind);
    }
    let goal = Node::goal();
    let mut types = Types { graph, node: &goal, findings, each: None };
    graph.goal.iter().for_each(|part| types.condition(part, 0));
}

/// Checks one node.
struct Types<'a> {
    graph: &'a Graph,
    node: &'a Node,
    findings: &'a mut Findings,
    /// Kind over which [`Term::Each`] ranges.
    each: Option<KindId>,
}

/// Knowledge about a term's type.
#[derive(Clone, PartialEq)]
enum Class {
    Bool,
    /// A number; of the named quantity where that is known.
    Number(Option<SmolStr>),
    Text,
    Pose,
    Entity,
    Case,
    List,
    /// A field's type does not stand in a graph.
    Any,
}

impl Types<'_> {
    fn node(&mut self, kind: &NodeKind) {
        match kind {
            NodeKind::Call(call) => self.call(call),
            NodeKind::If { condition, .. } | NodeKind::Wait { condition, .. } => self.condition(condition, 0),
            NodeKind::Repeat { until: Some(condition), .. } => self.condition(condition, 0),
            NodeKind::Monitor { watches, .. } => {
                for watch in watches {
                    self.condition(&watch.condition, 0);
                    if let Reaction::End { why: Some(why), .. } = &watch.reaction {
                        self.term(why, 0);
                    }
                }
            }
            NodeKind::Try { handlers, .. } => {
                for handler in handlers {
                    handler.on.iter().flatten().for_each(|failure| self.failure(*failure));
                    if let Some(caught) = handler.binds {
                        self.bound_to_class(caught.kind, &Class::Case);
                        self.bound_to_class(caught.text, &Class::Text);
                    }
                }
            }
            NodeKind::Let { binding, value } => self.let_value(*binding, value),
            NodeKind::Each { item, list, .. } => self.each_loop(*item, list),
            NodeKind::End { why: Some(why), .. } => {
                self.term(why, 0);
            }
            NodeKind::Repeat { until: None, .. } | NodeKind::End { why: None, .. } => {}
            NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::Parallel { .. } => {}
            NodeKind::Delay { .. } | NodeKind::Finally { .. } => {}
        }
    }

    fn say(&mut self, reason: InvalidReason) {
        self.findings.node(self.node, reason);
    }

    /// Checks the type of a binding of a failure.
    fn bound_to_class(&mut self, id: BindingId, expected: &Class) {
        match self.graph.bindings.get(id.index()) {
            None => self.say(InvalidReason::NoSuch { what: "binding", id: id.0 }),
            Some(binding) if class(&binding.ty) != *expected => {
                self.say(InvalidReason::BindingType(binding.name.clone()));
            }
            Some(_) => {}
        }
    }

    fn failure(&mut self, failure: FailureId) {
        if failure.index() >= self.graph.failures.len() {
            self.say(InvalidReason::NoSuch { what: "failure", id: failure.0 });
        }
    }

    fn call(&mut self, call: &CallNode) {
        let Some(primitive) = self.graph.primitives.get(call.primitive.index()) else {
            self.say(InvalidReason::NoSuch { what: "primitive", id: call.primitive.0 });
            return;
        };
        let params = primitive.params.iter().map(|param| &param.ty);
        self.args(&primitive.name, params, call.args.iter(), 0);
        match (call.binds, &primitive.result) {
            (None, None) => {}
            (Some(binding), Some(result)) => self.bound_to(binding, result),
            (Some(_), None) | (None, Some(_)) => self.say(InvalidReason::Result(primitive.name.clone())),
        }
        for need in &call.needs {
            self.failure(need.failure);
            self.quantified(need.each, |types| {
                need.when.iter().for_each(|when| types.condition(when, 0));
                types.condition(&need.condition, 0);
            });
        }
        for arg in call.motion.iter().flat_map(|motion| &motion.args) {
            self.term(arg, 0);
        }
        for effect in &call.effects {
            self.quantified(effect.each, |types| {
                effect.when.iter().for_each(|when| types.condition(when, 0));
                types.fact(&effect.fact, 0);
            });
        }
        for unsettled in &call.unsettles {
            self.quantified(unsettled.each, |types| {
                unsettled.when.iter().for_each(|when| types.condition(when, 0));
                types.fact(&unsettled.fact, 0);
            });
        }
        if let Some(lifetime) = &call.lasts {
            let unknown =
                lifetime.uses.iter().find(|resource| resource.index() >= self.graph.resources.len());
            if let Some(resource) = unknown {
                self.say(InvalidReason::NoSuch { what: "resource", id: resource.0 });
            }
            for entity in &lifetime.entities {
                self.term(entity, 0);
            }
        }
    }

    fn quantified(&mut self, each: Option<KindId>, check: impl FnOnce(&mut Self)) {
        if let Some(kind) = each.filter(|kind| kind.index() >= self.graph.kinds.len()) {
            self.say(InvalidReason::NoSuch { what: "kind", id: kind.0 });
            return;
        }
        self.each = each;
        check(self);
        self.each = None;
    }

    fn each_loop(&mut self, item: BindingId, list: &Term) {
        self.ground(list);
        let Some(binding) = self.graph.bindings.get(item.index()) else {
            self.say(InvalidReason::NoSuch { what: "binding", id: item.0 });
            return;
        };
        let expected = Type::List(Box::new(binding.ty.clone()));
        if !matches!(self.term(list, 0), Class::List | Class::Any) {
            self.say(InvalidReason::NotAList);
        } else if !self.fits(list, &expected) {
            self.say(InvalidReason::BindingType(binding.name.clone()));
        }
    }

    fn let_value(&mut self, id: BindingId, value: &Term) {
        self.term(value, 0);
        match self.graph.bindings.get(id.index()) {
            None => self.say(InvalidReason::NoSuch { what: "binding", id: id.0 }),
            Some(binding) if !self.fits(value, &binding.ty) => {
                self.say(InvalidReason::BindingType(binding.name.clone()));
            }
            Some(_) => {}
        }
    }

    fn bound_to(&mut self, id: BindingId, ty: &Type) {
        match self.graph.bindings.get(id.index()) {
            None => self.say(InvalidReason::NoSuch { what: "binding", id: id.0 }),
            Some(binding) if !is_subtype(self.graph, ty, &binding.ty) => {
                self.say(InvalidReason::BindingType(binding.name.clone()));
            }
            Some(_) => {}
        }
    }

    fn args<'t>(
        &mut self,
        of: &SmolStr,
        params: impl ExactSizeIterator<Item = &'t Type>,
        args: impl ExactSizeIterator<Item = &'t Term>,
        depth: usize,
    ) {
        let (expected, given) = (params.len(), args.len());
        if expected != given {
            self.say(InvalidReason::Arity { of: of.clone(), expected, given });
        }
        for (index, (ty, arg)) in params.zip(args).enumerate() {
            self.term(arg, depth);
            if !self.fits(arg, ty) {
                self.say(InvalidReason::Argument { of: of.clone(), index });
            }
        }
    }

    fn fact(&mut self, fact: &Fact, depth: usize) {
        let Some(fluent) = self.graph.fluents.get(fact.fluent.index()) else {
            self.say(InvalidReason::NoSuch { what: "fluent", id: fact.fluent.0 });
            return;
        };
        let (expected, given) = (fluent.params.len(), fact.args.len());
        if expected != given {
            self.say(InvalidReason::Arity { of: fluent.name.clone(), expected, given });
        }
        for (index, (ty, arg)) in fluent.params.iter().zip(&fact.args).enumerate() {
            let FactArg::Term(arg) = arg else { continue };
            self.ground(arg);
            self.term(arg, depth);
            if !self.fits(arg, ty) {
                self.say(InvalidReason::Argument { of: fluent.name.clone(), index });
            }
        }
    }

    fn condition(&mut self, condition: &Condition, depth: usize) {
        if depth > MAX_TERM_DEPTH {
            self.too_deep();
            return;
        }
        match condition {
            Condition::Literal(_) => {}
            Condition::Fact(fact) => self.fact(fact, depth + 1),
            Condition::Not(inner) => self.condition(inner, depth + 1),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.iter().for_each(|part| self.condition(part, depth + 1));
            }
            Condition::Compare(comparison, left, right) => {
                let (left, right) = (self.term(left, depth + 1), self.term(right, depth + 1));
                if !comparable(*comparison, &left, &right) {
                    self.say(InvalidReason::Comparison);
                }
            }
        }
    }

    fn too_deep(&mut self) {
        let limit = MAX_TERM_DEPTH;
        self.say(InvalidReason::TooMany { what: "levels of a condition or a term", count: limit + 1, limit });
    }

    /// Checks a term, and says what is known of its type.
    fn term(&mut self, term: &Term, depth: usize) -> Class {
        if depth > MAX_TERM_DEPTH {
            self.too_deep();
            return Class::Any;
        }
        match term {
            Term::Literal(value) => self.value(value, depth),
            Term::Binding(id) => match self.graph.bindings.get(id.index()) {
                Some(binding) => class(&binding.ty),
                None => {
                    self.say(InvalidReason::NoSuch { what: "binding", id: id.0 });
                    Class::Any
                }
            },
            Term::Each => {
                if self.each.is_none() {
                    self.say(InvalidReason::Each);
                }
                Class::Entity
            }
            Term::Field(of, field) => {
                self.ground(of);
                if !matches!(self.term(of, depth + 1), Class::Entity | Class::Any) {
                    self.say(InvalidReason::FieldOf(field.clone()));
                }
                Class::Any
            }
            Term::Measure(id, args) => self.measure(id.index(), args, depth + 1),
            Term::List(items) => {
                for item in items {
                    self.term(item, depth + 1);
                }
                Class::List
            }
            Term::Arith(_, left, right) => {
                for side in [left, right] {
                    if !matches!(self.term(side, depth + 1), Class::Number(_) | Class::Any) {
                        self.say(InvalidReason::Arithmetic);
                    }
                }
                Class::Number(None)
            }
            Term::Count(list) => {
                self.list(list, depth);
                Class::Number(None)
            }
            // The type of what is in a list does not stand in a class.
            Term::First(list) => {
                self.list(list, depth);
                Class::Any
            }
            Term::Template(parts) => {
                for part in parts {
                    if let TextPart::Value(value, ty) = part {
                        self.term(value, depth + 1);
                        if !self.fits(value, ty) {
                            self.say(InvalidReason::TextValue);
                        }
                    }
                }
                Class::Text
            }
        }
    }

    fn list(&mut self, list: &Term, depth: usize) {
        if !matches!(self.term(list, depth + 1), Class::List | Class::Any) {
            self.say(InvalidReason::NotAList);
        }
    }

    fn measure(&mut self, index: usize, args: &[Term], depth: usize) -> Class {
        let Some(measure) = self.graph.measures.get(index) else {
            self.say(InvalidReason::NoSuch { what: "measure", id: index as u32 });
            return Class::Any;
        };
        args.iter().for_each(|arg| self.ground(arg));
        self.args(&measure.name, measure.params.iter(), args.iter(), depth);
        class(&measure.result)
    }

    fn value(&mut self, value: &Value, depth: usize) -> Class {
        if depth > MAX_TERM_DEPTH {
            self.too_deep();
            return Class::Any;
        }
        match value {
            Value::Bool(_) => Class::Bool,
            Value::Int(_) => Class::Number(None),
            Value::Number(number) => {
                if !number.is_finite() {
                    self.say(InvalidReason::NotFinite(*number));
                }
                Class::Number(None)
            }
            Value::Text(_) => Class::Text,
            Value::Entity(_) => Class::Entity,
            Value::Case(_) => Class::Case,
            Value::Pose(_) => Class::Pose,
            Value::List(items) => {
                for item in items {
                    self.value(item, depth + 1);
                }
                Class::List
            }
        }
    }

    /// A term that must be known without observing.
    fn ground(&mut self, term: &Term) {
        // A stack of its own: how deep it goes was not checked yet.
        let mut open = vec![term];
        while let Some(term) = open.pop() {
            match term {
                Term::Literal(_) | Term::Binding(_) | Term::Each => {}
                Term::Field(..) | Term::Measure(..) => {
                    self.say(InvalidReason::Nested);
                    return;
                }
                Term::List(items) => open.extend(items),
                Term::Arith(_, left, right) => open.extend([&**left, &**right]),
                Term::Count(of) | Term::First(of) => open.push(of),
                Term::Template(parts) => open.extend(parts.iter().filter_map(|part| match part {
                    TextPart::Value(value, _) => Some(value),
                    TextPart::Literal(_) => None,
                })),
            }
        }
    }

    /// True if a term, checked before, can stand where a type is expected.
    fn fits(&self, term: &Term, ty: &Type) -> bool {
        match term {
            Term::Literal(value) => value.fits(ty),
            Term::Binding(id) => {
                self.graph.bindings.get(id.index()).is_none_or(|b| is_subtype(self.graph, &b.ty, ty))
            }
            Term::Each => self.each.is_none_or(|kind| is_subtype(self.graph, &Type::Entity(kind), ty)),
            Term::Field(..) => true,
            Term::Measure(id, _) => self
                .graph
                .measures
                .get(id.index())
                .is_none_or(|measure| is_subtype(self.graph, &measure.result, ty)),
            Term::List(items) => match ty {
                Type::List(inner) => items.iter().all(|item| self.fits(item, inner)),
                Type::Bool | Type::Int | Type::Number | Type::Quantity(_) | Type::Text => false,
                Type::Pose | Type::Entity(_) | Type::Case(_) => false,
            },
            Term::Arith(..) => matches!(class(ty), Class::Number(_)),
            Term::Count(_) => matches!(ty, Type::Int | Type::Number),
            // An element fits what the list of such elements fits.
            Term::First(list) => self.fits(list, &Type::List(Box::new(ty.clone()))),
            Term::Template(_) => *ty == Type::Text,
        }
    }
}

fn class(ty: &Type) -> Class {
    match ty {
        Type::Bool => Class::Bool,
        Type::Int | Type::Number => Class::Number(None),
        Type::Quantity(name) => Class::Number(Some(name.clone())),
        Type::Text => Class::Text,
        Type::Pose => Class::Pose,
        Type::Entity(_) => Class::Entity,
        Type::Case(_) => Class::Case,
        Type::List(_) => Class::List,
    }
}

fn comparable(comparison: Comparison, left: &Class, right: &Class) -> bool {
    let numbers = match (left, right) {
        (Class::Number(Some(left)), Class::Number(Some(right))) => left == right,
        (Class::Number(_) | Class::Any, Class::Number(_) | Class::Any) => true,
        (_, _) => false,
    };
    match comparison {
        Comparison::Less | Comparison::AtMost | Comparison::More | Comparison::AtLeast => numbers,
        Comparison::Equal | Comparison::Unequal => match (left, right) {
            (Class::Number(_), Class::Number(_)) => numbers,
            (Class::Any, _) | (_, Class::Any) => true,
            (left, right) => left == right,
        },
    }
}

/// True if a value of one type can stand where another is expected.
fn is_subtype(graph: &Graph, ty: &Type, expected: &Type) -> bool {
    match (ty, expected) {
        (Type::Entity(kind), Type::Entity(above)) => {
            let mut current = Some(*kind);
            while let Some(here) = current {
                if here == *above {
                    return true;
                }
                // Parents come before children, so this ends.
                current = graph
                    .kinds
                    .get(here.index())
                    .and_then(|kind| kind.parent)
                    .filter(|parent| *parent < here);
            }
            false
        }
        (Type::List(inner), Type::List(expected)) => is_subtype(graph, inner, expected),
        (Type::Int, Type::Number) => true,
        (ty, expected) => ty == expected,
    }
}
