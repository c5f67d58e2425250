//! Faults as they come to pass: calls that go wrong, and changes of the world at their time.

use crate::faults::{CallFault, CallFaultKind, Destination, Faults, WorldEvent};
use crate::thing::Rest;
use crate::world::SimWorld;
use indexmap::IndexMap;
use motet_runtime::Time;
use smol_str::SmolStr;
use std::collections::VecDeque;

/// Faults and world changes that are still to come.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct FaultSchedule {
    calls: Vec<CallFault>,
    counts: IndexMap<SmolStr, u32>,
    changes: VecDeque<(Time, WorldEvent)>,
}

/// A fault of one call.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ScheduledFault {
    pub(crate) fails: Option<SmolStr>,
    pub(crate) refuses: Option<SmolStr>,
    pub(crate) slower: f64,
    pub(crate) hangs: bool,
}

impl FaultSchedule {
    pub(crate) fn new(faults: &Faults) -> Self {
        let mut changes: Vec<_> =
            faults.world.iter().map(|change| (Time::from_secs(change.at), change.what.clone())).collect();
        changes.sort_by_key(|(at, _)| *at);
        Self { calls: faults.calls.clone(), counts: IndexMap::new(), changes: changes.into() }
    }

    /// Counts a call, and tells what happens to it.
    pub(crate) fn of_call(&mut self, primitive: &SmolStr) -> ScheduledFault {
        let count = self.counts.entry(primitive.clone()).or_insert(0);
        *count += 1;
        let mut fate = ScheduledFault { fails: None, refuses: None, slower: 1.0, hangs: false };
        let mine =
            |fault: &&CallFault| fault.primitive == *primitive && fault.nth.is_none_or(|nth| nth == *count);
        for fault in self.calls.iter().filter(mine) {
            match &fault.then {
                CallFaultKind::Fails(kind) => fate.fails = Some(kind.clone()),
                CallFaultKind::Refuses(kind) => fate.refuses = Some(kind.clone()),
                CallFaultKind::Slower(factor) => fate.slower *= factor,
                CallFaultKind::Hangs => fate.hangs = true,
            }
        }
        fate
    }

    /// Time at which the world changes next.
    pub(crate) fn next_time(&self) -> Time {
        self.changes.front().map_or(Time::NEVER, |(at, _)| *at)
    }

    /// The next change that is due.
    pub(crate) fn take(&mut self, now: Time) -> Option<WorldEvent> {
        self.changes.pop_front_if(|(at, _)| *at <= now).map(|(_, change)| change)
    }
}

impl SimWorld {
    /// A change happens. One of a thing that does not exist does not.
    pub(crate) fn happen(&mut self, change: &WorldEvent) {
        match change {
            WorldEvent::Moves { object, to } => self.move_away(object, to),
            WorldEvent::Walks { person, from, to, speed } => self.start_walk(person, *from, *to, *speed),
            WorldEvent::Slips(id) => self.slip(id),
            WorldEvent::Opens(id) => self.set_open(id, true),
            WorldEvent::Closes(id) => self.set_open(id, false),
            WorldEvent::Locks(id) => self.set_locked(id, true),
            WorldEvent::Unlocks(id) => self.set_locked(id, false),
            WorldEvent::Battery(charge) => self.battery = *charge,
        }
    }

    fn move_away(&mut self, id: &SmolStr, to: &Destination) {
        if !self.things.contains_key(id) {
            return;
        }
        match to {
            Destination::Surface(support) | Destination::Container(support) => {
                // What carries it cannot come to lie on it.
                if !self.things.contains_key(support) || self.root(support) == id.as_str() {
                    return;
                }
                self.slip(id);
                let is_in = matches!(to, Destination::Container(_));
                let rest = if is_in { Rest::In(support.clone()) } else { Rest::On(support.clone()) };
                self.lay(id, support, rest);
            }
            Destination::Point(xyz) => {
                self.slip(id);
                if let Some(thing) = self.things.get_mut(id) {
                    thing.rest = Rest::Free;
                    let from = thing.body.xyz;
                    self.shift(id, [xyz[0] - from[0], xyz[1] - from[1], xyz[2] - from[2]]);
                }
            }
        }
    }

    pub(crate) fn set_locked(&mut self, id: &str, locked: bool) {
        if let Some(door) = self.things.get_mut(id).and_then(|thing| thing.door.as_mut()) {
            door.locked = locked;
        }
    }
}
