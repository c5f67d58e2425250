//! The verbs of household requests.

use super::lead::skip_leads;
use super::noun::noun;
use super::token::{Token, words};
use super::wish::wish;
use crate::english::{
    APART_VERBS, IS_NO_THING_DONE, IS_NO_THING_HELP, IS_NO_THING_RID, IS_NO_THING_YOUR, TAKE_HOLD,
    VAGUE_VERBS, VERB, WANTED_LATER,
};

/// The act that a verb asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Act {
    Go,
    /// Come to the person.
    Come,
    /// Bring something to someone.
    Fetch,
    /// Take into the hand.
    Pick,
    /// Raise in the hand.
    Lift,
    Put,
    /// Take: to a place, or into the hand.
    Take,
    /// Put where it belongs.
    Stow,
    /// Put into something in which things are kept.
    Store,
    Discard,
    /// Throw: to a place, to someone, or away.
    Throw,
    /// Let go of.
    Release,
    Open,
    Close,
    /// Move: something to a place, or oneself.
    Move,
    /// Find out where something is.
    Find,
}

impl Act {
    /// The act of a name in the list of verbs.
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "go" => Self::Go,
            "come" => Self::Come,
            "fetch" => Self::Fetch,
            "pick" => Self::Pick,
            "lift" => Self::Lift,
            "put" => Self::Put,
            "take" => Self::Take,
            "stow" => Self::Stow,
            "store" => Self::Store,
            "discard" => Self::Discard,
            "throw" => Self::Throw,
            "release" => Self::Release,
            "open" => Self::Open,
            "close" => Self::Close,
            "move" => Self::Move,
            "find" => Self::Find,
            _ => return None,
        })
    }
}

/// The verb that stands at a place, and where its object begins.
pub(super) fn verb(tokens: &[Token], at: usize) -> Option<(Act, usize)> {
    // `the table, trash can and shelf`: a noun, for want of an object.
    let next = tokens.get(at + 1).map_or("", Token::word);
    if matches!(tokens.get(at)?.word(), "trash" | "bin") && matches!(next, "" | "can" | "bin" | "bag" | "and")
    {
        return None;
    }
    // `take care of it` says nothing of what to do with it.
    if VAGUE_VERBS.longest(tokens, at).is_some() {
        return None;
    }
    let wants = wanted(tokens, at).map(|after| (Act::Fetch, after));
    let verb = VERB.valued(tokens, at).and_then(|(count, act)| Some((Act::named(act)?, at + count)));
    let holds = TAKE_HOLD.longest(tokens, at).map(|count| (Act::Pick, at + count));
    verb.into_iter().chain(wants).chain(holds).max_by_key(|(_, after)| *after)
}

/// `lock it away`, `track it down`: the verb with its small word behind the thing, and where what is read
/// ends.
pub(super) fn apart(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let word = tokens.get(at)?.word();
    let (_, after) = noun(tokens, at + 1).filter(|_| APART_VERBS.begins_with(word))?;
    // The verb and what follows the thing, as if they stood together.
    let together: Vec<Token> =
        tokens.get(at..=at)?.iter().chain(tokens.get(after..)?).take(3).cloned().collect();
    let (count, means) = APART_VERBS.valued(&together, 0)?;
    Some((after + count - 1, [words(means).as_slice(), tokens.get(at + 1..after)?].concat()))
}

/// Finds where what somebody wants to have begins, where they want it now.
fn wanted(tokens: &[Token], at: usize) -> Option<usize> {
    let after = at + wish(tokens, at)?;
    // `I will need it later` tells of another time.
    let is_end = |token: &&Token| {
        matches!(token, Token::Comma | Token::Stop)
            || matches!(token.word(), "and" | "so" | "but" | "because")
    };
    let clause = tokens.get(after..)?.iter().take_while(|token| !is_end(token));
    let is_later = clause.clone().any(|token| WANTED_LATER.has(token.word()));
    (!is_later && !is_no_thing(tokens, after)).then_some(after)
}

/// Reads what somebody wants to do, or wants of somebody, and does not want to have: `to open it`, `your
/// help`.
fn is_no_thing(tokens: &[Token], at: usize) -> bool {
    let whose = IS_NO_THING_YOUR.has(tokens.get(at).map_or("", Token::word));
    let what = tokens.get(at + usize::from(whose)).map_or("", Token::word);
    let is_undone = tokens.get(at).is_some_and(|token| matches!(token.word(), "something" | "anything"))
        && tokens.get(at + 1).is_some_and(|token| IS_NO_THING_DONE.has(token.word()));
    // `I would like to get into the drawer`
    let is_way_in = tokens.get(at).is_some_and(|token| IS_NO_THING_RID.has(token.word()));
    is_undone
        || is_way_in
        || tokens.get(at).is_some_and(|token| matches!(token.word(), "to" | "you"))
        || IS_NO_THING_HELP.has(what)
}

/// Checks whether it is a wish that stands here, and no verb.
pub(super) fn is_want(tokens: &[Token], at: usize) -> bool {
    wanted(tokens, at).is_some()
}

/// Checks whether a request begins here, after what politeness puts before it.
pub(super) fn begins(tokens: &[Token], at: usize) -> bool {
    verb(tokens, skip_leads(tokens, at)).is_some()
}
