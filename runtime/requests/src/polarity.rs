//! Yes and no: the polarity of an answer's first words, words that stop a moving robot, and refusals.

use crate::engine::english::{
    ADDITIONS, ANSWER_COURTESY, ASKED_TO_STOP, HOLDS_STILL, IGNORANT, MOMENT, NO, PLACE_AFTER_STOP, PROCEEDS,
    REFUSALS, REPLACES, SEEKS, STOPS, STOPS_ALONE, WITHDRAWALS, YES,
};
use crate::engine::phrases::Phrases;
use crate::engine::token::{Token, pieces, tokens};

/// Polarity of the first words of an answer, with the remaining words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Polarity<'a> {
    /// Yes; the remaining words may say more.
    Yes(&'a str),
    /// No; the remaining words may name an alternative.
    No(&'a str),
    /// A refusal that ends the request, whatever follows: "don't try again", "stop, that is dangerous".
    Stop,
    /// The person does not know.
    Ignorant,
    /// None of the other polarities.
    Neither,
}

/// Reads the polarity of the first words. O(bytes).
///
/// ```
/// use motet_requests::{Polarity, polarity};
///
/// assert_eq!(polarity("no, the blue one"), Polarity::No(", the blue one"));
/// assert_eq!(polarity("stop at the table"), Polarity::Neither);
/// ```
#[must_use]
pub fn polarity(answer: &str) -> Polarity<'_> {
    let said = AnswerText::new(answer);
    let rest = said.skip_all(0, &ANSWER_COURTESY);
    if let Some(left) = said.skip(rest, &IGNORANT) {
        return if said.is_end(left) { Polarity::Ignorant } else { Polarity::Neither };
    }
    let asked = said.skip_all(said.skip_all(rest, &ASKED_TO_STOP), &ANSWER_COURTESY);
    let alone = said.skip(rest, &STOPS_ALONE).map(|left| said.skip_all(left, &ANSWER_COURTESY));
    if said.skips_no_place(asked, &STOPS) || alone.is_some_and(|left| said.is_end(left)) {
        return Polarity::Stop;
    }
    if let Some(left) = said.skip(rest, &NO) {
        let left = said.skip_all(said.skip_all(left, &NO), &ANSWER_COURTESY);
        return if said.skip(left, &STOPS).is_some() {
            Polarity::Stop
        } else {
            Polarity::No(said.from(left))
        };
    }
    if let Some(left) = said.skip(rest, &YES) {
        let left = said.skip_all(said.skip_all(left, &ANSWER_COURTESY), &YES);
        return Polarity::Yes(said.from(said.skip_all(left, &ANSWER_COURTESY)));
    }
    // A bare "please" agrees.
    let is_please = said.words.first().is_some_and(|first| first.word() == "please");
    if is_please && said.is_end(rest) { Polarity::Yes(said.from(rest)) } else { Polarity::Neither }
}

/// True if the words ask a moving robot to stop.
#[must_use]
pub fn stops(answer: &str) -> bool {
    match polarity(answer) {
        Polarity::Stop => true,
        Polarity::No(left) => is_wordless(left),
        Polarity::Yes(_) | Polarity::Ignorant | Polarity::Neither => false,
    }
}

/// True if the words ask a moving robot to keep still for a while: "wait", "hold on a second".
#[must_use]
pub fn holds(answer: &str) -> bool {
    is_whole(answer, &HOLDS_STILL, &MOMENT)
}

/// True if the words let a robot go on that keeps still: "go on", "ok, continue".
#[must_use]
pub fn proceeds(answer: &str) -> bool {
    let is_it = |said: &str| is_whole(said, &PROCEEDS, &MOMENT);
    // `ok, go on` agrees first.
    let agreed = answer.split_once(',').filter(|(first, _)| match polarity(first) {
        Polarity::Yes(rest) => is_wordless(rest),
        _ => false,
    });
    is_it(answer)
        || agreed.is_some_and(|(_, rest)| is_it(rest))
        || matches!(polarity(answer), Polarity::Yes(rest) if is_it(rest))
}

/// True if an answer is phrases of one list and then of another, with courtesy around them.
fn is_whole(answer: &str, phrases: &Phrases, behind: &Phrases) -> bool {
    let said = AnswerText::new(answer);
    let begin = said.skip_all(0, &ANSWER_COURTESY);
    said.skip(begin, phrases).is_some_and(|end| {
        let end = said.skip_all(said.skip_all(end, phrases), &ANSWER_COURTESY);
        said.is_end(said.skip_all(said.skip_all(end, behind), &ANSWER_COURTESY))
    })
}

