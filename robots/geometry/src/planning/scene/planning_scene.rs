//! Planning scene: robot model, obstacles and permitted contacts, as plain data.
//!
//! It holds nothing that is computed lazily; a [`QueryContext`](crate::planning::QueryContext) keeps that.

use motet_robots::card::Drive;
use motet_robots::scene::{Entity, Scene, Shape as ListedShape};
use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::SmolStr;

use crate::collision::{Body, Part, Shape, Solid};
use crate::kinematics::planar;
use crate::planning::scene::articulation::Articulation;
use crate::planning::scene::configuration::Configuration;
use crate::planning::scene::contact::{Contact, ContactTarget, MIN_CLEARANCE};
use crate::planning::scene::grid_index::{Obstacle, ObstacleIndex};
use crate::planning::scene::ik_solver::IkSolver;
use crate::planning::scene::robot_model::{HandModel, RobotModel};
use crate::planning::scene::scene_state::{HeldObject, SceneState, solid_shape};

/// How near a place counts as being at it, in m.
const AT_PLACE: f64 = 0.5;

/// A robot in a scene: its model, the scene and its state, the robot's body with the held object, and the obstacles.
#[derive(Clone, Debug)]
pub struct PlanningScene<'w> {
    pub(crate) model: &'w RobotModel,
    pub(crate) scene: &'w Scene,
    pub(crate) state: &'w SceneState,
    /// The robot's body, with the held object as its last part.
    pub(crate) body: Body,
    /// Index of the part that is held.
    pub(crate) held: Option<usize>,
    pub(crate) obstacles: ObstacleIndex,
    /// Index of the container that is about to open or close, whose moving parts are not among the obstacles.
    pub(crate) opening: Option<usize>,
    /// Entities whose shape is a mesh.
    unseen: Vec<SmolStr>,
}

impl<'w> PlanningScene<'w> {
    /// Scene of a robot in a state; O(entities).
    #[must_use]
    pub fn new(model: &'w RobotModel, scene: &'w Scene, state: &'w SceneState) -> Self {
        let mut obstacles = Vec::new();
        for (entity, at) in scene.entities.values().zip(0..) {
            let parts = solids(entity, state).into_iter();
            obstacles.extend(parts.map(|solid| Obstacle::new(at, solid)));
        }
        let mut body = model.body().clone();
        let mut held = None;
        if let (Some((id, tip_from_object)), Some(hand)) = (&state.held, model.hand())
            && let Some(shape) = scene.entities.get(id).and_then(solid_shape)
        {
            held = Some(body.parts().len());
            let part = Part { link: hand.tip, solid: Solid::new(tip_from_object, shape) };
            body = body.carrying(part, |link| hand.members.get(link) == Some(&true));
        }
        let is_mesh = |entity: &&Entity| matches!(entity.shape, Some(ListedShape::Mesh { .. }));
        let unseen = scene.entities.values().filter(is_mesh).map(|entity| entity.id.clone()).collect();
        Self {
            model,
            scene,
            state,
            body,
            held,
            obstacles: ObstacleIndex::new(obstacles),
            opening: None,
            unseen,
        }
    }

    /// The robot that is asked.
    #[must_use]
    pub fn model(&self) -> &RobotModel {
        self.model
    }

    /// Where the robot is.
    #[must_use]
    pub fn start(&self) -> &Configuration {
        &self.state.robot
    }

    /// What stands around: ids of entities with a solid of theirs, in the order of the scene.
    pub fn obstacles(&self) -> impl Iterator<Item = (SmolStr, &Solid)> {
        self.obstacles.iter().map(|obstacle| (self.name(obstacle.entity), &obstacle.solid))
    }

    /// The solids of the robot in a state, with what it holds.
    #[must_use]
    pub fn robot_at(&self, configuration: &Configuration) -> Vec<Solid> {
        self.body.placed(&self.model.map_from_links(configuration))
    }

