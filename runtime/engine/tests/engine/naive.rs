//! The engine beside a naive interpreter: plain recursion over the tree, which writes down what it believes
//! as a list and reads it from its end. Policies with a single thread of control, also across a swap in the
//! middle of an action; what runs at once (monitors, waits, parallel branches) is made one after the other
//! before: `rescan.rs` has that.

use motet_arbitrary::graph::{CallSketch, StepSketch, graph, steps, vocabulary as v, with_named_failures};
use motet_graph::{
    Arithmetic, BindingId, CallNode, Comparison, Condition, Ending, Fact, FactArg, FailureSentence, Graph,
    NodeId, NodeKind, ROOT, RegionId, Term, TextPart, Value, Verdict, spoken,
};
use motet_runtime::{
    Answer, Command, DriverEvent, Effect, Engine, Event, FailureReport, GoalId, Outcome, Pattern,
    PreparedSwap, Query, RunEnd, StartState, Time, TraceEventKind, Truth,
};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use smol_str::SmolStr;
use std::cell::Cell;
use std::collections::BTreeMap;

use crate::python::{mix, seen};

/// The same steps one after the other.
fn single(steps: &[StepSketch]) -> Vec<StepSketch> {
    steps
        .iter()
        .map(|step| match step {
            StepSketch::Call(call) => {
                let verdict = if call.retries > 0 { Verdict::Proven } else { call.verdict };
                StepSketch::Call(CallSketch { deadline_secs: 10.0, verdict, ..call.clone() })
            }
            StepSketch::Sequence(steps) | StepSketch::Monitor(_, steps) => {
                StepSketch::Sequence(single(steps))
            }
            StepSketch::Inline(steps) => StepSketch::Inline(single(steps)),
            StepSketch::If(condition, then, other) => {
                StepSketch::If(condition.clone(), single(then), other.as_ref().map(|steps| single(steps)))
            }
            StepSketch::Wait(condition, _) => StepSketch::If(condition.clone(), Vec::new(), None),
            StepSketch::Delay(_) => StepSketch::Sequence(Vec::new()),
            StepSketch::Finally(body, cleanup) => StepSketch::Finally(single(body), single(cleanup)),
            StepSketch::Try(body, handlers) => {
                let handlers = handlers.iter().map(|(on, steps)| (on.clone(), single(steps)));
                StepSketch::Try(single(body), handlers.collect())
            }
            StepSketch::Repeat(times, steps, until) => {
                StepSketch::Repeat(*times, single(steps), until.clone())
            }
            StepSketch::Each(list, most, steps) => StepSketch::Each(list.clone(), *most, single(steps)),
            StepSketch::Parallel(branches) => StepSketch::Sequence(single(&branches.concat())),
            StepSketch::Let(value) => StepSketch::Let(value.clone()),
            StepSketch::End(how) => StepSketch::End(*how),
        })
        .collect()
}

/// Each call asks for its needs, and begins once: what a goal of the policy before may still change is asked.
fn ask_all(graph: &mut Graph) {
    for call in calls(graph) {
        call.retries = 0;
        call.needs.iter_mut().for_each(|need| need.verdict = Verdict::Deferred);
    }
}

/// No call changes a fact, so that nothing that ends later unsettles what the next policy has proven.
fn change_nothing(graph: &mut Graph) {
    for call in calls(graph) {
        call.effects.clear();
        call.unsettles.clear();
    }
}

fn calls(graph: &mut Graph) -> impl Iterator<Item = &mut CallNode> {
    graph.nodes.iter_mut().filter_map(|node| match &mut node.kind {
        NodeKind::Call(call) => Some(call),
        _ => None,
    })
}

