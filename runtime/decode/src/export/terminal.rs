//! Terminals of an exported grammar as expressions: texts, names and ranges of decimal numbers.

use std::collections::BTreeMap;

use motet_syntax::Syntax;
use motet_syntax::words::RESERVED;

use super::ebnf::EbnfExpr;
use crate::subset::{MAX_NAME_CHARS, MAX_TEXT_CHARS, NumberRange};

/// The characters of a text, and those with which one begins.
const TEXT: &[(char, char)] = &[(' ', '!'), ('#', '['), (']', 'z'), ('|', '|'), ('~', '~')];
const TEXT_FIRST: &[(char, char)] = &[(' ', '!'), ('#', '#'), ('%', '['), (']', 'z'), ('|', '|'), ('~', '~')];
const NAME: &[(char, char)] = &[('a', 'z'), ('A', 'Z'), ('0', '9'), ('_', '_')];
const NAME_FIRST: &[(char, char)] = &[('a', 'z'), ('A', 'Z'), ('_', '_')];

/// The names so far that a name may not be, as a tree of their letters.
#[derive(Default)]
struct Tree {
    ends: bool,
    next: BTreeMap<char, Tree>,
}

/// The terms on lists that a text may say.
pub(super) const TEXT_TERMS: [&str; 2] = ["count", "first"];

/// The fields of a failure that a text may say.
pub(super) const TEXT_FIELDS: [&str; 2] = ["kind", "text"];

/// A text, without its quotes, in which some terms on lists and some fields of failures may be said. In JSON
/// the names of lists have a `$`.
pub(super) fn text(terms: &[&str], fields: &[&str], syntax: Syntax) -> EbnfExpr {
    // A word of the language is no value.
    let plain = || name_but(RESERVED.into_iter());
    let of = |term: &&str| {
        let (mark, name) = match syntax {
            Syntax::Json => ("$", name()),
            Syntax::Text => ("", plain()),
        };
        EbnfExpr::seq(vec![EbnfExpr::literal(format!("{term}({mark}")), name, EbnfExpr::literal(")")])
    };
    let field = |field: &&str| EbnfExpr::seq(vec![plain(), EbnfExpr::literal(format!(".{field}"))]);
    let values = std::iter::once(plain()).chain(terms.iter().map(of)).chain(fields.iter().map(field));
    let values = EbnfExpr::choice(values.collect());
    let value = EbnfExpr::seq(vec![EbnfExpr::literal("{"), values, EbnfExpr::literal("}")]);
    let braces = || [EbnfExpr::literal("{{"), EbnfExpr::literal("}}"), value.clone()];
    let of = |class: &[(char, char)]| {
        EbnfExpr::choice(std::iter::once(EbnfExpr::Class(class.to_vec())).chain(braces()).collect())
    };
    EbnfExpr::seq(vec![of(TEXT_FIRST), of(TEXT).repeat(0, bound(MAX_TEXT_CHARS - 1))])
}

/// A name, whatever it is.
pub(super) fn name() -> EbnfExpr {
    let rest = EbnfExpr::Class(NAME.to_vec()).repeat(0, bound(MAX_NAME_CHARS - 1));
    EbnfExpr::seq(vec![EbnfExpr::Class(NAME_FIRST.to_vec()), rest])
}

/// A name that is none of these words.
pub(super) fn name_but<'w>(words: impl Iterator<Item = &'w str>) -> EbnfExpr {
    let mut root = Tree::default();
    for word in words.filter(|word| crate::subset::is_name(word)) {
        let end = word.chars().fold(&mut root, |tree, letter| tree.next.entry(letter).or_default());
        end.ends = true;
    }
    below(&root, 0)
}

/// Continuations of a name that has followed the tree for `letters` letters.
fn below(tree: &Tree, letters: usize) -> EbnfExpr {
    let left = MAX_NAME_CHARS.saturating_sub(letters);
    let class = if letters == 0 { NAME_FIRST } else { NAME };
    let mut alternatives = Vec::new();
    if left > 0 {
        for (letter, next) in &tree.next {
            let letter = EbnfExpr::literal(letter.to_string());
            alternatives.push(EbnfExpr::seq(vec![letter, below(next, letters + 1)]));
        }
        let others = without(class, tree.next.keys().copied());
        if !others.is_empty() {
            let rest = EbnfExpr::Class(NAME.to_vec()).repeat(0, bound(left - 1));
            let rest = if left == 1 { EbnfExpr::Seq(Vec::new()) } else { rest };
            alternatives.push(EbnfExpr::seq(vec![EbnfExpr::Class(others), rest]));
        }
    }
    let more = EbnfExpr::choice(alternatives);
    if letters > 0 && !tree.ends { more.optional() } else { more }
}

