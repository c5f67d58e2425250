//! Trial of a policy: what the check says of it, and runs of it in worlds that keep to the contracts.

use motet_compiler::Session;
use motet_graph::{Graph, NodeId, NodeKind, Value, Verdict};
use motet_runtime::{
    Command, Driver, Effect, Engine, Event, PreparedSwap, RunEnd, StartState, Time, TraceEventKind, Truth,
};
use motet_syntax::{Parsed, Severity, Source, Sources};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;

use super::contract::{Condition, Domain, Frame, Need};
use super::policy::{Policy, domain_text, policy_text};
use super::wire::{Shared, speak};
use super::world::{Mood, World};

/// Greatest number of events of a run.
const MAX_EVENTS: usize = 5000;
/// Longest time in s for which nothing is heard of a driver, and nothing is due.
const MAX_SILENCE_SECS: f64 = 600.0;
/// Codes of a need and of a goal that are refuted.
pub(super) const REFUTED: [&str; 2] = ["M0501", "M0503"];

/// Fault that is put into every graph, to show that the fuzzer finds it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SeededFault {
    /// The prover calls every need proven that it has left to the run.
    ProvesTooMuch,
    /// The engine does not know what a step unsettles.
    ForgetsUnsettled,
}

impl SeededFault {
    fn put_into(self, graph: &mut Graph) {
        for node in &mut graph.nodes {
            let NodeKind::Call(call) = &mut node.kind else { continue };
            match self {
                Self::ProvesTooMuch => {
                    call.needs.iter_mut().for_each(|need| need.verdict = Verdict::Proven);
                }
                Self::ForgetsUnsettled => call.unsettles.clear(),
            }
        }
    }
}

/// Mistake of the prover or of the engine.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Mistake {
    /// A need that the graph calls proven is false when its step begins.
    Proven,
    /// A need that a guard has passed is false when its step begins.
    Passed,
    /// A guard refuses a need as false that holds.
    Refused,
    /// A guard refuses a need as unknown although everything can be observed.
    Unseen,
    /// The goal is called proven, and is false when the policy is done.
    Goal,
    /// The goal is observed to hold when the policy is done, and is false.
    Reached,
    /// The goal is observed to be false when the policy is done, and holds.
    Missed,
    /// The goal stays unknown when the policy is done, although everything can be observed.
    Unsure,
    /// The host has something to say against a driver that keeps to the protocol.
    Protocol,
    /// The run does not end.
    Endless,
}

impl Mistake {
    /// The rest of a sentence about a need.
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Proven => "is called proven, and is false when its step begins",
            Self::Passed => "was passed by its guard, and is false when its step begins",
            Self::Refused => "was refused by its guard as false, and holds",
            Self::Unseen => "was refused by its guard as unknown, and can be observed",
            Self::Goal => "is called proven, and is false when the policy is done",
            Self::Reached => "was observed to hold when the policy was done, and is false",
            Self::Missed => "was observed to be false when the policy was done, and holds",
            Self::Unsure => "stayed unknown when the policy was done, and can be observed",
            Self::Protocol => "is what the host says of its driver",
            Self::Endless => "",
        }
    }
}

/// Mistake with its place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Finding {
    pub(super) mistake: Mistake,
    /// Call and need, in words.
    pub(super) place: String,
}

/// Graph of a policy, and that of the policy which takes over from it.
#[derive(Clone, Debug)]
pub(super) struct Graphs {
    first: Graph,
    later: Option<Graph>,
    goal: Option<Goal>,
}

/// Goal of a policy.
#[derive(Clone, Debug)]
pub(super) struct Goal {
    pub(super) condition: Condition,
    /// True if the check calls it proven.
    pub(super) is_proven: bool,
}

