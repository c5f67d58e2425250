//! Distance between two solids: in closed form for two capsules, else by Gilbert, Johnson and Keerthi (1988),
//! on the point of a simplex nearest to the origin (Ericson 2005, 5.1).

use nalgebra::Vector3;

use super::solid::{Shape, Solid};

/// Greatest gap between the lower and the upper bound of a distance, in m.
const CLOSE: f64 = 1e-9;

/// Number of GJK steps after which the lower bound is taken as it is.
const STEPS: usize = 96;

impl Solid {
    /// Distance in m to another solid: never above the true one, and below it by no more than 1e-9 m unless
    /// both are nearly flat. 0 or negative if the solids overlap; the value is no penetration depth.
    ///
    /// ```
    /// use motet_geometry::collision::{Shape, Solid};
    /// use nalgebra::{Isometry3, Vector3};
    ///
    /// let ball = |x: f64| Solid::new(&Isometry3::translation(x, 0.0, 0.0), Shape::Capsule { radius: 0.1,
    /// half: 0.0 });
    /// let cube = Solid::new(&Isometry3::identity(), Shape::Box(Vector3::new(0.5, 0.5, 0.5)));
    /// assert!((cube.distance(&ball(1.0)) - 0.4).abs() < 1e-9);
    /// assert!(cube.is_farther(&ball(1.0), 0.3));
    /// ```
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        self.bounded(other, Precision { enough: f64::INFINITY, least: None }, &mut Vector3::zeros())
    }

    /// Checks whether the distance is more than `metres`. Cheaper than [`Self::distance`].
    #[must_use]
    pub fn is_farther(&self, other: &Self, metres: f64) -> bool {
        self.apart(self.reach(), other, other.reach(), [metres, metres], &mut Vector3::zeros()) > metres
    }

    /// Distance, or a lower bound as soon as one is above `enough`: from the bounding balls, whose radii the
    /// caller knows, or from the axes of a box or a cylinder.
    pub(crate) fn distance_to(&self, reach: f64, other: &Self, other_reach: f64, enough: f64) -> f64 {
        self.precision(reach, other, other_reach, Precision { enough, least: None }, &mut Vector3::zeros())
    }

    /// Lower bound that decides only whether the distance is above `enough`, and otherwise whether it is
    /// above `least`, which is no more. Cheaper than the distance. `axis` is a unit vector that separated the
    /// two solids before, or 0; it becomes one for the next call.
    pub(crate) fn apart(
        &self,
        reach: f64,
        other: &Self,
        other_reach: f64,
        [least, enough]: [f64; 2],
        axis: &mut Vector3<f64>,
    ) -> f64 {
        self.precision(reach, other, other_reach, Precision { enough, least: Some(least) }, axis)
    }

    /// Checks whether the distance is at most `metres`, up to rounding, by a point on each solid. A distance
    /// that is smaller by less than a millionth of `metres` may count as larger.
    pub(crate) fn is_nearer(&self, other: &Self, metres: f64) -> bool {
        match (&self.shape, &other.shape) {
            (Shape::HalfSpace, _)
            | (_, Shape::HalfSpace)
            | (Shape::Capsule { .. }, Shape::Capsule { .. }) => self.distance(other) <= metres,
            _ => are_nearer(self, other, metres + self.rim() + other.rim()),
        }
    }

    fn precision(
        &self,
        reach: f64,
        other: &Self,
        other_reach: f64,
        precision: Precision,
        axis: &mut Vector3<f64>,
    ) -> f64 {
        let enough = precision.enough;
        let wide = reach + other_reach + enough;
        let between = (self.centre - other.centre).norm_squared();
        if between > wide * wide {
            return between.sqrt() - reach - other_reach;
        }
        let below = match (&self.shape, &other.shape) {
            (Shape::HalfSpace, _) | (_, Shape::HalfSpace) => f64::NEG_INFINITY,
            (_, Shape::Box(half)) => other.beside_box(half, self),
            (Shape::Box(half), _) => self.beside_box(half, other),
            (_, Shape::Cylinder { radius, half }) => other.beside_cylinder(*radius, *half, self),
            (Shape::Cylinder { radius, half }, _) => self.beside_cylinder(*radius, *half, other),
            (Shape::Capsule { .. }, Shape::Capsule { .. }) => f64::NEG_INFINITY,
        };
        if below > enough { below } else { self.bounded(other, precision, axis) }
    }

    /// Lower bound that decides only whether the distance is above `enough`, over all places of this solid
    /// while it is translated by `shift`.
    pub(crate) fn swept_distance_to(
        &self,
        shift: &Vector3<f64>,
        reach: f64,
        other: &Self,
        other_reach: f64,
        enough: f64,
    ) -> f64 {
        let half_way = shift * 0.5;
        let wide = reach + half_way.norm() + other_reach + enough;
        let between = (self.centre + half_way - other.centre).norm_squared();
        if between > wide * wide {
            return between.sqrt() - (wide - enough);
        }
        if matches!(other.shape, Shape::HalfSpace) {
            let [_, _, up] = &other.axes;
            return above(other, self) + shift.dot(up).min(0.0);
        }
        if let Shape::Box(half) = &other.shape {
            let below = other.beside_swept(half, self, shift);
            if below > enough {
                return below;
            }
        }
        let rims = self.rim() + other.rim();
        let precision = Precision { enough: enough + rims, least: Some(enough + rims) };
        cores(&Swept { solid: self, shift: *shift }, other, precision, &mut Vector3::zeros()) - rims
    }

    /// Distance from this box to the smallest box along its axes that holds the other solid, less its rim.
    fn beside_box(&self, half: &Vector3<f64>, other: &Self) -> f64 {
        self.beside_swept(half, other, &Vector3::zeros())
    }

    /// Distance from this box to the box along its axes that holds all places of the other solid while it is
    /// translated.
    fn beside_swept(&self, half: &Vector3<f64>, other: &Self, shift: &Vector3<f64>) -> f64 {
        let between = other.centre + shift * 0.5 - self.centre;
        let square: f64 = self
            .axes
            .iter()
            .zip(half.iter())
            .map(|(axis, half)| {
                let wide = half + other.core_extent(axis) + 0.5 * shift.dot(axis).abs();
                let gap = (between.dot(axis).abs() - wide).max(0.0);
                gap * gap
            })
            .sum();
        square.sqrt() - other.rim()
    }

    /// Distance from this cylinder to the smallest coaxial cylinder that holds the other solid, less its rim.
    fn beside_cylinder(&self, radius: f64, half: f64, other: &Self) -> f64 {
        let [_, _, z] = &self.axes;
        let between = other.centre - self.centre;
        let up = between.dot(z);
        let out = (between.norm_squared() - up * up).max(0.0).sqrt();
        let [a, b, c] = &other.axes;
        let aside = |axis: &Vector3<f64>| {
            let part = axis.dot(z);
            (1.0 - part * part).max(0.0)
        };
        let wide = match &other.shape {
            Shape::Box(half) => {
                let [x, y, z] = half.data.0[0];
                (x * x * aside(a) + y * y * aside(b) + z * z * aside(c)).sqrt()
            }
            Shape::Cylinder { radius, half } => radius + half * aside(c).sqrt(),
            Shape::Capsule { half, .. } => half * aside(c).sqrt(),
            Shape::HalfSpace => f64::INFINITY,
        };
        let (up, out) = ((up.abs() - half - other.core_extent(z)).max(0.0), (out - radius - wide).max(0.0));
        (up * up + out * out).sqrt() - other.rim()
    }

    /// Distance, or a lower bound as soon as one is above `enough`.
    fn bounded(&self, other: &Self, precision: Precision, axis: &mut Vector3<f64>) -> f64 {
        match (&self.shape, &other.shape) {
            (Shape::HalfSpace, Shape::HalfSpace) => f64::NEG_INFINITY,
            (_, Shape::HalfSpace) => above(other, self),
            (Shape::HalfSpace, _) => above(self, other),
            (Shape::Capsule { radius, half }, Shape::Capsule { radius: far_radius, half: far_half }) => {
                segments(&ends(self, *half), &ends(other, *far_half)) - radius - far_radius
            }
            _ => {
                let rims = self.rim() + other.rim();
                let least = precision.least.map(|least| least + rims);
                cores(self, other, Precision { enough: precision.enough + rims, least }, axis) - rims
            }
        }
    }
}

