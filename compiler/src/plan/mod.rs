//! From a goal to calls that reach it: the contracts of the primitives are a planning domain, and the prover's facts are
//! its states. Goals are taken up one after the other, each together with those that shall still hold (Koehler and
//! Hoffmann 2000, goal agendas); for each a weighted best-first search looks for calls (`search`), led by what is still
//! missing (`estimate`).
//!
//! A plan is a proposal: who uses it writes a policy from it and has that checked like any other.

mod estimate;
mod failure;
mod search;
mod write;

use motet_syntax::ast::{Do, Expr, ExprKind};
use motet_syntax::{Diagnostic, Span, Syntax};
use smol_str::SmolStr;

pub use failure::NoPlan;

use crate::ir::{Condition, Entity, Program};
use crate::library::{Library, PrimitiveDef};
use crate::prove::Prover;
use crate::prove::eval::Frame;
use crate::prove::facts::Key;
use crate::prove::mend::Proposed;
use crate::resolve::expr::Resolver;
use crate::session::Session;
use crate::world::World;

/// The most states that a search looks at where nothing else is said.
pub const PLAN_BUDGET: usize = 600;
/// The most calls of a plan.
pub const MAX_PLAN: usize = 200;

/// What shall come about.
#[derive(Clone, Debug)]
pub struct Goal {
    /// The condition.
    pub condition: Expr,
    /// Whether it shall still hold when later goals are reached.
    pub lasts: Lasts,
}

/// Whether a goal has to hold at the end.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Lasts {
    /// It does.
    ToTheEnd,
    /// It has to hold once, on the way: the robot goes there and then elsewhere.
    Once,
}

impl Goal {
    /// A goal in the text form of conditions.
    ///
    /// # Errors
    ///
    /// What is wrong with it.
    pub fn read(text: &str, lasts: Lasts) -> Result<Self, NoPlan> {
        match motet_syntax::text::parse_condition(text) {
            Ok(condition) => Ok(Self { condition, lasts }),
            Err(why) => Err(NoPlan::NoCondition { text: text.to_owned(), why }),
        }
    }
}

/// Calls that reach the goals.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// The calls in order.
    pub steps: Vec<PlannedStep>,
    /// How many states were looked at.
    pub looked_at: usize,
}

/// One call of a plan, with what a policy may want to watch meanwhile.
#[derive(Clone, Debug)]
pub struct PlannedStep {
    /// The call, ready to be printed.
    pub call: Do,
    /// The person to whom the base moves.
    pub approaches: Option<SmolStr>,
    /// What the hand holds before and after, while the base moves.
    pub carries: Option<SmolStr>,
    /// For which goal it is, from 0; what puts things back comes after the last.
    pub goal: usize,
}

impl Session {
    /// Looks for calls that reach goals, one after the other, from the state at the start. The same session and goals give
    /// the same plan. `budget` bounds the states that are looked at, over all goals.
    ///
    /// # Errors
    ///
    /// Why there is no plan: a goal that is not understood, one that no call can bring about, or the budget.
    pub fn plan(&self, goals: &[Goal], budget: usize) -> Result<Plan, NoPlan> {
        let (library, world) = (self.library(), self.world());
        let conditions = goals.iter().map(|goal| resolve(&goal.condition, library, world));
        let conditions = conditions.collect::<Result<Vec<_>, _>>()?;
        let program = Program::default();
        let mut prover = Prover::new(&program, library, world);
        let mut agenda = Agenda { calls: Vec::new(), of: Vec::new(), left: budget };
        let mut kept: Vec<Condition> = Vec::new();
        for (index, (condition, goal)) in conditions.iter().zip(goals).enumerate() {
            for part in parts(condition, goal.lasts) {
                let mut all = kept.clone();
                all.push(part.clone());
                agenda.reach(&mut prover, &Condition::All(all), index)?;
                if goal.lasts == Lasts::ToTheEnd {
                    kept.push(part.clone());
                }
            }
        }
        agenda.tidy(&mut prover, kept, goals.len());
        let looked_at = budget.saturating_sub(agenda.left);
        let steps = agenda.write(&mut prover)?;
        Ok(Plan { steps, looked_at })
    }
}

