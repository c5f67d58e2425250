//! Motions that the compiler left to the run, checked in the room as the run has left it, by the geometry that the compiler
//! itself uses.

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_compiler::{Course, Prospect};
use motet_graph::Value;
use motet_runtime::{
    Answer, Command, DriverEvent, Effect, Engine, Event, GoalId, Motion, Outcome, Pattern, Query, Time,
    Verification, Verifier,
};

/// How long the engine waits for a verdict: longer than any search within its budget.
pub const WITHIN: Time = Time::from_nanos(10_000_000_000);

/// Checks motions along the way that a run takes.
#[derive(Debug)]
pub struct Guard {
    course: Course,
    live: BTreeMap<GoalId, Arc<Command>>,
}

impl Guard {
    /// For a run that begins where a course does.
    #[must_use]
    pub const fn new(course: Course) -> Self {
        Self { course, live: BTreeMap::new() }
    }

    fn report(&mut self, event: &DriverEvent) {
        match event {
            DriverEvent::Ended { goal, outcome } => {
                let Some(command) = self.live.remove(goal) else { return };
                match outcome {
                    Outcome::Success(value) => {
                        self.course.succeeded(&command.primitive, &command.args, value.as_ref());
                    }
                    Outcome::Failure(_) | Outcome::Interrupted => self.course.stopped(&command.primitive),
                }
            }
            DriverEvent::Refused { goal, .. } => {
                if let Some(command) = self.live.remove(goal) {
                    self.course.refused(&command.primitive);
                }
            }
            DriverEvent::Stopped { goal } => {
                if let Some(command) = self.live.remove(goal) {
                    self.course.stopped(&command.primitive);
                }
            }
            DriverEvent::Observed { query: Query::Fact { fluent, args }, answer: Answer::Truth(holds) } => {
                if let [Pattern::Is(Value::Entity(entity))] = args.as_slice() {
                    self.course.observed(fluent, entity, *holds);
                }
            }
            DriverEvent::Observed { .. } | DriverEvent::Acknowledged { .. } => {}
            DriverEvent::NotHeld { .. } | DriverEvent::Lost { .. } | DriverEvent::DriverLost => {}
        }
    }
}

impl Verifier for Guard {
    fn event(&mut self, event: &Event) {
        if let Event::Driver(event) = event {
            self.report(event);
        }
    }

    fn effect(&mut self, effect: &Effect) {
        let (Effect::Start { goal, command, .. } | Effect::Update { goal, command, .. }) = effect else {
            return;
        };
        // What an updated goal did before was interrupted.
        if let Some(before) = self.live.insert(*goal, Arc::clone(command)) {
            self.course.stopped(&before.primitive);
        }
        self.course.began(&command.primitive);
    }

    fn motion(&mut self, _engine: &Engine, motion: &Motion) -> Verification {
        let Command { primitive, args, .. } = &*motion.command;
        match self.course.motion(primitive, args, &motion.query, &motion.args) {
            Prospect::Feasible => Verification::Feasible,
            Prospect::Infeasible { failure, why } => Verification::Infeasible { failure, why: why.into() },
            Prospect::Unknown { why } => Verification::Unknown { why: why.into() },
        }
    }
}
