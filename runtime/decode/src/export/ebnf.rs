//! EBNF after ISO/IEC 14977, with neither character classes nor regular expressions: a class is the choice of its characters,
//! a bounded repetition a number of times the thing and a number of times the thing or nothing.

use super::grammar::{Expr, Grammar, RuleId};
use super::notation::{Level, Notation};

/// The grammar, a rule a line.
pub(super) fn print(grammar: &Grammar) -> String {
    let mut out = String::new();
    for rule in &grammar.rules {
        out.push_str(&name(&rule.name));
        out.push_str(" = ");
        Ebnf(grammar).expr(&mut out, &rule.body, Level::Choice);
        out.push_str(" ;\n");
    }
    out
}

/// WordList of a rule's name are joined by spaces, as the standard has it.
fn name(name: &str) -> String {
    name.replace('_', " ")
}

struct Ebnf<'g>(&'g Grammar);

impl Notation for Ebnf<'_> {
    const THEN: &'static str = ", ";
    const PARENTHESES: (&'static str, &'static str) = ("( ", " )");

    fn level(&self, expr: &Expr) -> Level {
        match expr {
            Expr::Choice(_) | Expr::Class(_) => Level::Choice,
            Expr::Seq(parts) if !parts.is_empty() => Level::Seq,
            Expr::Repeat(..) => Level::Seq,
            Expr::Literal(text) if text.contains('"') && text.contains('\'') => Level::Seq,
            Expr::Seq(_) | Expr::Literal(_) | Expr::Rule(_) => Level::Item,
        }
    }

    fn literal(&self, out: &mut String, text: &str) {
        literal(out, text);
    }

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        for (index, character) in ranges.iter().flat_map(|(from, to)| *from..=*to).enumerate() {
            if index > 0 {
                out.push_str(Self::OR);
            }
            literal(out, &character.to_string());
        }
    }

    fn repeat(&self, out: &mut String, inner: &Expr, least: u32, greatest: u32) {
        if least > 0 {
            out.push_str(&format!("{least} * "));
            self.expr(out, inner, Level::Item);
        }
        if greatest > least {
            if least > 0 {
                out.push_str(", ");
            }
            if greatest - least > 1 {
                out.push_str(&format!("{} * ", greatest - least));
            }
            out.push_str("[ ");
            self.expr(out, inner, Level::Choice);
            out.push_str(" ]");
        }
    }

    fn rule(&self, out: &mut String, id: RuleId) {
        out.push_str(&self.0.rule(id).map_or_else(String::new, |rule| name(&rule.name)));
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
