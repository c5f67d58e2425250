//! A run with a person beside it: the memory records its events, and a new request takes over in the middle
//! of it.

use std::collections::VecDeque;
use std::sync::Arc;

use motet_graph::{Graph, NodeId, NodeKind, Value};
use motet_requests::{
    Intent, ReportedLocation, RequestContext, RoomQuestion, holds, is_question, proceeds, stops,
};
use motet_robots::scene::Scene;
use motet_runtime::{
    Answer, Detection, Driver, DriverEvent, Effect, Engine, Event, GoalId, Heard, Moved, Observer,
    Outcome as GoalOutcome, PreparedSwap, Query, RetiredGraph, RunControl, RunEnd, SwapRefusal, Time,
    ToldThing, Verifier,
};
use motet_stdlib::lang::{failures, primitives};
use smol_str::SmolStr;

use super::early_start::EarlyStart;
use super::interjection::{self, LineMeaning, LineReading, LineRequest, PolicyCheck};
use super::problem::named_entity;
use super::{Conversation, DialogueObserver, OnInstruction, Problem};
use crate::background_work::{BackgroundWork, WorkProgress};
use crate::builtin::PlannedRequest;
use crate::runtime_check::Guard;
use crate::{PlanRequest, Planner, RemainingSteps, Wait};

/// The most words that wait to be taken in.
const MAX_HEARD: usize = 16;

/// Reason to stop a run before its end.
pub(super) enum StopReason {
    /// A new request that cannot take over as it is.
    Request(String),
    /// Objects that are elsewhere than believed, so that the same request must be planned anew.
    Statement(Vec<ReportedLocation>),
    /// A person stopped the robot.
    Stop,
}

/// Observer of a run that takes new requests and swaps policies.
pub(super) struct LiveRun<'r, 'a> {
    talk: &'r mut Conversation<'a>,
    planner: &'r mut dyn Planner,
    watcher: &'r mut dyn DialogueObserver,
    meant: Vec<(String, SmolStr)>,
    /// The latest time.
    pub(super) now: Time,
    /// Reason for which the run is being stopped.
    pub(super) pending: Option<StopReason>,
    /// Request that the run carries out.
    task: String,
    /// The request that took over.
    pub(super) request: Option<String>,
    /// A line that is being read.
    reading: Option<LineReading>,
    /// A request for which a policy is being written.
    awaited: Option<String>,
    /// A finished policy that is being checked.
    checking: Option<PolicyCheck>,
    /// A policy that waits to take over, with its request.
    next: Option<(PlannedRequest, Option<String>)>,
    /// State of an early start, while the rest of the policy is still being written.
    pub(super) first: Option<EarlyStart>,
    /// The steps of the running policy that were started.
    started: Vec<NodeId>,
    /// Checker of motions that the compiler deferred.
    guard: Option<Guard>,
    /// A question of the policy that is not answered yet.
    asked: Option<(GoalId, String)>,
    /// Answers to such questions that are being read.
    answers: VecDeque<BackgroundWork<Vec<ReportedLocation>>>,
    /// Locations that such answers told.
    told: Vec<ReportedLocation>,
    /// Words that the driver heard, the latest last.
    heard: VecDeque<String>,
    /// Line that the next swap takes in.
    said: Option<String>,
    /// True if the run is held, by a person or for a new instruction.
    is_held: bool,
    /// Wish to hold the run, or to let it go on, that the run loop has not heard.
    wish: Option<RunControl>,
}

/// Ending of a run.
pub(super) struct RunResult {
    pub(super) end: RunEnd,
    /// Graph that ran last.
    pub(super) graph: Arc<Graph>,
    /// Bindings of that graph at the end.
    pub(super) bound: Vec<(SmolStr, Value)>,
    /// The run ended at a guard: a belief was wrong, and the step never started.
    pub(super) was_refused: bool,
    /// The first step failed because the robot stood in the wrong place.
    pub(super) stood_wrong: bool,
}

