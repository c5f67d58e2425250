//! What is said beside a request and asks for nothing: how things are, why, what somebody wonders, and what to mind.

use super::token::{Token, longest, stands};
use super::verb::{Act, begins};

/// Who or what may be spoken of at the beginning.
const SUBJECTS: &[&str] = &[
    "i",
    "we",
    "you",
    "my",
    "our",
    "your",
    "his",
    "her",
    "their",
    "there",
    "it",
    "the",
    "this",
    "that",
    "he",
    "she",
    "they",
    "someone",
    "somebody",
    "nobody",
    "everybody",
    "everyone",
    "something",
    "anything",
    "nothing",
    "everything",
    "a",
    "an",
    "some",
    "these",
    "those",
    "its",
    "in",
    "on",
    "inside",
    "at",
    "here",
];
/// What follows a name or another single noun of whom something is told.
const TELLS: &[&str] = &[
    "is", "are", "was", "were", "has", "have", "had", "wants", "needs", "likes", "loves", "keeps", "gets",
    "will", "would", "can", "could", "does", "did", "just", "always", "never", "says", "said", "told",
    "thinks", "reckons", "hates", "forgot", "left", "comes", "asked",
];
/// Questions that ask why, where or how often.
const ASKS: &[&str] = &[
    "where is",
    "where are",
    "where did",
    "where has",
    "why is",
    "why are",
    "why did",
    "why does",
    "why has",
    "why do i",
    "why do not i",
    "why do not we have",
    "why have i not",
    "why can not i",
    "why have",
    "how come",
    "how many times",
    "how often",
    "how did",
    "how is",
    "how are you",
    "who left",
    "who put",
    "who has",
    "what is",
    "what are",
    "what did",
    "what do",
    "what a",
    "what would i do",
    "do you know",
    "do you see",
    "do you remember",
    "did you know",
    "did you see",
    "did you notice",
    "have you seen",
    "you know",
    "guess what",
    "remember",
];
/// Questions whether something is so.
const WHETHER: &[&str] = &["is", "are", "was", "were", "has", "does", "did"];
/// What somebody means to do, with whom it is spoken.
const SHALL_WE: &[&str] = &[
    "let us see",
    "let us have a look",
    "let us take a look",
    "let me see",
    "let me think",
    "thank goodness",
    "off you go",
    "no wonder",
    "no point",
    "no use",
    "no need",
];
/// Reasons, which stand before what is asked for.
const REASONS: &[&str] = &["since", "because", "seeing as", "seeing that", "now that", "given that", "as"];
/// What the robot is told not to do, or somebody said: it is not passed over.
const MATTERS: &[&str] = &[
    "not want you to",
    "you must not",
    "you should not",
    "you may not",
    "you can not",
    "you could not",
    "you are not to",
    "you will not",
    "you need not",
    "you never",
    "nobody may",
    "nobody should",
    "nobody must",
    "no one may",
    "no one should",
    "not allowed",
    "not supposed",
    "forbidden",
    "you do not have to",
    "you do not need to",
    "changed my mind",
    "never mind",
    "forget it",
    "no longer want",
    "not want it any more",
    "just kidding",
    "only joking",
    "was joking",
    "in a dream",
];
/// With these somebody is quoted.
const SAYS: &[&str] = &[
    "says", "said", "say", "told", "tells", "asked", "asks", "wrote", "writes", "replied", "shouted",
    "thinks",
];

/// A remark goes on to the end of its sentence, or to a comma or a joint behind which something is asked for.
pub(super) fn remark_end(tokens: &[Token], begin: usize) -> usize {
    let mut at = begin;
    while let Some(token) = tokens.get(at) {
        let is_joint = matches!(token, Token::Comma) || matches!(token.word(), "and" | "so" | "but");
        let asks = || begins(tokens, at + 1) || super::frame::asks_for_it(tokens, at + 1).is_some();
        if matches!(token, Token::Stop) || (at > begin && is_joint && asks()) {
            break;
        }
        at += 1;
    }
    at
}

