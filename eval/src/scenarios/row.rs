//! A row of `scenarios.jsonl`: its plan, its entities as an ordinary scene, and the facts at the start. Keys
//! that are not known are passed over; a step that is none is an error.

use indexmap::IndexMap;
use motet_compiler::InitialState;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::{Severity, Source, Sources, Span};
use serde::Deserialize;
use serde_json::{Map, Value, json};

/// Place of an object of which the row says nothing. No plan can name it.
const ELSEWHERE: &str = "(elsewhere)";

/// Kind of an entity of a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Kind {
    Place,
    Surface,
    Container,
    Object,
    Person,
}

/// The entities of a row by their names.
#[derive(Clone, Debug, Default)]
pub(super) struct Names(IndexMap<String, Kind>);

impl Names {
    pub(super) fn of(scene: &Map<String, Value>) -> Self {
        let mut names = Self::default();
        let keys =
            |key: &str| scene.get(key).and_then(Value::as_object).into_iter().flat_map(Map::keys).cloned();
        let listed = scene.get("places").and_then(Value::as_array).into_iter().flatten();
        let listed = listed.filter_map(Value::as_str).map(str::to_owned);
        names.add(keys("containers"), Kind::Container);
        names.add(keys("objects"), Kind::Object);
        names.add(keys("persons"), Kind::Person);
        names.add(keys("surfaces"), Kind::Surface);
        names.add(listed, Kind::Place);
        // What something is at, and what a turn faces, is a place, whether or not it is listed.
        let robot = scene.get("robot_at").and_then(Value::as_str);
        let faced = scene.get("turn_to").and_then(Value::as_object).into_iter().flat_map(Map::values);
        let things =
            ["objects", "persons", "containers"].iter().filter_map(|key| scene.get(*key)?.as_object());
        let things =
            things.flat_map(Map::values).flat_map(|thing| [thing.get("at"), thing.get("stand")]).flatten();
        let spots = faced.chain(things).filter_map(Value::as_str).chain(robot).map(str::to_owned);
        names.add(spots.collect::<Vec<_>>(), Kind::Place);
        names.add([ELSEWHERE.to_owned()], Kind::Place);
        names
    }

    fn add(&mut self, names: impl IntoIterator<Item = String>, kind: Kind) {
        for name in names {
            self.0.entry(name).or_insert(kind);
        }
    }

    pub(super) fn kind(&self, name: &str) -> Option<Kind> {
        self.0.get(name).copied()
    }

    pub(super) fn of_kind(&self, kind: Kind) -> impl Iterator<Item = &String> {
        self.0.iter().filter(move |(_, other)| **other == kind).map(|(name, _)| name)
    }

    pub(super) fn is_spot(&self, name: &str) -> bool {
        matches!(self.kind(name), Some(Kind::Place | Kind::Surface | Kind::Container))
    }
}

/// Properties of a thing in a row.
fn thing<'r>(row: &'r Row, name: &str) -> Option<&'r Map<String, Value>> {
    let tables = ["containers", "objects", "persons", "surfaces"].iter();
    tables.filter_map(|key| row.scene.get(*key)?.get(name)?.as_object()).next()
}

fn text<'v>(thing: Option<&'v Map<String, Value>>, key: &str) -> Option<&'v str> {
    thing?.get(key)?.as_str()
}

fn truth(thing: Option<&Map<String, Value>>, key: &str) -> Option<bool> {
    thing?.get(key)?.as_bool()
}

