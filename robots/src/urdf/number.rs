//! Numbers and poses in attributes. Every word of a vector has to be a number: a reader that skips what it cannot parse
//! takes `"abc 1 2 3"` for a vector.

use motet_syntax::{Diagnostic, Span};
use roxmltree::Node;

use super::document::{XmlSpans, child};
use super::errors::{BadNumber, ImpossibleNumber};
use super::model::Pose;

/// No length or offset of a robot is larger, in m or rad.
const GREATEST: f64 = 1e6;

/// Reads numbers and collects what is wrong with them.
pub(super) struct UrdfReader {
    pub(super) spans: XmlSpans,
    /// Whether `<origin>` may have `quat_xyzw`, as since URDF 1.1.
    pub(super) quaternions: bool,
    pub(super) found: Vec<Diagnostic>,
}

impl UrdfReader {
    /// Exactly `N` finite numbers; `None` where the attribute is missing or wrong.
    fn vector<const N: usize>(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<([f64; N], Span)> {
        let (text, span) = self.spans.attribute(node, key)?;
        let words: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
        let Some(values) = words.and_then(|words| <[f64; N]>::try_from(words).ok()) else {
            let wanted = match N {
                1 => "one number",
                3 => "three numbers",
                _ => "four numbers",
            };
            self.found.push(BadNumber { span, key, text: text.to_owned(), wanted }.into());
            return None;
        };
        for actual in values {
            let wanted = match actual {
                _ if !actual.is_finite() => "a finite number",
                _ if actual.abs() > GREATEST => "at most a million",
                _ => continue,
            };
            self.found.push(ImpossibleNumber { span, key, actual, wanted }.into());
            return None;
        }
        Some((values, span))
    }

    /// Three numbers, `default` where they are not given or wrong.
    pub(super) fn triple(&mut self, node: Node<'_, '_>, key: &'static str, default: [f64; 3]) -> [f64; 3] {
        self.vector::<3>(node, key).map_or(default, |(values, _)| values)
    }

    /// One number; `None` where it is not given or wrong.
    pub(super) fn scalar(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<f64> {
        self.vector::<1>(node, key).map(|([value], _)| value)
    }

    /// One number of a joint's limits, which may be beyond what a length can be: "unlimited" is often `1e16`.
    pub(super) fn limit(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<(f64, Span)> {
        let (text, span) = self.spans.attribute(node, key)?;
        match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Some((value, span)),
            Ok(actual) => {
                self.found.push(ImpossibleNumber { span, key, actual, wanted: "a finite number" }.into());
                None
            }
            Err(_) => {
                let mistake = BadNumber { span, key, text: text.to_owned(), wanted: "one number" };
                self.found.push(mistake.into());
                None
            }
        }
    }

    /// Lengths that have to be given and not be negative.
    pub(super) fn lengths<const N: usize>(
        &mut self,
        node: Node<'_, '_>,
        key: &'static str,
    ) -> Option<[f64; N]> {
        self.spans.required(node, key, &mut self.found)?;
        let (values, span) = self.vector::<N>(node, key)?;
        if let Some(actual) = values.into_iter().find(|value| *value < 0.0) {
            self.found.push(ImpossibleNumber { span, key, actual, wanted: "zero or more" }.into());
            return None;
        }
        Some(values)
    }

    /// Factors of which none is zero; ones where they are not given or wrong.
    pub(super) fn factors(&mut self, node: Node<'_, '_>, key: &'static str) -> [f64; 3] {
        let Some((values, span)) = self.vector::<3>(node, key) else { return [1.0; 3] };
        if values.contains(&0.0) {
            let mistake = ImpossibleNumber { span, key, actual: 0.0, wanted: "different from zero" };
            self.found.push(mistake.into());
            return [1.0; 3];
        }
        values
    }

    /// The pose in the child element `origin`; the identity where there is none.
    pub(super) fn origin(&mut self, node: Node<'_, '_>) -> Pose {
        let Some(origin) = child(node, "origin") else { return Pose::IDENTITY };
        let xyz = self.triple(origin, "xyz", [0.0; 3]);
        let turned = if self.quaternions { self.vector::<4>(origin, "quat_xyzw") } else { None };
        let quaternion_xyzw = match turned {
            Some((values, span)) => self.unit(values, span),
            None => from_rpy(self.triple(origin, "rpy", [0.0; 3])),
        };
        Pose { xyz, quaternion_xyzw }
    }

    fn unit(&mut self, values: [f64; 4], span: Span) -> [f64; 4] {
        let norm = values.iter().map(|value| value * value).sum::<f64>().sqrt();
        if (norm - 1.0).abs() > 1e-3 {
            let key = "quat_xyzw";
            self.found.push(ImpossibleNumber { span, key, actual: norm, wanted: "of length 1" }.into());
            return Pose::IDENTITY.quaternion_xyzw;
        }
        values.map(|value| value / norm)
    }
}

/// Roll about x, then pitch about y, then yaw about z, all about the fixed axes, in rad, as a unit quaternion x, y, z, w.
fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> [f64; 4] {
    let ((sr, cr), (sp, cp), (sy, cy)) =
        (libm::sincos(roll / 2.0), libm::sincos(pitch / 2.0), libm::sincos(yaw / 2.0));
    [
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    ]
}
