//! Goal search: samples configurations with the tip at one of some poses and searches a path to each free
//! one.
//!
//! Poses come in the given order; for each one candidate of base and arm after the other. The trials of a
//! free configuration are in `trial`.

mod trial;

use std::ops::{ControlFlow, Range};

use nalgebra::{Isometry3, Vector3};

use super::arm_candidates::{ArmDraft, ArmPrefilter, DraftCheck, PoseBatch};
use crate::inverse::batch::LANES;
use crate::planning::checking::{CollisionChecker, HandChecker};
use crate::planning::context::QueryContext;
use crate::planning::grasp::{GraspCandidate, GraspManifold};
use crate::planning::query::{ContactTally, MotionAnswer, SearchBudget};
use crate::planning::scene::{AllowedCollisions, Configuration, Contact, HandModel, IkSolver};

/// Number of poses that get a full sample budget each; beyond it they share one. The second is for arms
/// that do not place the base, where most candidates have no solution.
const SHARED: [usize; 2] = [8, 32];
/// Rounds after which a short proof is tried, where a round takes long.
const FEW: usize = 9;
/// Number of configurations checked at a time.
const BATCH: usize = 8;

/// Goal of the hand.
pub(crate) struct GoalSpec<'a, 'r, 'w> {
    pub(crate) hand: &'a HandModel,
    /// Tip poses in the map, the likeliest first.
    pub(crate) tips: Vec<Isometry3<f64>>,
    /// Manifold that the poses sample, where it is complete: then infeasibility can be proven.
    pub(crate) manifold: Option<&'a GraspManifold<'a>>,
    /// Permitted contacts at the goal and on the approach.
    pub(crate) allowed: AllowedCollisions,
    pub(crate) checker: &'a CollisionChecker<'r, 'w>,
    /// Offsets from a tip pose back to the start of the approach, in m in the map, the best first.
    pub(crate) backs: &'a dyn Fn(&Isometry3<f64>) -> Vec<Vector3<f64>>,
    /// Contact of the hand that closes at the pose of an index.
    pub(crate) closes: &'a dyn Fn(usize) -> Option<Contact>,
}

/// Pose of the hand at the goal.
#[derive(Clone, Copy, Debug)]
pub(crate) enum GoalPose {
    /// Index of a given pose.
    Tip(usize),
    /// Another pose of the manifold: between the given ones, or found by a proof.
    Grasp(GraspCandidate),
}

/// Approach line: configurations of a straight hand path to the goal.
pub(crate) struct ApproachLine {
    at: GoalPose,
    line: Vec<Configuration>,
    inwards: [f64; 2],
}

/// Goal configuration with its tip pose.
struct GoalCandidate {
    at: GoalPose,
    tip: Isometry3<f64>,
    configuration: Configuration,
}

/// Goal pose and the path to it.
type FoundPath = (GoalPose, Vec<Configuration>);

/// Control flow of the search: breaks with a path, or without one where the budget is spent.
type SearchFlow = ControlFlow<Option<FoundPath>>;

/// Rounds of candidates to visit.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rounds {
    /// All; the first round also checks the hand alone.
    First,
    /// The first few, likewise.
    Few,
    /// The rest after `Few`.
    Rest,
    /// All again, with a budget this many times as large.
    Again(usize),
    /// Rounds beyond the first budget, up to this many times as large.
    More(usize),
}

impl Rounds {
    /// Checks whether the first round also checks the hand alone.
    fn begins(self) -> bool {
        matches!(self, Self::First | Self::Few)
    }
}

/// Region of the base's places.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BaseRegion {
    /// Places to which a route leads, approximately, with the arm as it was.
    Open,
    /// All other places.
    CutOff,
}

/// Result of the hand-only check at a pose.
#[derive(Clone, Copy, PartialEq, Eq)]
enum HandCheckState {
    Unknown,
    Free,
    Blocked,
}

/// State of one goal search.
struct GoalSearch<'a, 'r, 'w> {
    goal: &'a GoalSpec<'a, 'r, 'w>,
    budget: SearchBudget,
    /// Poses with their indices; after the first round without those that the hand-only check excludes.
    tips: Vec<(usize, Isometry3<f64>, HandCheckState)>,
    /// Finer poses of the manifold, where the search has moved on to them.
    finer: Option<Vec<GraspCandidate>>,
    hand_checker: HandChecker<'r, 'w>,
    /// Free configurations tried in this phase.
    tried: usize,
    /// Number of those with a free approach line.
    lined: usize,
    /// Set where the budget is spent.
    is_spent: bool,
    hands: ContactTally,
    poses: ContactTally,
    ways: ContactTally,
    /// Set where a candidate was skipped because no route leads near its base.
    is_cut_off: bool,
    /// Candidates to check together.
    batch: Vec<GoalCandidate>,
    /// Approach lines without a simple path, for a short search.
    left: Vec<ApproachLine>,
    /// Approach lines without a short search's path, for a long one.
    searched: Vec<ApproachLine>,
    /// First free goal configuration.
    met: Option<Configuration>,
}

