//! Single things in words: which of some options an answer means, what a request names, what a thing is called.

use crate::english::{ALL_OF_THEM, ANY_OF_THEM, NUMBERED_THE};
use motet_robots::scene::Entity;
use smol_str::SmolStr;

use super::RequestContext;
use super::noun::{Noun, noun};
use super::side::{farthest, side};
use super::spot::{Spot, spot};
use super::token::{Token, singular, tokens};
use super::vocabulary::{Role, Vocabulary};

const ALL: &[Role] = &[Role::Object, Role::Surface, Role::Container, Role::Place, Role::Person];

/// The one of some options, or of everything where there are none, that an answer means: by name, by what tells it apart
/// ("the red one", "the one on the table"), or by its number ("the second"). None where none or several fit.
#[must_use]
pub fn pick(answer: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Option<SmolStr> {
    if let Some(id) = options.iter().find(|id| id.as_str() == answer.trim()) {
        return Some(id.clone());
    }
    let vocabulary = Vocabulary::new(situation.scene, &situation.supports);
    let words = tokens(answer);
    let words = without_lead(&words);
    // What is on top of a fridge is not in it.
    let place = |place: Option<Spot>| match place.map(|place| (place.relation, place.noun)) {
        Some((relation, Noun::Phrase(place))) => {
            let thing = vocabulary.meant(&place.words, ALL).first().copied()?;
            relation.fits(thing.role).then(|| thing.id.clone())
        }
        _ => None,
    };
    let (mut told, at): (Vec<String>, Option<SmolStr>) = match noun(words, 0) {
        Some((Noun::Phrase(mut phrase), after)) => {
            // `the one that is blue`
            for (is_so, words) in &phrase.is {
                if !is_so {
                    return None;
                }
                phrase.words.extend(words.iter().cloned());
            }
            let own = phrase.place.map(|place| *place);
            (phrase.words, place(own.or_else(|| spot(words, after).map(|(place, _)| place))))
        }
        _ => (Vec::new(), place(spot(words, 0).map(|(place, _)| place))),
    };
    told.retain(|word| word != "one" && word != "thing");
    if let [ordinal] = told.as_slice()
        && let Some(index) = ["first", "second", "third", "fourth"].iter().position(|known| known == ordinal)
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

/// Which of the options the answer to "Which one?" means, or what else it names: `both`, `any`, `not the red one`, `2`,
/// `the last one`. Empty where that is not clear.
#[must_use]
pub fn choose(answer: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Vec<SmolStr> {
    let mut words: Vec<String> = tokens(answer).iter().map(|token| token.word().to_owned()).collect();
    words.retain(|word| !matches!(word.as_str(), "" | "please" | "just" | "really" | "then"));
    let said = words.join(" ");
    if ANY_OF_THEM.has(said.as_str()) {
        return options.first().cloned().into_iter().collect();
    }
    if ALL_OF_THEM.has(said.as_str()) && (options.len() == 2 || !said.contains("both") && said != "the two") {
        return options.to_vec();
    }
    if let Some(rest) = said.strip_prefix("not ") {
        let but = pick(rest, options, situation);
        let left = options.iter().filter(|option| Some(*option) != but.as_ref());
        return if but.is_some() && options.len() == 2 { left.cloned().collect() } else { Vec::new() };
    }
    // `the red one and the blue one` are two, `the red one or the blue one` is none.
    if words.iter().any(|word| word == "or") {
        return Vec::new();
    }
    let mut chosen = Vec::new();
    for part in words.split(|word| word == "and").filter(|part| !part.is_empty()) {
        let said = part.join(" ");
        let words: Vec<&str> = part.iter().map(String::as_str).collect();
        if let Some(side) = side(&words) {
            // What is called so is meant before what stands there.
            let named = pick(&said, options, situation);
            let Some(id) = named.or_else(|| farthest(side, options, situation.scene)) else {
                return Vec::new();
            };
            chosen.push(id);
            continue;
        }
        let one = numbered(part, options).or_else(|| pick(&said, options, situation));
        let Some(id) = one.or_else(|| other(&said, options, situation)) else { return Vec::new() };
        if !chosen.contains(&id) {
            chosen.push(id);
        }
    }
    chosen
}

/// `2`, `number two`, `mug 2`, `the last one`, `the other one`
fn numbered(words: &[String], options: &[SmolStr]) -> Option<SmolStr> {
    const NUMBERS: &[&str] = &["one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
    const ORDINALS: &[&str] =
        &["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"];
    let counted = |word: &str, known: &[&str]| known.iter().position(|known| *known == word).map(|at| at + 1);
    let number = |word: &str| {
        let digit = word.parse::<usize>().ok().filter(|number| (1..=9).contains(number));
        digit.or_else(|| counted(word, NUMBERS))
    };
    let all: Vec<&str> = words.iter().map(String::as_str).collect();
    // `number one` counts, `the red one` does not.
    let is_first = matches!(all.as_slice(), ["one"] | ["number" | "no" | "option", "one"]);
    let kept = all.into_iter().filter(|word| !NUMBERED_THE.has(word) && (is_first || *word != "one"));
    let kept: Vec<&str> = kept.collect();
    match kept.as_slice() {
        ["last" | "latter"] => options.last().cloned(),
        ["former"] => options.first().cloned(),
        [word] | ["in", word, "place"] if counted(word, ORDINALS).is_some() => {
            options.get(counted(word, ORDINALS)? - 1).cloned()
        }
        [word] if number(word).is_some() => {
            // The number of a name, where the options have such names, and else that of the option.
            let named: Vec<_> = options.iter().filter(|id| id.ends_with(&format!("_{word}"))).collect();
            let counted = options.get(number(word)? - 1);
            match (named.as_slice(), counted) {
                ([named], Some(counted)) if *named != counted => None,
                ([named], _) => Some((*named).clone()),
                ([], counted) => counted.cloned(),
                _ => None,
            }
        }
        [.., last] if number(last).is_some() => {
            let id = kept.join("_");
            options.iter().find(|option| option.as_str() == id).cloned()
        }
        _ => None,
    }
}

/// `the other one`, of two of which one was spoken of; or another thing of the same kind by its name.
fn other(said: &str, options: &[SmolStr], situation: &RequestContext<'_>) -> Option<SmolStr> {
    if matches!(said, "the other one" | "the other") {
        let mut not_spoken_of = options.iter().filter(|id| !situation.spoken_of.contains(id));
        return match (options.len(), not_spoken_of.next(), not_spoken_of.next()) {
            (2, Some(only), None) => Some(only.clone()),
            _ => None,
        };
    }
    // By a name, not by what would only tell it from others: `the green one` is no apple.
    let named = <[SmolStr; 1]>::try_from(named(said, situation)).ok().map(|[named]| named)?;
    let kind = |id: &SmolStr| situation.scene.entities.get(id).map(|entity| entity.kind.clone());
    (kind(&named) == kind(options.first()?)).then_some(named)
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
pub fn named(request: &str, situation: &RequestContext<'_>) -> Vec<SmolStr> {
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
