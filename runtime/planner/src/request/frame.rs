//! Sentences that ask without an imperative, said as imperatives: `I need the fridge open` is `open the fridge`, `could the
//! coke be brought to me` is `bring the coke to me`. What is framed otherwise stays as it is.
//!
//! The frames are constructions with places for nouns, after Goldberg, Constructions (1995): a predicate of place or state
//! (`X belongs in Y`, `I want X shut`), a passive, a causative (`get X open`), a wish, and what politeness puts before them.

use super::noun::{Noun, located, noun};
use super::token::Token;
use super::verb::{Form, base, begins, skip_leads, stands};

/// What is wanted of something.
enum State {
    Open,
    Closed,
    /// It is somewhere: the words for it begin here.
    At,
    /// What is done with it, as the verb's base.
    Done(String),
}

/// What stands between a thing and where it shall be, or what shall be done with it.
const SHALL: &[&str] = &[
    "belongs",
    "belong",
    "goes",
    "lives",
    "should be",
    "should go",
    "should get",
    "should stay",
    "should end up",
    "needs to be",
    "needs to go",
    "needs to get",
    "need to be",
    "need to go",
    "has to be",
    "has to go",
    "have to be",
    "have to go",
    "ought to be",
    "ought to go",
    "is supposed to be",
    "is supposed to go",
    "are supposed to be",
    "is to be",
    "must go",
    "can go",
    "can be",
    "could go",
    "could be",
    "may go",
    "might go",
];
/// The same as a question: between the auxiliary and the state stands the thing.
const SHALL_IT: &[&str] = &["be", "go", "get", "stay", "end up"];
const WANT: &[&str] = &[
    "i want",
    "i need",
    "i would like",
    "i would love",
    "i would prefer",
    "i would rather have",
    "i prefer",
    "we want",
    "we need",
    "we would like",
];
const DO_NOT_WANT: &[&str] =
    &["i do not want", "we do not want", "i would not like", "do not leave", "do not keep", "never leave"];
const TO_BE: &[&str] = &["to be", "to go", "to get", "to stay", "to end up", "to be put", "to be left"];
const SEE_TO: &[&str] = &[
    "make sure that",
    "make sure",
    "ensure that",
    "ensure",
    "see to it that",
    "see that",
    "take care that",
    "be sure that",
    "make certain that",
];
const IS: &[&str] = &[
    "is",
    "are",
    "ends up",
    "end up",
    "gets",
    "get",
    "stays",
    "stay",
    "goes",
    "has been",
    "is put",
    "is left",
    "is placed",
];
/// Verbs that bring about a state: `get the fridge open`.
const CAUSE: &[&str] = &["get", "have", "leave", "keep", "make", "pull", "push", "swing", "slide", "set"];
/// What asks for the form in `-ing`.
const MIND: &[&str] = &[
    "would you mind",
    "do you mind",
    "mind",
    "how about",
    "what about",
    "any chance of",
    "is there any chance of",
    "i would appreciate you",
    "after",
    "start by",
];
/// Going somewhere in order to do something there: only the second counts.
const SET_OUT: &[&str] = &[
    "go over and",
    "go back and",
    "go out and",
    "go ahead and",
    "go and",
    "run over and",
    "run and",
    "hurry and",
    "come and",
    "head over and",
    "go",
    "run",
    "come",
    "try and",
    "try to",
];
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

/// Behind a verb of opening or closing: only where it is not so already, which has to be seen first.
pub(super) const ONLY_IF_SO: &str = "if it is open";

