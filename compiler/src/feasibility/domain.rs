//! The abstract domain of motion feasibility: a set of possible worlds, each with the steps that led to it.

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_geometry::planning::SceneState;
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use super::geometry::{Fingerprinted, Geometry};
use super::motion::may_move;
use super::verdict::{MotionVerdict, MotionVerdicts};
use crate::analysis::{Domain, Enclosing, Exit};
use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::{Call, Condition, Failure, Fluent, Program, Reaction, StepId, StepKind, Term, When};
use crate::prove::Proof;
use crate::prove::symbols::Symbols;

/// Maximal number of possible worlds at a program point.
pub(super) const MOST_WORLDS: usize = 8;

/// A possible world, with the steps that led to it.
#[derive(Clone, Debug)]
pub(super) struct PossibleWorld {
    pub(super) at: Arc<Fingerprinted>,
    /// Step that brought the robot to its pose.
    pub(super) stands_since: Option<StepId>,
    /// Step that took the thing in the hand.
    pub(super) held_since: Option<StepId>,
    /// Things that were opened, closed or put somewhere, with the step.
    pub(super) changed: Vec<(SmolStr, StepId)>,
    /// True if the program point is certainly reached in this world on some path; after a failure it may not
    /// be.
    pub(super) is_certain: bool,
}

impl PossibleWorld {
    /// The world at the start.
    fn at_start(at: Arc<Fingerprinted>) -> Self {
        Self { at, stands_since: None, held_since: None, changed: Vec::new(), is_certain: true }
    }

    /// Step that changed an entity last.
    pub(super) fn changer(&self, entity: &str) -> Option<StepId> {
        self.changed.iter().rev().find(|(name, _)| name == entity).map(|(_, step)| *step)
    }
}

/// Possible worlds at a program point; empty if no path leads there.
#[derive(Clone, Debug, Default)]
pub(super) struct Worlds {
    pub(super) known: Vec<PossibleWorld>,
    /// Reason why other worlds than the known ones are possible, if they are.
    pub(super) lost: Option<SmolStr>,
}

impl Worlds {
    pub(super) fn lost(why: SmolStr) -> Self {
        Self { known: Vec::new(), lost: Some(why) }
    }

    pub(super) fn only(possible: PossibleWorld) -> Self {
        Self { known: vec![possible], lost: None }
    }

    fn is_nowhere(&self) -> bool {
        self.known.is_empty() && self.lost.is_none()
    }

    /// Adds the worlds of another set; returns whether any was new.
    pub(super) fn join(&mut self, other: Self) -> bool {
        let mut is_new = self.lost.is_none() && other.lost.is_some();
        self.lost = self.lost.take().or(other.lost);
        for possible in other.known {
            let is_full = self.known.len() >= MOST_WORLDS;
            match self.known.iter_mut().find(|known| known.at.key == possible.at.key) {
                Some(known) => known.is_certain |= possible.is_certain,
                None if !is_full => {
                    self.known.push(possible);
                    is_new = true;
                }
                None => {
                    is_new |= self.lost.is_none();
                    self.lost = self.lost.take().or(Some(too_many()));
                }
            }
        }
        is_new
    }

    /// The same worlds, which may not be reached.
    pub(super) fn uncertain(mut self) -> Self {
        self.known.iter_mut().for_each(|possible| possible.is_certain = false);
        self
    }
}

fn too_many() -> SmolStr {
    smol_str::format_smolstr!("more than {MOST_WORLDS} different worlds are possible here")
}

/// Maximal number of rounds of a loop; then its worlds are unknown.
const ROUNDS: usize = 4;

/// Checker of the motions of a program, at one program point.
pub(super) struct MotionChecker<'a> {
    pub(super) program: &'a Program,
    pub(super) library: &'a Library,
    pub(super) environment: &'a Environment,
    pub(super) symbols: Symbols,
    pub(super) geometry: &'a Geometry,
    pub(super) proof: &'a Proof,
    /// Possible worlds here.
    pub(super) worlds: Worlds,
    enclosing: Vec<Enclosing<Worlds>>,
    /// Results by step; for a loop those of the last round, which has all worlds.
    found: BTreeMap<StepId, (Option<MotionVerdict>, Option<Diagnostic>)>,
}

impl<'a> MotionChecker<'a> {
    /// The checker before the first step.
    pub(super) fn new(
        program: &'a Program,
        proof: &'a Proof,
        library: &'a Library,
        environment: &'a Environment,
        geometry: &'a Geometry,
    ) -> Self {
        let symbols = Symbols::new(program, library, environment);
        let worlds = match geometry.start() {
            Ok(at) => Worlds::only(PossibleWorld::at_start(at)),
            Err(why) => Worlds::lost(why),
        };
        let (enclosing, found) = (Vec::new(), BTreeMap::new());
        Self { program, library, environment, symbols, geometry, proof, worlds, enclosing, found }
    }

