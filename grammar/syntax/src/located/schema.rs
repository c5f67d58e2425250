//! Comparison of a [`Located`] tree with a JSON Schema: reports every mismatch with its range, for documents
//! in JSON and TOML alike. Schemas are those that `schemars` derives: `$ref`, `type`, `properties`,
//! `required`, `additionalProperties`, `items`, `minItems` and `maxItems` that are equal, `minimum`, `enum`,
//! `const`, `anyOf` and `oneOf`.

use std::cell::RefCell;
use std::rc::Rc;

use rustc_hash::FxHashMap;
use serde_json::Value as Json;

use super::{Located, LocatedValue, Number, push_token};
use crate::ast::MAX_MISTAKES;
use crate::suggest;
use crate::words::DEADLINE;

/// A part of a document that does not fit its schema.
#[derive(Clone, Debug)]
pub struct Mismatch<'t> {
    /// The part: of an unknown key and of two forms the key, else the value.
    pub node: &'t Located<'t>,
    /// JSON Pointer of the part.
    pub pointer: String,
    pub kind: MismatchKind<'t>,
}

/// Ways in which a part of a document does not fit its schema.
#[derive(Clone, Debug)]
pub enum MismatchKind<'t> {
    /// The object does not know the key. Lists the keys that it knows.
    UnknownKey { object: &'t Located<'t>, known: Vec<&'t str> },
    /// The object lacks a required key.
    MissingKey { key: &'t str },
    /// The value has another type. Lists the JSON types that fit (`unsigned` is an integer from 0), or the
    /// words where only they do; `name` is the schema's where it has several forms of objects and nothing
    /// else.
    WrongType { types: Vec<&'t str>, words: Vec<&'t str>, name: Option<&'t str> },
    /// The array has another number of elements.
    WrongLength { expected: u64, found: usize },
    /// The number is below the least one, or above the greatest where there is one.
    OutOfRange { least: u64, greatest: Option<u64> },
    /// The string is no word of the enumeration.
    UnknownWord { known: Vec<&'t str> },
    /// No key of the object names one of its forms.
    NoForm { forms: Vec<&'t str> },
    /// A second key names a form too.
    TwoForms { first: &'t Located<'t> },
}

/// Compares a tree with a schema. Returns the mismatches in the order of the schema's objects, at most one
/// more than [`MAX_MISTAKES`]. O(tree × forms).
///
/// ```
/// # use motet_syntax::json;
/// #[derive(serde::Deserialize, schemars::JsonSchema)]
/// struct Mug {
///     mass: f64,
/// }
///
/// let source = motet_syntax::Source::new("mug.json", r#"{"mass": "heavy"}"#);
/// let (mug, diagnostics) = json::read::<Mug>(&source, motet_syntax::FileId(0));
/// assert!(mug.is_none());
/// assert_eq!(diagnostics[0].message, "expected a number, found the string `heavy`");
/// ```
#[must_use]
pub fn check_schema<'t>(tree: &'t Located<'t>, schema: &'t Json) -> Vec<Mismatch<'t>> {
    let view = SchemaView::new(schema);
    let mut check = SchemaCheck { view, pointer: String::new(), found: Vec::new() };
    check.value(tree, schema);
    check.found
}

struct SchemaCheck<'t> {
    view: SchemaView<'t>,
    pointer: String,
    found: Vec<Mismatch<'t>>,
}

/// A schema without `$ref` and alternatives, and the name of the definition that it comes from.
#[derive(Clone, Copy)]
pub(crate) struct Leaf<'t> {
    pub(crate) schema: &'t Json,
    pub(crate) name: Option<&'t str>,
}

/// A schema with its definitions.
pub(crate) struct SchemaView<'t> {
    root: &'t Json,
    /// Alternatives of each schema that was asked for, by its address.
    known: RefCell<FxHashMap<*const Json, Rc<[Leaf<'t>]>>>,
}

impl<'t> SchemaView<'t> {
    /// View of a whole schema.
    pub(crate) fn new(root: &'t Json) -> Self {
        Self { root, known: RefCell::default() }
    }

