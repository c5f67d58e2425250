//! Ranges of numbers in the canonical subset.

use motet_compiler::signature::Type;
use motet_syntax::unit::{Dimension, Unit};

use super::Decimal;

/// The numbers from `least` to `greatest`, in SI units, with a fixed number of decimals.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct NumberRange {
    /// The least number, in units of the last decimal.
    pub(crate) least: i64,
    /// The greatest number, in units of the last decimal.
    pub(crate) greatest: i64,
    /// The number of decimals.
    pub(crate) decimals: u8,
    /// The unit in the text syntax; `None` for a plain number.
    pub(crate) unit: Option<Unit>,
}

impl NumberRange {
    /// Deadlines and times: 0 to 9999.999 s.
    pub(crate) const DURATION: Self =
        Self { least: 0, greatest: 9_999_999, decimals: 3, unit: Some(Unit::Second) };

    /// The whole numbers of a range, both ends included.
    #[must_use]
    pub(crate) const fn whole(least: u32, greatest: u32) -> Self {
        Self { least: least as i64, greatest: greatest as i64, decimals: 0, unit: None }
    }

    /// The numbers of a type, within the range of the robot's card if there is one; `None` if the type has
    /// no numbers or the range is empty.
    #[must_use]
    pub(crate) fn of(ty: &Type, card: Option<(f64, f64)>) -> Option<Self> {
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

    /// The range as the text syntax spells its digits: percents are a hundred times the value, with two
    /// decimals less.
    pub(crate) fn spelled_in_text(&self) -> Self {
        match self.unit {
            Some(Unit::Percent) => Self { decimals: self.decimals.saturating_sub(2), ..*self },
            Some(_) | None => *self,
        }
    }

    /// The nearest number with the range's decimals; `None` if it is out of range.
    #[must_use]
    pub(crate) fn nearest(&self, value: f64) -> Option<Decimal> {
        Decimal::nearest(value, self.decimals).filter(|decimal| self.contains(*decimal))
    }

    /// The number has the range's decimals and lies in it.
    #[must_use]
    pub(crate) fn contains(&self, decimal: Decimal) -> bool {
        decimal.decimals == self.decimals && (self.least..=self.greatest).contains(&decimal.units)
    }
}
