//! Trials of a free goal configuration: simple paths to it and, for some, RRT-Connect. Where all fail: finer
//! grasps, places of the base that the map cuts off, an infeasibility certificate, and more candidates.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use nalgebra::Isometry3;

use super::{
    ApproachLine, BaseRegion, FoundPath, GoalCandidate, GoalPose, GoalSearch, GoalSpec, HandCheckState,
    Rounds, SearchFlow,
};
use crate::planning::certify::Certificate;
use crate::planning::grasp::{GraspCandidate, GraspManifold};
use crate::planning::query::{ContactTally, Infeasible, InfeasibleReason, MotionAnswer, UnknownReason};
use crate::planning::scene::Configuration;
use crate::planning::search::arm_candidates::ArmPrefilter;
use crate::planning::search::path::PathError;
use crate::planning::search::rrt_connect::RrtEffort;

/// Number of free configurations without a simple path after which a search is tried.
const SIMPLE: usize = 6;
/// Approach lines per short search.
const SEARCHED: usize = 3;
/// Approach lines kept for the long search.
const LEFT: usize = 8;
/// Number of configurations without an approach line that cost as much as one with a line.
const CHEAP: usize = 8;
/// Cells of the first and of the second proof; most proofs are short.
const SHORT: usize = 128;
const LONGER: usize = 1024;
/// Free configurations of a proof that are tried.
const MET: usize = 8;
/// Spacing of finer grasps: the motion of any point of the hand between neighbours, in m. The second is for
/// small manifolds.
const FINE: [f64; 2] = [0.05, 0.005];
/// Least number of finer grasps, and about the greatest.
const POSES: [usize; 2] = [128, 1024];
/// Budget factor where the map cuts the base off: most of these candidates are useless.
const CUT_OFF: usize = 4;
/// Budget factor of the last phase.
const MORE: usize = 8;

