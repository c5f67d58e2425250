//! The words of the contract as calls of the language, and conditions of a plan and atoms of a goal in JSON.
//! A condition for which the contract has no fluent becomes a fluent of its own, such as `person_near(user)`:
//! nothing is known of it.

use indexmap::IndexMap;
use serde_json::{Map, Value, json};

use super::policy::Scope;
use super::row::{Do, Kind, Names};

/// Meaning of a reference of a plan.
#[derive(Clone, Debug)]
pub(super) struct Bound {
    /// Its form in the policy: `$name`, or an id.
    pub(super) written: String,
    /// The entity behind it, where its step names one.
    pub(super) entity: Option<String>,
    /// Of a point: what it is a point of.
    of: Option<Value>,
    /// True if it can stand for an entity.
    pub(super) is_entity: bool,
}

impl Bound {
    /// An entity by its id.
    pub(super) fn entity(id: String) -> Self {
        Self { written: id.clone(), entity: Some(id), of: None, is_entity: true }
    }
}

/// Type of a parameter.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Takes {
    /// An object; a name that is no id is a description of one.
    Object,
    /// Anything that has an id.
    Entity,
    /// A text: a description, a question.
    Text,
    /// A number, or a word.
    Plain,
}

/// The parameters of each word, by position, and the verb of a point that can stand for the first.
const WORDS: &[(&str, &[(&str, Takes)])] = &[
    ("go", &[("to", Takes::Entity)]),
    ("turn", &[("to", Takes::Plain)]),
    ("search", &[("what", Takes::Text)]),
    ("detect", &[("what", Takes::Text)]),
    ("ground", &[("what", Takes::Entity), ("use", Takes::Plain)]),
    ("pick", &[("object", Takes::Object)]),
    ("place", &[("to", Takes::Entity)]),
    ("handover", &[("to", Takes::Entity)]),
    ("lift", &[("by", Takes::Plain)]),
    ("open", &[("what", Takes::Entity)]),
    ("close", &[("what", Takes::Entity)]),
    ("ask", &[("question", Takes::Text)]),
    ("check", &[("what", Takes::Text)]),
    ("wait", &[("time", Takes::Plain)]),
];

/// Words that a plan may give more than they ask for.
const TALKATIVE: &[&str] = &["ask", "check"];

/// A call as steps of the policy, and what the reference that it binds stands for. `number` gives each
/// binding its own.
pub(super) fn call(
    call: &Do,
    names: &Names,
    scope: &Scope,
    number: &mut dyn FnMut() -> usize,
) -> (Vec<Value>, Option<Bound>) {
    if call.op == "done" {
        return (vec![json!({"end": "done"})], None);
    }
    let params = WORDS.iter().find(|(word, _)| *word == call.op).map_or(&[][..], |(_, params)| *params);
    let mut steps = Vec::new();
    let mut args = Map::new();
    for (index, arg) in call.args.iter().enumerate() {
        match params.get(index) {
            Some((param, takes)) => {
                let value = argument(arg, *takes, &call.op, names, scope, number, &mut steps);
                args.insert((*param).to_owned(), value);
            }
            None if TALKATIVE.contains(&call.op.as_str()) => {}
            // No parameter takes it: the compiler is to say so.
            None => {
                args.insert(format!("arg{}", index + 1), arg.clone());
            }
        }
    }
    let mut step = Map::new();
    step.insert("do".to_owned(), json!(call.op));
    step.append(&mut args);
    let bound = call.binds.as_ref().and_then(|reference| {
        let bound = result(call, &mut step, names, scope, format!("{}_{}", plain(reference), number()))?;
        step.insert("as".to_owned(), json!(bound.written.trim_start_matches('$')));
        Some(bound)
    });
    if call.binds.is_none() && call.op == "detect" {
        // What is detected decides which `detect` is meant, also where its result is not kept.
        result(call, &mut step, names, scope, String::new());
    }
    steps.push(Value::Object(step));
    (steps, bound)
}

