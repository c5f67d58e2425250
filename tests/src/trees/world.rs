//! World in which policies run: every goal takes a second, and its outcome depends on the seed and on how
//! often the same goal was tried.

use std::collections::{BTreeMap, VecDeque};
use std::fmt::Write as _;

use motet_graph::{Graph, Value};
use motet_runtime::{
    Answer, Command, Driver, DriverEvent, Engine, GoalId, Outcome, Pattern, Query, RunEnd, StartState, Time,
};

use super::hash;

/// Actions of a run in the order of their starts, and its end.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Account {
    /// Lines such as `push what=lamp_1 power=2`.
    pub actions: Vec<String>,
    /// One of `done`, `failure`, `cannot` and `replan`.
    pub end: String,
}

/// Runs a graph in the world of a seed.
#[must_use]
pub fn run(graph: &Graph, seed: u64) -> Option<Account> {
    let mut engine = Engine::new(graph.clone(), &StartState::default()).ok()?;
    let mut world = World { seed, ..World::default() };
    let end = motet_runtime::run(&mut engine, &mut world, &mut (), Time::ZERO);
    let end = match end {
        RunEnd::Done { .. } => "done",
        RunEnd::Failed { .. } => "failure",
        RunEnd::Declined { .. } => "cannot",
        RunEnd::Replan { .. } => "replan",
        RunEnd::Interrupted | RunEnd::Fault(_) => return None,
    };
    Some(Account { actions: world.actions, end: end.to_owned() })
}

#[derive(Default)]
struct World {
    seed: u64,
    now: Time,
    actions: Vec<String>,
    /// Number of times that each goal was tried.
    tried: BTreeMap<String, u64>,
    lit: BTreeMap<String, bool>,
    events: VecDeque<(Time, DriverEvent)>,
    /// Facts that change when a goal ends well.
    effects: BTreeMap<u64, (String, bool)>,
    watched: Vec<Query>,
}

impl World {
    fn is_lit(&self, lamp: &str) -> bool {
        self.lit.get(lamp).copied().unwrap_or_else(|| hash(&format!("{}/lit/{lamp}", self.seed)) % 2 == 1)
    }

    fn answer(&self, query: &Query) -> Answer {
        match query {
            Query::Fact { fluent, args } => match (fluent.as_str(), args.as_slice()) {
                ("lit", [Pattern::Is(Value::Entity(lamp))]) => Answer::Truth(self.is_lit(lamp)),
                _ => Answer::Unknown,
            },
            Query::Measure { args, .. } => match args.as_slice() {
                [Value::Entity(lamp)] => {
                    let percent = hash(&format!("{}/level/{lamp}", self.seed)) % 100;
                    Answer::Value(Value::Number(percent as f64 / 100.0))
                }
                _ => Answer::Unknown,
            },
            Query::Field { .. } => Answer::Unknown,
        }
    }

    /// Failures of an action.
    fn kinds(primitive: &str) -> &'static [&'static str] {
        match primitive {
            "push" | "dim" => &["jam", "slip"],
            "light" | "find" => &["jam"],
            _ => &["slip"],
        }
    }
}

impl Driver for World {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        let mut line = command.primitive.to_string();
        for (name, value) in &command.args {
            let value = match value {
                Value::Text(text) | Value::Entity(text) => text.to_string(),
                other => other.to_string(),
            };
            let _ = write!(line, " {name}={value}");
        }
        let count = self.tried.entry(line.clone()).or_default();
        *count += 1;
        let number = hash(&format!("{}/{line}/{count}", self.seed));
        self.actions.push(line);
        let lamp = command.args.iter().find_map(|(_, value)| match value {
            Value::Entity(lamp) => Some(lamp.to_string()),
            _ => None,
        });
        let kinds = Self::kinds(&command.primitive);
        let outcome = if number % 100 < 30 {
            let kind = kinds.get((number / 100) as usize % kinds.len()).copied().unwrap_or_default();
            Outcome::Failure(kind.into())
        } else {
            if let Some(lamp) = lamp
                && let Some(value) = match command.primitive.as_str() {
                    "light" => Some(true),
                    "dim" => Some(false),
                    _ => None,
                }
            {
                self.effects.insert(goal.number(), (lamp, value));
            }
            let found = Value::Entity(format!("lamp_{}", 1 + number / 100 % 3).into());
            Outcome::Success((command.primitive == "find").then_some(found))
        };
        self.events.push_back((now.after(Time::from_secs(1.0)), DriverEvent::Ended { goal, outcome }));
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        let before = self.events.len();
        self.events
            .retain(|(_, event)| !matches!(event, DriverEvent::Ended { goal: other, .. } if *other == goal));
        if self.events.len() < before {
            self.effects.remove(&goal.number());
            self.events.push_front((now, DriverEvent::Ended { goal, outcome: Outcome::Interrupted }));
        }
    }

    fn update(&mut self, _: Time, _: GoalId, _: &Command) {}
    fn hold(&mut self, now: Time, goal: GoalId) {
        self.events.push_front((now, DriverEvent::NotHeld { goal }));
    }
    fn proceed(&mut self, _: Time, _: GoalId) {}
    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.cancel(now, goal);
    }

    fn observe(&mut self, now: Time, query: &Query) {
        let answer = self.answer(query);
        self.events.push_front((now, DriverEvent::Observed { query: query.clone(), answer }));
    }

    fn watch(&mut self, now: Time, query: &Query) {
        if !self.watched.contains(query) {
            self.watched.push(query.clone());
        }
        self.observe(now, query);
    }

    fn unwatch(&mut self, _: Time, query: &Query) {
        self.watched.retain(|watched| watched != query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let at = self.events.front()?.0;
        if at > until {
            self.now = until;
            return None;
        }
        let (at, event) = self.events.pop_front()?;
        self.now = self.now.max(at);
        if let DriverEvent::Ended { goal, outcome: Outcome::Success(_) } = &event
            && let Some((lamp, value)) = self.effects.remove(&goal.number())
        {
            self.lit.insert(lamp, value);
            for query in self.watched.clone() {
                let answer = self.answer(&query);
                self.events.push_front((at, DriverEvent::Observed { query, answer }));
            }
        }
        Some((self.now, event))
    }
}
