//! What is said beside a request and asks for nothing: how things are, why, what somebody wonders, and what to mind.

use super::beside::{ASKS, MATTERS, NAMES, REASONS, SAYS, SHALL_WE, SUBJECTS, TELLS, WHETHER};
use super::inflection::{Form, base};
use super::token::{Token, longest, stands};
use super::verb::{Act, begins};

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
    // What is only named or looked at is spoken of where more follows.
    if of(NAMES) && !(end..tokens.len()).any(|at| begins(tokens, at)) {
        return false;
    }
    // `leaving the fridge open wastes power`
    let is_doing = base(here.get(begin).map_or("", Token::word))
        .is_some_and(|(_, form)| form == Form::Gerund)
        && here.get(begin..).is_some_and(|said| said.iter().any(|token| is_telling(token.word())));
    let is_told = here.get(begin + 1).is_some_and(|token| TELLS.contains(&token.word()));
    let is_name = here.get(begin).is_some_and(|token| !is_open(token.word()));
    of(SUBJECTS)
        || of(ASKS)
        || of(NAMES)
        || of(SHALL_WE)
        || is_question(here, begin)
        || reason(tokens, begin, end)
        || purpose(tokens, begin, end)
        || is_doing
        || (is_told && is_name)
}

/// What is said of something that is done.
fn is_telling(word: &str) -> bool {
    matches!(
        word,
        "is" | "was"
            | "wastes"
            | "makes"
            | "takes"
            | "costs"
            | "lets"
            | "hurts"
            | "does"
            | "drives"
            | "can"
            | "will"
    )
}

/// `is the fridge still open?`
pub(super) fn is_question(tokens: &[Token], begin: usize) -> bool {
    let whose = [
        "you", "the", "my", "our", "it", "that", "this", "there", "anybody", "anyone", "somebody", "someone",
    ];
    let is = |at: usize, table: &[&str]| tokens.get(at).is_some_and(|token| table.contains(&token.word()));
    let left = ["did i leave", "did we leave", "have i left", "have we left"];
    longest(tokens, begin, &left).is_some()
        || is_rhetorical(tokens, begin)
        || is(begin, WHETHER) && (is(begin + 1, &whose) || (is(begin + 1, &["not"]) && is(begin + 2, &whose)))
}

/// `would it not look nice on the shelf?`, `should it not be shut?`: what is thought to be so, and asks for nothing by itself.
fn is_rhetorical(tokens: &[Token], begin: usize) -> bool {
    let asks = ["would", "should", "is", "does", "could", "will", "are", "do"];
    let at = begin + longest(tokens, begin, &asks).unwrap_or(0);
    let not = usize::from(stands(tokens, at, "not").is_some());
    let who = ["it", "that", "this", "the", "my", "our", "everything", "they", "these", "those"];
    let is_of_it = at > begin && longest(tokens, at + not, &who).is_some();
    is_of_it && (not == 1 || longest(tokens, begin, &["would", "should"]).is_some())
}

/// `since you are up anyway, …`: a whole clause, behind which something is asked for.
fn reason(tokens: &[Token], begin: usize, end: usize) -> bool {
    let Some(count) = longest(tokens, begin, REASONS) else {
        return false;
    };
    let is_subject = tokens.get(begin + count).is_some_and(|token| SUBJECTS.contains(&token.word()));
    is_subject && tokens.get(end) == Some(&Token::Comma)
}

/// `for safety, …`, `to keep it cool, …`, `so that it does not get lost, …`: what for, behind which something is asked for.
fn purpose(tokens: &[Token], begin: usize, end: usize) -> bool {
    let for_what = stands(tokens, begin, "for").is_some();
    let to_what =
        longest(tokens, begin, &["in order to", "so as to", "so that", "to"]).is_some_and(|count| {
            let does = [
                "keep", "make", "stop", "save", "avoid", "prevent", "help", "be", "get", "free", "protect",
                "let", "it", "i", "we", "nobody", "no",
            ];
            tokens.get(begin + count).is_some_and(|token| does.contains(&token.word()))
        });
    let is_bound = |token: &Token| {
        matches!(
            token.word(),
            "tomorrow"
                | "tonight"
                | "later"
                | "when"
                | "if"
                | "until"
                | "after"
                | "minutes"
                | "hours"
                | "unless"
        )
    };
    let said = tokens.get(begin..end).unwrap_or_default();
    (for_what || to_what)
        && !said.iter().any(is_bound)
        && tokens.get(end) == Some(&Token::Comma)
        && begins(tokens, end + 1)
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
        "coz",
        "cuz",
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
    // What somebody else does meanwhile bounds nothing of what is done now.
    let while_other = of(&["while", "whilst"]);
    let found = of(&reason).or(while_other).or_else(|| of(&lasts).filter(|_| holds));
    found.map(|_| remark_end(tokens, at))
}

/// Whether a phrase ends at a place.
pub(super) fn is_boundary(tokens: &[Token], at: usize) -> bool {
    matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
        || tokens.get(at).is_some_and(|token| {
            matches!(token.word(), "and" | "then" | "so" | "but" | "please" | "for" | "where")
        })
}
