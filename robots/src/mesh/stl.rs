//! STL: a header of 80 bytes, a count and 50 bytes a triangle; or the words `facet`, `vertex` and numbers.

use super::read::{MAX_TRIANGLES, Triangle, too_many};

const HEADER: usize = 80;
const RECORD: usize = 50;

/// Reads STL. The length decides between the forms, since some binary files begin with `solid` too.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
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
pub(super) fn three<'a>(mut words: impl Iterator<Item = &'a str>) -> Option<[f64; 3]> {
    let mut number = || words.next()?.parse().ok();
    Some([number()?, number()?, number()?])
}
