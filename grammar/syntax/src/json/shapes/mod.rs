//! Shapes of JSON that models write in place of those of the language, such as calls in the manner of tools.
//!
//! Used only where the plain reading has errors, and only for objects that it refuses: a primitive may have a
//! parameter `args` or `action`. Each shape is an edit of the document. The edited document is read like any
//! other, and the same edits are the fix of the note (M0122). A shape that could be read in two ways is left
//! as it is, and stays an error. The words are in [`table`].

mod call;
mod condition;
mod edits;
mod table;

use serde_json::Value as Json;

use crate::diagnostic::{Diagnostic, Edit, Fix};
use crate::errors::ReadShape;
use crate::located::{Leaf, Located, LocatedValue, SchemaView, form_key};
use crate::source::Span;
use crate::words::{DEADLINE, is_bare_name, is_name};

pub(super) use edits::EditedText;

/// Reads the shapes of a document without syntax errors. Returns the document in the form of the language,
/// and a note for each sort of shape; `None` if it has no such shape. O(document × forms).
pub(super) fn plain_form(
    tree: &Located<'_>,
    text: &str,
    schema: &Json,
) -> Option<(EditedText, Vec<Diagnostic>)> {
    let view = SchemaView::new(schema);
    let (mut steps, terms) = (view.forms("Step"), view.forms("Form"));
    steps.retain(|key| *key != DEADLINE);
    let mut reader = ShapeReader { view, steps, terms, text, readings: Vec::new() };
    reader.document(tree);
    let mut edits: Vec<Edit> =
        reader.readings.iter().flat_map(|reading| reading.edits.iter().cloned()).collect();
    let edited = EditedText::new(text, &mut edits)?;
    Some((edited, reader.readings.into_iter().map(Reading::note).collect()))
}

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
        let fix = Fix { title: format!("write {read}"), edits };
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
}

