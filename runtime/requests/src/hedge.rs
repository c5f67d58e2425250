//! How sure somebody is of what they say, and when they last knew: `I am fairly sure that`, `chances are`, `last I checked`.

use super::token::{Token, stands};
use crate::english::{HEDGE, MAY_BE, TOLD_SUBJECTS};

/// The number of words of it that stand before what is told.
pub(super) fn before(tokens: &[Token], at: usize) -> Option<usize> {
    // `it might be in the fridge` tells it itself.
    let follows = |count: &usize| tokens.get(at + count).is_some_and(|token| TOLD_SUBJECTS.has(token.word()));
    let count = HEDGE.longest(tokens, at).max(MAY_BE.longest(tokens, at).filter(follows))?;
    let stands = |words: &str| stands(tokens, at + count, words);
    // `I am sure that is it` points at something.
    let points = stands("that is").is_some() && stands("that is in").is_none();
    let that = stands("is that").or_else(|| stands("that")).filter(|_| !points);
    Some(count + that.unwrap_or(0))
}
