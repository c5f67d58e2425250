//! Where somebody says that things are: `the coke is in the fridge`, `I left it in the cupboard yesterday`, `try the drawer`.
//!
//! A clause is such a fact as a whole or not at all: who sits at a table says nothing of what is on it.

use smol_str::SmolStr;

use super::ReportedLocation;
use super::hedge;
use super::looking::{HOW, IS, LOOK};
use super::meaning::{OBJECTS, Reader};
use super::noun::{Noun, noun};
use super::spot::{Relation, Spot, spot, way};
use super::telling::{BEFORE, BEHIND, DENIES, HAS, PUT, WHO};
use super::token::{Token, longest, run, stands};
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
                if denies(clause)
                    && clause
                        .iter()
                        .any(|token| matches!(token.word(), "there" | "gone" | "anymore" | "more" | "longer"))
                {
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
            && longest(tokens, begin, LOOK)
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
        let (thing, spots) = said(tokens, skip(tokens, 0, BEFORE), Clause::Answer)?;
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
    tokens.iter().any(|token| {
        matches!(
            token.word(),
            "always" | "usually" | "normally" | "generally" | "typically" | "lives" | "belongs" | "keep"
        )
    })
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
        && let Some(spots) = spots(tokens, skip(tokens, at + 1, HOW), false)
    {
        return Some((it(), spots));
    }
    let look = longest(tokens, at, LOOK).filter(|_| is_answer);
    if let Some(count) = look {
        // `look for it in the cupboard`
        let for_it = stands(tokens, at + count, "for it").unwrap_or(0);
        return Some((it(), spots(tokens, at + count + for_it, true)?));
    }
    // `should be in the fridge`
    if let (true, Some(count)) = (is_answer, longest(tokens, at, IS)) {
        return Some((it(), spots(tokens, skip(tokens, at + count, HOW), false)?));
    }
    // `there is a can in the fridge`
    let there = ["there is", "there should be", "there might be", "there must be", "there was"];
    if let Some(count) = there.iter().find_map(|there| stands(tokens, at, there)) {
        let (thing, after) = noun(tokens, at + count)?;
        return Some((thing, spots(tokens, after, false)?));
    }
    // `somebody moved it to the cupboard`
    if WHO.contains(&tokens.get(at)?.word()) {
        let is_kin = matches!(tokens.get(at)?.word(), "my" | "our");
        let verb = skip(tokens, at + 1 + usize::from(is_kin), HAS);
        // `I had it in the fridge`
        let verb = if is_one_of(tokens, verb - 1, &["had"]) && !is_one_of(tokens, verb, PUT) {
            verb - 1
        } else {
            verb
        };
        // `I saw somebody put it in the fridge`
        let seen = [
            "saw somebody",
            "saw someone",
            "saw him",
            "saw her",
            "saw them",
            "saw you",
            "watched somebody",
            "watched someone",
        ];
        let verb = verb + longest(tokens, verb, &seen).unwrap_or(0);
        let is_to_come = tokens.get(at..verb)?.iter().any(|token| token.word() == "will");
        let is_found = is_one_of(tokens, verb, &["find", "see", "spot", "locate", "discover"]);
        if !is_one_of(tokens, verb, PUT) || (is_to_come && !is_found) {
            return None;
        }
        let (thing, after) = noun(tokens, verb + 1)?;
        return Some((thing, spots(tokens, skip(tokens, after, HOW), false)?));
    }
    // `Tommy put it in the fridge`
    let named =
        if is_one_of(tokens, at, &["the", "one", "some", "his", "her", "their"]) { at + 2 } else { at + 1 };
    let verb = skip(tokens, named, HAS);
    let verb = if verb > named && is_one_of(tokens, verb - 1, &["had"]) && !is_one_of(tokens, verb, PUT) {
        verb - 1
    } else {
        verb
    };
    let is_past = is_one_of(
        tokens,
        verb,
        &[
            "put", "left", "placed", "moved", "saw", "hid", "dropped", "stuck", "popped", "tucked",
            "stashed", "shoved", "chucked", "stored", "found", "threw", "set", "tidied", "took", "had",
        ],
    );
    if is_answer
        && is_past
        && !is_one_of(tokens, at, &["it", "that", "you", "there"])
        && let Some((thing @ Noun::Before(_), after)) = noun(tokens, verb + 1)
    {
        return Some((thing, spots(tokens, skip(tokens, after, HOW), false)?));
    }
    // `(I remember) leaving it in the fridge`
    if is_answer && tokens.get(at)?.word().ends_with("ing") && is_one_of(tokens, at, PUT) {
        let (thing, after) = noun(tokens, at + 1)?;
        return Some((thing, spots(tokens, skip(tokens, after, HOW), false)?));
    }
    // `the sponge lives in the drawer`: a verb that the noun would take in.
    let before_verb = (at + 1..tokens.len()).find_map(|verb| {
        let count = longest(
            tokens,
            verb,
            &["lives", "goes", "belongs", "sits", "stands", "lies", "hides", "stays", "rests"],
        )?;
        let (thing, after) = noun(tokens.get(..verb)?, at)?;
        (after == verb).then_some((thing, verb + count))
    });
    if let Some((thing, after)) = before_verb {
        return Some((thing, spots(tokens, skip(tokens, after, HOW), false)?));
    }
    let (thing, after) = noun(tokens, at)?;
    let after = skip(
        tokens,
        after,
        &[
            "probably",
            "usually",
            "normally",
            "most likely",
            "likely",
            "definitely",
            "surely",
            "certainly",
            "just",
            "still",
            "actually",
            "always",
            "generally",
            "apparently",
        ],
    );
    let count = longest(tokens, after, IS)?;
    Some((thing, spots(tokens, skip(tokens, after + count, HOW), false)?))
}

