//! Diagnostics of a scene beyond its JSON (M0431 to M0445, M0481 to M0483): numbers, ids and relations.

use motet_syntax::{Edit, Fix, Related, Span};
use smol_str::SmolStr;

use super::model::MAX_ENTITIES;
use super::quantity::{FURTHEST, SceneQuantity};
use crate::clearance::GREATEST_CLEARANCE;

motet_syntax::mistakes! {
    pub const CODES;

    /// Another version of the format.
    Version("M0431", Error) { found: u32 }
    message(m) { format!("the scene has format version {}; only version 1 is supported", m.found) }
    help(_m) { Some("write `\"motet_scene\": 1`".into()) }
    fix(m) { Some(replace(m.span, "1", "1")) }

    /// Another frame than `map`.
    Frame("M0432", Error) { found: SmolStr }
    message(m) { format!("unknown frame `{}`: the poses of a scene are in the frame `map`", m.found) }
    help(_m) { Some("transform the poses into `map` and write `\"frame\": \"map\"`".into()) }

    /// Two entities with one id.
    DuplicateId("M0433", Error) { id: SmolStr, first: Span }
    message(m) { format!("the id `{}` is used twice", m.id) }
    help(_m) { Some("give each entity an id of its own".into()) }
    related(m) { vec![Related::new("it is first used here", m.first)] }

    /// An id that no policy could name, or another name that does not stand on one line.
    BadId("M0434", Error) { key: &'static str, id: SmolStr }
    message(m) {
        match (m.key, m.id.is_empty()) {
            ("id", true) => "an id is empty".into(),
            ("id", false) => format!("`{}` cannot be named in a policy", m.id.escape_debug()),
            (key, _) => format!("`{key}` has a control character: `{}`", m.id.escape_debug()),
        }
    }
    help(m) {
        Some(match m.key {
            "id" => "an id has no back-quote, comma, semicolon or control character".into(),
            _ => "a name stands on one line and shows all of its characters".into(),
        })
    }

    /// An id that has a meaning of its own in the language.
    ReservedId("M0435", Error) { id: SmolStr }
    message(m) { format!("the id `{}` is reserved", m.id) }
    help(m) {
        Some(match m.id.as_str() {
            "robot" => "the robot stands under `\"robot\"`, not among the entities".into(),
            other => format!("name it otherwise, such as `{other}_1`"),
        })
    }

    /// More entities than a scene may have.
    TooManyEntities("M0436", Error) { count: usize }
    message(m) { format!("the scene has {} entities, more than the limit of {MAX_ENTITIES}", m.count) }
    help(_m) { Some("leave out entities that the robot does not need".into()) }

    /// A name that no entity has.
    UnknownEntity("M0437", Error) { key: &'static str, name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("`{}` names the entity `{}`, which the scene does not have", m.key, m.name) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("add it to `entities`, or leave out `{}`", m.key),
        })
    }
    fix(m) { m.near.as_ref().map(|near| replace(m.span, &quoted(near), near)) }

    /// Things that support each other in a cycle.
    SupportCycle("M0438", Error) { ring: Vec<SmolStr>, others: Vec<(SmolStr, Span)> }
    message(m) {
        match m.ring.as_slice() {
            [alone] => format!("`{alone}` is on or in itself"),
            ring => {
                let mut names: Vec<_> = ring.iter().take(8).map(|id| format!("`{id}`")).collect();
                if ring.len() > names.len() {
                    names.push(format!("{} more", ring.len() - names.len()));
                }
                names.extend(ring.first().map(|id| format!("`{id}`")));
                format!("supports form a cycle: {}", names.join(", "))
            }
        }
    }
    help(_m) { Some("put at least one of them on something else, or on nothing".into()) }
    related(m) {
        m.others
            .iter()
            .map(|(id, span)| Related::new(format!("the support of `{id}` is here"), *span))
            .collect()
    }

    /// A thing that is in the hand and elsewhere too.
    HeldElsewhere("M0439", Error) { id: SmolStr, held: Span }
    message(m) { format!("`{}` is held, but also on or in something", m.id) }
    help(_m) { Some("remove `on` and `in` of the held object".into()) }
    related(m) { vec![Related::new("it is held here", m.held)] }

    /// A number of its own that has a key of its own, or stands twice.
    FieldTwice("M0440", Error) { field: SmolStr }
    message(m) { format!("the field `{}` has a key of its own", m.field) }
    help(m) { Some(format!("write `\"{}\": …` beside `fields`, not in it", m.field)) }

    /// A size, mass or way that is zero or negative.
    NotPositive("M0441", Error) { quantity: SceneQuantity, found: f64 }
    message(m) { format!("{} is {}, but must be above zero", m.quantity.words(), m.quantity.show(m.found)) }

    /// A coordinate or size beyond what a room has, or an angle beyond what is exact.
    TooFar("M0442", Error) { quantity: SceneQuantity, found: f64 }
    message(m) {
        let limit = m.quantity.show(FURTHEST);
        format!("{} is {}, but at most {limit} is allowed", m.quantity.words(), m.quantity.show(m.found))
    }
    help(m) {
        let help = match m.quantity {
            SceneQuantity::Angle => "angles are in radians, and a full turn, 6.28, leaves them as they are",
            SceneQuantity::Joint => "joints are in radians, or in metres where they slide",
            _ => "lengths are in metres: 72 cm is 0.72",
        };
        Some(help.into())
    }

    /// An axis without a direction.
    ZeroAxis("M0443", Error) {}
    message(_m) { "the axis has length 0, so it has no direction".into() }
    help(_m) { Some("write a direction such as `[0, 0, 1]`".into()) }

    /// A door that opens by more than a turn.
    TooWideAngle("M0444", Error) { found: f64 }
    message(m) {
        format!(
            "the door opens by {:.2} rad, more than a full turn, {:.2} rad",
            m.found,
            std::f64::consts::TAU
        )
    }
    help(m) { Some(format!("angles are in radians: {} deg is {:.4}", m.found, m.found.to_radians())) }

    /// A name that is empty.
    EmptyName("M0445", Error) { key: &'static str }
    message(m) { format!("`{}` is empty", m.key) }
    help(_m) { Some("write the name of a kind such as `Object`".into()) }

    /// A clearance that no room needs.
    BadClearance("M0482", Error) { found: f64 }
    message(m) {
        format!("the clearance is {} m, but must be from 0 to {GREATEST_CLEARANCE} m", m.found)
    }
    help(_m) { Some("it is the distance from obstacles in metres: 5 cm is 0.05".into()) }

    /// A grip of nothing.
    GripOfNothing("M0483", Error) {}
    message(_m) { "`grip` is the pose of a held entity, but `holding` names none".into() }
    help(_m) { Some("name the held entity in `holding`, or leave out `grip`".into()) }

    /// A zone that is no area of the floor.
    BadZone("M0481", Error) { id: SmolStr, problem: &'static str }
    message(m) { format!("the zone `{}` {}; a zone is an area of the floor", m.id, m.problem) }
    help(_m) {
        Some("give its middle on the floor as `pose`, and its extent as a `box` or a `cylinder`".into())
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn replace(span: Span, text: &str, name: &str) -> Fix {
    Fix { title: format!("write `{name}`"), edits: vec![Edit { span, text: text.into() }] }
}
