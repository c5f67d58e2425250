//! Did-you-mean, and names in a sentence.

use smol_str::SmolStr;

/// The known name that is nearest to a written one, if one is near.
pub(crate) fn near<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<SmolStr> {
    motet_syntax::suggest::closest(name, known).map(SmolStr::new)
}

/// "`a`, `b` and `c`"
pub(crate) fn list(names: impl Iterator<Item = SmolStr>) -> String {
    let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
    }
}
