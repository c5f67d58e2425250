//! Grasp manifold: all grasps of an object, as families of hand poses with up to four parameters.
//!
//! A search samples grasps (`candidates`); an infeasibility certificate has to cover all of them. The two
//! agree on which poses are grasps.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_4, PI};

use nalgebra::{Isometry3, Translation3, Unit, Vector3};

use super::candidates::{GraspCandidate, TOP, hold_depths, is_ahead};
use crate::collision::{Shape, Solid};
use crate::inverse::interval::DisplacementBound;
use crate::planning::query::GraspSide;
use crate::planning::scene::{FingerContact, HandModel, HoldDepths};
use crate::trigonometry::{atan2, sin_cos, turn, wrapped};

/// Numerical slack of an angle or a length.
const SLACK: f64 = 1e-6;

/// Typical distance of an arm's wrist behind the palm, in m.
const WRIST: f64 = 0.25;

/// All grasps of one object with one hand.
pub(crate) struct GraspManifold<'a> {
    hand: &'a HandModel,
    object: Solid,
    side: Option<GraspSide>,
    /// Direction from the base to the object, in the plane.
    ahead: [f64; 2],
    slots: Vec<GraspFamily>,
    /// Further condition of a grasp.
    permits: Option<&'a dyn Fn(&GraspCandidate) -> bool>,
}

/// Patch: a box of parameters of one family.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GraspPatch {
    slot: usize,
    /// Parameters: the angle about the object's axis, the bend of the fingers, the place along the object
    /// in −1..=1, and the depth from 0, the deepest, to 1, the shallowest.
    middle: [f64; 4],
    half: [f64; 4],
}

/// Family of grasps with the same placement of the fingers.
#[derive(Clone, Copy)]
struct GraspFamily {
    kind: FamilyKind,
    width: f64,
    /// Half of the extent over which the place varies, as a vector.
    along: Vector3<f64>,
    low: [f64; 4],
    high: [f64; 4],
    /// Set where all poses are from above, unset where none is; `None` for a mixture.
    is_top: Option<bool>,
    /// Object between the fingers, and the depths at which they hold it.
    contact: FingerContact,
    depths: HoldDepths,
}

#[derive(Clone, Copy)]
enum FamilyKind {
    /// Around an axis from its side, closing to one side or the other.
    Around { down: Vector3<f64>, first: Vector3<f64>, sign: f64 },
    /// Along an axis, turned about it.
    End { down: Vector3<f64>, first: Vector3<f64>, is_round: bool },
    /// From the side of a disc, across its height.
    Rim { first: Vector3<f64>, across: Vector3<f64> },
    /// A single approach and closing direction.
    Flat { approach: Vector3<f64>, across: Vector3<f64> },
    /// Around a bar before a face, at a depth, closing to one side or the other.
    Bar { along: Vector3<f64>, out: Vector3<f64>, depth: f64, sign: f64 },
}

impl<'a> GraspManifold<'a> {
    /// Grasps of an object from a side, or from any, with the base at a pose.
    pub(crate) fn new(
        hand: &'a HandModel,
        object: &Solid,
        side: Option<GraspSide>,
        [x, y, _]: [f64; 3],
    ) -> Self {
        let ahead = [object.centre.x - x, object.centre.y - y];
        let mut manifold = Self { hand, object: *object, side, ahead, slots: vec![], permits: None };
        let [x, _, z] = object.axes;
        match object.shape {
            Shape::Box(half) => manifold.of_box(&half),
            Shape::Cylinder { radius, half } => {
                manifold.around(&z, radius, half);
                for across in [z, -z] {
                    manifold.add(FamilyKind::Rim { first: x, across }, 2.0 * half, [PI, 0.0, 0.0], None);
                }
            }
            Shape::Capsule { radius, half } if half > 0.0 => manifold.around(&z, radius, half),
            Shape::Capsule { radius, .. } => manifold.around(&Vector3::z(), radius, 0.0),
            Shape::HalfSpace => {}
        }
        manifold
    }