/// Precision that a caller needs of a distance.
#[derive(Clone, Copy)]
struct Precision {
    /// A bound above this value suffices.
    enough: f64,
    /// If the distance is not above `enough`: the value against which it is compared; `None` for the distance
    /// itself.
    least: Option<f64>,
}

fn above(half_space: &Solid, solid: &Solid) -> f64 {
    let [_, _, up] = &half_space.axes;
    (solid.centre - half_space.centre).dot(up) - solid.extent(up)
}

fn ends(solid: &Solid, half: f64) -> [Vector3<f64>; 2] {
    let [_, _, z] = &solid.axes;
    [solid.centre - z * half, solid.centre + z * half]
}

/// Convex set with a support function.
trait Convex {
    /// An interior point.
    fn middle(&self) -> Vector3<f64>;
    /// Support point: the point farthest in a direction.
    fn farthest(&self, direction: &Vector3<f64>) -> Vector3<f64>;
}

impl Convex for Solid {
    fn middle(&self) -> Vector3<f64> {
        self.centre
    }

    fn farthest(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        self.support(direction)
    }
}

/// All places of a solid during a translation.
struct Swept<'a> {
    solid: &'a Solid,
    shift: Vector3<f64>,
}

impl Convex for Swept<'_> {
    fn middle(&self) -> Vector3<f64> {
        self.solid.centre + self.shift * 0.5
    }

    fn farthest(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        let point = self.solid.support(direction);
        if direction.dot(&self.shift) > 0.0 { point + self.shift } else { point }
    }
}

