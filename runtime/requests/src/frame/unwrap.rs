//! Frames around one imperative, taken off: `would you mind`, `go over and`, `my wife wants you to`.

use super::clause::cause;
use super::favour::{stressed, told_when_done};
use super::state;
use crate::english::{
    APART_VERBS, ASKS_FOR_GERUND, GOES_FOR, RELAYED_I, RELAYED_MODALS, RELAYS, SETS_OUT, UNWRAPPED_AND,
    UNWRAPPED_COMING, UNWRAPPED_GETS, UNWRAPPED_GOT, UNWRAPPED_HAVE, UNWRAPPED_LET_ME_INTO,
    UNWRAPPED_ONCE_YOU_HAVE, UNWRAPPED_OVER, UNWRAPPED_RATHER, UNWRAPPED_SOMEBODY, UNWRAPPED_THERE,
    UNWRAPPED_WITH_YOU, WANTS_YOU_TO,
};
use crate::inflection::{Form, base, of_past};
use crate::noun::{Noun, noun};
use crate::token::{Token, stands};
use crate::verb::{Act, begins, verb};

/// A frame around an imperative: what stands for the tokens up to where.
pub(super) fn unwrapped(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let mind = ASKS_FOR_GERUND.longest(tokens, at);
    if let Some(count) = mind
        && let Some((verb, Form::Gerund)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    if let Some(found) = told_when_done(tokens, at).or_else(|| stressed(tokens, at)) {
        return Some(found);
    }
    // `when you come back to me, have it with you`
    if let Some(count) = UNWRAPPED_COMING.longest(tokens, at) {
        let mut have = at + count + UNWRAPPED_OVER.run(tokens, at + count);
        have += usize::from(tokens.get(have) == Some(&Token::Comma));
        have += UNWRAPPED_AND.longest(tokens, have).unwrap_or(0);
        if let Some(has) = UNWRAPPED_HAVE.longest(tokens, have)
            && let Some((_, after)) = noun(tokens, have + has)
            && let Some(with) = UNWRAPPED_WITH_YOU.longest(tokens, after)
        {
            let mut said = state::words("bring me");
            said.extend_from_slice(tokens.get(have + has..after)?);
            return Some((after + with, said));
        }
    }
    // `would you mind going to get it`
    if let Some(count) = stands(tokens, at, "go to").or_else(|| stands(tokens, at, "go over to"))
        && let "get" | "fetch" | "grab" | "bring" | "pick" | "open" | "close" | "shut" =
            tokens.get(at + count)?.word()
    {
        return Some((at + count, Vec::new()));
    }
    // `I would rather you waited at the sink`
    if let Some(count) = UNWRAPPED_RATHER.longest(tokens, at) {
        let word = tokens.get(at + count)?.word();
        if matches!(word, "were" | "was") {
            return Some((at + count + 1, state::words("go")));
        }
        let verb = base(word).filter(|(_, form)| *form == Form::Base).map(|(verb, _)| verb);
        return Some((at + count + 1, vec![Token::Word(verb.or_else(|| of_past(word))?)]));
    }
    // `once you have opened it, …`
    if let Some(count) = UNWRAPPED_ONCE_YOU_HAVE.longest(tokens, at)
        && let Some((verb, Form::Participle)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    // `once you have got hold of it, …`
    if let Some(count) = UNWRAPPED_GOT.longest(tokens, at) {
        return Some((at + count, state::words("get hold of")));
    }
    // `off you trot to the sink`
    if let Some(count) = stands(tokens, at, "off you")
        && let Some((Act::Go, after)) = verb(tokens, at + count)
        && matches!(tokens.get(after)?.word(), "to" | "over" | "across")
    {
        return Some((at + count, Vec::new()));
    }
    // `Daddy says you have to bring it`, `my wife wants you to close it`
    if let Some(count) = relayed(tokens, at) {
        return Some((at + count, Vec::new()));
    }
    // `somebody bring me the coke!`
    if let Some(count) = UNWRAPPED_SOMEBODY.longest(tokens, at)
        && let Some((verb, Form::Base)) = tokens.get(at + count).and_then(|token| base(token.word()))
        && (of_past(&verb).is_none()
            || tokens
                .get(at..)
                .unwrap_or_default()
                .iter()
                .take_while(|token| **token != Token::Stop)
                .any(|token| token.word() == "please"))
        && begins(tokens, at + count)
    {
        return Some((at + count, Vec::new()));
    }
    // `let me into the drawer`
    if let Some(count) = UNWRAPPED_LET_ME_INTO.longest(tokens, at)
        && let Some((Noun::Phrase(_), after)) = noun(tokens, at + count)
        && matches!(tokens.get(after), None | Some(Token::Stop | Token::Comma))
    {
        return Some((at + count, state::words("open")));
    }
    // `be holding it`
    if let Some(count) = stands(tokens, at, "be")
        && let Some((verb, Form::Gerund)) = tokens.get(at + count).and_then(|token| base(token.word()))
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    // `lock it away in the drawer`: the small word behind the thing makes the verb.
    if let Some(found) = apart(tokens, at) {
        return Some(found);
    }
    // `make sure I get the coke`
    if let Some(count) = UNWRAPPED_GETS.longest(tokens, at) {
        return Some((at + count, state::words("bring me")));
    }
    if let Some(count) = GOES_FOR.longest(tokens, at)
        && tokens.get(at + count)?.word() == "grab"
        && stands(tokens, at + count + 1, "hold").is_none()
    {
        return Some((at + count + 1, state::words("fetch")));
    }
    // `go over there, pick it up`
    if let Some(count) = UNWRAPPED_THERE.longest(tokens, at)
        && tokens.get(at + count) == Some(&Token::Comma)
        && begins(tokens, at + count + 1)
    {
        return Some((at + count + 1, Vec::new()));
    }
    let set_out = SETS_OUT.longest(tokens, at)?;
    let next = tokens.get(at + set_out)?.word();
    let is_verb = base(next).is_some_and(|(_, form)| form == Form::Base) && begins(tokens, at + set_out);
    let is_verb = is_verb || cause(tokens, at + set_out).is_some();
    is_verb.then(|| (at + set_out, Vec::new()))
}

/// What somebody else wants of the one who is spoken to, as the speaker says: how many words it takes.
pub(super) fn relayed(tokens: &[Token], at: usize) -> Option<usize> {
    let is_who = |token: &Token| {
        let word = token.word();
        !word.is_empty() && !RELAYED_I.has(word)
    };
    (at + 1..=at + 3).find_map(|end| {
        if !tokens.get(at..end)?.iter().all(is_who) {
            return None;
        }
        if let Some(count) = WANTS_YOU_TO.longest(tokens, end) {
            return Some(end + count - at);
        }
        let says = end + RELAYS.longest(tokens, end)?;
        Some(says + RELAYED_MODALS.longest(tokens, says)? - at)
    })
}

/// `lock it away`, `track it down`: the verb with its small word, and up to where the thing stands that it takes in.
pub(super) fn apart(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let word = tokens.get(at)?.word();
    let (_, after) = noun(tokens, at + 1).filter(|_| APART_VERBS.begins_with(word))?;
    // The verb and what follows the thing, as if they stood together.
    let together: Vec<Token> =
        tokens.get(at..=at)?.iter().chain(tokens.get(after..)?).take(3).cloned().collect();
    let (count, means) = APART_VERBS.valued(&together, 0)?;
    let count = count - 1;
    let mut said = state::words(means);
    said.extend_from_slice(tokens.get(at + 1..after)?);
    Some((after + count, said))
}