/// Result of checking a policy.
#[derive(Debug)]
pub(super) enum Checked {
    Accepted(Box<Graphs>),
    /// A need or the goal is refuted; the codes, of [`REFUTED`].
    Refuted(Vec<&'static str>),
    /// Something else is wrong with the document, with the codes.
    Other(Vec<&'static str>),
}

/// A session over a domain.
pub(super) struct Bench<'d> {
    pub(super) domain: &'d Domain,
    session: Session,
    with_needs: bool,
    fault: Option<SeededFault>,
}

impl Graphs {
    /// The goal of the policy.
    pub(super) fn goal(&self) -> Option<&Goal> {
        self.goal.as_ref()
    }
}

impl<'d> Bench<'d> {
    /// Reads a domain, perhaps without the needs of its actions.
    ///
    /// # Errors
    ///
    /// The domain has diagnostics: their texts.
    pub(super) fn new(
        domain: &'d Domain,
        with_needs: bool,
        fault: Option<SeededFault>,
    ) -> Result<Self, String> {
        let mut sources = Sources::default();
        let source = Source::new("domain.motet", domain_text(domain, with_needs));
        let id = sources.add(source.clone());
        let parsed = motet_syntax::read(&source, id);
        let mut said = parsed.diagnostics;
        let session = Session::builder().domains(&[parsed.file]).build(&mut sources);
        said.extend(session.input_diagnostics().iter().cloned());
        match said.iter().find(|said| said.severity == Severity::Error) {
            Some(wrong) => Err(format!("{}: {}\n{}", wrong.code.0, wrong.message, source.text)),
            None => Ok(Self { domain, session, with_needs, fault }),
        }
    }

    /// A session over nothing, for documents that declare the domain themselves.
    pub(super) fn bare(domain: &'d Domain, fault: Option<SeededFault>) -> Self {
        let session = Session::builder().build(&mut Sources::default());
        Self { domain, session, with_needs: true, fault }
    }

    /// Checks a policy.
    #[must_use]
    pub(super) fn check(&self, policy: &Policy) -> Checked {
        let mut sources = Sources::default();
        let source = Source::new("policy.motet", policy_text(self.domain, policy, self.with_needs));
        let id = sources.add(source.clone());
        let parsed = motet_syntax::read(&source, id);
        let mut checked = self.check_document(&parsed, "p", policy.goal.as_ref());
        if let Checked::Accepted(graphs) = &mut checked
            && !policy.later.is_empty()
        {
            match self.check_document(&parsed, "later", None) {
                Checked::Accepted(later) => graphs.later = Some(later.first),
                refused => return refused,
            }
        }
        checked
    }

    /// Checks a policy of a document, with its goal.
    #[must_use]
    pub(super) fn check_document(&self, parsed: &Parsed, policy: &str, goal: Option<&Condition>) -> Checked {
        let compiled = self.session.compile(parsed, Some(policy));
        let errors = compiled.diagnostics.iter().filter(|said| said.severity == Severity::Error);
        let mut codes: Vec<&'static str> = errors.map(|said| said.code.0).collect();
        codes.sort_unstable();
        codes.dedup();
        match compiled.graph {
            Some(mut graph) if codes.is_empty() => {
                self.fault.into_iter().for_each(|fault| fault.put_into(&mut graph));
                let goal = goal.map(|condition| {
                    // Without its needs a policy is judged as if everything were proven.
                    let is_trusted = !self.with_needs || self.fault == Some(SeededFault::ProvesTooMuch);
                    let is_proven = is_trusted || self.session.proves_goals(parsed);
                    Goal { condition: condition.clone(), is_proven }
                });
                Checked::Accepted(Box::new(Graphs { first: graph, later: None, goal }))
            }
            _ if !codes.is_empty() && codes.iter().all(|code| REFUTED.contains(code)) => {
                Checked::Refuted(codes)
            }
            _ => Checked::Other(codes),
        }
    }

    /// Runs a policy in a world of a seed.
    #[must_use]
    pub(super) fn run(&self, graphs: &Graphs, seed: u64, needs: Needs) -> Vec<Finding> {
        let way = match needs {
            Needs::Compiled => Way::of(seed),
            Needs::Dropped => Way::Direct,
        };
        self.played(graphs, seed, (needs, way), None).map_or_else(Vec::new, |run| run.findings)
    }

