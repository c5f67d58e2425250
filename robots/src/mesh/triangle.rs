//! Triangles of a mesh, and their bound.

/// Greatest number of triangles of one file.
pub const MAX_TRIANGLES: usize = 200_000;

/// Triangle by its three corners, in the frame and the unit of the mesh.
pub type Triangle = [[f64; 3]; 3];

/// Reason to refuse a file with too many triangles.
pub(super) fn too_many() -> String {
    format!("it has more than {MAX_TRIANGLES} triangles")
}
