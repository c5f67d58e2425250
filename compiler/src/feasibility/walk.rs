//! Interpretation of a policy on possible worlds.

use std::collections::BTreeMap;

use motet_geometry::planning::SceneState as Room;
use motet_syntax::Diagnostic;
use motet_syntax::ast::EndKind;
use smol_str::SmolStr;

use super::geometry::Geometry;
use super::motion::may_move;
use super::transfer::at_start;
use super::worlds::{Fingerprinted, Worlds};
use super::{MotionVerdict, MotionVerdicts};
use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::{Condition, Fluent, Program, Reaction, StepId, StepKind, Term, When};
use crate::prove::Proof;
use crate::prove::symbols::Symbols;

/// Maximal number of rounds of a loop; then its worlds are unknown.
const ROUNDS: usize = 4;

/// State of the interpretation.
pub(super) struct Walk<'a> {
    pub(super) program: &'a Program,
    pub(super) library: &'a Library,
    pub(super) environment: &'a Environment,
    pub(super) symbols: Symbols,
    pub(super) geometry: &'a Geometry,
    proof: &'a Proof,
    /// Results by step; for a loop those of the last round, which has all worlds.
    found: BTreeMap<StepId, (Option<MotionVerdict>, Option<Diagnostic>)>,
    /// For each enclosing `try`, the worlds in which something in it may fail.
    failures: Vec<Worlds>,
    /// For each enclosing sub-policy, the worlds in which it is done.
    exits: Vec<(StepId, Worlds)>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        program: &'a Program,
        proof: &'a Proof,
        library: &'a Library,
        environment: &'a Environment,
        geometry: &'a Geometry,
    ) -> Self {
        let symbols = Symbols::new(program, library, environment);
        let (found, failures, exits) = (BTreeMap::new(), Vec::new(), Vec::new());
        Self { program, library, environment, symbols, geometry, proof, found, failures, exits }
    }

    /// Interprets the whole policy.
    pub(super) fn policy(&mut self) {
        let start = match self.geometry.start() {
            Ok(at) => Worlds { known: vec![at_start(at)], lost: None },
            Err(why) => Worlds::lost(why),
        };
        self.block(&self.program.body, start);
    }

    /// Verdicts by step, and the diagnostics.
    pub(super) fn into_results(self) -> (MotionVerdicts, Vec<Diagnostic>) {
        let mut placed = vec![None; self.program.steps.len()];
        let mut diagnostics = Vec::new();
        for (id, (verdict, refused)) in self.found {
            if let Some(slot) = placed.get_mut(id.index()) {
                *slot = verdict;
            }
            diagnostics.extend(refused);
        }
        (placed, diagnostics)
    }

    pub(super) fn found(&mut self, id: StepId, verdict: Option<MotionVerdict>, refused: Option<Diagnostic>) {
        self.found.insert(id, (verdict, refused));
    }

    /// Records that a step may fail in these worlds, or some of them.
    pub(super) fn caught(&mut self, worlds: &Worlds) {
        for failure in &mut self.failures {
            failure.join(worlds.clone().uncertain());
        }
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

    fn block(&mut self, block: &[StepId], mut worlds: Worlds) -> Worlds {
        for id in block {
            if worlds.is_nowhere() {
                break;
            }
            worlds = self.step(*id, worlds);
        }
        worlds
    }

    fn step(&mut self, id: StepId, worlds: Worlds) -> Worlds {
        let program = self.program;
        if !self.proof.reached.get(id.index()).copied().unwrap_or(false) {
            return Worlds::default();
        }
        let Some(step) = program.steps.get(id.index()) else { return worlds };
        match &step.kind {
            StepKind::Call(call) => self.call(id, call, worlds),
            StepKind::Sequence { body, .. } => self.block(body, worlds),
            StepKind::Inline { body, .. } => {
                self.exits.push((id, Worlds::default()));
                let mut after = self.block(body, worlds);
                if let Some((_, exits)) = self.exits.pop() {
                    after.join(exits);
                }
                after
            }
            StepKind::If { condition, then, otherwise, .. } => {
                let where_it = |walk: &Self, truth: bool| {
                    let mut worlds = worlds.clone();
                    worlds.known.retain(|it| walk.truth(condition, &it.at).is_none_or(|is| is == truth));
                    worlds
                };
                let (yes, no) = (where_it(self, true), where_it(self, false));
                let mut after = self.block(then, yes);
                after.join(self.block(otherwise.as_deref().unwrap_or_default(), no));
                after
            }
            StepKind::Wait { .. } => {
                self.caught(&worlds);
                worlds
            }
            StepKind::Monitor { whens, body } => self.monitor(whens, body, worlds),
            StepKind::Try { body, catches } => {
                self.failures.push(Worlds::default());
                let mut after = self.block(body, worlds);
                let failed = self.failures.pop().unwrap_or_default();
                for catch in catches {
                    after.join(self.block(&catch.body, failed.clone()));
                }
                after
            }
            StepKind::Repeat { times, body, .. } => self.looped(body, worlds, *times > 1, false),
            StepKind::Each { body, at_most, .. } => self.looped(body, worlds, *at_most > 1, true),
            StepKind::Parallel { branches } => self.parallel(branches, worlds),
            StepKind::End { kind, of, .. } => {
                let exit = self.exits.iter_mut().rev().find(|(step, _)| Some(*step) == *of);
                match (kind, exit) {
                    (EndKind::Done, Some((_, exits))) => {
                        exits.join(worlds);
                    }
                    (EndKind::Fail, Some(_)) => self.caught(&worlds),
                    (EndKind::Done | EndKind::Fail | EndKind::Replan, _) => {}
                }
                Worlds::default()
            }
            StepKind::Unknown => Worlds::lost(SmolStr::new_static("a step before is not understood")),
        }
    }

    /// Interprets a loop until no round reaches a new world.
    fn looped(&mut self, body: &[StepId], entry: Worlds, again: bool, may_skip: bool) -> Worlds {
        let mut head = entry.clone();
        for round in 0.. {
            let after = self.block(body, head.clone());
            let is_new = again && head.join(after.clone());
            if !is_new {
                let mut all = after;
                if may_skip {
                    all.join(entry);
                }
                return all;
            }
            if round >= ROUNDS {
                head = Worlds::lost(SmolStr::new_static("every round of a loop leaves the world different"));
            }
        }
        entry
    }

    fn monitor(&mut self, whens: &[When], body: &[StepId], mut worlds: Worlds) -> Worlds {
        let why = || Some(SmolStr::new_static("a monitor's reaction may have moved the robot before"));
        let mut is_moved = false;
        for when in whens {
            match &when.reaction {
                Reaction::Resume { body: block, .. } => {
                    self.block(block, Worlds { known: Vec::new(), lost: why() });
                    is_moved |= self.moves_in(block);
                }
                // The body may begin again from anywhere within it.
                Reaction::Restart { .. } => is_moved |= self.moves_in(body),
                Reaction::Pause { .. } | Reaction::End { .. } => {}
            }
        }
        if is_moved {
            worlds.lost = worlds.lost.or_else(why);
        }
        self.block(body, worlds)
    }

    fn parallel(&mut self, branches: &[Vec<StepId>], worlds: Worlds) -> Worlds {
        let moving: Vec<bool> = branches.iter().map(|branch| self.moves_in(branch)).collect();
        let alone = moving.iter().filter(|moves| **moves).count() <= 1;
        let why = || SmolStr::new_static("something else moves at the same time");
        let mut after = None;
        for (branch, moves) in branches.iter().zip(&moving) {
            let entry = if alone { worlds.clone() } else { Worlds::lost(why()) };
            let end = self.block(branch, entry);
            if *moves {
                after = Some(end);
            }
        }
        if alone { after.unwrap_or(worlds) } else { Worlds::lost(why()) }
    }

    /// Returns whether a block may move the robot or a thing.
    fn moves_in(&self, block: &[StepId]) -> bool {
        let program = self.program;
        block.iter().filter_map(|id| program.steps.get(id.index())).any(|step| match &step.kind {
            StepKind::Call(call) => {
                self.library.primitive(call.primitive).is_some_and(|def| may_move(self.library, def))
            }
            StepKind::Sequence { body, .. }
            | StepKind::Inline { body, .. }
            | StepKind::Repeat { body, .. }
            | StepKind::Each { body, .. } => self.moves_in(body),
            StepKind::If { then, otherwise, .. } => {
                self.moves_in(then) || otherwise.as_ref().is_some_and(|block| self.moves_in(block))
            }
            StepKind::Monitor { whens, body } => {
                self.moves_in(body)
                    || whens.iter().any(|when| match &when.reaction {
                        Reaction::Resume { body, .. } => self.moves_in(body),
                        Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End { .. } => false,
                    })
            }
            StepKind::Try { body, catches } => {
                self.moves_in(body) || catches.iter().any(|catch| self.moves_in(&catch.body))
            }
            StepKind::Parallel { branches } => branches.iter().any(|branch| self.moves_in(branch)),
            StepKind::Wait { .. } | StepKind::End { .. } => false,
            StepKind::Unknown => true,
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
            Condition::All(parts) => {
                let parts: Vec<_> = parts.iter().map(|part| self.truth(part, at)).collect();
                if parts.contains(&Some(false)) {
                    return Some(false);
                }
                parts.iter().all(|part| *part == Some(true)).then_some(true)
            }
            Condition::AnyOf(parts) => {
                let parts: Vec<_> = parts.iter().map(|part| self.truth(part, at)).collect();
                if parts.contains(&Some(true)) {
                    return Some(true);
                }
                parts.iter().all(|part| *part == Some(false)).then_some(false)
            }
            Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => None,
        }
    }

    /// Truth of `holding` or `open` in a world; `None` for any other fluent.
    fn holds(&self, world: &Room, fluent: Fluent, entity: &str) -> Option<bool> {
        self.geometry.holds(self.library, world, fluent, entity)
    }
}
