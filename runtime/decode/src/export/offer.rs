//! What the signatures and the world offer a policy, place by place: the one source of all exported grammars.

use motet_compiler::Signatures;
use motet_compiler::signature::Type;
use motet_syntax::Syntax;
use motet_syntax::words::RESERVED;
use smol_str::SmolStr;

use super::value_set::{ValueContext, ValueSet};
use crate::subset::{NumberRange, Subset};

/// Above so many entities and cases a name of the text form may be one of theirs: a grammar that excludes them all would be
/// larger than all the rest of it.
pub(super) const MAX_EXCLUDED: usize = 1_000;

/// What a policy may be made of.
#[derive(Clone, PartialEq, Debug)]
pub struct Offer {
    /// Of which subset.
    pub subset: Subset,
    /// The robot; none where the library has none.
    pub robot: Option<SmolStr>,
    /// The places of values that what follows names.
    pub slots: Vec<ValueSet>,
    /// What a step may call.
    pub calls: Vec<CallOffer>,
    /// What a step may ask for: only what the robot observes.
    pub asked: Vec<Atom>,
    /// What a goal may ask for: nothing that is bound.
    pub goals: Vec<Atom>,
    /// The place of a reason.
    pub why: usize,
    /// The entities of each kind that has any, for the list of an `each`.
    pub lists: Vec<Vec<SmolStr>>,
    /// Whether anything binds a list.
    pub binds_lists: bool,
    /// The kinds of failure.
    pub failures: Vec<SmolStr>,
    /// What a name of the text form may not be.
    pub excluded: Vec<SmolStr>,
}

/// A callable.
#[derive(Clone, PartialEq, Debug)]
pub struct CallOffer {
    /// Its name.
    pub name: SmolStr,
    /// Its parameters with their places.
    pub args: Vec<(SmolStr, usize)>,
    /// Whether it has a deadline and retries on this subset.
    pub modifiers: bool,
    /// Whether it has a result.
    pub binds: bool,
}

/// A condition that has none within.
#[derive(Clone, PartialEq, Debug)]
pub enum Atom {
    /// A fluent with its parameters.
    Fluent(SmolStr, Vec<(SmolStr, usize)>),
    /// A measure with its parameters, and with what it is compared.
    Measure(SmolStr, Vec<(SmolStr, usize)>, usize),
    /// A field, the entity, and with what it is compared.
    Field(SmolStr, usize, usize),
}

impl Offer {
    /// The offer of signatures for a subset.
    #[must_use]
    pub fn new(signatures: &Signatures, subset: Subset) -> Self {
        let mut builder = Builder { signatures, bindable: signatures.bindable(), slots: Vec::new() };
        let written = subset.modifiers == crate::subset::Modifiers::Written;
        let calls = signatures.callables.iter().filter_map(|callable| {
            let params = callable.params.iter().map(|param| (&param.name, &param.ty, param.range));
            Some(CallOffer {
                name: callable.name.clone(),
                args: builder.args(params, STEP)?,
                modifiers: written && !callable.is_policy,
                binds: callable.result.is_some(),
            })
        });
        let calls = calls.collect();
        let asked = builder.atoms(STEP);
        let goals = builder.atoms(GOAL);
        let why = builder.slot(&Type::Text, None, STEP).unwrap_or(0);
        let (binds_lists, slots) =
            (builder.bindable.iter().any(|ty| matches!(ty, Type::List(_))), builder.slots);
        let own = |kind: usize| {
            signatures.entities.iter().filter(move |row| row.1 == kind).map(|row| row.0.clone())
        };
        Self {
            subset,
            robot: Some(&signatures.robot).filter(|robot| !robot.is_empty()).cloned(),
            slots,
            calls,
            asked,
            goals,
            why,
            lists: (0..signatures.kinds.len())
                .map(|kind| own(kind).collect())
                .filter(|list: &Vec<_>| !list.is_empty())
                .collect(),
            binds_lists,
            failures: signatures.failures.clone(),
            excluded: if subset.syntax == Syntax::Text { excluded(signatures) } else { Vec::new() },
        }
    }