impl<'a, 'r, 'w> GoalSearch<'a, 'r, 'w> {
    fn new(goal: &'a GoalSpec<'a, 'r, 'w>, budget: SearchBudget) -> Self {
        Self {
            goal,
            budget,
            tips: goal.tips.iter().enumerate().map(|(at, tip)| (at, *tip, HandCheckState::Unknown)).collect(),
            finer: None,
            hand_checker: goal.checker.context.hand_checker(goal.hand, &goal.tips, goal.allowed),
            tried: 0,
            lined: 0,
            is_spent: false,
            hands: ContactTally::default(),
            poses: ContactTally::default(),
            ways: ContactTally::default(),
            is_cut_off: false,
            batch: Vec::with_capacity(BATCH),
            left: vec![],
            searched: vec![],
            met: None,
        }
    }

    /// Checks the hand alone at a pose; unknown ones in batches.
    fn is_free(&mut self, at: usize) -> bool {
        if self.tips.get(at).is_some_and(|(_, _, known)| *known == HandCheckState::Unknown) {
            let next =
                self.tips.iter_mut().skip(at).filter(|(_, _, known)| *known == HandCheckState::Unknown);
            let mut next: Vec<_> = next.take(BATCH).collect();
            let poses: Vec<Isometry3<f64>> = next.iter().map(|(_, tip, _)| *tip).collect();
            // Of the finer poses the manifold permits only those at which the hand closes.
            let closes = |at: usize| self.finer.is_none().then(|| (self.goal.closes)(at)).flatten();
            for ((at, _, known), contact) in next.iter_mut().zip(self.hand_checker.contacts(&poses)) {
                let contact = contact.or_else(|| closes(*at));
                *known = if contact.is_some() { HandCheckState::Blocked } else { HandCheckState::Free };
                contact.iter().for_each(|contact| self.hands.add(contact));
            }
        }
        self.tips.get(at).is_some_and(|(_, _, known)| *known == HandCheckState::Free)
    }

    /// Drops the poses that the hand-only check excludes, and computes the number of rounds for the rest.
    fn rounds(&mut self, times: usize) -> usize {
        self.tips.retain(|(_, _, known)| *known != HandCheckState::Blocked);
        let [few, many] = SHARED;
        let shared = if self.places_base() || self.finer.is_some() { few } else { many };
        let candidates = self.budget.candidates.saturating_mul(times);
        candidates.min(candidates.saturating_mul(shared).div_ceil(self.tips.len().max(1)))
    }

    fn rounds_of(&mut self, times: Rounds) -> Range<usize> {
        match times {
            Rounds::First => 0..self.rounds(1),
            Rounds::Few => 0..self.rounds(1).min(FEW),
            Rounds::Rest => FEW..self.rounds(1),
            Rounds::Again(times) => 0..self.rounds(times),
            Rounds::More(times) => self.rounds(1)..self.rounds(times),
        }
    }

    fn at(&self, index: usize) -> GoalPose {
        let finer = self.finer.as_ref().and_then(|holds| holds.get(index));
        finer.map_or(GoalPose::Tip(index), |hold| GoalPose::Grasp(*hold))
    }

    fn places_base(&self) -> bool {
        matches!(self.goal.hand.solver, IkSolver::Lift(_))
    }

    /// Visits candidates one by one, a round for all poses before the next.
    fn one_by_one(&mut self, places: BaseRegion, times: Rounds) -> SearchFlow {
        let (goal, context) = (self.goal, self.goal.checker.context);
        let places_base = self.places_base();
        let is_passed = |base| context.is_near_drivable(base) != (places == BaseRegion::Open);
        let mut rounds = if times.begins() { 0..1 } else { self.rounds_of(times) };
        while let Some(round) = rounds.next() {
            for index in 0..self.tips.len() {
                if !self.is_free(index) {
                    continue;
                }
                let Some((at, tip, _)) = self.tips.get(index).copied() else { continue };
                if !places_base && is_passed(context.base_at(goal.hand, &tip, round)) {
                    self.is_cut_off |= places == BaseRegion::Open;
                    continue;
                }
                for configuration in context.candidates(goal.hand, &tip, round) {
                    if places_base && is_passed(configuration.base) {
                        self.is_cut_off |= places == BaseRegion::Open;
                        continue;
                    }
                    self.batch.push(GoalCandidate { at: self.at(at), tip, configuration });
                    if self.batch.len() == BATCH {
                        self.tries_batch()?;
                    }
                }
            }
            if round == 0 && times.begins() {
                rounds = 1..self.rounds_of(times).end;
            }
        }
        self.tries_batch()
    }

