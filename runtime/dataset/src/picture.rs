//! Pictures of rows: what the simulated robot's camera sees as a planner is asked.

use std::io::Cursor;
use std::sync::Arc;

use sha2::{Digest as _, Sha256};
use smol_str::{SmolStr, format_smolstr};

/// The folder of pictures, beside the files of rows.
pub const FOLDER: &str = "images";

/// Images of rows.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Pictures {
    #[default]
    None,
    /// Each has one of the room, and one of a thing that the request names, if it is in view. The light
    /// varies.
    EachRow,
}

/// Bytes of a PNG image.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Picture(pub(crate) Arc<[u8]>);

impl Picture {
    /// Its path as seen from the folder of the rows: of the scene, the robot and what it shows, so that the
    /// same is stored once.
    pub(crate) fn path(&self, scene: &str, robot: &str) -> SmolStr {
        let digest: String =
            Sha256::digest(&self.0).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        format_smolstr!("{FOLDER}/{scene}_{robot}_{digest}.png")
    }

    /// The same picture in another light: 1 is that of the camera, less is darker. Unchanged if it is no PNG
    /// with 8 bits for each channel.
    pub(crate) fn lit(self, light: f64) -> Self {
        relit(&self.0, light).map_or(self, |bytes| Self(bytes.into()))
    }
}

fn relit(bytes: &[u8], light: f64) -> Option<Vec<u8>> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info().ok()?;
    let mut pixels = vec![0; reader.output_buffer_size()?];
    let frame = reader.next_frame(&mut pixels).ok()?;
    let channels = match (frame.color_type, frame.bit_depth) {
        (png::ColorType::Rgb, png::BitDepth::Eight) => 3,
        (png::ColorType::Rgba, png::BitDepth::Eight) => 4,
        (png::ColorType::Grayscale, png::BitDepth::Eight) => 1,
        _ => return None,
    };
    for pixel in pixels.chunks_exact_mut(channels) {
        // The fourth channel is no light.
        for value in pixel.iter_mut().take(3) {
            *value = (f64::from(*value) * light).round().clamp(0.0, 255.0) as u8;
        }
    }
    let mut written = Vec::new();
    let mut encoder = png::Encoder::new(&mut written, frame.width, frame.height);
    encoder.set_color(frame.color_type);
    encoder.set_depth(frame.bit_depth);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(&pixels).ok()?;
    writer.finish().ok()?;
    Some(written)
}

/// Checks that trainers can read the bytes of an image file, and returns the fault. A PNG is decoded; of
/// other formats the first bytes are compared.
///
/// ```
/// use motet_dataset::picture::fault;
///
/// assert_eq!(fault(b"GIF89a"), None);
/// assert_eq!(fault(b"text").as_deref(), Some("it is no PNG, JPEG, WebP or GIF"));
/// ```
#[must_use]
pub fn fault(bytes: &[u8]) -> Option<String> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => decoded(bytes).err().map(|why| format!("it is no whole PNG: {why}")),
        [0xff, 0xd8, 0xff, ..] | [b'G', b'I', b'F', b'8', ..] => None,
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => None,
        _ => Some("it is no PNG, JPEG, WebP or GIF".to_owned()),
    }
}

fn decoded(bytes: &[u8]) -> Result<(), png::DecodingError> {
    let mut reader = png::Decoder::new(Cursor::new(bytes)).read_info()?;
    let Some(size) = reader.output_buffer_size() else { return Err(png::DecodingError::LimitsExceeded) };
    reader.next_frame(&mut vec![0; size])?;
    Ok(())
}
