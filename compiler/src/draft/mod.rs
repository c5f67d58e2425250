//! A policy that is being written, step by step, with what every stage knows of it so far: for hosts that have to say what
//! may come next.
//!
//! It is the checker itself that answers. A step is resolved, checked and proved by the stages' own code from the state
//! in which the steps before it left the proof, so an answer costs what one step costs and not what the policy does. What
//! only the end of a policy can tell is asked of a step that is closed for the time being: see [`Draft::permits_step`].

mod fluents;
mod template;

use std::hash::Hasher;

use motet_syntax::ast::{self, Policy, Step};
use motet_syntax::{Diagnostic, FileId, Severity, Span, Syntax};
use rustc_hash::FxHasher;
use smallvec::SmallVec;
use smol_str::SmolStr;

pub use self::template::Template;
use crate::ir::{BindingId, Condition, Entity, EnumId, Fact, Fluent, Program, StepId, StepKind, Term};
use crate::prove::Prover;
use crate::prove::draft::{Mark, Outcome, Parts, Place, Stand};
use crate::resolve::scope::{self, Scope};
use crate::session::Session;

/// The place that a step with this span takes is where the next step will stand.
pub const HOLE: Span = Span { file: FileId(u16::MAX), start: u32::MAX - 1, end: u32::MAX };

/// A sequence with this span stands for any one of its steps: see [`Draft::permits_any`].
pub const CHOICE: Span = Span { file: FileId(u16::MAX), start: u32::MAX - 2, end: u32::MAX };

/// An argument of a call that is being written.
#[derive(Clone, PartialEq, Debug)]
pub struct Value(Term);

impl Value {
    /// The entity with this number among those of the world.
    #[must_use]
    pub fn entity(index: u16) -> Self {
        Self(Term::Entity(Entity(index)))
    }

    /// A case of an enumeration, by their numbers.
    #[must_use]
    pub fn case(of: u16, case: u16) -> Self {
        Self(Term::Case(EnumId(of), case))
    }

    /// A number, in SI units where it has a unit.
    #[must_use]
    pub fn number(value: f64) -> Self {
        Self(Term::Number(value))
    }

    /// A text.
    #[must_use]
    pub fn text(text: impl Into<SmolStr>) -> Self {
        Self(Term::Text(text.into()))
    }

    /// A list.
    #[must_use]
    pub fn list(items: impl IntoIterator<Item = Self>) -> Self {
        Self(Term::List(items.into_iter().map(|item| item.0).collect()))
    }

    /// A value of which nothing is known.
    #[must_use]
    pub fn unknown() -> Self {
        Self(Term::Unknown)
    }
}

/// What a test at the end of a loop's body tells.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Test {
    /// It holds whenever it is asked, so the body does not run again.
    Holds,
    /// Only a proof tells.
    Open,
    /// It is about what the steps have left as it was, so what is wrong without it is wrong with it.
    Idle,
}

/// A policy that is being written.
#[derive(Clone, Debug)]
pub struct Draft {
    form: Syntax,
    program: Program,
    scope: Scope,
    proof: Parts,
    /// Where each step of the body begins.
    starts: Vec<Start>,
    /// Where the step begins that is not part of the body, and the states in which control reaches the hole in it.
    inside: Option<(Start, Vec<Stand>)>,
    /// The hole in it.
    hole: Option<StepId>,
}

/// Where a draft begins a step.
#[derive(Clone, Debug)]
struct Start {
    steps: usize,
    bindings: usize,
    scope: scope::Mark,
    proof: Mark,
}

impl Draft {
    /// The draft of a policy of which name, robot and goal are given; steps that it has are left out. The findings are
    /// about goal and robot; the draft can be used all the same.
    #[must_use]
    pub fn new(session: &Session, policy: &Policy, form: Syntax) -> (Self, Vec<Diagnostic>) {
        let (library, world) = session.parts();
        let head = Policy { body: ast::Block::default(), ..policy.clone() };
        let (mut program, mut said) = crate::resolve::resolve(&head, form, library, world);
        said.extend(crate::session::other_robot(policy, library));
        program.body.clear();
        let proof = Parts::new(&program, library, world);
        (
            Self {
                form,
                program,
                scope: Scope::default(),
                proof,
                starts: Vec::new(),
                inside: None,
                hole: None,
            },
            said,
        )
    }

    /// The number of a primitive among those of the session's library.
    #[must_use]
    pub fn primitive(session: &Session, name: &str) -> Option<usize> {
        session.parts().0.names.primitives.get(name).map(|id| id.index())
    }

