//! GBNF, the notation of llama.cpp: `root ::=`, ranges written out, lower bounds written, no recursion.

use super::grammar::{Expr, Grammar, RuleId};
use super::notation::{Level, Notation, times};

/// The grammar, a rule a line.
pub(super) fn print(grammar: &Grammar) -> String {
    let mut out = String::new();
    for rule in &grammar.rules {
        out.push_str(&name(&rule.name));
        out.push_str(" ::= ");
        Gbnf(grammar).expr(&mut out, &rule.body, Level::Choice);
        out.push('\n');
    }
    out
}

struct Gbnf<'g>(&'g Grammar);

/// WordList of a rule's name are joined by a minus sign, the only mark that llama.cpp has in one.
fn name(name: &str) -> String {
    name.replace('_', "-")
}

impl Notation for Gbnf<'_> {
    const THEN: &'static str = " ";

    fn literal(&self, out: &mut String, text: &str) {
        literal(out, text);
    }

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        class(out, ranges);
    }

    fn repeat(&self, out: &mut String, inner: &Expr, least: u32, greatest: u32) {
        let is_repeat = matches!(inner, Expr::Repeat(..));
        if is_repeat {
            out.push('(');
        }
        self.expr(out, inner, Level::Item);
        if is_repeat {
            out.push(')');
        }
        times(out, least, greatest);
    }

    fn rule(&self, out: &mut String, id: RuleId) {
        out.push_str(&self.0.rule(id).map_or_else(String::new, |rule| name(&rule.name)));
    }
}

fn literal(out: &mut String, text: &str) {
    out.push('"');
    for character in text.chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            other => out.push(other),
        }
    }
    out.push('"');
}

fn class(out: &mut String, ranges: &[(char, char)]) {
    out.push('[');
    for (from, to) in ranges {
        class_char(out, *from);
        if from != to {
            out.push('-');
            class_char(out, *to);
        }
    }
    out.push(']');
}

fn class_char(out: &mut String, character: char) {
    if matches!(character, '[' | ']' | '\\') {
        out.push('\\');
    }
    out.push(character);
}
