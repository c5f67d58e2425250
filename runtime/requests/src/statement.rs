//! Statements beside a request: what is mentioned, liked, left somewhere, and where things are.

use smol_str::SmolStr;

use super::ReportedLocation;
use super::meaning::{ANYWHERE, OBJECTS, Reader};
use super::noun::{Noun, Phrase, Which, noun};
use super::parse::{Spoken, Statement};
use super::spot::spot;
use super::token::{Token, stands};
use super::vocabulary::Role;
use super::whereabouts::{Clause, is_habit};

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
        for (index, _) in tokens.iter().enumerate() {
            for like in ["i like", "i love", "i prefer", "i enjoy"] {
                if let Some(count) = stands(tokens, index, like)
                    && let Some((Noun::Phrase(phrase), _)) = noun(tokens, index + count)
                {
                    self.liked.push(phrase.words);
                }
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
            let is_told = matches!(word(1), "is" | "are" | "was" | "were") && word(2) != "there";
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
        let says = |word: &str| {
            let mut words = spoken.statements.iter().flat_map(|statement| &statement.tokens);
            words.any(|token| token.word() == word)
        };
        let has = |what: &str| {
            self.vocabulary.things.iter().any(|thing| thing.role == Role::Object && thing.is(what))
        };
        if says("thirsty") && has("drink") {
            return Some("Shall I bring you something to drink?".to_owned());
        }
        let is_hungry = (says("hungry") || says("starving")) && has("food");
        is_hungry.then(|| "Shall I bring you something to eat?".to_owned())
    }
}
