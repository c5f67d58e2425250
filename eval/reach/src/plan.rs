//! Inverse kinematics of the whole robot from starts at random (Levenberg 1944), and RRT-Connect (Kuffner and
//! LaValle 2000) over base and arm with sampled edges.

use motet_geometry::planning::Configuration;
use nalgebra::{Isometry3, SMatrix, SVector};
use rand_xoshiro::SplitMix64;

use crate::chance::Chance;
use crate::model::{Model, Tip};
use crate::scenery::Scenery;

/// Distance in m that a state keeps from everything: as much as the query does.
pub(crate) const GAP: f64 = 0.002;

/// The state near another that puts the tip at a pose, within the limits; the base moves where it can and
/// `drives`.
pub(crate) fn solve(
    model: &Model,
    wanted: &Isometry3<f64>,
    from: &Configuration,
    drives: bool,
) -> Option<Configuration> {
    let mut state = from.clone();
    let dofs = model.machine.tree().dofs();
    let gap = |state: &Configuration| {
        let Tip { pose, bases, columns } = model.tip(state);
        let shift = wanted.translation.vector - pose.translation.vector;
        let turn = (wanted.rotation * pose.rotation.inverse()).scaled_axis();
        (SVector::<f64, 6>::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z), bases, columns)
    };
    let (mut error, mut bases, mut columns) = gap(&state);
    let mut damping = 1e-3;
    for _ in 0..40 {
        if error.norm() < 1e-9 {
            return Some(state);
        }
        let mut normal = SMatrix::<f64, 6, 6>::identity() * damping;
        let all = bases.iter().filter(|_| drives).chain(columns.iter().map(|(_, column)| column));
        for column in all {
            let column = SVector::<f64, 6>::from_column_slice(column);
            normal += column * column.transpose();
        }
        let pull = normal.cholesky()?.solve(&error);
        let amount = |column: &[f64; 6]| SVector::<f64, 6>::from_column_slice(column).dot(&pull);
        let mut next = state.clone();
        if drives {
            for (value, column) in next.base.iter_mut().zip(&bases) {
                *value += amount(column);
            }
        }
        for (at, column) in &columns {
            next.joints[*at] += amount(column);
            if let Some((lower, upper)) = dofs[*at].limits {
                next.joints[*at] = next.joints[*at].clamp(lower, upper);
            }
        }
        let after = gap(&next);
        if after.0.norm() < error.norm() {
            state = next;
            (error, bases, columns) = after;
            damping = (damping * 0.3).max(1e-12);
        } else {
            damping *= 6.0;
            if damping > 1e4 {
                return None;
            }
        }
    }
    None
}

/// A state with what moves the tip at random; the base in a disc about a point.
pub(crate) fn scatter(
    model: &Model,
    like: &Configuration,
    about: [f64; 2],
    far: f64,
    chance: &mut SplitMix64,
) -> Configuration {
    let mut state = like.clone();
    for dof in model.movable() {
        match dof {
            None => {
                let (sin, cos) = chance.between(-std::f64::consts::PI, std::f64::consts::PI).sin_cos();
                let out = far * chance.unit().sqrt();
                let yaw = chance.between(-std::f64::consts::PI, std::f64::consts::PI);
                state.base = [about[0] + cos * out, about[1] + sin * out, yaw];
            }
            Some(at) => {
                let pi = std::f64::consts::PI;
                let (lower, upper) = model.machine.tree().dofs()[at].limits.unwrap_or((-pi, pi));
                state.joints[at] = chance.between(lower.max(-2.0 * pi), upper.min(2.0 * pi));
            }
        }
    }
    state
}

