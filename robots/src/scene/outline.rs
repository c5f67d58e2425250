//! Outlines of upright things from above: how far two of them are apart, and how much room one has within
//! another. One definition for the motion queries and for simulated rooms.

use super::model::EntityShape;

/// Greatest distance in m between the outlines of a thing and of what it is placed near.
pub const PLACED_NEAR_M: f64 = 0.3;
/// Least and greatest distance in m between the outlines of a thing and of what it is placed beside.
pub const PLACED_BESIDE_M: [f64; 2] = [0.02, 0.15];
/// Tolerance in m of the distance that a placed thing keeps.
pub const PLACED_TOLERANCE_M: f64 = 1e-6;

/// Outline of an upright thing from above.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Outline {
    /// Disc about the axis.
    Disc {
        /// Radius in m.
        radius: f64,
    },
    /// Rectangle along the axes of the thing.
    Rectangle {
        /// Half of its lengths along x and y, in m.
        half: [f64; 2],
    },
}

impl Outline {
    /// Outline of a shape; `None` for a mesh, whose file is not read here.
    #[must_use]
    pub fn of(shape: &EntityShape) -> Option<Self> {
        match shape {
            EntityShape::Box([x, y, _]) => Some(Self::Rectangle { half: [x / 2.0, y / 2.0] }),
            EntityShape::Cylinder { radius, .. }
            | EntityShape::Sphere { radius }
            | EntityShape::Capsule { radius, .. } => Some(Self::Disc { radius: *radius }),
            EntityShape::Mesh { .. } => None,
        }
    }

    /// Metres from a point in the frame of the thing to its outline; 0 within.
    ///
    /// ```
    /// use motet_robots::scene::Outline;
    ///
    /// assert_eq!(Outline::Rectangle { half: [0.5, 0.25] }.gap([1.5, 0.0]), 1.0);
    /// assert_eq!(Outline::Disc { radius: 0.5 }.gap([0.1, 0.1]), 0.0);
    /// ```
    #[must_use]
    pub fn gap(self, [u, v]: [f64; 2]) -> f64 {
        match self {
            Self::Disc { radius } => (length(u, v) - radius).max(0.0),
            Self::Rectangle { half: [a, b] } => length((u.abs() - a).max(0.0), (v.abs() - b).max(0.0)),
        }
    }
}

/// Outline at a place of the floor plan.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlacedOutline {
    pub outline: Outline,
    /// Middle, in m in the map.
    pub centre: [f64; 2],
    /// Unit vector of its own x axis in the map.
    pub axis: [f64; 2],
}

impl PlacedOutline {
    /// A point of the map in the frame of the outline.
    fn local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([dx, dy], [cos, sin]) = ([x - self.centre[0], y - self.centre[1]], self.axis);
        [cos * dx + sin * dy, cos * dy - sin * dx]
    }

    /// Corners of a rectangle in the map; the middle of a disc.
    fn points(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let ([x, y], [cos, sin]) = (self.centre, self.axis);
        let (half, count) = match self.outline {
            Outline::Disc { .. } => ([0.0; 2], 1),
            Outline::Rectangle { half } => (half, 4),
        };
        let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
        signs.into_iter().take(count).map(move |[a, b]| {
            let [u, v] = [a * half[0], b * half[1]];
            [x + cos * u - sin * v, y + sin * u + cos * v]
        })
    }

    fn radius(&self) -> f64 {
        match self.outline {
            Outline::Disc { radius } => radius,
            Outline::Rectangle { .. } => 0.0,
        }
    }

    /// Radii in m of the largest disc about the middle within the outline, and of the least one around it.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        match self.outline {
            Outline::Disc { radius } => [radius, radius],
            Outline::Rectangle { half: [a, b] } => [a.min(b), length(a, b)],
        }
    }

    /// Metres from a point of the map to the outline; 0 within.
    #[must_use]
    pub fn gap_to(&self, point: [f64; 2]) -> f64 {
        self.outline.gap(self.local(point))
    }

    /// Metres between two outlines; 0 where they overlap.
    ///
    /// ```
    /// use motet_robots::scene::{Outline, PlacedOutline};
    ///
    /// let plate = |x: f64| PlacedOutline {
    ///     outline: Outline::Disc { radius: 0.1 },
    ///     centre: [x, 0.0],
    ///     axis: [1.0, 0.0],
    /// };
    /// assert!((plate(0.0).gap(&plate(0.5)) - 0.3).abs() < 1e-9);
    /// assert_eq!(plate(0.0).gap(&plate(0.1)), 0.0);
    /// ```
    #[must_use]
    pub fn gap(&self, other: &Self) -> f64 {
        let is_apart = |one: &Self, two: &Self| {
            let Outline::Rectangle { half } = one.outline else { return true };
            let corners: Vec<[f64; 2]> = two.points().map(|point| one.local(point)).collect();
            let beyond = |far: f64, along: fn(&[f64; 2]) -> f64| {
                corners.iter().all(|corner| along(corner) > far)
                    || corners.iter().all(|corner| -along(corner) > far)
            };
            beyond(half[0], |[u, _]| *u) || beyond(half[1], |[_, v]| *v)
        };
        let are_rectangles = [self, other].iter().all(|it| matches!(it.outline, Outline::Rectangle { .. }));
        if are_rectangles && !is_apart(self, other) && !is_apart(other, self) {
            return 0.0;
        }
        // Two convex outlines are nearest at a corner of one of them, or at the middle of a disc.
        let from = |one: &Self, two: &Self| {
            let gaps = two.points().map(|point| one.gap_to(point));
            gaps.fold(f64::INFINITY, f64::min) - two.radius()
        };
        match (self.outline, other.outline) {
            (_, Outline::Disc { .. }) => from(self, other).max(0.0),
            (Outline::Disc { .. }, Outline::Rectangle { .. }) => from(other, self).max(0.0),
            (Outline::Rectangle { .. }, Outline::Rectangle { .. }) => {
                from(self, other).min(from(other, self)).max(0.0)
            }
        }
    }

    /// Metres from a point of the map to the rim, for a point within; negative outside.
    #[must_use]
    pub fn depth_of(&self, point: [f64; 2]) -> f64 {
        let [u, v] = self.local(point);
        match self.outline {
            Outline::Disc { radius } => radius - length(u, v),
            Outline::Rectangle { half: [a, b] } => (a - u.abs()).min(b - v.abs()),
        }
    }

    /// Least distance in m of an outline within this one to the rim of this one; negative where it sticks
    /// out.
    #[must_use]
    pub fn room_around(&self, inner: &Self) -> f64 {
        let depths = inner.points().map(|point| self.depth_of(point));
        depths.fold(f64::INFINITY, f64::min) - inner.radius()
    }
}