/// Places to the end of a clause: `in the fridge or in the cupboard`, `the fridge first and then the drawer`.
fn spots(tokens: &[Token], mut at: usize, may_be_bare: bool) -> Option<Vec<Spot>> {
    let mut spots: Vec<Spot> = Vec::new();
    loop {
        // `the cupboard yesterday`, `the fridge first and then …`: a place ends before such words, `the first drawer` does not.
        let whole = tokens;
        let is_end = |end: &usize| {
            let after = skip(whole, *end, BEHIND);
            after > *end && (after == whole.len() || longest(whole, after, NEXT).is_some())
        };
        let end = (at + 1..whole.len()).find(is_end).unwrap_or(whole.len());
        let tokens = whole.get(..end)?;
        let bare = || {
            let (noun, after) = noun(tokens, at)?;
            let is_named = matches!(noun, Noun::Phrase(_));
            let spot = Spot { relation: Relation::To, preposition: "", noun, is_behind_thing: false };
            (is_named && (may_be_bare || !spots.is_empty())).then_some((spot, after))
        };
        let (spot, after) = spot(tokens, at).or_else(|| way(tokens, at)).or_else(bare)?;
        spots.push(spot);
        at = skip(whole, after, BEHIND);
        let goes_on = ["when", "while", "because", "since", "where", "so"];
        if at >= whole.len() || (at > 0 && longest(whole, at, &goes_on).is_some()) {
            return Some(spots);
        }
        at += longest(whole, at, NEXT)?;
        at = skip(whole, at, LOOK);
    }
}

/// What joins two places.
const NEXT: &[&str] =
    &["or else", "or maybe", "or perhaps", "or", "and then", "and after that", "and", "then"];

/// Past what says how sure somebody is, or is only said before.
fn leading(tokens: &[Token], mut at: usize, clause: Clause) -> usize {
    loop {
        let count = longest(tokens, at, BEFORE).max(hedge::before(tokens, at));
        let asks = longest(tokens, at, ASKING).filter(|_| clause == Clause::Answer);
        match count.max(asks) {
            Some(count) => at += count,
            None => return at,
        }
    }
}

/// Who tells where to look says it politely.
const ASKING: &[&str] = &[
    "would you",
    "could you",
    "can you",
    "will you",
    "you might want to",
    "you may want to",
    "you want to",
    "you had better",
    "you ought to",
    "you should probably",
    "you will have to",
    "you would do well to",
    "i would",
    "i would advise you to",
    "maybe you could",
    "maybe you should",
    "it might be worth",
    "it is worth",
    "it would be worth",
    "it may help to",
    "it might help to",
    "best",
    "best to",
    "if i were you i would",
    "you need to",
    "you have to",
    "let us",
    "please do",
    "just",
    "you should be able to",
    "go and",
    "do",
    "quickly",
    "also",
    "first",
    "next",
];

fn skip(tokens: &[Token], mut at: usize, skipped: &[&str]) -> usize {
    at += run(tokens, at, skipped);
    at
}

/// `my wife tells me it is …`: where what somebody else knows begins.
fn reported(tokens: &[Token], at: usize, clause: Clause) -> usize {
    let says = [
        "says",
        "said",
        "thinks",
        "tells me",
        "told me",
        "reckons",
        "swears",
        "is sure",
        "told us",
        "mentioned",
    ];
    let is_said = |end: usize| longest(tokens, end, &says).map(|count| skip(tokens, end + count, BEFORE));
    let found = (at + 1..=at + 2).find_map(is_said);
    found.filter(|_| clause == Clause::Answer).unwrap_or(at)
}

fn is_one_of(tokens: &[Token], at: usize, words: &[&str]) -> bool {
    tokens.get(at).is_some_and(|token| words.contains(&token.word()))
}

fn denies(tokens: &[Token]) -> bool {
    let mut at = 0;
    while at < tokens.len() {
        // `if I were you`, `unless I am mistaken` take nothing back.
        if let Some(count) = longest(tokens, at, BEHIND).max(hedge::before(tokens, at)) {
            at += count;
        } else if longest(tokens, at, DENIES).is_some() {
            return true;
        } else {
            at += 1;
        }
    }
    false
}
