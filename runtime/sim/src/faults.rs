//! Faults: files of injected faults and world changes as JSON, and their schedule in a run.

use crate::world::{Rest, SimWorld};
use indexmap::IndexMap;
use motet_runtime::{FailureReport, Time};
use motet_stdlib::lang::kinds;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::collections::VecDeque;

/// A file of faults. Everything in it is optional.
///
/// ```
/// let text = r#"{"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": "slipped"}}],
/// "world": [{"at": 4.5, "what": {"moves": {"object": "mug_1", "to": {"surface": "counter"}}}}],
///                "answers": ["the red one", null]}"#;
/// let faults = motet_sim::Faults::from_json(text).unwrap();
/// assert_eq!(faults.calls.len(), 1);
/// ```
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Faults {
    /// Faults of calls.
    pub calls: Vec<CallFault>,
    /// World changes in any order; of two at the same time the earlier in the file happens first.
    pub world: Vec<WorldChange>,
    /// Answers to `ask` and `choose`, in order, after those of the script; `null` refuses.
    pub answers: Vec<Option<String>>,
}

/// A fault of one call.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CallFault {
    #[schemars(with = "String")]
    pub primitive: SmolStr,
    /// Number of the call of that primitive in the run, from 1; retries count. Without it, every call.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub nth: Option<u32>,
    pub then: CallFaultKind,
}

/// Least factor of a call's time. A motion that takes no time never ends.
const SLOWER: f64 = 1e-3;

/// Greatest coordinate of a place in m.
const FARTHEST: f64 = 10_000.0;

/// Kind of a call's fault.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum CallFaultKind {
    /// It takes its time, changes nothing, and ends in this failure: its kind, or an object with its `kind`
    /// and a `text` for people.
    Fails(FailureReport),
    /// It is not accepted, for this failure.
    Refuses(FailureReport),
    /// It takes that many times as long.
    Slower(#[schemars(range(min = 0.001))] f64),
    /// It never ends by itself.
    Hangs,
}

/// A change of the world.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorldChange {
    /// Time in seconds from the beginning of the run, or from the answer.
    #[serde(default)]
    #[schemars(range(min = 0.0))]
    pub at: f64,
    /// Number of the answer, from 1, with which the time begins: a person answers, and does something.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub after_answer: Option<u32>,
    pub what: WorldEvent,
}

