//! Wavefront OBJ: `v X Y Z` and `f A B C …`. Normals, textures, materials and groups are passed over.

use super::read::{MAX_TRIANGLES, Triangle, too_many};
use super::stl::three;

/// The triangles; a face of more corners is a fan, which its corners hold as they would the face.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    // What is no UTF-8 is in names and comments, which are passed over.
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

/// A corner by `INDEX`, `INDEX/…`: from 1, or from the end where it is negative.
fn corner(word: &str, corners: &[[f64; 3]]) -> Option<[f64; 3]> {
    let index: i64 = word.split('/').next()?.parse().ok()?;
    let count = i64::try_from(corners.len()).ok()?;
    let at = if index < 0 { count.checked_add(index)? } else { index.checked_sub(1)? };
    corners.get(usize::try_from(at).ok()?).copied()
}
