//! Directional bound for a part beside an obstacle: contact throughout a cell, by the part's motion along
//! each axis of the obstacle instead of its greatest motion. An arm that turns beside a wall moves far
//! along it and hardly away from it.
//!
//! The motion of a point on a line is a convex combination of its ends' motions. A point in the middle of a
//! cell stays as near to the box as the sum of squares gives; a line whose ends stay on both sides of a
//! plane through the box's middle crosses that plane.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::inverse::interval::DisplacementBound;
use crate::planning::certify::deflate::SLACK;

/// Number of points on a line that are tried, each nearer to the best.
const PLACES: usize = 6;

/// Line of a solid in the axes of a box.
struct BoxLine {
    /// Ends of the line relative to the box's centre.
    ends: [[f64; 3]; 2],
    /// Motion bounds of the ends along each axis.
    gone: [[f64; 3]; 2],
    half: [f64; 3],
}

/// Directional motion bound of a solid over a cell.
pub(super) trait MotionExtent {
    /// Greatest motion in m of a point along a unit direction. On a line it is at most the interpolation of
    /// the ends' bounds.
    fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>) -> f64;

    /// Checks whether an upright solid stays upright.
    fn stays_upright(&self) -> bool;
}

impl MotionExtent for DisplacementBound {
    fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
        Self::along(self, point, direction)
    }

    fn stays_upright(&self) -> bool {
        self.turns_about().is_some_and(|axis| is_upright(&axis))
    }
}

/// Motion scaled by a share.
pub(super) struct ScaledMotion<'a, T>(pub(super) f64, pub(super) &'a T);

impl<T: MotionExtent> MotionExtent for ScaledMotion<'_, T> {
    fn along(&self, point: &Vector3<f64>, direction: &Vector3<f64>) -> f64 {
        self.0 * self.1.along(point, direction)
    }

    fn stays_upright(&self) -> bool {
        self.1.stays_upright()
    }
}

/// Certain core of a solid: a ball that slides along half of its line to both sides, up to a share of it.
struct InnerLine {
    step: Vector3<f64>,
    radius: f64,
    share: f64,
    is_round: bool,
}

impl InnerLine {
    fn new(solid: &Solid) -> Option<Self> {
        let [_, _, z] = &solid.axes;
        let (step, radius) = match solid.shape {
            Shape::Capsule { radius, half } => {
                return Some(Self { step: z * half, radius, share: 1.0, is_round: true });
            }
            Shape::Cylinder { radius, half } => (z * half, radius.min(half)),
            Shape::Box(_) => longest(solid),
            Shape::HalfSpace => return None,
        };
        let long = step.norm();
        (long > 0.0).then(|| Self { step, radius, share: 1.0 - (radius / long).min(1.0), is_round: false })
    }
}

/// Checks whether a solid is within `pad` m of another one throughout its motion.
#[inline]
pub(super) fn is_in(solid: &Solid, goes: &impl MotionExtent, other: &Solid, pad: f64) -> bool {
    let Some(inside) = InnerLine::new(solid) else { return false };
    let [_, _, z] = &solid.axes;
    let upright = match solid.shape {
        Shape::Cylinder { radius, half } if is_upright(z) && goes.stays_upright() => Some((radius, half)),
        Shape::Cylinder { .. } | Shape::Capsule { .. } | Shape::Box(_) | Shape::HalfSpace => None,
    };
    match (other.shape, upright) {
        (Shape::Box(half), Some((radius, long))) => {
            is_in_upright(solid, [radius, long], goes, other, [half.x, half.y, half.z], pad)
        }
        (Shape::Box(half), None) => is_in_box(solid, &inside, goes, other, [half.x, half.y, half.z], pad),
        (Shape::Cylinder { radius, half }, _) => {
            is_in_round(solid, &inside, goes, other, RoundBody { radius, half, rim: 0.0 }, pad)
        }
        (Shape::Capsule { radius, half }, _) => {
            is_in_round(solid, &inside, goes, other, RoundBody { radius: 0.0, half, rim: radius }, pad)
        }
        (Shape::HalfSpace, _) => false,
    }
}

/// Cylinder with a rim around it.
struct RoundBody {
    radius: f64,
    half: f64,
    rim: f64,
}

