//! Heuristic of the planner: additive costs (Bonet and Geffner 2001) over the calls that achieve what a goal
//! lacks, computed backwards from the goal in the present state. The applicable calls at the ends of these
//! chains are the helpful actions (Hoffmann and Nebel 2001) that the search tries. Each is expected to save
//! the costs of the subgoals that it achieves.

use rustc_hash::FxHashMap;

use crate::declare::{MAX_FLUENT_PARAMS, NeedDef, PrimitiveDef};
use crate::facts::{ANY, FactKey, TruthSet, arg};
use crate::ir::{Condition, Fact, Kind, MotionKind, Term};
use crate::plan::achievers::{Achiever, CandidateCall, Subgoal, entity_of};
use crate::prove::Prover;
use crate::prove::candidates::Candidates;
use crate::prove::evaluation::CallFrame;

/// Cost of a call.
const STEP: u32 = 100;
/// Cost for each kind between that of an argument and that of its parameter: a primitive for persons suits a
/// person better than one for any entity.
const GENERAL: u32 = 10;
/// Cost of finding an entity that is already known.
const RESULT: u32 = 150;
/// Cost of an argument that neither a need nor an effect mentions, so that the choice is a guess.
const GUESS: u32 = 300;
/// Cost of a person whom no subgoal mentions: a free hand alone is no reason to give somebody what it holds.
const BOTHER: u32 = 250;
/// Cost of a need that is left to a guard.
const GUARD: u32 = 300;
/// Cost of a guard if a perception could decide.
const UNSEEN: u32 = 1_000;
/// Maximal depth of needs of needs.
const DEPTH: usize = 14;

/// Subgoals of an estimate, as bits at their places; those after the first 64 have none.
type Subgoals = u64;

/// Cost of a goal: calls to make, and needs left to guards.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
struct Cost {
    calls: u32,
    guards: u32,
    /// Subgoals on the way.
    subgoals: Subgoals,
}

impl Cost {
    const fn sum(self) -> u32 {
        self.calls.saturating_add(self.guards)
    }

    const fn guard(guards: u32) -> Self {
        Self { calls: 0, guards, subgoals: 0 }
    }

    const fn and(self, other: Self) -> Self {
        Self {
            calls: self.calls.saturating_add(other.calls),
            guards: self.guards.saturating_add(other.guards),
            subgoals: self.subgoals | other.subgoals,
        }
    }
}

/// An applicable call.
#[derive(Clone, Debug)]
pub(crate) struct Ready {
    pub(super) call: CandidateCall,
    /// Cost of the call, with its guards.
    pub(super) cost: u32,
    /// Expected cost of what the target lacks after the call.
    pub(super) missing: u32,
    /// Subgoals that it achieves.
    serves: Subgoals,
}

/// Needs that a search has to meet.
#[derive(Clone, Copy)]
pub(crate) struct Target<'t> {
    pub(crate) needs: &'t [NeedDef],
    pub(crate) frame: CallFrame<'t>,
    pub(crate) purpose: Purpose,
}

impl Target<'_> {
    /// Returns whether the needs are met in the present state.
    pub(super) fn is_met(&self, prover: &Prover<'_>) -> bool {
        self.needs.iter().all(|need| self.purpose.is_met(prover.need(need, self.frame).0))
    }
}

/// Purpose of a search.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// A plan: its goal is proven.
    Plan,
    /// A repair: no need is refuted, and what is unknown is left to guards.
    Repair,
}

impl Purpose {
    fn is_met(self, value: TruthSet) -> bool {
        !value.no.is_some() && (self == Self::Repair || !value.open.is_some())
    }
}

/// Estimate of one state.
pub(crate) struct Estimate<'p, 'a> {
    prover: &'p Prover<'a>,
    target: Target<'p>,
    known: FxHashMap<Subgoal, Cost>,
    /// Subgoals on the present chain: a fact that needs itself cannot be achieved.
    asked: Vec<Subgoal>,
    /// Costs of the subgoals, in the order in which they were asked.
    costs: Vec<u32>,
    /// Number of calls that may still be estimated.
    left: &'p mut usize,
    /// Applicable calls, in the order of discovery.
    ready: Vec<Ready>,
    /// Calls that achieve a fact of the target itself.
    last: Vec<CandidateCall>,
    /// A need that cannot be met, with its distance from the goal: the nearest is the best explanation.
    dead: Option<String>,
    dead_at: usize,
}

