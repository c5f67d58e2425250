//! Derivation of a JSON Schema from the grammar of the JSON syntax, in the subset that every server takes:
//! objects with all keys required and no others, strings with `const`, `enum` or an anchored pattern,
//! `anyOf`, `$ref` alone in its object, arrays and numbers with bounds.
//!
//! The productions of the grammar spell objects as bytes. They are read as a template: the literals between
//! two values hold the end of one key and the beginning of the next.

use rustc_hash::FxHashMap;
use serde_json::{Map, Value, json};
use smol_str::SmolStr;

use super::derive::Level;
use super::terminal::{TEXT_FIELDS, TEXT_TERMS};
use crate::grammar::{
    Alternative, BlockRole, CleanupOf, ConditionUse, Grammar, NodeKind, Part, Relation, ValueSet,
};
use crate::subset::{Decimal, MAX_CONDITION_DEPTH, MAX_ITEMS, MAX_MEMBERS, MAX_STEPS, NumberRange};

/// Derives the JSON Schema of a grammar of the JSON syntax.
pub(super) fn schema(grammar: &Grammar) -> Value {
    let mut deriver = Deriver { grammar, defs: Map::new(), values: Vec::new(), known: FxHashMap::default() };
    deriver.define("name", json!({"type": "string", "pattern": "^[a-zA-Z_][a-zA-Z0-9_]*$"}));
    deriver.define("binding", json!({"type": "string", "pattern": "^\\$[a-zA-Z_][a-zA-Z0-9_]*$"}));
    // Without a bound: one makes engines slow. The class is that of the subset, which needs no escape.
    // A brace is written twice, or holds a name.
    let name = "[a-zA-Z_][a-zA-Z0-9_]*";
    let terms = TEXT_TERMS.iter().filter(|term| grammar.has_term(term));
    let terms: String = terms.map(|term| format!(r"|{term}\(\${name}\)")).collect();
    let fields =
        if grammar.has_caught() { format!(r"|{name}\.({})", TEXT_FIELDS.join("|")) } else { String::new() };
    let braces = format!(r"\{{\{{|\}}\}}|\{{({name}{terms}{fields})\}}");
    let (first, rest) = (r"[ !#%-\[\]-z|~]", r"[ !#-\[\]-z|~]");
    let pattern = format!("^({first}|{braces})({rest}|{braces})*$");
    deriver.define("text", json!({"type": "string", "pattern": pattern}));
    let mut root = deriver.object("", &grammar.document, Level::of_policy(grammar));
    if let Value::Object(root) = &mut root {
        root.insert("$defs".to_owned(), Value::Object(deriver.defs));
    }
    root
}

struct Deriver<'g> {
    grammar: &'g Grammar,
    defs: Map<String, Value>,
    values: Vec<(ValueSet, Value)>,
    /// References to definitions by what they define: an engine compiles a schema faster by far, the less
    /// it repeats.
    known: FxHashMap<String, Value>,
}

fn reference(name: &str) -> Value {
    json!({"$ref": format!("#/$defs/{name}")})
}

fn one_of(mut shapes: Vec<Value>) -> Value {
    if shapes.len() == 1 { shapes.pop().unwrap_or_default() } else { json!({"anyOf": shapes}) }
}

fn array(item: Value, least: usize, most: usize) -> Value {
    json!({"type": "array", "items": item, "minItems": least, "maxItems": most})
}

fn words(words: &[impl AsRef<str>]) -> Value {
    match words {
        [only] => json!({"type": "string", "const": only.as_ref()}),
        words => {
            let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
            json!({"type": "string", "enum": words})
        }
    }
}

fn number(range: &NumberRange) -> Value {
    if range.decimals == 0 {
        return json!({"type": "integer", "minimum": range.least, "maximum": range.greatest});
    }
    let bound = |units: i64| {
        let value = Decimal { units, decimals: range.decimals }.value();
        // A whole bound without a decimal point, which some servers read as another type.
        if value.fract() == 0.0 { json!(value as i64) } else { json!(value) }
    };
    json!({"type": "number", "minimum": bound(range.least), "maximum": bound(range.greatest)})
}

/// Adds a required key behind the others of an object.
fn add_key(object: &mut Value, key: &str, shape: Value) {
    if let Some(Value::Object(properties)) = object.get_mut("properties") {
        properties.insert(key.to_owned(), shape);
    }
    if let Some(Value::Array(required)) = object.get_mut("required") {
        required.push(json!(key));
    }
}

/// The keys of an object so far.
#[derive(Default)]
struct Keys {
    properties: Map<String, Value>,
    /// Bytes that were not read yet.
    text: String,
}

