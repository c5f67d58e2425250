//! Infeasibility by area cover: the base cannot come near enough to an entity whatever the arm does, or a
//! surface has no room for an object.
//!
//! Squares cover the plane. A square is dead where the certain core of the robot or object, deflated by
//! half of the square's diagonal, is still in contact.

use nalgebra::{Isometry3, Point3, Translation3, Vector3};

use super::deflate::SLACK;
use crate::collision::{Shape, Solid};
use crate::planning::scene::{
    ABOVE, Configuration, HeldObject, MIN_CLEARANCE, Obstacle, Padding, PlanningScene, SupportSurface,
};

/// Side of a square in m, for scenes of up to [`CELLS`] squares a side.
const CELL: f64 = 0.05;
/// Greatest number of squares along a side.
const CELLS: usize = 400;
/// Margin of the cover around all obstacles, in m.
const MARGIN: f64 = 0.6;
/// Greatest number of divisions of a square on a surface.
const DEPTH: u32 = 7;

/// Check that no place of an object fits some rules, for a point of the map in m, a distance in m from it,
/// and the radii of a disc within the object's outline and of one around it.
pub(crate) type ExcludedPlaces<'f> = dyn Fn([f64; 2], f64, [f64; 2]) -> bool + 'f;

impl PlanningScene<'_> {
    /// Checks whether no route of the base leads within `reach` of a target, by the 1-Lipschitz distance
    /// `far`. Sound for all arm configurations: it moves only the largest disc about the base's axis within
    /// a part that no joint moves.
    pub(crate) fn is_shut_off(&self, around: [f64; 2], reach: f64, far: impl Fn(f64, f64) -> f64) -> bool {
        let Some((radius, height)) = self.core() else { return false };
        // The disc is within one part, so it keeps that part's distance.
        let wall = |obstacle: &Obstacle| Some((section(&obstacle.solid, height)?, obstacle.padding.base));
        let walls: Vec<(Solid, f64)> = self.obstacles.iter().filter_map(wall).collect();
        let [x, y, _] = self.state.robot.base;
        let (mut low, mut high) = ([x, y], [x, y]);
        let wide = |at: f64, half: f64| [at - half, at + half];
        let solids = walls.iter().map(|(wall, _)| {
            let [half_x, half_y] = [Vector3::x(), Vector3::y()].map(|axis| wall.extent(&axis));
            [wide(wall.centre.x, half_x), wide(wall.centre.y, half_y)]
        });
        for spans in solids.chain([around.map(|at| wide(at, reach))]) {
            for ((low, high), [from, to]) in low.iter_mut().zip(&mut high).zip(spans) {
                (*low, *high) = (low.min(from), high.max(to));
            }
        }
        // In the ring around everything the base always drives.
        let margin = MARGIN + radius + Padding::new(self.clearance).base;
        let origin = low.map(|low| low - margin);
        let span = [high[0] - origin[0] + margin, high[1] - origin[1] + margin];
        let cell = CELL.max(span[0].max(span[1]) / CELLS as f64);
        let off = cell * std::f64::consts::FRAC_1_SQRT_2;
        let size = span.map(|span| libm::ceil(span / cell) as i64 + 1);
        let middle =
            |[column, row]: [i64; 2]| [origin[0] + column as f64 * cell, origin[1] + row as f64 * cell];
        let is_dead = |[x, y]: [f64; 2]| {
            let point = disc(x, y, height);
            let is_near = |(wall, pad): &(Solid, f64)| !wall.is_farther(&point, radius + pad - off - SLACK);
            radius - off > 0.0 && walls.iter().any(is_near)
        };
        let begin = [(x - origin[0]) / cell, (y - origin[1]) / cell].map(|at| libm::round(at) as i64);
        let index = |[column, row]: [i64; 2]| usize::try_from(row * size[0] + column).ok();
        let mut seen = vec![false; usize::try_from(size[0] * size[1]).unwrap_or(0)];
        let mut open = vec![begin];
        while let Some(at) = open.pop() {
            let place = middle(at);
            if far(place[0], place[1]) - off <= reach {
                return false;
            }
            for (right, down) in [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let next = [at[0] + right, at[1] + down];
                let is_within = next.iter().zip(size).all(|(at, size)| (0..size).contains(at));
                let slot = index(next).filter(|_| is_within).and_then(|at| seen.get_mut(at));
                let Some(slot) = slot.filter(|slot| !**slot) else { continue };
                *slot = true;
                if !is_dead(middle(next)) {
                    open.push(next);
                }
            }
        }
        true
    }

    /// Radius and height of the largest upright disc about the base's axis within one part that no joint
    /// moves.
    fn core(&self) -> Option<(f64, f64)> {
        let configuration = Configuration { base: [0.0; 3], joints: self.model.rest().to_vec() };
        let placed = self.body.placed(&self.model.map_from_links(&configuration));
        let fixed = self
            .body
            .parts()
            .iter()
            .zip(&placed)
            .filter(|(part, _)| self.model.ancestor_joints(part.link).is_empty());
        let discs = fixed.map(|(_, solid)| {
            let [_, _, z] = &solid.axes;
            let is_upright = z.x.abs() < 1e-9 && z.y.abs() < 1e-9;
            let wide = match solid.shape {
                Shape::Cylinder { radius, .. } if is_upright => radius,
                Shape::Capsule { radius, .. } => radius,
                Shape::Cylinder { radius, half } => radius.min(half),
                Shape::Box(half) if is_upright => half.x.min(half.y),
                Shape::Box(half) => half.min(),
                Shape::HalfSpace => 0.0,
            };
            (wide - libm::hypot(solid.centre.x, solid.centre.y), solid.centre.z)
        });
        let best = discs.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.filter(|(radius, _)| *radius > 2.0 * MIN_CLEARANCE)
    }

    /// Checks whether no place on a surface is free for the held object, upright in any direction, and not
    /// excluded by rules. Where there are rules it covers every place at which the object is on the surface
    /// in some direction; without any, those at which it is on it in every direction.
    pub(crate) fn is_full(
        &self,
        held: &HeldObject<'_>,
        on: &SupportSurface,
        index: usize,
        is_excluded: Option<&ExcludedPlaces<'_>>,
    ) -> bool {
        let solid = Solid::new(&Isometry3::identity(), held.shape);
        let bottom = solid.extent(&Vector3::z());
        let (inner, around) = match held.shape {
            Shape::Box(half) => (half.x.min(half.y), libm::hypot(half.x, half.y)),
            Shape::Cylinder { radius, .. } | Shape::Capsule { radius, .. } => (radius, radius),
            Shape::HalfSpace => return false,
        };
        // A round object is as wide all over only within the ball at its middle.
        let tall = if matches!(held.shape, Shape::Capsule { .. }) { 0.0 } else { bottom };
        let others: Vec<&Obstacle> =
            self.obstacles.iter().filter(|obstacle| obstacle.entity != index).collect();
        let least = if is_excluded.is_some() { inner } else { around };
        let spread = on.half.map(|half| (half - least).max(0.0));
        let mut open = vec![([0.0, 0.0], spread, 0)];
        while let Some(([x, y], [half_x, half_y], depth)) = open.pop() {
            let spot = on.map_from_face * Point3::new(x, y, bottom + ABOVE);
            let off = libm::hypot(half_x, half_y);
            let left = inner - off;
            let stands = Solid {
                centre: spot.coords,
                axes: [Vector3::x(), Vector3::y(), Vector3::z()],
                shape: if tall > 0.0 {
                    Shape::Cylinder { radius: left.max(1e-6), half: tall }
                } else {
                    Shape::Capsule { radius: left.max(1e-6), half: 0.0 }
                },
            };
            let is_near = |other: &&Obstacle| !stands.is_farther(&other.solid, other.padding.arm);
            if left > 0.0 && others.iter().any(is_near) {
                continue;
            }
            if is_excluded.is_some_and(|rules| rules([spot.x, spot.y], off, [inner, around])) {
                continue;
            }
            if depth >= DEPTH {
                return false;
            }
            let (quarter_x, quarter_y) = (half_x / 2.0, half_y / 2.0);
            for (right, up) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                open.push(([x + right * quarter_x, y + up * quarter_y], [quarter_x, quarter_y], depth + 1));
            }
        }
        true
    }
}

