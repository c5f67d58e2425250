//! Conditions and terms in the text syntax, with as few parentheses as the grammar needs, and those that help
//! a reader.

use std::borrow::Cow;

use smol_str::SmolStr;

use crate::ast::{ArithOp, Call, Expr, ExprKind, Name, TextPart};
use crate::render::is_steering;
use crate::unit::Unit;
use crate::unit::parse_quantity;
use crate::words::spelled;

/// Precedence of an expression, in the order of the grammar.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Precedence {
    Or,
    And,
    Not,
    Compare,
    Sum,
    Product,
    Atom,
}

/// Appends an expression.
pub(super) fn write(text: &mut String, expr: &Expr) {
    at(text, expr, Precedence::Or);
}

fn level(expr: &Expr) -> Precedence {
    match &expr.kind {
        ExprKind::AnyOf(members) if members.len() > 1 => Precedence::Or,
        ExprKind::All(members) if members.len() > 1 => Precedence::And,
        // A group of one is written as its member, an empty one as what it means.
        ExprKind::AnyOf(members) | ExprKind::All(members) => members.first().map_or(Precedence::Atom, level),
        ExprKind::Not(_) => Precedence::Not,
        ExprKind::Compare(..) => Precedence::Compare,
        ExprKind::Arith(ArithOp::Add | ArithOp::Subtract, ..) => Precedence::Sum,
        ExprKind::Arith(ArithOp::Multiply | ArithOp::Divide, ..) => Precedence::Product,
        _ => Precedence::Atom,
    }
}

/// Appends an expression, in parentheses unless it holds together at least as tightly as `least`.
fn at(text: &mut String, expr: &Expr, least: Precedence) {
    let in_parentheses = level(expr) < least;
    if in_parentheses {
        text.push('(');
    }
    bare(text, expr);
    if in_parentheses {
        text.push(')');
    }
}

fn bare(text: &mut String, expr: &Expr) {
    match &expr.kind {
        ExprKind::Bool(value) => text.push_str(if *value { "true" } else { "false" }),
        ExprKind::Number(value) => number(text, *value),
        ExprKind::Quantity(value, unit) => measure(text, *value, *unit),
        ExprKind::Text(value) => literal(text, &braces(value)),
        ExprKind::Template(parts) => literal(text, &template(parts)),
        ExprKind::Name(value) | ExprKind::Binding(value) => name(text, value),
        ExprKind::Plain(value) | ExprKind::Wrong(value) => plain(text, value),
        ExprKind::Any => text.push_str("any"),
        ExprKind::List(members) => {
            text.push('[');
            joined(text, members, ", ", Precedence::Or);
            text.push(']');
        }
        ExprKind::Call(value) => call(text, value),
        ExprKind::Field(inner, field) => {
            let is_number = match &inner.kind {
                ExprKind::Number(_) | ExprKind::Quantity(..) => true,
                ExprKind::Plain(value) => parse_quantity(value).is_some(),
                _ => false,
            };
            if is_number {
                text.push('(');
            }
            at(text, inner, Precedence::Atom);
            if is_number {
                text.push(')');
            }
            text.push('.');
            name(text, &field.text);
        }
        ExprKind::Not(inner) => {
            text.push_str("not ");
            // `not a < b` means the same as `not (a < b)`, but not to everyone.
            let least = if level(inner) == Precedence::Not { Precedence::Not } else { Precedence::Atom };
            at(text, inner, least);
        }
        ExprKind::All(members) if members.is_empty() => text.push_str("true"),
        ExprKind::AnyOf(members) if members.is_empty() => text.push_str("false"),
        ExprKind::All(members) if members.len() > 1 => joined(text, members, " and ", Precedence::Not),
        ExprKind::AnyOf(members) if members.len() > 1 => joined(text, members, " or ", Precedence::And),
        ExprKind::All(members) | ExprKind::AnyOf(members) => joined(text, members, "", Precedence::Or),
        ExprKind::Compare(op, left, right) => {
            at(text, left, Precedence::Sum);
            spaced(text, op.symbol());
            at(text, right, Precedence::Sum);
        }
        ExprKind::Arith(op, left, right) => {
            let (left_least, right_least) = match op {
                ArithOp::Add | ArithOp::Subtract => (Precedence::Sum, Precedence::Product),
                ArithOp::Multiply | ArithOp::Divide => (Precedence::Product, Precedence::Atom),
            };
            at(text, left, left_least);
            spaced(text, op.symbol());
            at(text, right, right_least);
        }
    }
}