impl Keys {
    /// Reads the text up to the key whose value comes next, with the values that are literals.
    fn key(&mut self) -> String {
        loop {
            let rest = self.text.trim_start_matches(['{', ',', '}', ']']);
            let Some((key, value)) = rest.strip_prefix('"').and_then(|rest| rest.split_once("\":")) else {
                self.text.clear();
                return String::new();
            };
            if value.is_empty() {
                let key = key.to_owned();
                self.text.clear();
                return key;
            }
            let end = match value.strip_prefix('"') {
                Some(string) => string.find('"').map_or(value.len(), |end| end + 2),
                None => value.find([',', '}']).unwrap_or(value.len()),
            };
            let (literal, behind) = value.split_at_checked(end).unwrap_or((value, ""));
            let shape = match serde_json::from_str::<Value>(literal) {
                Ok(Value::String(word)) => words(&[word]),
                Ok(Value::Number(version)) => json!({"type": "integer", "enum": [version]}),
                _ => json!({"type": "null"}),
            };
            self.properties.insert(key.to_owned(), shape);
            self.text = behind.to_owned();
        }
    }

    fn finish(mut self) -> Value {
        self.key();
        let required: Vec<&String> = self.properties.keys().collect();
        json!({
            "type": "object",
            "properties": self.properties,
            "required": required,
            "additionalProperties": false,
        })
    }
}

