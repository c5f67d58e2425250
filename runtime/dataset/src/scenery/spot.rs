//! A place for a thing on or in the furniture: free, near an edge from which it can be taken, and well
//! inside the edge.

use motet_robots::scene::{Entity, EntityShape, Placement, Scene};

use super::is_bin;
use crate::random::Draw;

/// Number of attempts to find a spot.
const TRIES: usize = 24;
/// Distance in m from the middle of a thing to the edge of its surface: at least, beside half its own width,
/// and at most, where the surface is large enough.
const EDGE: [f64; 2] = [0.03, 0.1];
/// Between two things, in m: room for fingers.
const BETWEEN: f64 = 0.12;

/// Puts a thing somewhere: its pose and its relation to what it is on or in. False where no spot was free.
pub(super) fn stand(scene: &mut Scene, thing: &mut Entity, inside: f64, draw: &mut Draw) -> bool {
    let Some([wide, deep, high]) = thing.shape.as_ref().and_then(extents) else { return false };
    let is_empty_space = |entity: &&Entity| match entity.kind.as_str() {
        "Container" => !is_bin(entity) && entity.locked != Some(true),
        "Surface" => true,
        _ => false,
    };
    let (closets, tops): (Vec<&Entity>, Vec<&Entity>) =
        scene.entities.values().filter(is_empty_space).partition(|entity| entity.kind == "Container");
    (thing.on, thing.inside, thing.pose) = (None, None, None);
    for _ in 0..TRIES {
        let goes_in = !closets.is_empty() && draw.chance(inside);
        let Some(holder) = draw.pick(if goes_in { &closets } else { &tops }) else { return false };
        let (Some(pose), Some(size)) = (holder.pose, holder.shape.as_ref().and_then(extents)) else {
            continue;
        };
        let [along, across, height] = size;
        let radius = wide.max(deep) / 2.0;
        let (free_x, free_y) = (along / 2.0 - radius - EDGE[0], across / 2.0 - radius - EDGE[0]);
        if free_x < 0.0 || free_y < 0.0 || (goes_in && high > height - 0.04) {
            continue;
        }
        let (x, y) = if goes_in {
            (draw.within(-free_x, free_x) / 2.0, draw.within(-free_y, free_y) / 2.0)
        } else {
            near_edge(free_x, free_y, draw)
        };
        let z = if goes_in { high / 2.0 - height / 2.0 + 0.01 } else { height / 2.0 + high / 2.0 };
        let [_, _, yaw] = pose.rpy;
        let (sine, cosine) = libm::sincos(yaw);
        let [at_x, at_y, at_z] = pose.xyz;
        let xyz = [at_x + cosine * x - sine * y, at_y + sine * x + cosine * y, at_z + z].map(millimetres);
        let crowded = scene.entities.values().any(|other| {
            let stands = other.on.as_ref() == Some(&holder.id) || other.inside.as_ref() == Some(&holder.id);
            stands && near(other, xyz, radius)
        });
        if crowded {
            continue;
        }
        let holder = Some(holder.id.clone());
        (thing.on, thing.inside) = if goes_in { (None, holder) } else { (holder, None) };
        thing.pose = Some(Placement { xyz, rpy: [0.0; 3] });
        return true;
    }
    false
}

/// A spot near one of the four edges, in the frame of the top's middle.
fn near_edge(free_x: f64, free_y: f64, draw: &mut Draw) -> (f64, f64) {
    let inwards = draw.within(0.0, EDGE[1] - EDGE[0]);
    let side = if draw.chance(0.5) { 1.0 } else { -1.0 };
    if draw.chance(free_x / (free_x + free_y).max(f64::EPSILON)) {
        (draw.within(-free_x, free_x), side * (free_y - inwards).max(0.0))
    } else {
        (side * (free_x - inwards).max(0.0), draw.within(-free_y, free_y))
    }
}

/// Returns `true` if an entity is too close to a spot for a thing of this radius.
fn near(other: &Entity, [x, y, _]: [f64; 3], radius: f64) -> bool {
    let (Some(pose), Some([wide, deep, _])) = (other.pose, other.shape.as_ref().and_then(extents)) else {
        return false;
    };
    let [other_x, other_y, _] = pose.xyz;
    libm::hypot(other_x - x, other_y - y) < radius + wide.max(deep) / 2.0 + BETWEEN
}

fn millimetres(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

/// The extents of a shape along its own axes, in m; none of a mesh.
fn extents(shape: &EntityShape) -> Option<[f64; 3]> {
    Some(match *shape {
        EntityShape::Box(extents) => extents,
        EntityShape::Cylinder { radius, height } => [2.0 * radius, 2.0 * radius, height],
        EntityShape::Sphere { radius } => [2.0 * radius; 3],
        EntityShape::Capsule { radius, height } => [2.0 * radius, 2.0 * radius, height + 2.0 * radius],
        EntityShape::Mesh { .. } => return None,
    })
}
