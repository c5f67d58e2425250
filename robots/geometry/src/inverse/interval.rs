//! Interval inverse kinematics: enclosures of all solutions over a cell, for branch and bound.
//!
//! A cell is a box of free parameters of the solution family of an arm whose tip is at a pose. Its enclosure
//! gives an interval for each joint value, and a bound for the displacement of each frame from its pose in
//! the middle of the cell. It knows no obstacles. It holds for every member of the cell: if a joint is beyond
//! its limits throughout, the cell has no solution; and a solid on a frame can be checked at the middle,
//! deflated by the displacement bound: the greatest distance of a body on a frame from its place there.
//!
//! Cells exist for [`LiftArm`](super::LiftArm) (yaw of the base and shoulder), for
//! [`ParallelArm`](super::ParallelArm) on a mobile base (heading of the arm, lean of the forearm, yaw of the
//! base), and for [`SevenArm`](super::SevenArm) on a fixed base (last joint).

use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use super::screw::wrist;
use crate::collision::{Shape, Solid};
use crate::kinematics::{KinematicChain, planar};
use crate::trigonometry::acos;

/// Tolerance, in rad or m, for a value beyond a limit.
const SLACK: f64 = 1e-5;

/// Box of free parameters of a solution family, for one branch of the closed form.
#[derive(Clone, Copy, Debug)]
pub(crate) struct IkCell {
    pub(crate) branch: u8,
    pub(crate) middle: [f64; 3],
    /// Half of each side; 0 for a parameter that the family does not have.
    pub(crate) half: [f64; 3],
}

/// Set of tip poses: one pose and a bound for the displacement from it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseSet {
    pub(crate) map_from_tip: Isometry3<f64>,
    pub(crate) displacement: DisplacementBound,
    /// If true, joint limits and the reach of the arm are ignored.
    pub(crate) is_any: bool,
}

impl PoseSet {
    pub(crate) fn new(map_from_tip: Isometry3<f64>, displacement: DisplacementBound) -> Self {
        Self { map_from_tip, displacement, is_any: false }
    }

    /// The same set with joint limits and reach ignored.
    pub(crate) fn any(self) -> Self {
        Self { is_any: true, ..self }
    }
}

/// Enclosure of the solutions over a cell.
pub(crate) enum IntervalSolution {
    /// No member is within the limits.
    Empty,
    /// All members are in this enclosure.
    Enclosed(Box<CellEnclosure>),
    /// No statement is possible.
    Unknown,
}

/// Middle of a cell, with bounds for the difference of its members from it.
pub(crate) struct CellEnclosure {
    /// x, y and yaw of the base in the map frame.
    pub(crate) base: [f64; 3],
    pub(crate) base_displacement: DisplacementBound,
    /// Frame after each joint, in the map frame, with its displacement bound.
    pub(crate) frames: Vec<(Isometry3<f64>, DisplacementBound)>,
    /// Value of each degree of freedom, and the radius of its interval.
    pub(crate) values: Vec<[f64; 2]>,
    /// Missing length of the arm in the middle, in m, and the radius of its interval.
    pub(crate) short: [f64; 2],
    /// True if the frames are the forward kinematics of the values, from the base on.
    pub(crate) is_joined: bool,
}

impl IkCell {
    /// Splits a cell into halves across a parameter.
    pub(crate) fn halves(&self, across: usize) -> [Self; 2] {
        let mut halves = [*self; 2];
        for (half, sign) in halves.iter_mut().zip([-0.5, 0.5]) {
            if let (Some(middle), Some(side)) = (half.middle.get_mut(across), half.half.get_mut(across)) {
                *middle += sign * *side;
                // The halves overlap by more than rounding.
                *side = 0.5 * *side + 1e-12;
            }
        }
        halves
    }
}

/// Interval of the angles about three axes, each perpendicular to the next, that make up a rotation that is
/// uncertain by the angle `off`, for one branch: values and radii.
pub(super) fn wrist_interval(
    axes: &[Vector3<f64>; 3],
    rotation: &UnitQuaternion<f64>,
    off: f64,
    branch: u8,
) -> Option<[[f64; 2]; 3]> {
    let [one, _, three] = axes;
    let [first, middle, last] = *wrist(axes, rotation).get(usize::from(branch))?;
    // The angle between the third and the first axis changes by no more than the rotation does; so does the
    // middle angle.
    let polar = acos(one.dot(&(rotation * three)));
    let around = azimuth(polar, off);
    Some([[first, around], [middle, off], [last, around]])
}

