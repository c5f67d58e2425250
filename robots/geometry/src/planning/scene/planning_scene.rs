//! Planning scene: robot model, obstacles and permitted contacts, as plain data.
//!
//! It holds nothing that is computed lazily; a [`QueryContext`](crate::planning::QueryContext) keeps that.

use motet_robots::card::Drive;
use motet_robots::clearance::Clearance;
use motet_robots::scene::{Entity, EntityShape, Scene, person_gap};
use motet_stdlib::lang::kinds;
use nalgebra::{Isometry3, Translation3, Vector3};
use smol_str::SmolStr;

use super::articulation::Articulation;
use super::configuration::Configuration;
use super::obstacle::{
    AllowedCollisions, Contact, ContactTarget, MIN_CLEARANCE, Obstacle, ObstacleIndex, Padding,
};
use super::robot_model::{HandModel, IkSolver, RobotModel};
use super::scene_state::{HeldObject, SceneState, solid_shape};
use crate::collision::{CollisionModel, LinkSolid, Shape, Solid};
use crate::kinematics::planar;

/// Distance at which the base counts as being at a place, in m.
const AT_PLACE: f64 = 0.5;
/// Distance up to which a robot counts as being at a handle, in m.
const AT_BAR: f64 = 0.03;

/// A robot in a scene: its model, the scene and its state, the robot's body with the held object, and the
/// obstacles.
#[derive(Clone, Debug)]
pub struct PlanningScene<'w> {
    pub(crate) model: &'w RobotModel,
    pub(crate) scene: &'w Scene,
    pub(crate) state: &'w SceneState,
    /// The robot's body, with the held object as its last part.
    pub(crate) body: CollisionModel,
    /// Index of the part that is held.
    pub(crate) held: Option<usize>,
    /// Distances that motions keep from obstacles.
    pub(crate) clearance: Clearance,
    pub(crate) obstacles: ObstacleIndex,
    /// Index of the container that is about to open or close, whose moving parts are not among the obstacles.
    pub(crate) opening: Option<usize>,
    /// Entities whose shape is a mesh.
    unseen: Vec<SmolStr>,
}

impl<'w> PlanningScene<'w> {
    /// Scene of a robot in a state, with the clearance of the scene or, where it gives none, of the card.
    /// O(entities + parts × obstacles near).
    #[must_use]
    pub fn new(model: &'w RobotModel, scene: &'w Scene, state: &'w SceneState) -> Self {
        Self::with_clearance(model, scene, state, scene.clearance.over(model.card().clearance))
    }

    /// Scene whose motions keep a given clearance.
    pub(crate) fn with_clearance(
        model: &'w RobotModel,
        scene: &'w Scene,
        state: &'w SceneState,
        clearance: Clearance,
    ) -> Self {
        let padding = Padding::new(clearance);
        let mut obstacles = Vec::new();
        for (entity, at) in scene.entities.values().zip(0..) {
            let parts = solids(entity, state).into_iter();
            obstacles.extend(parts.map(|solid| Obstacle::new(at, solid, padding)));
        }
        for (region, at) in state.kept.iter().zip(scene.entities.len()..) {
            // A distance that a rule gives is the greater one: the clearance counts from what it is about.
            let padding = if region.is_distance { Padding::LEAST } else { padding };
            obstacles.extend(region.columns.iter().map(|column| Obstacle::new(at, *column, padding)));
        }
        let mut body = model.body().clone();
        let mut held = None;
        if let (Some((id, tip_from_object)), Some(hand)) = (&state.held, model.hand())
            && let Some(shape) = scene.entities.get(id).and_then(solid_shape)
        {
            held = Some(body.parts().len());
            let part = LinkSolid { link: hand.tip, solid: Solid::new(tip_from_object, shape) };
            body = body.with_attached(part, |link| hand.members.get(link) == Some(&true));
        }
        let is_mesh = |entity: &&Entity| matches!(entity.shape, Some(EntityShape::Mesh { .. }));
        let unseen = scene.entities.values().filter(is_mesh).map(|entity| entity.id.clone()).collect();
        let mut planning = Self {
            model,
            scene,
            state,
            body,
            held,
            clearance,
            obstacles: ObstacleIndex::new(obstacles),
            opening: None,
            unseen,
        };
        planning.add_bars(padding);
        planning.permit_start();
        planning
    }

    /// Adds the handles of what is open, except for those that the robot is at, as after it let go.
    fn add_bars(&mut self, padding: Padding) {
        let bars = self.scene.entities.values().zip(0..).filter_map(|(entity, at)| {
            let opening = self.state.is_open(entity).then(|| Articulation::new(entity, self.state))??;
            Some(Obstacle::new(at, opening.bar(1.0), padding))
        });
        let mut bars: Vec<Obstacle> = bars.collect();
        if bars.is_empty() {
            return;
        }
        let placed = self.robot_at(&self.state.robot);
        bars.retain(|bar| placed.iter().all(|own| own.is_farther(&bar.solid, AT_BAR)));
        let all = self.obstacles.iter().copied().chain(bars);
        self.obstacles = ObstacleIndex::new(all.collect());
    }