impl GoalSearch<'_, '_, '_> {
    /// Runs the search to a path or to the answer without one.
    pub(crate) fn all(
        &mut self,
        prefilter: Option<&ArmPrefilter<'_, '_, '_>>,
    ) -> Result<FoundPath, MotionAnswer> {
        match self.found(prefilter) {
            ControlFlow::Break(way) => Ok(way),
            ControlFlow::Continue(is_proven) => Err(self.none(is_proven)),
        }
    }

    /// Runs the phases of the search; continues with `true` where infeasibility is proven.
    fn found(&mut self, prefilter: Option<&ArmPrefilter<'_, '_, '_>>) -> ControlFlow<FoundPath, bool> {
        if prefilter.is_some() {
            self.is_spent = self.goes(prefilter, BaseRegion::Open, Rounds::First)?;
        } else {
            self.is_spent = self.goes(prefilter, BaseRegion::Open, Rounds::Few)?;
            // A numeric candidate costs as much as a cell.
            if self.proves(SHORT)? == Certificate::Nowhere {
                return ControlFlow::Continue(true);
            }
            self.is_spent = self.is_spent || self.goes(prefilter, BaseRegion::Open, Rounds::Rest)?;
        }
        let Some(manifold) = self.goal.manifold.filter(|_| !self.is_spent) else {
            self.searches_long()?;
            return ControlFlow::Continue(false);
        };
        if self.proves(LONGER)? == Certificate::Nowhere {
            return ControlFlow::Continue(true);
        }
        // Trials beyond the given poses do not weaken an answer.
        self.refines(manifold);
        self.goes(prefilter, BaseRegion::Open, Rounds::First)?;
        if self.is_cut_off {
            self.goes(None, BaseRegion::CutOff, Rounds::Again(CUT_OFF))?;
        }
        self.searches_long()?;
        if self.budget.cells > LONGER && self.proves(usize::MAX)? == Certificate::Nowhere {
            return ControlFlow::Continue(true);
        }
        self.goes(prefilter, BaseRegion::Open, Rounds::More(MORE))?;
        if self.is_cut_off {
            self.goes(None, BaseRegion::CutOff, Rounds::More(MORE))?;
        }
        self.searches_long()?;
        ControlFlow::Continue(false)
    }

    /// Visits candidates; continues with `true` where the budget is spent.
    fn goes(
        &mut self,
        prefilter: Option<&ArmPrefilter<'_, '_, '_>>,
        places: BaseRegion,
        times: Rounds,
    ) -> ControlFlow<FoundPath, bool> {
        self.batch.clear();
        if times != Rounds::Rest {
            (self.tried, self.lined) = (0, 0);
        }
        let ended = match prefilter {
            Some(prefilter) => self.by_eights(prefilter, times),
            None => self.one_by_one(places, times),
        };
        match ended {
            ControlFlow::Break(Some(way)) => ControlFlow::Break(way),
            ControlFlow::Break(None) => ControlFlow::Continue(true),
            ControlFlow::Continue(()) => ControlFlow::Continue(false),
        }
    }

    /// Moves on to finer grasps of the manifold.
    fn refines(&mut self, manifold: &GraspManifold<'_>) {
        let goal = self.goal;
        let finer = finer(manifold);
        let tips: Vec<Isometry3<f64>> = finer.iter().map(|hold| hold.map_from_tip).collect();
        self.hand_checker = goal.checker.context.hand_checker(goal.hand, &tips, goal.allowed);
        self.tips =
            tips.into_iter().enumerate().map(|(at, tip)| (at, tip, HandCheckState::Unknown)).collect();
        self.finer = Some(finer);
    }

    /// Runs an infeasibility certificate of up to `cells` cells, or finds a path to a free configuration
    /// that it meets. Skipped where a free one is known.
    fn proves(&mut self, cells: usize) -> ControlFlow<FoundPath, Certificate> {
        let goal = self.goal;
        let Some(manifold) = goal.manifold.filter(|_| self.met.is_none()) else {
            return ControlFlow::Continue(Certificate::Open);
        };
        let cells = cells.min(self.budget.cells);
        let mut found = None;
        let before = std::mem::take(&mut self.tried);
        let covered =
            goal.checker.covered(goal.hand, manifold, goal.allowed, cells, |hold, configuration| {
                self.meets(hold, configuration, &mut found)
            });
        self.tried += before;
        match found {
            Some(way) => ControlFlow::Break(way),
            None => ControlFlow::Continue(covered),
        }
    }

    /// Answer without a path.
    fn none(&mut self, is_proven: bool) -> MotionAnswer {
        let none_free =
            |search: &Self| if search.poses.is_empty() { &search.hands } else { &search.poses }.none_free();
        if is_proven {
            return MotionAnswer::Infeasible(Infeasible::proven(none_free(self), None));
        }
        if self.is_spent {
            return MotionAnswer::Unknown(UnknownReason::Budget);
        }
        let configuration = self.met.take();
        let reason = match configuration.is_some() || self.is_cut_off {
            true => InfeasibleReason::BlockedPath { by: self.ways.most() },
            false => none_free(self),
        };
        let configuration = configuration.map(Box::new);
        MotionAnswer::Infeasible(Infeasible { configuration, ..Infeasible::exhausted(reason) })
    }

    /// Tries the collected candidates.
    pub(crate) fn tries_batch(&mut self) -> SearchFlow {
        let batch = std::mem::take(&mut self.batch);
        self.tries(batch)
    }

    /// Tries candidates one by one.
    pub(crate) fn tries(&mut self, batch: Vec<GoalCandidate>) -> SearchFlow {
        let goal = self.goal;
        let configurations: Vec<&Configuration> =
            batch.iter().map(|candidate| &candidate.configuration).collect();
        let contacts = goal.checker.contacts(&configurations, goal.allowed);
        for (candidate, contact) in batch.into_iter().zip(contacts) {
            if let Some(contact) = contact {
                self.poses.add(&contact);
                continue;
            }
            if let Some(way) = self.simple(candidate) {
                return ControlFlow::Break(Some(way));
            }
            // A search may succeed where simple paths fail.
            if self.tried.is_multiple_of(SIMPLE)
                && let Some(way) = self.searches()
            {
                return ControlFlow::Break(Some(way));
            }
            let paths = self.budget.paths;
            if self.lined >= paths || self.tried >= paths.saturating_mul(CHEAP) {
                return ControlFlow::Break(None);
            }
        }
        ControlFlow::Continue(())
    }

    /// Simple path to a free configuration.
    fn simple(&mut self, GoalCandidate { at, tip, configuration }: GoalCandidate) -> Option<FoundPath> {
        self.tried += 1;
        let way = self.goal.way_to(&tip, &configuration, &mut self.ways);
        self.met.get_or_insert(configuration);
        match way {
            Ok(path) => return Some((at, path)),
            Err(None) => {}
            Err(Some(line)) => {
                self.lined += 1;
                if self.left.len() < SEARCHED {
                    let inwards = line.first()?.inwards(&tip.translation.vector);
                    self.left.push(ApproachLine { at, line, inwards });
                }
            }
        }
        None
    }

    /// Tries a free configuration that a proof met.
    fn meets(
        &mut self,
        hold: &GraspCandidate,
        configuration: Configuration,
        found: &mut Option<FoundPath>,
    ) -> ControlFlow<()> {
        let candidate = GoalCandidate { at: GoalPose::Grasp(*hold), tip: hold.map_from_tip, configuration };
        self.is_cut_off |= !self.goal.checker.context.is_near_drivable(candidate.configuration.base);
        *found = self.simple(candidate).or_else(|| self.searches());
        if found.is_none() && self.tried < MET { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }

    /// Short searches to the collected approach lines.
    fn searches(&mut self) -> Option<FoundPath> {
        for lined in self.left.drain(..) {
            if let Some(path) = self.goal.checker.retreat(&lined.line, lined.inwards, RrtEffort::Short) {
                return Some((lined.at, path));
            }
            if self.searched.len() < LEFT {
                self.searched.push(lined);
            }
        }
        None
    }

    /// Long searches to the remaining approach lines.
    fn searches_long(&mut self) -> ControlFlow<FoundPath> {
        let checker = self.goal.checker;
        let mut left = self.searched.drain(..).chain(self.left.drain(..)).take(LEFT);
        let way = left.find_map(|ApproachLine { at, line, inwards, .. }| {
            Some((at, checker.retreat(&line, inwards, RrtEffort::Long)?))
        });
        way.map_or(ControlFlow::Continue(()), ControlFlow::Break)
    }
}

