//! How people ask whether somebody would do something: `I was wondering whether you might possibly`, `it would be a great help
//! if you could`, `do you think you'd be able to`. A grammar of what is composed there, since no table has all of it.
//!
//! Words of wishing, thinking and politeness lead up to who is asked and the modal verb; none of them denies or bounds
//! anything. Those that do, `not`, `unless`, `when`, are no part of it but in a few phrases that ask for the contrary of
//! what they say.

use super::inflection::{Form, base, of_past};
use super::manners::{ABLE, BEHIND, MODAL, SOFT, WHO};
use super::overture::{MINDS, OPEN};
use super::token::{Token, longest, run};

/// Where the words end that ask somebody for something, as a number of words; what is asked for stands behind.
pub(super) fn asking(tokens: &[Token], at: usize) -> Option<usize> {
    let (mut end, mut last) = (at, None);
    loop {
        if let Some(count) = asks(tokens, end) {
            last = Some(end + count);
        }
        match longest(tokens, end, OPEN) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + run(tokens, end, SOFT) - at)
}

/// Where the words end with which somebody asks whether they may: `could I maybe`, `any chance that we might`, as a number of words.
pub(super) fn before_speaker(tokens: &[Token], at: usize) -> Option<usize> {
    const ME: &[&str] = &["i", "we", "one", "this old man", "this old woman"];
    const MAY: &[&str] = &["could", "can", "may", "might"];
    const DOUBTS: &[&str] = &[
        "chance",
        "chances",
        "wonder",
        "wondering",
        "was wondering",
        "hope",
        "hoping",
        "was hoping",
        "if",
        "whether",
        "possible",
        "possibility",
        "way",
        "you",
    ];
    let (mut end, mut last, mut doubts) = (at, None, false);
    loop {
        // `I can get it` tells, `could I get it` and `I wonder if I might get it` ask.
        let told = longest(tokens, end, ME).and_then(|who| Some(who + longest(tokens, end + who, MAY)?));
        let asked =
            longest(tokens, end, MAY).and_then(|modal| Some(modal + longest(tokens, end + modal, ME)?));
        if let Some(count) = told.filter(|_| doubts).max(asked) {
            last = Some(end + count);
        }
        doubts |= longest(tokens, end, DOUBTS).is_some();
        match longest(tokens, end, OPEN) {
            Some(count) => end += count,
            None => break,
        }
    }
    let end = last?;
    Some(end + run(tokens, end, SOFT) - at)
}

/// `could you`, `you would`, `are you able to`: how many words it takes.
fn asks(tokens: &[Token], at: usize) -> Option<usize> {
    if let Some(who) = longest(tokens, at, WHO) {
        let modal = longest(tokens, at + who, BEHIND).or_else(|| has_time(tokens, at + who))?;
        let before = at.checked_sub(1).and_then(|at| tokens.get(at)).map_or("", Token::word);
        let is = |table: &[&str]| longest(tokens, at + who, table) == Some(modal);
        // `anyone can open it`, `you would open it` tell something where nothing leads up to them.
        let is_led = matches!(
            before,
            "if" | "whether"
                | "wish"
                | "hope"
                | "hoping"
                | "chance"
                | "chances"
                | "that"
                | "think"
                | "suppose"
                | "reckon"
                | "way"
                | "possible"
                | "possibility"
                | "need"
                | "want"
                | "like"
                | "love"
                | "for"
                | "ask"
                | "imagine"
                | "trust"
                | "believe"
                | "guess"
        );
        let needs_lead = tokens.get(at).is_some_and(|token| token.word() != "you") || is(&["would"]);
        // `if you should open it` tells when, `it is nice of you to open it` what is done already.
        let tells = match before {
            "if" | "whether" => {
                is(&["should", "must", "ought to", "to", "need to", "have to", "have got to", "are to"])
            }
            "of" => is(&["to"]),
            _ => false,
        };
        return (!tells && (is_led || !needs_lead)).then_some(who + modal);
    }
    if let Some(are) = longest(tokens, at, &["are", "would", "will", "could", "can"]) {
        let who = longest(tokens, at + are, WHO)?;
        let be = longest(tokens, at + are + who, &["be"]).unwrap_or(0);
        if let Some(able) = longest(tokens, at + are + who + be, ABLE) {
            return Some(are + who + be + able);
        }
    }
    let modal = longest(tokens, at, MODAL)?;
    Some(modal + longest(tokens, at + modal, WHO)?)
}