/// Whether words are a remark: with a subject before a verb, a question, or a reason. Anything else that is no command is
/// not understood, nor what forbids something or quotes somebody.
pub(super) fn is_remark(tokens: &[Token], begin: usize, end: usize) -> bool {
    let here = tokens.get(..end).unwrap_or_default();
    let of = |table: &[&str]| longest(here, begin, table).is_some();
    let matters = (begin..end).any(|at| longest(here, at, MATTERS).is_some());
    if end < begin + 2 || matters || quotes(tokens, here) {
        return false;
    }
    let is_told = here.get(begin + 1).is_some_and(|token| TELLS.contains(&token.word()));
    let is_name = here.get(begin).is_some_and(|token| !is_open(token.word()));
    of(SUBJECTS)
        || of(ASKS)
        || of(SHALL_WE)
        || is_question(here, begin)
        || reason(tokens, begin, end)
        || (is_told && is_name)
}

/// `is the fridge still open?`
pub(super) fn is_question(tokens: &[Token], begin: usize) -> bool {
    let whose =
        ["the", "my", "our", "it", "that", "this", "there", "anybody", "anyone", "somebody", "someone"];
    let is = |at: usize, table: &[&str]| tokens.get(at).is_some_and(|token| table.contains(&token.word()));
    is(begin, WHETHER) && (is(begin + 1, &whose) || (is(begin + 1, &["not"]) && is(begin + 2, &whose)))
}

/// `since you are up anyway, …`: a whole clause, behind which something is asked for.
fn reason(tokens: &[Token], begin: usize, end: usize) -> bool {
    let Some(count) = longest(tokens, begin, REASONS) else {
        return false;
    };
    let is_subject = tokens.get(begin + count).is_some_and(|token| SUBJECTS.contains(&token.word()));
    is_subject && tokens.get(end) == Some(&Token::Comma)
}

/// Words that begin a condition, a time or an order, and name nobody.
fn is_open(word: &str) -> bool {
    matches!(
        word,
        "if" | "unless"
            | "when"
            | "whenever"
            | "once"
            | "until"
            | "provided"
            | "suppose"
            | "tomorrow"
            | "later"
            | "tonight"
            | "after"
            | "before"
            | "should"
            | "could"
            | "can"
            | "would"
            | "not"
            | "never"
            | "do"
            | "what"
            | "whatever"
            | "who"
            | "which"
            | "whether"
            | "will"
            | "shall"
            | "must"
            | "may"
            | "might"
    )
}

/// `mum said, bring me the coke`: what follows are somebody else's words.
fn quotes(tokens: &[Token], here: &[Token]) -> bool {
    let word = |back: usize| here.len().checked_sub(back).and_then(|at| here.get(at)).map_or("", Token::word);
    let says = |word: &str| SAYS.contains(&word);
    let is_quoted = tokens.get(here.len()) == Some(&Token::Comma);
    is_quoted
        && (says(word(1))
            || (says(word(2)) && matches!(word(1), "me" | "you" | "us" | "him" | "her" | "them")))
}

