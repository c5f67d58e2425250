//! Handle of a container: the grasps of it, and the motion of the hand that follows it.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::collision::{Shape, Solid};
use crate::planning::context::QueryContext;
use crate::planning::grasp::candidates::GraspCandidate;
use crate::planning::grasp::manifold::GraspManifold;
use crate::planning::query::answer::GraspSide;
use crate::planning::scene::articulation::{Articulation, THICK};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::robot_model::HandModel;
use crate::trigonometry::turn;

/// Overlap of the finger tips with the bar beyond its middle, in m.
pub(crate) const BEYOND: f64 = 0.01;
/// Approach angles about the handle from the normal of its face, in rad.
const TILTS: [f64; 5] = [0.0, 0.52, -0.52, 1.05, -1.05];
/// Places along a handle, as shares of half of its length.
const PLACES: [f64; 3] = [0.0, 0.6, -0.6];

/// Handle to be grasped, and the travel that it follows.
pub(crate) struct HandlePull<'a> {
    pub(crate) id: &'a str,
    pub(crate) hand: &'a HandModel,
    pub(crate) opening: Articulation,
    /// Start and end of the travel, 0 closed and 1 open.
    pub(crate) parts: [f64; 2],
    /// Distance of the bar's middle before the tip, in m.
    pub(crate) depth: f64,
}

/// Part of the robot that follows the handle.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum FollowMode {
    /// Base, with the arm still.
    Base(HandSlide),
    /// Arm, with the base still.
    Arm(HandSlide),
}

/// Share of the door's turn that the hand slides about the bar: 0 turns with the door, 1 keeps its
/// direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct HandSlide(pub(crate) f64);

impl HandlePull<'_> {
    /// Modes in which the robot may follow, the most promising first.
    pub(crate) fn followings(
        &self,
        model: &crate::planning::scene::robot_model::RobotModel,
    ) -> Vec<FollowMode> {
        use motet_robots::card::Drive;
        let mut all = Vec::new();
        let turns_level = self.opening.hinge().is_none_or(|(axis, _)| axis.z.abs() > 1.0 - 1e-9);
        if turns_level && matches!(model.card().base.drive, Drive::Omnidirectional | Drive::Legged) {
            let turnings: &[f64] = if self.opening.hinge().is_some() { &[1.0, 0.5, 0.0] } else { &[0.0] };
            all.extend(turnings.iter().map(|share| FollowMode::Base(HandSlide(*share))));
        }
        if !matches!(self.hand.solver, crate::planning::scene::ik_solver::IkSolver::Lift(_)) {
            let turnings: &[f64] = if self.opening.hinge().is_some() { &[0.5, 0.0, 1.0] } else { &[0.0] };
            all.extend(turnings.iter().map(|share| FollowMode::Arm(HandSlide(*share))));
        }
        all
    }

    /// Pose of the handle's middle at `part` of the travel.
    pub(crate) fn map_from_handle(&self, part: f64) -> Isometry3<f64> {
        let handle = self.opening.handle();
        let rotation = UnitQuaternion::face_towards(&handle.along, &handle.out);
        self.opening.map_moved(part)
            * Isometry3::from_parts(Translation3::from(handle.centre.coords), rotation)
    }

    /// Grasp candidates of the handle in a fixed order.
    pub(crate) fn holds(&self) -> Vec<GraspCandidate> {
        let handle = self.opening.handle();
        let moved = self.opening.map_moved(self.parts[0]);
        let axis = Unit::new_normalize(handle.along);
        let mut all = Vec::new();
        for tilt in TILTS {
            let approach = turn(&axis, tilt) * -handle.out;
            let closes = handle.along.cross(&approach);
            for place in PLACES {
                for closes in [closes, -closes] {
                    let bar = handle.centre + handle.along * (place * handle.half);
                    let rotation = self.hand.turned(&approach, &closes);
                    let at = bar.coords - approach * self.depth - closes * self.hand.middle(THICK);
                    let pose = Isometry3::from_parts(Translation3::from(at), rotation);
                    let approach = moved.rotation * approach;
                    let side = if approach.z < -0.819 { GraspSide::Top } else { GraspSide::Side };
                    // A hand never comes from below.
                    if approach.z <= 0.5 {
                        all.push(GraspCandidate { map_from_tip: moved * pose, approach, side, width: THICK });
                    }
                }
            }
        }
        all
    }

    /// Manifold of all grasps of the handle, for a certificate.
    pub(crate) fn manifold(&self) -> GraspManifold<'_> {
        let handle = self.opening.handle();
        let moved = self.opening.map_moved(self.parts[0]);
        let (along, out) = (moved.rotation * handle.along, moved.rotation * handle.out);
        let shape = Shape::Capsule { radius: THICK / 2.0, half: handle.half };
        let bar =
            Solid { centre: (moved * handle.centre).coords, axes: [out, along.cross(&out), along], shape };
        let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        GraspManifold::of_bar(self.hand, &bar, out, self.depth, [most(&TILTS), most(&PLACES)])
    }

    /// Point of the bar between the fingers, at the start.
    pub(crate) fn bar(&self, hold: &GraspCandidate) -> Point3<f64> {
        let closes = hold.map_from_tip.rotation * Vector3::from(self.hand.card.closes);
        let from_tip = hold.approach * self.depth + closes * self.hand.middle(THICK);
        Point3::from(hold.map_from_tip.translation.vector + from_tip)
    }
}

impl HandlePull<'_> {
    /// Motion of the hand in the map after `done` of its path.
    pub(crate) fn moved(
        &self,
        hold: &GraspCandidate,
        done: f64,
        HandSlide(share): HandSlide,
    ) -> Isometry3<f64> {
        let [from, to] = self.parts;
        let part = from + (to - from) * done;
        let moved = self.opening.map_moved(part) * self.opening.map_moved(from).inverse();
        let Some((axis, angle)) = self.opening.hinge() else { return moved };
        let bar = self.bar(hold);
        let back = turn(&axis, -share * angle * (part - from));
        Translation3::from((moved * bar).coords) * (back * moved.rotation) * Translation3::from(-bar.coords)
    }
}

/// Configuration with the fingers around the handle.
pub(crate) fn gripping(
    context: &QueryContext<'_>,
    hand: &HandModel,
    configuration: &Configuration,
) -> Configuration {
    Configuration {
        base: configuration.base,
        joints: hand.around(&configuration.joints, context.model.rest(), THICK),
    }
}

/// Reach of the hand in front of its tip with the fingers closed around an object of a width, in m.
pub(crate) fn front_around(context: &QueryContext<'_>, hand: &HandModel, width: f64) -> f64 {
    let rest = context.model.rest();
    let poses = context.model.tree().root_from_links(&hand.around(rest, rest, width));
    let tip_from_root = poses.get(hand.tip).copied().unwrap_or_default().inverse();
    let points = Vector3::from(hand.card.points);
    let parts = context.model.body().parts().iter().filter(|it| hand.members.get(it.link) == Some(&true));
    let ends = parts.filter_map(|part| {
        let solid = part.solid.moved(&(tip_from_root * poses.get(part.link)?));
        Some(solid.centre.dot(&points) + solid.extent(&points))
    });
    ends.fold(0.0, f64::max)
}
