//! Names of a scene's things, and the search for the things that some words mean; with what a household knows
//! of them: categories, uses, other words. That is short on purpose: common nouns of a kitchen and a living
//! room. A scene's own categories count beside it.

use motet_robots::scene::Scene;
use motet_stdlib::lang::{entities, kinds};
use smol_str::SmolStr;

use crate::engine::english::{HOLDS_CAN, ORDINARY_WORDS, PACKAGES, SAME, THINGS, USES};
use crate::engine::phrases::is_word_of_lists;
use crate::engine::token::singular;

/// The role of a thing in requests.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Role {
    /// It can be carried.
    Object,
    /// Things stand on it.
    Surface,
    /// Things lie in it.
    Container,
    /// A spot on the floor.
    Place,
    Person,
}

/// A thing with its names.
#[derive(Clone, Debug)]
pub(crate) struct Thing {
    pub(crate) id: SmolStr,
    pub(crate) role: Role,
    pub(crate) support: Option<SmolStr>,
    /// Its id, class and names, as words in the singular.
    names: Vec<Vec<String>>,
    tags: Vec<String>,
}

/// The names of a scene.
#[derive(Clone, Debug, Default)]
pub(crate) struct Vocabulary {
    pub(crate) things: Vec<Thing>,
}

impl Vocabulary {
    /// Collects the names. `supports` says where things are now, where that is known better than by the
    /// scene.
    pub(crate) fn new(scene: &Scene, supports: &[(SmolStr, Option<SmolStr>)]) -> Self {
        let things = scene.entities.values().map(|entity| {
            let mut names: Vec<Vec<String>> = Vec::new();
            for name in [&entity.id, &entity.class].into_iter().chain(&entity.names) {
                let words = words(name);
                if !words.is_empty() && !names.contains(&words) {
                    names.push(words);
                }
            }
            let mut tags: Vec<String> =
                entity.categories.iter().map(|category| words(category).join(" ")).collect();
            for name in &names {
                tags.extend(kinds(name).iter().map(|tag| (*tag).to_owned()));
                // A water bottle has water in it.
                if let [content @ .., last] = name.as_slice()
                    && holds(last)
                    && !content.is_empty()
                {
                    tags.push(content.join(" "));
                }
            }
            tags.sort();
            tags.dedup();
            let now = supports.iter().find(|(id, _)| *id == entity.id).map(|(_, support)| support.clone());
            let support = now.unwrap_or_else(|| entity.on.clone().or_else(|| entity.inside.clone()));
            Thing { id: entity.id.clone(), role: role(&entity.kind, entity.fixed), support, names, tags }
        });
        let mut things: Vec<Thing> = things.collect();
        if !things.iter().any(|thing| thing.id == entities::USER) {
            let names = vec![vec![entities::USER.to_owned()]];
            let id = SmolStr::new_static(entities::USER);
            things.push(Thing { id, role: Role::Person, support: None, names, tags: Vec::new() });
        }
        Self { things }
    }

    pub(crate) fn thing(&self, id: &str) -> Option<&Thing> {
        self.things.iter().find(|thing| thing.id == id)
    }

    /// Takes in where a thing is.
    pub(crate) fn moved(&mut self, id: &str, place: &SmolStr) {
        if let Some(thing) = self.things.iter_mut().find(|thing| thing.id == id) {
            thing.support = Some(place.clone());
        }
    }

    /// The things of some roles that words mean, by the closest of three matches: by a whole name,
    /// by what it is, or by words of its name and of what it is together. Words are in the singular.
    pub(crate) fn meant(&self, words: &[String], roles: &[Role]) -> Vec<&Thing> {
        let all = || self.things.iter().filter(|thing| roles.contains(&thing.role));
        let phrase = words.join(" ");
        let usual = usual(&phrase).unwrap_or(&phrase);
        let named: Vec<_> = all().filter(|thing| thing.names.iter().any(|name| *name == words)).collect();
        if !named.is_empty() {
            return named;
        }
        let kinds: Vec<_> = all().filter(|thing| thing.is(usual)).collect();
        if !kinds.is_empty() {
            return kinds;
        }
        // By all words, before words that only say how it is packed are passed over.
        let told: Vec<_> = all().filter(|thing| thing.is_told_by(words)).collect();
        let exactly: Vec<_> =
            told.iter().copied().filter(|thing| words.iter().all(|word| thing.is_one_of_its(word))).collect();
        if exactly.is_empty() { told } else { exactly }
    }

    /// The things of some roles of which every word tells something, be it that they only tell it apart: `the
    /// red one`.
    pub(crate) fn told_by(&self, words: &[String], roles: &[Role]) -> Vec<&Thing> {
        let all = self.things.iter().filter(|thing| roles.contains(&thing.role));
        all.filter(|thing| thing.are_its(words)).collect()
    }

