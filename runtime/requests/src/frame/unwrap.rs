//! Frames around one imperative, taken off: `would you mind`, `go over and`, `my wife wants you to`.

use super::clause::cause;
use super::favour::{stressed, told_when_done};
use super::setting_out::{GOES_FOR, MIND, SET_OUT};
use super::state;
use crate::inflection::{Form, base, of_past};
use crate::noun::{Noun, noun};
use crate::token::{Token, longest, run, stands};
use crate::verb::{Act, begins, verb};

/// A frame around an imperative: what stands for the tokens up to where.
pub(super) fn unwrapped(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    let mind = longest(tokens, at, MIND);
    if let Some(count) = mind
        && let Some((verb, Form::Gerund)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    if let Some(found) = told_when_done(tokens, at).or_else(|| stressed(tokens, at)) {
        return Some(found);
    }
    // `when you come back to me, have it with you`
    let coming = [
        "when you come",
        "when you come back",
        "when you return",
        "when you get back",
        "when you are back",
        "when you next come",
        "when you get here",
        "come",
        "come back",
        "return",
        "get back",
        "come over",
        "next time you come",
        "on your way back",
        "on the way back",
        "on your way here",
    ];
    if let Some(count) = longest(tokens, at, &coming) {
        let mut have = at
            + count
            + run(tokens, at + count, &["over", "here", "to me", "to us", "back", "from there", "again"]);
        have += usize::from(tokens.get(have) == Some(&Token::Comma));
        have += longest(tokens, have, &["and", "then"]).unwrap_or(0);
        if let Some(has) = longest(
            tokens,
            have,
            &[
                "have",
                "make sure you have",
                "you should have",
                "please have",
                "be sure to have",
                "make sure to have",
            ],
        ) && let Some((_, after)) = noun(tokens, have + has)
            && let Some(with) = longest(tokens, after, &["with you", "in your hand", "on you"])
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
    let rather = [
        "i would rather you",
        "i would sooner you",
        "i would prefer it if you",
        "i would prefer that you",
        "i would prefer you to",
        "i wish you",
        "it is time you",
        "it is about time you",
        "it is high time you",
        "it is time somebody",
        "it is time someone",
        "it is about time somebody",
        "it is about time someone",
        "it is high time somebody",
        "it is high time someone",
        "it is time we",
        "it is about time we",
        "it is high time we",
        "what if you",
        "i would like it if you",
        "i would love it if you",
        "i would be glad if you",
        "i would be happy if you",
    ];
    if let Some(count) = longest(tokens, at, &rather) {
        let word = tokens.get(at + count)?.word();
        if matches!(word, "were" | "was") {
            return Some((at + count + 1, state::words("go")));
        }
        let verb = base(word).filter(|(_, form)| *form == Form::Base).map(|(verb, _)| verb);
        return Some((at + count + 1, vec![Token::Word(verb.or_else(|| of_past(word))?)]));
    }
    // `once you have opened it, …`
    if let Some(count) = longest(tokens, at, &["once you have", "after you have", "as soon as you have"])
        && let Some((verb, Form::Participle)) = base(tokens.get(at + count)?.word())
    {
        return Some((at + count + 1, vec![Token::Word(verb)]));
    }
    // `once you have got hold of it, …`
    let got = ["once you have got hold of", "after you have got hold of", "as soon as you have got hold of"];
    if let Some(count) = longest(tokens, at, &got) {
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
    if let Some(count) = longest(
        tokens,
        at,
        &["somebody", "someone", "anybody", "anyone", "one of you", "will somebody", "everybody"],
    ) && let Some((verb, Form::Base)) = tokens.get(at + count).and_then(|token| base(token.word()))
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
    if let Some(count) = longest(
        tokens,
        at,
        &[
            "let me into",
            "let us into",
            "let me get into",
            "get me into",
            "let me inside",
            "let me get inside",
            "give me access to",
        ],
    ) && let Some((Noun::Phrase(_), after)) = noun(tokens, at + count)
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
    let gets = [
        "make sure i get",
        "make sure that i get",
        "make sure i have",
        "see that i get",
        "see to it that i get",
        "see to it that i have",
        "ensure i get",
        "ensure that i get",
    ];
    if let Some(count) = longest(tokens, at, &gets) {
        return Some((at + count, state::words("bring me")));
    }
    if let Some(count) = longest(tokens, at, GOES_FOR)
        && tokens.get(at + count)?.word() == "grab"
        && stands(tokens, at + count + 1, "hold").is_none()
    {
        return Some((at + count + 1, state::words("fetch")));
    }
    // `go over there, pick it up`
    let there = [
        "move out of the way",
        "get out of the way",
        "get out of my way",
        "move aside",
        "step aside",
        "out of the way",
        "come along",
        "come on",
        "go over there",
        "go on over",
        "come over here",
        "come here",
        "turn around",
        "get up",
        "wake up",
        "go ahead",
        "look here",
        "look there",
    ];
    if let Some(count) = longest(tokens, at, &there)
        && tokens.get(at + count) == Some(&Token::Comma)
        && begins(tokens, at + count + 1)
    {
        return Some((at + count + 1, Vec::new()));
    }
    let set_out = longest(tokens, at, SET_OUT)?;
    let next = tokens.get(at + set_out)?.word();
    let is_verb = base(next).is_some_and(|(_, form)| form == Form::Base) && begins(tokens, at + set_out);
    let is_verb = is_verb || cause(tokens, at + set_out).is_some();
    is_verb.then(|| (at + set_out, Vec::new()))
}

/// What somebody else wants of the one who is spoken to, as the speaker says: how many words it takes.
pub(super) fn relayed(tokens: &[Token], at: usize) -> Option<usize> {
    const SAYS: &[&str] = &[
        "says",
        "said",
        "thinks",
        "reckons",
        "told me",
        "tells me",
        "insists",
        "insisted",
        "says that",
        "said that",
        "thinks that",
        "reckons that",
        "insists that",
        "told me that",
        "asked if",
        "asked whether",
        "is asking if",
        "is asking whether",
        "asks if",
        "asks whether",
        "would like it if",
        "wonders if",
        "wonders whether",
        "is wondering if",
        "is wondering whether",
        "would be glad if",
        "would be happy if",
        "suggests",
        "suggests that",
        "hopes",
        "is hoping",
        "would appreciate it if",
    ];
    const YOU: &[&str] = &[
        "you have to",
        "you must",
        "you should",
        "you need to",
        "you are to",
        "you ought to",
        "you had better",
        "you can",
        "you could",
        "you would",
        "you have got to",
        "you might",
        "you will",
    ];
    const WANTS: &[&str] = &[
        "wants you to",
        "needs you to",
        "would like you to",
        "would love you to",
        "asked you to",
        "has asked you to",
        "is asking you to",
        "asks you to",
        "expects you to",
        "would love for you to",
        "would like for you to",
        "requires you to",
        "orders you to",
        "commands you to",
        "begs you to",
    ];
    let is_who = |token: &Token| {
        let word = token.word();
        !word.is_empty()
            && !matches!(
                word,
                "i" | "we"
                    | "you"
                    | "it"
                    | "nobody"
                    | "not"
                    | "never"
                    | "if"
                    | "when"
                    | "who"
                    | "what"
                    | "that"
                    | "no"
            )
    };
    (at + 1..=at + 3).find_map(|end| {
        if !tokens.get(at..end)?.iter().all(is_who) {
            return None;
        }
        if let Some(count) = longest(tokens, end, WANTS) {
            return Some(end + count - at);
        }
        let says = end + longest(tokens, end, SAYS)?;
        Some(says + longest(tokens, says, YOU)? - at)
    })
}

/// `lock it away`, `track it down`: the verb with its small word, and up to where the thing stands that it takes in.
pub(super) fn apart(tokens: &[Token], at: usize) -> Option<(usize, Vec<Token>)> {
    const VERBS: &[(&str, &str, &str)] = &[
        ("lock", "away", "store"),
        ("lock", "up", "store"),
        ("shut", "up", "store"),
        ("shut", "away", "store"),
        ("file", "away", "store"),
        ("squirrel", "away", "store"),
        ("whisk", "away", "stow"),
        ("track", "down", "find"),
        ("hunt", "down", "find"),
        ("seek", "out", "find"),
        ("dig", "out", "fetch"),
        ("fish", "out", "fetch"),
        ("fish", "up", "fetch"),
        ("do", "away with", "discard"),
        ("snap", "up", "pick up"),
        ("scoop", "up", "pick up"),
        ("whip", "up", "pick up"),
        ("snatch", "up", "pick up"),
        ("gather", "up", "pick up"),
        ("heave", "up", "lift"),
    ];
    let word = tokens.get(at)?.word();
    let (_, after) = noun(tokens, at + 1).filter(|_| VERBS.iter().any(|(verb, _, _)| *verb == word))?;
    let (_, small, means) =
        VERBS.iter().find(|(verb, small, _)| *verb == word && stands(tokens, after, small).is_some())?;
    let count = stands(tokens, after, small)?;
    let mut said = state::words(means);
    said.extend_from_slice(tokens.get(at + 1..after)?);
    Some((after + count, said))
}