    /// Lets the robot begin nearer to an obstacle than the clearance: it then keeps the distance that it has.
    fn permit_start(&mut self) {
        if self.obstacles.iter().all(|obstacle| obstacle.padding == Padding::LEAST) {
            return;
        }
        let placed = self.robot_at(&self.state.robot);
        let placed: Vec<(Solid, f64, bool)> = placed
            .iter()
            .zip(0..)
            .map(|(solid, part)| (*solid, solid.reach(), self.is_carried(part)))
            .collect();
        self.obstacles.permit(&placed, Padding::new(self.clearance).most());
    }

    /// Lets the held object begin nearer to an obstacle than the clearance, with the tip at a pose.
    pub(crate) fn permit_held(&mut self, map_from_tip: &Isometry3<f64>) {
        let held = self.state.held.as_ref();
        let shape = held.and_then(|(id, _)| solid_shape(self.scene.entities.get(id)?));
        let Some(((_, tip_from_object), shape)) = held.zip(shape) else { return };
        let solid = Solid::new(&(map_from_tip * tip_from_object), shape);
        let most = Padding::new(self.clearance).most();
        self.obstacles.permit(&[(solid, solid.reach(), true)], most);
    }

    /// Checks whether a part of the body belongs to the arm, to the hand, or is held.
    pub(crate) fn is_carried(&self, part: usize) -> bool {
        let link = self.body.parts().get(part).map(|part| part.link);
        let carried = self.model.hand().map(|hand| &hand.carried);
        self.held == Some(part) || carried.zip(link).is_some_and(|(all, link)| all.get(link) == Some(&true))
    }

    /// Distances in m that motions of the base and the arm keep from obstacles. Nearer may come what touches
    /// by intent: the hand to the object that it grasps or released and to its support, the held object to
    /// the surface on which it stands, the hand to the container whose handle it grasps. Where the robot
    /// begins nearer to an obstacle, it keeps the distance that it has there, less a millimetre.
    #[must_use]
    pub fn clearance_kept(&self) -> Clearance {
        self.clearance
    }

    /// Padding of the obstacles of an entity: the least of theirs.
    pub(crate) fn padding_of(&self, entity: usize) -> Padding {
        let own = self.obstacles.iter().filter(|obstacle| obstacle.entity == entity);
        own.map(|obstacle| obstacle.padding).fold(Padding::new(self.clearance), Padding::least)
    }

    /// Obstacles with a smaller padding than the clearance asks for, by index.
    pub(crate) fn permitted(&self) -> impl Iterator<Item = (usize, Padding)> {
        let padding = Padding::new(self.clearance);
        let all = self.obstacles.iter().zip(0..).map(|(obstacle, at)| (at, obstacle.padding));
        all.filter(move |(_, own)| *own != padding)
    }

    /// Model of the robot.
    #[must_use]
    pub fn model(&self) -> &RobotModel {
        self.model
    }

    /// Configuration of the robot.
    #[must_use]
    pub fn start(&self) -> &Configuration {
        &self.state.robot
    }

    /// Obstacles by entity id, in the scene's order. An entity may have several solids.
    pub fn obstacles(&self) -> impl Iterator<Item = (SmolStr, &Solid)> {
        let things = self.obstacles.iter().filter(|obstacle| !self.is_kept(obstacle));
        things.map(|obstacle| (self.name(obstacle.entity), &obstacle.solid))
    }

    /// Solids of the robot and of the held object in a configuration.
    #[must_use]
    pub fn robot_at(&self, configuration: &Configuration) -> Vec<Solid> {
        self.body.placed(&self.model.map_from_links(configuration))
    }

    /// Reason for which no query can be answered: the shape of a body is not known.
    pub(crate) fn blind_spot(&self) -> Option<String> {
        if let Some(entity) = self.unseen.first() {
            return Some(format!("the shape of `{entity}` is a mesh, which is not read"));
        }
        let link =
            self.body.uncovered_links().first().and_then(|link| self.model.tree().links().get(*link))?;
        Some(format!("the shape of the robot's link `{link}` is a mesh, which is not read"))
    }

    /// Entity with its index.
    pub(crate) fn entity(&self, id: &str) -> Option<(usize, &'w Entity)> {
        let (at, _, entity) = self.scene.entities.get_full(id)?;
        Some((at, entity))
    }

