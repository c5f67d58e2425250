//! Words before a request: what politeness puts before its verb, indirect requests (`I was wondering whether
//! you might possibly`), and wishes to have something (`I could do with`, `any chance I might get`).
//!
//! Words of wishing, thinking and politeness lead up to who is asked and the modal verb; none of them denies
//! or bounds anything. Those that do, `not`, `unless`, `when`, are no part of it but in a few phrases that
//! ask for the contrary of what they say.

use crate::engine::english::{
    ASKS_SOMEBODY, BEFORE_CURT, CONTRASTS, CURT_WISHES, DOUBTS, FAVOUR, LEADS, MAY_HAVE, MINDING, NO_LEADS,
    OVERTURES, SOFTENERS, THANKS, VERB, WISH, WISH_HAVE,
};
use crate::engine::rule::Rules;
use crate::engine::token::{Token, stands};

/// The number of words that ask somebody for something; what is asked for stands behind.
fn asking(tokens: &[Token], at: usize) -> Option<usize> {
    behind_overtures(tokens, at, "asks")
}

/// The number of words with which somebody asks whether they may: `could I maybe`, `any chance that we
/// might`.
fn before_speaker(tokens: &[Token], at: usize) -> Option<usize> {
    behind_overtures(tokens, at, "asks_whether")
}

/// The number of words of what leads up to what some rules read, the last of it, and what softens it.
fn behind_overtures(tokens: &[Token], at: usize, rules: &'static str) -> Option<usize> {
    let (mut end, mut last, mut facts) = (at, None, Vec::new());
    loop {
        last = Rules(rules).knowing(tokens, end, &facts).map(|found| found.end).or(last);
        // `I can get it` tells, `I wonder if I might get it` asks.
        facts.extend(DOUBTS.longest(tokens, end).map(|_| "doubted"));
        match OVERTURES.longest(tokens, end) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + SOFTENERS.run(tokens, end) - at)
}

/// The ends of words of wishing, thinking and politeness that stand one behind another.
pub(crate) fn overtures(tokens: &[Token], at: usize) -> Vec<usize> {
    let next = |end: &usize| {
        let count = OVERTURES.longest(tokens, *end).max(MINDING.longest(tokens, *end))?;
        Some(end + count)
    };
    std::iter::successors(Some(at), next).skip(1).collect()
}

/// Counts how many words a wish takes at a place, behind which stands what somebody wants to have.
pub(crate) fn wish(tokens: &[Token], at: usize) -> Option<usize> {
    // `would it be possible to have the coke`, `any chance of the coke`
    let chance = WISH_HAVE.longest(tokens, at).filter(|count| {
        !tokens.get(at + count).is_some_and(|token| token.word() == "you" || token.word().ends_with("ing"))
    });
    WISH.longest(tokens, at).max(chance).max(curt(tokens, at)).max(may_have(tokens, at))
}

/// `need the coke`, `could do with a drink`: without who wants it, as somebody says in a hurry.
fn curt(tokens: &[Token], at: usize) -> Option<usize> {
    let before = at.checked_sub(1).and_then(|at| tokens.get(at));
    let begins = matches!(before, None | Some(Token::Comma | Token::Stop))
        || before.is_some_and(|token| BEFORE_CURT.has(token.word()));
    CURT_WISHES.longest(tokens, at).filter(|_| begins)
}

/// `is there any way I might have`, `could I perhaps get`, `can we please be given`
fn may_have(tokens: &[Token], at: usize) -> Option<usize> {
    let end = at + before_speaker(tokens, at)?;
    Some(end + MAY_HAVE.longest(tokens, end)? - at)
}

/// Finds where the request itself begins.
pub(crate) fn skip_leads(tokens: &[Token], mut at: usize) -> usize {
    loop {
        // Of a row of commas only the last stands before something.
        let rest = tokens.get(at..).unwrap_or_default();
        let commas = rest.iter().take_while(|token| matches!(token, Token::Comma)).count();
        at += commas.saturating_sub(1);
        if contrasts(tokens, at) {
            return at;
        }
        // `you know what to do` asks for nothing, `no need to` and `gonnae no` for the contrary.
        let knows = NO_LEADS.longest(tokens, at).is_some();
        let lead = LEADS
            .longest(tokens, at)
            .max(ASKS_SOMEBODY.longest(tokens, at))
            .max(asking(tokens, at))
            .filter(|_| !knows)
            // `do me a favour by opening it` is read with its verb.
            .or_else(|| {
                FAVOUR.longest(tokens, at).filter(|count| stands(tokens, at + count, "by").is_none())
            });
        // `let us have the coke` is a wish, and no `let us`.
        let want = wish(tokens, at);
        // `hang on to it` is no `hang on`.
        let verb = VERB.longest(tokens, at);
        match lead.filter(|lead| want.max(verb).is_none_or(|longer| longer <= *lead)) {
            Some(count) => at += count,
            None if matches!(tokens.get(at), Some(Token::Comma)) => at += 1,
            None => return at,
        }
    }
}

/// Counts how many words of thanks and the like stand at a place.
pub(crate) fn thanks(tokens: &[Token], at: usize) -> Option<usize> {
    if contrasts(tokens, at) {
        return None;
    }
    THANKS.longest(tokens, at)
}

/// `instead of the wrench`, `rather than there`: what follows is not wanted.
pub(crate) fn contrasts(tokens: &[Token], at: usize) -> bool {
    CONTRASTS.longest(tokens, at).is_some()
}
