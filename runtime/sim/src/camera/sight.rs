//! Sight: the share of a thing that the camera sees past everything that stands before it, by rays to a grid
//! of points over the thing.

use super::lens::{CameraLens, dot, minus};
use super::scenery::parts;
use super::solid::Solid;
use crate::body::turned;
use crate::world::{ArmPose, Rest, Role, SimWorld, Thing, ViewDirection};
use smol_str::SmolStr;

/// Rays from the middle to each side of the grid over a thing.
const RAYS: i32 = 4;

impl SimWorld {
    /// Position of the camera in the frame `map`, in m.
    pub(crate) fn eye_in_map(&self) -> [f64; 3] {
        let (base, [x, y, z]) = (self.base, self.eye.eye);
        let (sin, cos) = base.heading.sin_cos();
        [base.x + cos * x - sin * y, base.y + sin * x + cos * y, z]
    }

    /// Turn to the left of the base and elevation in rad that the camera has where a look turns it to a
    /// point, as far as it tilts.
    pub(crate) fn aim(&self, look: ViewDirection, point: [f64; 3]) -> [f64; 2] {
        let ([dx, dy, dz], [least, greatest]) = (minus(point, self.eye_in_map()), self.eye.tilt);
        let [home, start] = self.eye.rests;
        if look == ViewDirection::Still {
            return self.gaze.unwrap_or([0.0, if self.arm == ArmPose::Ready { start } else { home }]);
        }
        let far = dx.hypot(dy);
        let aside = if far > 1e-9 { turned(dy.atan2(dx) - self.base.heading) } else { 0.0 };
        [aside, dz.atan2(far).clamp(least, greatest)]
    }

    /// Lens of the camera, turned to a point in the frame `map` as far as a look turns it.
    pub(crate) fn lens(&self, look: ViewDirection, point: [f64; 3]) -> CameraLens {
        let [pan, up] = self.aim(look, point);
        CameraLens::new(self.eye_in_map(), self.base.heading + pan, -up)
    }

    /// True if a point in the frame `map` is in the picture of a look, hidden or not. The view of the card is
    /// about the base: what turns a camera at the wrist moves it, too.
    pub(crate) fn frames(&self, look: ViewDirection, point: [f64; 3]) -> bool {
        let aside = self.base.bearing_of(point[0], point[1]).abs();
        let view = self.cameras.iter().map(|camera| camera.view_rad).fold(0.0, f64::max);
        (look == ViewDirection::Around || aside <= view / 2.0)
            && self.lens(look, point).frames(minus(point, self.eye_in_map()))
    }

    /// Share from 0 to 1 of a thing that is in view and not hidden: of one of this world, or of one that is
    /// believed to be in it. O(things).
    pub(crate) fn seen_share(&self, id: &str, thing: &Thing, look: ViewDirection) -> f64 {
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
        let eye = self.eye_in_map();
        let frames = |[x, y, z]: [f64; 3]| self.frames(look, [eye[0] + x, eye[1] + y, eye[2] + z]);
        share(eye, &parts(thing), &others, &frames)
    }
}

/// Share of the rays to a thing that are in a picture and meet nothing before it; 1 where no ray meets it,
/// because the eye is in it.
fn share(eye: [f64; 3], own: &[Solid], others: &[Solid], frames: &dyn Fn([f64; 3]) -> bool) -> f64 {
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
                seen += u32::from(frames(ray) && first(&mut near.iter().copied()) >= own - 1e-6);
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
