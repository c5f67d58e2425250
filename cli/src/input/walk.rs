//! Folders: every `.motet` and `.json` file below, what Git ignores aside.

use std::collections::BTreeMap;
use std::path::Path;

use ignore::WalkBuilder;
use serde::de::IgnoredAny;

use super::{Input, Inputs, has_extension, read_file};
use crate::exit::Trouble;
use crate::input::Bytes;

/// Adds the files of a folder, sorted by path.
pub(super) fn folder(path: &Path, found: &mut Inputs) -> Result<(), Trouble> {
    let mut files = Vec::new();
    for entry in WalkBuilder::new(path).require_git(false).build() {
        let entry = entry.map_err(|error| Trouble::Read {
            path: path.to_owned(),
            source: error
                .into_io_error()
                .unwrap_or_else(|| std::io::Error::other("the folder cannot be listed")),
        })?;
        let file = entry.path();
        let is_file = entry.file_type().is_some_and(|kind| kind.is_file());
        if !is_file || !(has_extension(file, "motet") || has_extension(file, "json")) {
            continue;
        }
        if has_extension(file, "json") && !may_be_policy(file)? {
            found.skipped += 1;
            continue;
        }
        found.size += entry.metadata().map_or(0, |metadata| metadata.len());
        files.push(file.to_owned());
    }
    files.sort();
    found.inputs.extend(files.into_iter().map(Input::File));
    Ok(())
}

/// Whether a JSON file in a folder is meant as a policy: scenes, states and other data lie there too. What cannot be told
/// (broken JSON, say) is taken for one.
fn may_be_policy(path: &Path) -> Result<bool, Trouble> {
    let Bytes::All(bytes) = read_file(path)? else { return Ok(true) };
    Ok(match serde_json::from_slice::<BTreeMap<String, IgnoredAny>>(&bytes) {
        Ok(members) => ["motet", "policy", "steps"].iter().any(|key| members.contains_key(*key)),
        Err(error) => !error.is_data(),
    })
}