impl<'r, 'a> LiveRun<'r, 'a> {
    pub(super) fn new(
        talk: &'r mut Conversation<'a>,
        planner: &'r mut dyn Planner,
        watcher: &'r mut dyn DialogueObserver,
        (task, meant): (String, Vec<(String, SmolStr)>),
        now: Time,
    ) -> Self {
        Self {
            talk,
            planner,
            watcher,
            meant,
            now,
            pending: None,
            task,
            request: None,
            reading: None,
            awaited: None,
            checking: None,
            next: None,
            first: None,
            started: Vec::new(),
            guard: None,
            asked: None,
            answers: VecDeque::new(),
            told: Vec::new(),
            heard: VecDeque::new(),
            said: None,
            is_held: false,
            wish: None,
        }
    }

    /// Takes in what people say while the robot moves. Words that stop, hold or let go on count at once;
    /// everything else is for the swap that is asked for.
    fn listen(&mut self, now: Time) {
        if self.said.is_some() {
            return;
        }
        let Some(said) = self.heard.pop_front().or_else(|| self.watcher.request(now)) else { return };
        if stops(&said) {
            self.talk.memory.instruct(now, &said);
            self.pending = Some(StopReason::Stop);
        } else if holds(&said) {
            self.hold(true);
        } else if proceeds(&said) {
            self.hold(false);
        } else {
            if self.talk.on_instruction == OnInstruction::Pause && !is_question(&said) {
                self.hold(true);
            }
            self.said = Some(said);
        }
    }

    /// Holds the run, or lets it go on.
    fn hold(&mut self, is_held: bool) {
        if self.is_held != is_held {
            self.is_held = is_held;
            self.wish = Some(if is_held { RunControl::Hold } else { RunControl::Proceed });
            self.watcher.held(is_held);
        }
    }

    fn was_refused(&self, end: &RunEnd) -> bool {
        matches!(end, RunEnd::Failed { node, .. } if !self.started.contains(node))
    }

    fn stood_wrong(&self, end: &RunEnd, graph: &Graph, bound: &[(SmolStr, Value)]) -> bool {
        let RunEnd::Failed { kind, node, .. } = end else { return false };
        let is_first = self.started.is_empty() || self.started.as_slice() == [*node];
        match kind.as_str() {
            // What is picked up was driven to with the rest of what is there in view.
            failures::UNREACHABLE if is_call(graph, *node, primitives::PICK) => is_first,
            // From where it stands by chance there may be no room or no way: who drove there knows.
            failures::UNREACHABLE | failures::BLOCKED => {
                let target = leads_to(graph, *node, bound);
                let drove = |started: &NodeId| {
                    started != node
                        && leads_to(graph, *started, bound) == target
                        && is_call(graph, *started, primitives::GO)
                };
                is_first || (target.is_some() && !self.started.iter().any(drove))
            }
            _ => false,
        }
    }