    /// The resources, one a bit, that a primitive or a policy of this name uses while it runs.
    #[must_use]
    pub fn resources(session: &Session, name: &str, template: Option<&Template>) -> u64 {
        let library = session.parts().0;
        match (library.names.primitives.get(name).and_then(|id| library.primitive(*id)), template) {
            (Some(def), _) => def.uses,
            (None, Some(template)) => template.uses,
            (None, None) => 0,
        }
    }

    /// How many steps its body has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// Whether it has no step yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.starts.is_empty()
    }

    /// Appends a step to the body; false, and nothing is appended, where that is an error.
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

    /// Takes steps back until there are `len`.
    pub fn truncate(&mut self, len: usize) {
        self.leave();
        if let Some(start) = self.starts.get(len).cloned() {
            self.back_to(&start);
            self.starts.truncate(len);
            self.program.body.truncate(len);
        }
    }

    /// Whether a step may follow the body as it is. Nothing is appended.
    pub fn permits_step(&mut self, session: &Session, step: &Step) -> bool {
        self.permits(session, step, Looks::Away)
    }

    /// Whether a step may follow the body as it is, whichever step it is that the sequence in it whose span is [`CHOICE`] stands
    /// for: one proof for all of them. False does not say that one is an error, true says that none is. Nothing is appended.
    pub fn permits_any(&mut self, session: &Session, step: &Step) -> bool {
        self.permits(session, step, Looks::AtChoice)
    }

    fn permits(&mut self, session: &Session, step: &Step, looks: Looks) -> bool {
        let start = self.start();
        let (id, outcome) = self.prove(session, step, looks);
        self.back_to(&start);
        id.is_some() && !outcome.refuted
    }

    /// Whether the policy may end behind its last step: its goal is not refuted there.
    pub fn permits_end(&mut self, session: &Session) -> bool {
        self.leave();
        self.permits_done(session)
    }

    /// Goes where the next step will stand: behind the body, or where `step`, which follows it and is closed for the time
    /// being, has a step whose span is [`HOLE`]. What is asked next is asked of that place. False where `step` is an error.
    pub fn go(&mut self, session: &Session, step: Option<&Step>) -> bool {
        self.leave();
        let Some(step) = step else { return true };
        let start = self.start();
        let (id, outcome) = self.prove(session, step, Looks::Inside);
        self.inside = Some((start, outcome.stands));
        self.hole = self
            .program
            .steps
            .iter()
            .rposition(|step| step.span == HOLE)
            .and_then(|index| u32::try_from(index).ok().map(StepId));
        id.is_some() && !outcome.refuted
    }

    /// Whether control gets to the place at all; where it does not, nothing that stands there is refuted.
    #[must_use]
    pub fn is_live(&self) -> bool {
        match &self.inside {
            None => self.proof.live,
            Some((_, stands)) => !stands.is_empty(),
        }
    }

    /// Whether a call of the primitive with this number among those of the library may stand at the place. An argument
    /// that is not known yet is none: the needs that speak of one, and those behind them, are left open.
    pub fn permits_call(&mut self, session: &Session, primitive: usize, args: &[Option<Value>]) -> bool {
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

    /// What a test with a fluent tells at the place, where what began the step that is being written may come round again.
    /// An argument that is none is `any`.
    pub fn test(&mut self, session: &Session, fluent: &str, args: &[Option<Value>], negated: bool) -> Test {
        let (library, world) = session.parts();
        let Some(fluent) = library.names.fluents.get(fluent).copied() else { return Test::Open };
        let Self { proof, program, inside, .. } = self;
        let Some((start, stands)) = inside.as_mut().filter(|(_, stands)| !stands.is_empty()) else {
            return Test::Open;
        };
        let condition = condition(fluent, args, negated);
        let touches = stands.iter().any(|stand| start.proof.touches(stand, &condition));
        let given = (&*program, library, world);
        let mut holds = |stand: &mut Stand| proof.at(stand, given, |prover| prover.proves(&condition));
        if stands.iter_mut().all(&mut holds) {
            Test::Holds
        } else if touches {
            Test::Open
        } else {
            Test::Idle
        }
    }

    /// Whether the loop around the place may end its body there: nothing in it is refuted where it comes round. `until` is the
    /// test of a `repeat`: a fluent, its arguments, of which one that is none is `any`, and whether it stands under `not`. What
    /// runs at once with the loop is not asked.
    ///
    /// Where it may, a number that is the same for tests that leave the same facts, in the states in which the place is reached.
    pub fn permits_round(
        &mut self,
        session: &Session,
        until: Option<(&str, &[Option<Value>], bool)>,
    ) -> Option<u64> {
        let (library, world) = session.parts();
        let Self { proof, program, inside, hole, .. } = self;
        let (Some((_, stands)), Some(hole)) = (inside, *hole) else { return Some(0) };
        let condition = until.and_then(|(fluent, args, negated)| {
            let fluent = library.names.fluents.get(fluent).copied()?;
            Some(condition(fluent, args, negated))
        });
        let given = (&*program, library, world);
        let mut seen = FxHasher::default();
        let mut stands = stands.iter();
        let permits =
            stands.all(|stand| proof.comes_round(stand, (hole, condition.as_ref()), given, &mut seen));
        permits.then(|| seen.finish())
    }

    /// Whether the policy may be done at the place: its goal is not refuted there.
    pub fn permits_done(&mut self, session: &Session) -> bool {
        let Some(goal) = self.program.achieves.as_ref().map(|(goal, _)| goal.clone()) else { return true };
        self.everywhere(session, |prover| !prover.denies(&goal))
    }

    /// The latest binding with this name, as an argument.
    #[must_use]
    pub fn binding(&self, name: &str) -> Option<Value> {
        let index = self.program.bindings.iter().rposition(|binding| binding.name == name)?;
        Some(Value(Term::Binding(BindingId(u32::try_from(index).ok()?))))
    }

    fn everywhere(&mut self, session: &Session, mut ask: impl FnMut(&mut Prover<'_>) -> bool) -> bool {
        let (library, world) = session.parts();
        let Self { proof, program, inside, .. } = self;
        let given = (&*program, library, world);
        match inside {
            None if !proof.live => true,
            None => proof.here(given, ask),
            Some((_, stands)) => stands.iter_mut().all(|stand| proof.at(stand, given, &mut ask)),
        }
    }

    fn start(&mut self) -> Start {
        self.leave();
        let (steps, bindings) = (self.program.steps.len(), self.program.bindings.len());
        Start { steps, bindings, scope: self.scope.mark(), proof: self.proof.mark(steps) }
    }

    /// Drops what is known of a step that is not part of the body.
    fn leave(&mut self) {
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

    fn prove(&mut self, session: &Session, step: &Step, looks: Looks) -> (Option<StepId>, Outcome) {
        let (library, world) = session.parts();
        let Self { form, program, scope, proof, .. } = self;
        let (first, name) = (program.steps.len(), program.name.clone());
        let (id, said) = crate::resolve::resolve_step(step, (*form, &name), (library, world), program, scope);
        let Some(id) = id else { return (None, Outcome::default()) };
        let is_error = |said: &Diagnostic| said.severity == Severity::Error;
        let is_wrong = said.iter().any(is_error)
            || crate::check::check_from(program, first, library).iter().any(is_error);
        let mark = match looks {
            Looks::Away => None,
            Looks::Inside => Some(HOLE),
            Looks::AtChoice => Some(CHOICE),
        };
        let marked = mark.and_then(|mark| {
            let mut steps = program.steps.iter().zip(0..).skip(first);
            steps.find(|(step, _)| step.span == mark).map(|(_, index)| StepId(index))
        });
        let is_fork = |step: &crate::ir::Step| matches!(step.kind, StepKind::Parallel { .. });
        let grows = !program.steps.iter().skip(first).any(is_fork);
        let place = match looks {
            Looks::AtChoice => Place { hole: None, choice: marked, grows },
            Looks::Away | Looks::Inside => Place { hole: marked, choice: None, grows },
        };
        let mut outcome = proof.step(id, place, (&*program, library, world));
        outcome.refuted |= is_wrong;
        (Some(id), outcome)
    }
}

/// A fluent as a condition; an argument that is none is `any`.
fn condition(fluent: Fluent, args: &[Option<Value>], negated: bool) -> Condition {
    let args = args.iter().map(|arg| arg.as_ref().map(|value| value.0.clone()));
    let plain = Condition::Fact(Fact { fluent, args: args.collect() });
    if negated { Condition::Not(Box::new(plain)) } else { plain }
}

/// What a proof looks for in a step.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Looks {
    /// Nothing.
    Away,
    /// The hole in it.
    Inside,
    /// The choice in it.
    AtChoice,
}
