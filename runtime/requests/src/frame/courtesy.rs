//! What is said to whom is asked and asks for nothing: `um`, `, love`, `, would you?`, `no hurry`.

use super::aside::{ASIDES, NAMES};
use super::haste::{APART, HASTE};
use super::tags::TAGS;
use crate::inflection::{Form, base};
use crate::lead::skip_leads;
use crate::noun::{Noun, noun};
use crate::token::{Token, longest, run, stands};
use crate::verb::begins;

/// Sounds that are made while thinking, wherever they stand.
pub(crate) const SOUNDS: &[&str] = &[
    "um", "umm", "uh", "uhm", "er", "erm", "hm", "hmm", "mm", "ugh", "ah", "aah", "oh", "ooh", "aw", "gosh",
    "phew", "whoa", "ahem", "huh", "oops", "blimey", "argh", "eh", "yuck", "ew", "eww", "yikes", "ouch",
    "yay", "wow", "oof", "jeez", "sheesh", "brr",
];
/// What is called before a name.
const CALLS: &[&str] = &[
    "hey", "hi", "hello", "oi", "yo", "ok", "okay", "thanks", "sorry", "please", "alright", "right",
    "listen", "there",
];

/// A request without them.
pub(crate) fn without_courtesy(tokens: &[Token]) -> Vec<Token> {
    let mut kept: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        // `bring, please, the coke`
        if token.word() == "please"
            && tokens.get(at + 1) == Some(&Token::Comma)
            && let [before @ .., verb, Token::Comma] = kept.as_slice()
            && is_mark(before.last())
            && matches!(base(verb.word()), Some((_, Form::Base)))
        {
            kept.pop();
            at += 2;
            continue;
        }
        if SOUNDS.contains(&token.word()) {
            at += 1;
            // `the coke, um, please`
            if is_mark(kept.last()) && tokens.get(at) == Some(&Token::Comma) {
                at += 1;
            }
            // `the, uh, coke`
            unbroken(&mut kept, tokens.get(at));
            continue;
        }
        if let Some(end) =
            aside(tokens, at, &kept).or_else(|| called(tokens, at, &kept)).or_else(|| tag(tokens, at, &kept))
        {
            // `the coke, if you would be so kind`: courtesy is all that says that it is wanted.
            if is_wanted(tokens.get(at..end).unwrap_or_default(), &kept) {
                kept.push(Token::Word("please".to_owned()));
            }
            at = end;
            unbroken(&mut kept, tokens.get(at));
            continue;
        }
        kept.push(token.clone());
        at += 1;
    }
    kept
}

/// Whether courtesy follows a bare noun.
fn is_wanted(courtesy: &[Token], kept: &[Token]) -> bool {
    let begs = |token: &Token| {
        matches!(
            token.word(),
            "please"
                | "kind"
                | "mind"
                | "grateful"
                | "trouble"
                | "bother"
                | "thanks"
                | "cheers"
                | "ta"
                | "obliged"
                | "appreciated"
                | "good"
        )
    };
    let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
    let begin = skip_leads(sentence, 0);
    courtesy.iter().any(begs)
        && !begins(sentence, 0)
        && matches!(noun(sentence, begin), Some((Noun::Phrase(_), end)) if end == sentence.len())
}

/// `could I, er, have`, `the, uh, coke`: a comma behind a word that does not end a clause was put around what was left out.
fn unbroken(kept: &mut Vec<Token>, next: Option<&Token>) {
    if let [.., word, Token::Comma] = kept.as_slice()
        && MIDDLE.contains(&word.word())
        && matches!(next, Some(Token::Word(_)))
    {
        kept.pop();
    }
}

/// Words behind which no clause ends.
const MIDDLE: &[&str] = &[
    "the", "a", "an", "my", "your", "our", "to", "in", "on", "into", "onto", "me", "i", "we", "could",
    "would", "maybe", "perhaps", "possibly", "and", "of", "for", "have", "need", "want", "with", "at", "by",
    "be", "if",
];

fn is_mark(token: Option<&Token>) -> bool {
    matches!(token, None | Some(Token::Comma | Token::Stop))
}

/// `, like,`: with the comma behind it.
fn aside(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let end = at + longest(tokens, at, ASIDES)?;
    // `and, like, put it there`
    let joins = kept.last().is_some_and(|token| matches!(token.word(), "and" | "so" | "but" | "then"))
        && longest(tokens, at, &["like", "you know", "i mean", "well"]).is_some();
    ((is_mark(kept.last()) || joins) && tokens.get(end) == Some(&Token::Comma)).then_some(end + 1)
}

/// `, love`, `hey buddy,`: whom somebody calls, with the comma before it.
fn called(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    longest(tokens, at + comma, NAMES)?;
    let end = at + comma + run(tokens, at + comma, NAMES);
    if !is_mark(tokens.get(end)) {
        return None;
    }
    // `milk, honey, and bread` names three things.
    let goes_on = tokens.get(end) == Some(&Token::Comma)
        && matches!(tokens.get(end + 1).map_or("", Token::word), "and" | "or");
    // `take it, dear, and do not let go`
    let is_thing = matches!(
        tokens.get(end - 1).map_or("", Token::word),
        "honey"
            | "duck"
            | "pet"
            | "treasure"
            | "machine"
            | "flower"
            | "sugar"
            | "pumpkin"
            | "hen"
            | "star"
            | "petal"
    );
    let is_clause =
        longest(tokens, end + 2, &["i", "we", "it", "you", "he", "she", "they", "there", "that", "do not"])
            .is_some();
    let goes_on = goes_on
        && !is_clause
        && (is_thing || (!begins(tokens, end + 2) && stands(tokens, end + 2, "do not").is_none()));
    let is_called = match kept.last() {
        _ if comma == 1 => !kept.is_empty() && !goes_on,
        None | Some(Token::Stop) => tokens.get(end).is_some(),
        Some(Token::Word(word)) => CALLS.contains(&word.as_str()),
        Some(Token::Comma) => false,
    };
    is_called.then_some(end)
}

/// `…, will you?`, `no hurry`: with the comma before it.
fn tag(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    // `…, and be quick about it`
    let and =
        stands(tokens, at + comma, "and").filter(|and| longest(tokens, at + comma + and, HASTE).is_some());
    if let Some(end) = and.and_then(|and| Some(at + comma + and + longest(tokens, at + comma + and, HASTE)?))
    {
        return (!kept.is_empty() && is_mark(tokens.get(end))).then_some(end);
    }
    let is_apart = comma == 1 || kept.last() == Some(&Token::Stop);
    let apart = longest(tokens, at + comma, APART).filter(|_| is_apart);
    let mut end = at + comma + longest(tokens, at + comma, TAGS).max(apart)?;
    // `would you mate`, `cheers love`
    end += longest(tokens, end, NAMES).filter(|count| is_mark(tokens.get(end + count))).unwrap_or(0);
    (!kept.is_empty() && is_mark(tokens.get(end))).then_some(end)
}
