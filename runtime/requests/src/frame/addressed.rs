//! Requests that say who shall do it, as people do who speak the language little, and children: `you bring it to me`, `the
//! fridge, you close`. What is told of the one that is spoken to, `you always close it`, stays as it is.

use super::clause::cause;
use super::state::words;
use crate::english::{HABIT_WORDS, SAME_PASTS, TOLD_YOU_FOR_WHOM, TOLD_YOU_GO};
use crate::inflection::{Form, base};
use crate::lead::skip_leads;
use crate::noun::noun;
use crate::spot::{is_way, spot};
use crate::token::{Token, stands};
use crate::verb::verb;

/// Up to where `you` and its verb stand, and the verb, with `it` where nothing else says of what.
pub(super) fn told_you(tokens: &[Token], begin: usize) -> Option<(usize, Vec<Token>)> {
    // `you can give me` was passed over as far as the verb.
    let is_led = begin.checked_sub(2).is_some_and(|at| stands(tokens, at, "you can").is_some());
    let at = match stands(tokens, begin, "you") {
        Some(count) => begin + count,
        None if is_led => begin,
        None => return None,
    };
    let is_end = |token: &Token| matches!(token, Token::Comma | Token::Stop);
    let end = (at..tokens.len()).find(|at| tokens.get(*at).is_some_and(is_end)).unwrap_or(tokens.len());
    let here = tokens.get(..end)?;
    let word = here.get(at)?.word();
    let said = here.get(at..)?.split(|token| matches!(token.word(), "and" | "but" | "so")).next()?;
    if said.iter().any(|token| HABIT_WORDS.has(token.word())) {
        return None;
    }
    let sentence = here.get(..begin)?.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
    let asks = here.iter().skip(begin).chain(tokens.get(end..).unwrap_or_default().iter().take(2));
    let is_series = here.get(..begin)?.iter().any(|token| token.word() == "and")
        || verb(sentence, skip_leads(sentence, 0)).is_some()
        || sentence.iter().chain(asks).any(|token| token.word() == "please");
    if SAME_PASTS.has(word) && !is_series {
        return None;
    }
    // `you make open for me`
    if word == "make" {
        let is_state = here.get(at + 1).is_some_and(|next| matches!(next.word(), "open" | "closed" | "shut"));
        return match (is_state, cause(here, at)) {
            (true, _) => Some((at + 1, words("make it"))),
            (false, Some(_)) => Some((at, Vec::new())),
            (false, None) => None,
        };
    }
    let (_, form) = base(word)?;
    if form != Form::Base {
        return None;
    }
    let (_, after) = verb(here, at)?;
    let is_moving = TOLD_YOU_GO.has(word);
    let mut next = after;
    while let Some(count) = TOLD_YOU_FOR_WHOM.longest(here, next) {
        next += count;
    }
    let has_place = spot(here, next).is_some() || is_way(here, next);
    let has_thing = noun(here, next).is_some();
    if is_moving || (has_thing && !has_place) {
        return (at > begin).then(|| (at, Vec::new()));
    }
    // `you give me`, `you throw away`, `you put on the sink`
    let is_joint = here.get(next).is_none_or(|token| matches!(token.word(), "and" | "then"));
    if !(is_joint || has_place) {
        return None;
    }
    let mut said = here.get(at..after)?.to_vec();
    let gets = said.len() == 1 && here.get(after).is_some_and(|token| matches!(token.word(), "me" | "us"));
    let until = if gets { after + 1 } else { after };
    said.extend_from_slice(here.get(after..until)?);
    said.extend(words("it"));
    Some((until, said))
}
