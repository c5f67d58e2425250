//! Sight: the share of a thing that the camera sees past everything that stands before it, by rays to a grid
//! of points over the thing.

use super::lens::{dot, minus};
use super::scenery::parts;
use super::solid::Solid;
use crate::world::{Rest, Role, SimWorld, Thing};
use smol_str::SmolStr;

/// Rays from the middle to each side of the grid over a thing.
const RAYS: i32 = 4;

impl SimWorld {
    /// Position of the camera in the frame `map`, in m.
    pub(crate) fn eye_in_map(&self) -> [f64; 3] {
        let (base, [x, y, z]) = (self.base, self.eye);
        let (sin, cos) = base.heading.sin_cos();
        [base.x + cos * x - sin * y, base.y + sin * x + cos * y, z]
    }

    /// Share from 0 to 1 of a thing that nothing hides from the camera: of one of this world, or of one that
    /// is believed to be in it. O(things).
    pub(crate) fn unhidden_share(&self, id: &str, thing: &Thing) -> f64 {
        let holder = match &thing.rest {
            Rest::With(person) => Some(person),
            Rest::Free | Rest::On(_) | Rest::In(_) => None,
        };
        let hides = |other: &SmolStr, before: &Thing| {
            other != id
                && Some(other) != holder
                && before.role != Role::Place
                && self.holder(other).is_none()
                && self.shut_in(other).is_none()
        };
        let others = self.things.iter().filter(|(other, before)| hides(other, before));
        let others: Vec<Solid> = others.flat_map(|(_, before)| parts(before)).collect();
        share(self.eye_in_map(), &parts(thing), &others)
    }
}

/// Share of the rays to a thing that meet nothing before it; 1 where no ray meets it, because the eye is in
/// it.
fn share(eye: [f64; 3], own: &[Solid], others: &[Solid]) -> f64 {
    let Some(whole) = own.first() else { return 0.0 };
    let count = own.len() as f64;
    let centre =
        [0, 1, 2].map(|axis| own.iter().filter_map(|solid| solid.centre.get(axis)).sum::<f64>() / count);
    let away = |solid: &Solid| {
        let off = minus(solid.centre, centre);
        dot(off, off).sqrt() + solid.radius()
    };
    let radius = own.iter().map(away).fold(whole.radius(), f64::max);
    let gaze = minus(centre, eye);
    let far = dot(gaze, gaze).sqrt().max(1e-9);
    let along = gaze.map(|part| part / far);
    let near: Vec<&Solid> = others.iter().filter(|solid| is_before(solid, eye, along, far, radius)).collect();
    // Across the gaze: to the right, and up.
    let flat = along[0].hypot(along[1]);
    let right = if flat > 1e-6 { [along[1] / flat, -along[0] / flat, 0.0] } else { [1.0, 0.0, 0.0] };
    let up = [
        right[1] * along[2] - right[2] * along[1],
        right[2] * along[0] - right[0] * along[2],
        right[0] * along[1] - right[1] * along[0],
    ];
    let (mut met, mut seen) = (0_u32, 0_u32);
    for row in -RAYS..=RAYS {
        for column in -RAYS..=RAYS {
            let at = |step: i32| f64::from(step) / f64::from(RAYS) * 0.98 * radius;
            let (aside, above) = (at(column), at(row));
            let mut ray = gaze;
            for (part, (right, up)) in ray.iter_mut().zip(right.into_iter().zip(up)) {
                *part += aside * right + above * up;
            }
            let first = |solids: &mut dyn Iterator<Item = &Solid>| {
                solids.filter_map(|solid| Some(solid.hit(eye, ray)?.at)).fold(f64::INFINITY, f64::min)
            };
            let own = first(&mut own.iter());
            if own.is_finite() {
                met += 1;
                seen += u32::from(first(&mut near.iter().copied()) >= own - 1e-6);
            }
        }
    }
    if met == 0 { 1.0 } else { f64::from(seen) / f64::from(met) }
}

/// Checks if a solid may be between the eye and a ball that far away.
fn is_before(solid: &Solid, eye: [f64; 3], along: [f64; 3], far: f64, radius: f64) -> bool {
    let off = minus(solid.centre, eye);
    let depth = dot(off, along).clamp(0.0, far);
    let aside = minus(off, along.map(|part| part * depth));
    dot(aside, aside).sqrt() <= solid.radius() + radius
}
