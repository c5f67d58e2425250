//! Shapes of JSON that models write in place of those of the language, such as calls in the manner of tools.
//!
//! Used only where the plain reading has errors, and only for objects that it refuses: a primitive may have a
//! parameter `args` or `action`. Each shape is an edit of the document. The edited document is read like any
//! other, and the same edits are the fix of the note (M0122). A shape that could be read in two ways is left
//! as it is, and stays an error. The words are in [`table`].

mod call;
mod condition;
mod document;
mod step;
mod table;
mod worded;

use serde_json::Value as Json;

use crate::ast::{MAX_MISTAKES, MAX_STEPS};
use crate::diagnostic::{Diagnostic, Edit, Fix};
use crate::diagnostics::ReadShape;
use crate::located::{Leaf, Located, LocatedValue, SchemaView, form_key};
use crate::source::Span;
use crate::words::{DEADLINE, is_bare_name};

use crate::json::EditedText;
use worded::{WordedStep, text_steps};

/// Reads the shapes of a document without syntax errors. Returns the document in the form of the language,
/// and a note for each sort of shape; `None` if it has no such shape, or more of them than are read.
/// O(document × forms).
pub(crate) fn plain_form(
    tree: &Located<'_>,
    text: &str,
    schema: &Json,
) -> Option<(EditedText, Vec<Diagnostic>)> {
    let is_long =
        |node: &Located<'_>| matches!(&node.value, LocatedValue::Array(items) if items.len() > MAX_STEPS);
    if is_long(tree) || tree.members().iter().any(|(_, value)| is_long(value)) {
        return None;
    }
    let view = SchemaView::new(schema);
    let (mut steps, terms) = (view.forms("Step"), view.forms("Form"));
    steps.retain(|key| *key != DEADLINE);
    let mut reader = ShapeReader { view, steps, terms, text, readings: Vec::new(), edits: 0 };
    reader.document(tree);
    if reader.is_full() {
        return None;
    }
    let mut edits: Vec<Edit> =
        reader.readings.iter().flat_map(|reading| reading.edits.iter().cloned()).collect();
    let edited = EditedText::new(text, &mut edits)?;
    Some((edited, reader.readings.into_iter().map(Reading::note).collect()))
}

/// The most edits of a document: a step in another shape takes up to five, and its terms take more.
const MAX_EDITS: usize = 500_000;

/// All places of a document that are read in one way.
struct Reading {
    /// The shape as it is written, and as it is read.
    written: String,
    read: String,
    /// First of the places.
    span: Span,
    count: usize,
    edits: Vec<Edit>,
}

impl Reading {
    fn note(self) -> Diagnostic {
        let Self { written, read, span, count, edits } = self;
        let title = if read == table::IGNORED { "remove it".to_owned() } else { format!("write {read}") };
        let fix = Fix { title, edits };
        ReadShape { span, written, read, more: count.saturating_sub(1), fix }.into()
    }
}

struct ShapeReader<'t> {
    view: SchemaView<'t>,
    /// Keys that name the forms of a step without that of a deadline, and those of a condition or a term.
    steps: Vec<&'t str>,
    terms: Vec<&'t str>,
    text: &'t str,
    readings: Vec<Reading>,
    /// Number of their edits.
    edits: usize,
}

impl<'t> ShapeReader<'t> {
    /// Returns whether there is more to read in another way than a document can be about.
    fn is_full(&self) -> bool {
        self.readings.len() > MAX_MISTAKES || self.edits > MAX_EDITS
    }

    /// Notes that a place is written in one way and read in another.
    fn read_as(&mut self, span: Span, written: String, read: impl Into<String>, edits: Vec<Edit>) {
        if self.is_full() {
            return;
        }
        self.edits += edits.len();
        let read = read.into();
        match self.readings.iter_mut().find(|known| known.written == written && known.read == read) {
            Some(known) => {
                known.count += 1;
                known.edits.extend(edits);
            }
            None => self.readings.push(Reading { written, read, span, count: 1, edits }),
        }
    }