/// Grasps at the middles of small patches.
fn finer(manifold: &GraspManifold<'_>) -> Vec<GraspCandidate> {
    let ([near, nearer], [few, most]) = (FINE, POSES);
    let mut open = VecDeque::from(manifold.patches());
    let mut found = Vec::new();
    while let Some(patch) = open.pop_front() {
        let (size, across) = manifold.widest(&patch);
        let count = open.len() + found.len();
        if (size > near && count < most) || (size > nearer && count < few) {
            open.extend(patch.halves(across));
        } else {
            found.extend(manifold.hold(&patch));
        }
    }
    found
}

impl GoalSpec<'_, '_, '_> {
    /// Path from the start to a free goal configuration.
    ///
    /// # Errors
    ///
    /// An approach line to which no route was found, where there is one.
    fn way_to(
        &self,
        tip: &Isometry3<f64>,
        configuration: &Configuration,
        met: &mut ContactTally,
    ) -> Result<Vec<Configuration>, Option<Vec<Configuration>>> {
        let mut left = None;
        for back in (self.backs)(tip) {
            let Some(line) = self.checker.context.line(self.hand, configuration, tip, &back) else {
                continue;
            };
            match self.along(tip, &line, met) {
                Ok(path) => return Ok(path),
                Err(PathError::Line) => {}
                Err(PathError::Route) => left = left.or(Some(line)),
            }
        }
        Err(left)
    }

    /// Path from the start along an approach line.
    fn along(
        &self,
        tip: &Isometry3<f64>,
        line: &[Configuration],
        met: &mut ContactTally,
    ) -> Result<Vec<Configuration>, PathError> {
        let inner: Vec<&Configuration> = line.iter().take(line.len().saturating_sub(1)).skip(1).collect();
        if let Some(contact) = self.checker.first_contact(&inner, self.allowed) {
            met.add(&contact);
            return Err(PathError::Line);
        }
        let inwards = line.first().map_or([1.0, 0.0], |first| first.inwards(&tip.translation.vector));
        self.checker.route_to(line, inwards, self.allowed, met)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test fails by panicking")]
mod tests {
    use nalgebra::{Isometry3, Vector3};

    use super::{FINE, POSES, finer};
    use crate::collision::{Shape, Solid};
    use crate::planning::grasp::GraspManifold;
    use crate::planning::grasp::grasp_candidates;
    use crate::planning::scene::RobotModel;

    #[test]
    fn grasp_candidates_have_finer_ones_nearby() {
        let model = RobotModel::embedded("hsr");
        let hand = model.hand().unwrap();
        let shapes = [
            Shape::Capsule { radius: 0.03, half: 0.0 },
            Shape::Cylinder { radius: 0.03, half: 0.05 },
            Shape::Box(Vector3::new(0.03, 0.05, 0.08)),
        ];
        for shape in shapes {
            let object = Solid::new(&Isometry3::translation(1.0, 0.2, 0.6), shape);
            let base = [0.0; 3];
            let fine = finer(&GraspManifold::new(hand, &object, None, base));
            let (coarse, _) = grasp_candidates(hand, &object, None, base, None);
            assert!(fine.len() >= 64 && fine.len() <= 2 * POSES[1], "{shape:?}: {}", fine.len());
            for hold in &coarse {
                // The wrist: a point of the hand about as far from the object as the arm begins.
                let wrist = |pose: &Isometry3<f64>| {
                    pose * nalgebra::Point3::from(Vector3::from(hand.card.points) * -0.2)
                };
                let far = |other: &Isometry3<f64>| {
                    let tip = (hold.map_from_tip.translation.vector - other.translation.vector).norm();
                    tip.max((wrist(&hold.map_from_tip) - wrist(other)).norm())
                };
                let least = fine.iter().map(|other| far(&other.map_from_tip)).fold(f64::INFINITY, f64::min);
                assert!(least < 4.0 * FINE[0], "{shape:?}: {least}");
            }
        }
    }
}
