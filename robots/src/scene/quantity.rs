//! Quantities of the numbers of a scene: name, unit, sign and range of each.

/// Greatest coordinate and size in m, for a room or a house, and greatest angle in rad, beyond which rounding
/// grows.
pub(super) const FURTHEST: f64 = 1000.0;

/// Quantity that a number of a scene measures.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum SceneQuantity {
    /// A coordinate of a position, in m.
    Coordinate,
    /// Extent, radius, height, width or distance, in m.
    Size,
    /// Distance from obstacles, in m.
    Clearance,
    /// Mass in kg.
    Mass,
    /// Angle in rad.
    Angle,
    /// Opening angle of a door, in rad.
    Opening,
    /// Scale of a mesh.
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
    /// Name of the quantity, with an article.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Coordinate => "a coordinate",
            Self::Size => "a size",
            Self::Clearance => "a clearance",
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

    /// Formats a number with the unit.
    pub(super) fn show(self, value: f64) -> String {
        let unit = match self {
            Self::Coordinate | Self::Size | Self::Clearance => " m",
            Self::Mass => " kg",
            Self::Angle | Self::Opening => " rad",
            Self::FocalLength | Self::Pixel => " px",
            Self::Scale | Self::Joint | Self::Direction | Self::Field => "",
        };
        format!("{value}{unit}")
    }

    pub(super) fn has_to_be_positive(self) -> bool {
        matches!(self, Self::Size | Self::Mass | Self::Opening | Self::Scale | Self::FocalLength)
    }

    /// True if the magnitude is limited to [`FURTHEST`].
    pub(super) fn has_bound(self) -> bool {
        // A clearance has a bound of its own.
        matches!(self, Self::Coordinate | Self::Size | Self::Angle | Self::Joint)
    }
}
