//! Batch collision checks: eight configurations at a time in `f32`, to find the pairs of solids that are
//! certainly apart.
//!
//! A [`BatchModel`] is a robot with some joints free, built once for a planning scene; [`Obb`]s are the
//! obstacles. A [`BatchCheck`] places the robot in a [`Batch8`] of configurations and returns the pairs that
//! are not certainly apart, with the configurations in which they certainly touch; the others are checked
//! again in `f64`. So it saves work and decides only cases that are clearer than its own error.
//!
//! **Rounding.** The base is at most [`FAR`] m from the origin along either axis, every part at most [`LONG`]
//! m from the base, and every joint at most [`TURNS`] rad from 0; otherwise nothing is decided. An angle is
//! off by 5e-7 rad as it is rounded, its sine by 2e-7 more, and an entry of a rotation by 1.1e-6 after its
//! three products and sums; a product of two rotations adds 3e-7. So a joint adds less than [`TURNED`], three
//! times as much as an entry, to the error of any direction, and [`MOVED`] for the sums of places below 8 m.
//! These add up along the chain of each part ([`batch_model::BatchPart::slack`]), so the bound grows with the
//! lengths in between: 1e-5 m to 6e-5 m for arms. Every distance is reduced by it twice for each part, once
//! for its motion, and by [`TOLD`] for the distance itself. A velocity is off by that for each rad of joint
//! rotation, which is added to it ([`separation`]).

mod batch_check;
mod batch_model;
mod boxes;
mod lanes;
mod pair_check;
mod posed_batch;
mod separation;

pub(crate) use batch_check::{BatchCheck, BatchPair, NearPair, PairTarget};
pub(crate) use batch_model::{Batch8, BatchModel};
pub(crate) use boxes::{Obb, ObbSet};
pub(crate) use posed_batch::PosedBatch;

#[cfg(test)]
mod tests;

/// Greatest distance of the base from the origin of a neighbourhood, in m along either axis.
const FAR: f64 = 3.0;
/// Greatest distance of any part from the base, in m.
const LONG: f64 = 4.0;
/// Greatest position of a joint, in rad or m.
const TURNS: f64 = 7.0;
/// Error that a joint adds to a direction.
const TURNED: f64 = 4.5e-6;
/// Error that a joint adds to a place, in m.
const MOVED: f64 = 2e-6;
/// Error of the distance between two solids, in m.
const TOLD: f32 = 1e-5;
/// Depth below the required distance, beside the error of the parts, from which two solids certainly touch,
/// in m: a tenth of a millimetre, more than the rounding of an obstacle ([`boxes::Obb::is_exact`]).
const SURE: f32 = 1e-4;
