//! Durations and counts that must be constants, so that the longest duration of every policy is known.

use motet_syntax::ast::{Expr, ExprKind};
use motet_syntax::unit::Unit;

use super::elaborator::{Elaborator, Expected, ValueRole};
use super::errors;
use crate::ir::{BindingId, Term, Ty};

/// Maximal count of a loop, a retry or a reaction.
pub const MAX_COUNT: u32 = 1_000_000;
/// Maximal deadline in seconds: a week.
pub const MAX_SECONDS: f64 = 604_800.0;

impl Elaborator<'_> {
    /// Elaborates a constant duration, in seconds.
    pub(crate) fn seconds(&mut self, expr: &Expr, place: &'static str) -> Option<f64> {
        let wanted = Expected { ty: Ty::DURATION, place: ValueRole::Named(place) };
        match self.term_of(expr, wanted) {
            Term::Number(value) if value.is_finite() && (0.0..=MAX_SECONDS).contains(&value) => Some(value),
            Term::Number(value) => {
                // In the unit in which it is written.
                let unit = expr.unit().unwrap_or(Unit::Second);
                let (least, greatest) = (unit.show(0.0), unit.show(MAX_SECONDS));
                let actual = unit.show(value);
                self.report(errors::OutOfRange {
                    span: expr.span,
                    place: place.to_owned(),
                    least,
                    greatest,
                    actual,
                    meant: None,
                });
                None
            }
            Term::Unknown => None,
            Term::Binding(id) if self.is_param(id) => None,
            _ => {
                self.report(errors::NotConstant { span: expr.span, place });
                None
            }
        }
    }

    /// Returns whether a binding is a parameter, whose value is known only at a call.
    fn is_param(&self, id: BindingId) -> bool {
        self.bindings.get(id.index()).is_some_and(|binding| binding.is_param)
    }

    /// Elaborates a constant count of at least `least`.
    pub(crate) fn count(&mut self, expr: &Expr, place: &'static str, least: u32) -> Option<u32> {
        let wanted = Expected { ty: Ty::INT, place: ValueRole::Named(place) };
        let beyond = |actual: String| errors::OutOfRange {
            span: expr.span,
            place: place.to_owned(),
            least: least.to_string(),
            greatest: MAX_COUNT.to_string(),
            actual,
            meant: None,
        };
        // A whole number that no integer holds.
        if let ExprKind::Number(value) = expr.kind
            && value.fract() == 0.0
            && value.abs() > f64::from(MAX_COUNT)
        {
            self.report(beyond(value.to_string()));
            return None;
        }
        match self.term_of(expr, wanted) {
            Term::Int(value) => {
                let count = u32::try_from(value).ok().filter(|count| (least..=MAX_COUNT).contains(count));
                if count.is_none() {
                    self.report(beyond(value.to_string()));
                }
                count
            }
            Term::Unknown => None,
            Term::Binding(id) if self.is_param(id) => None,
            _ => {
                self.report(errors::NotConstant { span: expr.span, place });
                None
            }
        }
    }
}
