//! Conditions as trees of condition nodes.
//!
//! A condition of the graph has three values, a node two. So each condition is brought into negation
//! normal form, and a leaf succeeds where its literal is *known*: `not open(c)` is a node that succeeds
//! where the fact is known to be false. Strong Kleene logic makes the whole succeed exactly where it is
//! known to be true.

use motet_graph::{Comparison, Condition, Fact, MeasureId, Term};

use smol_str::SmolStr;

use super::Exporter;
use super::call::fact_term;
use crate::element::Element;
use crate::names::{IS, THAN, is_node_name, is_port};
use crate::vocabulary::NodeSignature;

impl Exporter<'_> {
    /// Element that succeeds where the condition is known to have the truth value `wanted`.
    pub(super) fn condition(&mut self, path: &str, condition: &Condition, wanted: bool) -> Element {
        match condition {
            Condition::Literal(value) => {
                Element::new(if *value == wanted { "AlwaysSuccess" } else { "AlwaysFailure" })
            }
            Condition::Fact(fact) => self.fact(path, fact, wanted),
            Condition::Compare(op, left, right) => {
                let op = if wanted { *op } else { opposite(*op) };
                self.comparison(path, op, left, right)
            }
            Condition::Not(inner) => self.condition(path, inner, !wanted),
            Condition::All(parts) => self.joined(path, parts, wanted, wanted),
            Condition::AnyOf(parts) => self.joined(path, parts, wanted, !wanted),
        }
    }

    /// A conjunction, or else a disjunction.
    fn joined(&mut self, path: &str, parts: &[Condition], wanted: bool, is_conjunction: bool) -> Element {
        let mut parts: Vec<_> = parts.iter().map(|part| self.condition(path, part, wanted)).collect();
        let (tag, empty) =
            if is_conjunction { ("Sequence", "AlwaysSuccess") } else { ("Fallback", "AlwaysFailure") };
        match parts.len() {
            0 => Element::new(empty),
            1 => parts.remove(0),
            _ => Element::new(tag).around(parts),
        }
    }

    fn fact(&mut self, path: &str, fact: &Fact, wanted: bool) -> Element {
        let graph = self.graph;
        let Some(fluent) = graph.fluents.get(fact.fluent.index()) else {
            return self.refuse(path, "this fact", "its fluent is not declared");
        };
        let names = ports(self.vocabulary.fluents.get(&fluent.name), fact.args.len());
        let Some(names) = names.filter(|_| is_node_name(&fluent.name)) else {
            let part = format!("the fluent `{}`", fluent.name.escape_debug());
            return self.refuse(path, part, "this cannot be the name of a node of its own");
        };
        let node = self.vocabulary.condition_node(&fluent.name);
        self.manifest.add_fluent(graph, fluent, &node, &names);
        let mut element = Element::new(&node);
        for (name, arg) in names.iter().zip(&fact.args) {
            let value = match fact_term(arg) {
                Some(term) => self.port(path, term),
                None => Some("any".to_owned()),
            };
            element = element.with(name, value.unwrap_or_default());
        }
        if wanted { element } else { element.with(IS, "false") }
    }

    fn comparison(&mut self, path: &str, op: Comparison, left: &Term, right: &Term) -> Element {
        match (left, right) {
            (Term::Measure(measure, args), Term::Literal(_) | Term::Binding(_)) => {
                self.measured(path, op, *measure, args, right)
            }
            (Term::Literal(_) | Term::Binding(_), Term::Measure(measure, args)) => {
                self.measured(path, mirrored(op), *measure, args, left)
            }
            _ => match (self.operand(left), self.operand(right)) {
                (Some(left), Some(right)) => {
                    let code = format!("{left} {} {right}", op.symbol());
                    Element::new("ScriptCondition").with("code", code)
                }
                _ => {
                    let shown = self.names.condition(&Condition::Compare(op, left.clone(), right.clone()));
                    let reason = "a node compares a measure or an entry of the blackboard with a literal";
                    self.refuse(path, format!("`{shown}`"), reason)
                }
            },
        }
    }

    fn measured(
        &mut self,
        path: &str,
        op: Comparison,
        measure: MeasureId,
        args: &[Term],
        than: &Term,
    ) -> Element {
        let graph = self.graph;
        let Some(measure) = graph.measures.get(measure.index()) else {
            return self.refuse(path, "this measure", "it is not declared");
        };
        let names = ports(self.vocabulary.measures.get(&measure.name), args.len());
        let Some(names) = names.filter(|_| is_node_name(&measure.name)) else {
            let part = format!("the measure `{}`", measure.name.escape_debug());
            return self.refuse(path, part, "this cannot be the name of a node of its own");
        };
        let node = self.vocabulary.condition_node(&measure.name);
        self.manifest.add_measure(graph, measure, &node, &names);
        let mut element = Element::new(&node);
        for (name, arg) in names.iter().zip(args) {
            element = element.with(name, self.port(path, arg).unwrap_or_default());
        }
        element.with(IS, word(op)).with(THAN, self.port(path, than).unwrap_or_default())
    }
}

/// Ports of the arguments of a fluent or a measure, which a graph does not name.
fn ports(signature: Option<&NodeSignature>, count: usize) -> Option<Vec<SmolStr>> {
    let ports: Vec<_> = signature?.params.iter().take(count).map(|(name, _)| name.clone()).collect();
    (ports.len() == count && ports.iter().all(|port| is_port(port))).then_some(ports)
}

/// Word for a comparison, as the JSON syntax has it.
fn word(op: Comparison) -> &'static str {
    match op {
        Comparison::Equal => "equal",
        Comparison::Unequal => "unequal",
        Comparison::Less => "less",
        Comparison::AtMost => "at_most",
        Comparison::More => "more",
        Comparison::AtLeast => "at_least",
    }
}

/// The comparison that holds where this one does not.
fn opposite(op: Comparison) -> Comparison {
    match op {
        Comparison::Equal => Comparison::Unequal,
        Comparison::Unequal => Comparison::Equal,
        Comparison::Less => Comparison::AtLeast,
        Comparison::AtMost => Comparison::More,
        Comparison::More => Comparison::AtMost,
        Comparison::AtLeast => Comparison::Less,
    }
}

/// The comparison with its sides exchanged.
fn mirrored(op: Comparison) -> Comparison {
    match op {
        Comparison::Equal | Comparison::Unequal => op,
        Comparison::Less => Comparison::More,
        Comparison::AtMost => Comparison::AtLeast,
        Comparison::More => Comparison::Less,
        Comparison::AtLeast => Comparison::AtMost,
    }
}
