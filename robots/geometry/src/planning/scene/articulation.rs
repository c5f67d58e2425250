//! Articulation of a container: its drawer or door between closed and open.
//!
//! A drawer is a box without a lid that slides out as a whole. A container with a door is a box without the
//! face that the door closes; the door turns about the hinge. Motion of the hand along the handle is in
//! `motions`.

use motet_robots::scene::{Entity, Travel};
use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use super::scene_state::{SceneState, solid_shape};
use crate::collision::{Shape, Solid};
use crate::trigonometry::turn;

/// Assumed wall thickness of an open container, in m.
pub(crate) const WALL: f64 = 0.01;
/// Distance from the face to the middle of its handle, in m: room for fingers behind it.
pub(crate) const STANDS_OUT: f64 = 0.04;
/// Distance of a door's handle from the edge away from the hinge, in m.
const INSET: f64 = 0.05;
/// Thickness of a handle, in m.
pub(crate) const THICK: f64 = 0.016;

/// Articulation of a container, in the map. `part` is 0 where it is closed and 1 where it is open.
#[derive(Clone, PartialEq, Debug)]
pub struct Articulation {
    still: Vec<Solid>,
    /// Moving solids in the closed pose.
    moving: Vec<Solid>,
    way: ArticulationJoint,
    /// Handle in the closed pose.
    handle: Handle,
    whole: Solid,
}

/// Bar that the hand grasps. A scene does not place handles, so this one is where most are: across the
/// middle of a drawer's front, or along the free edge of a door.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Handle {
    pub(crate) centre: Point3<f64>,
    pub(crate) along: Vector3<f64>,
    /// Unit normal of the face that carries it.
    pub(crate) out: Vector3<f64>,
    /// Half of its graspable length, in m.
    pub(crate) half: f64,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum ArticulationJoint {
    Slide(Vector3<f64>),
    Hinge { axis: Unit<Vector3<f64>>, at: Vector3<f64>, angle: f64 },
}

