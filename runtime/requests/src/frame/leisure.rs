//! When it suits who is asked: `when you get a moment`, `if it is not too much trouble`.

use crate::english::{LEISURE_ARE_DONE, LEISURE_HAVE, LEISURE_STARTS, LEISURE_WORDS};
use crate::inflection::{Form, base};
use crate::token::Token;

/// `when you get a moment`, `if it is not too much trouble`, `when you are done with that`: how many words it takes.
pub(super) fn leisure(tokens: &[Token], at: usize) -> Option<usize> {
    let count = LEISURE_STARTS.longest(tokens, at)?;
    let mut end = at + count;
    if let Some(done) = LEISURE_ARE_DONE.longest(tokens, end) {
        end += done;
        // What it is done with may be another task, which is not asked for; `done putting the mug away` asks for more.
        while tokens.get(end).is_some_and(|token| !token.word().is_empty() && !is_task(token.word())) {
            end += 1;
        }
    }
    while tokens.get(end).is_some_and(|token| LEISURE_WORDS.has(token.word())) {
        end += 1;
    }
    let is_whole = matches!(tokens.get(end), None | Some(Token::Stop | Token::Comma));
    // `when you come back, have it with you` asks for it.
    let has = tokens.get(end) == Some(&Token::Comma) && LEISURE_HAVE.longest(tokens, end + 1).is_some();
    (is_whole && end > at + count && !has).then_some(end - at)
}

/// Whether a word is a verb of requests, in any form.
pub(super) fn is_task(word: &str) -> bool {
    base(word).is_some_and(|(_, form)| matches!(form, Form::Base | Form::Gerund | Form::Participle))
}
