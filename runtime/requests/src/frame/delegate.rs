//! What somebody says that they have to do, cannot do or forgot, and then asks for: `I forgot to close the fridge, could you
//! do that for me?`

use super::task::{ASIDE, BEHIND, DO_IT, NOT_TO, TO_DO, WISHED};
use crate::inflection::{Form, base};
use crate::lead::skip_leads;
use crate::noun::noun;
use crate::spot::spot;
use crate::token::{Token, longest, stands};
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
        let asks = longest(tokens, at, &["could you", "can you", "would you", "will you"]);
        let is_alone = |count: usize| {
            let end = at + count + longest(tokens, at + count, &["please", "for me", "instead"]).unwrap_or(0);
            matches!(tokens.get(end), None | Some(Token::Comma | Token::Stop))
        };
        if let Some(count) = asks.filter(|count| is_alone(*count) && is_joint(said.last())) {
            let begin = before(&said, said.len());
            // Only what somebody cannot do or forgot asks for it so: `I want to close it, would you?` may only chat.
            let cannot = [
                "i can not",
                "i could not",
                "am not able to",
                "am unable to",
                "forgot to",
                "have forgotten to",
                "can not manage to",
                "can not seem to",
                "asked for",
                "has asked for",
                "is asking for",
                "asked me to",
                "was asked to",
                "told me to",
                "am supposed to",
                "was supposed to",
                "meant to",
                "have no time to",
                "do not have time to",
                "never got round to",
                "never got around to",
            ];
            let sentence = said.get(begin..).unwrap_or_default();
            if (0..sentence.len()).any(|at| longest(sentence, at, &cannot).is_some()) {
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
    while let Some(count) = BEHIND.iter().filter_map(|words| ends_with(here, last, words)).max() {
        last -= count;
    }
    let begin =
        DO_IT.iter().filter_map(|words| ends_with(here, last, words)).map(|count| last - count).min()?;
    let led = skip_leads(here.get(..begin)?, at);
    // `you do it!`
    let led = led + stands(here.get(..begin)?, led, "you").unwrap_or(0);
    (begin >= at && led == begin).then_some(end)
}

/// How many words stand before a place, where they do.
fn ends_with(tokens: &[Token], end: usize, words: &str) -> Option<usize> {
    let count = words.split(' ').count();
    stands(tokens, end.checked_sub(count)?, words)
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
    let shows = longest(tokens, at, &["show me", "prove it", "go on"]);
    let shown = shows.map(|count| at + count).filter(|end| is_bet && *end == clause_end(tokens, at));
    let end = shown.or_else(|| asks_for_it(tokens, at))?;
    if (begin..said.len()).any(|at| longest(said, at, NOT_TO).is_some()) {
        return None;
    }
    let to_do = |at: usize| Some(at + longest(said, at, TO_DO)?);
    // `I am having trouble opening it, could you do it?`
    let trouble =
        ["trouble", "difficulty", "difficulties", "a hard time", "problems", "keep forgetting about"];
    let doing = (begin..said.len()).find_map(|at| {
        let verb = at + longest(said, at, &trouble)?;
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
    let will_not = ["will not", "does not want to", "would not", "does not"];
    let stuck = (begin + 1..said.len()).find_map(|at| {
        let verb = at + longest(said, at, &will_not)?;
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
                || longest(said, *at, &["with this", "with these", "with my", "with only", "on my own", "by myself", "because of", "due to"]).is_some()
                // `and never got round to it`
                || (stands(said, *at, "and").is_some() && verb(said, *at + 1).is_none())
        })
        .unwrap_or(said.len());
    let aside = ASIDE.iter().filter_map(|aside| ends_with(said.get(..until)?, until, aside)).max();
    Some((begin, end, said.get(task..until - aside.unwrap_or(0))?.to_vec()))
}

/// `I would rather have it in the drawer. Do that for me.`: seen to.
fn wished_for(said: &[Token], begin: usize) -> Option<Vec<Token>> {
    let at = (begin..said.len()).find_map(|at| Some(at + longest(said, at, WISHED)?))?;
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
    const WANTS: &[&str] = &[
        "wants",
        "needs",
        "would like",
        "would love",
        "would prefer",
        "would rather have",
        "prefers",
        "asked for",
        "is asking for",
        "has asked for",
        "insists on having",
        "likes to have",
        "wanted",
        "is expecting",
        "expects",
    ];
    let at = (begin + 1..said.len()).find_map(|at| Some(at + longest(said, at, WANTS)?))?;
    let mut wanted = vec![Token::Word("i".to_owned()), Token::Word("want".to_owned())];
    wanted.extend_from_slice(said.get(at..clause_end(said, at))?);
    Some(wanted)
}

/// `the fridge must be closed, you do it?`: seen to.
fn has_to_be(said: &[Token], begin: usize) -> Option<Vec<Token>> {
    let begin = skip_leads(said, begin);
    let must = [
        "must be",
        "should have been",
        "ought to have been",
        "was supposed to be",
        "was meant to be",
        "has to be",
        "ought to be",
        "have to be",
        "should be",
        "needs to be",
        "is supposed to be",
        "must go",
        "has to go",
        "should go",
    ];
    let at = (begin + 1..clause_end(said, begin)).find(|at| longest(said, *at, &must).is_some())?;
    let count = longest(said, at, &must)?;
    let mut wanted = vec![Token::Word("ensure".to_owned())];
    wanted.extend_from_slice(said.get(begin..at)?);
    wanted.push(Token::Word("is".to_owned()));
    wanted.extend_from_slice(said.get(at + count..clause_end(said, at))?);
    Some(wanted)
}

/// `I will meet you at the door, you go ahead`
fn met(tokens: &[Token], at: usize) -> Option<(usize, usize, Vec<Token>)> {
    let meets = [
        "i will meet you",
        "i will see you",
        "i will join you",
        "we will meet you",
        "let us meet",
        "i am going to want your help",
        "i am going to need your help",
        "i am going to need you",
        "i will want your help",
        "i will need your help",
        "i will need you",
    ];
    let place = at + meets.iter().find_map(|meets| stands(tokens, at, meets))?;
    let (_, after) = spot(tokens, place)?;
    let next = clause_end(tokens, place) + 1;
    let next = next + stands(tokens, next, "so").unwrap_or(0);
    let ahead = ["you go ahead", "go ahead", "go on ahead", "you go on ahead", "you go first", "go there"];
    let end = next + longest(tokens, next, &ahead)?;
    if end != clause_end(tokens, next) {
        return None;
    }
    let mut said = vec![Token::Word("go".to_owned())];
    said.extend_from_slice(tokens.get(place..after)?);
    Some((at, end, said))
}
