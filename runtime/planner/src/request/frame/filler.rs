//! Words of a request that say how or when it is convenient, and not what: they are left out.

use crate::request::token::{Token, stands};

/// Words that say how or when and not what.
const FILLERS: &[&str] = &[
    "right now",
    "right away",
    "any more",
    "anymore",
    "really",
    "simply",
    "maybe",
    "perhaps",
    "possibly",
    "carefully",
    "gently",
    "straight away",
    "at once",
    "at some point",
    "at your convenience",
    "for a moment",
    "for a second",
    "for a minute",
    "for a while",
    "for a bit",
    "for now",
    "in the meantime",
];

/// A request without them.
pub(super) fn without_fillers(tokens: &[Token]) -> Vec<Token> {
    let mut kept = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        if let Some(count) = FILLERS.iter().filter_map(|filler| stands(tokens, at, filler)).max() {
            at += count;
        } else if let Some(count) = tag(tokens, at).or_else(|| leisure(tokens, at)) {
            at += count;
        } else {
            kept.extend(tokens.get(at).cloned());
            at += 1;
        }
    }
    kept
}

/// `…, will you?`: how many words the question at the end takes.
fn tag(tokens: &[Token], at: usize) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    let ask = ["will you please", "would you please", "will you", "would you", "can you", "could you"];
    let count = comma + ask.iter().find_map(|ask| stands(tokens, at + comma, ask))?;
    (at > 0 && matches!(tokens.get(at + count), None | Some(Token::Stop))).then_some(count)
}

/// `when you get a moment`, `if it is not too much trouble`: how many words it takes.
fn leisure(tokens: &[Token], at: usize) -> Option<usize> {
    const LEISURE: &[&str] = &[
        "when", "whenever", "if", "once", "as", "soon", "you", "get", "got", "have", "find", "can", "could",
        "are", "would", "not", "too", "much", "trouble", "is", "it", "a", "the", "some", "spare", "free",
        "moment", "minute", "second", "time", "chance", "ready", "able", "so", "kind", "do", "mind", "like",
    ];
    let subject = |begin: &str| stands(tokens, at, &format!("{begin} you"));
    let count = ["when", "whenever", "if", "once", "as soon as"].iter().find_map(|begin| subject(begin));
    let count = count.or_else(|| stands(tokens, at, "if it is not"))?;
    let mut end = at + count;
    while tokens.get(end).is_some_and(|token| LEISURE.contains(&token.word())) {
        end += 1;
    }
    let is_whole = matches!(tokens.get(end), None | Some(Token::Stop | Token::Comma));
    (is_whole && end > at + count).then_some(end - at)
}