    /// Why nothing can be said in this room, if so: something in it has a shape that is not known.
    pub(crate) fn blind_spot(&self) -> Option<String> {
        if let Some(entity) = self.unseen.first() {
            return Some(format!("the shape of `{entity}` is a mesh, which is not read"));
        }
        let link = self.body.unseen().first().and_then(|link| self.model.tree().links().get(*link))?;
        Some(format!("the shape of the robot's link `{link}` is a mesh, which is not read"))
    }

    /// An entity with its index.
    pub(crate) fn entity(&self, id: &str) -> Option<(usize, &'w Entity)> {
        let (at, _, entity) = self.scene.entities.get_full(id)?;
        Some((at, entity))
    }

    /// The entity's solids, as they stand.
    pub(crate) fn solids_of(&self, entity: usize) -> impl Iterator<Item = &Solid> {
        self.obstacles
            .iter()
            .filter(move |obstacle| obstacle.entity == entity)
            .map(|obstacle| &obstacle.solid)
    }

    /// The name of an entity by index.
    pub(crate) fn name(&self, entity: usize) -> SmolStr {
        self.scene.entities.get_index(entity).map(|(id, _)| id.clone()).unwrap_or_default()
    }

    pub(crate) fn told(&self, part: usize, other: ContactTarget) -> Contact {
        let link = |part: usize| {
            let link = self.body.parts().get(part).map_or(0, |part| part.link);
            self.model.tree().links().get(link).cloned().unwrap_or_default()
        };
        let (other, is_own) = match other {
            ContactTarget::Obstacle(at) => {
                (self.obstacles.get(at).map_or_else(SmolStr::default, |it| self.name(it.entity)), false)
            }
            ContactTarget::Part(at) => (link(at), true),
            ContactTarget::Floor => (SmolStr::new_static("floor"), false),
        };
        Contact { link: link(part), other, is_own }
    }

    /// Whether no part of the robot turns on the straight way between two states.
    pub(crate) fn is_straight(&self, from: &Configuration, to: &Configuration) -> bool {
        let ([_, _, yaw], [_, _, to_yaw]) = (from.base, to.base);
        let values = from.joints.iter().zip(&to.joints).zip(self.model.turning());
        yaw == to_yaw && values.into_iter().all(|((one, other), turns)| one == other || !turns)
    }

    /// The variable that lifts the arm and its highest value, where the arm has one.
    pub(crate) fn lift(&self) -> Option<(usize, f64)> {
        let IkSolver::Lift(arm) = &self.model.hand()?.solver else {
            return None;
        };
        let chain = arm.chain();
        let (lower, upper) = chain.variables.first()?.limits?;
        Some((*chain.in_tree.first()?, if arm.up > 0.0 { upper } else { lower }))
    }

    /// The robot as it is, with the base elsewhere, the hand open, and values of the arm's joints.
    pub(crate) fn with(&self, hand: &HandModel, base: [f64; 3], values: &[f64]) -> Configuration {
        let now = &self.state.robot.joints;
        // Around something the fingers stay as they are.
        let mut joints = if self.state.held.is_some() { now.clone() } else { hand.opened(now) };
        for (at, value) in hand.solver.chain().in_tree.iter().zip(values) {
            if let Some(slot) = joints.get_mut(*at) {
                *slot = *value;
            }
        }
        Configuration { base, joints }
    }

    /// The pose of the base's link.
    pub(crate) fn map_from_base(&self, [x, y, yaw]: [f64; 3]) -> Isometry3<f64> {
        let height = self.model.card().model.as_ref().map_or(0.0, |model| model.height_m);
        planar(x, y, yaw) * Translation3::new(0.0, 0.0, height)
    }

    /// Whether the base goes in every direction.
    pub(crate) fn slides(&self) -> bool {
        self.model.drives() && self.model.card().base.drive != Drive::Differential
    }

    /// The direction in which the base is likely to face with the tip at a pose: that of the fingers, or from where the robot
    /// is where they point down.
    pub(crate) fn heading(&self, hand: &HandModel, map_from_tip: &Isometry3<f64>) -> f64 {
        let points = map_from_tip.rotation * Vector3::from(hand.card.points);
        if points.x * points.x + points.y * points.y > 0.1 {
            return libm::atan2(points.y, points.x);
        }
        let ([x, y, _], at) = (self.state.robot.base, map_from_tip.translation);
        libm::atan2(at.y - y, at.x - x)
    }

