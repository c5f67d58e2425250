//! Where somebody says that things are: `the coke is in the fridge`, `I left it in the cupboard yesterday`, `try the drawer`.
//!
//! A clause is such a fact as a whole or not at all: who sits at a table says nothing of what is on it.

use crate::english::{
    ADVICE, BEFORE_REPORT, BEHIND_REPORT, FINDS, HAD, IS_HABIT_ALWAYS, IS_SOMEWHERE, IS_SOMEWHERE_HOW,
    LOOK_THERE, NEXT_PLACE, NO_REPORTER, PUT_SOMEWHERE, PUTS_PAST, REPORT_DENIALS, REPORTED_SAYS, REPORTER,
    REPORTER_ARTICLE, REPORTER_HAS, SAID_LIVES, SAID_SEEN, SAID_THERE, SPOTS_GOES_ON, SURELY, TOLD_THERE,
};
use crate::phrases::Phrases;
use smol_str::SmolStr;

use super::ReportedLocation;
use super::hedge;
use super::meaning::{OBJECTS, Reader};
use super::noun::{Noun, noun};
use super::spot::{Relation, Spot, spot, way};
use super::token::{Token, stands};
use super::vocabulary::Role;

/// Whether a clause answers the question where something is, so that a bare place is one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Clause {
    Answer,
    Statement,
}

impl Reader<'_> {
    /// What an answer says of where things are. Of the same thing more than one place is where to look first, then next.
    pub(super) fn told(&mut self, tokens: &[Token]) -> Vec<ReportedLocation> {
        let mut told = Vec::new();
        for sentence in tokens.split(|token| *token == Token::Stop) {
            let mut here = Vec::new();
            for clause in sentence.split(|token| *token == Token::Comma) {
                // `I put it in the fridge, but it is not there any more`
                if denies(clause) && clause.iter().any(|token| TOLD_THERE.has(token.word())) {
                    here.clear();
                }
                here.extend(self.whereabouts(clause, Clause::Answer));
            }
            told.extend(here);
        }
        told
    }

    /// What one clause says of where something is; nothing where it says something else.
    pub(super) fn whereabouts(&mut self, tokens: &[Token], clause: Clause) -> Vec<ReportedLocation> {
        let begin = reported(tokens, leading(tokens, 0, clause), clause);
        // `is it not in the fridge?` proposes it.
        let proposes = clause == Clause::Answer
            && LOOK_THERE
                .longest(tokens, begin)
                .is_some_and(|count| !denies(tokens.get(begin + count..).unwrap_or_default()));
        // Who says beside a request where something is kept as a rule does not say that it is there.
        if (clause == Clause::Statement && is_habit(tokens))
            || (denies(tokens) && !proposes)
            || begin >= tokens.len()
        {
            return Vec::new();
        }
        let Some((thing, spots)) = said(tokens, begin, clause) else { return Vec::new() };
        let Ok(things) = self.things(&thing, OBJECTS, None) else { return Vec::new() };
        let [thing] = things.as_slice() else { return Vec::new() };
        let located: Option<Vec<ReportedLocation>> =
            spots.iter().map(|spot| self.located(thing, spot)).collect();
        let located = located.unwrap_or_default();
        if let Some(first) = located.first() {
            self.vocabulary.moved(thing, &first.place);
            self.said.spoken_of.push(thing.clone());
        }
        located
    }

    /// Where something is kept, as a clause says that tells a rule.
    pub(super) fn whereabouts_of_habit(&mut self, tokens: &[Token]) -> Option<ReportedLocation> {
        if denies(tokens) {
            return None;
        }
        let (thing, spots) = said(tokens, skip(tokens, 0, &BEFORE_REPORT), Clause::Answer)?;
        let ([spot], Ok(things)) = (spots.as_slice(), self.things(&thing, OBJECTS, None)) else {
            return None;
        };
        let [thing] = things.as_slice() else { return None };
        self.located(thing, spot)
    }

    fn located(&mut self, thing: &SmolStr, spot: &Spot) -> Option<ReportedLocation> {
        let places = self.things(&spot.noun, &[Role::Surface, Role::Container], None).ok()?;
        let [place] = places.as_slice() else { return None };
        let role = self.vocabulary.thing(place)?.role;
        // What is at a drawer may be in it or beside it.
        let is_clear = spot.relation != Relation::At || role != Role::Container;
        let relation = if role == Role::Container { "in" } else { "on" };
        (spot.relation.fits(role) && is_clear).then(|| ReportedLocation {
            thing: thing.clone(),
            relation,
            place: place.clone(),
        })
    }
}

