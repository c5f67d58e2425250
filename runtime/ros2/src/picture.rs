//! Pictures and depth images of cameras, as `sensor_msgs/Image` and `sensor_msgs/CompressedImage` have them.
//!
//! They come from outside: sides and memory are bounded before anything is decoded.

use crate::cdr::Message;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Greatest width and height of a picture.
const MAX_SIDE: u32 = 4_096;
/// Greatest number of bytes that the decoder of a PNG file may take.
const MAX_BYTES: usize = 128 * 1024 * 1024;

/// Picture of red, green and blue bytes, row by row.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Picture {
    pub(crate) width: u32,
    pub(crate) height: u32,
    rgb: Vec<u8>,
}

impl Picture {
    /// Picture of a `sensor_msgs/Image` or of a `sensor_msgs/CompressedImage`, which has a `format`.
    ///
    /// # Errors
    ///
    /// Its encoding or its size, if it cannot be read.
    pub(crate) fn of(message: &Message) -> Result<Self, String> {
        match (message.get("format"), message.get("data")) {
            (Some(_), Some(Message::Bytes(data))) => Self::decompress(data, message.text("format")),
            _ => Self::raw(message),
        }
    }

    fn raw(image: &Message) -> Result<Self, String> {
        let (width, height) = size(image)?;
        let encoding = image.text("encoding");
        let (pixel, picks): (usize, [usize; 3]) = match encoding {
            "rgb8" => (3, [0, 1, 2]),
            "bgr8" => (3, [2, 1, 0]),
            "rgba8" => (4, [0, 1, 2]),
            "bgra8" => (4, [2, 1, 0]),
            "mono8" | "8UC1" => (1, [0, 0, 0]),
            _ => {
                return Err(format!(
                    "pictures of the encoding `{encoding}` are not read: rgb8, bgr8, rgba8, bgra8 and \
                     mono8 are"
                ));
            }
        };
        let rows = rows(image, width, height, pixel).ok_or("a picture has fewer bytes than its size says")?;
        let rgb = rows.into_iter().flat_map(|row| picked(row, pixel, picks)).collect();
        Ok(Self { width, height, rgb })
    }

    /// Picture of a file, whose first bytes say what it is: the format of the message is a text for people.
    fn decompress(data: &[u8], format: &str) -> Result<Self, String> {
        match data {
            [0xff, 0xd8, ..] => Self::jpeg(data).map_err(|why| format!("a JPEG picture: {why}")),
            [0x89, b'P', b'N', b'G', ..] => Self::of_png(data).map_err(|why| format!("a PNG picture: {why}")),
            _ => Err(format!("pictures of the format `{format}` are not read: JPEG and PNG are")),
        }
    }