    /// Verdicts by step, and the diagnostics.
    pub(super) fn into_results(self) -> (MotionVerdicts, Vec<Diagnostic>) {
        let mut verdicts = vec![None; self.program.steps.len()];
        let mut diagnostics = Vec::new();
        for (id, (verdict, refused)) in self.found {
            if let Some(slot) = verdicts.get_mut(id.index()) {
                *slot = verdict;
            }
            diagnostics.extend(refused);
        }
        (verdicts, diagnostics)
    }

    pub(super) fn found(&mut self, id: StepId, verdict: Option<MotionVerdict>, refused: Option<Diagnostic>) {
        self.found.insert(id, (verdict, refused));
    }

    /// Throws all failures of a primitive in these worlds.
    pub(super) fn throw_in(&mut self, worlds: Worlds, kinds: &[Failure]) {
        let here = std::mem::replace(&mut self.worlds, worlds);
        self.throw_all(kinds);
        self.worlds = here;
    }

    /// Removes worlds that contradict the facts that the prover knows.
    pub(super) fn possible(&self, id: StepId, mut worlds: Worlds) -> Worlds {
        let Some(certain) = self.proof.certain.get(&id) else { return worlds };
        worlds.known.retain(|possible| {
            certain.iter().all(|fact| {
                let name = self.environment.name(fact.entity);
                self.holds(&possible.at.world, fact.fluent, &name).is_none_or(|value| value == fact.value)
            })
        });
        worlds
    }

    /// Returns whether a block may move the robot or a thing.
    fn moves_in(&self, block: &[StepId]) -> bool {
        block.iter().filter_map(|id| self.program.step(*id)).any(|step| match &step.kind {
            StepKind::Call(call) => {
                self.library.primitive(call.primitive).is_some_and(|def| may_move(self.library, def))
            }
            StepKind::Unknown => true,
            other => other.blocks().iter().any(|block| self.moves_in(block)),
        })
    }

    /// Truth of a condition in a world; `None` if the geometry does not determine it.
    fn truth(&self, condition: &Condition, at: &Fingerprinted) -> Option<bool> {
        match condition {
            Condition::Literal(value) => Some(*value),
            Condition::Fact(fact) => {
                let [Some(Term::Entity(entity))] = fact.args.as_slice() else { return None };
                if self.library.lang_items.reachable == Some(fact.fluent) {
                    return self.geometry.reaches(at, &self.environment.name(*entity));
                }
                self.holds(&at.world, fact.fluent, &self.environment.name(*entity))
            }
            Condition::Not(inner) => self.truth(inner, at).map(|value| !value),
            Condition::All(parts) => all(parts.iter().map(|part| self.truth(part, at))),
            Condition::AnyOf(parts) => {
                let none = all(parts.iter().map(|part| self.truth(part, at).map(|value| !value)));
                none.map(|value| !value)
            }
            Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => None,
        }
    }

    /// Truth of `holding` or `open` in a world; `None` for any other fluent.
    fn holds(&self, world: &SceneState, fluent: Fluent, entity: &str) -> Option<bool> {
        self.geometry.holds(self.library, world, fluent, entity)
    }
}

/// Conjunction of values, some of which may be unknown.
fn all(parts: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let mut value = Some(true);
    for part in parts {
        match part {
            Some(false) => return Some(false),
            Some(true) => {}
            None => value = None,
        }
    }
    value
}

