//! `look`: an entity in a camera's view with a free line of sight, with base and arm still.
//!
//! An entity is in view within the range of the card, where neither an obstacle nor the held object hides
//! one of its points. A camera that joints turn has to aim at it to within [`AIM`], and its bearing from the
//! base may be at most half of the card's view, which includes the joints' motion. The view of a fixed camera
//! is its own.

use motet_robots::card::CameraMount;
use motet_robots::scene::Entity;
use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::kinematics::{Dof, quasi_random};
use crate::planning::context::QueryContext;
use crate::planning::query::{
    BearingLimit, ContactTally, Infeasible, InfeasibleReason, MotionAnswer, MotionWitness, ReachLength,
    SearchBudget, UnknownReason,
};
use crate::planning::scene::{AllowedCollisions, Configuration, RobotModel};

/// Greatest angle between a camera's axis and its target, in rad; for a fixed camera up and down only.
const AIM: f64 = 0.37;
/// Positions of its joints by which the elevations of a camera are found.
const TURNS: usize = 256;
/// Distance of sampled points from an entity's centre, as a share of its half extents.
const OUT: f64 = 0.8;

/// Answers `look`: a configuration that sees an entity.
pub(crate) fn look(context: &QueryContext<'_>, id: &str, budget: SearchBudget) -> MotionAnswer {
    let unknown = |why: String| MotionAnswer::Unknown(UnknownReason::Because(why));
    let Some((index, entity)) = context.entity(id) else { return unknown(format!("there is no `{id}`")) };
    let card = context.model.card();
    let camera = card.cameras.values().next();
    let frame = camera.and_then(|camera| context.model.tree().link(camera.frame.as_deref()?).ok());
    let Some((camera, frame)) = camera.zip(frame) else {
        return unknown("the card names no camera with a frame".into());
    };
    let points = points_of(context, index, entity);
    if points.is_empty() {
        return unknown(format!("the pose of `{id}` is unknown"));
    }
    if context.state.holds(id) {
        return unknown(format!("the hand holds `{id}`"));
    }
    let start = &context.state.robot;
    let (moving, dofs) = head(context.model, frame);
    let view =
        CameraView { frame, range: camera.range_m, half: camera.view_rad / 2.0, is_still: moving.is_empty() };
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
        match sees(context, &configuration, &view, index, &points) {
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
        if let Some(path) = context.unfold(start, &configuration, &mut ways) {
            let margins = context.margins(&path, AllowedCollisions::default());
            return MotionAnswer::Feasible(Box::new(MotionWitness { path, grasp: None, margins }));
        }
        is_blocked = true;
    }
    let is_far = hides.most().is_none() && away.is_finite();
    let reason = match (is_blocked, is_far) {
        (true, _) => InfeasibleReason::BlockedPath { by: ways.most() },
        (false, true) => {
            InfeasibleReason::OutOfReach { length: ReachLength::Sight, needs: away, reach: view.range }
        }
        (false, false) => {
            let by = hides.most();
            let aside = points.first().filter(|_| by.is_none()).and_then(|it| view.beyond(start, it));
            InfeasibleReason::NotInView { by, aside }
        }
    };
    MotionAnswer::Infeasible(Infeasible::exhausted(reason))
}

impl RobotModel {
    /// Place of the first camera of the card, in the posture `start` if there is one, and how far its joints
    /// turn it up and down, whatever may be in their way. `None` if the card does not name the camera's link.
    #[must_use]
    pub fn camera_mount(&self) -> Option<CameraMount> {
        *self.camera_mount.get_or_init(|| self.find_camera_mount())
    }

    fn find_camera_mount(&self) -> Option<CameraMount> {
        let link = self.tree().link(self.card().cameras.values().next()?.frame.as_ref()?).ok()?;
        let camera = |joints: &[f64]| {
            let poses = self.map_from_links(&Configuration { base: [0.0; 3], joints: joints.to_vec() });
            let pose = poses.get(link)?;
            Some((
                pose.translation.vector.into(),
                libm::asin((pose.rotation * Vector3::z()).z.clamp(-1.0, 1.0)),
            ))
        };
        let mut joints = self.posture("start", self.rest()).unwrap_or_else(|| self.rest().to_vec());
        let ((_, home), (eye, start)) = (camera(self.rest())?, camera(&joints)?);
        let (moving, dofs) = head(self, link);
        let mut tilt = [home.min(start), home.max(start)];
        for at in 1..=TURNS {
            for (slot, position) in moving.iter().zip(quasi_random(&dofs, at)) {
                joints.get_mut(*slot).into_iter().for_each(|joint| *joint = position);
            }
            let (_, up) = camera(&joints)?;
            tilt = [tilt[0].min(up), tilt[1].max(up)];
        }
        let arm = self.hand().map(|hand| &hand.solver.chain().in_tree);
        let is_on_arm = moving.iter().any(|at| arm.is_some_and(|arm| arm.contains(at)));
        Some(CameraMount { eye, rests: [home, start], tilt, is_on_arm })
    }
}