/// Flat slice of a solid at a height at which it is surely as wide; `None` where it is not there.
fn section(solid: &Solid, height: f64) -> Option<Solid> {
    const THIN: f64 = 1e-3;
    let [_, _, z] = &solid.axes;
    let is_upright = z.x.abs() < 1e-9 && z.y.abs() < 1e-9;
    let shape = match solid.shape {
        Shape::Box(half) if is_upright && (height - solid.centre.z).abs() <= half.z => {
            Shape::Box(Vector3::new(half.x, half.y, THIN))
        }
        Shape::Cylinder { radius, half } | Shape::Capsule { radius, half }
            if is_upright && (height - solid.centre.z).abs() <= half =>
        {
            Shape::Cylinder { radius, half: THIN }
        }
        Shape::Box(_) | Shape::Cylinder { .. } | Shape::Capsule { .. } | Shape::HalfSpace => return None,
    };
    let centre = Vector3::new(solid.centre.x, solid.centre.y, height);
    Some(Solid { centre, axes: solid.axes, shape })
}

/// Point of the base's axis as a solid.
fn disc(x: f64, y: f64, height: f64) -> Solid {
    let pose = Isometry3::from(Translation3::new(x, y, height));
    Solid::new(&pose, Shape::Capsule { radius: 0.0, half: 0.0 })
}
