//! Statements beside a request: what is mentioned, liked, left somewhere; and reported locations: `the coke
//! is in the fridge`, `I left it in the cupboard yesterday`.
//!
//! A clause is such a fact as a whole or not at all: who sits at a table says nothing of what is on it.

use motet_stdlib::lang::fluents;
use smol_str::SmolStr;

use crate::engine::english::{
    ADVICE, BEFORE_REPORT, BEHIND_REPORT, IS_HABIT_ALWAYS, LIKES, LOOK_THERE, NEEDS_TO, REPORT_DENIALS,
    TELLING_BE, TOLD_THERE,
};
use crate::engine::noun::{Noun, Phrase, Relation, Spot, Which, noun, skip, spot, spots};
use crate::engine::rule::Rules;
use crate::engine::token::{Token, stands};
use crate::engine::vocabulary::{Role, good_for};
use crate::meaning::{ANYWHERE, OBJECTS, Reader};
use crate::parse::{Spoken, Statement};
use crate::{PendingQuestion, ReportedLocation};

impl Reader<'_> {
    /// Takes in what was said beside the request: what was mentioned, liked, left somewhere, and where things
    /// are.
    pub(super) fn state(&mut self, statement: &Statement) {
        let tokens = &statement.tokens;
        // `we always keep the coke in the fridge` says where it goes, and not that it is there.
        if is_habit(tokens) {
            let usual = self.whereabouts_of_habit(tokens);
            if let Some(usual) = usual {
                self.usual.push((usual.thing.clone(), usual.place));
                self.said.spoken_of.push(usual.thing);
                return;
            }
        }
        // `I put the coke in the fridge and I am thirsty`
        let mut located = self.whereabouts(tokens, Clause::Statement);
        if located.is_empty() {
            let clauses =
                tokens.split(|token| matches!(token.word(), "and" | "so") || *token == Token::Comma);
            located = clauses.flat_map(|clause| self.whereabouts(clause, Clause::Statement)).collect();
        }
        // Two places for one thing leave it open where it is.
        let is_clear =
            |one: &ReportedLocation| located.iter().filter(|other| other.thing == one.thing).count() == 1;
        if !located.is_empty() && located.iter().all(is_clear) {
            self.said.located.extend(located);
            return;
        }
        for index in 0..tokens.len() {
            if let Some(count) = LIKES.longest(tokens, index)
                && let Some((Noun::Phrase(phrase), _)) = noun(tokens, index + count)
            {
                self.liked.push(phrase.words);
            }
        }
        let mut at = 0;
        while at < tokens.len() {
            // `I can reach it` names no can.
            if stands(tokens, at, "can").is_some() {
                at += 1;
                continue;
            }
            let Some((Noun::Phrase(mut phrase), after)) = noun(tokens, at) else {
                at += 1;
                continue;
            };
            if phrase.words.is_empty() {
                if let Some((place, _)) = spot(tokens, after) {
                    phrase.place = Some(Box::new(place));
                    self.left = Some(phrase);
                }
                at = after.max(at + 1);
                continue;
            }
            // `there is a mug on the table`: of several mugs the one there is meant by what follows.
            if stands(tokens, at.saturating_sub(2), "there is").is_some()
                && self.vocabulary.meant(&phrase.words, OBJECTS).len() > 1
                && let Some((place, end)) = spot(tokens, after)
            {
                phrase.place = Some(Box::new(place));
                self.left = Some(phrase);
                at = end;
                continue;
            }
            // `the can is rubbish` says what it is, and speaks of nothing else; `there is a can` does speak
            // of it.
            let word =
                |back: usize| at.checked_sub(back).and_then(|at| tokens.get(at)).map_or("", Token::word);
            let is_told = TELLING_BE.has(word(1)) && word(2) != "there";
            // `that is enough of the can`
            if !(is_told && phrase.which != Which::The) || phrase.said.starts_with("enough of") {
                self.mention(&phrase);
            }
            at = after.max(at + 1);
        }
    }

    /// Keeps in mind what a noun of a statement means. The noun may stand between a verb and an adjective: of
    /// its runs of words the longest that is a name counts.
    fn mention(&mut self, phrase: &Phrase) {
        let count = phrase.words.len();
        let runs = (1..=count).rev().flat_map(|len| (0..=count - len).map(move |start| start..start + len));
        for run in runs {
            let words = phrase.words.get(run).unwrap_or_default();
            let found: Vec<SmolStr> =
                self.vocabulary.meant(words, OBJECTS).iter().map(|thing| thing.id.clone()).collect();
            if !found.is_empty() {
                // `it` is then as ambiguous as what it stands for.
                // The plural is of its last word: `the mug lives there` is of one.
                let is_plural = phrase.is_plural && words.last() == phrase.words.last();
                if found.len() > 1 && phrase.which == Which::The && !is_plural {
                    let said = if words.len() == count {
                        phrase.said.clone()
                    } else {
                        format!("the {}", words.join(" "))
                    };
                    self.left = Some(Phrase { words: words.to_vec(), said, is_plural, ..phrase.clone() });
                }
                self.said.spoken_of.extend(found);
                return;
            }
            let places = self.vocabulary.meant(words, ANYWHERE);
            if let [place] = places.as_slice() {
                self.places.push(place.id.clone());
                self.said.spoken_of.push(place.id.clone());
                return;
            }
        }
    }

    /// Reads what somebody may want who only says how they are.
    pub(super) fn wished(&self, spoken: &Spoken) -> Option<String> {
        let words = spoken.statements.iter().flat_map(|statement| &statement.tokens);
        let wishes: Vec<_> = words.filter_map(|token| NEEDS_TO.value(token.word())).collect();
        let has = |what: &str| {
            self.vocabulary.things.iter().any(|thing| thing.role == Role::Object && thing.is(what))
        };
        // Who is thirsty and hungry is offered first what stands first in the list.
        let found = NEEDS_TO.values().find(|verb| wishes.contains(verb) && good_for(verb).is_some_and(has));
        found.map(|verb| format!("Shall I bring you something to {verb}?"))
    }
}

