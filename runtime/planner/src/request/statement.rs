//! What is said beside a request: what is mentioned, liked, left somewhere, and where things are.

use smol_str::SmolStr;

use super::Located;
use super::command::{Spoken, Statement};
use super::meaning::{ANYWHERE, HOLDERS, OBJECTS, Reader};
use super::noun::{Noun, Phrase, Which, located, noun};
use super::token::{Token, stands};
use super::vocabulary::Role;

impl Reader<'_> {
    /// Takes in what was said beside the request: what was mentioned, liked, left somewhere, and where things are.
    pub(super) fn state(&mut self, statement: &Statement) {
        let tokens = &statement.tokens;
        if self.tell(tokens) {
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
            let Some((Noun::Phrase(mut phrase), after)) = noun(tokens, at) else {
                at += 1;
                continue;
            };
            if phrase.words.is_empty() {
                if let Some((place, _)) = located(tokens, after) {
                    phrase.place = Some(Box::new(place));
                    self.left = Some(phrase);
                }
                at = after.max(at + 1);
                continue;
            }
            // `the can is rubbish` says what it is, and speaks of nothing else; `there is a can` does speak of it.
            let word =
                |back: usize| at.checked_sub(back).and_then(|at| tokens.get(at)).map_or("", Token::word);
            let is_told = matches!(word(1), "is" | "are" | "was" | "were") && word(2) != "there";
            if !(is_told && phrase.which != Which::The) {
                self.mention(&phrase);
            }
            at = after.max(at + 1);
        }
    }

    /// Keeps in mind what a noun of a statement means. The noun may stand between a verb and an adjective: of its runs of
    /// words the longest that is a name counts.
    fn mention(&mut self, phrase: &Phrase) {
        let count = phrase.words.len();
        let runs = (1..=count).rev().flat_map(|len| (0..=count - len).map(move |start| start..start + len));
        for run in runs {
            let words = phrase.words.get(run).unwrap_or_default();
            let found: Vec<SmolStr> =
                self.vocabulary.meant(words, OBJECTS).iter().map(|thing| thing.id.clone()).collect();
            if !found.is_empty() {
                // `it` is then as ambiguous as what it stands for.
                if found.len() > 1 && phrase.which == Which::The && !phrase.is_plural {
                    self.left = Some(Phrase { words: words.to_vec(), ..phrase.clone() });
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

    /// `the coke is in the fridge`, `it is on the table`, `in the cupboard`: a fact. Whether it was one.
    pub(super) fn tell(&mut self, tokens: &[Token]) -> bool {
        let subject = match noun(tokens, 0) {
            Some((subject, after)) => [
                "is now",
                "are now",
                "is",
                "are",
                "must be",
                "should be",
                "might be",
                "may be",
                "could be",
                "was",
                "is probably",
                "has to be",
            ]
            .iter()
            .find_map(|word| Some((subject.clone(), after + stands(tokens, after, word)?))),
            None => None,
        };
        let (subject, at) = subject.unwrap_or((Noun::Before, 0));
        let Some((place, _)) = located(tokens, at).filter(|(_, end)| *end == tokens.len()) else {
            return false;
        };
        let (Ok(things), Ok(places)) =
            (self.things(&subject, OBJECTS, None), self.things(&place, HOLDERS, None))
        else {
            return false;
        };
        let ([thing], [place]) = (things.as_slice(), places.as_slice()) else { return false };
        let Some(role) = self.vocabulary.thing(place).map(|place| place.role) else { return false };
        let relation = if role == Role::Container { "in" } else { "on" };
        self.said.located.push(Located { thing: thing.clone(), relation, place: place.clone() });
        self.said.spoken_of.push(thing.clone());
        true
    }

    /// `I put it on the counter`, `look in the cupboard`, `it should be in there, in the drawer`: an answer to the question
    /// where a thing is tells the first place in it.
    pub(super) fn tell_place(&mut self, tokens: &[Token]) {
        let found = (0..tokens.len()).find_map(|at| {
            let (place, _) = located(tokens, at)?;
            let places = self.things(&place, &[Role::Surface, Role::Container], None).ok()?;
            <[SmolStr; 1]>::try_from(places).ok()
        });
        let (Some([place]), Ok(things)) = (found, self.things(&Noun::Before, OBJECTS, None)) else { return };
        let role = self.vocabulary.thing(&place).map(|place| place.role);
        let relation = if role == Some(Role::Container) { "in" } else { "on" };
        if let [thing] = things.as_slice() {
            self.said.located.push(Located { thing: thing.clone(), relation, place });
        }
    }

    /// What somebody may want who only says how they are.
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
