//! Keys: single facts and patterns as numbers.

use smol_str::SmolStr;

use crate::ir::{Entity, Fluent};

/// Arguments of a fact, 16 bits each, the first lowest.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct FactKey(pub(crate) u64);

/// Argument of a key that stands for `any`.
pub(crate) const ANY: u16 = u16::MAX;

impl FactKey {
    /// Pattern of every fact of a fluent.
    pub(crate) const ALL: Self = Self(u64::MAX);

    pub(crate) fn new(args: impl Iterator<Item = u16>) -> Self {
        Self(args.take(4).enumerate().fold(0, |key, (index, arg)| key | (u64::from(arg) << (16 * index))))
    }

    pub(crate) fn arg(self, index: usize) -> u16 {
        u16::try_from((self.0 >> (16 * index.min(3))) & 0xffff).unwrap_or(ANY)
    }

    /// Replaces one argument.
    pub(crate) fn with(self, index: usize, arg: u16) -> Self {
        let shift = 16 * index.min(3);
        Self((self.0 & !(0xffff << shift)) | (u64::from(arg) << shift))
    }

    /// Mask of the arguments that are `any`.
    #[inline]
    pub(super) fn any(self) -> u64 {
        const HIGH: u64 = 0x8000_8000_8000_8000;
        // The high bit of each part of the complement that is zero, found for all four at once.
        let rest = !self.0;
        let zero = !(((rest & !HIGH) + !HIGH) | rest) & HIGH;
        (zero >> 15) * 0xffff
    }

    /// Number of arguments that are `any`.
    pub(super) fn width(self) -> u32 {
        self.any().count_ones() / 16
    }

    pub(crate) fn is_pattern(self) -> bool {
        self.any() != 0
    }

    /// First argument; `None` if it is `any`.
    pub(super) fn head(self) -> Option<u16> {
        let head = self.arg(0);
        (head != ANY).then_some(head)
    }

    /// Facts that two patterns share, if neither covers the other.
    pub(super) fn crossing(self, other: Self) -> Option<Self> {
        let (one, two) = (self.any(), other.any());
        let agree = (self.0 ^ other.0) & !one & !two == 0;
        // What is `any` on one side is taken from the other.
        let shared = (self.0 & !one) | (other.0 & one);
        (agree && one & !two != 0 && two & !one != 0).then_some(Self(shared))
    }

    /// Returns whether every fact of `other` belongs to this pattern.
    pub(crate) fn covers(self, other: Self) -> bool {
        (self.0 ^ other.0) & !self.any() == 0
    }
}

/// A fluent with a key.
pub(crate) type Atom = (Fluent, FactKey);

/// Spelling of a fact: "`on(cup, table)`".
pub(crate) fn show(name: &str, key: FactKey, arity: usize, arg: impl Fn(usize, u16) -> SmolStr) -> String {
    let args: Vec<_> = (0..arity)
        .map(|index| {
            let value = key.arg(index);
            if value == ANY { SmolStr::new_static("any") } else { arg(index, value) }
        })
        .collect();
    format!("`{name}({})`", args.join(", "))
}

/// Argument of a key that stands for an entity.
pub(crate) fn arg(entity: Entity) -> u16 {
    entity.0
}