    fn jpeg(data: &[u8]) -> Result<Self, String> {
        let most = MAX_SIDE as usize;
        let options = DecoderOptions::default().set_max_width(most).set_max_height(most);
        let options = options.set_strict_mode(true).jpeg_set_out_colorspace(ColorSpace::RGB);
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(data), options);
        let rgb = decoder.decode().map_err(|error| error.to_string())?;
        let (width, height) = decoder.dimensions().ok_or("it has no size")?;
        Self::new(u32::try_from(width).unwrap_or(0), u32::try_from(height).unwrap_or(0), rgb)
    }

    fn of_png(data: &[u8]) -> Result<Self, String> {
        let limits = png::Limits { bytes: MAX_BYTES };
        let mut decoder = png::Decoder::new_with_limits(std::io::Cursor::new(data), limits);
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        decoder.set_ignore_text_chunk(true);
        let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
        let (width, height) = reader.info().size();
        if !is_side(width) || !is_side(height) {
            return Err(wrong_sides());
        }
        let mut bytes = vec![0; reader.output_buffer_size().ok_or_else(wrong_sides)?];
        let frame = reader.next_frame(&mut bytes).map_err(|error| error.to_string())?;
        let (pixel, picks) = match frame.color_type {
            png::ColorType::Grayscale => (1, [0, 0, 0]),
            png::ColorType::GrayscaleAlpha => (2, [0, 0, 0]),
            png::ColorType::Rgba => (4, [0, 1, 2]),
            png::ColorType::Rgb | png::ColorType::Indexed => (3, [0, 1, 2]),
        };
        Self::new(width, height, picked(&bytes, pixel, picks).collect())
    }

    fn new(width: u32, height: u32, rgb: Vec<u8>) -> Result<Self, String> {
        if !is_side(width) || !is_side(height) {
            return Err(wrong_sides());
        }
        let is_whole = rgb.len() == 3 * width as usize * height as usize;
        is_whole.then_some(Self { width, height, rgb }).ok_or_else(|| "it is not whole".to_owned())
    }

    /// PNG file of it.
    ///
    /// # Errors
    ///
    /// Why it cannot be written.
    pub(crate) fn png(&self) -> Result<Vec<u8>, String> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::Fast);
        let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&self.rgb));
        written.map_err(|error| format!("a picture cannot be written: {error}"))?;
        Ok(file)
    }
}

/// Bytes of pixels of `pixel` bytes each, in another order.
fn picked(bytes: &[u8], pixel: usize, picks: [usize; 3]) -> impl Iterator<Item = u8> {
    let pixels = bytes.chunks_exact(pixel);
    pixels.flat_map(move |bytes| picks.map(|at| bytes.get(at).copied().unwrap_or_default()))
}

fn is_side(side: u32) -> bool {
    (1..=MAX_SIDE).contains(&side)
}

fn wrong_sides() -> String {
    format!("a picture has no sides from 1 to {MAX_SIDE} pixels")
}

/// Width and height of a `sensor_msgs/Image`.
///
/// # Errors
///
/// They are none of a picture.
pub(crate) fn size(image: &Message) -> Result<(u32, u32), String> {
    let side = |name| {
        let Some(Message::Uint(side)) = image.get(name) else { return None };
        u32::try_from(*side).ok().filter(|side| is_side(*side))
    };
    let sides = side("width").zip(side("height"));
    sides.ok_or_else(wrong_sides)
}

/// Rows of an image, of `pixel` bytes each pixel.
fn rows(image: &Message, width: u32, height: u32, pixel: usize) -> Option<Vec<&[u8]>> {
    let Some(Message::Bytes(data)) = image.get("data") else { return None };
    let Some(Message::Uint(step)) = image.get("step") else { return None };
    let (step, row) = (usize::try_from(*step).ok()?, width as usize * pixel);
    (0..height as usize).map(|at| data.get(at.checked_mul(step)?..)?.get(..row)).collect()
}

