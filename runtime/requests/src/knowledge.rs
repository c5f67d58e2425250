//! What a household knows: what things are, what they are good for, and what belongs to what someone says they want. Short
//! on purpose: common nouns of a kitchen and a living room, no wordings. A scene's own categories count beside it.

use crate::english::{HOLDS_CAN, ORDINARY_WORDS, PACKAGES, SAME, THINGS, USES};

/// What a thing with a name is, beside what it is called: `coke` is a `drink`. The longest ending of the name counts: an
/// `energy bar` is not any bar, and a `lime soda` is no lime.
pub(super) fn is(name: &[String]) -> Vec<&'static str> {
    for start in 0..name.len() {
        let ending = name.get(start..).unwrap_or_default().join(" ");
        if let Some(what) = THINGS.value(&ending) {
            return what.split(", ").collect();
        }
    }
    // `water bottle`: what is in it.
    match name {
        [rest @ .., last] if !rest.is_empty() && is_package(last) => is(rest),
        _ => Vec::new(),
    }
}

/// What a thing is that someone eats, drinks, cleans with.
pub(super) fn good_for(verb: &str) -> Option<&'static str> {
    USES.value(verb)
}

/// Whether a word says how a thing is packed.
pub(super) fn is_package(word: &str) -> bool {
    PACKAGES.has(word)
}

/// Whether something that is called so has in it what the words before say: a `water bottle`, but not a `water glass`.
pub(super) fn holds(word: &str) -> bool {
    HOLDS_CAN.has(word)
}

/// Whether a word is an ordinary one.
pub(super) fn is_ordinary(word: &str) -> bool {
    ORDINARY_WORDS.has(word)
}

/// A category by its usual word.
pub(super) fn usual(words: &str) -> Option<&'static str> {
    SAME.value(words)
}

/// Every word of the tables, for the reader of misspelt words.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let categories = THINGS.values().flat_map(|what| what.split([',', ' '])).filter(|word| !word.is_empty());
    THINGS.words().chain(categories).chain(SAME.words())
}
