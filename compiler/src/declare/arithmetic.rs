//! Arithmetic with dimensions, and the wording of type errors.

use motet_syntax::Span;
use motet_syntax::ast::{ArithOp, Expr, ExprKind};
use motet_syntax::suggest::one_of;
use motet_syntax::unit::{Dimension, Unit};
use smol_str::SmolStr;

use super::diagnostics;
use super::diagnostics::WrongDimension;
use super::elaborator::{Elaborator, Expected, ValueRole, percent};
use super::name::article;
use crate::ir::{Base, BindingId, Term, Ty};

impl Elaborator<'_> {
    pub(super) fn arith(&mut self, op: ArithOp, left: &Expr, right: &Expr, span: Span) -> (Term, Ty) {
        let mut size = 0;
        let [(left, left_ty), (right, right_ty)] = [left, right].map(|part| {
            let (term, ty) = self.term(part, None);
            (self.bounded(term, part.span, &mut size), ty)
        });
        let (Some(a), Some(b)) = (dimension(left_ty), dimension(right_ty)) else {
            if left_ty.base != Base::Unknown && right_ty.base != Base::Unknown {
                self.mismatch(op.symbol(), left_ty, right_ty, span);
            }
            return (Term::Unknown, Ty::UNKNOWN);
        };
        let result = match op {
            ArithOp::Add | ArithOp::Subtract if a == b => a,
            ArithOp::Add | ArithOp::Subtract => {
                self.mismatch(op.symbol(), left_ty, right_ty, span);
                return (Term::Unknown, Ty::UNKNOWN);
            }
            ArithOp::Multiply => a.times(b),
            ArithOp::Divide => a.over(b),
        };
        let plain = result == Dimension::NONE;
        let whole = plain && left_ty == Ty::INT && right_ty == Ty::INT && op != ArithOp::Divide;
        let base = if whole {
            Base::Int
        } else if plain {
            Base::Number
        } else {
            Base::Quantity(result)
        };
        let ty = Ty::plain(base);
        if op == ArithOp::Divide && literal(&right) == Some(0.0) {
            self.report(diagnostics::ResultWithoutValue { span, is_division_by_zero: true });
            return (Term::Unknown, ty);
        }
        let known = literal(&left).zip(literal(&right)).map(|(a, b)| match op {
            ArithOp::Add => a + b,
            ArithOp::Subtract => a - b,
            ArithOp::Multiply => a * b,
            ArithOp::Divide => a / b,
        });
        match known {
            Some(value) if !value.is_finite() => {
                self.report(diagnostics::ResultWithoutValue { span, is_division_by_zero: false });
                (Term::Unknown, ty)
            }
            Some(value) if whole => (Term::Int(value as i64), ty),
            Some(value) => (Term::Number(value), ty),
            None => (Term::Arith(op, Box::new(left), Box::new(right)), ty),
        }
    }

    pub(crate) fn mismatch(&mut self, operator: &'static str, left: Ty, right: Ty, span: Span) {
        let left = self.library.type_name(left);
        let right = self.library.type_name(right);
        self.report(WrongDimension { span, left, right, operator });
    }

    /// An example value of a type, in back-quotes, where one helps.
    pub(super) fn example(&self, ty: Ty) -> Option<String> {
        match ty {
            Ty { base: Base::Quantity(Dimension::NONE), lists: 0 } => Some("`20 %`".to_owned()),
            Ty { base: Base::Quantity(dimension), lists: 0 } => {
                Some(format!("`1 {}`", dimension.si_symbol()))
            }
            Ty { base: Base::Text, lists: 0 } => Some("`\"red mug\"`".to_owned()),
            Ty { base: Base::Int, lists: 0 } => Some("`3`".to_owned()),
            _ => None,
        }
    }

    /// Proposed spelling for a value of the wrong type, where the value shows what was meant.
    pub(super) fn instead(&self, term: &Term, expr: &Expr, wanted: Ty) -> Option<String> {
        let is_known = |name: &str| self.scope.find(name).is_some() || self.entities.find(name).is_some();
        match (&expr.kind, wanted) {
            (ExprKind::List(items), Ty { lists: 0, .. }) if items.len() == 1 => {
                Some("the value without brackets".to_owned())
            }
            (ExprKind::Text(text), Ty { base: Base::Entity(_), lists: 0 }) if is_known(text) => {
                Some(format!("`{text}` without quotes"))
            }
            (ExprKind::Plain(text), Ty { base: Base::Quantity(dimension), lists: 0 }) => {
                let number = text.trim().trim_end_matches(|c: char| !c.is_ascii_digit());
                number.parse::<f64>().ok()?;
                let unit = text.trim().get(number.len()..)?.trim();
                let unit = match Unit::from_spelling(unit).filter(|meant| meant.dimension() == dimension) {
                    Some(meant) => meant,
                    None if unit.is_empty() && dimension == Dimension::ANGLE => Unit::Degree,
                    None if unit.is_empty() => Unit::si(dimension)?,
                    None => return None,
                };
                Some(format!("`\"{number} {}\"`", unit.symbol()))
            }
            (_, Ty { base: Base::Entity(kind), lists: 0 }) if matches!(term, Term::Entity(_)) => {
                let fitting = self.entities.iter().filter(|(.., of)| self.library.is_kind(*of, kind));
                let fitting: Vec<SmolStr> = fitting.map(|(_, name, _)| name.clone()).take(4).collect();
                (1..=3).contains(&fitting.len()).then(|| one_of(fitting.iter().map(SmolStr::as_str)))
            }
            (ExprKind::Name(name) | ExprKind::Binding(name), Ty::TEXT)
                if matches!(term, Term::Caught(..)) =>
            {
                Some(format!("`{name}.text`"))
            }
            _ => None,
        }
    }

    /// Describes a value for a message about its type.
    pub(super) fn describe(&self, term: &Term, ty: Ty) -> String {
        let name = self.library.type_name(ty);
        match term {
            Term::Entity(id) => match self.entities.name(*id) {
                Some(id) => format!("`{id}`, which is {}", article(&name)),
                None => article(&name),
            },
            Term::Case(id, case) => format!("the case `{}` of `{name}`", self.library.case_name(*id, *case)),
            Term::Text(text) => format!("the text \"{}\"", text.chars().take(40).collect::<String>()),
            Term::Binding(id) => match self.bindings.get(id.index()) {
                Some(binding) => format!("`{}`, which is {}", binding.name, article(&name)),
                None => article(&name),
            },
            _ => article(&name),
        }
    }
}

