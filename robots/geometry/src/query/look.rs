//! `look`: a thing in a camera's view with a free line of sight, the base and the arm where they are.
//!
//! A thing counts as in view where the camera looks at it to within [`AIM`], which lies within the view of any camera, is no
//! farther than the card says that the camera sees, and where nothing stands between the camera and one of its points.

use motet_robots::scene::Entity;
use nalgebra::Vector3;

use super::answer::{Answer, Budget, Infeasible, Reason, Unknown, Witness};
use super::room::Room;
use super::state::State;
use super::touch::Allowed;
use super::travel::Tally;
use crate::collision::{Shape, Solid};
use crate::kinematics::{Variable, spread};

/// The greatest angle between the camera's axis and what it looks at, in rad.
const AIM: f64 = 0.37;
/// How far out on a thing points are looked at, as a share of its half extents.
const OUT: f64 = 0.8;

impl Room<'_> {
    /// A state that sees an entity.
    pub(super) fn look(&self, id: &str, budget: Budget) -> Answer {
        let unknown = |why: String| Answer::Unknown(Unknown::Because(why));
        let Some((index, entity)) = self.entity(id) else { return unknown(format!("there is no `{id}`")) };
        let card = self.machine.card();
        let camera = card.cameras.values().next();
        let frame = camera.and_then(|camera| self.machine.tree().link(camera.frame.as_deref()?).ok());
        let Some((camera, frame)) = camera.zip(frame) else {
            return unknown("the card names no camera with a frame".into());
        };
        let points = self.points_of(index, entity);
        if points.is_empty() {
            return unknown(format!("the place of `{id}` is not known"));
        }
        if self.world.holds(id) {
            return unknown(format!("the hand holds `{id}`"));
        }
        let start = &self.world.robot;
        let (moving, variables) = self.head(frame);
        let (mut hides, mut ways) = (Tally::default(), Tally::default());
        let mut away = f64::INFINITY;
        let rounds = if moving.is_empty() { 1 } else { budget.candidates.max(1) };
        let mut is_blocked = false;
        for at in 0..rounds {
            let mut state = start.clone();
            if at > 0 {
                for (slot, value) in moving.iter().zip(spread(&variables, at)) {
                    if let Some(joint) = state.joints.get_mut(*slot) {
                        *joint = value;
                    }
                }
            }
            match self.sees(&state, frame, index, &points, camera.range_m) {
                Sight::Free => {}
                Sight::Hidden(by) => {
                    hides.add_entity(by);
                    continue;
                }
                Sight::Far(far) => {
                    away = away.min(far);
                    continue;
                }
                Sight::Aside => continue,
            }
            if let Some(path) = self.unfold(start, &state, &mut ways) {
                let margins = self.margins(&path, Allowed::default());
                return Answer::Feasible(Box::new(Witness { path, grasp: None, margins }));
            }
            is_blocked = true;
        }
        let is_far = hides.most().is_none() && away.is_finite();
        let reason = match (is_blocked, is_far) {
            (true, _) => Reason::BlockedPath { by: ways.most() },
            (false, true) => Reason::OutOfReach { what: "sight", needs: away, reach: camera.range_m },
            (false, false) => Reason::NotInView { by: hides.most() },
        };
        Answer::Infeasible(Infeasible::exhausted(reason))
    }

    /// The joints that turn a camera and nothing of the arm; of a camera at the wrist those of the arm.
    fn head(&self, frame: usize) -> (Vec<usize>, Vec<Variable>) {
        let arm = self.machine.hand().map(|hand| &hand.solver.chain().in_tree);
        let mut all: Vec<usize> =
            self.machine.levers(frame).iter().map(|lever| lever.driver.variable).collect();
        all.sort_unstable();
        all.dedup();
        let own: Vec<usize> =
            all.iter().copied().filter(|at| !arm.is_some_and(|arm| arm.contains(at))).collect();
        let moving = if own.is_empty() { all } else { own };
        let variables = self.machine.tree().variables();
        let known = moving.iter().filter_map(|at| variables.get(*at).cloned()).collect();
        (moving, known)
    }

    /// Points of an entity that may be looked at, its middle first.
    fn points_of(&self, index: usize, entity: &Entity) -> Vec<Vector3<f64>> {
        let Some(pose) = self.world.pose(entity) else { return vec![] };
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
    fn sees(&self, state: &State, frame: usize, index: usize, points: &[Vector3<f64>], range: f64) -> Sight {
        let poses = self.machine.map_from_links(state);
        let Some(camera) = poses.get(frame) else { return Sight::Aside };
        let (eye, axis) = (camera.translation.vector, camera.rotation * Vector3::z());
        let mut found = Sight::Aside;
        for point in points {
            let way = point - eye;
            let far = way.norm();
            if far < 1e-6 || axis.dot(&way) < libm::cos(AIM) * far {
                continue;
            }
            if far > range {
                found = if matches!(found, Sight::Hidden(_)) { found } else { Sight::Far(far) };
                continue;
            }
            let line = segment(&eye, point);
            let near = self.things.near([line.centre.x, line.centre.y], far / 2.0).map(|(_, thing)| thing);
            let mut others = near.filter(|thing| thing.entity != index);
            match others.find(|thing| !line.is_farther(&thing.solid, 0.0)) {
                None => return Sight::Free,
                Some(thing) => found = Sight::Hidden(self.name(thing.entity)),
            }
        }
        found
    }
}

enum Sight {
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
