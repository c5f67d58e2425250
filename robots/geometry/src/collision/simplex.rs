//! Point of a simplex nearest to the origin (Ericson 2005, 5.1).

use nalgebra::Vector3;

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
