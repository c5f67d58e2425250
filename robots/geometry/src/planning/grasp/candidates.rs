//! Grasp candidates: hand poses from the shape of an object and the opening of the hand.
//!
//! The fingers close across the object on a line through its axis or its centre, at the depth at which they
//! hold it best. Where a point is given, the object lies between the fingers there: the hand is moved along
//! the object and, in the closing direction, as far as the fingers then move the object.

use std::f64::consts::{FRAC_PI_6, TAU};

use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::collision::{Shape, Solid};
use crate::planning::query::GraspSide;
use crate::planning::scene::{FingerContact, HandModel, HoldDepths};
use crate::trigonometry::{sin_cos, turn};

/// Height in m of the finger tips above the lower face of an object, for a grasp from above.
const ABOVE: f64 = 0.004;
/// Distance in m from the end of an object at which whole fingers hold it.
const FINGER: f64 = 0.03;
/// Least distance between two depths that are tried, in m.
const NEXT: f64 = 0.003;

/// Cosine bound of a grasp from above: approaches steeper than 35° from straight down.
pub(crate) const TOP: f64 = -0.819;

/// Grasp candidate: a hand pose with its approach and the width of the object there.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct GraspCandidate {
    pub(crate) map_from_tip: Isometry3<f64>,
    /// Unit vector along which the fingers point.
    pub(crate) approach: Vector3<f64>,
    pub(crate) side: GraspSide,
    pub(crate) width: f64,
    /// Distance of the object's centre from the tip along the fingers, and what is between them.
    pub(crate) depth: f64,
    pub(crate) contact: FingerContact,
    /// Translation of the object by the closing fingers.
    pub(crate) push: Vector3<f64>,
}

/// All candidates in a fixed order, at a point if one is given, and the least width across which the object
/// could be grasped, in m.
pub(crate) fn grasp_candidates(
    hand: &HandModel,
    object: &Solid,
    side: Option<GraspSide>,
    base: [f64; 3],
    point: Option<Vector3<f64>>,
) -> (Vec<GraspCandidate>, f64) {
    let off = point.map(|point| point - object.centre);
    let (holds, shallow) = (vec![], vec![]);
    let mut found = CandidateList { hand, object, off, holds, shallow, least: f64::INFINITY, known: vec![] };
    let [x, _, z] = object.axes;
    match object.shape {
        Shape::Box(half) => found.of_box(&half),
        Shape::Cylinder { radius, half } => {
            found.around(&z, radius, half);
            // Across the height at the rim, as for a plate.
            for step in 0..16 {
                let out = turn(&Unit::new_normalize(z), TAU * f64::from(step) / 16.0) * x;
                found.add(&-out, &z, 2.0 * half, false);
                found.add(&-out, &-z, 2.0 * half, false);
            }
        }
        Shape::Capsule { radius, half } if half > 0.0 => found.around(&z, radius, half),
        Shape::Capsule { radius, .. } => found.around(&Vector3::z(), radius, 0.0),
        Shape::HalfSpace => {}
    }
    let [base_x, base_y, _] = base;
    let ahead = [object.centre.x - base_x, object.centre.y - base_y];
    let (least, mut holds) = (found.least, found.holds);
    holds.extend(found.shallow);
    holds.retain(|hold| match side {
        None => true,
        Some(GraspSide::Top) => hold.side == GraspSide::Top,
        Some(GraspSide::Side) => hold.side != GraspSide::Top,
        Some(GraspSide::Front) => hold.side != GraspSide::Top && is_ahead(&hold.approach, ahead),
    });
    (holds, least)
}

/// Depths at which the fingers of a hand hold an object whose near face is before the palm; of a round one
/// the nearest point.
pub(crate) fn hold_depths(hand: &HandModel, width: f64, contact: FingerContact) -> Option<HoldDepths> {
    let half = match contact {
        FingerContact::Round => width / 2.0,
        FingerContact::Flat(half) => half,
    };
    hand.depths(width, contact, (hand.palm + half).max(0.0))
}

/// Steps in which candidates are ordered by their approach, and m by which they move the object for one step.
const STEPS: usize = 20;
const PUSHED: f64 = 0.002;

/// Orders candidates: those that move the object less, and from the robot's side, first, and from above,
/// which is rarely blocked, in the middle. `ahead` leads from the base to the object.
pub(crate) fn in_order(holds: &mut [GraspCandidate], ahead: &Vector3<f64>) {
    let pushed = |hold: &GraspCandidate| libm::round(hold.push.norm() / PUSHED) as usize;
    holds.sort_by_cached_key(|hold| pushed(hold) + rank(hold, ahead));
}