    fn rename(&mut self, key: &Located<'_>, name: &str) {
        let edits = vec![replace(key.span, quoted(name))];
        self.read_as(key.span, format!("the key {}", shown(key)), format!("`{name}`"), edits);
    }

    /// A value is read as a string or an object that has one key.
    fn respell(&mut self, value: &Located<'_>, read: String) {
        let edits = vec![replace(value.span, read.clone())];
        self.read_as(value.span, shown(value), format!("`{read}`"), edits);
    }

    /// Reads the shapes of a value that should fit a schema, and those inside.
    fn value(&mut self, node: &Located<'_>, schema: &'t Json) {
        let leaves = self.view.leaves(schema);
        if self.handlers(node, &leaves) {
            return;
        }
        if let Some(items) = self.items_of_one(node, &leaves) {
            let edits = vec![before(node, "["), after(node, "]")];
            self.read_as(start(node), "a single value".to_owned(), "a list of one", edits);
            return self.value(node, items);
        }
        let node = match leaves.first().and_then(|leaf| leaf.name) {
            Some("Step") => {
                self.step(node);
                node
            }
            Some("Awaited") => self.awaited(node),
            Some("Condition") => {
                self.condition(node);
                node
            }
            Some("Rule") => {
                self.kept(node);
                node
            }
            Some("Reaction") => self.reaction(node),
            _ => node,
        };
        match &node.value {
            LocatedValue::Array(items) => {
                let schema = leaves.iter().find_map(|leaf| leaf.schema.get("items"));
                schema.into_iter().for_each(|schema| items.iter().for_each(|item| self.value(item, schema)));
            }
            LocatedValue::Object(_) => self.object(node, &leaves),
            _ => {}
        }
    }

