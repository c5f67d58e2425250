//! Texts and names as expressions.

use std::collections::BTreeMap;

use super::ebnf::EbnfExpr;
use crate::subset::{MAX_NAME_CHARS, MAX_TEXT_CHARS};

/// The characters of a text, and those with which one begins.
pub(super) const TEXT: &[(char, char)] = &[(' ', '!'), ('#', '['), (']', '~')];
const TEXT_FIRST: &[(char, char)] = &[(' ', '!'), ('#', '#'), ('%', '['), (']', '~')];
const NAME: &[(char, char)] = &[('a', 'z'), ('A', 'Z'), ('0', '9'), ('_', '_')];
const NAME_FIRST: &[(char, char)] = &[('a', 'z'), ('A', 'Z'), ('_', '_')];

/// The names so far that a name may not be, as a tree of their letters.
#[derive(Default)]
struct Tree {
    ends: bool,
    next: BTreeMap<char, Tree>,
}

/// A text, without its quotes.
pub(super) fn text() -> EbnfExpr {
    let rest = EbnfExpr::Class(TEXT.to_vec()).repeat(0, bound(MAX_TEXT_CHARS - 1));
    EbnfExpr::seq(vec![EbnfExpr::Class(TEXT_FIRST.to_vec()), rest])
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