/// Event in the world.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum WorldEvent {
    /// Somebody moves a thing.
    Moves {
        #[schemars(with = "String")]
        object: SmolStr,
        to: Destination,
    },
    /// A person walks along a straight line.
    Walks {
        #[schemars(with = "String")]
        person: SmolStr,
        /// From here, in m; without it from where they are.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        from: Option<[f64; 2]>,
        /// To here, in m.
        to: [f64; 2],
        #[schemars(range(min = 0.001))]
        speed: f64,
    },
    /// A held thing slips out of the hand; without effect if it is not held.
    Slips(#[schemars(with = "String")] SmolStr),
    /// Somebody opens a container.
    Opens(#[schemars(with = "String")] SmolStr),
    /// Somebody closes a container.
    Closes(#[schemars(with = "String")] SmolStr),
    /// Somebody locks a container.
    Locks(#[schemars(with = "String")] SmolStr),
    /// Somebody unlocks a container.
    Unlocks(#[schemars(with = "String")] SmolStr),
    /// The battery reads this charge from now on, between 0 and 1.
    Battery(#[schemars(range(min = 0.0, max = 1.0))] f64),
}

impl WorldEvent {
    /// Kind of the entity that a key of a file of faults names; `None` for other keys.
    ///
    /// ```
    /// assert_eq!(motet_sim::WorldEvent::kind_at("opens"), Some("Container"));
    /// ```
    #[must_use]
    pub fn kind_at(key: &str) -> Option<&'static str> {
        Some(match key {
            "person" => kinds::PERSON,
            "slips" => kinds::OBJECT,
            "container" | "opens" | "closes" | "locks" | "unlocks" => kinds::CONTAINER,
            "object" | "surface" => kinds::ENTITY,
            _ => return None,
        })
    }
}

/// Destination of a moved thing.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Destination {
    /// A free spot of a surface.
    Surface(#[schemars(with = "String")] SmolStr),
    /// Into a container.
    Container(#[schemars(with = "String")] SmolStr),
    /// A point, in m, that its centre comes to.
    Point([f64; 3]),
}

/// A file of faults that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct FaultsError {
    message: String,
}

impl Faults {
    /// Reads a file's text.
    ///
    /// # Errors
    ///
    /// Where it is not JSON of this form, or a number is out of range; with line and column where the text is
    /// at fault.
    pub fn from_json(text: &str) -> Result<Self, FaultsError> {
        let faults: Self =
            serde_json::from_str(text).map_err(|error| FaultsError { message: error.to_string() })?;
        faults.check()?;
        Ok(faults)
    }

    /// Checks that each number is in its range, and that nothing moves onto itself.
    ///
    /// # Errors
    ///
    /// The first fault or change that cannot be.
    pub fn check(&self) -> Result<(), FaultsError> {
        self.ranges().map_or(Ok(()), |message| Err(FaultsError { message }))
    }

    /// The file's JSON Schema.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(Self).to_value()
    }

    fn ranges(&self) -> Option<String> {
        let wrong_call = self.calls.iter().find_map(|fault| match (&fault.then, fault.nth) {
            (_, Some(0)) => Some("`nth` counts from 1".to_owned()),
            (CallFaultKind::Slower(factor), _) if *factor < SLOWER => {
                Some(format!("`slower` is {factor}, least is {SLOWER}"))
            }
            (
                CallFaultKind::Slower(_)
                | CallFaultKind::Fails(_)
                | CallFaultKind::Refuses(_)
                | CallFaultKind::Hangs,
                _,
            ) => None,
        });
        let wrong_change = || self.world.iter().find_map(WorldChange::ranges);
        wrong_call.or_else(wrong_change)
    }
}

impl WorldChange {
    fn ranges(&self) -> Option<String> {
        if self.at < 0.0 {
            return Some(format!("`at` is {} s, least is 0 s", self.at));
        }
        if self.after_answer == Some(0) {
            return Some("`after_answer` counts from 1".to_owned());
        }
        let is_far = |point: &[f64]| point.iter().any(|number| number.abs() > FARTHEST);
        let far = Some(format!("a coordinate is more than {FARTHEST} m from the origin"));
        match &self.what {
            WorldEvent::Walks { speed, .. } if *speed < 1e-3 => {
                Some(format!("`speed` is {speed} m/s, least is 0.001 m/s"))
            }
            WorldEvent::Walks { from, to, .. } if is_far(to) || from.is_some_and(|from| is_far(&from)) => far,
            WorldEvent::Moves { to: Destination::Point(point), .. } if is_far(point) => far,
            WorldEvent::Moves { object, to: Destination::Surface(to) | Destination::Container(to) }
                if object == to =>
            {
                Some(format!("`{object}` cannot move onto or into itself"))
            }
            WorldEvent::Battery(charge) if !(0.0..=1.0).contains(charge) => {
                Some(format!("`battery` is {charge}, which is not between 0 and 1"))
            }
            WorldEvent::Walks { .. }
            | WorldEvent::Battery(_)
            | WorldEvent::Moves { .. }
            | WorldEvent::Slips(_) => None,
            WorldEvent::Opens(_) | WorldEvent::Closes(_) | WorldEvent::Locks(_) | WorldEvent::Unlocks(_) => {
                None
            }
        }
    }
}

/// Faults and world changes that are still to come.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct FaultSchedule {
    calls: Vec<CallFault>,
    counts: IndexMap<SmolStr, u32>,
    changes: VecDeque<(Time, WorldEvent)>,
    /// Changes that follow answers.
    later: Vec<WorldChange>,
    answers: u32,
}

/// A fault of one call.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ScheduledFault {
    pub(crate) fails: Option<FailureReport>,
    pub(crate) refuses: Option<FailureReport>,
    pub(crate) slower: f64,
    pub(crate) hangs: bool,
}

impl FaultSchedule {
    pub(crate) fn new(faults: &Faults) -> Self {
        let (later, timed): (Vec<_>, Vec<_>) =
            faults.world.iter().cloned().partition(|change| change.after_answer.is_some());
        let mut changes: Vec<_> =
            timed.into_iter().map(|change| (Time::from_secs(change.at), change.what)).collect();
        changes.sort_by_key(|(at, _)| *at);
        let (calls, counts) = (faults.calls.clone(), IndexMap::new());
        Self { calls, counts, changes: changes.into(), later, answers: 0 }
    }

    /// A person has answered: what follows from it is now due.
    pub(crate) fn answered(&mut self, now: Time) {
        self.answers += 1;
        let due: Vec<WorldChange> =
            self.later.iter().filter(|change| change.after_answer == Some(self.answers)).cloned().collect();
        for change in due {
            self.insert(now.after(Time::from_secs(change.at)), change.what);
        }
    }

    /// Adds a change behind those of the same time.
    pub(crate) fn insert(&mut self, at: Time, what: WorldEvent) {
        let place = self.changes.partition_point(|(time, _)| *time <= at);
        self.changes.insert(place, (at, what));
    }

    /// Counts a call, and tells what happens to it.
    pub(crate) fn of_call(&mut self, primitive: &SmolStr) -> ScheduledFault {
        let count = self.counts.entry(primitive.clone()).or_insert(0);
        *count += 1;
        let mut fate = ScheduledFault { fails: None, refuses: None, slower: 1.0, hangs: false };
        let mine =
            |fault: &&CallFault| fault.primitive == *primitive && fault.nth.is_none_or(|nth| nth == *count);
        for fault in self.calls.iter().filter(mine) {
            match &fault.then {
                CallFaultKind::Fails(failure) => fate.fails = Some(failure.clone()),
                CallFaultKind::Refuses(failure) => fate.refuses = Some(failure.clone()),
                CallFaultKind::Slower(factor) => fate.slower = (fate.slower * factor).max(SLOWER),
                CallFaultKind::Hangs => fate.hangs = true,
            }
        }
        fate
    }

    /// Time at which the world changes next.
    pub(crate) fn next_time(&self) -> Time {
        self.changes.front().map_or(Time::NEVER, |(at, _)| *at)
    }

    /// The next change that is due.
    pub(crate) fn take(&mut self, now: Time) -> Option<WorldEvent> {
        self.changes.pop_front_if(|(at, _)| *at <= now).map(|(_, change)| change)
    }
}

impl SimWorld {
    /// A change happens. One of a thing that does not exist does not.
    pub(crate) fn happen(&mut self, change: &WorldEvent) {
        match change {
            WorldEvent::Moves { object, to } => self.move_away(object, to),
            WorldEvent::Walks { person, from, to, speed } => self.start_walk(person, *from, *to, *speed),
            WorldEvent::Slips(id) => self.slip(id),
            WorldEvent::Opens(id) => self.set_open(id, true),
            WorldEvent::Closes(id) => self.set_open(id, false),
            WorldEvent::Locks(id) => self.set_locked(id, true),
            WorldEvent::Unlocks(id) => self.set_locked(id, false),
            WorldEvent::Battery(charge) => self.battery = *charge,
        }
    }

    fn move_away(&mut self, id: &SmolStr, to: &Destination) {
        if !self.things.contains_key(id) {
            return;
        }
        match to {
            Destination::Surface(support) | Destination::Container(support) => {
                // What carries it cannot come to lie on it.
                if !self.things.contains_key(support) || self.root(support) == id.as_str() {
                    return;
                }
                self.slip(id);
                let is_in = matches!(to, Destination::Container(_));
                let rest = if is_in { Rest::In(support.clone()) } else { Rest::On(support.clone()) };
                self.lay(id, support, rest);
            }
            Destination::Point(xyz) => {
                self.slip(id);
                if let Some(thing) = self.things.get_mut(id) {
                    thing.rest = Rest::Free;
                    let from = thing.body.xyz;
                    self.shift(id, [xyz[0] - from[0], xyz[1] - from[1], xyz[2] - from[2]]);
                }
            }
        }
    }

    pub(crate) fn set_locked(&mut self, id: &str, locked: bool) {
        if let Some(door) = self.things.get_mut(id).and_then(|thing| thing.door.as_mut()) {
            door.locked = locked;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn refused(text: &str, why: &str) {
        let error = Faults::from_json(text).unwrap_err().to_string();
        assert!(error.contains(why), "{error}");
    }

    #[test]
    fn faults_what_is_wrong_is_said() {
        refused(r#"{"call": []}"#, "unknown field `call`");
        refused(r#"{"calls": [{"primitive": "go", "nth": 0, "then": "hangs"}]}"#, "counts from 1");
        refused(r#"{"world": [{"at": -1, "what": {"slips": "mug"}}]}"#, "-1 s");
        refused(r#"{"world": [{"at": 1, "what": {"battery": 2}}]}"#, "not between 0 and 1");
        refused(
            r#"{"world": [{"at": 1, "what": {"moves": {"object": "mug", "to": {"surface": "mug"}}}}]}"#,
            "`mug` cannot move onto or into itself",
        );
        refused(
            r#"{"world": [{"at": 1, "what": {"moves": {"object": "mug", "to": {"point": [1e300, 0, 0]}}}}]}"#,
            "more than 10000 m",
        );
        refused(r#"{"world": [{"after_answer": 0, "what": {"opens": "fridge"}}]}"#, "counts from 1");
        refused(
            r#"{"world": [{"at": 1, "what": {"walks": {"person": "user", "to": [0, 0], "speed": 0}}}]}"#,
            "0 m/s",
        );
    }

    #[test]
    fn faults_writing_and_reading_gives_the_same() {
        let text = concat!(
            r#"{"calls":[{"primitive":"go","then":{"slower":2.0}}],"world":[{"at":1.0,"what":"#,
            r#"{"walks":{"person":"user","to":[1.0,2.0],"speed":0.5}}},{"at":2.0,"what":{"moves":"#,
            r#"{"object":"cup","to":{"point":[1.0,0.0,0.5]}}}}],"answers":["yes",null]}"#
        );
        let faults = Faults::from_json(text).unwrap();
        assert_eq!(serde_json::to_string(&faults).unwrap(), text);
        assert_eq!(Faults::schema().get("additionalProperties"), Some(&serde_json::Value::Bool(false)));
    }
}