/// What is reached one after the other: the parts of a conjunction that shall hold at the end.
fn parts(condition: &Condition, lasts: Lasts) -> &[Condition] {
    match (condition, lasts) {
        (Condition::All(parts), Lasts::ToTheEnd) => parts,
        _ => std::slice::from_ref(condition),
    }
}

/// The calls found so far.
struct Agenda {
    calls: Vec<Proposed>,
    /// For which goal each is.
    of: Vec<usize>,
    left: usize,
}

impl Agenda {
    fn reach(&mut self, prover: &mut Prover<'_>, goal: &Condition, index: usize) -> Result<(), NoPlan> {
        let found = search::search(prover, &self.calls, goal, &mut self.left)?;
        self.of.resize(self.of.len() + found.len(), index);
        self.calls.extend(found);
        if self.calls.len() > MAX_PLAN {
            Err(NoPlan::Budget { goal: prover.show(goal, true, Frame::default()) })
        } else {
            Ok(())
        }
    }

    /// Closes what the plan opened, where the goals do not speak of it and nothing they ask for is lost by it.
    fn tidy(&mut self, prover: &mut Prover<'_>, mut kept: Vec<Condition>, index: usize) {
        let Some(open) = prover.library.names.fluents.get("open").copied() else { return };
        search::replay(prover, &self.calls);
        let mut opened = Vec::new();
        prover.facts.entries(open, Key::ALL, |key, value| {
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
            if self.reach(prover, &Condition::All(all), index).is_ok() {
                kept.push(closed);
            }
        }
    }

    fn write(&self, prover: &mut Prover<'_>) -> Result<Vec<PlannedStep>, NoPlan> {
        search::replay(prover, &[]);
        let mut steps = Vec::with_capacity(self.calls.len());
        for (index, (call, goal)) in self.calls.iter().zip(&self.of).enumerate() {
            let Some(def) = prover.library.primitive(call.primitive) else { continue };
            let before = held(prover);
            let approaches = approaches(prover, def, call);
            search::apply(prover, index, call);
            let moves = def.motion.as_ref().is_some_and(|(query, _)| query == "go_to");
            let carries = before.filter(|held_before| moves && held(prover).as_ref() == Some(held_before));
            let written = write::call(call, prover.library, prover.world)
                .ok_or_else(|| NoPlan::Unwritable { primitive: def.name.clone() })?;
            steps.push(PlannedStep { call: written, approaches, carries, goal: *goal });
        }
        Ok(steps)
    }
}

/// What is held for sure.
fn held(prover: &Prover<'_>) -> Option<SmolStr> {
    let holding = *prover.library.names.fluents.get("holding")?;
    let mut found = None;
    prover.facts.entries(holding, Key::ALL, |key, value| {
        if value.is_true() {
            found = Some(Entity(key.arg(0)));
        }
    });
    prover.world.entities().name(found?).cloned()
}

/// The person to whom a call moves the base.
fn approaches(prover: &Prover<'_>, def: &PrimitiveDef, call: &Proposed) -> Option<SmolStr> {
    let (query, args) = def.motion.as_ref()?;
    let frame = Frame { args: &call.args, result: call.result, each: None };
    let target = Entity(prover.argument(args.first().filter(|_| query == "go_to")?, frame)?);
    let kind = prover.world.entities().kind(target)?;
    let is_person = prover.library.is_kind(kind, prover.library.kind_named("Person"));
    prover.world.entities().name(target).filter(|_| is_person).cloned()
}

fn resolve(goal: &Expr, library: &Library, world: &World) -> Result<Condition, NoPlan> {
    let mut resolver = Resolver::new(library, world.entities(), world.has_scene(), Syntax::Text);
    let condition = resolver.condition(goal);
    let wrong: Vec<Diagnostic> = resolver.diagnostics;
    if wrong.is_empty() { Ok(condition) } else { Err(NoPlan::Wrong { diagnostics: wrong }) }
}

/// A fluent of entities as a condition: `at(mug_1, shelf)`.
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
