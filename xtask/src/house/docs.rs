//! Measures of doc comments: their first word, their length, and items that have none.

use super::files::SourceFile;
use super::{Measure, is_source};

/// First words of a relative clause without its noun.
const WH_WORDS: [&str; 10] =
    ["what", "whether", "where", "how", "who", "that", "which", "whose", "whom", "why"];

/// Beginnings of a public item that needs a doc comment.
const ITEMS: [&str; 10] = [
    "pub fn ",
    "pub const fn ",
    "pub struct ",
    "pub enum ",
    "pub trait ",
    "pub type ",
    "pub const ",
    "pub static ",
    "pub async fn ",
    "pub unsafe fn ",
];

/// The share of doc comments that open with a wh-word, those of one or two words, and public items without
/// one.
pub(super) fn measures(files: &[SourceFile]) -> Vec<Measure> {
    let (mut all, mut wh, mut short, mut bare) = (0_usize, Vec::new(), Vec::new(), Vec::new());
    for file in files.iter().filter(|file| is_source(file)) {
        for (line, text) in comments(file) {
            all += 1;
            let place = format!("{}:{line}: {}", file.path, text.lines().next().unwrap_or_default());
            let mut words = text.split_whitespace();
            let first = words.next().unwrap_or_default();
            let first = first.trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
            if WH_WORDS.contains(&first.as_str()) {
                wh.push(place.clone());
            }
            if words.count() < 2 {
                short.push(place);
            }
        }
        bare.extend(undocumented(file));
    }
    let percent = if all == 0 { 0.0 } else { 100.0 * wh.len() as f64 / all as f64 };
    vec![
        Measure { name: "wh-docs-percent", figure: percent, places: wh },
        Measure::count("short-docs", short),
        Measure::count("undocumented", bare),
    ]
}

/// The doc comments of a file, each with its first line's number.
fn comments(file: &SourceFile) -> Vec<(usize, String)> {
    let mut comments: Vec<(usize, String)> = Vec::new();
    let mut open = None;
    for (number, line) in file.lines.iter().enumerate() {
        let trimmed = line.trim_start();
        let marker = ["///", "//!"].into_iter().find(|marker| trimmed.starts_with(marker));
        if let Some(text) = marker.and_then(|marker| trimmed.strip_prefix(marker)) {
            match comments.last_mut().filter(|_| open == marker) {
                Some((_, comment)) => {
                    comment.push('\n');
                    comment.push_str(text.trim());
                }
                None => comments.push((number + 1, text.trim().to_owned())),
            }
        }
        open = marker;
    }
    comments
}

/// Public items of a file without a doc comment before them. The input and the body of a macro are no
/// items: there a constant has no type, or a name begins with `$`.
fn undocumented(file: &SourceFile) -> Vec<String> {
    let mut bare = Vec::new();
    let mut documented = false;
    for (number, line) in file.lines.iter().take(file.source_lines).enumerate() {
        let trimmed = line.trim_start();
        if trimmed.starts_with("///") || trimmed.starts_with("#[doc") {
            documented = true;
        } else if ITEMS.iter().any(|item| trimmed.starts_with(item)) {
            let of_macro =
                trimmed.contains(" $") || (trimmed.contains(" const ") && !trimmed.contains([':', '(']));
            if !documented && !of_macro {
                bare.push(format!("{}:{}: {trimmed}", file.path, number + 1));
            }
            documented = false;
        } else if !(trimmed.starts_with('#') || trimmed.starts_with("//") || trimmed.starts_with(')'))
            && (trimmed.is_empty() || trimmed.ends_with([';', '}', '{']))
        {
            documented = false;
        }
    }
    bare
}

#[cfg(test)]
mod tests {
    use super::super::files;
    use super::*;

    fn figures(text: &str) -> Vec<(&'static str, Vec<String>)> {
        let file = files::SourceFile {
            path: "a.rs".to_owned(),
            lines: text.lines().map(str::to_owned).collect(),
            is_test: false,
            source_lines: text.lines().count(),
        };
        measures(&[file]).into_iter().map(|measure| (measure.name, measure.places)).collect()
    }

    #[test]
    fn measures_find_wh_words_short_and_missing_comments() {
        let found = figures(
            "//! A module of things.\n/// What it is.\npub fn a() {}\n\n/// Name.\npub fn b() {}\n\npub fn \
                c() {}\n",
        );
        let places: Vec<usize> = found.iter().map(|(_, places)| places.len()).collect();
        assert_eq!(places, [1, 1, 1]);
    }

    #[test]
    fn undocumented_looks_past_attributes_and_macros() {
        let found = figures(
            "/// Makes the thing.\n#[must_use]\npub fn a() {}\npub const CODES;\npub struct $name;\n",
        );
        assert!(found.iter().all(|(_, places)| places.is_empty()));
        let found = figures("pub const LIMIT: usize = 3;\n");
        assert!(found.iter().any(|(_, places)| !places.is_empty()));
    }
}
