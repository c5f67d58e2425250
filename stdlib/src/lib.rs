//! The standard library: kinds, fluents, measures, failures, primitives and policies, as Motet text.

/// The files, in the order in which they are read: name and text.
pub const FILES: &[(&str, &str)] = &[];
