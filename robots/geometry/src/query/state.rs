//! Where a robot is: the pose of its base, and the positions of its joints.

/// A state of the whole robot.
#[derive(Clone, PartialEq, Debug)]
pub struct State {
    /// x and y in m and yaw in rad of the base in the map. Along a path yaw goes on beyond a half turn.
    pub base: [f64; 3],
    /// A value for each variable of the robot's tree.
    pub joints: Vec<f64>,
}

impl State {
    /// The state on the straight way to another, at `part` of it in 0..=1.
    #[must_use]
    pub fn towards(&self, other: &Self, part: f64) -> Self {
        // Rounding does not take it beyond either.
        let mix = |one: f64, other: f64| (one + (other - one) * part).max(one.min(other)).min(one.max(other));
        let [x, y, yaw] = self.base;
        let [far_x, far_y, far_yaw] = other.base;
        Self {
            base: [mix(x, far_x), mix(y, far_y), mix(yaw, far_yaw)],
            joints: self.joints.iter().zip(&other.joints).map(|(one, other)| mix(*one, *other)).collect(),
        }
    }

    /// The same state with the base elsewhere.
    #[must_use]
    pub fn at(&self, base: [f64; 3]) -> Self {
        Self { base, joints: self.joints.clone() }
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
