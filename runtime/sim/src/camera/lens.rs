//! A pinhole camera at a place, looking somewhere.

use motet_graph::Pose;
use motet_robots::quaternion::mul;
use motet_runtime::CameraModel;

/// Columns and rows of a picture.
pub(crate) const SIZE: [usize; 2] = [640, 480];
/// The focal length in pixels: 80° from side to side.
const FOCAL: f64 = 381.4;

/// Position where a camera is and where it looks. The axes are those of images: x to the right, y down, z
/// ahead.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct CameraLens {
    /// Its place in the frame `map`, in m.
    pub(crate) eye: [f64; 3],
    /// Its axes in the frame `map`.
    pub(super) axes: [[f64; 3]; 3],
    quaternion: [f64; 4],
}

impl CameraLens {
    /// A camera that looks along a heading, and so much below the horizon; both in rad. It is level from left
    /// to right.
    pub(crate) fn new(eye: [f64; 3], heading: f64, below: f64) -> Self {
        let ((sy, cy), (sb, cb)) = (heading.sin_cos(), below.sin_cos());
        let axes = [[sy, -cy, 0.0], [-sb * cy, -sb * sy, -cb], [cb * cy, cb * sy, -sb]];
        let ((hs, hc), (ts, tc)) = ((heading / 2.0).sin_cos(), (below / 2.0).sin_cos());
        // map_from_camera = yaw * pitch * the turn from a body's axes to those of images.
        let turned = mul([0.0, 0.0, hs, hc], [0.0, ts, 0.0, tc]);
        Self { eye, axes, quaternion: mul(turned, [-0.5, 0.5, -0.5, 0.5]) }
    }

    /// True if a direction in the frame `map` is in the picture.
    pub(super) fn frames(&self, ray: [f64; 3]) -> bool {
        let [right, down, ahead] = self.axes.map(|axis| dot(axis, ray));
        let [half_x, half_y] = SIZE.map(|size| size as f64 / 2.0 / FOCAL * ahead);
        ahead > 0.0 && right.abs() <= half_x && down.abs() <= half_y
    }

    /// The ray of a pixel in the frame `map`, as long as its depth is 1.
    pub(super) fn ray(&self, column: usize, row: usize) -> [f64; 3] {
        let [cx, cy] = centre();
        let (x, y) = ((column as f64 - cx) / FOCAL, (row as f64 - cy) / FOCAL);
        let [right, down, ahead] = self.axes;
        [0, 1, 2].map(|at| {
            let part = |axis: [f64; 3]| axis.get(at).copied().unwrap_or_default();
            x * part(right) + y * part(down) + part(ahead)
        })
    }

    /// The pixels that a ball may cover, from and to in both directions; none where it is behind the camera.
    pub(super) fn covered(&self, centre_in_map: [f64; 3], radius: f64) -> Option<[[usize; 2]; 2]> {
        let from_eye = minus(centre_in_map, self.eye);
        let [x, y, z] = self.axes.map(|axis| dot(axis, from_eye));
        let (near, far) = (z - radius, z + radius);
        if far <= 0.0 {
            return None;
        }
        let [width, height] = SIZE;
        if near <= 0.01 {
            return Some([[0, width], [0, height]]);
        }
        let span = |at: f64, middle: f64, size: usize| {
            let (low, high) = (at - radius, at + radius);
            let least = (low / near).min(low / far) * FOCAL + middle;
            let greatest = (high / near).max(high / far) * FOCAL + middle;
            let pixel = |value: f64| value.clamp(0.0, size as f64) as usize;
            let span = [pixel(least.floor()), pixel(greatest.ceil() + 1.0)];
            (span[0] < span[1]).then_some(span)
        };
        let [cx, cy] = centre();
        Some([span(x, cx, width)?, span(y, cy, height)?])
    }

    /// As those know it who lift points.
    pub(crate) fn camera(&self) -> CameraModel {
        let [cx, cy] = centre();
        CameraModel {
            pose: Pose { xyz: self.eye, quaternion: self.quaternion },
            intrinsics: [FOCAL, FOCAL, cx, cy],
        }
    }
}

/// The pixel that the axis goes through, counted from the centre of the first.
fn centre() -> [f64; 2] {
    SIZE.map(|size| (size as f64 - 1.0) / 2.0)
}

pub(super) fn dot(one: [f64; 3], other: [f64; 3]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

pub(super) fn minus([x, y, z]: [f64; 3], [a, b, c]: [f64; 3]) -> [f64; 3] {
    [x - a, y - b, z - c]
}

#[cfg(test)]
mod tests {
    #![allow(clippy::indexing_slicing, reason = "a test fails by panicking")]

    use super::*;
    use motet_robots::quaternion::rotate;
    use std::f64::consts::{FRAC_PI_4, SQRT_2};

    #[test]
    fn lens_quaternion_is_that_of_the_axes() {
        for (heading, below) in [(0.0, 0.0), (0.7, 0.3), (-2.9, -0.4), (3.1, 1.5)] {
            let lens = CameraLens::new([0.0; 3], heading, below);
            for (axis, unit) in lens.axes.iter().zip([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]) {
                let off = minus(rotate(lens.quaternion, unit), *axis);
                assert!(dot(off, off) < 1e-18, "{heading} {below}");
            }
        }
    }

    #[test]
    fn lens_looks_at_the_point() {
        let lens = CameraLens::new([1.0, 2.0, 1.2], 3.0 * FRAC_PI_4, 0.5_f64.atan2(SQRT_2));
        let ray = lens.ray(0, 0);
        let ahead = lens.axes[2];
        let gaze = minus([0.0, 3.0, 0.7], lens.eye);
        assert!((dot(gaze, ahead) - dot(gaze, gaze).sqrt()).abs() < 1e-9);
        assert!((dot(ray, ahead) - 1.0).abs() < 1e-9, "a ray is as long as its depth is 1");
        assert!(dot(ray, lens.axes[0]) < 0.0 && dot(ray, lens.axes[1]) < 0.0, "the first pixel is top left");
        assert_eq!(lens.covered([2.0, 1.0, 1.2], 0.1), None, "behind it");
        assert_eq!(lens.covered([1.0, 2.0, 1.3], 0.5), Some([[0, 640], [0, 480]]), "all about it");
    }
}