    /// Runs a policy, and returns what happened, line by line.
    #[must_use]
    pub(super) fn trace(&self, graphs: &Graphs, seed: u64) -> Vec<String> {
        self.trace_on(graphs, seed, Way::of(seed))
    }

    /// The same on a way to the world.
    pub(super) fn trace_on(&self, graphs: &Graphs, seed: u64, way: Way) -> Vec<String> {
        let run = self.played(graphs, seed, (Needs::Compiled, way), Some(Vec::new()));
        run.and_then(|run| run.log).unwrap_or_default()
    }

    /// A run to its end.
    fn played(
        &self,
        graphs: &Graphs,
        seed: u64,
        (needs, way): (Needs, Way),
        mut log: Option<Vec<String>>,
    ) -> Option<Run<'_>> {
        let mut world = self.world(seed);
        let mood = world.mood();
        if let Some(log) = &mut log {
            world.changes = Some(Vec::new());
            log.push(format!("{mood:?} world"));
        }
        let engine = Engine::new(graphs.first.clone(), &StartState::default()).ok()?;
        let engine = engine.with_capabilities(world.capabilities());
        // A quarter of the runs is seen to its end.
        let after = (seed / 4) % 16;
        let later = graphs.later.clone().map(|later| (after, later)).filter(|(after, _)| *after < 12);
        let world = Shared::new(world);
        let mut run = Run {
            engine,
            world: world.clone(),
            mood,
            needs,
            later,
            goal: graphs.goal.clone(),
            has_swapped: false,
            is_judged: false,
            testing: Vec::new(),
            findings: Vec::new(),
            bindings: Vec::new(),
            log,
        };
        match way {
            Way::Direct => run.whole(&mut world.clone()),
            Way::Protocol => {
                let spoken = speak(&world, &graphs.first, |driver| run.whole(driver));
                let notes = spoken.map_or_else(|why| vec![why], |((), notes)| notes);
                notes.into_iter().for_each(|note| run.note(Mistake::Protocol, note));
            }
        }
        Some(run)
    }

    /// A world of a seed, which also decides its mood.
    fn world(&self, seed: u64) -> World<'_> {
        let mood = match seed % 4 {
            0 => Mood::Honest,
            1 | 2 => Mood::Adversarial,
            _ => Mood::Veiled,
        };
        World::new(self.domain, mood, SplitMix64::seed_from_u64(seed))
    }
}

/// Way from the engine to the world.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Way {
    Direct,
    /// Over the driver protocol.
    Protocol,
}

impl Way {
    /// One run in eight speaks with its world over the driver protocol, in each of its moods.
    const fn of(seed: u64) -> Self {
        if seed % 8 == (seed / 8) % 8 { Self::Protocol } else { Self::Direct }
    }
}

/// Needs that a run is judged by.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Needs {
    /// Those of the graph, with their verdicts.
    Compiled,
    /// Those of the domain, which the graph lacks: all count as proven.
    Dropped,
}

struct Run<'d> {
    engine: Engine,
    world: Shared<'d>,
    mood: Mood,
    needs: Needs,
    /// The number of events after which another policy takes over, and its graph.
    later: Option<(u64, Graph)>,
    goal: Option<Goal>,
    has_swapped: bool,
    /// True once the goal was observed.
    is_judged: bool,
    /// Tests that have begun and have not come out.
    testing: Vec<NodeId>,
    findings: Vec<Finding>,
    /// Values of the names, by what the run has reported so far.
    bindings: Vec<Option<Value>>,
    /// What happens, line by line, if it is to be shown.
    log: Option<Vec<String>>,
}

