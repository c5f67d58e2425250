//! Incremental checks: a policy is checked while it is written, step by step, for hosts that must know what
//! may come next.
//!
//! The stages themselves answer: a step is resolved, checked and proved from the state after the steps before
//! it, so an answer costs one step and not the whole policy. Questions about the end of a policy are asked of
//! a step that is closed for the time being: see [`IncrementalChecker::permits_step`].
//!
//! Guarded by the tests of `runtime/decode`, above all the properties of its acceptor.

mod point;
mod template;

use std::hash::Hasher;

use motet_syntax::ast::{self, Policy, Step};
use motet_syntax::{Diagnostic, FileId, Severity, Span, Syntax};
use rustc_hash::FxHasher;
use smallvec::SmallVec;
use smol_str::SmolStr;

pub use self::point::{FactCause, KnownFact, KnownTruth};
pub use self::template::PolicyTemplate;
use crate::declare::name::{Scope, ScopeMark};
use crate::facts::effort;
use crate::ir::{Condition, Entity, EnumId, Fact, Fluent, Program, StepId, StepKind, Term};
use crate::prove::suspended::{Checkpoint, ProofTarget, StepOutcome, SuspendedProof};
use crate::prove::{AbstractState, Prover};
use crate::session::Session;

/// Span of the step that marks the program point at which the next step will be written.
pub const PROGRAM_POINT: Span = Span { file: FileId(u16::MAX), start: u32::MAX - 1, end: u32::MAX };

/// Span of a sequence that stands for any one of its steps: see [`IncrementalChecker::permits_any`].
pub const CHOICE: Span = Span { file: FileId(u16::MAX), start: u32::MAX - 2, end: u32::MAX };

/// Asks questions that may take a limited effort together: `effort` is a number of facts that proofs look at,
/// where the visit of a step counts as 40. Once [`is_used_up`], all answers are "no", and nobody may rely on
/// them. The same questions take the same effort on every machine.
pub fn within<T>(effort: u64, ask: impl FnOnce() -> T) -> T {
    effort::within(effort, ask)
}

/// Returns whether the effort of the questions [`within`] a limit is used up.
#[must_use]
pub fn is_used_up() -> bool {
    effort::is_used_up()
}

/// Argument of a call that is being written.
#[derive(Clone, PartialEq, Debug)]
pub struct ArgumentValue(Term);

impl ArgumentValue {
    /// Entity by its index in the environment.
    #[must_use]
    pub fn entity(index: u16) -> Self {
        Self(Term::Entity(Entity(index)))
    }

    /// Case of an enumeration, by their indices.
    #[must_use]
    pub fn case(of: u16, case: u16) -> Self {
        Self(Term::Case(EnumId(of), case))
    }

    /// Number, in SI units if it has a dimension.
    #[must_use]
    pub fn number(value: f64) -> Self {
        Self(Term::Number(value))
    }

    /// A text literal.
    #[must_use]
    pub fn text(text: impl Into<SmolStr>) -> Self {
        Self(Term::Text(text.into()))
    }

    /// A list of arguments.
    #[must_use]
    pub fn list(items: impl IntoIterator<Item = Self>) -> Self {
        Self(Term::List(items.into_iter().map(|item| item.0).collect()))
    }

    /// The first element of this list.
    #[must_use]
    pub fn first(self) -> Self {
        Self(Term::First(Box::new(self.0)))
    }

    /// An unknown value.
    #[must_use]
    pub fn unknown() -> Self {
        Self(Term::Unknown)
    }
}

/// Result of a test at the end of a loop's body.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LoopTest {
    /// The test always holds, so the body does not run again.
    Holds,
    /// Only a proof of the loop decides.
    Open,
    /// The test is about facts that the loop leaves unchanged, so an error without it is an error with it.
    Idle,
}