/// Letters, digits and `_` of a name.
fn plain(name: &str) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    format!("r_{}", name.chars().map(letter).collect::<String>())
}

fn argument(
    arg: &Value,
    takes: Takes,
    op: &str,
    names: &Names,
    scope: &Scope,
    number: &mut dyn FnMut() -> usize,
    steps: &mut Vec<Value>,
) -> Value {
    let Some(text) = arg.as_str() else {
        return if takes == Takes::Text { json!(arg.to_string()) } else { arg.clone() };
    };
    if let Some(reference) = text.strip_prefix('$') {
        let Some(bound) = scope.find(reference) else { return json!(text) };
        return match (&bound.of, &bound.entity, takes) {
            (Some(of), ..) if op != "ground" => {
                steps.push(json!({"do": "aim", "at": bound.written, "use": op}));
                of.clone()
            }
            (_, Some(entity), Takes::Text) => json!(entity),
            _ => json!(bound.written),
        };
    }
    if takes == Takes::Object && names.kind(text).is_none() {
        let found = format!("found_{}", number());
        steps.push(json!({"do": "find", "what": text, "as": found}));
        return json!(format!("${found}"));
    }
    // In a text a `$` of its own is doubled; here none begins with one.
    json!(text)
}

/// Result of a call, if it has one; the call itself is changed where its result decides which is meant.
fn result(
    call: &Do,
    step: &mut Map<String, Value>,
    names: &Names,
    scope: &Scope,
    name: String,
) -> Option<Bound> {
    let first = call.args.first().and_then(Value::as_str).unwrap_or_default();
    let named = match first.strip_prefix('$') {
        Some(reference) => scope.find(reference).and_then(|bound| bound.entity.clone()),
        None => names.kind(first).map(|_| first.to_owned()),
    };
    let written = format!("${name}");
    let thing = |entity| Bound { written: written.clone(), entity, of: None, is_entity: true };
    match call.op.as_str() {
        "search" => Some(thing(named)),
        "detect" => {
            let which = match named.as_deref().and_then(|name| names.kind(name)) {
                Some(Kind::Container) => "detect_container",
                Some(Kind::Person) => "detect_person",
                Some(Kind::Object | Kind::Surface | Kind::Place) | None => "detect",
            };
            step.insert("do".to_owned(), json!(which));
            Some(thing(named))
        }
        "ground" => {
            let of = step.get("what").cloned().unwrap_or_default();
            Some(Bound { written, entity: None, of: Some(of), is_entity: true })
        }
        "ask" => Some(choice(call, step, names, written)),
        "check" => Some(Bound { written, entity: None, of: None, is_entity: false }),
        "go" | "turn" | "pick" | "place" | "handover" | "lift" | "open" | "close" | "wait" | "home"
        | "start_pose" | "wake_up" => None,
        // A word that the compiler does not know may give anything.
        _ => Some(thing(None)),
    }
}

/// A question with answers that are things is a choice between them; one without answers, between all
/// objects.
fn choice(call: &Do, step: &mut Map<String, Value>, names: &Names, written: String) -> Bound {
    let answers: Vec<&str> = call.answers.iter().filter_map(Value::as_str).collect();
    let all = |fits: &dyn Fn(&str) -> bool| !answers.is_empty() && answers.iter().all(|answer| fits(answer));
    let objects: Vec<&str> = names.of_kind(Kind::Object).map(String::as_str).collect();
    let (word, among) = if call.answers.is_empty() && !objects.is_empty() {
        ("choose", objects)
    } else if all(&|answer| names.kind(answer) == Some(Kind::Object)) {
        ("choose", answers.clone())
    } else if all(&|answer| names.is_spot(answer)) {
        ("choose_spot", answers.clone())
    } else {
        return Bound { written, entity: None, of: None, is_entity: false };
    };
    step.insert("do".to_owned(), json!(word));
    step.insert("among".to_owned(), json!(among));
    step.entry("question").or_insert_with(|| json!("Which?"));
    Bound { written, entity: None, of: None, is_entity: true }
}

