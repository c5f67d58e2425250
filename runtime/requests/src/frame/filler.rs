//! Words of a request that say how, why or when it is convenient, and not what: they are left out.

use super::fill::{FILLERS, LASTING, LIES, NOT_MANNER, OTHERS, STRESSED};
use super::leisure::leisure;
use crate::inflection::{Form, base};
use crate::token::{Token, longest, stands};

/// A request without them.
pub(super) fn without_fillers(tokens: &[Token]) -> Vec<Token> {
    let mut kept: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        if let Some(count) = longest(tokens, at, FILLERS).or_else(|| manner(tokens, at)) {
            at += count;
        } else if let Some(count) =
            leisure(tokens, at).or_else(|| aim(tokens, at, &kept)).or_else(|| deadline(tokens, at, &kept))
        {
            at += count;
        } else if is_stress(tokens, at) {
            at += 1;
        } else if let Some((count, word)) = at_speaker(tokens, at) {
            kept.push(Token::Word(word.to_owned()));
            at += count;
        } else {
            kept.extend(tokens.get(at).cloned());
            at += 1;
        }
    }
    kept
}

/// `safely`, `nice and gently`, `all the way`, `somewhere in the drawer`: how, and where more or less.
fn manner(tokens: &[Token], at: usize) -> Option<usize> {
    let is_adverb = |at: usize| {
        let word = tokens.get(at).map_or("", Token::word);
        word.len() > 4 && word.ends_with("ly") && !NOT_MANNER.contains(&word)
    };
    let more =
        longest(tokens, at, &["nice and", "as", "very", "more", "so", "ever so", "really", "quite", "too"])
            .unwrap_or(0);
    if is_adverb(at + more) {
        // `as gently as you can`
        let behind = longest(tokens, at + more + 1, &["as you can", "as possible", "as you like"]);
        return match behind {
            Some(behind) => Some(more + 1 + behind),
            None if stands(tokens, at, "as").is_some() => None,
            None => Some(more + 1),
        };
    }
    let is_last = |at: usize| {
        matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
            || tokens.get(at).is_some_and(|token| {
                matches!(token.word(), "and" | "for" | "please" | "so" | "open" | "in" | "on" | "inside")
            })
    };
    let how = [
        "all the way",
        "somewhere",
        "a bit",
        "a little bit",
        "a tad",
        "really",
        "like that",
        "like this",
        "a minute",
        "a moment",
        "a second",
        "a sec",
        "a while",
    ];
    let count = longest(tokens, at, &how)?;
    let is_partial = tokens.get(at).is_some_and(|token| token.word() == "a");
    // `open it a little` asks for less than `open it`.
    let is_partial =
        is_partial && tokens.get(..at)?.iter().any(|token| matches!(token.word(), "open" | "close" | "shut"));
    (count == 1 && stands(tokens, at, "really").is_some() || (is_last(at + count) && !is_partial))
        .then_some(count)
}

/// `right here`, `straight into the drawer`, `i still need`
fn is_stress(tokens: &[Token], at: usize) -> bool {
    let word = |at: Option<usize>| at.and_then(|at| tokens.get(at)).map_or("", Token::word);
    let (before, here, next) = (word(at.checked_sub(1)), word(Some(at)), word(Some(at + 1)));
    match here {
        "right" | "straight" => before != "the" && STRESSED.contains(&next),
        "still" => matches!(before, "i" | "we" | "you"),
        _ => false,
    }
}

/// `where I am sitting`, `here with me`: where the person is.
fn at_speaker(tokens: &[Token], at: usize) -> Option<(usize, &'static str)> {
    if let Some(count) = [
        "over here with me",
        "here with me",
        "over here by me",
        "here by me",
        "over here next to me",
        "here next to me",
        "over here beside me",
        "here beside me",
        "by my side",
        "to my side",
    ]
    .iter()
    .find_map(|words| stands(tokens, at, words))
    {
        return Some((count, "here"));
    }
    let count = longest(tokens, at, &["where i am", "where we are", "where i sit", "where i stand"])?;
    let how = ["sitting", "standing", "lying", "at", "now", "stuck", "resting"];
    let is_how = tokens.get(at + count).is_some_and(|token| how.contains(&token.word()));
    let count = count + usize::from(is_how);
    matches!(tokens.get(at + count), None | Some(Token::Comma | Token::Stop)).then_some((count, "me"))
}