/// The entities as a scene document. Heights and distances are told as fields: a row gives no positions in
/// the room.
pub(super) fn document(row: &Row, names: &Names) -> Value {
    let held = row.scene.get("holding").and_then(Value::as_str);
    let mut entities = Vec::with_capacity(names.0.len());
    for (name, kind) in &names.0 {
        let about = thing(row, name);
        let mut entity = Map::new();
        entity.insert("id".into(), json!(name));
        entity.insert("kind".into(), json!(format!("{kind:?}")));
        for (from, to) in [("kind", "class"), ("mass", "mass"), ("width", "width")] {
            if let (Kind::Object, Some(value)) = (kind, about.and_then(|about| about.get(from))) {
                entity.insert(to.into(), value.clone());
            }
        }
        let mut fields = Map::new();
        for (part, key, field) in [
            ("pose", "z", "height"),
            ("pose", "d", "away"),
            ("handle", "z", "handle_height"),
            ("handle", "d", "handle_away"),
        ] {
            let value = about.and_then(|about| about.get(part)?.get(key));
            if let Some(value) = value.filter(|value| value.is_number()) {
                fields.insert(field.into(), value.clone());
            }
        }
        if let Some(width) = about.and_then(|about| about.get("free_width")).filter(|width| width.is_number())
        {
            fields.insert("free_width".into(), width.clone());
        }
        entity.insert("fields".into(), Value::Object(fields));
        let at = text(about, "at").filter(|_| *kind == Kind::Object && held != Some(name));
        match at.and_then(|at| Some((at, names.kind(at)?))) {
            Some((at, Kind::Surface)) => entity.insert("on".into(), json!(at)),
            Some((at, Kind::Container)) => entity.insert("in".into(), json!(at)),
            _ => None,
        };
        if *kind == Kind::Container {
            // What may be open or closed has a door; what is not known of it is not said.
            let open = truth(about, "open");
            if open.is_some() || about.is_some_and(|about| about.contains_key("handle")) {
                entity.insert("travel".into(), json!({"slide": {"axis": [1, 0, 0], "distance": 0.3}}));
                entity.insert("locked".into(), json!(truth(about, "locked").unwrap_or(false)));
            }
            if let Some(open) = open.filter(|_| truth(about, "unknown") != Some(true)) {
                entity.insert("open".into(), json!(open));
            }
        }
        entities.push(Value::Object(entity));
    }
    let robot = json!({"holding": held, "at": row.scene.get("robot_at").and_then(Value::as_str)});
    json!({"motet_scene": 1, "frame": "map", "robot": robot, "entities": entities})
}

/// The scene of a row.
pub(super) fn scene(row: &Row, names: &Names, sources: &mut Sources) -> Result<Scene, String> {
    let source = Source::new("scene.json", document(row, names).to_string());
    let file = sources.add(source.clone());
    let (scene, said) = motet_robots::scene::read(&source, file);
    match said.iter().find(|said| said.severity == Severity::Error) {
        Some(wrong) => Err(format!("the scene: {} {}", wrong.code, wrong.message)),
        None => scene.ok_or_else(|| "the scene cannot be read".to_owned()),
    }
}

/// A name in the text form.
fn quoted(name: &str) -> String {
    format!("`{name}`")
}

/// Facts in order, the later winning.
#[derive(Default)]
struct Facts(IndexMap<String, (Option<bool>, Span)>);

impl Facts {
    fn tell(&mut self, fluent: &str, args: &[&str], value: bool) {
        let key = format!("{fluent}({})", args.join(", "));
        self.0.shift_remove(&key);
        self.0.insert(key, (Some(value), Span::default()));
    }
}

/// The facts at the start that no scene tells.
pub(super) fn state(row: &Row, names: &Names, robot: &Robot) -> InitialState {
    let mut facts = Facts::default();
    let scene = &row.scene;
    let word = |key: &str| scene.get(key).and_then(Value::as_str);
    let flag = |key: &str| scene.get(key).and_then(Value::as_bool);
    facts.tell("legged", &["robot"], robot.base.drive == motet_robots::card::Drive::Legged);
    facts.tell("precise", &["robot"], row.profile == "fine" || word("vision") == Some("none"));
    facts.tell("stays", &["robot"], flag("search_in_place") == Some(true));
    facts.tell("standing", &["robot"], flag("awake") != Some(false));
    if let Some(posture) = word("posture") {
        let raised = matches!(posture, "start" | "start_pose" | "ready");
        facts.tell("folded", &["robot"], matches!(posture, "home" | "folded" | "carry"));
        facts.tell("raised", &["robot"], raised);
    }
    // A swap point within a step says so: `mid_place`.
    if let Some(point) = word("swap_point") {
        let within = ["mid", "during", "while"].iter().any(|word| point.starts_with(word));
        facts.tell("settled", &["robot"], !within);
    }
    places(row, names, &mut facts);
    let faced = scene.get("turn_to").and_then(Value::as_object).into_iter().flatten();
    for (side, spot) in faced.filter_map(|(side, spot)| Some((side, spot.as_str()?))) {
        if matches!(side.as_str(), "left" | "right" | "around") {
            facts.tell("faces", &[side, &quoted(spot)], true);
        }
    }
    for blocked in scene.get("blocked").and_then(Value::as_array).into_iter().flatten() {
        path_blocked(blocked, names, &mut facts);
    }
    let occupied =
        scene.get("occupied").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str);
    for spot in occupied.filter(|spot| names.is_spot(spot)) {
        facts.tell("full", &[&quoted(spot)], true);
    }
    for rule in scene.get("rules").and_then(Value::as_array).into_iter().flatten() {
        forbid(rule, names, &mut facts);
    }
    InitialState { facts: facts.0, ..InitialState::default() }
}

