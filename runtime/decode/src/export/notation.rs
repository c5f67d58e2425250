//! Notation of a grammar: the traversal that all notations share, and the parts that differ.

use super::ebnf::{EbnfExpr, RuleId};

/// Binding strength that the context of an expression needs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Level {
    Choice,
    Seq,
    Item,
}

pub(super) trait Notation {
    /// Between what stands one after the other.
    const THEN: &'static str;
    /// Between what stands one instead of the other.
    const OR: &'static str = " | ";
    /// Around what has to hold together.
    const PARENTHESES: (&'static str, &'static str) = ("(", ")");

    fn literal(&self, out: &mut String, text: &str);

    fn class(&self, out: &mut String, ranges: &[(char, char)]);

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32);

    fn rule(&self, out: &mut String, id: RuleId);

    fn nothing(&self, out: &mut String) {
        out.push_str("\"\"");
    }

    /// Binding strength of an expression.
    fn level(&self, expr: &EbnfExpr) -> Level {
        match expr {
            EbnfExpr::Choice(_) => Level::Choice,
            EbnfExpr::Seq(parts) if !parts.is_empty() => Level::Seq,
            EbnfExpr::Seq(_)
            | EbnfExpr::Literal(_)
            | EbnfExpr::Class(_)
            | EbnfExpr::Repeat(..)
            | EbnfExpr::Rule(_) => Level::Item,
        }
    }

    /// Writes an expression where it has to hold together as tightly as this.
    fn expr(&self, out: &mut String, expr: &EbnfExpr, least: Level) {
        let in_parentheses = self.level(expr) < least;
        if in_parentheses {
            out.push_str(Self::PARENTHESES.0);
        }
        match expr {
            EbnfExpr::Literal(text) => self.literal(out, text),
            EbnfExpr::Class(ranges) => self.class(out, ranges),
            EbnfExpr::Seq(parts) if parts.is_empty() => self.nothing(out),
            EbnfExpr::Seq(parts) => self.joined(out, parts, Self::THEN, Level::Item),
            EbnfExpr::Choice(parts) => self.joined(out, parts, Self::OR, Level::Seq),
            EbnfExpr::Repeat(inner, least, greatest) => self.repeat(out, inner, *least, *greatest),
            EbnfExpr::Rule(id) => self.rule(out, *id),
        }
        if in_parentheses {
            out.push_str(Self::PARENTHESES.1);
        }
    }

    fn joined(&self, out: &mut String, parts: &[EbnfExpr], with: &str, level: Level) {
        for (index, part) in parts.iter().enumerate() {
            if index > 0 {
                out.push_str(with);
            }
            self.expr(out, part, level);
        }
    }
}

/// Repetition as GBNF, Lark and regular expressions write it.
pub(super) fn times(out: &mut String, least: u32, greatest: u32) {
    match (least, greatest) {
        (0, 1) => out.push('?'),
        (least, greatest) => out.push_str(&format!("{{{least},{greatest}}}")),
    }
}
