//! The judge of `reach`: furnished rooms made from a seed, what is true of them by exhaustive search, and a
//! check of witnesses. Kinematics, collision, grasps and planning are written a second time here, in `f64`
//! and on parry3d; with the query it shares the reader of URDFs, which links may touch, and how deep a hand
//! goes around a thing.

#![allow(
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "dense numerics on lists of one length, in a program that nothing depends on"
)]

mod chance;
mod check;
mod export;
mod grasp;
mod judge;
mod model;
mod plan;
mod report;
mod room;
mod scenery;
mod truth;

pub use check::faults;
pub use judge::{AnswerKind, Case, Settings, run};
pub use model::{Model, robot};
pub use report::{Table, command};
pub use room::{furnished, targets};
pub use truth::{Truth, truth};
