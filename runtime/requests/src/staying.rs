//! Where the robot stays once it has done what it was asked for: `and wait there`.

use super::remark::is_boundary;
use super::token::{Token, longest, run};
use super::verb::Act;

/// What keeps open or shut what is.
const SO: &[&str] = &[
    "leave it like that",
    "leave it that way",
    "leave it so",
    "keep it like that",
    "keep it that way",
    "keep it so",
    "let it stay like that",
];

/// `just stay there with it`: where the robot is once it has done what it was asked for. Where it ends.
pub(super) fn stays_put(tokens: &[Token], begin: usize, before: Act) -> Option<usize> {
    // `take it in your hand and keep it there`, `drive there and then stop`
    let joined = begin.checked_sub(1).and_then(|at| tokens.get(at));
    // `close it, but leave it for now` takes it back.
    if joined.is_some_and(|token| token.word() == "but") {
        return None;
    }
    let is_joined = joined.is_some_and(|token| matches!(token.word(), "and" | "then"));
    let same: &[&str] = match before {
        Act::Pick | Act::Lift => &[
            "keep it there",
            "hold it there",
            "keep it",
            "keep hold of it",
            "keep holding it",
            "just keep it",
            "just hold it",
            "keep them",
            "keep it up",
            "keep it in the air",
            "hold on to it",
            "hang on to it",
            "hold it",
            "hold it tight",
        ],
        Act::Open => &["keep it open", "leave it open", "hold it open"],
        Act::Close => &["keep it shut", "leave it shut", "keep it closed", "leave it closed"],
        Act::Put | Act::Store | Act::Stow => {
            &["leave it there", "keep it there", "let it stay there", "leave it like that"]
        }
        Act::Go if is_joined => &["stop", "stop there"],
        _ => &[],
    };
    // `open it and leave it`; as a sentence of its own it may take back what was asked for.
    let left = ["leave it", "leave it be", "leave it alone", "let it be"];
    if is_joined
        && matches!(before, Act::Open | Act::Put | Act::Store | Act::Stow)
        && let Some(count) = longest(tokens, begin, &left)
        && is_boundary(tokens, begin + count)
    {
        return Some(begin + count);
    }
    let so: &[&str] = if matches!(before, Act::Open | Act::Close) { SO } else { &[] };
    if let Some(count) = longest(tokens, begin, same).max(longest(tokens, begin, so))
        && is_boundary(tokens, begin + count)
    {
        return Some(begin + count);
    }
    let awaits = [
        "await further instructions",
        "await instructions",
        "await my instructions",
        "await further orders",
        "await orders",
        "await my orders",
        "await my signal",
        "await my word",
    ];
    if let Some(count) = longest(tokens, begin, &awaits) {
        return is_boundary(tokens, begin + count).then_some(begin + count);
    }
    let stays = longest(
        tokens,
        begin,
        &[
            "stay",
            "wait",
            "stand by",
            "stand",
            "remain",
            "sit",
            "hang on",
            "hold on",
            "hold still",
            "stay put",
            "hang about",
        ],
    )?;
    let there = [
        "there",
        "put",
        "still",
        "where you are",
        "right where you are",
        "over there",
        "in place",
        "at the ready",
        "ready",
        "out of the way",
        "out of my way",
        "out of everyone's way",
        "out from under my feet",
        "clear",
    ];
    let mut at = begin + stays;
    let is_there = longest(tokens, at, &there);
    at += is_there.unwrap_or(0);
    let what_for = [
        "with it",
        "with them",
        "for me",
        "for us",
        "for now",
        "please",
        "for further instructions",
        "for more instructions",
        "for instructions",
        "for my instructions",
        "for further orders",
        "for orders",
        "for my orders",
        "for my signal",
        "for my word",
        "for my call",
        "for my command",
        "for what comes next",
        "for the next step",
        "for the next instruction",
        "for a bit",
        "a bit",
        "for me there",
        "there",
        "for me to come",
        "for me to tell you",
        "for me to say so",
        "holding it",
    ];
    let begins_for = at;
    at += run(tokens, at, &what_for);
    // `and wait` alone, behind what it waits with or where
    let is_waiting = is_there.is_some()
        || (matches!(before, Act::Pick | Act::Lift | Act::Go | Act::Take) && (at > begins_for || is_joined));
    if !is_waiting {
        return None;
    }
    is_boundary(tokens, at).then_some(at)
}