/// Checker of a policy that is being written. Clones are independent; a clone costs the size of the policy.
///
/// ```
/// use motet_compiler::Session;
/// use motet_compiler::incremental::IncrementalChecker;
/// use motet_syntax::{FileId, Source, Sources, Syntax};
///
/// let session = Session::builder().build(&mut Sources::default());
/// let source = Source::new("greet.motet", "policy greet { say(\"hello\") sya(\"you\") }");
/// let parsed = motet_syntax::read(&source, FileId(99));
/// let policy = parsed.file.policies().next().expect("one policy");
/// let (mut checker, diagnostics) = IncrementalChecker::new(&session, policy, Syntax::Text);
/// assert!(diagnostics.is_empty());
/// assert!(checker.push(&session, &policy.body.steps[0]));
/// assert!(!checker.permits_step(&session, &policy.body.steps[1]));
/// assert_eq!(checker.len(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct IncrementalChecker {
    form: Syntax,
    program: Program,
    /// The step whose rules hold for the whole body.
    kept: Option<StepId>,
    scope: Scope,
    proof: SuspendedProof,
    /// Checkpoints before the steps of the body.
    starts: Vec<Start>,
    /// Checkpoint before the open step, and the states in which control reaches the program point in it.
    inside: Option<(Start, Vec<AbstractState<'static>>)>,
    /// The step at the program point in the open step, and the scope there.
    point: Option<StepId>,
    scope_at_point: Option<Scope>,
}

/// Checkpoint before a step.
#[derive(Clone, Debug)]
struct Start {
    steps: usize,
    bindings: usize,
    scope: ScopeMark,
    proof: Checkpoint,
}

impl IncrementalChecker {
    /// Starts a policy with a name, a robot, a goal and rules of where the robot may not go; its steps are
    /// ignored. The diagnostics are about these; the checker is usable in any case.
    #[must_use]
    pub fn new(session: &Session, policy: &Policy, form: Syntax) -> (Self, Vec<Diagnostic>) {
        let (library, environment) = session.parts();
        let head = Policy { body: ast::Block::default(), cleanup: None, ..policy.clone() };
        let (mut program, mut said) = crate::resolve::resolve(&head, form, library, environment);
        said.extend(crate::limits::check_robot_name(policy, library));
        let kept = program.body.first().copied();
        program.body.clear();
        let mut proof = SuspendedProof::new(&program, library, environment);
        if let Some(kept) = kept {
            proof.watch(kept, (&program, library, environment));
        }
        (
            Self {
                form,
                program,
                kept,
                scope: Scope::default(),
                proof,
                starts: Vec::new(),
                inside: None,
                point: None,
                scope_at_point: None,
            },
            said,
        )
    }

    /// Index of a primitive in the session's library.
    #[must_use]
    pub fn primitive(session: &Session, name: &str) -> Option<usize> {
        session.parts().0.names.primitives.get(name).map(|id| id.index())
    }

    /// Resources, one a bit, that a primitive or policy uses while it runs.
    #[must_use]
    pub fn resources(session: &Session, name: &str, template: Option<&PolicyTemplate>) -> u64 {
        let library = session.parts().0;
        match (library.names.primitives.get(name).and_then(|id| library.primitive(*id)), template) {
            (Some(def), _) => def.uses,
            (None, Some(template)) => template.uses,
            (None, None) => 0,
        }
    }

