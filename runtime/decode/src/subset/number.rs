//! Which numbers may stand where a type is asked for.

use motet_compiler::signature::Type;
use motet_syntax::unit::{Dimension, Unit};

use super::Decimal;

/// The numbers from `least` to `greatest`, in SI units, with so many decimals.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct NumberRange {
    /// The least, in units of the last decimal.
    pub least: i64,
    /// The greatest, in units of the last decimal.
    pub greatest: i64,
    /// How many decimals.
    pub decimals: u8,
    /// The unit of the text form; none of a plain number.
    pub unit: Option<Unit>,
}

impl NumberRange {
    /// Deadlines and times, in seconds.
    pub const DURATION: Self = Self { least: 0, greatest: 9_999_999, decimals: 3, unit: Some(Unit::Second) };

    /// Whole numbers.
    #[must_use]
    pub const fn whole(least: u32, greatest: u32) -> Self {
        Self { least: least as i64, greatest: greatest as i64, decimals: 0, unit: None }
    }

    /// The numbers of a type, within the range of a robot's card where there is one; none where the type has no numbers
    /// or the range is empty.
    #[must_use]
    pub fn of(ty: &Type, card: Option<(f64, f64)>) -> Option<Self> {
        let (least, greatest, decimals) = match ty {
            Type::Int => (-1e6, 1e6, 0),
            Type::Number => (-1e6, 1e6, 3),
            Type::Quantity(Dimension::LENGTH | Dimension::FORCE) => (-1e3, 1e3, 3),
            Type::Quantity(Dimension::ANGLE) => (-100.0, 100.0, 4),
            Type::Quantity(Dimension::DURATION) => (0.0, 9999.999, 3),
            Type::Quantity(Dimension::MASS) => (0.0, 1e3, 3),
            Type::Quantity(Dimension::NONE) => (0.0, 1.0, 3),
            Type::Quantity(_) => (-100.0, 100.0, 3),
            Type::Bool | Type::Text | Type::Pose | Type::Entity(_) | Type::Enum(_) | Type::List(_) => {
                return None;
            }
        };
        let (lower, upper) = card.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let scale = Decimal::scale(decimals);
        let least = (f64::max(least, lower) * scale).ceil() as i64;
        let greatest = (f64::min(greatest, upper) * scale).floor() as i64;
        let unit = match ty {
            Type::Quantity(Dimension::NONE) => Some(Unit::Percent),
            Type::Quantity(dimension) => Some(Unit::si(*dimension)?),
            _ => None,
        };
        (least <= greatest).then_some(Self { least, greatest, decimals, unit })
    }

    /// The nearest number of the range's decimals; none where it is out of range.
    #[must_use]
    pub fn nearest(&self, value: f64) -> Option<Decimal> {
        Decimal::nearest(value, self.decimals).filter(|decimal| self.contains(*decimal))
    }

    /// Whether a number with the range's decimals is in it.
    #[must_use]
    pub fn contains(&self, decimal: Decimal) -> bool {
        decimal.decimals == self.decimals && (self.least..=self.greatest).contains(&decimal.units)
    }
}
