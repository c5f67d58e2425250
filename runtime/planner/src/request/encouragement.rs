//! Whether somebody who was asked whether to try again says so, in whatever words: `give it another shot`, `it cannot hurt`.

use super::assent::{AGAIN, AGREES, PLAIN, WHOLE};
use super::dissent::{BESIDE, DENIES, GIVES_UP};
use super::lead::skip_leads;
use super::token::{Token, longest, stands, tokens};
use super::verb::verb;

/// Whether an answer agrees to another try, and says nothing else that would have to be done or heeded: what it says beside
/// that, in words; none where it does not agree.
#[must_use]
pub fn encourages(answer: &str) -> Option<String> {
    let said = tokens(answer);
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
        let is_beside = longest(clause, begin, BESIDE).is_some();
        if !is_beside && (0..clause.len()).any(|at| longest(clause, at, GIVES_UP).is_some()) {
            return None;
        }
        let is_agreed = (0..clause.len())
            .any(|at| longest(clause, at, AGAIN).is_some() || longest(clause, at, AGREES).is_some())
            && is_plain(clause);
        // `I cannot do it myself` says why.
        let is_agreed = is_agreed && stands(clause, begin, "i can not").is_none();
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

fn negates(clause: &[Token]) -> bool {
    clause.iter().any(|token| matches!(token.word(), "no" | "not" | "never" | "if" | "without" | "nothing"))
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
