//! Bound of the work of one reading, so that no text keeps a robot waiting. People's sentences take a small
//! part of it; the rules of a long clause without a comma would otherwise take time with the third power of
//! its length.

use std::cell::Cell;

/// Most steps of one reading. A step is a look-up of a list, a noun, or a part of a rule.
pub(crate) const MAX_STEPS: u32 = 3_000_000;

thread_local! {
    /// Steps that are left to the reading of this thread; `None` outside of a reading.
    static LEFT: Cell<Option<u32>> = const { Cell::new(None) };
}

/// End of a reading, also where it panics.
struct ReadingEnd;

impl Drop for ReadingEnd {
    fn drop(&mut self) {
        LEFT.set(None);
    }
}

/// Reads within the bound; `None` if the reading used it up, and what it found is not to be relied on. A
/// reading inside another shares its bound.
pub(crate) fn bounded<T>(read: impl FnOnce() -> T) -> Option<T> {
    if LEFT.get().is_some() {
        return Some(read());
    }
    LEFT.set(Some(MAX_STEPS));
    let reading = ReadingEnd;
    let found = read();
    let found = (!is_used_up()).then_some(found);
    drop(reading);
    found
}

/// True once the bound is used up.
pub(crate) fn is_used_up() -> bool {
    LEFT.get() == Some(0)
}

/// Takes a step. False once the bound is used up: nothing more is found then.
pub(crate) fn step() -> bool {
    match LEFT.get() {
        None => true,
        Some(0) => false,
        Some(left) => {
            LEFT.set(Some(left - 1));
            left > 1
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{MAX_STEPS, bounded, step};

    #[test]
    fn effort_is_bounded_for_the_whole_reading_and_anew_for_the_next() {
        let steps = |count: u32| bounded(|| (0..count).filter(|_| step()).count());
        assert_eq!(steps(10), Some(10));
        assert_eq!(steps(MAX_STEPS + 5), None);
        assert_eq!(steps(10), Some(10));
        // A reading inside another shares its bound.
        assert_eq!(bounded(|| [steps(MAX_STEPS / 2 + 1), steps(MAX_STEPS / 2 + 1)]), None);
        assert!(step(), "outside of a reading nothing is counted");
    }
}