/// Whether a clause tells what is so as a rule.
pub(super) fn is_habit(tokens: &[Token]) -> bool {
    tokens.iter().any(|token| IS_HABIT_ALWAYS.has(token.word()))
}

/// Which thing a clause places, and where.
fn said(tokens: &[Token], at: usize, clause: Clause) -> Option<(Noun, Vec<Spot>)> {
    let it = || Noun::Before("it");
    let is_answer = clause == Clause::Answer;
    // `in the cupboard`
    if let Some(spots) = spots(tokens, at, false) {
        return Some((it(), spots));
    }
    // `it in the cupboard`, behind `you will see`
    if is_answer
        && stands(tokens, at, "it").is_some()
        && let Some(spots) = spots(tokens, skip(tokens, at + 1, &IS_SOMEWHERE_HOW), false)
    {
        return Some((it(), spots));
    }
    let look = LOOK_THERE.longest(tokens, at).filter(|_| is_answer);
    if let Some(count) = look {
        // `look for it in the cupboard`
        let for_it = stands(tokens, at + count, "for it").unwrap_or(0);
        return Some((it(), spots(tokens, at + count + for_it, true)?));
    }
    // `should be in the fridge`
    if let (true, Some(count)) = (is_answer, IS_SOMEWHERE.longest(tokens, at)) {
        return Some((it(), spots(tokens, skip(tokens, at + count, &IS_SOMEWHERE_HOW), false)?));
    }
    // `there is a can in the fridge`
    if let Some(count) = SAID_THERE.longest(tokens, at) {
        let (thing, after) = noun(tokens, at + count)?;
        return Some((thing, spots(tokens, after, false)?));
    }
    // `somebody moved it to the cupboard`
    if REPORTER.has(tokens.get(at)?.word()) {
        let is_kin = matches!(tokens.get(at)?.word(), "my" | "our");
        let verb = skip(tokens, at + 1 + usize::from(is_kin), &REPORTER_HAS);
        // `I had it in the fridge`
        let verb = if is_one_of(tokens, verb - 1, &HAD) && !is_one_of(tokens, verb, &PUT_SOMEWHERE) {
            verb - 1
        } else {
            verb
        };
        // `I saw somebody put it in the fridge`
        let verb = verb + SAID_SEEN.longest(tokens, verb).unwrap_or(0);
        let is_to_come = tokens.get(at..verb)?.iter().any(|token| token.word() == "will");
        let is_found = is_one_of(tokens, verb, &FINDS);
        if !is_one_of(tokens, verb, &PUT_SOMEWHERE) || (is_to_come && !is_found) {
            return None;
        }
        let (thing, after) = noun(tokens, verb + 1)?;
        return Some((thing, spots(tokens, skip(tokens, after, &IS_SOMEWHERE_HOW), false)?));
    }
    // `Tommy put it in the fridge`
    let named = if is_one_of(tokens, at, &REPORTER_ARTICLE) { at + 2 } else { at + 1 };
    let verb = skip(tokens, named, &REPORTER_HAS);
    let verb =
        if verb > named && is_one_of(tokens, verb - 1, &HAD) && !is_one_of(tokens, verb, &PUT_SOMEWHERE) {
            verb - 1
        } else {
            verb
        };
    let is_past = is_one_of(tokens, verb, &PUTS_PAST);
    if is_answer
        && is_past
        && !is_one_of(tokens, at, &NO_REPORTER)
        && let Some((thing @ Noun::Before(_), after)) = noun(tokens, verb + 1)
    {
        return Some((thing, spots(tokens, skip(tokens, after, &IS_SOMEWHERE_HOW), false)?));
    }
    // `(I remember) leaving it in the fridge`
    if is_answer && tokens.get(at)?.word().ends_with("ing") && is_one_of(tokens, at, &PUT_SOMEWHERE) {
        let (thing, after) = noun(tokens, at + 1)?;
        return Some((thing, spots(tokens, skip(tokens, after, &IS_SOMEWHERE_HOW), false)?));
    }
    // `the sponge lives in the drawer`: a verb that the noun would take in.
    let before_verb = (at + 1..tokens.len()).find_map(|verb| {
        let count = SAID_LIVES.longest(tokens, verb)?;
        let (thing, after) = noun(tokens.get(..verb)?, at)?;
        (after == verb).then_some((thing, verb + count))
    });
    if let Some((thing, after)) = before_verb {
        return Some((thing, spots(tokens, skip(tokens, after, &IS_SOMEWHERE_HOW), false)?));
    }
    let (thing, after) = noun(tokens, at)?;
    let after = skip(tokens, after, &SURELY);
    let count = IS_SOMEWHERE.longest(tokens, after)?;
    Some((thing, spots(tokens, skip(tokens, after + count, &IS_SOMEWHERE_HOW), false)?))
}

