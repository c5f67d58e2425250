//! Arithmetic, checked for dimension, and what does not fit together.

use motet_syntax::Span;
use motet_syntax::ast::{ArithOp, Expr, ExprKind};
use motet_syntax::suggest::one_of;
use motet_syntax::unit::{Dimension, Unit};
use smol_str::SmolStr;

use super::errors::WrongDimension;
use super::expr::Resolver;
use super::near::article;
use crate::ir::{Base, Term, Ty};

impl Resolver<'_> {
    pub(super) fn arith(&mut self, op: ArithOp, left: &Expr, right: &Expr, span: Span) -> (Term, Ty) {
        let (left, left_ty) = self.term(left, None);
        let (right, right_ty) = self.term(right, None);
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
        let known = literal(&left).zip(literal(&right)).map(|(a, b)| match op {
            ArithOp::Add => a + b,
            ArithOp::Subtract => a - b,
            ArithOp::Multiply => a * b,
            ArithOp::Divide => a / b,
        });
        match known.filter(|value| value.is_finite()) {
            Some(value) if whole => (Term::Int(value as i64), ty),
            Some(value) => (Term::Number(value), ty),
            None => (Term::Arith(op, Box::new(left), Box::new(right)), ty),
        }
    }

    pub(crate) fn mismatch(&mut self, operator: &'static str, left: Ty, right: Ty, span: Span) {
        let left = self.library.type_name(left);
        let right = self.library.type_name(right);
        self.say(WrongDimension { span, left, right, operator });
    }

    /// A value of a type as it is written, where that helps.
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

    /// What to write in place of a value of another type, where the value says so.
    pub(super) fn instead(&self, term: &Term, ty: Ty, expr: &Expr, wanted: Ty) -> Option<String> {
        let is_known = |name: &str| self.scope.find(name).is_some() || self.entities.find(name).is_some();
        match (&expr.kind, wanted) {
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
            (ExprKind::Name(name) | ExprKind::Plain(name), wanted)
                if wanted.element().is_some_and(|element| self.library.fits(element, ty)) =>
            {
                Some(match expr.kind {
                    ExprKind::Plain(_) => format!("`[\"{name}\"]`"),
                    _ => format!("`[{name}]`"),
                })
            }
            (_, Ty { base: Base::Entity(kind), lists: 0 }) if matches!(term, Term::Entity(_)) => {
                let fitting = self.entities.iter().filter(|(.., of)| self.library.is_kind(*of, kind));
                let fitting: Vec<SmolStr> = fitting.map(|(_, name, _)| name.clone()).take(4).collect();
                (1..=3).contains(&fitting.len()).then(|| one_of(fitting.iter().map(SmolStr::as_str)))
            }
            _ => None,
        }
    }

    /// A value in words, for a message about its type.
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
            Term::Bool(_)
            | Term::Int(_)
            | Term::Number(_)
            | Term::List(_)
            | Term::Param(_)
            | Term::Result
            | Term::Each
            | Term::Field(..)
            | Term::Measure(..)
            | Term::Arith(..)
            | Term::Unknown => article(&name),
        }
    }
}

/// The dimension of a number or quantity.
pub(crate) fn dimension(ty: Ty) -> Option<Dimension> {
    match ty {
        Ty { base: Base::Int | Base::Number, lists: 0 } => Some(Dimension::NONE),
        Ty { base: Base::Quantity(dimension), lists: 0 } => Some(dimension),
        _ => None,
    }
}

/// A number that is written out. Whole numbers are exact up to 2^53, the most that a document can write.
fn literal(term: &Term) -> Option<f64> {
    match term {
        Term::Int(value) => Some(*value as f64),
        Term::Number(value) => Some(*value),
        _ => None,
    }
}
