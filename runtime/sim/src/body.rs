//! Position where a thing is and how much room it takes: an upright box or cylinder. What is tilted is taken
//! as upright.

use motet_graph::Pose;
use motet_robots::scene::{EntityShape, Outline, PlacedOutline, Placement};

/// Position where the robot stands: x and y in m in the frame `map`, heading in rad.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct BasePose {
    /// East, in m.
    pub x: f64,
    /// North, in m.
    pub y: f64,
    /// Counter-clockwise from the x axis, in rad.
    pub heading: f64,
}

impl BasePose {
    /// Metres in the plane to a point.
    #[must_use]
    pub fn distance_to(self, x: f64, y: f64) -> f64 {
        (x - self.x).hypot(y - self.y)
    }

    /// The angle by which it would have to turn to face a point, at most π to either side.
    ///
    /// ```
    /// let base = motet_sim::BasePose { x: 1.0, y: 0.0, heading: 0.0 };
    /// assert_eq!(base.distance_to(1.0, 2.0), 2.0);
    /// assert!((base.bearing_of(1.0, 2.0) - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn bearing_of(self, x: f64, y: f64) -> f64 {
        turned((y - self.y).atan2(x - self.x) - self.heading)
    }
}

/// An angle brought to the range from −π to π.
pub(crate) fn turned(angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    sin.atan2(cos)
}

