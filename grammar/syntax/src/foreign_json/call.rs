//! Calls in the manner of tools: another key for the callee, the arguments in an object of their own or in a
//! string, and objects around the call.

use serde_json::{Map, Value as Json};

use super::{
    ShapeReader, is_any, is_any_key, is_misspelt, member, pattern, quoted, replace, start, table, whole,
};
use crate::diagnostic::Edit;
use crate::located::{Located, LocatedValue};
use crate::source::Span;
use crate::words::{CALL_KEYS, is_bare_name, is_name};

/// A step in another shape, as the parts of its object that stay and the edits in them.
#[derive(Default)]
pub(super) struct CallShape {
    parts: Vec<Span>,
    edits: Vec<Edit>,
    /// Keys of the shape, without those of arguments.
    keys: Vec<String>,
    /// True if the shape is an ending and not a call.
    is_ending: bool,
    is_changed: bool,
}

impl ShapeReader<'_> {
    pub(super) fn call(&mut self, node: &Located<'_>) {
        let Some(shape) = self.call_shape(node) else { return };
        let mut edits = self.restructure(node.span, shape.parts);
        edits.extend(shape.edits);
        let read = if shape.is_ending { "`{\"end\": …}`" } else { "`{\"do\": …}`" };
        self.read_as(start(node), format!("`{{{}}}`", shape.keys.join(", ")), read, edits);
    }

    /// The shape of a step that is no form of the language; `None` if there is no such reading, or several.
    pub(super) fn call_shape(&self, node: &Located<'_>) -> Option<CallShape> {
        let mut shape = CallShape::default();
        let is_read = self.collect(node, Around::Steps, &mut shape)
            || self.single(node, &mut shape)
            || self.single_argument(node, &mut shape);
        (is_read && shape.is_changed).then_some(shape)
    }

    /// Collects the parts of a call. Returns `false` if the object does not name one callee.
    fn collect(&self, node: &Located<'_>, around: Around, shape: &mut CallShape) -> bool {
        let members = node.members();
        let mut with_arguments = members.iter().filter(|(key, _)| is_any(key, &table::ARGUMENTS));
        let arguments = match (with_arguments.next(), with_arguments.next()) {
            (Some((key, _)), None) => Some(key),
            _ => None,
        };
        let is_call = |value: &&(Located<'_>, Located<'_>)| {
            matches!(&value.1.value, LocatedValue::Object(_)) && !self.is_term(&value.1)
        };
        let callee = self.callee(node, arguments.is_some() || around == Around::Call);
        let mut wrappers = members.iter().filter(|(key, _)| is_any(key, &table::WRAPPERS)).filter(is_call);
        let wrapper = match (&callee, wrappers.next(), wrappers.next()) {
            (None, Some((key, _)), None) => Some(key),
            _ => None,
        };
        if callee.is_none() && wrapper.is_none() {
            return false;
        }
        let is_tool_call = arguments.is_some() || wrapper.is_some() || around == Around::Call;
        for (key, value) in members {
            let name = key.text().unwrap_or_default();
            let dots = if matches!(value.value, LocatedValue::Object(_)) { "{…}" } else { "…" };
            if callee == Some(key) {
                if name != "do" {
                    shape.edits.push(replace(key.span, quoted("do")));
                    shape.is_changed = true;
                }
                shape.parts.push(key.span.to(value.span));
            } else if wrapper == Some(key) {
                if !self.collect(value, Around::Call, shape) {
                    return false;
                }
                shape.is_changed = true;
            } else if arguments == Some(key) && self.arguments(value, callee, shape) {
                shape.is_changed = true;
            } else if is_tool_call && is_noise(key, value) {
                continue;
            } else {
                shape.parts.push(key.span.to(value.span));
                continue;
            }
            if around == Around::Steps {
                shape.keys.push(format!("{}: {dots}", quoted(name)));
            }
        }
        true
    }

    /// Key of the callee; `None` without one, or with several.
    fn callee<'n, 's>(&self, node: &'n Located<'s>, has_arguments: bool) -> Option<&'n Located<'s>> {
        let named = |key: &&str| {
            let (key, name) = member(node, key)?;
            let is_type = key.text() == Some("type") && is_any(name, &table::TYPES);
            (name.text().is_some_and(is_name) && !is_type).then_some(key)
        };
        let mut keys = table::CALLEES.iter().filter_map(named);
        match (named(&"do"), keys.next(), keys.next()) {
            (Some(own), ..) => Some(own),
            (None, Some(only), None) => Some(only),
            (None, None, _) => named(&table::NAME).filter(|_| has_arguments),
            (None, Some(_), Some(_)) => None,
        }
    }

    /// Collects arguments that have a value of their own. Returns `false` if that value may be an argument.
    fn arguments(&self, value: &Located<'_>, callee: Option<&Located<'_>>, shape: &mut CallShape) -> bool {
        let is_plain = callee.is_some_and(|key| key.text() == Some("do"));
        match &value.value {
            // Arguments in arguments are no shape of a call.
            LocatedValue::Object(_) if is_any_key(value, &table::ARGUMENTS) => false,
            LocatedValue::Object(members) if !is_plain || !self.is_term(value) => {
                shape.parts.extend(members.iter().map(whole));
                true
            }
            LocatedValue::Null => true,
            LocatedValue::Text(text) if !is_plain && text.trim().is_empty() => true,
            LocatedValue::Text(text) if !is_plain => {
                let Ok(members) = serde_json::from_str::<Map<String, Json>>(text) else { return false };
                let members: Vec<String> =
                    members.iter().map(|(key, value)| format!("{}: {value}", quoted(key))).collect();
                if !members.is_empty() {
                    shape.parts.push(value.span);
                    shape.edits.push(replace(value.span, members.join(", ")));
                }
                true
            }
            _ => false,
        }
    }

    /// Reads an ending with the key of its reason: `{"do": "cannot", "why": "…"}`. Returns `false` for
    /// anything else.
    pub(super) fn ending_call(&mut self, node: &Located<'_>, key: &Located<'_>, value: &Located<'_>) -> bool {
        let Some(kind) = value.text().and_then(|word| self.ending(word)) else { return false };
        let is_part = |(name, _): &(Located<'_>, Located<'_>)| name == key || name.text() == Some("why");
        if member(node, "why").is_none() || !node.members().iter().all(is_part) {
            return false;
        }
        let edits = vec![replace(key.span.to(value.span), format!("\"end\": {}", quoted(kind)))];
        self.read_as(start(node), pattern(node), "`{\"end\": …}`", edits);
        true
    }

    /// Reads a callee as the key of its only argument: `{"go": "user"}`, `{"detect": "mug", "as": "m"}`.
    fn single_argument(&self, node: &Located<'_>, shape: &mut CallShape) -> bool {
        let is_clause = |(key, _): &&(Located<'_>, Located<'_>)| is_any(key, &CALL_KEYS);
        let mut others = node.members().iter().filter(|member| !is_clause(member));
        let (Some((key, value)), None, None) = (others.next(), others.next(), member(node, "do")) else {
            return false;
        };
        let is_callee = |name: &&str| {
            is_bare_name(name)
                && self.ending(name).is_none()
                && !table::is_own(key)
                && !table::LABELS.contains(name)
                && !table::KINDS.contains(name)
                && (table::SHORT_CALLEES.contains(name) || !is_misspelt(name, &self.steps))
        };
        let Some(name) = key.text().filter(is_callee).filter(|_| value.text().is_some()) else {
            return false;
        };
        *shape = CallShape { is_changed: true, ..CallShape::default() };
        shape.keys.push(format!("{}: …", quoted(name)));
        shape.parts.extend(node.members().iter().map(whole));
        shape.edits.push(replace(key.span, format!("\"do\": {}, \"arg1\"", quoted(name))));
        true
    }

    /// Reads a callee, or an ending, as the only key: `{"pick": {"object": "mug_1"}}`, `{"fail": "why"}`.
    fn single(&self, node: &Located<'_>, shape: &mut CallShape) -> bool {
        let [(key, value)] = node.members() else { return false };
        let is_name = |name: &&str| is_bare_name(name) || self.ending(name).is_some();
        let Some(name) = key.text().filter(is_name).filter(|_| !table::is_own(key)) else { return false };
        let is_empty = match &value.value {
            LocatedValue::Object(members) => members.is_empty(),
            LocatedValue::Null | LocatedValue::Bool(true) => true,
            _ => false,
        };
        *shape = CallShape { is_changed: true, ..CallShape::default() };
        if let Some(kind) = self.ending(name) {
            let own = format!("\"end\": {}", quoted(kind));
            shape.is_ending = true;
            shape.keys.push(format!("{}: …", quoted(name)));
            shape.parts.push(key.span.to(value.span));
            if is_empty {
                shape.edits.push(replace(key.span.to(value.span), own));
            } else {
                shape.edits.push(replace(key.span, format!("{own}, \"why\"")));
            }
            return is_empty || value.text().is_some();
        }
        let is_plain = |(_, value): &(Located<'_>, Located<'_>)| match &value.value {
            LocatedValue::Array(items) => items.iter().all(|item| item.members().is_empty()),
            LocatedValue::Object(_) => self.is_term(value),
            _ => true,
        };
        let is_call = is_empty || !value.members().is_empty() && !self.is_term(value);
        shape.keys.push(format!("{}: {{…}}", quoted(name)));
        shape.parts.push(key.span);
        shape.parts.extend(value.members().iter().map(whole));
        shape.edits.push(replace(key.span, format!("\"do\": {}", quoted(name))));
        is_call
            && !is_misspelt(name, &self.steps)
            && value.members().iter().all(is_plain)
            && !is_any_key(value, &self.steps)
    }
}

/// Position of an object that may be a call.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Around {
    Steps,
    /// Inside of an object that says it is a call.
    Call,
}

/// Checks if a member of a call in the manner of tools says nothing about it.
fn is_noise(key: &Located<'_>, value: &Located<'_>) -> bool {
    let is_word = value.text().is_some();
    let is_label = is_word || matches!(value.value, LocatedValue::Number(_) | LocatedValue::Null);
    is_any(key, &table::NOISE) && is_label || is_any(key, &table::PROSE) && is_word
}
