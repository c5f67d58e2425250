//! Diagnostics of a scene or a state that does not fit the library (M022x, M032x).

use motet_syntax::{Related, Span};
use smol_str::SmolStr;

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Entity of a scene with an unknown kind.
    UnknownKind("M0221", Error) { kind: SmolStr, entity: SmolStr, near: Option<SmolStr> }
    message(m) { format!("`{}` has the kind `{}`, which is not declared", m.entity, m.kind) }
    help(m) { m.near.as_ref().map(|near| format!("did you mean `{near}`?")) }

    /// Entity of a scene with a name that is taken.
    TakenName("M0222", Error) { entity: SmolStr }
    message(m) { format!("there is already an entity `{}`", m.entity) }
    help(_m) { Some("give the entity in the scene another id".to_owned()) }

    /// Scene with too many entities.
    TooManyEntities("M0223", Error) { limit: usize }
    message(m) { format!("the scene has more than {} entities", m.limit) }
    help(_m) { Some("remove entities that the policies do not use".to_owned()) }

    /// Entry of a state that is no fact.
    NotAFact("M0224", Error) { text: String, why: String, remedy: Option<String> }
    message(m) { format!("`{}` is not a fact: {}", m.text, m.why) }
    help(m) {
        let usual = || "write a fluent with its arguments, such as \"on(mug_1, table)\": true".to_owned();
        Some(m.remedy.clone().unwrap_or_else(usual))
    }

    /// Contradiction between facts about the hands.
    Contradiction("M0225", Error) { what: String, remedy: String, other: Option<Span> }
    message(m) { m.what.clone() }
    help(m) { Some(m.remedy.clone()) }
    related(m) { m.other.iter().map(|other| Related::new("contradicts this", *other)).collect() }
}
