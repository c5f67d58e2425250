//! Number of lines, or of feedback, that a driver says in a second.

use std::time::{Duration, Instant};

/// Counter of the lines of one second.
#[derive(Default)]
pub(super) struct LineRate {
    begun: Option<Instant>,
    lines: u32,
}

impl LineRate {
    /// Counts a line that was heard now. True if there were more than `most` in this second.
    pub(super) fn exceeds(&mut self, most: u32, now: Instant) -> bool {
        self.exceeds_by(1, most, now)
    }

    /// Counts several that were heard now. True if there were more than `most` in this second.
    pub(super) fn exceeds_by(&mut self, heard: usize, most: u32, now: Instant) -> bool {
        let is_over = |begun: Instant| now.saturating_duration_since(begun) >= Duration::from_secs(1);
        if self.begun.is_none_or(is_over) {
            (self.begun, self.lines) = (Some(now), 0);
        }
        self.lines = self.lines.saturating_add(u32::try_from(heard).unwrap_or(u32::MAX));
        self.lines > most
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, Instant, LineRate};

    #[test]
    fn line_rate_is_that_of_one_second() {
        let (mut rate, begun) = (LineRate::default(), Instant::now());
        assert!((0..200).all(|_| !rate.exceeds(200, begun)));
        assert!(rate.exceeds(200, begun + Duration::from_millis(999)));
        assert!(!rate.exceeds(200, begun + Duration::from_secs(1)));
    }
}
