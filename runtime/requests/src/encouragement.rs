//! Consent to another try, in whatever words: `give it another shot`, `it cannot hurt`.

use super::inflection::{Form, base};
use super::lead::skip_leads;
use super::token::{Token, stands, tokens};
use super::verb::{Act, verb};
use crate::english::{
    AGAIN, AGREES, AGREES_AS_CLAUSE, AGREES_PLAINLY, BESIDE_THE_POINT, DENIAL_WORDS, GIVES_UP, IS_TAG_ASKS,
    NEGATES_NO, PLAIN_WORDS, REPORT_WORDS, RETRY_WORDS, SKIP_SOFT_SOFT, SOUNDS, TRIES_AGAIN,
};

/// Checks whether an answer agrees to another try, and says nothing else that would have to be done or
/// heeded: what it says beside that, in words; none where it does not agree.
#[must_use]
pub fn encourages(answer: &str) -> Option<String> {
    let mut said = tokens(answer);
    // `uh huh` and `mm hm` agree.
    said.retain(|token| {
        let word = token.word();
        !SOUNDS.has(word) || matches!(word, "uh" | "huh" | "mm" | "hm")
    });
    let (mut agrees, mut beside) = (false, Vec::new());
    for clause in said.split(|token| matches!(token, Token::Comma | Token::Stop)) {
        let begin = skip_soft(clause, 0);
        if clause.get(begin..).is_none_or(<[Token]>::is_empty) {
            agrees |= (0..clause.len()).any(|at| AGREES.longest(clause, at).is_some());
            continue;
        }
        // `if you would, thank you`
        if AGREES_AS_CLAUSE.longest(clause, begin) == Some(clause.len() - begin) {
            agrees = true;
            continue;
        }
        let is_beside =
            BESIDE_THE_POINT.longest(clause, begin).max(BESIDE_THE_POINT.longest(clause, 0)).is_some();
        if !is_beside && (0..clause.len()).any(|at| GIVES_UP.longest(clause, at).is_some()) {
            return None;
        }
        let is_agreed = (0..clause.len())
            .any(|at| AGAIN.longest(clause, at).is_some() || AGREES.longest(clause, at).is_some())
            && is_plain(clause);
        // `I cannot do it myself` says why.
        let is_agreed = is_agreed && stands(clause, begin, "i can not").is_none();
        if let Some(left) = asks_again(clause).filter(|_| !is_agreed) {
            agrees = true;
            beside.extend(left);
            continue;
        }
        let is_denied = !is_beside
            && clause.iter().any(|token| DENIAL_WORDS.has(token.word()))
            && (!is_agreed || negates(clause));
        if is_denied {
            return None;
        }
        // Something else is asked for.
        if !is_agreed && !is_beside && verb(clause, skip_leads(clause, begin)).is_some() {
            return None;
        }
        agrees |= is_agreed;
        if !is_agreed && !is_beside && !is_tag(clause) {
            beside.extend(clause.iter().map(Token::word));
        }
    }
    agrees.then(|| beside.join(" "))
}

fn is_tag(clause: &[Token]) -> bool {
    matches!(clause, [ask, _] if IS_TAG_ASKS.has(ask.word()))
}

/// Checks whether it takes back or bounds something, in words that are no part of what only sounds so.
fn negates(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        match BESIDE_THE_POINT.longest(clause, at).max(AGREES_AS_CLAUSE.longest(clause, at)) {
            Some(count) => at += count,
            None if NEGATES_NO.has(token.word()) => {
                return true;
            }
            None => at += 1,
        }
    }
    false
}

/// Checks whether a clause that asks for another try says nothing else that would have to be heeded: words
/// that deny or bound it, or another thing to do. What it says beside that, in words.
fn asks_again(clause: &[Token]) -> Option<Vec<&str>> {
    // Who asks something, or tells what somebody did, asks for nothing.
    let (mut at, mut tries, mut left) = (0, false, Vec::new());
    while let Some(token) = clause.get(at) {
        let taken = TRIES_AGAIN.longest(clause, at);
        match taken {
            Some(count) => {
                let said = clause.get(at..at + count)?;
                tries |= said.iter().any(|token| RETRY_WORDS.has(token.word()));
                at += count;
            }
            None if PLAIN_WORDS.has(token.word()) || AGREES.has(token.word()) => at += 1,
            None if DENIAL_WORDS.has(token.word()) => return None,
            None if verb(clause, at)
                .is_some_and(|(act, _)| !matches!(act, Act::Go | Act::Come | Act::Move)) =>
            {
                return None;
            }
            None if REPORT_WORDS.has(token.word()) => return None,
            // `try opening it again`
            None if matches!(base(token.word()), Some((_, Form::Gerund))) => return None,
            None => {
                left.push(token.word());
                at += 1;
            }
        }
    }
    tries.then_some(left)
}

/// Checks whether a clause has no other words than those that agree.
fn is_plain(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        let taken = AGREES_PLAINLY.longest(clause, at);
        match taken {
            Some(count) => at += count,
            None if PLAIN_WORDS.has(token.word()) => at += 1,
            None => return false,
        }
    }
    true
}

/// Past words that only soften.
fn skip_soft(clause: &[Token], mut at: usize) -> usize {
    while clause.get(at).is_some_and(|token| SKIP_SOFT_SOFT.has(token.word())) {
        at += 1;
    }
    at
}
