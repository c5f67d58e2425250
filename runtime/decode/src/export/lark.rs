//! Lark, as llguidance reads it: rules in lower case, what is a word of its own as a terminal with a
//! regular expression.

use super::ebnf::{EbnfExpr, EbnfGrammar, EbnfRule, RuleId};
use super::notation::{Level, Notation, times};

/// First line of a Lark grammar, by which llguidance recognises its dialect.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Header {
    /// No header: what other readers of Lark take.
    #[default]
    None,
    Llguidance,
}

/// The grammar, a rule a line.
pub(super) fn print(grammar: &EbnfGrammar, header: Header) -> String {
    let mut out = String::new();
    if header == Header::Llguidance {
        out.push_str("%llguidance {}\n\n");
    }
    for (index, rule) in grammar.rules.iter().enumerate() {
        if rule.is_token {
            out.push_str(&name(rule, index));
            out.push_str(": /");
            Regex.expr(&mut out, &rule.body, Level::Choice);
            out.push_str("/\n");
        } else {
            out.push_str(&name(rule, index));
            out.push_str(": ");
            Lark(grammar).expr(&mut out, &rule.body, Level::Choice);
            out.push('\n');
        }
    }
    out
}

fn name(rule: &EbnfRule, index: usize) -> String {
    match (index, rule.is_token) {
        (0, _) => "start".to_owned(),
        (_, true) => rule.name.to_ascii_uppercase(),
        (_, false) => rule.name.clone(),
    }
}

struct Lark<'g>(&'g EbnfGrammar);

impl Notation for Lark<'_> {
    const THEN: &'static str = " ";

    fn literal(&self, out: &mut String, text: &str) {
        // A string of JSON is one of Lark.
        out.push_str(&serde_json::to_string(text).unwrap_or_default());
    }

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        out.push('/');
        Regex.class(out, ranges);
        out.push('/');
    }

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32) {
        out.push('(');
        self.expr(out, inner, Level::Choice);
        out.push(')');
        times(out, least, greatest);
    }

    fn rule(&self, out: &mut String, id: RuleId) {
        out.push_str(&self.0.rule(id).map_or_else(String::new, |rule| name(rule, id.0)));
    }
}

/// A token as a regular expression: it has no rules within.
struct Regex;

impl Notation for Regex {
    const THEN: &'static str = "";
    const OR: &'static str = "|";
    const PARENTHESES: (&'static str, &'static str) = ("(?:", ")");

    fn literal(&self, out: &mut String, text: &str) {
        text.chars().for_each(|character| escaped(out, character));
    }

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
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

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32) {
        out.push_str("(?:");
        self.expr(out, inner, Level::Choice);
        out.push(')');
        times(out, least, greatest);
    }

    fn rule(&self, _out: &mut String, _id: RuleId) {}

    fn nothing(&self, _out: &mut String) {}
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