    /// Runs a policy to its end, and learns from it.
    pub(super) fn run(
        &mut self,
        answered: PlannedRequest,
        driver: &mut dyn Driver,
        scene: &Scene,
    ) -> Result<RunResult, Problem> {
        let Some(graph) = answered.planned.compiled.graph.clone() else {
            return Err(Problem::nothing("there is no graph to run"));
        };
        let shared = Arc::new(graph.clone());
        self.talk.known.spoken_of.clone_from(&answered.understood.spoken_of);
        self.watcher.planned(&answered, &shared);
        let before = self.talk.known.places(scene);
        let session = self.talk.session(scene, &self.talk.known, driver.base());
        let verifies = self.watcher.verifies();
        self.guard = session.world_tracker().map(|course| Guard::new(course, verifies));
        let (mut engine, start) =
            self.talk.engine(graph, scene, driver.capabilities(), self.guard.is_some())?;
        self.talk.memory.policy(self.now, 0, shared);
        self.talk.known.look_away();
        self.first = match self.planner.rest(Wait::Not) {
            RemainingSteps::Nothing => None,
            RemainingSteps::Coming => Some(EarlyStart::new(None, &answered)),
            rest @ (RemainingSteps::Whole(_) | RemainingSteps::Broken | RemainingSteps::Stopped) => {
                Some(EarlyStart::new(Some(rest), &answered))
            }
        };
        let run = self.talk.next_run();
        self.now = driver.begin_run(self.now, &run, Some(engine.graph()));
        let from = self.now;
        let end = match self.watcher.scribe(&run, &engine, &start) {
            Some(scribe) => scribe.run(&mut engine, driver, self, from),
            None => motet_runtime::run(&mut engine, driver, self, from),
        };
        while let Some(answer) = self.answers.pop_front() {
            // Nothing moves any more.
            if let WorkProgress::Done(told) = answer.wait(|| self.watcher.is_stopped()) {
                self.hear_told(told);
            }
        }
        let checked = self.checking.take().and_then(|check| check.request);
        let read = self.reading.take().map(|line| line.said);
        let late = checked.or_else(|| self.awaited.take()).or(read).or_else(|| self.said.take());
        self.pending = self.pending.take().or(late.map(StopReason::Request));
        // Behind its first step, a policy that is still being written goes on.
        if self.first.is_none() || self.pending.is_some() || !matches!(end, RunEnd::Done { .. }) {
            self.watcher.ended(self.now, &end);
        }
        let told = std::mem::take(&mut self.told);
        self.now = self.talk.learn((&engine, &end), (&before, &told), driver, self.now);
        let bound = engine.snapshot().bindings;
        self.talk.bound.clone_from(&bound);
        if let Some(first) = &mut self.first {
            first.bound.clone_from(&bound);
        }
        let (was_refused, stood_wrong) =
            (self.was_refused(&end), self.stood_wrong(&end, engine.graph(), &bound));
        Ok(RunResult { end, graph: Arc::new(engine.graph().clone()), bound, was_refused, stood_wrong })
    }
}

impl LiveRun<'_, '_> {
    /// Takes in the locations that an answer to a question of the policy tells: the driver hears of them at
    /// once, and the next plan.
    fn hear_told(&mut self, told: Vec<ReportedLocation>) {
        told.iter().for_each(|one| self.talk.known.hear(one));
        self.told.extend(told);
    }

    /// Takes in the answers that were read by now.
    fn hear_answers(&mut self) {
        while let Some(answer) = self.answers.front() {
            match answer.progress() {
                WorkProgress::Coming => return,
                WorkProgress::Done(told) => self.hear_told(told),
                WorkProgress::Late => {}
            }
            self.answers.pop_front();
        }
    }

    /// Answers a question from what is known in the middle of the run.
    fn reply(&mut self, said: &str, question: &RoomQuestion, engine: &Engine) {
        let mut known = self.talk.known.clone();
        known.learn(engine, self.talk.base());
        let answer = self.talk.known_answer(question, &known);
        self.watcher.answered(said, answer.as_deref());
    }

    /// Starts to read a line beside the run.
    fn read(&mut self, said: String, engine: &Engine) {
        let mut known = self.talk.known.clone();
        let mut midway = known.clone();
        let before = known.places(&self.talk.setting.scene);
        known.learn(engine, self.talk.base());
        midway.learn_midway(engine, self.talk.base());
        midway.presume(&self.talk.setting.scene, &before);
        let (tells, mode) = (!self.planner.reads_answers(), self.watcher.verifies());
        let line = (said, self.task.clone());
        self.reading = Some(LineReading::start(self.talk, line, (known, midway), tells, mode));
    }

    /// Takes in the line that is being read, once it is: a question is answered, and a request is planned.
    fn heard_line(&mut self, now: Time, engine: &Engine) -> Option<PreparedSwap> {
        let line = self.reading.take()?;
        let meaning = match line.read.progress() {
            WorkProgress::Coming => {
                self.reading = Some(line);
                return None;
            }
            WorkProgress::Done(LineMeaning::Question(question)) => {
                self.reply(&line.said, &question, engine);
                return None;
            }
            WorkProgress::Done(meaning) => meaning,
            // The robot stops, and it is the next request.
            WorkProgress::Late => {
                self.talk.memory.instruct(now, &line.said);
                self.pending = Some(StopReason::Request(line.said));
                return None;
            }
        };
        self.talk.memory.instruct(now, &line.said);
        match meaning {
            LineMeaning::Request(request) => self.plan(now, *request, engine),
            LineMeaning::Statement(told) => {
                self.pending = Some(StopReason::Statement(told));
                None
            }
            LineMeaning::Question(_) => None,
        }
    }

