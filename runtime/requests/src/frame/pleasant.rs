//! What would be nice, with what is wanted as its subject: `the coke would hit the spot`, `the fridge closed would be lovely`,
//! `opening it would be a big help`; and what is only called for: `the coke, over here!`

use super::state::{State, state, words};
use crate::inflection::{Form, base};
use crate::noun::{Noun, noun};
use crate::spot::spot;
use crate::token::{Token, longest, run, stands};
use crate::verb::{begins, verb};

/// What is nice, behind `would be`.
const NICE: &[&str] = &[
    "a",
    "an",
    "the",
    "so",
    "very",
    "really",
    "most",
    "ever so",
    "just",
    "quite",
    "rather",
    "absolutely",
    "pretty",
    "real",
    "total",
    "nice",
    "great",
    "lovely",
    "good",
    "grand",
    "wonderful",
    "fantastic",
    "marvellous",
    "amazing",
    "awesome",
    "brilliant",
    "brill",
    "super",
    "excellent",
    "perfect",
    "ideal",
    "splendid",
    "handy",
    "useful",
    "helpful",
    "welcome",
    "appreciated",
    "much appreciated",
    "kind",
    "sweet",
    "cool",
    "delightful",
    "smashing",
    "ace",
    "fab",
    "fabulous",
    "terrific",
    "divine",
    "heavenly",
    "heaven",
    "bliss",
    "help",
    "big",
    "huge",
    "massive",
    "enormous",
    "tremendous",
    "relief",
    "treat",
    "blessing",
    "favour",
    "favor",
    "lifesaver",
    "kindness",
    "godsend",
    "the thing",
    "thing",
    "best",
    "my day",
    "for me",
    "for us",
    "of you",
    "to me",
    "to us",
    "right now",
    "now",
    "at the moment",
    "about now",
    "right about now",
    "please",
    "thanks",
    "thank you",
    "dear",
    "love",
    "indeed",
    "today",
    "too",
    "as well",
    "if possible",
    "of help",
    "all right",
    "okay",
    "ok",
    "fine",
];
/// The same as one verb, behind `would`.
const DOES: &[&str] = &[
    "hit the spot",
    "go down well",
    "go down a treat",
    "go down nicely",
    "go down very well",
    "do nicely",
    "do the trick",
    "do me nicely",
    "do me",
    "do me good",
    "do me fine",
    "do wonders",
    "do",
    "come in handy",
    "come in useful",
    "come in very handy",
    "help",
    "help me",
    "help a lot",
    "help me a lot",
    "help me out",
    "help me no end",
    "really help",
    "make my day",
    "make me happy",
    "make me very happy",
    "make life easier",
    "make my life easier",
    "suit me",
    "suit me fine",
    "save me",
    "save my life",
    "save my back",
    "save me a trip",
    "cheer me up",
    "work wonders",
    "be just the thing",
    "be just the ticket",
    "be just what i need",
    "be exactly what i need",
    "be music to my ears",
    "be very much appreciated",
    "be greatly appreciated",
    "not go amiss",
    "never go amiss",
    "mean a lot",
    "mean the world",
    "mean a lot to me",
    "mean the world to me",
    "please me",
    "please me no end",
    "be worth a lot",
];

/// What would be nice, as an imperative, and where its clause ends.
pub(super) fn pleasant(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    (begin + 1..tokens.len()).find_map(|at| {
        let end = at + nice(tokens, at)?;
        if end < tokens.len() {
            return None;
        }
        let wanted = said(tokens.get(begin..at)?)?;
        Some((wanted, end))
    })
}

/// `would be lovely`, `would come in handy`: how many words it takes.
fn nice(tokens: &[Token], at: usize) -> Option<usize> {
    let would = longest(
        tokens,
        at,
        &["would", "would really", "would certainly", "would sure", "would just", "might"],
    )?;
    let behind = [
        "right now",
        "now",
        "please",
        "about now",
        "right about now",
        "thanks",
        "thank you",
        "too",
        "at the moment",
    ];
    if let Some(count) = longest(tokens, at + would, DOES) {
        let end = at + would + count;
        return Some(end + run(tokens, end, &behind) - at);
    }
    let be = at + would + longest(tokens, at + would, &["be", "feel", "make", "be such"])?;
    let count = run(tokens, be, NICE);
    (count > 0).then_some(be + count - at)
}

