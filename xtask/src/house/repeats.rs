//! Pairs of places that share twelve or more equal lines.

use std::collections::HashMap;

use super::files::SourceFile;

/// Lines that a run shares at least.
const RUN: usize = 12;

/// The pairs, each once, at the first line of its longest run.
pub(super) fn equal(files: &[SourceFile]) -> Vec<String> {
    let kept: Vec<Vec<(usize, &str)>> = files.iter().map(telling_lines).collect();
    let mut windows: HashMap<Vec<&str>, Vec<(usize, usize)>> = HashMap::new();
    for (file, lines) in kept.iter().enumerate() {
        for (start, window) in lines.windows(RUN).enumerate() {
            let key = window.iter().map(|line| line.1).collect();
            windows.entry(key).or_default().push((file, start));
        }
    }
    let mut pairs = Vec::new();
    for places in windows.values().filter(|places| places.len() > 1) {
        for (index, left) in places.iter().enumerate() {
            for right in places.iter().skip(index + 1) {
                let apart = left.0 != right.0 || right.1 >= left.1 + RUN;
                if apart && !continues(&kept, *left, *right) {
                    let name = |(file, start): (usize, usize)| {
                        let line = kept.get(file).and_then(|lines| lines.get(start)).map_or(0, |line| line.0);
                        format!("{}:{line}", files.get(file).map_or("", |file| file.path.as_str()))
                    };
                    pairs.push(format!("{} ~ {}", name(*left), name(*right)));
                }
            }
        }
    }
    pairs.sort();
    pairs
}

/// Whether the lines before both places are equal as well, so that an earlier window has named the pair.
fn continues(kept: &[Vec<(usize, &str)>], left: (usize, usize), right: (usize, usize)) -> bool {
    let before = |(file, start): (usize, usize)| {
        let line = start.checked_sub(1)?;
        kept.get(file)?.get(line).map(|line| line.1)
    };
    before(left).is_some() && before(left) == before(right)
}

/// The lines of a file that are more than punctuation, imports or comments, with their numbers.
fn telling_lines(file: &SourceFile) -> Vec<(usize, &str)> {
    let lines = file.lines.iter().enumerate().map(|(number, line)| (number + 1, line.trim()));
    lines
        .filter(|(_, line)| {
            line.chars().any(char::is_alphanumeric)
                && !line.starts_with("//")
                && !line.starts_with("use ")
                && !line.starts_with("pub use ")
                && !line.starts_with("#[")
        })
        .collect()
}
