//! Eight states of a robot at a time, in `f32`: which pairs of solids are apart for certain.
//!
//! A [`BatchModel`] is a robot of which some joints move, made once for a room; [`Obb`]s are what stands around. [`BatchCheck`] places the
//! robot in [`Batch8`] states and hands over the pairs that it cannot tell to be apart, with those states in which they touch for certain;
//! the others are looked at again in `f64`. So it takes work away and decides only what is farther from open than it may be off.
//!
//! **Rounding.** The base is no farther than [`FAR`] m from the origin along either side, no part farther than [`LONG`] m from the base,
//! and no joint further than [`TURNS`] rad from 0; else nothing is said. An angle is off by 5e-7 rad as it is rounded, its sine by 2e-7
//! more, and an entry of a rotation by 1.1e-6 after its three products and sums; a product of two rotations adds 3e-7. So a joint
//! adds less than [`TURNED`], three times as much as an entry, to how far any direction is off, and [`MOVED`] for the sums of places
//! below 8 m. These are added up along the chain of each part ([`batch_model::BatchPart::slack`]), so that the bound grows with the lengths
//! in between: 1e-5 m to 6e-5 m for arms. It is taken off every distance twice for each part, once for how far it goes, as
//! is [`TOLD`] for the distance itself. A velocity is off by that for each rad that the joints turn, which is added to it ([`motion`]).

mod aabb;
mod batch_check;
mod batch_model;
mod lanes;
mod motion;
mod pair_check;
mod posed_batch;
mod separation;

pub(crate) use batch_check::{BatchCheck, BatchPair, NearPair, PairTarget};
pub(crate) use batch_model::{Batch8, BatchModel};
pub(crate) use obb::{Obb, ObbSet};
pub(crate) use posed_batch::PosedBatch;

mod obb;
mod self_pairs;
#[cfg(test)]
mod tests;

/// How far from the origin of a neighbourhood the base may be, in m along either side.
const FAR: f64 = 3.0;
/// How far from the base any part may be, in m.
const LONG: f64 = 4.0;
/// The greatest position of a joint, in rad or m.
const TURNS: f64 = 7.0;
/// How much a joint adds to how far a direction is off.
const TURNED: f64 = 4.5e-6;
/// How much a joint adds to how far a place is off, in m.
const MOVED: f64 = 2e-6;
/// How far the distance between two solids may be off, in m.
const TOLD: f32 = 1e-5;
/// How much nearer than wanted two solids have to be to count as near for certain, beside what may be off of parts, in m: a tenth of
/// a millimetre, which is more than what a thing is rounded by ([`obb::Obb::is_exact`]).
const SURE: f32 = 1e-4;
