//! Clauses that ask without an imperative: predicates, wishes, causatives, and what stands before its verb.

use super::ONLY_IF_SO;
use super::placed::{fronted, headed, sent, with_it};
use super::pleasant::{called_for, pleasant};
use super::room::room_for;
use super::state::{State, is_place, opposite, opposite_name, state, thing_before, words};
use crate::english::{
    BARE_BINS, BARE_PLEASE, BARE_WAYS, BECOMES, CAUSATIVES, IN_HAND, IS_PRONOUN_ME, OPINIONS, PREDICATE_BIN,
    PREDICATE_CAN, PREDICATE_ME, PREDICATE_NEEDS, PREDICATE_REACHES, PREDICATE_SHOULD_NOT_BE,
    PREDICATE_TO_ME, SEE_TO, SELF_MOVED_TAKE, SHALL_BE, SHALL_IT, TO_BE, UNLESS_SO_IF, UNLESS_SO_IS_STILL,
    UNWANTED_STATE, WANTS_STATE, WISH_SEES_YOU,
};
use crate::inflection::Form;
use crate::lead::skip_leads;
use crate::noun::{Noun, noun};
use crate::spot::{Relation, spot, way};
use crate::token::{Token, stands};
use crate::verb::begins;
use crate::wish::wish as to_have;

/// Behind this only `open` and `closed` ask for something: `it stays on the table` tells where it is.
const STAYS: &str = "stays";

/// One clause said plainly, and where what follows it begins.
pub(super) fn clause(tokens: &[Token], begin: usize, begins_sentence: bool) -> Option<(Vec<Token>, usize)> {
    let limit = (begin..tokens.len())
        .find(|at| matches!(tokens.get(*at), Some(Token::Comma | Token::Stop)))
        .unwrap_or(tokens.len());
    let tokens_here = tokens.get(..limit)?;
    predicate(tokens_here, begin)
        .or_else(|| wish(tokens_here, begin))
        .or_else(|| cause(tokens_here, begin))
        .or_else(|| self_moved(tokens_here, begin))
        .or_else(|| fronted(tokens_here, begin))
        .or_else(|| room_for(tokens_here, begin))
        .or_else(|| with_it(tokens, begin))
        .or_else(|| sent(tokens_here, begin))
        .or_else(|| pleasant(tokens_here, begin))
        .or_else(|| unless_so(tokens, begin, limit))
        .or_else(|| begins_sentence.then(|| called_for(tokens, begin, limit)).flatten())
        .or_else(|| begins_sentence.then(|| headed(tokens, begin, limit)).flatten())
        .or_else(|| begins_sentence.then(|| bare(tokens, begin, limit)).flatten())
}

/// `the coke belongs in the fridge`, `can the coke go in the fridge`, `make sure that the drawer is shut`
fn predicate(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let asks = PREDICATE_CAN.longest(tokens, begin);
    let sees = SEE_TO.longest(tokens, begin);
    let (begin, links) = match (asks, sees) {
        (Some(count), _) => (begin + count, &SHALL_IT),
        (None, Some(count)) => (begin + count, &BECOMES),
        (None, None) => (begin + OPINIONS.longest(tokens, begin).unwrap_or(0), &SHALL_BE),
    };
    let is_seen_to = asks.is_none() && sees.is_some();
    let belongs = asks.is_none() && sees.is_none();
    let (mut said, after) = thing_before(tokens, begin, |at| {
        // `can it please go there`
        let please = if asks.is_some() { stands(tokens, at, "please").unwrap_or(0) } else { 0 };
        let count = links.longest(tokens, at + please).map(|count| count + please);
        let none = PREDICATE_SHOULD_NOT_BE.longest(tokens, at);
        let (count, is_wanted) = match (count, none) {
            (Some(count), _) => (count, true),
            (None, Some(1)) => (1, true),
            (None, Some(count)) if is_seen_to || count == 3 => (count, false),
            (None, _) => return None,
        };
        // `see that it gets to me`
        if is_seen_to
            && let Some(reached) = PREDICATE_REACHES.longest(tokens, at)
            && let Some(me) = PREDICATE_ME.longest(tokens, at + reached)
        {
            return Some((State::Done("bring me".to_owned()), at + reached + me));
        }
        if (is_seen_to || belongs) && is_wanted && PREDICATE_TO_ME.longest(tokens, at + count).is_some() {
            return Some((State::At, at + count));
        }
        if stands(tokens, at, "disappears").or(stands(tokens, at, "disappeared")).is_some()
            && !is_place(tokens, at + count)
        {
            return None;
        }
        // `it is for the bin`
        if tokens.get(at + count - 1).is_some_and(|token| token.word() == "for") {
            return Some((
                State::Done("discard".to_owned()),
                at + count + PREDICATE_BIN.longest(tokens, at + count)?,
            ));
        }
        let needs = PREDICATE_NEEDS.longest(tokens, at) == Some(count);
        let (state, after) = state(tokens, at + count, if needs { Form::Gerund } else { Form::Participle })?;
        // `it must be closed` may only guess; `it must be put on the table` asks.
        if stands(tokens, at, "must be") == Some(count)
            && (!matches!(state, State::Done(_)) || opposite_name(&state).is_some())
        {
            return None;
        }
        if stands(tokens, at, STAYS) == Some(count) && opposite_name(&state).is_none() {
            return None;
        }
        Some((if is_wanted { state } else { opposite(state)? }, after))
    })?;
    if let Some(verb) = said.first_mut().filter(|verb| belongs && verb.word() == "put") {
        *verb = Token::Word("keep".to_owned());
    }
    Some((said, after))
}

