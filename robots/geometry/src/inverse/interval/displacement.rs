//! Displacement bounds: the greatest distance of a body on a frame from its place in the middle of a cell.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};

/// Greatest number of translations in a bound.
const SLIDES: usize = 6;

/// Greatest number of rotations about known axes in a bound.
const SPINS: usize = 3;

/// Bound for the displacement of a frame: translations along given vectors, a rotation about any axis through
/// a point, then rotations about given axes one after the other, and a shift before or after.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DisplacementBound {
    /// Shift in m in any direction, and in any horizontal one.
    shift: f64,
    flat: f64,
    /// Translation by at most each of these vectors, forwards or backwards.
    slides: [Vector3<f64>; SLIDES],
    count: usize,
    /// Rotation in rad about any axis through the point `about`, in the map frame.
    turn: f64,
    about: Vector3<f64>,
    spins: [RotationBound; SPINS],
    turns: usize,
}

/// Rotation by at most an angle about one unit axis through a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RotationBound {
    /// Greatest angle, in rad.
    pub(crate) angle: f64,
    pub(crate) axis: Vector3<f64>,
    pub(crate) at: Vector3<f64>,
}

impl RotationBound {
    /// Perpendicular vector from the axis to a point.
    fn out(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let off = point - self.at;
        off - self.axis * off.dot(&self.axis)
    }

    /// Greatest distance, in m, of any point within `rim` of a point that is displaced by `before` already.
    pub(crate) fn far(&self, point: &Vector3<f64>, rim: f64, before: f64) -> f64 {
        // A chord is no longer than its arc, nor than twice the radius.
        self.angle.min(2.0) * (self.out(point).norm() + rim + before)
    }

    /// Greatest distance along a unit vector, in m, for a point that is displaced by `before` already.
    pub(crate) fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>, before: f64) -> f64 {
        let out = self.out(point);
        let across = self.axis.cross(direction);
        sine(self.angle) * across.dot(&out).abs()
            + versine(self.angle) * out.dot(direction).abs()
            // A rotation moves nothing along its axis.
            + self.angle.min(2.0) * before * across.norm()
    }
}

impl DisplacementBound {
    pub(crate) fn none() -> Self {
        let (zero, axis) = (Vector3::zeros(), Vector3::z());
        let spins = [RotationBound { angle: 0.0, axis, at: zero }; SPINS];
        let slides = [zero; SLIDES];
        Self { shift: 0.0, flat: 0.0, slides, count: 0, turn: 0.0, about: zero, spins, turns: 0 }
    }

    pub(crate) fn unknown() -> Self {
        Self { shift: f64::INFINITY, ..Self::none() }
    }

    /// Adds a shift in any direction, in m.
    pub(crate) fn shifted(self, more: f64) -> Self {
        Self { shift: self.shift + more, ..self }
    }

    /// Adds a translation by at most a vector.
    pub(crate) fn slid(mut self, step: Vector3<f64>) -> Self {
        match self.slides.get_mut(self.count) {
            Some(slot) => (*slot, self.count) = (step, self.count + 1),
            None => self.shift += step.norm(),
        }
        self
    }

    /// Adds the motion of the end of a lever arm that rotates by at most an angle about a perpendicular axis.
    pub(crate) fn swung(self, axis: &Vector3<f64>, arm: &Vector3<f64>, angle: f64) -> Self {
        let across = axis.cross(arm);
        self.slid(across * sine(angle)).shifted(across.norm() * versine(angle))
    }

    /// Sets the rotation about a point.
    pub(crate) fn turned(self, about: Vector3<f64>, turn: f64) -> Self {
        Self { turn, about, ..self }
    }

    /// Adds a rotation about an axis through a point, after all others.
    pub(crate) fn spun(mut self, axis: Vector3<f64>, at: Vector3<f64>, angle: f64) -> Self {
        match self.spins.get_mut(self.turns) {
            Some(slot) => (*slot, self.turns) = (RotationBound { angle, axis, at }, self.turns + 1),
            None => self.shift = f64::INFINITY,
        }
        self
    }

    /// Restricts the bound to motions that keep the height, if no rotation is known.
    pub(crate) fn level(mut self) -> Self {
        (self.flat, self.shift) = (self.flat + self.shift, 0.0);
        self.slides.iter_mut().for_each(|slide| slide.z = 0.0);
        self
    }

