//! The Rust files of the workspace, and measures of their sizes.

use std::path::Path;
use std::process::Command;

use super::{Measure, is_source};

/// Columns of a line at most, as in `rustfmt.toml`.
const WIDTH: usize = 110;

/// Folders whose files are tests, evaluations, benchmarks or chores: they are read, and do not count as
/// source.
const APART: [&str; 7] = ["tests", "benches", "examples", "eval", "fuzz", "xtask", "snapshots"];

/// One tracked Rust file.
pub(super) struct SourceFile {
    /// Path from the root of the workspace.
    pub(super) path: String,
    pub(super) lines: Vec<String>,
    /// Whether all of the file is test code.
    pub(super) is_test: bool,
    /// Lines from the first `#[cfg(test)]` module on; all lines where there is none.
    pub(super) source_lines: usize,
}

/// The tracked Rust files below `root`.
pub(super) fn tracked(root: &Path) -> Result<Vec<SourceFile>, String> {
    let output = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard", "*.rs"])
        .current_dir(root)
        .output()
        .map_err(|error| format!("git: {error}"))?;
    let paths = String::from_utf8(output.stdout).map_err(|error| error.to_string())?;
    let mut files = Vec::new();
    for path in paths.lines() {
        // A file that is deleted and not yet committed is still listed.
        let Ok(text) = std::fs::read_to_string(root.join(path)) else { continue };
        files.push(source_file(path, &text));
    }
    Ok(files)
}

fn source_file(path: &str, text: &str) -> SourceFile {
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let is_test = path.split('/').any(|part| APART.contains(&part) || part == "tests.rs");
    // Attributes may stand between the two lines.
    let begins_tests = |(at, line): (usize, &String)| {
        let module = lines.iter().skip(at + 1).find(|line| !line.starts_with("#["));
        line == "#[cfg(test)]" && module.is_some_and(|line| line.starts_with("mod ") && line.ends_with('{'))
    };
    let tests = lines.iter().enumerate().position(begins_tests);
    let source_lines = tests.unwrap_or(lines.len());
    SourceFile { path: path.to_owned(), lines, is_test, source_lines }
}

/// Lines over the width, sizes of files, and the sums.
pub(super) fn measures(files: &[SourceFile]) -> Vec<Measure> {
    let mut long = Vec::new();
    for file in files {
        for (number, line) in file.lines.iter().enumerate() {
            if line.chars().count() > WIDTH {
                long.push(format!("{}:{}", file.path, number + 1));
            }
        }
    }
    let mut sizes: Vec<(usize, &str)> = files
        .iter()
        .filter(|file| is_source(file))
        .map(|file| (file.source_lines, file.path.as_str()))
        .collect();
    sizes.sort_unstable();
    let at = |share: usize| sizes.get(sizes.len() * share / 4).map_or(0, |size| size.0) as f64;
    let largest = sizes.last().map_or(0, |size| size.0) as f64;
    let total: usize = sizes.iter().map(|size| size.0).sum();
    let listed = sizes.iter().map(|(lines, path)| format!("{lines:5} {path}")).collect();
    vec![
        Measure::count("long-lines", long),
        Measure::figure("file-lines-first-quarter-at-least", at(1)),
        Measure::figure("file-lines-third-quarter", at(3)),
        Measure::figure("file-lines-most", largest),
        Measure::figure("source-lines", total as f64),
        Measure { name: "source-files", figure: sizes.len() as f64, places: listed },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn source_file_counts_lines_before_the_test_module() {
        let file = source_file("a/src/b.rs", "fn a() {}\n\n#[cfg(test)]\n#[allow(x)]\nmod tests {\n}\n");
        assert_eq!((file.source_lines, file.is_test), (2, false));
        assert!(source_file("a/tests/b.rs", "").is_test);
    }

    #[test]
    fn measures_lists_lines_over_the_width() {
        let file = source_file("a/src/b.rs", &format!("// {}\n// short\n", "x".repeat(WIDTH)));
        let long = measures(&[file]).swap_remove(0);
        assert_eq!(long.places, ["a/src/b.rs:1"]);
    }
}
