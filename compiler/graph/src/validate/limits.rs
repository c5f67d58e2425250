//! Named limits of a graph.

/// The most nodes, and the most regions.
pub const MAX_NODES: usize = 200_000;
/// The deepest nesting of regions.
pub const MAX_DEPTH: usize = 1_024;
/// The deepest nesting of a condition, a term, a value or a type.
pub const MAX_TERM_DEPTH: usize = 48;
/// The most resources.
pub const MAX_RESOURCES: usize = 128;
/// The most findings that are reported.
pub(super) const MAX_FINDINGS: usize = 100;