    /// The schema itself.
    pub(crate) fn root(&self) -> &'t Json {
        self.root
    }

    /// Definition with this name.
    pub(crate) fn definition(&self, name: &str) -> Option<&'t Json> {
        self.root.get("$defs").and_then(|definitions| definitions.get(name))
    }

    /// Keys that name the forms of an object with several.
    pub(crate) fn forms(&self, name: &str) -> Vec<&'t str> {
        let leaves = self.definition(name).map(|schema| self.leaves(schema)).unwrap_or_default();
        leaves.iter().filter_map(|leaf| form_key(leaf.schema)).collect()
    }

    /// Words of an enumeration.
    pub(crate) fn words(&self, name: &str) -> Vec<&'t str> {
        let leaves = self.definition(name).map(|schema| self.leaves(schema)).unwrap_or_default();
        leaves.iter().flat_map(|leaf| words(leaf.schema).unwrap_or_default()).collect()
    }

    /// Schema of a key; `None` for one that the object does not list.
    pub(crate) fn property(&self, schema: &'t Json, key: &str) -> Option<&'t Json> {
        property(schema, key)
    }

    /// Schema of the elements, if only a list of any length is accepted.
    pub(crate) fn list_items(&self, schema: &'t Json) -> Option<&'t Json> {
        let is_list = types(schema).iter().all(|kind| matches!(*kind, "array" | "null"));
        let is_fixed = schema.get("maxItems").is_some();
        schema.get("items").filter(|_| is_list && !is_fixed)
    }

    /// Checks if a schema accepts only `null`.
    pub(crate) fn is_null(&self, schema: &Json) -> bool {
        types(schema) == ["null"]
    }

    /// The alternatives of a schema, through `$ref`.
    pub(crate) fn leaves(&self, schema: &'t Json) -> Rc<[Leaf<'t>]> {
        if let Some(known) = self.known.borrow().get(&std::ptr::from_ref(schema)) {
            return Rc::clone(known);
        }
        let mut found = Vec::new();
        self.add_leaves(Leaf { schema, name: None }, &mut found);
        let found: Rc<[Leaf<'t>]> = found.into();
        self.known.borrow_mut().insert(schema, Rc::clone(&found));
        found
    }

    fn add_leaves(&self, leaf: Leaf<'t>, found: &mut Vec<Leaf<'t>>) {
        let Leaf { schema, name } = leaf;
        if let Some(pointer) =
            schema.get("$ref").and_then(Json::as_str).and_then(|target| target.strip_prefix('#'))
        {
            let name = name.or_else(|| pointer.rsplit('/').next());
            if let Some(schema) = self.root.pointer(pointer) {
                self.add_leaves(Leaf { schema, name }, found);
            }
            return;
        }
        match schema.get("anyOf").or_else(|| schema.get("oneOf")).and_then(Json::as_array) {
            Some(options) => options.iter().for_each(|schema| self.add_leaves(Leaf { schema, name }, found)),
            None => found.push(leaf),
        }
    }
}

impl<'t> SchemaCheck<'t> {
    fn value(&mut self, node: &'t Located<'t>, schema: &'t Json) {
        if self.found.len() > MAX_MISTAKES {
            return;
        }
        let leaves = self.view.leaves(schema);
        // An optional struct is a struct, not an object with several forms.
        let is_struct = leaves.iter().filter(|leaf| types(leaf.schema) != ["null"]).count() == 1;
        let fitting: Vec<Leaf<'t>> =
            leaves.iter().copied().filter(|leaf| accepts(leaf.schema, &node.value)).collect();
        match (&node.value, fitting.as_slice()) {
            (_, []) => self.report(node, wrong_type(&leaves)),
            (LocatedValue::Object(_), [only]) if is_struct || form_key(only.schema).is_none() => {
                self.object(node, only.schema);
            }
            (LocatedValue::Object(_), forms) => self.form(node, forms),
            (LocatedValue::Array(items), [leaf, ..]) => self.array(node, items, leaf.schema),
            (LocatedValue::Text(text), fitting) => {
                let mut known: Vec<&str> = Vec::new();
                for leaf in fitting {
                    // The value of a constant, such as a version, is checked by who reads it.
                    let is_constant = is_struct && leaf.schema.get("const").is_some();
                    let Some(words) = words(leaf.schema).filter(|_| !is_constant) else { return };
                    known.extend(words);
                }
                if !known.contains(&text.as_ref()) {
                    self.report(node, MismatchKind::UnknownWord { known });
                }
            }
            (LocatedValue::Number(number), [leaf, ..]) => {
                if let Some(problem) = out_of_range(*number, leaf.schema) {
                    self.report(node, problem);
                }
            }
            (_, [..]) => {}
        }
    }

    /// An object with several forms: the first key that names one decides, a deadline only if no other does.
    fn form(&mut self, node: &'t Located<'t>, forms: &[Leaf<'t>]) {
        let form_of = |key: &Located<'_>| forms.iter().find(|form| form_key(form.schema) == key.text());
        let mut named = node.members().iter().filter_map(|(key, _)| Some((key, form_of(key)?)));
        let decisive = named.clone().find(|(key, _)| key.text() != Some(DEADLINE)).or_else(|| named.next());
        let Some((first, form)) = decisive else {
            let heads = forms.iter().filter_map(|form| form_key(form.schema)).collect();
            return self.report(node, MismatchKind::NoForm { forms: heads });
        };
        let second = node.members().iter().map(|(key, _)| key).find(|key| {
            let is_key = |key: &str| property(form.schema, key).is_some() || is_open(form.schema).is_some();
            form_of(key).is_some() && key.text() != first.text() && !key.text().is_some_and(is_key)
        });
        match second {
            Some(second) => {
                let key = second.text().unwrap_or("");
                self.inside(key, |check| check.report(second, MismatchKind::TwoForms { first }));
            }
            None => self.object(node, form.schema),
        }
    }

    fn object(&mut self, node: &'t Located<'t>, schema: &'t Json) {
        for (key, value) in node.members() {
            let name = key.text().unwrap_or("");
            let inner = property(schema, name).or_else(|| is_open(schema));
            self.inside(name, |check| match inner {
                Some(inner) => check.value(value, inner),
                None => {
                    let known = properties(schema).collect();
                    check.report(key, MismatchKind::UnknownKey { object: node, known });
                }
            });
        }
        let required = schema.get("required").and_then(Json::as_array).into_iter().flatten();
        for key in required.filter_map(Json::as_str) {
            if !node.members().iter().any(|(known, _)| known.text() == Some(key)) {
                self.report(node, MismatchKind::MissingKey { key });
            }
        }
    }

    fn array(&mut self, node: &'t Located<'t>, items: &'t [Located<'t>], schema: &'t Json) {
        let bound = |key: &str| schema.get(key).and_then(Json::as_u64);
        if let Some(expected) = bound("maxItems").filter(|most| bound("minItems") == Some(*most))
            && items.len() as u64 != expected
        {
            return self.report(node, MismatchKind::WrongLength { expected, found: items.len() });
        }
        let Some(inner) = schema.get("items") else { return };
        for (index, item) in items.iter().enumerate() {
            self.inside(&index.to_string(), |check| check.value(item, inner));
        }
    }

    fn inside(&mut self, token: &str, check: impl FnOnce(&mut Self)) {
        let length = self.pointer.len();
        push_token(&mut self.pointer, token);
        check(self);
        self.pointer.truncate(length);
    }

    fn report(&mut self, node: &'t Located<'t>, kind: MismatchKind<'t>) {
        if self.found.len() > MAX_MISTAKES {
            return;
        }
        self.found.push(Mismatch { node, pointer: self.pointer.clone(), kind });
    }
}

/// JSON types that a schema without alternatives accepts; none where it accepts all.
fn types(schema: &Json) -> Vec<&str> {
    match schema.get("type") {
        Some(Json::String(kind)) => vec![kind],
        Some(Json::Array(kinds)) => kinds.iter().filter_map(Json::as_str).collect(),
        _ if words(schema).is_some() => vec!["string"],
        _ => Vec::new(),
    }
}

fn accepts(schema: &Json, value: &LocatedValue<'_>) -> bool {
    let is_whole = |number: &Number| !matches!(number, Number::Float(_));
    let types = types(schema);
    types.is_empty()
        || types.iter().any(|kind| match value {
            LocatedValue::Null => *kind == "null",
            LocatedValue::Bool(_) => *kind == "boolean",
            LocatedValue::Number(number) => *kind == "number" || *kind == "integer" && is_whole(number),
            LocatedValue::Text(_) => *kind == "string",
            LocatedValue::Date => false,
            LocatedValue::Array(_) => *kind == "array",
            LocatedValue::Object(_) => *kind == "object",
        })
}

/// Words of an enumeration of strings.
fn words(schema: &Json) -> Option<Vec<&str>> {
    if let Some(word) = schema.get("const").and_then(Json::as_str) {
        return Some(vec![word]);
    }
    schema.get("enum").and_then(Json::as_array).map(|words| words.iter().filter_map(Json::as_str).collect())
}

fn properties(schema: &Json) -> impl Iterator<Item = &str> {
    schema.get("properties").and_then(Json::as_object).into_iter().flatten().map(|(key, _)| key.as_str())
}

fn property<'t>(schema: &'t Json, key: &str) -> Option<&'t Json> {
    schema.get("properties").and_then(|properties| properties.get(key))
}

