//! Yes, no, and stop, at the beginning of what a person says.

use motet_requests::token::{self, Token};

/// Polarity of the first words of an answer, with the remaining words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Polarity<'a> {
    /// Yes; what follows may say more.
    Yes(&'a str),
    /// No; what follows may say what instead.
    No(&'a str),
    /// No, whatever follows: "don't try again", "stop, that is dangerous".
    Stop,
    /// The person does not know.
    Ignorant,
    /// None of these.
    Neither,
}

/// Words that agree.
const YES: &[&str] = &[
    "yes",
    "yeah",
    "yep",
    "yup",
    "sure",
    "of course",
    "absolutely",
    "definitely",
    "by all means",
    "sure thing",
    "go for it",
    "certainly",
    "ok",
    "okay",
    "alright",
    "all right",
    "please do",
    "do it",
    "do that",
    "go on",
    "go ahead",
    "carry on",
    "continue",
    "again",
    "retry",
    "try again",
    "try it again",
    "try once more",
    "once more",
    "one more time",
];
/// Words that decline what was offered.
const NO: &[&str] = &[
    "no",
    "nope",
    "nah",
    "never mind",
    "nevermind",
    "forget it",
    "forget about it",
    "forget that",
    "no thanks",
    "no thank you",
];
/// Words that end it.
const STOP: &[&str] = &[
    "stop",
    "halt",
    "cancel",
    "abort",
    "quit",
    "enough",
    "that is enough",
    "that is fine",
    "do not",
    "not now",
    "not again",
    "no more",
    "no way",
    "leave it",
    "leave that",
    "leave them",
    "give up",
    "skip it",
    "skip that",
    "neither",
    "none",
];
/// These end it only where nothing else is said.
const STOP_ALONE: &[&str] = &[
    "nothing",
    "nothing at all",
    "nobody",
    "leave",
    "skip",
    "i'll do it myself",
    "i will do it myself",
    "i'll do it",
    "i will do it",
];
/// Phrases that ask a moving robot to hold still.
const HOLD: &[&str] = &["wait", "hold on", "hold it", "freeze", "pause", "careful", "watch out", "look out"];
/// Words for not knowing.
const IGNORANT: &[&str] = &[
    "no idea",
    "no clue",
    "not sure",
    "i am not sure",
    "do not know",
    "i do not know",
    "i have no idea",
    "who knows",
];
/// Politeness, which says nothing.
const COURTESY: &[&str] =
    &["please", "thanks", "thank you", "oh", "well", "hm", "hmm", "then", "so", "just", "actually"];
/// Openings of a polite request to stop: "could you stop that".
const ASKING: &[&str] = &[
    "would you",
    "could you",
    "can you",
    "will you",
    "you can",
    "you may",
    "you could",
    "you should",
    "you must",
    "you would better",
    "you had better",
    "go ahead and",
    "i want you to",
    "i would like you to",
];
/// Behind `stop` and `leave it` these begin a place: "stop at the table".
const PLACES: &[&str] = &["at", "by", "in", "on", "near", "next", "beside", "behind", "with", "under"];

/// Reads the first words.
pub(super) fn polarity(said: &str) -> Polarity<'_> {
    let rest = skip_all(said, COURTESY);
    if let Some(left) = skip(rest, IGNORANT) {
        return if is_done(left) { Polarity::Ignorant } else { Polarity::Neither };
    }
    let asked = skip_all(skip_all(rest, ASKING), COURTESY);
    if skip(asked, STOP).is_some_and(|left| !begins_place(left)) {
        return Polarity::Stop;
    }
    if skip(rest, STOP_ALONE).is_some_and(|left| is_done(skip_all(left, COURTESY))) {
        return Polarity::Stop;
    }
    if let Some(mut left) = skip(rest, NO) {
        left = skip_all(skip_all(left, NO), COURTESY);
        return if skip(left, STOP).is_some() { Polarity::Stop } else { Polarity::No(left) };
    }
    if let Some(left) = skip(rest, YES) {
        return Polarity::Yes(skip_all(skip_all(skip_all(left, COURTESY), YES), COURTESY));
    }
    // A bare "please" agrees.
    if is_done(rest) && !is_done(said) && skip(said, &["please"]).is_some() {
        return Polarity::Yes(rest);
    }
    Polarity::Neither
}

