//! Values of expressions, with the meaning that Python gives to them.

use std::cmp::Ordering;

/// Greatest number of elements of a list, and of bytes of a text, that an expression makes.
pub(super) const MOST: usize = 1_000_000;

#[derive(Clone, PartialEq, Debug)]
pub(super) enum Value {
    None,
    Bool(bool),
    Int(i64),
    Float(f64),
    Text(String),
    List(Vec<Value>),
    /// Entries in their order.
    Dict(Vec<(String, Value)>),
}

impl Value {
    /// Value of the text of an attribute: a number or a truth where it is one.
    pub(super) fn of_literal(text: &str) -> Self {
        if let Some(inner) = text.strip_prefix('\'').and_then(|rest| rest.strip_suffix('\'')) {
            return Self::Text(inner.to_owned());
        }
        // Python reads underscores in numbers, and xacro takes such words as text.
        let word = text.trim();
        if word.contains('_') {
            return Self::Text(text.to_owned());
        }
        if let Ok(int) = word.parse() {
            return Self::Int(int);
        }
        // Rust reads `inf` and `nan` as numbers, too.
        if let Ok(float) = word.parse() {
            return Self::Float(float);
        }
        match word {
            "true" | "True" => Self::Bool(true),
            "false" | "False" => Self::Bool(false),
            _ => Self::Text(text.to_owned()),
        }
    }

    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Bool(value) => Some(f64::from(u8::from(*value))),
            #[allow(clippy::cast_precision_loss, reason = "Python rounds so, too")]
            Self::Int(value) => Some(*value as f64),
            Self::Float(value) => Some(*value),
            _ => None,
        }
    }

    pub(super) fn int(&self) -> Option<i64> {
        match self {
            Self::Bool(value) => Some(i64::from(*value)),
            Self::Int(value) => Some(*value),
            _ => None,
        }
    }

    /// Truth in a condition of Python.
    pub(super) fn is_true(&self) -> bool {
        match self {
            Self::None => false,
            Self::Bool(value) => *value,
            Self::Int(value) => *value != 0,
            Self::Float(value) => *value != 0.0,
            Self::Text(text) => !text.is_empty(),
            Self::List(values) => !values.is_empty(),
            Self::Dict(entries) => !entries.is_empty(),
        }
    }

    /// Truth of `value` in `xacro:if`; `None` where it is none.
    pub(super) fn condition(&self) -> Option<bool> {
        match self {
            Self::Text(text) => match Self::of_literal(text) {
                Self::Text(_) => None,
                other => other.condition(),
            },
            Self::None | Self::List(_) | Self::Dict(_) => None,
            other => Some(other.is_true()),
        }
    }

    /// Text as Python prints it.
    pub(super) fn text(&self) -> String {
        match self {
            Self::None => "None".to_owned(),
            Self::Bool(true) => "True".to_owned(),
            Self::Bool(false) => "False".to_owned(),
            Self::Int(value) => value.to_string(),
            Self::Float(value) => format!("{value:?}"),
            Self::Text(text) => text.clone(),
            Self::List(values) => {
                let parts: Vec<String> = values.iter().map(Self::quoted).collect();
                format!("[{}]", parts.join(", "))
            }
            Self::Dict(entries) => {
                let parts: Vec<String> =
                    entries.iter().map(|(key, value)| format!("'{key}': {}", value.quoted())).collect();
                format!("{{{}}}", parts.join(", "))
            }
        }
    }

    fn quoted(&self) -> String {
        if let Self::Text(text) = self { format!("'{text}'") } else { self.text() }
    }

    /// Element of a list, a text or a dictionary.
    pub(super) fn index(&self, at: &Self) -> Result<Self, String> {
        let missing = || format!("it has no element {}", at.quoted());
        match (self, at) {
            (Self::Dict(entries), key) => {
                let key = key.text();
                let found = entries.iter().find(|(own, _)| *own == key);
                found.map(|(_, value)| value.clone()).ok_or_else(missing)
            }
            (Self::List(values), at) => {
                let place = place(at, values.len()).ok_or_else(missing)?;
                values.get(place).cloned().ok_or_else(missing)
            }
            (Self::Text(text), at) => {
                let place = place(at, text.chars().count()).ok_or_else(missing)?;
                text.chars().nth(place).map(|letter| Self::Text(letter.into())).ok_or_else(missing)
            }
            (other, _) => Err(format!("{} has no elements", other.quoted())),
        }
    }

    /// Equality of Python: `1 == 1.0 == True`.
    pub(super) fn equals(&self, other: &Self) -> bool {
        match (self.number(), other.number()) {
            (Some(one), Some(two)) => one == two,
            (None, None) => self == other,
            _ => false,
        }
    }

    pub(super) fn order(&self, other: &Self) -> Result<Ordering, String> {
        let wrong = || format!("{} and {} have no order", self.quoted(), other.quoted());
        match (self, other) {
            (Self::Text(one), Self::Text(two)) => Ok(one.cmp(two)),
            _ => {
                let numbers = self.number().zip(other.number()).ok_or_else(wrong)?;
                numbers.0.partial_cmp(&numbers.1).ok_or_else(wrong)
            }
        }
    }

    /// True if a list, a text or a dictionary has an element.
    pub(super) fn contains(&self, element: &Self) -> Result<bool, String> {
        match (self, element) {
            (Self::List(values), one) => Ok(values.iter().any(|value| value.equals(one))),
            (Self::Dict(entries), one) => Ok(entries.iter().any(|(key, _)| *key == one.text())),
            (Self::Text(text), Self::Text(part)) => Ok(text.contains(part.as_str())),
            _ => Err(format!("{} has no elements", self.quoted())),
        }
    }

    /// Result of an operator on two values.
    pub(super) fn combine(&self, sign: &str, other: &Self) -> Result<Self, String> {
        match (sign, self, other) {
            ("+", Self::Text(one), Self::Text(two)) if one.len() + two.len() <= MOST => {
                return Ok(Self::Text(format!("{one}{two}")));
            }
            ("+", Self::List(one), Self::List(two)) if one.len() + two.len() <= MOST => {
                return Ok(Self::List(one.iter().chain(two).cloned().collect()));
            }
            _ => {}
        }
        if let Some((one, two)) = self.int().zip(other.int())
            && let Some(whole) = ints(sign, one, two)?
        {
            return Ok(Self::Int(whole));
        }
        let numbers = self.number().zip(other.number());
        let (one, two) = numbers
            .ok_or_else(|| format!("`{sign}` does not fit {} and {}", self.quoted(), other.quoted()))?;
        if two == 0.0 && matches!(sign, "/" | "//" | "%") {
            return Err("a division by zero".to_owned());
        }
        Ok(Self::Float(match sign {
            "+" => one + two,
            "-" => one - two,
            "*" => one * two,
            "/" => one / two,
            "//" => (one / two).floor(),
            "%" => one - two * (one / two).floor(),
            _ => libm::pow(one, two),
        }))
    }
}

/// Result of an operator on whole numbers, if it is whole.
fn ints(sign: &str, one: i64, two: i64) -> Result<Option<i64>, String> {
    let result = match sign {
        "+" => one.checked_add(two),
        "-" => one.checked_sub(two),
        "*" => one.checked_mul(two),
        "//" | "%" if two != 0 => {
            let (floor, rest) = (one.div_euclid(two), one.rem_euclid(two));
            // Python rounds towards minus infinity, and the rest has the sign of the divisor.
            let (floor, rest) = if rest != 0 && two < 0 { (floor - 1, rest + two) } else { (floor, rest) };
            Some(if sign == "%" { rest } else { floor })
        }
        "**" if two >= 0 => u32::try_from(two).ok().and_then(|two| one.checked_pow(two)),
        _ => return Ok(None),
    };
    result.map(Some).ok_or_else(|| format!("{one} {sign} {two} is too large"))
}

/// Place of an element, counted from the end if it is negative.
fn place(at: &Value, count: usize) -> Option<usize> {
    let at = at.int()?;
    let count = i64::try_from(count).ok()?;
    usize::try_from(if at < 0 { count + at } else { at }).ok()
}
