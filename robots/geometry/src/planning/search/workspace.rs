//! What an arm reaches whatever stands around, from the numbers of its chain alone.

use nalgebra::{Isometry3, Vector3};

use crate::inverse::LiftArm;
use crate::inverse::interval::DisplacementBound;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::motions::reach::certain;
use crate::planning::query::answer::{InfeasibleReason, MotionAnswer};
use crate::planning::scene::ik_solver::IkSolver;
use crate::planning::scene::robot_model::HandModel;
use crate::planning::search::context::QueryContext;

/// Poses of the tip that are not out of reach for certain.
pub(crate) enum ReachEnvelope<'a> {
    /// With the wrist between two heights, in m.
    Heights(&'a LiftArm, [f64; 2]),
    /// Within a distance of the shoulder, in m.
    CollisionChecker(Vector3<f64>, f64),
    /// The base drives to it, and the arm is not known well enough.
    Anywhere,
}

impl QueryContext<'_> {
    /// What a hand reaches.
    pub(crate) fn span<'h>(&self, hand: &'h HandModel) -> ReachEnvelope<'h> {
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
        ReachEnvelope::CollisionChecker(shoulder.coords, reach)
    }
}

impl ReachEnvelope<'_> {
    /// Whether a pose is not out of reach for certain.
    pub(crate) fn holds(&self, map_from_tip: &Isometry3<f64>) -> bool {
        match self {
            Self::Heights(arm, [least, greatest]) => {
                let height = arm.centre(map_from_tip).z;
                // Rounding takes nothing away.
                (least - 1e-6..=greatest + 1e-6).contains(&height)
            }
            Self::CollisionChecker(shoulder, reach) => {
                (map_from_tip.translation.vector - shoulder).norm() <= reach + 1e-6
            }
            Self::Anywhere => true,
        }
    }

    /// Whether all poses that are near to one, by no more than what is told of it, are out of reach for certain.
    pub(crate) fn is_beyond(&self, map_from_tip: &Isometry3<f64>, drift: &DisplacementBound) -> bool {
        match self {
            Self::Heights(arm, [least, greatest]) => {
                let centre = arm.centre(map_from_tip).coords;
                let off = drift.point(&centre, 0.0) + 1e-6;
                centre.z + off < *least || centre.z - off > *greatest
            }
            Self::CollisionChecker(shoulder, reach) => {
                let tip = map_from_tip.translation.vector;
                (tip - shoulder).norm() > reach + drift.point(&tip, 0.0) + 1e-6
            }
            Self::Anywhere => false,
        }
    }

    /// That no arm configuration brings the hand to a thing at a place, where that is certain if it is of all other holds as of these.
    pub(crate) fn beyond(
        &self,
        place: &Vector3<f64>,
        id: &str,
        holds: &[GraspCandidate],
    ) -> Option<MotionAnswer> {
        let tips: Vec<_> = holds.iter().map(|hold| hold.map_from_tip).collect();
        self.beyond_all(place, &format!("`{id}`"), &tips).map(|(reason, change)| certain(reason, change))
    }

    /// Why no arm configuration brings the hand to any of some poses, and by how much `what`, which is at a place, is off.
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
                // In terms of the thing's height: the wrist is so much above or below it. That is not enough for a hand to have
                // room there, and nothing stands below the floor.
                let change = (place.z - off > 0.0).then(|| {
                    let least = whole_centimetres(off.abs());
                    let change = if off > 0.0 { "lower" } else { "higher" };
                    format!("{what} would have to be at least {least:.2} m {change}")
                });
                let reason =
                    InfeasibleReason::OutOfReach { what: "height", needs: place.z, reach: place.z - off };
                Some((reason, change))
            }
            Self::CollisionChecker(shoulder, reach) => {
                let needs = tips.iter().map(|tip| (tip.translation.vector - shoulder).norm());
                let needs = needs.fold(f64::INFINITY, f64::min);
                Some((InfeasibleReason::OutOfReach { what: "distance", needs, reach: *reach }, None))
            }
            Self::Anywhere => None,
        }
    }
}

/// A length in m, rounded up to whole centimetres.
pub(crate) fn whole_centimetres(metres: f64) -> f64 {
    libm::ceil(metres * 100.0) / 100.0
}
