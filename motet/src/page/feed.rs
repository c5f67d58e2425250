//! Items of a run from the entries of its journal, whether it goes on or is long over.
//!
//! An engine is stepped along, for beliefs and bindings. The tree of the terminal's view gives labels, states
//! and remarks of the steps. Texts of models and drivers stay texts: the page shows them as such.

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_graph::{NodeId, Value as MotetValue};
use motet_runtime::journal::{EngineReplay, JournalEntry, StepEntry};
use motet_runtime::{
    Command, DriverEvent, Effect, EndCause, Event, GoalId, NodeEnding, OWN_MOTION, Outcome, RunEnd, Snapshot,
    Time, TraceEvent, TraceEventKind, Verification,
};
use motet_stdlib::lang::{failures, primitives};
use serde_json::{Map, Value, json};

use super::outline::outline;
use super::source::PolicyText;
use super::tree::{StepStatus, StepTree};
use super::world::PageWorld;
use crate::printable::escape;

/// Facts beyond which beliefs are not compared entry by entry.
const MOST_FACTS: usize = 5_000;

/// Feed of a page.
#[derive(Default)]
pub struct PageFeed {
    /// Number of runs so far; the one that runs has the last number.
    pub run: u32,
    replay: Option<EngineReplay>,
    /// Trees of the policies of this run, by revision.
    trees: Vec<StepTree>,
    beliefs: Beliefs,
    goals: BTreeMap<GoalId, Arc<Command>>,
    /// Robot and room, where they are known.
    pub world: Option<PageWorld>,
    /// Text of the policy that begins or takes over next.
    pub text: Option<PolicyText>,
}

/// Beliefs that the page has.
#[derive(Debug, Default)]
struct Beliefs {
    facts: BTreeMap<String, Option<bool>>,
    readings: BTreeMap<String, String>,
    bindings: BTreeMap<String, String>,
}

impl PageFeed {
    /// Feed before the first run.
    pub fn new(world: Option<PageWorld>) -> Self {
        Self { world, ..Self::default() }
    }

    /// Id of an item that follows from an entry.
    pub fn id(&self, seq: u64) -> String {
        format!("{}-{seq}", self.run)
    }

    /// Item that follows from an entry, with its id; `None` where the engine does not take the entry.
    pub fn entry(&mut self, seq: u64, entry: &JournalEntry) -> Option<(String, Value)> {
        let mut item = match entry {
            JournalEntry::Head(head) => {
                self.run += 1;
                self.replay = Some(EngineReplay::new(head).ok()?);
                (self.trees, self.beliefs, self.goals) = Default::default();
                let mut item = self.outline("run")?;
                item.insert("at".to_owned(), json!(head.from.secs()));
                item.insert("request".to_owned(), json!(head.instruction));
                let mut changes = Vec::new();
                self.believe(&mut changes);
                item.insert("c".to_owned(), Value::Array(changes));
                item
            }
            JournalEntry::Step(step) | JournalEntry::GaveUp(step) => {
                let changes = self.step(entry, step)?;
                let mut item = Map::new();
                item.insert("t".to_owned(), json!("step"));
                item.insert("at".to_owned(), json!(step.at.secs()));
                item.insert("c".to_owned(), Value::Array(changes));
                item
            }
            JournalEntry::Swap(swap) => {
                self.replay.as_mut()?.take(entry).ok()?;
                let mut item = self.outline("swap")?;
                let mut changes = Vec::new();
                self.effects(swap.at, &swap.effects, &mut changes);
                self.believe(&mut changes);
                item.insert("at".to_owned(), json!(swap.at.secs()));
                item.insert("c".to_owned(), Value::Array(changes));
                item
            }
            JournalEntry::Resumed(resumed) => {
                let mut item = Map::new();
                item.insert("t".to_owned(), json!("resumed"));
                item.insert("at".to_owned(), json!(self.now().secs()));
                item.insert("cut".to_owned(), json!(resumed.cut_bytes));
                item
            }
        };
        item.insert("run".to_owned(), json!(self.run));
        Some((self.id(seq), Value::Object(item)))
    }

    fn now(&self) -> Time {
        self.replay.as_ref().map_or(Time::ZERO, EngineReplay::now)
    }

