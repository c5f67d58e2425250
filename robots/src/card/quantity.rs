//! Quantities of a card: each read from a number or from a text with a unit, checked, in SI units.

use motet_syntax::unit::{Dimension, Unit};
use motet_syntax::{Diagnostic, FileId, Span};

use super::diagnostics::{BadQuantity, EmptyRange, OutOfRange, WrongDimension};
use super::model::Range;
use super::wire;
use super::wire::{TomlSpanned, WrittenQuantity};
use crate::clearance::GREATEST_CLEARANCE;

/// Allowed sign of a number.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Sign {
    Positive,
    /// Zero or more.
    NotNegative,
    Any,
}

/// Upper end of a length, in m and as words.
#[derive(Clone, Copy)]
pub(super) struct Greatest(f64, &'static str);

impl Greatest {
    /// Upper end of a clearance.
    pub(super) const CLEARANCE: Self = Self(GREATEST_CLEARANCE, "at most 0.5 m");
    /// Upper end of an error: two of them are a clearance.
    pub(super) const ERROR: Self = Self(GREATEST_CLEARANCE / 2.0, "at most 0.25 m");
}

/// Greatest length, mass, time or speed of a robot.
const GREATEST: f64 = 1e6;

/// Reads quantities and collects diagnostics.
pub(super) struct QuantityReader {
    pub(super) file: FileId,
    pub(super) found: Vec<Diagnostic>,
}

impl QuantityReader {
    pub(super) fn span<T>(&self, at: &TomlSpanned<T>) -> Span {
        let range = at.0.span();
        Span::new(self.file, range.start, range.end)
    }

    /// Reads a quantity of a known dimension; 0 if it is wrong.
    pub(super) fn of(
        &mut self,
        key: &str,
        at: &TomlSpanned<WrittenQuantity>,
        dimension: Dimension,
        sign: Sign,
    ) -> f64 {
        let Some((value, found)) = self.in_one_of(key, at, &units_of(dimension)) else { return 0.0 };
        if let Some(unit) = found.filter(|unit| unit.dimension() != dimension) {
            let units = units_of(dimension);
            let mistake =
                WrongDimension { span: self.span(at), key: key.to_owned(), unit: unit.symbol(), units };
            self.found.push(mistake.into());
            return 0.0;
        }
        self.checked(key, self.span(at), value, sign)
    }

    /// Reads a length from 0 to an upper end; 0 if it is wrong.
    pub(super) fn up_to(
        &mut self,
        key: &str,
        at: &TomlSpanned<WrittenQuantity>,
        Greatest(greatest, wanted): Greatest,
    ) -> f64 {
        let value = self.of(key, at, Dimension::LENGTH, Sign::NotNegative);
        if value <= greatest {
            return value;
        }
        let (span, actual) = (self.span(at), format!("{value} m"));
        self.found.push(OutOfRange { span, key: key.to_owned(), actual, wanted }.into());
        0.0
    }

    /// Reads a part, above 0 and at most 1; 1 if it is wrong.
    pub(super) fn part(&mut self, key: &str, at: &TomlSpanned<WrittenQuantity>) -> f64 {
        let before = self.found.len();
        let value = self.of(key, at, Dimension::NONE, Sign::Positive);
        if self.found.len() == before && value <= 1.0 {
            return value;
        }
        if self.found.len() == before {
            let (span, wanted) = (self.span(at), "at most 1");
            let actual = value.to_string();
            self.found.push(OutOfRange { span, key: key.to_owned(), actual, wanted }.into());
        }
        1.0
    }

    /// Reads a quantity of any dimension with its unit, in SI units.
    pub(super) fn any(
        &mut self,
        key: &str,
        at: &TomlSpanned<WrittenQuantity>,
    ) -> Option<(f64, Option<Unit>)> {
        self.in_one_of(key, at, &["m", "cm", "mm", "rad", "deg", "s", "ms", "kg", "g", "N", "m/s", "%"])
    }

    fn in_one_of(
        &mut self,
        key: &str,
        at: &TomlSpanned<WrittenQuantity>,
        units: &[&'static str],
    ) -> Option<(f64, Option<Unit>)> {
        let text = match at.get() {
            WrittenQuantity::Number(value) => return Some((*value, None)),
            WrittenQuantity::Text(text) => text,
        };
        let split = text.find(|c: char| !(c.is_ascii_digit() || ".+-eE_".contains(c))).unwrap_or(text.len());
        let (number, symbol) = text.split_at_checked(split).unwrap_or((text, ""));
        let parsed = number.parse::<f64>().ok().zip(Unit::parse(symbol.trim()));
        if parsed.is_none() {
            let units = units.to_vec();
            let mistake = BadQuantity { span: self.span(at), key: key.to_owned(), text: text.clone(), units };
            self.found.push(mistake.into());
        }
        parsed.map(|(value, unit)| (unit.to_si(value), Some(unit)))
    }

    /// Reads a number without a unit; 0 if it is impossible.
    pub(super) fn plain(&mut self, key: &str, at: &TomlSpanned<f64>, sign: Sign) -> f64 {
        self.checked(key, self.span(at), *at.get(), sign)
    }

    /// Checks a number; 0 if it is impossible.
    pub(super) fn checked(&mut self, key: &str, span: Span, value: f64, sign: Sign) -> f64 {
        let (fits, wanted) = match sign {
            Sign::Positive => (value > 0.0, "above zero"),
            Sign::NotNegative => (value >= 0.0, "zero or more"),
            Sign::Any => (true, "a finite number"),
        };
        let wanted = if !value.is_finite() {
            "a finite number"
        } else if !fits {
            wanted
        } else if value.abs() > GREATEST {
            "at most a million"
        } else {
            return value;
        };
        self.found.push(OutOfRange { span, key: key.to_owned(), actual: value.to_string(), wanted }.into());
        0.0
    }

    /// Dimension of the first unit in an interval; its mistakes are reported elsewhere.
    pub(super) fn written(&mut self, at: &wire::RangeTable) -> Option<Dimension> {
        let before = self.found.len();
        let mut unit = |at| self.any("", at).and_then(|(_, unit)| unit);
        let unit = unit(&at.least).or_else(|| unit(&at.greatest));
        self.found.truncate(before);
        unit.map(Unit::dimension)
    }

    /// Reads an interval of a known dimension, or of any.
    pub(super) fn range(&mut self, key: &str, at: &wire::RangeTable, dimension: Option<Dimension>) -> Range {
        let before = self.found.len();
        // The first unit decides the dimension; a bare number follows it.
        let dimension = dimension.or_else(|| self.written(at)).unwrap_or(Dimension::NONE);
        let least = self.of(&format!("{key}.least"), &at.least, dimension, Sign::Any);
        let greatest = self.of(&format!("{key}.greatest"), &at.greatest, dimension, Sign::Any);
        if self.found.len() == before && least > greatest {
            let (span, other) = (self.span(&at.least), self.span(&at.greatest));
            self.found.push(EmptyRange { span, key: key.to_owned(), least, greatest, other }.into());
        }
        Range { least, greatest }
    }
}

/// Units of a dimension; none for one without units of its own.
pub(super) fn units_of(dimension: Dimension) -> Vec<&'static str> {
    Unit::symbols_of(dimension).collect()
}
