//! Inverse kinematics of any chain: Levenberg–Marquardt within the limits, from a start and then from seeds of a
//! low-discrepancy sequence. It finds one solution or none, and that it finds none proves nothing.

use nalgebra::{Isometry3, Vector6};

use super::Tolerance;
use crate::kinematics::{Chain, spread};
use crate::trigonometry::rotation_vector;

/// How long to look.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Settings {
    /// Starts, the given one included.
    pub starts: usize,
    /// Steps from one start.
    pub steps: usize,
    /// When it is found.
    pub tolerance: Tolerance,
}

impl Default for Settings {
    fn default() -> Self {
        Self { starts: 100, steps: 60, tolerance: Tolerance::EXACT }
    }
}

/// Values of the chain's variables, within the limits, that put the tip at the pose; `None` where none was found.
/// The first start is `from`; the next are spread over the limits. O(starts × steps × joints).
#[must_use]
pub fn solve(
    chain: &Chain,
    base_from_tip: &Isometry3<f64>,
    from: &[f64],
    settings: Settings,
) -> Option<Vec<f64>> {
    let spread = (1..settings.starts).map(|index| spread(&chain.variables, index));
    std::iter::once(from.to_vec())
        .chain(spread)
        .find_map(|start| refined(chain, base_from_tip, &start, settings.steps, settings.tolerance))
}

/// The same from one start only.
#[must_use]
pub fn refined(
    chain: &Chain,
    base_from_tip: &Isometry3<f64>,
    from: &[f64],
    steps: usize,
    tolerance: Tolerance,
) -> Option<Vec<f64>> {
    let mut values = from.to_vec();
    values.resize(chain.variables.len(), 0.0);
    clamp(chain, &mut values);
    let mut error = gap(chain, base_from_tip, &values);
    let mut damping = 1e-3;
    for _ in 0..steps {
        if is_within(&error, tolerance) {
            return Some(values);
        }
        let columns = jacobian(chain, &values);
        let next = step(chain, &values, &columns, &error, damping)?;
        let after = gap(chain, base_from_tip, &next);
        if after.norm_squared() < error.norm_squared() {
            (values, error) = (next, after);
            damping = (damping * 0.2).max(1e-12);
        } else {
            damping *= 8.0;
            if damping > 1e6 {
                return None;
            }
        }
    }
    is_within(&error, tolerance).then_some(values)
}

/// A solution of a closed form as it is where forward kinematics confirms it; a URDF whose axes are rounded needs a step or two.
pub(super) fn polished<const N: usize>(
    chain: &Chain,
    values: [f64; N],
    base_from_tip: &Isometry3<f64>,
) -> Option<[f64; N]> {
    if Tolerance::EXACT.covers(&chain.base_from_tip(&values), base_from_tip) {
        return Some(values);
    }
    refined(chain, base_from_tip, &values, 4, Tolerance::EXACT)?.try_into().ok()
}

fn is_within(error: &Vector6<f64>, tolerance: Tolerance) -> bool {
    let [x, y, z, a, b, c] = error.data.0[0];
    (x * x + y * y + z * z).sqrt() <= tolerance.position && (a * a + b * b + c * c).sqrt() <= tolerance.angle
}

/// What is missing, in the base's frame: metres, then a rotation vector in rad.
fn gap(chain: &Chain, wanted: &Isometry3<f64>, values: &[f64]) -> Vector6<f64> {
    let pose = chain.base_from_tip(values);
    let shift = wanted.translation.vector - pose.translation.vector;
    let turn = rotation_vector(&(wanted.rotation * pose.rotation.inverse()));
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

/// For each variable how the tip moves with it: velocity, then angular velocity, in the base's frame.
fn jacobian(chain: &Chain, values: &[f64]) -> Vec<Vector6<f64>> {
    let tip = chain.base_from_tip(values).translation.vector;
    let mut columns = vec![Vector6::zeros(); chain.variables.len()];
    let mut pose = Isometry3::identity();
    for joint in &chain.joints {
        pose *= joint.before;
        let axis = pose * joint.axis.into_inner() * joint.driver.multiplier;
        let arm = if joint.slides { axis } else { axis.cross(&(tip - pose.translation.vector)) };
        let turn = if joint.slides { nalgebra::Vector3::zeros() } else { axis };
        if let Some(column) = columns.get_mut(joint.driver.variable) {
            *column += Vector6::new(arm.x, arm.y, arm.z, turn.x, turn.y, turn.z);
        }
        pose *= joint.motion(joint.driver.position(values));
    }
    columns
}

/// The damped step `Jᵀ (J Jᵀ + damping)⁻¹ error`, within the limits. A variable that stands at a limit and would be
/// pushed beyond is held, and the others share its part.
fn step(
    chain: &Chain,
    values: &[f64],
    columns: &[Vector6<f64>],
    error: &Vector6<f64>,
    damping: f64,
) -> Option<Vec<f64>> {
    let mut held = vec![false; values.len()];
    // Every round holds one variable more, or is the last.
    for _ in 0..=values.len() {
        let mut normal = [[0.0; 6]; 6];
        for (column, _) in columns.iter().zip(&held).filter(|(_, held)| !**held) {
            for (row, a) in normal.iter_mut().zip(column) {
                for (slot, b) in row.iter_mut().zip(column) {
                    *slot += a * b;
                }
            }
        }
        for (at, row) in normal.iter_mut().enumerate() {
            if let Some(slot) = row.get_mut(at) {
                *slot += damping;
            }
        }
        let pull = solved(normal, error.data.0[0])?;
        let mut next = values.to_vec();
        let mut again = false;
        for ((((value, column), held), variable), before) in
            next.iter_mut().zip(columns).zip(&mut held).zip(&chain.variables).zip(values)
        {
            if *held {
                continue;
            }
            let change: f64 = column.iter().zip(&pull).map(|(a, b)| a * b).sum();
            *value += change;
            let at_limit = |(lower, upper): (f64, f64)| {
                (*before <= lower && change < 0.0) || (*before >= upper && change > 0.0)
            };
            if variable.limits.is_some_and(at_limit) {
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

fn clamp(chain: &Chain, values: &mut [f64]) {
    for (value, variable) in values.iter_mut().zip(&chain.variables) {
        if let Some((lower, upper)) = variable.limits {
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
            for (entry, above) in row.iter_mut().zip(&top).skip(pivot) {
                *entry -= factor * above;
            }
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