    /// Number of steps of the body.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// Returns whether the body has no step.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.starts.is_empty()
    }

    /// Appends a step to the body. Returns false, and appends nothing, if the step has an error.
    pub fn push(&mut self, session: &Session, step: &Step) -> bool {
        let start = self.start();
        let (id, outcome) = self.prove(session, step, Looks::Away);
        let Some(id) = id.filter(|_| !outcome.refuted) else {
            self.back_to(&start);
            return false;
        };
        self.program.body.push(id);
        self.starts.push(start);
        true
    }

    /// Removes steps until `len` remain.
    pub fn truncate(&mut self, len: usize) {
        self.leave();
        if let Some(start) = self.starts.get(len).cloned() {
            self.back_to(&start);
            self.starts.truncate(len);
            self.program.body.truncate(len);
        }
    }

    /// Returns whether a step may follow the body. Appends nothing.
    pub fn permits_step(&mut self, session: &Session, step: &Step) -> bool {
        self.permits(session, step, Looks::Away)
    }

    /// Returns whether a step may follow the body, whichever step the sequence with the span [`CHOICE`] in it
    /// stands for: one proof for all of them. True means that none is an error; false does not mean that one
    /// is. Appends nothing.
    pub fn permits_any(&mut self, session: &Session, step: &Step) -> bool {
        self.permits(session, step, Looks::AtChoice)
    }

    fn permits(&mut self, session: &Session, step: &Step, looks: Looks) -> bool {
        let start = self.start();
        let (id, outcome) = self.prove(session, step, looks);
        self.back_to(&start);
        id.is_some() && !outcome.refuted
    }

    /// Moves to the program point of the next step: after the body, or at the step with the span
    /// [`PROGRAM_POINT`] inside `step`, which follows the body and is closed for the time being. Later
    /// questions are about this point. Returns false if `step` has an error.
    pub fn go(&mut self, session: &Session, step: Option<&Step>) -> bool {
        self.leave();
        let Some(step) = step else { return true };
        let start = self.start();
        let (id, outcome) = self.prove(session, step, Looks::Inside);
        self.inside = Some((start, outcome.states_at_point));
        self.point = self
            .program
            .steps
            .iter()
            .rposition(|step| step.span == PROGRAM_POINT)
            .and_then(|index| u32::try_from(index).ok().map(StepId));
        id.is_some() && !outcome.refuted
    }

    /// Returns whether control reaches the program point; if not, no step there is refuted.
    #[must_use]
    pub fn is_live(&self) -> bool {
        match &self.inside {
            None => self.proof.live,
            Some((_, states_at_point)) => !states_at_point.is_empty(),
        }
    }

    /// Returns whether a call of the primitive with this index is permitted at the program point. An unknown
    /// argument is `None`: the needs that mention one, and those after them, stay open.
    pub fn permits_call(
        &mut self,
        session: &Session,
        primitive: usize,
        args: &[Option<ArgumentValue>],
    ) -> bool {
        let (library, _) = session.parts();
        let Some(def) = library.primitives.get(primitive) else { return false };
        let open = args.iter().position(Option::is_none).and_then(|index| u16::try_from(index).ok());
        let count = match open {
            None => def.needs.len(),
            Some(first) => {
                def.needs.iter().take_while(|need| need.last_param().is_none_or(|last| last < first)).count()
            }
        };
        let known = args.iter().map(|arg| arg.as_ref().map_or(Term::Unknown, |value| value.0.clone()));
        let terms: SmallVec<[Term; 4]> = known.collect();
        self.everywhere(session, |prover| !prover.refutes(def, &terms, count))
    }

    /// Evaluates a test of a fluent at the program point, at the end of the body of a loop. An argument that
    /// is `None` stands for `any`.
    pub fn test(
        &mut self,
        session: &Session,
        fluent: &str,
        args: &[Option<ArgumentValue>],
        negated: bool,
    ) -> LoopTest {
        let (library, environment) = session.parts();
        let Some(fluent) = library.names.fluents.get(fluent).copied() else { return LoopTest::Open };
        let Self { proof, program, inside, .. } = self;
        let Some((start, states_at_point)) =
            inside.as_mut().filter(|(_, states_at_point)| !states_at_point.is_empty())
        else {
            return LoopTest::Open;
        };
        let condition = condition(fluent, args, negated);
        let touches = states_at_point.iter().any(|state| start.proof.touches(state, &condition));
        let given = (&*program, library, environment);
        let mut holds =
            |state: &mut AbstractState<'static>| proof.at(state, given, |prover| prover.proves(&condition));
        if states_at_point.iter_mut().all(&mut holds) {
            LoopTest::Holds
        } else if touches {
            LoopTest::Open
        } else {
            LoopTest::Idle
        }
    }

    /// Returns whether the loop around the program point may end its body there: no need in it is refuted in
    /// a later round. `until` is the test of a `repeat`: a fluent, its arguments (`None` stands for `any`),
    /// and whether it is negated. Parallel branches are not checked.
    ///
    /// If so, the number is equal for tests that leave the same facts in the states at the program point.
    pub fn permits_round(
        &mut self,
        session: &Session,
        until: Option<(&str, &[Option<ArgumentValue>], bool)>,
    ) -> Option<u64> {
        let (library, environment) = session.parts();
        let Self { proof, program, inside, point, .. } = self;
        let (Some((_, states_at_point)), Some(point)) = (inside, *point) else { return Some(0) };
        let condition = until.and_then(|(fluent, args, negated)| {
            let fluent = library.names.fluents.get(fluent).copied()?;
            Some(condition(fluent, args, negated))
        });
        let given = (&*program, library, environment);
        let mut seen = FxHasher::default();
        let mut states_at_point = states_at_point.iter();
        let permits = states_at_point
            .all(|state| proof.comes_round(state, (point, condition.as_ref()), given, &mut seen));
        permits.then(|| seen.finish())
    }

    /// Returns whether the policy may be done at the program point: its goal is not refuted there.
    pub fn permits_done(&mut self, session: &Session) -> bool {
        let Some(goal) = self.program.achieves.as_ref().map(|(goal, _)| goal.clone()) else { return true };
        self.everywhere(session, |prover| !prover.denies(&goal))
    }

    /// The binding with a name that is visible at the program point, as an argument.
    #[must_use]
    pub fn binding(&self, name: &str) -> Option<ArgumentValue> {
        Some(ArgumentValue(self.scope_here().find(name)?.term.clone()))
    }

    /// Names that have a value at the program point, in the order in which they were bound.
    pub fn visible(&self) -> impl Iterator<Item = &SmolStr> {
        self.scope_here().names()
    }

    fn scope_here(&self) -> &Scope {
        self.scope_at_point.as_ref().unwrap_or(&self.scope)
    }

    fn everywhere(&mut self, session: &Session, mut ask: impl FnMut(&mut Prover<'_>) -> bool) -> bool {
        let (library, environment) = session.parts();
        let Self { proof, program, inside, .. } = self;
        let given = (&*program, library, environment);
        effort::spend(effort::VISIT);
        match inside {
            None if !proof.live => true,
            None => proof.here(given, ask),
            Some((_, states_at_point)) => {
                states_at_point.iter_mut().all(|state| proof.at(state, given, &mut ask))
            }
        }
    }

    fn start(&mut self) -> Start {
        self.leave();
        let (steps, bindings) = (self.program.steps.len(), self.program.bindings.len());
        Start { steps, bindings, scope: self.scope.mark(), proof: self.proof.mark(steps) }
    }

    /// Drops the open step.
    fn leave(&mut self) {
        self.scope_at_point = None;
        if let Some((start, _)) = self.inside.take() {
            self.back_to(&start);
        }
    }

    fn back_to(&mut self, start: &Start) {
        self.program.steps.truncate(start.steps);
        self.program.bindings.truncate(start.bindings);
        self.scope.back_to(start.scope);
        self.proof.back_to(&start.proof);
    }

    fn prove(&mut self, session: &Session, step: &Step, looks: Looks) -> (Option<StepId>, StepOutcome) {
        let (library, environment) = session.parts();
        let Self { form, program, kept, scope, proof, scope_at_point, .. } = self;
        let (first, name) = (program.steps.len(), program.name.clone());
        let given = (library, environment);
        let place = (*kept, PROGRAM_POINT);
        let made = crate::resolve::resolve_step(step, place, (*form, &name), given, program, scope);
        if looks == Looks::Inside {
            *scope_at_point = made.scope_at_point;
        }
        let Some(id) = made.id else { return (None, StepOutcome::default()) };
        crate::limits::fill_in_bounds(program, first, library);
        let is_error = |said: &Diagnostic| said.severity == Severity::Error;
        let is_wrong = made.diagnostics.iter().any(is_error)
            || crate::limits::check_from(program, first, library).iter().any(is_error);
        let mark = match looks {
            Looks::Away => None,
            Looks::Inside => Some(PROGRAM_POINT),
            Looks::AtChoice => Some(CHOICE),
        };
        let marked = mark.and_then(|mark| {
            let mut steps = program.steps.iter().zip(0..).skip(first);
            steps.find(|(step, _)| step.span == mark).map(|(_, index)| StepId(index))
        });
        let is_fork = |step: &crate::ir::Step| matches!(step.kind, StepKind::Parallel { .. });
        let grows = !program.steps.iter().skip(first).any(is_fork);
        let place = match looks {
            Looks::AtChoice => ProofTarget { point: None, choice: marked, grows },
            Looks::Away | Looks::Inside => ProofTarget { point: marked, choice: None, grows },
        };
        let mut outcome = proof.step(id, place, (&*program, library, environment));
        outcome.refuted |= is_wrong;
        (Some(id), outcome)
    }
}

/// Condition of a fluent; an argument that is `None` stands for `any`.
fn condition(fluent: Fluent, args: &[Option<ArgumentValue>], negated: bool) -> Condition {
    let args = args.iter().map(|arg| arg.as_ref().map(|value| value.0.clone()));
    let plain = Condition::Fact(Fact { fluent, args: args.collect() });
    if negated { Condition::Not(Box::new(plain)) } else { plain }
}

/// Mark that a proof looks for in a step.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Looks {
    Away,
    Inside,
    AtChoice,
}
