//! The planner: calls that reach a goal. The contracts of the primitives are the planning domain, and the
//! prover's facts are its states.
//!
//! Goals are taken up in order, each together with those that must still hold (goal agendas, Koehler and
//! Hoffmann 2000). For each, a weighted best-first search (`search`) looks for calls, guided by a heuristic
//! (`estimate`).
//!
//! A plan is a proposal: its user writes a policy from it and has that checked like any other. Guarded by
//! `tests/tests/it/planning.rs` and `eval/tests/it/planbench.rs`.

pub(crate) mod achievers;
pub(crate) mod estimate;
pub(crate) mod search;

use motet_syntax::ast::{Do, Expr, ExprKind};
use motet_syntax::{Diagnostic, Span, Syntax};
use smol_str::SmolStr;
use thiserror::Error;

use crate::declare::elaborator::Elaborator;
use crate::declare::{Library, NeedDef, PrimitiveDef};
use crate::environment::Environment;
use crate::facts::FactKey;
use crate::ir::{Condition, Entity, Kind, MotionKind, Program};
use crate::plan::achievers::CandidateCall;
use crate::plan::estimate::{Purpose, Target};
use crate::plan::search::Bounds;
use crate::prove::Prover;
use crate::prove::evaluation::CallFrame;
use crate::session::Session;

/// Default budget of a search, in states.
pub const PLAN_BUDGET: usize = 600;
/// Maximal number of estimated calls for each state of the budget, with the states that it leads to.
const EFFORT: usize = 10_000;
/// Maximal number of calls of a plan.
pub const MAX_PLAN: usize = 200;

/// Condition to achieve.
#[derive(Clone, Debug)]
pub struct Goal {
    pub condition: Expr,
    pub persistence: Persistence,
}

/// Persistence of a goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Persistence {
    ToTheEnd,
    /// The goal must hold once, on the way: the robot goes there and then elsewhere.
    Once,
}

impl Goal {
    /// Parses a goal in text syntax.
    ///
    /// # Errors
    ///
    /// [`NoPlan::NoCondition`] if the text is no condition.
    pub fn read(text: &str, persistence: Persistence) -> Result<Self, NoPlan> {
        match motet_syntax::text::parse_condition(text) {
            Ok(condition) => Ok(Self { condition, persistence }),
            Err(why) => Err(NoPlan::NoCondition { text: text.to_owned(), why }),
        }
    }
}

/// Calls that reach the goals.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    pub steps: Vec<PlannedStep>,
    /// Number of expanded states.
    pub expanded_states: usize,
}

/// One call of a plan, with facts that a policy may want to watch meanwhile.
#[derive(Clone, Debug)]
pub struct PlannedStep {
    /// The call, ready to be printed.
    pub call: Do,
    /// Person to whom the base moves.
    pub approaches: Option<SmolStr>,
    /// Thing in the hand before and after, while the base moves.
    pub carries: Option<SmolStr>,
    /// Index of the goal it serves; one past the last for calls that tidy up.
    pub goal: usize,
}

impl Session {
    /// Searches calls that reach goals, one after the other, from the state at the start. The same session
    /// and goals give the same plan. `budget` bounds the number of expanded states over all goals.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_compiler::plan::{Goal, PLAN_BUDGET, Persistence};
    /// use motet_robots::builtin;
    /// use motet_syntax::Sources;
    ///
    /// let robot = builtin::robot("hsr").expect("built in").robot;
    /// let scene = builtin::scene("kitchen").expect("built in");
    /// let session = Session::builder().robot(&robot).scene(&scene).build(&mut Sources::default());
    /// let goal = Goal::read("holding(mug_1)", Persistence::ToTheEnd)?;
    /// let plan = session.plan(&[goal], PLAN_BUDGET)?;
    /// let last = plan.steps.last().map(|step| step.call.call.name.text.as_str());
    /// assert_eq!(last, Some("pick"));
    /// # Ok::<(), motet_compiler::plan::NoPlan>(())
    /// ```
    ///
    /// # Errors
    ///
    /// A goal that is not understood, one that no call can achieve, or an exhausted budget.
    pub fn plan(&self, goals: &[Goal], budget: usize) -> Result<Plan, NoPlan> {
        let (library, environment) = (self.library(), self.environment());
        let conditions = goals.iter().map(|goal| resolve(&goal.condition, library, environment));
        let conditions = conditions.collect::<Result<Vec<_>, _>>()?;
        let program = Program::default();
        let mut prover = Prover::new(&program, library, environment);
        let left =
            Bounds { states: budget, estimates: budget.saturating_mul(EFFORT), calls: MAX_PLAN, plans: 1 };
        let mut agenda = Agenda { calls: Vec::new(), of: Vec::new(), left };
        let mut kept: Vec<Condition> = Vec::new();
        for (index, (condition, goal)) in conditions.iter().zip(goals).enumerate() {
            for part in parts(condition, goal.persistence) {
                let mut all = kept.clone();
                all.push(part.clone());
                agenda.reach(&mut prover, &Condition::All(all), index)?;
                if goal.persistence == Persistence::ToTheEnd {
                    kept.push(part.clone());
                }
            }
        }
        agenda.tidy(&mut prover, kept, goals.len());
        let expanded_states = budget.saturating_sub(agenda.left.states);
        let steps = agenda.write(&mut prover)?;
        Ok(Plan { steps, expanded_states })
    }
}

