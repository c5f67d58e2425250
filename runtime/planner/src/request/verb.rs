//! The verbs of household requests, and what stands before them out of politeness.

use super::token::Token;

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
    /// Throw away.
    Discard,
    /// Let go of.
    Release,
    /// Open.
    Open,
    /// Close.
    Close,
    /// Move: something to a place, or oneself.
    Move,
}

/// Verbs with their small words. Of two that fit the longer one counts.
const VERBS: &[(&str, Act)] = &[
    ("go get", Act::Fetch),
    ("go and get", Act::Fetch),
    ("go fetch", Act::Fetch),
    ("go and fetch", Act::Fetch),
    ("go grab", Act::Fetch),
    ("go find", Act::Fetch),
    ("go", Act::Go),
    ("drive", Act::Go),
    ("navigate", Act::Go),
    ("head", Act::Go),
    ("walk", Act::Go),
    ("travel", Act::Go),
    ("proceed", Act::Go),
    ("visit", Act::Go),
    ("approach", Act::Go),
    ("park", Act::Go),
    ("stand", Act::Go),
    ("wait", Act::Go),
    ("return to", Act::Go),
    ("return", Act::Put),
    ("roll", Act::Go),
    ("make your way", Act::Go),
    ("position yourself", Act::Go),
    ("move yourself", Act::Go),
    ("come", Act::Come),
    ("move", Act::Move),
    ("bring", Act::Fetch),
    ("fetch", Act::Fetch),
    ("get rid of", Act::Discard),
    ("get hold of", Act::Pick),
    ("get", Act::Fetch),
    ("give", Act::Fetch),
    ("hand", Act::Fetch),
    ("hand over", Act::Fetch),
    ("pass", Act::Fetch),
    ("deliver", Act::Fetch),
    ("serve", Act::Fetch),
    ("find me", Act::Fetch),
    ("retrieve", Act::Fetch),
    ("carry", Act::Take),
    ("take", Act::Take),
    ("take hold of", Act::Pick),
    ("grab", Act::Take),
    ("pick up", Act::Pick),
    ("pick", Act::Pick),
    ("grasp", Act::Pick),
    ("grip", Act::Pick),
    ("seize", Act::Pick),
    ("collect", Act::Take),
    ("hold", Act::Pick),
    ("lift", Act::Lift),
    ("raise", Act::Lift),
    ("put", Act::Put),
    ("place", Act::Put),
    ("set", Act::Put),
    ("lay", Act::Put),
    ("leave", Act::Put),
    ("transfer", Act::Put),
    ("relocate", Act::Put),
    ("shift", Act::Put),
    ("position", Act::Put),
    ("stick", Act::Put),
    ("deposit", Act::Put),
    ("drop off", Act::Put),
    ("insert", Act::Put),
    ("stow", Act::Stow),
    ("store", Act::Stow),
    ("put away", Act::Stow),
    ("put back", Act::Stow),
    ("tidy up", Act::Stow),
    ("tidy away", Act::Stow),
    ("tidy", Act::Stow),
    ("clear away", Act::Stow),
    ("throw away", Act::Discard),
    ("throw out", Act::Discard),
    ("throw", Act::Discard),
    ("toss", Act::Discard),
    ("toss out", Act::Discard),
    ("toss away", Act::Discard),
    ("chuck", Act::Discard),
    ("chuck out", Act::Discard),
    ("discard", Act::Discard),
    ("dispose of", Act::Discard),
    ("trash", Act::Discard),
    ("bin", Act::Discard),
    ("recycle", Act::Discard),
    ("compost", Act::Discard),
    ("dump", Act::Discard),
    ("release", Act::Release),
    ("let go of", Act::Release),
    ("drop", Act::Release),
    ("put down", Act::Release),
    ("set down", Act::Release),
    ("open", Act::Open),
    ("open up", Act::Open),
    ("pull open", Act::Open),
    ("close", Act::Close),
    ("shut", Act::Close),
    ("close up", Act::Close),
    ("push closed", Act::Close),
];

/// What may stand before a verb and asks for no more than that it is done. Longer ones first where one begins another.
const LEADS: &[&str] = &[
    "how would you",
    "how will you",
    "how do you",
    "how could you",
    "how can you",
    "could you",
    "can you",
    "would you be so kind as to",
    "would you be so kind to",
    "would you kindly",
    "would you please",
    "would you",
    "will you",
    "could i ask you to",
    "may i ask you to",
    "i want you to",
    "i need you to",
    "i would like you to",
    "i would love you to",
    "i ask you to",
    "you should",
    "you can",
    "you have to",
    "you need to",
    "go ahead and",
    "go on and",
    "be so kind as to",
    "be so kind and",
    "make sure to",
    "help me to",
    "help me",
    "let us",
    "hey robot",
    "hello robot",
    "robot",
    "hey",
    "hello",
    "hi",
    "excuse me",
    "please",
    "kindly",
    "quickly",
    "okay",
    "ok",
    "alright",
    "and",
    "so",
    "now",
    "just",
    "then",
    "after that",
    "afterwards",
    "next",
    "first",
    "finally",
    "also",
    "actually",
    "sorry",
    "instead",
];

/// What someone says who wants to have something.
const WANTS: &[&str] = &[
    "i would like to have",
    "i would like to get",
    "i would like",
    "i would love",
    "i want to have",
    "i want",
    "i need",
    "i could use",
    "i will have",
    "i will take",
    "could i have",
    "could i get",
    "can i have",
    "can i get",
    "may i have",
    "can we have",
    "could we have",
    "we need",
];

/// How many tokens words take at a place; none where they do not stand there.
pub(super) fn stands(tokens: &[Token], at: usize, words: &str) -> Option<usize> {
    let mut count = 0;
    for word in words.split(' ') {
        if tokens.get(at + count)?.word() != word {
            return None;
        }
        count += 1;
    }
    Some(count)
}

/// Where the request itself begins.
pub(super) fn skip_leads(tokens: &[Token], mut at: usize) -> usize {
    loop {
        let lead = LEADS.iter().filter_map(|lead| stands(tokens, at, lead)).max();
        match lead {
            Some(count) => at += count,
            None if matches!(tokens.get(at), Some(Token::Comma)) => at += 1,
            None => return at,
        }
    }
}

/// The verb that stands at a place, and where its object begins.
pub(super) fn verb(tokens: &[Token], at: usize) -> Option<(Act, usize)> {
    // `the table, trash can and shelf`: a noun, for want of an object.
    let next = tokens.get(at + 1).map_or("", Token::word);
    if matches!(tokens.get(at)?.word(), "trash" | "bin") && matches!(next, "" | "can" | "bin" | "bag" | "and")
    {
        return None;
    }
    let wants = WANTS.iter().filter_map(|want| Some((Act::Fetch, at + stands(tokens, at, want)?)));
    let verbs = VERBS.iter().filter_map(|(verb, act)| Some((*act, at + stands(tokens, at, verb)?)));
    verbs.chain(wants).max_by_key(|(_, after)| *after)
}

/// Whether a request begins here, after what politeness puts before it.
pub(super) fn begins(tokens: &[Token], at: usize) -> bool {
    verb(tokens, skip_leads(tokens, at)).is_some()
}
