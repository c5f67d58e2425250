//! Interpreter of the rules: lists of templates with slots, and what takes their place.
//!
//! The rules of a list are tried in order and the first that fits is applied. Within a rule a list of phrases
//! takes the longest of them; an optional or repeated part is taken where it stands. Only a slot may end at
//! several places, such as `{thing}` at each word behind which a noun may end: these are tried in order. So
//! the work for a rule is linear in its parts for each of them.

use crate::engine::effort;
use crate::engine::phrases::{List, list};
use crate::engine::reader::{self, Clause};
use crate::engine::template::{Part, Side, Template};
use crate::engine::token::{Token, words};
use crate::engine::verb::Act;
#[cfg(test)]
use tests::fits;

/// A list of rules by its name in the files.
pub(crate) struct Rules(pub(crate) &'static str);

/// End and words that a rule found.
#[derive(Debug)]
pub(crate) struct Found {
    pub(crate) end: usize,
    /// Words that take the place of those that were read.
    pub(crate) words: Vec<Token>,
}

/// Progress of a rule.
#[derive(Clone, Default)]
struct State {
    at: usize,
    slots: Vec<(&'static str, Vec<Token>)>,
    value: Option<Vec<Token>>,
}

/// Most words that a look back takes in.
const BACK: usize = 8;

impl Rules {
    /// Applies the first rule that fits at a place.
    pub(crate) fn at(&self, tokens: &[Token], at: usize) -> Option<Found> {
        self.behind(tokens, at, None)
    }

    /// The end of what the first rule that fits reads.
    pub(crate) fn end(&self, tokens: &[Token], at: usize) -> Option<usize> {
        Some(self.at(tokens, at)?.end)
    }

    /// Applies the first rule that fits at a place behind a command.
    pub(crate) fn behind(&self, tokens: &[Token], at: usize, before: Option<Act>) -> Option<Found> {
        self.apply(Clause::new(tokens, at, before, &[]))
    }

    /// Applies the first rule that fits at a place of a command of which something was said.
    pub(crate) fn given(&self, tokens: &[Token], at: usize, act: Act, facts: &[&str]) -> Option<Found> {
        self.apply(Clause::new(tokens, at, Some(act), facts))
    }

    /// Applies the first rule that fits at a place, with what is known there.
    pub(crate) fn knowing(&self, tokens: &[Token], at: usize, facts: &[&str]) -> Option<Found> {
        self.apply(Clause::new(tokens, at, None, facts))
    }

    fn apply(&self, clause: Clause<'_>) -> Option<Found> {
        let begin = clause.begin;
        match list(self.0)? {
            List::Rules(rules) => {
                let state = clause.rules(self.0, rules, State { at: begin, ..State::default() })?;
                Some(Found { end: state.at, words: state.value.unwrap_or_default() })
            }
            // A list without a slot needs no rule.
            List::Phrases(phrases) => {
                let count = phrases.longest(clause.tokens, begin)?;
                Some(Found { end: begin + count, words: Vec::new() })
            }
        }
    }

    /// Applies the first rule that fits anywhere: what it writes.
    pub(crate) fn search(&self, tokens: &[Token]) -> Option<Vec<Token>> {
        let Some(List::Rules(rules)) = list(self.0) else { return None };
        rules.iter().enumerate().find_map(|(index, rule)| {
            let found = (0..tokens.len()).find_map(|at| {
                Clause::new(tokens, at, None, &[]).rule(rule, State { at, ..State::default() })
            })?;
            fits(self.0, index);
            found.value
        })
    }

    /// Rewrites what rules fit, from the first word to the last.
    pub(crate) fn rewrite(&self, tokens: &mut Vec<Token>) {
        let mut at = 0;
        while at < tokens.len() && !effort::is_used_up() {
            match self.at(tokens, at) {
                Some(found) => {
                    let next = at + found.words.len();
                    tokens.splice(at..found.end, found.words);
                    at = next;
                }
                None => at += 1,
            }
        }
    }
}

impl Clause<'_> {
    fn rules(&self, name: &'static str, rules: &'static [Template], state: State) -> Option<State> {
        let (index, found) = rules
            .iter()
            .enumerate()
            .find_map(|(index, rule)| Some((index, self.rule(rule, state.clone())?)))?;
        fits(name, index);
        Some(found)
    }

    fn rule(&self, rule: &'static Template, state: State) -> Option<State> {
        let begin = State { slots: Vec::new(), value: None, ..state };
        let mut end = self.part(&rule.part, begin).into_iter().next()?;
        if let Some(value) = rule.value {
            end.value = Some(filled(value, &end.slots));
        }
        Some(State { slots: state.slots, ..end })
    }

    /// All ends at which a part fits, in order.
    fn part(&self, part: &'static Part, state: State) -> Vec<State> {
        if !effort::step() {
            return Vec::new();
        }
        match part {
            Part::Word(word) => {
                let is_it = match (self.tokens.get(state.at), *word) {
                    (Some(Token::Comma), ",") | (Some(Token::Stop), ".") => true,
                    (Some(Token::Word(said)), word) => said == word,
                    _ => false,
                };
                if is_it { vec![State { at: state.at + 1, value: None, ..state }] } else { Vec::new() }
            }
            Part::Sequence(parts) => parts.iter().fold(vec![state], |states, part| {
                states.into_iter().flat_map(|state| self.part(part, state)).collect()
            }),
            // An optional part.
            Part::Choice(parts) if matches!(parts.last(), Some(Part::Sequence(none)) if none.is_empty()) => {
                let taken: Vec<State> = parts
                    .iter()
                    .take(parts.len() - 1)
                    .flat_map(|part| self.part(part, state.clone()))
                    .collect();
                if taken.is_empty() { vec![State { value: None, ..state }] } else { taken }
            }
            Part::Choice(parts) => parts.iter().flat_map(|part| self.part(part, state.clone())).collect(),
            Part::Repeat(part) => {
                let mut last = state;
                while let Some(next) = self.part(part, last.clone()).into_iter().next()
                    && next.at > last.at
                {
                    last = next;
                }
                vec![State { value: None, ..last }]
            }
            Part::List(name) => match list(name) {
                Some(List::Phrases(phrases)) => {
                    let count = phrases.longest(self.tokens, state.at);
                    count
                        .map(|count| State { at: state.at + count, value: None, ..state })
                        .into_iter()
                        .collect()
                }
                Some(List::Rules(rules)) => self.rules(name, rules, state).into_iter().collect(),
                None => Vec::new(),
            },
            Part::Slot(name, part) => {
                let begin = state.at;
                let mut found = self.part(part, state);
                for state in &mut found {
                    let read = || self.tokens.get(begin..state.at).unwrap_or_default().to_vec();
                    let value = state.value.take().unwrap_or_else(read);
                    state.value = Some(value.clone());
                    state.slots.push((name, value));
                }
                found
            }
            Part::Read(number, argument) => reader::read(self, *number, argument, state.at)
                .into_iter()
                .map(|(at, value)| State { at, value, slots: state.slots.clone() })
                .collect(),
            Part::Look(side, is_wanted, part) => {
                let at = state.at;
                let stands = match side {
                    Side::Ahead => !self.part(part, state.clone()).is_empty(),
                    Side::Behind => (at.saturating_sub(BACK)..at).any(|from| {
                        let before = State { at: from, ..State::default() };
                        self.part(part, before).iter().any(|state| state.at == at)
                    }),
                };
                if stands == *is_wanted { vec![State { value: None, ..state }] } else { Vec::new() }
            }
        }
    }
}

#[cfg(not(test))]
const fn fits(_list: &str, _index: usize) {}

/// A value with its slots filled.
fn filled(value: &'static str, slots: &[(&'static str, Vec<Token>)]) -> Vec<Token> {
    let mut filled = Vec::new();
    for word in value.split_whitespace() {
        match word.strip_prefix('{').and_then(|word| word.strip_suffix('}')) {
            Some(name) => {
                let slot = slots.iter().rev().find(|(slot, _)| *slot == name);
                filled.extend(slot.map(|(_, said)| said.clone()).unwrap_or_default());
            }
            None => filled.extend(words(word)),
        }
    }
    filled
}

#[cfg(test)]
pub(crate) mod tests {
    use std::cell::RefCell;

    thread_local! {
        /// Rules that fitted, as list and position, in order. The last of a call is the rule of its own list.
        pub(crate) static FITTING: RefCell<Vec<(&'static str, usize)>> = const { RefCell::new(Vec::new()) };
    }

    /// Notes that a rule fits.
    pub(crate) fn fits(list: &'static str, index: usize) {
        FITTING.with_borrow_mut(|fitting| fitting.push((list, index)));
    }
}