/// Lower bound of the distance between the cores of two solids. With the nearest point `v` of a simplex
/// within the Minkowski difference, no point of the difference is nearer to the origin than the plane square
/// to `v` through the support point `w`.
///
/// `nearest` is a point of the difference, so its length is never below the distance.
fn cores(one: &impl Convex, other: &Solid, precision: Precision, axis: &mut Vector3<f64>) -> f64 {
    let enough = precision.enough;
    if *axis != Vector3::zeros() {
        // The plane square to the last separating direction is enough in most cases.
        let below = axis.dot(&(one.farthest(&-*axis) - other.support(axis)));
        if below > enough {
            return below;
        }
    }
    let mut nearest = one.middle() - other.centre;
    let mut simplex = Simplex::empty();
    let mut below = 0.0_f64;
    for _ in 0..STEPS {
        let length = nearest.norm();
        if length < 1e-12 {
            return 0.0;
        }
        let support = one.farthest(&-nearest) - other.support(&nearest);
        let bound = nearest.dot(&support) / length;
        if bound > below {
            (below, *axis) = (bound, nearest / length);
        }
        let is_told =
            precision.least.is_some_and(|least| length <= least || (length <= enough && below > least));
        if below > enough || is_told || length - below <= CLOSE || simplex.contains(&support) {
            return below;
        }
        simplex.push(support);
        let Some((next, rest)) = simplex.nearest() else { return 0.0 };
        simplex = rest;
        nearest = next;
    }
    below
}

/// Checks whether two points within the cores of two solids are as near to each other as `metres`.
fn are_nearer(one: &Solid, other: &Solid, metres: f64) -> bool {
    let mut nearest = one.centre - other.centre;
    let mut simplex = Simplex::empty();
    for _ in 0..STEPS {
        let length = nearest.norm();
        if length <= metres {
            return true;
        }
        let support = one.support(&-nearest) - other.support(&nearest);
        if nearest.dot(&support) > metres * length || simplex.contains(&support) {
            return false;
        }
        simplex.push(support);
        let Some((next, rest)) = simplex.nearest() else { return true };
        simplex = rest;
        nearest = next;
    }
    false
}

