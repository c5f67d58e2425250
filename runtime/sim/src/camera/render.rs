//! Pictures: of each pixel the colour and the depth of the nearest surface along its ray; and their encoding
//! as PNG.

use super::lens::{CameraLens, SIZE, dot};
use super::scenery::{Painted, scenery};
use crate::world::SimWorld;
use motet_robots::scene::Colour;
use motet_robots::scene::Scene;
use motet_runtime::DepthImage;

/// Distance that the camera measures, in m: what is beyond is the background.
const FAR_M: f64 = 10.0;
/// Direction of the light.
const LIGHT: [f64; 3] = [-0.35, -0.25, 0.9];
/// The share of light that comes from everywhere.
const AMBIENT: f64 = 0.55;
/// The squares of the floor, in m and in two greys.
const TILE_M: f64 = 0.5;
const TILES: [Colour; 2] = [[168, 166, 160], [180, 178, 172]];
/// Colour of the background.
const SKY: Colour = [214, 222, 230];

/// Image and depth of a simulated camera.
pub(crate) struct RenderedView {
    /// Red, green and blue of each pixel, row by row.
    pub(crate) colours: Vec<u8>,
    pub(crate) depth: DepthImage,
}

/// A picture of the world. O(pixels + pixels that things cover).
pub(crate) fn render(world: &SimWorld, scene: &Scene, lens: &CameraLens) -> RenderedView {
    let [width, height] = SIZE;
    let mut pixels: Vec<(f64, Colour)> = Vec::with_capacity(width * height);
    for row in 0..height {
        pixels.extend((0..width).map(|column| ground(lens.eye, lens.ray(column, row))));
    }
    for painted in scenery(world, scene) {
        paint(&painted, lens, &mut pixels);
    }
    let mut colours = Vec::with_capacity(pixels.len() * 3);
    let mut millimetres = Vec::with_capacity(pixels.len());
    for (depth, colour) in pixels {
        colours.extend(colour);
        millimetres.push(if depth < FAR_M { (depth * 1_000.0).round() as u16 } else { 0 });
    }
    RenderedView { colours, depth: DepthImage { width, height, millimetres } }
}

fn paint(painted: &Painted, lens: &CameraLens, pixels: &mut [(f64, Colour)]) {
    let [width, _] = SIZE;
    let solid = &painted.solid;
    let Some([[left, right], [top, bottom]]) = lens.covered(solid.centre, solid.radius()) else { return };
    for row in top..bottom {
        for column in left..right {
            let Some(hit) = solid.hit(lens.eye, lens.ray(column, row)) else { continue };
            let Some(pixel) = pixels.get_mut(row * width + column) else { continue };
            if hit.at < pixel.0 && hit.at < FAR_M {
                *pixel = (hit.at, lit(painted.colour, hit.normal));
            }
        }
    }
}

/// The floor, or what is behind everything.
fn ground([x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> (f64, Colour) {
    let far = -z / dz;
    if dz > -1e-9 || far >= FAR_M {
        return (f64::INFINITY, SKY);
    }
    let square = |at: f64| (at / TILE_M).floor() as i64;
    let is_odd = (square(x + far * dx) + square(y + far * dy)).rem_euclid(2) == 1;
    let [even, odd] = TILES;
    (far, if is_odd { odd } else { even })
}

/// A colour in the light, where the surface faces along a normal: Lambert's law.
fn lit(colour: Colour, normal: [f64; 3]) -> Colour {
    let share = AMBIENT + (1.0 - AMBIENT) * dot(normal, LIGHT).clamp(0.0, 1.0);
    colour.map(|part| (f64::from(part) * share).round() as u8)
}

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