    /// Item of the policy that runs now, whose tree is made.
    fn outline(&mut self, kind: &str) -> Option<Map<String, Value>> {
        let graph = Arc::new(self.replay.as_ref()?.engine().graph().clone());
        let tree = StepTree::new(Arc::clone(&graph));
        let text = self.text.take();
        let mut item = outline(&graph, &tree, text.as_ref(), self.world.as_ref());
        item.insert("t".to_owned(), json!(kind));
        self.trees.push(tree);
        Some(item)
    }

    fn step(&mut self, entry: &JournalEntry, step: &StepEntry) -> Option<Vec<Value>> {
        let mut changes = Vec::new();
        if let Some(event) = &step.event {
            self.trees.iter_mut().for_each(|tree| tree.event(event));
            self.event(event, &mut changes);
        }
        // Whether it differs from the journal is for `motet replay` to tell.
        self.replay.as_mut()?.take(entry).ok()?;
        self.effects(step.at, &step.effects, &mut changes);
        self.believe(&mut changes);
        Some(changes)
    }

    fn event(&mut self, event: &Event, changes: &mut Vec<Value>) {
        match event {
            Event::Driver(report) => self.reported(report, changes),
            Event::Verified { verdict, .. } => {
                if let Verification::Infeasible { why, .. } = verdict {
                    let blocks = self.world.as_ref().map(|world| world.named(why));
                    changes.push(json!({"k": "blocked", "why": escape(why), "by": blocks}));
                }
            }
            Event::Hold => changes.push(json!({"k": "held", "is": true})),
            Event::Proceed => changes.push(json!({"k": "held", "is": false})),
            Event::Stop => changes.push(json!({"k": "stopped"})),
            Event::Begin | Event::Tick | Event::Noticed { .. } => {}
        }
    }

    fn reported(&mut self, report: &DriverEvent, changes: &mut Vec<Value>) {
        let ended = |goal: &GoalId, how: &str, why: Option<String>| {
            let why = why.map(|why| escape(&why));
            json!({"k": "goal", "g": goal.to_string(), "how": how, "why": why})
        };
        match report {
            DriverEvent::Acknowledged { goal } => {
                changes.push(json!({"k": "state", "g": goal.to_string(), "is": "runs"}));
            }
            DriverEvent::Ended { goal, outcome } => {
                let command = self.goals.remove(goal);
                let change = match outcome {
                    Outcome::Success(result) => {
                        let leaves = command.and_then(|command| command.leaves.clone());
                        let pose = self.world.as_mut().zip(leaves).and_then(|(world, at)| world.left(&at));
                        changes.extend(pose.map(|pose| json!({"k": "pose", "pose": pose})));
                        ended(goal, "done", result.as_ref().map(ToString::to_string))
                    }
                    Outcome::Failure(failure) => ended(goal, "failed", Some(failure.to_string())),
                    Outcome::Interrupted => ended(goal, "interrupted", None),
                };
                changes.push(change);
            }
            DriverEvent::Refused { goal, failure } => {
                self.goals.remove(goal);
                changes.push(ended(goal, "failed", Some(format!("refused: {failure}"))));
            }
            DriverEvent::Feedback { goal, text, own_motion } => {
                let text = format!("{}{}", if *own_motion { OWN_MOTION } else { "" }, escape(text));
                changes.push(json!({"k": "feedback", "g": goal.to_string(), "text": text}));
            }
            DriverEvent::Stopped { goal } => changes.push(ended(goal, "interrupted", None)),
            DriverEvent::Lost { goal } => {
                changes.push(json!({"k": "state", "g": goal.to_string(), "is": "lost"}));
            }
            DriverEvent::NotHeld { goal } => {
                changes.push(json!({"k": "state", "g": goal.to_string(), "is": "not held"}));
            }
            DriverEvent::DriverLost | DriverEvent::DriverGone => changes.push(json!({"k": "lost"})),
            DriverEvent::Observed { query, answer } => {
                let (query, answer) = (escape(&query.to_string()), escape(&answer.to_string()));
                if self.beliefs.readings.insert(query.clone(), answer.clone()).as_ref() != Some(&answer) {
                    changes.push(json!({"k": "read", "q": query, "v": answer}));
                }
            }
        }
    }