/// Length of a vector; the same bits on every machine, as `hypot` is not.
fn length(u: f64, v: f64) -> f64 {
    (u * u + v * v).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(outline: Outline, x: f64, y: f64, yaw: f64) -> PlacedOutline {
        PlacedOutline { outline, centre: [x, y], axis: [yaw.cos(), yaw.sin()] }
    }

    /// Least distance of the points of two outlines, by a grid along their rims.
    fn sampled(one: &PlacedOutline, other: &PlacedOutline) -> f64 {
        let rim = |it: &PlacedOutline| -> Vec<[f64; 2]> {
            let [cos, sin] = it.axis;
            let at = |[u, v]: [f64; 2]| [it.centre[0] + cos * u - sin * v, it.centre[1] + sin * u + cos * v];
            (0..720)
                .map(|step| f64::from(step) / 720.0)
                .map(|part| match it.outline {
                    Outline::Disc { radius } => {
                        let (sin, cos) = (std::f64::consts::TAU * part).sin_cos();
                        at([radius * cos, radius * sin])
                    }
                    Outline::Rectangle { half: [a, b] } => {
                        let along = (part * 4.0).fract() * 2.0 - 1.0;
                        at(match (part * 4.0) as u32 {
                            0 => [a, along * b],
                            1 => [-a, along * b],
                            2 => [along * a, b],
                            _ => [along * a, -b],
                        })
                    }
                })
                .collect()
        };
        let others = rim(other);
        let gaps = rim(one).into_iter().flat_map(|[x, y]| {
            others.iter().map(move |[to_x, to_y]| (x - to_x).hypot(y - to_y)).collect::<Vec<_>>()
        });
        gaps.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn outline_gap_is_the_least_distance() {
        let disc = Outline::Disc { radius: 0.2 };
        let [wide, thin] = [[0.5, 0.3], [1.0, 0.02]].map(|half| Outline::Rectangle { half });
        for (one, other) in [(disc, disc), (disc, wide), (wide, thin), (thin, thin), (wide, disc)] {
            for step in 0..24 {
                let (angle, far) = (f64::from(step), 1.6 + 0.05 * f64::from(step));
                let a = placed(one, 0.1, -0.2, 0.3 * angle);
                let b = placed(other, 0.1 + far * angle.cos(), -0.2 + far * angle.sin(), angle);
                let (gap, sampled) = (a.gap(&b), sampled(&a, &b));
                assert!(gap <= sampled + 1e-9 && sampled - gap < 0.01, "{a:?} {b:?}: {gap} {sampled}");
                assert!((gap - b.gap(&a)).abs() < 1e-12);
            }
        }
        // Two that cross have no corner within each other.
        assert_eq!(placed(thin, 0.0, 0.0, 0.0).gap(&placed(thin, 0.0, 0.0, 1.5)), 0.0);
    }

    #[test]
    fn outline_has_room_within_another() {
        let table = placed(Outline::Rectangle { half: [0.5, 0.3] }, 1.0, 0.0, 0.0);
        let cup = placed(Outline::Disc { radius: 0.05 }, 1.0, 0.1, 0.0);
        assert!((table.room_around(&cup) - 0.15).abs() < 1e-12);
        let book = placed(Outline::Rectangle { half: [0.1, 0.05] }, 1.4, 0.0, std::f64::consts::FRAC_PI_2);
        assert!((table.room_around(&book) - 0.05).abs() < 1e-12);
        let round = placed(Outline::Disc { radius: 0.3 }, 1.0, 0.0, 0.0);
        assert!(round.room_around(&book) < 0.0);
    }
}
