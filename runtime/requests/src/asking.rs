//! How people ask whether somebody would do something: `I was wondering whether you might possibly`, `it would be a great help
//! if you could`, `do you think you'd be able to`. A grammar of what is composed there, since no table has all of it.
//!
//! Words of wishing, thinking and politeness lead up to who is asked and the modal verb; none of them denies or bounds
//! anything. Those that do, `not`, `unless`, `when`, are no part of it but in a few phrases that ask for the contrary of
//! what they say.

use super::inflection::{Form, base, of_past};
use super::token::{Token, stands};
use crate::english::{
    ANYONE_ASKED, ARE_YOU_ABLE, ASKED_PERSON, ASKING_WORDS, ASKS_IF, DOUBTS, GRATEFUL_WORDS, HAS_TIME,
    HELPING_WORDS, IN_ANOTHER_FORM_AM, IN_ANOTHER_FORM_SEE_TO, IN_ANOTHER_FORM_TO, MAY, MINDING, MODALS,
    MODALS_BEHIND, MODALS_OF_DUTY, NOT_FEELING, OVERTURES, SOFTENERS, SPEAKER, WE,
};
use crate::phrases::Phrases;

/// Where the words end that ask somebody for something, as a number of words; what is asked for stands behind.
pub(super) fn asking(tokens: &[Token], at: usize) -> Option<usize> {
    let (mut end, mut last) = (at, None);
    loop {
        if let Some(count) = asks(tokens, end) {
            last = Some(end + count);
        }
        match OVERTURES.longest(tokens, end) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + SOFTENERS.run(tokens, end) - at)
}

/// Where the words end with which somebody asks whether they may: `could I maybe`, `any chance that we might`, as a number of words.
pub(super) fn before_speaker(tokens: &[Token], at: usize) -> Option<usize> {
    let (mut end, mut last, mut doubts) = (at, None, false);
    loop {
        // `I can get it` tells, `could I get it` and `I wonder if I might get it` ask.
        let told = SPEAKER.longest(tokens, end).and_then(|who| Some(who + MAY.longest(tokens, end + who)?));
        let asked =
            MAY.longest(tokens, end).and_then(|modal| Some(modal + SPEAKER.longest(tokens, end + modal)?));
        if let Some(count) = told.filter(|_| doubts).max(asked) {
            last = Some(end + count);
        }
        doubts |= DOUBTS.longest(tokens, end).is_some();
        match OVERTURES.longest(tokens, end) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + SOFTENERS.run(tokens, end) - at)
}

/// `could you`, `you would`, `are you able to`: how many words it takes.
fn asks(tokens: &[Token], at: usize) -> Option<usize> {
    if let Some(who) = ASKED_PERSON.longest(tokens, at) {
        let modal = MODALS_BEHIND.longest(tokens, at + who).or_else(|| HAS_TIME.longest(tokens, at + who))?;
        let before = at.checked_sub(1).and_then(|at| tokens.get(at)).map_or("", Token::word);
        let is = |list: &Phrases| list.longest(tokens, at + who) == Some(modal);
        // `anyone can open it`, `you would open it` tell something where nothing leads up to them.
        let is_led = ASKS_IF.has(before);
        let needs_lead = tokens.get(at).is_some_and(|token| token.word() != "you")
            || stands(tokens, at + who, "would") == Some(modal);
        // `if you should open it` tells when, `it is nice of you to open it` what is done already.
        let tells = match before {
            "if" | "whether" => is(&MODALS_OF_DUTY),
            "of" => stands(tokens, at + who, "to") == Some(modal),
            _ => false,
        };
        return (!tells && (is_led || !needs_lead)).then_some(who + modal);
    }
    if let Some(count) = ARE_YOU_ABLE.longest(tokens, at) {
        return Some(count);
    }
    let modal = MODALS.longest(tokens, at)?;
    Some(modal + ASKED_PERSON.longest(tokens, at + modal)?)
}

/// `would you mind terribly popping it on the table`, `I'd be over the moon if you fetched it`: up to where the verb takes
/// the place of it, and the verb.
pub(super) fn in_another_form(tokens: &[Token], at: usize) -> Option<(usize, String)> {
    // `could you see your way to fetching`: what leads up to it was passed over.
    let before = at.checked_sub(1).and_then(|at| tokens.get(at)).map_or("", Token::word);
    if IN_ANOTHER_FORM_TO.has(before)
        && let Some((verb, Form::Gerund)) = base(tokens.get(at)?.word())
    {
        return Some((at + 1, verb));
    }
    let next = |end: &usize| {
        let count = OVERTURES.longest(tokens, *end).max(MINDING.longest(tokens, *end))?;
        Some(end + count)
    };
    let ends: Vec<usize> = std::iter::successors(Some(at), next).skip(1).collect();
    ends.into_iter().rev().find_map(|end| {
        let said = tokens.get(at..end)?;
        let verb = tokens.get(end)?.word();
        let has = |list: &Phrases| said.iter().any(|token| list.has(token.word()));
        let last = said.last()?.word();
        // `what are you doing`, `I am closing it` tell or ask what somebody does.
        let tells = IN_ANOTHER_FORM_AM.has(last);
        let sets_about = IN_ANOTHER_FORM_SEE_TO.longest(tokens, at);
        let asks = sets_about == Some(said.len())
            || has(&HELPING_WORDS)
            || (has(&ANYONE_ASKED) && has(&ASKING_WORDS));
        // `I mind opening it` tells how somebody feels.
        let feels = has(&WE) && !has(&NOT_FEELING);
        match base(verb) {
            Some((verb, Form::Gerund)) if !feels && asks && !tells => return Some((end + 1, verb)),
            _ => {}
        }
        let who = (1..said.len()).rev().find(|at| said.get(*at).is_some_and(|token| token.word() == "if"))?;
        let mut behind = who + 1 + ASKED_PERSON.longest(said, who + 1)?;
        behind += SOFTENERS.run(said, behind);
        let is_nice = has(&GRATEFUL_WORDS);
        (behind == said.len() && is_nice).then(|| Some((end + 1, of_past(verb)?)))?
    })
}
