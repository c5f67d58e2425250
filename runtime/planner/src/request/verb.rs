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
    /// Find out where something is.
    Find,
}

/// Verbs with their small words. Of two that fit the longer one counts. They stand in their classes after Levin, English
/// Verb Classes and Alternations (1993): motion (51), bringing (11), giving (13), holding (15), putting (9), removing (10).
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
    ("run", Act::Go),
    ("step", Act::Go),
    ("wander", Act::Go),
    ("hurry", Act::Go),
    ("get over", Act::Go),
    ("get yourself", Act::Go),
    ("meet me", Act::Go),
    ("meet us", Act::Go),
    ("stay", Act::Go),
    ("stop", Act::Go),
    ("find your way", Act::Go),
    ("make your way over", Act::Go),
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
    ("grab hold of", Act::Pick),
    ("keep hold of", Act::Pick),
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
    ("locate", Act::Find),
    ("find", Act::Find),
    ("look for", Act::Find),
    ("search for", Act::Find),
    ("have a look for", Act::Find),
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
    "could you please",
    "could you maybe",
    "could you also",
    "could you",
    "can you",
    "would you be able to",
    "are you able to",
    "is it possible for you to",
    "would it be possible for you to",
    "would it be possible to",
    "is it possible to",
    "do you think you could",
    "do you think you can",
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
    "i was wondering if you could",
    "i was wondering whether you could",
    "i wonder if you could",
    "i wonder whether you could",
    "i would appreciate it if you could",
    "i would appreciate it if you would",
    "i would appreciate it if you",
    "i would be grateful if you could",
    "i would be grateful if you would",
    "i would be glad if you could",
    "i would be happy if you could",
    "it would be great if you could",
    "it would be great if you would",
    "it would be great if you",
    "it would be nice if you could",
    "it would be nice if you would",
    "it would be nice if you",
    "it would be lovely if you could",
    "it would be lovely if you",
    "it would be good if you could",
    "it would be good if you",
    "it would be kind if you",
    "it would help if you could",
    "it would help if you",
    "is there any chance that you could",
    "is there any chance you could",
    "any chance that you could",
    "any chance you could",
    "any chance you can",
    "if you could",
    "if you would",
    "if you can",
    "i think you should",
    "you may",
    "you could",
    "you might",
    "you must",
    "you will have to",
    "your task is to",
    "your job is to",
    "it is time to",
    "feel free to",
    "remember to",
    "do not forget to",
    "do me a favor and",
    "do me a favour and",
    "do me a favor",
    "do me a favour",
    "be a dear and",
    "be a darling and",
    "be a good robot and",
    "be nice and",
    "be kind and",
    "you know what",
    "no",
    "no wait",
    "hang on",
    "on second thought",
    "on second thoughts",
    "listen",
    "look here",
    "good morning",
    "good evening",
    "oh",
    "well",
    "right",
    "great",
    "um",
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
    "i could do with",
    "i will need",
    "i am going to need",
    "i feel like having",
    "i feel like",
    "i fancy having",
    "i fancy",
    "i would love to have",
    "i would love to get",
    "i would like to get hold of",
    "i would not mind having",
    "i would not mind",
    "i want to get",
    "i wish to have",
    "i wish for",
    "i am after",
    "let me have",
    "let us have",
    "let me get",
    "may we have",
    "may i get",
    "might i have",
    "could i please have",
    "can i please have",
    "may i please have",
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

/// How a verb is inflected.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Form {
    /// `put`
    Base,
    /// `putting`
    Gerund,
    /// `brought`
    Participle,
}

/// Participles that no rule makes.
const PARTICIPLES: &[(&str, &str)] = &[
    ("brought", "bring"),
    ("taken", "take"),
    ("thrown", "throw"),
    ("given", "give"),
    ("held", "hold"),
    ("left", "leave"),
    ("kept", "keep"),
    ("laid", "lay"),
    ("stuck", "stick"),
    ("hidden", "hide"),
    ("found", "find"),
    ("slid", "slide"),
];

/// A verb of a request by one of its forms.
pub(super) fn base(word: &str) -> Option<(String, Form)> {
    if let Some((_, verb)) = PARTICIPLES.iter().find(|(known, _)| *known == word) {
        return Some(((*verb).to_owned(), Form::Participle));
    }
    let mut verbs = VERBS.iter().filter_map(|(verb, _)| verb.split(' ').next());
    verbs.find_map(|verb| {
        let form = if verb == word {
            Form::Base
        } else if has_ending(word, verb, "ing") {
            Form::Gerund
        } else if has_ending(word, verb, "ed") {
            Form::Participle
        } else {
            return None;
        };
        Some((verb.to_owned(), form))
    })
}

/// Whether a word is a verb with an ending: `fetching`, `placing`, `putting`, `carried`.
fn has_ending(word: &str, verb: &str, ending: &str) -> bool {
    let Some(stem) = word.strip_suffix(ending) else { return false };
    let doubled = || {
        let last = verb.chars().last();
        stem.strip_prefix(verb).is_some_and(|rest| rest.chars().count() == 1 && rest.chars().last() == last)
    };
    let without_e = || verb.strip_suffix('e') == Some(stem);
    let with_i =
        || ending == "ed" && verb.strip_suffix('y').is_some_and(|y| stem.strip_suffix('i') == Some(y));
    stem == verb || doubled() || without_e() || with_i()
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
