//! Diagnostics of a robot's card that does not fit the declarations (M0406 to M0410, M0446).

use motet_syntax::{Related, Span};
use smol_str::SmolStr;

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Unknown fluent or measure under `observes`.
    UnknownObserved("M0406", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no fluent or measure `{}` to observe", m.name) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("declare it in primitives.motet, such as `fluent {}(what: Entity)`, or remove it", m.name),
        })
    }

    /// Unknown primitive in a card.
    UnknownProvided("M0407", Error) { name: SmolStr, near: Option<SmolStr>, is_policy: bool }
    message(m) {
        if m.is_policy {
            format!("`{}` is a policy, not a primitive", m.name)
        } else {
            format!("no primitive `{}` is declared", m.name)
        }
    }
    help(m) {
        Some(match &m.near {
            _ if m.is_policy => "remove it: a robot has every policy whose primitives it provides".to_owned(),
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("declare it in primitives.motet, `action {}()`, or remove it", m.name),
        })
    }

    /// Bounds of an unknown parameter in a card.
    UnknownBound("M0408", Error) { primitive: SmolStr, param: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("`{}` has no parameter `{}`", m.primitive, m.param) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None if m.known.is_empty() => format!("it has no parameters: write `{} = {{}}`", m.primitive),
            None => format!("its parameters are {}", m.known),
        })
    }

    /// Bounds of a parameter in the wrong unit, or of one that is no number. `unit` is the SI symbol of the
    /// parameter's quantity, empty for plain numbers; `None` if the parameter is no number.
    WrongBound("M0409", Error) { primitive: SmolStr, param: SmolStr, ty: String, unit: Option<&'static str> }
    message(m) {
        match m.unit {
            Some(_) => format!("`{}` of `{}` has the type {}, but its bounds have another unit", m.param, m.primitive, m.ty),
            None => format!("`{}` of `{}` has the type {}, but only numbers have bounds", m.param, m.primitive, m.ty),
        }
    }
    help(m) {
        Some(match m.unit {
            None => format!("write `{} = {{}}`", m.primitive),
            Some("") => "write both bounds without a unit".to_owned(),
            Some(unit) => format!("write both bounds in {unit}, such as `{{ least = \"0 {unit}\", greatest = \"1 {unit}\" }}`"),
        })
    }

    /// Provided primitive whose declaration needs something that the robot lacks.
    UnfitPrimitive("M0410", Error) { name: SmolStr, why: String, at: Span }
    message(m) { format!("this robot cannot provide `{}` as declared: {}", m.name, m.why) }
    help(m) { Some(format!("add what is missing to the card, declare `{0}` again in primitives.motet, or remove `{0}`", m.name)) }
    related(m) { vec![Related::new("declared here", m.at)] }

    /// Entry under `initially` of a card that is no fact.
    NotAtFirst("M0446", Error) { text: String, why: String, remedy: Option<String> }
    message(m) { format!("`{}` is not a fact: {}", m.text, m.why) }
    help(m) {
        let usual = || "write a fluent with its arguments, perhaps under one `not`, such as \"not standing(robot)\"".to_owned();
        Some(m.remedy.clone().unwrap_or_else(usual))
    }
}
