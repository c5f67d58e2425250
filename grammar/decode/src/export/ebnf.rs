//! EBNF after ISO/IEC 14977, with neither character classes nor regular expressions: a class is the choice of its characters,
//! a bounded repetition a number of times the thing and a number of times the thing or nothing.

use super::grammar::{Expr, Grammar};

/// The grammar, a rule a line.
pub(super) fn print(grammar: &Grammar) -> String {
    let mut out = String::new();
    for rule in &grammar.rules {
        out.push_str(&name(&rule.name));
        out.push_str(" = ");
        expr(&mut out, &rule.body, grammar, Level::Choice);
        out.push_str(" ;\n");
    }
    out
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Choice,
    Seq,
    Item,
}

/// Words of a rule's name are joined by spaces, as the standard has it.
fn name(name: &str) -> String {
    name.replace('_', " ")
}

fn expr(out: &mut String, expr: &Expr, grammar: &Grammar, level: Level) {
    let own = match expr {
        Expr::Choice(_) => Level::Choice,
        Expr::Class(_) => Level::Choice,
        Expr::Seq(parts) if !parts.is_empty() => Level::Seq,
        Expr::Repeat(..) => Level::Seq,
        Expr::Literal(text) if text.contains('"') && text.contains('\'') => Level::Seq,
        Expr::Seq(_) | Expr::Literal(_) | Expr::Rule(_) => Level::Item,
    };
    let in_parentheses = own < level;
    if in_parentheses {
        out.push_str("( ");
    }
    match expr {
        Expr::Literal(text) => literal(out, text),
        Expr::Class(ranges) => {
            let mut is_first = true;
            for character in ranges.iter().flat_map(|(from, to)| *from..=*to) {
                if !std::mem::take(&mut is_first) {
                    out.push_str(" | ");
                }
                literal(out, &character.to_string());
            }
        }
        Expr::Seq(parts) if parts.is_empty() => out.push_str("\"\""),
        Expr::Seq(parts) => joined(out, parts, ", ", grammar, Level::Item),
        Expr::Choice(parts) => joined(out, parts, " | ", grammar, Level::Seq),
        Expr::Repeat(inner, least, greatest) => {
            if *least > 0 {
                out.push_str(&format!("{least} * "));
                self::expr(out, inner, grammar, Level::Item);
            }
            if greatest > least {
                if *least > 0 {
                    out.push_str(", ");
                }
                if greatest - least > 1 {
                    out.push_str(&format!("{} * ", greatest - least));
                }
                out.push_str("[ ");
                self::expr(out, inner, grammar, Level::Choice);
                out.push_str(" ]");
            }
        }
        Expr::Rule(id) => out.push_str(&grammar.rule(*id).map_or_else(String::new, |rule| name(&rule.name))),
    }
    if in_parentheses {
        out.push_str(" )");
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

/// The standard has two quotes and no escape: where both stand in a text, it is several.
fn literal(out: &mut String, text: &str) {
    let mut rest = text;
    while !rest.is_empty() {
        if rest.len() < text.len() {
            out.push_str(", ");
        }
        let without = |quote: char| rest.find(quote).unwrap_or(rest.len());
        let (quote, end) =
            if without('"') >= without('\'') { ('"', without('"')) } else { ('\'', without('\'')) };
        let (part, behind) = rest.split_at_checked(end).unwrap_or((rest, ""));
        out.push(quote);
        out.push_str(part);
        out.push(quote);
        rest = behind;
    }
}
