//! Indirect requests: `I was wondering whether you might possibly`, `it would be a great help
//! if you could`, `do you think you'd be able to`. A grammar of what is composed there, since no table has
//! all of it.
//!
//! Words of wishing, thinking and politeness lead up to who is asked and the modal verb; none of them denies
//! or bounds anything. Those that do, `not`, `unless`, `when`, are no part of it but in a few phrases that
//! ask for the contrary of what they say.

use super::token::{Token, stands};
use crate::english::{
    ARE_YOU_ABLE, ASKED_PERSON, ASKS_IF, DOUBTS, HAS_TIME, MAY, MINDING, MODALS, MODALS_BEHIND,
    MODALS_OF_DUTY, OVERTURES, SOFTENERS, SPEAKER,
};

/// Finds where the words end that ask somebody for something, as a number of words; what is asked for stands
/// behind.
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

/// Finds where the words end with which somebody asks whether they may: `could I maybe`, `any chance that we
/// might`, as a number of words.
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

/// The ends of words of wishing, thinking and politeness that stand one behind another.
pub(super) fn overtures(tokens: &[Token], at: usize) -> Vec<usize> {
    let next = |end: &usize| {
        let count = OVERTURES.longest(tokens, *end).max(MINDING.longest(tokens, *end))?;
        Some(end + count)
    };
    std::iter::successors(Some(at), next).skip(1).collect()
}
