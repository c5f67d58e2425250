//! Suggestions of similar names, and lists of names in a sentence.

use smol_str::SmolStr;

/// Nearest known name to a written one, if one is near.
pub(crate) fn near<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<SmolStr> {
    motet_syntax::suggest::closest(name, known).map(SmolStr::new)
}

/// Joins names into a phrase: "`a`, `b` and `c`".
pub(crate) fn list(names: impl Iterator<Item = SmolStr>) -> String {
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}

/// Name of a type with its article: "an `Object`".
pub(crate) fn article(name: &str) -> String {
    let vowel =
        name.chars().next().is_some_and(|first| matches!(first.to_ascii_lowercase(), 'a' | 'e' | 'i' | 'o'));
    format!("{} `{name}`", if vowel { "an" } else { "a" })
}
