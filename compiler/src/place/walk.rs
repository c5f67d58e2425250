//! The walk over a policy with the worlds that may be met.

use std::collections::BTreeMap;

use motet_geometry::planning::SceneState as Room;
use motet_syntax::Diagnostic;
use motet_syntax::ast::EndKind;
use smol_str::SmolStr;

use super::after::at_start;
use super::geometry::Geometry;
use super::meaning::moves_blindly;
use super::ways::{Keyed, Ways};
use super::{Placed, Verdict};
use crate::ir::{Condition, Program, Reaction, StepId, StepKind, Term, When};
use crate::library::Library;
use crate::prove::Proof;
use crate::prove::symbols::Symbols;
use crate::world::World;

/// How often a loop is walked before its worlds are given up.
const ROUNDS: usize = 4;

/// The state of the walk.
pub(super) struct Walk<'a> {
    pub(super) program: &'a Program,
    pub(super) library: &'a Library,
    pub(super) world: &'a World,
    pub(super) symbols: Symbols,
    pub(super) geometry: &'a Geometry,
    proof: &'a Proof,
    /// By step; of a loop the last round, which has all worlds.
    found: BTreeMap<StepId, (Option<Verdict>, Option<Diagnostic>)>,
    /// For each `try` around, the worlds in which something in it may fail.
    failures: Vec<Ways>,
    /// For each sub-policy around, the worlds in which it is done.
    exits: Vec<(StepId, Ways)>,
}

impl<'a> Walk<'a> {
    pub(super) fn new(
        program: &'a Program,
        proof: &'a Proof,
        library: &'a Library,
        world: &'a World,
        geometry: &'a Geometry,
    ) -> Self {
        let symbols = Symbols::new(program, library, world);
        let (found, failures, exits) = (BTreeMap::new(), Vec::new(), Vec::new());
        Self { program, library, world, symbols, geometry, proof, found, failures, exits }
    }

    /// Walks the whole policy.
    pub(super) fn policy(&mut self) {
        let start = match self.geometry.start() {
            Ok(at) => Ways { known: vec![at_start(at)], lost: None },
            Err(why) => Ways::lost(why),
        };
        self.block(&self.program.body, start);
    }

