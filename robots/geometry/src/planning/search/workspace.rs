//! Workspace of an arm: an outer bound of its reach from the lengths of its chain alone, whatever the
//! obstacles.

use nalgebra::{Isometry3, Vector3};

use crate::inverse::LiftArm;
use crate::inverse::interval::DisplacementBound;
use crate::planning::grasp::GraspCandidate;
use crate::planning::query::{InfeasibleReason, MotionAnswer, ReachLength, certain};
use crate::planning::scene::{HandModel, IkSolver, PlanningScene};

/// Reach envelope: tip poses outside of it are unreachable for certain.
pub(crate) enum ReachEnvelope<'a> {
    /// Wrist heights of an arm on a lift, in m; the base drives anywhere.
    Heights(&'a LiftArm, [f64; 2]),
    /// Ball around the shoulder, with its radius in m.
    Ball(Vector3<f64>, f64),
    /// No bound: the base drives to the pose.
    Anywhere,
}

impl PlanningScene<'_> {
    /// Reach envelope of a hand.
    pub(crate) fn reach_envelope<'h>(&self, hand: &'h HandModel) -> ReachEnvelope<'h> {
        if let IkSolver::Lift(arm) = &hand.solver {
            return ReachEnvelope::Heights(arm, arm.heights());
        }
        let chain = hand.solver.chain();
        let Some(first) = chain.joints.first().filter(|_| !self.model.drives()) else {
            return ReachEnvelope::Anywhere;
        };
        let first = nalgebra::Point3::from(first.before.translation.vector);
        let shoulder = self.map_from_base(self.state.robot.base) * first;
        let links = chain.joints.iter().skip(1).map(|joint| joint.before.translation.vector.norm());
        let slides = chain.joints.iter().filter(|joint| joint.is_prismatic).map(|joint| {
            let limits = chain.dofs.get(joint.coupling.dof).and_then(|known| known.limits);
            limits.map_or(f64::INFINITY, |(lower, upper)| {
                lower.abs().max(upper.abs()) * joint.coupling.multiplier.abs() + joint.coupling.offset.abs()
            })
        });
        let reach = links.chain(slides).sum::<f64>() + chain.last_from_tip.translation.vector.norm();
        ReachEnvelope::Ball(shoulder.coords, reach)
    }
}

impl ReachEnvelope<'_> {
    /// Checks whether a pose may be reachable.
    pub(crate) fn holds(&self, map_from_tip: &Isometry3<f64>) -> bool {
        match self {
            Self::Heights(arm, [least, greatest]) => {
                let height = arm.centre(map_from_tip).z;
                // Spare for rounding.
                (least - 1e-6..=greatest + 1e-6).contains(&height)
            }
            Self::Ball(shoulder, reach) => {
                (map_from_tip.translation.vector - shoulder).norm() <= reach + 1e-6
            }
            Self::Anywhere => true,
        }
    }

    /// Checks whether all poses within a drift of one are unreachable.
    pub(crate) fn is_beyond(&self, map_from_tip: &Isometry3<f64>, drift: &DisplacementBound) -> bool {
        match self {
            Self::Heights(arm, [least, greatest]) => {
                let centre = arm.centre(map_from_tip).coords;
                let off = drift.point(&centre, 0.0) + 1e-6;
                centre.z + off < *least || centre.z - off > *greatest
            }
            Self::Ball(shoulder, reach) => {
                let tip = map_from_tip.translation.vector;
                (tip - shoulder).norm() > reach + drift.point(&tip, 0.0) + 1e-6
            }
            Self::Anywhere => false,
        }
    }

    /// Answer for an object out of reach of all grasp candidates; `None` where one may be reachable. The
    /// caller proves it for the other grasps.
    pub(crate) fn beyond(
        &self,
        place: &Vector3<f64>,
        id: &str,
        holds: &[GraspCandidate],
    ) -> Option<MotionAnswer> {
        let tips: Vec<_> = holds.iter().map(|hold| hold.map_from_tip).collect();
        self.beyond_all(place, &format!("`{id}`"), &tips).map(|(reason, change)| certain(reason, change))
    }

    /// Reason and change for a target at `place`, called `what`, none of whose tip poses is reachable.
    pub(crate) fn beyond_all(
        &self,
        place: &Vector3<f64>,
        what: &str,
        tips: &[Isometry3<f64>],
    ) -> Option<(InfeasibleReason, Option<String>)> {
        if tips.is_empty() || tips.iter().any(|tip| self.holds(tip)) {
            return None;
        }
        match self {
            Self::Heights(arm, [least, greatest]) => {
                let off = tips.iter().map(|tip| {
                    let height = arm.centre(tip).z;
                    if height > *greatest { height - greatest } else { height - least }
                });
                let off = off.reduce(|one, other| if other.abs() < one.abs() { other } else { one })?;
                // In terms of the object's height: the wrist is off by this much. Being in reach is not
                // enough for being feasible, and nothing is below the floor.
                let change = (place.z - off > 0.0).then(|| {
                    let least = whole_centimetres(off.abs());
                    let change = if off > 0.0 { "lower" } else { "higher" };
                    format!("{what} would have to be at least {least:.2} m {change}")
                });
                let reason = InfeasibleReason::OutOfReach {
                    length: ReachLength::Height,
                    needs: place.z,
                    reach: place.z - off,
                };
                Some((reason, change))
            }
            Self::Ball(shoulder, reach) => {
                let needs = tips.iter().map(|tip| (tip.translation.vector - shoulder).norm());
                let needs = needs.fold(f64::INFINITY, f64::min);
                Some((
                    InfeasibleReason::OutOfReach { length: ReachLength::Distance, needs, reach: *reach },
                    None,
                ))
            }
            Self::Anywhere => None,
        }
    }
}

/// Length in m, rounded up to whole centimetres.
pub(crate) fn whole_centimetres(metres: f64) -> f64 {
    libm::ceil(metres * 100.0) / 100.0
}