    /// Plans a request: beside the run where the planner can, or at once.
    fn plan(&mut self, now: Time, line: LineRequest, engine: &Engine) -> Option<PreparedSwap> {
        let LineRequest { request, known, scene, session } = line;
        self.talk.bound = engine.snapshot().bindings;
        let meant = std::mem::take(&mut self.meant);
        let situation = RequestContext { meant: meant.clone(), ..known.situation(&scene) };
        let image = self.talk.look(now);
        let ask = PlanRequest { image: image.as_ref(), ..self.talk.ask(&session, &request, &situation) };
        self.checking = None;
        if self.planner.begin(&ask) {
            (self.awaited, self.first) = (Some(request), None);
            return None;
        }
        let planned =
            self.talk.plan_for((&request, image.as_ref()), &meant, self.planner, (&session, &scene, &known));
        let prepared = planned.ok().and_then(|answered| {
            let graph = answered.planned.compiled.graph.clone()?;
            Some((PreparedSwap::new(graph, &engine.running()).ok()?, answered))
        });
        match prepared {
            Some((prepared, answered)) => {
                self.next = Some((answered, Some(request)));
                Some(prepared)
            }
            // It needs a question, or another start: the robot stops, and it is the next request.
            None => {
                self.pending = Some(StopReason::Request(request));
                None
            }
        }
    }

    /// Returns a finished policy that can take over: for a new request, or the rest of an early start.
    fn written(&mut self, engine: &Engine) -> Option<PreparedSwap> {
        if self.checking.is_none() {
            let (policy, understood, request) = self.finished()?;
            let mut known = self.talk.known.clone();
            known.learn_midway(engine, self.talk.base());
            let mode = self.watcher.verifies();
            self.checking = Some(PolicyCheck::start(self.talk, (policy, request), understood, known, mode));
        }
        let checking = self.checking.take()?;
        let answered = match checking.check.progress() {
            WorkProgress::Coming => {
                self.checking = Some(checking);
                return None;
            }
            WorkProgress::Done(answered) => answered,
            WorkProgress::Late => None,
        };
        let prepared = answered.and_then(|answered| {
            let graph = answered.planned.compiled.graph.clone()?;
            Some((PreparedSwap::new(graph, &engine.running()).ok()?, *answered))
        });
        match prepared {
            Some((prepared, answered)) => {
                self.next = Some((answered, checking.request));
                Some(prepared)
            }
            None => {
                self.pending = checking.request.map(StopReason::Request);
                None
            }
        }
    }

    /// A policy that has been written since the last call, with its request.
    fn finished(&mut self) -> Option<(String, Intent, Option<String>)> {
        if let Some(request) = self.awaited.take() {
            match self.planner.rest(Wait::Not) {
                RemainingSteps::Coming => self.awaited = Some(request),
                RemainingSteps::Whole(policy) => {
                    let spoken_of = self.talk.known.spoken_of.clone();
                    return Some((policy, Intent { spoken_of, ..Intent::default() }, Some(request)));
                }
                RemainingSteps::Nothing | RemainingSteps::Broken | RemainingSteps::Stopped => {
                    self.pending = Some(StopReason::Request(request));
                }
            }
            return None;
        }
        let first = self.first.as_mut().filter(|first| first.rest.is_none())?;
        let rest = self.planner.rest(Wait::Not);
        if rest == RemainingSteps::Coming {
            return None;
        }
        first.rest = Some(rest.clone());
        let RemainingSteps::Whole(policy) = rest else { return None };
        Some((policy, first.understood.clone(), None))
    }
}

/// Last entity among the arguments of a call: its destination.
fn leads_to(graph: &Graph, node: NodeId, bound: &[(SmolStr, Value)]) -> Option<SmolStr> {
    let NodeKind::Call(call) = &graph.nodes.get(node.index())?.kind else { return None };
    call.args.iter().filter_map(|arg| named_entity(graph, bound, arg)).next_back()
}

