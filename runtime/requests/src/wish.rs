//! What somebody says who wants to have something: `I could do with`, `I'd quite fancy having`, `any chance I might get`.

use super::asking::before_speaker;
use super::token::Token;
use crate::english::{BEFORE_CURT, CURT_WISHES, MAY_HAVE, WISH, WISH_HAVE};

/// How many words a wish takes at a place, behind which stands what somebody wants to have.
pub(super) fn wish(tokens: &[Token], at: usize) -> Option<usize> {
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