    /// The same grasps, of which a further condition lets some not count. A proof covers them all.
    pub(crate) fn permitting(self, permits: &'a dyn Fn(&GraspCandidate) -> bool) -> Self {
        Self { permits: Some(permits), ..self }
    }

    /// Grasps of a bar before a face: turned about it by at most `about`, at a depth, and at most `share`
    /// of its half length from its middle.
    pub(crate) fn of_bar(
        hand: &'a HandModel,
        bar: &Solid,
        out: Vector3<f64>,
        depth: f64,
        [about, share]: [f64; 2],
    ) -> Self {
        let [.., along] = bar.axes;
        let (half, width) = match bar.shape {
            Shape::Capsule { radius, half } => (half, 2.0 * radius),
            Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => (0.0, 0.0),
        };
        let slot = |sign| GraspFamily {
            kind: FamilyKind::Bar { along, out, depth, sign },
            width,
            along: along * (half * share),
            low: [-about, 0.0, -1.0, 0.0],
            high: [about, 0.0, 1.0, 0.0],
            is_top: None,
            contact: FingerContact::Round,
            depths: HoldDepths { least: depth, best: depth, most: depth },
        };
        let slots = vec![slot(1.0), slot(-1.0)];
        Self { hand, object: *bar, side: None, ahead: [0.0; 2], slots, permits: None }
    }

    fn around(&mut self, axis: &Vector3<f64>, radius: f64, half: f64) {
        let down = if axis.z > 0.0 { -axis } else { *axis };
        let square = if axis.z.abs() < 0.9 { axis.cross(&Vector3::z()) } else { axis.cross(&Vector3::y()) };
        let first = square.normalize();
        let along = if half > 0.03 { axis * (half * 0.5) } else { Vector3::zeros() };
        let places = if half > 0.03 { 1.0 } else { 0.0 };
        for sign in [1.0, -1.0] {
            let kind = FamilyKind::Around { down, first, sign };
            let spans = [PI, FRAC_PI_3, places];
            self.add(kind, 2.0 * radius, spans, Some(along));
        }
        let kind = FamilyKind::End { down, first, is_round: half == 0.0 };
        self.add(kind, 2.0 * radius, [PI, 0.0, 0.0], None);
    }

    fn of_box(&mut self, half: &Vector3<f64>) {
        let [x, y, z] = self.object.axes;
        let axes = [(x, half.x), (y, half.y), (z, half.z)];
        for (at, (across, wide)) in axes.iter().enumerate() {
            for (other, (approach, _)) in axes.iter().enumerate() {
                let third = axes.iter().enumerate().find(|(third, _)| *third != at && *third != other);
                let Some((_, (direction, long))) = third.filter(|_| other != at) else { continue };
                let places = if *long > 0.04 { 1.0 } else { 0.0 };
                for (approach, across) in
                    [(*approach, *across), (*approach, -across), (-approach, *across), (-approach, -across)]
                {
                    let along = Some(direction * (long * 0.5));
                    self.add(FamilyKind::Flat { approach, across }, 2.0 * wide, [0.0, 0.0, places], along);
                }
            }
        }
    }