/// Interval of the angles of a wrist whose carrier rotates in the map frame within `carrier` while the held
/// body rotates within `held`. It depends on the axes of both rotations: a hand that points straight down
/// stays so however the arm rotates about the vertical.
pub(super) fn carried_wrist_interval(
    axes: &[Vector3<f64>; 3],
    [map_from_carrier, rotation]: [&UnitQuaternion<f64>; 2],
    [carrier, held]: [&DisplacementBound; 2],
    branch: u8,
) -> Option<[[f64; 2]; 3]> {
    let [one, _, three] = axes;
    let [first, middle, last] = wrist_interval(axes, rotation, carrier.angle() + held.angle(), branch)?;
    let (u, w) = (map_from_carrier * one, map_from_carrier * (rotation * three));
    let (cos, aside) = (u.dot(&w), u.cross(&w));
    let sin = aside.norm();
    if sin < 1e-3 {
        return Some([first, middle, last]);
    }
    let aside = aside / sin;
    // Displacement of one direction along another, each displaced on its own.
    let off = |[displacement, beyond]: [&DisplacementBound; 2], from: &Vector3<f64>, to: &Vector3<f64>| {
        displacement.along(from, to)
            + beyond.along(to, from)
            + displacement.point(from, 0.0) * beyond.point(to, 0.0)
    };
    let around = |displacements: [&DisplacementBound; 2], from: &Vector3<f64>, to: &Vector3<f64>| {
        let out = (from - to * cos) / sin;
        let room = sin - off(displacements, from, &out);
        if room > 1e-6 { libm::atan(off(displacements, from, &aside) / room) + 1e-9 } else { PI }
    };
    let along = off([held, carrier], &w, &u);
    let polar = acos(cos);
    let leans = (acos(cos - along) - polar).max(polar - acos(cos + along)) + 1e-9;
    let least = |[angle, off]: [f64; 2], other: f64| [angle, off.min(other)];
    Some([
        least(first, around([held, carrier], &w, &u)),
        least(middle, leans),
        least(last, around([carrier, held], &u, &w)),
    ])
}

/// Greatest change of azimuth about an axis of a vector at the angle `polar` to the axis, under a rotation by
/// at most `off`.
pub(super) fn azimuth(polar: f64, off: f64) -> f64 {
    let room = polar.min(PI - polar) - 1e-6;
    if off >= room { PI } else { libm::asin((libm::sin(off) / libm::sin(polar)).min(1.0)) + 1e-9 }
}

/// Greatest change of a component of a vector of length `long` that rotates by at most `off` about an axis
/// perpendicular to both; `slope` is the component perpendicular to the measured direction.
pub(super) fn wave(slope: f64, long: f64, off: f64) -> f64 {
    (slope.abs() * off + 0.5 * long * off * off).min(2.0 * long)
}

/// Intervals of the degrees of freedom for intervals of joint positions; `None` if one is beyond its limits
/// throughout and limits count.
pub(super) fn dof_intervals(
    chain: &KinematicChain,
    positions: &[[f64; 2]],
    is_any: bool,
) -> Option<Vec<[f64; 2]>> {
    let joints = chain.joints.iter().zip(&chain.dofs).zip(positions);
    let values = joints.map(|((joint, dof), [position, off])| {
        let size = joint.coupling.multiplier.abs();
        let (mut value, off) = ((position - joint.coupling.offset) / joint.coupling.multiplier, off / size);
        let Some((lower, upper)) = dof.limits else { return Some([value, off]) };
        let (least, greatest) = (lower - off - SLACK, upper + off + SLACK);
        if !joint.is_prismatic {
            // The first of the values that differ by full turns and are not too small.
            let turn = TAU / size;
            value += turn * libm::ceil((least - value) / turn);
        }
        (is_any || (least <= value && value <= greatest)).then_some([value, off])
    });
    values.collect()
}

/// Frames after the joints, in the map frame, at the middle values.
pub(super) fn frames(
    chain: &KinematicChain,
    map_from_base: Isometry3<f64>,
    values: &[[f64; 2]],
) -> Vec<Isometry3<f64>> {
    let values: Vec<f64> = values.iter().map(|[value, _]| *value).collect();
    let mut pose = map_from_base;
    let placed = chain.joints.iter().map(|joint| {
        pose = pose * joint.before * joint.motion(joint.coupling.position(&values));
        pose
    });
    placed.collect()
}

/// Pose of the link of a base at a height above the floor.
pub(super) fn based([x, y, yaw]: [f64; 3], height: f64) -> Isometry3<f64> {
    let mut pose = planar(x, y, yaw);
    pose.translation.z = height;
    pose
}

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
            slides in prop::collection::vec(vector(), 0..4),
            shares in prop::collection::vec(-1.0..1.0_f64, 8),
            spins in prop::collection::vec((vector(), vector()), 0..3),
            angles in prop::collection::vec(prop::sample::select(vec![0.0, 1e-3, 0.05, 0.3, 1.0, 2.5]), 4),
            size in prop::sample::select(vec![1e-3, 0.02, 0.3]), shift in vector(),
            pivot in (vector(), vector()), point in vector(), direction in vector(),
            is_level in any::<bool>(), has_turn in any::<bool>(),
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
            let told = [displacement.along(&point, &direction),
                displacement.carried(&point).along(&Vector3::zeros(), &direction)];
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