/// Distance between two segments (Ericson 2005, 5.1.9).
fn segments([p1, q1]: &[Vector3<f64>; 2], [p2, q2]: &[Vector3<f64>; 2]) -> f64 {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let tiny = 1e-18;
    let (s, t) = if a <= tiny && e <= tiny {
        (0.0, 0.0)
    } else if a <= tiny {
        (0.0, (f / e).clamp(0.0, 1.0))
    } else {
        let c = d1.dot(&r);
        if e <= tiny {
            ((-c / a).clamp(0.0, 1.0), 0.0)
        } else {
            let b = d1.dot(&d2);
            let determinant = a * e - b * b;
            let s = if determinant > 1e-12 * a * e {
                ((b * f - c * e) / determinant).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let t = (b * s + f) / e;
            if t < 0.0 {
                ((-c / a).clamp(0.0, 1.0), 0.0)
            } else if t > 1.0 {
                (((b - c) / a).clamp(0.0, 1.0), 1.0)
            } else {
                (s, t)
            }
        }
    };
    (r + d1 * s - d2 * t).norm()
}

type Point = Vector3<f64>;

/// Simplex of up to four points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Simplex {
    points: [Point; 4],
    count: usize,
}

impl Simplex {
    pub(super) fn empty() -> Self {
        Self { points: [Point::zeros(); 4], count: 0 }
    }

    fn of<const N: usize>(corners: [Point; N]) -> Self {
        let mut simplex = Self::empty();
        corners.into_iter().for_each(|corner| simplex.push(corner));
        simplex
    }

    pub(super) fn push(&mut self, point: Point) {
        if let Some(slot) = self.points.get_mut(self.count) {
            *slot = point;
            self.count += 1;
        }
    }

    pub(super) fn contains(&self, point: &Point) -> bool {
        self.points.iter().take(self.count).any(|known| known == point)
    }

    /// Nearest point to the origin and the corners that span it; `None` if the origin is inside.
    pub(super) fn nearest(&self) -> Option<(Point, Self)> {
        let [a, b, c, d] = self.points;
        match self.count {
            0 => None,
            1 => Some((a, *self)),
            2 => Some(segment(a, b)),
            3 => Some(triangle(a, b, c)),
            _ => tetrahedron([a, b, c, d]),
        }
    }
}

fn segment(a: Point, b: Point) -> (Point, Simplex) {
    let along = b - a;
    let (part, whole) = (-a.dot(&along), along.norm_squared());
    if part <= 0.0 {
        (a, Simplex::of([a]))
    } else if part >= whole {
        (b, Simplex::of([b]))
    } else {
        (a + along * (part / whole), Simplex::of([a, b]))
    }
}

fn triangle(a: Point, b: Point, c: Point) -> (Point, Simplex) {
    let normal = (b - a).cross(&(c - a));
    let square = normal.norm_squared();
    // Side of each edge on which the origin projects.
    let inside = |one: &Point, other: &Point| normal.dot(&one.cross(other)) >= 0.0;
    if square > 1e-300 && inside(&a, &b) && inside(&b, &c) && inside(&c, &a) {
        return (normal * (normal.dot(&a) / square), Simplex::of([a, b, c]));
    }
    least([segment(a, b), segment(b, c), segment(c, a)])
}

fn tetrahedron([a, b, c, d]: [Point; 4]) -> Option<(Point, Simplex)> {
    let faces = [(a, b, c, d), (a, b, d, c), (a, c, d, b), (b, c, d, a)];
    let mut best: Option<(Point, Simplex)> = None;
    for (one, two, three, rest) in faces {
        let normal = (two - one).cross(&(three - one));
        let (apex, origin) = (normal.dot(&(rest - one)), -normal.dot(&one));
        // A flat tetrahedron has no inside, so each of its faces counts.
        let is_flat = apex.abs() <= 1e-12 * normal.norm() * (rest - one).norm();
        if is_flat || apex * origin < 0.0 {
            let found = triangle(one, two, three);
            best = Some(best.map_or(found, |known| least([known, found])));
        }
    }
    best
}

fn least<const N: usize>(found: [(Point, Simplex); N]) -> (Point, Simplex) {
    let none = (Point::zeros(), Simplex::empty());
    let best = found
        .into_iter()
        .reduce(|best, next| if next.0.norm_squared() < best.0.norm_squared() { next } else { best });
    best.unwrap_or(none)
}