/// Schema of all keys that have no property of their own, where such keys are welcome.
fn is_open(schema: &Json) -> Option<&Json> {
    schema.get("additionalProperties").filter(|open| open.is_object() || **open == Json::Bool(true))
}

/// The key that names a form of an object: the first that it requires.
pub(crate) fn form_key(schema: &Json) -> Option<&str> {
    schema.get("required").and_then(Json::as_array).and_then(|keys| keys.first()).and_then(Json::as_str)
}

fn wrong_type<'t>(leaves: &[Leaf<'t>]) -> MismatchKind<'t> {
    let mut kinds: Vec<&str> = Vec::new();
    let known: Option<Vec<Vec<&str>>> = leaves.iter().map(|leaf| words(leaf.schema)).collect();
    if let Some(known) = known {
        return MismatchKind::WrongType { types: kinds, words: known.concat(), name: None };
    }
    for leaf in leaves {
        for kind in types(leaf.schema).into_iter().filter(|kind| *kind != "null") {
            let kind = if kind == "integer" && is_unsigned(leaf.schema) { "unsigned" } else { kind };
            if !kinds.contains(&kind) {
                kinds.push(kind);
            }
        }
    }
    let name = leaves.first().and_then(|leaf| leaf.name).filter(|_| leaves.len() > 1 && kinds == ["object"]);
    MismatchKind::WrongType { types: kinds, words: Vec::new(), name }
}