/// A graph whose conditions speak of single facts only, proved from nothing where it takes over.
fn ground(steps: &[StepSketch]) -> Graph {
    fn condition(of: &mut Condition) {
        match of {
            Condition::Literal(_) | Condition::Compare(..) => {}
            Condition::Fact(fact) => {
                for arg in &mut fact.args {
                    if *arg == FactArg::Any {
                        *arg = FactArg::Term(Term::Literal(Value::Entity("mug".into())));
                    }
                }
            }
            Condition::Not(inner) => condition(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => parts.iter_mut().for_each(condition),
        }
    }
    let mut graph = with_named_failures(graph(&single(steps)));
    for node in &mut graph.nodes {
        match &mut node.kind {
            NodeKind::Call(call) => call.needs.iter_mut().for_each(|need| condition(&mut need.condition)),
            NodeKind::If { condition: of, .. } | NodeKind::Repeat { until: Some(of), .. } => condition(of),
            _ => {}
        }
    }
    graph
}

/// How the goal of a number ends.
fn fate(seed: u64, number: usize, command: &Command) -> Outcome {
    let dice = mix(seed, &format!("goal {number}"));
    let object = |number: u64| Value::Entity(["mug", "cup", "bowl"][(number % 3) as usize].into());
    let value = match command.primitive.as_str() {
        "detect" => Some(object(dice)),
        "detect_all" => Some(Value::List((0..dice % 4).map(object).collect())),
        _ => None,
    };
    match dice / 8 % 12 {
        0 => Outcome::Interrupted,
        1..4 => Outcome::Failure(FailureReport {
            kind: ["timeout", "unreachable", "not_found"][(dice % 3) as usize].into(),
            text: dice.is_multiple_of(2).then(|| format!("because of {number}").into()),
        }),
        _ => Outcome::Success(value),
    }
}

/// How a goal ends that the swap cancels.
fn fate_of_cancelled(seed: u64, number: usize, command: &Command) -> Outcome {
    match fate(seed, number, command) {
        Outcome::Success(value) if seed.is_multiple_of(3) => Outcome::Success(value),
        _ => Outcome::Interrupted,
    }
}

/// How a region or a step ended.
enum Flow {
    Ok,
    /// Its kind, where it arose, and what the driver said of it.
    Fail(String, NodeId, Option<SmolStr>),
    Interrupted,
    /// `done` or `fail` of a sub-policy, with the step that says so.
    Leave(NodeId, Ending, NodeId),
    End(RunEnd),
    /// The policy is replaced.
    Swapped,
}

/// A goal whose policy was replaced.
#[derive(Clone)]
struct Orphan {
    command: Command,
    number: usize,
    call: CallNode,
    graph: Graph,
    bindings: BTreeMap<BindingId, Value>,
}

struct Naive {
    seed: u64,
    graph: Graph,
    bindings: BTreeMap<BindingId, Value>,
    /// What was written of facts, the latest last.
    facts: Vec<(String, Vec<Pattern>, Truth)>,
    readings: BTreeMap<String, Answer>,
    started: usize,
    log: Vec<String>,
    swap_at: Option<usize>,
    orphan: Option<Orphan>,
    /// Whether the goal of the replaced policy may still go on.
    is_free: bool,
}

impl Naive {
    fn region(&mut self, region: RegionId) -> Flow {
        let mut at = self.graph.regions[region.index()].entry;
        while let Some(id) = at {
            match self.node(id) {
                Flow::Ok => at = self.graph.nodes[id.index()].next,
                flow => return flow,
            }
        }
        Flow::Ok
    }

    fn node(&mut self, id: NodeId) -> Flow {
        match self.graph.nodes[id.index()].kind.clone() {
            NodeKind::Call(call) => self.call(id, &call),
            NodeKind::Sequence { body, .. } => self.region(body),
            NodeKind::Inline { body, .. } => match self.region(body) {
                Flow::Leave(of, Ending::Fail, end) if of == id => Flow::Fail("failed".into(), end, None),
                Flow::Leave(of, ..) if of == id => Flow::Ok,
                flow => flow,
            },
            NodeKind::If { condition, then, otherwise } => {
                if self.test(&condition) {
                    self.region(then)
                } else {
                    otherwise.map_or(Flow::Ok, |otherwise| self.region(otherwise))
                }
            }
            NodeKind::Try { body, handlers } => match self.region(body) {
                Flow::Fail(kind, origin, text) => {
                    let named = |id: &motet_graph::FailureId| self.graph.failures[id.index()] == kind;
                    let fits = handlers
                        .iter()
                        .find(|handler| handler.on.as_ref().is_none_or(|on| on.iter().any(named)));
                    let Some(handler) = fits else { return Flow::Fail(kind, origin, text) };
                    let caught = handler.binds.expect("every handler names its failure");
                    let told = text.unwrap_or_else(|| self.sentence(&kind));
                    self.bindings.insert(caught.kind, Value::Case(kind.into()));
                    self.bindings.insert(caught.text, Value::Text(told));
                    self.region(handler.body)
                }
                flow => flow,
            },
            NodeKind::Finally { body, cleanup } => {
                let flow = self.region(body);
                if matches!(flow, Flow::Interrupted | Flow::Swapped) {
                    return flow;
                }
                match (self.region(cleanup), flow) {
                    (Flow::Swapped, _) => Flow::Swapped,
                    (Flow::Interrupted, Flow::Ok | Flow::Fail(..)) => Flow::Interrupted,
                    (_, flow) => flow,
                }
            }
            NodeKind::Repeat { times, body, until } => {
                for _ in 0..times {
                    match self.region(body) {
                        Flow::Ok => {}
                        flow => return flow,
                    }
                    if until.as_ref().is_some_and(|until| self.test(until)) {
                        return Flow::Ok;
                    }
                }
                if until.is_some() { Flow::Fail("exhausted".into(), id, None) } else { Flow::Ok }
            }
            NodeKind::Each { item, list, at_most, body } => {
                let Some(Value::List(items)) = self.term(&list, &mut Vec::new()) else { panic!("no list") };
                if items.len() > at_most as usize {
                    return Flow::Fail("exhausted".into(), id, None);
                }
                for value in items {
                    self.bindings.insert(item, value);
                    match self.region(body) {
                        Flow::Ok => {}
                        flow => return flow,
                    }
                }
                Flow::Ok
            }
            NodeKind::Let { binding, value } => {
                let value = self.term(&value, &mut Vec::new()).unwrap();
                self.bindings.insert(binding, value);
                Flow::Ok
            }
            NodeKind::End { how, of: Some(of), .. } => Flow::Leave(of, how, id),
            NodeKind::End { how: Ending::Done, .. } => Flow::End(RunEnd::Done { why: None, result: None }),
            NodeKind::End { how: Ending::Cannot, .. } => Flow::End(RunEnd::Declined { why: None }),
            NodeKind::End { how: Ending::Replan, .. } => Flow::End(RunEnd::Replan { why: None }),
            NodeKind::End { how: Ending::Fail, .. } => {
                Flow::End(RunEnd::Failed { kind: "failed".into(), why: None, node: id })
            }
            NodeKind::Wait { .. } | NodeKind::Delay { .. } | NodeKind::Monitor { .. } => panic!("not single"),
            NodeKind::Parallel { .. } => panic!("not single"),
        }
    }

    fn call(&mut self, id: NodeId, call: &CallNode) -> Flow {
        let primitive = self.graph.primitives[call.primitive.index()].clone();
        let mut last = Flow::Ok;
        for _ in 0..=call.retries {
            let values = call.args.iter().map(|arg| self.term(arg, &mut Vec::new()).unwrap());
            let names = primitive.params.iter().map(|param| param.name.clone());
            let command = Command {
                primitive: primitive.name.clone(),
                args: names.zip(values).collect(),
                uses: primitive.uses.iter().map(|id| self.graph.resources[id.index()].name.clone()).collect(),
                manner: call.manner,
                deadline_secs: call.deadline_secs,
                motions: Vec::new(),
                leaves: None,
            };
            let goes_on = |orphan: &Orphan| {
                orphan.command.args == command.args
                    && orphan.command.primitive == command.primitive
                    && orphan.command.manner == command.manner
            };
            let number = if self.is_free && self.orphan.as_ref().is_some_and(goes_on) {
                self.log.push(format!("kept {command}"));
                self.orphan.take().unwrap().number
            } else {
                let blocks = |orphan: &Orphan| conflict(&orphan.command, &command);
                if self.orphan.as_ref().is_some_and(blocks) {
                    self.end_orphan();
                }
                if let Some(kind) = self.refuted(call) {
                    last = Flow::Fail(kind, id, None);
                    continue;
                }
                self.write_unsettled(call);
                self.log.push(format!("start {command}"));
                self.started += 1;
                self.started
            };
            self.is_free = false;
            if self.swap_at == Some(number) {
                let (graph, bindings) = (self.graph.clone(), self.bindings.clone());
                self.orphan = Some(Orphan { command, number, call: call.clone(), graph, bindings });
                return Flow::Swapped;
            }
            self.end_orphan();
            match fate(self.seed, number, &command) {
                Outcome::Success(value) => {
                    if let (Some(binding), Some(value)) = (call.binds, value) {
                        self.bindings.insert(binding, value);
                    }
                    self.write_made(call);
                    return Flow::Ok;
                }
                Outcome::Failure(FailureReport { kind, text }) => {
                    self.doubt(call);
                    last = Flow::Fail(kind.into(), id, text);
                }
                Outcome::Interrupted => {
                    self.doubt(call);
                    return Flow::Interrupted;
                }
            }
        }
        last
    }

    /// Sentence for a failure of which the driver said nothing.
    fn sentence(&self, kind: &str) -> SmolStr {
        let is_it = |of: &&FailureSentence| self.graph.failures[of.failure.index()] == kind;
        let known = self.graph.sentences.iter().find(is_it);
        known.map_or_else(|| kind.replace('_', " ").into(), |known| known.text.clone())
    }

    /// The end of a policy that is done: what can be observed of its goal is observed.
    fn done(&mut self) -> RunEnd {
        self.facts.retain(|(fluent, ..)| fluent == "trusted");
        self.readings.clear();
        let (goal, mut missing) = (self.graph.goal.clone(), Vec::new());
        goal.iter().for_each(|part| _ = self.condition(part, &mut missing));
        self.look(&missing);
        if goal.iter().any(|part| self.condition(part, &mut Vec::new()) == Truth::False) {
            return RunEnd::Failed { kind: "failed".into(), why: Some(String::new()), node: NodeId(0) };
        }
        RunEnd::Done { why: None, result: None }
    }

    /// The failure of the first guard that does not hold.
    fn refuted(&mut self, call: &CallNode) -> Option<String> {
        let deferred: Vec<_> = call.needs.iter().filter(|need| need.verdict == Verdict::Deferred).collect();
        let mut missing = Vec::new();
        let mut refusal = None;
        for look in 0..2 {
            refusal = None;
            for need in &deferred {
                let truth = self.condition(&need.condition, &mut missing);
                if truth == Truth::False {
                    return Some(self.graph.failures[need.failure.index()].to_string());
                }
                if truth == Truth::Unknown && refusal.is_none() {
                    refusal = Some(self.graph.failures[need.failure.index()].to_string());
                }
            }
            if refusal.is_none() || missing.is_empty() {
                break;
            }
            if look == 0 {
                self.look(&missing);
            }
        }
        refusal
    }

    fn test(&mut self, condition: &Condition) -> bool {
        let mut missing = Vec::new();
        let mut truth = self.condition(condition, &mut missing);
        if truth == Truth::Unknown && !missing.is_empty() {
            self.look(&missing);
            truth = self.condition(condition, &mut Vec::new());
        }
        truth == Truth::True
    }

    /// Observes. After that the goal of a replaced policy has been cancelled.
    fn look(&mut self, missing: &[Query]) {
        self.is_free = false;
        for query in missing {
            let answer = seen(self.seed, query);
            match (query, &answer) {
                (Query::Fact { fluent, args }, answer) => {
                    let truth =
                        if let Answer::Truth(truth) = answer { Truth::from(*truth) } else { Truth::Unknown };
                    self.facts.push((fluent.to_string(), args.clone(), truth));
                }
                (query, answer) => {
                    self.readings.insert(query.to_string(), answer.clone());
                }
            }
        }
    }

    fn end_orphan(&mut self) {
        let Some(orphan) = self.orphan.take() else { return };
        let own = (
            std::mem::replace(&mut self.graph, orphan.graph),
            std::mem::replace(&mut self.bindings, orphan.bindings),
        );
        match fate_of_cancelled(self.seed, orphan.number, &orphan.command) {
            Outcome::Success(_) => self.write_made(&orphan.call),
            Outcome::Failure(_) | Outcome::Interrupted => self.doubt(&orphan.call),
        }
        (self.graph, self.bindings) = own;
    }

    fn write(&mut self, fact: &Fact, truth: Truth) {
        let args = fact.args.iter().map(|arg| match arg {
            FactArg::Any => Some(Pattern::Any),
            FactArg::Term(term) => self.term(term, &mut Vec::new()).map(Pattern::Is),
        });
        if let Some(args) = args.collect() {
            self.facts.push((self.graph.fluents[fact.fluent.index()].name.to_string(), args, truth));
        }
    }

    fn write_made(&mut self, call: &CallNode) {
        for value in [false, true] {
            for effect in call.effects.iter().filter(|effect| effect.value == value) {
                self.write(&effect.fact, Truth::from(value));
            }
        }
    }

    fn write_unsettled(&mut self, call: &CallNode) {
        call.unsettles.iter().for_each(|unsettled| self.write(&unsettled.fact, Truth::Unknown));
    }

    fn doubt(&mut self, call: &CallNode) {
        call.effects.iter().for_each(|effect| self.write(&effect.fact, Truth::Unknown));
        self.write_unsettled(call);
    }

    fn condition(&self, condition: &Condition, missing: &mut Vec<Query>) -> Truth {
        match condition {
            Condition::Literal(value) => Truth::from(*value),
            Condition::Not(inner) => self.condition(inner, missing).negated(),
            Condition::All(parts) => parts.iter().fold(Truth::True, |truth, part| match truth {
                Truth::False => truth,
                truth => truth.and(self.condition(part, missing)),
            }),
            Condition::AnyOf(parts) => parts.iter().fold(Truth::False, |truth, part| match truth {
                Truth::True => truth,
                truth => truth.or(self.condition(part, missing)),
            }),
            Condition::Fact(fact) => {
                let name = &self.graph.fluents[fact.fluent.index()];
                let args: Option<Vec<Pattern>> = fact
                    .args
                    .iter()
                    .map(|arg| match arg {
                        FactArg::Any => panic!("not ground"),
                        FactArg::Term(term) => self.term(term, missing).map(Pattern::Is),
                    })
                    .collect();
                let Some(args) = args else { return Truth::Unknown };
                let covers = |wide: &[Pattern]| {
                    wide.iter().zip(&args).all(|(wide, arg)| *wide == Pattern::Any || wide == arg)
                };
                let written = self
                    .facts
                    .iter()
                    .rev()
                    .find(|(fluent, wide, _)| *fluent == name.name.as_str() && covers(wide));
                let truth = written.map_or(Truth::Unknown, |(.., truth)| *truth);
                if truth == Truth::Unknown && name.observable {
                    missing.push(Query::Fact { fluent: name.name.clone(), args });
                }
                truth
            }
            Condition::Compare(comparison, left, right) => {
                let (left, right) = (self.term(left, missing), self.term(right, missing));
                let (Some(left), Some(right)) = (left, right) else { return Truth::Unknown };
                match (comparison, left, right) {
                    (Comparison::Equal, left, right) => Truth::from(left == right),
                    (Comparison::Less, Value::Number(left), Value::Number(right)) => {
                        Truth::from(left < right)
                    }
                    (Comparison::More, Value::Number(left), Value::Number(right)) => {
                        Truth::from(left > right)
                    }
                    other => panic!("not sketched: {other:?}"),
                }
            }
        }
    }

    fn term(&self, term: &Term, missing: &mut Vec<Query>) -> Option<Value> {
        let query = match term {
            Term::Literal(value) => return Some(value.clone()),
            Term::Binding(id) => return self.bindings.get(id).cloned(),
            Term::List(items) => {
                return items
                    .iter()
                    .map(|item| self.term(item, missing))
                    .collect::<Option<_>>()
                    .map(Value::List);
            }
            Term::Count(list) => {
                let Some(Value::List(items)) = self.term(list, missing) else { return None };
                return Some(Value::Int(items.len() as i64));
            }
            Term::First(list) => {
                let Some(Value::List(items)) = self.term(list, missing) else { return None };
                return items.first().cloned();
            }
            Term::Template(parts) => {
                let parts = parts.iter().map(|part| match part {
                    TextPart::Literal(text) => Some(text.to_string()),
                    TextPart::Value(value, ty) => {
                        self.term(value, missing).map(|value| spoken(&self.graph, &value, ty))
                    }
                });
                return parts.collect::<Option<String>>().map(|text| Value::Text(text.into()));
            }
            Term::Field(of, field) => {
                let Some(Value::Entity(entity)) = self.term(of, missing) else { return None };
                Query::Field { entity, field: field.clone() }
            }
            Term::Measure(id, args) => {
                let args = args.iter().map(|arg| self.term(arg, missing)).collect::<Option<_>>()?;
                Query::Measure { measure: self.graph.measures[id.index()].name.clone(), args }
            }
            Term::Each
            | Term::Arith(
                Arithmetic::Add | Arithmetic::Subtract | Arithmetic::Multiply | Arithmetic::Divide,
                ..,
            ) => {
                panic!("not sketched")
            }
        };
        match self.readings.get(&query.to_string()) {
            Some(Answer::Value(value)) => Some(value.clone()),
            _ => {
                missing.push(query);
                None
            }
        }
    }
}

fn conflict(a: &Command, b: &Command) -> bool {
    let nested = |x: &str, y: &str| x == y || (x, y) == ("arm", "camera") || (y, x) == ("arm", "camera");
    a.uses.iter().any(|a| b.uses.iter().any(|b| nested(a, b)))
}

/// An end without the step and the part of the goal that was seen first to be false.
fn without_node(end: RunEnd) -> RunEnd {
    match end {
        RunEnd::Failed { kind, why: Some(why), .. } => {
            assert!(why.starts_with("the goal does not hold: `"), "{why}");
            RunEnd::Failed { kind, why: Some(String::new()), node: NodeId(0) }
        }
        end => end,
    }
}

/// Parts of a goal, by the bits of a number.
fn goal(bits: u64) -> Vec<Condition> {
    let holding = |object: &str| Condition::Fact(v::fact(v::HOLDING, vec![v::entity(object)]));
    let at = |place: &str| Condition::Fact(v::fact(v::AT, vec![v::entity("robot"), v::entity(place)]));
    let trusted = Condition::Fact(v::fact(v::TRUSTED, vec![v::entity("mug")]));
    let all = [
        holding("mug"),
        Condition::Not(Box::new(holding("cup"))),
        Condition::AnyOf(vec![at("table"), at("shelf")]),
        Condition::All(vec![at("user"), v::nearer("user", 0.5)]),
        Condition::AnyOf(vec![trusted, holding("cup")]),
    ];
    all.into_iter()
        .enumerate()
        .filter(|(index, _)| bits >> (2 * index) & 3 == 3)
        .map(|(_, part)| part)
        .collect()
}

/// What starts and goes on, and how it ends, as the naive interpreter has it.
fn expected(seed: u64, first: &Graph, second: &Graph, swap_at: Option<usize>) -> (Vec<String>, RunEnd) {
    let mut naive = Naive {
        seed,
        graph: first.clone(),
        bindings: BTreeMap::new(),
        facts: vec![("holding".into(), vec![Pattern::Any], Truth::False)],
        readings: BTreeMap::new(),
        started: 0,
        log: Vec::new(),
        swap_at,
        orphan: None,
        is_free: false,
    };
    let mut flow = naive.region(ROOT);
    if matches!(flow, Flow::Swapped) {
        naive.graph = second.clone();
        naive.bindings.clear();
        naive.swap_at = None;
        naive.is_free = true;
        naive.log.push("swap".into());
        flow = naive.region(ROOT);
    }
    let end = match flow {
        Flow::Ok => naive.done(),
        Flow::End(RunEnd::Done { .. }) => naive.done(),
        Flow::Fail(kind, node, _) => RunEnd::Failed { kind: kind.into(), why: None, node },
        Flow::Interrupted => RunEnd::Interrupted,
        Flow::End(end) => end,
        Flow::Leave(..) | Flow::Swapped => panic!("nothing takes it"),
    };
    (naive.log, end)
}

/// The same of the engine, with a driver that answers first, then ends what was cancelled, then the rest.
fn observed(seed: u64, first: &Graph, second: &Graph, swap_at: Option<usize>) -> (Vec<String>, RunEnd) {
    let mut engine = Engine::new(first.clone(), &StartState::default()).unwrap();
    let mut live: BTreeMap<GoalId, (usize, Command, bool)> = BTreeMap::new();
    let (mut asked, mut log, mut out, mut started) = (Vec::new(), Vec::new(), Vec::new(), 0);
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    loop {
        let mut swap = false;
        for effect in out.drain(..) {
            match effect {
                Effect::Start { goal, command, .. } => {
                    started += 1;
                    log.push(format!("start {command}"));
                    live.insert(goal, (started, (*command).clone(), false));
                    swap |= swap_at == Some(started);
                }
                Effect::Cancel { goal } => live.get_mut(&goal).unwrap().2 = true,
                Effect::Observe { query } => asked.push((*query).clone()),
                Effect::Report(record) => {
                    if let TraceEventKind::Kept { goal, .. } = record.what {
                        log.push(format!("kept {}", live[&goal].1));
                    }
                }
                Effect::Finished(end) => return (log, without_node(*end)),
                other => panic!("not expected: {other:?}"),
            }
        }
        if swap {
            let goal = *live.keys().next().unwrap();
            engine.handle(Time::ZERO, Event::Driver(DriverEvent::Acknowledged { goal }), &mut out);
            let prepared = PreparedSwap::new(second.clone(), &engine.running()).unwrap();
            log.push("swap".into());
            engine.swap(Time::ZERO, prepared, &mut out).unwrap();
            continue;
        }
        let event = if asked.is_empty() {
            let cancelled = live.iter().find(|(_, (.., cancelled))| *cancelled).map(|(goal, _)| *goal);
            let goal = cancelled.unwrap_or_else(|| *live.keys().next().expect("nothing to wait for"));
            let (number, command, cancelled) = live.remove(&goal).unwrap();
            let fate = if cancelled { fate_of_cancelled } else { fate };
            DriverEvent::Ended { goal, outcome: fate(seed, number, &command) }
        } else {
            let query: Query = asked.remove(0);
            DriverEvent::Observed { answer: seen(seed, &query), query }
        };
        engine.handle(Time::ZERO, Event::Driver(event), &mut out);
    }
}

#[test]
fn engine_effects_are_those_of_a_naive_interpreter() {
    let cases = (prop::collection::vec(steps(), 1..3), steps(), any::<u64>(), any::<bool>());
    let config = ProptestConfig {
        cases: 1_000,
        max_shrink_iters: 5_000,
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let (swapped, kept) = (Cell::new(0_u32), Cell::new(0_u32));
    let result = TestRunner::new(config).run(&cases, |(own, other, seed, same)| {
        let own = own.concat();
        let mut first = ground(&own);
        let mut second = ground(&if same { own } else { other });
        (first.goal, second.goal) = (goal(seed), goal(seed >> 10));
        second.initial.clear();
        // A goal that both have is kept, and may change what it does in the second.
        if same || seed % 2 == 0 {
            ask_all(&mut second);
        } else {
            change_nothing(&mut first);
        }
        for round in 0..20_usize {
            let seed = seed.wrapping_add(round as u64);
            let swap_at = (round % 4 > 0).then_some(round % 4);
            let expected = expected(seed, &first, &second, swap_at);
            prop_assert_eq!(observed(seed, &first, &second, swap_at), expected.clone());
            swapped.set(swapped.get() + u32::from(expected.0.iter().any(|line| line == "swap")));
            kept.set(kept.get() + u32::from(expected.0.iter().any(|line| line.starts_with("kept"))));
        }
        Ok(())
    });
    result.unwrap_or_else(|failure| panic!("{failure}"));
    assert!(swapped.get() > 1_000 && kept.get() > 100, "{} swaps, {} goals kept", swapped.get(), kept.get());
}
