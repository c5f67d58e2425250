//! What would be nice, asked for in a clause with `if`: `I would be ever so grateful if you brought me the coke`, `it would
//! help if the drawer were shut`.

use crate::english::{
    FAVOUR_BEGINS, FAVOUR_I, FAVOUR_WHO, FAVOUR_WORDS, FAVOUR_WOULD, TOLD_WHEN_DONE_DONE,
    TOLD_WHEN_DONE_TELLS,
};
use crate::inflection::{Form, base, of_past};
use crate::token::{Token, stands};
use crate::verb::begins;

/// Up to where the frame takes the place of what, and the words that do: a verb, or what sees to a state.
pub(super) fn favour(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let mut at = begin + FAVOUR_BEGINS.longest(tokens, begin)?;
    let nice = at;
    while tokens.get(at).is_some_and(|token| FAVOUR_WORDS.has(token.word())) {
        at += 1;
    }
    if at == nice && stands(tokens, begin, "is it").is_none() {
        return None;
    }
    at += stands(tokens, at, "if")?;
    let Some(who) = FAVOUR_WHO.longest(tokens, at) else {
        // `it would help if the drawer were shut`
        let is_told = tokens.get(at).is_some_and(|token| FAVOUR_I.has(token.word()));
        return (!is_told).then(|| (at, vec![Token::Word("ensure".to_owned())]));
    };
    at += who;
    at += FAVOUR_WOULD.run(tokens, at);
    let word = tokens.get(at)?.word();
    let verb = match base(word) {
        Some((verb, Form::Base)) => verb,
        _ => of_past(word)?,
    };
    Some((at + 1, vec![Token::Word(verb)]))
}

/// `… if you took it and brought it to me`: the verbs that follow the first of such a clause, in the form of requests.
pub(super) fn in_series(tokens: &mut [Token], mut at: usize) {
    while let Some(token) = tokens.get(at) {
        if *token == Token::Stop {
            break;
        }
        let is_joint = token.word() == "and";
        at += 1;
        if is_joint
            && let Some(verb) =
                tokens.get(at).and_then(|token| of_past(token.word()).or_else(|| doing(token.word())))
            && let Some(token) = tokens.get_mut(at)
        {
            *token = Token::Word(verb);
        }
    }
}

/// `… picking it up and hanging on to it`
fn doing(word: &str) -> Option<String> {
    base(word).filter(|(_, form)| *form == Form::Gerund).map(|(verb, _)| verb)
}

/// `let me know once you have put it there`: that it shall be done, and told.
pub(super) fn told_when_done(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let at = begin + TOLD_WHEN_DONE_TELLS.longest(tokens, begin)?;
    let at = at + TOLD_WHEN_DONE_DONE.longest(tokens, at)?;
    let (verb, form) = base(tokens.get(at)?.word())?;
    // `once you have put it there`: some participles are the verb itself.
    let is_done = form == Form::Participle || (form == Form::Base && of_past(&verb).is_some());
    is_done.then(|| (at + 1, vec![Token::Word(verb)]))
}

/// `do close it`: a request with weight.
pub(super) fn stressed(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    let at = begin + stands(tokens, begin, "do")?;
    let (_, form) = base(tokens.get(at)?.word())?;
    (form == Form::Base && begins(tokens, at)).then(|| (at, Vec::new()))
}
