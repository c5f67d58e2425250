//! What somebody says that they have to do, cannot do or forgot, and then asks for: `I forgot to close the fridge, could you
//! do that for me?`

use crate::english::{
    ANOTHER_WANTS, ASKED_FOR_SHOW_ME, ASKED_FOR_WILL_NOT, ASKED_FOR_WITH_THIS, BEHIND_DO_IT, DO_IT,
    ELLIPTIC_CANNOT, ELLIPTIC_COULD_YOU, ELLIPTIC_PLEASE, HAS_TO_BE_MUST, HAS_TO_DO, MET_AHEAD, MET_MEETS,
    NEED_NOT, TASK_ASIDES, TROUBLE, WISHED_STATE,
};
use crate::inflection::{Form, base};
use crate::lead::skip_leads;
use crate::noun::noun;
use crate::spot::spot;
use crate::token::{Token, stands};
use crate::verb::verb;

/// A request with what is delegated in the place of what asks for it.
pub(super) fn delegated(tokens: &[Token]) -> Vec<Token> {
    let mut tokens = tokens.to_vec();
    let mut at = 0;
    while at < tokens.len() {
        if let Some((from, to, said)) = asked_for(&tokens, at).or_else(|| met(&tokens, at)) {
            tokens.splice(from..to, said);
            at = from;
        }
        at += 1;
    }
    tokens
}

/// `I cannot get it open. Could you?`: the verb that is left out, where it was said before what has to be done.
pub(super) fn elliptic(tokens: &[Token]) -> Vec<Token> {
    let mut said: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while let Some(token) = tokens.get(at) {
        let asks = ELLIPTIC_COULD_YOU.longest(tokens, at);
        let is_alone = |count: usize| {
            let end = at + count + ELLIPTIC_PLEASE.longest(tokens, at + count).unwrap_or(0);
            matches!(tokens.get(end), None | Some(Token::Comma | Token::Stop))
        };
        if let Some(count) = asks.filter(|count| is_alone(*count) && is_joint(said.last())) {
            let begin = before(&said, said.len());
            // Only what somebody cannot do or forgot asks for it so: `I want to close it, would you?` may only chat.
            let sentence = said.get(begin..).unwrap_or_default();
            if (0..sentence.len()).any(|at| ELLIPTIC_CANNOT.longest(sentence, at).is_some()) {
                said.extend_from_slice(tokens.get(at..at + count).unwrap_or_default());
                said.extend(["do", "it"].map(|word| Token::Word(word.to_owned())));
                at += count;
                continue;
            }
        }
        said.push(token.clone());
        at += 1;
    }
    said
}

/// Whether a clause asks for what was spoken of; where it ends.
pub(crate) fn asks_for_it(tokens: &[Token], at: usize) -> Option<usize> {
    let end = clause_end(tokens, at);
    let here = tokens.get(..end)?;
    let mut last = end;
    while let Some(count) = BEHIND_DO_IT.longest_before(here, last) {
        last -= count;
    }
    let begin = last - DO_IT.longest_before(here, last)?;
    let led = skip_leads(here.get(..begin)?, at);
    // `you do it!`
    let led = led + stands(here.get(..begin)?, led, "you").unwrap_or(0);
    (begin >= at && led == begin).then_some(end)
}

fn clause_end(tokens: &[Token], at: usize) -> usize {
    let is_end = |at: &usize| matches!(tokens.get(*at), Some(Token::Comma | Token::Stop));
    (at..tokens.len()).find(is_end).unwrap_or(tokens.len())
}

/// Where the clause before a place begins that may say what has to be done: with its sentence.
fn before(tokens: &[Token], at: usize) -> usize {
    let mut begin = at.saturating_sub(1);
    while begin > 0 && tokens.get(begin - 1) != Some(&Token::Stop) {
        begin -= 1;
    }
    begin
}

fn is_joint(token: Option<&Token>) -> bool {
    matches!(token, Some(Token::Comma | Token::Stop))
        || token.is_some_and(|token| matches!(token.word(), "but" | "so" | "and"))
}

