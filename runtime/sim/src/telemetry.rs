//! Telemetry: where the base and the things really are, told when the host asks and something has moved.

use crate::body::BasePose;
use crate::world::SimWorld;
use motet_runtime::{Moved, MovedThing, Time};
use std::collections::BTreeMap;

/// Shortest time between two reports.
const SPAN: Time = Time::from_nanos(20_000_000);

/// Poses that were told last.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Trail {
    last: Option<(Time, BasePose)>,
    /// Position and yaw of each thing, in the order of the world.
    things: Vec<([f64; 3], f64)>,
}

impl Trail {
    /// Next report: the first has all things, every other those that have moved. `None` if nothing has, or
    /// too little time has passed. O(things).
    pub(crate) fn next(&mut self, world: &SimWorld) -> Option<Moved> {
        if self.last.is_some_and(|(at, _)| world.now < at.after(SPAN)) {
            return None;
        }
        let poses = world.things.values().map(|thing| (thing.body.xyz, thing.body.yaw));
        let is_same =
            self.things.len() == world.things.len() && self.things.iter().copied().eq(poses.clone());
        if is_same && self.last.is_some_and(|(_, base)| base == world.base) {
            return None;
        }
        let is_moved = |(index, pose): &(usize, ([f64; 3], f64))| self.things.get(*index) != Some(pose);
        let moved = poses.clone().enumerate().filter(is_moved);
        let things = moved.filter_map(|(index, (xyz, yaw))| {
            let (sin, cos) = (yaw / 2.0).sin_cos();
            let id = world.things.get_index(index)?.0.clone();
            Some(MovedThing { id, xyz, quaternion: [0.0, 0.0, sin, cos] })
        });
        let things = things.collect();
        self.things = poses.collect();
        self.last = Some((world.now, world.base));
        let BasePose { x, y, heading } = world.base;
        Some(Moved { at: world.now, base: [x, y, heading], joints: BTreeMap::new(), things })
    }
}
