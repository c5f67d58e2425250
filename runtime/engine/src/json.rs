//! Compact JSON of the engine's types.

/// Writes a value as compact JSON. Writing to memory fails for no type of this crate.
pub(crate) fn to_json<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
