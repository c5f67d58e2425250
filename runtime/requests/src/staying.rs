//! Where the robot stays once it has done what it was asked for: `and wait there`.

use super::remark::is_boundary;
use super::token::Token;
use super::verb::Act;
use crate::english::{
    KEEPS_SO, KEPT_HOLD, KEPT_OPEN, KEPT_SHUT, KEPT_THERE, STAYS_PUT_AWAITS, STAYS_PUT_LEFT, STAYS_PUT_STAY,
    STAYS_PUT_THERE, STAYS_PUT_WHAT_FOR, STOPS_THERE,
};

/// `just stay there with it`: where the robot is once it has done what it was asked for. Where it ends.
pub(super) fn stays_put(tokens: &[Token], begin: usize, before: Act) -> Option<usize> {
    // `take it in your hand and keep it there`, `drive there and then stop`
    let joined = begin.checked_sub(1).and_then(|at| tokens.get(at));
    // `close it, but leave it for now` takes it back.
    if joined.is_some_and(|token| token.word() == "but") {
        return None;
    }
    let is_joined = joined.is_some_and(|token| matches!(token.word(), "and" | "then"));
    let same = match before {
        Act::Pick | Act::Lift => KEPT_HOLD.longest(tokens, begin),
        Act::Open => KEPT_OPEN.longest(tokens, begin).max(KEEPS_SO.longest(tokens, begin)),
        Act::Close => KEPT_SHUT.longest(tokens, begin).max(KEEPS_SO.longest(tokens, begin)),
        Act::Put | Act::Store | Act::Stow => KEPT_THERE.longest(tokens, begin),
        Act::Go if is_joined => STOPS_THERE.longest(tokens, begin),
        _ => None,
    };
    // `open it and leave it`; as a sentence of its own it may take back what was asked for.
    if is_joined
        && matches!(before, Act::Open | Act::Put | Act::Store | Act::Stow)
        && let Some(count) = STAYS_PUT_LEFT.longest(tokens, begin)
        && is_boundary(tokens, begin + count)
    {
        return Some(begin + count);
    }
    if let Some(count) = same
        && is_boundary(tokens, begin + count)
    {
        return Some(begin + count);
    }
    if let Some(count) = STAYS_PUT_AWAITS.longest(tokens, begin) {
        return is_boundary(tokens, begin + count).then_some(begin + count);
    }
    let stays = STAYS_PUT_STAY.longest(tokens, begin)?;
    let mut at = begin + stays;
    let is_there = STAYS_PUT_THERE.longest(tokens, at);
    at += is_there.unwrap_or(0);
    let begins_for = at;
    at += STAYS_PUT_WHAT_FOR.run(tokens, at);
    // `and wait` alone, behind what it waits with or where
    let is_waiting = is_there.is_some()
        || (matches!(before, Act::Pick | Act::Lift | Act::Go | Act::Take) && (at > begins_for || is_joined));
    if !is_waiting {
        return None;
    }
    is_boundary(tokens, at).then_some(at)
}
