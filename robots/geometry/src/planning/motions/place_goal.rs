//! Rules for a place, resolved in a scene state: which poses of a thing on its support fit them, where to
//! look for such poses, and which points certainly have none.

use motet_robots::scene::{
    Entity, Outline, PLACED_BESIDE_M, PLACED_NEAR_M, PLACED_TOLERANCE_M, PlacedOutline,
};
use motet_stdlib::lang::kinds;
use nalgebra::{Isometry3, Point3, Vector3};
use smol_str::SmolStr;

use crate::collision::{Shape, Solid};
use crate::planning::context::QueryContext;
use crate::planning::placing::{MapPose, Misfit, PlaceRules};
use crate::planning::query::{InfeasibleReason, MotionAnswer, UnknownReason, certain};
use crate::planning::scene::{ABOVE, HeldObject, SupportSurface, solid_shape};

/// Radius in m of a person without a shape.
const PERSON_RADIUS_M: f64 = 0.3;
/// Difference of height in m at which a thing still stands on a surface, or a pose means its place on it.
const LEVEL_M: f64 = 0.02;
/// Directions from the middle of a thing in which places near it are tried.
const DIRECTIONS: u32 = 24;
/// Gaps in m at which places near a thing are tried.
const GAPS: [f64; 6] = [0.03, 0.05, 0.08, 0.12, 0.18, 0.26];

/// Rules for the place of one thing on one support.
pub(crate) struct PlaceGoal {
    face: PlacedOutline,
    /// Outline of what it is to be near, and of what it is to be beside.
    near: Option<PlacedOutline>,
    beside: Option<PlacedOutline>,
    /// Least distance in m of the whole outline to the rim of the support.
    pub(crate) from_edge: f64,
    /// Pose of its middle.
    pub(crate) at: Option<MapPose>,
    /// Set where it may also lie on a side.
    pub(crate) may_lie: bool,
    /// Set where the rules exclude any place.
    pub(crate) excludes: bool,
}

impl PlaceGoal {
    /// Resolves rules.
    ///
    /// # Errors
    ///
    /// The answer where the outline of what they name is unknown, or where no place can fit them.
    pub(crate) fn new(
        context: &QueryContext<'_>,
        held: &HeldObject<'_>,
        (on, support): (&str, &SupportSurface),
        rules: &PlaceRules,
    ) -> Result<Self, MotionAnswer> {
        let axis = support.map_from_face.rotation * Vector3::x();
        let face = support.map_from_face.translation;
        let outline = if support.is_disc {
            Outline::Disc { radius: support.half[0] }
        } else {
            Outline::Rectangle { half: support.half }
        };
        let face = PlacedOutline { outline, centre: [face.x, face.y], axis: [axis.x, axis.y] };
        let named = |id: &SmolStr| outline_of(context, held, id);
        let (near, beside) = (rules.near.as_ref().map(named), rules.beside.as_ref().map(named));
        let goal = Self {
            face,
            near: near.transpose()?.map(|(outline, _)| outline),
            beside: beside.clone().transpose()?.map(|(outline, _)| outline),
            from_edge: rules.from_edge.get().max(0.0),
            at: rules.at,
            may_lie: rules.may_lie,
            excludes: rules.excludes(),
        };
        let none = |why: Misfit| Err(certain(InfeasibleReason::NoPlace(why), None));
        let on = SmolStr::new(on);
        if let (Some(id), Some(Ok((outline, bottom)))) = (&rules.beside, beside) {
            let is_level = (bottom - support.map_from_face.translation.z).abs() <= LEVEL_M;
            if !is_level || face.depth_of(outline.centre) < 0.0 {
                return none(Misfit::Elsewhere { on, beside: id.clone() });
            }
        }
        let limit = face.depth_of(face.centre) - least_half(held.shape);
        if goal.from_edge > limit.max(0.0) + PLACED_TOLERANCE_M {
            return none(Misfit::Narrow { on, needs: goal.from_edge, limit });
        }
        Ok(goal)
    }