    /// Adds a family with its ranges of the angle, of the bend and of the place along the object.
    fn add(
        &mut self,
        kind: FamilyKind,
        width: f64,
        [about, bend, places]: [f64; 3],
        along: Option<Vector3<f64>>,
    ) {
        if width > self.hand.card.opening_m {
            return;
        }
        let along = along.unwrap_or_default();
        let contact = match kind {
            FamilyKind::Around { .. } | FamilyKind::End { is_round: true, .. } | FamilyKind::Bar { .. } => {
                FingerContact::Round
            }
            FamilyKind::End { .. } | FamilyKind::Rim { .. } | FamilyKind::Flat { .. } => {
                FingerContact::Flat(self.object.extent(&kind.directions(0.0, 0.0).0))
            }
        };
        let Some(depths) = hold_depths(self.hand, width, contact) else { return };
        let whole = GraspFamily {
            contact,
            depths,
            kind,
            width,
            along,
            low: [-about, 0.0, -places, 0.0],
            high: [about, bend, places, 1.0],
            is_top: None,
        };
        let is_upright = |axis: &Vector3<f64>| axis.z.abs() > 1.0 - 1e-9;
        let level = |slot: GraspFamily| GraspFamily {
            high: [about, slot.high[1], places, 0.0],
            is_top: Some(false),
            ..slot
        };
        match kind {
            FamilyKind::Around { down, .. } if is_upright(&down) => {
                // Bend from which on a grasp counts as from above.
                let bent = libm::asin(-TOP);
                let [_, most, ..] = whole.high;
                let side = GraspFamily { high: [about, (bent + SLACK).min(most), places, 1.0], ..whole };
                self.slots.push(level(side));
                if bent < most {
                    let low = [-about, bent - SLACK, -places, 0.0];
                    self.slots.push(GraspFamily { low, is_top: Some(true), ..whole });
                }
            }
            FamilyKind::Around { .. } => self.slots.push(whole),
            FamilyKind::Rim { across, .. } if is_upright(&across) => self.slots.push(level(whole)),
            FamilyKind::Rim { .. } => self.slots.push(whole),
            FamilyKind::Bar { .. } => self.slots.push(whole),
            FamilyKind::End { down: approach, .. } | FamilyKind::Flat { approach, .. } => {
                if approach.z < TOP {
                    self.slots.push(GraspFamily { is_top: Some(true), ..whole });
                } else {
                    self.slots.push(level(whole));
                }
            }
        }
    }

    /// Patches that cover all grasps.
    pub(crate) fn patches(&self) -> Vec<GraspPatch> {
        let slots = self.slots.iter().zip(0..).filter(|(slot, _)| match self.side {
            None => true,
            Some(GraspSide::Top) => slot.is_top != Some(false),
            Some(GraspSide::Side | GraspSide::Front) => slot.is_top != Some(true),
        });
        let patches = slots.map(|(GraspFamily { low, high, .. }, slot)| {
            let each = |of: fn(f64, f64) -> f64| {
                std::array::from_fn(|at: usize| {
                    low.get(at).zip(high.get(at)).map_or(0.0, |(low, high)| of(*low, *high))
                })
            };
            GraspPatch {
                slot,
                middle: each(|low, high| (low + high) / 2.0),
                half: each(|low, high| (high - low) / 2.0),
            }
        });
        patches.collect()
    }

    /// Motion of the hand in m over half of a patch's widest side, approximately, and the index of that side.
    pub(crate) fn widest(&self, patch: &GraspPatch) -> (f64, usize) {
        let [about, bend, place, deep] = patch.half;
        let Some(slot) = self.slots.get(patch.slot) else { return (0.0, 0) };
        let far = self.hand.palm.abs() + self.object.reach() + WRIST;
        let deep = deep * (slot.depths.most - slot.depths.least).abs();
        widest(&[about * far, bend * far, place * slot.along.norm(), deep])
    }

    /// Grasp at the middle of a patch, and the drift of the others; `None` for an empty patch.
    pub(crate) fn over(&self, patch: &GraspPatch) -> Option<(Isometry3<f64>, DisplacementBound)> {
        let slot = self.slots.get(patch.slot)?;
        let ([about, bend, place, deep], [abouts, bends, places, deeps]) = (patch.middle, patch.half);
        let (approach, across) = slot.kind.directions(about, bend);
        let turns = match slot.kind {
            FamilyKind::Flat { .. } => 0.0,
            // For rotations about perpendicular axes, the cosine of half of the whole angle is the product
            // of the cosines of the half angles.
            FamilyKind::Around { .. }
            | FamilyKind::End { .. }
            | FamilyKind::Rim { .. }
            | FamilyKind::Bar { .. } => libm::hypot(abouts, bends),
        };
        // A hand never comes from below.
        if approach.z - turns - SLACK > 0.5 || self.is_behind(slot, &approach, abouts + bends) {
            return None;
        }
        let (first, last) = match slot.kind {
            FamilyKind::Bar { depth, .. } => (depth, depth),
            FamilyKind::Around { .. }
            | FamilyKind::End { .. }
            | FamilyKind::Rim { .. }
            | FamilyKind::Flat { .. } => self.depths(slot, &approach, [bend, bends], [deep, deeps])?,
        };
        let depth = (first + last) / 2.0;
        let middle = self.object.centre + slot.along * place;
        let at = middle - approach * depth - across * self.hand.middle(slot.width);
        let tip = Isometry3::from_parts(Translation3::from(at), self.hand.turned(&approach, &across));
        let drift = DisplacementBound::none()
            .shifted(SLACK)
            .slid(slot.along * places)
            .slid(approach * ((last - first).abs() / 2.0));
        let drift = match slot.kind {
            FamilyKind::Flat { .. } => drift,
            // The bend is applied first, the turn about the object last.
            FamilyKind::Around { down, .. } => drift.spun(across, middle, bends).spun(down, middle, abouts),
            FamilyKind::End { down: axis, .. }
            | FamilyKind::Rim { across: axis, .. }
            | FamilyKind::Bar { along: axis, .. } => drift.spun(axis, middle, abouts),
        };
        Some((tip, drift))
    }