    /// How far a place is from an entity with its middle at another. A thing is served by its centre; what things stand on, in or with, by
    /// its outline.
    pub(crate) fn far_from(
        &self,
        index: usize,
        entity: &Entity,
        [x, y]: [f64; 2],
    ) -> impl Fn(f64, f64) -> f64 + use<> {
        let is_point = matches!(entity.kind.as_str(), "Object" | "Place");
        let outline: Vec<Solid> = if is_point { vec![] } else { self.solids_of(index).copied().collect() };
        move |at_x, at_y| {
            let solids = outline.iter().map(|solid| beside(solid, at_x, at_y));
            solids.reduce(f64::min).unwrap_or_else(|| libm::hypot(at_x - x, at_y - y))
        }
    }

    /// How near the base has to be to an entity to serve it, in m.
    pub(crate) fn served_within(&self, entity: &Entity) -> f64 {
        match (entity.kind.as_str(), self.model.hand()) {
            ("Place", _) | (_, None) => AT_PLACE,
            (_, Some(hand)) => hand.card.reach_m,
        }
    }

    /// What is in the hand, where it is the thing that is asked for.
    pub(crate) fn held_thing(&self, id: &str) -> Option<HeldObject<'_>> {
        let (held, tip_from_object) = self.state.held.as_ref().filter(|(held, _)| held == id)?;
        let (hand, (_, entity)) = (self.model.hand()?, self.entity(held)?);
        let shape = solid_shape(entity)?;
        let closes = tip_from_object.rotation.inverse() * Vector3::from(hand.card.closes);
        let width = 2.0 * Solid::new(&Isometry3::identity(), shape).extent(&closes);
        Some(HeldObject { id: held.clone(), tip_from_object: *tip_from_object, hand, shape, width })
    }

    /// What an entity stands on: the first other that is no farther from it than everything stays from everything.
    pub(crate) fn support(&self, entity: usize) -> Option<usize> {
        let own: Vec<&Solid> = self.solids_of(entity).collect();
        let gap = MIN_CLEARANCE + 0.001;
        let is_near = |obstacle: &Obstacle| own.iter().any(|own| !own.is_farther(&obstacle.solid, gap));
        let all =
            own.iter().flat_map(|own| self.obstacles.near([own.centre.x, own.centre.y], own.reach() + gap));
        let others = all.filter(|(_, obstacle)| obstacle.entity != entity && is_near(obstacle));
        others.min_by_key(|(index, _)| *index).map(|(_, obstacle)| obstacle.entity)
    }
}

/// The solids of an entity; none where it has no shape or its place is not known, or where it is in the hand.
///
/// A closed container is as solid as its shape. An open drawer is a box without a lid that stands out by its travel; what has
/// a door is a box without the face where the door was, and the door turned outwards.
pub(crate) fn solids(entity: &Entity, state: &SceneState) -> Vec<Solid> {
    let (Some(pose), Some(shape)) = (state.pose(entity), solid_shape(entity)) else { return vec![] };
    if state.holds(&entity.id) {
        return vec![];
    }
    let opening = state.is_open(entity).then(|| Articulation::new(entity, state)).flatten();
    opening.map_or_else(|| vec![Solid::new(&pose, shape)], |opening| opening.solids(1.0))
}

/// The distance in the plane from a place to a solid, whatever its height.
fn beside(solid: &Solid, x: f64, y: f64) -> f64 {
    let up = solid.extent(&Vector3::z());
    let vertical = Solid {
        centre: Vector3::new(x, y, solid.centre.z),
        axes: [Vector3::x(), Vector3::y(), Vector3::z()],
        shape: Shape::Capsule { radius: 0.0, half: up },
    };
    solid.distance(&vertical).max(0.0)
}