/// The kind of a clause: in an answer a bare place is a location.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Clause {
    Answer,
    Statement,
}

impl Reader<'_> {
    /// Reads what an answer says of where things are. Of the same thing more than one place is where to look
    /// first, then next.
    pub(super) fn told(&mut self, tokens: &[Token], asked: PendingQuestion) -> Vec<ReportedLocation> {
        let mut told = Vec::new();
        for sentence in tokens.split(|token| *token == Token::Stop) {
            let mut here = Vec::new();
            for clause in sentence.split(|token| *token == Token::Comma) {
                // `I put it in the fridge, but it is not there any more`
                if denies(clause) && clause.iter().any(|token| TOLD_THERE.has(token.word())) {
                    here.clear();
                }
                here.extend(self.whereabouts(&guided(clause, asked), Clause::Answer));
            }
            told.extend(here);
        }
        told
    }

    /// Reads what one clause says of where something is; nothing where it says something else.
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

    /// Finds where something is kept, as a clause says that tells a rule.
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
        let relation = if role == Role::Container { fluents::IN } else { fluents::ON };
        (spot.relation.fits(role) && is_clear).then(|| ReportedLocation {
            thing: thing.clone(),
            relation,
            place: place.clone(),
        })
    }
}

/// An answer that says where to take the thing from, or where to look, as one that says where it is.
fn guided(clause: &[Token], asked: PendingQuestion) -> Vec<Token> {
    let begin = leading(clause, 0, Clause::Answer);
    let found = Rules("guidance").at(clause, 0).or_else(|| Rules("guidance").at(clause, begin));
    let search = || {
        let found = [0, begin].iter().find_map(|at| Rules("guided_search").at(clause, *at));
        found.filter(|_| asked == PendingQuestion::Where)
    };
    match found.or_else(search) {
        Some(found) => [&found.words, clause.get(found.end..).unwrap_or_default()].concat(),
        None => clause.to_vec(),
    }
}

/// True if a clause tells what is so as a rule.
pub(super) fn is_habit(tokens: &[Token]) -> bool {
    tokens.iter().any(|token| IS_HABIT_ALWAYS.has(token.word()))
}

/// The thing that a clause places, and where.
fn said(tokens: &[Token], at: usize, clause: Clause) -> Option<(Noun, Vec<Spot>)> {
    let rules = if clause == Clause::Answer { "reported_in_answer" } else { "reported" };
    let found = Rules(rules).at(tokens, at)?;
    let is_looked_for = clause == Clause::Answer && LOOK_THERE.longest(tokens, at).is_some();
    Some((noun(&found.words, 0)?.0, spots(tokens, found.end, is_looked_for)?))
}

/// Past what says how sure somebody is, or is only said before.
fn leading(tokens: &[Token], mut at: usize, clause: Clause) -> usize {
    loop {
        let count = BEFORE_REPORT.longest(tokens, at).max(hedged(tokens, at));
        let asks = ADVICE.longest(tokens, at).filter(|_| clause == Clause::Answer);
        match count.max(asks) {
            Some(count) => at += count,
            None => return at,
        }
    }
}

/// The number of words that say how sure somebody is.
fn hedged(tokens: &[Token], at: usize) -> Option<usize> {
    Some(Rules("hedged").end(tokens, at)? - at)
}

/// `my wife tells me it is …`: where what somebody else knows begins.
fn reported(tokens: &[Token], at: usize, clause: Clause) -> usize {
    Rules("hearsay").end(tokens, at).filter(|_| clause == Clause::Answer).unwrap_or(at)
}

fn denies(tokens: &[Token]) -> bool {
    let mut at = 0;
    while at < tokens.len() {
        // `if I were you`, `unless I am mistaken` take nothing back.
        if let Some(count) = BEHIND_REPORT.longest(tokens, at).max(hedged(tokens, at)) {
            at += count;
        } else if REPORT_DENIALS.longest(tokens, at).is_some() {
            return true;
        } else {
            at += 1;
        }
    }
    false
}
