//! SayCan rows as ordinary policies and scenes: an instruction's expected plan, its start and its goal.
//!
//! The rows name places and objects but no geometry, so the room is our own: each place stands where a robot
//! can drive around it, and objects stand side by side on it.

use serde::Deserialize;
use serde_json::{Map, Value, json};

/// A row of `saycan.jsonl`; what the tests do not read is left out.
#[derive(Clone, Debug, Deserialize)]
pub struct Row {
    /// The row's name.
    pub id: String,
    /// Instruction of the person.
    pub instruction: String,
    /// Kind of the instruction.
    #[serde(default)]
    pub family: String,
    robot_start: Start,
    scene: Map<String, Value>,
    expected_plan: Vec<Op>,
    goal: Vec<Value>,
}

#[derive(Clone, Debug, Deserialize)]
struct Start {
    at: String,
    holding: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
struct Op {
    op: String,
    args: Vec<String>,
}

/// Places of these rows, each the centre of a box of 0.8 m × 0.6 m.
const PLACES: &[(&str, [f64; 2])] = &[
    ("table", [2.5, 0.0]),
    ("close_counter", [0.0, -2.5]),
    ("far_counter", [3.5, 3.5]),
    ("trash", [-2.5, 1.0]),
];
const HEIGHT_M: f64 = 0.7;
const USER: [f64; 2] = [-1.5, -2.0];

impl Row {
    /// Reads a line.
    ///
    /// # Errors
    ///
    /// Where the line is not such a row.
    pub fn read(line: &str) -> serde_json::Result<Self> {
        serde_json::from_str(line)
    }

    /// The plan as a policy document with its goal.
    #[must_use]
    pub fn policy(&self) -> String {
        let mut held = self.robot_start.holding.clone();
        let mut steps = Vec::with_capacity(self.expected_plan.len());
        for op in &self.expected_plan {
            let first = op.args.first().cloned().unwrap_or_default();
            steps.push(match op.op.as_str() {
                "go" => json!({"do": "go", "to": first}),
                "pick" => {
                    held = Some(first.clone());
                    json!({"do": "pick", "object": first})
                }
                // The source puts things "at the user": that is a handover.
                "place" if first == "user" => json!({"do": "handover", "object": held.take(), "to": first}),
                "place" => json!({"do": "place", "object": held.take(), "on": first}),
                "done" => json!({"end": "done"}),
                other => json!({"do": other}),
            });
        }
        let goal: Vec<_> = self.goal.iter().map(goal).collect();
        let name = self.id.replace('-', "_");
        json!({"motet": 1, "policy": name, "robot": "hsr", "achieves": {"all": goal}, "steps": steps})
            .to_string()
    }

    /// True if the goal holds in a world that tells which facts hold.
    #[must_use]
    pub fn reached(&self, holds: impl Fn(&str, &[&str]) -> bool) -> bool {
        self.goal.iter().all(|atom| is_reached(atom, &holds))
    }

    /// The room as a scene document.
    #[must_use]
    pub fn scene(&self) -> String {
        let mut entities = Vec::new();
        for (name, [x, y]) in PLACES {
            let kind = if *name == "trash" { "Container" } else { "Surface" };
            entities.push(json!({
                "id": name, "kind": kind, "class": name, "fixed": true,
                "pose": {"xyz": [x, y, HEIGHT_M / 2.0], "rpy": [0, 0, 0]}, "shape": {"box": [0.8, 0.6,
                    HEIGHT_M]},
            }));
        }
        for (index, (id, place)) in self.scene.iter().enumerate() {
            let place = place.as_str().unwrap_or_default();
            let [x, y] = spot(place);
            let [dx, dy] = [0.15 * (index % 3) as f64 - 0.2, 0.15 * (index / 3 % 3) as f64 - 0.15];
            let mut entity = json!({
                "id": id, "kind": "Object", "class": id, "names": [id.replace('_', " ")], "mass": 0.3,
                "pose": {"xyz": [x + dx, y + dy, HEIGHT_M + 0.05], "rpy": [0, 0, 0]},
                "shape": {"cylinder": {"radius": 0.03, "height": 0.1}},
            });
            if let (false, Some(fields)) = (place == "hand", entity.as_object_mut()) {
                let key = if place == "trash" { "in" } else { "on" };
                fields.insert(key.to_owned(), json!(place));
            }
            entities.push(entity);
        }
        entities.push(json!({
            "id": "user", "kind": "Person", "class": "person",
            "pose": {"xyz": [USER[0], USER[1], 0.0], "rpy": [0, 0, 0]},
            "shape": {"cylinder": {"radius": 0.3, "height": 1.7}},
        }));
        let [x, y] = spot(&self.robot_start.at);
        let robot = json!({"base": [x - 0.9, y, 0.0], "holding": self.robot_start.holding,
            "at": self.robot_start.at});
        json!({"motet_scene": 1, "frame": "map", "robot": robot, "entities": entities}).to_string()
    }
}

fn spot(place: &str) -> [f64; 2] {
    let known = PLACES.iter().find(|(name, _)| *name == place).map(|(_, at)| *at);
    known.unwrap_or(USER)
}

/// `["at", x, y]`, `["or", …]` as a condition of the JSON form.
fn goal(atom: &Value) -> Value {
    let words: Vec<&str> = atom.as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    match words.as_slice() {
        ["or"] => {
            let parts = atom.as_array().into_iter().flatten().skip(1).map(goal);
            json!({"any": parts.collect::<Vec<_>>()})
        }
        ["at", what, place] => json!({"is": "at", "what": what, "where": place}),
        ["robot_at", place] => json!({"is": "at", "what": "robot", "where": place}),
        ["visited", place] => json!({"is": "visited", "where": place}),
        [fluent, object] => json!({"is": fluent, "object": object}),
        _ => atom.clone(),
    }
}

fn is_reached(atom: &Value, holds: &impl Fn(&str, &[&str]) -> bool) -> bool {
    let words: Vec<&str> = atom.as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    match words.as_slice() {
        ["or"] => atom.as_array().into_iter().flatten().skip(1).any(|part| is_reached(part, holds)),
        ["robot_at", place] => holds("at", &["robot", place]),
        [fluent, args @ ..] => holds(fluent, args),
        [] => false,
    }
}