/// Depths of a `sensor_msgs/Image` in mm, little-endian; `None` if its encoding has none.
pub(crate) fn millimetres(image: &Message, width: u32, height: u32) -> Option<Vec<u8>> {
    let is_big = image.number("is_bigendian") > 0.0;
    match image.text("encoding") {
        "16UC1" | "mono16" => {
            let rows = rows(image, width, height, 2)?;
            let pairs = rows.into_iter().flat_map(|row| row.chunks_exact(2));
            Some(
                pairs.flat_map(|pair| if is_big { [pair[1], pair[0]] } else { [pair[0], pair[1]] }).collect(),
            )
        }
        "32FC1" => {
            let rows = rows(image, width, height, 4)?;
            let depth = |bytes: &[u8]| {
                let bytes: [u8; 4] = bytes.try_into().unwrap_or_default();
                let metres = if is_big { f32::from_be_bytes(bytes) } else { f32::from_le_bytes(bytes) };
                let mm = f64::from(metres) * 1000.0;
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the range is checked"
                )]
                let mm = if mm.is_finite() && (0.0..65_535.0).contains(&mm) { mm.round() as u16 } else { 0 };
                mm.to_le_bytes()
            };
            Some(rows.into_iter().flat_map(|row| row.chunks_exact(4)).flat_map(depth).collect())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cdr::{decode, encode};
    use crate::layout::{Distribution, Layouts};
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;
    use serde_json::json;

    /// JPEG file of 16 × 8 pixels: the left half is red, the right half blue.
    const JPEG: &str = "\
        /9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAA0JCgsKCA0LCgsODg0PEyAVExISEyccHhcgLikxMC4pLSwzOko+MzZGNywtQFdB\
        RkxOUlNSMj5aYVpQYEpRUk//2wBDAQ4ODhMREyYVFSZPNS01T09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09PT09P\
        T09PT09PT09PT09PT0//wAARCAAIABADASIAAhEBAxEB/8QAFgABAQEAAAAAAAAAAAAAAAAAAAQF/8QAFBABAAAAAAAAAAAA\
        AAAAAAAAAP/EABQBAQAAAAAAAAAAAAAAAAAAAAT/xAAZEQACAwEAAAAAAAAAAAAAAAAAQwWBwQb/2gAMAwEAAhEDEQA/AMVG\
        B3PsrR08u8P/2Q==";

    fn read(data: &[u8]) -> Result<Picture, String> {
        let (layouts, name) =
            (Layouts::of(Distribution::Humble, None).unwrap(), "sensor_msgs/CompressedImage");
        let bytes = encode(&layouts, name, &json!({"format": "own", "data": data})).unwrap();
        Picture::of(&decode(&layouts, name, &bytes).unwrap())
    }

    fn pixel(picture: &Picture, x: usize) -> [u8; 3] {
        picture.rgb[3 * x..3 * x + 3].try_into().unwrap()
    }

    #[test]
    fn jpeg_picture_has_its_pixels() {
        let file = STANDARD.decode(JPEG).unwrap();
        let picture = read(&file).unwrap();
        assert_eq!((picture.width, picture.height), (16, 8));
        let ([red, _, blue], [other_red, _, other_blue]) = (pixel(&picture, 1), pixel(&picture, 14));
        assert!(red > 170 && blue < 60 && other_red < 60 && other_blue > 180, "{picture:?}");
        assert!(read(&file[..file.len() / 2]).is_err(), "half a picture is none");
        // Of all files that differ in a byte none brings the reader down.
        for at in 2..file.len() {
            let mut wrong = file.clone();
            wrong[at] ^= 0xff;
            drop(read(&wrong));
        }
    }

    #[test]
    fn png_picture_has_its_pixels() {
        let picture = Picture { width: 2, height: 1, rgb: vec![1, 2, 3, 4, 5, 6] };
        assert_eq!(read(&picture.png().unwrap()).unwrap(), picture);
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, 1, 1);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Sixteen);
        encoder.write_header().unwrap().write_image_data(&[9, 200]).unwrap();
        assert_eq!(read(&file).unwrap().rgb, [9, 9, 9]);
    }

    #[test]
    fn pictures_that_are_none_or_too_large_are_refused() {
        assert_eq!(
            read(b"GIF89a").unwrap_err(),
            "pictures of the format `own` are not read: JPEG and PNG are"
        );
        let file = Picture { width: 5_000, height: 1, rgb: vec![0; 15_000] }.png().unwrap();
        assert_eq!(read(&file).unwrap_err(), "a PNG picture: a picture has no sides from 1 to 4096 pixels");
        let mut jpeg = STANDARD.decode(JPEG).unwrap();
        let frame = jpeg.windows(2).position(|two| two == [0xff, 0xc0]).unwrap();
        jpeg[frame + 5..frame + 9].copy_from_slice(&[0x20, 0x00, 0x00, 0x10]);
        assert!(read(&jpeg).unwrap_err().starts_with("a JPEG picture: "));
    }
}
