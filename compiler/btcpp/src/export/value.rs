//! Values and names as the texts of ports.

use std::collections::BTreeSet;

use motet_graph::python::identifier;
use motet_graph::{BindingId, Graph, Term, Type, Value};

use super::Writer;
use crate::names::is_plain;

/// Names of the bindings on the blackboard: letters, digits and underscores, a letter first; none for a
/// result that has no name.
pub(super) fn entries(graph: &Graph) -> Vec<Option<String>> {
    let mut taken = BTreeSet::new();
    let entry = |name: &str| {
        let stem = identifier(name.split('\'').next().unwrap_or(name));
        let is_letter = stem.starts_with(|char: char| char.is_ascii_alphabetic());
        let is_own = ["failure", "broken"].iter().any(|own| stem.starts_with(own));
        let stem = if is_letter && !is_own { stem } else { format!("its_{stem}") };
        let mut names = std::iter::once(stem.clone()).chain((2_u64..).map(|n| format!("{stem}_{n}")));
        let name = names.find(|name| !taken.contains(name)).unwrap_or(stem);
        taken.insert(name.clone());
        name
    };
    let is_named = |name: &&str| *name != "_" && !name.starts_with("_'");
    let names: Vec<Option<&str>> =
        graph.bindings.iter().map(|binding| Some(binding.name.as_str()).filter(is_named)).collect();
    let mut entry = entry;
    names.into_iter().map(|name| name.map(&mut entry)).collect()
}

/// Type of a port in C++.
pub(super) fn port_type(ty: &Type) -> String {
    match ty {
        Type::Bool => "bool".to_owned(),
        Type::Int | Type::Number | Type::Quantity(_) => "double".to_owned(),
        Type::Text | Type::Entity(_) | Type::Case(_) => "std::string".to_owned(),
        // Position and quaternion, seven numbers.
        Type::Pose => "std::vector<double>".to_owned(),
        Type::List(inner) => match &**inner {
            Type::Bool => "std::vector<bool>".to_owned(),
            Type::Int | Type::Number | Type::Quantity(_) => "std::vector<double>".to_owned(),
            Type::Text | Type::Entity(_) | Type::Case(_) | Type::Pose | Type::List(_) => {
                "std::vector<std::string>".to_owned()
            }
        },
    }
}

/// A value as the text of a port; the reason where it has none.
pub(super) fn literal(value: &Value) -> Result<String, &'static str> {
    match value {
        Value::Bool(value) => Ok(value.to_string()),
        Value::Int(value) => Ok(value.to_string()),
        Value::Number(value) => Ok(value.to_string()),
        Value::Entity(text) | Value::Case(text) | Value::Text(text) if !is_plain(text) => {
            Err("a text that BehaviorTree.CPP reads as the name of an entry or as JSON")
        }
        Value::Entity(text) | Value::Case(text) | Value::Text(text) => {
            let is_control = |char: char| char.is_control() && !matches!(char, '\n' | '\r' | '\t');
            match text.chars().any(|char| is_control(char) || matches!(char, '\u{fffe}' | '\u{ffff}')) {
                true => Err("a control character, which XML does not have"),
                false => Ok(text.to_string()),
            }
        }
        Value::Pose(pose) => {
            let numbers: Vec<String> = pose.xyz.iter().chain(&pose.quaternion).map(f64::to_string).collect();
            Ok(numbers.join(";"))
        }
        Value::List(items) => {
            let mut texts = Vec::with_capacity(items.len());
            for item in items {
                let text = match item {
                    Value::List(_) | Value::Pose(_) => return Err("a list of lists or of poses"),
                    other => literal(other)?,
                };
                if text.contains(';') || text.is_empty() {
                    return Err("a list in which a text is empty or has a `;`");
                }
                texts.push(text);
            }
            Ok(texts.join(";"))
        }
    }
}

impl Writer<'_> {
    /// The entry of a binding as a port refers to it.
    pub(super) fn entry(&self, id: BindingId) -> Option<&str> {
        self.entries.get(id.index())?.as_deref()
    }

    /// A term as the text of a port: a constant or the entry of a binding; refused otherwise.
    pub(super) fn port(&mut self, term: &Term, path: &str) -> String {
        let what = match term {
            Term::Literal(value) => match literal(value) {
                Ok(text) => return text,
                Err(why) => why,
            },
            Term::Binding(id) => match self.entry(*id) {
                Some(entry) => return format!("{{{entry}}}"),
                None => "a result without a name",
            },
            Term::Each => "a value of each entity of a kind",
            Term::Field(..) => "a field as an argument: a port holds a constant or an entry",
            Term::Measure(..) => "a measure as an argument: a port holds a constant or an entry",
            Term::List(items) => {
                let items = items.iter().map(|item| match item {
                    Term::Literal(value) => Some(value.clone()),
                    _ => None,
                });
                match items.collect::<Option<Vec<Value>>>().map(|items| literal(&Value::List(items))) {
                    Some(Ok(text)) => return text,
                    Some(Err(why)) => why,
                    None => "a list of bindings: a port holds a constant or one entry",
                }
            }
            Term::Arith(..) => "a calculation: a port holds a constant or an entry",
            Term::Count(_) | Term::First(_) => {
                "`count` or `first` as an argument: a port holds a constant or an entry"
            }
            Term::Template(_) => "a text with values: a port holds a constant or an entry",
        };
        self.refuse(path, what);
        String::new()
    }
}

/// Seconds as the text of a port in milliseconds; none below one and above what the port holds.
pub(super) fn milliseconds(secs: f64) -> Option<String> {
    let ms = (secs * 1000.0).round();
    (1.0..=f64::from(u32::MAX)).contains(&ms).then(|| ms.to_string())
}