/// `do not drop it`, `do not let go`: what to mind with what is asked for anyway. Where it ends.
pub(super) fn caution(tokens: &[Token], begin: usize, before: Option<Act>) -> Option<usize> {
    const MIND: &[&str] = &[
        "drop",
        "spill",
        "break",
        "scratch",
        "crush",
        "squash",
        "bump",
        "knock",
        "damage",
        "worry",
        "rush",
        "hurry",
        "dawdle",
        "be long",
        "be late",
        "be shy",
        "be slow",
        "take too long",
        "take long",
        "take forever",
        "let it fall",
        "let it slip",
        "make a mess",
        "make me wait",
        "forget",
    ];
    const HOLD: &[&str] = &[
        "let go",
        "let it go",
        "put it down",
        "put down",
        "set it down",
        "put it anywhere",
        "give it back",
        "lose it",
        "release it",
        "move",
        "go anywhere",
    ];
    // `no putting it down`: the `no` was passed over.
    let is_no = begin.checked_sub(1).is_some_and(|at| stands(tokens, at, "no").is_some());
    if let (true, Some(count)) =
        (is_no, longest(tokens, begin, &["putting it down", "letting go", "dropping it", "giving it back"]))
    {
        let is_held = matches!(before, Some(Act::Pick | Act::Lift));
        return (is_held && is_boundary(tokens, begin + count)).then_some(begin + count);
    }
    let at = begin
        + longest(
            tokens,
            begin,
            &["do not you dare", "do not you", "do not", "never", "try not to", "careful not to"],
        )?;
    let of = |table: &[&str]| longest(tokens, at, table).is_some();
    // `do not forget the mug` may ask for it, `do not forget!` minds what was said.
    let forgets = stands(tokens, at, "forget").is_some();
    let end = remark_end(tokens, at);
    let is_minded = of(MIND) && (!forgets || end == at + 1);
    let is_held = of(HOLD) && matches!(before, Some(Act::Pick | Act::Lift));
    let says_more = (at..end)
        .any(|at| tokens.get(at).is_some_and(|token| matches!(token.word(), "and" | "or" | "but" | "just")));
    ((is_minded || is_held) && !says_more).then_some(end)
}

/// What is said beside a request in its own clause: why, and how long something is held. Where it ends.
pub(super) fn beside(tokens: &[Token], at: usize, act: Act) -> Option<usize> {
    let who =
        ["i", "we", "it", "he", "she", "they", "the", "my", "our", "there", "nobody", "someone", "somebody"];
    let is_clause = |at: usize| tokens.get(at).is_some_and(|token| who.contains(&token.word()));
    let reason = [
        "because",
        "since",
        "as",
        "cause",
        "cos",
        "now that",
        "seeing that",
        "seeing as",
        "given that",
        "in case",
    ];
    let holds = matches!(act, Act::Pick | Act::Lift | Act::Take | Act::Go);
    let lasts = ["while", "whilst", "until", "till"];
    let of = |table: &[&str]| {
        table.iter().find_map(|words| stands(tokens, at, words)).filter(|count| is_clause(at + count))
    };
    let found = of(&reason).or_else(|| of(&lasts).filter(|_| holds));
    found.map(|_| remark_end(tokens, at))
}

/// Whether a phrase ends at a place.
pub(super) fn is_boundary(tokens: &[Token], at: usize) -> bool {
    matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
        || tokens.get(at).is_some_and(|token| {
            matches!(token.word(), "and" | "then" | "so" | "but" | "please" | "for" | "where")
        })
}

/// `just stay there with it`: where the robot is once it has done what it was asked for. Where it ends.
pub(super) fn stays_put(tokens: &[Token], begin: usize, before: Act) -> Option<usize> {
    // `take it in your hand and keep it there`, `drive there and then stop`
    let joined = begin.checked_sub(1).and_then(|at| tokens.get(at));
    let is_joined = joined.is_some_and(|token| matches!(token.word(), "and" | "then"));
    let same: &[&str] = match before {
        Act::Pick | Act::Lift => &["keep it there", "hold it there"],
        Act::Go if is_joined => &["stop", "stop there"],
        _ => &[],
    };
    if let Some(count) = longest(tokens, begin, same)
        && is_boundary(tokens, begin + count)
    {
        return Some(begin + count);
    }
    let stays = longest(tokens, begin, &["stay", "wait", "stand", "remain", "sit"])?;
    let there = ["there", "put", "still", "where you are", "right where you are", "over there"];
    let mut at = begin + stays;
    at += longest(tokens, at, &there)?;
    while let Some(count) =
        longest(tokens, at, &["with it", "with them", "for me", "for us", "for now", "please"])
    {
        at += count;
    }
    is_boundary(tokens, at).then_some(at)
}