    fn effects(&mut self, at: Time, effects: &[Effect], changes: &mut Vec<Value>) {
        for effect in effects {
            match effect {
                Effect::Start { goal, node, command, deadline } => {
                    self.goals.insert(*goal, Arc::clone(command));
                    let change = self.started(*goal, *node, command, *deadline);
                    changes.push(change);
                }
                Effect::Update { goal, node, command, deadline } => {
                    self.goals.insert(*goal, Arc::clone(command));
                    let mut change = self.started(*goal, *node, command, *deadline);
                    if let Some(change) = change.as_object_mut() {
                        change.insert("k".to_owned(), json!("update"));
                    }
                    changes.push(change);
                }
                Effect::Cancel { goal } => {
                    changes.push(json!({"k": "state", "g": goal.to_string(), "is": "cancelling"}));
                }
                Effect::Hold { goal } => {
                    changes.push(json!({"k": "state", "g": goal.to_string(), "is": "held"}));
                }
                Effect::Proceed { goal } => {
                    changes.push(json!({"k": "state", "g": goal.to_string(), "is": "runs"}));
                }
                Effect::SafeStop { goal } => {
                    changes.push(json!({"k": "state", "g": goal.to_string(), "is": "safe stop"}));
                }
                Effect::Report(event) => self.traced(event, changes),
                Effect::Finished(end) => changes.push(self.finished(at, end)),
                Effect::Observe { .. }
                | Effect::Watch { .. }
                | Effect::Unwatch { .. }
                | Effect::Verify { .. } => {}
            }
        }
    }

    fn started(&mut self, goal: GoalId, node: NodeId, command: &Command, deadline: Time) -> Value {
        let tree = self.trees.last_mut();
        let label = tree.and_then(|tree| {
            tree.start(node, command);
            tree.row(node).map(|row| row.label.clone())
        });
        let world = self.world.as_ref();
        let motions = command.motions.iter().filter_map(|motion| motion.witness.as_deref());
        let paths: Vec<Value> =
            world.into_iter().flat_map(|world| motions.clone().map(|witness| world.path(witness))).collect();
        let why: Vec<String> =
            command.motions.iter().filter_map(|motion| motion.why.as_deref()).map(escape).collect();
        json!({
            "k": "start", "g": goal.to_string(), "r": self.place(node), "cmd": escape(&command.to_string()),
            "l": label, "uses": command.uses, "by": deadline.secs(), "paths": paths, "open": why,
            "q": question(command),
        })
    }

    /// Row of a step in the newest tree.
    fn place(&self, node: NodeId) -> Option<usize> {
        self.trees.last().and_then(|tree| tree.rows.iter().position(|row| row.node == Some(node)))
    }

    fn traced(&mut self, event: &TraceEvent, changes: &mut Vec<Value>) {
        let revision = event.revision as usize;
        let is_old = revision + 1 < self.trees.len();
        let Some(tree) = self.trees.get_mut(revision) else { return };
        let node = tree.take(event);
        if let Some(place) = node.and_then(|node| tree.rows.iter().position(|row| row.node == Some(node)))
            && let Some(row) = tree.rows.get(place)
        {
            let kind = if matches!(event.what, TraceEventKind::Entered { .. }) { "enter" } else { "row" };
            let mut change = json!({
                "k": kind, "r": place, "s": status(row.status), "n": row.note, "a": row.since.secs(),
                "l": row.label,
            });
            if let Some(change) = change.as_object_mut() {
                change.extend(row.took.map(|took| ("d".to_owned(), json!(took.secs()))));
                change.extend(is_old.then(|| ("v".to_owned(), json!(revision))));
            }
            changes.push(change);
        }
        match &event.what {
            TraceEventKind::Fired { node, watch, truth } => changes.push(json!({
                "k": "fired", "r": self.place(*node), "w": watch, "truth": truth.to_string(),
            })),
            TraceEventKind::Guard { node, need, truth } => changes.push(json!({
                "k": "guard", "r": self.place(*node), "i": need, "truth": truth.to_string(),
            })),
            TraceEventKind::Verified { node, verdict } => changes.push(json!({
                "k": "verdict", "r": self.place(*node), "text": escape(&verdict.to_string()),
            })),
            TraceEventKind::Swapped { policy } => changes.push(json!({"k": "swapped", "policy": &**policy})),
            TraceEventKind::Kept { goal, .. } => {
                changes.push(json!({"k": "fate", "g": goal.to_string(), "is": "kept"}));
            }
            TraceEventKind::Updated { goal, .. } => {
                changes.push(json!({"k": "fate", "g": goal.to_string(), "is": "updated"}));
            }
            TraceEventKind::GoalEnded {
                goal,
                ending: NodeEnding::Interrupted,
                cause: EndCause::Swap,
                ..
            } => {
                changes.push(json!({"k": "fate", "g": goal.to_string(), "is": "cancelled"}));
            }
            TraceEventKind::GoalObserved { truth } => {
                changes.push(json!({"k": "observed", "truth": truth.to_string()}));
            }
            _ => {}
        }
    }

