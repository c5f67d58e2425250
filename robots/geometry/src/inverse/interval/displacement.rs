//! How far what a frame carries can be from where it is in the middle of a cell.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};

/// Directions in which a frame slides at most.
const SLIDES: usize = 6;

/// Axes about which a frame turns at most.
const SPINS: usize = 3;

/// A frame goes by no more than this: it slides, turns about a point, then about axes one after the other, and is shifted before or after.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DisplacementBound {
    /// In m, in any direction, and in any that is level.
    shift: f64,
    flat: f64,
    /// By no more than each of these forwards or backwards.
    slides: [Vector3<f64>; SLIDES],
    count: usize,
    /// In rad about any axis through a point, in the map.
    turn: f64,
    about: Vector3<f64>,
    spins: [RotationBound; SPINS],
    turns: usize,
}

/// A turn about one axis of length 1 through a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RotationBound {
    /// In rad.
    pub(crate) angle: f64,
    pub(crate) axis: Vector3<f64>,
    pub(crate) at: Vector3<f64>,
}

impl RotationBound {
    /// From the axis to a point.
    fn out(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let off = point - self.at;
        off - self.axis * off.dot(&self.axis)
    }

    /// How far a point goes at most that is within `rim` of a place, less what it was off from there before, in m.
    pub(crate) fn far(&self, point: &Vector3<f64>, rim: f64, before: f64) -> f64 {
        // A chord is no longer than its arc, nor than twice the radius.
        self.angle.min(2.0) * (self.out(point).norm() + rim + before)
    }

    /// How far along a direction of length 1, where it may have gone so far before.
    pub(crate) fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>, before: f64) -> f64 {
        let out = self.out(point);
        let across = self.axis.cross(direction);
        sine(self.angle) * across.dot(&out).abs()
            + versine(self.angle) * out.dot(direction).abs()
            // Nothing goes along the axis.
            + self.angle.min(2.0) * before * across.norm()
    }
}

impl DisplacementBound {
    /// What does not move.
    pub(crate) fn none() -> Self {
        let (zero, axis) = (Vector3::zeros(), Vector3::z());
        let spins = [RotationBound { angle: 0.0, axis, at: zero }; SPINS];
        let slides = [zero; SLIDES];
        Self { shift: 0.0, flat: 0.0, slides, count: 0, turn: 0.0, about: zero, spins, turns: 0 }
    }

    /// What is anywhere.
    pub(crate) fn unknown() -> Self {
        Self { shift: f64::INFINITY, ..Self::none() }
    }

    /// The same, and shifted by so much more.
    pub(crate) fn shifted(self, more: f64) -> Self {
        Self { shift: self.shift + more, ..self }
    }

    /// The same, and slid by no more than a step.
    pub(crate) fn slid(mut self, step: Vector3<f64>) -> Self {
        match self.slides.get_mut(self.count) {
            Some(slot) => (*slot, self.count) = (step, self.count + 1),
            None => self.shift += step.norm(),
        }
        self
    }

    /// The same, and moved as the end of an arm is that turns about an axis to which it is square, by no more than an angle.
    pub(crate) fn swung(self, axis: &Vector3<f64>, arm: &Vector3<f64>, angle: f64) -> Self {
        let across = axis.cross(arm);
        self.slid(across * sine(angle)).shifted(across.norm() * versine(angle))
    }

    /// The same, with a turn about a point.
    pub(crate) fn turned(self, about: Vector3<f64>, turn: f64) -> Self {
        Self { turn, about, ..self }
    }

    /// The same, with a turn about an axis through a point after all others.
    pub(crate) fn spun(mut self, axis: Vector3<f64>, at: Vector3<f64>, angle: f64) -> Self {
        match self.spins.get_mut(self.turns) {
            Some(slot) => (*slot, self.turns) = (RotationBound { angle, axis, at }, self.turns + 1),
            None => self.shift = f64::INFINITY,
        }
        self
    }

    /// The same of what keeps its height, where nothing is known to turn.
    pub(crate) fn level(mut self) -> Self {
        (self.flat, self.shift) = (self.flat + self.shift, 0.0);
        self.slides.iter_mut().for_each(|slide| slide.z = 0.0);
        self
    }

    /// What goes along with a point that this carries, without turning.
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

    /// How directions turn: what it does to places as far from the origin as they are long.
    pub(crate) fn turning(&self) -> Self {
        let zero = Vector3::zeros();
        let mut turning = Self { shift: 0.0, flat: 0.0, count: 0, about: zero, ..*self };
        turning.spins.iter_mut().for_each(|spin| spin.at = zero);
        turning
    }

    /// By how much it is turned at most, in rad.
    pub(crate) fn angle(&self) -> f64 {
        let spins = match self.spins() {
            // About axes square to each other: the cosine of half of both is the product of those of the halves.
            [one, other] if one.axis.dot(&other.axis).abs() < 1e-9 => libm::hypot(one.angle, other.angle),
            spins => spins.iter().map(|spin| spin.angle).sum(),
        };
        self.turn + spins
    }

    /// How far a solid goes at most, in m: the axis of a capsule, whose rim goes along however it turns, and every point of
    /// anything else.
    pub(crate) fn of(&self, solid: &Solid) -> f64 {
        farthest(solid, self.turns_about(), |point, rim| self.point(point, rim))
    }

    /// The one direction about which it turns, if there is one.
    pub(crate) fn turns_about(&self) -> Option<Vector3<f64>> {
        match self.spins() {
            [] if self.turn == 0.0 => Some(Vector3::z()),
            [only] if self.turn == 0.0 => Some(only.axis),
            _ => None,
        }
    }

    /// How far what is within `rim` of a point goes at most, in m.
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

    /// How far a point goes at most along a direction of length 1, in m: to first order by where it goes, and by how far for the rest.
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

    /// How far it slides and is shifted at most, in m.
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

/// The greatest sine of an angle that is no larger.
fn sine(angle: f64) -> f64 {
    if angle < 0.5 { angle } else { libm::sin(angle.min(std::f64::consts::FRAC_PI_2)) }
}

/// The greatest of 1 less the cosine of an angle that is no larger.
fn versine(angle: f64) -> f64 {
    if angle < 0.5 { 0.5 * angle * angle } else { 1.0 - libm::cos(angle.min(std::f64::consts::PI)) }
}

/// The most of what is told of a place and so much around it, where that is largest at the ends of a line, over the axis of a capsule, whose
/// rim goes along however it turns, and every point of anything else. What turns about one axis alone is told of.
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
            // About its own direction it turns into itself.
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

        /// What moves in one of the ways that a drift allows goes nowhere farther than it says, nor does what is carried along.
        #[test]
        fn nothing_goes_farther_than_is_told(
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
