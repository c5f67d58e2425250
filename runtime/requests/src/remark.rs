//! What is said beside a request and asks for nothing: how things are, why, what somebody wonders, and what to mind.

use super::inflection::{Form, base};
use super::token::{Token, stands};
use super::verb::{Act, begins};
use crate::english::{
    BESIDE_LASTS, BESIDE_REASON, BESIDE_WHO, IS_BOUNDARY_AND, IS_OPEN_IF, IS_QUESTION_LEFT,
    IS_QUESTION_WHOSE, IS_RHETORICAL_ASKS, IS_RHETORICAL_WHO, IS_RHETORICAL_WOULD, IS_TELLING_IS,
    OPEN_QUESTIONS, PROHIBITIONS, PURPOSE_DOES_2, PURPOSE_IN_ORDER_TO, PURPOSE_TOMORROW, QUOTES_ME,
    QUOTING_VERBS, REASONS, SHALL_WE, SUBJECTS, TELLING_VERBS, TOPICS, WHETHER,
};
use crate::phrases::Phrases;

/// A remark goes on to the end of its sentence, or to a comma or a joint behind which something is asked for.
pub(super) fn remark_end(tokens: &[Token], begin: usize) -> usize {
    let mut at = begin;
    while let Some(token) = tokens.get(at) {
        let is_joint = matches!(token, Token::Comma) || matches!(token.word(), "and" | "so" | "but");
        let asks = || begins(tokens, at + 1) || super::frame::asks_for_it(tokens, at + 1).is_some();
        if matches!(token, Token::Stop) || (at > begin && is_joint && asks()) {
            break;
        }
        at += 1;
    }
    at
}

/// Whether words are a remark: with a subject before a verb, a question, or a reason. Anything else that is no command is
/// not understood, nor what forbids something or quotes somebody.
pub(super) fn is_remark(tokens: &[Token], begin: usize, end: usize) -> bool {
    let here = tokens.get(..end).unwrap_or_default();
    let of = |list: &Phrases| list.longest(here, begin).is_some();
    let matters = (begin..end).any(|at| PROHIBITIONS.longest(here, at).is_some());
    if end < begin + 2 || matters || quotes(tokens, here) {
        return false;
    }
    // What is only named or looked at is spoken of where more follows.
    if of(&TOPICS) && !(end..tokens.len()).any(|at| begins(tokens, at)) {
        return false;
    }
    // `leaving the fridge open wastes power`
    let is_doing = base(here.get(begin).map_or("", Token::word))
        .is_some_and(|(_, form)| form == Form::Gerund)
        && here.get(begin..).is_some_and(|said| said.iter().any(|token| is_telling(token.word())));
    let is_told = here.get(begin + 1).is_some_and(|token| TELLING_VERBS.has(token.word()));
    let is_name = here.get(begin).is_some_and(|token| !is_open(token.word()));
    of(&SUBJECTS)
        || of(&OPEN_QUESTIONS)
        || of(&TOPICS)
        || of(&SHALL_WE)
        || is_question(here, begin)
        || reason(tokens, begin, end)
        || purpose(tokens, begin, end)
        || is_doing
        || (is_told && is_name)
}

/// What is said of something that is done.
fn is_telling(word: &str) -> bool {
    IS_TELLING_IS.has(word)
}

/// `is the fridge still open?`
pub(super) fn is_question(tokens: &[Token], begin: usize) -> bool {
    let is = |at: usize, list: &Phrases| tokens.get(at).is_some_and(|token| list.has(token.word()));
    IS_QUESTION_LEFT.longest(tokens, begin).is_some()
        || is_rhetorical(tokens, begin)
        || is(begin, &WHETHER)
            && (is(begin + 1, &IS_QUESTION_WHOSE)
                || (stands(tokens, begin + 1, "not").is_some() && is(begin + 2, &IS_QUESTION_WHOSE)))
}

/// `would it not look nice on the shelf?`, `should it not be shut?`: what is thought to be so, and asks for nothing by itself.
fn is_rhetorical(tokens: &[Token], begin: usize) -> bool {
    let at = begin + IS_RHETORICAL_ASKS.longest(tokens, begin).unwrap_or(0);
    let not = usize::from(stands(tokens, at, "not").is_some());
    let is_of_it = at > begin && IS_RHETORICAL_WHO.longest(tokens, at + not).is_some();
    is_of_it && (not == 1 || IS_RHETORICAL_WOULD.longest(tokens, begin).is_some())
}

/// `since you are up anyway, …`: a whole clause, behind which something is asked for.
fn reason(tokens: &[Token], begin: usize, end: usize) -> bool {
    let Some(count) = REASONS.longest(tokens, begin) else {
        return false;
    };
    let is_subject = tokens.get(begin + count).is_some_and(|token| SUBJECTS.has(token.word()));
    is_subject && tokens.get(end) == Some(&Token::Comma)
}

/// `for safety, …`, `to keep it cool, …`, `so that it does not get lost, …`: what for, behind which something is asked for.
fn purpose(tokens: &[Token], begin: usize, end: usize) -> bool {
    let for_what = stands(tokens, begin, "for").is_some();
    let to_what = PURPOSE_IN_ORDER_TO
        .longest(tokens, begin)
        .is_some_and(|count| tokens.get(begin + count).is_some_and(|token| PURPOSE_DOES_2.has(token.word())));
    let is_bound = |token: &Token| PURPOSE_TOMORROW.has(token.word());
    let said = tokens.get(begin..end).unwrap_or_default();
    (for_what || to_what)
        && !said.iter().any(is_bound)
        && tokens.get(end) == Some(&Token::Comma)
        && begins(tokens, end + 1)
}

/// Words that begin a condition, a time or an order, and name nobody.
fn is_open(word: &str) -> bool {
    IS_OPEN_IF.has(word)
}

/// `mum said, bring me the coke`: what follows are somebody else's words.
fn quotes(tokens: &[Token], here: &[Token]) -> bool {
    let word = |back: usize| here.len().checked_sub(back).and_then(|at| here.get(at)).map_or("", Token::word);
    let says = |word: &str| QUOTING_VERBS.has(word);
    let is_quoted = tokens.get(here.len()) == Some(&Token::Comma);
    is_quoted && (says(word(1)) || (says(word(2)) && QUOTES_ME.has(word(1))))
}

/// What is said beside a request in its own clause: why, and how long something is held. Where it ends.
pub(super) fn beside(tokens: &[Token], at: usize, act: Act) -> Option<usize> {
    let is_clause = |at: usize| tokens.get(at).is_some_and(|token| BESIDE_WHO.has(token.word()));
    let holds = matches!(act, Act::Pick | Act::Lift | Act::Take | Act::Go);
    let of = |list: &Phrases| list.longest(tokens, at).filter(|count| is_clause(at + count));
    // What somebody else does meanwhile bounds nothing of what is done now: `while` and `whilst` stand among the reasons.
    let found = of(&BESIDE_REASON).or_else(|| of(&BESIDE_LASTS).filter(|_| holds));
    found.map(|_| remark_end(tokens, at))
}

/// Whether a phrase ends at a place.
pub(super) fn is_boundary(tokens: &[Token], at: usize) -> bool {
    matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
        || tokens.get(at).is_some_and(|token| IS_BOUNDARY_AND.has(token.word()))
}
