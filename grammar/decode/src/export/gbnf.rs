//! GBNF, the notation of llama.cpp: `root ::=`, ranges written out, lower bounds written, no recursion.

use super::grammar::{Expr, Grammar};

/// The grammar, a rule a line.
pub(super) fn print(grammar: &Grammar) -> String {
    let mut out = String::new();
    for rule in &grammar.rules {
        out.push_str(&name(&rule.name));
        out.push_str(" ::= ");
        expr(&mut out, &rule.body, grammar, Level::Choice);
        out.push('\n');
    }
    out
}

/// How tightly an expression has to hold together where it stands.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Choice,
    Seq,
    Item,
}

/// Words of a rule's name are joined by a minus sign, the only mark that llama.cpp has in one.
fn name(name: &str) -> String {
    name.replace('_', "-")
}

fn expr(out: &mut String, expr: &Expr, grammar: &Grammar, level: Level) {
    let own = match expr {
        Expr::Choice(_) => Level::Choice,
        Expr::Seq(parts) if !parts.is_empty() => Level::Seq,
        Expr::Seq(_) | Expr::Literal(_) | Expr::Class(_) | Expr::Repeat(..) | Expr::Rule(_) => Level::Item,
    };
    let in_parentheses = own < level;
    if in_parentheses {
        out.push('(');
    }
    match expr {
        Expr::Literal(text) => literal(out, text),
        Expr::Class(ranges) => class(out, ranges),
        Expr::Seq(parts) if parts.is_empty() => out.push_str("\"\""),
        Expr::Seq(parts) => joined(out, parts, " ", grammar, Level::Item),
        Expr::Choice(parts) => joined(out, parts, " | ", grammar, Level::Seq),
        Expr::Repeat(inner, least, greatest) => {
            let is_repeat = matches!(**inner, Expr::Repeat(..));
            if is_repeat {
                out.push('(');
            }
            self::expr(out, inner, grammar, Level::Item);
            if is_repeat {
                out.push(')');
            }
            match (least, greatest) {
                (0, 1) => out.push('?'),
                (least, greatest) => out.push_str(&format!("{{{least},{greatest}}}")),
            }
        }
        Expr::Rule(id) => out.push_str(&grammar.rule(*id).map_or_else(String::new, |rule| name(&rule.name))),
    }
    if in_parentheses {
        out.push(')');
    }
}

fn joined(out: &mut String, parts: &[Expr], with: &str, grammar: &Grammar, level: Level) {
    for (index, part) in parts.iter().enumerate() {
        if index > 0 {
            out.push_str(with);
        }
        expr(out, part, grammar, level);
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
