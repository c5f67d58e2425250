//! Conditions in other shapes: a fluent as the key of its arguments, and other names of keys and operators.

use super::{
    ShapeReader, is_any, is_any_key, is_misspelt, member, pattern, quoted, replace, start, table, whole,
};
use crate::located::{Located, LocatedValue};
use crate::words::{is_bare_name, is_name, spelled};

impl ShapeReader<'_> {
    pub(super) fn condition(&mut self, node: &Located<'_>) {
        if self.is_term(node) {
            if let (Some((key, _)), None) = (member(node, "is"), member(node, "get")) {
                self.fluent(node, key);
            }
            return;
        }
        let named = node
            .members()
            .iter()
            .filter(|(key, name)| is_any(key, &table::FLUENTS) && name.text().is_some_and(is_bare_name));
        let named: Vec<_> = named.collect();
        match (named.as_slice(), node.members()) {
            ([(key, _)], _) => self.fluent(node, key),
            ([], [(key, value)]) => {
                let name = key.text().unwrap_or_default();
                let own = table::condition_key(name);
                if own == name { self.fact(node, key, value) } else { self.rename(key, own) }
            }
            _ => {}
        }
    }

    /// Reads a fluent with its name under `head`, and perhaps a key for all of its arguments.
    fn fluent(&mut self, node: &Located<'_>, head: &Located<'_>) {
        let mut edits = Vec::new();
        if head.text() != Some("is") {
            edits.push(replace(head.span, quoted("is")));
        }
        let mut parts = Vec::new();
        for (key, value) in node.members() {
            match &value.value {
                LocatedValue::Object(members) if is_any(key, &table::ARGUMENTS) && !self.is_term(value) => {
                    parts.extend(members.iter().map(whole));
                }
                _ => parts.push(key.span.to(value.span)),
            }
        }
        edits.extend(self.restructure(node.span, parts));
        if !edits.is_empty() {
            self.read_as(start(node), pattern(node), "`{\"is\": …}`", edits);
        }
    }

    /// Reads a fact as an object: `{"open": "fridge_1"}`.
    fn fact(&mut self, node: &Located<'_>, key: &Located<'_>, value: &Located<'_>) {
        let Some(name) = key.text().filter(|name| is_bare_name(name)) else { return };
        if is_misspelt(name, &self.terms) {
            return;
        }
        let args: Option<Vec<String>> = match &value.value {
            LocatedValue::Object(members) if !members.is_empty() => {
                if members.iter().all(|(_, value)| argument(value).is_some()) && !self.is_term(value) {
                    let parts = std::iter::once(key.span).chain(members.iter().map(whole));
                    let mut edits = self.restructure(node.span, parts);
                    edits.push(replace(key.span, format!("\"is\": {}", quoted(name))));
                    let read = format!("`{{\"is\": {}, …}}`", quoted(name));
                    self.read_as(start(node), pattern(node), read, edits);
                }
                return;
            }
            LocatedValue::Text(_) => argument(value).map(|arg| vec![arg]),
            LocatedValue::Array(items) => items.iter().map(argument).collect(),
            LocatedValue::Object(_) | LocatedValue::Null | LocatedValue::Bool(true) => Some(Vec::new()),
            LocatedValue::Bool(false) | LocatedValue::Number(_) | LocatedValue::Date => None,
        };
        let Some(args) = args else { return };
        let edits = vec![replace(node.span, quoted(&format!("{name}({})", args.join(", "))))];
        self.read_as(start(node), pattern(node), format!("`\"{name}(…)\"`"), edits);
    }

    /// Checks if an object is a condition or a term in the form of the language.
    pub(super) fn is_term(&self, node: &Located<'_>) -> bool {
        is_any_key(node, &self.terms)
    }
}

/// An argument of a fluent in the text syntax; `None` for what is no name.
fn argument(value: &Located<'_>) -> Option<String> {
    let name = value.text()?;
    let name = name.strip_prefix('$').unwrap_or(name);
    match name {
        "any" => Some(name.to_owned()),
        _ => is_name(name).then(|| spelled(name).into_owned()),
    }
}
