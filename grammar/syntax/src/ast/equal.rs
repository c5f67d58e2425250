//! Equality of trees that ignores spans: what a round trip through the other form or the formatter keeps.

use smol_str::SmolStr;

use super::{
    Arg, ArithOp, Block, Call, Catch, CatchOn, Clause, CompareOp, Do, End, EndKind, EntitiesDecl, EnumDecl,
    Expr, ExprKind, FailureDecl, File, FluentDecl, InitiallyDecl, Item, KindDecl, MeasureDecl, Name, Param,
    Policy, PrimitiveDecl, PrimitiveForm, Quantified, Reaction, Step, StepKind, TypeExpr, When,
};
use crate::unit::Unit;

/// Whether two files say the same, wherever it stands. Numbers are the same if their bits are. O(nodes).
#[must_use]
pub fn same(a: &File, b: &File) -> bool {
    a.same(b)
}

/// Equality that ignores spans.
trait Same {
    fn same(&self, other: &Self) -> bool;
}

impl<T: Same> Same for Option<T> {
    fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Some(a), Some(b)) => a.same(b),
            (None, None) => true,
            (Some(_), None) | (None, Some(_)) => false,
        }
    }
}

impl<T: Same> Same for Vec<T> {
    fn same(&self, other: &Self) -> bool {
        self.len() == other.len() && self.iter().zip(other).all(|(a, b)| a.same(b))
    }
}

impl<T: Same> Same for Box<T> {
    fn same(&self, other: &Self) -> bool {
        (**self).same(&**other)
    }
}

impl<A: Same, B: Same> Same for (A, B) {
    fn same(&self, other: &Self) -> bool {
        self.0.same(&other.0) && self.1.same(&other.1)
    }
}

impl Same for f64 {
    fn same(&self, other: &Self) -> bool {
        self.to_bits() == other.to_bits()
    }
}

macro_rules! values {
    ($($name:ident)*) => {$(
        impl Same for $name {
            fn same(&self, other: &Self) -> bool {
                self == other
            }
        }
    )*};
}

macro_rules! structs {
    ($($name:ident { $($field:ident),* })*) => {$(
        impl Same for $name {
            fn same(&self, other: &Self) -> bool {
                true $(&& self.$field.same(&other.$field))*
            }
        }
    )*};
}

values!(bool SmolStr Unit CompareOp ArithOp EndKind PrimitiveForm);

structs! {
    File { items }
    Name { text }
    KindDecl { doc, name, parent, fields }
    FluentDecl { doc, name, params }
    MeasureDecl { doc, name, params, result }
    FailureDecl { doc, name }
    EnumDecl { doc, name, cases }
    EntitiesDecl { doc, names, kind }
    InitiallyDecl { facts }
    Param { name, ty, default }
    PrimitiveDecl { doc, form, name, params, result, clauses }
    Quantified { expr, each, when }
    Policy { doc, name, params, robot, achieves, body }
    Block { steps }
    Step { kind }
    Do { call, bind, within, retry }
    Call { name, args }
    Arg { name, value }
    When { condition, hold, reaction }
    Catch { on, body }
    End { kind, why }
    Expr { kind }
}

/// Variants with the same parts are compared part by part; different variants are different.
macro_rules! enums {
    ($($name:ident { $($pattern:pat, $other:pat => $same:expr;)* })*) => {$(
        impl Same for $name {
            fn same(&self, other: &Self) -> bool {
                std::mem::discriminant(self) == std::mem::discriminant(other) && match (self, other) {
                    $(($pattern, $other) => $same,)*
                    // Different variants, which the discriminants have told apart already.
                    (_, _) => false,
                }
            }
        }
    )*};
}

