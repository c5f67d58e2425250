//! The robot's clock, as the stamps of its joint states and of its odometry tell it.
//!
//! It may differ from that of this machine, and may go slower where a simulation has stamps of its own time.
//! Its time is that of the newest stamp, and goes on from there: so a message is late by as much as its stamp
//! is behind. A delay that all messages have had from the beginning cannot be seen. Stamps of transforms do
//! not count: localisations write them ahead.

use std::time::{Duration, Instant};

/// Time for which the newest stamp counts. A clock that is set back is believed after twice this time.
const LASTS: Duration = Duration::from_secs(60);
/// The same for the time of a simulation, which may go slower than that of this machine.
const LASTS_SIMULATED: Duration = Duration::from_millis(200);
/// Stamps before this one in s are of a simulation.
const SIMULATED: f64 = 1e9;
/// Greatest delay of a message in s that is told apart from a greater one.
const MAX_LATE: f64 = 3600.0;

/// Clock of the robot.
#[derive(Debug, Default)]
pub(crate) struct Clock {
    /// Beginning of the time of arrivals.
    origin: Option<Instant>,
    /// Greatest difference of a stamp and its arrival in s, of the time that lasts now and the one before.
    leads: [Option<f64>; 2],
    begun: Option<Instant>,
}

impl Clock {
    /// Takes in a stamp in s that came at `arrival`; the time at which it was written, as far as it is known.
    pub(crate) fn hear(&mut self, stamp: f64, arrival: Instant) -> Instant {
        let origin = *self.origin.get_or_insert(arrival);
        let lasts = if stamp < SIMULATED { LASTS_SIMULATED } else { LASTS };
        if stamp > 0.0 {
            let begun = *self.begun.get_or_insert(arrival);
            if arrival.saturating_duration_since(begun) > lasts {
                (self.leads, self.begun) = ([None, self.leads[0]], Some(arrival));
            }
            let lead = stamp - since(origin, arrival);
            self.leads[0] = Some(self.leads[0].map_or(lead, |greatest| greatest.max(lead)));
        }
        self.written(stamp, arrival)
    }

    /// Time at which a message with a stamp in s was written that came at `arrival`. It is the arrival
    /// without a stamp, and as long as no clock is known.
    #[must_use]
    pub(crate) fn written(&self, stamp: f64, arrival: Instant) -> Instant {
        let lead = self.leads.iter().flatten().copied().reduce(f64::max);
        let (Some(origin), Some(lead)) = (self.origin, lead.filter(|_| stamp > 0.0)) else { return arrival };
        let late = since(origin, arrival) + lead - stamp;
        let late = if late.is_finite() { late.clamp(0.0, MAX_LATE) } else { 0.0 };
        arrival.checked_sub(Duration::from_secs_f64(late)).unwrap_or(arrival)
    }
}

fn since(origin: Instant, at: Instant) -> f64 {
    at.saturating_duration_since(origin).as_secs_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Delays in ms that a clock finds of messages with a stamp in s and an arrival in ms.
    fn delays(messages: &[(f64, u64)]) -> Vec<u128> {
        let (mut clock, origin) = (Clock::default(), Instant::now() + Duration::from_secs(3600));
        let delay = |(stamp, millis): &(f64, u64)| {
            let arrival = origin + Duration::from_millis(*millis);
            (arrival - clock.hear(*stamp, arrival)).as_millis()
        };
        messages.iter().map(delay).collect()
    }

    #[test]
    fn message_is_late_by_its_stamp_whatever_the_clock_says() {
        let now = 2e9;
        assert_eq!(delays(&[(now, 0), (now + 1.0, 1000), (now + 0.5, 2000), (0.0, 2000)]), [0, 0, 1500, 0]);
        // A delay that grows is one, although the messages come steadily.
        assert_eq!(delays(&[(now, 0), (now + 0.5, 1000), (now + 1.0, 2000)]), [0, 500, 1000]);
    }

    #[test]
    fn slow_simulation_is_not_late() {
        let messages: Vec<(f64, u64)> = (0..100).map(|at: u64| (1.0 + 0.05 * at as f64, 100 * at)).collect();
        assert!(delays(&messages).into_iter().all(|late| late <= 300), "{:?}", delays(&messages));
    }

    #[test]
    fn clock_that_was_set_back_is_believed_in_the_end() {
        let messages: Vec<(f64, u64)> = (0..200).map(|at: u64| (2e9 + at as f64, 1000 * at)).collect();
        let back = messages.iter().map(|(stamp, millis)| (stamp + 198.0, millis + 200_000));
        let all: Vec<(f64, u64)> = messages.iter().copied().chain(back).collect();
        let delays = delays(&all);
        assert_eq!([delays[199], delays[210], delays[399]], [0, 2000, 0]);
    }
}
