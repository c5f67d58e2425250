//! Pictures as files.

use super::render::RenderedView;

/// A picture as a PNG; none where it is no picture.
pub(crate) fn encoded(shot: &RenderedView) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    let (width, height) = (u32::try_from(shot.depth.width).ok()?, u32::try_from(shot.depth.height).ok()?);
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().ok()?;
    writer.write_image_data(&shot.colours).ok()?;
    writer.finish().ok()?;
    Some(bytes)
}
