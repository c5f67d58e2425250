//! Inverse kinematics of any chain: Levenberg–Marquardt within the limits, from a start and then from seeds of a
//! low-discrepancy sequence. It finds one solution or none, and that it finds none proves nothing.

use nalgebra::{Isometry3, Vector3};

use super::Tolerance;
use crate::kinematics::{KinematicChain, quasi_random};
use crate::trigonometry::{rotation_vector, turn};

/// How long to look.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NumericSettings {
    /// Starts, the given one included.
    pub starts: usize,
    /// Steps from one start.
    pub steps: usize,
    /// When it is found.
    pub tolerance: Tolerance,
}

impl Default for NumericSettings {
    fn default() -> Self {
        Self { starts: 100, steps: 60, tolerance: Tolerance::EXACT }
    }
}

/// Values of the chain's variables, within the limits, that put the tip at the pose; `None` where none was found.
/// The first start is `from`; the next are spread over the limits. O(starts × steps × joints).
#[must_use]
pub fn solve(
    chain: &KinematicChain,
    base_from_tip: &Isometry3<f64>,
    from: &[f64],
    settings: NumericSettings,
) -> Option<Vec<f64>> {
    let spread = (1..settings.starts).map(|index| quasi_random(&chain.dofs, index));
    std::iter::once(from.to_vec())
        .chain(spread)
        .find_map(|start| refined(chain, base_from_tip, &start, settings.steps, settings.tolerance))
}

/// The same from one start only.
#[must_use]
pub fn refined(
    chain: &KinematicChain,
    base_from_tip: &Isometry3<f64>,
    from: &[f64],
    steps: usize,
    tolerance: Tolerance,
) -> Option<Vec<f64>> {
    let mut values = from.to_vec();
    values.resize(chain.dofs.len(), 0.0);
    clamp(chain, &mut values);
    let (mut placed, mut after) = (ChainState::default(), ChainState::default());
    placed.set(chain, base_from_tip, &values);
    let mut columns = placed.jacobian(chain);
    let mut damping = 1e-3;
    for _ in 0..steps {
        if is_within(&placed.error, tolerance) {
            return Some(values);
        }
        let next = step(chain, &values, &columns, &placed.error, damping)?;
        after.set(chain, base_from_tip, &next);
        if squared(&after.error) < squared(&placed.error) {
            values = next;
            std::mem::swap(&mut placed, &mut after);
            columns = placed.jacobian(chain);
            damping = (damping * 0.2).max(1e-12);
        } else {
            damping *= 8.0;
            if damping > 1e6 {
                return None;
            }
        }
    }
    is_within(&placed.error, tolerance).then_some(values)
}

/// A solution of a closed form as it is where forward kinematics confirms it; a URDF whose axes are rounded needs a step or two.
pub(super) fn polished<const N: usize>(
    chain: &KinematicChain,
    values: [f64; N],
    base_from_tip: &Isometry3<f64>,
) -> Option<[f64; N]> {
    if Tolerance::EXACT.covers(&chain.base_from_tip(&values), base_from_tip) {
        return Some(values);
    }
    refined(chain, base_from_tip, &values, 4, Tolerance::EXACT)?.try_into().ok()
}

/// Metres, then a rotation vector in rad: in the base's frame.
type Twist = [f64; 6];

fn squared(twist: &Twist) -> f64 {
    twist.iter().map(|value| value * value).sum()
}

fn is_within([x, y, z, a, b, c]: &Twist, tolerance: Tolerance) -> bool {
    (x * x + y * y + z * z).sqrt() <= tolerance.position && (a * a + b * b + c * c).sqrt() <= tolerance.angle
}

/// A chain with its variables at some values.
#[derive(Default)]
struct ChainState {
    /// For each joint its axis, as long as its position changes with its variable, and where it is.
    axes: Vec<[Vector3<f64>; 2]>,
    tip: Vector3<f64>,
    /// What is missing to the pose that is wanted.
    error: Twist,
}