impl<'a> Domain<'a> for MotionChecker<'a> {
    type Mark = Worlds;
    type Path = Worlds;
    type Collector = Worlds;
    /// True for a branch that may move the robot or a thing.
    type Changes = bool;

    fn program(&self) -> &'a Program {
        self.program
    }

    fn library(&self) -> &'a Library {
        self.library
    }

    fn enclosing(&mut self) -> &mut Vec<Enclosing<Worlds>> {
        &mut self.enclosing
    }

    fn is_live(&self) -> bool {
        !self.worlds.is_nowhere()
    }

    fn stop(&mut self) {
        self.worlds = Worlds::default();
    }

    fn mark(&self) -> Worlds {
        self.worlds.clone()
    }

    fn restore(&mut self, mark: &Worlds) {
        self.worlds = mark.clone();
    }

    fn path(&self, _mark: &Worlds) -> Worlds {
        self.worlds.clone()
    }

    fn follow(&mut self, path: &Worlds) {
        self.worlds = path.clone();
    }

    fn join(&mut self, _mark: &Worlds, paths: &[Worlds]) {
        self.worlds = Worlds::default();
        for path in paths {
            self.worlds.join(path.clone());
        }
    }

    fn widen(&self, head: &Worlds, back: &Worlds, round: usize) -> Option<Worlds> {
        let mut next = head.clone();
        let is_new = next.join(back.clone());
        let why = || SmolStr::new_static("a loop changes the world in every round");
        is_new.then(|| if round < ROUNDS { next } else { Worlds::lost(why()) })
    }

    fn collector(&self) -> Worlds {
        Worlds::default()
    }

    fn collector_at(&self, _other: &Worlds) -> Worlds {
        Worlds::default()
    }

    /// A block that moves something may be anywhere in its motions.
    fn anywhere(&self, states: &Worlds, block: &'a [StepId]) -> Option<Worlds> {
        if self.moves_in(block) {
            let why = "something may have interrupted a motion before";
            return Some(Worlds::lost(SmolStr::new_static(why)));
        }
        self.collected(states)
    }

    fn collect(&self, into: &mut Worlds, exit: Exit) {
        let worlds = self.worlds.clone();
        into.join(if exit == Exit::Failure { worlds.uncertain() } else { worlds });
    }

    fn collected(&self, states: &Worlds) -> Option<Worlds> {
        (!states.is_nowhere()).then(|| states.clone())
    }

    /// The prover knows more of what is reachable.
    fn enter(&mut self, id: StepId) -> bool {
        self.proof.reached.get(id.index()).copied().unwrap_or(false)
    }

    fn transfer(&mut self, id: StepId, call: &Call, _span: Span) {
        self.call(id, call);
    }

    fn assume_at(&mut self, id: StepId, condition: &Condition, truth: bool) -> bool {
        let mut worlds = std::mem::take(&mut self.worlds);
        // What the robot does not see to be true may be unknown to it, whatever is so.
        let may_be_unknown = !truth && self.proof.unknown_tests.contains(&id);
        worlds.known.retain_mut(|it| {
            let is_so = self.truth(condition, &it.at).is_none_or(|value| value == truth);
            it.is_certain &= is_so;
            is_so || may_be_unknown
        });
        if self.proof.drops.contains(&(id, truth)) {
            worlds.lost.get_or_insert(SmolStr::new_static("the held thing may have dropped"));
        }
        self.worlds = worlds;
        self.is_live()
    }

    fn await_at(&mut self, _id: StepId, condition: &Condition) {
        if self.worlds.known.iter().any(|it| self.truth(condition, &it.at) == Some(false)) {
            self.worlds = Worlds::lost(SmolStr::new_static("the world has changed during a wait"));
        }
    }

    fn lose(&mut self, _id: StepId) {
        self.worlds = Worlds::lost(SmolStr::new_static("an earlier step has an error"));
    }

    /// A reaction that moves something may run at any moment of the body.
    fn monitor(&mut self, id: StepId, whens: &'a [When], body: &'a [StepId]) {
        self.check_entry(id, whens, body);
        let why = || SmolStr::new_static("a monitor's reaction may have moved the robot before");
        let (mut entry, moves) = (self.worlds.clone(), self.moves_in(body));
        for when in whens {
            let is_moved = match &when.reaction {
                Reaction::Resume { body, .. } => self.moves_in(body),
                // The body may begin again from anywhere within it.
                Reaction::Restart { .. } => moves,
                Reaction::Pause { .. } | Reaction::Timeout | Reaction::End { .. } => false,
            };
            let is_anywhere = moves || matches!(when.reaction, Reaction::Resume { .. });
            self.worlds = if is_anywhere { Worlds::lost(why()) } else { entry.clone() };
            self.react(when);
            if is_moved {
                entry.lost = entry.lost.or_else(|| Some(why()));
            }
        }
        self.worlds = entry;
        self.block(body);
    }

    fn branch_changes(&mut self, branches: &'a [Vec<StepId>]) -> Vec<bool> {
        branches.iter().map(|branch| self.moves_in(branch)).collect()
    }

    fn disturb(&mut self, _id: StepId, changes: &[bool], _index: usize) {
        if changes.iter().filter(|moves| **moves).count() > 1 {
            self.worlds = Worlds::lost(SmolStr::new_static("something else moves at the same time"));
        }
    }

    /// The worlds of the branch that moves; those of several are unknown.
    fn compose(&mut self, id: StepId, changes: &[bool], paths: &[Worlds]) {
        self.disturb(id, changes, 0);
        let mut moving = changes.iter().zip(paths).filter(|(moves, _)| **moves);
        if let (Some((_, path)), None) = (moving.next(), moving.next()) {
            self.follow(path);
        }
    }
}
