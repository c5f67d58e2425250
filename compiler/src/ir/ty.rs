//! Types of terms.

use motet_syntax::unit::Dimension;

use super::{EnumId, Kind};

/// A type: a base type inside a number of lists.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Ty {
    pub(crate) base: Base,
    /// Number of enclosing `List<…>`.
    pub(crate) lists: u8,
}

/// A type that is no list.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Base {
    /// The type `Bool`.
    Bool,
    /// The type `Int`.
    Int,
    Number,
    /// `Length`, `Ratio`, …: a number with a dimension.
    Quantity(Dimension),
    /// The type `Text`.
    Text,
    Pose,
    Entity(Kind),
    Enum(EnumId),
    /// Unknown because of an error that was reported; compatible with every type.
    Unknown,
}

impl Ty {
    /// Type after an error; compatible with every type.
    pub(crate) const UNKNOWN: Self = Self::plain(Base::Unknown);
    /// The type `Bool`.
    pub(crate) const BOOL: Self = Self::plain(Base::Bool);
    /// The type `Text`.
    pub(crate) const TEXT: Self = Self::plain(Base::Text);
    /// The type `Int`.
    pub(crate) const INT: Self = Self::plain(Base::Int);
    /// The type `Ratio`.
    pub(crate) const RATIO: Self = Self::plain(Base::Quantity(Dimension::NONE));
    pub(crate) const DURATION: Self = Self::plain(Base::Quantity(Dimension::DURATION));

    /// Type without a list.
    #[must_use]
    pub(crate) const fn plain(base: Base) -> Self {
        Self { base, lists: 0 }
    }

    /// Type of lists of this type.
    #[must_use]
    pub(crate) const fn list(self) -> Self {
        Self { base: self.base, lists: self.lists.saturating_add(1) }
    }

    /// Type of the elements; `None` if the type is no list.
    #[must_use]
    pub(crate) fn element(self) -> Option<Self> {
        (self.lists > 0).then(|| Self { base: self.base, lists: self.lists - 1 })
    }

    /// Kind of a single entity; `None` for other types.
    #[must_use]
    pub(crate) fn kind(self) -> Option<Kind> {
        match self {
            Self { base: Base::Entity(kind), lists: 0 } => Some(kind),
            _ => None,
        }
    }
}