/// Places to the end of a clause: `in the fridge or in the cupboard`, `the fridge first and then the drawer`.
fn spots(tokens: &[Token], mut at: usize, may_be_bare: bool) -> Option<Vec<Spot>> {
    let mut spots: Vec<Spot> = Vec::new();
    loop {
        // `the cupboard yesterday`, `the fridge first and then …`: a place ends before such words, `the first drawer` does not.
        let whole = tokens;
        let is_end = |end: &usize| {
            let after = skip(whole, *end, &BEHIND_REPORT);
            after > *end && (after == whole.len() || NEXT_PLACE.longest(whole, after).is_some())
        };
        let end = (at + 1..whole.len()).find(is_end).unwrap_or(whole.len());
        let tokens = whole.get(..end)?;
        let bare = || {
            let (noun, after) = noun(tokens, at)?;
            let is_named = matches!(noun, Noun::Phrase(_));
            let spot =
                Spot { relation: Relation::To, preposition: String::new(), noun, is_behind_thing: false };
            (is_named && (may_be_bare || !spots.is_empty())).then_some((spot, after))
        };
        let (spot, after) = spot(tokens, at).or_else(|| way(tokens, at)).or_else(bare)?;
        spots.push(spot);
        at = skip(whole, after, &BEHIND_REPORT);
        if at >= whole.len() || (at > 0 && SPOTS_GOES_ON.longest(whole, at).is_some()) {
            return Some(spots);
        }
        at += NEXT_PLACE.longest(whole, at)?;
        at = skip(whole, at, &LOOK_THERE);
    }
}

/// Past what says how sure somebody is, or is only said before.
fn leading(tokens: &[Token], mut at: usize, clause: Clause) -> usize {
    loop {
        let count = BEFORE_REPORT.longest(tokens, at).max(hedge::before(tokens, at));
        let asks = ADVICE.longest(tokens, at).filter(|_| clause == Clause::Answer);
        match count.max(asks) {
            Some(count) => at += count,
            None => return at,
        }
    }
}

fn skip(tokens: &[Token], at: usize, skipped: &Phrases) -> usize {
    at + skipped.run(tokens, at)
}

/// `my wife tells me it is …`: where what somebody else knows begins.
fn reported(tokens: &[Token], at: usize, clause: Clause) -> usize {
    let is_said = |end: usize| {
        REPORTED_SAYS.longest(tokens, end).map(|count| skip(tokens, end + count, &BEFORE_REPORT))
    };
    let found = (at + 1..=at + 2).find_map(is_said);
    found.filter(|_| clause == Clause::Answer).unwrap_or(at)
}

fn is_one_of(tokens: &[Token], at: usize, words: &Phrases) -> bool {
    tokens.get(at).is_some_and(|token| words.has(token.word()))
}

fn denies(tokens: &[Token]) -> bool {
    let mut at = 0;
    while at < tokens.len() {
        // `if I were you`, `unless I am mistaken` take nothing back.
        if let Some(count) = BEHIND_REPORT.longest(tokens, at).max(hedge::before(tokens, at)) {
            at += count;
        } else if REPORT_DENIALS.longest(tokens, at).is_some() {
            return true;
        } else {
            at += 1;
        }
    }
    false
}
