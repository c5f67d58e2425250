//! Numbers, digit by digit: which digits may follow so that the number can still be in its range and in its one spelling,
//! without a leading zero, a trailing one behind the point, or `-0`.

use crate::subset::NumberRange;

/// The digits of a number so far.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub(crate) struct Digits {
    /// All digits as one number.
    units: u64,
    negative: bool,
    begun: bool,
    point: bool,
    /// How many stand behind the point.
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

    /// The digits with one more byte, where they can still become a number of the range.
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

    /// The number, where it is one of the range and spelled as it has to be.
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

    /// Whether some digits more, or none, make it a number of the range.
    fn can_be(self, range: &NumberRange) -> bool {
        if self.finish(range).is_some() {
            return true;
        }
        // The sizes that the sign leaves.
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
            // At least one more digit, and the last of them no zero: more than what stands there.
            return step > 0 && first < greatest && first + (scale - 1) >= least && scale > 1;
        }
        // Decimals behind it, or more digits before the point.
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
    fn every_number_of_a_range_is_spelled_in_one_way() {
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
