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
use tokio::sync::oneshot;

use super::answer::Refusal;
use super::check::{findings, read};
use super::narration::{Line, narrate};
use super::run_table::RunTable;
use crate::flags::Speed;
use crate::runner::PacedView;
use crate::run_view::View;

/// Longest span without a look at the answer to an open question.
const QUESTION_EVERY: Time = Time::from_nanos(100_000_000);

/// Compiles a policy in a session. Refuses it unless it has no error.
pub(super) fn compile(
    session: &motet_compiler::Session,
    project: &ProjectSession,
    policy: &str,
) -> Result<(Graph, Value), Refusal> {
    let (source, parsed) = read(policy)?;
    let compiled = session.compile(&parsed, None);
    let found = findings(&compiled.diagnostics, &project.sources(source));
    match compiled.graph {
        Some(graph) => Ok((graph, found)),
        None => Err(Refusal::new("the check refuses the policy: nothing has moved for it").with(found)),
    }
}

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
    /// Client that waits for the result of a swap, with the findings of its policy.
    swapping: Option<(oneshot::Sender<Result<Value, Refusal>>, Value)>,
    /// The latest time.
    pub(super) now: Time,
}

impl<'r, 'a> RunWatch<'r, 'a> {
    pub(super) fn new(
        talk: &'r mut Conversation<'a>,
        project: &'r ProjectSession,
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
            swapping: None,
            now: Time::ZERO,
        }
    }

    /// Runs an engine to its end with a journal. An error is one of the journal, without which nothing starts.
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

    fn prepare(&self, policy: &str, engine: &Engine) -> Result<(PreparedSwap, Value), Refusal> {
        let (graph, found) = compile(&self.talk.midway(engine), self.project, policy)?;
        let prepared = PreparedSwap::new(graph, &engine.running()).map_err(|refusal| refused(&refusal))?;
        Ok((prepared, found))
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
        let guard: &mut dyn Verifier = self.guard.as_mut()?;
        Some(guard)
    }

    fn swap(&mut self, _now: Time, engine: &Engine) -> Option<PreparedSwap> {
        let order = self.runs.take_offer(&self.run)?;
        if engine.is_over() || self.runs.is_stopped(&self.run) {
            // Who offered it may be gone.
            let _ = order.reply.send(Err(Refusal::new("the run ends")));
            return None;
        }
        match self.prepare(&order.policy, engine) {
            Ok((prepared, found)) => {
                self.swapping = Some((order.reply, found));
                Some(prepared)
            }
            Err(refusal) => {
                self.runs.line(&self.run, &format!("a swap was refused: {}", refusal.problem()));
                let _ = order.reply.send(Err(refusal));
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
        let asking = if self.runs.is_asking(&self.run) { QUESTION_EVERY } else { Time::NEVER };
        self.pace.at_least_every().min(asking)
    }
}