/// `so I can see it`, `before the kids see it`, `where I can reach it`, `until I say so`: what for, which changes nothing of
/// what is done now. How many words it takes.
fn aim(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let other = |at: usize| longest(tokens, at, OTHERS);
    let can = |at: usize| {
        let can = [
            "can",
            "could",
            "can not",
            "could not",
            "will not",
            "would not",
            "do not",
            "does not",
            "am not",
            "is not",
        ];
        longest(tokens, at, &can)
    };
    // `the` and `my` have a noun before the verb.
    let then_can = |who: usize| (who + 1..=who + 3).find_map(|at| Some(at + can(at)?));
    let clause = |who: usize| -> Option<usize> {
        other(who)?;
        let after = then_can(who)?;
        // `so it can go in the bin` asks for it.
        let next = tokens.get(after).map_or("", Token::word);
        let is_person = tokens.get(who).is_some_and(|token| matches!(token.word(), "i" | "we"));
        (is_person
            || !matches!(
                next,
                "go" | "be"
                    | "get"
                    | "stay"
                    | "end"
                    | "live"
                    | "have"
                    | "should"
                    | "goes"
                    | "belongs"
                    | "lives"
                    | "is"
                    | "has"
                    | "needs"
                    | "must"
            ))
        .then_some(after)
    };
    let begins_clause = matches!(kept.last(), None | Some(Token::Stop));
    let is_aim = match tokens.get(at)?.word() {
        "so" => {
            let that = stands(tokens, at, "so that").unwrap_or(1);
            let negated = then_negated(tokens, at + that);
            !begins_clause && (clause(at + that).is_some() || negated || purpose(tokens, at + that))
        }
        "where" => {
            let will = ["i will", "we will", "i am sure to", "i am going to"];
            !begins_clause && (clause(at + 1).is_some() || longest(tokens, at + 1, &will).is_some())
        }
        // The state in which it is now is no other thing.
        "instead" => {
            stands(tokens, at, "instead of").is_some()
                && tokens
                    .get(at + 2)
                    .is_some_and(|token| token.word() == "out" || LIES.contains(&token.word()))
                && !begins_clause
        }
        // `or I will scream`
        "or" => {
            let then = [
                "you are",
                "i am",
                "we are",
                "i will",
                "i am going to",
                "we will",
                "you will",
                "he will",
                "she will",
                "they will",
                "it will",
                "there will be",
                "somebody will",
                "someone will",
                "mum will",
                "mummy will",
                "dad will",
                "daddy will",
                "heads will",
            ];
            !begins_clause && longest(tokens, at + 1, &then).is_some()
        }
        // `…, not lying about`
        "not" => {
            let left = ["left", "out", "strewn", "scattered", "just", "on the floor", "all over"];
            kept.last() == Some(&Token::Comma)
                && [LIES, left.as_slice()].iter().any(|state| longest(tokens, at + 1, state).is_some())
        }
        "before" => {
            // `before dinner`, `before Granny comes`; `before you open it`, `before opening it` set an order.
            let next = tokens.get(at + 1).map_or("", Token::word);
            let is_task = base(next).is_some_and(|(_, form)| form == Form::Gerund);
            let is_told = !begins_clause || other(at + 1).is_some();
            is_told
                && !next.is_empty()
                && next != "you"
                && next != "putting"
                && !is_task
                && !orders(tokens, at + 1)
        }
        "until" | "till" => {
            let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
            other(at + 1).is_some() && sentence.iter().any(|token| LASTING.contains(&token.word()))
        }
        "when" | "by" => {
            let by = stands(tokens, at, "by the time").unwrap_or(1);
            let back = [
                "i get",
                "i am",
                "i come",
                "i return",
                "we get",
                "we are",
                "we come",
                "they get",
                "they come",
            ];
            let is_back = longest(tokens, at + by, &back).is_some();
            let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
            // Who wants something to be so by then wants it done before.
            let waits = sentence.iter().any(|token| matches!(token.word(), "waiting" | "ready"))
                || sentence.windows(2).any(|two| matches!(two, [have, the] if matches!(have.word(), "have" | "want" | "need" | "see" | "sure" | "ensure" | "that") && matches!(the.word(), "the" | "my" | "it")));
            is_back && !begins_clause && (waits || sentence.windows(2).any(is_state))
        }
        _ => false,
    };
    let rest = tokens.get(at..).unwrap_or_default();
    let end = rest.iter().position(|token| matches!(token, Token::Comma | Token::Stop)).unwrap_or(rest.len());
    // `before we go out I want it shut`: what is asked for begins without a comma.
    let asks = (at + 3..at + end).find(|begin| {
        crate::wish::wish(tokens, *begin).is_some()
            || longest(
                tokens,
                *begin,
                &[
                    "please",
                    "make sure",
                    "could you",
                    "would you",
                    "can you",
                    "will you",
                    "you need to",
                    "you have to",
                    "you must",
                ],
            )
            .is_some()
    });
    if begins_clause && let Some(begin) = asks {
        let said = tokens.get(at..begin)?;
        let is_before =
            stands(said, 0, "before").is_some() && !said.iter().any(|token| token.word() == "you");
        return is_before.then_some(begin - at);
    }
    is_aim.then_some(end)
}

