//! Reader of mesh files, from bytes to triangles.
//!
//! STL is a header of 80 bytes, a count and 50 bytes for each triangle, or text with the words `facet` and
//! `vertex`. Wavefront OBJ has lines `v X Y Z` and `f A B C …`; normals, textures, materials and groups are
//! skipped. The readers are our own: they name the line of a mistake and stop at the
//! limit of triangles, which `stl_io` and `tobj` do not.

use super::triangle::{MAX_TRIANGLES, Triangle, too_many};

/// Greatest size of one file, in bytes. Collision meshes have some kilobytes, visual meshes some megabytes.
pub const MAX_BYTES: u64 = 32 << 20;

/// Greatest coordinate, in the unit of the file.
const GREATEST: f64 = 1e9;

/// Reads the triangles of a file by the extension of its name: `.stl`, binary or text, `.obj`, or `.dae`.
/// There is at least one, and every coordinate is finite. O(bytes).
///
/// # Errors
///
/// A clause that describes the first mistake, with its line in a text file.
///
/// ```
/// use motet_robots::mesh;
///
/// let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
/// assert_eq!(mesh::read("plate.obj", text).unwrap().len(), 1);
/// assert_eq!(mesh::read("plate.obj", b"v 0 0").unwrap_err(), "line 1 has no three numbers");
/// ```
pub fn read(file: &str, bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    if bytes.len() as u64 > MAX_BYTES {
        return Err(too_large());
    }
    let triangles = match extension(file).as_str() {
        "stl" => stl(bytes)?,
        "obj" => obj(bytes)?,
        "dae" => super::collada::read(bytes)?,
        other => return Err(format!("`.{other}` files are not read, `.stl`, `.obj` and `.dae` are")),
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

/// Extension of a file name, in lower case.
pub(super) fn extension(file: &str) -> String {
    file.rsplit_once('.').map_or_else(String::new, |(_, end)| end.to_ascii_lowercase())
}

pub(super) fn too_large() -> String {
    format!("it is larger than {} MiB", MAX_BYTES >> 20)
}

/// Bytes of the header of a binary STL.
const HEADER: usize = 80;
/// Bytes of a triangle in a binary STL.
const RECORD: usize = 50;

/// Reads STL. The length decides between the forms, since some binary files begin with `solid` too.
fn stl(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let announced =
        bytes.get(HEADER..HEADER + 4).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    let records = bytes.get(HEADER + 4..).unwrap_or_default();
    let announced = announced.and_then(|count| usize::try_from(count).ok());
    if let Some(count) = announced.filter(|count| count.checked_mul(RECORD) == Some(records.len())) {
        return if count > MAX_TRIANGLES { Err(too_many()) } else { Ok(binary(records)) };
    }
    let begins = bytes.trim_ascii_start().get(..5).unwrap_or_default();
    if begins.eq_ignore_ascii_case(b"solid") && !bytes.contains(&0) {
        // Only the name of the solid may be no UTF-8, and it is skipped.
        return words(&String::from_utf8_lossy(bytes));
    }
    Err(match announced {
        Some(count) => {
            format!("it announces {count} triangles, and has bytes for {}", records.len() / RECORD)
        }
        None => "it is no STL".to_owned(),
    })
}

/// Records of twelve numbers, of which the first three are the normal, and two unused bytes.
fn binary(records: &[u8]) -> Vec<Triangle> {
    let triangle = |record: &[u8]| {
        let mut numbers =
            record.chunks_exact(4).filter_map(|bytes| bytes.try_into().ok()).map(f32::from_le_bytes).skip(3);
        let mut corner = || [(); 3].map(|()| f64::from(numbers.next().unwrap_or(f32::NAN)));
        [corner(), corner(), corner()]
    };
    records.chunks_exact(RECORD).map(triangle).collect()
}

fn words(text: &str) -> Result<Vec<Triangle>, String> {
    let (mut triangles, mut corners) = (Vec::new(), Vec::new());
    for (line, number) in text.lines().zip(1..) {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some(word) if word.eq_ignore_ascii_case("vertex") => {
                corners.push(three(words).ok_or_else(|| format!("line {number} has no three numbers"))?)
            }
            Some(word) if word.eq_ignore_ascii_case("endfacet") => {
                let triangle = <Triangle>::try_from(std::mem::take(&mut corners));
                triangles.push(
                    triangle
                        .map_err(|_| format!("the facet that ends in line {number} has no three corners"))?,
                );
                if triangles.len() > MAX_TRIANGLES {
                    return Err(too_many());
                }
            }
            Some(_) | None => {}
        }
    }
    if corners.is_empty() { Ok(triangles) } else { Err("it ends within a facet".to_owned()) }
}

/// Parses the first three words as numbers.
fn three<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<[f64; 3]> {
    let mut number = || words.next()?.parse().ok();
    Some([number()?, number()?, number()?])
}

/// Reads Wavefront OBJ. A face of more than three corners becomes a fan of triangles.
fn obj(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    // Only names and comments may be no UTF-8, and they are skipped.
    let text = String::from_utf8_lossy(bytes);
    let (mut corners, mut triangles): (Vec<[f64; 3]>, Vec<Triangle>) = (Vec::new(), Vec::new());
    for (line, number) in text.lines().zip(1..) {
        let said = line.split_once('#').map_or(line, |(said, _)| said);
        let mut words = said.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                corners.push(three(words).ok_or_else(|| format!("line {number} has no three numbers"))?)
            }
            Some("f") => {
                let face: Option<Vec<[f64; 3]>> = words.map(|word| corner(word, &corners)).collect();
                let face =
                    face.ok_or_else(|| format!("line {number} names a corner that is not above it"))?;
                let [first, rest @ ..] = face.as_slice() else { continue };
                triangles
                    .extend(rest.iter().zip(rest.iter().skip(1)).map(|(one, next)| [*first, *one, *next]));
                if triangles.len() > MAX_TRIANGLES {
                    return Err(too_many());
                }
            }
            Some(_) | None => {}
        }
    }
    Ok(triangles)
}

/// Corner by `INDEX` or `INDEX/…`: counted from 1, or from the end if negative.
fn corner(word: &str, corners: &[[f64; 3]]) -> Option<[f64; 3]> {
    let index: i64 = word.split('/').next()?.parse().ok()?;
    let count = i64::try_from(corners.len()).ok()?;
    let at = if index < 0 { count.checked_add(index)? } else { index.checked_sub(1)? };
    corners.get(usize::try_from(at).ok()?).copied()
}
