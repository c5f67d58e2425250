//! Whether somebody who was asked whether to try again says so, in whatever words: `give it another shot`, `it cannot hurt`.

use super::lead::skip_leads;
use super::token::{Token, longest, stands, tokens};
use super::verb::verb;

/// What says so.
const AGAIN: &[&str] = &[
    "again",
    "once more",
    "one more time",
    "one more try",
    "one more go",
    "one more shot",
    "one more attempt",
    "one more chance",
    "another go",
    "another try",
    "another shot",
    "another attempt",
    "another chance",
    "another crack",
    "another whirl",
    "another bash",
    "second try",
    "second go",
    "second attempt",
    "second chance",
    "second shot",
    "keep trying",
    "keep at it",
    "keep going",
    "try harder",
    "try some more",
    "retry",
    "redo",
    "repeat",
    "start over",
    "go for it",
    "go ahead",
    "carry on",
    "continue",
    "do it",
    "do that",
    "do so",
    "please do",
    "you should",
    "you may",
    "you can",
    "would you",
    "try it",
    "try that",
    "have a go",
    "give it a go",
    "give it a try",
    "give it a shot",
    "go on",
];
/// What agrees by itself.
const AGREES: &[&str] = &[
    "yes",
    "yeah",
    "yep",
    "yup",
    "aye",
    "sure",
    "okay",
    "ok",
    "alright",
    "all right",
    "of course",
    "certainly",
    "absolutely",
    "definitely",
    "naturally",
    "indeed",
    "by all means",
    "you bet",
    "why not",
    "please",
    "sounds good",
    "fine",
    "gladly",
    "i would like that",
    "i would love that",
    "that would be",
    "uh huh",
    "mm hmm",
];
/// The only other words of a clause with one of these.
const PLAIN: &[&str] = &[
    "it",
    "that",
    "this",
    "a",
    "an",
    "the",
    "one",
    "more",
    "time",
    "times",
    "at",
    "just",
    "you",
    "could",
    "can",
    "would",
    "should",
    "must",
    "may",
    "might",
    "i",
    "we",
    "like",
    "want",
    "to",
    "think",
    "why",
    "do",
    "not",
    "so",
    "then",
    "and",
    "for",
    "me",
    "us",
    "let",
    "hurt",
    "harm",
    "will",
    "does",
    "be",
    "well",
    "oh",
    "now",
    "need",
    "there",
    "in",
    "no",
    "with",
    "on",
    "try",
    "trying",
    "give",
    "have",
    "take",
    "go",
    "thing",
    "things",
    "right",
    "same",
    "best",
    "your",
    "still",
    "say",
    "happy",
    "worth",
    "of",
    "up",
    "great",
    "lovely",
    "nice",
    "good",
    "kind",
    "wonderful",
    "fantastic",
    "perfect",
    "brilliant",
    "helpful",
    "very",
    "really",
    "too",
    "if",
    "uh",
    "um",
    "huh",
    "hmm",
    "from",
    "scratch",
    "course",
    "ahead",
    "please",
    "another",
    "bit",
    "you'd",
    "dear",
    "thanks",
    "thank",
    "was",
    "hoping",
    "but",
    "quick",
    "hurry",
    "once",
    "as",
    "make",
];
/// What says no in form and not in meaning, or is only said beside it.
const BESIDE: &[&str] = &[
    "do not give up",
    "never give up",
    "do not worry",
    "not to worry",
    "never mind",
    "no worries",
    "no problem",
    "no matter",
    "no harm",
    "no big deal",
    "no bother",
    "no rush",
    "no hurry",
    "not a problem",
    "it does not matter",
    "does not matter",
    "it can not hurt",
    "can not hurt",
    "it will not hurt",
    "it would not hurt",
    "will not hurt",
    "would not hurt",
    "why not",
    "why do not you",
    "do not be discouraged",
    "do not stop",
    "do not lose heart",
    "do not be afraid",
    "i am in no rush",
    "i am in no hurry",
    "there is no rush",
    "there is no hurry",
    "there is no harm",
    "i do not mind",
    "i can not do it myself",
    "i can not get it myself",
    "i can not reach it myself",
    "i need it",
    "i still need it",
    "i really need it",
    "i do need it",
    "i want it",
    "i really want it",
    "i would not mind",
    "that is fine",
    "that is okay",
    "that is ok",
    "that is all right",
    "that is alright",
    "it is fine",
    "it is okay",
    "it is all right",
    "take your time",
    "be careful",
    "be quick",
    "be gentle",
    "careful",
    "hold it tight",
    "hold it tighter",
    "hold on tight",
    "mind you",
    "try not to drop it",
    "do not drop it",
    "no reason not to",
    "and be careful",
    "not your fault",
    "it is not your fault",
];
/// What gives it up, in words that agree by themselves.
const GIVES_UP: &[&str] = &[
    "let it be",
    "let it go",
    "let that be",
    "let that go",
    "give up",
    "give it up",
    "give that up",
    "call it a day",
    "make do",
];
/// What agrees by itself, though it begins like a condition.
const IF_YOU: &[&str] = &["if you would", "if you could", "if you can", "if you please", "if you like"];
/// Words that take back, restrict or put off what is agreed to.
const DENIES: &[&str] = &[
    "no",
    "not",
    "never",
    "nothing",
    "none",
    "stop",
    "leave",
    "forget",
    "cancel",
    "instead",
    "other",
    "enough",
    "wait",
    "later",
    "unless",
    "if",
    "until",
    "when",
    "after",
    "rather",
    "different",
    "without",
    "nope",
    "nah",
    "before",
];

