//! Words that models write where the library has another: the table `words.txt` of the standard library.
//!
//! It serves the help and the fixes of unknown callees and parameters. A name that is declared is never
//! looked up here.

use std::sync::OnceLock;

use rustc_hash::FxHashMap;

/// Meaning of a word that is no callee.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Meaning {
    /// Calls that it may mean.
    Calls(Vec<MeantCall>),
    /// An ending of the policy.
    End(&'static str),
    /// Waiting, for a time or until a condition holds.
    Wait,
    /// No one step: what to write in the text syntax, and in JSON.
    Help(&'static str, &'static str),
}

/// Call that a word may mean.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct MeantCall {
    pub(crate) callee: &'static str,
    /// True if the word may mean something else as well.
    pub(crate) is_unsure: bool,
}

/// The table of words.
#[derive(Default, Debug)]
struct Words {
    calls: FxHashMap<String, Meaning>,
    /// Names of parameters, each with other names for it.
    parameters: Vec<(&'static str, Vec<String>)>,
    /// Fluents, each with words for its opposite.
    opposites: Vec<(&'static str, Vec<String>)>,
    /// Keys beside the arguments of a call in JSON that only explain it.
    prose: Vec<String>,
}

/// Meaning of a word in the place of a callee.
pub(crate) fn meaning(word: &str) -> Option<Meaning> {
    words().calls.get(&folded(word)).cloned()
}

/// Checks for a key that only explains the call that it stands in.
pub(crate) fn is_prose(key: &str) -> bool {
    words().prose.contains(&folded(key))
}

/// The fluent whose opposite a word means.
pub(crate) fn opposite_of(word: &str) -> Option<&'static str> {
    let word = folded(word);
    words().opposites.iter().find(|(_, others)| others.contains(&word)).map(|(fluent, _)| *fluent)
}

/// The one of several parameters that another name means; `None` if there is none, or more than one.
pub(crate) fn parameter<'p>(name: &str, mut free: impl Iterator<Item = &'p str>) -> Option<&'p str> {
    let name = folded(name);
    let mut is_meant = |parameter: &&str| {
        let rows = words().parameters.iter().filter(|(known, _)| known == parameter);
        rows.flat_map(|(_, others)| others).any(|other| *other == name)
    };
    let first = free.find(&mut is_meant)?;
    free.find(is_meant).is_none().then_some(first)
}

fn words() -> &'static Words {
    static WORDS: OnceLock<Words> = OnceLock::new();
    WORDS.get_or_init(|| {
        let mut words = Words::default();
        for line in motet_stdlib::WORDS.lines().filter(|line| !line.starts_with('#')) {
            words.add(line);
        }
        words
    })
}

impl Words {
    /// Adds a row of the table. A row of another form is left out; a test of the table finds it.
    fn add(&mut self, line: &'static str) -> Option<()> {
        let (head, list) = line.rsplit_once(": ")?;
        let (sort, head) = head.split_once(' ').unwrap_or((head, ""));
        let meaning = match sort {
            "time" => Meaning::Wait,
            "prose" => {
                self.prose.extend(list.split_whitespace().map(folded));
                return Some(());
            }
            "not" => {
                self.opposites.push((head, list.split_whitespace().map(folded).collect()));
                return Some(());
            }
            "call" => {
                let calls = head.split(", ").map(|call| match call.strip_prefix('~') {
                    Some(callee) => MeantCall { callee, is_unsure: true },
                    None => MeantCall { callee: call, is_unsure: false },
                });
                Meaning::Calls(calls.collect())
            }
            "end" => Meaning::End(head),
            "help" => {
                let (text, json) = head.split_once(" | ")?;
                Meaning::Help(text, json)
            }
            "parameter" => {
                self.parameters.push((head, list.split_whitespace().map(folded).collect()));
                return Some(());
            }
            _ => return None,
        };
        self.calls.extend(list.split_whitespace().map(|word| (folded(word), meaning.clone())));
        Some(())
    }
}

/// A word without the differences between notations: `pick_up`, `pickUp` and `Pick-Up` are one.
fn folded(word: &str) -> String {
    word.chars().filter(char::is_ascii_alphanumeric).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use motet_syntax::Sources;
    use motet_syntax::words::CALL_KEYS;

    use super::{Meaning, MeantCall, folded, meaning, parameter, words};
    use crate::declare::Library;

    #[test]
    fn words_lead_to_what_the_library_declares() {
        let (library, _) = Library::builder(None, &mut Sources::default()).build();
        let rows = motet_stdlib::WORDS.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
        let rows: Vec<&str> = rows.collect();
        assert!(rows.len() > 30, "{}", rows.len());
        let is_callee = |name: &str| {
            library.names.primitives.contains_key(name) || library.names.policies.contains_key(name)
        };
        for row in &rows {
            let (head, list) = row.rsplit_once(": ").unwrap_or_else(|| panic!("{row}"));
            let sort = head.split(' ').next().unwrap();
            for word in list.split_whitespace().filter(|_| !["parameter", "not", "prose"].contains(&sort)) {
                assert!(!is_callee(word), "`{word}` is a callee itself");
                match meaning(word).unwrap() {
                    Meaning::Calls(calls) => {
                        assert!(calls.iter().all(|call| is_callee(call.callee)), "{row}");
                    }
                    Meaning::End(kind) => {
                        assert!(["done", "fail", "replan", "cannot"].contains(&kind), "{row}");
                    }
                    Meaning::Wait => assert_eq!(sort, "time"),
                    Meaning::Help(text, json) => assert!(!text.is_empty() && !json.is_empty(), "{row}"),
                }
            }
        }
        let params = |name: &str| {
            let of_primitives = library.primitives.iter().flat_map(|def| def.params.iter().map(|p| &p.name));
            let of_fluents = library.fluents.iter().flat_map(|def| def.params.iter().map(|(name, _)| name));
            let of_policies = library.policies.iter().flat_map(|def| def.params.iter().map(|p| &p.name.text));
            CALL_KEYS.contains(&name)
                || of_primitives.chain(of_fluents).chain(of_policies).any(|known| known == name)
        };
        for (name, _) in &words().parameters {
            assert!(params(name), "no parameter is named `{name}`");
        }
        for (fluent, _) in &words().opposites {
            assert!(library.names.fluents.contains_key(*fluent), "no fluent is named `{fluent}`");
        }
        let listed = rows
            .iter()
            .filter(|row| !["parameter", "not ", "prose"].iter().any(|sort| row.starts_with(sort)))
            .flat_map(|row| row.rsplit_once(": ").unwrap().1.split_whitespace().map(folded));
        assert_eq!(words().calls.len(), listed.count(), "a word stands in one row only");
    }

    #[test]
    fn words_are_folded() {
        for word in ["navigate_to", "navigateTo", "Navigate-To"] {
            let go = MeantCall { callee: "go", is_unsure: false };
            assert_eq!(meaning(word), Some(Meaning::Calls(vec![go])), "{word}");
        }
        assert_eq!(meaning("juggle"), None);
        assert_eq!(parameter("target", ["object", "hand"].into_iter()), Some("object"));
        assert_eq!(parameter("target", ["object", "on"].into_iter()), None);
        assert_eq!(parameter("speed", ["object", "on"].into_iter()), None);
    }
}