/// Rank of a candidate, the best the least. In steps, so that rounding does not change the order.
pub(crate) fn rank(hold: &GraspCandidate, ahead: &Vector3<f64>) -> usize {
    match hold.side {
        GraspSide::Top => STEPS / 2,
        GraspSide::Side | GraspSide::Front => {
            let far = (ahead.x * ahead.x + ahead.y * ahead.y).sqrt().max(1e-9);
            let worth = (hold.approach.x * ahead.x + hold.approach.y * ahead.y) / far;
            STEPS.saturating_sub_signed(libm::round(worth * f64::from(STEPS as u32)) as isize)
        }
    }
}

/// Checks whether the fingers point within 45° of a direction in the plane.
pub(crate) fn is_ahead(approach: &Vector3<f64>, [x, y]: [f64; 2]) -> bool {
    let flat = libm::hypot(approach.x, approach.y);
    approach.x * x + approach.y * y >= std::f64::consts::FRAC_1_SQRT_2 * flat * libm::hypot(x, y)
}

/// Finger placement around an object, free along its axis.
struct FingerPlacement {
    approach: Vector3<f64>,
    along: Vector3<f64>,
    width: f64,
    side: GraspSide,
    contact: FingerContact,
    /// Distance of the object's centre from the tip, and greater ones for a grasp from above.
    depth: f64,
    shallow: [Option<f64>; 2],
    rotation: UnitQuaternion<f64>,
}

struct CandidateList<'a> {
    hand: &'a HandModel,
    object: &'a Solid,
    /// Point of the grasp from the object's centre, if it is given.
    off: Option<Vector3<f64>>,
    holds: Vec<GraspCandidate>,
    /// Grasps that hold less of the object.
    shallow: Vec<GraspCandidate>,
    least: f64,
    /// Depths at which the fingers hold, by width and contact.
    known: Vec<(f64, FingerContact, Option<HoldDepths>)>,
}

