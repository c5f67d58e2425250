//! A drawer or a door between closed and open: what of a container moves, what stays, along which way, and where the hand
//! takes hold of it.
//!
//! A drawer is a box without a lid that comes out as a whole. What has a door is a box without the face that the door
//! closes, and the door, which turns about the hinge.

use motet_robots::scene::{Entity, Travel};
use nalgebra::{Isometry3, Point3, Translation3, Unit, Vector3};

use crate::collision::{Shape, Solid};
use crate::planning::scene::obstacle::solid_shape;
use crate::planning::scene::scene_state::SceneState;
use crate::trigonometry::turn;

/// How thick the walls of an open container are taken to be, in m.
pub(crate) const WALL: f64 = 0.01;
/// How far the middle of a handle stands out from the face that it is on, in m: room for fingers behind it.
const STANDS_OUT: f64 = 0.04;
/// How far a door's handle is from the edge away from the hinge, in m.
const INSET: f64 = 0.05;
/// The thickness of a handle, in m.
pub(crate) const THICK: f64 = 0.016;

/// How a container opens, in the map. `part` is 0 where it is closed and 1 where it is open.
#[derive(Clone, PartialEq, Debug)]
pub struct Articulation {
    still: Vec<Solid>,
    /// Where they are when it is closed.
    moving: Vec<Solid>,
    way: ArticulationJoint,
    /// Where it is when it is closed.
    handle: Handle,
    /// The closed container.
    whole: Solid,
}

/// A bar to take hold of. A scene does not say where handles are, so it is where most are: across the middle of a
/// drawer's front, along the free edge of a door.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Handle {
    pub(crate) centre: Point3<f64>,
    /// Its direction; of length 1.
    pub(crate) along: Vector3<f64>,
    /// Away from the face that it is on; of length 1.
    pub(crate) out: Vector3<f64>,
    /// Half of the length over which it can be taken, in m.
    pub(crate) half: f64,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum ArticulationJoint {
    Slide(Vector3<f64>),
    Hinge { axis: Unit<Vector3<f64>>, at: Vector3<f64>, angle: f64 },
}

impl Articulation {
    /// How an entity opens where it stands. `None` where it has no travel or no known place, is no box, or has no face whose
    /// door turns about its hinge.
    #[must_use]
    pub fn new(entity: &Entity, state: &SceneState) -> Option<Self> {
        let (pose, shape) = (state.pose(entity)?, solid_shape(entity)?);
        let (Shape::Box(half), Some(travel)) = (shape, entity.travel) else { return None };
        let whole = Solid::new(&pose, shape);
        match travel {
            Travel::Slide { axis, distance } => {
                let axis = Vector3::from(axis) * distance;
                // Without its upper face, wherever the entity's axes have that.
                let up = face_towards(&(pose.rotation.inverse() * Vector3::z()));
                let out = face_towards(&axis);
                let across = out.cross(&up);
                let along = if across.norm() > 0.5 { across } else { across_of(&out) };
                let front = out.component_mul(&half) + out * STANDS_OUT;
                let handle = Handle::new(&pose, &front, &along, &out, half.dot(&along.abs()) / 2.0);
                let moving = walls(&pose, &half, &up);
                Some(Self {
                    still: vec![],
                    moving,
                    way: ArticulationJoint::Slide(pose.rotation * axis),
                    handle,
                    whole,
                })
            }
            Travel::Hinge { axis, at, angle } => {
                let (axis, at) = (Unit::try_new(Vector3::from(axis), 1e-9)?, Vector3::from(at));
                let out = door(&half, &axis, &at, angle)?;
                let along = face_towards(&axis);
                // From the hinge across the door.
                let across =
                    face_towards(&(out.component_mul(&half) - at).component_mul(&across_mask(&out, &along)));
                let wide = half.dot(&across.abs());
                let edge = across * (wide - INSET.min(wide));
                let front = out.component_mul(&half) + out * STANDS_OUT + edge;
                let handle = Handle::new(&pose, &front, &along, &out, half.dot(&along.abs()) / 2.0);
                let way = ArticulationJoint::Hinge {
                    axis: Unit::new_unchecked(pose.rotation * axis.into_inner()),
                    at: (pose * Point3::from(at)).coords,
                    angle,
                };
                let moving = vec![wall(&half, &out).moved(&pose)];
                Some(Self { still: walls(&pose, &half, &out), moving, way, handle, whole })
            }
        }
    }

    /// The same with more that goes along, where it is when it is closed.
    #[must_use]
    pub(crate) fn with(mut self, more: Vec<Solid>) -> Self {
        self.moving.extend(more);
        self
    }

    /// What stays where it is.
    #[must_use]
    pub fn still(&self) -> &[Solid] {
        &self.still
    }

    /// What moves, where it then is.
    #[must_use]
    pub fn moving(&self, part: f64) -> Vec<Solid> {
        let moved = self.map_moved(part);
        self.moving.iter().map(|solid| solid.moved(&moved)).collect()
    }

    /// All of it.
    #[must_use]
    pub fn solids(&self, part: f64) -> Vec<Solid> {
        self.still.iter().copied().chain(self.moving(part)).collect()
    }