impl Run<'_> {
    /// Runs to the end.
    fn whole(&mut self, driver: &mut dyn Driver) {
        let (mut now, mut event, mut effects) = (Time::ZERO, Event::Begin, Vec::new());
        for number in 0..MAX_EVENTS as u64 {
            self.log(now, || format!("< {event:?}"));
            self.engine.handle(now, event, &mut effects);
            if self.carry_out(driver, now, &mut effects) {
                return;
            }
            if let Some((_, graph)) = self.later.take_if(|(after, _)| *after == number) {
                self.take_over(now, graph, &mut effects);
                if self.carry_out(driver, now, &mut effects) {
                    return;
                }
            }
            let wake = self.engine.wake_at().unwrap_or(Time::NEVER);
            let until = wake.min(now.after(Time::from_secs(MAX_SILENCE_SECS)));
            (now, event) = match driver.advance(until) {
                Some((at, report)) => {
                    self.world.world().heard(&report);
                    (at.max(now), Event::Driver(report))
                }
                None if until < wake => {
                    self.note(Mistake::Endless, "nothing is left to wait for".to_owned());
                    return;
                }
                None => (wake, Event::Tick),
            };
        }
        self.note(Mistake::Endless, format!("more than {MAX_EVENTS} events"));
    }

    /// Carries out what the engine asks for; returns true at the end of the run.
    fn carry_out(&mut self, driver: &mut dyn Driver, now: Time, effects: &mut Vec<Effect>) -> bool {
        for effect in std::mem::take(effects) {
            match &effect {
                Effect::Report(trace) => self.log(now, || format!("    {:?}", trace.what)),
                effect => self.log(now, || format!("> {effect:?}")),
            }
            match &effect {
                Effect::Finished(end) => {
                    match **end {
                        RunEnd::Fault(_) => self.note(Mistake::Endless, format!("{end}")),
                        RunEnd::Done { .. } if !self.is_judged => self.judge_goal(None),
                        _ => {}
                    }
                    return true;
                }
                Effect::Start { node, command, .. } => self.started(*node, command),
                Effect::Report(trace) => {
                    self.tests(&trace.what);
                    self.reported(&trace.what);
                }
                _ => {}
            }
            driver.carry_out(now, &effect);
        }
        false
    }

    /// Another policy takes over, unless the engine refuses it.
    fn take_over(&mut self, now: Time, graph: Graph, effects: &mut Vec<Effect>) {
        let swapped = PreparedSwap::new(graph, &self.engine.running())
            .and_then(|prepared| self.engine.swap(now, prepared, effects).map(drop));
        self.log(now, || format!("< swap: {swapped:?}"));
        if swapped.is_ok() {
            self.has_swapped = true;
            self.testing.clear();
            self.bindings.clear();
        }
    }

    /// Logs a line, if the run is to be shown.
    fn log(&mut self, now: Time, line: impl FnOnce() -> String) {
        if let Some(log) = &mut self.log {
            for (at, fact) in self.world.world().changes.iter_mut().flat_map(|changes| changes.drain(..)) {
                log.push(format!("{:.2}   {fact}", at.secs()));
            }
            log.push(format!("{:.2} {}", now.secs(), line()));
        }
    }

    fn note(&mut self, mistake: Mistake, place: String) {
        self.findings.push(Finding { mistake, place });
    }

    /// Verdicts on the needs of a call.
    fn verdicts(&self, node: NodeId) -> Vec<Verdict> {
        match self.engine.graph().nodes.get(node.index()).map(|node| &node.kind) {
            Some(NodeKind::Call(call)) => call.needs.iter().map(|need| need.verdict).collect(),
            _ => Vec::new(),
        }
    }

    /// The policy is done, and its goal was observed, if it can be: does it hold?
    fn judge_goal(&mut self, observed: Option<Truth>) {
        self.is_judged = true;
        let Some(Goal { condition, is_proven }) = self.goal.clone().filter(|_| !self.has_swapped) else {
            return;
        };
        let (world, frame) = (self.world.world(), Frame::default());
        let holds = world.domain().holds(&condition, &frame, &world.state);
        let need = Need { condition, each: None, when: None };
        let is_moving = world.is_moving(&world.domain().asked(&need, &frame));
        drop(world);
        let mistake = match observed {
            _ if is_proven && !holds => Mistake::Goal,
            Some(Truth::True) if !holds && !is_moving => Mistake::Reached,
            Some(Truth::False) if holds && !is_moving => Mistake::Missed,
            Some(Truth::Unknown) if self.mood == Mood::Honest => Mistake::Unsure,
            _ => return,
        };
        self.note(mistake, "the goal".to_owned());
    }

    /// A step begins: do its needs hold?
    fn started(&mut self, node: NodeId, command: &Command) {
        let Some((action, frame)) = self.world.world().called(command) else { return };
        let verdicts = self.verdicts(node);
        for (index, need) in action.needs.iter().enumerate() {
            let world = self.world.world();
            // A quantified need is about those of which somebody has heard.
            if world.meets(need, &frame) {
                continue;
            }
            let is_moving = world.is_moving(&world.domain().asked(need, &frame));
            drop(world);
            let mistake = match verdicts.get(index) {
                // Nor can a policy that has taken over know what the steps before it are about to change.
                Some(Verdict::Proven) if self.has_swapped && is_moving => continue,
                Some(Verdict::Proven) => Mistake::Proven,
                None if self.needs == Needs::Dropped => Mistake::Proven,
                // What another branch changes meanwhile, a look just before cannot know.
                _ if is_moving => continue,
                _ => Mistake::Passed,
            };
            self.note(mistake, format!("need {} of `{command}`", index + 1));
        }
    }

    /// Follows which tests look at the world. In parallel branches a question may be that of a guard.
    fn tests(&mut self, what: &TraceEventKind) {
        let nodes = &self.engine.graph().nodes;
        let kind = |node: &NodeId| nodes.get(node.index()).map(|node| &node.kind);
        match what {
            TraceEventKind::Entered { node } if matches!(kind(node), Some(NodeKind::If { .. })) => {
                self.testing.push(*node);
            }
            TraceEventKind::Tested { node, .. } | TraceEventKind::Ended { node, .. } => {
                self.testing.retain(|other| other != node);
            }
            _ => {}
        }
        let is_parallel = || nodes.iter().any(|node| matches!(node.kind, NodeKind::Parallel { .. }));
        self.world.world().is_tested = !self.testing.is_empty() && !is_parallel();
    }

    /// A guard refuses: is it right?
    fn reported(&mut self, what: &TraceEventKind) {
        if let TraceEventKind::Bound { binding, value } = what {
            self.bindings.resize(self.bindings.len().max(binding.index() + 1), None);
            self.bindings
                .get_mut(binding.index())
                .into_iter()
                .for_each(|slot| *slot = Some((**value).clone()));
        }
        if let TraceEventKind::GoalObserved { truth } = what {
            self.judge_goal(Some(*truth));
        }
        if matches!(what, TraceEventKind::Fired { .. }) {
            // A reaction goes by what has set it off.
            self.world.world().calm();
        }
        let TraceEventKind::Guard { node, need, truth } = what else { return };
        if self.mood != Mood::Honest || *truth == Truth::True {
            return;
        }
        let Some(NodeKind::Call(call)) = self.engine.graph().nodes.get(node.index()).map(|node| &node.kind)
        else {
            return;
        };
        let (graph, index) = (self.engine.graph(), *need as usize);
        let primitive = graph.primitives.get(call.primitive.index());
        let Some(action) = primitive.and_then(|primitive| self.world.world().action(&primitive.name)) else {
            return;
        };
        let args = call.args.iter().filter_map(|arg| match arg {
            motet_graph::Term::Literal(value) => Some(value.clone()),
            motet_graph::Term::Binding(binding) => self.bindings.get(binding.index()).cloned().flatten(),
            _ => None,
        });
        let frame = self.world.world().frame(args);
        if frame.params.len() < action.params.len() {
            // A name that the policy before it has bound.
            return;
        }
        let Some(need) = action.needs.get(index) else { return };
        let world = self.world.world();
        if world.is_moving(&world.domain().asked(need, &frame)) {
            return;
        }
        let holds = world.meets(need, &frame);
        let has_undeclared = !world.domain().undeclared().is_empty();
        drop(world);
        let place = || format!("need {} of a call", index + 1);
        if *truth == Truth::Unknown {
            // Nobody can observe of which kind an entity is that the domain does not declare.
            if need.each.is_some() && has_undeclared {
                return;
            }
            self.note(Mistake::Unseen, place());
        } else if holds {
            self.note(Mistake::Refused, place());
        }
    }
}