    /// Schema of the elements, for one value where only a list is accepted and a list of it would be right.
    fn items_of_one(&self, node: &Located<'_>, leaves: &[Leaf<'t>]) -> Option<&'t Json> {
        let mut lists = leaves.iter().filter(|leaf| !self.view.is_null(leaf.schema));
        let (Some(list), None) = (lists.next(), lists.next()) else { return None };
        let items = self.view.list_items(list.schema)?;
        let holds_steps = || self.view.leaves(items).first().and_then(|leaf| leaf.name) == Some("Step");
        let is_one = match &node.value {
            LocatedValue::Object(members) => !members.is_empty(),
            LocatedValue::Text(word) => {
                !holds_steps() || self.ending(word).is_some() || text_steps(word).is_some()
            }
            _ => false,
        };
        is_one.then_some(items)
    }

    /// Reads other keys of an object for its own, leaves out prose, and reads the shapes of its values.
    fn object(&mut self, node: &Located<'_>, leaves: &[Leaf<'t>]) {
        let forms: Vec<_> =
            leaves.iter().filter_map(|leaf| Some((form_key(leaf.schema)?, leaf.schema))).collect();
        let is_step = leaves.first().and_then(|leaf| leaf.name) == Some("Step");
        let worded = self.worded(node).filter(|_| is_step).unwrap_or_default();
        let form = match forms.as_slice() {
            [only] => Some(*only),
            several if !worded.head.is_empty() => {
                several.iter().copied().find(|(head, _)| *head == worded.head)
            }
            several => node.members().iter().find_map(|(key, value)| {
                let name = table::condition_key(key.text()?);
                // A `do` that names nothing is the body of another form.
                let is_form = (name != "do" || value.text().is_some())
                    && (name != DEADLINE || member(node, "steps").is_some());
                several.iter().copied().find(|(head, _)| *head == name && is_form)
            }),
        };
        let Some((head, schema)) = form else { return };
        if head == "on" && self.handler_of_step(node) {
            return;
        }
        let WordedStep { kind, mut renamed, is_unnamed, .. } = worded;
        if is_unnamed {
            let read = format!("\"{head}\": {}", quoted(table::UNNAMED_GROUP));
            let edits = vec![insert(node.span.start + 1, node, format!("{read}, "))];
            self.read_as(start(node), pattern(node), format!("`{{{read}, …}}`"), edits);
        }
        renamed.iter().for_each(|(key, name)| self.rename(key, name));
        for (_, aliases, name) in table::KEYS.iter().filter(|row| row.0 == head) {
            let is_free =
                |key: &Located<'_>| kind != Some(key) && !renamed.iter().any(|(known, _)| *known == key);
            // A `do` with a word calls something.
            let is_body = |key: &Located<'_>, value: &Located<'_>| {
                !is_step || key.text() != Some("do") || value.text().is_none()
            };
            let mut found = node
                .members()
                .iter()
                .filter(|(key, value)| is_any(key, aliases) && is_free(key) && is_body(key, value));
            let mut found = std::iter::from_fn(|| found.next().map(|(key, _)| key));
            let is_known = member(node, name).is_some() || renamed.iter().any(|(_, known)| known == name);
            if let (false, Some(alias), None) = (is_known, found.next(), found.next()) {
                self.rename(alias, name);
                renamed.push((alias, name));
            }
        }
        let name_of = |key: &Located<'_>| renamed.iter().find(|(known, _)| *known == key).map(|row| row.1);
        // A call takes any key.
        let is_closed = !schema.get("additionalProperties").is_some_and(Json::is_object);
        let is_idle = |(key, value): &&(Located<'_>, Located<'_>)| {
            let is_own = name_of(key).is_some()
                || key.text().is_some_and(|key| self.view.property(schema, key).is_some());
            kind == Some(key) || is_closed && !is_own && is_idle(key, value)
        };
        let (idle, kept): (Vec<_>, Vec<_>) = node.members().iter().partition(is_idle);
        if let Some((first, _)) = idle.first() {
            let edits = self.restructure(node.span, kept.iter().map(|member| whole(member)));
            let written: Vec<String> = idle.iter().map(|(key, value)| said(key, value, kind)).collect();
            let read = match kind {
                Some(_) => format!("`{{{}: …}}`", quoted(head)),
                None => table::IGNORED.to_owned(),
            };
            self.read_as(first.span, written.join(", "), read, edits);
        }
        for (key, value) in kept {
            if let Some(numbers) = self.pose(value).filter(|_| head == "do") {
                let edits = vec![replace(value.span, format!("{{\"pose\": [{numbers}]}}"))];
                self.read_as(start(value), pattern(value), "`{\"pose\": […]}`", edits);
                continue;
            }
            let own = table::condition_key(key.text().unwrap_or_default());
            let name = name_of(key).unwrap_or(own);
            let bare = value.text().and_then(|text| text.strip_prefix('$')).filter(|bare| is_bare_name(bare));
            if let Some(bare) = bare.filter(|_| table::NAMES.contains(&name)) {
                self.respell(value, quoted(bare));
            }
            let schema = self.view.property(schema, name);
            schema.into_iter().for_each(|schema| self.value(value, schema));
        }
    }

    /// Numbers of a pose that is written as an object of them; `None` for any other value.
    fn pose(&self, node: &Located<'_>) -> Option<String> {
        let mut numbers = Vec::new();
        for names in table::POSE {
            let mut named = node.members().iter().filter(|(key, _)| is_any(key, names));
            match (named.next(), named.next()) {
                (Some((_, value)), None) if matches!(value.value, LocatedValue::Number(_)) => {
                    numbers.push(self.source(value).to_owned());
                }
                // A height may be absent.
                (None, _) if names.contains(&"z") => {}
                _ => return None,
            }
        }
        (numbers.len() == node.members().len()).then(|| numbers.join(", "))
    }

    fn step(&mut self, node: &Located<'_>) {
        if let Some(kind) = node.text().and_then(|word| self.ending(word)) {
            return self.respell(node, format!("{{\"end\": {}}}", quoted(kind)));
        }
        if let Some(steps) = node.text().and_then(text_steps) {
            return self.respell(node, steps);
        }
        if self.worded(node).is_some() {
            return;
        }
        match self.step_form(node) {
            Some((key, value)) if key.text() == Some("end") => {
                let word = value.text().unwrap_or_default();
                if let Some(kind) = self.ending(word).filter(|kind| *kind != word) {
                    self.respell(value, quoted(kind));
                }
            }
            Some((key, _)) if key.text() != Some("do") => {}
            Some((key, value)) if self.ending_call(node, key, value) => {}
            Some(_) | None => self.call(node),
        }
    }

    /// Member of a step that names its form.
    fn step_form<'n, 's>(&self, node: &'n Located<'s>) -> Option<&'n (Located<'s>, Located<'s>)> {
        let is_form = |(key, value): &&(Located<'_>, Located<'_>)| {
            is_any(key, &self.steps) && (key.text() != Some("do") || value.text().is_some())
        };
        let deadline = || member(node, DEADLINE).filter(|_| member(node, "steps").is_some());
        node.members().iter().find(is_form).or_else(deadline)
    }

    /// Checks if a value is a step, in the form of the language or in another shape.
    fn is_step(&self, node: &Located<'_>) -> bool {
        self.step_form(node).is_some()
            || self.worded(node).is_some()
            || self.call_shape(node).is_some()
            || node.text().is_some_and(|text| text_steps(text).is_some())
    }

    /// The kind of ending that a word means.
    fn ending(&self, word: &str) -> Option<&'t str> {
        let own = table::ENDINGS.iter().find(|(known, _)| *known == word).map_or(word, |(_, own)| *own);
        self.view.words("EndKind").into_iter().find(|kind| *kind == own)
    }

    /// Reads a reaction: a word alone, or an object whose key does not fit its word. Returns the reaction,
    /// which may be the only element of a list.
    fn reaction<'n, 's>(&mut self, node: &'n Located<'s>) -> &'n Located<'s> {
        if let LocatedValue::Array(items) = &node.value
            && let [only] = items.as_slice()
            && (only.text().is_some() || is_any_key(only, &["react", "end"]))
        {
            let open = Span { end: only.span.start, ..node.span };
            let close = Span { start: only.span.end, ..node.span };
            let edits = vec![replace(open, ""), replace(close, "")];
            self.read_as(start(node), "a list of one reaction".to_owned(), "a reaction", edits);
            return self.reaction(only);
        }
        let reacts = self.view.words("ReactKind");
        let kind_of = |word: &str| match reacts.iter().find(|kind| **kind == word) {
            Some(kind) => Some(("react", *kind)),
            None => self.ending(word).map(|kind| ("end", kind)),
        };
        if let Some((key, kind)) = node.text().and_then(kind_of) {
            self.respell(node, format!("{{\"{key}\": {}}}", quoted(kind)));
            return node;
        }
        let kind = node.members().iter().find(|(key, _)| is_any(key, &table::KINDS));
        if let Some((key, value)) = kind
            && let Some((own, kind)) = value.text().and_then(kind_of)
            && (key.text(), value.text()) != (Some(own), Some(kind))
        {
            let edits = vec![replace(key.span, quoted(own)), replace(value.span, quoted(kind))];
            let written = format!("`{{{}: {}}}`", quoted(key.text().unwrap_or_default()), self.source(value));
            self.read_as(key.span, written, format!("`{{\"{own}\": {}}}`", quoted(kind)), edits);
        }
        node
    }

    fn source(&self, node: &Located<'_>) -> &'t str {
        self.text.get(node.span.range()).unwrap_or_default()
    }

    /// Edits after which an object has these parts of it as its members, and nothing else. The parts are in
    /// the order of the document, and are members or stand in for one.
    fn restructure(&self, object: Span, parts: impl IntoIterator<Item = Span>) -> Vec<Edit> {
        let mut edits = Vec::new();
        let mut at = object.start + 1;
        let mut comma = "";
        for part in parts {
            let gap = Span { start: at, end: part.start, ..object };
            if self.text.get(gap.range()).is_none_or(|gap| gap.trim() != comma.trim()) {
                edits.push(replace(gap, comma));
            }
            (at, comma) = (part.end, ", ");
        }
        let rest = Span { start: at, end: object.end.saturating_sub(1), ..object };
        if self.text.get(rest.range()).is_none_or(|rest| !rest.trim().is_empty()) {
            edits.push(replace(rest, ""));
        }
        edits
    }
}

