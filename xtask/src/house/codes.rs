//! Codes of diagnostics: each is declared in a `diagnostics.rs`, and `ARCHITECTURE.md` says which part of the
//! compiler has which codes.

use super::files::SourceFile;
use super::{Measure, is_source};

/// Row of the table: patterns such as `M05xx`, and the folder of the code that declares them.
struct CodeRow<'t> {
    patterns: Vec<&'t str>,
    folder: &'t str,
}

/// Codes that are declared elsewhere or that the table gives to another folder, and patterns without a code.
/// `table` is the text of `ARCHITECTURE.md`.
pub(super) fn misplaced(files: &[SourceFile], table: &str) -> Measure {
    let rows: Vec<CodeRow<'_>> = table.lines().filter_map(row).collect();
    let mut places = Vec::new();
    let mut unused: Vec<(&str, &str)> =
        rows.iter().flat_map(|row| row.patterns.iter().map(|pattern| (row.folder, *pattern))).collect();
    for file in files.iter().filter(|file| is_source(file)) {
        let own =
            rows.iter().filter(|row| file.path.starts_with(row.folder)).max_by_key(|row| row.folder.len());
        let is_apart = file.path.ends_with("/diagnostics.rs") || file.path.contains("/diagnostics/");
        for (number, code) in
            file.lines.iter().enumerate().filter_map(|(at, line)| Some((at + 1, code(line)?)))
        {
            let fits = |pattern: &str| stands_for(pattern, code);
            if !is_apart || own.is_none_or(|row| !row.patterns.iter().any(|pattern| fits(pattern))) {
                places.push(format!("{}:{number}: {code}", file.path));
            }
            unused.retain(|(folder, pattern)| own.is_none_or(|row| row.folder != *folder) || !fits(pattern));
        }
    }
    places.extend(unused.iter().map(|(folder, pattern)| format!("ARCHITECTURE.md: {pattern} of {folder}")));
    Measure::count("misplaced-codes", places)
}

/// Row of a table whose first cell has codes and whose last names a folder.
fn row(line: &str) -> Option<CodeRow<'_>> {
    let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
    let [codes, _, folder] = cells.as_slice() else { return None };
    let patterns: Vec<&str> = codes.split(", ").collect();
    let is_pattern = |word: &&str| {
        word.strip_prefix('M')
            .is_some_and(|rest| rest.len() == 4 && rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    patterns.iter().all(is_pattern).then(|| CodeRow { patterns, folder: folder.trim_matches('`') })
}

/// Code that a line of a macro declares: `Refuted("M0501", Error) {`, or without a severity.
fn code(line: &str) -> Option<&str> {
    let (name, rest) = line.trim_start().split_once("(\"")?;
    let (code, then) = rest.split_once('"')?;
    let is_name =
        name.starts_with(|c: char| c.is_ascii_uppercase()) && name.chars().all(char::is_alphanumeric);
    let is_severity = [")", ", Error)", ", Warning)"].iter().any(|end| then.starts_with(end));
    let digits = code.strip_prefix('M')?;
    let is_code = digits.len() == 4 && digits.bytes().all(|byte| byte.is_ascii_digit());
    (is_name && name != "Code" && is_severity && is_code).then_some(code)
}

fn stands_for(pattern: &str, code: &str) -> bool {
    pattern.len() == code.len() && pattern.bytes().zip(code.bytes()).all(|(p, c)| p == b'x' || p == c)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "| codes | of | folder |\n|---|---|---|\n| M05xx, M0702 | needs | `a/prove` |\n";

    fn found(path: &str, line: &str) -> Vec<String> {
        let lines = vec![line.to_owned(), "            Other(\"M0702\")".to_owned()];
        let file = SourceFile { path: path.to_owned(), source_lines: 2, is_test: false, lines };
        misplaced(&[file], TABLE).places
    }

    #[test]
    fn misplaced_compares_codes_with_the_table() {
        let line = "    Refuted(\"M0501\", Error) {";
        assert!(found("a/prove/diagnostics.rs", line).is_empty());
        assert_eq!(found("a/prove/mod.rs", line).len(), 2, "not in a file of diagnostics");
        let other = found("a/prove/diagnostics.rs", "    Refuted(\"M0601\", Error) {");
        assert_eq!(other, ["a/prove/diagnostics.rs:1: M0601", "ARCHITECTURE.md: M05xx of a/prove"]);
    }
}
