//! Types.

use motet_syntax::unit::Dimension;

use super::{EnumId, Kind};

/// A type: a base and how many lists are around it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Ty {
    /// What is inside.
    pub(crate) base: Base,
    /// How many `List<…>` are around it.
    pub(crate) lists: u8,
}

/// A type that is no list.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Base {
    /// `Bool`
    Bool,
    /// `Int`
    Int,
    /// `Number`
    Number,
    /// `Length`, `Ratio`, …: a number with a dimension.
    Quantity(Dimension),
    /// `Text`
    Text,
    /// `Pose`
    Pose,
    /// An entity of a kind.
    Entity(Kind),
    /// A case of an enumeration.
    Enum(EnumId),
    /// Not known because of an error that was already reported: fits everything.
    Unknown,
}

impl Ty {
    /// A type that fits everything, after an error.
    pub(crate) const UNKNOWN: Self = Self::plain(Base::Unknown);
    /// `Bool`
    pub(crate) const BOOL: Self = Self::plain(Base::Bool);
    /// `Text`
    pub(crate) const TEXT: Self = Self::plain(Base::Text);
    /// `Int`
    pub(crate) const INT: Self = Self::plain(Base::Int);
    /// `Duration`
    pub(crate) const RATIO: Self = Self::plain(Base::Quantity(Dimension::NONE));
    pub(crate) const DURATION: Self = Self::plain(Base::Quantity(Dimension::DURATION));

    /// A type that is no list.
    #[must_use]
    pub(crate) const fn plain(base: Base) -> Self {
        Self { base, lists: 0 }
    }

    /// A list of it.
    #[must_use]
    pub(crate) const fn list(self) -> Self {
        Self { base: self.base, lists: self.lists.saturating_add(1) }
    }

    /// The type of an element; none where it is no list.
    #[must_use]
    pub(crate) fn element(self) -> Option<Self> {
        (self.lists > 0).then(|| Self { base: self.base, lists: self.lists - 1 })
    }

    /// The kind, of an entity that is in no list.
    #[must_use]
    pub(crate) fn kind(self) -> Option<Kind> {
        match self {
            Self { base: Base::Entity(kind), lists: 0 } => Some(kind),
            _ => None,
        }
    }
}
