//! Shows what is done, paces it, brings typed lines as new requests, and writes the record.

use std::rc::Rc;
use std::sync::Arc;

use motet_graph::Graph;
use motet_planner::builtin::Answered;
use motet_planner::conversation::{Outcome, Problem, Watcher};
use motet_planner::guard::Verifies;
use motet_runtime::{Control, Effect, Onlooker as _, Refusal, RunEnd, Time};
use serde_json::json;

use super::model::printable;
use super::person::Asked;
use super::record::Recorder;
use crate::args::{DoArgs, RunFormat};
use crate::command::run::{self, Pace};
use crate::exit::Trouble;
use crate::out::{Colors, note};

/// Looks on.
pub(super) struct Eyes<'a> {
    args: &'a DoArgs,
    colors: Colors,
    asked: Rc<Asked>,
    recorder: Option<Recorder>,
    pace: Option<Pace>,
}

impl<'a> Eyes<'a> {
    pub(super) fn new(
        args: &'a DoArgs,
        colors: Colors,
        asked: Rc<Asked>,
        recorder: Option<Recorder>,
    ) -> Self {
        Self { args, colors, asked, recorder, pace: None }
    }

    fn record(&mut self, what: &str, more: serde_json::Value) {
        if let Some(recorder) = &self.recorder {
            recorder.write(what, more);
        }
    }

    /// Something is asked for.
    pub(super) fn requested(&mut self, request: &str) {
        self.record("request", json!({"text": request}));
    }

    /// How it all ended.
    pub(super) fn finish(mut self, outcome: &Outcome) -> Result<(), Trouble> {
        let word = match outcome {
            Outcome::Done => "done",
            Outcome::GivenUp => "given_up",
            Outcome::Stopped => "stopped",
            Outcome::Failed(_) => "failed",
        };
        self.record("outcome", json!({"outcome": word}));
        self.recorder.map_or(Ok(()), Recorder::finish)
    }
}

impl Watcher for Eyes<'_> {
    fn planned(&mut self, answered: &Answered, graph: &Arc<Graph>) {
        if let Some(recorder) = &self.recorder {
            recorder.policy(&answered.planned.text);
        }
        answered.understood.notes.iter().for_each(|text| note(text));
        if self.args.format == RunFormat::Human {
            note(&printable(answered.planned.text.trim_end()));
        }
        self.pace = Some(run::stage(self.args.format, graph, self.colors, self.args.simulated.speed));
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        if let Some(pace) = &mut self.pace {
            pace.effect(now, effect);
        }
    }

    fn reached(&mut self, now: Time) -> Control {
        self.pace.as_mut().map_or(Control::GoOn, |pace| pace.reached(now))
    }

    fn at_least_every(&self) -> Time {
        self.pace.as_ref().map_or(Time::NEVER, |pace| pace.at_least_every())
    }

    fn verifies(&self) -> Verifies {
        self.args.simulated.speed.verifies()
    }

    fn is_stopped(&self) -> bool {
        run::is_interrupted()
    }

    fn request(&mut self, _now: Time) -> Option<String> {
        let line = self.asked.typed()?;
        self.requested(&line);
        Some(line)
    }

    fn swapped(&mut self, _now: Time, refusal: Option<&Refusal>) {
        match refusal {
            None => self.record("swap", json!({})),
            Some(refusal) => self.record("swap_refused", json!({"why": refusal.to_string()})),
        }
    }

    fn ended(&mut self, _now: Time, end: &RunEnd) {
        if let Some(mut pace) = self.pace.take() {
            pace.finish(end);
        }
        self.record("ended", json!({"how": end.to_string()}));
    }

    fn asked(&mut self, problem: &Problem, answer: Option<&str>) {
        let (kind, question) = (problem.kind.name(), problem.question.clone());
        self.record("question", json!({"kind": kind, "question": question, "answer": answer}));
    }
}
