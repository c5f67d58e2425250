//! Guarantees of an engine that hold for any driver.

use crate::effect::Effect;
use crate::event::{DriverEvent, Event};
use crate::ids::GoalId;
use crate::run_loop::{Observer, RunControl};
use crate::time::Time;
use motet_graph::Graph;
use std::collections::{BTreeMap, BTreeSet};

/// Looks on while an engine runs, and notes every promise that it breaks: no goal is started twice, or while
/// what it conflicts with is live; a goal is cancelled at most once and not before it runs; time goes
/// forwards; nothing follows the end.
#[derive(Clone, Debug)]
pub struct EngineGuarantees {
    /// Names of resources that conflict, both ways.
    conflicts: BTreeSet<(String, String)>,
    live: BTreeMap<GoalId, Live>,
    ever: BTreeSet<GoalId>,
    last: Time,
    is_over: bool,
    broken: Vec<String>,
}

#[derive(Clone, Debug, Default)]
struct Live {
    uses: Vec<String>,
    acknowledged: bool,
    cancelled: bool,
}

impl EngineGuarantees {
    /// Of an engine that runs this graph.
    #[must_use]
    pub fn new(graph: &Graph) -> Self {
        let mut conflicts = BTreeSet::new();
        for resource in &graph.resources {
            let own = resource.name.to_string();
            for inner in resource.contains.iter().filter_map(|id| graph.resources.get(id.index())) {
                conflicts.insert((own.clone(), inner.name.to_string()));
                conflicts.insert((inner.name.to_string(), own.clone()));
            }
            conflicts.insert((own.clone(), own));
        }
        let (live, ever, broken) = (BTreeMap::new(), BTreeSet::new(), Vec::new());
        Self { conflicts, live, ever, last: Time::ZERO, is_over: false, broken }
    }

    /// Descriptions of the violations so far.
    #[must_use]
    pub fn broken(&self) -> &[String] {
        &self.broken
    }

    /// Number of goals that were started.
    #[must_use]
    pub fn starts(&self) -> usize {
        self.ever.len()
    }

    fn start(&mut self, goal: GoalId, uses: Vec<String>) {
        if !self.ever.insert(goal) {
            self.broken.push(format!("goal {goal} is started twice"));
        }
        for (other, live) in &self.live {
            for held in &live.uses {
                if uses.iter().any(|wanted| self.conflicts.contains(&(wanted.clone(), held.clone()))) {
                    self.broken.push(format!("goal {goal} is started while {other} holds `{held}`"));
                }
            }
        }
        self.live.insert(goal, Live { uses, ..Live::default() });
    }
}

impl Observer for EngineGuarantees {
    fn event(&mut self, now: Time, event: &Event) {
        if now < self.last {
            self.broken.push(format!("time runs backwards, from {} to {now}", self.last));
        }
        self.last = now;
        let Event::Driver(event) = event else { return };
        match event {
            DriverEvent::Acknowledged { goal } => {
                if let Some(live) = self.live.get_mut(goal) {
                    live.acknowledged = true;
                }
            }
            DriverEvent::Refused { goal, .. }
            | DriverEvent::Ended { goal, .. }
            | DriverEvent::Stopped { goal } => {
                self.live.remove(goal);
            }
            DriverEvent::DriverLost | DriverEvent::DriverGone => {}
            DriverEvent::NotHeld { .. } | DriverEvent::Lost { .. } => {}
            DriverEvent::Feedback { .. } | DriverEvent::Observed { .. } => {}
        }
    }

    fn commit(&mut self, _now: Time, effects: &[Effect]) -> RunControl {
        for effect in effects {
            if self.is_over {
                self.broken.push(format!("{effect:?} after the end"));
            }
            match effect {
                Effect::Start { goal, command, .. } => {
                    self.start(*goal, command.uses.iter().map(ToString::to_string).collect());
                }
                Effect::Cancel { goal } => {
                    let live = self.live.get_mut(goal);
                    if !live.is_some_and(|live| {
                        live.acknowledged && !std::mem::replace(&mut live.cancelled, true)
                    }) {
                        self.broken.push(format!("goal {goal} is cancelled twice, or before it runs"));
                    }
                }
                Effect::Finished(_) => self.is_over = true,
                Effect::Hold { .. } | Effect::Proceed { .. } | Effect::Update { .. } => {}
                Effect::SafeStop { .. } | Effect::Verify { .. } | Effect::Report(_) => {}
                Effect::Observe { .. } | Effect::Watch { .. } | Effect::Unwatch { .. } => {}
            }
        }
        RunControl::Continue
    }
}
