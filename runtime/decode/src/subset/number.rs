//! Numbers of the canonical subset: their ranges, decimals with one spelling each (`-1.5`, `0`, `0.25`), and
//! the digits of a number so far.

use std::fmt;

use motet_compiler::signature::Type;
use motet_syntax::unit::{Dimension, Unit};

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
    /// Deadlines: 0.001 to 9999.999 s.
    pub(crate) const DEADLINE: Self = Self { least: 1, ..Self::DURATION };

    /// Times: 0 to 9999.999 s.
    pub(crate) const DURATION: Self =
        Self { least: 0, greatest: 9_999_999, decimals: 3, unit: Some(Unit::Second) };

    /// Parts of the robot's speed and acceleration: 1 % to 100 %.
    pub(crate) const PART: Self = Self { least: 10, greatest: 1000, decimals: 3, unit: Some(Unit::Percent) };

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
            Type::Bool | Type::Text | Type::Pose | Type::Failure | Type::Entity(_) => return None,
            Type::Enum(_) | Type::List(_) => return None,
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

    /// The numbers of a pose: three coordinates and the turn about the vertical.
    pub(crate) fn of_pose() -> [Self; 4] {
        let number =
            |decimals, greatest: i64, unit| Self { least: -greatest, greatest, decimals, unit: Some(unit) };
        let length = number(3, 1_000_000, Unit::Metre);
        [length, length, length, number(4, 1_000_000, Unit::Radian)]
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

/// A decimal number: `units` times 10 to the power of `-decimals`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Decimal {
    /// Units of the last decimal.
    pub(crate) units: i64,
    /// The number of decimals, at most 6.
    pub(crate) decimals: u8,
}

impl Decimal {
    /// The nearest decimal number; `None` if it needs more than 15 digits.
    #[must_use]
    pub(crate) fn nearest(value: f64, decimals: u8) -> Option<Self> {
        let scaled = (value * Self::scale(decimals)).round();
        let is_exact = scaled.is_finite() && scaled.abs() < 1e15;
        // Below 2^53 every whole number has an exact place in both.
        is_exact.then_some(Self { units: scaled as i64, decimals })
    }

    /// Ten to the power of the number of decimals.
    pub(crate) fn scale(decimals: u8) -> f64 {
        10f64.powi(i32::from(decimals))
    }

    /// The floating-point number that its digits read as.
    #[must_use]
    pub(crate) fn value(self) -> f64 {
        self.to_string().parse().unwrap_or(0.0)
    }

    /// The same ratio in percent: a hundred times the number.
    #[must_use]
    pub(crate) fn percent(self) -> Self {
        match self.decimals.checked_sub(2) {
            Some(decimals) => Self { units: self.units, decimals },
            None => Self { units: self.units * 10i64.pow(2 - u32::from(self.decimals)), decimals: 0 },
        }
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scale = 10u64.pow(u32::from(self.decimals));
        let size = self.units.unsigned_abs();
        let sign = if self.units < 0 { "-" } else { "" };
        write!(f, "{sign}{}", size / scale)?;
        let fraction = size % scale;
        if fraction > 0 {
            let digits = format!("{fraction:0width$}", width = usize::from(self.decimals));
            write!(f, ".{}", digits.trim_end_matches('0'))?;
        }
        Ok(())
    }
}

/// The digits of a number so far. A digit may follow if the number can still reach its range in its only
/// spelling, without a leading zero, a trailing zero behind the point, or `-0`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(crate) struct Digits {
    /// All digits read as one number.
    units: u64,
    negative: bool,
    begun: bool,
    point: bool,
    /// The number of digits behind the point.
    decimals: u8,
}

impl Digits {
    pub(crate) fn pack(self) -> (u32, u32, u32) {
        let flags = u32::from(self.negative) | u32::from(self.begun) << 1 | u32::from(self.point) << 2;
        let (low, high) = (self.units & 0xffff_ffff, self.units >> 32);
        let half = |half: u64| u32::try_from(half).unwrap_or(u32::MAX);
        (flags | u32::from(self.decimals) << 3, half(low), half(high))
    }

    pub(crate) fn unpack((pos, lo, hi): (u32, u32, u32)) -> Self {
        Self {
            units: u64::from(lo) | u64::from(hi) << 32,
            negative: pos & 1 != 0,
            begun: pos & 2 != 0,
            point: pos & 4 != 0,
            decimals: u8::try_from(pos >> 3).unwrap_or(u8::MAX),
        }
    }

