//! Shapes of whole documents: steps without a policy around them, a policy in another object, other keys for
//! its parts, and prose beside them.

use super::{
    ShapeReader, after, before, insert, is_any, member, pattern, quoted, replace, shown, start, table, whole,
};
use crate::located::{Located, LocatedValue};
use crate::source::Span;
use crate::text;
use crate::words::is_name;

type Member<'s> = (Located<'s>, Located<'s>);

impl ShapeReader<'_> {
    pub(super) fn document(&mut self, node: &Located<'_>) {
        let head = format!("{{\"motet\": 1, \"policy\": {}, \"steps\": ", quoted(table::UNNAMED));
        let read = "a policy with these steps";
        let steps = self.view.property(self.view.root(), "steps");
        let Some(step) = steps.and_then(|steps| self.view.list_items(steps)) else { return };
        match &node.value {
            LocatedValue::Array(items) if items.iter().any(|item| self.is_step(item)) => {
                let is_list = self.source(node).starts_with('[');
                let (open, close) = if is_list { ("", "") } else { ("[", "]") };
                let mut edits =
                    vec![before(node, format!("{head}{open}")), after(node, format!("{close}}}"))];
                for pair in items.windows(2).filter(|_| !is_list) {
                    if let [one, next] = pair {
                        edits.push(replace(
                            Span { start: one.span.end, end: next.span.start, ..one.span },
                            ", ",
                        ));
                    }
                }
                let written = if is_list { "a list of steps" } else { "several objects" };
                self.read_as(start(node), written.to_owned(), read, edits);
                items.iter().for_each(|item| self.value(item, step));
            }
            LocatedValue::Object(_) if member(node, "motet").or(member(node, "policy")).is_some() => {
                self.policy(node);
            }
            // Steps and a cleanup are those of a policy, and a group of steps only inside of one.
            LocatedValue::Object(_) if member(node, "steps").is_none() && self.is_step(node) => {
                let edits = vec![before(node, format!("{head}[")), after(node, "]}")];
                self.read_as(start(node), "a step alone".to_owned(), read, edits);
                self.value(node, step);
            }
            LocatedValue::Object(_) if self.step_form(node).is_some() => {
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
        let members = unwrapped(node);
        let is_unwrapped =
            members.len() != node.members().len() || members.iter().zip(node.members()).any(|(a, b)| *a != b);
        let find = |name: &str| members.iter().copied().find(|(key, _)| key.text() == Some(name));
        let mut plans = members.iter().copied().filter(|member| is_plan(member));
        let plan = match (find("steps"), plans.next(), plans.next()) {
            (Some(_), ..) => None,
            (None, Some((key, _)), None) => Some(key),
            (None, ..) => return,
        };
        let goal = find(table::GOAL).filter(|(_, goal)| find("achieves").is_none() && is_goal(goal));
        let goal = goal.map(|(key, _)| key);
        plan.into_iter().for_each(|key| self.rename(key, "steps"));
        goal.into_iter().for_each(|key| self.rename(key, "achieves"));
        let mut added = Vec::new();
        if find("motet").is_none() {
            added.push("\"motet\": 1".to_owned());
        }
        if find("policy").is_none() {
            match find(table::NAME) {
                Some((key, name)) if name.text().is_some_and(is_name) => self.rename(key, "policy"),
                Some(_) | None => added.push(format!("\"policy\": {}", quoted(table::UNNAMED))),
            }
        }
        if !added.is_empty() {
            let edits = vec![insert(node.span.start + 1, node, format!("{}, ", added.join(", ")))];
            let read = format!("one with `{}`", added.join(", "));
            self.read_as(start(node), "the policy".to_owned(), read, edits);
        }
        let (prose, kept): (Vec<&Member<'_>>, Vec<_>) =
            members.iter().copied().partition(|(key, value)| goal != Some(key) && is_prose(key, value));
        if is_unwrapped {
            let edits = self.restructure(node.span, kept.iter().map(|member| whole(member)));
            self.read_as(start(node), pattern(node), "the policy in it", edits);
        } else if let Some((key, _)) = prose.first() {
            let edits = self.restructure(node.span, kept.iter().map(|member| whole(member)));
            let keys: Vec<String> = prose.iter().map(|(key, _)| shown(key)).collect();
            self.read_as(key.span, keys.join(", "), table::IGNORED, edits);
        }
        let root = self.view.root();
        for (key, value) in kept {
            let name = match key {
                key if plan == Some(key) => Some("steps"),
                key if goal == Some(key) => Some("achieves"),
                key => key.text(),
            };
            let schema = name.and_then(|name| self.view.property(root, name));
            schema.into_iter().for_each(|schema| self.value(value, schema));
        }
    }
}

/// Members of a policy; of one in another object those of both.
fn unwrapped<'n, 's>(node: &'n Located<'s>) -> Vec<&'n Member<'s>> {
    let holds_steps = |value: &Located<'_>| {
        value.members().iter().any(|member| member.0.text() == Some("steps") || is_plan(member))
    };
    let is_wrapper = |(key, value): &&Member<'_>| {
        (key.text() == Some("policy") || is_any(key, &table::PLANS)) && holds_steps(value)
    };
    let mut wrappers = node.members().iter().filter(is_wrapper);
    match (member(node, "steps"), wrappers.next(), wrappers.next()) {
        (None, Some(wrapper), None) => {
            let inner = |member: &'n Member<'s>| {
                if member == wrapper { wrapper.1.members() } else { std::slice::from_ref(member) }
            };
            node.members().iter().flat_map(inner).collect()
        }
        _ => node.members().iter().collect(),
    }
}

/// Checks for another key that holds the steps.
fn is_plan((key, value): &Member<'_>) -> bool {
    is_any(key, &table::PLANS) && matches!(value.value, LocatedValue::Array(_))
}

/// Checks if a value under `goal` is a condition and no prose.
fn is_goal(value: &Located<'_>) -> bool {
    match &value.value {
        LocatedValue::Text(text) => text.contains('(') && text::parse_condition(text).is_ok(),
        LocatedValue::Object(_) => true,
        _ => false,
    }
}

fn is_prose(key: &Located<'_>, value: &Located<'_>) -> bool {
    let is_text = |value: &Located<'_>| value.text().is_some();
    let is_said = match &value.value {
        LocatedValue::Array(items) => items.iter().all(is_text),
        _ => is_text(value),
    };
    is_said && (is_any(key, &table::PROSE) || key.text() == Some(table::GOAL))
}