    /// What was found, by step, and what there is to say.
    pub(super) fn told(self) -> (Placed, Vec<Diagnostic>) {
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

    pub(super) fn found(&mut self, id: StepId, verdict: Option<Verdict>, refused: Option<Diagnostic>) {
        self.found.insert(id, (verdict, refused));
    }

    /// Something may fail here, in these worlds or some of them.
    pub(super) fn caught(&mut self, ways: &Ways) {
        for failure in &mut self.failures {
            failure.join(ways.clone().uncertain());
        }
    }

    /// Of the worlds those that agree with what the prover knows.
    pub(super) fn possible(&self, id: StepId, mut ways: Ways) -> Ways {
        let Some(certain) = self.proof.certain.get(&id) else { return ways };
        ways.known.retain(|situation| {
            certain.iter().all(|fact| {
                let Some(def) = self.library.fluent(fact.fluent) else { return true };
                let name = self.world.name(fact.entity);
                self.holds(&situation.at.world, &def.name, &name).is_none_or(|value| value == fact.value)
            })
        });
        ways
    }

    fn block(&mut self, block: &[StepId], mut ways: Ways) -> Ways {
        for id in block {
            if ways.is_nowhere() {
                break;
            }
            ways = self.step(*id, ways);
        }
        ways
    }

    fn step(&mut self, id: StepId, ways: Ways) -> Ways {
        let program = self.program;
        if !self.proof.reached.get(id.index()).copied().unwrap_or(false) {
            return Ways::default();
        }
        let Some(step) = program.steps.get(id.index()) else { return ways };
        match &step.kind {
            StepKind::Call(call) => self.call(id, call, ways),
            StepKind::Sequence { body, .. } => self.block(body, ways),
            StepKind::Inline { body, .. } => {
                self.exits.push((id, Ways::default()));
                let mut after = self.block(body, ways);
                if let Some((_, exits)) = self.exits.pop() {
                    after.join(exits);
                }
                after
            }
            StepKind::If { condition, then, otherwise, .. } => {
                let where_it = |walk: &Self, truth: bool| {
                    let mut ways = ways.clone();
                    ways.known.retain(|it| walk.truth(condition, &it.at).is_none_or(|is| is == truth));
                    ways
                };
                let (yes, no) = (where_it(self, true), where_it(self, false));
                let mut after = self.block(then, yes);
                after.join(self.block(otherwise.as_deref().unwrap_or_default(), no));
                after
            }
            StepKind::Wait { .. } => {
                self.caught(&ways);
                ways
            }
            StepKind::Monitor { whens, body } => self.monitor(whens, body, ways),
            StepKind::Try { body, catches } => {
                self.failures.push(Ways::default());
                let mut after = self.block(body, ways);
                let failed = self.failures.pop().unwrap_or_default();
                for catch in catches {
                    after.join(self.block(&catch.body, failed.clone()));
                }
                after
            }
            StepKind::Repeat { times, body, .. } => self.looped(body, ways, *times > 1, false),
            StepKind::Each { body, at_most, .. } => self.looped(body, ways, *at_most > 1, true),
            StepKind::Parallel { branches } => self.parallel(branches, ways),
            StepKind::End { kind, of, .. } => {
                let exit = self.exits.iter_mut().rev().find(|(step, _)| Some(*step) == *of);
                match (kind, exit) {
                    (EndKind::Done, Some((_, exits))) => {
                        exits.join(ways);
                    }
                    (EndKind::Fail, Some(_)) => self.caught(&ways),
                    (EndKind::Done | EndKind::Fail | EndKind::Replan, _) => {}
                }
                Ways::default()
            }
            StepKind::Unknown => Ways::lost(SmolStr::new_static("a step before is not understood")),
        }
    }

    /// A loop until no round brings a new world.
    fn looped(&mut self, body: &[StepId], entry: Ways, again: bool, may_skip: bool) -> Ways {
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
                head = Ways::lost(SmolStr::new_static("every round of a loop leaves the world different"));
            }
        }
        entry
    }

    fn monitor(&mut self, whens: &[When], body: &[StepId], mut ways: Ways) -> Ways {
        let why = || Some(SmolStr::new_static("a monitor's reaction may have moved the robot before"));
        let mut is_moved = false;
        for when in whens {
            match &when.reaction {
                Reaction::Resume { body: block, .. } => {
                    self.block(block, Ways { known: Vec::new(), lost: why() });
                    is_moved |= self.moves_in(block);
                }
                // The body may begin again from anywhere within it.
                Reaction::Restart { .. } => is_moved |= self.moves_in(body),
                Reaction::Pause { .. } | Reaction::End { .. } => {}
            }
        }
        if is_moved {
            ways.lost = ways.lost.or_else(why);
        }
        self.block(body, ways)
    }

    fn parallel(&mut self, branches: &[Vec<StepId>], ways: Ways) -> Ways {
        let moving: Vec<bool> = branches.iter().map(|branch| self.moves_in(branch)).collect();
        let alone = moving.iter().filter(|moves| **moves).count() <= 1;
        let why = || SmolStr::new_static("something else moves at the same time");
        let mut after = None;
        for (branch, moves) in branches.iter().zip(&moving) {
            let entry = if alone { ways.clone() } else { Ways::lost(why()) };
            let end = self.block(branch, entry);
            if *moves {
                after = Some(end);
            }
        }
        if alone { after.unwrap_or(ways) } else { Ways::lost(why()) }
    }

    /// Whether a block moves the robot or something.
    fn moves_in(&self, block: &[StepId]) -> bool {
        let program = self.program;
        block.iter().filter_map(|id| program.steps.get(id.index())).any(|step| match &step.kind {
            StepKind::Call(call) => self.library.primitive(call.primitive).is_some_and(|def| {
                def.motion
                    .as_ref()
                    .map_or_else(|| moves_blindly(self.library, def), |(name, _)| name != "look")
            }),
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

    /// Whether a condition holds in a world, where its geometry says so.
    fn truth(&self, condition: &Condition, at: &Keyed) -> Option<bool> {
        match condition {
            Condition::Literal(value) => Some(*value),
            Condition::Fact(fact) => {
                let name = &self.library.fluent(fact.fluent)?.name;
                let [Some(Term::Entity(entity))] = fact.args.as_slice() else { return None };
                if name == "reachable" {
                    return self.geometry.reaches(at, &self.world.name(*entity));
                }
                self.holds(&at.world, name, &self.world.name(*entity))
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

    /// Whether something is held or open in a world; none of any other fluent.
    fn holds(&self, world: &Room, fluent: &str, entity: &str) -> Option<bool> {
        match fluent {
            "holding" => Some(world.holds(entity)),
            "open" => self.geometry.is_open(world, entity),
            _ => None,
        }
    }
}
