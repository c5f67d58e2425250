//! What stands before a verb out of politeness, and what someone says who wants to have something.

use super::asking::asking;
use super::token::{Token, stands};
use super::wish::wish;
use crate::english::{ASKS_SOMEBODY, CONTRASTS, FAVOUR, LEADS, NO_LEADS, THANKS, VERB};

/// Where the request itself begins.
pub(super) fn skip_leads(tokens: &[Token], mut at: usize) -> usize {
    loop {
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

/// How many words of thanks and the like stand at a place.
pub(super) fn thanks(tokens: &[Token], at: usize) -> Option<usize> {
    if contrasts(tokens, at) {
        return None;
    }
    THANKS.longest(tokens, at)
}

/// `instead of the wrench`, `rather than there`: what follows is not wanted.
pub(super) fn contrasts(tokens: &[Token], at: usize) -> bool {
    CONTRASTS.longest(tokens, at).is_some()
}
