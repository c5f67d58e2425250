//! What stands around, a second time: entities as parry3d's shapes, open drawers as five walls.

use motet_geometry::planning::{Configuration, SceneState};
use motet_robots::scene::{Entity, EntityShape, Scene, Travel};
use nalgebra::{Isometry3, Translation3, Vector3};

use crate::model::{Model, Solid};

/// Thickness of the walls of an open drawer, in m.
const WALL: f64 = 0.01;

/// A scene as solids, each with the index of its entity.
pub(crate) struct Scenery {
    pub(crate) solids: Vec<(usize, Solid)>,
    floor: Solid,
}

impl Scenery {
    /// Everything but what is held; `None` where there is a mesh or an open door.
    pub(crate) fn new(scene: &Scene, world: &SceneState) -> Option<Self> {
        let mut solids = Vec::new();
        for (at, entity) in scene.entities.values().enumerate() {
            if world.holds(&entity.id) || entity.kind == "Zone" {
                continue;
            }
            let Some((shape, pose)) = entity.shape.as_ref().zip(world.pose(entity)) else { continue };
            solids.extend(standing(entity, world, shape, pose)?.into_iter().map(|solid| (at, solid)));
        }
        Some(Self { solids, floor: Solid::floor() })
    }

    /// The first thing that the robot touches: names of a link and of what it touches. The hand may touch
    /// `exempt`.
    pub(crate) fn touch(
        &self,
        model: &Model,
        state: &Configuration,
        exempt: Option<usize>,
        gap: f64,
    ) -> Option<(usize, Touched)> {
        let poses = model.links(state);
        let still = Isometry3::identity();
        for (link, part) in model.parts.iter().filter(|(link, _)| model.counts(*link)) {
            let may_touch = model.in_hand(*link);
            for (entity, solid) in &self.solids {
                if !(may_touch && exempt == Some(*entity)) && part.touches(&poses[*link], solid, &still, gap)
                {
                    return Some((*link, Touched::Entity(*entity)));
                }
            }
            if model.is_carried(*link) && part.touches(&poses[*link], &self.floor, &still, gap) {
                return Some((*link, Touched::Floor));
            }
        }
        model.pairs.iter().find_map(|[one, other]| {
            let ((link, part), (beyond, solid)) = (&model.parts[*one], &model.parts[*other]);
            part.touches(&poses[*link], solid, &poses[*beyond], gap)
                .then_some((*link, Touched::Link(*beyond)))
        })
    }

    /// True if the hand alone, its tip at a pose and open, touches anything but `exempt`.
    pub(crate) fn hand_touches(
        &self,
        members: &[(Isometry3<f64>, &Solid)],
        map_from_tip: &Isometry3<f64>,
        exempt: usize,
        gap: f64,
    ) -> bool {
        let still = Isometry3::identity();
        members.iter().any(|(tip_from_link, part)| {
            let pose = map_from_tip * tip_from_link;
            part.touches(&pose, &self.floor, &still, gap)
                || self
                    .solids
                    .iter()
                    .any(|(entity, solid)| *entity != exempt && part.touches(&pose, solid, &still, gap))
        })
    }
}

/// Name of the touched body.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Touched {
    Entity(usize),
    Link(usize),
    Floor,
}

fn standing(
    entity: &Entity,
    world: &SceneState,
    shape: &EntityShape,
    pose: Isometry3<f64>,
) -> Option<Vec<Solid>> {
    Some(match (shape, &entity.travel) {
        (EntityShape::Box(extents), Some(Travel::Slide { axis, distance })) if world.is_open(entity) => {
            drawer(pose, *extents, *axis, *distance)
        }
        (EntityShape::Box(_), Some(Travel::Hinge { .. })) if world.is_open(entity) => return None,
        (EntityShape::Box(extents), _) => vec![Solid::cuboid(pose, *extents)],
        (EntityShape::Cylinder { radius, height }, _) => vec![Solid::cylinder(pose, *radius, *height)],
        (EntityShape::Capsule { radius, height }, _) => vec![Solid::capsule(pose, *radius, *height)],
        (EntityShape::Sphere { radius }, _) => vec![Solid::ball(pose, *radius)],
        (EntityShape::Mesh { .. }, _) => return None,
    })
}

/// An open drawer that stands upright: a bottom and four sides, drawn out.
fn drawer(pose: Isometry3<f64>, [x, y, z]: [f64; 3], axis: [f64; 3], distance: f64) -> Vec<Solid> {
    let out = pose * Translation3::from(Vector3::from(axis) * distance);
    let [thin_x, thin_y, thin_z] = [x, y, z].map(|extent| WALL.min(extent));
    let at =
        |x: f64, y: f64, z: f64, extents: [f64; 3]| Solid::cuboid(out * Translation3::new(x, y, z), extents);
    vec![
        at(0.0, 0.0, (thin_z - z) / 2.0, [x, y, thin_z]),
        at((x - thin_x) / 2.0, 0.0, 0.0, [thin_x, y, z]),
        at((thin_x - x) / 2.0, 0.0, 0.0, [thin_x, y, z]),
        at(0.0, (y - thin_y) / 2.0, 0.0, [x, thin_y, z]),
        at(0.0, (thin_y - y) / 2.0, 0.0, [x, thin_y, z]),
    ]
}