/// Returns `true` if the words ask a moving robot to stop.
pub(super) fn stops(said: &str) -> bool {
    let rest = skip_all(said, COURTESY);
    skip(rest, HOLD).is_some_and(|left| !begins_place(left))
        || match polarity(said) {
            Polarity::Stop => true,
            Polarity::No(left) => is_done(left),
            Polarity::Yes(_) | Polarity::Ignorant | Polarity::Neither => false,
        }
}

/// Request inside an addition: "also bring me the apple".
pub(super) fn added(said: &str) -> Option<&str> {
    let rest = skip(said, &["also", "and also", "and then", "after that", "afterwards", "then", "and"])?;
    let rest = rest.trim_start_matches([',', ' ']);
    (!rest.is_empty()).then_some(rest)
}

fn begins_place(said: &str) -> bool {
    words(said).next().is_some_and(|(word, _)| PLACES.contains(&word.as_str()))
}

/// Returns `true` if no word is left to read.
pub(super) fn is_done(said: &str) -> bool {
    words(said).next().is_none()
}

/// Strips the longest matching phrase from the beginning.
fn skip<'a>(said: &'a str, phrases: &[&str]) -> Option<&'a str> {
    let behind = |phrase: &&str| {
        let mut said_words = words(said);
        let mut end = 0;
        for wanted in phrase.split(' ') {
            let (word, at) = said_words.next()?;
            if word != wanted {
                return None;
            }
            end = at;
        }
        Some(end)
    };
    phrases.iter().filter_map(behind).max().and_then(|end| said.get(end..))
}

/// The same as often as it goes.
fn skip_all<'a>(mut said: &'a str, phrases: &[&str]) -> &'a str {
    while let Some(left) = skip(said, phrases) {
        said = left;
    }
    said
}

/// The words, each with the offset behind it.
fn words(said: &str) -> impl Iterator<Item = (String, usize)> {
    token::pieces(said).into_iter().filter_map(|(token, end)| match token {
        Token::Word(word) => Some((word, end)),
        Token::Comma | Token::Stop => None,
    })
}

#[cfg(test)]
mod tests {
    use super::{Polarity, added, polarity, stops};

    #[test]
    fn the_first_words_tell() {
        for said in [
            "No, leave it alone!",
            "please don't",
            "no, don't",
            "no, that's enough",
            "Don’t try again",
            "stop it",
            "not now",
            "stop, that is dangerous!",
            "nothing, thanks",
            "leave it",
            "I'll do it myself",
            "would you stop that",
            "you can stop now, please",
            "go ahead and cancel it",
        ] {
            assert_eq!(polarity(said), Polarity::Stop, "{said}");
        }
        for (said, rest) in [
            ("nope", ""),
            ("no no", ""),
            ("nah, thanks", ""),
            ("no, the blue one", ", the blue one"),
            ("forget it, bring me the apple", ", bring me the apple"),
        ] {
            assert_eq!(polarity(said), Polarity::No(rest), "{said}");
        }
        for (said, rest) in [
            ("Yes.", "."),
            ("please", ""),
            ("ok, try again please", ""),
            ("sure, it is in the cupboard", ", it is in the cupboard"),
        ] {
            assert_eq!(polarity(said), Polarity::Yes(rest), "{said}");
        }
        assert_eq!(polarity("no idea"), Polarity::Ignorant);
        for said in [
            "no idea, I am sitting at the table",
            "wait a moment",
            "what?",
            "stop at the table",
            "would you stop by the table",
            "you can leave it on the table",
            "please bring me the cup",
        ] {
            assert_eq!(polarity(said), Polarity::Neither, "{said}");
        }
    }

    #[test]
    fn who_moves_is_told_to_stop() {
        for said in
            ["stop", "Wait!", "never mind", "cancel that", "hold on a second", "no!", "leave it, please"]
        {
            assert!(stops(said), "{said}");
        }
        for said in ["go on", "wait at the table", "bring me the apple", "no, the blue one", "thanks"] {
            assert!(!stops(said), "{said}");
        }
        assert_eq!(added("also bring me the apple"), Some("bring me the apple"));
        assert_eq!(added("android"), None);
    }
}