/// Checks contact with a round solid: the nearest point of the line stays near, away from the axis, about
/// it and along it.
fn is_in_round(
    solid: &Solid,
    inside: &InnerLine,
    goes: &impl MotionExtent,
    other: &Solid,
    round: RoundBody,
    pad: f64,
) -> bool {
    let [_, _, z] = &other.axes;
    let between = solid.centre - other.centre;
    let near = inside.radius + round.rim + pad - SLACK;
    let is_near = |share: f64| {
        let point = between + inside.step * share;
        let up = point.dot(z);
        let out = point - z * up;
        let far = out.norm();
        if up.abs() > round.half + near || far > round.radius + near {
            return false;
        }
        let away = if far > 1e-9 {
            out / far
        } else {
            solid
                .axes
                .iter()
                .map(|axis| z.cross(axis))
                .fold(
                    Vector3::zeros(),
                    |most, next| if next.norm_squared() > most.norm_squared() { next } else { most },
                )
                .normalize()
        };
        let place = point + other.centre;
        let gone = |axis: &Vector3<f64>| goes.along(&place, axis) + SLACK;
        // One direction beyond the bound decides.
        let wide = round.radius + near;
        let away_by = far + gone(&away);
        if away_by.is_nan() || away_by > wide {
            return false;
        }
        let about = gone(&z.cross(&away));
        if about.is_nan() || about > wide {
            return false;
        }
        let (out, up) =
            ((libm::hypot(away_by, about) - round.radius).max(0.0), up.abs() + gone(z) - round.half);
        // An unknown bound is NaN or infinite.
        up.is_finite() && out * out + up.max(0.0) * up.max(0.0) <= near * near
    };
    let places = nearest(&between, &inside.step, z, round.half);
    places.into_iter().any(|at| is_near(at.clamp(-inside.share, inside.share)))
}

/// Parameters, with −1 and 1 the ends, of the points of a line nearest to another line: to its middle, and
/// to all of it.
fn nearest(between: &Vector3<f64>, step: &Vector3<f64>, z: &Vector3<f64>, half: f64) -> [f64; 2] {
    let long = step.norm_squared();
    if long < 1e-12 {
        return [0.0; 2];
    }
    let (slope, up) = (step.dot(z), between.dot(z));
    let square = long - slope * slope;
    let level = if square > 1e-9 { (slope * up - step.dot(between)) / square } else { 0.0 };
    // Beyond the other line's ends, its end is nearest.
    let end = z * (up + slope * level.clamp(-1.0, 1.0)).clamp(-half, half);
    [(end - between).dot(step) / long, level]
}

/// Checks contact with a box.
fn is_in_box(
    solid: &Solid,
    inside: &InnerLine,
    goes: &impl MotionExtent,
    board: &Solid,
    half: [f64; 3],
    pad: f64,
) -> bool {
    let step = inside.step;
    let between = solid.centre - board.centre;
    let near = inside.radius + pad - SLACK;
    let mut line = BoxLine { ends: [[0.0; 3]; 2], gone: [[0.0; 3]; 2], half };
    let [first, last] = &mut line.ends;
    for (((axis, half), first), last) in board.axes.iter().zip(half).zip(first).zip(last) {
        let (at, by) = (between.dot(axis), step.dot(axis));
        (*first, *last) = (at - by, at + by);
        // Apart even in the middle of the cell.
        if first.min(*last) > half + near || first.max(*last) < -half - near {
            return false;
        }
    }
    let BoxLine { ends: [first, last], gone: [gone, goes_last], .. } = &mut line;
    let sides = first.iter().zip(last).zip(gone.iter_mut().zip(goes_last)).zip(board.axes.iter().zip(half));
    for (((first, last), (gone, other)), (axis, half)) in sides {
        *gone = goes.along(&(solid.centre - step), axis) + SLACK;
        *other = goes.along(&(solid.centre + step), axis) + SLACK;
        // Too far in this direction, and not across the middle either.
        let is_through = *first * *last < 0.0 && first.abs() > *gone && last.abs() > *other;
        let least = gone.min(*other);
        if !gone.is_finite() || !other.is_finite() || (!is_through && least > half + near) {
            return false;
        }
    }
    // Only a round solid has a ball at the ends of its line.
    line.stays(inside.share, near) || line.leads_through(if inside.is_round { near } else { pad - SLACK })
}

