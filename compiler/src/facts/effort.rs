//! Bound of the work of the proofs of one document, so that none takes more than its size: what a step costs
//! grows with the facts that are known of other things, and a policy may make very many.

use motet_syntax::effort::Effort;

/// Facts that the proofs of one document may look at. The visit of a step counts as [`VISIT`] of them.
const MAX_FACTS: u64 = 40_000_000;
/// Facts that they may look at besides, for each byte of the document.
const MAX_FACTS_OF_BYTE: u64 = 3;
/// Weight of the visit of a step.
pub(crate) const VISIT: usize = 40;
/// Weight of the change of a fact: some 130 bytes are remembered of each, so all take at most 330 MB.
pub(crate) const WRITE: usize = 16;

thread_local! {
    /// Bound of the document that this thread checks.
    static EFFORT: Effort = const { Effort::new() };
}

/// Checks a document of a length in bytes within the bound.
pub(crate) fn bounded<T>(bytes: usize, check: impl FnOnce() -> T) -> T {
    within(MAX_FACTS + MAX_FACTS_OF_BYTE * bytes as u64, check)
}

/// Does work within a bound; inside of other work within that of the other.
pub(crate) fn within<T>(facts: u64, work: impl FnOnce() -> T) -> T {
    EFFORT.with(|effort| effort.bounded(facts, work))
}

/// Returns whether the bound is used up.
pub(crate) fn is_used_up() -> bool {
    EFFORT.with(Effort::is_used_up)
}

/// Counts facts that are looked at.
#[inline]
pub(crate) fn spend(facts: usize) {
    EFFORT.with(|effort| effort.spend(facts as u64));
}
