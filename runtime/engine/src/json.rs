//! JSON of the engine's types: compact text, and lists of pairs in which each pair is an object with two
//! named fields.

use crate::query::{Query, Truth};
use motet_graph::Value;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use smol_str::SmolStr;

macro_rules! rows {
    ($($(#[$doc:meta])* $module:ident: $row:ident { $first:ident: $A:ty, $second:ident: $B:ty })*) => {$(
        $(#[$doc])*
        #[derive(Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub(crate) struct $row {
            $first: $A,
            $second: $B,
        }

        pub(crate) mod $module {
            use super::*;

            pub(crate) fn serialize<S: Serializer>(
                pairs: &[($A, $B)],
                serializer: S,
            ) -> Result<S::Ok, S::Error> {
                let row = |(a, b): &($A, $B)| $row { $first: a.clone(), $second: b.clone() };
                serializer.collect_seq(pairs.iter().map(row))
            }

            pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
                deserializer: D,
            ) -> Result<Vec<($A, $B)>, D::Error> {
                let rows = Vec::<$row>::deserialize(deserializer)?;
                Ok(rows.into_iter().map(|row| (row.$first, row.$second)).collect())
            }
        }
    )*};
}

rows! {
    /// A fact with its truth value.
    facts: FactRow { fact: Query, truth: Truth }
    /// An entity with the name of its kind.
    entities: EntityRow { id: SmolStr, kind: SmolStr }
    /// A bound name with its value.
    bindings: BindingRow { name: SmolStr, value: Value }
}

/// Writes a value as compact JSON. Writing to memory fails for no type of this crate.
pub(crate) fn to_json<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
