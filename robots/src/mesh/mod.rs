//! Meshes of the links of a robot: triangles from STL, OBJ and COLLADA files, and the solids that enclose
//! them.
//!
//! This module opens no file: [`attach`] asks its caller for the bytes of each, and [`locate`] gives the
//! paths at which a file may be.

mod attach;
mod collada;
mod cover;
mod diagnostics;
mod read;
mod triangle;

pub use attach::{MeshFile, attach, locate};
pub use cover::cover;
pub use diagnostics::CODES;
pub(crate) use diagnostics::UnreadMesh;
pub use read::{MAX_BYTES, read};
pub use triangle::{MAX_TRIANGLES, Triangle};
