//! The search for a way of the hand to one of some poses: the poses in the order in which they are given, for each one
//! candidate for the base and the arm after the other. Which ways are looked for to a candidate, and what is tried where there is none, is
//! in `trial`.

use std::ops::{ControlFlow, Range};

use nalgebra::{Isometry3, Vector3};

use crate::inverse::batch::LANES;
use crate::planning::checking::collision_checker::CollisionChecker;
use crate::planning::checking::hand_check::HandChecker;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::grasp::manifold::GraspManifold;
use crate::planning::query::answer::{MotionAnswer, SearchBudget};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::scene::ik_solver::IkSolver;
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::ContactTally;
use crate::planning::search::prefilter_arm::{ArmDraft, ArmPrefilter, DraftCheck, PoseBatch};

mod trial;

use trial::ApproachLine;

/// So many poses have the candidates of a budget each; more share them. Where the base is not placed by the arm's own solver,
/// most candidates have no solution at all, and the poses that were given have more.
const SHARED: [usize; 2] = [8, 32];
/// Rounds after which a short proof is tried, where a round takes long.
const FEW: usize = 9;
/// How far the base comes from where it stands in the end while the hand reaches, in m.
pub(crate) const LAST: f64 = 0.65;
/// States that are looked at at a time for what they touch.
const BATCH: usize = 8;

/// Where the hand is wanted.
pub(crate) struct GoalSpec<'a, 'r, 'w> {
    pub(crate) hand: &'a HandModel,
    /// Poses of its tip in the map, the likeliest first.
    pub(crate) tips: Vec<Isometry3<f64>>,
    /// All ways in which the hand may hold something, of which the poses are some, where these are all that are considered: so it is
    /// proven that there is no way where the hand alone is free in none.
    pub(crate) manifold: Option<&'a GraspManifold<'a>>,
    /// What may touch there and on the last line to it.
    pub(crate) allowed: AllowedCollisions,
    pub(crate) checker: &'a CollisionChecker<'r, 'w>,
    /// From a pose of the tip back to where the last straight line to it begins, in m in the map: the best first.
    pub(crate) backs: &'a dyn Fn(&Isometry3<f64>) -> Vec<Vector3<f64>>,
}

/// Where the hand is in the end.
#[derive(Clone, Copy, Debug)]
pub(crate) enum GoalPose {
    /// At a pose that was given, by its index.
    Tip(usize),
    /// At another, between those or where a proof found room for it.
    GraspCandidate(GraspCandidate),
}

/// A state with the tip at a pose.
struct GoalCandidate {
    at: GoalPose,
    tip: Isometry3<f64>,
    configuration: Configuration,
}

/// Where the hand is, with the way to it.
type FoundPath = (GoalPose, Vec<Configuration>);

/// What ends a search through candidates: a way, or that as many were tried as may be.
type SearchFlow = ControlFlow<Option<FoundPath>>;

/// Which rounds of candidates are gone through.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rounds {
    /// All; in the first it is found out in which poses the hand alone is free.
    First,
    /// The first few of them, likewise.
    Few,
    /// The others.
    Rest,
    /// All once more, with a budget so many times as large.
    Again(usize),
    /// Those that come after them with a budget so many times as large.
    More(usize),
}

impl Rounds {
    /// Whether it is found out in the first round in which poses the hand alone is free.
    fn begins(self) -> bool {
        matches!(self, Self::First | Self::Few)
    }
}

/// Which places of the base are looked at.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BaseRegion {
    /// To which a way leads, about, with the arm as it was and the base taken for a disc.
    Open,
    /// The others.
    CutOff,
}

/// What is known of the hand alone in a pose.
#[derive(Clone, Copy, PartialEq, Eq)]
enum HandCheckState {
    Unknown,
    Free,
    Blocked,
}

/// What was tried of a budget, and what was met.
struct GoalSearch<'a, 'r, 'w> {
    goal: &'a GoalSpec<'a, 'r, 'w>,
    budget: SearchBudget,
    /// The poses by their index; after the first round without those in which the hand alone is not free.
    tips: Vec<(usize, Isometry3<f64>, HandCheckState)>,
    /// What they are, where they are none of those that were given.
    finer: Option<Vec<GraspCandidate>>,
    hand_checker: HandChecker<'r, 'w>,
    /// Free states that were tried since the last time that as many began to be tried as may be.
    tried: usize,
    /// Of these so many to which the hand comes straight.
    lined: usize,
    /// Whether as many were tried as may be.
    is_spent: bool,
    hands: ContactTally,
    poses: ContactTally,
    ways: ContactTally,
    /// Whether a candidate was passed over because no way leads near to where its base is.
    is_cut_off: bool,
    /// States to look at.
    batch: Vec<GoalCandidate>,
    /// Free states to which the hand comes straight, and no simple way leads.
    left: Vec<ApproachLine>,
    /// Some of those to which a short search led nowhere.
    searched: Vec<ApproachLine>,
    /// A free state.
    met: Option<Configuration>,
}

impl<'a, 'r, 'w> GoalSearch<'a, 'r, 'w> {
    fn new(goal: &'a GoalSpec<'a, 'r, 'w>, budget: SearchBudget) -> Self {
        Self {
            goal,
            budget,
            tips: goal.tips.iter().enumerate().map(|(at, tip)| (at, *tip, HandCheckState::Unknown)).collect(),
            finer: None,
            hand_checker: goal.checker.context.palm(goal.hand, &goal.tips, goal.allowed),
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

    /// Whether the hand alone is free in a pose. Where that is not known it is found out for the next ones as well.
    fn is_free(&mut self, at: usize) -> bool {
        if self.tips.get(at).is_some_and(|(_, _, known)| *known == HandCheckState::Unknown) {
            let next =
                self.tips.iter_mut().skip(at).filter(|(_, _, known)| *known == HandCheckState::Unknown);
            let mut next: Vec<_> = next.take(BATCH).collect();
            let poses: Vec<Isometry3<f64>> = next.iter().map(|(_, tip, _)| *tip).collect();
            for ((_, _, known), contact) in next.iter_mut().zip(self.hand_checker.contacts(&poses)) {
                *known = if contact.is_some() { HandCheckState::Blocked } else { HandCheckState::Free };
                contact.iter().for_each(|contact| self.hands.add(contact));
            }
        }
        self.tips.get(at).is_some_and(|(_, _, known)| *known == HandCheckState::Free)
    }

    /// Leaves out the poses in which the hand alone is known not to be free: so many rounds are left for the others, with a budget so many times as
    /// large.
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
        finer.map_or(GoalPose::Tip(index), |hold| GoalPose::GraspCandidate(*hold))
    }

    fn places_base(&self) -> bool {
        matches!(self.goal.hand.solver, IkSolver::Lift(_))
    }

    /// Goes through all candidates, those of a round for all poses before the next; what ends the search.
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

    /// The same candidates, eight at a time.
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

    /// Looks at drafts while there are at least so many: the free ones are tried at once, those that come near something when
    /// there are enough of them.
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

    /// A draft to what `f64` can tell, where a way may lead to it.
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
    /// A way from where the robot is to one of the poses: which, and the states.
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

    /// How far the base can be from the tip of a hand, in m.
    pub(crate) fn farthest(&self, hand: &HandModel) -> f64 {
        match &hand.solver {
            IkSolver::Lift(arm) => arm.reach(),
            IkSolver::Parallel(_) | IkSolver::Seven(_) | IkSolver::Steps(_) => {
                hand.card.reach_m + self.model.card().base.radius_m
            }
        }
    }
}
