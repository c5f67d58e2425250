//! Grasps of a thing, drawn at random from all directions: level to 60° down around what is round,
//! along and across the sides of a box, from above; against a jaw that does not move, where the hand has one.
//! The contract of the query defines a grasp: the near face as close to the palm as it can be, the
//! fingers beyond the widest place of a round thing or 1 cm over a flat one.

use motet_geometry::planning::RobotModel;
use motet_robots::scene::{Entity, EntityShape};
use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use rand_xoshiro::SplitMix64;

use crate::chance::Chance;

/// A pose of the hand, and the direction of the fingers.
pub(crate) struct Grasp {
    pub(crate) map_from_tip: Isometry3<f64>,
    pub(crate) approach: Vector3<f64>,
}

/// A way to close on a thing.
struct Way {
    approach: Vector3<f64>,
    along: Vector3<f64>,
    width: f64,
    /// Its extent against the approach on the line of the hand.
    half: f64,
    is_round: bool,
    shift: Vector3<f64>,
}

/// A grasp at random; `None` where the draw is none.
pub(crate) fn draw(
    machine: &RobotModel,
    entity: &Entity,
    pose: &Isometry3<f64>,
    chance: &mut SplitMix64,
) -> Option<Grasp> {
    let hand = machine.hand()?;
    let way = match *entity.shape.as_ref()? {
        EntityShape::Box(extents) => flat(pose, extents.map(|extent| extent / 2.0), chance),
        EntityShape::Cylinder { radius, height } => round(pose, radius, height / 2.0, true, chance),
        EntityShape::Capsule { radius, height } => round(pose, radius, height / 2.0, false, chance),
        EntityShape::Sphere { radius } => round(pose, radius, 0.0, false, chance),
        EntityShape::Mesh { .. } => return None,
    };
    if way.approach.z > 0.5 || way.width > hand.card.opening_m {
        return None;
    }
    let depth = (hand.palm + way.half).max(0.0);
    let most = if way.is_round {
        hand.fingers + 0.35 * way.width / 2.0
    } else {
        hand.fingers + way.half - way.half.min(0.01)
    };
    if depth > most {
        return None;
    }
    // From above anywhere between as deep and as shallow as can be.
    let depth = if way.approach.z < -0.82 { chance.between(depth, most) } else { depth };
    let (points, closes) = (Vector3::from(hand.card.points), Vector3::from(hand.card.closes));
    let own = Matrix3::from_columns(&[points, closes, points.cross(&closes)]);
    let wanted = Matrix3::from_columns(&[way.approach, way.along, way.approach.cross(&way.along)]);
    let rotation = Rotation3::from_matrix_unchecked(wanted * own.transpose());
    // What a jaw that does not move holds lies against it.
    let middle = way.along * hand.middle(way.width);
    let at = pose.translation.vector + way.shift - way.approach * depth - middle;
    let map_from_tip =
        Isometry3::from_parts(Translation3::from(at), UnitQuaternion::from_rotation_matrix(&rotation));
    Some(Grasp { map_from_tip, approach: way.approach })
}

/// Upright round things, as all in these rooms are.
fn round(
    pose: &Isometry3<f64>,
    radius: f64,
    half: f64,
    is_flat_on_top: bool,
    chance: &mut SplitMix64,
) -> Way {
    let up = if half > 0.0 { pose.rotation * Vector3::z() } else { Vector3::z() };
    let (sin, cos) = chance.between(-std::f64::consts::PI, std::f64::consts::PI).sin_cos();
    let side = pose.rotation * Vector3::x();
    let out = side * cos + up.cross(&side) * sin;
    let across = up.cross(&out) * if chance.is(0.5) { 1.0 } else { -1.0 };
    let kind = chance.unit();
    if is_flat_on_top && 2.0 * half < 0.13 && kind < 0.15 {
        let along = if chance.is(0.5) { up } else { -up };
        let shift = Vector3::zeros();
        return Way { approach: -out, along, width: 2.0 * half, half: radius, is_round: false, shift };
    }
    if kind < 0.35 {
        let extent = if half > 0.0 { half + if is_flat_on_top { 0.0 } else { radius } } else { radius };
        let is_round = half == 0.0;
        let shift = Vector3::zeros();
        return Way { approach: -up, along: across, width: 2.0 * radius, half: extent, is_round, shift };
    }
    let tilt = if chance.is(0.4) { 0.0 } else { chance.between(0.0, std::f64::consts::FRAC_PI_3) };
    let approach = -up * tilt.sin() - out * tilt.cos();
    let level = tilt.cos().max(1e-9);
    // On the line of the hand the side or the end is met first.
    let met = if half > 0.0 { (radius / level).min(half / tilt.sin().max(1e-9)) } else { radius };
    let extent = half * tilt.sin() + radius * if is_flat_on_top { level } else { 1.0 };
    let shift = if half > 0.03 { up * (half * chance.between(-0.5, 0.5)) } else { Vector3::zeros() };
    Way {
        approach,
        along: across,
        width: 2.0 * radius,
        half: radius.max(met.min(extent)),
        is_round: true,
        shift,
    }
}

fn flat(pose: &Isometry3<f64>, half: [f64; 3], chance: &mut SplitMix64) -> Way {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis);
    let along = chance.below(3);
    let approach = (along + 1 + chance.below(2)) % 3;
    let third = 3 - along - approach;
    let sign = |chance: &mut SplitMix64| if chance.is(0.5) { 1.0 } else { -1.0 };
    let shift = if half[third] > 0.04 { half[third] * chance.between(-0.5, 0.5) } else { 0.0 };
    Way {
        approach: axes[approach] * sign(chance),
        along: axes[along] * sign(chance),
        width: 2.0 * half[along],
        half: half[approach],
        is_round: false,
        shift: axes[third] * shift,
    }
}
