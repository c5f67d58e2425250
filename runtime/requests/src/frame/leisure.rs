//! When it suits who is asked: `when you get a moment`, `if it is not too much trouble`.

use crate::inflection::{Form, base};
use crate::token::{Token, longest, stands};

/// `when you get a moment`, `if it is not too much trouble`, `when you are done with that`: how many words it takes.
pub(super) fn leisure(tokens: &[Token], at: usize) -> Option<usize> {
    const LEISURE: &[&str] = &[
        "when",
        "whenever",
        "if",
        "once",
        "as",
        "soon",
        "you",
        "get",
        "got",
        "have",
        "has",
        "find",
        "can",
        "could",
        "are",
        "would",
        "not",
        "too",
        "much",
        "trouble",
        "is",
        "it",
        "a",
        "the",
        "some",
        "spare",
        "free",
        "at",
        "up",
        "moment",
        "minute",
        "second",
        "sec",
        "time",
        "chance",
        "ready",
        "able",
        "so",
        "kind",
        "do",
        "mind",
        "like",
        "good",
        "there",
        "that",
        "next",
        "around",
        "about",
        "by",
        "manage",
        "bother",
        "to",
        "ask",
        "okay",
        "getting",
        "doing",
        "bringing",
        "fetching",
        "passing",
        "reaching",
        "helping",
        "me",
        "anyway",
        "feel",
        "found",
        "located",
        "spotted",
        "them",
        "finished",
        "done",
        "with",
        "nothing",
        "else",
        "better",
        "busy",
        "otherwise",
        "occupied",
        "please",
        "happen",
        "come",
        "back",
        "pass",
        "passing",
        "going",
        "way",
        "on",
        "your",
        "over",
        "feet",
        "hand",
        "hands",
        "hands free",
        "breath",
        "idle",
        "bored",
        "awake",
        "charged",
        "already",
        "here",
        "still",
        "alright",
        "fine",
        "all",
        "right",
        "fancy",
        "it",
        "happy",
        "willing",
        "no",
        "hurry",
        "rush",
        "quite",
        "really",
        "pop",
        "wander",
        "walk",
        "run",
        "breath",
        "breather",
        "break",
        "nearby",
        "close",
        "handy",
        "want",
        "wish",
        "care",
        "please",
        "wouldn",
        "say",
        "think",
        "possible",
        "possibly",
        "great",
        "imposition",
    ];
    let starts = ["when", "whenever", "if", "once", "as soon as", "while", "since", "as"];
    let subject = |begin: &str| stands(tokens, at, &format!("{begin} you"));
    let count = starts.iter().find_map(|begin| subject(begin));
    let count = count.or_else(|| longest(tokens, at, &["if it is not", "if that is not"]))?;
    let mut end = at + count;
    if let Some(done) = longest(tokens, end, &["are done", "are finished", "have finished", "are through"]) {
        end += done;
        // What it is done with may be another task, which is not asked for; `done putting the mug away` asks for more.
        while tokens.get(end).is_some_and(|token| !token.word().is_empty() && !is_task(token.word())) {
            end += 1;
        }
    }
    while tokens.get(end).is_some_and(|token| LEISURE.contains(&token.word())) {
        end += 1;
    }
    let is_whole = matches!(tokens.get(end), None | Some(Token::Stop | Token::Comma));
    // `when you come back, have it with you` asks for it.
    let has = tokens.get(end) == Some(&Token::Comma)
        && longest(tokens, end + 1, &["have", "please have", "make sure you have"]).is_some();
    (is_whole && end > at + count && !has).then_some(end - at)
}

/// Whether a word is a verb of requests, in any form.
pub(super) fn is_task(word: &str) -> bool {
    base(word).is_some_and(|(_, form)| matches!(form, Form::Base | Form::Gerund | Form::Participle))
}