/// True if the straight way between two states is free at samples so many m or rad apart.
pub(crate) fn is_free(
    model: &Model,
    scenery: &Scenery,
    from: &Configuration,
    to: &Configuration,
    apart: f64,
    exempt: Option<usize>,
) -> bool {
    let steps = (size(from, to) / apart).ceil().max(1.0) as usize;
    // Coarse to fine: what is met is met soon.
    let mut stride = steps.next_power_of_two();
    let mut is_first = true;
    while stride > 0 {
        let mut at = if is_first { 0 } else { stride };
        while at <= steps {
            let state = from.towards(to, at as f64 / steps as f64);
            if scenery.touch(model, &state, exempt, GAP).is_some() {
                return false;
            }
            at += if is_first { stride } else { 2 * stride };
        }
        is_first = false;
        stride /= 2;
    }
    scenery.touch(model, to, exempt, GAP).is_none()
}

/// The largest change: m of the base, rad of its yaw and of joints.
fn size(from: &Configuration, to: &Configuration) -> f64 {
    let drive = (to.base[0] - from.base[0]).hypot(to.base[1] - from.base[1]);
    let joints = from.joints.iter().zip(&to.joints).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    drive.max((to.base[2] - from.base[2]).abs() * 0.5).max(joints * 0.5)
}

fn metric(from: &Configuration, to: &Configuration) -> f64 {
    let square = |a: f64| a * a;
    let drive = square(to.base[0] - from.base[0]) + square(to.base[1] - from.base[1]);
    let joints: f64 = from.joints.iter().zip(&to.joints).map(|(a, b)| square(a - b)).sum();
    (drive + 0.1 * square(to.base[2] - from.base[2]) + 0.1 * joints).sqrt()
}

/// The heap entry of a search: a node with its cost.
pub(crate) struct Search<'a> {
    pub(crate) model: &'a Model,
    pub(crate) scenery: &'a Scenery,
    /// Extensions of a tree.
    pub(crate) steps: usize,
    /// Samples of edges are so far apart, in m.
    pub(crate) apart: f64,
}

impl Search<'_> {
    /// True if a way leads from one state to another. Both are free. The hand may be open in one and not in
    /// the other: in between it is like in either, and opens or closes on the way.
    pub(crate) fn connects(
        &self,
        start: &Configuration,
        goal: &Configuration,
        chance: &mut SplitMix64,
    ) -> bool {
        let free =
            |a: &Configuration, b: &Configuration| is_free(self.model, self.scenery, a, b, self.apart, None);
        if free(start, goal) {
            return true;
        }
        let middle = [(start.base[0] + goal.base[0]) / 2.0, (start.base[1] + goal.base[1]) / 2.0];
        let far = (goal.base[0] - start.base[0]).hypot(goal.base[1] - start.base[1]) / 2.0 + 1.0;
        let mut trees = [vec![(start.clone(), 0)], vec![(goal.clone(), 0)]];
        for step in 0..self.steps {
            let side = step % 2;
            let like = if chance.is(0.5) { start } else { goal };
            let mut aim = scatter(self.model, like, middle, far, chance);
            // The arm as at one end, half of the time: in the open it need not move.
            if chance.is(0.5) && self.model.machine.drives() {
                aim.joints.clone_from(if chance.is(0.5) { &start.joints } else { &goal.joints });
            }
            let Some(new) = self.extend(&mut trees[side], &aim, 0.4) else { continue };
            // The other tree goes towards it as far as it can.
            while let Some(next) = self.extend(&mut trees[1 - side], &new, 0.4) {
                if metric(&next, &new) < 1e-9 {
                    return true;
                }
            }
        }
        false
    }

    fn extend(
        &self,
        tree: &mut Vec<(Configuration, usize)>,
        aim: &Configuration,
        step: f64,
    ) -> Option<Configuration> {
        let distance = |known: &(Configuration, usize)| metric(&known.0, aim);
        let near = (0..tree.len()).min_by(|a, b| distance(&tree[*a]).total_cmp(&distance(&tree[*b])))?;
        let far = metric(&tree[near].0, aim);
        if far < 1e-9 {
            return None;
        }
        let next = if far <= step { aim.clone() } else { tree[near].0.towards(aim, step / far) };
        if !is_free(self.model, self.scenery, &tree[near].0, &next, self.apart, None) {
            return None;
        }
        tree.push((next.clone(), near));
        Some(next)
    }
}