/// Facts about the places of things, about things under others, and about full places.
fn places(row: &Row, names: &Names, facts: &mut Facts) {
    let held = row.scene.get("holding").and_then(Value::as_str);
    let robot = row.scene.get("robot_at").and_then(Value::as_str);
    for (name, kind) in &names.0 {
        let about = thing(row, name);
        let at = match kind {
            Kind::Container => text(about, "stand").or(Some(name.as_str())),
            Kind::Place | Kind::Surface => Some(name.as_str()),
            Kind::Object => text(about, "at").or(Some(ELSEWHERE)).filter(|_| held != Some(name)),
            Kind::Person => text(about, "at"),
        };
        if let Some(at) = at {
            facts.tell("at", &[&quoted(name), &quoted(at)], true);
            // The robot is at every spot that it serves from where it stands.
            let serves = kind == &Kind::Container && robot == Some(at);
            let stands = robot == Some(name) && names.is_spot(name);
            if serves {
                facts.tell("at", &["robot", &quoted(name)], true);
            } else if stands {
                facts.tell("at", &["robot", &quoted(at)], true);
            }
        }
        if let Some(above) = text(about, "under").filter(|above| names.kind(above) == Some(Kind::Object)) {
            facts.tell("on", &[&quoted(above), &quoted(name)], true);
            facts.tell("clear", &[&quoted(name)], false);
        }
        if ["full", "occupied"].iter().any(|key| truth(about, key) == Some(true)) && names.is_spot(name) {
            facts.tell("full", &[&quoted(name)], true);
        }
    }
}

/// A path that is blocked: between two spots, or to one from everywhere.
fn path_blocked(path: &Value, names: &Names, facts: &mut Facts) {
    let ends: Vec<&str> = match path {
        Value::Array(ends) => ends.iter().filter_map(Value::as_str).collect(),
        Value::Object(ends) => ends.values().filter_map(Value::as_str).collect(),
        Value::String(end) if names.is_spot(end) => vec![end],
        Value::String(ends) => {
            ends.split(['-', '>', ',']).map(str::trim).filter(|end| !end.is_empty()).collect()
        }
        _ => Vec::new(),
    };
    if ends.iter().any(|end| !names.is_spot(end)) {
        return;
    }
    match ends.as_slice() {
        [only] => facts.tell("path_blocked", &["any", &quoted(only)], true),
        [one, other] => {
            facts.tell("path_blocked", &[&quoted(one), &quoted(other)], true);
            facts.tell("path_blocked", &[&quoted(other), &quoted(one)], true);
        }
        _ => {}
    }
}

/// A rule `no_VERB` and everything that it names.
fn forbid(rule: &Value, names: &Names, facts: &mut Facts) {
    let Some(verb) = rule.get("rule").and_then(Value::as_str).and_then(|rule| rule.strip_prefix("no_"))
    else {
        return;
    };
    if !VERBS.contains(&verb) {
        return;
    }
    let values = rule.as_object().into_iter().flat_map(Map::values);
    let named = values.flat_map(|value| value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice));
    let named = named.filter_map(Value::as_str).filter(|name| names.kind(name).is_some());
    let (spots, things): (Vec<_>, Vec<_>) = named.partition(|name| names.is_spot(name));
    if verb == "place" && !spots.is_empty() && !things.is_empty() {
        for (thing, spot) in things.iter().flat_map(|thing| spots.iter().map(move |spot| (thing, spot))) {
            facts.tell("kept_from", &[&quoted(thing), &quoted(spot)], true);
        }
        return;
    }
    for name in spots.iter().chain(&things) {
        facts.tell("forbidden", &[verb, &quoted(name)], true);
    }
}

/// The verbs that a rule or a point can name, as `contract.motet` declares them.
pub(super) const VERBS: &[&str] =
    &["go", "turn", "search", "detect", "ground", "pick", "place", "handover", "lift", "open", "close"];

/// A row; what the evaluation does not read is left out.
#[derive(Clone, Debug, Deserialize)]
pub(super) struct Row {
    pub(super) id: String,
    pub(super) robot: String,
    pub(super) profile: String,
    #[serde(default)]
    pub(super) scene: Map<String, Value>,
    plan: Vec<Value>,
    pub(super) verdict: String,
    #[serde(default)]
    pub(super) class: Option<String>,
    #[serde(default)]
    error_step: Value,
    /// Basis of the verdict: `static`, or `geometry`.
    #[serde(default)]
    pub(super) needs: Option<String>,
}