/// Whether an answer agrees to another try, and says nothing else that would have to be done or heeded: what it says beside
/// that, in words; none where it does not agree.
#[must_use]
pub fn encourages(answer: &str) -> Option<String> {
    let said = tokens(answer);
    let (mut agrees, mut beside) = (false, Vec::new());
    for clause in said.split(|token| matches!(token, Token::Comma | Token::Stop)) {
        let begin = skip_soft(clause, 0);
        if clause.get(begin..).is_none_or(<[Token]>::is_empty) {
            agrees |= (0..clause.len()).any(|at| longest(clause, at, AGREES).is_some());
            continue;
        }
        // `if you would, thank you`
        if IF_YOU.iter().any(|words| stands(clause, begin, words) == Some(clause.len() - begin)) {
            agrees = true;
            continue;
        }
        let is_beside = longest(clause, begin, BESIDE).is_some();
        if !is_beside && (0..clause.len()).any(|at| longest(clause, at, GIVES_UP).is_some()) {
            return None;
        }
        let is_agreed = (0..clause.len())
            .any(|at| longest(clause, at, AGAIN).is_some() || longest(clause, at, AGREES).is_some())
            && is_plain(clause);
        // `I cannot do it myself` says why.
        let is_agreed = is_agreed && stands(clause, begin, "i can not").is_none();
        let is_denied = !is_beside
            && clause.iter().any(|token| DENIES.contains(&token.word()))
            && (!is_agreed || negates(clause));
        if is_denied {
            return None;
        }
        // Something else is asked for.
        if !is_agreed && !is_beside && verb(clause, skip_leads(clause, begin)).is_some() {
            return None;
        }
        agrees |= is_agreed;
        if !is_agreed && !is_beside && !is_tag(clause) {
            beside.extend(clause.iter().map(Token::word));
        }
    }
    agrees.then(|| beside.join(" "))
}

/// `can it?`
fn is_tag(clause: &[Token]) -> bool {
    let asks = ["can", "could", "will", "would", "is", "does", "shall"];
    matches!(clause, [ask, _] if asks.contains(&ask.word()))
}

fn negates(clause: &[Token]) -> bool {
    clause.iter().any(|token| matches!(token.word(), "no" | "not" | "never" | "if" | "without" | "nothing"))
}

/// Whether a clause has no other words than those that agree.
fn is_plain(clause: &[Token]) -> bool {
    let mut at = 0;
    while let Some(token) = clause.get(at) {
        let taken =
            AGAIN.iter().chain(AGREES).chain(BESIDE).filter_map(|words| stands(clause, at, words)).max();
        match taken {
            Some(count) => at += count,
            None if PLAIN.contains(&token.word()) => at += 1,
            None => return false,
        }
    }
    true
}

/// Past words that only soften.
fn skip_soft(clause: &[Token], mut at: usize) -> usize {
    let soft = [
        "oh", "well", "um", "uh", "huh", "hmm", "and", "but", "so", "yes", "yeah", "sure", "okay", "ok",
        "please", "then", "dear",
    ];
    while clause.get(at).is_some_and(|token| soft.contains(&token.word())) {
        at += 1;
    }
    at
}
