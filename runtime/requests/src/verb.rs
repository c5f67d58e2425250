//! The verbs of household requests.

use super::lead::skip_leads;
use super::lexicon::VERBS;
use super::token::{Token, longest, run, stands};
use super::wish::wish;

/// What is asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Act {
    /// Go somewhere.
    Go,
    /// Come to the person.
    Come,
    /// Bring something to someone.
    Fetch,
    /// Take into the hand.
    Pick,
    /// Raise in the hand.
    Lift,
    /// Put somewhere.
    Put,
    /// Take: to a place, or into the hand.
    Take,
    /// Put where it belongs.
    Stow,
    /// Put into something in which things are kept.
    Store,
    /// Throw away.
    Discard,
    /// Throw: to a place, to someone, or away.
    Throw,
    /// Let go of.
    Release,
    /// Open.
    Open,
    /// Close.
    Close,
    /// Move: something to a place, or oneself.
    Move,
    /// Find out where something is.
    Find,
}

/// The verb that stands at a place, and where its object begins.
pub(super) fn verb(tokens: &[Token], at: usize) -> Option<(Act, usize)> {
    // `the table, trash can and shelf`: a noun, for want of an object.
    let next = tokens.get(at + 1).map_or("", Token::word);
    if matches!(tokens.get(at)?.word(), "trash" | "bin") && matches!(next, "" | "can" | "bin" | "bag" | "and")
    {
        return None;
    }
    // `take care of it` says nothing of what to do with it.
    let vague = [
        "take care",
        "take a look",
        "hold on a",
        "set about",
        "get ready",
        "come to think",
        "run out",
        "pass by",
    ];
    if longest(tokens, at, &vague).is_some() {
        return None;
    }
    let wants = wanted(tokens, at).map(|after| (Act::Fetch, after));
    let verbs = VERBS.iter().filter_map(|(verb, act)| Some((*act, at + stands(tokens, at, verb)?)));
    let holds = hold(tokens, at).map(|after| (Act::Pick, after));
    verbs.chain(wants).chain(holds).max_by_key(|(_, after)| *after)
}

/// Where what somebody wants to have begins, where they want it now.
fn wanted(tokens: &[Token], at: usize) -> Option<usize> {
    let after = at + wish(tokens, at)?;
    // `I will need it later` tells of another time.
    let is_end = |token: &&Token| {
        matches!(token, Token::Comma | Token::Stop)
            || matches!(token.word(), "and" | "so" | "but" | "because")
    };
    let clause = tokens.get(after..)?.iter().take_while(|token| !is_end(token));
    let is_later = clause.clone().any(|token| {
        matches!(
            token.word(),
            "later" | "tomorrow" | "tonight" | "afterwards" | "soon" | "gone" | "eventually"
        )
    });
    (!is_later && !is_no_thing(tokens, after)).then_some(after)
}

/// `get a firm grip on`, `keep a tight hold of`, `close your hand around`: where what is held begins.
fn hold(tokens: &[Token], at: usize) -> Option<usize> {
    let hand = [
        "close your hand",
        "close your hands",
        "close your gripper",
        "close your fingers",
        "wrap your hand",
        "wrap your fingers",
        "wrap your gripper",
        "put your hand",
        "put your hands",
        "lay your hands",
    ];
    if let Some(count) = longest(tokens, at, &hand) {
        return Some(at + count + longest(tokens, at + count, &["around", "round", "on", "about"])?);
    }
    let takes =
        longest(tokens, at, &["get", "take", "keep", "grab", "catch", "have", "maintain", "hold", "hang"])?;
    let mut end = at + takes;
    if longest(tokens, at, &["hold", "hang"]).is_some() {
        // `hold on tight to it`
        end += stands(tokens, end, "on").unwrap_or(0);
        end +=
            longest(tokens, end, &["tight", "fast", "firm", "good and tight", "really tight", "very tight"])?;
        return Some(end + longest(tokens, end, &["to", "onto"])?);
    }
    end += longest(tokens, end, &["a", "your"]).unwrap_or(0);
    end += run(
        tokens,
        end,
        &["nice", "good", "firm", "tight", "proper", "safe", "secure", "steady", "strong", "solid", "very"],
    );
    end += longest(tokens, end, &["grip", "hold", "grasp"])?;
    Some(end + longest(tokens, end, &["on to", "on", "of", "onto"])?)
}

/// What somebody wants to do, or wants of somebody, and does not want to have: `to open it`, `your help`.
fn is_no_thing(tokens: &[Token], at: usize) -> bool {
    let whose =
        matches!(tokens.get(at).map_or("", Token::word), "your" | "some" | "a" | "more" | "any" | "the");
    let what = tokens.get(at + usize::from(whose)).map_or("", Token::word);
    let is_undone = tokens.get(at).is_some_and(|token| matches!(token.word(), "something" | "anything"))
        && tokens.get(at + 1).is_some_and(|token| {
            matches!(token.word(), "done" | "about" | "sorted" | "out" | "from" | "in" | "inside")
        });
    // `I would like to get into the drawer`
    let is_way_in = tokens.get(at).is_some_and(|token| {
        matches!(
            token.word(),
            "rid" | "into" | "in" | "at" | "inside" | "through" | "out" | "past" | "by" | "started" | "going"
        )
    });
    is_undone
        || is_way_in
        || tokens.get(at).is_some_and(|token| matches!(token.word(), "to" | "you"))
        || matches!(
            what,
            "help"
                | "hand"
                | "look"
                | "chat"
                | "peek"
                | "think"
                | "seat"
                | "assistance"
                | "advice"
                | "favor"
                | "favour"
                | "word"
                | "break"
                | "rest"
                | "room"
                | "space"
        )
}

/// Whether it is a wish that stands here, and no verb.
pub(super) fn is_want(tokens: &[Token], at: usize) -> bool {
    wanted(tokens, at).is_some()
}

/// Whether a request begins here, after what politeness puts before it.
pub(super) fn begins(tokens: &[Token], at: usize) -> bool {
    verb(tokens, skip_leads(tokens, at)).is_some()
}