/// Dimension of a number or quantity; `None` for other types.
pub(crate) fn dimension(ty: Ty) -> Option<Dimension> {
    match ty {
        Ty { base: Base::Int | Base::Number, lists: 0 } => Some(Dimension::NONE),
        Ty { base: Base::Quantity(dimension), lists: 0 } => Some(dimension),
        _ => None,
    }
}

/// Number of a literal. Whole numbers are exact up to 2^53, the largest that a document can hold.
fn literal(term: &Term) -> Option<f64> {
    match term {
        Term::Int(value) => Some(*value as f64),
        Term::Number(value) => Some(*value),
        _ => None,
    }
}

/// Maximal count of a loop, a retry or a reaction.
pub const MAX_COUNT: u32 = 1_000_000;
/// Maximal deadline in seconds: a week.
pub const MAX_SECONDS: f64 = 604_800.0;
/// Least deadline, in seconds.
const LEAST_DEADLINE_SECS: f64 = 0.001;
/// Maximal distance in m that a `keep` can ask for.
const MAX_DISTANCE_M: f64 = 1000.0;

/// Least part of a robot's speed that a manner may ask for.
const LEAST_PART: f64 = 0.01;

impl Elaborator<'_> {
    /// Elaborates a least distance: a length that is not negative.
    pub(crate) fn distance(&mut self, expr: &Expr) -> Term {
        let wanted = Expected { ty: Ty::LENGTH, place: ValueRole::Named("a least distance") };
        let term = self.term_of(expr, wanted);
        match term {
            Term::Number(value) if !(0.0..=MAX_DISTANCE_M).contains(&value) => {
                let unit = expr.unit().unwrap_or(Unit::Metre);
                self.report(diagnostics::OutOfRange {
                    span: expr.span,
                    place: "a least distance".to_owned(),
                    least: unit.show(0.0),
                    greatest: unit.show(MAX_DISTANCE_M),
                    actual: unit.show(value),
                    meant: None,
                });
                Term::Unknown
            }
            term => term,
        }
    }

    /// Elaborates a constant duration, in seconds.
    pub(crate) fn seconds(&mut self, expr: &Expr, place: &'static str) -> Option<f64> {
        self.seconds_from(0.0, expr, place)
    }

    /// A deadline in seconds. Within no time at all nothing is done.
    pub(crate) fn deadline(&mut self, expr: &Expr, place: &'static str) -> Option<f64> {
        self.seconds_from(LEAST_DEADLINE_SECS, expr, place)
    }

    fn seconds_from(&mut self, least: f64, expr: &Expr, place: &'static str) -> Option<f64> {
        // In the unit in which it is written.
        let unit = expr.unit().unwrap_or(Unit::Second);
        self.constant(expr, (Ty::DURATION, place), [least, MAX_SECONDS], |value, end| {
            unit.show(if end == least && value >= least { 0.0 } else { end })
        })
    }

    /// Returns whether a binding is a parameter, whose value is known only at a call.
    fn is_param(&self, id: BindingId) -> bool {
        self.bindings.get(id.index()).is_some_and(|binding| binding.is_param)
    }

    /// Elaborates a constant part of a whole, from [`LEAST_PART`] to 1.
    pub(crate) fn part(&mut self, expr: &Expr, place: &'static str) -> Option<f64> {
        let range = [LEAST_PART, 1.0];
        self.constant(expr, (Ty::RATIO, place), range, |_, part| format!("{} %", percent(part)))
    }

    /// Elaborates a constant number of a range. `shown` writes a number of the report, given the value.
    fn constant(
        &mut self,
        expr: &Expr,
        (ty, place): (Ty, &'static str),
        [least, greatest]: [f64; 2],
        shown: impl Fn(f64, f64) -> String,
    ) -> Option<f64> {
        match self.term_of(expr, Expected { ty, place: ValueRole::Named(place) }) {
            Term::Number(value) if (least..=greatest).contains(&value) => Some(value),
            Term::Number(value) => {
                self.report(diagnostics::OutOfRange {
                    span: expr.span,
                    place: place.to_owned(),
                    least: shown(value, least),
                    greatest: shown(value, greatest),
                    actual: shown(value, value),
                    meant: None,
                });
                None
            }
            Term::Unknown => None,
            Term::Binding(id) if self.is_param(id) => None,
            _ => {
                self.report(diagnostics::NotConstant { span: expr.span, place });
                None
            }
        }
    }

    /// Elaborates a constant count of at least `least`.
    pub(crate) fn count(&mut self, expr: &Expr, place: &'static str, least: u32) -> Option<u32> {
        let wanted = Expected { ty: Ty::INT, place: ValueRole::Named(place) };
        let beyond = |actual: String| diagnostics::OutOfRange {
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
                self.report(diagnostics::NotConstant { span: expr.span, place });
                None
            }
        }
    }
}
