//! Lowering of terms and conditions, with the parameters of a contract replaced by the arguments of the call.

use motet_graph as graph;
use motet_syntax::ast::{ArithOp, CompareOp};

use super::table::Tables;
use crate::ir::{Condition, Fact, Term};

impl Tables<'_> {
    pub(super) fn term(
        &mut self,
        term: &Term,
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> graph::Term {
        use graph::Value;
        let literal = graph::Term::Literal;
        match term {
            Term::Bool(value) => literal(Value::Bool(*value)),
            Term::Int(value) => literal(Value::Int(*value)),
            Term::Number(value) => literal(Value::Number(*value)),
            Term::Text(text) => literal(Value::Text(text.clone())),
            Term::Case(id, case) => literal(Value::Case(self.library.case_name(*id, *case).into())),
            Term::Entity(entity) => literal(Value::Entity(self.environment.name(*entity))),
            Term::List(items) => self.list(items, args, result),
            Term::Binding(id) => graph::Term::Binding(graph::BindingId(id.0)),
            Term::Param(index) => match args.get(usize::from(*index)) {
                // An argument is never itself a parameter, so this ends.
                Some(Term::Param(_)) | None => literal(Value::Bool(false)),
                Some(arg) => self.term(arg, &[], None),
            },
            Term::Result => result.map_or(literal(Value::Bool(false)), graph::Term::Binding),
            Term::Each => graph::Term::Each,
            Term::Field(of, name) => graph::Term::Field(Box::new(self.term(of, args, result)), name.clone()),
            Term::Measure(id, inner) => {
                let inner = inner.iter().map(|arg| self.term(arg, args, result)).collect();
                graph::Term::Measure(self.measure(*id), inner)
            }
            Term::Arith(op, left, right) => {
                let op = match op {
                    ArithOp::Add => graph::Arithmetic::Add,
                    ArithOp::Subtract => graph::Arithmetic::Subtract,
                    ArithOp::Multiply => graph::Arithmetic::Multiply,
                    ArithOp::Divide => graph::Arithmetic::Divide,
                };
                let (left, right) = (self.term(left, args, result), self.term(right, args, result));
                graph::Term::Arith(op, Box::new(left), Box::new(right))
            }
            // Only after an error, and what has errors is not lowered.
            Term::Unknown => literal(Value::Bool(false)),
        }
    }

    /// Lowers a list: to a literal if all items are, else to a list that the engine evaluates.
    fn list(&mut self, items: &[Term], args: &[Term], result: Option<graph::BindingId>) -> graph::Term {
        let terms: Vec<_> = items.iter().map(|item| self.term(item, args, result)).collect();
        let values: Option<Vec<_>> = terms
            .iter()
            .map(|term| match term {
                graph::Term::Literal(value) => Some(value.clone()),
                _ => None,
            })
            .collect();
        values.map_or(graph::Term::List(terms), |values| graph::Term::Literal(graph::Value::List(values)))
    }

    pub(super) fn condition(
        &mut self,
        condition: &Condition,
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> graph::Condition {
        match condition {
            Condition::Literal(value) => graph::Condition::Literal(*value),
            Condition::Fact(fact) => match self.fact(fact, args, result) {
                Some(fact) => graph::Condition::Fact(fact),
                None => graph::Condition::Literal(false),
            },
            Condition::Compare(op, left, right) => {
                let op = match op {
                    CompareOp::Equal => graph::Comparison::Equal,
                    CompareOp::Unequal => graph::Comparison::Unequal,
                    CompareOp::Less => graph::Comparison::Less,
                    CompareOp::AtMost => graph::Comparison::AtMost,
                    CompareOp::More => graph::Comparison::More,
                    CompareOp::AtLeast => graph::Comparison::AtLeast,
                };
                graph::Condition::Compare(op, self.term(left, args, result), self.term(right, args, result))
            }
            // Decided by the prover from the monitors around the step: in a graph it holds.
            Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) | Condition::Unknown => {
                graph::Condition::Literal(true)
            }
            Condition::Not(inner) => graph::Condition::Not(Box::new(self.condition(inner, args, result))),
            Condition::All(parts) => {
                graph::Condition::All(parts.iter().map(|part| self.condition(part, args, result)).collect())
            }
            Condition::AnyOf(parts) => {
                graph::Condition::AnyOf(parts.iter().map(|part| self.condition(part, args, result)).collect())
            }
        }
    }

    pub(super) fn fact(
        &mut self,
        fact: &Fact,
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> Option<graph::Fact> {
        let fluent = self.fluent(fact.fluent);
        let terms = fact.args.iter().map(|arg| match arg {
            None => graph::FactArg::Any,
            Some(term) => graph::FactArg::Term(self.term(term, args, result)),
        });
        let args: Vec<_> = terms.collect();
        let whole = fact.args.iter().all(|arg| *arg != Some(Term::Unknown));
        whole.then_some(graph::Fact { fluent, args })
    }
}
