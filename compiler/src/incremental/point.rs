//! Knowledge at a program point of a whole policy, for editors: the facts with their causes, and the
//! questions of an incremental check.

use motet_syntax::ast::Policy;
use motet_syntax::{Span, Syntax};
use smol_str::SmolStr;

use super::{IncrementalChecker, PROGRAM_POINT, Start};
use crate::facts::{ANY, Cause, FactKey, TruthSet, show};
use crate::ir::{Fluent, StepId};
use crate::prove::Prover;
use crate::prove::suspended::SuspendedProof;
use crate::session::Session;
use crate::signature::{Type, of_type};

/// Fact at a program point.
#[derive(Clone, PartialEq, Debug)]
pub struct KnownFact {
    /// The fact in the language: `holding(mug_1)`.
    pub text: String,
    /// Names of its entities and cases; `any` where it is about all.
    pub args: Vec<SmolStr>,
    pub truth: KnownTruth,
    pub cause: FactCause,
}

/// Truth of a fact over all paths to a program point.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum KnownTruth {
    /// True on every path.
    Holds,
    /// False on every path.
    Fails,
    /// True on some paths and false on others.
    Differs,
    /// Known only to the run, on some path at least.
    Unobserved,
}

/// Cause of what is known about a fact.
#[derive(Clone, PartialEq, Debug)]
pub enum FactCause {
    /// Nothing was said.
    Nothing,
    /// The scene, the state, the card or a declaration.
    Start,
    /// A step, with its short name: `go(kitchen_table)`.
    Step { span: Span, name: SmolStr },
}

impl IncrementalChecker {
    /// Checker at the step with the span [`PROGRAM_POINT`] of a whole policy. Steps with an error may change
    /// any fact. Only questions about this point have a meaning; steps cannot be pushed. `None` if the policy
    /// has no such step.
    #[must_use]
    pub fn at_point(session: &Session, policy: &Policy, form: Syntax) -> Option<Self> {
        let (library, environment) = session.parts();
        let (program, scope_at_point) =
            crate::resolve::resolve_at(policy, PROGRAM_POINT, form, library, environment);
        let index = program.steps.iter().position(|step| step.span == PROGRAM_POINT)?;
        let point = StepId(u32::try_from(index).ok()?);
        let mut proof = SuspendedProof::new(&program, library, environment);
        let (steps, bindings) = (program.steps.len(), program.bindings.len());
        let scope = crate::declare::name::Scope::default();
        let start = Start { steps, bindings, scope: scope.mark(), proof: proof.mark(steps) };
        let states = proof.states_at(point, (&program, library, environment));
        Some(Self {
            form,
            program,
            kept: None,
            scope,
            proof,
            starts: Vec::new(),
            inside: Some((start, states)),
            point: Some(point),
            scope_at_point,
        })
    }

    /// Type of the binding with a name that is visible at the program point; `None` after an error.
    #[must_use]
    pub fn binding_type(&self, name: &str) -> Option<Type> {
        of_type(self.scope_here().find(name)?.ty)
    }

    /// Facts at the program point, over all states in which control reaches it: those that a step has
    /// changed first, the latest step before the others, then those of the start. O(states × facts).
    pub fn known_facts(&mut self, session: &Session) -> Vec<KnownFact> {
        let (library, environment) = session.parts();
        let Self { proof, program, inside, .. } = self;
        let given = (&*program, library, environment);
        let Some((_, states)) = inside else { return Vec::new() };
        let mut atoms: Vec<(Fluent, FactKey)> = Vec::new();
        for state in states.iter_mut() {
            proof.at(state, given, |prover| atoms.extend(prover.atoms()));
        }
        atoms.sort_unstable();
        atoms.dedup();
        let mut values = vec![TruthSet::default(); atoms.len()];
        for state in states.iter_mut() {
            proof.at(state, given, |prover| {
                for (value, (fluent, key)) in values.iter_mut().zip(&atoms) {
                    *value = value.join(prover.state.facts.get(*fluent, *key));
                }
            });
        }
        let Some((_, states)) = inside else { return Vec::new() };
        let Some(state) = states.first_mut() else { return Vec::new() };
        let mut known = proof.at(state, given, |prover| {
            let facts = atoms.iter().zip(&values);
            facts.filter_map(|(atom, value)| prover.known(*atom, *value)).collect::<Vec<_>>()
        });
        known.sort_by_key(|(step, _)| (step.is_none(), std::cmp::Reverse(*step)));
        known.into_iter().map(|(_, fact)| fact).collect()
    }
}

impl Prover<'_> {
    /// Facts and patterns with values of their own.
    fn atoms(&self) -> Vec<(Fluent, FactKey)> {
        let mut atoms = Vec::new();
        for (index, def) in self.library.fluents.iter().enumerate() {
            let Ok(fluent) = u16::try_from(index).map(Fluent) else { break };
            if !def.derived {
                self.state.facts.parts(fluent, FactKey::ALL, |key| atoms.push((fluent, key)));
            }
        }
        atoms
    }

    /// Description of a fact, with the step that caused it; `None` if nothing was ever said.
    fn known(
        &self,
        (fluent, key): (Fluent, FactKey),
        value: TruthSet,
    ) -> Option<(Option<StepId>, KnownFact)> {
        let def = self.library.fluent(fluent)?;
        let truth = match (value.yes.is_some(), value.no.is_some(), value.open.is_some()) {
            (true, false, false) => KnownTruth::Holds,
            (false, true, false) => KnownTruth::Fails,
            (true, true, false) => KnownTruth::Differs,
            _ => KnownTruth::Unobserved,
        };
        let causes = [value.open, value.yes, value.no];
        let cause = causes.into_iter().filter(|cause| cause.is_some()).max_by_key(|cause| cause.as_step());
        let cause = cause.unwrap_or(Cause::NOTHING);
        let step = cause.as_step();
        let (step, cause) = match step.and_then(|id| self.program.step(id)) {
            Some(step_of) => {
                let name = self.cause_name(cause);
                (step, FactCause::Step { span: step_of.span, name })
            }
            None if cause.is_start() => (None, FactCause::Start),
            None if truth == KnownTruth::Unobserved => return None,
            None => (None, FactCause::Nothing),
        };
        let args = (0..def.params.len()).map(|index| match key.arg(index) {
            ANY => SmolStr::new_static("any"),
            arg => self.argument_name(fluent, index, arg),
        });
        let text =
            show(&def.name, key, def.params.len(), |index, arg| self.argument_name(fluent, index, arg));
        let text = text.trim_matches('`').to_owned();
        Some((step, KnownFact { text, args: args.collect(), truth, cause }))
    }
}
