//! From the bytes of a mesh to its triangles, or to why it has none.

use super::{obj, stl};

/// The most bytes of one file. Collision meshes have some kilobytes, meshes for showing some megabytes.
pub const MAX_BYTES: u64 = 32 << 20;

/// The most triangles of one file.
pub const MAX_TRIANGLES: usize = 200_000;

/// No coordinate is larger, in the file's unit.
const GREATEST: f64 = 1e9;

/// Three corners, in the mesh's frame and its unit.
pub type Triangle = [[f64; 3]; 3];

/// The triangles of a file by the end of its name: `.stl`, binary or text, or `.obj`. There is at least one,
/// and every coordinate is finite. O(bytes).
///
/// # Errors
///
/// What is wrong with the file, as a clause.
pub fn read(file: &str, bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    if bytes.len() as u64 > MAX_BYTES {
        return Err(too_large());
    }
    let triangles = match extension(file).as_str() {
        "stl" => stl::read(bytes)?,
        "obj" => obj::read(bytes)?,
        other => return Err(format!("`.{other}` files are not read, `.stl` and `.obj` are")),
    };
    if triangles.is_empty() {
        return Err("it has no triangle".to_owned());
    }
    let is_far = |value: &f64| !value.is_finite() || value.abs() > GREATEST;
    if triangles.iter().flatten().flatten().any(is_far) {
        return Err("it has a corner that is nowhere: not a finite number, or beyond 1e9".to_owned());
    }
    Ok(triangles)
}

/// The end of a file's name after the last point, in lower case.
pub(super) fn extension(file: &str) -> String {
    file.rsplit_once('.').map_or_else(String::new, |(_, end)| end.to_ascii_lowercase())
}

pub(super) fn too_large() -> String {
    format!("it is larger than {} MiB", MAX_BYTES >> 20)
}

pub(super) fn too_many() -> String {
    format!("it has more than {MAX_TRIANGLES} triangles")
}
