//! Lines of a binding's steps, for findings about them.

use std::collections::BTreeMap;
use toml::de::{DeTable, DeValue};

/// Lines of the steps of each primitive, from 1, in the text of a binding.
pub(super) fn of_steps(text: &str) -> BTreeMap<String, Vec<usize>> {
    let Ok(table) = DeTable::parse(text) else { return BTreeMap::new() };
    let primitives = table.get_ref().get("primitives").and_then(|value| value.get_ref().as_table());
    let line = |at: usize| 1 + text.bytes().take(at).filter(|byte| *byte == b'\n').count();
    let steps = |value: &DeValue<'_>| -> Option<Vec<usize>> {
        let steps = value.as_table()?.get("steps")?.get_ref().as_array()?;
        Some(steps.iter().map(|step| line(step.span().start)).collect())
    };
    let named = primitives.into_iter().flatten();
    named.filter_map(|(name, value)| Some((name.get_ref().to_string(), steps(value.get_ref())?))).collect()
}