impl CandidateList<'_> {
    /// Adds grasps around an axis, level and bent towards its lower end, and along it from either end.
    fn around(&mut self, axis: &Vector3<f64>, radius: f64, half: f64) {
        // Downwards for an upright axis.
        let down = if axis.z > 0.0 { -axis } else { *axis };
        let square = if axis.z.abs() < 0.9 { axis.cross(&Vector3::z()) } else { axis.cross(&Vector3::y()) };
        let first = square.normalize();
        let ball = half == 0.0;
        let heights = self.shifts(axis, half, 0.03);
        let about = Unit::new_normalize(*axis);
        let outs: Vec<Vector3<f64>> =
            (0..16).map(|step| turn(&about, TAU * f64::from(step) / 16.0) * first).collect();
        for (sin, cos) in [0.0, FRAC_PI_6, 2.0 * FRAC_PI_6].map(sin_cos) {
            for out in &outs {
                let approach = down * sin - out * cos;
                let along = axis.cross(out);
                // Bent fingers still close across the axis at the widest place.
                let ways = [along, -along].map(|along| self.way(&approach, &along, 2.0 * radius, true));
                for height in &heights {
                    ways.iter().flatten().for_each(|way| self.hold(way, axis * *height));
                }
            }
        }
        for along in &outs {
            self.add(&down, along, 2.0 * radius, ball);
        }
    }

    fn of_box(&mut self, half: &Vector3<f64>) {
        let axes: Vec<(Vector3<f64>, f64)> =
            self.object.axes.iter().copied().zip(half.iter().copied()).collect();
        for (at, (along, wide)) in axes.iter().enumerate() {
            for (other, (approach, _)) in axes.iter().enumerate() {
                if other == at {
                    continue;
                }
                let third = axes.iter().enumerate().find(|(third, _)| *third != at && *third != other);
                let shifts = third.map_or(vec![0.0], |(_, (axis, half))| self.shifts(axis, *half, 0.04));
                let direction = third.map_or(Vector3::zeros(), |(_, (axis, _))| *axis);
                let ways =
                    [(*approach, *along), (*approach, -along), (-approach, *along), (-approach, -along)]
                        .map(|(approach, along)| self.way(&approach, &along, 2.0 * wide, false));
                for shift in shifts {
                    ways.iter().flatten().for_each(|way| self.hold(way, direction * shift));
                }
            }
        }
    }

    /// Places along an axis at which an object is grasped: in the middle and, of a long one, half-way to its
    /// ends; or as near to the given point as whole fingers hold the object.
    fn shifts(&self, axis: &Vector3<f64>, half: f64, long: f64) -> Vec<f64> {
        match self.off {
            Some(off) => {
                let most = if half > long { (0.5 * half).max(half - FINGER) } else { 0.0 };
                vec![off.dot(axis).clamp(-most, most)]
            }
            None if half > long => vec![0.0, half * 0.5, half * -0.5],
            None => vec![0.0],
        }
    }

    /// Adds grasps around the centre.
    fn add(&mut self, approach: &Vector3<f64>, along: &Vector3<f64>, width: f64, is_round: bool) {
        if let Some(way) = self.way(approach, along, width, is_round) {
            self.hold(&way, Vector3::zeros());
        }
    }

    /// Placement with an approach and a closing direction; `None` where the fingers do not reach around the
    /// object.
    fn way(
        &mut self,
        approach: &Vector3<f64>,
        along: &Vector3<f64>,
        width: f64,
        is_round: bool,
    ) -> Option<FingerPlacement> {
        // A hand never comes from below.
        if approach.z > 0.5 {
            return None;
        }
        self.least = self.least.min(width);
        if width > self.hand.card.opening_m {
            return None;
        }
        let half = self.object.extent(approach);
        let (contact, half) = if is_round {
            // Bent towards a long object, the palm meets its side before its end.
            (FingerContact::Round, (width / 2.0).max(half.min(self.side_extent(approach))))
        } else {
            (FingerContact::Flat(half), half)
        };
        let HoldDepths { best, most, .. } = self.depths(width, contact)?;
        let depth = best.max(self.hand.palm + half);
        if depth > most {
            return None;
        }
        let side = if approach.z < TOP { GraspSide::Top } else { GraspSide::Side };
        // From above, the finger tips may have to stay above the support.
        let is_shallow = |at: &f64| side == GraspSide::Top && *at > depth + NEXT;
        let end = self.hand.closing.end_around(width, best, contact);
        let above = end.map(|end| end - self.object.extent(approach) + ABOVE).filter(|at| *at < most - NEXT);
        let shallow = [above, Some(most)].map(|at| at.filter(is_shallow));
        let rotation = self.hand.turned(approach, along);
        Some(FingerPlacement {
            approach: *approach,
            along: *along,
            width,
            side,
            contact,
            depth,
            shallow,
            rotation,
        })
    }

    /// Depths at which the fingers hold; of a round object those before its nearest point.
    fn depths(&mut self, width: f64, contact: FingerContact) -> Option<HoldDepths> {
        if let Some((.., depths)) = self.known.iter().find(|known| (known.0, known.1) == (width, contact)) {
            return *depths;
        }
        let depths = hold_depths(self.hand, width, contact);
        self.known.push((width, contact, depths));
        depths
    }

    /// Adds the grasps at a shift from the centre.
    fn hold(&mut self, way: &FingerPlacement, shift: Vector3<f64>) {
        let FingerPlacement { approach, along, width, side, contact, rotation, .. } = *way;
        let aside = along * self.off.map_or(0.0, |off| off.dot(&along));
        for (depth, is_shallow) in [(Some(way.depth), false), (way.shallow[0], true), (way.shallow[1], true)]
        {
            let Some(depth) = depth else { continue };
            let at = self.object.centre + shift + aside - approach * depth - along * self.hand.middle(width);
            let map_from_tip = Isometry3::from_parts(Translation3::from(at), rotation);
            let hold = GraspCandidate { map_from_tip, approach, side, width, depth, contact, push: aside };
            if is_shallow { self.shallow.push(hold) } else { self.holds.push(hold) }
        }
    }

    /// Extent of the object against a direction, on the line through its middle.
    fn side_extent(&self, approach: &Vector3<f64>) -> f64 {
        let [_, _, z] = &self.object.axes;
        match self.object.shape {
            Shape::Cylinder { radius, half } | Shape::Capsule { radius, half } => {
                let along = approach.dot(z).abs();
                let aside = (1.0 - along * along).max(0.0).sqrt();
                let out = if aside > 1e-9 { radius / aside } else { f64::INFINITY };
                let end = if along > 1e-9 { half / along } else { f64::INFINITY };
                // A ball, and a round end, are met sooner than a flat one.
                if half > 0.0 { out.min(end) } else { radius }
            }
            Shape::Box(_) | Shape::HalfSpace => self.object.extent(approach),
        }
    }
}
