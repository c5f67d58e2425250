//! Conditions as leaves that succeed if they are known to hold.
//!
//! An unknown condition is neither true nor false, so a negation goes down to the leaves: an inverter above
//! would turn what is unknown into what holds.

use motet_graph::{BindingId, Comparison, Condition, Fact, FactArg, Term, Type, Value};

use super::Writer;
use super::model::{Leaf, Port};
use super::value::{literal, port_type};
use crate::leaves::{PortType, Ports};
use crate::names::{COUNT, FIELD, FLUENT, IS, MEASURE, NUMBER, OF, THAN, VALUE, is_node_name, is_port_name};
use crate::xml::Element;

impl Writer<'_> {
    /// A tree of leaves that succeeds if a condition is known to be `holds`, and fails otherwise.
    pub(super) fn condition(&mut self, condition: &Condition, holds: bool, path: &str) -> Element {
        match condition {
            Condition::Literal(value) => {
                Element::new(if *value == holds { "AlwaysSuccess" } else { "AlwaysFailure" })
            }
            Condition::Fact(fact) => self.fact(fact, holds, path),
            Condition::Compare(comparison, left, right) => {
                let comparison = if holds { *comparison } else { inverse(*comparison) };
                self.compare(comparison, left, right, path)
            }
            Condition::Not(inner) => self.condition(inner, !holds, path),
            Condition::All(parts) => self.joined(parts, holds, holds, path),
            Condition::AnyOf(parts) => self.joined(parts, !holds, holds, path),
        }
    }

    fn joined(&mut self, parts: &[Condition], is_all: bool, holds: bool, path: &str) -> Element {
        let mut parts: Vec<Element> = parts.iter().map(|part| self.condition(part, holds, path)).collect();
        match (parts.pop(), parts.is_empty(), is_all) {
            (None, _, true) => Element::new("AlwaysSuccess"),
            (None, _, false) => Element::new("AlwaysFailure"),
            (Some(only), true, _) => only,
            (Some(last), false, _) => {
                parts.push(last);
                Element::new(if is_all { "Sequence" } else { "Fallback" }).children(parts)
            }
        }
    }

    fn fact(&mut self, fact: &Fact, holds: bool, path: &str) -> Element {
        let graph = self.graph;
        let Some(fluent) = graph.fluents.get(fact.fluent.index()) else {
            return self.refuse(path, "a fluent that the graph does not declare");
        };
        if !fluent.observable {
            let why = "is known from effects alone, and a tree keeps no facts";
            return self.refuse(path, format!("a test of `{}`, which {why}", fluent.name));
        }
        let ports = named(self.leaves.fluent(&fluent.name), fluent.params.len());
        let mut leaf = Leaf::condition(format!("{FLUENT}{}", fluent.name));
        for ((port, ty), arg) in ports.into_iter().zip(&fluent.params).zip(&fact.args) {
            let value = match arg {
                FactArg::Any => "any".to_owned(),
                FactArg::Term(term) => self.port(term, path),
            };
            leaf.give(Port::typed(&port, ty), value);
        }
        let is = Port::text(IS).or("true");
        if holds {
            leaf.has(is)
        } else {
            leaf.give(is, "false".to_owned())
        }
        self.leaf(leaf, path)
    }

    fn compare(&mut self, comparison: Comparison, left: &Term, right: &Term, path: &str) -> Element {
        let graph = self.graph;
        let observed = |term: &Term| matches!(term, Term::Measure(..) | Term::Field(..) | Term::Count(_));
        if observed(right) && !observed(left) {
            return self.compare(mirrored(comparison), right, left, path);
        }
        let mut leaf;
        let than = match left {
            Term::Measure(id, args) => {
                let Some(measure) = graph.measures.get(id.index()) else {
                    return self.refuse(path, "a measure that the graph does not declare");
                };
                let known = self.leaves.measure(&measure.name).map(|(ports, _)| ports);
                let ports = named(known, measure.params.len());
                leaf = Leaf::condition(format!("{MEASURE}{}", measure.name));
                for ((port, ty), arg) in ports.into_iter().zip(&measure.params).zip(args) {
                    let value = self.port(arg, path);
                    leaf.give(Port::typed(&port, ty), value);
                }
                measure.result.clone()
            }
            Term::Field(of, field) => {
                leaf = Leaf::condition(FIELD.to_owned());
                let of = self.port(of, path);
                leaf.give(Port::text("field"), field.to_string());
                leaf.give(Port::text(OF), of);
                match self.leaves.field(field) {
                    Some(PortType::Name | PortType::Text) => Type::Text,
                    _ => Type::Number,
                }
            }
            Term::Count(list) => return self.count(list, comparison, right, path),
            other => {
                let ty = match other {
                    Term::Binding(id) => graph.bindings.get(id.index()).map(|binding| binding.ty.clone()),
                    Term::Literal(Value::Int(_) | Value::Number(_)) => Some(Type::Number),
                    Term::Literal(Value::Text(_) | Value::Entity(_) | Value::Case(_)) => Some(Type::Text),
                    _ => None,
                };
                let ty = match ty {
                    Some(Type::Text | Type::Entity(_) | Type::Case(_)) => Type::Text,
                    Some(Type::Int | Type::Number | Type::Quantity(_)) => Type::Number,
                    Some(Type::Bool | Type::Pose | Type::List(_)) | None => {
                        return self
                            .refuse(path, "a comparison of values that are neither names nor numbers");
                    }
                };
                leaf = Leaf::condition(if ty == Type::Text { VALUE } else { NUMBER }.to_owned());
                let value = self.port(other, path);
                leaf.give(Port::typed(OF, &ty), value);
                ty
            }
        };
        leaf.give(Port::text(IS), key(comparison).to_owned());
        let value = self.port(right, path);
        leaf.give(Port::typed(THAN, &than), value);
        self.leaf(leaf, path)
    }

    /// Comparison of the length of a list of names.
    pub(super) fn count(&mut self, list: &Term, comparison: Comparison, than: &Term, path: &str) -> Element {
        let mut leaf = Leaf::condition(COUNT.to_owned());
        let value = self.port(list, path);
        let ty = match list {
            Term::Binding(id) => self.graph.bindings.get(id.index()).map(|binding| port_type(&binding.ty)),
            _ => None,
        };
        if ty.is_some_and(|ty| ty != "std::vector<std::string>") {
            return self.refuse(path, "the length of a list of numbers");
        }
        leaf.give(Port::typed(OF, &Type::List(Box::new(Type::Text))), value);
        leaf.give(Port::text(IS), key(comparison).to_owned());
        let value = self.port(than, path);
        leaf.give(Port::typed(THAN, &Type::Number), value);
        self.leaf(leaf, path)
    }
}