/// Request inside an addition: "also bring me the apple".
#[must_use]
pub fn added(answer: &str) -> Option<&str> {
    let said = AnswerText::new(answer);
    let rest = said.from(said.skip(0, &ADDITIONS)?).trim_start_matches([',', ' ']);
    (!rest.is_empty()).then_some(rest)
}

/// Things inside a withdrawal: "without the apple".
#[must_use]
pub fn withdrawn(answer: &str) -> Option<&str> {
    let said = AnswerText::new(answer);
    let rest = said.from(said.skip(said.skip_all(0, &ANSWER_COURTESY), &WITHDRAWALS)?);
    let rest = rest.trim_start_matches([',', ' ']).trim_end_matches(['.', '!', ' ']);
    (!rest.is_empty()).then_some(rest)
}

/// True if a text has no word.
#[must_use]
pub fn is_wordless(text: &str) -> bool {
    AnswerText::new(text).is_end(0)
}

/// True if a text says somewhere that something cannot or will not be done.
#[must_use]
pub fn refuses(text: &str) -> bool {
    has(text, &REFUSALS)
}

/// True if a text asks to look for something: "find the spanner".
#[must_use]
pub fn seeks(text: &str) -> bool {
    has(text, &SEEKS)
}

/// True if a text says that it replaces what was asked for before: "the apple instead".
#[must_use]
pub fn replaces(text: &str) -> bool {
    has(text, &REPLACES)
}

fn has(text: &str, phrases: &Phrases) -> bool {
    let words = tokens(text);
    (0..words.len()).any(|at| phrases.longest(&words, at).is_some())
}

/// Words of an answer, without the marks between them.
struct AnswerText<'a> {
    text: &'a str,
    words: Vec<Token>,
    /// Offset in bytes behind each word.
    ends: Vec<usize>,
}

impl<'a> AnswerText<'a> {
    fn new(text: &'a str) -> Self {
        let (words, ends) = pieces(text).into_iter().filter(|(token, _)| !token.word().is_empty()).unzip();
        Self { text, words, ends }
    }

    fn is_end(&self, at: usize) -> bool {
        at >= self.words.len()
    }

    /// The text behind the words before a place.
    fn from(&self, at: usize) -> &'a str {
        let end = at.checked_sub(1).and_then(|last| self.ends.get(last));
        self.text.get(end.copied().unwrap_or_default()..).unwrap_or_default()
    }

    fn skip(&self, at: usize, phrases: &Phrases) -> Option<usize> {
        Some(at + phrases.longest(&self.words, at)?)
    }

    fn skip_all(&self, at: usize, phrases: &Phrases) -> usize {
        at + phrases.run(&self.words, at)
    }

    /// True if a phrase stands at a place and no place of the scene behind it: `stop`, but not `stop at`.
    fn skips_no_place(&self, at: usize, phrases: &Phrases) -> bool {
        self.skip(at, phrases).is_some_and(|left| PLACE_AFTER_STOP.longest(&self.words, left).is_none())
    }
}

#[cfg(test)]
mod tests {
    use super::{Polarity, added, holds, polarity, proceeds, refuses, stops};

    #[test]
    fn polarity_is_that_of_the_first_words() {
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
    fn stops_reads_words_for_a_moving_robot() {
        for said in ["stop", "never mind", "cancel that", "no!", "leave it, please"] {
            assert!(stops(said), "{said}");
        }
        for said in ["go on", "wait", "wait at the table", "bring me the apple", "no, the blue one", "thanks"]
        {
            assert!(!stops(said), "{said}");
        }
    }

    #[test]
    fn holds_and_proceeds_read_whole_answers() {
        for said in ["Wait!", "hold on a second, please", "just wait a moment", "freeze", "wait for me"] {
            assert!(holds(said) && !proceeds(said), "{said}");
        }
        for said in
            ["go on", "ok, go on please", "Continue.", "carry on", "you can go on now", "well, proceed"]
        {
            assert!(proceeds(said) && !holds(said), "{said}");
        }
        for said in
            ["wait at the table", "wait, bring me the apple", "go on the table", "yes", "go to the table", ""]
        {
            assert!(!holds(said) && !proceeds(said), "{said}");
        }
    }

    #[test]
    fn added_is_the_request_behind_the_addition() {
        assert_eq!(added("also bring me the apple"), Some("bring me the apple"));
        assert_eq!(added("android"), None);
    }

    #[test]
    fn refuses_finds_a_refusal_anywhere() {
        assert!(refuses("I\u{2019}m sorry, I can\u{2019}t do that.") && refuses("I am unable to lift it."));
        assert!(!refuses("Sure, I will bring the coke."));
    }
}
