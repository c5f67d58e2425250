//! Shows what is done, paces it, brings typed lines as new requests, and writes the record.

use std::cmp::Reverse;
use std::rc::Rc;
use std::sync::Arc;

use motet_graph::Graph;
use motet_planner::builtin::PlannedRequest;
use motet_planner::dialogue::{DialogueObserver, Outcome, Problem, RunRecorder};
use motet_planner::runtime_check::CheckMode;
use motet_runtime::{Effect, Engine, Observer as _, RunControl, RunEnd, StartState, SwapRefusal, Time};
use serde_json::json;

use super::model::printable;
use super::person::Asked;
use super::record::Recorder;
use super::scribe::Journal;
use crate::args::{DoArgs, RunFormat, Said};
use crate::command::run::{self, Pace};
use crate::exit::Trouble;
use crate::out::{Colors, note};

/// How often it is looked whether something is to be said.
const LISTENS_EVERY: Time = Time::from_nanos(100_000_000);

/// Looks on.
pub(super) struct Eyes<'a> {
    args: &'a DoArgs,
    colors: Colors,
    asked: Rc<Asked>,
    recorder: Option<Recorder>,
    /// What was asked for last.
    request: String,
    /// What is still to be said, the latest first.
    say: Vec<Said>,
    pace: Option<Pace>,
    /// The number of the policy that is shown, of those of this run.
    revision: u32,
    /// A policy that takes over, to be shown as soon as the one before has been told to end.
    next: Option<(String, Arc<Graph>)>,
    /// What shows the policy before.
    older: Option<Pace>,
    is_swapping: bool,
}

impl<'a> Eyes<'a> {
    pub(super) fn new(
        args: &'a DoArgs,
        colors: Colors,
        asked: Rc<Asked>,
        recorder: Option<Recorder>,
    ) -> Self {
        let mut say = args.say.clone();
        say.reverse();
        say.sort_by_key(|said| Reverse(said.at));
        Self {
            args,
            colors,
            asked,
            recorder,
            request: String::new(),
            say,
            pace: None,
            revision: 0,
            next: None,
            older: None,
            is_swapping: false,
        }
    }

    fn record(&mut self, what: &str, more: serde_json::Value) {
        if let Some(recorder) = &self.recorder {
            recorder.write(what, more);
        }
    }

    /// Shows a policy from now on.
    fn stage(&mut self, text: &str, graph: &Graph) {
        if self.args.format == RunFormat::Human {
            note(&printable(text.trim_end()));
        }
        let pace = run::stage(self.args.format, graph, self.colors, self.args.simulated.speed);
        self.older = self.pace.replace(pace);
    }

    /// Something is asked for.
    pub(super) fn requested(&mut self, request: &str) {
        self.record("request", json!({"text": request}));
        request.clone_into(&mut self.request);
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

impl DialogueObserver for Eyes<'_> {
    fn scribe(&mut self, engine: &Engine, start: &StartState) -> Option<Box<dyn RunRecorder>> {
        let recorder = self.recorder.clone()?;
        Some(Box::new(Journal::new(recorder, engine, start, &self.request)))
    }

    fn planned(&mut self, answered: &PlannedRequest, graph: &Arc<Graph>) {
        if let Some(recorder) = &self.recorder {
            recorder.policy(&answered.planned.text);
        }
        answered.understood.notes.iter().for_each(|text| note(text));
        let text = answered.planned.text.clone();
        if std::mem::take(&mut self.is_swapping) {
            self.next = Some((text, Arc::clone(graph)));
        } else {
            (self.revision, self.pace, self.older) = (0, None, None);
            self.stage(&text, graph);
        }
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        if let Effect::Report(record) = effect {
            if record.revision < self.revision {
                return self.older.iter_mut().for_each(|older| older.late(now, effect));
            }
            let is_newer = record.revision > self.revision;
            self.revision = record.revision;
            if let Some((text, graph)) = self.next.take_if(|_| is_newer) {
                self.pace.iter_mut().for_each(|pace| pace.leave(now));
                self.stage(&text, &graph);
            }
        }
        if let Some(pace) = &mut self.pace {
            pace.effect(now, effect);
        }
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.pace.as_mut().map_or(RunControl::Continue, |pace| pace.reached(now))
    }

    fn at_least_every(&self) -> Time {
        let own = if self.say.is_empty() { Time::NEVER } else { LISTENS_EVERY };
        self.pace.as_ref().map_or(own, |pace| pace.at_least_every().min(own))
    }

    fn verifies(&self) -> CheckMode {
        self.args.simulated.speed.verifies()
    }

    fn is_stopped(&self) -> bool {
        run::is_interrupted()
    }

    fn request(&mut self, now: Time) -> Option<String> {
        let said = self.say.pop_if(|said| said.at <= now).map(|said| said.text);
        let line = said.or_else(|| self.asked.typed())?;
        self.requested(&line);
        Some(line)
    }

    fn swapped(&mut self, _now: Time, refusal: Option<&SwapRefusal>) {
        match refusal {
            None => {
                self.is_swapping = true;
                self.record("swap", json!({}));
            }
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
