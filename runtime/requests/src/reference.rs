//! Reference resolution: the things of the scene that noun phrases, pronouns and places mean.

use motet_stdlib::lang::entities;
use smol_str::SmolStr;

use crate::RequestError;
use crate::engine::english::{CANDIDATES_OPEN, REFUSE};
use crate::engine::noun::{Noun, Phrase, Which};
use crate::engine::vocabulary::Role;
use crate::meaning::{OBJECTS, Reader};

impl Reader<'_> {
    pub(crate) fn is_person(&self, noun: &Noun) -> bool {
        match noun {
            Noun::Speaker | Noun::Here => true,
            Noun::Before(_) | Noun::There => false,
            Noun::Phrase(phrase) => !self.vocabulary.meant(&phrase.words, &[Role::Person]).is_empty(),
        }
    }

    pub(crate) fn one(&mut self, noun: &Noun, roles: &[Role]) -> Result<SmolStr, RequestError> {
        // Furniture before what stands on it: `the table` is no toy table.
        let fixed: Vec<Role> = roles.iter().copied().filter(|role| *role != Role::Object).collect();
        let found = self
            .things(noun, &fixed, None)
            .or_else(|puzzle| self.things(noun, roles, None).map_err(|_| puzzle))?;
        let said = if let Noun::Phrase(phrase) = noun { phrase.said.clone() } else { "there".to_owned() };
        match found.as_slice() {
            [only] => Ok(only.clone()),
            [] => Err(RequestError::NotFound { what: said }),
            _ => Err(RequestError::AmbiguousReference { what: said, options: found }),
        }
    }

    /// True if it was asked and said what these words mean.
    fn is_settled(&self, phrase: &Phrase) -> bool {
        self.situation.meant.iter().any(|(said, _)| *said == phrase.said)
    }

    /// For each thing that is meant, what it may be: several where any will do.
    pub(crate) fn choices(
        &mut self,
        noun: &Noun,
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<Vec<SmolStr>>, RequestError> {
        let Noun::Phrase(phrase) = noun else {
            return Ok(self.things(noun, OBJECTS, from)?.into_iter().map(|id| vec![id]).collect());
        };
        let found = self.candidates(phrase, OBJECTS, from)?;
        let found = self.preferred(found);
        // Of what is good for something several may fit, and a person cares which.
        if phrase.good_for.is_some() && matches!(phrase.which, Which::Any) && found.len() > 1 {
            return Err(ambiguous(phrase, found));
        }
        let is_refuse = phrase.words.last().is_some_and(|word| REFUSE.has(word));
        Ok(match phrase.which {
            Which::The if is_refuse => found.into_iter().map(|id| vec![id]).collect(),
            Which::The if found.len() > 1 && !phrase.is_plural && !self.is_settled(phrase) => {
                return Err(ambiguous(phrase, found));
            }
            Which::The | Which::All => found.into_iter().map(|id| vec![id]).collect(),
            Which::Count(count) if found.len() < count => {
                let known =
                    if let [_] = found.as_slice() { "one".to_owned() } else { found.len().to_string() };
                return Err(RequestError::Unfit {
                    why: format!("I know of only {known} of the things that you call `{}`", phrase.said),
                });
            }
            Which::Count(1) | Which::Any => vec![found],
            Which::Count(count) => found.into_iter().take(count).map(|id| vec![id]).collect(),
        })
    }

    /// Of several things the one that the person would rather have.
    fn preferred(&self, found: Vec<SmolStr>) -> Vec<SmolStr> {
        let wins = |id: &&SmolStr| {
            let others = || found.iter().filter(move |other| other != id);
            self.situation
                .prefers
                .iter()
                .any(|known| known.liked.contains(id) && others().all(|other| known.over.contains(other)))
        };
        match found.iter().find(wins) {
            Some(one) => vec![one.clone()],
            None => found,
        }
    }

    /// The things that are meant; of a single noun the one.
    pub(crate) fn things(
        &mut self,
        noun: &Noun,
        roles: &[Role],
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<SmolStr>, RequestError> {
        match noun {
            Noun::Speaker | Noun::Here => Ok(vec![SmolStr::new_static(entities::USER)]),
            Noun::There => match self.places.last() {
                Some(place) => Ok(vec![place.clone()]),
                None => Err(RequestError::NotUnderstood { part: "there".to_owned() }),
            },
            Noun::Before(pronoun) => self.before(pronoun, roles),
            Noun::Phrase(phrase) => {
                let found = self.candidates(phrase, roles, from)?;
                let is_one = !matches!(phrase.which, Which::All) && !phrase.is_plural;
                if is_one && found.len() > 1 && !self.is_settled(phrase) {
                    return Err(ambiguous(phrase, found));
                }
                if roles.contains(&Role::Surface) {
                    self.places.extend(found.iter().cloned());
                }
                Ok(found)
            }
        }
    }

    /// Reads what `it` is.
    fn before(&mut self, pronoun: &str, roles: &[Role]) -> Result<Vec<SmolStr>, RequestError> {
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
            None => Err(RequestError::NotUnderstood { part: pronoun.to_owned() }),
        }
    }

    /// All things that a noun may mean.
    pub(crate) fn candidates(
        &mut self,
        phrase: &Phrase,
        roles: &[Role],
        from: Option<&[SmolStr]>,
    ) -> Result<Vec<SmolStr>, RequestError> {
        let place = match &phrase.place {
            Some(place) => Some(vec![self.holder(&place.clone())?]),
            None => from.map(<[SmolStr]>::to_vec),
        };
        // Words of which it was found out what they mean.
        let meant = self.situation.meant.iter().filter(|(said, _)| *said == phrase.said).map(|(_, id)| id);
        let fits = |id: &&SmolStr| self.vocabulary.thing(id).is_some_and(|thing| roles.contains(&thing.role));
        let meant: Vec<SmolStr> = meant.filter(fits).cloned().collect();
        if !meant.is_empty() {
            return Ok(meant);
        }
        let mut words = phrase.words.clone();
        // What someone says of a thing that they opened or emptied tells nothing about which it is.
        words.retain(|word| !CANDIDATES_OPEN.has(word.as_str()));
        let found = self.named(&words, roles);
        let found = match (found.as_slice(), roles, words.as_slice()) {
            // `dispose of the trash`: what is thrown away, and not the bin.
            ([], [Role::Object], [word]) if REFUSE.has(word) => self.named(&["rubbish".to_owned()], roles),
            _ => found,
        };
        if found.is_empty()
            && let Some(other) = self.vocabulary.meant(&words, ALL).first()
        {
            return Err(RequestError::Unfit { why: unfit(&other.called(), other.role, roles) });
        }
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
                        words = respelt;
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
        let content = words.get(words.len().saturating_sub(phrase.content.len())..).unwrap_or_default();
        let has =
            |id: &SmolStr, content: &str| vocabulary.thing(id).is_some_and(|thing| thing.is_content(content));
        let fitting: Vec<SmolStr> = found
            .into_iter()
            .filter(|id| content.iter().all(|content| has(id, content)))
            .filter(|id| phrase.is.iter().all(|(is_so, words)| is(id, words) == *is_so))
            .filter(|id| {
                let thing = vocabulary.thing(id);
                phrase.good_for.is_none_or(|what| thing.is_some_and(|thing| thing.is(what)))
            })
            .collect();
        let is_there = |id: &&SmolStr| {
            place.as_ref().is_none_or(|places| {
                let support = vocabulary.thing(id).and_then(|thing| thing.support.as_ref());
                support.is_some_and(|support| places.contains(support))
            })
        };
        let mut found: Vec<SmolStr> = fitting.iter().filter(is_there).cloned().collect();
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
        if !is_open || place.is_some() {
            found = self.extreme(phrase, found);
        }
        if let ([], [elsewhere], Some(_)) = (found.as_slice(), fitting.as_slice(), &place)
            && !phrase.words.is_empty()
        {
            return Err(self.elsewhere(elsewhere));
        }
        if found.is_empty() {
            return Err(RequestError::NotFound { what: phrase.said.clone() });
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

    /// Finds where a thing is, which is not where it was said to be.
    fn elsewhere(&self, id: &SmolStr) -> RequestError {
        let thing = self.vocabulary.thing(id);
        let support = thing.and_then(|thing| self.vocabulary.thing(thing.support.as_ref()?));
        let at = match support {
            Some(support) if support.role == Role::Container => format!("in the {}", support.called()),
            Some(support) => format!("on the {}", support.called()),
            None => "somewhere else".to_owned(),
        };
        RequestError::Elsewhere {
            why: format!("as far as I know the {} is {at}", self.called(id)),
            thing: id.clone(),
        }
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

pub(crate) fn ambiguous(phrase: &Phrase, options: Vec<SmolStr>) -> RequestError {
    RequestError::AmbiguousReference { what: phrase.said.clone(), options }
}

const ALL: &[Role] = &[Role::Object, Role::Surface, Role::Container, Role::Place, Role::Person];

/// Explains why something that is known by its name is not what is asked for.
fn unfit(called: &str, role: Role, asked: &[Role]) -> String {
    match asked {
        [Role::Object] => format!("I cannot carry the {called}"),
        [Role::Container] => format!("I cannot open or close the {called}"),
        [Role::Person] => format!("the {called} is no person"),
        _ if role == Role::Person => format!("nothing can be put on or in the {called}"),
        _ => format!("the {called} is not something to go to or to put things on"),
    }
}

#[cfg(test)]
mod tests {
    use motet_robots::builtin;

    use crate::engine::noun::noun;
    use crate::engine::token::tokens;
    use crate::meaning::{OBJECTS, Reader};
    use crate::{RequestContext, RequestError};

    /// The things of the kitchen that words mean, after some were spoken of.
    fn meant(said: &str, spoken_of: &[&str]) -> Result<Vec<String>, RequestError> {
        let scene = builtin::scene("kitchen").unwrap();
        let mut context = RequestContext::new(&scene);
        context.spoken_of = spoken_of.iter().map(|id| (*id).into()).collect();
        let (noun, _) = noun(&tokens(said), 0).unwrap();
        let found = Reader::new(&context).things(&noun, OBJECTS, None)?;
        Ok(found.iter().map(ToString::to_string).collect())
    }

    #[test]
    fn things_by_name_by_category_and_by_place() {
        assert_eq!(meant("the coke", &[]).unwrap(), ["coke"]);
        assert_eq!(meant("all the mugs", &[]).unwrap(), ["mug_1", "mug_2"]);
        assert!(matches!(meant("the mug", &[]), Err(RequestError::AmbiguousReference { .. })));
        assert!(matches!(meant("the piano", &[]), Err(RequestError::NotFound { .. })));
    }

    #[test]
    fn pronoun_means_the_last_thing_of_its_role() {
        assert_eq!(meant("it", &["coke", "sponge", "sink"]).unwrap(), ["sponge"]);
        assert!(matches!(meant("it", &[]), Err(RequestError::NotUnderstood { .. })));
    }
}