/// Checks contact of an upright cylinder that stays upright with a box, by the motion of its axis alone.
fn is_in_upright(
    solid: &Solid,
    [radius, long]: [f64; 2],
    goes: &impl MotionExtent,
    board: &Solid,
    half: [f64; 3],
    pad: f64,
) -> bool {
    let radius = radius + pad - SLACK;
    let between = solid.centre - board.centre;
    let mut beside = 0.0;
    let mut has_height = false;
    for (axis, half) in board.axes.iter().zip(half) {
        let beyond = between.dot(axis).abs() - half;
        let is_up = is_upright(axis);
        let wide = if is_up { long } else { radius };
        if beyond > wide {
            return false;
        }
        let gone = goes.along(&solid.centre, axis) + SLACK;
        let beyond = beyond + gone;
        if is_up {
            has_height = true;
            if beyond.is_nan() || beyond > long {
                return false;
            }
        } else {
            let out = if beyond.is_nan() { f64::INFINITY } else { beyond.max(0.0) };
            beside += out * out;
        }
    }
    has_height && beside <= radius * radius
}

fn is_upright(axis: &Vector3<f64>) -> bool {
    axis.x.abs() < 1e-9 && axis.y.abs() < 1e-9
}

/// Half of the longest line along a box's axes through its centre, and the radius of a ball that slides
/// along it.
fn longest(solid: &Solid) -> (Vector3<f64>, f64) {
    let Shape::Box(half) = solid.shape else { return (Vector3::zeros(), 0.0) };
    let [x, y, z] = &solid.axes;
    let most = half.max();
    let line = if half.x >= most {
        x * half.x
    } else if half.y >= most {
        y * half.y
    } else {
        z * half.z
    };
    (line, half.min())
}

impl BoxLine {
    /// Squared distance bound of a point of the line from the box, without one axis.
    fn off(&self, at: f64, but: Option<usize>) -> f64 {
        let (share, rest) = (0.5 + 0.5 * at, 0.5 - 0.5 * at);
        let ([first, last], [gone, goes]) = (&self.ends, &self.gone);
        let mut sum = 0.0;
        let all = first.iter().zip(last).zip(gone.iter().zip(goes).zip(self.half)).zip(0..);
        for (((first, last), ((gone, goes), half)), axis) in all {
            if but != Some(axis) {
                let out = (rest * first + share * last).abs() + rest * gone + share * goes - half;
                sum += out.max(0.0) * out.max(0.0);
            }
        }
        sum
    }

    /// Checks whether a point within a share of the line's middle stays within `near` of the box.
    fn stays(&self, share: f64, near: f64) -> bool {
        // The bound is convex along the line.
        let (mut low, mut high, near) = (-share, share, near * near);
        let (mut at, mut off) = (0.0, self.off(0.0, None));
        if off <= near {
            return true;
        }
        for _ in 0..PLACES {
            let (below, above) = ((low + at) / 2.0, (at + high) / 2.0);
            let (off_below, off_above) = (self.off(below, None), self.off(above, None));
            if off_below.min(off_above) <= near {
                return true;
            }
            if off_below < off {
                (high, at, off) = (at, below, off_below);
            } else if off_above < off {
                (low, at, off) = (at, above, off_above);
            } else {
                (low, high) = (below, above);
            }
        }
        false
    }

    /// Checks whether the line crosses a middle plane of the box within `near` of it.
    fn leads_through(&self, near: f64) -> bool {
        let ([first, last], [gone, goes]) = (&self.ends, &self.gone);
        let mut all = first.iter().zip(last).zip(gone.iter().zip(goes)).zip(0..);
        all.any(|(((first, last), (gone, goes)), axis)| {
            if first * last >= 0.0 || first.abs() <= *gone || last.abs() <= *goes {
                return false;
            }
            // Each end as far out as possible with the other as far in.
            let [one, other] = [1.0, -1.0].map(|to| {
                let (first, last) = (first.abs() + to * gone, last.abs() - to * goes);
                2.0 * first / (first + last) - 1.0
            });
            self.off(one, Some(axis)).max(self.off(other, Some(axis))) <= near * near
        })
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
    use proptest::prelude::*;

    use super::is_in;
    use crate::collision::{Shape, Solid};
    use crate::inverse::interval::DisplacementBound;
    use crate::planning::scene::MIN_CLEARANCE;

    fn solid(at: [f64; 3], turn: [f64; 3], shape: Shape) -> Solid {
        let turned = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        Solid::new(&Isometry3::from_parts(Translation3::from(Vector3::from(at)), turned), shape)
    }

    fn spun(axis: &Vector3<f64>, at: &Vector3<f64>, angle: f64) -> Isometry3<f64> {
        let about = Translation3::from(*at);
        about * UnitQuaternion::from_scaled_axis(axis * angle) * about.inverse()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(8192))]

