//! Dimensions and units. Inside, everything is SI and radians; a unit exists only where a document is read or
//! written.

/// Physical dimension of a quantity, as exponents of the base units metre, second, kilogram and radian.
///
/// `Ratio` and plain numbers have all exponents zero.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, PartialOrd, Ord)]
pub struct Dimension {
    /// Exponent of the metre.
    pub metre: i8,
    /// Exponent of the second.
    pub second: i8,
    /// Exponent of the kilogram.
    pub kilogram: i8,
    /// Exponent of the radian.
    pub radian: i8,
}

impl Dimension {
    /// No dimension, as of `Number` and `Ratio`.
    pub const NONE: Self = Self { metre: 0, second: 0, kilogram: 0, radian: 0 };
    /// Dimension of `Length`, in metres.
    pub const LENGTH: Self = Self { metre: 1, ..Self::NONE };
    /// Dimension of `Angle`, in radians.
    pub const ANGLE: Self = Self { radian: 1, ..Self::NONE };
    /// Dimension of `Duration`, in seconds.
    pub const DURATION: Self = Self { second: 1, ..Self::NONE };
    /// Dimension of `Mass`, in kilograms.
    pub const MASS: Self = Self { kilogram: 1, ..Self::NONE };
    /// Dimension of `Force`, in newtons.
    pub const FORCE: Self = Self { metre: 1, second: -2, kilogram: 1, radian: 0 };
    /// Dimension of `Speed`, in metres a second.
    pub const SPEED: Self = Self { metre: 1, second: -1, ..Self::NONE };

    /// The dimension of a product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self {
            metre: self.metre.saturating_add(other.metre),
            second: self.second.saturating_add(other.second),
            kilogram: self.kilogram.saturating_add(other.kilogram),
            radian: self.radian.saturating_add(other.radian),
        }
    }

    /// The dimension of a quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        Self {
            metre: self.metre.saturating_sub(other.metre),
            second: self.second.saturating_sub(other.second),
            kilogram: self.kilogram.saturating_sub(other.kilogram),
            radian: self.radian.saturating_sub(other.radian),
        }
    }

    /// The name of the type with this dimension, where the language has one.
    #[must_use]
    pub fn type_name(self) -> Option<&'static str> {
        DIMENSIONS.iter().find(|(_, dimension)| *dimension == self).map(|(name, _)| *name)
    }

    /// The dimension of a quantity type by its name.
    #[must_use]
    pub fn of_type(name: &str) -> Option<Self> {
        DIMENSIONS.iter().find(|(known, _)| *known == name).map(|(_, dimension)| *dimension)
    }

    /// The symbol of its SI unit; empty for [`Dimension::NONE`] and for dimensions without a unit of their
    /// own.
    #[must_use]
    pub fn si_symbol(self) -> &'static str {
        Unit::si(self).map_or("", Unit::symbol)
    }
}

const DIMENSIONS: &[(&str, Dimension)] = &[
    ("Length", Dimension::LENGTH),
    ("Angle", Dimension::ANGLE),
    ("Duration", Dimension::DURATION),
    ("Mass", Dimension::MASS),
    ("Force", Dimension::FORCE),
    ("Speed", Dimension::SPEED),
    ("Ratio", Dimension::NONE),
];

/// A unit as written in a document.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, PartialOrd, Ord)]
pub enum Unit {
    Metre,
    Centimetre,
    Millimetre,
    Kilometre,
    Radian,
    Degree,
    Second,
    Millisecond,
    Minute,
    Hour,
    Kilogram,
    Gram,
    Newton,
    MetrePerSecond,
    KilometrePerHour,
    Percent,
}

