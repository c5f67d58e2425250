//! Configuration of the whole robot: the pose of its base and the positions of its joints.

use nalgebra::Vector3;

/// Configuration: a base pose and all joint values.
///
/// Between two configurations the robot moves straight in base and joints.
#[derive(Clone, PartialEq, Debug)]
pub struct Configuration {
    /// Pose of the base in the map: x and y in m, yaw in rad. Along a path yaw continues beyond half a turn.
    pub base: [f64; 3],
    /// Value of each variable of the robot's tree, in rad or m.
    pub joints: Vec<f64>,
}

impl Configuration {
    /// Configuration on the straight edge to another one, at `part` of it in 0..=1.
    ///
    /// ```
    /// use motet_geometry::planning::Configuration;
    ///
    /// let start = Configuration { base: [0.0, 0.0, 0.0], joints: vec![0.25] };
    /// let end = Configuration { base: [2.0, 1.0, 0.0], joints: vec![0.75] };
    /// assert_eq!(start.towards(&end, 0.5), Configuration { base: [1.0, 0.5, 0.0], joints: vec![0.5] });
    /// ```
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

    /// Becomes the configuration at `part` of the edge between two others, without an allocation.
    pub(crate) fn set_towards(&mut self, from: &Self, to: &Self, part: f64) {
        let mix = |one, other| between(one, other, part);
        let values = self.joints.iter_mut().zip(from.joints.iter().zip(&to.joints));
        values.for_each(|(slot, (one, other))| *slot = mix(*one, *other));
        let values = self.base.iter_mut().zip(from.base.iter().zip(&to.base));
        values.for_each(|(slot, (one, other))| *slot = mix(*one, *other));
    }

    /// Same joints with the base at another pose.
    #[must_use]
    pub fn at(&self, base: [f64; 3]) -> Self {
        Self { base, joints: self.joints.clone() }
    }

    /// Same configuration with the base turned by `further` rad.
    #[must_use]
    pub(crate) fn turned(&self, further: f64) -> Self {
        let [x, y, yaw] = self.base;
        self.at([x, y, yaw + further])
    }

    /// Unit direction in the plane from the base to a point.
    #[must_use]
    pub(crate) fn inwards(&self, place: &Vector3<f64>) -> [f64; 2] {
        let [x, y, _] = self.base;
        let (dx, dy) = (place.x - x, place.y - y);
        let far = libm::hypot(dx, dy).max(1e-9);
        [dx / far, dy / far]
    }

    /// Same configuration with the yaw, modulo full turns, that is nearest to the one of `before`.
    #[must_use]
    pub fn after(mut self, before: &Self) -> Self {
        let [_, _, from] = before.base;
        let [_, _, yaw] = &mut self.base;
        *yaw = from + crate::trigonometry::wrapped(*yaw - from);
        self
    }
}

/// Linear interpolation; rounding does not leave the interval.
fn between(one: f64, other: f64, part: f64) -> f64 {
    (one + (other - one) * part).max(one.min(other)).min(one.max(other))
}

/// Position of the base on the floor, in m in the map.
pub(crate) fn plane(configuration: &Configuration) -> [f64; 2] {
    let [x, y, _] = configuration.base;
    [x, y]
}