fn member<'n, 's>(node: &'n Located<'s>, key: &str) -> Option<&'n (Located<'s>, Located<'s>)> {
    node.members().iter().find(|(known, _)| known.text() == Some(key))
}

fn whole((key, value): &(Located<'_>, Located<'_>)) -> Span {
    key.span.to(value.span)
}

fn is_any(key: &Located<'_>, names: &[&str]) -> bool {
    key.text().is_some_and(|key| names.contains(&key))
}

fn is_any_key(node: &Located<'_>, names: &[&str]) -> bool {
    node.members().iter().any(|(key, _)| is_any(key, names))
}

/// Place of a note about a whole value: of an object its first key, of a list its bracket.
fn start(node: &Located<'_>) -> Span {
    match &node.value {
        LocatedValue::Array(_) => Span { end: node.span.start + 1, ..node.span },
        _ => node.head(),
    }
}

fn replace(span: Span, text: impl Into<String>) -> Edit {
    Edit { span, text: text.into() }
}

fn insert(at: u32, node: &Located<'_>, text: impl Into<String>) -> Edit {
    replace(Span { start: at, end: at, ..node.span }, text)
}

fn before(node: &Located<'_>, text: impl Into<String>) -> Edit {
    insert(node.span.start, node, text)
}

fn after(node: &Located<'_>, text: impl Into<String>) -> Edit {
    insert(node.span.end, node, text)
}

