//! `look`: a thing in a camera's view with a free line of sight, the base and the arm where they are.
//!
//! A thing counts as in view where it is no farther than the card says that the camera sees, and where nothing stands between the
//! camera and one of its points. What is in the view of a camera depends on whether joints turn it: then it has to look at the thing
//! to within [`AIM`], and the thing may be no farther aside of the base's direction than half of what the card calls its view, which
//! is with its joints turned; else the whole of the view is its own.

use motet_robots::scene::Entity;
use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::kinematics::{Dof, quasi_random};
use crate::planning::query::answer::{
    BearingLimit, Infeasible, InfeasibleReason, MotionAnswer, MotionWitness, SearchBudget, UnknownReason,
};
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::AllowedCollisions;
use crate::planning::search::context::QueryContext;
use crate::planning::search::path::ContactTally;

/// The greatest angle between the axis of a camera and what it looks at, in rad; up and down of a camera that nothing turns.
const AIM: f64 = 0.37;
/// How far out on a thing points are looked at, as a share of its half extents.
const OUT: f64 = 0.8;

impl QueryContext<'_> {
    /// A state that sees an entity.
    pub(crate) fn look(&self, id: &str, budget: SearchBudget) -> MotionAnswer {
        let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        let card = self.model.card();
        let camera = card.cameras.values().next();
        let frame = camera.and_then(|camera| self.model.tree().link(camera.frame.as_deref()?).ok());
        let Some((camera, frame)) = camera.zip(frame) else {
            return unknown("the card names no camera with a frame".into());
        };
        let points = self.points_of(index, entity);
        if points.is_empty() {
            return unknown(format!("the place of `{id}` is not known"));
        }
        if self.state.holds(id) {
            return unknown(format!("the hand holds `{id}`"));
        }
        let start = &self.state.robot;
        let (moving, dofs) = self.head(frame);
        let view = CameraView {
            frame,
            range: camera.range_m,
            half: camera.view_rad / 2.0,
            is_still: moving.is_empty(),
        };
        let (mut hides, mut ways) = (ContactTally::default(), ContactTally::default());
        let mut away = f64::INFINITY;
        let rounds = if moving.is_empty() { 1 } else { budget.candidates.max(1) };
        let mut is_blocked = false;
        for at in 0..rounds {
            let mut configuration = start.clone();
            if at > 0 {
                for (slot, value) in moving.iter().zip(quasi_random(&dofs, at)) {
                    if let Some(joint) = configuration.joints.get_mut(*slot) {
                        *joint = value;
                    }
                }
            }
            match self.sees(&configuration, &view, index, &points) {
                Visibility::Free => {}
                Visibility::Hidden(by) => {
                    hides.add_entity(by);
                    continue;
                }
                Visibility::Far(far) => {
                    away = away.min(far);
                    continue;
                }
                Visibility::Aside => continue,
            }
            if let Some(path) = self.unfold(start, &configuration, &mut ways) {
                let margins = self.margins(&path, AllowedCollisions::default());
                return MotionAnswer::Feasible(Box::new(MotionWitness { path, grasp: None, margins }));
            }
            is_blocked = true;
        }
        let is_far = hides.most().is_none() && away.is_finite();
        let reason = match (is_blocked, is_far) {
            (true, _) => InfeasibleReason::BlockedPath { by: ways.most() },
            (false, true) => InfeasibleReason::OutOfReach { what: "sight", needs: away, reach: view.range },
            (false, false) => {
                let by = hides.most();
                let aside = points.first().filter(|_| by.is_none()).and_then(|it| view.beyond(start, it));
                InfeasibleReason::NotInView { by, aside }
            }
        };
        MotionAnswer::Infeasible(Infeasible::exhausted(reason))
    }

    /// The joints that turn a camera and nothing of the arm; of a camera at the wrist those of the arm.
    fn head(&self, frame: usize) -> (Vec<usize>, Vec<Dof>) {
        let arm = self.model.hand().map(|hand| &hand.solver.chain().in_tree);
        let mut all: Vec<usize> =
            self.model.ancestor_joints(frame).iter().map(|ancestor| ancestor.coupling.dof).collect();
        all.sort_unstable();
        all.dedup();
        let own: Vec<usize> =
            all.iter().copied().filter(|at| !arm.is_some_and(|arm| arm.contains(at))).collect();
        let moving = if own.is_empty() { all } else { own };
        let dofs = self.model.tree().dofs();
        let known = moving.iter().filter_map(|at| dofs.get(*at).cloned()).collect();
        (moving, known)
    }

    /// Points of an entity that may be looked at, its middle first.
    fn points_of(&self, index: usize, entity: &Entity) -> Vec<Vector3<f64>> {
        let Some(pose) = self.state.pose(entity) else { return vec![] };
        let mut points = vec![pose.translation.vector];
        for solid in self.solids_of(index) {
            for axis in [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis) {
                let far = solid.extent(&axis) * OUT;
                points.extend([solid.centre + axis * far, solid.centre - axis * far]);
            }
        }
        points
    }

    /// Whether a camera sees one of the points.
    fn sees(
        &self,
        configuration: &Configuration,
        view: &CameraView,
        index: usize,
        points: &[Vector3<f64>],
    ) -> Visibility {
        let poses = self.model.map_from_links(configuration);
        let Some(camera) = poses.get(view.frame) else { return Visibility::Aside };
        let (eye, axis) = (camera.translation.vector, camera.rotation * Vector3::z());
        let mut found = Visibility::Aside;
        for point in points {
            let way = point - eye;
            let far = way.norm();
            if far < 1e-6 || !view.holds(&axis, configuration.base[2], &way) {
                continue;
            }
            if far > view.range {
                found = if matches!(found, Visibility::Hidden(_)) { found } else { Visibility::Far(far) };
                continue;
            }
            let line = segment(&eye, point);
            let near =
                self.obstacles.near([line.centre.x, line.centre.y], far / 2.0).map(|(_, obstacle)| obstacle);
            let mut others = near.filter(|obstacle| obstacle.entity != index);
            match others.find(|obstacle| !line.is_farther(&obstacle.solid, 0.0)) {
                None => return Visibility::Free,
                Some(obstacle) => found = Visibility::Hidden(self.name(obstacle.entity)),
            }
        }
        found
    }
}

