//! Words of a request that say how, why or when it is convenient, and not what: they are left out.

use super::leisure::leisure;
use crate::english::{
    AIM_BACK, AIM_CAN, AIM_GO, AIM_HAVE, AIM_LEFT, AIM_PLEASE, AIM_THEN, AIM_WILL, AT_SPEAKER_HOW,
    AT_SPEAKER_OVER_HERE_WITH_ME, AT_SPEAKER_WHERE_I_AM, DEADLINE_COUNTS, DEADLINE_NEEDS, DEADLINE_SECOND,
    FILLERS, LASTING_VERBS, LYING_ABOUT, MANNER_AND, MANNER_AS_YOU_CAN, MANNER_HOW, MANNER_NICE_AND,
    NEGATIONS, NO_ADVERBS, OTHERS, PERSON_DOES, PURPOSE_DOES, PURPOSE_I, PURPOSE_NOBODY, STRESSED,
};
use crate::inflection::{Form, base};
use crate::token::{Token, stands};

/// A request without them.
pub(super) fn without_fillers(tokens: &[Token]) -> Vec<Token> {
    let mut kept: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut at = 0;
    while at < tokens.len() {
        if let Some(count) = FILLERS.longest(tokens, at).or_else(|| manner(tokens, at)) {
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
        word.len() > 4 && word.ends_with("ly") && !NO_ADVERBS.has(word)
    };
    let more = MANNER_NICE_AND.longest(tokens, at).unwrap_or(0);
    if is_adverb(at + more) {
        // `as gently as you can`
        let behind = MANNER_AS_YOU_CAN.longest(tokens, at + more + 1);
        return match behind {
            Some(behind) => Some(more + 1 + behind),
            None if stands(tokens, at, "as").is_some() => None,
            None => Some(more + 1),
        };
    }
    let is_last = |at: usize| {
        matches!(tokens.get(at), None | Some(Token::Comma | Token::Stop))
            || tokens.get(at).is_some_and(|token| MANNER_AND.has(token.word()))
    };
    let count = MANNER_HOW.longest(tokens, at)?;
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
        "right" | "straight" => before != "the" && STRESSED.has(next),
        "still" => matches!(before, "i" | "we" | "you"),
        _ => false,
    }
}

/// `where I am sitting`, `here with me`: where the person is.
fn at_speaker(tokens: &[Token], at: usize) -> Option<(usize, &'static str)> {
    if let Some(count) = AT_SPEAKER_OVER_HERE_WITH_ME.longest(tokens, at) {
        return Some((count, "here"));
    }
    let count = AT_SPEAKER_WHERE_I_AM.longest(tokens, at)?;
    let is_how = tokens.get(at + count).is_some_and(|token| AT_SPEAKER_HOW.has(token.word()));
    let count = count + usize::from(is_how);
    matches!(tokens.get(at + count), None | Some(Token::Comma | Token::Stop)).then_some((count, "me"))
}