        /// The directional bound is sound: contact holds for every motion within the drift.
        #[test]
        fn obstacle_bound_holds_for_every_motion(
            at in [-0.3..0.3_f64, -0.3..0.3_f64, -0.2..0.2_f64],
            turn in [-1.5..1.5_f64, -1.5..1.5_f64, -1.5..1.5_f64], half in 0.02..0.4_f64,
            radius in 0.01..0.2_f64, kind in 0..4_u8, beyond in 0..4_u8,
            board in [0.05..0.5_f64, 0.05..0.5_f64, 0.002..0.3_f64], lean in -1.5..1.5_f64,
            slide in [-0.2..0.2_f64, -0.2..0.2_f64, -0.2..0.2_f64], spin in 0.0..0.6_f64,
            bend in 0.0..0.4_f64, centre in [-0.5..0.5_f64, -0.5..0.5_f64, -0.5..0.5_f64],
            size in prop::sample::select(vec![0.03, 0.3, 1.0]), clearance in 0.0..0.08_f64,
            moved in prop::collection::vec(prop::sample::select(vec![-1.0, -0.6, 0.0, 0.3, 1.0]), 30),
        ) {
            let shape = match kind {
                0 => Shape::Capsule { radius, half },
                1 | 2 => Shape::Cylinder { radius, half },
                _ => Shape::Box(Vector3::new(radius, half, 0.7 * radius)),
            };
            // An upright solid that stays upright has a bound of its own.
            let is_upright = kind == 2;
            let own = solid(at, if is_upright { [0.0, 0.0, turn[2]] } else { turn }, shape);
            let [long, wide, _] = board;
            let other = match beyond {
                0 | 1 => Shape::Box(Vector3::from(board)),
                2 => Shape::Cylinder { radius: wide, half: long },
                _ => Shape::Capsule { radius: 0.4 * wide, half: long },
            };
            let board = solid([0.0; 3], if kind == 3 { [lean, 0.3, 0.0] } else { [0.0, 0.0, lean] }, other);
            let (slide, centre) = (Vector3::from(slide) * size, Vector3::from(centre));
            let (spin, bend) = (spin * size, if is_upright { 0.0 } else { bend * size });
            let axis = Vector3::new(lean, 1.0, 0.3).normalize();
            let mut drift = DisplacementBound::none().slid(slide);
            if !is_upright {
                drift = drift.spun(axis, centre, bend);
            }
            let drift = drift.spun(Vector3::z(), centre, spin);
            let pad = clearance.max(MIN_CLEARANCE);
            if is_in(&own, &drift, &board, pad) {
                for by in moved.chunks(3) {
                    let moves = spun(&Vector3::z(), &centre, spin * by[0])
                        * spun(&axis, &centre, bend * by[1])
                        * Translation3::from(slide * by[2]);
                    let moved = own.moved(&moves);
                    prop_assert!(moved.is_nearer(&board, pad), "{own:?} {moved:?} {board:?}");
                }
            }
        }
    }

    /// An arm that turns along a thin board is in contact throughout.
    #[test]
    fn obstacle_bound_finds_an_arm_through_a_board() {
        let arm = solid([0.0; 3], [0.0; 3], Shape::Capsule { radius: 0.05, half: 0.3 });
        let board = solid([0.0; 3], [0.0; 3], Shape::Box(Vector3::new(1.0, 1.0, 0.005)));
        let slid =
            |step: Vector3<f64>| is_in(&arm, &DisplacementBound::none().slid(step), &board, MIN_CLEARANCE);
        assert!(slid(Vector3::new(0.9, 0.0, 0.25)));
        assert!(!slid(Vector3::new(0.0, 0.0, 0.4)) && !slid(Vector3::new(1.2, 0.0, 0.0)));
        let far = DisplacementBound::none().spun(Vector3::z(), Vector3::new(0.3, 0.0, 0.0), 3.0);
        assert!(is_in(&arm, &far, &board, MIN_CLEARANCE));
    }
}
