//! The words of the contract as calls of `contract.motet`: arguments by position become arguments by name.

use serde_json::{Map, Value, json};

use super::policy::Scope;
use super::row::Do;
use super::world::{Kind, Names};

/// What a reference of a plan stands for.
#[derive(Clone, Debug)]
pub(super) struct Bound {
    /// How the policy writes it: `$name`, or an id.
    pub(super) written: String,
    /// The entity behind it, where its step names one.
    pub(super) entity: Option<String>,
    /// Of a point: what it is a point of.
    of: Option<Value>,
    /// Whether it can stand where an entity is asked for.
    pub(super) is_entity: bool,
}

impl Bound {
    /// An entity by its id.
    pub(super) fn entity(id: String) -> Self {
        Self { written: id.clone(), entity: Some(id), of: None, is_entity: true }
    }
}

/// What a parameter takes.
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

/// What a call gives, where it gives something; the call itself is changed where its result decides which
/// is meant.
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

/// What a monitor does.
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