/// `so I can see it`, `before the kids see it`, `where I can reach it`, `until I say so`: what for, which changes nothing of
/// what is done now. How many words it takes.
fn aim(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let other = |at: usize| OTHERS.longest(tokens, at);
    let can = |at: usize| AIM_CAN.longest(tokens, at);
    // `the` and `my` have a noun before the verb.
    let then_can = |who: usize| (who + 1..=who + 3).find_map(|at| Some(at + can(at)?));
    let clause = |who: usize| -> Option<usize> {
        other(who)?;
        let after = then_can(who)?;
        // `so it can go in the bin` asks for it.
        let next = tokens.get(after).map_or("", Token::word);
        let is_person = tokens.get(who).is_some_and(|token| matches!(token.word(), "i" | "we"));
        (is_person || !AIM_GO.has(next)).then_some(after)
    };
    let begins_clause = matches!(kept.last(), None | Some(Token::Stop));
    let is_aim = match tokens.get(at)?.word() {
        "so" => {
            let that = stands(tokens, at, "so that").unwrap_or(1);
            let negated = then_negated(tokens, at + that);
            !begins_clause && (clause(at + that).is_some() || negated || purpose(tokens, at + that))
        }
        "where" => !begins_clause && (clause(at + 1).is_some() || AIM_WILL.longest(tokens, at + 1).is_some()),
        // The state in which it is now is no other thing.
        "instead" => {
            stands(tokens, at, "instead of").is_some()
                && tokens
                    .get(at + 2)
                    .is_some_and(|token| token.word() == "out" || LYING_ABOUT.has(token.word()))
                && !begins_clause
        }
        // `or I will scream`
        "or" => !begins_clause && AIM_THEN.longest(tokens, at + 1).is_some(),
        // `…, not lying about`
        "not" => {
            kept.last() == Some(&Token::Comma)
                && LYING_ABOUT.longest(tokens, at + 1).max(AIM_LEFT.longest(tokens, at + 1)).is_some()
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
            other(at + 1).is_some() && sentence.iter().any(|token| LASTING_VERBS.has(token.word()))
        }
        "when" | "by" => {
            let by = stands(tokens, at, "by the time").unwrap_or(1);
            let is_back = AIM_BACK.longest(tokens, at + by).is_some();
            let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
            // Who wants something to be so by then wants it done before.
            let waits = sentence.iter().any(|token| matches!(token.word(), "waiting" | "ready"))
                || sentence.windows(2).any(|two| matches!(two, [have, the] if AIM_HAVE.has(have.word()) && matches!(the.word(), "the" | "my" | "it")));
            is_back && !begins_clause && (waits || sentence.windows(2).any(is_state))
        }
        _ => false,
    };
    let rest = tokens.get(at..).unwrap_or_default();
    let end = rest.iter().position(|token| matches!(token, Token::Comma | Token::Stop)).unwrap_or(rest.len());
    // `before we go out I want it shut`: what is asked for begins without a comma.
    let asks = (at + 3..at + end).find(|begin| {
        crate::wish::wish(tokens, *begin).is_some() || AIM_PLEASE.longest(tokens, *begin).is_some()
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
    let is_other = OTHERS.longest(tokens, who).is_some() && stands(tokens, who, "you").is_none();
    is_other && (who + 1..=who + 4).any(|at| NEGATIONS.longest(tokens, at).is_some())
}

/// `so nobody trips over it`, `so that we all know where it is`: somebody else does or does not do something then.
fn purpose(tokens: &[Token], who: usize) -> bool {
    let is_told = |at: usize| {
        tokens.get(at).is_some_and(|token| !token.word().is_empty() && !PURPOSE_DOES.has(token.word()))
    };
    let that = who.checked_sub(1).is_some_and(|at| stands(tokens, at, "that").is_some());
    let person = PURPOSE_I.longest(tokens, who);
    PURPOSE_NOBODY.longest(tokens, who).is_some_and(|count| is_told(who + count))
        || person.is_some_and(|count| that && PERSON_DOES.longest(tokens, who + count).is_none())
}

/// `I need it there in two minutes`: by when. Of what somebody is told to do it says when, and stays.
fn deadline(tokens: &[Token], at: usize, kept: &[Token]) -> Option<usize> {
    let count = stands(tokens, at, "in").or_else(|| stands(tokens, at, "within"))?;
    let count = count + DEADLINE_COUNTS.longest(tokens, at + count)?;
    let unit = tokens.get(at + count)?.word();
    let is_unit = DEADLINE_SECOND.has(unit);
    let sentence = kept.rsplit(|token| *token == Token::Stop).next().unwrap_or_default();
    let clause = sentence.rsplit(|token| *token == Token::Comma).next().unwrap_or_default();
    (is_unit && DEADLINE_NEEDS.longest(clause, 0).is_some()).then_some(count + 1)
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