    /// Visits candidates in batches of eight.
    fn by_eights(&mut self, prefilter: &ArmPrefilter<'_, '_, '_>, times: Rounds) -> SearchFlow {
        let mut drafts: Vec<ArmDraft> = Vec::new();
        let mut groups: Vec<PoseBatch> = Vec::new();
        let mut tips: Vec<(usize, Isometry3<f64>)> = Vec::new();
        for index in 0..self.tips.len() {
            if self.is_free(index) {
                tips.extend(self.tips.get(index).map(|(at, tip, _)| (*at, *tip)));
            }
            if tips.len() == LANES || (index + 1 == self.tips.len() && !tips.is_empty()) {
                let group = prefilter.group(std::mem::take(&mut tips));
                if times.begins() {
                    prefilter.drafts(&group, 0, &mut drafts);
                    self.screened(prefilter, &mut drafts, LANES)?;
                }
                groups.push(group);
            }
        }
        for round in self.rounds_of(times).skip(usize::from(times.begins())) {
            for group in &groups {
                prefilter.drafts(group, round, &mut drafts);
                self.screened(prefilter, &mut drafts, LANES)?;
            }
        }
        self.screened(prefilter, &mut drafts, 1)?;
        self.tries_batch()
    }

    /// Checks drafts while there are at least `least`: tries the free ones at once and collects the
    /// undecided ones.
    fn screened(
        &mut self,
        prefilter: &ArmPrefilter<'_, '_, '_>,
        drafts: &mut Vec<ArmDraft>,
        least: usize,
    ) -> SearchFlow {
        while drafts.len() >= least {
            let rest = drafts.split_off(drafts.len().min(LANES));
            let seen = prefilter.seen(drafts);
            for (draft, _) in drafts.iter().zip(&seen).filter(|(_, seen)| matches!(seen, DraftCheck::Free)) {
                if let Some(candidate) = self.solved(prefilter, draft, true) {
                    self.tries(vec![candidate])?;
                }
            }
            for (draft, seen) in drafts.iter().zip(&seen) {
                match seen {
                    DraftCheck::Free => {}
                    DraftCheck::Touches(contact) => self.poses.add(contact),
                    DraftCheck::Open => {
                        let candidate = self.solved(prefilter, draft, false);
                        self.batch.extend(candidate);
                    }
                }
                if self.batch.len() == BATCH {
                    self.tries_batch()?;
                }
            }
            *drafts = rest;
        }
        ControlFlow::Continue(())
    }

    /// Solves a draft in `f64`; `None` where no route leads near its base.
    fn solved(
        &mut self,
        prefilter: &ArmPrefilter<'_, '_, '_>,
        draft: &ArmDraft,
        is_free: bool,
    ) -> Option<GoalCandidate> {
        let configuration = prefilter.configuration(draft)?;
        if self.goal.checker.context.is_near_drivable(configuration.base) {
            return Some(GoalCandidate { at: self.at(draft.at), tip: draft.tip, configuration });
        }
        self.is_cut_off = true;
        if is_free {
            self.met.get_or_insert(configuration);
        }
        None
    }
}

impl QueryContext<'_> {
    /// Searches a path from the start to one of the goal's poses.
    ///
    /// # Errors
    ///
    /// The answer where none was found.
    pub(crate) fn search_goal(
        &self,
        goal: &GoalSpec<'_, '_, '_>,
        budget: SearchBudget,
    ) -> Result<FoundPath, MotionAnswer> {
        let prefilter = match &goal.hand.solver {
            IkSolver::Lift(arm) => ArmPrefilter::new(goal.checker, goal.hand, arm, goal.allowed),
            IkSolver::Parallel(_) | IkSolver::Seven(_) | IkSolver::Steps(_) => None,
        };
        GoalSearch::new(goal, budget).all(prefilter.as_ref())
    }

    /// Greatest distance of the base from the tip of a hand, in m.
    pub(crate) fn farthest(&self, hand: &HandModel) -> f64 {
        match &hand.solver {
            IkSolver::Lift(arm) => arm.reach(),
            IkSolver::Parallel(_) | IkSolver::Seven(_) | IkSolver::Steps(_) => {
                hand.card.reach_m + self.model.card().base.radius_m
            }
        }
    }
}
