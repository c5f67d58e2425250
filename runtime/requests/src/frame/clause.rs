//! Clauses that ask without an imperative: predicates, wishes, causatives, and what stands before its verb.

use super::ONLY_IF_SO;
use super::link::{CAUSE, DO_NOT_WANT, HOLDS, IN_HAND, IS, SEE_TO, SHALL, SHALL_IT, TO_BE, WANT};
use super::placed::{fronted, headed, sent, with_it};
use super::pleasant::{called_for, pleasant};
use super::room::room_for;
use super::state::{State, is_place, opposite, opposite_name, state, thing_before, words};
use crate::inflection::Form;
use crate::lead::skip_leads;
use crate::noun::{Noun, noun};
use crate::spot::{Relation, spot, way};
use crate::token::{Token, longest, stands};
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
    let asks = longest(tokens, begin, &["can", "could", "may", "would"]);
    let sees = longest(tokens, begin, SEE_TO);
    let (begin, links) = match (asks, sees) {
        (Some(count), _) => (begin + count, SHALL_IT),
        (None, Some(count)) => (begin + count, IS),
        (None, None) => (begin + longest(tokens, begin, HOLDS).unwrap_or(0), SHALL),
    };
    let is_seen_to = asks.is_none() && sees.is_some();
    let belongs = asks.is_none() && sees.is_none();
    let (mut said, after) = thing_before(tokens, begin, |at| {
        // `can it please go there`
        let please = if asks.is_some() { stands(tokens, at, "please").unwrap_or(0) } else { 0 };
        let count = longest(tokens, at + please, links).map(|count| count + please);
        let none = longest(tokens, at, &["should not be", "is not", "needs", "wants"]);
        let (count, is_wanted) = match (count, none) {
            (Some(count), _) => (count, true),
            (None, Some(1)) => (1, true),
            (None, Some(count)) if is_seen_to || count == 3 => (count, false),
            (None, _) => return None,
        };
        // `see that it gets to me`
        let to_me = ["to me", "to us", "over to me", "to where i am", "with me", "here with me"];
        if is_seen_to
            && let Some(reached) = longest(tokens, at, &["reaches", "reached"])
            && let Some(me) = longest(tokens, at + reached, &["me", "us"])
        {
            return Some((State::Done("bring me".to_owned()), at + reached + me));
        }
        if (is_seen_to || belongs) && is_wanted && longest(tokens, at + count, &to_me).is_some() {
            return Some((State::At, at + count));
        }
        if stands(tokens, at, "disappears").or(stands(tokens, at, "disappeared")).is_some()
            && !is_place(tokens, at + count)
        {
            return None;
        }
        // `it is for the bin`
        if tokens.get(at + count - 1).is_some_and(|token| token.word() == "for") {
            let bin = [
                "the bin",
                "the trash",
                "the rubbish",
                "the rubbish bin",
                "the garbage",
                "the waste",
                "the trash can",
                "the dustbin",
                "the waste bin",
                "the garbage can",
                "the scrapheap",
            ];
            return Some((
                State::Done("discard".to_owned()),
                at + count + longest(tokens, at + count, &bin)?,
            ));
        }
        let needs = longest(tokens, at, &["needs", "wants"]) == Some(count);
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
    let sees_you = ["to see you", "to meet you", "to have you", "you to be", "you"];
    let wants = longest(tokens, begin, WANT).max(to_have(tokens, begin));
    if let Some(count) = wants
        && let Some(you) = sees_you.iter().find_map(|see| stands(tokens, begin + count, see))
        && is_place(tokens, begin + count + you)
    {
        return Some((words("go"), begin + count + you));
    }
    if let Some(count) = wants {
        return thing_before(tokens, begin + count, |at| {
            let to_be = longest(tokens, at, TO_BE);
            let found = state(tokens, at + to_be.unwrap_or(0), Form::Participle)?;
            // `I want the mug on the table` is left to who knows where the mug is.
            let sees = stands(tokens, begin + count - 1, "see").is_some()
                || stands(tokens, begin + count - 1, "for").is_some();
            (to_be.is_some() || sees || !matches!(found.0, State::At)).then_some(found)
        });
    }
    let count = longest(tokens, begin, DO_NOT_WANT)?;
    thing_before(tokens, begin + count, |at| {
        let to_be = longest(tokens, at, TO_BE).unwrap_or(0);
        let (state, after) = state(tokens, at + to_be, Form::Participle)?;
        Some((opposite(state)?, after))
    })
}

/// `get the fridge open`, `push the drawer shut`, `have the coke brought to me`
pub(super) fn cause(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let verb = tokens.get(begin)?.word();
    if !CAUSE.contains(&verb) {
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
        if let ("have" | "get" | "keep", Some(_)) = (verb, longest(tokens, at, IN_HAND)) {
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
    let moves = matches!(
        tokens.get(begin)?.word(),
        "take"
            | "get"
            | "bring"
            | "move"
            | "drive"
            | "park"
            | "roll"
            | "drag"
            | "haul"
            | "wheel"
            | "shift"
            | "plant"
            | "place"
            | "put"
            | "position"
            | "station"
            | "steer"
            | "carry"
    );
    let is_self = matches!(tokens.get(begin + 1)?.word(), "yourself");
    (moves && is_self).then(|| (words("go"), begin + 2))
}

/// `if the drawer is open, close it`: `close the drawer if it is open`.
fn unless_so(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    let at = begin + longest(tokens, begin, &["if", "in case", "when"])?;
    let here = tokens.get(..limit)?;
    let (said, after) = thing_before(here, at, |at| {
        let count =
            ["is still", "is", "was left", "has been left"].iter().find_map(|is| stands(here, at, is))?;
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
    let bins = [
        "rubbish bin",
        "bin",
        "trash",
        "trash can",
        "dustbin",
        "rubbish",
        "garbage",
        "garbage can",
        "straight in the bin",
        "waste bin",
    ];
    if !begins_first(tokens, begin)
        && let Some(count) = longest(tokens, begin, &bins)
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
        && let Some(asked) = longest(tokens, asks, &["please", "now", "quick"])
        && matches!(tokens.get(asks + asked), None | Some(Token::Stop | Token::Comma))
    {
        let mut said = words("put");
        said.extend_from_slice(tokens.get(begin..after)?);
        said.extend_from_slice(tokens.get(limit + 1..end)?);
        return Some((said, end));
    }
    let ways = [
        "over to",
        "to",
        "into",
        "onto",
        "away into",
        "away in",
        "back into",
        "back onto",
        "back to",
        "back in",
        "back on",
        "over onto",
        "over into",
        "straight into",
        "down onto",
        "up onto",
    ];
    let goes = longest(tokens, after, &ways);
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
    matches!(word, "me" | "us" | "it" | "them" | "that" | "this" | "here" | "there" | "you" | "i")
}
