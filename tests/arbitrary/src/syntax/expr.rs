//! Generators of conditions and terms.

use smol_str::{SmolStr, format_smolstr};

use super::{Flavor, TreeGenerator};
use motet_syntax::ast::{Arg, ArithOp, Call, CompareOp, Expr, ExprKind, TextPart};
use motet_syntax::unit::{Dimension, Unit};

/// Position of a term, which decides if it may be `any`.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum TermPosition {
    Term,
    /// An argument of a fluent or a measure, where `any` is a word of its own.
    FluentArg,
    /// A place where no type is expected: in JSON a quantity has its unit, and a text is no plain string.
    Untyped,
}

impl TreeGenerator<'_> {
    fn expr(&self, kind: ExprKind) -> Expr {
        Expr { kind, span: self.span() }
    }

    pub(super) fn condition(&mut self, depth: usize) -> Expr {
        let leaf = depth == 0;
        let kind = match self.choice.below(if leaf { 4 } else { 9 }) {
            0 => ExprKind::Call(self.fluent(depth)),
            1 => ExprKind::Bool(self.choice.is_heads()),
            2 => self.bound_or_else(|_| ExprKind::Bool(true)),
            3 => {
                let of = Box::new(self.untyped(0));
                ExprKind::Field(of, self.choice.word())
            }
            4 => ExprKind::Not(Box::new(self.condition(depth - 1))),
            5 => ExprKind::All(self.some(2, |it| it.condition(depth - 1))),
            6 => ExprKind::AnyOf(self.some(2, |it| it.condition(depth - 1))),
            _ => {
                use CompareOp::{AtLeast, AtMost, Equal, Less, More, Unequal};
                let op = self.choice.of(&[Less, Equal, Unequal, AtMost, More, AtLeast], Less);
                let left = self.term(depth - 1);
                let right = if left.shows_no_type() { self.untyped(depth - 1) } else { self.term(depth - 1) };
                ExprKind::Compare(op, Box::new(left), Box::new(right))
            }
        };
        self.expr(kind)
    }

    pub(super) fn term(&mut self, depth: usize) -> Expr {
        self.term_in(TermPosition::Term, depth)
    }

    pub(super) fn untyped(&mut self, depth: usize) -> Expr {
        self.term_in(TermPosition::Untyped, depth)
    }

    fn term_in(&mut self, place: TermPosition, depth: usize) -> Expr {
        let leaf = depth == 0;
        let kind = match self.choice.below(if leaf { 7 } else { 12 }) {
            0 => self.name_in(place),
            1 => ExprKind::Number(self.choice.number()),
            2 => self.quantity(place),
            3 if depth > 0 && self.choice.is_heads() => self.template(depth - 1),
            3 => self.literal(place),
            4 => ExprKind::Bool(self.choice.is_heads()),
            5 => self.bound_or_else(|it| it.name_in(place)),
            6 if place == TermPosition::FluentArg => ExprKind::Any,
            6 => self.name_in(place),
            7 => ExprKind::Call(self.fluent(depth - 1)),
            8 => {
                let of = Box::new(self.untyped(depth - 1));
                ExprKind::Field(of, self.choice.word())
            }
            9 if place == TermPosition::Untyped => ExprKind::List(self.some(0, |it| it.untyped(depth - 1))),
            9 => ExprKind::List(self.some(0, |it| it.term(depth - 1))),
            10 => ExprKind::Call(self.pose(depth - 1)),
            _ => {
                use ArithOp::{Add, Divide, Multiply, Subtract};
                let op = self.choice.of(&[Add, Subtract, Multiply, Divide], Add);
                ExprKind::Arith(op, Box::new(self.untyped(depth - 1)), Box::new(self.untyped(depth - 1)))
            }
        };
        self.expr(kind)
    }

    /// A name that nothing binds; in JSON never `any` where that is a word.
    fn name_in(&mut self, place: TermPosition) -> ExprKind {
        let name = self.choice.name_text();
        match self.flavor {
            Flavor::Text => ExprKind::Name(name),
            // In the text syntax a string with blanks is a text.
            Flavor::Json if place == TermPosition::Untyped && name.contains(' ') => ExprKind::Text(name),
            Flavor::Json => ExprKind::Plain(name),
        }
    }

    fn bound_or_else(&mut self, otherwise: impl FnOnce(&mut Self) -> ExprKind) -> ExprKind {
        let index = self.choice.below(8);
        match (self.scope.get(index).cloned(), self.flavor) {
            (Some(name), Flavor::Text) => ExprKind::Name(name),
            (Some(name), Flavor::Json) => ExprKind::Binding(name),
            (None, _) => otherwise(self),
        }
    }

    /// A quantity; in JSON a bare number in place of the SI unit, where a type is expected.
    fn quantity(&mut self, place: TermPosition) -> ExprKind {
        let value = self.choice.number();
        let unit = self.choice.of(Unit::ALL, Unit::Metre);
        let is_si = unit.dimension() != Dimension::NONE && Unit::si(unit.dimension()) == Some(unit);
        match self.flavor {
            Flavor::Text => ExprKind::Quantity(value, unit),
            Flavor::Json if is_si && place != TermPosition::Untyped => ExprKind::Number(value),
            Flavor::Json => {
                let quantity = self.expr(ExprKind::Quantity(value, unit));
                ExprKind::Plain(motet_syntax::print::expression(&quantity).into())
            }
        }
    }

    /// A number without a unit.
    pub(super) fn number(&mut self) -> Expr {
        let value = self.choice.number();
        self.expr(ExprKind::Number(value))
    }

    pub(super) fn percent(&mut self) -> Expr {
        let value = self.choice.number();
        self.expr(ExprKind::Quantity(value, Unit::Percent))
    }

    /// A text; in JSON one that could be nothing else.
    fn literal(&mut self, place: TermPosition) -> ExprKind {
        let text = self.choice.text();
        match self.flavor {
            Flavor::Text => ExprKind::Text(text),
            Flavor::Json if place == TermPosition::Untyped => ExprKind::Text(text),
            Flavor::Json if text.starts_with('$') => ExprKind::Text(text),
            Flavor::Json => ExprKind::Plain(format_smolstr!("the {text}")),
        }
    }

    /// A text with values, which are in the text syntax wherever it stands.
    fn template(&mut self, depth: usize) -> ExprKind {
        let flavor = std::mem::replace(&mut self.flavor, Flavor::Text);
        let mut parts = Vec::new();
        for _ in 0..=self.choice.below(2) {
            let name = self.choice.name_text();
            let kind = match self.choice.below(4) {
                0 => ExprKind::Name(name),
                1 => ExprKind::Call(self.fluent(depth)),
                2 => ExprKind::Field(Box::new(self.term(depth)), self.choice.word()),
                _ => ExprKind::Arith(ArithOp::Add, Box::new(self.term(depth)), Box::new(self.term(0))),
            };
            // What is quoted inside would end the value.
            let value = self.expr(kind);
            let is_plain = !motet_syntax::print::expression(&value).contains(['"', '{']);
            let value = if is_plain { value } else { self.expr(ExprKind::Name("mug_1".into())) };
            parts.extend([
                TextPart::Literal(format_smolstr!("the {}", self.choice.text())),
                TextPart::Value(value),
            ]);
        }
        self.flavor = flavor;
        ExprKind::Template(parts)
    }

    /// A pose, whose numbers have no names in either syntax.
    fn pose(&mut self, depth: usize) -> Call {
        let values = self.some(0, |it| it.term(depth)).into_iter();
        let args = values.map(|value| Arg { name: None, span: value.span, value }).collect();
        let name = motet_syntax::ast::Name { text: motet_syntax::ast::POSE.into(), span: self.span() };
        Call { name, args, span: self.span() }
    }

    fn fluent(&mut self, depth: usize) -> Call {
        self.call_with(TermPosition::FluentArg, depth.saturating_sub(1))
    }

    pub(super) fn call(&mut self, depth: usize) -> Call {
        self.call_with(TermPosition::Term, depth)
    }

    fn call_with(&mut self, place: TermPosition, depth: usize) -> Call {
        let name = self.choice.word();
        let count = self.choice.below(3);
        let args = (0..count).map(|index| self.arg(index, place, depth)).collect();
        Call { name, args, span: self.span() }
    }

    fn arg(&mut self, index: usize, place: TermPosition, depth: usize) -> Arg {
        const KEYS: &[&str] = &["object", "to the", "on"];
        let key = KEYS.get(index).map_or_else(SmolStr::default, SmolStr::new);
        let is_named = self.flavor == Flavor::Json || self.choice.is_heads();
        let name = is_named.then(|| motet_syntax::ast::Name { text: key, span: self.span() });
        Arg { name, value: self.term_in(place, depth), span: self.span() }
    }

    /// A time to wait: a literal.
    pub(super) fn time(&mut self) -> Expr {
        let time = self.duration();
        match &time.kind {
            ExprKind::Quantity(..) => time,
            _ => self.expr(ExprKind::Quantity(1.0, Unit::Second)),
        }
    }

    pub(super) fn duration(&mut self) -> Expr {
        let unit = self.choice.of(&[Unit::Second, Unit::Millisecond, Unit::Minute, Unit::Hour], Unit::Second);
        let value = f64::from(u8::try_from(self.choice.below(200)).unwrap_or(0)) / 4.0;
        let kind = match self.choice.below(3) {
            0 => ExprKind::Quantity(value, unit),
            1 => self.bound_or_else(|_| ExprKind::Quantity(value, unit)),
            _ => ExprKind::Quantity(value, Unit::Second),
        };
        self.expr(kind)
    }

    pub(super) fn count(&mut self) -> Expr {
        let value = f64::from(u8::try_from(self.choice.below(10)).unwrap_or(0));
        let kind = match self.choice.below(2) {
            0 => ExprKind::Number(value),
            _ => self.bound_or_else(|_| ExprKind::Number(value)),
        };
        self.expr(kind)
    }
}
