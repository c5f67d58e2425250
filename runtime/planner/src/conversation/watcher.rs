//! Who is there beside the robot: somebody who answers, and somebody who looks on.

use std::sync::Arc;

use motet_graph::Graph;
use motet_runtime::{
    Driver, Effect, Engine, Event, Observer, RunControl, RunEnd, StartState, SwapRefusal, Time,
};

use super::problem::Problem;
use crate::builtin::Answered;
use crate::guard::Verifies;

/// Answers questions.
pub trait Person {
    /// Asks a question. None where nobody answers.
    fn ask(&mut self, problem: &Problem) -> Option<String>;
}

/// Nobody is there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Nobody;

impl Person for Nobody {
    fn ask(&mut self, _problem: &Problem) -> Option<String> {
        None
    }
}

/// Looks on, and brings new requests.
pub trait Watcher {
    /// Who writes down the run that is about to begin, where somebody does. The engine has not taken in anything yet.
    fn scribe(&mut self, _engine: &Engine, _start: &StartState) -> Option<Box<dyn Scribe>> {
        None
    }
    /// A policy is about to run, or to take over.
    fn planned(&mut self, _answered: &Answered, _graph: &Arc<Graph>) {}
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
    fn verifies(&self) -> Verifies {
        Verifies::AtOnce
    }
    /// A new request that somebody has made meanwhile.
    fn request(&mut self, _now: Time) -> Option<String> {
        None
    }
    /// Whether a person stops it all, at a question too.
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
impl Watcher for () {}

/// Writes down one run.
pub trait Scribe {
    /// Runs an engine to its end as [`motet_runtime::run`] does, and writes down what it takes in and gives out.
    fn run(
        self: Box<Self>,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        onlooker: &mut dyn Observer,
        from: Time,
    ) -> RunEnd;
}