enums! {
    Item {
        Self::Kind(a), Self::Kind(b) => a.same(b);
        Self::Fluent(a), Self::Fluent(b) => a.same(b);
        Self::Measure(a), Self::Measure(b) => a.same(b);
        Self::Failure(a), Self::Failure(b) => a.same(b);
        Self::Enum(a), Self::Enum(b) => a.same(b);
        Self::Primitive(a), Self::Primitive(b) => a.same(b);
        Self::Policy(a), Self::Policy(b) => a.same(b);
        Self::Entities(a), Self::Entities(b) => a.same(b);
        Self::Initially(a), Self::Initially(b) => a.same(b);
        Self::ClosedWorld(_), Self::ClosedWorld(_) => true;
    }
    TypeExpr {
        Self::Named(a), Self::Named(b) => a.same(b);
        Self::List(a, _), Self::List(b, _) => a.same(b);
    }
    Clause {
        Self::Needs(a), Self::Needs(b) => a.same(b);
        Self::Makes(a), Self::Makes(b) => a.same(b);
        Self::Unsettles(a), Self::Unsettles(b) => a.same(b);
        Self::Motion(a), Self::Motion(b) => a.same(b);
        Self::Uses(a), Self::Uses(b) => a.same(b);
        Self::Takes { least: a, greatest: c }, Self::Takes { least: b, greatest: d } => a.same(b) && c.same(d);
        Self::Fails(a), Self::Fails(b) => a.same(b);
        Self::Lasts(a), Self::Lasts(b) => a.same(b);
    }
    StepKind {
        Self::Do(a), Self::Do(b) => a.same(b);
        Self::Sequence { name: a, body: c }, Self::Sequence { name: b, body: d } => a.same(b) && c.same(d);
        Self::If { condition: a, then: c, otherwise: e }, Self::If { condition: b, then: d, otherwise: f } =>
            a.same(b) && c.same(d) && e.same(f);
        Self::Wait { condition: a, within: c }, Self::Wait { condition: b, within: d } => a.same(b) && c.same(d);
        Self::Monitor { whens: a, body: c }, Self::Monitor { whens: b, body: d } => a.same(b) && c.same(d);
        Self::Try { body: a, catches: c }, Self::Try { body: b, catches: d } => a.same(b) && c.same(d);
        Self::Repeat { times: a, body: c, until: e }, Self::Repeat { times: b, body: d, until: f } =>
            a.same(b) && c.same(d) && e.same(f);
        Self::Each { item: a, list: c, at_most: e, body: g }, Self::Each { item: b, list: d, at_most: f, body: h } =>
            a.same(b) && c.same(d) && e.same(f) && g.same(h);
        Self::Parallel { branches: a }, Self::Parallel { branches: b } => a.same(b);
        Self::End(a), Self::End(b) => a.same(b);
    }
    Reaction {
        Self::Pause { within: a, .. }, Self::Pause { within: b, .. } => a.same(b);
        Self::Restart { at_most: a, .. }, Self::Restart { at_most: b, .. } => a.same(b);
        Self::Resume { at_most: a, body: c, .. }, Self::Resume { at_most: b, body: d, .. } => a.same(b) && c.same(d);
        Self::End(a), Self::End(b) => a.same(b);
    }
    CatchOn {
        Self::Any(_), Self::Any(_) => true;
        Self::Kinds(a), Self::Kinds(b) => a.same(b);
    }
    ExprKind {
        Self::Bool(a), Self::Bool(b) => a.same(b);
        Self::Number(a), Self::Number(b) => a.same(b);
        Self::Quantity(a, c), Self::Quantity(b, d) => a.same(b) && c.same(d);
        Self::Text(a), Self::Text(b) => a.same(b);
        Self::Name(a), Self::Name(b) => a.same(b);
        Self::Binding(a), Self::Binding(b) => a.same(b);
        Self::Plain(a), Self::Plain(b) => a.same(b);
        Self::Wrong(a), Self::Wrong(b) => a.same(b);
        Self::Any, Self::Any => true;
        Self::List(a), Self::List(b) => a.same(b);
        Self::Call(a), Self::Call(b) => a.same(b);
        Self::Field(a, c), Self::Field(b, d) => a.same(b) && c.same(d);
        Self::Not(a), Self::Not(b) => a.same(b);
        Self::All(a), Self::All(b) => a.same(b);
        Self::AnyOf(a), Self::AnyOf(b) => a.same(b);
        Self::Compare(a, c, e), Self::Compare(b, d, f) => a.same(b) && c.same(d) && e.same(f);
        Self::Arith(a, c, e), Self::Arith(b, d, f) => a.same(b) && c.same(d) && e.same(f);
    }
}