    /// Range of the tip's distance from the centre; `None` where the object is too far from the palm in all
    /// poses.
    fn depths(
        &self,
        slot: &GraspFamily,
        approach: &Vector3<f64>,
        [bend, bends]: [f64; 2],
        [deep, deeps]: [f64; 2],
    ) -> Option<(f64, f64)> {
        let [near, far] = self.extents(slot, approach, bend, bends);
        let HoldDepths { least, best, most } = slot.depths;
        // From the side as well as possible; from above, the finger tips may have to stay above the support.
        let first = if slot.is_top == Some(false) { best } else { least };
        let palm = |half: f64| (self.hand.palm + half).max(first);
        let (least, greatest) = (palm(near), palm(far).min(most));
        if least > most + SLACK {
            return None;
        }
        let mix = |from: f64, share: f64| from + (most - from) * share;
        Some((mix(least, (deep - deeps).max(0.0)), mix(greatest, (deep + deeps).min(1.0))))
    }

    /// Checks a predicate of a pose and its drift on all grasps, by subdivision. `false` where the patches
    /// run out before it is decided.
    pub(crate) fn are_all(&self, is: impl Fn(&Isometry3<f64>, &DisplacementBound) -> bool) -> bool {
        const MOST: usize = 4096;
        let mut open = self.patches();
        for _ in 0..MOST {
            let Some(patch) = open.pop() else { return true };
            let Some((tip, drift)) = self.over(&patch) else { continue };
            if !is(&tip, &drift) {
                let (_, across) = self.widest(&patch);
                open.extend(patch.halves(across));
            }
        }
        false
    }

    /// Grasp at the middle of a patch; `None` where it is no grasp, or from another side than requested.
    pub(crate) fn hold(&self, patch: &GraspPatch) -> Option<GraspCandidate> {
        let slot = self.slots.get(patch.slot)?;
        let [about, bend, ..] = patch.middle;
        let (approach, _) = slot.kind.directions(about, bend);
        let (map_from_tip, _) = self.over(&GraspPatch { half: [0.0; 4], ..*patch })?;
        let side = if approach.z < TOP { GraspSide::Top } else { GraspSide::Side };
        let is_asked_for = match self.side {
            None => true,
            Some(GraspSide::Top) => side == GraspSide::Top,
            Some(GraspSide::Side) => side != GraspSide::Top,
            Some(GraspSide::Front) => side != GraspSide::Top && is_ahead(&approach, self.ahead),
        };
        let middle = self.object.centre + slot.along * patch.middle.get(2).copied().unwrap_or_default();
        let hold = GraspCandidate {
            map_from_tip,
            approach,
            side,
            width: slot.width,
            depth: (middle - map_from_tip.translation.vector).dot(&approach),
            contact: slot.contact,
            push: Vector3::zeros(),
        };
        let is_permitted = |hold: &GraspCandidate| self.permits.is_none_or(|permits| permits(hold));
        (is_asked_for && approach.z <= 0.5).then_some(hold).filter(is_permitted)
    }

