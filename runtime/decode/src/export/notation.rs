//! Notations of a grammar: GBNF of llama.cpp, Lark as llguidance reads it, and EBNF after ISO/IEC 14977. They
//! share the traversal ([`Notation`]) and differ in its leaves.

use super::ebnf::{EbnfExpr, EbnfGrammar, EbnfRule, RuleId};

/// First line of a Lark grammar, by which llguidance recognises its dialect.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Header {
    /// No header: the dialect of other readers of Lark.
    #[default]
    None,
    Llguidance,
}

/// GBNF, the notation of llama.cpp: `root ::=`, ranges written out, lower bounds written, no recursion.
pub(super) fn gbnf(grammar: &EbnfGrammar) -> String {
    let rule =
        |(index, rule)| format!("{} ::= {}\n", Gbnf(grammar).name(index, rule), body(&Gbnf(grammar), rule));
    grammar.rules.iter().enumerate().map(rule).collect()
}

/// EBNF after ISO/IEC 14977, with neither character classes nor regular expressions: a class is the choice
/// of its characters, a bounded repetition a number of times the thing and a number of times the thing or
/// nothing.
pub(super) fn iso_ebnf(grammar: &EbnfGrammar) -> String {
    let rule =
        |(index, rule)| format!("{} = {} ;\n", Iso(grammar).name(index, rule), body(&Iso(grammar), rule));
    grammar.rules.iter().enumerate().map(rule).collect()
}

/// Lark, as llguidance reads it: rules in lower case, terminals with a regular expression in upper case.
pub(super) fn lark(grammar: &EbnfGrammar, header: Header) -> String {
    let mut out = String::from(if header == Header::Llguidance { "%llguidance {}\n\n" } else { "" });
    for (index, rule) in grammar.rules.iter().enumerate() {
        let name = Lark(grammar).name(index, rule);
        out.push_str(&match rule.is_token {
            true => format!("{name}: /{}/\n", body(&Regex(grammar), rule)),
            false => format!("{name}: {}\n", body(&Lark(grammar), rule)),
        });
    }
    out
}

fn body(notation: &impl Notation, rule: &EbnfRule) -> String {
    let mut out = String::new();
    notation.expr(&mut out, &rule.body, Level::Choice);
    out
}

/// Binding strength that the context of an expression needs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Level {
    Choice,
    Seq,
    Item,
}

trait Notation {
    /// The mark between members of a sequence.
    const THEN: &'static str = " ";
    /// The mark between alternatives.
    const OR: &'static str = " | ";
    /// The marks around a group.
    const PARENTHESES: (&'static str, &'static str) = ("(", ")");

    fn grammar(&self) -> &EbnfGrammar;

    /// The name of the rule at a place.
    fn name(&self, index: usize, rule: &EbnfRule) -> String;

    fn literal(&self, out: &mut String, text: &str);

    fn class(&self, out: &mut String, ranges: &[(char, char)]);

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32);

    fn rule(&self, out: &mut String, id: RuleId) {
        out.extend(self.grammar().rule(id).map(|rule| self.name(id.0, rule)));
    }

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

    /// Writes an expression in a context that binds at least as tightly as `least`.
    fn expr(&self, out: &mut String, expr: &EbnfExpr, least: Level) {
        if self.level(expr) < least {
            out.push_str(Self::PARENTHESES.0);
            self.expr(out, expr, Level::Choice);
            return out.push_str(Self::PARENTHESES.1);
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
fn times(out: &mut String, least: u32, greatest: u32) {
    match (least, greatest) {
        (0, 1) => out.push('?'),
        (least, greatest) => out.push_str(&format!("{{{least},{greatest}}}")),
    }
}

/// Ranges of characters in brackets.
fn bracketed(out: &mut String, ranges: &[(char, char)], character: impl Fn(&mut String, char)) {
    out.push('[');
    for (from, to) in ranges {
        character(out, *from);
        if from != to {
            out.push('-');
            character(out, *to);
        }
    }
    out.push(']');
}

struct Gbnf<'g>(&'g EbnfGrammar);

impl Notation for Gbnf<'_> {
    fn grammar(&self) -> &EbnfGrammar {
        self.0
    }

    /// The words of a name are joined by a minus sign, the only mark that llama.cpp has in one.
    fn name(&self, _index: usize, rule: &EbnfRule) -> String {
        rule.name.replace('_', "-")
    }

    fn literal(&self, out: &mut String, text: &str) {
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

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        bracketed(out, ranges, |out, character| {
            if matches!(character, '[' | ']' | '\\') {
                out.push('\\');
            }
            out.push(character);
        });
    }

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32) {
        let is_repeat = matches!(inner, EbnfExpr::Repeat(..));
        out.push_str(if is_repeat { "(" } else { "" });
        self.expr(out, inner, Level::Item);
        out.push_str(if is_repeat { ")" } else { "" });
        times(out, least, greatest);
    }
}

