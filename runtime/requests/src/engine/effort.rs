//! Bound of the work of one reading, so that no text keeps a robot waiting. People's sentences take a small
//! part of it; the rules of a long clause without a comma would otherwise take time with the third power of
//! its length.

use motet_syntax::effort::Effort;

/// Most steps of one reading. A step is a look-up of a list, a noun, or a part of a rule.
pub(crate) const MAX_STEPS: u32 = 3_000_000;

thread_local! {
    /// Bound of the reading of this thread.
    static EFFORT: Effort = const { Effort::new() };
}

/// Reads within the bound; `None` if the reading used it up. A reading inside another shares its bound.
pub(crate) fn bounded<T>(read: impl FnOnce() -> T) -> Option<T> {
    let read = |effort: &Effort| Some(read()).filter(|_| !effort.is_used_up());
    EFFORT.with(|effort| effort.bounded(MAX_STEPS.into(), || read(effort)))
}

/// True once the bound is used up.
pub(crate) fn is_used_up() -> bool {
    EFFORT.with(Effort::is_used_up)
}

/// Takes a step. False once the bound is used up: nothing more is found then.
pub(crate) fn step() -> bool {
    EFFORT.with(|effort| effort.spend(1));
    !is_used_up()
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
