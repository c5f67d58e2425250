//! The share of public type names that stand for more than one concept.

use std::collections::BTreeMap;

use super::files::SourceFile;
use super::{Measure, is_source};

/// Beginnings of a public type.
const TYPES: [&str; 5] = ["pub struct ", "pub enum ", "pub trait ", "pub type ", "pub union "];

/// Names of public types that are defined more than once, in percent of all names, with the places of each.
/// `stages` lists names of one concept at several stages.
pub(super) fn shared(files: &[SourceFile], stages: &[String]) -> Measure {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for file in files.iter().filter(|file| is_source(file)) {
        for (number, line) in file.lines.iter().take(file.source_lines).enumerate() {
            if let Some(name) = type_name(line) {
                places.entry(name.to_owned()).or_default().push(format!("{}:{}", file.path, number + 1));
            }
        }
    }
    let all = places.len();
    let shared: Vec<String> = places
        .into_iter()
        .filter(|(name, places)| places.len() > 1 && !stages.contains(name))
        .map(|(name, places)| format!("{name}: {}", places.join(" ")))
        .collect();
    let percent = if all == 0 { 0.0 } else { 100.0 * shared.len() as f64 / all as f64 };
    Measure { name: "shared-names-percent", figure: percent, places: shared }
}

/// The name of the public type that a line declares at the level of a module.
fn type_name(line: &str) -> Option<&str> {
    let rest = TYPES.iter().find_map(|start| line.strip_prefix(start))?;
    rest.split(|c: char| !c.is_alphanumeric() && c != '_').next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn type_name_reads_declarations_of_modules_only() {
        assert_eq!(type_name("pub struct Scene<'a> {"), Some("Scene"));
        assert_eq!(type_name("    pub type Item = u8;"), None);
        assert_eq!(type_name("pub(crate) struct Scene {"), None);
    }
}
