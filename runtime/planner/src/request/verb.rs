//! The verbs of household requests.

use super::lead::{skip_leads, wish};
use super::token::{Token, longest, stands};

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

/// Verbs with their small words. Of two that fit the longer one counts. They stand in their classes after Levin, English
/// Verb Classes and Alternations (1993): motion (51), bringing (11), giving (13), holding (15), putting (9), removing (10).
pub(super) const VERBS: &[(&str, Act)] = &[
    ("go get", Act::Fetch),
    ("go and get", Act::Fetch),
    ("go fetch", Act::Fetch),
    ("go and fetch", Act::Fetch),
    ("go grab", Act::Fetch),
    ("go find", Act::Fetch),
    ("go and find", Act::Fetch),
    ("go pick up", Act::Pick),
    ("go", Act::Go),
    ("drive", Act::Go),
    ("navigate", Act::Go),
    ("head", Act::Go),
    ("walk", Act::Go),
    ("travel", Act::Go),
    ("proceed", Act::Go),
    ("visit", Act::Go),
    ("approach", Act::Go),
    ("run", Act::Go),
    ("step", Act::Go),
    ("wander", Act::Go),
    ("hurry", Act::Go),
    ("get over", Act::Go),
    ("get yourself", Act::Go),
    ("meet me", Act::Go),
    ("meet", Act::Go),
    ("join me", Act::Go),
    ("join us", Act::Go),
    ("meet us", Act::Go),
    ("stay", Act::Go),
    ("stop", Act::Go),
    ("find your way", Act::Go),
    ("make your way over", Act::Go),
    ("stand", Act::Go),
    ("wait", Act::Go),
    ("return to", Act::Go),
    ("roll", Act::Go),
    ("make your way", Act::Go),
    ("position yourself", Act::Go),
    ("move yourself", Act::Go),
    ("nip", Act::Go),
    ("nip over", Act::Go),
    ("pop over", Act::Go),
    ("pop across", Act::Go),
    ("pop along", Act::Go),
    ("pop round", Act::Go),
    ("hop", Act::Go),
    ("hop over", Act::Go),
    ("scoot", Act::Go),
    ("trot", Act::Go),
    ("dash", Act::Go),
    ("zip", Act::Go),
    ("scurry", Act::Go),
    ("stroll", Act::Go),
    ("toddle", Act::Go),
    ("trundle", Act::Go),
    ("waddle", Act::Go),
    ("march", Act::Go),
    ("swing by", Act::Go),
    ("make for", Act::Go),
    ("make a beeline for", Act::Go),
    ("make tracks for", Act::Go),
    ("set off", Act::Go),
    ("report", Act::Go),
    ("relocate yourself", Act::Go),
    ("work your way", Act::Go),
    ("take up position", Act::Go),
    ("take your place", Act::Go),
    ("see me", Act::Go),
    ("remain", Act::Go),
    ("convey", Act::Fetch),
    ("track down", Act::Find),
    ("hunt down", Act::Find),
    ("hunt for", Act::Find),
    ("seek out", Act::Find),
    ("reach", Act::Take),
    ("remove", Act::Take),
    ("clasp", Act::Pick),
    ("catch", Act::Pick),
    ("lower", Act::Put),
    ("ease", Act::Put),
    ("balance", Act::Put),
    ("slot", Act::Put),
    ("push", Act::Put),
    ("park", Act::Go),
    ("rush", Act::Go),
    ("zoom", Act::Go),
    ("speed", Act::Go),
    ("whizz", Act::Go),
    ("race", Act::Go),
    ("shuffle", Act::Go),
    ("amble", Act::Go),
    ("saunter", Act::Go),
    ("glide", Act::Go),
    ("cruise", Act::Go),
    ("journey", Act::Go),
    ("make haste", Act::Go),
    ("clear off", Act::Go),
    ("buzz off", Act::Go),
    ("be off", Act::Go),
    ("get going", Act::Go),
    ("get along", Act::Go),
    ("get moving", Act::Go),
    ("get close", Act::Go),
    ("get closer", Act::Go),
    ("move closer", Act::Go),
    ("go closer", Act::Go),
    ("go as far as", Act::Go),
    ("get to", Act::Go),
    ("get back to", Act::Go),
    ("follow me", Act::Go),
    ("take a trip", Act::Go),
    ("take a stroll", Act::Go),
    ("take a walk", Act::Go),
    ("go for a walk", Act::Go),
    ("get your wheels", Act::Go),
    ("bring yourself", Act::Go),
    ("be so good as to go", Act::Go),
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
    ("send", Act::Fetch),
    ("send over", Act::Fetch),
    ("bring along", Act::Fetch),
    ("bring over", Act::Fetch),
    ("reach me", Act::Fetch),
    ("reach for", Act::Pick),
    ("reach out for", Act::Pick),
    ("reach over for", Act::Pick),
    ("come back with", Act::Fetch),
    ("be back with", Act::Fetch),
    ("return with", Act::Fetch),
    ("carry", Act::Take),
    ("haul", Act::Take),
    ("lug", Act::Take),
    ("cart", Act::Take),
    ("nab", Act::Take),
    ("snatch", Act::Take),
    ("snag", Act::Take),
    ("scoop up", Act::Pick),
    ("snatch up", Act::Pick),
    ("gather up", Act::Pick),
    ("get your hands on", Act::Pick),
    ("lay your hands on", Act::Pick),
    ("hold onto", Act::Pick),
    ("hang onto", Act::Pick),
    ("cling to", Act::Pick),
    ("hold up", Act::Pick),
    ("keep holding", Act::Pick),
    ("keep holding on to", Act::Pick),
    ("keep holding onto", Act::Pick),
    ("keep carrying", Act::Pick),
    ("hoist", Act::Lift),
    ("take", Act::Take),
    ("grab", Act::Take),
    ("pick up", Act::Pick),
    ("pick", Act::Pick),
    ("grasp", Act::Pick),
    ("hold on to", Act::Pick),
    ("hang on to", Act::Pick),
    ("clutch", Act::Pick),
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
    ("keep", Act::Put),
    ("rest", Act::Put),
    ("stand up", Act::Put),
    ("slide", Act::Put),
    ("slip", Act::Put),
    ("tuck", Act::Put),
    ("pop", Act::Put),
    ("stash", Act::Put),
    ("stuff", Act::Put),
    ("hide", Act::Put),
    ("shove", Act::Put),
    ("dump", Act::Put),
    ("plonk", Act::Put),
    ("plonk down", Act::Put),
    ("plop", Act::Put),
    ("plunk", Act::Put),
    ("bung", Act::Put),
    ("whack", Act::Put),
    ("slap", Act::Put),
    ("settle", Act::Put),
    ("install", Act::Put),
    ("lodge", Act::Put),
    ("nestle", Act::Put),
    ("load", Act::Put),
    ("squeeze", Act::Put),
    ("sit", Act::Put),
    ("ditch", Act::Discard),
    ("scrap", Act::Discard),
    ("junk", Act::Discard),
    ("get shot of", Act::Discard),
    ("do away with", Act::Discard),
    ("fling out", Act::Discard),
    ("sling out", Act::Discard),
    ("fling", Act::Throw),
    ("sling", Act::Throw),
    ("lob", Act::Throw),
    ("pitch", Act::Throw),
    ("locate", Act::Find),
    ("find", Act::Find),
    ("look for", Act::Find),
    ("search for", Act::Find),
    ("have a look for", Act::Find),
    ("stow", Act::Store),
    ("store", Act::Store),
    ("put away", Act::Stow),
    ("put back", Act::Stow),
    ("clear", Act::Put),
    ("pack", Act::Put),
    ("pack away", Act::Stow),
    ("pack up", Act::Stow),
    ("file away", Act::Stow),
    ("lock away", Act::Store),
    ("shut away", Act::Store),
    ("stow away", Act::Store),
    ("store away", Act::Store),
    ("return", Act::Put),
    ("tidy up", Act::Stow),
    ("tidy away", Act::Stow),
    ("tidy", Act::Stow),
    ("clear away", Act::Stow),
    ("throw away", Act::Discard),
    ("throw out", Act::Discard),
    ("throw", Act::Throw),
    ("toss", Act::Throw),
    ("toss out", Act::Discard),
    ("toss away", Act::Discard),
    ("chuck", Act::Throw),
    ("chuck out", Act::Discard),
    ("discard", Act::Discard),
    ("dispose of", Act::Discard),
    ("trash", Act::Discard),
    ("bin", Act::Discard),
    ("recycle", Act::Discard),
    ("compost", Act::Discard),
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
    ("crack open", Act::Open),
    ("throw open", Act::Open),
    ("fling open", Act::Open),
    ("swing open", Act::Open),
    ("slide open", Act::Open),
    ("pop open", Act::Open),
    ("prop open", Act::Open),
    ("unlatch", Act::Open),
    ("close up", Act::Close),
    ("push shut", Act::Close),
    ("push to", Act::Close),
    ("pull shut", Act::Close),
    ("pull closed", Act::Close),
    ("swing shut", Act::Close),
    ("slide shut", Act::Close),
    ("slam", Act::Close),
    ("slam shut", Act::Close),
    ("seal", Act::Close),
    ("push closed", Act::Close),
];

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
    while let Some(count) = longest(
        tokens,
        end,
        &["nice", "good", "firm", "tight", "proper", "safe", "secure", "steady", "strong", "solid", "very"],
    ) {
        end += count;
    }
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
        || tokens.get(at).is_some_and(|token| token.word() == "to")
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
