//! Meshes of a robot's links: triangles from STL and OBJ files, enclosed in pieces that geometry knows. No file is opened
//! here: [`attach`] asks for the bytes of each, and [`locate`] says where they may be.

mod attach;
mod cover;
mod errors;
mod locate;
mod obj;
mod read;
mod stl;

pub use attach::{MeshFile, attach};
pub use cover::cover;
pub use errors::CODES;
pub(crate) use errors::UnreadMesh;
pub use locate::locate;
pub use read::{MAX_BYTES, MAX_TRIANGLES, Triangle, read};