struct Iso<'g>(&'g EbnfGrammar);

impl Notation for Iso<'_> {
    const THEN: &'static str = ", ";
    const PARENTHESES: (&'static str, &'static str) = ("( ", " )");

    fn grammar(&self) -> &EbnfGrammar {
        self.0
    }

    /// The words of a name are joined by spaces, as the standard has it.
    fn name(&self, _index: usize, rule: &EbnfRule) -> String {
        rule.name.replace('_', " ")
    }

    fn level(&self, expr: &EbnfExpr) -> Level {
        match expr {
            EbnfExpr::Choice(_) | EbnfExpr::Class(_) => Level::Choice,
            EbnfExpr::Seq(parts) if !parts.is_empty() => Level::Seq,
            EbnfExpr::Repeat(..) => Level::Seq,
            EbnfExpr::Literal(text) if text.contains('"') && text.contains('\'') => Level::Seq,
            EbnfExpr::Seq(_) | EbnfExpr::Literal(_) | EbnfExpr::Rule(_) => Level::Item,
        }
    }

    /// The standard has two quotes and no escape: a text with both becomes several literals.
    fn literal(&self, out: &mut String, text: &str) {
        let mut rest = text;
        while !rest.is_empty() {
            if rest.len() < text.len() {
                out.push_str(Self::THEN);
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

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        for (index, character) in ranges.iter().flat_map(|(from, to)| *from..=*to).enumerate() {
            if index > 0 {
                out.push_str(Self::OR);
            }
            self.literal(out, &character.to_string());
        }
    }

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32) {
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
}

struct Lark<'g>(&'g EbnfGrammar);

impl Notation for Lark<'_> {
    fn grammar(&self) -> &EbnfGrammar {
        self.0
    }

    fn name(&self, index: usize, rule: &EbnfRule) -> String {
        match (index, rule.is_token) {
            (0, _) => "start".to_owned(),
            (_, true) => rule.name.to_ascii_uppercase(),
            (_, false) => rule.name.clone(),
        }
    }

    fn literal(&self, out: &mut String, text: &str) {
        // A string of JSON is one of Lark.
        out.push_str(&serde_json::to_string(text).unwrap_or_default());
    }

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        out.push('/');
        Regex(self.0).class(out, ranges);
        out.push('/');
    }

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32) {
        out.push('(');
        self.expr(out, inner, Level::Choice);
        out.push(')');
        times(out, least, greatest);
    }
}

/// A terminal of Lark as a regular expression: it refers to no rule.
struct Regex<'g>(&'g EbnfGrammar);

impl Notation for Regex<'_> {
    const THEN: &'static str = "";
    const OR: &'static str = "|";
    const PARENTHESES: (&'static str, &'static str) = ("(?:", ")");

    fn grammar(&self) -> &EbnfGrammar {
        self.0
    }

    fn name(&self, _index: usize, _rule: &EbnfRule) -> String {
        String::new()
    }

    fn literal(&self, out: &mut String, text: &str) {
        text.chars().for_each(|character| escaped(out, character));
    }

    fn class(&self, out: &mut String, ranges: &[(char, char)]) {
        bracketed(out, ranges, escaped);
    }

    fn repeat(&self, out: &mut String, inner: &EbnfExpr, least: u32, greatest: u32) {
        out.push_str("(?:");
        self.expr(out, inner, Level::Choice);
        out.push(')');
        times(out, least, greatest);
    }

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
