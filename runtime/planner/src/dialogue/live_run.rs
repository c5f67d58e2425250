//! A run with a person beside it: the memory records its events, and a new request takes over in the middle
//! of it.

use std::collections::VecDeque;
use std::sync::Arc;

use motet_graph::{Graph, NodeId, NodeKind, Value};
use motet_requests::{
    Asked, Intent, ReportedLocation, RequestContext, added, holds, is_question, proceeds, stops, withdrawn,
};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{
    Answer, Detection, Driver, DriverEvent, Effect, Engine, Event, GoalId, Heard, Moved, Observer,
    Outcome as GoalOutcome, Pattern, PreparedSwap, Query, RetiredGraph, RunControl, RunEnd, SwapRefusal,
    Time, ToldThing, Truth, Verifier,
};
use motet_stdlib::lang::{entities, failures, fluents, kinds, primitives};
use smol_str::SmolStr;

use super::early_start::EarlyStart;
use super::problem::named_entity;
use super::{Conversation, DialogueObserver, OnInstruction, Problem};
use crate::builtin::PlannedRequest;
use crate::model::{ReplyVerdict, judge};
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
    /// A request for which a policy is being written.
    awaited: Option<String>,
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
    /// Locations that answers to such questions told.
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
            awaited: None,
            next: None,
            first: None,
            started: Vec::new(),
            guard: None,
            asked: None,
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
        let late = self.awaited.take().or_else(|| self.said.take());
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
    fn hear_answer(&mut self, question: &str, said: &str) {
        let scene = self.talk.known.scene(&self.talk.setting.scene);
        let situation = self.talk.known.situation(&scene);
        let spoken_of = motet_requests::named(question, &situation);
        let told = motet_requests::told(said, Asked::Where, &RequestContext { spoken_of, ..situation });
        told.iter().for_each(|one| self.talk.known.hear(one));
        self.told.extend(told);
    }

    /// Answers a question from what is known in the middle of the run. False if the line is none.
    fn reply(&mut self, said: &str, engine: &Engine) -> bool {
        let mut known = self.talk.known.clone();
        known.learn(engine, self.talk.base());
        let scene = known.scene(&self.talk.setting.scene);
        let Some(question) = motet_requests::question(said, &known.situation(&scene)) else { return false };
        let answer = self.talk.known_answer(&question, &known);
        self.watcher.answered(said, answer.as_deref());
        true
    }

    /// The request after an addition, `also bring the apple`, or a withdrawal, `without the apple`.
    fn changed(&self, said: String) -> String {
        let task = self.task.trim_end_matches(['.', '!', ' ']);
        let names = |words: &str| {
            let scene = &self.talk.setting.scene;
            !motet_requests::named(words, &RequestContext::new(scene)).is_empty()
        };
        if let Some(more) = added(&said) {
            return format!("{task} and {more}");
        }
        match withdrawn(&said).filter(|rest| names(rest)) {
            Some(rest) => format!("{task}, but without {rest}"),
            None => said,
        }
    }

    /// Returns a finished policy that can take over: for a new request, or the rest of an early start.
    fn written(&mut self, engine: &Engine) -> Option<PreparedSwap> {
        if let Some(request) = self.awaited.take() {
            let prepared = match self.planner.rest(Wait::Not) {
                RemainingSteps::Coming => {
                    self.awaited = Some(request);
                    return None;
                }
                RemainingSteps::Whole(policy) => {
                    let understood =
                        Intent { spoken_of: self.talk.known.spoken_of.clone(), ..Intent::default() };
                    self.prepared(&policy, understood, Some(request.clone()), engine)
                }
                RemainingSteps::Nothing | RemainingSteps::Broken | RemainingSteps::Stopped => None,
            };
            if prepared.is_none() {
                self.pending = Some(StopReason::Request(request));
            }
            return prepared;
        }
        let first = self.first.as_mut().filter(|first| first.rest.is_none())?;
        let rest = self.planner.rest(Wait::Not);
        if rest == RemainingSteps::Coming {
            return None;
        }
        first.rest = Some(rest.clone());
        let understood = first.understood.clone();
        let RemainingSteps::Whole(policy) = rest else { return None };
        self.prepared(&policy, understood, None, engine)
    }

    /// Prepares a finished policy to take over in the present beliefs.
    fn prepared(
        &mut self,
        policy: &str,
        understood: Intent,
        request: Option<String>,
        engine: &Engine,
    ) -> Option<PreparedSwap> {
        let mut known = self.talk.known.clone();
        known.learn_midway(engine, self.talk.base());
        let scene = known.scene(&self.talk.setting.scene);
        // Where the base is while it moves nobody knows beforehand.
        let judged = judge(&self.talk.session(&scene, &known, None), policy);
        // Other steps than were written are not slipped in: the request is planned anew.
        let ReplyVerdict::Good { planned, changed, .. } = judged else { return None };
        if !changed.is_empty() {
            return None;
        }
        let prepared = PreparedSwap::new(planned.compiled.graph.clone()?, &engine.running()).ok()?;
        self.next = Some((PlannedRequest { understood, planned: *planned }, request));
        Some(prepared)
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

/// Reads locations from a line that states them and requests nothing.
fn statement(said: &str, situation: &RequestContext<'_>) -> Option<Vec<ReportedLocation>> {
    let understood = motet_requests::understand(said, situation).ok()?;
    (understood.aims.is_empty() && !understood.located.is_empty()).then_some(understood.located)
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
            self.hear_answer(&question, said);
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
        let guard: &mut dyn Verifier = self.guard.as_mut()?;
        Some(guard)
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
        self.listen(now);
        // The robot stops, or keeps still, before anything is planned.
        if self.pending.is_some() || self.wish.is_some() {
            return None;
        }
        let Some(said) = self.said.take() else { return self.written(engine) };
        if self.reply(&said, engine) {
            return None;
        }
        self.talk.memory.instruct(now, &said);
        let request = self.changed(said);
        let mut known = self.talk.known.clone();
        let before = known.places(&self.talk.setting.scene);
        known.learn_midway(engine, self.talk.base());
        known.presume(&before);
        self.talk.bound = engine.snapshot().bindings;
        let scene = known.scene(&self.talk.setting.scene);
        if !self.planner.reads_answers()
            && let Some(told) = statement(&request, &known.situation(&scene))
        {
            self.pending = Some(StopReason::Statement(told));
            return None;
        }
        let meant = std::mem::take(&mut self.meant);
        let session = self.talk.session(&scene, &known, None);
        let situation = RequestContext { meant: meant.clone(), ..known.situation(&scene) };
        let image = self.talk.look(now);
        let ask = PlanRequest { image: image.as_ref(), ..self.talk.ask(&session, &request, &situation) };
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

/// Asks a driver for all facts about the robot itself that its card lists as observable. Returns the answers
/// in order, and the time after them, at most the card's `observe_within` later.
pub(super) fn sense(
    driver: &mut dyn Driver,
    robot: &Robot,
    scene: &Scene,
    now: Time,
) -> (Vec<(Query, Truth)>, Time) {
    let is = |value: Value| Pattern::Is(value);
    let entity = |id: &SmolStr| is(Value::Entity(id.clone()));
    let mut queries = Vec::new();
    let mut ask = |fluent: &str, args: Vec<Pattern>| {
        if robot.observes.iter().any(|known| known == fluent) {
            queries.push(Query::Fact { fluent: fluent.into(), args });
        }
    };
    for hand in robot.hands.keys() {
        ask(fluents::FREE, vec![is(Value::Case(hand.clone()))]);
    }
    for one in scene.entities.values() {
        if one.kind == kinds::OBJECT {
            ask(fluents::HOLDING, vec![entity(&one.id)]);
        } else {
            ask(fluents::AT, vec![is(Value::Entity(SmolStr::new_static(entities::ROBOT))), entity(&one.id)]);
        }
    }
    self::ask(driver, queries, robot, now)
}

/// Asks a driver questions. Returns the answers in order, and the time after them, at most the card's
/// `observe_within` later.
pub(super) fn ask(
    driver: &mut dyn Driver,
    queries: Vec<Query>,
    robot: &Robot,
    now: Time,
) -> (Vec<(Query, Truth)>, Time) {
    for query in &queries {
        driver.observe(now, query);
    }
    let until = Time::from_secs(now.secs() + robot.observe_within_secs);
    let (mut seen, mut at, mut left) = (Vec::new(), now, queries.len());
    while left > 0 {
        let Some((time, event)) = driver.advance(until) else {
            at = at.max(until);
            break;
        };
        at = at.max(time);
        if let DriverEvent::Observed { query, answer } = event
            && queries.contains(&query)
        {
            left -= 1;
            if let Answer::Truth(holds) = answer {
                seen.push((query, if holds { Truth::True } else { Truth::False }));
            }
        }
    }
    (seen, at)
}