/// A string as JSON writes it.
fn quoted(text: &str) -> String {
    Json::from(text).to_string()
}

/// Checks if a member of a closed object only explains it.
fn is_idle(key: &Located<'_>, value: &Located<'_>) -> bool {
    let is_label =
        matches!(value.value, LocatedValue::Text(_) | LocatedValue::Number(_) | LocatedValue::Null);
    is_label && [&table::PROSE[..], &table::NOISE, &table::LABELS].iter().any(|words| is_any(key, words))
}

/// A member that is left out, as a note says it: the key, and of the word that names the form its value too.
fn said(key: &Located<'_>, value: &Located<'_>, kind: Option<&Located<'_>>) -> String {
    match value.text().filter(|_| kind == Some(key)) {
        Some(word) => format!("`{{{}: {}}}`", quoted(key.text().unwrap_or_default()), quoted(word)),
        None => shown(key),
    }
}

/// A key or a word in back-quotes.
fn shown(node: &Located<'_>) -> String {
    format!("`{}`", node.text().unwrap_or_default())
}

/// Checks if a name is one letter away from a key of a form, which then is misspelt.
fn is_misspelt(name: &str, forms: &[&str]) -> bool {
    !table::SHORT_FLUENTS.contains(&name) && forms.iter().any(|form| strsim::osa_distance(form, name) < 2)
}

/// An object by its keys: `{"action": …, "args": {…}}`.
fn pattern(node: &Located<'_>) -> String {
    let member = |(key, value): &(Located<'_>, Located<'_>)| {
        let value = match &value.value {
            LocatedValue::Object(_) => "{…}",
            LocatedValue::Array(_) => "[…]",
            _ => "…",
        };
        format!("{}: {value}", quoted(key.text().unwrap_or_default()))
    };
    let members: Vec<String> = node.members().iter().map(member).collect();
    format!("`{{{}}}`", members.join(", "))
}
