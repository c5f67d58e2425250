//! Observer of a run that clients follow: says what happens, paces it, lets a policy that checks take over,
//! and stops it when a client or a person wants that.

use std::sync::Arc;

use motet_graph::Graph;
use motet_host::journal::{JournalWriter, RunRecorder};
use motet_planner::dialogue::Conversation;
use motet_planner::runtime_check::Guard;
use motet_project::ProjectSession;
use motet_runtime::{
    Answer, Detection, Driver, Effect, Engine, Event, Observer, PreparedSwap, Query, RetiredGraph,
    RunControl, RunEnd, SwapRefusal, Time, ToldThing, Verifier,
};
use serde_json::{Value, json};

use super::answer::Refusal;
use super::checker::{Checker, PendingCheck};
use super::narration::{Line, narrate};
use super::run_table::{ReplySender, RunTable};
use crate::flags::Speed;
use crate::run_view::View;
use crate::runner::PacedView;

/// Longest span without a look at the answer to an open question, or at the check of a swap.
const LOOK_EVERY: Time = Time::from_nanos(100_000_000);

/// View that only tells the pace when to stop.
struct StopView {
    runs: Arc<RunTable>,
    run: String,
}

impl View for StopView {
    fn effect(&mut self, _now: Time, _effect: &Effect) {}

    fn past(&mut self, _now: Time, _effect: &Effect) {}

    fn reached(&mut self, _now: Time) {}

    fn is_closed(&self) -> bool {
        self.runs.is_stopped(&self.run)
    }

    fn finish(&mut self, _now: Time, _end: &RunEnd) {}
}

/// Observer of a run.
pub(super) struct RunWatch<'r, 'a> {
    talk: &'r mut Conversation<'a>,
    project: &'r ProjectSession,
    runs: Arc<RunTable>,
    run: String,
    guard: Option<Guard>,
    pace: PacedView,
    /// Graphs of the run by revision.
    graphs: Vec<Arc<Graph>>,
    checker: Checker,
    /// Check of a policy that is to take over, with the client that waits.
    checking: Option<(PendingCheck, ReplySender)>,
    /// Client that waits for the result of a swap, with the findings of its policy.
    swapping: Option<(ReplySender, Value)>,
    /// The latest time.
    pub(super) now: Time,
}

impl<'r, 'a> RunWatch<'r, 'a> {
    /// Observer of a run with this id.
    pub(super) fn new(
        talk: &'r mut Conversation<'a>,
        (project, checker): (&'r ProjectSession, &Checker),
        (runs, run): (&Arc<RunTable>, &str),
        guard: Option<Guard>,
        speed: Speed,
    ) -> Self {
        let view = StopView { runs: Arc::clone(runs), run: run.to_owned() };
        Self {
            talk,
            project,
            runs: Arc::clone(runs),
            run: run.to_owned(),
            guard,
            pace: PacedView::new(Box::new(view), speed),
            graphs: Vec::new(),
            checker: checker.clone(),
            checking: None,
            swapping: None,
            now: Time::ZERO,
        }
    }

    /// Runs an engine to its end with a journal. An error is one of the journal, without which nothing
    /// starts.
    pub(super) fn run(
        &mut self,
        engine: &mut Engine,
        driver: &mut dyn Driver,
        journal: JournalWriter,
        from: Time,
    ) -> (RunEnd, Option<String>) {
        self.now = from;
        self.graphs.push(Arc::new(engine.graph().clone()));
        let mut recorder = RunRecorder::new(journal, self);
        let end = motet_runtime::run(engine, driver, &mut recorder, from);
        let error = recorder.finish().err().map(|error| error.to_string());
        (end, error)
    }

    /// Graph that ran last.
    pub(super) fn graph(&self) -> Option<&Arc<Graph>> {
        self.graphs.last()
    }

    /// Begins the check of a policy that was offered.
    fn begin_check(&mut self, engine: &Engine) {
        let Some(order) = self.runs.take_offer(&self.run) else { return };
        match self.checker.begin(self.talk.midway(engine), order.policy) {
            Ok(pending) => self.checking = Some((pending, order.reply)),
            Err(refusal) => self.refuse(order.reply, refusal),
        }
    }

    fn refuse(&mut self, reply: ReplySender, refusal: Refusal) {
        self.runs.line(&self.run, &format!("a swap was refused: {}", refusal.problem()));
        // Who offered it may be gone.
        let _ = reply.send(Err(refusal));
    }
}

fn refused(refusal: &SwapRefusal) -> Refusal {
    Refusal::new(format!("the policy cannot take over: {refusal}; the one before goes on"))
}

impl Observer for RunWatch<'_, '_> {
    fn event(&mut self, now: Time, event: &Event) {
        self.now = self.now.max(now);
        self.pace.event(now, event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.now = self.now.max(now);
        self.pace.effect(now, effect);
        let revision = match effect {
            Effect::Report(record) => record.revision as usize,
            _ => self.graphs.len().saturating_sub(1),
        };
        let graph = self.graphs.get(revision).or(self.graphs.last());
        match graph.and_then(|graph| narrate(graph, now, effect)) {
            Some(Line::Event(line)) => self.runs.line(&self.run, &line),
            Some(Line::Message(line)) => self.runs.say(&self.run, &line),
            None => {}
        }
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.now = self.now.max(now);
        self.pace.reached(now)
    }

    fn detected(&mut self, _now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        let scene = self.project.scene.clone().unwrap_or_default();
        let (news, facts) = self.talk.known.notice_seen(&scene, seen, engine);
        self.guard.iter_mut().for_each(|guard| guard.saw(news.clone()));
        facts
    }

    fn tell(&mut self) -> Option<ToldThing> {
        self.talk.known.take_untold()
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        self.guard.as_mut().map(|guard| guard as &mut dyn Verifier)
    }

    fn swap(&mut self, _now: Time, engine: &Engine) -> Option<PreparedSwap> {
        if self.checking.is_none() {
            self.begin_check(engine);
        }
        let checked = self.checking.as_ref()?.0.result()?;
        let (_, reply) = self.checking.take()?;
        if engine.is_over() || self.runs.is_stopped(&self.run) {
            self.refuse(reply, Refusal::new("the run ends"));
            return None;
        }
        // The engine refuses a policy that was proved from facts that have changed since.
        let prepared = checked.and_then(|(graph, found)| {
            let prepared = PreparedSwap::new(graph, &engine.running());
            Ok((prepared.map_err(|refusal| refused(&refusal))?, found))
        });
        match prepared {
            Ok((prepared, found)) => {
                self.swapping = Some((reply, found));
                Some(prepared)
            }
            Err(refusal) => {
                self.refuse(reply, refusal);
                None
            }
        }
    }

    fn swapped(&mut self, _now: Time, graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        let Some((reply, found)) = self.swapping.take() else { return };
        let answer = match result {
            Ok(_) => {
                self.graphs.push(Arc::clone(graph));
                self.runs.started(&self.run, &graph.policy);
                Ok(json!({"run": self.run, "policy": graph.policy.as_str(), "says": found.get("says")}))
            }
            Err(refusal) => Err(refused(&refusal)),
        };
        let _ = reply.send(answer);
    }

    fn at_least_every(&self) -> Time {
        let looks = self.runs.is_asking(&self.run) || self.checking.is_some();
        self.pace.at_least_every().min(if looks { LOOK_EVERY } else { Time::NEVER })
    }
}
