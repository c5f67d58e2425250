//! Cells of a [`SevenArm`] on a base that stands still: by the position of the last joint, for each way to hold the elbow, the wrist
//! and the shoulder.
//!
//! The last joint leaves the wrist's centre and the hand's side of the wrist. The distance of that from the shoulder is the elbow's
//! angle, and so how far the fifth axis leans from the line between both; where on the circle square to the sixth axis it then is gives
//! the sixth joint. Both directions turn the shoulder. What each can be off follows from what those before it can, by the law of cosines
//! and by how far a direction turns about an axis that it leans away from.

use std::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Isometry3, Point3, Unit, Vector3};

use super::{
    CellEnclosure, DisplacementBound, IkCell, IntervalSolution, PoseSet, azimuth, dof_intervals, frames,
    wrist_interval,
};
use crate::inverse::SevenArm;
use crate::inverse::seven_arm::between;
use crate::inverse::subproblem::{angle_between, turned};
use crate::trigonometry::{acos, atan2, turn};

/// What rounding may take of a length or a cosine.
const ROUNDED: f64 = 1e-7;

impl SevenArm {
    /// Cells that hold all solutions.
    pub(crate) fn cells(&self) -> Vec<IkCell> {
        let (lower, upper) = self.last_span();
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0);
        (0..8).map(|branch| IkCell { branch, middle: [middle, 0.0, 0.0], half: [half, 0.0, 0.0] }).collect()
    }

    /// How far something goes for a change of each parameter of a cell, about, in m.
    pub(crate) fn weights(&self) -> [f64; 3] {
        [0.5 * (self.wrist - self.shoulder).norm(), 0.0, 0.0]
    }

    /// What is known of a cell, with the base at a pose.
    pub(crate) fn enclose(
        &self,
        tips: &PoseSet,
        map_from_base: &Isometry3<f64>,
        base: [f64; 3],
        cell: &IkCell,
    ) -> IntervalSolution {
        let [h1, h2, h3, h4, h5, h6, h7] = &self.axes;
        let ([value, ..], [values, ..]) = (cell.middle, cell.half);
        let Some(joint) = self.chain.joints.last() else { return IntervalSolution::Unknown };
        let last = joint.coupling.multiplier * value + joint.coupling.offset;
        let lasts = values * joint.coupling.multiplier.abs();
        let base_from_tip = map_from_base.inverse() * tips.map_from_tip;
        let moved = base_from_tip * self.base_from_tip.inverse();
        let back = turn(&Unit::new_unchecked(*h7), -last);
        let rotation = moved.rotation * back;
        let reached_at =
            moved.rotation * (self.last + back * (self.wrist - self.last)) + moved.translation.vector;
        let wrist_in_map = (map_from_base * Point3::from(reached_at)).coords;
        // The wrist turns about the last axis, and goes where the tip does.
        let swing = h7.cross(&(self.wrist - self.last)).norm() * lasts.min(2.0);
        let moves = swing + tips.displacement.point(&wrist_in_map, swing) + ROUNDED;
        let tilts = lasts + tips.displacement.angle();

        // The elbow.
        let reached = reached_at - self.shoulder;
        let (upper, fore) = (self.shoulder - self.elbow, self.wrist - self.elbow);
        let (long, one, two) = (reached.norm(), upper.norm(), fore.norm());
        let (near, far) = ((long - moves).max(0.0), long + moves);
        if near > one + two + ROUNDED || far < (one - two).abs() - ROUNDED {
            return IntervalSolution::Empty;
        }
        let bent =
            |long: f64| acos(((one * one + two * two - long * long) / (2.0 * one * two)).clamp(-1.0, 1.0));
        let (least, greatest) = (bent(near), bent(far));
        let straight = atan2(upper.dot(&h4.cross(&fore)), upper.dot(&fore));
        let sign = if cell.branch & 1 == 0 { 1.0 } else { -1.0 };
        let (q4, fourth) = (straight + sign * (least + greatest) / 2.0, (greatest - least) / 2.0 + ROUNDED);
        let to_wrist = turned(h4, q4, &fore) - upper;
        let leaning = turned(h4, q4, h5);
        // How fast the fifth axis leans from the line to the wrist, and how fast that turns, at most, while the elbow does.
        let rates = [near, far].map(|long| {
            let share = (two * two - one * one) / (2.0 * long * long);
            [(0.5 - share).abs(), (0.5 + share).abs()]
        });
        let [lean_rate, line_rate] = [0, 1].map(|at: usize| {
            let all = rates.iter().filter_map(|rates| rates.get(at));
            all.copied().fold(0.0, f64::max)
        });
        let lean = atan2(h4.dot(&to_wrist.cross(&leaning)), to_wrist.dot(&leaning)).abs();
        let leans = if near < 1e-3 { PI } else { lean_rate * fourth + ROUNDED };
        let is_to_one_side = lean - leans > 0.0 && lean + leans < PI;

        // The sixth joint.
        let points = if moves < long { libm::asin(moves / long) } else { PI };
        let seen = rotation.inverse() * reached / long;
        let polar = acos(h6.dot(&seen));
        let off = points + tilts;
        let [low, high] = [polar - off, polar + off].map(|angle| angle.clamp(0.0, PI));
        let sines = [low, high].map(libm::sin);
        let sin_low = sines.into_iter().fold(1.0, f64::min);
        let is_across = low <= FRAC_PI_2 && high >= FRAC_PI_2;
        let sin_high = if is_across { 1.0 } else { sines.into_iter().fold(0.0, f64::max) };
        let cosines = [(lean + leans).min(PI), (lean - leans).max(0.0)].map(libm::cos);
        let (mut alo, mut ahi) = (0.0, PI);
        if sin_low > 1e-6 {
            let all = cosines.iter().flat_map(|cos| [cos / sin_low, cos / sin_high]);
            let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), next| {
                (f64::min(least, next), f64::max(most, next))
            });
            if least > 1.0 + ROUNDED || most < -1.0 - ROUNDED {
                return IntervalSolution::Empty;
            }
            (alo, ahi) = (acos(most.clamp(-1.0, 1.0)), acos(least.clamp(-1.0, 1.0)));
        }
        let ahead = atan2(seen.dot(&h6.cross(h5)), seen.dot(h5));
        let sign = if cell.branch & 2 == 0 { 1.0 } else { -1.0 };
        let q6 = -(ahead + sign * (alo + ahi) / 2.0);
        let sixth = ((ahi - alo) / 2.0 + azimuth(polar, off) + ROUNDED).min(PI);

        // The shoulder, and the fifth joint between.
        let fifth = rotation * turned(h6, -q6, h5);
        let shoulder = between([&to_wrist, &leaning], [&reached, &fifth]);
        let is_to_one_side = is_to_one_side && shoulder.is_some();
        let shoulder = shoulder.unwrap_or_default();
        let aside = acos(reached.dot(&fifth) / long);
        let about = azimuth(aside, (points + tilts + sixth).min(PI));
        let turns = if is_to_one_side { points + about + line_rate * fourth } else { PI };
        let turns = (turns + ROUNDED).min(PI);
        let upper_end = shoulder * turn(&Unit::new_unchecked(*h4), q4);
        let rest = upper_end.inverse() * rotation * turn(&Unit::new_unchecked(*h6), -q6);
        let square = rest * h6;
        let q5 = angle_between(h5, h6, &square);
        let fifths = azimuth(acos(h5.dot(&square)), (turns + fourth + tilts + sixth).min(PI));
        let Some([first, second, third]) =
            wrist_interval(&[*h1, *h2, *h3], &shoulder, turns, cell.branch >> 2)
        else {
            return IntervalSolution::Unknown;
        };
        let positions = [first, second, third, [q4, fourth], [q5, fifths], [q6, sixth], [last, lasts]];
        let Some(known) = dof_intervals(&self.chain, &positions, tips.is_any) else {
            return IntervalSolution::Empty;
        };

        // From the base up to the forearm, from the tip down to the wrist.
        let mut placed = frames(&self.chain, *map_from_base, &known);
        let mut end = tips.map_from_tip * self.chain.last_from_tip.inverse();
        for ((slot, joint), [position, _]) in
            placed.iter_mut().zip(&self.chain.joints).zip(positions).rev().take(3)
        {
            *slot = end;
            end *= (joint.before * joint.motion(position)).inverse();
        }
        let in_map = |point: &Vector3<f64>| (map_from_base * Point3::from(*point)).coords;
        let at = in_map(&self.shoulder);
        let elbow = in_map(&(self.shoulder + shoulder * (self.elbow - self.shoulder)));
        let axis = |at: usize| {
            let found = self.chain.joints.get(at).zip(placed.get(at));
            found.map_or(Vector3::z(), |(joint, pose)| pose * joint.axis.into_inner())
        };
        let displacements = [
            DisplacementBound::none().spun(axis(0), at, first[1]),
            DisplacementBound::none().spun(axis(1), at, second[1]).spun(axis(0), at, first[1]),
            DisplacementBound::none().turned(at, turns),
            DisplacementBound::none().turned(elbow, turns + fourth).shifted(turns.min(2.0) * one),
            DisplacementBound::none()
                .turned(wrist_in_map, tilts)
                .spun(axis(5), wrist_in_map, sixth)
                .shifted(moves),
            DisplacementBound::none().turned(wrist_in_map, tilts).shifted(moves),
            tips.displacement,
        ];
        IntervalSolution::Enclosed(Box::new(CellEnclosure {
            base,
            base_displacement: DisplacementBound::none(),
            frames: placed.into_iter().zip(displacements).collect(),
            values: known,
            short: [0.0; 2],
            is_joined: false,
        }))
    }
}