/// A step of a plan with its place in it.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Its number in the order of the plan, from 1: what comes first.
    pub(super) order: usize,
    /// Its path as a row writes it: `2.then.1`.
    pub(super) label: String,
    pub(super) step: Step,
}

/// A step of a plan.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Do(Do),
    If { condition: Value, then: Vec<Node>, otherwise: Vec<Node> },
    Retry { times: Value, body: Vec<Node>, on_fail: Vec<Node> },
    While { condition: Value, max: Value, body: Vec<Node> },
    Monitor { condition: Value, reaction: String, body: Vec<Node> },
    Parallel { branches: Vec<Vec<Node>> },
}

/// One primitive with its arguments by position.
#[derive(Clone, Debug)]
pub(super) struct Do {
    pub(super) op: String,
    pub(super) args: Vec<Value>,
    /// The reference that it binds, without its `$`.
    pub(super) binds: Option<String>,
    /// Between what a person can choose.
    pub(super) answers: Vec<Value>,
}

impl Row {
    /// The plan, each step with its place.
    pub(super) fn plan(&self) -> Result<Vec<Node>, String> {
        Reader::default().block(&self.plan, "")
    }

    /// The step that the row calls wrong.
    pub(super) fn error_step(&self) -> Option<String> {
        match &self.error_step {
            Value::String(text) => Some(text.clone()),
            Value::Number(number) => Some(number.to_string()),
            _ => None,
        }
    }
}

#[derive(Default)]
struct Reader {
    seen: usize,
}

impl Reader {
    fn block(&mut self, steps: &[Value], prefix: &str) -> Result<Vec<Node>, String> {
        let numbered = steps.iter().enumerate();
        numbered.map(|(index, step)| self.step(step, format!("{prefix}{}", index + 1))).collect()
    }

    fn part(&mut self, step: &Map<String, Value>, label: &str, key: &str) -> Result<Vec<Node>, String> {
        match step.get(key) {
            None | Some(Value::Null) => Ok(Vec::new()),
            Some(Value::Array(steps)) => self.block(steps, &format!("{label}.{key}.")),
            Some(_) => Err(format!("step {label}: `{key}` is no list of steps")),
        }
    }

    fn step(&mut self, step: &Value, label: String) -> Result<Node, String> {
        let Some(keys) = step.as_object() else { return Err(format!("step {label} is no object")) };
        self.seen += 1;
        let order = self.seen;
        let value = |key: &str| keys.get(key).cloned().unwrap_or_default();
        let step = if keys.contains_key("op") {
            Step::Do(primitive(keys, &label)?)
        } else if keys.contains_key("if") {
            let then = self.part(keys, &label, "then")?;
            Step::If { condition: value("if"), then, otherwise: self.part(keys, &label, "else")? }
        } else if keys.contains_key("retry") {
            let body = self.part(keys, &label, "body")?;
            Step::Retry { times: value("retry"), body, on_fail: self.part(keys, &label, "on_fail")? }
        } else if keys.contains_key("while") {
            let body = self.part(keys, &label, "body")?;
            Step::While { condition: value("while"), max: value("max"), body }
        } else if keys.contains_key("monitor") {
            let reaction = value("on").as_str().unwrap_or("pause").to_owned();
            Step::Monitor { condition: value("monitor"), reaction, body: self.part(keys, &label, "body")? }
        } else if let Some(branches) = keys.get("parallel").and_then(Value::as_array) {
            let mut list = Vec::with_capacity(branches.len());
            for (index, branch) in branches.iter().enumerate() {
                // A branch of one step may stand without its list.
                let steps = branch.as_array().map_or(std::slice::from_ref(branch), Vec::as_slice);
                list.push(self.block(steps, &format!("{label}.parallel.{}.", index + 1))?);
            }
            Step::Parallel { branches: list }
        } else {
            return Err(format!("step {label} is neither a primitive nor a control step"));
        };
        Ok(Node { order, label, step })
    }
}

fn primitive(keys: &Map<String, Value>, label: &str) -> Result<Do, String> {
    let Some(op) = keys.get("op").and_then(Value::as_str) else {
        return Err(format!("step {label}: `op` is no name"));
    };
    let list = |key: &str| match keys.get(key) {
        None | Some(Value::Null) => Vec::new(),
        Some(Value::Array(items)) => items.clone(),
        Some(only) => vec![only.clone()],
    };
    let binds = keys.get("as").and_then(Value::as_str).map(|name| name.trim_start_matches('$').to_owned());
    Ok(Do { op: op.to_owned(), args: list("args"), binds, answers: list("answers") })
}