impl Articulation {
    /// Articulation of an entity in a state. `None` where the entity has no travel or no known pose, is no
    /// box, or has no face whose door turns about its hinge.
    ///
    /// ```
    /// use motet_geometry::planning::{Articulation, RobotModel, SceneState};
    /// use motet_robots::builtin::{self, RobotWithBody};
    ///
    /// let RobotWithBody { robot, urdf } = builtin::robot("hsr").unwrap();
    /// let scene = builtin::scene("kitchen").unwrap();
    /// let state = SceneState::new(&RobotModel::new(&robot, &urdf), &scene);
    ///
    /// let drawer = Articulation::new(&scene.entities["drawer_1"], &state).unwrap();
    /// assert!((drawer.map_moved(1.0).translation.vector.norm() - 0.35).abs() < 1e-9);
    /// assert!(Articulation::new(&scene.entities["mug_1"], &state).is_none());
    /// ```
    #[must_use]
    pub fn new(entity: &Entity, state: &SceneState) -> Option<Self> {
        let (pose, shape) = (state.pose(entity)?, solid_shape(entity)?);
        let (Shape::Box(half), Some(travel)) = (shape, entity.travel) else { return None };
        let whole = Solid::new(&pose, shape);
        match travel {
            Travel::Slide { axis, distance } => {
                let axis = Vector3::from(axis) * distance;
                // The upper face is missing, whichever axis of the entity points up.
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

    /// Adds solids that move along, given in the closed pose.
    #[must_use]
    pub(crate) fn with(mut self, more: Vec<Solid>) -> Self {
        self.moving.extend(more);
        self
    }

    /// Solids that stay in place.
    #[must_use]
    pub fn still(&self) -> &[Solid] {
        &self.still
    }

    /// Moving solids at `part`.
    #[must_use]
    pub fn moving(&self, part: f64) -> Vec<Solid> {
        let moved = self.map_moved(part);
        self.moving.iter().map(|solid| solid.moved(&moved)).collect()
    }

    /// All solids at `part`.
    #[must_use]
    pub fn solids(&self, part: f64) -> Vec<Solid> {
        self.still.iter().copied().chain(self.moving(part)).collect()
    }

    /// Motion of the moving solids in the map from the closed pose to `part`.
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

    /// Motion bound: the greatest distance that a point of a moving solid goes within `part` of the travel,
    /// in m.
    pub(crate) fn goes(&self, solid: &Solid, part: f64) -> f64 {
        match &self.way {
            ArticulationJoint::Slide(way) => way.norm() * part,
            ArticulationJoint::Hinge { axis, at, angle } => {
                let arm = (solid.centre - at).cross(axis).norm() + solid.reach();
                (angle * part).abs() * arm
            }
        }
    }

    /// Axis of the hinge and the angle of the open door, in rad; `None` for a drawer.
    pub(crate) fn hinge(&self) -> Option<(Unit<Vector3<f64>>, f64)> {
        match &self.way {
            ArticulationJoint::Slide(_) => None,
            ArticulationJoint::Hinge { axis, angle, .. } => Some((*axis, *angle)),
        }
    }

    /// Path length of the handle, in m.
    pub(crate) fn length(&self) -> f64 {
        match &self.way {
            ArticulationJoint::Slide(way) => way.norm(),
            ArticulationJoint::Hinge { axis, at, angle } => {
                (self.handle.centre.coords - at).cross(axis).norm() * angle.abs()
            }
        }
    }

    /// Bar of the handle at `part`.
    pub(crate) fn bar(&self, part: f64) -> Solid {
        let Handle { centre, along, half, .. } = self.handle;
        let rotation = UnitQuaternion::rotation_between(&Vector3::z(), &along)
            .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        let pose = Isometry3::from_parts(Translation3::from(centre.coords), rotation);
        Solid::new(&(self.map_moved(part) * pose), Shape::Capsule { radius: THICK / 2.0, half })
    }

    /// Handle in the closed pose.
    pub(crate) fn handle(&self) -> &Handle {
        &self.handle
    }

    /// Checks whether a point is inside of the container at `part`; the contents of a drawer move with it.
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

/// Normal of the box's face that is nearest to a direction.
fn face_towards(direction: &Vector3<f64>) -> Vector3<f64> {
    let axis = direction.iamax();
    Vector3::from_fn(|row, _| if row == axis { direction.get(row).map_or(0.0, |v| v.signum()) } else { 0.0 })
}

/// Axis of a box that is square to another one.
fn across_of(axis: &Vector3<f64>) -> Vector3<f64> {
    if axis.x == 0.0 { Vector3::x() } else { Vector3::y() }
}

/// Mask of the axis that is square to both: 1 there, else 0.
fn across_mask(one: &Vector3<f64>, other: &Vector3<f64>) -> Vector3<f64> {
    Vector3::repeat(1.0) - one.abs() - other.abs()
}

/// Five walls of a box without the face in one direction, in the frame of its pose.
pub(crate) fn walls(pose: &Isometry3<f64>, half: &Vector3<f64>, missing: &Vector3<f64>) -> Vec<Solid> {
    faces().filter(|face| face != missing).map(|face| wall(half, &face).moved(pose)).collect()
}

fn faces() -> impl Iterator<Item = Vector3<f64>> {
    [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().flat_map(|axis| [axis, -axis])
}

/// Face of a box as a slab within it.
fn wall(half: &Vector3<f64>, face: &Vector3<f64>) -> Solid {
    let thin = half.zip_map(face, |half, part| if part == 0.0 { half } else { (WALL / 2.0).min(half) });
    let centre = face.component_mul(&(half - thin));
    Solid::new(&Translation3::from(centre).into(), Shape::Box(thin))
}

/// Face that the door closes: of the faces at the hinge the one whose door swings farthest out of the box.
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