fn joined(text: &mut String, members: &[Expr], separator: &str, least: Precedence) {
    for (index, member) in members.iter().enumerate() {
        if index > 0 {
            text.push_str(separator);
        }
        at(text, member, least);
    }
}

fn spaced(text: &mut String, symbol: &str) {
    text.push(' ');
    text.push_str(symbol);
    text.push(' ');
}

/// Appends a call: `pick(mug, from: top)`.
pub(super) fn call(text: &mut String, call: &Call) {
    name(text, &call.name.text);
    text.push('(');
    for (index, arg) in call.args.iter().enumerate() {
        if index > 0 {
            text.push_str(", ");
        }
        if let Some(key) = &arg.name {
            name(text, &key.text);
            text.push_str(": ");
        }
        write(text, &arg.value);
    }
    text.push(')');
}

/// Appends a name, in back-quotes where it needs them.
pub(super) fn name(text: &mut String, value: &str) {
    text.push_str(&spelled(value));
}

/// Appends names with commas.
pub(super) fn names(text: &mut String, values: &[Name]) {
    for (index, value) in values.iter().enumerate() {
        if index > 0 {
            text.push_str(", ");
        }
        name(text, &value.text);
    }
}

/// A string of JSON whose meaning no one has settled: a quantity or an id if it looks like one, a text
/// otherwise.
fn plain(text: &mut String, value: &SmolStr) {
    let is_id = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    if let Some((number, unit)) = parse_quantity(value) {
        measure(text, number, unit);
    } else if !value.is_empty() && value.chars().all(is_id) {
        name(text, value);
    } else {
        literal(text, &braces(value));
    }
}

/// A text as it is written, before quotes and escapes: with each brace twice.
pub(super) fn braces(text: &str) -> Cow<'_, str> {
    if text.contains(['{', '}']) {
        Cow::Owned(text.replace('{', "{{").replace('}', "}}"))
    } else {
        Cow::Borrowed(text)
    }
}

/// A text with values as it is written, before quotes and escapes.
pub(super) fn template(parts: &[TextPart]) -> String {
    let mut text = String::new();
    for part in parts {
        match part {
            TextPart::Literal(literal) => text.push_str(&braces(literal)),
            TextPart::Value(value) => {
                text.push('{');
                write(&mut text, value);
                text.push('}');
            }
        }
    }
    text
}

fn measure(text: &mut String, value: f64, unit: Unit) {
    number(text, value);
    text.push(' ');
    text.push_str(unit.symbol());
}

/// The shortest digits that read back as the same number.
fn number(text: &mut String, value: f64) {
    let size = value.abs();
    let is_plain = size == 0.0 || (1e-5..1e16).contains(&size);
    text.push_str(&if is_plain { format!("{value}") } else { format!("{value:e}") });
}

/// Appends a text in quotes.
fn literal(text: &mut String, value: &str) {
    text.push('"');
    for character in value.chars() {
        match character {
            '"' => text.push_str("\\\""),
            '\\' => text.push_str("\\\\"),
            '\n' => text.push_str("\\n"),
            '\t' => text.push_str("\\t"),
            '\r' => text.push_str("\\r"),
            steering if is_steering(steering) => text.extend(steering.escape_unicode()),
            other => text.push(other),
        }
    }
    text.push('"');
}
