//! Names of the standard library that Rust code spells itself, beside the table `stdlib/src/lang.rs`.

use std::collections::BTreeSet;
use std::path::Path;

use super::files::SourceFile;
use super::{Measure, is_source};

/// Words before the name of a declaration.
const DECLARES: [&str; 6] = ["kind", "fluent", "measure", "failure", "action", "perception"];

/// Folders that may spell the names: the library itself, and the notations, whose keywords are partly the
/// same words.
const APART: [&str; 4] = ["stdlib/", "grammar/", "robots/src/scene/", "robots/src/xacro/"];

/// Names of kinds, fluents, measures, failures and primitives that the standard library declares.
pub(super) fn declared(root: &Path) -> Result<BTreeSet<String>, String> {
    let folder = root.join("stdlib/motet");
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut names = BTreeSet::new();
    for entry in std::fs::read_dir(&folder).map_err(failed)? {
        let text = std::fs::read_to_string(entry.map_err(failed)?.path()).map_err(failed)?;
        names.extend(text.lines().filter_map(name_of).map(str::to_owned));
    }
    Ok(names)
}

/// Name that a line of the library declares.
fn name_of(line: &str) -> Option<&str> {
    let (_, rest) = line.split_once(' ').filter(|(word, _)| DECLARES.contains(word))?;
    rest.split(|letter: char| !letter.is_alphanumeric() && letter != '_')
        .next()
        .filter(|name| !name.is_empty())
}

/// String literals in source that are such a name. A key of JSON is a word of its own.
pub(super) fn spelled(files: &[SourceFile], names: &BTreeSet<String>) -> Measure {
    let mut places = Vec::new();
    for file in files.iter().filter(|file| is_source(file)) {
        if APART.iter().any(|folder| file.path.starts_with(folder)) {
            continue;
        }
        for (number, line) in file.lines.iter().take(file.source_lines).enumerate() {
            let text = line.trim_start();
            if text.starts_with("//") || text.starts_with("#[") {
                continue;
            }
            let parts: Vec<&str> = text.split('"').collect();
            let is_key = |behind: &str| behind.starts_with(':') && !behind.starts_with("::");
            let literals = parts.windows(2).skip(1).step_by(2).filter_map(|pair| match pair {
                [name, behind] if names.contains(*name) && !is_key(behind) => Some(*name),
                _ => None,
            });
            places.extend(literals.map(|name| format!("{}:{}: {name}", file.path, number + 1)));
        }
    }
    Measure::count("library-names", places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_of_reads_declarations_only() {
        assert_eq!(name_of("fluent holding(object: Object)"), Some("holding"));
        assert_eq!(name_of("kind Place: Entity"), Some("Place"));
        assert_eq!(name_of("  needs holding(object)"), None);
        assert_eq!(name_of("policy fetch(item: Text) {"), None);
    }

    #[test]
    fn spelled_counts_whole_literals_of_source() {
        let lines = [
            "let a = [\"holding\", \"a holding\"];",
            "// \"holding\"",
            "json!({\"holding\": a})",
            "fn a() {}",
        ];
        let file = |path: &str, is_test| SourceFile {
            path: path.to_owned(),
            lines: lines.iter().map(|line| (*line).to_owned()).collect(),
            is_test,
            source_lines: lines.len(),
        };
        let files =
            [file("a/src/b.rs", false), file("stdlib/src/lang.rs", false), file("a/tests/b.rs", true)];
        let found = spelled(&files, &BTreeSet::from(["holding".to_owned()]));
        assert_eq!(found.places, ["a/src/b.rs:1: holding"]);
    }
}
