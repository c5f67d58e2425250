//! Small readers of GBNF, Lark and ISO EBNF: the parts of them that are exported.

use std::collections::HashMap;

use motet_decode::export::{EbnfExpr as Expr, EbnfGrammar as Grammar, EbnfRule as Rule, RuleId};

/// A notation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Notation {
    /// `root ::= "a" [b-c]{0,3}`
    Gbnf,
    /// `start: "a" NAME`
    Lark,
    /// `root = "a", 3 * [ b ] ;`
    Ebnf,
}

/// Reads a grammar. Panics where it cannot: a test made it.
#[must_use]
#[expect(clippy::panic, reason = "a test whose grammar cannot be read cannot go on")]
pub fn read(text: &str, notation: Notation) -> Grammar {
    let sign = match notation {
        Notation::Gbnf => " ::= ",
        Notation::Lark => ": ",
        Notation::Ebnf => " = ",
    };
    let lines: Vec<(&str, &str)> = text
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('%'))
        .map(|line| line.split_once(sign).unwrap_or_else(|| panic!("no rule: {line}")))
        .collect();
    let names: HashMap<&str, usize> = lines.iter().enumerate().map(|(at, (name, _))| (*name, at)).collect();
    assert_eq!(names.len(), lines.len(), "two rules have one name");
    let rules = lines.iter().map(|(name, body)| {
        let mut reader = Reader { rest: body, notation, names: &names };
        let body = reader.choice();
        reader.skip();
        let rest = reader.rest.trim_start_matches(';');
        assert!(rest.is_empty(), "`{name}` goes on with {rest:.80}");
        Rule { name: (*name).to_owned(), body, is_token: false }
    });
    Grammar { rules: rules.collect() }
}

struct Reader<'t> {
    rest: &'t str,
    notation: Notation,
    names: &'t HashMap<&'t str, usize>,
}

impl Reader<'_> {
    fn skip(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn take(&mut self, mark: &str) -> bool {
        match self.rest.strip_prefix(mark) {
            Some(rest) => {
                self.rest = rest;
                true
            }
            None => false,
        }
    }

    fn expect(&mut self, mark: &str) {
        assert!(self.take(mark), "`{mark}` is missing before {:.60}", self.rest);
    }

    #[expect(clippy::panic, reason = "a test whose grammar cannot be read cannot go on")]
    fn character(&mut self) -> char {
        let Some(first) = self.rest.chars().next() else { panic!("the grammar ends too early") };
        self.rest = self.rest.get(first.len_utf8()..).unwrap_or("");
        first
    }

    fn choice(&mut self) -> Expr {
        let mut parts = vec![self.seq()];
        loop {
            self.skip();
            if !self.take("|") {
                return Expr::choice(parts);
            }
            parts.push(self.seq());
        }
    }

    fn seq(&mut self) -> Expr {
        let mut parts = Vec::new();
        loop {
            self.skip();
            self.take(",");
            self.skip();
            if self.rest.is_empty()
                || self.rest.starts_with(['|', ')', ';'])
                || (self.notation == Notation::Ebnf && self.rest.starts_with(']'))
            {
                return Expr::Seq(parts);
            }
            let item = self.item();
            parts.push(self.repeated(item));
        }
    }

    fn repeated(&mut self, item: Expr) -> Expr {
        if self.notation == Notation::Ebnf {
            return item;
        }
        if self.take("?") {
            return Expr::Repeat(Box::new(item), 0, 1);
        }
        if !self.take("{") {
            return item;
        }
        let least = self.whole();
        self.expect(",");
        let greatest = self.whole();
        self.expect("}");
        Expr::Repeat(Box::new(item), least, greatest)
    }

    fn whole(&mut self) -> u32 {
        let digits = self.rest.len() - self.rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (number, rest) = self.rest.split_at(digits);
        self.rest = rest;
        number.parse().unwrap_or(0)
    }

    fn item(&mut self) -> Expr {
        if self.take("(") {
            let inner = self.choice();
            self.skip();
            self.expect(")");
            return inner;
        }
        if self.notation == Notation::Ebnf {
            return self.ebnf_item();
        }
        if self.take("\"") {
            return self.escaped_literal();
        }
        if self.notation == Notation::Gbnf && self.take("[") {
            return self.class();
        }
        if self.notation == Notation::Lark && self.take("/") {
            let mut regex = Regex { reader: self };
            return regex.choice();
        }
        self.reference(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
    }

    fn ebnf_item(&mut self) -> Expr {
        for quote in ['"', '\''] {
            if self.rest.starts_with(quote) {
                self.character();
                let end = self.rest.find(quote).unwrap_or(0);
                let (text, _) = self.rest.split_at(end);
                let text = text.to_owned();
                self.rest = self.rest.get(end + 1..).unwrap_or("");
                return Expr::Literal(text);
            }
        }
        if self.take("[") {
            let inner = self.choice();
            self.skip();
            self.expect("]");
            return Expr::Repeat(Box::new(inner), 0, 1);
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            let times = self.whole();
            self.expect(" * ");
            return Expr::Repeat(Box::new(self.item()), times, times);
        }
        self.reference(|c| c.is_ascii_alphanumeric() || c == ' ')
    }

    #[expect(clippy::panic, reason = "a test whose grammar cannot be read cannot go on")]
    fn reference(&mut self, is_part: impl Fn(char) -> bool) -> Expr {
        let end = self.rest.find(|c: char| !is_part(c)).unwrap_or(self.rest.len());
        let (name, rest) = self.rest.split_at(end);
        self.rest = rest;
        let name = name.trim();
        let Some(rule) = self.names.get(name) else { panic!("there is no rule `{name}` before {rest:.40}") };
        Expr::Rule(RuleId(*rule))
    }

    fn escaped_literal(&mut self) -> Expr {
        let mut text = String::new();
        loop {
            match self.character() {
                '"' => return Expr::Literal(text),
                '\\' => text.push(self.character()),
                other => text.push(other),
            }
        }
    }

    /// A class behind its bracket.
    fn class(&mut self) -> Expr {
        let mut ranges = Vec::new();
        loop {
            let from = match self.character() {
                ']' => return Expr::Class(ranges),
                '\\' => self.character(),
                other => other,
            };
            let to = if self.take("-") {
                match self.character() {
                    '\\' => self.character(),
                    other => other,
                }
            } else {
                from
            };
            ranges.push((from, to));
        }
    }
}

/// A regular expression behind its first slash.
struct Regex<'r, 't> {
    reader: &'r mut Reader<'t>,
}

impl Regex<'_, '_> {
    fn choice(&mut self) -> Expr {
        let mut alternatives = Vec::new();
        let mut parts = Vec::new();
        loop {
            let item = match self.reader.character() {
                '/' | ')' => {
                    alternatives.push(Expr::Seq(parts));
                    return Expr::choice(alternatives);
                }
                '|' => {
                    alternatives.push(Expr::Seq(std::mem::take(&mut parts)));
                    continue;
                }
                '(' => {
                    self.reader.expect("?:");
                    self.choice()
                }
                '[' => self.reader.class(),
                '\\' => Expr::Literal(self.reader.character().to_string()),
                other => Expr::Literal(other.to_string()),
            };
            parts.push(self.reader.repeated(item));
        }
    }
}
