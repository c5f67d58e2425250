//! What the proof of a step asked for: questions that differ in nothing of it have one answer.

use super::Value;
use crate::ir::{Fluent, Term};
use crate::prove::facts::{ANY, Key};
use crate::prove::heed::Heeded;
use crate::session::Session;

/// The facts that the proof of a step asked for.
#[derive(Clone, Debug, Default)]
pub struct Heeds(pub(super) Heeded);

impl Heeds {
    /// Whether it asked for what a fluent says of these arguments: where it did not, it would have gone the same way whatever
    /// that is. An argument that is none is `any`.
    #[must_use]
    pub fn has(&self, session: &Session, fluent: &str, args: &[Option<Value>]) -> bool {
        let fluent: Option<Fluent> = session.parts().0.names.fluents.get(fluent).copied();
        let key = args.iter().enumerate().fold(Key(0), |key, (index, arg)| {
            let arg = match arg {
                Some(Value(Term::Entity(entity))) => entity.0,
                Some(Value(Term::Case(_, case))) => *case,
                // A name may be one of several.
                Some(_) | None => ANY,
            };
            key.with(index, arg)
        });
        fluent.is_none_or(|fluent| self.0.has(fluent, key))
    }
}