    fn finished(&self, at: Time, end: &RunEnd) -> Value {
        let (how, why, node) = match end {
            RunEnd::Done { why, result } => {
                let result = result.as_ref().map(|result| format!("gave {result}"));
                ("done", why.clone().or(result), None)
            }
            RunEnd::Failed { kind, why, node } => {
                // `fail "…"` has a kind of its own that says nothing more.
                let why = match why {
                    None => kind.to_string(),
                    Some(why) if kind == failures::FAILED => why.clone(),
                    Some(why) => format!("{kind}: {why}"),
                };
                ("failed", Some(why), Some(*node))
            }
            RunEnd::Declined { why } => ("declined", why.clone(), None),
            RunEnd::Replan { why } => ("replan", why.clone(), None),
            RunEnd::Interrupted => ("interrupted", None, None),
            RunEnd::Fault(fault) => ("fault", Some(fault.to_string()), None),
        };
        let place = node.and_then(|node| self.place(node));
        let why = why.map(|why| escape(&why));
        let blocks = self.world.as_ref().zip(why.as_deref()).map(|(world, why)| world.named(why));
        json!({"k": "end", "how": how, "why": why, "r": place, "at": at.secs(), "by": blocks})
    }

    /// Adds what is believed now and was not before.
    fn believe(&mut self, changes: &mut Vec<Value>) {
        let Some(replay) = &self.replay else { return };
        let Snapshot { bindings, facts, .. } = replay.engine().snapshot();
        for (name, value) in bindings {
            let (name, value) = (name.to_string(), shown(&value));
            if self.beliefs.bindings.get(&name) != Some(&value) {
                changes.push(json!({"k": "bind", "b": name, "v": value}));
                self.beliefs.bindings.insert(name, value);
            }
        }
        if facts.len() > MOST_FACTS {
            return;
        }
        for (query, truth) in facts {
            let known = match truth {
                motet_runtime::Truth::True => Some(true),
                motet_runtime::Truth::False => Some(false),
                motet_runtime::Truth::Unknown => None,
            };
            let fact = escape(&query.to_string());
            if self.beliefs.facts.get(&fact) != Some(&known) {
                changes.push(json!({"k": "fact", "f": fact, "v": known}));
                self.beliefs.facts.insert(fact, known);
            }
        }
    }
}

fn shown(value: &MotetValue) -> String {
    escape(&value.to_string())
}

const fn status(status: StepStatus) -> &'static str {
    match status {
        StepStatus::Pending => "pending",
        StepStatus::Running => "running",
        StepStatus::Done => "done",
        StepStatus::Failed => "failed",
        StepStatus::Interrupted => "interrupted",
    }
}

/// Question of a command with its options; null for other commands.
fn question(command: &Command) -> Value {
    let is_question = command.primitive == primitives::ASK || command.primitive == primitives::CHOOSE;
    let Some(MotetValue::Text(text)) = command.arg("question").filter(|_| is_question) else {
        return Value::Null;
    };
    let options = match command.arg("among") {
        Some(MotetValue::List(among)) => among.iter().map(shown).collect(),
        Some(_) | None => Vec::new(),
    };
    json!({"text": escape(text), "options": options})
}