    /// Words with those that nothing is called replaced by the one name that they are a slip away from. None
    /// where one has no such name.
    pub(crate) fn respelt(&self, words: &[String]) -> Option<Vec<String>> {
        let own = self.things.iter().flat_map(|thing| thing.names.iter().flatten());
        let tags = self.things.iter().flat_map(|thing| &thing.tags).flat_map(|tag| tag.split(' '));
        let mut known: Vec<&str> = own.map(String::as_str).chain(tags).collect();
        for word in known_words() {
            known.push(word);
        }
        let mut is_changed = false;
        let mut respelt = Vec::with_capacity(words.len());
        for word in words {
            if known.contains(&word.as_str()) || is_package(word) {
                respelt.push(word.clone());
                continue;
            }
            if is_ordinary(word) {
                return None;
            }
            let most = match word.chars().count() {
                0..=3 => return None,
                4..=6 => 1,
                _ => 2,
            };
            let mut near: Vec<(usize, &str)> = known
                .iter()
                .map(|known| (slips(word, known), *known))
                .filter(|(distance, _)| *distance <= most)
                .collect();
            near.sort_unstable();
            near.dedup();
            // Two names that are as near leave it open which was meant.
            match near.as_slice() {
                [(_, only)] => respelt.push((*only).to_owned()),
                [(least, first), (next, _), ..] if least < next => respelt.push((*first).to_owned()),
                _ => return None,
            }
            is_changed = true;
        }
        is_changed.then_some(respelt)
    }
}

impl Thing {
    /// Reads what it is called: its first name that is no id, else the id in words.
    pub(crate) fn called(&self) -> String {
        self.names
            .iter()
            .max_by_key(|name| name.len())
            .map_or_else(|| self.id.to_string(), |name| name.join(" "))
    }

    /// True if some words hold all those of one of its names.
    pub(crate) fn is_named_in(&self, words: &[String]) -> bool {
        self.names.iter().any(|name| name.iter().all(|word| words.contains(word)))
    }

    /// True if it is something, by category.
    pub(crate) fn is(&self, what: &str) -> bool {
        self.tags.iter().any(|tag| tag == what)
    }

    /// True if every word is one of its names' or says what it is; that it is packed says nothing by
    /// itself. A word that only tells it apart, the `red` of a `red mug`, does not name it: there is a `can`
    /// of what is in it, but no `red can`.
    fn is_told_by(&self, words: &[String]) -> bool {
        self.are_its(words) && words.iter().any(|word| self.is_content(word))
    }

    /// True if every word is one of its names' or says what it is, adjectives alone too.
    fn are_its(&self, words: &[String]) -> bool {
        let is_named = words.iter().any(|word| self.is_content(word));
        let is_its = |word: &String| self.is_one_of_its(word) || (is_named && is_package(word));
        words.iter().any(|word| self.is_one_of_its(word)) && words.iter().all(is_its)
    }

    fn is_one_of_its(&self, word: &str) -> bool {
        self.names.iter().flatten().any(|known| known == word) || self.is_content(word)
    }

    /// True if a word says what it is or what is in it: the noun of one of its names, or a category.
    pub(crate) fn is_content(&self, word: &str) -> bool {
        self.names.iter().any(|name| name.last().is_some_and(|last| last == word))
            || self.is(usual(word).unwrap_or(word))
    }
}

/// Counts how many slips of the keyboard lie between a word and a name in either number.
fn slips(word: &str, name: &str) -> usize {
    strsim::osa_distance(word, name).min(strsim::osa_distance(word, &format!("{name}s")))
}

/// A name as words in the singular, without the number that tells it from its like.
fn words(name: &str) -> Vec<String> {
    let normal = motet_robots::scene::normal(name);
    let mut words: Vec<&str> = normal.split(' ').filter(|word| !word.is_empty()).collect();
    if words.len() > 1 && words.last().is_some_and(|last| last.chars().all(|digit| digit.is_ascii_digit())) {
        words.pop();
    }
    words.into_iter().map(singular).collect()
}

fn role(kind: &str, fixed: bool) -> Role {
    match kind {
        kinds::SURFACE => Role::Surface,
        kinds::CONTAINER => Role::Container,
        kinds::PLACE => Role::Place,
        kinds::PERSON => Role::Person,
        _ if fixed => Role::Surface,
        _ => Role::Object,
    }
}

/// Reads what a thing with a name is, beside what it is called: `coke` is a `drink`. The longest ending of
/// the name counts: an `energy bar` is not any bar, and a `lime soda` is no lime.
fn kinds(name: &[String]) -> Vec<&'static str> {
    for start in 0..name.len() {
        let ending = name.get(start..).unwrap_or_default().join(" ");
        if let Some(what) = THINGS.value(&ending) {
            return what.split(", ").collect();
        }
    }
    // `water bottle`: what is in it.
    match name {
        [rest @ .., last] if !rest.is_empty() && is_package(last) => kinds(rest),
        _ => Vec::new(),
    }
}

/// Reads what a thing is that someone eats, drinks, cleans with.
pub(crate) fn good_for(verb: &str) -> Option<&'static str> {
    USES.value(verb)
}

/// True if a word says how a thing is packed.
pub(crate) fn is_package(word: &str) -> bool {
    PACKAGES.has(word)
}

/// True if something that is called so has in it what the words before say: a `water bottle`, but not
/// a `water glass`.
fn holds(word: &str) -> bool {
    HOLDS_CAN.has(word)
}

/// True if a word is an ordinary one, and so no slip for the name of a thing: `look` is no misspelt
/// `book`.
fn is_ordinary(word: &str) -> bool {
    ORDINARY_WORDS.has(word) || is_word_of_lists(word)
}

/// A category by its usual word.
fn usual(words: &str) -> Option<&'static str> {
    SAME.value(words)
}

/// Every word of the tables, for the reader of misspelt words.
fn known_words() -> impl Iterator<Item = &'static str> {
    let categories = THINGS.values().flat_map(|what| what.split([',', ' '])).filter(|word| !word.is_empty());
    THINGS.words().chain(categories).chain(SAME.words())
}