impl ChainState {
    fn set(&mut self, chain: &KinematicChain, wanted: &Isometry3<f64>, values: &[f64]) {
        self.axes.clear();
        let mut pose = Isometry3::identity();
        for joint in &chain.joints {
            pose *= joint.before;
            let axis = pose.rotation * joint.axis.into_inner() * joint.coupling.multiplier;
            self.axes.push([axis, pose.translation.vector]);
            let position = joint.coupling.position(values);
            if joint.is_prismatic {
                pose *= joint.motion(position);
            } else {
                pose.rotation *= turn(&joint.axis, position);
            }
        }
        pose *= chain.last_from_tip;
        self.tip = pose.translation.vector;
        let shift = wanted.translation.vector - self.tip;
        let turn = rotation_vector(&(wanted.rotation * pose.rotation.inverse()));
        self.error = [shift.x, shift.y, shift.z, turn.x, turn.y, turn.z];
    }

    /// For each variable how the tip moves with it: velocity, then angular velocity.
    fn jacobian(&self, chain: &KinematicChain) -> Vec<Twist> {
        let mut columns = vec![[0.0; 6]; chain.dofs.len()];
        for (joint, [axis, at]) in chain.joints.iter().zip(&self.axes) {
            let (arm, turn) = match joint.is_prismatic {
                true => (*axis, Vector3::zeros()),
                false => (axis.cross(&(self.tip - at)), *axis),
            };
            if let Some(column) = columns.get_mut(joint.coupling.dof) {
                let more = [arm.x, arm.y, arm.z, turn.x, turn.y, turn.z];
                column.iter_mut().zip(more).for_each(|(slot, more)| *slot += more);
            }
        }
        columns
    }
}

/// The damped step `Jᵀ (J Jᵀ + damping)⁻¹ error`, within the limits. A variable that stands at a limit and would be
/// pushed beyond is held, and the others share its part.
fn step(
    chain: &KinematicChain,
    values: &[f64],
    columns: &[Twist],
    error: &Twist,
    damping: f64,
) -> Option<Vec<f64>> {
    let mut held = vec![false; values.len()];
    // Every round holds one variable more, or is the last.
    for _ in 0..=values.len() {
        let mut normal = [[0.0; 6]; 6];
        for (column, _) in columns.iter().zip(&held).filter(|(_, held)| !**held) {
            for (row, a) in normal.iter_mut().zip(column) {
                row.iter_mut().zip(column).for_each(|(slot, b)| *slot += a * b);
            }
        }
        for (at, row) in normal.iter_mut().enumerate() {
            if let Some(slot) = row.get_mut(at) {
                *slot += damping;
            }
        }
        let pull = solved(normal, *error)?;
        let mut next = values.to_vec();
        let mut again = false;
        for ((((value, column), held), dof), before) in
            next.iter_mut().zip(columns).zip(&mut held).zip(&chain.dofs).zip(values)
        {
            if *held {
                continue;
            }
            let change: f64 = column.iter().zip(&pull).map(|(a, b)| a * b).sum();
            *value += change;
            let at_limit = |(lower, upper): (f64, f64)| {
                (*before <= lower && change < 0.0) || (*before >= upper && change > 0.0)
            };
            if dof.limits.is_some_and(at_limit) {
                (*held, again) = (true, true);
            }
        }
        if !again {
            clamp(chain, &mut next);
            return Some(next);
        }
    }
    None
}

fn clamp(chain: &KinematicChain, values: &mut [f64]) {
    for (value, dof) in values.iter_mut().zip(&chain.dofs) {
        if let Some((lower, upper)) = dof.limits {
            *value = value.clamp(lower, upper);
        }
    }
}

/// Solves a symmetric positive definite system of six equations by elimination; `None` where it is singular. Written
/// out because a library's may fuse products with sums on some machines.
fn solved(mut rows: [[f64; 6]; 6], mut right: [f64; 6]) -> Option<[f64; 6]> {
    for pivot in 0..6 {
        let top = *rows.get(pivot)?;
        let (first, value) = (*top.get(pivot)?, *right.get(pivot)?);
        if first.is_nan() || first <= 0.0 {
            return None;
        }
        for (row, slot) in rows.iter_mut().zip(&mut right).skip(pivot + 1) {
            let factor = row.get(pivot)? / first;
            // What stands before the pivot is not looked at again.
            row.iter_mut().zip(&top).for_each(|(entry, above)| *entry -= factor * above);
            *slot -= factor * value;
        }
    }
    let mut solution = [0.0; 6];
    for at in (0..6).rev() {
        let row = rows.get(at)?;
        let known: f64 = row.iter().zip(&solution).skip(at + 1).map(|(a, b)| a * b).sum();
        let value = (right.get(at)? - known) / row.get(at)?;
        *solution.get_mut(at)? = value;
    }
    Some(solution)
}
