//! Conditions of a plan, `not open(drawer)`, and atoms of a goal, `["at", "apple", "shelf"]`, in the JSON
//! form.
//!
//! What the contract has no fluent for becomes one of its own, of which nothing is known:
//! `person_near(user)`.

use indexmap::IndexMap;
use serde_json::{Map, Value, json};

use super::policy::Scope;
use super::world::Names;

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
        let (name, args) = call(text);
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
        let (name, args) = call(text);
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
fn call(text: &str) -> (String, Vec<String>) {
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
