//! Where a robot is: the pose of its base, and the positions of its joints.

use nalgebra::Vector3;

/// A state of the whole robot.
#[derive(Clone, PartialEq, Debug)]
pub struct Configuration {
    /// x and y in m and yaw in rad of the base in the map. Along a path yaw goes on beyond a half turn.
    pub base: [f64; 3],
    /// A value for each variable of the robot's tree.
    pub joints: Vec<f64>,
}

impl Configuration {
    /// The state on the straight way to another, at `part` of it in 0..=1.
    #[must_use]
    pub fn towards(&self, other: &Self, part: f64) -> Self {
        let mix = |one, other| between(one, other, part);
        let [x, y, yaw] = self.base;
        let [far_x, far_y, far_yaw] = other.base;
        Self {
            base: [mix(x, far_x), mix(y, far_y), mix(yaw, far_yaw)],
            joints: self.joints.iter().zip(&other.joints).map(|(one, other)| mix(*one, *other)).collect(),
        }
    }

    /// Becomes the state on the straight way between two others, at `part` of it in 0..=1.
    pub(crate) fn set_towards(&mut self, from: &Self, to: &Self, part: f64) {
        let mix = |one, other| between(one, other, part);
        let values = self.joints.iter_mut().zip(from.joints.iter().zip(&to.joints));
        values.for_each(|(slot, (one, other))| *slot = mix(*one, *other));
        let values = self.base.iter_mut().zip(from.base.iter().zip(&to.base));
        values.for_each(|(slot, (one, other))| *slot = mix(*one, *other));
    }

    /// The same state with the base elsewhere.
    #[must_use]
    pub fn at(&self, base: [f64; 3]) -> Self {
        Self { base, joints: self.joints.clone() }
    }

    /// The same state with the base turned further, in rad.
    #[must_use]
    pub(crate) fn turned(&self, further: f64) -> Self {
        let [x, y, yaw] = self.base;
        self.at([x, y, yaw + further])
    }

    /// The direction from the base to a place, in the plane and of length 1.
    #[must_use]
    pub(crate) fn inwards(&self, place: &Vector3<f64>) -> [f64; 2] {
        let [x, y, _] = self.base;
        let (dx, dy) = (place.x - x, place.y - y);
        let far = libm::hypot(dx, dy).max(1e-9);
        [dx / far, dy / far]
    }

    /// The same state with a yaw that differs by full turns and is nearest to that of `before`.
    #[must_use]
    pub fn after(mut self, before: &Self) -> Self {
        let [_, _, from] = before.base;
        let [_, _, yaw] = &mut self.base;
        *yaw = from + crate::trigonometry::wrapped(*yaw - from);
        self
    }
}

/// The number at `part` of the way between two; rounding does not take it beyond them.
fn between(one: f64, other: f64, part: f64) -> f64 {
    (one + (other - one) * part).max(one.min(other)).min(one.max(other))
}