/// Reaction of a monitor.
pub(super) fn reaction(word: &str) -> Value {
    match word {
        "pause" => json!({"react": "pause"}),
        "replan" => json!({"end": "replan", "why": "a monitor fired"}),
        "ask" => {
            json!({"react": "resume", "at_most": 1, "steps": [{"do": "ask", "question": "Shall I go on?"}]})
        }
        _ => json!({"end": "fail", "why": "a monitor fired"}),
    }
}

/// The parameters of a fluent of one's own.
const PARAMS: [&str; 4] = ["a", "b", "c", "d"];

/// Translates conditions and remembers which fluents they need.
#[derive(Clone, Debug)]
pub(super) struct Conditions<'n> {
    names: &'n Names,
    /// Fluents to declare, with their number of parameters.
    fluents: IndexMap<String, usize>,
}

impl<'n> Conditions<'n> {
    pub(super) fn new(names: &'n Names) -> Self {
        Self { names, fluents: IndexMap::new() }
    }

    pub(super) fn into_fluents(self) -> IndexMap<String, usize> {
        self.fluents
    }

    /// Makes sure that there is a fluent of a name that something is watched by.
    pub(super) fn declare(&mut self, text: &str) {
        let (name, args) = split_call(text);
        let name = word(&name);
        if fixed(&name, &[]).is_none() && !KNOWN.contains(&name.as_str()) {
            self.fluents.entry(name).or_insert(args.len().min(PARAMS.len()));
        }
    }

    /// Several conditions, or one.
    pub(super) fn list(&mut self, value: &Value, scope: &Scope) -> Vec<Value> {
        match value.as_array() {
            Some(list) if list.iter().all(|item| item.as_str().is_some_and(|text| text.contains('('))) => {
                list.iter().map(|item| self.value(item, scope)).collect()
            }
            _ => vec![self.value(value, scope)],
        }
    }

    /// A condition of a plan.
    pub(super) fn value(&mut self, value: &Value, scope: &Scope) -> Value {
        match value {
            Value::String(text) => self.text(text, scope),
            Value::Bool(value) => json!(value),
            other => self.atom(other, scope),
        }
    }

    fn text(&mut self, text: &str, scope: &Scope) -> Value {
        let text = text.trim();
        for (word, key) in [(" or ", "any"), (" and ", "all")] {
            if text.contains(word) {
                let parts: Vec<_> = text.split(word).map(|part| self.text(part, scope)).collect();
                return json!({key: parts});
            }
        }
        if let Some(inner) = text.strip_prefix("not ").or_else(|| text.strip_prefix('!')) {
            return json!({"not": self.text(inner, scope)});
        }
        let (name, args) = split_call(text);
        self.fact(&name, &args, scope)
    }

    /// An atom of a goal.
    pub(super) fn atom(&mut self, atom: &Value, scope: &Scope) -> Value {
        let parts = atom.as_array().map(Vec::as_slice).unwrap_or_default();
        let Some((Value::String(name), rest)) = parts.split_first() else {
            return self.text(&atom.to_string(), scope);
        };
        match name.as_str() {
            "not" => json!({"not": rest.first().map(|inner| self.value(inner, scope))}),
            "or" | "any" => {
                json!({"any": rest.iter().map(|part| self.value(part, scope)).collect::<Vec<_>>()})
            }
            "and" | "all" => {
                json!({"all": rest.iter().map(|part| self.value(part, scope)).collect::<Vec<_>>()})
            }
            _ => {
                let args: Vec<String> = rest.iter().filter_map(Value::as_str).map(str::to_owned).collect();
                self.fact(name, &args, scope)
            }
        }
    }