/// Distance between two points in m.
pub(crate) fn distance([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> f64 {
    (a - x).hypot(b - y).hypot(c - z)
}

/// An upright thing.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct UprightBody {
    /// The reference point of its pose.
    pub(crate) xyz: [f64; 3],
    pub(crate) yaw: f64,
    pub(crate) outline: Outline,
    /// From the reference point down to the bottom and up to the top.
    below: f64,
    above: f64,
}

impl UprightBody {
    /// A thing as a scene gives it. One without a shape is a disc of 4 cm radius and 8 cm height.
    pub(crate) fn new(pose: Placement, shape: Option<&EntityShape>, stands_on_pose: bool) -> Self {
        let outline = shape.and_then(Outline::of).unwrap_or(Outline::Disc { radius: 0.04 });
        let height = match shape {
            Some(EntityShape::Box([_, _, z])) => *z,
            Some(EntityShape::Cylinder { height, .. }) => *height,
            Some(EntityShape::Sphere { radius }) => 2.0 * radius,
            Some(EntityShape::Capsule { radius, height }) => height + 2.0 * radius,
            Some(EntityShape::Mesh { .. }) | None => 0.08,
        };
        let (below, above) = if stands_on_pose { (0.0, height) } else { (height / 2.0, height / 2.0) };
        Self { xyz: pose.xyz, yaw: pose.rpy[2], outline, below, above }
    }

    pub(crate) const fn x(&self) -> f64 {
        self.xyz[0]
    }

    pub(crate) const fn y(&self) -> f64 {
        self.xyz[1]
    }

    pub(crate) const fn z(&self) -> f64 {
        self.xyz[2]
    }

    pub(crate) fn top(&self) -> f64 {
        self.z() + self.above
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.z() - self.below
    }

    pub(crate) fn middle(&self) -> [f64; 3] {
        [self.x(), self.y(), (self.bottom() + self.top()) / 2.0]
    }

    /// Puts its bottom's centre at a point.
    pub(crate) fn put(&mut self, x: f64, y: f64, bottom: f64) {
        self.xyz = [x, y, bottom + self.below];
    }

    /// The radius of the disc about its axis that holds it.
    pub(crate) fn radius(&self) -> f64 {
        match self.outline {
            Outline::Disc { radius } => radius,
            Outline::Rectangle { half: [x, y] } => x.hypot(y),
        }
    }

    /// A vector of its own frame in the frame `map`.
    pub(crate) fn turned_out(&self, vector: [f64; 3]) -> [f64; 3] {
        let (sin, cos) = self.yaw.sin_cos();
        let [x, y, z] = vector;
        [cos * x - sin * y, sin * x + cos * y, z]
    }

    fn local(&self, x: f64, y: f64) -> [f64; 2] {
        let (sin, cos) = self.yaw.sin_cos();
        let (dx, dy) = (x - self.x(), y - self.y());
        [cos * dx + sin * dy, cos * dy - sin * dx]
    }

    /// Its outline at its place.
    pub(crate) fn placed(&self) -> PlacedOutline {
        let (sin, cos) = self.yaw.sin_cos();
        PlacedOutline { outline: self.outline, centre: [self.x(), self.y()], axis: [cos, sin] }
    }

    /// Metres in the plane from a point to its outline; 0 within.
    pub(crate) fn gap(&self, x: f64, y: f64) -> f64 {
        self.outline.gap(self.local(x, y))
    }

    /// True if a disc lies within its outline.
    pub(crate) fn holds_disc(&self, x: f64, y: f64, radius: f64) -> bool {
        let [u, v] = self.local(x, y);
        match self.outline {
            Outline::Disc { radius: own } => u.hypot(v) + radius <= own,
            Outline::Rectangle { half: [a, b] } => u.abs() + radius <= a && v.abs() + radius <= b,
        }
    }

    /// Points of a grid over its outline, its centre first.
    pub(crate) fn grid(&self, step: f64) -> Vec<[f64; 2]> {
        let [a, b] = match self.outline {
            Outline::Disc { radius } => [radius; 2],
            Outline::Rectangle { half } => half,
        };
        let count = |half: f64| (half / step).floor().clamp(0.0, 100.0) as i32;
        let mut points = vec![[self.x(), self.y()]];
        for row in -count(a)..=count(a) {
            for column in -count(b)..=count(b) {
                let [dx, dy, _] = self.turned_out([f64::from(row) * step, f64::from(column) * step, 0.0]);
                points.push([self.x() + dx, self.y() + dy]);
            }
        }
        points
    }

    /// Stances about it at a distance from its outline, facing it: at the corners' arcs and about every 10 cm
    /// along its sides.
    pub(crate) fn stances(&self, clearance: f64) -> Vec<BasePose> {
        let mut stances = Vec::new();
        let mut add = |at: [f64; 2], normal: [f64; 2]| {
            let [x, y, _] =
                self.turned_out([at[0] + normal[0] * clearance, at[1] + normal[1] * clearance, 0.0]);
            let [nx, ny, _] = self.turned_out([normal[0], normal[1], 0.0]);
            stances.push(BasePose { x: self.x() + x, y: self.y() + y, heading: (-ny).atan2(-nx) });
        };
        match self.outline {
            Outline::Disc { radius } => {
                for step in 0..32 {
                    let (sin, cos) = (f64::from(step) / 32.0 * std::f64::consts::TAU).sin_cos();
                    add([cos * radius, sin * radius], [cos, sin]);
                }
            }
            Outline::Rectangle { half: [a, b] } => {
                for (half, other, along_x) in [(b, a, false), (a, b, true)] {
                    let count = (half / 0.1).ceil().clamp(1.0, 50.0) as i32;
                    for step in -count..=count {
                        let along = half * f64::from(step) / f64::from(count);
                        for side in [-1.0, 1.0] {
                            if along_x {
                                add([along, side * other], [0.0, side]);
                            } else {
                                add([side * other, along], [side, 0.0]);
                            }
                        }
                    }
                }
            }
        }
        stances
    }

    pub(crate) fn pose(&self) -> Pose {
        let (sin, cos) = (self.yaw / 2.0).sin_cos();
        Pose { xyz: self.xyz, quaternion: [0.0, 0.0, sin, cos] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> UprightBody {
        let pose = Placement { xyz: [2.0, 0.5, 0.36], rpy: [0.0, 0.0, std::f64::consts::FRAC_PI_2] };
        UprightBody::new(pose, Some(&EntityShape::Box([1.2, 0.8, 0.72])), false)
    }

    #[test]
    fn body_gaps_are_to_the_turned_outline() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} is not {b}");
        close(table().gap(0.0, 0.5), 1.6);
        close(table().gap(2.0, 2.1), 1.0);
        close(table().gap(2.1, 0.6), 0.0);
        close(table().top(), 0.72);
        close(table().bottom(), 0.0);
    }

    #[test]
    fn body_stances_face_the_thing() {
        for stance in table().stances(0.25) {
            assert!((table().gap(stance.x, stance.y) - 0.25).abs() < 1e-9);
            let ahead = (stance.x + 0.3 * stance.heading.cos(), stance.y + 0.3 * stance.heading.sin());
            assert!(table().gap(ahead.0, ahead.1) < 1e-9);
        }
    }

    #[test]
    fn body_grid_starts_in_the_middle() {
        assert_eq!(table().grid(0.1).first(), Some(&[2.0, 0.5]));
        assert!(table().grid(0.1).iter().all(|[x, y]| table().gap(*x, *y) < 1e-9));
    }
}
