//! Whether somebody who was asked whether to try again says so, in whatever words: `give it another shot`, `it cannot hurt`.

use super::again::{AGAIN, WHOLE};
use super::assent::{AGREES, PLAIN};
use super::dissent::{BESIDE, DENIES, GIVES_UP};
use super::frame::SOUNDS;
use super::inflection::{Form, base};
use super::lead::skip_leads;
use super::token::{Token, longest, stands, tokens};
use super::verb::{Act, verb};

/// Whether an answer agrees to another try, and says nothing else that would have to be done or heeded: what it says beside
/// that, in words; none where it does not agree.
#[must_use]
pub fn encourages(answer: &str) -> Option<String> {
    let mut said = tokens(answer);
    // `uh huh` and `mm hm` agree.
    said.retain(|token| {
        let word = token.word();
        !SOUNDS.contains(&word) || matches!(word, "uh" | "huh" | "mm" | "hm")
    });
    let (mut agrees, mut beside) = (false, Vec::new());
    for clause in said.split(|token| matches!(token, Token::Comma | Token::Stop)) {
        let begin = skip_soft(clause, 0);
        if clause.get(begin..).is_none_or(<[Token]>::is_empty) {
            agrees |= (0..clause.len()).any(|at| longest(clause, at, AGREES).is_some());
            continue;
        }
        // `if you would, thank you`
        if WHOLE.iter().any(|words| stands(clause, begin, words) == Some(clause.len() - begin)) {
            agrees = true;
            continue;
        }
        let is_beside = longest(clause, begin, BESIDE).max(longest(clause, 0, BESIDE)).is_some();
        if !is_beside && (0..clause.len()).any(|at| longest(clause, at, GIVES_UP).is_some()) {
            return None;
        }
        let is_agreed = (0..clause.len())
            .any(|at| longest(clause, at, AGAIN).is_some() || longest(clause, at, AGREES).is_some())
            && is_plain(clause);
        // `I cannot do it myself` says why.
        let is_agreed = is_agreed && stands(clause, begin, "i can not").is_none();
        if let Some(left) = asks_again(clause).filter(|_| !is_agreed) {
            agrees = true;
            beside.extend(left);
            continue;
        }
        let is_denied = !is_beside
            && clause.iter().any(|token| DENIES.contains(&token.word()))
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

/// `can it?`
fn is_tag(clause: &[Token]) -> bool {
    let asks = ["can", "could", "will", "would", "is", "does", "shall"];
    matches!(clause, [ask, _] if asks.contains(&ask.word()))
}

/// Whether it takes back or bounds something, in words that are no part of what only sounds so.
fn negates(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        match longest(clause, at, BESIDE).max(longest(clause, at, WHOLE)) {
            Some(count) => at += count,
            None if matches!(token.word(), "no" | "not" | "never" | "if" | "without" | "nothing") => {
                return true;
            }
            None => at += 1,
        }
    }
    false
}

/// Whether a clause that asks for another try says nothing else that would have to be heeded: words that deny or bound it, or
/// another thing to do. What it says beside that, in words.
fn asks_again(clause: &[Token]) -> Option<Vec<&str>> {
    const TRIES: &[&str] = &[
        "again", "more", "another", "retry", "redo", "repeat", "second", "third", "trying", "over", "try",
        "once",
    ];
    // Who asks something, or tells what somebody did, asks for nothing.
    const TELLS: &[&str] = &[
        "what", "why", "who", "where", "when", "how", "which", "did", "does", "was", "were", "is", "has",
        "had", "he", "she", "they", "tried", "failed", "fell", "broke", "dropped", "myself", "somebody",
        "someone", "tomorrow", "tonight", "soon", "think",
    ];
    let (mut at, mut tries, mut left) = (0, false, Vec::new());
    while let Some(token) = clause.get(at) {
        let taken = [AGAIN, BESIDE, WHOLE].iter().filter_map(|table| longest(clause, at, table)).max();
        match taken {
            Some(count) => {
                let said = clause.get(at..at + count)?;
                tries |= said.iter().any(|token| TRIES.contains(&token.word()));
                at += count;
            }
            None if PLAIN.contains(&token.word()) || AGREES.contains(&token.word()) => at += 1,
            None if DENIES.contains(&token.word()) => return None,
            None if verb(clause, at)
                .is_some_and(|(act, _)| !matches!(act, Act::Go | Act::Come | Act::Move)) =>
            {
                return None;
            }
            None if TELLS.contains(&token.word()) => return None,
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

/// Whether a clause has no other words than those that agree.
fn is_plain(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        let taken =
            AGAIN.iter().chain(AGREES).chain(BESIDE).filter_map(|words| stands(clause, at, words)).max();
        match taken {
            Some(count) => at += count,
            None if PLAIN.contains(&token.word()) => at += 1,
            None => return false,
        }
    }
    true
}

/// Past words that only soften.
fn skip_soft(clause: &[Token], mut at: usize) -> usize {
    let soft = [
        "oh", "well", "um", "uh", "huh", "hmm", "and", "but", "so", "yes", "yeah", "sure", "okay", "ok",
        "please", "then", "dear",
    ];
    while clause.get(at).is_some_and(|token| soft.contains(&token.word())) {
        at += 1;
    }
    at
}
