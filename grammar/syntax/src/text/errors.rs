//! What can be wrong with the text form. Raised by [`super::scan`] before parsing, by [`super::explain`] for what the
//! grammar refuses, and by the builders for what it cannot see.

use smol_str::SmolStr;

use crate::diagnostic::{Code, Edit, Fix, Mistake, Related};
use crate::source::Span;
use crate::suggest;
use crate::unit::Unit;

/// The text does not follow the grammar.
#[derive(Clone, Debug, Default)]
pub struct TextSyntax {
    /// The word or mark that does not fit.
    pub span: Span,
    /// What is wrong, as a clause.
    pub message: String,
    /// What to write instead, where it is known.
    pub help: Option<String>,
    /// The other place, such as the bracket that is open.
    pub related: Option<(&'static str, Span)>,
    /// What to write in place of the span, where that is sure to be right.
    pub fix: Option<String>,
}

impl Mistake for TextSyntax {
    const CODE: Code = Code("M0101");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        self.message.clone()
    }
    fn help(&self) -> Option<String> {
        self.help.clone()
    }
    fn related(&self) -> Vec<Related> {
        self.related.iter().map(|(words, span)| Related::new(*words, *span)).collect()
    }
    fn fix(&self) -> Option<Fix> {
        self.fix.as_ref().map(|text| {
            let title = if text.is_empty() { "remove it".into() } else { format!("write `{text}`") };
            Fix { title, edits: vec![Edit { span: self.span, text: text.clone() }] }
        })
    }
}

/// A word after a number that is no unit.
#[derive(Clone, Debug)]
pub struct UnknownUnit {
    /// The word.
    pub span: Span,
    /// As written.
    pub unit: SmolStr,
}

/// Other ways in which people write the units.
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

impl UnknownUnit {
    /// The unit that was meant, where that is clear.
    #[must_use]
    pub fn meant(unit: &str) -> Option<Unit> {
        let lower = unit.to_ascii_lowercase();
        let spelling = SPELLINGS.iter().find(|(word, _)| *word == lower).map(|(_, meant)| *meant);
        spelling.or_else(|| Unit::parse(&lower)).or_else(|| Unit::parse(&unit.to_ascii_uppercase()))
    }
}

impl Mistake for UnknownUnit {
    const CODE: Code = Code("M0120");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("unknown unit `{}`", self.unit)
    }
    fn help(&self) -> Option<String> {
        Some(match Self::meant(&self.unit) {
            Some(meant) => format!("did you mean `{}`?", meant.symbol()),
            None => format!("the units are {}", suggest::one_of(Unit::ALL.iter().map(|unit| unit.symbol()))),
        })
    }
    fn fix(&self) -> Option<Fix> {
        Self::meant(&self.unit).map(|meant| Fix {
            title: format!("write `{}`", meant.symbol()),
            edits: vec![Edit { span: self.span, text: meant.symbol().into() }],
        })
    }
}