impl<'p, 'a> Estimate<'p, 'a> {
    pub(crate) fn new(prover: &'p Prover<'a>, target: Target<'p>, left: &'p mut usize) -> Self {
        Self {
            prover,
            target,
            known: FxHashMap::default(),
            asked: Vec::new(),
            costs: Vec::new(),
            left,
            ready: Vec::new(),
            last: Vec::new(),
            dead: None,
            dead_at: 0,
        }
    }

    /// Cost of what the target lacks, with the applicable calls on the way there. Fails if no call leads
    /// there, with the need that cannot be met if one is known.
    pub(super) fn lacking(mut self) -> Result<(u32, Vec<Ready>), Option<String>> {
        let Target { needs, frame, .. } = self.target;
        let costs: Vec<_> = needs.iter().map(|need| self.need(need, frame)).collect();
        let all = costs.into_iter().try_fold(Cost::default(), |all, cost| Some(all.and(cost?)));
        let Some(all) = all else { return Err(self.dead) };
        for ready in &mut self.ready {
            let served = ready.serves & all.subgoals;
            let costs = self.costs.iter().enumerate().filter(|(place, _)| bit(*place) & served != 0);
            ready.missing = costs.fold(all.sum(), |missing, (_, cost)| missing.saturating_sub(*cost));
        }
        Ok((all.sum(), self.ready))
    }

    /// Calls that achieve the first need that is not met, and whose own needs may be unmet.
    pub(crate) fn last_calls(mut self) -> Vec<CandidateCall> {
        for need in self.target.needs {
            self.need(need, self.target.frame);
            if !self.last.is_empty() {
                break;
            }
        }
        self.last
    }

