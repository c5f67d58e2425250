//! A run with somebody beside it: what happens is remembered, and a new request takes over in the middle of it.

use std::sync::Arc;

use motet_graph::Graph;
use motet_robots::scene::Scene;
use motet_runtime::{
    Control, Driver, Effect, Engine, Event, Onlooker, Prepared, Refusal, Retired, RunEnd, Time,
};
use smol_str::SmolStr;

use super::{Conversation, Planner, Problem, Watcher};
use crate::builtin::Answered;

/// The eyes and ears of a run.
pub(super) struct Live<'r, 'a> {
    talk: &'r mut Conversation<'a>,
    planner: &'r mut dyn Planner,
    watcher: &'r mut dyn Watcher,
    meant: Vec<(String, SmolStr)>,
    /// The latest time.
    pub(super) now: Time,
    /// A new request that cannot take over as it stands: the run is stopped for it.
    pub(super) pending: Option<String>,
    /// The request that took over.
    pub(super) request: Option<String>,
    /// A policy that waits to take over, with its request.
    next: Option<(Answered, String)>,
}

impl<'r, 'a> Live<'r, 'a> {
    pub(super) fn new(
        talk: &'r mut Conversation<'a>,
        planner: &'r mut dyn Planner,
        watcher: &'r mut dyn Watcher,
        meant: Vec<(String, SmolStr)>,
        now: Time,
    ) -> Self {
        Self { talk, planner, watcher, meant, now, pending: None, request: None, next: None }
    }

    /// Runs a policy to its end, and learns from it. Gives the graph that ran last too.
    pub(super) fn run(
        &mut self,
        answered: Answered,
        driver: &mut dyn Driver,
        scene: &Scene,
    ) -> Result<(RunEnd, Arc<Graph>), Problem> {
        let Some(graph) = answered.planned.compiled.graph.clone() else {
            return Err(Problem::nothing("there is no graph to run"));
        };
        let shared = Arc::new(graph.clone());
        self.talk.known.spoken_of.clone_from(&answered.understood.spoken_of);
        self.watcher.planned(&answered, &shared);
        let mut engine = self.talk.engine(graph, scene)?;
        self.talk.memory.policy(self.now, 0, shared);
        let from = self.now;
        let end = motet_runtime::run(&mut engine, driver, self, from);
        self.watcher.ended(self.now, &end);
        self.talk.known.learn(&engine);
        Ok((end, Arc::new(engine.graph().clone())))
    }
}

impl Onlooker for Live<'_, '_> {
    fn event(&mut self, now: Time, event: &Event) {
        self.now = self.now.max(now);
        self.talk.memory.event(now, event);
        self.watcher.event(now, event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.now = self.now.max(now);
        self.talk.memory.effect(now, effect);
        self.watcher.effect(now, effect);
    }

    fn reached(&mut self, now: Time) -> Control {
        self.now = self.now.max(now);
        let control = self.watcher.reached(now);
        if self.pending.is_some() { Control::Stop } else { control }
    }

    fn swap(&mut self, now: Time, engine: &Engine) -> Option<Prepared> {
        if self.pending.is_some() || engine.is_over() {
            return None;
        }
        let request = self.watcher.request(now)?;
        self.talk.memory.instruct(now, &request);
        let mut known = self.talk.known.clone();
        known.learn(engine);
        let scene = known.scene(&self.talk.setting.scene);
        let meant = std::mem::take(&mut self.meant);
        let planned = self.talk.plan_for(&request, &meant, self.planner, &scene, &known);
        let prepared = planned.ok().and_then(|answered| {
            let graph = answered.planned.compiled.graph.clone()?;
            Some((Prepared::new(graph, &engine.running()).ok()?, answered))
        });
        match prepared {
            Some((prepared, answered)) => {
                self.next = Some((answered, request));
                Some(prepared)
            }
            // It needs a question, or another start: the robot stops, and it is the next request.
            None => {
                self.pending = Some(request);
                None
            }
        }
    }

    fn swapped(&mut self, now: Time, graph: &Arc<Graph>, result: Result<Retired, Refusal>) {
        let next = self.next.take();
        match (result, next) {
            (Ok(retired), Some((answered, request))) => {
                self.talk.memory.policy(now, retired.revision() + 1, graph.clone());
                self.watcher.swapped(now, None);
                self.watcher.planned(&answered, graph);
                self.request = Some(request);
            }
            (Err(refusal), Some((_, request))) => {
                self.watcher.swapped(now, Some(&refusal));
                self.pending = Some(request);
            }
            (_, None) => {}
        }
    }

    fn at_least_every(&self) -> Time {
        self.watcher.at_least_every()
    }
}