/// What a camera sees by itself.
struct CameraView {
    /// The link that it is.
    frame: usize,
    /// How far, in m.
    range: f64,
    /// Half of the view that the card gives it, in rad.
    half: f64,
    /// Whether no joint turns it.
    is_still: bool,
}

impl CameraView {
    /// Whether what is that way from a camera is in its view, the base heading so.
    fn holds(&self, axis: &Vector3<f64>, heading: f64, way: &Vector3<f64>) -> bool {
        let is_within = |angle: f64| axis.dot(way) >= libm::cos(angle) * way.norm();
        let up = |it: &Vector3<f64>| libm::atan2(it.z, libm::hypot(it.x, it.y));
        if !self.is_still {
            return is_within(AIM.min(self.half)) && aside(heading, way).abs() <= self.half;
        }
        // To the sides of what looks straight down or up there is nothing to measure from.
        if up(axis).abs() > 1.0 {
            return is_within(AIM.min(self.half));
        }
        aside(libm::atan2(axis.y, axis.x), way).abs() <= self.half && (up(way) - up(axis)).abs() <= AIM
    }

    /// How far a place is aside of where a robot heads, where that is beyond the view.
    fn beyond(&self, configuration: &Configuration, place: &Vector3<f64>) -> Option<BearingLimit> {
        let [x, y, heading] = configuration.base;
        let needs = aside(heading, &(place - Vector3::new(x, y, 0.0)));
        (!self.is_still && needs.abs() > self.half).then_some(BearingLimit { needs, limit: self.half })
    }
}

/// How far to the left of a direction in the plane a way leads, in rad.
fn aside(heading: f64, way: &Vector3<f64>) -> f64 {
    crate::trigonometry::wrapped(libm::atan2(way.y, way.x) - heading)
}

enum Visibility {
    Free,
    Hidden(smol_str::SmolStr),
    Far(f64),
    /// The camera looks elsewhere.
    Aside,
}

/// The straight line between two points as a solid.
fn segment(from: &Vector3<f64>, to: &Vector3<f64>) -> Solid {
    let way = to - from;
    let length = way.norm();
    let along = way / length;
    let other = if along.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let first = along.cross(&other).normalize();
    let axes = [first, along.cross(&first), along];
    Solid { centre: (from + to) / 2.0, axes, shape: Shape::Capsule { radius: 0.0, half: length / 2.0 } }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::CameraView;

    /// Whether what is so many degrees to the left and up from a camera that looks along x is in its view, the base heading so.
    fn sees(view: f64, is_still: bool, heading: f64, [left, up]: [f64; 2]) -> bool {
        let view = CameraView { frame: 0, range: 5.0, half: view.to_radians() / 2.0, is_still };
        let (left, up) = (left.to_radians(), up.to_radians());
        let way = Vector3::new(up.cos() * left.cos(), up.cos() * left.sin(), up.sin());
        view.holds(&Vector3::x(), heading.to_radians(), &(way * 2.0))
    }

    #[test]
    fn the_view_of_a_camera_that_nothing_turns_is_its_own() {
        for (way, is_seen) in [
            ([0.0, 0.0], true),
            ([29.0, 0.0], true),
            ([-29.0, 20.0], true),
            ([31.0, 0.0], false),
            ([0.0, 22.0], false),
            ([180.0, 0.0], false),
        ] {
            assert_eq!(sees(60.0, true, 90.0, way), is_seen, "{way:?}");
        }
    }

    #[test]
    fn a_camera_that_is_turned_looks_at_the_thing_within_its_view() {
        for (view, heading, way, is_seen) in [
            (260.0, 0.0, [20.0, 0.0], true),
            (260.0, 0.0, [23.0, 0.0], false),
            // Turned to the side as far as the view goes, and further.
            (260.0, -125.0, [0.0, 0.0], true),
            (260.0, -135.0, [0.0, 0.0], false),
            (260.0, 170.0, [0.0, 0.0], false),
            (360.0, 180.0, [0.0, 0.0], true),
            // Narrower than what the camera aims at.
            (30.0, 0.0, [14.0, 0.0], true),
            (30.0, 0.0, [17.0, 0.0], false),
        ] {
            assert_eq!(sees(view, false, heading, way), is_seen, "{view}, {heading}, {way:?}");
        }
    }
}