    fn condition(&mut self, condition: &Condition, truth: bool, frame: CallFrame<'_>) -> Option<Cost> {
        let value = self.prover.evaluate(condition, frame);
        let value = if truth { value } else { value.not() };
        if self.target.purpose.is_met(value) {
            return Some(Cost::default());
        }
        match condition {
            Condition::Not(inner) => self.condition(inner, !truth, frame),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                let is_choice = matches!(condition, Condition::AnyOf(_)) == truth;
                let costs: Vec<_> = parts.iter().map(|part| self.condition(part, truth, frame)).collect();
                if is_choice {
                    return costs.into_iter().flatten().min_by_key(|cost| cost.sum());
                }
                costs.into_iter().try_fold(Cost::default(), |all, cost| Some(all.and(cost?)))
            }
            Condition::Fact(fact) => self.fact(fact, truth, frame, value),
            // A plan can put a monitor around a step; what numbers say is known or left to a guard.
            Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) | Condition::Unknown => {
                Some(Cost::default())
            }
            Condition::Literal(_) | Condition::Compare(..) => {
                if value.no.is_some() {
                    // That a call is for other things than these is no reason: `user != user` of what puts
                    // something down.
                    if !self.compares_entities(condition, frame) {
                        self.bury(|prover| prover.show(condition, truth, frame));
                    }
                    return None;
                }
                Some(Cost::default())
            }
        }
    }

    fn compares_entities(&self, condition: &Condition, frame: CallFrame<'_>) -> bool {
        let Condition::Compare(_, left, right) = condition else { return false };
        let is_entity = |term: &Term| self.prover.argument(term, frame).is_some();
        is_entity(left) && is_entity(right)
    }

    fn fact(&mut self, fact: &Fact, truth: bool, frame: CallFrame<'_>, value: TruthSet) -> Option<Cost> {
        let prover = self.prover;
        let is_derived = prover.library.fluent(fact.fluent).is_none_or(|def| def.derived);
        let Some(key) = prover.key(fact, frame).filter(|_| !is_derived) else { return Some(Cost::default()) };
        if truth || !key.is_pattern() {
            return self.subgoal((fact.fluent, key, truth), value);
        }
        // That none holds: each that may hold has to go.
        let held = prover.may_hold(fact.fluent, key);
        if held.is_empty() && !value.no.is_some() {
            return Some(Cost::guard(GUARD));
        }
        held.into_iter().try_fold(Cost::default(), |all, (key, value)| {
            Some(all.and(self.subgoal((fact.fluent, key, false), value.not())?))
        })
    }

    fn subgoal(&mut self, subgoal: Subgoal, value: TruthSet) -> Option<Cost> {
        if let Some(known) = self.known.get(&subgoal) {
            return Some(*known);
        }
        if self.asked.contains(&subgoal) || self.asked.len() >= DEPTH {
            return None;
        }
        self.asked.push(subgoal);
        let place = self.costs.len();
        self.costs.push(0);
        let achievers = self.prover.achievers(subgoal);
        if self.asked.len() == 1 {
            self.last.extend(achievers.iter().map(|achiever| achiever.call.clone()));
        }
        let costs: Vec<_> = achievers.iter().map(|achiever| self.achiever(achiever, place)).collect();
        let guard = (!value.no.is_some()).then(|| {
            let is_seen = self.prover.library.perceived.contains(&subgoal.0);
            Cost::guard(if is_seen { UNSEEN } else { GUARD })
        });
        let best = costs.into_iter().chain([guard]).flatten().min_by_key(|cost| cost.sum());
        self.asked.pop();
        match best {
            Some(mut best) => {
                best.subgoals |= bit(place);
                self.costs.get_mut(place).into_iter().for_each(|cost| *cost = best.sum());
                self.known.insert(subgoal, best);
                return Some(best);
            }
            None if achievers.is_empty() => {
                let (fluent, key, truth) = subgoal;
                self.bury(|prover| {
                    let name = prover.library.fluent(fluent).map_or("?", |def| def.name.as_str());
                    let count = prover.library.fluent(fluent).map_or(0, |def| def.params.len());
                    let args: Vec<_> =
                        (0..count).map(|index| prover.argument_name(fluent, index, key.arg(index))).collect();
                    let not = if truth { "" } else { "not " };
                    format!("`{not}{name}({})`", args.join(", "))
                });
            }
            None => {}
        }
        None
    }

    fn achiever(&mut self, achiever: &Achiever<'_>, place: usize) -> Option<Cost> {
        *self.left = self.left.checked_sub(1)?;
        let Achiever { call, when, subgoal } = achiever;
        let def = self.prover.library.primitive(call.primitive)?;
        let frame = CallFrame { args: &call.args, result: call.result, each: None };
        let mut before = Cost::default();
        if let Some((when, each)) = when {
            // That an effect does not come about by the way is no reason: there are others.
            let dead = (self.dead.clone(), self.dead_at);
            let cost = self.condition(when, true, CallFrame { each: *each, ..frame });
            (self.dead, self.dead_at) = dead;
            before = before.and(cost?);
        }
        for need in &def.needs {
            before = before.and(self.need(need, frame)?);
        }
        let found = if def.result.is_some() { RESULT } else { 0 };
        let own = STEP
            .saturating_add(self.general(def, call))
            .saturating_add(guesses(def, call))
            .saturating_add(self.bothers(call, *subgoal))
            .saturating_add(self.shut_in(def, call))
            .saturating_add(found);
        if before.calls == 0 {
            match self.ready.iter_mut().find(|ready| ready.call == *call) {
                Some(ready) => ready.serves |= bit(place),
                None => {
                    let cost = own.saturating_add(before.guards);
                    self.ready.push(Ready { call: call.clone(), cost, missing: 0, serves: bit(place) });
                }
            }
        }
        Some(before.and(Cost { calls: own, ..Cost::default() }))
    }

    fn need(&mut self, need: &NeedDef, frame: CallFrame<'_>) -> Option<Cost> {
        let value = self.prover.need(need, frame).0;
        if self.target.purpose.is_met(value) {
            return Some(Cost::default());
        }
        match need.each {
            Some(kind) => self.each(need, kind, frame),
            None => self.condition(&need.condition, true, frame),
        }
    }

    /// Cost of a quantified need: the sum over the entities for which it is asked.
    fn each(&mut self, need: &NeedDef, kind: Kind, frame: CallFrame<'_>) -> Option<Cost> {
        let Candidates { known, doubtful, rest } = self.prover.asked(need, kind, frame);
        let has_others = rest.is_some() || !doubtful.is_empty();
        let mut all = if has_others { self.whatever_else(&need.condition, frame) } else { Cost::default() };
        for candidate in known {
            let frame = CallFrame { each: Some(candidate), ..frame };
            all = all.and(self.condition(&need.condition, true, frame)?);
        }
        Some(all)
    }

    /// Cost of a quantified need whose entities are unknown: of what settles it for all of them, or of a
    /// guard.
    fn whatever_else(&mut self, condition: &Condition, frame: CallFrame<'_>) -> Cost {
        let guard = Cost::guard(GUARD);
        let parts = match condition {
            Condition::AnyOf(parts) => parts.as_slice(),
            only => std::slice::from_ref(only),
        };
        let settles: Vec<_> = parts.iter().filter(|part| !speaks(part, &Term::Each)).collect();
        let costs = settles.into_iter().filter_map(|part| self.condition(part, true, frame));
        costs.chain([guard]).min_by_key(|cost| cost.sum()).unwrap_or(guard)
    }

    /// Cost of parameters that are more general than their arguments.
    fn general(&self, def: &PrimitiveDef, call: &CandidateCall) -> u32 {
        let library = self.prover.library;
        let args = call.args.iter().zip(&def.params).filter_map(|(arg, param)| {
            let kind = self.prover.environment.entities().kind(entity_of(arg)?)?;
            let wanted = param.ty.kind_within()?;
            let above = std::iter::successors(Some(kind), |kind| library.kinds.get(kind.index())?.parent);
            u32::try_from(above.take_while(|kind| *kind != wanted).count()).ok()
        });
        args.sum::<u32>().saturating_mul(GENERAL)
    }

    /// Cost of driving to a thing that lies in a container: it is only seen once the robot is there.
    fn shut_in(&self, def: &PrimitiveDef, call: &CandidateCall) -> u32 {
        let goes = def.motion.as_ref().is_some_and(|(query, _)| *query == MotionKind::GoTo);
        let (Some(inside), true) = (self.prover.library.lang_items.inside, goes) else { return 0 };
        let targets = call.args.iter().filter_map(entity_of);
        let mut lies_in = targets.map(|target| FactKey::new([arg(target), ANY].into_iter()));
        let is_in = |key: FactKey| {
            let held = self.prover.may_hold(inside, key);
            held.iter().any(|(_, value)| value.is_true())
        };
        if lies_in.any(is_in) { GENERAL } else { 0 }
    }

    /// Cost of involving people.
    fn bothers(&self, call: &CandidateCall, (_, key, _): Subgoal) -> u32 {
        let (library, entities) = (self.prover.library, self.prover.environment.entities());
        let Some(person) = library.lang_items.person else { return 0 };
        let troubled = call.args.iter().filter(|arg| match arg {
            Term::Entity(entity) => {
                let is_person = entities.kind(*entity).is_some_and(|kind| library.is_kind(kind, person));
                is_person && !(0..MAX_FLUENT_PARAMS).any(|index| key.arg(index) == entity.0)
            }
            _ => false,
        });
        u32::try_from(troubled.count()).unwrap_or(u32::MAX).saturating_mul(BOTHER)
    }

    fn bury(&mut self, show: impl Fn(&Prover<'_>) -> String) {
        if self.dead.is_none() || self.asked.len() < self.dead_at {
            self.dead = Some(show(self.prover));
            self.dead_at = self.asked.len();
        }
    }
}