/// Ranges without some characters.
fn without(ranges: &[(char, char)], but: impl Iterator<Item = char>) -> Vec<(char, char)> {
    let mut left = ranges.to_vec();
    for letter in but {
        let (before, after) = (char::from_u32(u32::from(letter) - 1), char::from_u32(u32::from(letter) + 1));
        left = left
            .into_iter()
            .flat_map(|(from, to)| {
                if !(from..=to).contains(&letter) {
                    return [Some((from, to)), None];
                }
                let low = before.filter(|before| from <= *before).map(|before| (from, before));
                let high = after.filter(|after| *after <= to).map(|after| (after, to));
                [low, high]
            })
            .flatten()
            .collect();
    }
    left
}

fn bound(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// The numbers of a range as JSON and, before the unit, the text syntax write them: exactly their canonical
/// digits.
pub(super) fn number(range: &NumberRange) -> EbnfExpr {
    let decimals = u32::from(range.decimals);
    let mut alternatives = Vec::new();
    if range.greatest >= 0 {
        alternatives.push(magnitude(size(range.least.max(0)), size(range.greatest), decimals));
    }
    if range.least < 0 {
        let nearest = if range.greatest < 0 { size(range.greatest) } else { 1 };
        let digits = magnitude(nearest, size(range.least), decimals);
        alternatives.push(EbnfExpr::seq(vec![EbnfExpr::literal("-"), digits]));
    }
    EbnfExpr::choice(alternatives)
}

fn size(units: i64) -> u64 {
    units.unsigned_abs()
}

/// From `low` to `high` units of the last decimal.
fn magnitude(low: u64, high: u64, decimals: u32) -> EbnfExpr {
    let scale = 10u64.pow(decimals);
    let (mut low_whole, low_rest) = (low / scale, low % scale);
    let (mut high_whole, high_rest) = (high / scale, high % scale);
    let point = |whole: u64, from: u64, to: u64| {
        EbnfExpr::seq(vec![EbnfExpr::literal(whole.to_string()), fraction(from, to, decimals)])
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
        alternatives.push(EbnfExpr::seq(vec![whole(low_whole, high_whole), any]));
    }
    alternatives.extend(last);
    EbnfExpr::choice(alternatives)
}

/// Nothing, or a point and digits that do not end in 0.
fn fraction(low: u64, high: u64, width: u32) -> EbnfExpr {
    if width == 0 || high == 0 {
        return EbnfExpr::Seq(Vec::new());
    }
    let digits = EbnfExpr::seq(vec![EbnfExpr::literal("."), decimals(low.max(1), high, width)]);
    if low == 0 { digits.optional() } else { digits }
}

/// Digits that do not end in 0 and that, filled up with zeros to the width, lie between two numbers; also
/// no digit at all where the lower number is 0.
fn decimals(low: u64, high: u64, width: u32) -> EbnfExpr {
    if width == 0 || high == 0 {
        return EbnfExpr::Seq(Vec::new());
    }
    let unit = 10u64.pow(width - 1);
    let last = unit * 10 - 1;
    let any = EbnfExpr::seq(vec![digit('0', '9').repeat(0, width - 1), digit('1', '9')]);
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
            alternatives.push(EbnfExpr::seq(vec![EbnfExpr::literal(character.to_string()), rest]));
        }
    }
    if let Some((from, to)) = full {
        let rest = decimals(0, unit - 1, width - 1);
        alternatives.push(EbnfExpr::seq(vec![digit(from, to), rest]));
    }
    let some = EbnfExpr::choice(alternatives);
    if low == 0 { some.optional() } else { some }
}

/// Whole numbers without leading zeros.
fn whole(low: u64, high: u64) -> EbnfExpr {
    let mut alternatives = Vec::new();
    let mut from = low;
    while from <= high {
        let width = from.to_string().len() as u32;
        let to = high.min(10u64.pow(width) - 1);
        alternatives.push(fixed(from, to, width));
        from = to + 1;
    }
    EbnfExpr::choice(alternatives)
}

/// Exactly so many digits, leading zeros among them.
fn fixed(low: u64, high: u64, width: u32) -> EbnfExpr {
    if width == 0 {
        return EbnfExpr::Seq(Vec::new());
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
            alternatives.push(EbnfExpr::seq(vec![EbnfExpr::literal(character.to_string()), rest]));
        }
    }
    if let Some((from, to)) = full {
        let rest = digit('0', '9').repeat(width - 1, width - 1);
        let rest = if width == 1 { EbnfExpr::Seq(Vec::new()) } else { rest };
        alternatives.push(EbnfExpr::seq(vec![digit(from, to), rest]));
    }
    EbnfExpr::choice(alternatives)
}

fn digit(from: char, to: char) -> EbnfExpr {
    if from == to { EbnfExpr::literal(from.to_string()) } else { EbnfExpr::Class(vec![(from, to)]) }
}