    /// Place of a pose: that of the thing with its bottom on the support.
    ///
    /// # Errors
    ///
    /// The answer where the pose is not over the support, or at another height.
    pub(crate) fn place_at(
        &self,
        pose: &MapPose,
        shape: Shape,
        (on, support): (&str, &SupportSurface),
    ) -> Result<Isometry3<f64>, MotionAnswer> {
        let none = |why: Misfit| Err(certain(InfeasibleReason::NoPlace(why), None));
        let [x, y, z] = pose.xyz();
        let face = support.map_from_face.translation.z;
        let half = Solid::new(&Isometry3::identity(), shape).extent(&Vector3::z());
        let (needs, actual) = (z, face + half);
        let is_level = (face - LEVEL_M..=face + 2.0 * half + LEVEL_M).contains(&needs);
        if needs != 0.0 && !is_level {
            return none(Misfit::Height { on: on.into(), needs, actual });
        }
        let place = crate::kinematics::planar(x, y, pose.yaw());
        let place = nalgebra::Translation3::new(0.0, 0.0, actual + ABOVE) * place;
        let room = footprint(&Solid::new(&place, shape)).map(|outline| self.face.room_around(&outline));
        match room {
            Some(room) if room < -PLACED_TOLERANCE_M => {
                none(Misfit::Overhang { on: on.into(), beyond: -room })
            }
            Some(_) | None => Ok(place),
        }
    }

    /// Checks whether a thing that stands there fits the rules.
    pub(crate) fn fits(&self, stands: &Solid) -> bool {
        let Some(outline) = footprint(stands) else { return false };
        let is_near = self.near.is_none_or(|near| near.gap(&outline) <= PLACED_NEAR_M);
        let [least, most] = PLACED_BESIDE_M;
        let is_beside = self.beside.is_none_or(|beside| (least..=most).contains(&beside.gap(&outline)));
        let room = self.face.room_around(&outline);
        is_near && is_beside && (self.from_edge == 0.0 || room >= self.from_edge - PLACED_TOLERANCE_M)
    }

    /// Checks that no thing whose middle is within `off` m of a point of the map fits the rules. The radii in
    /// m are those of a disc that is certainly within its outline, and of one around it.
    pub(crate) fn is_excluded(&self, point: [f64; 2], off: f64, [inner, around]: [f64; 2]) -> bool {
        let gap = |to: &PlacedOutline| to.gap_to(point);
        let is_far = |to: &PlacedOutline, most: f64| gap(to) - off - around > most + PLACED_TOLERANCE_M;
        let [least, most] = PLACED_BESIDE_M;
        let is_close = |to: &PlacedOutline| gap(to) + off - inner < least - PLACED_TOLERANCE_M;
        let is_at_rim = self.face.depth_of(point) + off - inner < self.from_edge - PLACED_TOLERANCE_M;
        self.near.is_some_and(|to| is_far(&to, PLACED_NEAR_M))
            || self.beside.is_some_and(|to| is_far(&to, most) || is_close(&to))
            || (self.from_edge > 0.0 && is_at_rim)
    }

    /// Points of the map around what the thing is to be near or beside; `radius` in m is that of the thing.
    pub(crate) fn spots(&self, radius: f64) -> Vec<[f64; 2]> {
        let mut spots = Vec::new();
        for to in self.beside.iter().chain(&self.near) {
            for (gap, step) in GAPS.into_iter().flat_map(|gap| (0..DIRECTIONS).map(move |step| (gap, step))) {
                let angle = std::f64::consts::TAU * f64::from(step) / f64::from(DIRECTIONS);
                let (sin, cos) = libm::sincos(angle);
                let at = |out: f64| [to.centre[0] + out * cos, to.centre[1] + out * sin];
                // The gap grows at most as fast as the distance, so that this comes from within.
                let mut out = gap + radius;
                for _ in 0..32 {
                    out += (gap + radius - to.gap_to(at(out))).max(0.0);
                }
                spots.push(at(out));
            }
        }
        spots
    }
}