impl<'t> ShapeReader<'t> {
    /// Notes that a place is written in one way and read in another.
    fn read_as(&mut self, span: Span, written: String, read: impl Into<String>, edits: Vec<Edit>) {
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

    fn document(&mut self, node: &Located<'_>) {
        let head = format!("{{\"motet\": 1, \"policy\": {}, \"steps\": ", quoted(table::UNNAMED));
        let read = "a policy with these steps";
        let steps = self.view.property(self.view.root(), "steps");
        let Some(step) = steps.and_then(|steps| self.view.list_items(steps)) else { return };
        match &node.value {
            LocatedValue::Array(items) if items.iter().any(|item| self.is_step(item)) => {
                let edits = vec![before(node, head), after(node, "}")];
                self.read_as(start(node), "a list of steps".to_owned(), read, edits);
                items.iter().for_each(|item| self.value(item, step));
            }
            LocatedValue::Object(_) if member(node, "motet").or(member(node, "policy")).is_some() => {
                self.policy(node);
            }
            LocatedValue::Object(_) if self.is_step(node) => {
                let edits = vec![before(node, format!("{head}[")), after(node, "]}")];
                self.read_as(start(node), "a step alone".to_owned(), read, edits);
                self.value(node, step);
            }
            LocatedValue::Object(_) => self.policy(node),
            _ => {}
        }
    }

    /// An object that is a policy, perhaps without its name and with other keys for its parts.
    fn policy(&mut self, node: &Located<'_>) {
        let is_plan = |(key, value): &&(Located<'_>, Located<'_>)| {
            is_any(key, &table::PLANS) && matches!(value.value, LocatedValue::Array(_))
        };
        let mut plans = node.members().iter().filter(is_plan);
        let plan = match (member(node, "steps"), plans.next(), plans.next()) {
            (Some(_), ..) => None,
            (None, Some((key, _)), None) => {
                self.rename(key, "steps");
                Some(key)
            }
            (None, ..) => return,
        };
        let mut added = Vec::new();
        if member(node, "motet").is_none() {
            added.push("\"motet\": 1".to_owned());
        }
        if member(node, "policy").is_none() {
            match member(node, table::NAME) {
                Some((key, name)) if name.text().is_some_and(is_name) => self.rename(key, "policy"),
                Some(_) | None => added.push(format!("\"policy\": {}", quoted(table::UNNAMED))),
            }
        }
        if !added.is_empty() {
            let edits = vec![insert(node.span.start + 1, node, format!("{}, ", added.join(", ")))];
            let read = format!("one with `{}`", added.join(", "));
            self.read_as(start(node), "the policy".to_owned(), read, edits);
        }
        let is_prose =
            |(key, value): &&(Located<'_>, Located<'_>)| is_any(key, &table::PROSE) && value.text().is_some();
        let (prose, kept): (Vec<_>, Vec<_>) = node.members().iter().partition(is_prose);
        if let Some((key, _)) = prose.first() {
            let edits = self.restructure(node.span, kept.iter().map(|member| whole(member)));
            let keys: Vec<String> = prose.iter().map(|(key, _)| shown(key)).collect();
            self.read_as(key.span, keys.join(", "), "prose, which is ignored", edits);
        }
        let root = self.view.root();
        for (key, value) in kept {
            let name = if plan == Some(key) { Some("steps") } else { key.text() };
            let schema = name.and_then(|name| self.view.property(root, name));
            schema.into_iter().for_each(|schema| self.value(value, schema));
        }
    }

    /// Reads the shapes of a value that should fit a schema, and those inside.
    fn value(&mut self, node: &Located<'_>, schema: &'t Json) {
        let leaves = self.view.leaves(schema);
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
            Some("Condition" | "Awaited") => {
                self.condition(node);
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
            LocatedValue::Text(word) => !holds_steps() || self.ending(word).is_some(),
            _ => false,
        };
        is_one.then_some(items)
    }

    /// Reads other keys of an object for its own, and the shapes of its values.
    fn object(&mut self, node: &Located<'_>, leaves: &[Leaf<'t>]) {
        let forms: Vec<_> =
            leaves.iter().filter_map(|leaf| Some((form_key(leaf.schema)?, leaf.schema))).collect();
        let form = match forms.as_slice() {
            [only] => Some(*only),
            several => node.members().iter().find_map(|(key, value)| {
                let name = table::condition_key(key.text()?);
                // A `do` that names nothing is the body of another form.
                let is_form = (name != "do" || value.text().is_some())
                    && (name != DEADLINE || member(node, "steps").is_some());
                several.iter().copied().find(|(head, _)| *head == name && is_form)
            }),
        };
        let Some((head, schema)) = form else { return };
        let mut renamed: Vec<(&Located<'_>, &str)> = Vec::new();
        for (_, aliases, name) in table::KEYS.iter().filter(|row| row.0 == head) {
            let is_alias =
                |key: &&Located<'_>| is_any(key, aliases) && !renamed.iter().any(|(known, _)| known == key);
            let mut found = node.members().iter().map(|(key, _)| key).filter(is_alias);
            if let (None, Some(alias), None) = (member(node, name), found.next(), found.next()) {
                self.rename(alias, name);
                renamed.push((alias, name));
            }
        }
        for (key, value) in node.members() {
            if let Some(numbers) = self.pose(value).filter(|_| head == "do") {
                let edits = vec![replace(value.span, format!("{{\"pose\": [{numbers}]}}"))];
                self.read_as(start(value), pattern(value), "`{\"pose\": […]}`", edits);
                continue;
            }
            let own = table::condition_key(key.text().unwrap_or_default());
            let name = renamed.iter().find(|(alias, _)| *alias == key).map_or(own, |(_, name)| name);
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
        match self.step_form(node) {
            Some((key, value)) if key.text() == Some("end") => {
                let word = value.text().unwrap_or_default();
                if let Some(kind) = self.ending(word).filter(|kind| *kind != word) {
                    self.respell(value, quoted(kind));
                }
            }
            Some((key, _)) if key.text() != Some("do") => {}
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
        self.step_form(node).is_some() || self.call_shape(node).is_some()
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