impl Session {
    /// The same session in an environment where a condition holds, as far as it is made of facts. Unchanged
    /// where the condition has an error.
    #[must_use]
    pub fn supposing(&self, condition: &Expr) -> Self {
        let Ok(condition) = resolve(condition, self.library(), self.environment()) else {
            return self.clone();
        };
        let mut environment = self.environment().clone();
        suppose(&condition, true, &mut environment);
        self.with_environment(environment)
    }
}

fn suppose(condition: &Condition, truth: bool, environment: &mut Environment) {
    match condition {
        Condition::Fact(fact) => environment.assert_fact(fact.clone(), truth),
        Condition::Not(inner) => suppose(inner, !truth, environment),
        Condition::All(parts) if truth => parts.iter().for_each(|part| suppose(part, true, environment)),
        Condition::AnyOf(parts) if !truth => parts.iter().for_each(|part| suppose(part, false, environment)),
        Condition::All(_) | Condition::AnyOf(_) | Condition::Literal(_) | Condition::Compare(..) => {}
        Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) | Condition::Unknown => {}
    }
}

/// Goals that are reached one after the other: the parts of a conjunction that must hold at the end.
fn parts(condition: &Condition, persistence: Persistence) -> &[Condition] {
    match (condition, persistence) {
        (Condition::All(parts), Persistence::ToTheEnd) => parts,
        _ => std::slice::from_ref(condition),
    }
}

/// The calls so far.
struct Agenda {
    calls: Vec<CandidateCall>,
    /// Goal of each call.
    of: Vec<usize>,
    left: Bounds,
}

impl Agenda {
    fn reach(&mut self, prover: &mut Prover<'_>, goal: &Condition, index: usize) -> Result<(), NoPlan> {
        let needs = [NeedDef { condition: goal.clone(), each: None, when: None, span: Span::default() }];
        let target = Target { needs: &needs, frame: CallFrame::default(), purpose: Purpose::Plan };
        let shown = |prover: &Prover<'_>| prover.show(goal, true, CallFrame::default());
        replay(prover, &self.calls);
        let mut found = search::search(prover, target, &mut self.left)
            .map_err(|blocker| NoPlan::Unreachable { goal: shown(prover), blocker })?;
        let found = found.pop().ok_or_else(|| NoPlan::Budget { goal: shown(prover) })?;
        self.of.resize(self.of.len() + found.len(), index);
        self.calls.extend(found);
        if self.calls.len() > MAX_PLAN { Err(NoPlan::Budget { goal: shown(prover) }) } else { Ok(()) }
    }

    /// Closes containers that the plan opened, unless a goal mentions them or would be lost. A thing in the
    /// hand stays in it: to put it down and to find it again risks more than a container that is open.
    fn tidy(&mut self, prover: &mut Prover<'_>, mut kept: Vec<Condition>, index: usize) {
        let Some(open) = prover.library.lang_items.open else { return };
        replay(prover, &self.calls);
        let in_hand = held(prover);
        let mut opened = Vec::new();
        prover.state.facts.entries(open, FactKey::ALL, |key, value| {
            if value.is_true() && value.yes.as_step().is_some() {
                opened.push(key);
            }
        });
        opened.sort_unstable();
        for key in opened {
            let args = vec![Some(crate::ir::Term::Entity(Entity(key.arg(0))))];
            let is_open = Condition::Fact(crate::ir::Fact { fluent: open, args });
            if kept.iter().any(|goal| crate::prove::mentions(goal, open)) {
                return;
            }
            let closed = Condition::Not(Box::new(is_open));
            let mut all = kept.clone();
            all.push(closed.clone());
            let before = self.calls.len();
            if self.reach(prover, &Condition::All(all), index).is_err() {
                continue;
            }
            if in_hand.is_some() && self.held_since(prover, before).any(|held| held != in_hand) {
                self.calls.truncate(before);
                self.of.truncate(before);
            } else {
                kept.push(closed);
            }
        }
    }

