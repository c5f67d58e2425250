//! Resources: the language manual, the standard library, the skill, and the journals of the runs.

use std::path::Path;

use motet_host::journal;
use rmcp::model::{Resource, ResourceContents, ResourceTemplate};

use super::answer::{Refusal, shown};
use super::robot::journal_folder;
use crate::output::escape;

/// Manual of the language.
const MANUAL: &str = include_str!("../../../manual/language.md");
/// Skill file for agents.
const SKILL: &str = include_str!("../../../skills/motet/SKILL.md");
/// The most journals of a list, the latest.
const MAX_JOURNALS: usize = 100;
/// The most bytes of the entries of a journal, the first ones.
const MAX_JOURNAL_BYTES: usize = 512 * 1024;

const MARKDOWN: &str = "text/markdown";
const TEXT: &str = "text/plain";
const LINES: &str = "application/x-ndjson";

/// Resources that do not change: address, type, title, text.
fn fixed() -> impl Iterator<Item = (String, &'static str, String, &'static str)> {
    let pages = [
        ("motet://manual/language", MARKDOWN, "The language Motet", MANUAL),
        ("skill://motet/SKILL.md", MARKDOWN, "How an agent works with these tools", SKILL),
    ];
    let library = motet_stdlib::FILES.iter().map(|(name, text)| {
        let name = name.trim_start_matches("stdlib/");
        (format!("motet://stdlib/{name}"), TEXT, format!("Standard library: {name}"), *text)
    });
    pages
        .into_iter()
        .map(|(uri, kind, title, text)| (uri.to_owned(), kind, title.to_owned(), text))
        .chain(library)
}

/// Lists the resources.
pub(super) fn list(journals: Option<&Path>) -> Vec<Resource> {
    let fixed = fixed().map(|(uri, kind, title, text)| {
        Resource::new(uri, title.clone()).with_title(title).with_mime_type(kind).with_size(text.len() as u64)
    });
    let runs = journals.map(runs).unwrap_or_default().into_iter().map(|run| {
        Resource::new(format!("motet://journal/{run}"), format!("Journal of the run {run}"))
            .with_mime_type(LINES)
    });
    fixed.chain(runs).collect()
}

/// Templates of addresses.
pub(super) fn templates(journals: Option<&Path>) -> Vec<ResourceTemplate> {
    let journal = ResourceTemplate::new("motet://journal/{run}", "Journal of a run").with_mime_type(LINES);
    journals.map(|_| journal).into_iter().collect()
}

/// Runs with a journal, the latest last.
fn runs(journals: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(journals).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok());
    let mut runs: Vec<String> = names.filter(|name| journal_folder(journals, name).is_some()).collect();
    runs.sort();
    runs.split_off(runs.len().saturating_sub(MAX_JOURNALS))
}

/// Reads a resource.
pub(super) fn read(uri: &str, journals: Option<&Path>) -> Result<ResourceContents, Refusal> {
    if let Some((uri, kind, _, text)) = fixed().find(|(known, ..)| known == uri) {
        return Ok(ResourceContents::text(text, uri).with_mime_type(kind));
    }
    let unknown = || Refusal::unknown("resource", uri, "`resources/list` names all of them");
    let run = uri.strip_prefix("motet://journal/").ok_or_else(unknown)?;
    let folder = journals.and_then(|journals| journal_folder(journals, run)).ok_or_else(unknown)?;
    let (mut text, mut left) = (String::new(), 0_usize);
    let read = journal::read(&folder, &mut |_, entry| {
        let line = shown(serde_json::to_value(&entry).unwrap_or_default()).to_string();
        if text.len() + line.len() < MAX_JOURNAL_BYTES && left == 0 {
            text.push_str(&line);
            text.push('\n');
        } else {
            left += 1;
        }
    });
    if let Err(error) = read
        && text.is_empty()
    {
        return Err(Refusal::new(escape(&format!("the journal cannot be read: {error}"))));
    }
    if left > 0 {
        text.push_str(&format!("{{\"entries_not_shown\": {left}}}\n"));
    }
    Ok(ResourceContents::text(text, escape(uri)).with_mime_type(LINES))
}
