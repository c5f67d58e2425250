//! Ranges of decimal numbers as expressions: exactly the canonical digits of the numbers in the range.

use super::grammar::Expr;
use crate::subset::NumberRange;

/// The numbers of a range as JSON and, before the unit, the text form write them.
pub(super) fn expr(range: &NumberRange) -> Expr {
    let decimals = u32::from(range.decimals);
    let mut alternatives = Vec::new();
    if range.greatest >= 0 {
        alternatives.push(magnitude(size(range.least.max(0)), size(range.greatest), decimals));
    }
    if range.least < 0 {
        let nearest = if range.greatest < 0 { size(range.greatest) } else { 1 };
        let digits = magnitude(nearest, size(range.least), decimals);
        alternatives.push(Expr::seq(vec![Expr::literal("-"), digits]));
    }
    Expr::choice(alternatives)
}

fn size(units: i64) -> u64 {
    units.unsigned_abs()
}

/// From `low` to `high` units of the last decimal.
fn magnitude(low: u64, high: u64, decimals: u32) -> Expr {
    let scale = 10u64.pow(decimals);
    let (mut low_whole, low_rest) = (low / scale, low % scale);
    let (mut high_whole, high_rest) = (high / scale, high % scale);
    let point = |whole: u64, from: u64, to: u64| {
        Expr::seq(vec![Expr::literal(whole.to_string()), fraction(from, to, decimals)])
    };
    if low_whole == high_whole {
        return point(low_whole, low_rest, high_rest);
    }
    let mut alternatives = Vec::new();
    if low_rest > 0 {
        alternatives.push(point(low_whole, low_rest, scale - 1));
        low_whole += 1;
    }
    let mut last = None;
    if high_rest + 1 < scale {
        last = Some(point(high_whole, 0, high_rest));
        high_whole -= 1;
    }
    if low_whole <= high_whole {
        let any = fraction(0, scale - 1, decimals);
        alternatives.push(Expr::seq(vec![whole(low_whole, high_whole), any]));
    }
    alternatives.extend(last);
    Expr::choice(alternatives)
}

/// Nothing, or a point and digits that do not end in 0.
fn fraction(low: u64, high: u64, width: u32) -> Expr {
    if width == 0 || high == 0 {
        return Expr::Seq(Vec::new());
    }
    let digits = Expr::seq(vec![Expr::literal("."), decimals(low.max(1), high, width)]);
    if low == 0 { digits.optional() } else { digits }
}

/// Digits that do not end in 0 and that, filled up with zeros to the width, lie between two numbers; also no digit at all
/// where the lower number is 0.
fn decimals(low: u64, high: u64, width: u32) -> Expr {
    if width == 0 || high == 0 {
        return Expr::Seq(Vec::new());
    }
    let unit = 10u64.pow(width - 1);
    let last = unit * 10 - 1;
    let any = Expr::seq(vec![digit('0', '9').repeat(0, width - 1), digit('1', '9')]);
    match (low, high == last) {
        (0, true) => return any.optional(),
        (1, true) => return any,
        _ => {}
    }
    let mut alternatives = Vec::new();
    let mut full: Option<(char, char)> = None;
    for (first, character) in (0u64..10).zip('0'..='9') {
        let start = first * unit;
        // After a leading 0 a digit other than 0 has to come, or the number ends in 0.
        let least = if first == 0 { 1 } else { 0 };
        let from = low.saturating_sub(start).max(least);
        let Some(to) = high.checked_sub(start).map(|to| to.min(unit - 1)) else { continue };
        if from > to || (first == 0 && unit == 1) {
            continue;
        }
        if from == 0 && to == unit - 1 {
            full = Some((full.map_or(character, |(start, _)| start), character));
        } else {
            let rest = decimals(from, to, width - 1);
            alternatives.push(Expr::seq(vec![Expr::literal(character.to_string()), rest]));
        }
    }
    if let Some((from, to)) = full {
        let rest = decimals(0, unit - 1, width - 1);
        alternatives.push(Expr::seq(vec![digit(from, to), rest]));
    }
    let some = Expr::choice(alternatives);
    if low == 0 { some.optional() } else { some }
}

/// Whole numbers without leading zeros.
fn whole(low: u64, high: u64) -> Expr {
    let mut alternatives = Vec::new();
    let mut from = low;
    while from <= high {
        let width = from.to_string().len() as u32;
        let to = high.min(10u64.pow(width) - 1);
        alternatives.push(fixed(from, to, width));
        from = to + 1;
    }
    Expr::choice(alternatives)
}

/// Exactly so many digits, leading zeros among them.
fn fixed(low: u64, high: u64, width: u32) -> Expr {
    if width == 0 {
        return Expr::Seq(Vec::new());
    }
    let unit = 10u64.pow(width - 1);
    let mut alternatives = Vec::new();
    let mut full: Option<(char, char)> = None;
    for (first, character) in (0u64..10).zip('0'..='9') {
        let start = first * unit;
        let from = low.saturating_sub(start);
        let Some(to) = high.checked_sub(start).map(|to| to.min(unit - 1)) else { continue };
        if from > to {
            continue;
        }
        if from == 0 && to == unit - 1 {
            full = Some((full.map_or(character, |(start, _)| start), character));
        } else {
            let rest = fixed(from, to, width - 1);
            alternatives.push(Expr::seq(vec![Expr::literal(character.to_string()), rest]));
        }
    }
    if let Some((from, to)) = full {
        let rest = digit('0', '9').repeat(width - 1, width - 1);
        let rest = if width == 1 { Expr::Seq(Vec::new()) } else { rest };
        alternatives.push(Expr::seq(vec![digit(from, to), rest]));
    }
    Expr::choice(alternatives)
}

fn digit(from: char, to: char) -> Expr {
    if from == to { Expr::literal(from.to_string()) } else { Expr::Class(vec![(from, to)]) }
}