    /// Bound for a body that follows a point of this frame without rotating.
    pub(crate) fn carried(&self, point: &Vector3<f64>) -> Self {
        let mut carried = Self { turn: 0.0, turns: 0, ..*self };
        let mut gone = self.straight();
        let turned = self.turn.min(2.0) * (point - self.about).norm();
        (carried.shift, gone) = (carried.shift + turned, gone + turned);
        for spin in self.spins() {
            let out = spin.out(point);
            let more = spin.angle.min(2.0) * gone;
            carried = carried.swung(&spin.axis, &out, spin.angle).shifted(more);
            gone += spin.angle.min(2.0) * out.norm() + more;
        }
        carried
    }

    /// Bound for directions: the displacement of points at the distance of 1 m from the axes.
    pub(crate) fn turning(&self) -> Self {
        let zero = Vector3::zeros();
        let mut turning = Self { shift: 0.0, flat: 0.0, count: 0, about: zero, ..*self };
        turning.spins.iter_mut().for_each(|spin| spin.at = zero);
        turning
    }

    /// Greatest angle of rotation, in rad.
    pub(crate) fn angle(&self) -> f64 {
        let spins = match self.spins() {
            // For perpendicular axes, the cosine of half the total angle is the product of the cosines of the
            // halves.
            [one, other] if one.axis.dot(&other.axis).abs() < 1e-9 => libm::hypot(one.angle, other.angle),
            spins => spins.iter().map(|spin| spin.angle).sum(),
        };
        self.turn + spins
    }

    /// Greatest displacement of a solid, in m: of the axis of a capsule, whose rim follows however it
    /// rotates, and of every point of any other shape.
    pub(crate) fn of(&self, solid: &Solid) -> f64 {
        farthest(solid, self.turns_about(), |point, rim| self.point(point, rim))
    }

    /// The only axis of rotation, if there is one.
    pub(crate) fn turns_about(&self) -> Option<Vector3<f64>> {
        match self.spins() {
            [] if self.turn == 0.0 => Some(Vector3::z()),
            [only] if self.turn == 0.0 => Some(only.axis),
            _ => None,
        }
    }

    /// Greatest displacement of any point within `rim` of a point, in m.
    pub(crate) fn point(&self, point: &Vector3<f64>, rim: f64) -> f64 {
        let mut gone = self.straight();
        // A chord is no longer than its arc, nor than twice the radius.
        if self.turn > 0.0 {
            gone += self.turn.min(2.0) * ((point - self.about).norm() + rim);
        }
        for spin in self.spins() {
            gone += spin.far(point, rim, gone);
        }
        gone
    }

    /// Greatest displacement of a point along a unit vector, in m: exact to first order, and bounded beyond.
    pub(crate) fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
        let mut gone = self.shift + self.flat * libm::hypot(direction.x, direction.y);
        gone += self.slides().iter().map(|slide| slide.dot(direction).abs()).sum::<f64>();
        let mut far = self.straight();
        if self.turn > 0.0 {
            let out = point - self.about;
            let long = out.norm();
            gone += sine(self.turn) * out.cross(direction).norm() + versine(self.turn) * long;
            far += self.turn.min(2.0) * long;
        }
        for spin in self.spins() {
            gone += spin.along(point, direction, far);
            far += spin.far(point, 0.0, far);
        }
        gone
    }

    /// Greatest sum of translations and shifts, in m.
    fn straight(&self) -> f64 {
        self.shift + self.flat + self.slides().iter().map(Vector3::norm).sum::<f64>()
    }

    fn slides(&self) -> &[Vector3<f64>] {
        self.slides.get(..self.count).unwrap_or_default()
    }

    fn spins(&self) -> &[RotationBound] {
        self.spins.get(..self.turns).unwrap_or_default()
    }
}

/// Greatest sine of any angle up to `angle`.
fn sine(angle: f64) -> f64 {
    if angle < 0.5 { angle } else { libm::sin(angle.min(std::f64::consts::FRAC_PI_2)) }
}

/// Greatest value of 1 − cos of any angle up to `angle`.
fn versine(angle: f64) -> f64 {
    if angle < 0.5 { 0.5 * angle * angle } else { 1.0 - libm::cos(angle.min(std::f64::consts::PI)) }
}

