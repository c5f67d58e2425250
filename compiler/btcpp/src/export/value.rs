//! Values and names as the texts of ports.

use std::collections::BTreeSet;

use motet_graph::python::identifier;
use motet_graph::{Graph, Type, Value};

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

/// Seconds as the text of a port in milliseconds; none below one and above what the port holds.
pub(super) fn milliseconds(secs: f64) -> Option<String> {
    let ms = (secs * 1000.0).round();
    (1.0..=f64::from(u32::MAX)).contains(&ms).then(|| ms.to_string())
}
