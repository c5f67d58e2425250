//! A scene or a state that does not fit the library (M022x, M032x).

use motet_syntax::{Related, Span};
use smol_str::SmolStr;

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// A scene's entity of a kind that is not declared.
    UnknownKind("M0221", Error) { kind: SmolStr, entity: SmolStr, near: Option<SmolStr> }
    message(m) { format!("`{}` is of the kind `{}`, which is not declared", m.entity, m.kind) }
    help(m) { m.near.as_ref().map(|near| format!("did you mean `{near}`?")) }

    /// A scene's entity with a name that is taken.
    TakenName("M0222", Error) { entity: SmolStr }
    message(m) { format!("an entity `{}` exists already", m.entity) }
    help(_m) { Some("give the entity of the scene another id".to_owned()) }

    /// More entities than fit.
    TooManyEntities("M0223", Error) { limit: usize }
    message(m) { format!("the scene has more than {} entities", m.limit) }
    help(_m) { Some("leave out what the policy does not touch".to_owned()) }

    /// A state whose entry is no fact.
    NotAFact("M0224", Error) { text: String, why: String, remedy: Option<String> }
    message(m) { format!("`{}` is not a fact: {}", m.text, m.why) }
    help(m) {
        let usual = || "write a fluent with its arguments, such as \"on(mug_1, table)\": true".to_owned();
        Some(m.remedy.clone().unwrap_or_else(usual))
    }

    /// A state whose facts cannot all be so: what is held and what the hands are free for.
    Contradiction("M0225", Error) { what: String, remedy: String, other: Option<Span> }
    message(m) { m.what.clone() }
    help(m) { Some(m.remedy.clone()) }
    related(m) { m.other.iter().map(|other| Related::new("and this here", *other)).collect() }
}
