//! A span of time on the command line: `90s`, `10 min`, `1h`.

use motet_syntax::unit::{Dimension, Unit};

/// Reads a number with a unit of time; in seconds.
///
/// # Errors
///
/// What is wrong with it, for clap to print.
pub(crate) fn duration(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let end = text.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(text.len());
    let (number, unit) = text.split_at_checked(end).unwrap_or((text, ""));
    let wrong = || "write a number with ms, s, min or h, such as 90s or 10min".to_owned();
    let unit =
        Unit::parse(unit.trim()).filter(|unit| unit.dimension() == Dimension::DURATION).ok_or_else(wrong)?;
    let secs = unit.to_si(number.parse().map_err(|_| wrong())?);
    if secs.is_finite() && secs > 0.0 { Ok(secs) } else { Err("it must be longer than nothing".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::duration;

    #[test]
    fn reads_times() {
        for (text, secs) in [("90s", 90.0), ("10min", 600.0), ("1.5 h", 5400.0), ("200ms", 0.2)] {
            assert_eq!(duration(text), Ok(secs), "{text}");
        }
        for text in ["", "10", "s", "-5s", "0s", "1e9s", "10 weeks", "1.2.3s", "∞ s"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }
}
