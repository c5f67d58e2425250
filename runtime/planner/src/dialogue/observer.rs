//! People and observers beside the robot: an operator who answers, and observers who record.

use std::sync::Arc;

use motet_graph::Graph;
use motet_runtime::{
    Driver, Effect, Engine, Event, Observer, RunControl, RunEnd, StartState, SwapRefusal, Time,
};

use super::problem::Problem;
use crate::builtin::PlannedRequest;
use crate::runtime_check::CheckMode;

/// A person who answers the robot's questions.
pub trait Person {
    /// Asks a question. None where nobody answers.
    fn ask(&mut self, problem: &Problem) -> Option<String>;
}

/// NoOperator is there.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoOperator;

impl Person for NoOperator {
    fn ask(&mut self, _problem: &Problem) -> Option<String> {
        None
    }
}

/// Looks on, and brings new requests.
pub trait DialogueObserver {
    /// Recorder of the run that is about to begin, if there is one. The engine has handled no event yet.
    fn scribe(&mut self, _engine: &Engine, _start: &StartState) -> Option<Box<dyn RunRecorder>> {
        None
    }
    /// A policy is about to run, or to take over.
    fn planned(&mut self, _answered: &PlannedRequest, _graph: &Arc<Graph>) {}
    /// An event is about to be handled.
    fn event(&mut self, _now: Time, _event: &Event) {}
    /// An effect is about to be carried out.
    fn effect(&mut self, _now: Time, _effect: &Effect) {}
    /// Time has passed; whether the run goes on. To pace it against a clock, wait here.
    fn reached(&mut self, _now: Time) -> RunControl {
        RunControl::Continue
    }
    /// The longest span without a call of [`Watcher::reached`].
    fn at_least_every(&self) -> Time {
        Time::NEVER
    }
    /// When motions are searched for that were left to the run.
    fn verifies(&self) -> CheckMode {
        CheckMode::AtOnce
    }
    /// A new request that somebody has made meanwhile.
    fn request(&mut self, _now: Time) -> Option<String> {
        None
    }
    /// Returns `true` once a person wants everything to stop, also during a question.
    fn is_stopped(&self) -> bool {
        false
    }
    /// A policy took over, or could not.
    fn swapped(&mut self, _now: Time, _refusal: Option<&SwapRefusal>) {}
    /// A run has ended.
    fn ended(&mut self, _now: Time, _end: &RunEnd) {}
    /// Something is to be asked, or was answered.
    fn asked(&mut self, _problem: &Problem, _answer: Option<&str>) {}
}

/// Looks on without a word.
impl DialogueObserver for () {}

/// Writes down one run.
pub trait RunRecorder {
    /// Runs an engine to its end as [`motet_runtime::run`] does, and writes down what it takes in and gives
    /// out.
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Observer,
        from: Time,
    ) -> RunEnd;
}