/// What somebody names as nice, as what they ask for.
fn said(named: &[Token]) -> Option<Vec<Token>> {
    let first = named.first()?.word();
    // `opening it`, `you opening it`
    let doing = usize::from(first == "you" || first == "your");
    if let Some((verb, Form::Gerund)) = base(named.get(doing)?.word()) {
        let mut said = words(&verb);
        said.extend_from_slice(named.get(doing + 1..)?);
        if begins(&said, 0) {
            return Some(said);
        }
    }
    // `having the coke`, `to have the coke`, `a bit of help opening it`
    let having = longest(
        named,
        0,
        &[
            "having",
            "to have",
            "getting",
            "some help",
            "some help with",
            "a bit of help",
            "a hand",
            "help",
            "a little help",
        ],
    );
    if let Some((verb, Form::Gerund)) = having.and_then(|at| base(named.get(at)?.word())) {
        let mut said = words(&verb);
        said.extend_from_slice(named.get(having? + 1..)?);
        return begins(&said, 0).then_some(said);
    }
    let at = longest(named, 0, &["having", "to have", "getting"]).unwrap_or(0);
    let (thing, after) = noun(named, at)?;
    let Noun::Phrase(phrase) = &thing else { return None };
    if phrase.words.is_empty() || begins(named, at) {
        return None;
    }
    let what = named.get(at..after)?;
    if after == named.len() {
        return opened(what).or_else(|| Some([words("bring me").as_slice(), what].concat()));
    }
    let led = after + longest(named, after, &["back", "safely", "up", "over"]).unwrap_or(0);
    if longest(
        named,
        led,
        &["here", "over here", "with me", "here with me", "by my side", "beside me", "next to me"],
    )
    .is_some_and(|count| led + count == named.len())
    {
        return Some([words("bring me").as_slice(), what].concat());
    }
    if spot(named, led).is_some_and(|(_, end)| end == named.len()) {
        return Some([words("put").as_slice(), what, named.get(led..)?].concat());
    }
    let (found, end) = state(named, after, Form::Participle)?;
    let verb = match found {
        State::Done(verb) => verb,
        State::Open | State::Closed | State::At => return None,
    };
    Some([words(&verb).as_slice(), what, named.get(end..)?].concat())
}

/// `the fridge open`: a noun takes its adjective in.
fn opened(what: &[Token]) -> Option<Vec<Token>> {
    let (last, thing) = what.split_last()?;
    let verb = match last.word() {
        "open" => "open",
        "closed" | "shut" => "close",
        _ => return None,
    };
    Some([words(verb).as_slice(), thing].concat())
}

/// `the coke, over here!`, `the coke! Here!`: who calls for it wants to have it.
pub(super) fn called_for(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    let here = tokens.get(..limit)?;
    if verb(here, begin).is_some() {
        return None;
    }
    let (thing, after) = noun(here, begin)?;
    let Noun::Phrase(phrase) = thing else { return None };
    if phrase.words.is_empty() || phrase.place.is_some() {
        return None;
    }
    let mut at = after;
    at += run(tokens, at, &["please", "next", "now"]);
    if at < limit && stands(tokens, at, "over").is_none() && longest(tokens, at, &["here", "to me"]).is_none()
    {
        return None;
    }
    while matches!(tokens.get(at), Some(Token::Comma | Token::Stop)) {
        at += 1;
    }
    let hither = [
        "over here to me",
        "over here",
        "over to me",
        "here to me",
        "to me",
        "here",
        "right here",
        "to me here",
        "over here please",
        "here please",
        "this way",
        "into my hand",
        "in my hand",
        "into my hands",
        "to my side",
        "for me",
        "over to me please",
        "to me please",
        "here now",
        "to me now",
    ];
    let end = at + longest(tokens, at, &hither)?;
    let is_over = matches!(tokens.get(end), None | Some(Token::Comma | Token::Stop));
    is_over
        .then(|| ([words("bring me").as_slice(), tokens.get(begin..after).unwrap_or_default()].concat(), end))
}
