//! Pictures of the simulated room as it is: its shapes in flat colours, with the depth of every pixel, from
//! where the robot's camera is. The same world gives the same bytes.
//!
//! Fed by the world alone, [`scenery`] says what there is to be seen and in which colours, [`solid`] where a
//! ray meets it, [`lens`] which ray a pixel is, [`render`] puts these together, and [`sight`] tells how much
//! of a thing is not hidden. There are no walls, no shadows and no robot in a picture: it is for telling
//! things apart, not for beauty.

mod lens;
mod render;
mod scenery;
mod sight;
mod solid;

pub(crate) use lens::CameraLens;
pub(crate) use render::{encoded, render};
pub(crate) use scenery::front;