/// `so the dog can not get it`: what shall not be asks for nothing else.
fn then_negated(tokens: &[Token], who: usize) -> bool {
    let not =
        ["can not", "could not", "will not", "would not", "does not", "do not", "is not", "are not", "never"];
    let is_other = longest(tokens, who, OTHERS).is_some() && stands(tokens, who, "you").is_none();
    is_other && (who + 1..=who + 4).any(|at| longest(tokens, at, &not).is_some())
}

/// `so nobody trips over it`, `so that we all know where it is`: somebody else does or does not do something then.
fn purpose(tokens: &[Token], who: usize) -> bool {
    let nobody = [
        "nobody",
        "no one",
        "none of us",
        "none of them",
        "everybody",
        "everyone",
        "we all",
        "they all",
        "anybody",
        "anyone",
    ];
    let is_told = |at: usize| {
        let does = [
            "is", "will", "would", "should", "must", "has", "had", "needs", "wants", "goes", "belongs",
            "please", "could",
        ];
        tokens.get(at).is_some_and(|token| !token.word().is_empty() && !does.contains(&token.word()))
    };
    let that = who.checked_sub(1).is_some_and(|at| stands(tokens, at, "that").is_some());
    let person = longest(tokens, who, &["i", "we", "he", "she", "they"]);
    let does = ["need", "want", "would", "should", "must", "will", "am", "have to"];
    longest(tokens, who, &nobody).is_some_and(|count| is_told(who + count))
        || person.is_some_and(|count| that && longest(tokens, who + count, &does).is_none())
}

/// `I need it there in two minutes`: by when. Of what somebody is told to do it says when, and stays.
fn deadline(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    const COUNTS: &[&str] = &["a", "one", "two", "three", "five", "ten", "a few", "a couple of"];
    let count = stands(tokens, at, "in").or_else(|| stands(tokens, at, "within"))?;
    let count = count + longest(tokens, at + count, COUNTS)?;
    let unit = tokens.get(at + count)?.word();
    let is_unit = matches!(unit, "second" | "seconds" | "minute" | "minutes" | "moment");
    let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
    let clause = sentence.rsplit(|token| *token == Token::Comma).next().unwrap_or_default();
    let needs = [
        "have",
        "please have",
        "make sure",
        "i would like",
        "we would like",
        "i need",
        "we need",
        "i want",
        "we want",
    ];
    (is_unit && longest(clause, 0, &needs).is_some()).then_some(count + 1)
}

/// Whether a clause says what the one who is spoken to does.
fn orders(tokens: &[Token], at: usize) -> bool {
    let is_end = |token: &&Token| matches!(token, Token::Comma | Token::Stop);
    tokens
        .get(at..)
        .unwrap_or_default()
        .iter()
        .take_while(|token| !is_end(token))
        .any(|token| token.word() == "you")
}

fn is_state(two: &[Token]) -> bool {
    matches!(two, [to, be] if matches!(to.word(), "to" | "should" | "must") && matches!(be.word(), "be" | "stay"))
}