    fn fact(&mut self, name: &str, args: &[String], scope: &Scope) -> Value {
        let name = word(name);
        let written: Vec<_> = args.iter().filter_map(|arg| self.entity(arg, scope)).collect();
        if written.len() == args.len()
            && let Some(fact) = fixed(&name, &written)
        {
            return fact;
        }
        // A fluent of the contract that is not used as it is declared there cannot be declared again.
        let name = if KNOWN.contains(&name.as_str()) { format!("{name}_seen") } else { name };
        let count = *self.fluents.entry(name.clone()).or_insert(written.len().min(PARAMS.len()));
        if count > written.len() {
            let other = format!("{name}_{}", written.len());
            self.fluents.entry(other.clone()).or_insert(written.len());
            return own(&other, &written, written.len());
        }
        own(&name, &written, count)
    }

    /// An argument as the policy writes it, where it is an entity.
    fn entity(&self, arg: &str, scope: &Scope) -> Option<String> {
        match arg.strip_prefix('$') {
            None => self.names.kind(arg).map(|_| arg.to_owned()),
            Some(reference) => match scope.find(reference) {
                Some(bound) => bound.is_entity.then(|| bound.written.clone()),
                None => Some(arg.to_owned()),
            },
        }
    }
}

/// Fluents that the contract or the standard library declares.
const KNOWN: &[&str] = &[
    "open",
    "closed",
    "holding",
    "at",
    "in",
    "on",
    "robot_at",
    "free",
    "locked",
    "clear",
    "near",
    "visible",
    "located",
    "reachable",
    "standing",
    "visited",
    "lifted",
    "full",
    "fresh",
    "stale",
    "serves",
    "part",
    "faces",
    "folded",
    "raised",
    "settled",
    "legged",
    "precise",
    "stays",
    "forbidden",
    "kept_from",
    "path_blocked",
    "monitored",
];

/// A fact that the contract has a fluent for.
fn fixed(name: &str, args: &[String]) -> Option<Value> {
    Some(match (name, args) {
        ("open", [what]) => json!({"is": "open", "container": what}),
        ("closed", [what]) => json!({"not": {"is": "open", "container": what}}),
        ("locked", [what]) => json!({"is": "locked", "container": what}),
        ("holding", [what]) => json!({"is": "holding", "object": what}),
        ("holding", []) => json!({"not": {"is": "free", "hand": "hand"}}),
        ("empty_hand" | "hand_empty" | "gripper_empty" | "free", []) => json!({"is": "free", "hand": "hand"}),
        ("at" | "in" | "on", [what, spot]) => json!({"is": "at", "what": what, "where": spot}),
        ("robot_at", [spot]) => json!({"is": "at", "what": "robot", "where": spot}),
        _ => return None,
    })
}

fn own(name: &str, args: &[String], count: usize) -> Value {
    let mut fact = Map::new();
    fact.insert("is".to_owned(), json!(name));
    for (param, arg) in PARAMS.iter().zip(args).take(count) {
        fact.insert((*param).to_owned(), json!(arg));
    }
    Value::Object(fact)
}

/// A name of the language: letters, digits and `_`, a letter first.
fn word(text: &str) -> String {
    let letters: String =
        text.trim().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let plain = letters.starts_with(|c: char| c.is_ascii_alphabetic());
    if plain { letters } else { format!("condition_{letters}") }
}

/// `name(a, b)` apart.
fn split_call(text: &str) -> (String, Vec<String>) {
    let Some((name, rest)) = text.split_once('(') else { return (text.to_owned(), Vec::new()) };
    let Some((inside, after)) = rest.rsplit_once(')') else { return (text.to_owned(), Vec::new()) };
    if !after.trim().is_empty() {
        return (text.to_owned(), Vec::new());
    }
    let args = inside.split(',').map(|arg| arg.trim().to_owned()).filter(|arg| !arg.is_empty());
    (name.to_owned(), args.collect())
}

/// The declarations of fluents of one's own.
pub(super) fn declarations(fluents: &IndexMap<String, usize>) -> String {
    let declare = |(name, count): (&String, &usize)| {
        let params: Vec<_> = PARAMS.iter().take(*count).map(|param| format!("{param}: Entity")).collect();
        format!("fluent `{name}`({})\n", params.join(", "))
    };
    fluents.iter().map(declare).collect()
}
