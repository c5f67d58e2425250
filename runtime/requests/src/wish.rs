//! What somebody says who wants to have something: `I could do with`, `I'd quite fancy having`, `any chance I might get`.

use super::asking::before_speaker;
use super::token::{Token, longest, run};
use super::wanting::{HAVE, HOW, MAY_I, NEEDS, TO_HAVE, WANTS, WOULD};

/// How many words a wish takes at a place, behind which stands what somebody wants to have.
pub(super) fn wish(tokens: &[Token], at: usize) -> Option<usize> {
    let asked = longest(tokens, at, MAY_I).and_then(|may| Some(may + longest(tokens, at + may, HAVE)?));
    // `would it be possible to have the coke`, `any chance of the coke`
    let have = [
        "would it be possible to have",
        "would it be possible to get",
        "is it possible to have",
        "any chance of having",
        "any chance of",
    ];
    let chance = longest(tokens, at, &have).filter(|count| {
        !tokens.get(at + count).is_some_and(|token| token.word() == "you" || token.word().ends_with("ing"))
    });
    let found = longest(tokens, at, WANTS).max(asked).max(chance);
    found
        .max(cleft(tokens, at))
        .max(wants(tokens, at))
        .max(curt(tokens, at))
        .max(happier(tokens, at))
        .max(may_have(tokens, at))
}

/// `what I need in my hand right now is`
fn cleft(tokens: &[Token], at: usize) -> Option<usize> {
    let what = [
        "what",
        "all",
        "the thing",
        "the only thing",
        "the one thing",
        "one thing",
        "all that",
        "the thing that",
        "the very thing",
    ];
    let who = at + longest(tokens, at, &what)?;
    let end = who + wants(tokens, who)?;
    let now = [
        "in my hand",
        "in my hands",
        "over here",
        "here",
        "most",
        "most of all",
        "next",
        "now",
        "with me",
        "beside me",
        "by my side",
        "more than anything",
        "at the moment",
        "today",
        "for this",
        "for that",
        "from you",
        "just",
        "in here",
        "badly",
        "first",
    ];
    let end = end + run(tokens, end, &now);
    Some(end + longest(tokens, end, &["is", "would be", "is to have"])? - at)
}

/// `I'd quite like to have`, `we could really use`
fn wants(tokens: &[Token], at: usize) -> Option<usize> {
    let who = longest(tokens, at, &["i", "we", "me", "all i", "this old lady", "this old man"])?;
    let how = run(tokens, at + who, HOW);
    let verb = at + who + how;
    let said = tokens.get(at..verb)?;
    // `I did not want`, `I do not want` are no wishes: the `not` stands in no table but with what it asks for.
    let is_would = said.iter().any(|token| matches!(token.word(), "would" | "could" | "should"));
    let would = longest(tokens, verb, WOULD).filter(|_| is_would);
    let end = verb + longest(tokens, verb, NEEDS).max(would)?;
    Some(end + longest(tokens, end, TO_HAVE).unwrap_or(0) - at)
}

/// `need the coke`, `could do with a drink`: without who wants it, as somebody says in a hurry.
fn curt(tokens: &[Token], at: usize) -> Option<usize> {
    let before = at.checked_sub(1).and_then(|at| tokens.get(at));
    let begins = matches!(before, None | Some(Token::Comma | Token::Stop))
        || before
            .is_some_and(|token| matches!(token.word(), "please" | "hey" | "so" | "robot" | "and" | "just"));
    let words = [
        "need",
        "really need",
        "just need",
        "badly need",
        "want",
        "would like",
        "would love",
        "could use",
        "could do with",
        "could really do with",
        "could really use",
        "would not mind",
        "would not say no to",
        "going to need",
        "desperate for",
        "dying for",
        "gasping for",
        "in need of",
        "in desperate need of",
        "require",
        "requiring",
        "needing",
        "wanting",
        "fancy having",
    ];
    longest(tokens, at, &words).filter(|_| begins)
}

/// `I'd feel safer with`, `it would be nicer to have`: what is wanted is told behind it.
fn happier(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end = at
        + longest(
            tokens,
            at,
            &["i would", "we would", "it would", "it will", "that would", "it is", "would it"],
        )?;
    let begin = end;
    let how = [
        "be",
        "feel",
        "sleep",
        "rest",
        "look",
        "work",
        "a lot",
        "a bit",
        "much",
        "far",
        "so much",
        "so",
        "even",
        "really",
        "very",
        "all",
        "the",
        "most",
        "happier",
        "safer",
        "better",
        "easier",
        "calmer",
        "nicer",
        "neater",
        "tidier",
        "more comfortable",
        "more at ease",
        "comfortable",
        "happy",
        "glad",
        "great",
        "lovely",
        "good",
        "nice",
        "wonderful",
        "grand",
        "handy",
        "useful",
        "helpful",
        "perfect",
        "ideal",
        "fantastic",
        "brilliant",
        "delighted",
        "pleased",
        "grateful",
        "best",
        "possible",
        "okay",
        "ok",
        "dead",
        "for me",
        "for us",
        "a relief",
        "a great help",
        "a big help",
        "a help",
        "a treat",
        "prefer it",
        "like it best",
        "like it better",
        "love it",
    ];
    end += run(tokens, end, &how);
    if end == begin {
        return None;
    }
    Some(end + longest(tokens, end, &["with", "having", "to have", "to see", "to get"])? - at)
}

/// `is there any way I might have`, `could I perhaps get`, `can we please be given`
fn may_have(tokens: &[Token], at: usize) -> Option<usize> {
    let end = at + before_speaker(tokens, at)?;
    let have = [
        "have",
        "get",
        "borrow",
        "be given",
        "be handed",
        "be passed",
        "be brought",
        "have back",
        "get back",
        "get hold of",
        "trouble you for",
        "bother you for",
        "ask you for",
        "pester you for",
        "beg you for",
        "get my hands on",
        "take delivery of",
        "hold",
    ];
    Some(end + longest(tokens, end, &have)? - at)
}
