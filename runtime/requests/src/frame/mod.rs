//! Sentences that ask without an imperative, said as imperatives: `I need the fridge open` is `open the fridge`, `could the
//! coke be brought to me` is `bring the coke to me`. What is framed otherwise stays as it is.
//!
//! The frames are constructions with places for nouns, after Goldberg, Constructions (1995): a predicate of place or state
//! (`X belongs in Y`, `I want X shut`), a passive, a causative (`get X open`), a wish, and what politeness puts before them.

mod addressed;
mod clause;
mod courtesy;
mod delegate;
mod favour;
mod filler;
mod leisure;
mod placed;
mod pleasant;
mod room;
mod state;
mod unwrap;

use self::addressed::told_you;
use self::clause::clause;
pub(super) use self::courtesy::without_courtesy;
pub(super) use self::delegate::asks_for_it;
use self::delegate::{delegated, elliptic};
use self::favour::{favour, in_series};
use self::filler::without_fillers;
use self::placed::wanted_there;
use self::unwrap::unwrapped;
use super::asking::in_another_form;
use super::lead::skip_leads;
use super::token::Token;
use crate::english::{PLAIN_AND, POSSESSED_IN, POSSESSED_PLACE_IS, POSSESSED_USUAL};

/// Behind a verb of opening or closing: only where it is not so already, which has to be seen first.
pub(super) const ONLY_IF_SO: &str = "if it is open";

/// A request with its frames said plainly.
pub(super) fn plain(tokens: &[Token]) -> Vec<Token> {
    // What is left out may stand between other words that are.
    // `I cannot open it, could you?` has to be read before courtesy is left out.
    let tokens = elliptic(&possessed(tokens));
    let mut tokens = without_courtesy(&without_fillers(&without_courtesy(&tokens)));
    tokens = delegated(&tokens);
    let mut said = Vec::with_capacity(tokens.len());
    let (mut at, mut starts, mut begins_sentence) = (0, true, true);
    // Every rewriting takes words away or goes on behind what it wrote: the bound only guards against a slip of that.
    let mut left = tokens.len() * 4 + 16;
    while at < tokens.len() && left > 0 {
        left -= 1;
        if starts {
            let begin = skip_leads(&tokens, at);
            if let Some((from, words)) = told_you(&tokens, begin).or_else(|| wanted_there(&tokens, begin)) {
                tokens.splice(begin..from, words);
                continue;
            }
            if let Some((from, verb)) = in_another_form(&tokens, begin) {
                tokens.splice(begin..from, [Token::Word(verb)]);
                in_series(&mut tokens, begin);
                continue;
            }
            if let Some((from, words)) = unwrapped(&tokens, begin) {
                tokens.splice(begin..from, words);
                continue;
            }
            if let Some((from, words)) = favour(&tokens, begin) {
                tokens.splice(begin..from, words);
                in_series(&mut tokens, begin);
                continue;
            }
            if let Some((words, after)) = clause(&tokens, begin, begins_sentence) {
                // A comma before a clause that takes the place of a statement stays one.
                said.extend(words);
                (at, starts, begins_sentence) = (after, false, false);
                continue;
            }
        }
        let Some(token) = tokens.get(at) else { break };
        let joins = matches!(token, Token::Comma | Token::Stop) || PLAIN_AND.has(token.word());
        begins_sentence = *token == Token::Stop || (begins_sentence && starts && is_lead(&tokens, at));
        starts = joins;
        said.push(token.clone());
        at += 1;
    }
    said
}

/// Whether something begins here that politeness puts before a request.
fn is_lead(tokens: &[Token], at: usize) -> bool {
    skip_leads(tokens, at) > at
}

/// `the sponge's place is in the drawer`: it belongs there.
fn possessed(tokens: &[Token]) -> Vec<Token> {
    let mut said: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        at += 1;
        let whose = token.word().strip_suffix("'s").filter(|whose| !whose.is_empty());
        let how = POSSESSED_USUAL.longest(tokens, at).unwrap_or(0);
        let place = POSSESSED_PLACE_IS
            .longest(tokens, at + how)
            .filter(|count| POSSESSED_IN.longest(tokens, at + how + count).is_some());
        match (whose, place) {
            (Some(whose), Some(count)) => {
                said.push(Token::Word(whose.to_owned()));
                said.push(Token::Word("belongs".to_owned()));
                at += how + count;
            }
            _ => said.push(token.clone()),
        }
    }
    said
}