/// Half of the least edge of a shape, in m: some outline of it contains a disc of this radius, and none is
/// narrower.
fn least_half(shape: Shape) -> f64 {
    match shape {
        Shape::Box(half) => half.min(),
        Shape::Cylinder { radius, half } => radius.min(half),
        Shape::Capsule { radius, .. } => radius,
        Shape::HalfSpace => 0.0,
    }
}

/// Outline of an entity from above and the height of its bottom, in m.
fn outline_of(
    context: &QueryContext<'_>,
    held: &HeldObject<'_>,
    id: &SmolStr,
) -> Result<(PlacedOutline, f64), MotionAnswer> {
    let unknown = |why: String| Err(MotionAnswer::Unknown(UnknownReason::Because(why)));
    if *id == held.id {
        return unknown(format!("`{id}` has no place near itself"));
    }
    let Some((_, entity)) = context.entity(id) else { return unknown(format!("there is no `{id}`")) };
    if context.state.holds(id) {
        return unknown(format!("the hand holds `{id}`"));
    }
    let Some(pose) = context.state.pose(entity) else {
        return unknown(format!("the pose of `{id}` is unknown"));
    };
    let solid = shape_of(entity).map(|shape| Solid::new(&pose, shape));
    match solid.and_then(|solid| Some((footprint(&solid)?, solid))) {
        Some((outline, solid)) => Ok((outline, solid.centre.z - solid.extent(&Vector3::z()))),
        None => unknown(format!("the outline of `{id}` is unknown")),
    }
}

fn shape_of(entity: &Entity) -> Option<Shape> {
    let disc = |radius: f64| Some(Shape::Cylinder { radius, half: 0.0 });
    match (&entity.shape, entity.kind.as_str()) {
        (Some(_), _) => solid_shape(entity),
        (None, kinds::PERSON) => disc(PERSON_RADIUS_M),
        (None, kinds::PLACE) => disc(0.0),
        (None, _) => None,
    }
}

/// Outline of a solid from above; `None` where none of its axes is upright. A lying cylinder has the outline
/// of a box, and so has a lying capsule.
pub(crate) fn footprint(solid: &Solid) -> Option<PlacedOutline> {
    let is_upright = |axis: &Vector3<f64>| axis.z.abs() > 1.0 - 1e-9;
    let is_level = |axis: &Vector3<f64>| axis.z.abs() < 1e-6;
    let [x, y, z] = &solid.axes;
    let rectangle = |along: &Vector3<f64>, half: [f64; 2]| {
        let scale = 1.0 / libm::hypot(along.x, along.y);
        (Outline::Rectangle { half }, [along.x * scale, along.y * scale])
    };
    let disc = |radius: f64| (Outline::Disc { radius }, [1.0, 0.0]);
    let (outline, axis) = match solid.shape {
        Shape::Box(half) if is_upright(z) => rectangle(x, [half.x, half.y]),
        Shape::Box(half) if is_upright(x) => rectangle(y, [half.y, half.z]),
        Shape::Box(half) if is_upright(y) => rectangle(z, [half.z, half.x]),
        Shape::Capsule { radius, half } if half == 0.0 || is_upright(z) => disc(radius),
        Shape::Capsule { radius, half } if is_level(z) => rectangle(z, [half + radius, radius]),
        Shape::Cylinder { radius, .. } if is_upright(z) => disc(radius),
        Shape::Cylinder { radius, half } if is_level(z) => rectangle(z, [half, radius]),
        Shape::Box(_) | Shape::Capsule { .. } | Shape::Cylinder { .. } | Shape::HalfSpace => return None,
    };
    Some(PlacedOutline { outline, centre: [solid.centre.x, solid.centre.y], axis })
}

/// Point of a support over a point of the map, at a height in m above it.
pub(crate) fn above(support: &SupportSurface, [x, y]: [f64; 2], height: f64) -> Vector3<f64> {
    Point3::new(x, y, support.map_from_face.translation.z + height).coords
}