    /// Solids of an entity in the current state.
    pub(crate) fn solids_of(&self, entity: usize) -> impl Iterator<Item = &Solid> {
        self.obstacles
            .iter()
            .filter(move |obstacle| obstacle.entity == entity)
            .map(|obstacle| &obstacle.solid)
    }

    /// Id of an entity by its index.
    pub(crate) fn name(&self, entity: usize) -> SmolStr {
        if let Some((id, _)) = self.scene.entities.get_index(entity) {
            return id.clone();
        }
        let kept = entity.checked_sub(self.scene.entities.len()).and_then(|at| self.state.kept.get(at));
        kept.map(|region| region.name.clone()).unwrap_or_default()
    }

    /// Checks whether an obstacle is a region that the robot may not enter, with nothing in it.
    pub(crate) fn is_kept(&self, obstacle: &Obstacle) -> bool {
        obstacle.entity >= self.scene.entities.len()
    }

    pub(crate) fn named_contact(&self, part: usize, other: ContactTarget) -> Contact {
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

    /// Checks whether no part of the robot turns along an edge.
    pub(crate) fn is_straight(&self, from: &Configuration, to: &Configuration) -> bool {
        let ([_, _, yaw], [_, _, to_yaw]) = (from.base, to.base);
        let values = from.joints.iter().zip(&to.joints).zip(self.model.turning());
        yaw == to_yaw && values.into_iter().all(|((one, other), turns)| one == other || !turns)
    }

    /// Variable of the arm's lift and its highest value; `None` for an arm without one.
    pub(crate) fn lift(&self) -> Option<(usize, f64)> {
        let IkSolver::Lift(arm) = &self.model.hand()?.solver else {
            return None;
        };
        let chain = arm.chain();
        let (lower, upper) = chain.dofs.first()?.limits?;
        Some((*chain.in_tree.first()?, if arm.up > 0.0 { upper } else { lower }))
    }

    /// Current configuration with the base elsewhere, the hand open and the arm's joints at `values`.
    pub(crate) fn with(&self, hand: &HandModel, base: [f64; 3], values: &[f64]) -> Configuration {
        let now = &self.state.robot.joints;
        // Fingers around a held object stay closed.
        let mut joints = if self.state.held.is_some() { now.clone() } else { hand.opened(now) };
        for (at, value) in hand.solver.chain().in_tree.iter().zip(values) {
            if let Some(slot) = joints.get_mut(*at) {
                *slot = *value;
            }
        }
        Configuration { base, joints }
    }

    /// Pose of the base's link with the base at a pose on the floor.
    pub(crate) fn map_from_base(&self, [x, y, yaw]: [f64; 3]) -> Isometry3<f64> {
        let height = self.model.card().model.as_ref().map_or(0.0, |model| model.height_m);
        planar(x, y, yaw) * Translation3::new(0.0, 0.0, height)
    }

    /// Checks whether the base drives in every direction.
    pub(crate) fn slides(&self) -> bool {
        self.model.drives() && self.model.card().base.drive != Drive::Differential
    }

    /// Likely heading of the base with the tip at a pose: the one of the fingers or, where they point down,
    /// the direction from the robot.
    pub(crate) fn heading(&self, hand: &HandModel, map_from_tip: &Isometry3<f64>) -> f64 {
        let points = map_from_tip.rotation * Vector3::from(hand.card.points);
        if points.x * points.x + points.y * points.y > 0.1 {
            return libm::atan2(points.y, points.x);
        }
        let ([x, y, _], at) = (self.state.robot.base, map_from_tip.translation);
        libm::atan2(at.y - y, at.x - x)
    }

    /// Distance function in the plane to an entity centred at a point. An object or place counts by its
    /// centre; furniture, containers and people by their outline.
    pub(crate) fn far_from(
        &self,
        index: usize,
        entity: &Entity,
        [x, y]: [f64; 2],
    ) -> impl Fn(f64, f64) -> f64 + use<> {
        let is_point = matches!(entity.kind.as_str(), kinds::OBJECT | kinds::PLACE | kinds::ZONE);
        let outline: Vec<Solid> = if is_point { vec![] } else { self.solids_of(index).copied().collect() };
        move |at_x, at_y| {
            let solids = outline.iter().map(|solid| beside(solid, at_x, at_y));
            solids.reduce(f64::min).unwrap_or_else(|| libm::hypot(at_x - x, at_y - y))
        }
    }

    /// Greatest distance in m from which the base serves an entity.
    pub(crate) fn served_within(&self, entity: &Entity) -> f64 {
        match (entity.kind.as_str(), self.model.hand()) {
            (kinds::PLACE | kinds::ZONE, _) | (_, None) => AT_PLACE,
            (kinds::PERSON, Some(hand)) => person_gap(self.model.card().base.radius_m, hand.card.reach_m),
            (_, Some(hand)) => hand.card.reach_m,
        }
    }

    /// Held object, where its id is `id`.
    pub(crate) fn held_object(&self, id: &str) -> Option<HeldObject<'_>> {
        let (held, tip_from_object) = self.state.held.as_ref().filter(|(held, _)| held == id)?;
        let (hand, (_, entity)) = (self.model.hand()?, self.entity(held)?);
        let shape = solid_shape(entity)?;
        let width = hand.width(shape, tip_from_object);
        Some(HeldObject { id: held.clone(), tip_from_object: *tip_from_object, hand, shape, width })
    }

