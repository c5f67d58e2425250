//! Single things in words: which of some options an answer means, what a request names, what a thing is called.

use motet_robots::scene::Entity;
use smol_str::SmolStr;

use super::Situation;
use super::noun::{Noun, located, noun};
use super::token::{Token, singular, tokens};
use super::vocabulary::{Role, Vocabulary};

const ALL: &[Role] = &[Role::Object, Role::Surface, Role::Container, Role::Place, Role::Person];

/// The one of some options, or of everything where there are none, that an answer means: by name, by what tells it apart
/// ("the red one", "the one on the table"), or by its number ("the second"). None where none or several fit.
#[must_use]
pub fn pick(answer: &str, options: &[SmolStr], situation: &Situation<'_>) -> Option<SmolStr> {
    if let Some(id) = options.iter().find(|id| id.as_str() == answer.trim()) {
        return Some(id.clone());
    }
    let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
    let words = tokens(answer);
    let words = without_lead(&words);
    let place = |place: Option<Noun>| match place {
        Some(Noun::Phrase(place)) => {
            vocabulary.meant(&place.words, ALL).first().map(|thing| thing.id.clone())
        }
        _ => None,
    };
    let (mut told, at): (Vec<String>, Option<SmolStr>) = match noun(words, 0) {
        Some((Noun::Phrase(phrase), after)) => {
            let own = phrase.place.map(|place| *place);
            (phrase.words, place(own.or_else(|| located(words, after).map(|(place, _)| place))))
        }
        _ => (Vec::new(), place(located(words, 0).map(|(place, _)| place))),
    };
    told.retain(|word| word != "one" && word != "thing");
    let number = ["first", "second", "third", "fourth"];
    if let [ordinal] = told.as_slice()
        && let Some(index) = number.iter().position(|known| known == ordinal)
    {
        return options.get(index).cloned();
    }
    let is_option = |id: &SmolStr| options.is_empty() || options.contains(id);
    // What is only told by its place is among the options; a bare place is the option itself.
    let fitting = |words: &[String]| -> Vec<SmolStr> {
        let all = if words.is_empty() { Vec::new() } else { vocabulary.told_by(words, ALL) };
        all.into_iter().map(|thing| thing.id.clone()).filter(is_option).collect()
    };
    let mut found = if told.is_empty() { options.to_vec() } else { fitting(&told) };
    if let Some(at) = &at {
        let there =
            |id: &SmolStr| vocabulary.thing(id).is_some_and(|thing| thing.support.as_ref() == Some(at));
        let standing: Vec<SmolStr> = found.iter().filter(|id| there(id)).cloned().collect();
        if told.is_empty() && standing.is_empty() && is_option(at) {
            return Some(at.clone());
        }
        found = standing;
    }
    match found.as_slice() {
        [only] => Some(only.clone()),
        _ => None,
    }
}

fn without_lead(words: &[Token]) -> &[Token] {
    let skipped =
        ["i", "mean", "meant", "want", "take", "would", "like", "please", "well", "oh", "it", "is", "its"];
    let count =
        words.iter().take_while(|token| skipped.contains(&token.word()) || *token == &Token::Comma).count();
    words.get(count..).unwrap_or_default()
}

/// The things of the scene that a request names, in the order of the scene: what an extractor of objects gives.
#[must_use]
pub fn named(request: &str, situation: &Situation<'_>) -> Vec<SmolStr> {
    let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
    let words: Vec<String> = tokens(request).iter().map(|token| singular(token.word())).collect();
    let mut found: Vec<SmolStr> = Vec::new();
    let mut at = 0;
    while at < words.len() {
        // The longest run of words that is a name counts.
        let named = (1..=4.min(words.len() - at)).rev().find_map(|count| {
            let run = words.get(at..at + count)?;
            let things =
                if run.iter().any(String::is_empty) { Vec::new() } else { vocabulary.meant(run, ALL) };
            (!things.is_empty())
                .then(|| (count, things.into_iter().map(|thing| thing.id.clone()).collect::<Vec<_>>()))
        });
        match named {
            Some((count, ids)) => {
                found.extend(ids);
                at += count;
            }
            None => at += 1,
        }
    }
    let order = situation.scene.entities.keys();
    order.filter(|id| found.contains(id)).cloned().collect()
}

/// What people call a thing: its first other name, else its class, else its id in words.
#[must_use]
pub fn called(entity: &Entity) -> String {
    match (entity.names.first(), entity.class.as_str()) {
        (Some(name), _) => name.to_string(),
        (None, "") => entity.id.replace(['_', '-'], " "),
        (None, class) => class.to_owned(),
    }
}