    /// A place of a value.
    #[must_use]
    pub fn slot(&self, id: usize) -> Option<&ValueSet> {
        self.slots.get(id)
    }
}

const STEP: ValueContext = ValueContext { binds: true, any: false };
const GOAL: ValueContext = ValueContext { binds: false, any: false };

struct Builder<'a> {
    signatures: &'a Signatures,
    bindable: Vec<Type>,
    slots: Vec<ValueSet>,
}

impl Builder<'_> {
    /// The place of a value; none where nothing may stand there.
    fn slot(&mut self, ty: &Type, range: Option<(f64, f64)>, place: ValueContext) -> Option<usize> {
        let mut slot = ValueSet::of(ty, range, place, self.signatures, &self.bindable);
        if let Type::List(element) = ty {
            slot.items = self.slot(element, None, place);
        }
        if slot.is_empty() {
            return None;
        }
        if let Some(known) = self.slots.iter().position(|known| *known == slot) {
            return Some(known);
        }
        self.slots.push(slot);
        Some(self.slots.len() - 1)
    }

    /// The places of arguments; none where one of them takes nothing.
    fn args<'p>(
        &mut self,
        params: impl Iterator<Item = (&'p SmolStr, &'p Type, Option<(f64, f64)>)>,
        place: ValueContext,
    ) -> Option<Vec<(SmolStr, usize)>> {
        params.map(|(name, ty, range)| Some((name.clone(), self.slot(ty, range, place)?))).collect()
    }

    fn atoms(&mut self, place: ValueContext) -> Vec<Atom> {
        let signatures = self.signatures;
        let needs_observing = place.binds;
        let mut atoms = Vec::new();
        for fluent in signatures.fluents.iter().filter(|fluent| fluent.is_observable || !needs_observing) {
            let params = fluent.params.iter().map(|(name, ty)| (name, ty, None));
            if let Some(args) = self.args(params, ValueContext { any: true, ..place }) {
                atoms.push(Atom::Fluent(fluent.name.clone(), args));
            }
        }
        for measure in signatures.measures.iter().filter(|measure| measure.is_observable || !needs_observing)
        {
            let params = measure.params.iter().map(|(name, ty)| (name, ty, None));
            // A comparison is with a value that is written out.
            if let Some(args) = self.args(params, place)
                && let Some(than) = self.slot(&measure.result, None, GOAL)
                && !measure.params.iter().any(|(name, _)| name == "than")
            {
                atoms.push(Atom::Measure(measure.name.clone(), args, than));
            }
        }
        let mut fields: Vec<&SmolStr> = Vec::new();
        for field in &signatures.fields {
            // Of two kinds with a field of one name the first counts.
            if fields.contains(&&field.name) {
                continue;
            }
            fields.push(&field.name);
            if let Some(of) = self.slot(&Type::Entity(field.kind), None, place)
                && let Some(than) = self.slot(&field.ty, None, GOAL)
            {
                atoms.push(Atom::Field(field.name.clone(), of, than));
            }
        }
        atoms
    }
}

/// The words of the language, and the names of entities and cases where they are not too many.
fn excluded(signatures: &Signatures) -> Vec<SmolStr> {
    let mut words: Vec<SmolStr> = RESERVED.iter().map(|word| SmolStr::new_static(word)).collect();
    let cases = signatures.enums.iter().flat_map(|def| def.cases.iter());
    let named: Vec<_> = signatures.entities.iter().map(|row| &row.0).chain(cases).cloned().collect();
    if named.len() <= MAX_EXCLUDED {
        words.extend(named);
    }
    words
}

/// With which range a comparison is not by equality alone.
pub(super) fn is_ordered(slot: Option<&ValueSet>) -> bool {
    slot.is_some_and(|slot| slot.number.is_some())
}

/// Times, in seconds.
pub(super) const SECONDS: NumberRange = NumberRange::DURATION;