    /// Id of the held object and its solid in the map frame, with the links at `poses`. `None` if nothing
    /// with a shape is held.
    pub(crate) fn held_solid(&self, poses: &[Isometry3<f64>]) -> Option<(&SmolStr, Solid)> {
        let ((id, _), part) = self.state.held.as_ref().zip(self.body.parts().get(self.held?))?;
        Some((id, part.solid.moved(poses.get(part.link)?)))
    }

    /// Supporting entity of another one: the first within the padding of it.
    pub(crate) fn support(&self, entity: usize) -> Option<usize> {
        let own: Vec<&Solid> = self.solids_of(entity).collect();
        let gap = MIN_CLEARANCE + 0.001;
        let is_near = |obstacle: &Obstacle| own.iter().any(|own| !own.is_farther(&obstacle.solid, gap));
        let all =
            own.iter().flat_map(|own| self.obstacles.near([own.centre.x, own.centre.y], own.reach() + gap));
        let is_other = |at: &Obstacle| at.entity != entity && !self.is_kept(at);
        let others = all.filter(|(_, obstacle)| is_other(obstacle) && is_near(obstacle));
        others.min_by_key(|(index, _)| *index).map(|(_, obstacle)| obstacle.entity)
    }
}

impl AllowedCollisions {
    /// Contacts of the hand that is about to grasp an entity or just released it.
    pub(crate) fn of_grasp(scene: &PlanningScene<'_>, entity: usize) -> Self {
        Self { hand: Some(entity), near: scene.support(entity), ..Self::default() }
    }
}

/// Solids of an entity; none where it has no shape or no known pose, is held, or is a zone.
///
/// A closed container is as solid as its shape. An open drawer is a box without a lid, moved by its travel;
/// a container with an open door is a box without one face, and the door turned outwards.
pub(crate) fn solids(entity: &Entity, state: &SceneState) -> Vec<Solid> {
    let (Some(pose), Some(shape)) = (state.pose(entity), solid_shape(entity)) else { return vec![] };
    if state.holds(&entity.id) || entity.kind == kinds::ZONE {
        return vec![];
    }
    let opening = state.is_open(entity).then(|| Articulation::new(entity, state)).flatten();
    opening.map_or_else(|| vec![Solid::new(&pose, shape)], |opening| opening.solids(1.0))
}

/// Horizontal distance from a point to a solid, whatever its height.
fn beside(solid: &Solid, x: f64, y: f64) -> f64 {
    let up = solid.extent(&Vector3::z());
    let vertical = Solid {
        centre: Vector3::new(x, y, solid.centre.z),
        axes: [Vector3::x(), Vector3::y(), Vector3::z()],
        shape: Shape::Capsule { radius: 0.0, half: up },
    };
    solid.distance(&vertical).max(0.0)
}

/// Height above the surface at which an object is released, in m.
pub(crate) const ABOVE: f64 = 0.004;

/// Flat rectangle or disc that supports objects.
pub(crate) struct SupportSurface {
    /// Pose of the middle of its upper face.
    pub(crate) map_from_face: Isometry3<f64>,
    pub(crate) half: [f64; 2],
    /// Height of the walls around it, in m: objects come in from above them.
    pub(crate) walls: f64,
    pub(crate) is_disc: bool,
}

impl SupportSurface {
    /// Point of the rim at a share of its length, in units of half the sides.
    pub(crate) fn rim(&self, around: f64) -> [f64; 2] {
        if self.is_disc {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * around);
            return [cos, sin];
        }
        // Equal spacing on long and short sides.
        let [wide, deep] = self.half;
        // The rim is a single point.
        if wide + deep <= 0.0 {
            return [0.0; 2];
        }
        let gone = around * 2.0 * (wide + deep);
        if gone < wide {
            [2.0 * gone / wide - 1.0, -1.0]
        } else if gone < wide + deep {
            [1.0, 2.0 * (gone - wide) / deep - 1.0]
        } else if gone < 2.0 * wide + deep {
            [1.0 - 2.0 * (gone - wide - deep) / wide, 1.0]
        } else {
            [-1.0, 1.0 - 2.0 * (gone - 2.0 * wide - deep) / deep]
        }
    }
}
