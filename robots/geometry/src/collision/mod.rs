//! What touches what, in `f64`: solids and the distance between two, and the solids of a robot.

mod body;
mod distance;
mod outline;
mod part;
mod simplex;
mod solid;

pub use body::{Body, Near};
pub use part::Part;
pub use solid::{Shape, Solid};
