//! A context-free grammar without recursion: literals, classes of characters, sequences, choices, bounded
//! repetition, and rules. The first rule is the root. What the notations print.

/// The place of a rule in its grammar.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct RuleId(pub usize);

/// Expression of an EBNF grammar.
#[derive(Clone, PartialEq, Debug)]
pub enum EbnfExpr {
    Literal(String),
    /// One character of these ranges, both ends included, all of them ASCII.
    Class(Vec<(char, char)>),
    /// One after the other; nothing where there is none.
    Seq(Vec<EbnfExpr>),
    /// One of several.
    Choice(Vec<EbnfExpr>),
    /// As often as from the first to the second number.
    Repeat(Box<EbnfExpr>, u32, u32),
    /// Reference to a rule.
    Rule(RuleId),
}

/// One rule of an EBNF grammar.
#[derive(Clone, PartialEq, Debug)]
pub struct EbnfRule {
    /// Its name: lower-case letters, digits and `_`; no two are alike.
    pub name: String,
    pub body: EbnfExpr,
    /// Marks a terminal: a rule that refers to no other rule.
    pub is_token: bool,
}

/// Rules, of which each names only those behind it or none that leads back: nothing recurses.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct EbnfGrammar {
    /// The rules, the root first.
    pub rules: Vec<EbnfRule>,
}

impl EbnfExpr {
    /// Expression that matches one literal text.
    #[must_use]
    pub fn literal(text: impl Into<String>) -> Self {
        Self::Literal(text.into())
    }

    /// The thing, or nothing.
    #[must_use]
    pub fn optional(self) -> Self {
        self.repeat(0, 1)
    }

    /// The thing so many times.
    #[must_use]
    pub fn repeat(self, least: u32, greatest: u32) -> Self {
        match (least, greatest) {
            (1, 1) => self,
            // Some notations have no repetition that is none.
            (_, 0) => Self::Seq(Vec::new()),
            _ => Self::Repeat(Box::new(self), least, greatest),
        }
    }

    /// One of several, which is the thing itself where there is only one.
    #[must_use]
    pub fn choice(mut of: Vec<Self>) -> Self {
        match (of.len(), of.pop()) {
            (1, Some(only)) => only,
            (_, None) => Self::Choice(of),
            (_, Some(last)) => {
                of.push(last);
                Self::Choice(of)
            }
        }
    }

    /// One after the other; neighbouring literals become one.
    #[must_use]
    pub fn seq(of: Vec<Self>) -> Self {
        let mut parts: Vec<Self> = Vec::with_capacity(of.len());
        for part in of {
            match (parts.last_mut(), part) {
                (Some(Self::Literal(before)), Self::Literal(text)) => before.push_str(&text),
                (_, Self::Seq(inner)) if inner.is_empty() => {}
                (_, part) => parts.push(part),
            }
        }
        match (parts.len(), parts.pop()) {
            (1, Some(only)) => only,
            (_, None) => Self::Seq(parts),
            (_, Some(last)) => {
                parts.push(last);
                Self::Seq(parts)
            }
        }
    }
}

impl EbnfGrammar {
    /// Adds a rule whose name is made of any text, and made unique.
    pub(crate) fn add(&mut self, name: &str, body: EbnfExpr, is_token: bool) -> RuleId {
        let mut clean: String = name
            .chars()
            .map(
                |character| {
                    if character.is_ascii_alphanumeric() { character.to_ascii_lowercase() } else { '_' }
                },
            )
            .collect();
        // A leading digit or underscore, and a double one, mean something in some notation.
        while clean.contains("__") {
            clean = clean.replace("__", "_");
        }
        let clean = clean.trim_matches('_');
        let clean = if clean.starts_with(|first: char| first.is_ascii_alphabetic()) {
            clean.to_owned()
        } else {
            format!("x{clean}")
        };
        let is_taken = |name: &str| self.rules.iter().any(|rule| rule.name == name);
        let mut unique = clean.clone();
        let mut count = 1;
        while is_taken(&unique) {
            count += 1;
            unique = format!("{clean}x{count}");
        }
        self.rules.push(EbnfRule { name: unique, body, is_token });
        RuleId(self.rules.len() - 1)
    }

    /// The rule with an id.
    #[must_use]
    pub fn rule(&self, id: RuleId) -> Option<&EbnfRule> {
        self.rules.get(id.0)
    }
}
