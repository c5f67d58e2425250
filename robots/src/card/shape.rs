//! Whether a document has the keys and the types of a card: the wire types' own schema, walked over the TOML tree, so
//! that every wrong key is told at once and each at its place.

use motet_syntax::{Diagnostic, FileId, Span, suggest};
use serde_json::Value as Json;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::errors::{MissingKey, UnknownKey, UnknownWord, WrongType};
use super::wire::schema;

/// What of the document does not fit the schema of a card.
pub(super) fn check(document: &Spanned<DeTable<'_>>, file: FileId) -> Vec<Diagnostic> {
    let schema = schema().to_value();
    let mut walk = Walk { root: &schema, file, found: Vec::new() };
    walk.table(document.get_ref(), Span::new(file, 0, 0), &schema, "");
    walk.found
}

struct Walk<'s> {
    root: &'s Json,
    file: FileId,
    found: Vec<Diagnostic>,
}

impl<'s> Walk<'s> {
    fn span<T>(&self, value: &Spanned<T>) -> Span {
        let range = value.span();
        Span::new(self.file, range.start, range.end)
    }

    /// `path` is the dotted key as the user writes it, empty for the whole card.
    fn table(&mut self, table: &DeTable<'_>, span: Span, schema: &'s Json, path: &str) {
        let properties = schema.get("properties").and_then(Json::as_object);
        let open = schema.get("additionalProperties").filter(|open| open.is_object());
        for (key, value) in table {
            let name: &str = key.get_ref();
            let inner = properties.and_then(|properties| properties.get(name)).or(open);
            let Some(inner) = inner else {
                let known = || properties.into_iter().flatten().map(|(known, _)| known.as_str());
                let near = suggest::closest(name, known()).map(str::to_owned);
                let known = known().filter(|known| table.get(*known).is_none()).map(str::to_owned).collect();
                self.found
                    .push(UnknownKey { span: self.span(key), key: name.to_owned(), near, known }.into());
                continue;
            };
            let path = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
            self.value(value, inner, &path);
        }
        let required = schema.get("required").and_then(Json::as_array).into_iter().flatten();
        for key in required.filter_map(Json::as_str).filter(|key| table.get(*key).is_none()) {
            self.found.push(MissingKey { span, key: key.to_owned(), section: path.to_owned() }.into());
        }
    }

    fn value(&mut self, value: &Spanned<DeValue<'_>>, schema: &'s Json, path: &str) {
        let schema = self.resolved(schema);
        let span = self.span(value);
        if let Some(words) = words(schema) {
            return self.word(value, &words, path);
        }
        let kinds = self.kinds(schema);
        let (found, name) = kind(value.get_ref());
        if !kinds.iter().any(|wanted| *wanted == name || *wanted == "number" && name == "integer") {
            let wanted: Vec<&str> = kinds.iter().map(|kind| told(kind)).collect();
            let key = path.to_owned();
            self.found
                .push(WrongType { span, key, found: found.to_owned(), wanted: wanted.join(" or ") }.into());
            return;
        }
        match value.get_ref() {
            DeValue::Table(table) => self.table(table, span, schema, path),
            DeValue::Array(items) => {
                let Some(inner) = schema.get("items") else { return };
                for item in items.iter() {
                    self.value(item, inner, path);
                }
            }
            DeValue::String(_)
            | DeValue::Integer(_)
            | DeValue::Float(_)
            | DeValue::Boolean(_)
            | DeValue::Datetime(_) => {}
        }
    }

    fn word(&mut self, value: &Spanned<DeValue<'_>>, words: &[&str], path: &str) {
        let span = self.span(value);
        let found = kind(value.get_ref()).0.to_owned();
        let Some(word) = value.get_ref().as_str() else {
            let wanted = suggest::one_of(words.iter().copied());
            return self.found.push(WrongType { span, key: path.to_owned(), found, wanted }.into());
        };
        if !words.contains(&word) {
            let near = suggest::closest(word, words.iter().copied()).map(str::to_owned);
            let known = words.iter().map(|word| (*word).to_owned()).collect();
            self.found.push(UnknownWord { span, word: word.to_owned(), near, known }.into());
        }
    }

    /// Follows `$ref`.
    fn resolved(&self, schema: &'s Json) -> &'s Json {
        let pointer = schema.get("$ref").and_then(Json::as_str).and_then(|target| target.strip_prefix('#'));
        pointer.and_then(|pointer| self.root.pointer(pointer)).unwrap_or(schema)
    }

    /// The JSON types that a schema takes.
    fn kinds(&self, schema: &'s Json) -> Vec<&'s str> {
        match (schema.get("type"), schema.get("anyOf").and_then(Json::as_array)) {
            (Some(Json::String(kind)), _) => vec![kind],
            (Some(Json::Array(kinds)), _) => kinds.iter().filter_map(Json::as_str).collect(),
            (_, Some(options)) => {
                options.iter().flat_map(|option| self.kinds(self.resolved(option))).collect()
            }
            (_, None) => Vec::new(),
        }
    }
}

/// The words of an enumeration.
fn words(schema: &Json) -> Option<Vec<&str>> {
    if let Some(options) = schema.get("oneOf").and_then(Json::as_array) {
        return options.iter().map(|option| option.get("const").and_then(Json::as_str)).collect();
    }
    schema.get("enum").and_then(Json::as_array).map(|words| words.iter().filter_map(Json::as_str).collect())
}

/// What a value is, for people and for a schema.
fn kind(value: &DeValue<'_>) -> (&'static str, &'static str) {
    match value {
        DeValue::String(_) => ("a text", "string"),
        DeValue::Integer(_) => ("a whole number", "integer"),
        DeValue::Float(_) => ("a number", "number"),
        DeValue::Boolean(_) => ("a truth value", "boolean"),
        DeValue::Datetime(_) => ("a date", "date"),
        DeValue::Array(_) => ("a list", "array"),
        DeValue::Table(_) => ("a section", "object"),
    }
}

fn told(kind: &str) -> &str {
    match kind {
        "string" => "a text",
        "integer" => "a whole number",
        "number" => "a number",
        "boolean" => "a truth value",
        "array" => "a list",
        "object" => "a section",
        other => other,
    }
}
