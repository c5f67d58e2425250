//! Lark, as llguidance reads it: rules in lower case, what is a word of its own as a terminal with a regular expression.

use super::grammar::{Expr, Grammar, Rule};

/// Whether the line stands at the top by which llguidance knows its dialect.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Header {
    /// No header: what other readers of Lark take.
    #[default]
    None,
    /// `%llguidance {}`
    Llguidance,
}

/// The grammar, a rule a line.
pub(super) fn print(grammar: &Grammar, header: Header) -> String {
    let mut out = String::new();
    if header == Header::Llguidance {
        out.push_str("%llguidance {}\n\n");
    }
    for (index, rule) in grammar.rules.iter().enumerate() {
        if rule.is_token {
            out.push_str(&name(rule, index));
            out.push_str(": /");
            regex(&mut out, &rule.body, Level::Choice);
            out.push_str("/\n");
        } else {
            out.push_str(&name(rule, index));
            out.push_str(": ");
            expr(&mut out, &rule.body, grammar, Level::Choice);
            out.push('\n');
        }
    }
    out
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Choice,
    Seq,
    Item,
}

fn level(expr: &Expr) -> Level {
    match expr {
        Expr::Choice(_) => Level::Choice,
        Expr::Seq(parts) if !parts.is_empty() => Level::Seq,
        Expr::Seq(_) | Expr::Literal(_) | Expr::Class(_) | Expr::Repeat(..) | Expr::Rule(_) => Level::Item,
    }
}

fn name(rule: &Rule, index: usize) -> String {
    match (index, rule.is_token) {
        (0, _) => "start".to_owned(),
        (_, true) => rule.name.to_ascii_uppercase(),
        (_, false) => rule.name.clone(),
    }
}

fn expr(out: &mut String, expr: &Expr, grammar: &Grammar, least: Level) {
    let in_parentheses = level(expr) < least;
    if in_parentheses {
        out.push('(');
    }
    match expr {
        Expr::Literal(text) => literal(out, text),
        Expr::Class(_) => {
            out.push('/');
            regex(out, expr, Level::Choice);
            out.push('/');
        }
        Expr::Seq(parts) if parts.is_empty() => out.push_str("\"\""),
        Expr::Seq(parts) => joined(out, parts, " ", grammar, Level::Item),
        Expr::Choice(parts) => joined(out, parts, " | ", grammar, Level::Seq),
        Expr::Repeat(inner, least, greatest) => {
            out.push('(');
            self::expr(out, inner, grammar, Level::Choice);
            out.push(')');
            match (least, greatest) {
                (0, 1) => out.push('?'),
                (least, greatest) => out.push_str(&format!("{{{least},{greatest}}}")),
            }
        }
        Expr::Rule(id) => {
            out.push_str(&grammar.rule(*id).map_or_else(String::new, |rule| name(rule, id.0)));
        }
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
    // A string of JSON is one of Lark.
    out.push_str(&serde_json::to_string(text).unwrap_or_default());
}

/// A token as a regular expression: it has no rules within.
fn regex(out: &mut String, expr: &Expr, least: Level) {
    let in_parentheses = level(expr) < least;
    if in_parentheses {
        out.push_str("(?:");
    }
    match expr {
        Expr::Literal(text) => text.chars().for_each(|character| escaped(out, character)),
        Expr::Class(ranges) => {
            out.push('[');
            for (from, to) in ranges {
                escaped(out, *from);
                if from != to {
                    out.push('-');
                    escaped(out, *to);
                }
            }
            out.push(']');
        }
        Expr::Seq(parts) => parts.iter().for_each(|part| regex(out, part, Level::Item)),
        Expr::Choice(parts) => {
            for (index, part) in parts.iter().enumerate() {
                if index > 0 {
                    out.push('|');
                }
                regex(out, part, Level::Seq);
            }
        }
        Expr::Repeat(inner, least, greatest) => {
            out.push_str("(?:");
            regex(out, inner, Level::Choice);
            out.push(')');
            match (least, greatest) {
                (0, 1) => out.push('?'),
                (least, greatest) => out.push_str(&format!("{{{least},{greatest}}}")),
            }
        }
        // A token has none.
        Expr::Rule(_) => {}
    }
    if in_parentheses {
        out.push(')');
    }
}

fn escaped(out: &mut String, character: char) {
    if !character.is_ascii_alphanumeric()
        && character.is_ascii_graphic()
        && !matches!(character, '_' | '"' | '!' | '#' | '%' | '~' | ',' | ':')
    {
        out.push('\\');
    }
    out.push(character);
}
