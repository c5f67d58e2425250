//! Concrete states: every fact true, false or unobserved.

use super::make::{Arg, Atom, Domain, Effect, Literal};

/// Every fact of a domain, by its place.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct State {
    facts: Vec<Option<bool>>,
    /// Remaining runs of the reaction of each enclosing monitor, the outermost first.
    pub(super) left: Vec<usize>,
}

/// Index of the first fact of each fluent.
fn offset(domain: &Domain, fluent: usize) -> usize {
    domain.arities.iter().take(fluent).map(|arity| count(domain, *arity)).sum()
}

/// Beside the entities that a domain names there is one that stands for all others.
fn count(domain: &Domain, arity: usize) -> usize {
    (0..arity).fold(1, |count, _| count * (domain.entities + 1))
}

/// The places of the facts that an atom means, of a call on `entity`.
pub(super) fn places(domain: &Domain, atom: &Atom, entity: usize) -> Vec<usize> {
    let mut places = vec![0];
    for (index, arg) in atom.args.iter().enumerate() {
        let weight = count(domain, index);
        let choices = match arg {
            Arg::Param => entity..entity + 1,
            Arg::Entity(other) => *other..*other + 1,
            Arg::Any => 0..domain.entities + 1,
        };
        places = choices.flat_map(|choice| places.iter().map(move |place| place + choice * weight)).collect();
    }
    let base = offset(domain, atom.fluent);
    places.into_iter().map(|place| base + place).collect()
}

impl State {
    pub(super) fn start(domain: &Domain) -> Self {
        let size = offset(domain, domain.arities.len());
        let facts = vec![domain.is_closed.then_some(false); size];
        let mut state = Self { facts, left: Vec::new() };
        for (atom, truth) in &domain.start {
            state.set(domain, atom, 0, Some(*truth));
        }
        state
    }

    pub(super) fn set(&mut self, domain: &Domain, atom: &Atom, entity: usize, value: Option<bool>) {
        for place in places(domain, atom, entity) {
            if let Some(slot) = self.facts.get_mut(place) {
                *slot = value;
            }
        }
    }

    /// Truth of a literal; of one with `any`, of its existential closure.
    pub(super) fn value(&self, domain: &Domain, literal: &Literal, entity: usize) -> Option<bool> {
        let values: Vec<_> = places(domain, &literal.atom, entity)
            .into_iter()
            .map(|place| self.facts.get(place).copied().flatten())
            .collect();
        let some = if values.contains(&Some(true)) {
            Some(true)
        } else if values.contains(&None) {
            None
        } else {
            Some(false)
        };
        some.map(|some| some == literal.truth)
    }

    /// The state after a literal was seen to be `truth`; of one with `any` that holds it is not known for
    /// which entity.
    pub(super) fn seen(&self, domain: &Domain, literal: &Literal, entity: usize, truth: bool) -> Self {
        let mut after = self.clone();
        let holds = literal.truth == truth;
        if places(domain, &literal.atom, entity).len() == 1 || !holds {
            after.set(domain, &literal.atom, entity, Some(holds));
        }
        after
    }

    /// This state with effects whose conditions are those of the state `before`: what is unmade first, so
    /// that what is made wins.
    pub(super) fn with_effects(
        mut self,
        domain: &Domain,
        before: &Self,
        effects: &[Effect],
        entity: usize,
    ) -> Self {
        for truth in [false, true] {
            for effect in effects.iter().filter(|effect| effect.literal.truth == truth) {
                let happens =
                    effect.when.as_ref().map_or(Some(true), |when| before.value(domain, when, entity));
                for place in places(domain, &effect.literal.atom, entity) {
                    let Some(slot) = self.facts.get_mut(place) else { continue };
                    match happens {
                        Some(true) => *slot = Some(truth),
                        Some(false) => {}
                        // It may have happened: known only where it changes nothing.
                        None if *slot == Some(truth) => {}
                        None => *slot = None,
                    }
                }
            }
        }
        self
    }

    /// The state after a failure: what it would have changed is not known.
    pub(super) fn shaken(&self, domain: &Domain, effects: &[Effect], entity: usize) -> Self {
        let mut after = self.clone();
        for effect in effects {
            let happens = effect.when.as_ref().map_or(Some(true), |when| self.value(domain, when, entity));
            if happens != Some(false) {
                after.set(domain, &effect.literal.atom, entity, None);
            }
        }
        after
    }
}