/// Unit, symbol, dimension, and the factor to SI as a fraction, so that `7 cm` is exactly `7.0 / 100.0`.
const UNITS: &[(Unit, &str, Dimension, f64, f64)] = &[
    (Unit::Metre, "m", Dimension::LENGTH, 1.0, 1.0),
    (Unit::Centimetre, "cm", Dimension::LENGTH, 1.0, 100.0),
    (Unit::Millimetre, "mm", Dimension::LENGTH, 1.0, 1000.0),
    (Unit::Kilometre, "km", Dimension::LENGTH, 1000.0, 1.0),
    (Unit::Radian, "rad", Dimension::ANGLE, 1.0, 1.0),
    (Unit::Degree, "deg", Dimension::ANGLE, std::f64::consts::PI, 180.0),
    (Unit::Second, "s", Dimension::DURATION, 1.0, 1.0),
    (Unit::Millisecond, "ms", Dimension::DURATION, 1.0, 1000.0),
    (Unit::Minute, "min", Dimension::DURATION, 60.0, 1.0),
    (Unit::Hour, "h", Dimension::DURATION, 3600.0, 1.0),
    (Unit::Kilogram, "kg", Dimension::MASS, 1.0, 1.0),
    (Unit::Gram, "g", Dimension::MASS, 1.0, 1000.0),
    (Unit::Newton, "N", Dimension::FORCE, 1.0, 1.0),
    (Unit::MetrePerSecond, "m/s", Dimension::SPEED, 1.0, 1.0),
    (Unit::KilometrePerHour, "km/h", Dimension::SPEED, 1.0, 3.6),
    (Unit::Percent, "%", Dimension::NONE, 1.0, 100.0),
];

/// Other spellings of units, in lower case.
const SPELLINGS: &[(&str, Unit)] = &[
    ("sec", Unit::Second),
    ("secs", Unit::Second),
    ("second", Unit::Second),
    ("seconds", Unit::Second),
    ("msec", Unit::Millisecond),
    ("millisecond", Unit::Millisecond),
    ("milliseconds", Unit::Millisecond),
    ("mins", Unit::Minute),
    ("minute", Unit::Minute),
    ("minutes", Unit::Minute),
    ("hour", Unit::Hour),
    ("hours", Unit::Hour),
    ("meter", Unit::Metre),
    ("meters", Unit::Metre),
    ("metre", Unit::Metre),
    ("metres", Unit::Metre),
    ("centimeter", Unit::Centimetre),
    ("centimeters", Unit::Centimetre),
    ("centimetre", Unit::Centimetre),
    ("centimetres", Unit::Centimetre),
    ("millimeters", Unit::Millimetre),
    ("millimetres", Unit::Millimetre),
    ("degree", Unit::Degree),
    ("degrees", Unit::Degree),
    ("radian", Unit::Radian),
    ("radians", Unit::Radian),
    ("gram", Unit::Gram),
    ("grams", Unit::Gram),
    ("kilo", Unit::Kilogram),
    ("kilogram", Unit::Kilogram),
    ("kilograms", Unit::Kilogram),
    ("newton", Unit::Newton),
    ("newtons", Unit::Newton),
    ("percent", Unit::Percent),
];

impl Unit {
    /// Every unit, by dimension.
    pub const ALL: &[Self] = &[
        Self::Metre,
        Self::Centimetre,
        Self::Millimetre,
        Self::Kilometre,
        Self::Radian,
        Self::Degree,
        Self::Second,
        Self::Millisecond,
        Self::Minute,
        Self::Hour,
        Self::Kilogram,
        Self::Gram,
        Self::Newton,
        Self::MetrePerSecond,
        Self::KilometrePerHour,
        Self::Percent,
    ];

    /// The unit with this symbol; case matters.
    #[must_use]
    pub fn parse(symbol: &str) -> Option<Self> {
        UNITS.iter().find(|row| row.1 == symbol).map(|row| row.0)
    }

    /// The unit that a word means where it is not a symbol: `sec`, `Metres`, `KG`. `None` for any other word.
    #[must_use]
    pub fn from_spelling(word: &str) -> Option<Self> {
        let lower = word.to_ascii_lowercase();
        let spelling = SPELLINGS.iter().find(|(known, _)| *known == lower).map(|(_, unit)| *unit);
        spelling.or_else(|| Self::parse(&lower)).or_else(|| Self::parse(&word.to_ascii_uppercase()))
    }