/// `I have to open it, but can you do it for me?`: from where to where `open it` takes their place.
fn asked_for(tokens: &[Token], at: usize) -> Option<(usize, usize, Vec<Token>)> {
    if at == 0 || !is_joint(tokens.get(at - 1)) {
        return None;
    }
    let begin = before(tokens, at);
    let said = tokens.get(..at - 1)?;
    // `I bet you cannot open it. Show me!`
    let is_bet = (begin..said.len()).any(|at| stands(said, at, "bet you can not").is_some());
    let shows = ASKED_FOR_SHOW_ME.longest(tokens, at);
    let shown = shows.map(|count| at + count).filter(|end| is_bet && *end == clause_end(tokens, at));
    let end = shown.or_else(|| asks_for_it(tokens, at))?;
    if (begin..said.len()).any(|at| NEED_NOT.longest(said, at).is_some()) {
        return None;
    }
    let to_do = |at: usize| Some(at + HAS_TO_DO.longest(said, at)?);
    // `I am having trouble opening it, could you do it?`
    let doing = (begin..said.len()).find_map(|at| {
        let verb = at + TROUBLE.longest(said, at)?;
        let (base, form) = base(said.get(verb)?.word())?;
        (form == Form::Gerund).then_some((verb, base))
    });
    if let Some((verb, base)) = doing {
        let (_, after) = noun(said, verb + 1)?;
        let mut words = vec![Token::Word(base)];
        words.extend_from_slice(said.get(verb + 1..after)?);
        return Some((begin, end, words));
    }
    // `it will not open for me, can you do it?`
    let stuck = (begin + 1..said.len()).find_map(|at| {
        let verb = at + ASKED_FOR_WILL_NOT.longest(said, at)?;
        let word = said.get(verb)?.word();
        let (_, after) = noun(said.get(..at)?, begin)?;
        (after == at && matches!(word, "open" | "close" | "shut")).then(|| (at, word.to_owned()))
    });
    if let Some((thing_end, word)) = stuck {
        let mut words = vec![Token::Word(word)];
        words.extend_from_slice(said.get(begin..thing_end)?);
        return Some((begin, end, words));
    }
    let task = (begin..said.len()).find_map(|at| to_do(at).filter(|task| verb(said, *task).is_some()));
    let Some(task) = task else {
        let wished =
            wished_for(said, begin).or_else(|| of_another(said, begin)).or_else(|| has_to_be(said, begin));
        return wished.map(|said| (begin, end, said));
    };
    let until = (task..said.len())
        .find(|at| {
            matches!(said.get(*at), Some(Token::Comma | Token::Stop))
                || matches!(said.get(*at).map_or("", Token::word), "but" | "so")
                // `with this bad wrist`
                || ASKED_FOR_WITH_THIS.longest(said, *at).is_some()
                // `and never got round to it`
                || (stands(said, *at, "and").is_some() && verb(said, *at + 1).is_none())
        })
        .unwrap_or(said.len());
    let aside = TASK_ASIDES.longest_before(said, until);
    Some((begin, end, said.get(task..until - aside.unwrap_or(0))?.to_vec()))
}

/// `I would rather have it in the drawer. Do that for me.`: seen to.
fn wished_for(said: &[Token], begin: usize) -> Option<Vec<Token>> {
    let at = (begin..said.len()).find_map(|at| Some(at + WISHED_STATE.longest(said, at)?))?;
    let limit = clause_end(said, at);
    let (thing, place) = (at + 1..limit).find_map(|end| {
        let (_, after) = noun(said.get(..end)?, at)?;
        let (_, to) = spot(said.get(..limit)?, end)?;
        (after == end && to == limit).then_some((at..end, end..limit))
    })?;
    let mut wanted = vec![Token::Word("put".to_owned())];
    wanted.extend_from_slice(said.get(thing)?);
    wanted.extend_from_slice(said.get(place)?);
    Some(wanted)
}

/// `my wife wants the coke on the counter, could you see to that?`, `Mum asked for it to be put away. Would you?`
fn of_another(said: &[Token], begin: usize) -> Option<Vec<Token>> {
    let at = (begin + 1..said.len()).find_map(|at| Some(at + ANOTHER_WANTS.longest(said, at)?))?;
    let mut wanted = vec![Token::Word("i".to_owned()), Token::Word("want".to_owned())];
    wanted.extend_from_slice(said.get(at..clause_end(said, at))?);
    Some(wanted)
}

/// `the fridge must be closed, you do it?`: seen to.
fn has_to_be(said: &[Token], begin: usize) -> Option<Vec<Token>> {
    let begin = skip_leads(said, begin);
    let at = (begin + 1..clause_end(said, begin)).find(|at| HAS_TO_BE_MUST.longest(said, *at).is_some())?;
    let count = HAS_TO_BE_MUST.longest(said, at)?;
    let mut wanted = vec![Token::Word("ensure".to_owned())];
    wanted.extend_from_slice(said.get(begin..at)?);
    wanted.push(Token::Word("is".to_owned()));
    wanted.extend_from_slice(said.get(at + count..clause_end(said, at))?);
    Some(wanted)
}

/// `I will meet you at the door, you go ahead`
fn met(tokens: &[Token], at: usize) -> Option<(usize, usize, Vec<Token>)> {
    let place = at + MET_MEETS.longest(tokens, at)?;
    let (_, after) = spot(tokens, place)?;
    let next = clause_end(tokens, place) + 1;
    let next = next + stands(tokens, next, "so").unwrap_or(0);
    let end = next + MET_AHEAD.longest(tokens, next)?;
    if end != clause_end(tokens, next) {
        return None;
    }
    let mut said = vec![Token::Word("go".to_owned())];
    said.extend_from_slice(tokens.get(place..after)?);
    Some((at, end, said))
}