/// A request with its frames said plainly.
pub(super) fn plain(tokens: &[Token]) -> Vec<Token> {
    let mut tokens = without_fillers(tokens);
    let mut said = Vec::with_capacity(tokens.len());
    let (mut at, mut starts, mut begins_sentence) = (0, true, true);
    // Every rewriting takes words away or goes on behind what it wrote: the bound only guards against a slip of that.
    let mut left = tokens.len() * 4 + 16;
    while at < tokens.len() && left > 0 {
        left -= 1;
        if starts {
            let begin = skip_leads(&tokens, at);
            if let Some((from, words)) = unwrapped(&tokens, begin) {
                tokens.splice(begin..from, words);
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
        let joins = matches!(token, Token::Comma | Token::Stop)
            || matches!(token.word(), "and" | "so" | "but" | "then" | "because");
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

fn without_fillers(tokens: &[Token]) -> Vec<Token> {
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

/// A frame around an imperative: what stands for the tokens up to where.
fn unwrapped(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let mind = MIND.iter().filter_map(|mind| stands(tokens, at, mind)).max();
    if let Some(count) = mind
        && let Some((verb, Form::Gerund)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    let set_out = SET_OUT.iter().filter_map(|out| stands(tokens, at, out)).max()?;
    let next = tokens.get(at + set_out)?.word();
    let is_verb = base(next).is_some_and(|(_, form)| form == Form::Base) && begins(tokens, at + set_out);
    let is_verb = is_verb || cause(tokens, at + set_out).is_some();
    is_verb.then(|| (at + set_out, Vec::new()))
}

/// One clause said plainly, and where what follows it begins.
fn clause(tokens: &[Token], begin: usize, begins_sentence: bool) -> Option<(Vec<Token>, usize)> {
    let limit = (begin..tokens.len())
        .find(|at| matches!(tokens.get(*at), Some(Token::Comma | Token::Stop)))
        .unwrap_or(tokens.len());
    let tokens_here = tokens.get(..limit)?;
    predicate(tokens_here, begin)
        .or_else(|| wish(tokens_here, begin))
        .or_else(|| cause(tokens_here, begin))
        .or_else(|| self_moved(tokens_here, begin))
        .or_else(|| fronted(tokens_here, begin))
        .or_else(|| unless_so(tokens, begin, limit))
        .or_else(|| begins_sentence.then(|| bare(tokens, begin, limit)).flatten())
}

/// `the coke belongs in the fridge`, `can the coke go in the fridge`, `make sure that the drawer is shut`
fn predicate(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let asks = ["can", "could", "may", "would"].iter().find_map(|ask| stands(tokens, begin, ask));
    let sees = SEE_TO.iter().filter_map(|see| stands(tokens, begin, see)).max();
    let (begin, links) = match (asks, sees) {
        (Some(count), _) => (begin + count, SHALL_IT),
        (None, Some(count)) => (begin + count, IS),
        (None, None) => (begin, SHALL),
    };
    let is_seen_to = asks.is_none() && sees.is_some();
    thing_before(tokens, begin, |at| {
        let count = links.iter().filter_map(|link| stands(tokens, at, link)).max();
        let none = ["should not be", "is not", "needs"].iter().find_map(|link| stands(tokens, at, link));
        let (count, is_wanted) = match (count, none) {
            (Some(count), _) => (count, true),
            (None, Some(1)) => (1, true),
            (None, Some(count)) if is_seen_to || count == 3 => (count, false),
            (None, _) => return None,
        };
        let needs = stands(tokens, at, "needs") == Some(count);
        let (state, after) = state(tokens, at + count, if needs { Form::Gerund } else { Form::Participle })?;
        Some((if is_wanted { state } else { opposite(state)? }, after))
    })
}

/// `I need the fridge open`, `I would like the coke to be on the table`, `I want you at the door`
fn wish(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let sees_you = ["to see you", "to meet you", "to have you", "you to be", "you"];
    let wants = WANT.iter().filter_map(|want| stands(tokens, begin, want)).max();
    if let Some(count) = wants
        && let Some(you) = sees_you.iter().find_map(|see| stands(tokens, begin + count, see))
        && is_place(tokens, begin + count + you)
    {
        return Some((words("go"), begin + count + you));
    }
    if let Some(count) = wants {
        return thing_before(tokens, begin + count, |at| {
            let to_be = TO_BE.iter().filter_map(|to_be| stands(tokens, at, to_be)).max();
            let found = state(tokens, at + to_be.unwrap_or(0), Form::Participle)?;
            // `I want the mug on the table` is left to who knows where the mug is.
            (to_be.is_some() || !matches!(found.0, State::At)).then_some(found)
        });
    }
    let count = DO_NOT_WANT.iter().filter_map(|want| stands(tokens, begin, want)).max()?;
    thing_before(tokens, begin + count, |at| {
        let to_be = TO_BE.iter().filter_map(|to_be| stands(tokens, at, to_be)).max().unwrap_or(0);
        let (state, after) = state(tokens, at + to_be, Form::Participle)?;
        Some((opposite(state)?, after))
    })
}

/// `get the fridge open`, `push the drawer shut`, `have the coke brought to me`
fn cause(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let verb = tokens.get(begin)?.word();
    if !CAUSE.contains(&verb) {
        return None;
    }
    thing_before(tokens, begin + 1, |at| {
        let (state, after) = state(tokens, at, Form::Participle)?;
        let is_open_or_closed = opposite_name(&state).is_some();
        (is_open_or_closed || (matches!(verb, "get" | "have") && matches!(state, State::Done(_))))
            .then_some((state, after))
    })
}

/// `take yourself to the door`
fn self_moved(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let moves = matches!(tokens.get(begin)?.word(), "take" | "get" | "bring" | "move" | "drive" | "park");
    let is_self = matches!(tokens.get(begin + 1)?.word(), "yourself");
    (moves && is_self).then(|| (words("go"), begin + 2))
}

/// `on the table is where I want the coke`
fn fronted(tokens: &[Token], begin: usize) -> Option<(Vec<Token>, usize)> {
    let (_, after) = located(tokens, begin)?;
    let at = after + stands(tokens, after, "is where")?;
    let at = at + WANT.iter().filter_map(|want| stands(tokens, at, want)).max()?;
    let (_, end) = noun(tokens, at)?;
    let mut said = words("put");
    said.extend_from_slice(tokens.get(at..end)?);
    said.extend_from_slice(tokens.get(begin..after)?);
    let end = end + TO_BE.iter().filter_map(|to_be| stands(tokens, end, to_be)).max().unwrap_or(0);
    Some((said, end))
}

/// `if the drawer is open, close it`: `close the drawer if it is open`.
fn unless_so(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    let at = begin + ["if", "in case", "when"].iter().find_map(|word| stands(tokens, begin, word))?;
    let here = tokens.get(..limit)?;
    let (said, after) = thing_before(here, at, |at| {
        let count =
            ["is still", "is", "was left", "has been left"].iter().find_map(|is| stands(here, at, is))?;
        let (state, after) = state(here, at + count, Form::Participle)?;
        Some((opposite(state)?, after))
    })?;
    if after != limit {
        return None;
    }
    let then = skip_leads(tokens, limit + 1);
    let verb = tokens.get(then)?.word();
    let wanted = said.first()?.word();
    let is_same = verb == wanted || (verb == "shut" && wanted == "close");
    let is_it = matches!(tokens.get(then + 1)?.word(), "it" | "that");
    (is_same && is_it).then(|| ([said, words(ONLY_IF_SO)].concat(), then + 2))
}

/// `the coke, please`: someone wants to have it.
fn bare(tokens: &[Token], begin: usize, limit: usize) -> Option<(Vec<Token>, usize)> {
    if begins(tokens, begin) {
        return None;
    }
    let (_, after) = noun(tokens.get(..limit)?, begin)?;
    let is_named = tokens.get(begin).is_some_and(|token| !is_pronoun(token.word()));
    let please = |at: usize| stands(tokens, at, "please").is_some();
    if is_named && (please(after) || (after == limit && please(limit + 1))) {
        let mut said = words("bring me");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, after));
    }
    let goes = ["over to", "to", "into", "onto"].iter().find_map(|to| stands(tokens, after, to));
    let (_, end) = noun(tokens.get(..limit)?, after + goes?)?;
    if is_named && (please(end) || (end == limit && please(limit + 1))) {
        let mut said = words("put");
        said.extend_from_slice(tokens.get(begin..after)?);
        return Some((said, after));
    }
    None
}

fn is_pronoun(word: &str) -> bool {
    matches!(word, "me" | "us" | "it" | "them" | "that" | "this" | "here" | "there" | "you" | "i")
}

/// The first noun from `begin` on behind which `state` finds something, said as an imperative.
fn thing_before(
    tokens: &[Token],
    begin: usize,
    state: impl Fn(usize) -> Option<(State, usize)>,
) -> Option<(Vec<Token>, usize)> {
    (begin + 1..tokens.len()).find_map(|at| {
        let (found, after) = state(at)?;
        let (thing, end) = noun(tokens.get(..at)?, begin)?;
        if end != at {
            return None;
        }
        let verb = match found {
            State::Open => "open".to_owned(),
            State::Closed => "close".to_owned(),
            State::At if matches!(thing, Noun::Speaker) => return None,
            State::At => "put".to_owned(),
            State::Done(verb) => verb,
        };
        let mut said = words(&verb);
        said.extend_from_slice(tokens.get(begin..at)?);
        Some((said, after))
    })
}

/// What is wanted, and where the words for it that are still to be read begin.
fn state(tokens: &[Token], at: usize, form: Form) -> Option<(State, usize)> {
    let skipped = ["back", "all", "wide", "safely"];
    let word = tokens.get(at)?.word();
    let at = if skipped.contains(&word) && tokens.get(at + 1).is_some() { at + 1 } else { at };
    let word = tokens.get(at)?.word();
    let is_last = tokens.get(at + 1).is_none_or(|next| {
        matches!(next, Token::Comma | Token::Stop)
            || matches!(next.word(), "and" | "for" | "please" | "again")
    });
    match word {
        "open" if is_last => return Some((State::Open, at + 1)),
        "closed" | "shut" if is_last => return Some((State::Closed, at + 1)),
        _ => {}
    }
    if is_place(tokens, at) {
        return Some((State::At, at));
    }
    let (verb, found) = base(word)?;
    // `put` and `shut` are their own participles.
    let is_put = found == Form::Base && form == Form::Participle && base_is_participle(word);
    let next = tokens.get(at + 1).map_or("", Token::word);
    // A `tea set` is a noun: these need a place behind them.
    let is_put = is_put && (is_place(tokens, at + 1) || matches!(next, "away" | "back" | "down"));
    (found == form || is_put).then_some((State::Done(verb), at + 1))
}

fn base_is_participle(word: &str) -> bool {
    matches!(word, "put" | "set" | "shut")
}

fn is_place(tokens: &[Token], at: usize) -> bool {
    let to =
        ["into", "onto", "over here", "over there", "here", "next to", "near", "by", "beside", "with me"];
    located(tokens, at).is_some() || to.iter().any(|to| stands(tokens, at, to).is_some())
}

fn opposite(state: State) -> Option<State> {
    match opposite_name(&state)? {
        "open" => Some(State::Open),
        _ => Some(State::Closed),
    }
}

fn opposite_name(state: &State) -> Option<&'static str> {
    match state {
        State::Open => Some("closed"),
        State::Closed => Some("open"),
        State::Done(verb) if verb == "open" => Some("closed"),
        State::Done(verb) if matches!(verb.as_str(), "close" | "shut") => Some("open"),
        State::At | State::Done(_) => None,
    }
}

fn words(text: &str) -> Vec<Token> {
    text.split(' ').map(|word| Token::Word(word.to_owned())).collect()
}
