//! What is wanted of a thing: that it is open, closed, somewhere, or that something is done with it.

use crate::english::{STATE_AND, STATE_POSED, STATE_RUBBISH, STATE_SKIPPED, WHERETO};
use crate::inflection::{Form, base};
use crate::noun::{Noun, noun};
use crate::spot::{Relation, located, way};
use crate::token::Token;

/// What is wanted of something.
pub(super) enum State {
    Open,
    Closed,
    /// It is somewhere: the words for it begin here.
    At,
    /// What is done with it, as the verb's base.
    Done(String),
}

/// The first noun from `begin` on behind which `state` finds something, said as an imperative.
pub(super) fn thing_before(
    tokens: &[Token],
    begin: usize,
    state: impl Fn(usize) -> Option<(State, usize)>,
) -> Option<(Vec<Token>, usize)> {
    (begin + 1..tokens.len()).find_map(|at| {
        let (found, after) = state(at)?;
        let (thing, end) = noun(tokens.get(..at)?, begin)?;
        if end != at {
            return None;
        }
        let verb = match found {
            State::Open => "open".to_owned(),
            State::Closed => "close".to_owned(),
            State::At if matches!(thing, Noun::Speaker) => return None,
            State::At => "put".to_owned(),
            State::Done(verb) => verb,
        };
        let mut said = words(&verb);
        said.extend_from_slice(tokens.get(begin..at)?);
        Some((said, after))
    })
}

/// What is wanted, and where the words for it that are still to be read begin.
pub(super) fn state(tokens: &[Token], at: usize, form: Form) -> Option<(State, usize)> {
    let word = tokens.get(at)?.word();
    // `standing open`
    let is_door = tokens.get(at + 1).is_some_and(|next| matches!(next.word(), "open" | "closed" | "shut"));
    let skips = STATE_SKIPPED.has(word) || (is_door && matches!(word, "standing" | "left" | "kept"));
    let at = if skips && tokens.get(at + 1).is_some() { at + 1 } else { at };
    let at = match STATE_POSED.run(tokens, at) {
        0 => at,
        count if is_place(tokens, at + count) => at + count,
        _ => at,
    };
    let word = tokens.get(at)?.word();
    let is_last = tokens
        .get(at + 1)
        .is_none_or(|next| matches!(next, Token::Comma | Token::Stop) || STATE_AND.has(next.word()));
    match word {
        "open" if is_last => return Some((State::Open, at + 1)),
        "closed" | "shut" if is_last => return Some((State::Closed, at + 1)),
        _ => {}
    }
    // `it can go out with the rubbish`
    if let Some(count) = STATE_RUBBISH.longest(tokens, at) {
        return Some((State::Done("discard".to_owned()), at + count));
    }
    if is_place(tokens, at) {
        return Some((State::At, at));
    }
    let (verb, found) = base(word)?;
    // `it needs taking care of` says nothing of what to do with it.
    if tokens.get(at + 1).is_some_and(|next| next.word() == "care") {
        return None;
    }
    // `put` and `shut` are their own participles.
    let is_put = found == Form::Base && form == Form::Participle && base_is_participle(word);
    let next = tokens.get(at + 1).map_or("", Token::word);
    // A `tea set` is a noun: these need a place behind them.
    let is_put = is_put && (is_place(tokens, at + 1) || matches!(next, "away" | "back" | "down"));
    (found == form || is_put).then_some((State::Done(verb), at + 1))
}

fn base_is_participle(word: &str) -> bool {
    matches!(word, "put" | "set" | "shut")
}

/// Whether words for a place begin here.
pub(super) fn is_place(tokens: &[Token], at: usize) -> bool {
    let is_way = || way(tokens, at).is_some_and(|(spot, _)| spot.relation != Relation::To);
    located(tokens, at).is_some() || WHERETO.longest(tokens, at).is_some() || is_way()
}

/// What is wanted of a thing of which this is not wanted; none where nothing is the opposite.
pub(super) fn opposite(state: State) -> Option<State> {
    match opposite_name(&state)? {
        "open" => Some(State::Open),
        _ => Some(State::Closed),
    }
}

/// The opposite in a word.
pub(super) fn opposite_name(state: &State) -> Option<&'static str> {
    match state {
        State::Open => Some("closed"),
        State::Closed => Some("open"),
        State::Done(verb) if verb == "open" => Some("closed"),
        State::Done(verb) if matches!(verb.as_str(), "close" | "shut") => Some("open"),
        State::At | State::Done(_) => None,
    }
}

/// Words as tokens.
pub(super) fn words(text: &str) -> Vec<Token> {
    text.split(' ').map(|word| Token::Word(word.to_owned())).collect()
}
