//! Spelling of conditions, facts and terms, for messages.

use super::Prover;
use super::evaluation::CallFrame;
use crate::facts::show;
use crate::ir::{Condition, Fact, Term};

impl Prover<'_> {
    /// Spelling of a condition, in back-quotes.
    pub(crate) fn show(&self, condition: &Condition, truth: bool, frame: CallFrame<'_>) -> String {
        let text = self.text(condition, frame);
        let inner = text.trim_matches('`');
        if truth { format!("`{inner}`") } else { format!("`not {inner}`") }
    }

    pub(super) fn text(&self, condition: &Condition, frame: CallFrame<'_>) -> String {
        let join = |parts: &[Condition], word: &str| {
            let parts: Vec<_> = parts.iter().map(|part| self.text(part, frame)).collect();
            parts.join(word)
        };
        match condition {
            Condition::Literal(value) => value.to_string(),
            Condition::Fact(fact) => self.fact_text(fact, frame),
            Condition::Compare(op, left, right) => {
                format!("{} {} {}", self.term_text(left, frame), op.symbol(), self.term_text(right, frame))
            }
            Condition::MonitoredMeasure(id) => {
                format!("monitored({})", self.library.measure(*id).map_or("?", |def| def.name.as_str()))
            }
            Condition::MonitoredFluent(id) => {
                format!("monitored({})", self.library.fluent(*id).map_or("?", |def| def.name.as_str()))
            }
            Condition::Not(inner) => format!("not {}", self.text(inner, frame)),
            Condition::All(parts) => join(parts, " and "),
            Condition::AnyOf(parts) => join(parts, " or "),
            Condition::Unknown => "…".to_owned(),
        }
    }

    fn fact_text(&self, fact: &Fact, frame: CallFrame<'_>) -> String {
        let Some(def) = self.library.fluent(fact.fluent) else { return "…".to_owned() };
        match self.key(fact, frame) {
            Some(key) => {
                let name = |index, arg| self.argument_name(fact.fluent, index, arg);
                show(&def.name, key, def.params.len(), name).trim_matches('`').to_owned()
            }
            None => def.name.to_string(),
        }
    }

    pub(super) fn term_text(&self, term: &Term, frame: CallFrame<'_>) -> String {
        match term {
            Term::Bool(value) => value.to_string(),
            Term::Int(value) => value.to_string(),
            Term::Number(value) => round(*value).to_string(),
            Term::Text(text) => format!("\"{text}\""),
            Term::Case(id, case) => self.library.case_name(*id, *case).to_owned(),
            Term::Entity(entity) => self.environment.name(*entity).to_string(),
            Term::List(items) => {
                let items: Vec<_> = items.iter().map(|item| self.term_text(item, frame)).collect();
                format!("[{}]", items.join(", "))
            }
            Term::Binding(id) => self
                .program
                .bindings
                .get(id.index())
                .map_or_else(|| "?".to_owned(), |binding| binding.name.to_string()),
            Term::Param(index) => match frame.args.get(usize::from(*index)) {
                None | Some(Term::Param(_)) => "?".to_owned(),
                Some(term) => self.term_text(term, frame),
            },
            Term::Result => "result".to_owned(),
            Term::Each => {
                frame.each.map_or_else(|| "each".to_owned(), |entity| self.entity_name(entity).to_string())
            }
            Term::Field(of, name) => format!("{}.{name}", self.term_text(of, frame)),
            Term::Measure(id, args) => {
                let name = self.library.measure(*id).map_or("?", |def| def.name.as_str());
                let args: Vec<_> = args.iter().map(|arg| self.term_text(arg, frame)).collect();
                format!("{name}({})", args.join(", "))
            }
            Term::Arith(op, left, right) => {
                format!("{} {} {}", self.term_text(left, frame), op.symbol(), self.term_text(right, frame))
            }
            Term::Unknown => "?".to_owned(),
        }
    }
}

/// Rounds a number for messages.
pub(super) fn round(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
