//! What is said beside a request: what is mentioned, liked, left somewhere, and where things are.

use smol_str::SmolStr;

use super::Located;
use super::command::{Spoken, Statement};
use super::meaning::{ANYWHERE, HOLDERS, OBJECTS, Reader};
use super::noun::{Noun, located, noun};
use super::token::Token;
use super::verb::stands;
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
            // A noun may begin behind a verb: the longest ending that is a name counts.
            for start in 0..phrase.words.len() {
                let ending = phrase.words.get(start..).unwrap_or_default();
                let found: Vec<SmolStr> =
                    self.vocabulary.meant(ending, OBJECTS).iter().map(|thing| thing.id.clone()).collect();
                if !found.is_empty() {
                    self.said.spoken_of.extend(found);
                    break;
                }
                let places = self.vocabulary.meant(ending, ANYWHERE);
                if let [place] = places.as_slice() {
                    self.places.push(place.id.clone());
                    break;
                }
            }
            at = after.max(at + 1);
        }
    }

    /// `the coke is in the fridge`, `it is on the table`, `in the cupboard`: a fact. Whether it was one.
    fn tell(&mut self, tokens: &[Token]) -> bool {
        let subject = match noun(tokens, 0) {
            Some((subject, after)) => ["is now", "are now", "is", "are", "must be", "should be"]
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

    /// What somebody may want who only says how they are.
    pub(super) fn wished(&self, spoken: &Spoken) -> Option<String> {
        let says = |word: &str| {
            let mut words = spoken.statements.iter().flat_map(|statement| &statement.tokens);
            words.any(|token| token.word() == word)
        };
        if says("thirsty") {
            return Some("Shall I bring you something to drink?".to_owned());
        }
        (says("hungry") || says("starving")).then(|| "Shall I bring you something to eat?".to_owned())
    }
}
