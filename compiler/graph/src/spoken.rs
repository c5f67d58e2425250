//! Values as a person says them: `2.5 m`, `80 %`, `the red mug and the cup`.

use crate::model::{Graph, Type, Value};

/// A value as a person says it: an entity by its name, a quantity with its unit, a list as `a, b and c`.
///
/// ```
/// use motet_graph::{Graph, Type, Value, spoken};
///
/// let graph = Graph::empty("tidy_up", "hsr");
/// let battery = spoken(&graph, &Value::Number(0.8123), &Type::Quantity("Ratio".into()));
/// assert_eq!(battery, "81.2 %");
/// let cans = Value::List(["can_1", "can_2", "can_3"].map(|id| Value::Entity(id.into())).to_vec());
/// let cans = spoken(&graph, &cans, &Type::List(Box::new(Type::Text)));
/// assert_eq!(cans, "can_1, can_2 and can_3");
/// ```
#[must_use]
pub fn spoken(graph: &Graph, value: &Value, ty: &Type) -> String {
    match value {
        Value::Bool(value) => (if *value { "yes" } else { "no" }).to_owned(),
        Value::Int(value) => match ty {
            #[expect(clippy::cast_precision_loss, reason = "it is rounded")]
            Type::Quantity(quantity) => number(*value as f64, quantity),
            Type::Bool | Type::Int | Type::Number | Type::Text | Type::Pose => value.to_string(),
            Type::Entity(_) | Type::Case(_) | Type::List(_) => value.to_string(),
        },
        Value::Number(value) => match ty {
            Type::Quantity(quantity) => number(*value, quantity),
            Type::Bool | Type::Int | Type::Number | Type::Text | Type::Pose => number(*value, ""),
            Type::Entity(_) | Type::Case(_) | Type::List(_) => number(*value, ""),
        },
        Value::Text(text) => text.to_string(),
        Value::Entity(id) => {
            let known = graph.names.iter().find(|known| known.entity == *id);
            known.map_or(id, |known| &known.name).to_string()
        }
        Value::Case(case) => case.to_string(),
        Value::Pose(_) => value.to_string(),
        Value::List(items) => {
            let inner = if let Type::List(inner) = ty { inner } else { ty };
            let items: Vec<String> = items.iter().map(|item| spoken(graph, item, inner)).collect();
            match items.split_last() {
                None => "nothing".to_owned(),
                Some((only, [])) => only.clone(),
                Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
            }
        }
    }
}

/// A number with three digits that count, and the unit of its quantity.
fn number(value: f64, quantity: &str) -> String {
    let (value, unit) = in_unit(value, quantity);
    let rounded = format!("{value:.2e}").parse().unwrap_or(value);
    let rounded = if value.abs() >= 100.0 { value.round() } else { rounded };
    unit.map_or_else(|| rounded.to_string(), |unit| format!("{rounded} {unit}"))
}

/// A number in SI units as people write it, with the unit; none where its quantity has none.
pub(crate) fn in_unit(value: f64, quantity: &str) -> (f64, Option<&'static str>) {
    let (value, unit) = match quantity {
        "Length" => (value, "m"),
        // A turn of 90 deg is 1.5707963267948966 rad.
        "Angle" => ((value.to_degrees() * 1e9).round() / 1e9, "deg"),
        "Duration" => (value, "s"),
        "Mass" => (value, "kg"),
        "Force" => (value, "N"),
        "Speed" => (value, "m/s"),
        "Ratio" => ((value * 1e11).round() / 1e9, "%"),
        _ => return (value, None),
    };
    (value, Some(unit))
}