/// Names of ports, numbered where no library gives them.
fn named(known: Option<&Ports>, count: usize) -> Vec<String> {
    match known.filter(|known| known.len() == count) {
        Some(known) => known.iter().map(|(name, _)| name.to_string()).collect(),
        None => (1..=count).map(|number| format!("arg_{number}")).collect(),
    }
}

/// Word of a comparison, as in the JSON syntax.
fn key(comparison: Comparison) -> &'static str {
    match comparison {
        Comparison::Equal => "equal",
        Comparison::Unequal => "unequal",
        Comparison::Less => "less",
        Comparison::AtMost => "at_most",
        Comparison::More => "more",
        Comparison::AtLeast => "at_least",
    }
}

/// The comparison that holds where another one does not.
fn inverse(comparison: Comparison) -> Comparison {
    match comparison {
        Comparison::Equal => Comparison::Unequal,
        Comparison::Unequal => Comparison::Equal,
        Comparison::Less => Comparison::AtLeast,
        Comparison::AtMost => Comparison::More,
        Comparison::More => Comparison::AtMost,
        Comparison::AtLeast => Comparison::Less,
    }
}

/// The comparison with its sides exchanged.
fn mirrored(comparison: Comparison) -> Comparison {
    match comparison {
        Comparison::Equal | Comparison::Unequal => comparison,
        Comparison::Less => Comparison::More,
        Comparison::AtMost => Comparison::AtLeast,
        Comparison::More => Comparison::Less,
        Comparison::AtLeast => Comparison::AtMost,
    }
}

/// Leaves and values.
impl Writer<'_> {
    /// Writes a leaf and adds it to the models.
    pub(super) fn leaf(&mut self, leaf: Leaf, path: &str) -> Element {
        if !is_node_name(&leaf.id) {
            return self.refuse(path, format!("`{}`, which is no name for a node", leaf.id));
        }
        let wrong = leaf.ports.iter().find(|port| !is_port_name(&port.name));
        if let Some(port) = wrong {
            return self
                .refuse(path, format!("`{}` of `{}`, which is no name for a port", port.name, leaf.id));
        }
        let (kind, ports, _) =
            self.models.0.entry(leaf.id.clone()).or_insert_with(|| (leaf.kind, Vec::new(), leaf.note));
        let is_other = *kind != leaf.kind;
        let mut clash = None;
        for port in leaf.ports {
            match ports.iter().find(|known| known.name == port.name) {
                None => ports.push(port),
                Some(known) if *known == port => {}
                Some(_) => clash = Some(port.name),
            }
        }
        if is_other || clash.is_some() {
            let what = format!("`{}`, because two different leaves would have this name", leaf.id);
            return self.refuse(path, what);
        }
        // A verifier of BehaviorTree.CPP does not know the long form inside a reactive node.
        let element = Element::new(leaf.id);
        leaf.values.into_iter().fold(element, |element, (name, value)| element.with(&name, value))
    }
}

impl Writer<'_> {
    /// The entry of a binding as a port refers to it.
    pub(super) fn entry(&self, id: BindingId) -> Option<&str> {
        self.entries.get(id.index())?.as_deref()
    }

    /// A term as the text of a port: a constant or the entry of a binding; refused otherwise.
    pub(super) fn port(&mut self, term: &Term, path: &str) -> String {
        let what = match term {
            Term::Literal(value) => match literal(value) {
                Ok(text) => return text,
                Err(why) => why,
            },
            Term::Binding(id) => match self.entry(*id) {
                Some(entry) => return format!("{{{entry}}}"),
                None => "a result without a name",
            },
            Term::Each => "a value of each entity of a kind",
            Term::Field(..) => "a field as an argument: a port holds a constant or an entry",
            Term::Measure(..) => "a measure as an argument: a port holds a constant or an entry",
            Term::List(items) => {
                let items = items.iter().map(|item| match item {
                    Term::Literal(value) => Some(value.clone()),
                    _ => None,
                });
                match items.collect::<Option<Vec<Value>>>().map(|items| literal(&Value::List(items))) {
                    Some(Ok(text)) => return text,
                    Some(Err(why)) => why,
                    None => "a list of bindings: a port holds a constant or one entry",
                }
            }
            Term::Arith(..) => "a calculation: a port holds a constant or an entry",
            Term::Count(_) | Term::First(_) => {
                "`count` or `first` as an argument: a port holds a constant or an entry"
            }
            Term::Template(_) => "a text with values: a port holds a constant or an entry",
        };
        self.refuse(path, what);
        String::new()
    }
}