    /// Thing in the hand after each call from the one at an index on.
    fn held_since<'s>(
        &'s self,
        prover: &'s mut Prover<'_>,
        first: usize,
    ) -> impl Iterator<Item = Option<SmolStr>> + 's {
        let (before, after) = self.calls.split_at(first.min(self.calls.len()));
        replay(prover, before);
        after.iter().map(move |call| {
            search::apply(prover, call);
            held(prover)
        })
    }

    fn write(&self, prover: &mut Prover<'_>) -> Result<Vec<PlannedStep>, NoPlan> {
        replay(prover, &[]);
        let mut steps = Vec::with_capacity(self.calls.len());
        for (call, goal) in self.calls.iter().zip(&self.of) {
            let Some(def) = prover.library.primitive(call.primitive) else { continue };
            let before = held(prover);
            let approaches = approaches(prover, def, call);
            search::apply(prover, call);
            let moves = def.motion.as_ref().is_some_and(|(query, _)| *query == MotionKind::GoTo);
            let carries = before.filter(|held_before| moves && held(prover).as_ref() == Some(held_before));
            let written =
                achievers::spell_call(call, prover.library, prover.environment, Syntax::Text, |_| None)
                    .ok_or_else(|| NoPlan::Unwritable { primitive: def.name.clone() })?;
            steps.push(PlannedStep { call: written, approaches, carries, goal: *goal });
        }
        Ok(steps)
    }
}

/// Rolls everything back and applies calls from the start.
fn replay(prover: &mut Prover<'_>, calls: &[CandidateCall]) {
    prover.back_to(0);
    prover.state.lasting.clear();
    calls.iter().for_each(|call| search::apply(prover, call));
}

/// Thing that is certainly in the hand.
fn held(prover: &Prover<'_>) -> Option<SmolStr> {
    let holding = prover.library.lang_items.holding?;
    let mut found = None;
    prover.state.facts.entries(holding, FactKey::ALL, |key, value| {
        if value.is_true() {
            found = Some(Entity(key.arg(0)));
        }
    });
    prover.environment.entities().name(found?).cloned()
}

/// Person to whom a call moves the base.
fn approaches(prover: &Prover<'_>, def: &PrimitiveDef, call: &CandidateCall) -> Option<SmolStr> {
    let (query, args) = def.motion.as_ref()?;
    let frame = CallFrame { args: &call.args, result: call.result, each: None };
    let target = Entity(prover.argument(args.first().filter(|_| *query == MotionKind::GoTo)?, frame)?);
    let kind = prover.environment.entities().kind(target)?;
    let is_person = prover.library.is_kind(kind, prover.library.lang_items.person.unwrap_or(Kind::ROOT));
    prover.environment.entities().name(target).filter(|_| is_person).cloned()
}

fn resolve(goal: &Expr, library: &Library, environment: &Environment) -> Result<Condition, NoPlan> {
    let mut elaborator =
        Elaborator::new(library, environment.entities(), environment.has_scene(), Syntax::Text);
    let condition = elaborator.condition(goal);
    let wrong: Vec<Diagnostic> = elaborator.diagnostics;
    if wrong.is_empty() { Ok(condition) } else { Err(NoPlan::Wrong { diagnostics: wrong }) }
}

/// Condition of a fluent with entities: `at(mug_1, shelf)`.
#[must_use]
pub fn fact(fluent: &str, args: &[&str]) -> Expr {
    let span = Span::default();
    let name = |text: &str| motet_syntax::ast::Name { text: text.into(), span };
    let args = args.iter().map(|arg| motet_syntax::ast::Arg {
        name: None,
        value: Expr { kind: ExprKind::Name((*arg).into()), span },
        span,
    });
    let call = motet_syntax::ast::Call { name: name(fluent), args: args.collect(), span };
    Expr { kind: ExprKind::Call(call), span }
}

/// Error of the planner.
#[derive(Error, Clone, PartialEq, Debug)]
pub enum NoPlan {
    /// The goal is no condition.
    #[error("`{text}` is not a condition: {why}")]
    NoCondition {
        text: String,
        /// Error of the parser.
        why: String,
    },
    /// The goal uses unknown names or wrong types.
    #[error("{}", diagnostics.first().map_or("the goal is wrong", |said| said.message.as_str()))]
    Wrong { diagnostics: Vec<Diagnostic> },
    /// No call achieves a missing fact.
    #[error("no action of the robot achieves {goal}{}", because(blocker.as_ref()))]
    Unreachable {
        /// The goal, in back-quotes.
        goal: String,
        /// The need that cannot be met, in back-quotes.
        blocker: Option<String>,
    },
    /// The budget of states or the length limit of plans is exhausted.
    #[error("no plan for {goal} was found within the budget")]
    Budget {
        /// The goal, in back-quotes.
        goal: String,
    },
    /// A call has an argument that a policy cannot express.
    #[error("a call of `{primitive}` cannot be written as a step")]
    Unwritable { primitive: SmolStr },
}

fn because(blocker: Option<&String>) -> String {
    blocker.map_or_else(String::new, |blocker| format!(": {blocker} cannot be met"))
}