impl Deriver<'_> {
    fn define(&mut self, name: &str, shape: Value) -> Value {
        let clean = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
        let clean: String = name.chars().map(clean).collect();
        let (mut unique, mut count) = (clean.clone(), 1);
        while self.defs.contains_key(&unique) {
            count += 1;
            unique = format!("{clean}_{count}");
        }
        self.defs.insert(unique.clone(), shape);
        reference(&unique)
    }

    /// A definition that is made once.
    fn once(&mut self, name: String, make: impl FnOnce(&mut Self) -> Value) -> Value {
        if let Some(known) = self.known.get(&name) {
            return known.clone();
        }
        let shape = make(self);
        let shape = self.define(&name, shape);
        self.known.insert(name, shape.clone());
        shape
    }

    /// The object that a literal and parts spell.
    fn object(&mut self, lead: &str, parts: &[Part], level: Level) -> Value {
        let mut keys = Keys { text: lead.to_owned(), ..Keys::default() };
        for part in parts {
            let shape = match part {
                Part::Action(_) => continue,
                Part::Literal(text) => {
                    keys.text.push_str(text);
                    continue;
                }
                Part::OptionalNumber { lead, range } => {
                    keys.text.push_str(lead);
                    let name = format!("optional_{}_{}_{}", range.least, range.greatest, range.decimals);
                    self.once(name, |_| json!({"anyOf": [number(range), {"type": "null"}]}))
                }
                Part::Manner => {
                    keys.text.push_str(self.grammar.manner_lead());
                    let words = words(&["slowly", "gently"]);
                    let part = number(&NumberRange::PART);
                    self.once("manner".to_owned(), |_| json!({"anyOf": [words, part, {"type": "null"}]}))
                }
                Part::CaughtName => {
                    keys.text.push_str(",\"as\":");
                    let name = json!({"anyOf": [reference("name"), {"type": "null"}]});
                    self.once("optional_name".to_owned(), |_| name)
                }
                Part::ResultType => {
                    keys.text.push_str(",\"result\":");
                    let types = self.grammar.result_types();
                    let types: Vec<&SmolStr> = types.iter().map(|(_, name)| name).collect();
                    json!({"anyOf": [words(&types), {"type": "null"}]})
                }
                Part::Given { .. } => continue,
                // That of a step makes two objects of one: see `choice`.
                Part::Cleanup(CleanupOf::Step) => continue,
                Part::Cleanup(CleanupOf::Policy) => {
                    keys.text.push_str(",\"finally\":");
                    let blocks = level.of_cleanup().map(|level| self.block(level, 1));
                    one_of(blocks.into_iter().chain([json!({"type": "null"})]).collect())
                }
                // Objects whose `{"` was spelled before the choice.
                Part::Choice(_, alternatives) => {
                    let open = keys.text.strip_suffix("{\"").map(str::to_owned);
                    let lead = if open.is_some() { "{\"" } else { "" };
                    keys.text = open.unwrap_or(keys.text);
                    self.choice(lead, alternatives, level)
                }
                part => self.value(part, level),
            };
            let key = keys.key();
            keys.properties.insert(key, shape);
        }
        keys.finish()
    }

    fn choice(&mut self, lead: &str, alternatives: &[Alternative], level: Level) -> Value {
        let mut shapes = Vec::new();
        for alternative in Alternative::flattened(alternatives, lead) {
            let shape = match alternative.parts.as_slice() {
                [Part::Condition(asked)] => self.condition(*asked == ConditionUse::Goal),
                _ if alternative.literal == "null" => json!({"type": "null"}),
                [list @ Part::Repeat(_)] if alternative.literal == "[" => self.value(list, level),
                parts => {
                    let mark = if level.in_cleanup { "cleanup_" } else { "" };
                    let name = match alternative.is_composite() {
                        true => format!("{mark}{}_{}", alternative.name, level.depth),
                        false => alternative.name.to_string(),
                    };
                    // Nothing may be left out in JSON: a step has a cleanup, or it is another object.
                    let is_cleanup = |part: &&Part| matches!(part, Part::Cleanup(CleanupOf::Step));
                    if let (true, Some(inner)) =
                        (parts.iter().any(|part| is_cleanup(&part)), level.of_cleanup())
                    {
                        let cleaned = format!("{name}_cleaned");
                        let cleaned = self.once(cleaned, |deriver| {
                            let block = deriver.block(inner, 1);
                            let mut object = deriver.object(&alternative.literal, parts, level);
                            add_key(&mut object, "finally", block);
                            object
                        });
                        shapes.push(cleaned);
                    }
                    if parts.iter().any(|part| matches!(part, Part::Given { .. })) {
                        let giving = self.once(format!("{name}_result"), |deriver| {
                            let mut object = deriver.object(&alternative.literal, parts, level);
                            add_key(&mut object, "result", reference("binding"));
                            object
                        });
                        shapes.push(giving);
                    }
                    self.once(name, |deriver| deriver.object(&alternative.literal, parts, level))
                }
            };
            shapes.push(shape);
        }
        // `null` is the last, as engines expect of what may be missing.
        shapes.sort_by_key(|shape| shape.get("type").is_some_and(|ty| ty == "null"));
        one_of(shapes)
    }

    /// The shape of a part that is one value.
    fn value(&mut self, part: &Part, level: Level) -> Value {
        match part {
            Part::Name(_) => reference("name"),
            Part::Value { ty, range, place } => {
                let set = ValueSet::of(ty, *range, *place, level.in_goal, self.grammar);
                self.value_set(set)
            }
            Part::Number(range) => number(range),
            Part::Relation(ty) => {
                let relations: &[Relation] =
                    if ValueSet::is_ordered(ty) { &Relation::ALL } else { &Relation::EQUALITY };
                words(&relations.iter().map(|relation| relation.word()).collect::<Vec<_>>())
            }
            Part::Failures => self.once("kinds".to_owned(), |deriver| {
                // `any` may stand beside others, which says the same: alternatives would begin alike.
                let failures = &deriver.grammar.signatures.failures;
                let any = failures.iter().map(|name| name.as_str()).chain(["any"]);
                array(words(&any.collect::<Vec<_>>()), 1, MAX_MEMBERS)
            }),
            Part::ListName | Part::Caught => reference("binding"),
            Part::FailureKind => {
                self.once("failure".to_owned(), |deriver| words(&deriver.grammar.signatures.failures))
            }
            Part::EntityList => self.once("list".to_owned(), |deriver| {
                let binds = deriver.grammar.binds_lists();
                let mut lists: Vec<Value> = binds.then(|| reference("binding")).into_iter().collect();
                for names in deriver.grammar.entities_by_kind() {
                    lists.push(array(words(&names), 1, MAX_ITEMS));
                }
                one_of(lists)
            }),
            Part::Condition(asked) => self.condition(*asked == ConditionUse::Goal),
            Part::Block(role, least) => {
                let depth =
                    if *role == BlockRole::Body { level.depth } else { level.depth.saturating_sub(1) };
                self.block(Level { depth, ..level }, *least)
            }
            Part::Repeat(repeat) => {
                let item = match repeat.item.as_slice() {
                    [only] => self.value(only, level),
                    parts => self.object("", parts, level),
                };
                array(item, usize::from(repeat.least), usize::from(repeat.most))
            }
            Part::Literal(_) | Part::Action(_) | Part::OptionalNumber { .. } => Value::Null,
            Part::Manner | Part::Cleanup(_) | Part::CaughtName => Value::Null,
            Part::ResultType | Part::Given { .. } => Value::Null,
            Part::Choice(_, alternatives) => self.choice("", alternatives, level),
            // Nothing may be left out in JSON.
            Part::Optional { .. } => Value::Null,
        }
    }

    fn block(&mut self, level: Level, least: u32) -> Value {
        let mark = if level.in_cleanup { "cleanup_" } else { "" };
        let name = if least == 0 { "maybe_block" } else { "block" };
        self.once(format!("{mark}{name}_{}", level.depth), |deriver| {
            let step = deriver.step(level);
            array(step, least as usize, MAX_STEPS)
        })
    }

    fn value_set(&mut self, set: ValueSet) -> Value {
        if let Some((_, known)) = self.values.iter().find(|(known, _)| *known == set) {
            return known.clone();
        }
        let mut names: Vec<&str> = set.names.iter().map(|name| name.as_str()).collect();
        names.extend(set.any.then_some("any"));
        let mut shapes = Vec::new();
        if !names.is_empty() {
            shapes.push(words(&names));
        }
        shapes.extend(set.number.map(|range| number(&range)));
        shapes.extend(set.bool.then(|| json!({"type": "boolean"})));
        shapes.extend(set.text.then(|| reference("text")));
        shapes.extend(set.binding.then(|| reference("binding")));
        if set.first {
            shapes.push(self.once("first".to_owned(), |_| {
                let mut keys = Keys::default();
                keys.properties.insert("get".to_owned(), words(&["first"]));
                keys.properties.insert("of".to_owned(), reference("binding"));
                keys.finish()
            }));
        }
        if set.pose {
            shapes.push(self.once("pose".to_owned(), |_| {
                let [length, ..] = NumberRange::of_pose();
                let mut keys = Keys::default();
                keys.properties.insert("pose".to_owned(), array(number(&length), 4, 4));
                keys.finish()
            }));
        }
        if let Some(items) = &set.items {
            shapes.push(array(self.value_set((**items).clone()), 1, MAX_ITEMS));
        }
        let is_short = set.names.is_empty() && shapes.len() == 1;
        let shape = one_of(shapes);
        // A short shape, or one that is defined already, needs no definition of its own.
        let shape = if is_short { shape } else { self.define(&set.name, shape) };
        self.values.push((set, shape.clone()));
        shape
    }

    fn step(&mut self, level: Level) -> Value {
        let mark = if level.in_cleanup { "cleanup_" } else { "" };
        self.once(format!("{mark}step_{}", level.depth), |deriver| {
            let grammar = deriver.grammar;
            let steps = grammar.steps.iter().filter(|step| step.cleans || !level.in_cleanup);
            let (nested, plain): (Vec<_>, Vec<_>) = steps.cloned().partition(Alternative::is_composite);
            // Steps without steps are the same at each level.
            let plain =
                deriver.once(format!("{mark}plain_step"), |deriver| deriver.choice("{\"", &plain, level));
            if nested.is_empty() || level.depth == 0 {
                return one_of(vec![plain]);
            }
            let nested = deriver.choice("{\"", &nested, level);
            one_of(vec![plain, nested])
        })
    }

    fn condition(&mut self, in_goal: bool) -> Value {
        let prefix = if in_goal { "goal" } else { "condition" };
        self.nested_condition(prefix, MAX_CONDITION_DEPTH)
    }

    fn nested_condition(&mut self, prefix: &str, depth: usize) -> Value {
        self.once(format!("{prefix}_{depth}"), |deriver| {
            let (grammar, in_goal) = (deriver.grammar, prefix == "goal");
            let mut shapes = Vec::new();
            for atom in grammar.asked_atoms(in_goal) {
                let lead = format!("{{\"{}{}", atom.sort.lead(), atom.spelled.literal);
                let level = Level { depth: 0, in_goal, in_cleanup: false };
                let name = format!("{prefix}_{}", atom.spelled.name);
                shapes.push(deriver.once(name, |deriver| deriver.object(&lead, &atom.spelled.parts, level)));
            }
            if let Some(below) = depth.checked_sub(1) {
                let level = deriver.nested_condition(prefix, below);
                let several =
                    deriver.once(format!("{prefix}s_{depth}"), |_| array(level.clone(), 2, MAX_MEMBERS));
                for (kind, shape) in
                    [(NodeKind::Not, level), (NodeKind::All, several.clone()), (NodeKind::Any, several)]
                {
                    let [open, ..] = grammar.connective(kind).unwrap_or_default();
                    let mut keys = Keys::default();
                    keys.properties.insert(open.trim_matches(['{', '"', ':', '[']).to_owned(), shape);
                    shapes.push(keys.finish());
                }
            }
            json!({"anyOf": shapes})
        })
    }
}
