//! The numbers of a scene: what each measures, and whether it can be.

use motet_syntax::json::Spanned;
use motet_syntax::{Diagnostic, Span};

use super::errors::{NotPositive, TooFar, ZeroAxis};

/// The furthest coordinate and the greatest size, in m: a scene is a room or a house. The greatest angle, in rad: of a greater one
/// rounding leaves less and less.
pub(super) const FURTHEST: f64 = 1000.0;

/// What a number measures.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum SceneQuantity {
    /// A coordinate of a position, in m.
    Coordinate,
    /// An extent, radius, height, width or way, in m.
    Size,
    /// In kg.
    Mass,
    /// In rad.
    Angle,
    /// How far a door opens, in rad.
    Opening,
    /// Of a mesh.
    Scale,
    /// Of a camera, in pixels.
    FocalLength,
    /// Of a camera, in pixels.
    Pixel,
    /// A joint's value, in m or rad.
    Joint,
    /// Of an axis.
    Direction,
    /// A number that a kind declares.
    Field,
}

impl SceneQuantity {
    /// As the subject of a sentence.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Coordinate => "a coordinate",
            Self::Size => "a size",
            Self::Mass => "the mass",
            Self::Angle => "an angle",
            Self::Opening => "the angle of a door",
            Self::Scale => "a scale",
            Self::FocalLength => "a focal length",
            Self::Pixel => "a pixel coordinate",
            Self::Joint => "a joint value",
            Self::Direction => "a component of the axis",
            Self::Field => "a field",
        }
    }

    /// A number with its unit.
    pub(super) fn show(self, value: f64) -> String {
        let unit = match self {
            Self::Coordinate | Self::Size => " m",
            Self::Mass => " kg",
            Self::Angle | Self::Opening => " rad",
            Self::FocalLength | Self::Pixel => " px",
            Self::Scale | Self::Joint | Self::Direction | Self::Field => "",
        };
        format!("{value}{unit}")
    }

    fn has_to_be_positive(self) -> bool {
        match self {
            Self::Size | Self::Mass | Self::Opening | Self::Scale | Self::FocalLength => true,
            Self::Coordinate | Self::Angle | Self::Pixel | Self::Joint | Self::Direction | Self::Field => {
                false
            }
        }
    }

    /// Whether it is no farther from 0 than [`FURTHEST`].
    fn has_bound(self) -> bool {
        match self {
            Self::Coordinate | Self::Size | Self::Angle | Self::Joint => true,
            Self::Mass
            | Self::Opening
            | Self::Scale
            | Self::FocalLength
            | Self::Pixel
            | Self::Direction
            | Self::Field => false,
        }
    }
}

/// Says what is wrong with numbers.
#[derive(Debug, Default)]
pub(super) struct NumberReader {
    /// What was found so far.
    pub(super) found: Vec<Diagnostic>,
}

impl NumberReader {
    /// The number, where it can be.
    pub(super) fn one(&mut self, number: &Spanned<f64>, quantity: SceneQuantity) -> Option<f64> {
        self.value(number.value, number.span, quantity)
    }

    /// The three numbers, where all can be; at most one mistake is told.
    pub(super) fn three(&mut self, point: &Spanned<[f64; 3]>, quantity: SceneQuantity) -> Option<[f64; 3]> {
        let [x, y, z] = point.value;
        Some([
            self.value(x, point.span, quantity)?,
            self.value(y, point.span, quantity)?,
            self.value(z, point.span, quantity)?,
        ])
    }

    /// The direction of a vector, with length 1.
    pub(super) fn axis(&mut self, axis: &Spanned<[f64; 3]>) -> Option<[f64; 3]> {
        let raw = self.three(axis, SceneQuantity::Direction)?;
        // Scaled first, so that neither tiny nor huge components are lost in the squares.
        let greatest = raw.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        if greatest == 0.0 {
            self.found.push(ZeroAxis { span: axis.span }.into());
            return None;
        }
        let scaled = raw.map(|part| part / greatest);
        let length = scaled.iter().map(|part| part * part).sum::<f64>().sqrt();
        Some(scaled.map(|part| part / length))
    }

    /// The value is finite: JSON has no other, and the reader takes no number that is too large for a float.
    fn value(&mut self, value: f64, span: Span, quantity: SceneQuantity) -> Option<f64> {
        if quantity.has_to_be_positive() && value <= 0.0 {
            self.found.push(NotPositive { span, quantity, found: value }.into());
        } else if quantity.has_bound() && value.abs() > FURTHEST {
            self.found.push(TooFar { span, quantity, found: value }.into());
        } else {
            return Some(value);
        }
        None
    }
}
