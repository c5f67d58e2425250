//! The geometry of robots: where their links are, which joint positions put a hand somewhere, how far they
//! are from what
//! stands around, and which motions there are among it.
//!
//! It takes the URDFs that `motet-robots` reads. Everything is in metres and radians, in `f64`, in
//! right-handed frames
//! with z up; `a_from_b` is the pose of frame `b` in frame `a`, so that transforms read as products:
//! `map_from_tip = map_from_base * base_from_tip`.
//!
//! The same inputs give the same bits on every machine: sines come from `libm` and not from the platform,
//! no product is
//! fused with a sum, and sums have one order.

pub mod collision;
pub mod inverse;
pub mod kinematics;
pub mod planning;
mod simd;
mod trigonometry;

pub use kinematics::{Dof, KinematicTree};