fn is_unsigned(schema: &Json) -> bool {
    schema.get("minimum").and_then(Json::as_f64) == Some(0.0)
}

fn out_of_range<'t>(number: Number, schema: &Json) -> Option<MismatchKind<'t>> {
    let least = schema.get("minimum").and_then(Json::as_f64).filter(|least| *least >= 0.0)?;
    let greatest = match schema.get("format").and_then(Json::as_str)? {
        "uint8" => u64::from(u8::MAX),
        "uint16" => u64::from(u16::MAX),
        "uint32" => u64::from(u32::MAX),
        _ => u64::MAX,
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "bounds of whole numbers from 0"
    )]
    let least = least as u64;
    match number {
        Number::Unsigned(value) if value < least => Some(MismatchKind::OutOfRange { least, greatest: None }),
        Number::Unsigned(value) if value > greatest => {
            Some(MismatchKind::OutOfRange { least, greatest: Some(greatest) })
        }
        Number::Signed(_) => Some(MismatchKind::OutOfRange { least, greatest: None }),
        Number::Unsigned(_) | Number::Float(_) => None,
    }
}

/// JSON types with their articles, as one phrase: "a string, a number or an array".
#[must_use]
pub(crate) fn phrase(types: &[&str], words: &[&str]) -> String {
    let mut parts: Vec<String> = Vec::new();
    for kind in types {
        match *kind {
            "string" => parts.push("a string".into()),
            "number" => parts.push("a number".into()),
            "integer" => parts.push("a whole number".into()),
            "unsigned" => parts.push("a whole number from 0".into()),
            "boolean" => parts.extend(["`true`".into(), "`false`".into()]),
            "array" => parts.push("an array".into()),
            "object" => parts.push("an object".into()),
            _ => parts.push("`null`".into()),
        }
    }
    parts.extend(words.iter().map(|word| format!("`{word}`")));
    suggest::listed(&parts)
}
