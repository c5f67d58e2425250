//! The state at the start: a JSON object of facts, `{"holding(mug_1)": true, "free(hand)": false}`; `null` is not known.

use std::path::Path;

use indexmap::IndexMap;
use motet_compiler::InitialState;
use motet_syntax::Sources;
use motet_syntax::json::{self, Spanned};

use super::add;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

/// Reads a state from a file, or from the argument itself where it is an object.
pub(super) fn read(path: &Path, sources: &mut Sources, report: &mut Report) -> Result<InitialState, Trouble> {
    let written = path.to_str().filter(|text| text.trim_start().starts_with('{'));
    let (name, bytes) = match written {
        Some(text) => ("--state".to_owned(), text.as_bytes().to_vec()),
        None => (path.display().to_string(), read_small(path)?),
    };
    let (source, file, mut said) = add(&name, &bytes, sources);
    let (facts, more) = json::read::<IndexMap<Spanned<String>, Option<bool>>>(&source, file);
    said.extend(more);
    report.usable("state", &said, sources)?;
    let facts = facts.ok_or(Trouble::Diagnosed("state"))?;
    Ok(InitialState {
        facts: facts.into_iter().map(|(fact, holds)| (fact.value, (holds, fact.span))).collect(),
    })
}
