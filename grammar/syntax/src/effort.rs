//! Bounds of the work on one input, so that none keeps anybody waiting.

use crate::ast::MAX_MISTAKES;
use crate::diagnostic::{Diagnostic, Severity};
use std::cell::Cell;

/// Bound of the work on one input, of which a thread has one at a time. It is a `static` of the thread.
#[derive(Debug)]
pub struct Effort {
    /// Steps that are left to the input; `None` while there is none.
    left: Cell<Option<u64>>,
}

/// End of an input, also where the work on it panics.
struct InputEnd<'a>(&'a Effort);

impl Drop for InputEnd<'_> {
    fn drop(&mut self) {
        self.0.left.set(None);
    }
}

impl Effort {
    /// Bound that counts nothing yet.
    #[must_use]
    #[allow(clippy::new_without_default, reason = "a thread local is made by a constant")]
    pub const fn new() -> Self {
        Self { left: Cell::new(None) }
    }

    /// Does work of so many steps at most. Work inside of other work shares its bound.
    pub fn bounded<T>(&self, steps: u64, work: impl FnOnce() -> T) -> T {
        if self.left.get().is_some() {
            return work();
        }
        self.left.set(Some(steps));
        let _end = InputEnd(self);
        work()
    }

    /// Returns whether the bound is used up. What was found until then is not to be relied on.
    #[inline]
    #[must_use]
    pub fn is_used_up(&self) -> bool {
        self.left.get() == Some(0)
    }

    /// Counts steps. Outside of bounded work nothing is counted.
    #[inline]
    pub fn spend(&self, steps: u64) {
        if let Some(left) = self.left.get() {
            self.left.set(Some(left.saturating_sub(steps)));
        }
    }
}

/// Count of the errors in a list of diagnostics that grows, which looks at each of them once.
#[derive(Clone, Copy, Debug, Default)]
pub struct ErrorCount {
    seen: usize,
    errors: usize,
}

impl ErrorCount {
    /// Returns whether a list has more errors than are told. One that has become shorter is counted anew.
    pub fn is_too_many<'a>(&mut self, list: impl ExactSizeIterator<Item = &'a Diagnostic>) -> bool {
        if list.len() < self.seen {
            *self = Self::default();
        }
        let (seen, length) = (self.seen, list.len());
        self.errors += list.skip(seen).filter(|found| found.severity == Severity::Error).count();
        self.seen = length;
        self.errors > MAX_MISTAKES
    }
}
