//! Images of maps: PGM as text (P2) and as bytes (P5), and PNG. Sizes are checked before memory is taken.

use std::io::Cursor;

/// Greatest number of cells of a map: 16 million, as 4096 by 4096.
pub const MAX_CELLS: usize = 1 << 24;

/// Grey image, row by row from the top.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Raster {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Grey values from 0 (black) to 255 (white).
    pub(super) grey: Vec<u8>,
    /// Cells that are not opaque, if the image has transparency.
    pub(super) transparent: Vec<bool>,
}

/// Reads an image by its first bytes, or returns the problem with its place. O(bytes).
pub(super) fn read(bytes: &[u8]) -> Result<Raster, String> {
    match bytes {
        [b'P', b'2', ..] => pgm(bytes, true),
        [b'P', b'5', ..] => pgm(bytes, false),
        [0x89, b'P', b'N', b'G', ..] => png(bytes),
        [] => Err("it is empty".to_owned()),
        _ => Err("it begins neither as a PGM (`P2`, `P5`) nor as a PNG".to_owned()),
    }
}

fn size(width: usize, height: usize) -> Result<usize, String> {
    match width.checked_mul(height) {
        Some(0) => Err(format!("it has {width} × {height} pixels")),
        Some(cells) if cells <= MAX_CELLS => Ok(cells),
        _ => Err(format!("it has {width} × {height} pixels, more than the limit of {MAX_CELLS}")),
    }
}

/// Scanner of the numbers of a PGM, with the byte that comes next.
struct Scanner<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl Scanner<'_> {
    /// Next number; comments reach from `#` to the end of their line.
    fn number(&mut self, what: &str) -> Result<usize, String> {
        while let Some(byte) = self.bytes.get(self.at) {
            match byte {
                b'#' => {
                    let rest = self.bytes.get(self.at..).unwrap_or_default();
                    self.at += rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
                }
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
        let text = rest.get(..digits).and_then(|digits| std::str::from_utf8(digits).ok()).unwrap_or_default();
        match text.parse() {
            Ok(number) => {
                self.at += digits;
                Ok(number)
            }
            Err(_) if rest.is_empty() => Err(format!("it ends before {what}")),
            Err(_) => Err(format!("{what} is no number, at byte {} in line {}", self.at, self.line())),
        }
    }

    fn line(&self) -> usize {
        1 + self.bytes.iter().take(self.at).filter(|byte| **byte == b'\n').count()
    }
}

fn pgm(bytes: &[u8], is_text: bool) -> Result<Raster, String> {
    let mut scanner = Scanner { bytes, at: 2 };
    let (width, height) = (scanner.number("its width")?, scanner.number("its height")?);
    let cells = size(width, height)?;
    let greatest = scanner.number("its greatest value")?;
    if !(1..=65_535).contains(&greatest) {
        return Err(format!("its greatest value is {greatest}, but must be from 1 to 65535"));
    }
    let mut grey = Vec::with_capacity(cells.min(bytes.len()));
    let mut push = |value: usize, cell: usize| {
        if value > greatest {
            let (column, row) = (cell % width + 1, cell / width + 1);
            return Err(format!("the pixel {column} of row {row} is {value}, more than {greatest}"));
        }
        grey.push(u8::try_from((value * 255 + greatest / 2) / greatest).unwrap_or(u8::MAX));
        Ok(())
    };
    if is_text {
        for cell in 0..cells {
            let value = scanner.number(&format!("pixel {} of row {}", cell % width + 1, cell / width + 1))?;
            push(value, cell)?;
        }
    } else {
        // Exactly one white space ends the header.
        let pixels = bytes.get(scanner.at + 1..).unwrap_or_default();
        let each = if greatest > 255 { 2 } else { 1 };
        if pixels.len() < cells * each {
            let rows = pixels.len() / (width * each);
            return Err(format!("it ends in row {} of {height}", rows + 1));
        }
        for (cell, pixel) in pixels.chunks_exact(each).take(cells).enumerate() {
            push(pixel.iter().fold(0, |value, byte| value << 8 | usize::from(*byte)), cell)?;
        }
    }
    Ok(Raster { width, height, grey, transparent: Vec::new() })
}

fn png(bytes: &[u8]) -> Result<Raster, String> {
    let fail = |problem: png::DecodingError| problem.to_string();
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(fail)?;
    let info = reader.info();
    let (width, height) = (info.width as usize, info.height as usize);
    let cells = size(width, height)?;
    let bound = reader.output_buffer_size().ok_or_else(|| "it is too large".to_owned())?;
    let mut pixels = vec![0; bound];
    let frame = reader.next_frame(&mut pixels).map_err(fail)?;
    let each = frame.color_type.samples();
    let (mut grey, mut transparent) = (Vec::with_capacity(cells), Vec::new());
    for pixel in pixels.chunks_exact(each).take(cells) {
        // Map servers take the mean of the colours.
        let (colours, alpha) = pixel.split_at(if each > 2 { 3 } else { 1 });
        let sum: usize = colours.iter().map(|colour| usize::from(*colour)).sum();
        grey.push(u8::try_from((sum + colours.len() / 2) / colours.len()).unwrap_or(u8::MAX));
        transparent.extend(alpha.first().map(|alpha| *alpha < u8::MAX));
    }
    Ok(Raster { width, height, grey, transparent })
}

#[cfg(test)]
mod tests {
    use super::read;

    fn check(bytes: &[u8], expected: Result<&[u8], &str>) {
        match (read(bytes), expected) {
            (Ok(raster), Ok(grey)) => assert_eq!(raster.grey, grey),
            (Err(problem), Err(wanted)) => assert!(problem.contains(wanted), "{problem}"),
            (found, expected) => panic!("{found:?} instead of {expected:?}"),
        }
    }

    #[test]
    fn read_pgm_of_both_forms() {
        check(b"P2\n# CREATOR: a map saver\n2 2\n# max\n255\n0 205\n254 1\n", Ok(&[0, 205, 254, 1]));
        check(b"P5 2 2 255\n\x00\xcd\xfe\x01", Ok(&[0, 205, 254, 1]));
        check(b"P5 1 2 65535 \xff\xff\x80\x00", Ok(&[255, 128]));
        check(b"P2 2 1 1 0 1", Ok(&[0, 255]));
    }

    #[test]
    fn read_refuses_what_is_no_whole_image() {
        check(b"", Err("empty"));
        check(b"GIF89a", Err("begins neither"));
        check(b"P2", Err("ends before its width"));
        check(b"P2 0 4 255", Err("0 × 4 pixels"));
        check(b"P5 99999999 99999999 255 ", Err("more than the limit"));
        check(b"P5 18446744073709551615 9 255 ", Err("more than the limit"));
        check(b"P5 99999999999999999999999 9 255 ", Err("its width is no number, at byte 3 in line 1"));
        check(b"P2 2 2\n0\n", Err("from 1 to 65535"));
        check(b"P2 2 2 9\n1 2\n3 x\n", Err("pixel 2 of row 2 is no number, at byte 15 in line 3"));
        check(b"P2 2 2 9\n1 2\n3", Err("ends before pixel 2 of row 2"));
        check(b"P2 2 1 9\n1 10", Err("pixel 2 of row 1 is 10, more than 9"));
        check(b"P5 4 4 255 \x00\x00\x00\x00\x00", Err("ends in row 2 of 4"));
        check(b"\x89PNG\r\n\x1a\n", Err(""));
    }
}