/// `have two seconds to`, `have until I count to three to`: how many words it takes.
fn has_time(tokens: &[Token], at: usize) -> Option<usize> {
    let mut end =
        at + longest(tokens, at, &["have", "have got", "have exactly", "have only got", "have just"])?;
    end += longest(
        tokens,
        end,
        &[
            "a",
            "one",
            "two",
            "three",
            "five",
            "ten",
            "thirty",
            "sixty",
            "a few",
            "a couple of",
            "exactly one",
            "exactly two",
        ],
    )?;
    end += longest(
        tokens,
        end,
        &["second", "seconds", "minute", "minutes", "moment", "moments", "sec", "secs", "min", "mins"],
    )?;
    Some(end + longest(tokens, end, &["to"])? - at)
}

/// `would you mind terribly popping it on the table`, `I'd be over the moon if you fetched it`: up to where the verb takes
/// the place of it, and the verb.
pub(super) fn in_another_form(tokens: &[Token], at: usize) -> Option<(usize, String)> {
    // `could you see your way to fetching`: what leads up to it was passed over.
    let before = at.checked_sub(1).and_then(|at| tokens.get(at)).map_or("", Token::word);
    if matches!(before, "to" | "by" | "about" | "of" | "mind")
        && let Some((verb, Form::Gerund)) = base(tokens.get(at)?.word())
    {
        return Some((at + 1, verb));
    }
    let next = |end: &usize| {
        let count = longest(tokens, *end, OPEN).max(longest(tokens, *end, MINDS))?;
        Some(end + count)
    };
    let ends: Vec<usize> = std::iter::successors(Some(at), next).skip(1).collect();
    ends.into_iter().rev().find_map(|end| {
        let said = tokens.get(at..end)?;
        let verb = tokens.get(end)?.word();
        let has = |words: &[&str]| said.iter().any(|token| words.contains(&token.word()));
        let last = said.last()?.word();
        // `what are you doing`, `I am closing it` tell or ask what somebody does.
        let tells =
            matches!(last, "am" | "is" | "are" | "be" | "i" | "we" | "start" | "begin" | "it" | "time");
        let sets_about = longest(
            tokens,
            at,
            &["see to", "see about", "set about", "go about", "get on with", "be amenable to", "be up for"],
        );
        let asks = sets_about == Some(said.len())
            || has(&[
                "help",
                "hand",
                "mind",
                "minding",
                "consider",
                "considering",
                "object",
                "opposed",
                "averse",
                "fancy",
                "try",
            ])
            || (has(&["you", "somebody", "someone", "anybody", "anyone"])
                && has(&[
                    "would",
                    "could",
                    "can",
                    "appreciate",
                    "appreciated",
                    "chance",
                    "chances",
                    "about",
                    "possibility",
                    "like",
                    "love",
                ]));
        // `I mind opening it` tells how somebody feels.
        let feels = has(&["i", "we"])
            && !has(&["would", "could", "need", "want", "can", "not", "hoping", "if", "you"]);
        match base(verb) {
            Some((verb, Form::Gerund)) if !feels && asks && !tells => return Some((end + 1, verb)),
            _ => {}
        }
        let who = (1..said.len()).rev().find(|at| said.get(*at).is_some_and(|token| token.word() == "if"))?;
        let mut behind = who + 1 + longest(said, who + 1, WHO)?;
        behind += run(said, behind, SOFT);
        let is_nice = has(&[
            "would",
            "could",
            "grateful",
            "obliged",
            "glad",
            "appreciate",
            "mind",
            "okay",
            "ok",
            "fine",
        ]);
        (behind == said.len() && is_nice).then(|| Some((end + 1, of_past(verb)?)))?
    })
}