    /// The digits with one more byte; `None` if they cannot become a number of the range.
    pub(crate) fn push(mut self, byte: u8, range: &NumberRange) -> Option<Self> {
        match byte {
            b'-' if !self.begun && !self.negative => self.negative = true,
            b'.' if self.begun && !self.point && range.decimals > 0 => self.point = true,
            b'0'..=b'9' => {
                let is_zero = self.begun && !self.point && self.units == 0;
                let is_full = self.point && self.decimals >= range.decimals;
                if is_zero || is_full {
                    return None;
                }
                self.units = self.units.checked_mul(10)?.checked_add(u64::from(byte - b'0'))?;
                self.begun = true;
                self.decimals += u8::from(self.point);
            }
            _ => return None,
        }
        self.can_be(range).then_some(self)
    }

    /// The number in units of the last decimal, if it is in the range and canonically spelled.
    pub(crate) fn finish(self, range: &NumberRange) -> Option<i64> {
        let ends_well = self.begun && if self.point { !self.units.is_multiple_of(10) } else { true };
        let is_zero = self.negative && self.units == 0;
        if !ends_well || is_zero || (self.point && self.decimals == 0) {
            return None;
        }
        let missing = range.decimals.checked_sub(self.decimals)?;
        let size = i64::try_from(self.units.checked_mul(10u64.checked_pow(u32::from(missing))?)?).ok()?;
        let units = if self.negative { -size } else { size };
        (range.least..=range.greatest).contains(&units).then_some(units)
    }

    /// Some more digits, or none, make it a number of the range.
    fn can_be(self, range: &NumberRange) -> bool {
        if self.finish(range).is_some() {
            return true;
        }
        // The magnitudes that the sign leaves.
        let (least, greatest) = if self.negative {
            (1.max(range.greatest.saturating_neg()), range.least.saturating_neg())
        } else {
            (0.max(range.least), range.greatest)
        };
        if greatest < least {
            return false;
        }
        let (least, greatest) = (least.unsigned_abs(), greatest.unsigned_abs());
        if !self.begun {
            return true;
        }
        let Some(step) = range.decimals.checked_sub(self.decimals) else { return false };
        let Some(scale) = 10u64.checked_pow(u32::from(step)) else { return false };
        let Some(first) = self.units.checked_mul(scale) else { return false };
        if self.point {
            // At least one more digit follows, and the last is not zero: the number grows.
            return step > 0 && first < greatest && first + (scale - 1) >= least && scale > 1;
        }
        // Decimals may follow, or more digits before the point.
        let (mut low, mut size) = (first, scale);
        loop {
            if low <= greatest && low + (size - 1) >= least {
                return true;
            }
            if self.units == 0 || low > greatest {
                return false;
            }
            let (Some(next_low), Some(next_size)) = (low.checked_mul(10), size.checked_mul(10)) else {
                return false;
            };
            (low, size) = (next_low, next_size);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::expect_used, reason = "a test fails by panicking")]

    use super::*;

    fn spelled(text: &str, range: &NumberRange) -> Option<Digits> {
        text.bytes().try_fold(Digits::default(), |digits, byte| digits.push(byte, range))
    }

    #[test]
    fn every_number_of_a_range_is_spelled_in_one_alternative() {
        for (least, greatest, decimals) in
            [(-120, 345, 2), (0, 99, 0), (5, 17, 1), (-20, -3, 1), (1, 9, 0), (995, 1005, 3), (0, 0, 2)]
        {
            let range = NumberRange { least, greatest, decimals, unit: None };
            let mut found = Vec::new();
            let mut open = vec![String::new()];
            while let Some(text) = open.pop() {
                let digits = spelled(&text, &range).expect("it was viable");
                found.extend(digits.finish(&range));
                let before = open.len();
                for byte in b"-.0123456789" {
                    let next = format!("{text}{}", char::from(*byte));
                    if spelled(&next, &range).is_some() {
                        open.push(next);
                    }
                }
                assert!(open.len() > before || digits.finish(&range).is_some(), "{text} leads nowhere");
            }
            found.sort_unstable();
            assert_eq!(found, (least..=greatest).collect::<Vec<_>>(), "{least}..={greatest}, {decimals}");
        }
    }
}