    fn row(self) -> (&'static str, Dimension, f64, f64) {
        UNITS
            .iter()
            .find(|row| row.0 == self)
            .map_or(("", Dimension::NONE, 1.0, 1.0), |row| (row.1, row.2, row.3, row.4))
    }

    /// Symbol as written in a document.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        self.row().0
    }

    /// Dimension of the unit.
    #[must_use]
    pub fn dimension(self) -> Dimension {
        self.row().1
    }

    /// A number of this unit, in SI units (a percentage as a ratio).
    ///
    /// ```
    /// use motet_syntax::unit::Unit;
    ///
    /// assert_eq!(Unit::Centimetre.to_si(7.0), 0.07);
    /// ```
    #[must_use]
    pub fn to_si(self, value: f64) -> f64 {
        let (_, _, numerator, denominator) = self.row();
        value * numerator / denominator
    }

    /// A value in SI units as a number of this unit.
    #[must_use]
    pub fn from_si(self, si: f64) -> f64 {
        let (_, _, numerator, denominator) = self.row();
        si * denominator / numerator
    }

    /// A value in SI units as a number of this unit, to nine digits: `720 deg`.
    #[must_use]
    pub fn show(self, si: f64) -> String {
        let (symbol, value) = (self.symbol(), self.from_si(si));
        let digits = if value == 0.0 { 0.0 } else { 8.0 - value.abs().log10().floor() };
        let scale = 10_f64.powf(digits.clamp(0.0, 12.0));
        format!("{} {symbol}", (value * scale).round() / scale)
    }

    /// The SI unit of a dimension, where the language has one.
    #[must_use]
    pub fn si(dimension: Dimension) -> Option<Self> {
        UNITS.iter().find(|row| row.2 == dimension && row.3 == 1.0 && row.4 == 1.0).map(|row| row.0)
    }

    /// Every unit's symbol for a dimension, SI first.
    pub fn symbols_of(dimension: Dimension) -> impl Iterator<Item = &'static str> {
        UNITS.iter().filter(move |row| row.2 == dimension).map(|row| row.1)
    }
}

/// Reads a quantity such as `"20 cm"`: a number, perhaps spaces, and the symbol of a unit. `None` for any
/// other text.
///
/// ```
/// use motet_syntax::unit::{Unit, parse_quantity};
///
/// assert_eq!(parse_quantity("20 cm"), Some((20.0, Unit::Centimetre)));
/// assert_eq!(parse_quantity("20 cubits"), None);
/// ```
#[must_use]
pub fn parse_quantity(text: &str) -> Option<(f64, Unit)> {
    let text = text.trim();
    let sign = usize::from(text.starts_with('-'));
    let digits = text.get(sign..).map_or(0, number_length);
    let (number, unit) = text.split_at_checked(sign + digits).filter(|_| digits > 0)?;
    let unit = Unit::parse(unit.trim_start())?;
    let value: f64 = number.parse().ok()?;
    value.is_finite().then_some((value, unit))
}

/// Length in bytes of the unsigned number at the start of a text: digits, one fraction, one exponent. 0
/// without digits.
pub(crate) fn number_length(text: &str) -> usize {
    let digits = |from: usize| {
        text.get(from..).map_or(0, |rest| rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()))
    };
    let mut length = digits(0);
    if length == 0 {
        return 0;
    }
    let mark = |at: usize| text.as_bytes().get(at).copied();
    if mark(length) == Some(b'.') && digits(length + 1) > 0 {
        length += 1 + digits(length + 1);
    }
    if let Some(b'e' | b'E') = mark(length) {
        let sign = usize::from(matches!(mark(length + 1), Some(b'+' | b'-')));
        let exponent = digits(length + 1 + sign);
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}
