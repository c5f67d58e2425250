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
            path: at_fault(&error).unwrap_or(path).to_owned(),
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
            found.skipped.push(file.to_owned());
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
    let has = |members: &Members, keys: &[&str]| keys.iter().any(|key| members.contains_key(*key));
    Ok(match serde_json::from_slice::<Members>(&bytes) {
        Ok(members) => has(&members, &["motet", "policy", "steps", "achieves", "do"]),
        // Steps without the policy around them.
        Err(error) if error.is_data() => serde_json::from_slice::<Vec<Members>>(&bytes).is_ok_and(|items| {
            items.iter().any(|item| has(item, &["do", "sequence", "monitor", "parallel"]))
        }),
        Err(_) => true,
    })
}

/// The members of an object; what they hold is not read.
type Members = BTreeMap<String, IgnoredAny>;

/// The file or folder that an error of a walk is about.
fn at_fault(error: &ignore::Error) -> Option<&Path> {
    match error {
        ignore::Error::WithPath { path, .. } => Some(path),
        ignore::Error::WithDepth { err, .. } | ignore::Error::WithLineNumber { err, .. } => at_fault(err),
        ignore::Error::Partial(errors) => errors.iter().find_map(at_fault),
        ignore::Error::Loop { child, .. } => Some(child),
        ignore::Error::Io(_)
        | ignore::Error::Glob { .. }
        | ignore::Error::UnrecognizedFileType(_)
        | ignore::Error::InvalidDefinition => None,
    }
}
