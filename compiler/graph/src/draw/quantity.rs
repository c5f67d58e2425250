//! Numbers of a quantity as people write them: with a unit, angles in degrees, ratios in per cent.

use crate::model::{Graph, Term, Type, Value};

/// A number in SI units with the unit of its quantity; as it is where that has none.
fn with_unit(value: f64, quantity: &str) -> String {
    let (value, unit) = match quantity {
        "Length" => (value, "m"),
        // A turn of 90 deg is 1.5707963267948966 rad.
        "Angle" => ((value.to_degrees() * 1e9).round() / 1e9, "deg"),
        "Duration" => (value, "s"),
        "Mass" => (value, "kg"),
        "Force" => (value, "N"),
        "Speed" => (value, "m/s"),
        "Ratio" => ((value * 1e11).round() / 1e9, "%"),
        _ => return value.to_string(),
    };
    format!("{value} {unit}")
}

/// A number as a literal of a type; none where it is no number, or its type no quantity.
pub(super) fn literal(term: &Term, ty: Option<&Type>) -> Option<String> {
    match (term, ty) {
        #[expect(clippy::cast_precision_loss, reason = "for the eye")]
        (Term::Literal(Value::Int(value)), Some(Type::Quantity(quantity))) => {
            Some(with_unit(*value as f64, quantity))
        }
        (Term::Literal(Value::Number(value)), Some(Type::Quantity(quantity))) => {
            Some(with_unit(*value, quantity))
        }
        (_, _) => None,
    }
}

/// The type of a term as far as a graph's tables say it; that of a field does not stand there.
pub(super) fn type_of<'a>(graph: &'a Graph, term: &Term) -> Option<&'a Type> {
    match term {
        Term::Measure(id, _) => graph.measures.get(id.index()).map(|measure| &measure.result),
        Term::Binding(id) => graph.bindings.get(id.index()).map(|binding| &binding.ty),
        Term::Literal(_) | Term::Each | Term::Field(..) | Term::List(_) | Term::Arith(..) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::with_unit;

    #[test]
    fn numbers_are_written_as_people_do() {
        for (value, quantity, expected) in [
            (std::f64::consts::FRAC_PI_2, "Angle", "90 deg"),
            (0.3, "Ratio", "30 %"),
            (0.07, "Ratio", "7 %"),
            (0.5, "Length", "0.5 m"),
            (90.0, "Duration", "90 s"),
            (3.0, "", "3"),
        ] {
            assert_eq!(with_unit(value, quantity), expected);
        }
    }
}