/// Subgoal at a place.
fn bit(place: usize) -> Subgoals {
    u32::try_from(place).ok().and_then(|place| 1_u64.checked_shl(place)).unwrap_or(0)
}

/// Cost of arguments that are guesses.
fn guesses(def: &PrimitiveDef, call: &CandidateCall) -> u32 {
    let args = call.args.iter().zip(&def.params).enumerate();
    let guessed = args.filter(|(index, (arg, param))| {
        let own = Term::Param(u16::try_from(*index).unwrap_or(u16::MAX));
        let spoken = |fact: &Fact| fact.args.iter().flatten().any(|term| *term == own);
        entity_of(arg).is_some()
            && param.default_after(|earlier| call.args.get(earlier)) != Some(*arg)
            && !def.makes.iter().any(|effect| {
                spoken(&effect.fact) || effect.when.as_ref().is_some_and(|when| speaks(when, &own))
            })
            && !def.needs.iter().any(|need| speaks(&need.condition, &own))
            && !def.motion.as_ref().is_some_and(|(_, args)| args.iter().any(|arg| is_of(arg, &own)))
    });
    u32::try_from(guessed.count()).unwrap_or(u32::MAX).saturating_mul(GUESS)
}

/// Returns whether an argument of a motion is a term, or the first of a list that the term is.
fn is_of(arg: &Term, term: &Term) -> bool {
    arg == term || matches!(arg, Term::First(list) if **list == *term)
}

/// Returns whether a condition mentions a term.
fn speaks(condition: &Condition, term: &Term) -> bool {
    condition.any(&|part| match part {
        Condition::Fact(fact) => fact.args.iter().flatten().any(|arg| arg == term),
        Condition::Compare(_, left, right) => left == term || right == term,
        _ => false,
    })
}