/// `I need the fridge open`, `I would like the coke to be on the table`, `I want you at the door`
fn wish(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let wants = WANTS_STATE.longest(tokens, begin).max(to_have(tokens, begin));
    if let Some(count) = wants
        && let Some(you) = WISH_SEES_YOU.longest(tokens, begin + count)
        && is_place(tokens, begin + count + you)
    {
        return Some((words("go"), begin + count + you));
    }
    if let Some(count) = wants {
        return thing_before(tokens, begin + count, |at| {
            let to_be = TO_BE.longest(tokens, at);
            let found = state(tokens, at + to_be.unwrap_or(0), Form::Participle)?;
            // `I want the mug on the table` is left to who knows where the mug is.
            let sees = stands(tokens, begin + count - 1, "see").is_some()
                || stands(tokens, begin + count - 1, "for").is_some();
            (to_be.is_some() || sees || !matches!(found.0, State::At)).then_some(found)
        });
    }
    let count = UNWANTED_STATE.longest(tokens, begin)?;
    thing_before(tokens, begin + count, |at| {
        let to_be = TO_BE.longest(tokens, at).unwrap_or(0);
        let (state, after) = state(tokens, at + to_be, Form::Participle)?;
        Some((opposite(state)?, after))
    })
}

/// `get the fridge open`, `push the drawer shut`, `have the coke brought to me`
pub(super) fn cause(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let verb = tokens.get(begin)?.word();
    if !CAUSATIVES.has(verb) {
        return None;
    }
    thing_before(tokens, begin + 1, |at| {
        // `make it go on the table`
        if let ("make", Some(goes)) = (verb, stands(tokens, at, "go")) {
            return is_place(tokens, at + goes).then_some((State::At, at + goes));
        }
        // `make it stand on the table`
        if let ("make" | "have", "stand" | "sit" | "rest" | "lie" | "live") = (verb, tokens.get(at)?.word()) {
            return is_place(tokens, at + 1).then_some((State::At, at + 1));
        }
        // `have it on the table`
        if verb == "have" && is_place(tokens, at) && spot(tokens, at).is_some() {
            return Some((State::At, at));
        }
        // `push it to`
        if let ("push" | "pull", "to") = (verb, tokens.get(at)?.word()) {
            let is_last =
                tokens.get(at + 1).is_none_or(|next| matches!(next.word(), "please" | "for" | "and"));
            return is_last.then_some((State::Closed, at + 1));
        }
        // `have it waiting on the table`
        if let ("have", "waiting" | "ready") = (verb, tokens.get(at)?.word()) {
            return is_place(tokens, at + 1).then_some((State::At, at + 1));
        }
        // `have it in your hand`
        if let ("have" | "get" | "keep", Some(_)) = (verb, IN_HAND.longest(tokens, at)) {
            return Some((State::Done("hold".to_owned()), at));
        }
        // `let it rest on the table`
        if let ("let", "rest" | "sit" | "stand" | "lie" | "be" | "go" | "stay" | "live") =
            (verb, tokens.get(at)?.word())
        {
            return is_place(tokens, at + 1).then_some((State::At, at + 1));
        }
        if verb == "let" {
            return None;
        }
        // `make it disappear in the bin`
        if let ("make", "disappear" | "vanish") = (verb, tokens.get(at)?.word()) {
            return is_place(tokens, at + 1).then_some((State::At, at + 1));
        }
        let (state, after) = state(tokens, at, Form::Participle)?;
        let is_open_or_closed = opposite_name(&state).is_some();
        (is_open_or_closed || (matches!(verb, "get" | "have") && matches!(state, State::Done(_))))
            .then_some((state, after))
    })
}

