//! Which fluents a step speaks of: what it needs, asks or changes. What speaks of none that another step speaks of can
//! neither refute that step nor be refuted by it.

use motet_syntax::ast::PrimitiveKind;

use super::Template;
use crate::ir::{Base, Condition, Fluent, StepKind};
use crate::library::{Library, NeedDef, PrimitiveDef};
use crate::session::Session;

/// Stands for how fresh a pose is.
const FRESH: u64 = 1 << 63;

/// The bit of a fluent; several may share one.
fn bit(fluent: Fluent) -> u64 {
    1 << (fluent.index() % 63)
}

impl super::Draft {
    /// The fluents that a call of this name speaks of, as bits; several may share one. Of what is not known all.
    #[must_use]
    pub fn fluents(session: &Session, name: &str, template: Option<&Template>) -> u64 {
        let library = session.parts().0;
        match (library.names.primitives.get(name).and_then(|id| library.primitive(*id)), template) {
            (Some(def), _) => of_primitive(def, library),
            (None, Some(template)) => template.fluents,
            (None, None) => u64::MAX,
        }
    }

    /// The bit of the fluent with this name.
    #[must_use]
    pub fn fluent(session: &Session, name: &str) -> u64 {
        session.parts().0.names.fluents.get(name).map_or(u64::MAX, |fluent| bit(*fluent))
    }
}

fn of_condition(condition: &Condition) -> u64 {
    match condition {
        Condition::Fact(fact) => bit(fact.fluent),
        whole => whole.parts().iter().fold(0, |all, part| all | of_condition(part)),
    }
}

fn when(when: Option<&Condition>) -> u64 {
    when.map_or(0, of_condition)
}

/// What a need asks for.
pub(super) fn of_need(need: &NeedDef) -> u64 {
    of_condition(&need.condition) | when(need.when.as_ref())
}

/// What a primitive changes, and what that depends on.
pub(super) fn of_effects(def: &PrimitiveDef, library: &Library) -> u64 {
    let effects = def.makes.iter().chain(&def.unsettles);
    let effects = effects.map(|effect| bit(effect.fact.fluent) | when(effect.when.as_ref()));
    let mut all = effects.fold(0, |all, more| all | more);
    // What was perceived is stale once its resource is used or its object moved.
    let moves = def.form == PrimitiveKind::Action && !(def.makes.is_empty() && def.unsettles.is_empty());
    let lasts = library.primitives.iter().filter_map(|def| def.lasts.as_ref());
    if moves || lasts.into_iter().any(|lasts| lasts.resources & def.uses != 0) {
        all |= library.perceived.iter().fold(FRESH, |all, fluent| all | bit(*fluent));
    }
    all
}

fn of_primitive(def: &PrimitiveDef, library: &Library) -> u64 {
    let mut all = def.needs.iter().fold(of_effects(def, library), |all, need| all | of_need(need));
    if def.lasts.is_some() || def.params.iter().any(|param| param.ty.base == Base::Pose) {
        all |= FRESH;
    }
    all
}

/// What a step itself speaks of, without those in it.
pub(super) fn of_step(kind: &StepKind, library: &Library) -> u64 {
    match kind {
        StepKind::Call(call) => {
            library.primitive(call.primitive).map_or(u64::MAX, |def| of_primitive(def, library))
        }
        StepKind::Unknown => u64::MAX,
        other => other.conditions().fold(0, |all, condition| all | of_condition(condition)),
    }
}