/// Joints that turn a camera and are not the arm's; all of them for a camera at the wrist.
fn head(model: &RobotModel, frame: usize) -> (Vec<usize>, Vec<Dof>) {
    let arm = model.hand().map(|hand| &hand.solver.chain().in_tree);
    let mut all: Vec<usize> =
        model.ancestor_joints(frame).iter().map(|ancestor| ancestor.coupling.dof).collect();
    all.sort_unstable();
    all.dedup();
    let own: Vec<usize> = all.iter().copied().filter(|at| !arm.is_some_and(|arm| arm.contains(at))).collect();
    let moving = if own.is_empty() { all } else { own };
    let dofs = model.tree().dofs();
    let known = moving.iter().filter_map(|at| dofs.get(*at).cloned()).collect();
    (moving, known)
}

/// Points of an entity to look at, its centre first.
fn points_of(context: &QueryContext<'_>, index: usize, entity: &Entity) -> Vec<Vector3<f64>> {
    let Some(pose) = context.state.pose(entity) else { return vec![] };
    let mut points = vec![pose.translation.vector];
    for solid in context.solids_of(index) {
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis) {
            let far = solid.extent(&axis) * OUT;
            points.extend([solid.centre + axis * far, solid.centre - axis * far]);
        }
    }
    points
}

/// Checks whether the camera sees one of the points.
fn sees(
    context: &QueryContext<'_>,
    configuration: &Configuration,
    view: &CameraView,
    index: usize,
    points: &[Vector3<f64>],
) -> Visibility {
    let poses = context.model.map_from_links(configuration);
    let Some(camera) = poses.get(view.frame) else { return Visibility::Aside };
    let (eye, axis) = (camera.translation.vector, camera.rotation * Vector3::z());
    let load = context.held_solid(&poses);
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
            context.obstacles.near([line.centre.x, line.centre.y], far / 2.0).map(|(_, obstacle)| obstacle);
        let mut others = near.filter(|obstacle| obstacle.entity != index && !context.is_kept(obstacle));
        let hides = |solid: &Solid| !line.is_farther(solid, 0.0);
        let held = load.as_ref().filter(|(_, solid)| hides(solid)).map(|(id, _)| (*id).clone());
        let by = held.or_else(|| {
            others.find(|obstacle| hides(&obstacle.solid)).map(|obstacle| context.name(obstacle.entity))
        });
        match by {
            None => return Visibility::Free,
            Some(by) => found = Visibility::Hidden(by),
        }
    }
    found
}

/// View of a camera.
struct CameraView {
    /// Index of its link.
    frame: usize,
    /// Range in m.
    range: f64,
    /// Half of the horizontal view, in rad.
    half: f64,
    /// Set where no joint turns it.
    is_still: bool,
}

impl CameraView {
    /// Checks whether a direction from the camera is in its view, with the base at a heading.
    fn holds(&self, axis: &Vector3<f64>, heading: f64, way: &Vector3<f64>) -> bool {
        let is_within = |angle: f64| axis.dot(way) >= libm::cos(angle) * way.norm();
        let up = |it: &Vector3<f64>| libm::atan2(it.z, libm::hypot(it.x, it.y));
        if !self.is_still {
            return is_within(AIM.min(self.half)) && aside(heading, way).abs() <= self.half;
        }
        // A camera that looks straight up or down has no bearing.
        if up(axis).abs() > 1.0 {
            return is_within(AIM.min(self.half));
        }
        aside(libm::atan2(axis.y, axis.x), way).abs() <= self.half && (up(way) - up(axis)).abs() <= AIM
    }

    /// Bearing of a place, where it is beyond the view.
    fn beyond(&self, configuration: &Configuration, place: &Vector3<f64>) -> Option<BearingLimit> {
        let [x, y, heading] = configuration.base;
        let needs = aside(heading, &(place - Vector3::new(x, y, 0.0)));
        (!self.is_still && needs.abs() > self.half).then_some(BearingLimit { needs, limit: self.half })
    }
}

/// Bearing relative to a heading, positive to the left, in rad.
fn aside(heading: f64, way: &Vector3<f64>) -> f64 {
    crate::trigonometry::wrapped(libm::atan2(way.y, way.x) - heading)
}

enum Visibility {
    Free,
    Hidden(smol_str::SmolStr),
    Far(f64),
    Aside,
}

/// Line segment as a solid.
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

    /// Checks a direction, in degrees to the left and up, from a camera that looks along x.
    fn sees(view: f64, is_still: bool, heading: f64, [left, up]: [f64; 2]) -> bool {
        let view = CameraView { frame: 0, range: 5.0, half: view.to_radians() / 2.0, is_still };
        let (left, up) = (left.to_radians(), up.to_radians());
        let way = Vector3::new(up.cos() * left.cos(), up.cos() * left.sin(), up.sin());
        view.holds(&Vector3::x(), heading.to_radians(), &(way * 2.0))
    }

    #[test]
    fn view_of_a_fixed_camera_is_its_own() {
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
    fn view_of_a_turning_camera_contains_the_target() {
        for (view, heading, way, is_seen) in [
            (260.0, 0.0, [20.0, 0.0], true),
            (260.0, 0.0, [23.0, 0.0], false),
            // At the limit of the view, and beyond it.
            (260.0, -125.0, [0.0, 0.0], true),
            (260.0, -135.0, [0.0, 0.0], false),
            (260.0, 170.0, [0.0, 0.0], false),
            (360.0, 180.0, [0.0, 0.0], true),
            // Narrower than the camera's aim.
            (30.0, 0.0, [14.0, 0.0], true),
            (30.0, 0.0, [17.0, 0.0], false),
        ] {
            assert_eq!(sees(view, false, heading, way), is_seen, "{view}, {heading}, {way:?}");
        }
    }
}