fn is_call(graph: &Graph, node: NodeId, name: &str) -> bool {
    let Some(NodeKind::Call(call)) = graph.nodes.get(node.index()).map(|node| &node.kind) else {
        return false;
    };
    graph.primitives.get(call.primitive.index()).is_some_and(|primitive| primitive.name == name)
}

impl Observer for LiveRun<'_, '_> {
    fn event(&mut self, now: Time, event: &Event) {
        self.now = self.now.max(now);
        self.talk.memory.event(now, event);
        self.watcher.event(now, event);
        if let Event::Driver(DriverEvent::Ended {
            goal,
            outcome: GoalOutcome::Success(Some(Value::Text(said))),
        }) = event
            && let Some((_, question)) = self.asked.take_if(|(asked, _)| asked == goal)
        {
            let answer = (question, said.to_string());
            self.answers.push_back(interjection::answer(self.talk, answer, self.watcher.verifies()));
            self.hear_answers();
        }
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.now = self.now.max(now);
        self.talk.memory.effect(now, effect);
        if let Effect::Start { node, goal, command, .. } = effect {
            self.started.push(*node);
            if command.primitive == primitives::ASK
                && let Some(Value::Text(question)) = command.arg("question")
            {
                self.asked = Some((*goal, question.to_string()));
            }
        }
        self.watcher.effect(now, effect);
    }

    fn wants_telemetry(&self) -> bool {
        self.watcher.wants_telemetry()
    }

    fn moved(&mut self, moved: &Moved) {
        self.watcher.moved(moved);
    }

    fn detected(&mut self, now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        self.watcher.detected(now, seen);
        let (news, facts) = self.talk.known.notice_seen(&self.talk.setting.scene, seen, engine);
        self.guard.iter_mut().for_each(|guard| guard.saw(news.clone()));
        facts
    }

    fn tell(&mut self) -> Option<ToldThing> {
        self.talk.known.take_untold()
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        self.guard.as_mut().map(|guard| guard as &mut dyn Verifier)
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.now = self.now.max(now);
        if self.pending.is_some() {
            return RunControl::Stop;
        }
        match self.watcher.reached(now) {
            RunControl::Continue => self.wish.take().unwrap_or(RunControl::Continue),
            control @ (RunControl::Hold | RunControl::Proceed | RunControl::Stop) => control,
        }
    }

    fn heard(&mut self, _now: Time, heard: &Heard) {
        if self.heard.len() < MAX_HEARD {
            self.heard.push_back(heard.text.to_string());
        }
    }

    fn swap(&mut self, now: Time, engine: &Engine) -> Option<PreparedSwap> {
        if self.pending.is_some() || engine.is_over() {
            return None;
        }
        self.hear_answers();
        self.listen(now);
        // The robot stops, or keeps still, before anything is planned.
        if self.pending.is_some() || self.wish.is_some() {
            return None;
        }
        if self.reading.is_none()
            && let Some(said) = self.said.take()
        {
            self.read(said, engine);
        }
        if self.reading.is_some() {
            let prepared = self.heard_line(now, engine);
            if prepared.is_some() || self.pending.is_some() || self.next.is_some() {
                return prepared;
            }
        }
        self.written(engine)
    }

    fn swapped(&mut self, now: Time, graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        let next = self.next.take();
        match (result, next) {
            (Ok(retired), Some((answered, request))) => {
                self.started.clear();
                self.hold(false);
                // The new policy goes on by itself.
                self.wish = None;
                self.talk.memory.policy(now, retired.revision() + 1, graph.clone());
                self.watcher.swapped(now, None);
                self.watcher.planned(&answered, graph);
                self.first = None;
                if let Some(request) = request {
                    self.task.clone_from(&request);
                    self.request = Some(request);
                }
            }
            (Err(refusal), Some((_, request))) => {
                self.watcher.swapped(now, Some(&refusal));
                if let Some(request) = request {
                    self.pending = Some(StopReason::Request(request));
                }
            }
            (_, None) => {}
        }
    }

    fn at_least_every(&self) -> Time {
        self.watcher.at_least_every()
    }
}
