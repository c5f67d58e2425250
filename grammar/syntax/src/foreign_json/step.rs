//! Shapes of steps: a form under a word such as `type`, a group without a name, steps in the text syntax, and
//! handlers and rules written as steps and conditions.

use super::worded::WordedStep;
use super::{
    ShapeReader, after, before, insert, is_any, is_any_key, is_idle, member, pattern, quoted, replace, start,
    table, whole,
};
use crate::ast::{CompareOp, ExprKind};
use crate::located::{Leaf, Located, LocatedValue, form_key};
use crate::print;
use crate::text;
use crate::words::is_bare_name;

impl<'t> ShapeReader<'t> {
    /// Reads a step whose form is a word, or shows by its keys; `None` for any other.
    pub(super) fn worded<'n, 's>(&self, node: &'n Located<'s>) -> Option<WordedStep<'n, 's>> {
        let is_form = |key: &Located<'_>| key.text() != Some("do") && is_any(key, &self.steps);
        let own = node.members().iter().find(|(key, _)| is_form(key)).and_then(|(key, _)| key.text());
        let of_word = |(key, value): &'n (Located<'s>, Located<'s>)| {
            let word = value.text().filter(|_| is_any(key, &table::STEP_KINDS))?;
            let row = table::STEP_WORDS.iter().find(|row| row.0 == word)?;
            own.is_none_or(|own| own == row.1).then_some((key, row.1))
        };
        let mut words = node.members().iter().filter_map(of_word);
        let (kind, head) = match (words.next(), words.next()) {
            (Some((kind, head)), None) => (Some(kind), head),
            (Some(_), Some(_)) => return None,
            (None, _) if own.is_some() || self.step_form(node).is_some() => return None,
            (None, _) => (None, self.form_by_keys(node)?),
        };
        let mut renamed = Vec::new();
        if own.is_none() && (kind.is_some() || head != "sequence" || member(node, table::NAME).is_some()) {
            let aliases = table::STEP_HEADS.iter().find(|row| row.0 == head).map_or(&[][..], |row| row.1);
            let mut named = node.members().iter().map(|(key, _)| key).filter(|key| is_any(key, aliases));
            match (named.next(), named.next()) {
                (Some(alias), None) => renamed.push((alias, head)),
                _ => return None,
            }
        }
        // A primitive may have the name of a form: only what has its parts is one.
        let has = |name: &str| {
            let is_part = |row: &&(&str, &[&str], &str)| row.0 == head && row.2 == name;
            let aliases = table::KEYS.iter().filter(is_part).flat_map(|row| row.1);
            let is_given = |(key, value): &(Located<'_>, Located<'_>), alias: &str| {
                key.text() == Some(alias) && kind != Some(key) && (alias != "do" || value.text().is_none())
            };
            let mut aliases =
                aliases.map(|alias| node.members().iter().any(|member| is_given(member, alias)));
            member(node, name).is_some()
                || renamed.iter().any(|(_, known)| *known == name)
                || aliases.any(|is_there| is_there)
        };
        let steps = self.view.definition("Step").map(|step| self.view.leaves(step)).unwrap_or_default();
        let form = steps.iter().find(|leaf| form_key(leaf.schema) == Some(head))?;
        let required = form.schema.get("required")?.as_array()?;
        let is_whole = required
            .iter()
            .filter_map(|key| key.as_str())
            .all(|key| has(key) || key == "at_most" || key == "sequence" && kind.is_none());
        let is_unnamed = own.is_none() && renamed.is_empty();
        is_whole.then_some(WordedStep { head, kind, renamed, is_unnamed })
    }

    /// The form of a step that shows by keys which are no heads: a group without a name, a loop with `for`.
    fn form_by_keys(&self, node: &Located<'_>) -> Option<&'static str> {
        if is_any_key(node, &["for", "foreach", "for_each"]) && member(node, "in").is_some() {
            return Some("each");
        }
        let is_list = member(node, "steps").is_some_and(|(_, steps)| {
            matches!(steps.value, LocatedValue::Array(_) | LocatedValue::Object(_))
        });
        let is_part = |(key, value): &(Located<'_>, Located<'_>)| {
            is_any(key, &["steps", "finally"]) || is_idle(key, value)
        };
        (is_list && node.members().iter().all(is_part)).then_some("sequence")
    }

    /// Reads steps in place of handlers: they handle any failure. Returns `false` for anything else.
    pub(super) fn handlers(&mut self, node: &Located<'_>, leaves: &[Leaf<'t>]) -> bool {
        let mut lists = leaves.iter().filter_map(|leaf| self.view.list_items(leaf.schema));
        let catch = lists.next().map(|items| self.view.leaves(items)).unwrap_or_default();
        let Some(catch) = catch.first().filter(|leaf| leaf.name == Some("Catch")) else { return false };
        let steps = self.view.property(catch.schema, "steps");
        let Some(step) = steps.and_then(|steps| self.view.list_items(steps)) else { return false };
        let is_step = |item: &Located<'_>| {
            !is_any_key(item, &table::HANDLERS) && !is_any_key(item, &["steps"]) && self.is_step(item)
        };
        let head = "{\"on\": [\"any\"], \"steps\": [";
        let (items, edits) = match &node.value {
            LocatedValue::Array(items) if !items.is_empty() && items.iter().all(is_step) => {
                let end = node.span.end.saturating_sub(1);
                (items.as_slice(), vec![insert(node.span.start + 1, node, head), insert(end, node, "]}")])
            }
            LocatedValue::Object(_) | LocatedValue::Text(_) if is_step(node) => {
                (std::slice::from_ref(node), vec![before(node, format!("[{head}")), after(node, "]}]")])
            }
            _ => return false,
        };
        self.read_as(start(node), "steps".to_owned(), "a handler of any failure with these steps", edits);
        items.iter().for_each(|item| self.value(item, step));
        true
    }

    /// Reads a handler with the keys of a call beside its kinds: `{"on": "any", "do": "home"}`.
    pub(super) fn handler_of_step(&mut self, node: &Located<'_>) -> bool {
        let mut kinds = node.members().iter().filter(|(key, _)| is_any(key, &table::HANDLERS));
        let (Some((on, kinds)), None) = (kinds.next(), kinds.next()) else { return false };
        let is_call = member(node, "do").is_some_and(|(_, callee)| callee.text().is_some_and(is_bare_name));
        let kinds = match &kinds.value {
            LocatedValue::Text(kind) => format!("[{}]", quoted(kind)),
            LocatedValue::Array(_) => self.source(kinds).to_owned(),
            _ => return false,
        };
        if !is_call || member(node, "steps").is_some() {
            return false;
        }
        let parts = node.members().iter().filter(|(key, _)| key != on).map(whole);
        let mut edits = self.restructure(node.span, parts);
        edits.push(insert(node.span.start + 1, node, format!("\"on\": {kinds}, \"steps\": [{{")));
        edits.push(insert(node.span.end.saturating_sub(1), node, "}]"));
        self.read_as(start(node), pattern(node), "a handler with this step", edits);
        true
    }

    /// Reads the object around what is awaited: `{"wait": {"seconds": 5}}`. Returns what is awaited.
    pub(super) fn awaited<'n, 's>(&mut self, node: &'n Located<'s>) -> &'n Located<'s> {
        if let [(key, value)] = node.members() {
            let is_time = matches!(value.value, LocatedValue::Number(_) | LocatedValue::Text(_))
                && is_any(key, &table::TIMES);
            let is_condition = is_any(key, &["until", "condition"])
                && matches!(value.value, LocatedValue::Object(_) | LocatedValue::Text(_));
            if is_time || is_condition {
                let head = crate::source::Span { end: value.span.start, ..node.span };
                let tail = crate::source::Span { start: value.span.end, ..node.span };
                let edits = vec![replace(head, ""), replace(tail, "")];
                self.read_as(start(node), pattern(node), "its value", edits);
                if is_condition {
                    self.condition(value);
                }
                return value;
            }
        }
        self.condition(node);
        node
    }

    /// Reads a rule in the text syntax: `"distance(user) >= 1 m"`.
    pub(super) fn kept(&mut self, node: &Located<'_>) {
        let Some(rule) = node.text().and_then(rule) else { return };
        self.respell(node, rule);
    }
}

/// A rule of a `keep` in JSON, of one in the text syntax.
fn rule(text: &str) -> Option<String> {
    let plain = text.trim();
    if let Some(zone) = plain.strip_prefix("out of ").map(str::trim).filter(|zone| is_bare_name(zone)) {
        return Some(format!("{{\"out_of\": {}}}", quoted(zone)));
    }
    let ExprKind::Compare(CompareOp::AtLeast | CompareOp::More, left, right) =
        text::parse_condition(plain).ok()?.kind
    else {
        return None;
    };
    let ExprKind::Call(call) = left.kind else { return None };
    let [of] = call.args.as_slice() else { return None };
    let name = match &of.value.kind {
        ExprKind::Name(name) => name.to_string(),
        ExprKind::Binding(name) => format!("${name}"),
        _ => return None,
    };
    let is_distance =
        call.name.text == "distance" && matches!(right.kind, ExprKind::Quantity(..) | ExprKind::Number(_));
    let least = match right.kind {
        ExprKind::Number(_) => print::expression(&right),
        _ => quoted(&print::expression(&right)),
    };
    is_distance.then(|| format!("{{\"distance\": {}, \"at_least\": {least}}}", quoted(&name)))
}
