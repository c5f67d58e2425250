//! Bound of the work of the proofs of one document, so that none takes more than its size: what a step costs
//! grows with the facts that are known of other things, and a policy may make very many.

use std::cell::Cell;

/// Facts that the proofs of one document may look at. The visit of a step counts as [`VISIT`] of them.
const MAX_FACTS: u64 = 40_000_000;
/// How many more these are for each byte of the document.
const MAX_FACTS_OF_BYTE: u64 = 3;
/// Weight of the visit of a step.
pub(crate) const VISIT: usize = 40;
/// Weight of the change of a fact, which is remembered.
pub(crate) const WRITE: usize = 5;

thread_local! {
    /// What is left to the document of this thread; `None` outside of one.
    static LEFT: Cell<Option<u64>> = const { Cell::new(None) };
}

/// End of a document, also where its check panics.
struct DocumentEnd;

impl Drop for DocumentEnd {
    fn drop(&mut self) {
        LEFT.set(None);
    }
}

/// Checks a document of a length in bytes within the bound. One inside another shares its bound.
pub(crate) fn bounded<T>(bytes: usize, check: impl FnOnce() -> T) -> T {
    if LEFT.get().is_some() {
        return check();
    }
    LEFT.set(Some(MAX_FACTS + MAX_FACTS_OF_BYTE * bytes as u64));
    let end = DocumentEnd;
    let found = check();
    drop(end);
    found
}

/// Returns whether the bound is used up.
pub(crate) fn is_used_up() -> bool {
    LEFT.get() == Some(0)
}

/// Counts facts that are looked at.
#[inline]
pub(crate) fn spend(facts: usize) {
    if let Some(left) = LEFT.get() {
        LEFT.set(Some(left.saturating_sub(facts as u64)));
    }
}
