//! The state at the start: a JSON object of facts, `{"holding(mug_1)": true, "free(hand)": false}`; `null` is not known.

use std::path::Path;

use indexmap::IndexMap;
use motet_compiler::State;
use motet_syntax::Sources;
use motet_syntax::json::{self, Spanned};

use super::next_id;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

/// Reads a state from a file.
pub(super) fn read(path: &Path, sources: &mut Sources, report: &mut Report) -> Result<State, Trouble> {
    let bytes = read_small(path)?;
    let file = next_id(sources);
    let (source, mut said) = crate::document::decode(&path.display().to_string(), &bytes, file);
    sources.add(source.clone());
    let (facts, more) = json::read::<IndexMap<Spanned<String>, Option<bool>>>(&source, file);
    said.extend(more);
    report.usable("state", &said, sources)?;
    let facts = facts.ok_or(Trouble::Diagnosed("state"))?;
    Ok(State { facts: facts.into_iter().map(|(fact, holds)| (fact.value, (holds, fact.span))).collect() })
}
