//! Numbers with a bounded count of decimals, printed in one way: `-1.5`, `0`, `0.25`.

use std::fmt;

/// A decimal number: `units` of 10 to the power of `-decimals`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Decimal {
    /// How many units of the last decimal.
    pub units: i64,
    /// How many decimals, at most 6.
    pub decimals: u8,
}

impl Decimal {
    /// The nearest number with so many decimals; none where it has no 15 digits.
    #[must_use]
    pub fn nearest(value: f64, decimals: u8) -> Option<Self> {
        let scaled = (value * Self::scale(decimals)).round();
        let is_exact = scaled.is_finite() && scaled.abs() < 1e15;
        // Below 2^53 every whole number has an exact place in both.
        is_exact.then_some(Self { units: scaled as i64, decimals })
    }

    /// Ten to the power of the count of decimals.
    pub(crate) fn scale(decimals: u8) -> f64 {
        10f64.powi(i32::from(decimals))
    }

    /// As a number, the one that its digits read as.
    #[must_use]
    pub fn value(self) -> f64 {
        self.to_string().parse().unwrap_or(0.0)
    }

    /// A hundred times the number.
    #[must_use]
    pub fn percent(self) -> Self {
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