/// Maximum over a solid of a function of a point and a rim that has its maximum at ends of lines: over the
/// axis of a capsule, whose rim follows however it rotates, and over every point of any other shape. `axis`
/// is the only axis of rotation, if there is one.
pub(crate) fn farthest(
    solid: &Solid,
    axis: Option<Vector3<f64>>,
    told: impl Fn(&Vector3<f64>, f64) -> f64,
) -> f64 {
    let [x, y, z] = &solid.axes;
    let ends = |half: Vector3<f64>, rim: f64| {
        told(&(solid.centre + half), rim).max(told(&(solid.centre - half), rim))
    };
    match solid.shape {
        Shape::Capsule { half: 0.0, .. } => told(&solid.centre, 0.0),
        Shape::Capsule { half, .. } => ends(z * half, 0.0),
        Shape::Cylinder { radius, half } => {
            // A rotation about its own axis maps the cylinder to itself.
            let is_along = axis.is_some_and(|axis| z.cross(&axis).norm_squared() < 1e-18);
            ends(z * half, if is_along { 0.0 } else { radius })
        }
        Shape::Box(half) => {
            let (x, y, z) = (x * half.x, y * half.y, z * half.z);
            [x + y, x - y]
                .into_iter()
                .fold(0.0_f64, |most, side| most.max(ends(side + z, 0.0)).max(ends(side - z, 0.0)))
        }
        Shape::HalfSpace => f64::INFINITY,
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
    use proptest::prelude::*;

    use super::DisplacementBound;

    fn turned(axis: &Vector3<f64>, at: &Vector3<f64>, angle: f64) -> Isometry3<f64> {
        let about = Translation3::from(*at);
        about * UnitQuaternion::from_scaled_axis(axis * angle) * about.inverse()
    }

    fn vector() -> impl Strategy<Value = Vector3<f64>> {
        [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64].prop_map(|[x, y, z]| Vector3::new(x, y, z + 1e-6))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        /// No motion within the bound exceeds it, nor does a carried body.
        #[test]
        fn displacement_bound_is_sound(
            slides in prop::collection::vec(vector(), 0..4), shares in prop::collection::vec(-1.0..1.0_f64, 8),
            spins in prop::collection::vec((vector(), vector()), 0..3), angles in prop::collection::vec(prop::sample::select(vec![0.0, 1e-3, 0.05, 0.3, 1.0, 2.5]), 4),
            size in prop::sample::select(vec![1e-3, 0.02, 0.3]), shift in vector(), pivot in (vector(), vector()),
            point in vector(), direction in vector(), is_level in any::<bool>(), has_turn in any::<bool>(),
        ) {
            let mut displacement = DisplacementBound::none().shifted(size * shift.norm());
            let mut moves = Isometry3::from(Translation3::from(shift * (size * shares[0])));
            for (slide, share) in slides.iter().zip(&shares[1..]) {
                displacement = displacement.slid(slide * size);
                moves = Translation3::from(slide * (size * share)) * moves;
            }
            let (axis, about) = pivot;
            if has_turn && !is_level {
                displacement = displacement.turned(about, angles[0]);
                moves = turned(&axis.normalize(), &about, angles[0] * shares[4]) * moves;
            }
            if is_level {
                displacement = displacement.level();
                moves.translation.z = 0.0;
            }
            for (((axis, at), share), angle) in spins.iter().zip(&shares[5..]).zip(&angles[1..]) {
                let axis = if is_level { Vector3::z() } else { axis.normalize() };
                displacement = displacement.spun(axis, *at, *angle);
                moves = turned(&axis, at, angle * share) * moves;
            }
            let place = nalgebra::Point3::from(point);
            let gone = (moves * place).coords - point;
            let direction = direction.normalize();
            let told = [displacement.along(&point, &direction), displacement.carried(&point).along(&Vector3::zeros(), &direction)];
            for told in told {
                prop_assert!(gone.dot(&direction).abs() <= told + 1e-12, "{} > {told}", gone.dot(&direction));
            }
            prop_assert!(gone.norm() <= displacement.point(&point, 0.0) + 1e-12);
            prop_assert!(moves.rotation.angle() <= displacement.angle() + 1e-9);
            if is_level {
                prop_assert!(displacement.along(&point, &Vector3::z()) < 1e-12);
            }
        }
    }
}
