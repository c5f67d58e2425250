//! What is said to whom is asked and asks for nothing: `um`, `, love`, `, would you?`, `no hurry`.

use crate::english::{
    APART_TAGS, ASIDE_LIKE, ASIDES, CALLED_HONEY, CALLED_I, CALLS, ENDEARMENTS, HASTE, INNER_WORDS,
    IS_WANTED_PLEASE, SOUNDS, TAGS,
};
use crate::inflection::{Form, base};
use crate::lead::skip_leads;
use crate::noun::{Noun, noun};
use crate::token::{Token, stands};
use crate::verb::begins;

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
        if SOUNDS.has(token.word()) {
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
    let begs = |token: &Token| IS_WANTED_PLEASE.has(token.word());
    let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
    let begin = skip_leads(sentence, 0);
    courtesy.iter().any(begs)
        && !begins(sentence, 0)
        && matches!(noun(sentence, begin), Some((Noun::Phrase(_), end)) if end == sentence.len())
}

/// `could I, er, have`, `the, uh, coke`: a comma behind a word that does not end a clause was put around what was left out.
fn unbroken(kept: &mut Vec<Token>, next: Option<&Token>) {
    if let [.., word, Token::Comma] = kept.as_slice()
        && INNER_WORDS.has(word.word())
        && matches!(next, Some(Token::Word(_)))
    {
        kept.pop();
    }
}

fn is_mark(token: Option<&Token>) -> bool {
    matches!(token, None | Some(Token::Comma | Token::Stop))
}

/// `, like,`: with the comma behind it.
fn aside(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let end = at + ASIDES.longest(tokens, at)?;
    // `and, like, put it there`
    let joins = kept.last().is_some_and(|token| matches!(token.word(), "and" | "so" | "but" | "then"))
        && ASIDE_LIKE.longest(tokens, at).is_some();
    ((is_mark(kept.last()) || joins) && tokens.get(end) == Some(&Token::Comma)).then_some(end + 1)
}

/// `, love`, `hey buddy,`: whom somebody calls, with the comma before it.
fn called(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    ENDEARMENTS.longest(tokens, at + comma)?;
    let end = at + comma + ENDEARMENTS.run(tokens, at + comma);
    if !is_mark(tokens.get(end)) {
        return None;
    }
    // `milk, honey, and bread` names three things.
    let goes_on = tokens.get(end) == Some(&Token::Comma)
        && matches!(tokens.get(end + 1).map_or("", Token::word), "and" | "or");
    // `take it, dear, and do not let go`
    let is_thing = CALLED_HONEY.has(tokens.get(end - 1).map_or("", Token::word));
    let is_clause = CALLED_I.longest(tokens, end + 2).is_some();
    let goes_on = goes_on
        && !is_clause
        && (is_thing || (!begins(tokens, end + 2) && stands(tokens, end + 2, "do not").is_none()));
    let is_called = match kept.last() {
        _ if comma == 1 => !kept.is_empty() && !goes_on,
        None | Some(Token::Stop) => tokens.get(end).is_some(),
        Some(Token::Word(word)) => CALLS.has(word.as_str()),
        Some(Token::Comma) => false,
    };
    is_called.then_some(end)
}

/// `…, will you?`, `no hurry`: with the comma before it.
fn tag(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let comma = usize::from(tokens.get(at) == Some(&Token::Comma));
    // `…, and be quick about it`
    let and =
        stands(tokens, at + comma, "and").filter(|and| HASTE.longest(tokens, at + comma + and).is_some());
    if let Some(end) = and.and_then(|and| Some(at + comma + and + HASTE.longest(tokens, at + comma + and)?)) {
        return (!kept.is_empty() && is_mark(tokens.get(end))).then_some(end);
    }
    let is_apart = comma == 1 || kept.last() == Some(&Token::Stop);
    let apart = APART_TAGS.longest(tokens, at + comma).filter(|_| is_apart);
    let mut end = at + comma + TAGS.longest(tokens, at + comma).max(apart)?;
    // `would you mate`, `cheers love`
    end += ENDEARMENTS.longest(tokens, end).filter(|count| is_mark(tokens.get(end + count))).unwrap_or(0);
    (!kept.is_empty() && is_mark(tokens.get(end))).then_some(end)
}
