//! What nouns mean: the things of the scene that words, pronouns and places single out.

use smol_str::SmolStr;

use super::Puzzle;
use super::meaning::{HOLDERS, OBJECTS, Reader};
use super::noun::{Noun, Phrase, Which};
use super::vocabulary::Role;

impl Reader<'_> {
    pub(super) fn is_person(&self, noun: &Noun) -> bool {
        match noun {
            Noun::Speaker | Noun::Here => true,
            Noun::Before | Noun::There => false,
            Noun::Phrase(phrase) => !self.vocabulary.meant(&phrase.words, &[Role::Person]).is_empty(),
        }
    }

    pub(super) fn one(&mut self, noun: &Noun, roles: &[Role]) -> Result<SmolStr, Puzzle> {
        // Furniture before what stands on it: `the table` is no toy table.
        let fixed: Vec<Role> = roles.iter().copied().filter(|role| *role != Role::Object).collect();
        let found = self
            .things(noun, &fixed, None)
            .or_else(|puzzle| self.things(noun, roles, None).map_err(|_| puzzle))?;
        let said = if let Noun::Phrase(phrase) = noun { phrase.said.clone() } else { "there".to_owned() };
        match found.as_slice() {
            [only] => Ok(only.clone()),
            [] => Err(Puzzle::NotFound { what: said }),
            _ => Err(Puzzle::AmbiguousReference { what: said, options: found }),
        }
    }

    /// For each thing that is meant, what it may be: several where any will do.
    pub(super) fn choices(
        &mut self,
        noun: &Noun,
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<Vec<SmolStr>>, Puzzle> {
        let Noun::Phrase(phrase) = noun else {
            return Ok(self.things(noun, OBJECTS, from)?.into_iter().map(|id| vec![id]).collect());
        };
        let found = self.candidates(phrase, OBJECTS, from)?;
        Ok(match phrase.which {
            Which::The if found.len() > 1 && !phrase.is_plural => return Err(ambiguous(phrase, found)),
            Which::The | Which::All => found.into_iter().map(|id| vec![id]).collect(),
            Which::Count(count) if found.len() < count => {
                return Err(Puzzle::NotFound { what: phrase.said.clone() });
            }
            Which::Count(1) | Which::Any => vec![found],
            Which::Count(count) => found.into_iter().take(count).map(|id| vec![id]).collect(),
        })
    }

    /// The things that are meant; of a single noun the one.
    pub(super) fn things(
        &mut self,
        noun: &Noun,
        roles: &[Role],
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<SmolStr>, Puzzle> {
        match noun {
            Noun::Speaker | Noun::Here => Ok(vec![SmolStr::new_static("user")]),
            Noun::There => match self.places.last() {
                Some(place) => Ok(vec![place.clone()]),
                None => Err(Puzzle::NotUnderstood { part: "there".to_owned() }),
            },
            Noun::Before => self.before(roles),
            Noun::Phrase(phrase) => {
                let found = self.candidates(phrase, roles, from)?;
                let is_one = !matches!(phrase.which, Which::All) && !phrase.is_plural;
                if is_one && found.len() > 1 {
                    return Err(ambiguous(phrase, found));
                }
                if roles.contains(&Role::Surface) {
                    self.places.extend(found.iter().cloned());
                }
                Ok(found)
            }
        }
    }

    /// What `it` is.
    fn before(&mut self, roles: &[Role]) -> Result<Vec<SmolStr>, Puzzle> {
        if let Some(left) = self.left.clone()
            && roles.contains(&Role::Object)
        {
            let found = self.candidates(&left, roles, None)?;
            if let [_] = found.as_slice() {
                return Ok(found);
            }
            return Err(ambiguous(&left, found));
        }
        let fits = |id: &&SmolStr| self.vocabulary.thing(id).is_some_and(|thing| roles.contains(&thing.role));
        let last = self.said.spoken_of.iter().rev().find(fits);
        let held = self.situation.holding.as_ref().filter(|held| fits(held));
        match last.or(held) {
            Some(id) => Ok(vec![id.clone()]),
            None => Err(Puzzle::NotUnderstood { part: "it".to_owned() }),
        }
    }

    /// All things that a noun may mean.
    pub(super) fn candidates(
        &mut self,
        phrase: &Phrase,
        roles: &[Role],
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<SmolStr>, Puzzle> {
        let place = match &phrase.place {
            Some(place) => Some(self.things(&place.clone(), HOLDERS, None)?),
            None => from.map(<[SmolStr]>::to_vec),
        };
        // Words of which it was found out what they mean.
        if let Some((_, id)) = self.situation.meant.iter().rev().find(|(said, _)| *said == phrase.said)
            && self.vocabulary.thing(id).is_some_and(|thing| roles.contains(&thing.role))
        {
            return Ok(vec![id.clone()]);
        }
        let mut words = phrase.words.clone();
        // What someone says of a thing that they opened or emptied tells nothing about which it is.
        words.retain(|word| !matches!(word.as_str(), "open" | "opened" | "nice" | "good" | "other" | "new"));
        let found = self.named(&words, roles);
        let found = if found.is_empty() && !words.is_empty() {
            match self.vocabulary.respelt(&words) {
                Some(respelt) => {
                    let found = self.named(&respelt, roles);
                    if !found.is_empty() {
                        self.said.notes.push(format!(
                            "I read `{}` as `{}`",
                            words.join(" "),
                            respelt.join(" ")
                        ));
                    }
                    found
                }
                None => found,
            }
        } else {
            found
        };
        let vocabulary = &self.vocabulary;
        let is = |id: &SmolStr, words: &[String]| {
            vocabulary.meant(words, roles).iter().any(|thing| thing.id == *id)
        };
        let mut found: Vec<SmolStr> = found
            .into_iter()
            .filter(|id| phrase.is.iter().all(|(is_so, words)| is(id, words) == *is_so))
            .filter(|id| {
                let thing = vocabulary.thing(id);
                phrase.good_for.is_none_or(|what| thing.is_some_and(|thing| thing.is(what)))
            })
            .filter(|id| {
                place.as_ref().is_none_or(|places| {
                    let support = vocabulary.thing(id).and_then(|thing| thing.support.clone());
                    support.is_some_and(|support| places.contains(&support))
                })
            })
            .collect();
        if phrase.is_liked || (phrase.words.is_empty() && !self.liked.is_empty()) {
            found.retain(|id| self.liked.iter().any(|words| is(id, words)));
        }
        // `an open can`: of several the one that was spoken of.
        if found.len() > 1 {
            let spoken: Vec<_> =
                found.iter().filter(|id| self.said.spoken_of.contains(id)).cloned().collect();
            if let [_] = spoken.as_slice()
                && phrase.which != Which::All
                && !matches!(phrase.which, Which::Count(_))
                && !phrase.words.is_empty()
            {
                found = spoken;
            }
        }
        let is_open = phrase.words.is_empty() && phrase.good_for.is_none() && phrase.is.is_empty();
        if found.is_empty() {
            return Err(Puzzle::NotFound { what: phrase.said.clone() });
        }
        if is_open
            && place.is_none()
            && !phrase.is_liked
            && self.liked.is_empty()
            && phrase.which != Which::All
        {
            return Err(self.ask("What do you mean by that?", roles));
        }
        Ok(found)
    }

    fn named(&self, words: &[String], roles: &[Role]) -> Vec<SmolStr> {
        let things: Vec<_> = if words.is_empty() {
            self.vocabulary.things.iter().filter(|thing| roles.contains(&thing.role)).collect()
        } else {
            self.vocabulary.meant(words, roles)
        };
        things.into_iter().map(|thing| thing.id.clone()).collect()
    }
}

pub(super) fn ambiguous(phrase: &Phrase, options: Vec<SmolStr>) -> Puzzle {
    Puzzle::AmbiguousReference { what: phrase.said.clone(), options }
}
