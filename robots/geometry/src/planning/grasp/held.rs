//! State that a scene describes. An object of which the scene only says that it is held is held as `reach`
//! would grasp it, upright.

use std::collections::BTreeMap;

use motet_robots::scene::{Grip, Scene};
use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::SmolStr;

use super::candidates::{GraspCandidate, grasp_candidates, in_order, rank};
use crate::collision::Solid;
use crate::kinematics::planar;
use crate::planning::context::QueryContext;
use crate::planning::query::{InfeasibleReason, MotionAnswer, UnknownReason, certain};
use crate::planning::scene::{
    Configuration, HeldObject, PlanningScene, RobotModel, SceneState, above_floor, isometry, solid_shape,
};

/// Place of the object before the base while its grasp is chosen, in m.
const AHEAD: [f64; 3] = [1.0, 0.0, 0.8];
/// Number of grasps of which the first without a contact is chosen.
const TRIED: usize = 64;

impl SceneState {
    /// State that a scene describes. Joints that it does not name are at rest. Without a grip in the scene, a
    /// held object is as `reach` grasps one that stands upright on something before the robot: the first of
    /// its list with which the robot has no contact as it stands, and of equals the one that holds it most
    /// upright.
    #[must_use]
    pub fn new(model: &RobotModel, scene: &Scene) -> Self {
        let mut joints = model.rest().to_vec();
        for (name, value) in &scene.robot.joints {
            if let Some(slot) = model.tree().dof(name).ok().and_then(|at| joints.get_mut(at)) {
                *slot = *value;
            }
        }
        let mut state = Self {
            robot: Configuration { base: scene.robot.base, joints },
            moved: BTreeMap::new(),
            held: None,
            open: BTreeMap::new(),
            kept: Vec::new(),
        };
        if let Some(Some(id)) = &scene.robot.holding {
            let given = scene.robot.grip.as_ref().filter(|grip| grip.of == *id);
            let given = given.map(|grip| isometry(&grip.tip_from_object));
            let grip = given.or_else(|| grip(model, scene, &state, id));
            if let Some(grip) = grip {
                state = state.holding(model, scene, id, grip);
            }
        }
        state
    }

    /// The same with this grip of what the hand holds; `None` if it holds something else.
    #[must_use]
    pub fn gripping(&self, model: &RobotModel, scene: &Scene, grip: &Grip) -> Option<Self> {
        self.holds(&grip.of).then(|| self.holding(model, scene, &grip.of, isometry(&grip.tip_from_object)))
    }

    /// The same with an object in the hand, and the fingers around it, whatever the scene says of them.
    fn holding(&self, model: &RobotModel, scene: &Scene, id: &SmolStr, grip: Isometry3<f64>) -> Self {
        let mut state = Self { held: Some((id.clone(), grip)), ..self.clone() };
        if let Some((hand, shape)) = model.hand().zip(scene.entities.get(id).and_then(solid_shape)) {
            state.robot.joints = hand.around(&state.robot.joints, model.rest(), hand.width(shape, &grip));
        }
        state
    }
}

impl PlanningScene<'_> {
    /// Answer to a motion of the held object that the hand cannot hold; `None` for the others.
    pub(crate) fn unheld(&self, held: &HeldObject<'_>) -> Option<MotionAnswer> {
        let (_, entity) = self.entity(&held.id)?;
        let limit = held.hand.card.payload_kg;
        if let Some(needs) = entity.mass_kg.filter(|mass| *mass > limit) {
            return Some(certain(InfeasibleReason::TooHeavy { needs, limit }, None));
        }
        let is_given = self.scene.robot.grip.as_ref().is_some_and(|grip| grip.of == held.id);
        let (grasps, _) = grasp_candidates(
            held.hand,
            &Solid::new(&Isometry3::identity(), held.shape),
            None,
            self.state.robot.base,
            None,
        );
        let why =
            format!("no grasp by `{}` of `{}` is known, and the scene gives none", held.hand.name, held.id);
        (!is_given && grasps.is_empty()).then_some(MotionAnswer::Unknown(UnknownReason::Because(why)))
    }
}

/// Pose in the tip's frame of an object that the hand holds; `None` for a shape that no hand holds.
fn grip(model: &RobotModel, scene: &Scene, state: &SceneState, id: &SmolStr) -> Option<Isometry3<f64>> {
    let (hand, shape) = model.hand().zip(scene.entities.get(id).and_then(solid_shape))?;
    let [x, y, yaw] = state.robot.base;
    let pose = planar(x, y, yaw) * Translation3::from(Vector3::from(AHEAD));
    let ahead = planar(x, y, yaw).rotation * Vector3::x();
    let object = Solid::new(&pose, shape);
    let (mut all, _) = grasp_candidates(hand, &object, None, state.robot.base, None);
    in_order(&mut all, &ahead);
    // It stood on something, which the hand does not reach into.
    let bottom = object.centre.z - object.extent(&Vector3::z());
    let stays_above = |hold: &GraspCandidate| {
        let fingers = hand.closing.sweep(hold.width, hold.depth, hold.contact);
        let mut solids = hand.closing.open().chain(fingers);
        solids.all(|own| above_floor(&own.moved(&hold.map_from_tip)) > bottom)
    };
    if all.iter().any(stays_above) {
        all.retain(stays_above);
    }
    let map_from_tip = model.map_from_links(&state.robot).get(hand.tip).copied()?;
    let up = |grip: &Isometry3<f64>| (map_from_tip.rotation * grip.rotation * Vector3::z()).z;
    let grips = all.iter().take(TRIED).map(|hold| (rank(hold, &ahead), hold.map_from_tip.inverse() * pose));
    let grips: Vec<(usize, Isometry3<f64>)> = grips.collect();
    let is_free = |grip: &Isometry3<f64>| {
        let held = state.holding(model, scene, id, *grip);
        QueryContext::new(model, scene, &held).start_contact().is_none()
    };
    let Some((best, first)) = grips.iter().find(|(_, grip)| is_free(grip)).or(grips.first()) else {
        // No list holds it: level, its near face at the palm.
        let rotation = hand.turned(&ahead, &Vector3::z().cross(&ahead));
        let at = object.centre - ahead * (hand.palm + object.extent(&ahead)).max(0.0);
        return Some(Isometry3::from_parts(Translation3::from(at), rotation).inverse() * pose);
    };
    let equals = grips.iter().filter(|(rank, grip)| rank == best && up(grip) > up(first) + 1e-6);
    let upright = equals.map(|(_, grip)| grip).filter(|grip| is_free(grip));
    Some(*upright.max_by(|one, other| up(one).total_cmp(&up(other))).unwrap_or(first))
}
