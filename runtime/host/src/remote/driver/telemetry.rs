//! Queue of what a driver reports beside the events of the engine, bounded however much it says.

use motet_runtime::{Detection, Heard, Moved, Time};
use smol_str::SmolStr;
use std::collections::{HashSet, VecDeque};

use super::super::protocol::MAX_MOVED_NAMES;

/// Telemetry of one such span is one report: 50 a second.
const SPAN: Time = Time::from_nanos(20_000_000);
/// The most reports of each kind that wait to be read; the oldest are dropped.
const MOST: usize = 128;

#[derive(Debug, Default)]
pub(super) struct TelemetryQueue {
    moved: VecDeque<Moved>,
    detected: VecDeque<Vec<Detection>>,
    heard: VecDeque<Heard>,
    /// Names of the joints and things of all reports.
    names: HashSet<SmolStr>,
    /// Some were dropped.
    has_cut: bool,
    /// Latest pose of the base.
    pub(super) base: Option<[f64; 3]>,
}

impl TelemetryQueue {
    pub(super) fn push_moved(&mut self, moved: Moved) {
        self.base = Some(moved.base);
        let span = |at: Time| at.nanos() / SPAN.nanos();
        match self.moved.back_mut() {
            Some(last) if span(last.at) == span(moved.at) => last.merge(&moved),
            _ => push(&mut self.moved, moved),
        }
    }

    /// Drops the joints and things of a report with which a run would have more than [`MAX_MOVED_NAMES`].
    /// Returns whether there are any for the first time.
    pub(super) fn cut(&mut self, moved: &mut Moved) -> bool {
        let names = &mut self.names;
        let mut has_room = |name: &SmolStr| {
            names.contains(name) || (names.len() < MAX_MOVED_NAMES && names.insert(name.clone()))
        };
        let before = moved.joints.len() + moved.things.len();
        moved.joints.retain(|name, _| has_room(name));
        moved.things.retain(|thing| has_room(&thing.id));
        let is_cut = moved.joints.len() + moved.things.len() < before;
        is_cut && !std::mem::replace(&mut self.has_cut, true)
    }

    pub(super) fn push_detected(&mut self, seen: Vec<Detection>) {
        push(&mut self.detected, seen);
    }

    pub(super) fn push_heard(&mut self, heard: Heard) {
        push(&mut self.heard, heard);
    }

    pub(super) fn moved(&mut self) -> Option<Moved> {
        self.moved.pop_front()
    }

    pub(super) fn detected(&mut self) -> Option<Vec<Detection>> {
        self.detected.pop_front()
    }

    pub(super) fn heard(&mut self) -> Option<Heard> {
        self.heard.pop_front()
    }
}

fn push<T>(queue: &mut VecDeque<T>, item: T) {
    if queue.len() >= MOST {
        queue.pop_front();
    }
    queue.push_back(item);
}

#[cfg(test)]
mod tests {
    use super::{MAX_MOVED_NAMES, MOST, TelemetryQueue};
    use motet_runtime::{Moved, MovedThing, Time};

    fn moved(secs: f64, x: f64, joint: &str, things: &[&str]) -> Moved {
        let thing =
            |id: &&str| MovedThing { id: (*id).into(), xyz: [x, 0.0, 0.0], quaternion: [0.0, 0.0, 0.0, 1.0] };
        Moved {
            at: Time::from_secs(secs),
            base: [x, 0.0, 0.0],
            joints: [(joint.into(), x)].into(),
            things: things.iter().map(thing).collect(),
        }
    }

    #[test]
    fn telemetry_queue_keeps_one_report_a_span() {
        let mut queue = TelemetryQueue::default();
        queue.push_moved(moved(0.001, 1.0, "a", &["mug"]));
        queue.push_moved(moved(0.019, 2.0, "b", &["mug", "cup"]));
        queue.push_moved(moved(0.021, 3.0, "a", &[]));
        let first = queue.moved().unwrap();
        assert_eq!((first.at, first.base), (Time::from_secs(0.019), [2.0, 0.0, 0.0]));
        assert_eq!(first.joints, [("a".into(), 1.0), ("b".into(), 2.0)].into());
        assert_eq!(first.things, moved(0.0, 2.0, "", &["mug", "cup"]).things);
        assert_eq!(queue.moved().map(|next| next.base), Some([3.0, 0.0, 0.0]));
        assert_eq!(queue.moved(), None);
    }

    #[test]
    fn telemetry_queue_takes_a_limited_number_of_names() {
        let mut queue = TelemetryQueue::default();
        let mut told = (0..MAX_MOVED_NAMES).map(|name| moved(0.0, 0.0, &name.to_string(), &[]));
        assert!(told.all(|mut moved| !queue.cut(&mut moved)));
        let mut more = moved(0.0, 0.0, "7", &["mug"]);
        assert!(queue.cut(&mut more));
        assert_eq!((more.joints.len(), more.things.len()), (1, 0));
        assert!(!queue.cut(&mut moved(0.0, 0.0, "7", &["cup"])), "it is told once");
    }

    #[test]
    fn telemetry_queue_drops_the_oldest() {
        let mut queue = TelemetryQueue::default();
        (0..1_000).for_each(|at| queue.push_moved(moved(f64::from(at), 0.0, "a", &[])));
        let left: Vec<Moved> = std::iter::from_fn(|| queue.moved()).collect();
        assert_eq!(left.len(), MOST);
        assert_eq!(left.last().map(|last| last.at), Some(Time::from_secs(999.0)));
    }
}