/// `take yourself to the door`
fn self_moved(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let moves = SELF_MOVED_TAKE.has(tokens.get(begin)?.word());
    let is_self = matches!(tokens.get(begin + 1)?.word(), "yourself");
    (moves && is_self).then(|| (words("go"), begin + 2))
}

/// `if the drawer is open, close it`: `close the drawer if it is open`.
fn unless_so(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    let at = begin + UNLESS_SO_IF.longest(tokens, begin)?;
    let here = tokens.get(..limit)?;
    let (said, after) = thing_before(here, at, |at| {
        let count = UNLESS_SO_IS_STILL.longest(here, at)?;
        let (state, after) = state(here, at + count, Form::Participle)?;
        Some((opposite(state)?, after))
    })?;
    if after != limit {
        return None;
    }
    let then = skip_leads(tokens, limit + 1);
    let verb = tokens.get(then)?.word();
    let wanted = said.first()?.word();
    let is_same = verb == wanted || (verb == "shut" && wanted == "close");
    let is_it = matches!(tokens.get(then + 1)?.word(), "it" | "that");
    (is_same && is_it).then(|| ([said, words(ONLY_IF_SO)].concat(), then + 2))
}

/// Whether a clause follows that says what is done with what was named just before.
fn is_spoken_of(tokens: &[Token], mut at: usize) -> bool {
    while matches!(tokens.get(at), Some(Token::Comma))
        || tokens.get(at).is_some_and(|token| token.word() == "and")
    {
        at += 1;
    }
    let begin = skip_leads(tokens, at);
    let begin = begin + stands(tokens, begin, "you").unwrap_or(0);
    let is_end = |token: &&Token| matches!(token, Token::Comma | Token::Stop);
    let mut clause = tokens.get(begin..).unwrap_or_default().iter().take_while(|token| !is_end(token));
    begins(tokens, begin) && clause.any(|token| matches!(token.word(), "it" | "them" | "there" | "that"))
}

/// `the coke, please`: someone wants to have it.
fn bare(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    // `nobody wants the toy now. Rubbish bin, please`
    if !begins_first(tokens, begin)
        && let Some(count) = BARE_BINS.longest(tokens, begin)
        && matches!(tokens.get(begin + count), None | Some(Token::Comma | Token::Stop))
        && stands(tokens, begin + count + 1, "please").is_some()
    {
        return Some((words("discard it"), begin + count));
    }
    if begins(tokens, begin) {
        return None;
    }
    let (_, after) = noun(tokens.get(..limit)?, begin)?;
    // `see to the can` says nothing of what to do with it.
    if matches!(tokens.get(begin)?.word(), "see" | "attend" | "tend" | "look") {
        return None;
    }
    let is_named = tokens.get(begin).is_some_and(|token| !is_pronoun(token.word()));
    // `the fridge, please, you close it`: what is done with it is said.
    let next = limit + 1 + stands(tokens, limit + 1, "please").unwrap_or(0);
    if is_spoken_of(tokens, next) {
        return None;
    }
    let please = |at: usize| stands(tokens, at, "please").is_some();
    if is_named && (please(after) || (after == limit && please(limit + 1))) {
        let mut said = words("bring me");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, after));
    }
    // `the coke, on the table, please`
    if is_named
        && after == limit
        && tokens.get(limit) == Some(&Token::Comma)
        && let Some((place, end)) = spot(tokens, limit + 1).or_else(|| way(tokens, limit + 1))
        && matches!(place.noun, Noun::Phrase(_))
        && place.relation != Relation::Beside
        && let asks = end + usize::from(tokens.get(end) == Some(&Token::Comma))
        && let Some(asked) = BARE_PLEASE.longest(tokens, asks)
        && matches!(tokens.get(asks + asked), None | Some(Token::Stop | Token::Comma))
    {
        let mut said = words("put");
        said.extend_from_slice(tokens.get(begin..after)?);
        said.extend_from_slice(tokens.get(limit + 1..end)?);
        return Some((said, end));
    }
    let goes = BARE_WAYS.longest(tokens, after);
    let (_, end) = noun(tokens.get(..limit)?, after + goes?)?;
    let is_short = after - begin <= 4;
    let is_said =
        is_short && matches!(tokens.get(after + goes? - 1)?.word(), "into" | "onto") && end == limit;
    if is_named && (is_said || please(end) || (end == limit && please(limit + 1))) {
        let mut said = words("put");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, after));
    }
    None
}

/// Whether nothing was said before.
fn begins_first(tokens: &[Token], begin: usize) -> bool {
    tokens.get(..begin).is_none_or(|before| !before.contains(&Token::Stop))
}

fn is_pronoun(word: &str) -> bool {
    IS_PRONOUN_ME.has(word)
}