    /// How what moves has moved in the map since it was closed.
    #[must_use]
    pub fn map_moved(&self, part: f64) -> Isometry3<f64> {
        match &self.way {
            ArticulationJoint::Slide(way) => Translation3::from(way * part).into(),
            ArticulationJoint::Hinge { axis, at, angle } => {
                let turned = Isometry3::from_parts(Translation3::identity(), turn(axis, angle * part));
                Translation3::from(*at) * turned * Translation3::from(-at)
            }
        }
    }

    /// How far any point of a solid that moves along goes for a `part`, at most, in m. The solid is where it is at any part.
    pub(crate) fn goes(&self, solid: &Solid, part: f64) -> f64 {
        match &self.way {
            ArticulationJoint::Slide(way) => way.norm() * part,
            ArticulationJoint::Hinge { axis, at, angle } => {
                let arm = (solid.centre - at).cross(axis).norm() + solid.reach();
                (angle * part).abs() * arm
            }
        }
    }

    /// The hinge's axis and how far the door turns about it, in rad; `None` of a drawer.
    pub(crate) fn hinge(&self) -> Option<(Unit<Vector3<f64>>, f64)> {
        match &self.way {
            ArticulationJoint::Slide(_) => None,
            ArticulationJoint::Hinge { axis, angle, .. } => Some((*axis, *angle)),
        }
    }

    /// How far the handle goes, in m.
    pub(crate) fn length(&self) -> f64 {
        match &self.way {
            ArticulationJoint::Slide(way) => way.norm(),
            ArticulationJoint::Hinge { axis, at, angle } => {
                (self.handle.centre.coords - at).cross(axis).norm() * angle.abs()
            }
        }
    }

    /// The handle when it is closed.
    pub(crate) fn handle(&self) -> &Handle {
        &self.handle
    }

    /// Whether a point lies in it when it is open by a part; what lies in a drawer goes with it.
    pub(crate) fn carries(&self, point: &Vector3<f64>, part: f64) -> bool {
        let ArticulationJoint::Slide(way) = &self.way else { return false };
        let Shape::Box(half) = self.whole.shape else { return false };
        let from_middle = point - way * part - self.whole.centre;
        self.whole.axes.iter().zip(half.iter()).all(|(axis, half)| axis.dot(&from_middle).abs() <= *half)
    }
}

impl Handle {
    fn new(
        pose: &Isometry3<f64>,
        centre: &Vector3<f64>,
        along: &Vector3<f64>,
        out: &Vector3<f64>,
        half: f64,
    ) -> Self {
        Self {
            centre: pose * Point3::from(*centre),
            along: pose.rotation * along,
            out: pose.rotation * out,
            half,
        }
    }
}

/// The direction of the box's face that looks most along a direction.
fn face_towards(direction: &Vector3<f64>) -> Vector3<f64> {
    let axis = direction.iamax();
    Vector3::from_fn(|row, _| if row == axis { direction.get(row).map_or(0.0, |v| v.signum()) } else { 0.0 })
}

/// Some axis of a box that is square to another.
fn across_of(axis: &Vector3<f64>) -> Vector3<f64> {
    if axis.x == 0.0 { Vector3::x() } else { Vector3::y() }
}

/// 1 along the axis that is square to both, else 0.
fn across_mask(one: &Vector3<f64>, other: &Vector3<f64>) -> Vector3<f64> {
    Vector3::repeat(1.0) - one.abs() - other.abs()
}

/// Five walls of a box, in the frame of its pose, without the face in a direction.
fn walls(pose: &Isometry3<f64>, half: &Vector3<f64>, missing: &Vector3<f64>) -> Vec<Solid> {
    faces().filter(|face| face != missing).map(|face| wall(half, &face).moved(pose)).collect()
}

fn faces() -> impl Iterator<Item = Vector3<f64>> {
    [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().flat_map(|axis| [axis, -axis])
}

/// A face of a box as a slab within it.
fn wall(half: &Vector3<f64>, face: &Vector3<f64>) -> Solid {
    let thin = half.zip_map(face, |half, part| if part == 0.0 { half } else { (WALL / 2.0).min(half) });
    let centre = face.component_mul(&(half - thin));
    Solid::new(&Translation3::from(centre).into(), Shape::Box(thin))
}

/// The face that the door closes: of the faces next to the hinge that whose door comes to lie farthest outside of the box.
fn door(
    half: &Vector3<f64>,
    axis: &Unit<Vector3<f64>>,
    at: &Vector3<f64>,
    angle: f64,
) -> Option<Vector3<f64>> {
    let swing = Translation3::from(*at)
        * Isometry3::from_parts(Translation3::identity(), turn(axis, angle))
        * Translation3::from(-at);
    let outside = |face: &Vector3<f64>| {
        let solid = wall(half, face).moved(&swing);
        let beyond = solid.centre.iter().zip(half.iter()).map(|(at, half)| at.abs() - half);
        beyond.fold(f64::NEG_INFINITY, f64::max)
    };
    let along_hinge = |face: &Vector3<f64>| face.dot(axis).abs() > 0.5;
    let next_to_hinge = |face: &Vector3<f64>| (face.dot(at) - face.abs().dot(half)).abs() < 0.02;
    let doors = faces().filter(|face| !along_hinge(face) && next_to_hinge(face));
    let doors = doors.map(|face| (face, outside(&face)));
    let best = doors.reduce(|best, next| if next.1 > best.1 + 1e-9 { next } else { best });
    best.map(|(face, _)| face)
}