    /// Checks whether no pose of a patch is from the robot's side, where that is requested.
    fn is_behind(&self, slot: &GraspFamily, approach: &Vector3<f64>, off: f64) -> bool {
        let is_level = matches!(slot.kind, FamilyKind::Flat { .. })
            || matches!(slot.kind, FamilyKind::Around { down: axis, .. } | FamilyKind::Rim { across: axis,
                .. }
                if axis.z.abs() > 1.0 - 1e-9);
        let [x, y] = self.ahead;
        let angle = wrapped(atan2(approach.y, approach.x) - atan2(y, x));
        self.side == Some(GraspSide::Front) && is_level && angle.abs() > FRAC_PI_4 + off + SLACK
    }

    /// Range of the object's extent against the fingers.
    fn extents(&self, slot: &GraspFamily, approach: &Vector3<f64>, bend: f64, bends: f64) -> [f64; 2] {
        let flat = self.object.extent(approach);
        let radius = slot.width / 2.0;
        match slot.kind {
            FamilyKind::Flat { .. }
            | FamilyKind::Rim { .. }
            | FamilyKind::Bar { .. }
            | FamilyKind::End { is_round: false, .. } => [flat, flat],
            FamilyKind::End { .. } => [radius, radius],
            FamilyKind::Around { .. } => {
                let (half, is_flat) = match self.object.shape {
                    Shape::Cylinder { half, .. } => (half, true),
                    Shape::Capsule { half, .. } => (half, false),
                    Shape::Box(_) | Shape::HalfSpace => (0.0, false),
                };
                if half == 0.0 {
                    return [radius, radius];
                }
                let (low, high) = ((bend - bends).max(0.0), bend + bends);
                let (sin, cos) = (libm::sin, libm::cos);
                // A more bent hand meets the side later and the end sooner.
                let side = |bend: f64| radius / cos(bend).max(1e-6);
                let end = |bend: f64| half / sin(bend).max(1e-9);
                let whole = |bend: f64| half * sin(bend) + if is_flat { radius * cos(bend) } else { radius };
                let least = side(low).min(end(high)).min(whole(low)).min(whole(high));
                let greatest = side(high).min(end(low)).min(whole(bend) + (half + radius) * bends);
                [radius.max(least), radius.max(greatest)]
            }
        }
    }
}

impl FamilyKind {
    /// Approach and closing direction of the fingers.
    fn directions(&self, about: f64, bend: f64) -> (Vector3<f64>, Vector3<f64>) {
        match self {
            Self::Around { down, first, sign } => {
                let axis = if *sign > 0.0 { *down } else { -down };
                let out = turn(&Unit::new_unchecked(*down), about) * first;
                let (sin, cos) = sin_cos(bend);
                (down * sin - out * cos, axis.cross(&out))
            }
            Self::End { down, first, .. } => (*down, turn(&Unit::new_unchecked(*down), about) * first),
            Self::Rim { first, across } => (-(turn(&Unit::new_unchecked(*across), about) * first), *across),
            Self::Flat { approach, across } => (*approach, *across),
            Self::Bar { along, out, sign, .. } => {
                let approach = turn(&Unit::new_unchecked(*along), about) * -out;
                (approach, along.cross(&approach) * *sign)
            }
        }
    }
}

/// Largest of some sizes, the first of equals, with its index.
pub(crate) fn widest(sizes: &[f64]) -> (f64, usize) {
    let all = sizes.iter().copied().zip(0..);
    all.fold((0.0, 0), |most, next| if next.0 > most.0 { next } else { most })
}

impl GraspPatch {
    /// Halves of a patch across one parameter.
    pub(crate) fn halves(&self, across: usize) -> [Self; 2] {
        let mut halves = [*self; 2];
        for (half, sign) in halves.iter_mut().zip([-0.5, 0.5]) {
            if let (Some(middle), Some(side)) = (half.middle.get_mut(across), half.half.get_mut(across)) {
                *middle += sign * *side;
                *side = 0.5 * *side + 1e-12;
            }
        }
        halves
    }
}
