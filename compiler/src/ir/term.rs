//! Terms and conditions, their types, and the closed set of motion queries that a contract can ask for.

use std::fmt;

use motet_syntax::ast::{ArithOp, CompareOp};
use motet_syntax::unit::Dimension;
use smol_str::SmolStr;

use super::{BindingId, Entity, EnumId, Fluent, Kind, Measure};

/// A value, or an expression for one.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Term {
    Bool(bool),
    Int(i64),
    /// Number in SI units.
    Number(f64),
    Text(SmolStr),
    /// Pose in the map: a point in m and a yaw in rad.
    Pose {
        xyz: [f64; 3],
        yaw: f64,
    },
    /// Text with values: its parts, each with its type.
    Template(Vec<(Term, Ty)>),
    Case(EnumId, u16),
    Entity(Entity),
    List(Vec<Term>),
    Binding(BindingId),
    /// Failure that a handler caught: the bindings of its kind and its text. As a value it is its text.
    Caught(BindingId, BindingId),
    /// Parameter of the enclosing contract.
    Param(u16),
    /// Result of the enclosing contract.
    Result,
    /// Variable of a quantified entry of a contract.
    Each,
    Field(Box<Term>, SmolStr),
    Measure(Measure, Vec<Term>),
    Arith(ArithOp, Box<Term>, Box<Term>),
    /// Number of elements of a list.
    Count(Box<Term>),
    /// First element of a list; an empty list has none.
    First(Box<Term>),
    /// Term with an error.
    Unknown,
}

/// A condition on facts and values.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Condition {
    Literal(bool),
    Fact(Fact),
    Compare(CompareOp, Term, Term),
    /// Holds if an enclosing monitor watches this measure.
    MonitoredMeasure(Measure),
    /// Holds if an enclosing monitor watches this fluent.
    MonitoredFluent(Fluent),
    Not(Box<Condition>),
    All(Vec<Condition>),
    AnyOf(Vec<Condition>),
    /// Condition with an error: unknown, and never reported again.
    Unknown,
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Fact {
    pub(crate) fluent: Fluent,
    /// Arguments; `None` stands for `any`.
    pub(crate) args: Vec<Option<Term>>,
}

impl Term {
    fn parts(&self) -> impl Iterator<Item = &Self> {
        let said: &[(Self, Ty)] = if let Self::Template(parts) = self { parts } else { &[] };
        let (one, other, rest): (_, _, &[Self]) = match self {
            Self::Field(of, _) | Self::Count(of) | Self::First(of) => (Some(&**of), None, &[]),
            Self::Arith(_, left, right) => (Some(&**left), Some(&**right), &[]),
            Self::List(terms) | Self::Measure(_, terms) => (None, None, terms),
            Self::Bool(_)
            | Self::Int(_)
            | Self::Number(_)
            | Self::Text(_)
            | Self::Pose { .. }
            | Self::Template(_)
            | Self::Case(..)
            | Self::Entity(_)
            | Self::Binding(_)
            | Self::Caught(..)
            | Self::Param(_)
            | Self::Result
            | Self::Each
            | Self::Unknown => (None, None, &[]),
        };
        one.into_iter().chain(other).chain(rest).chain(said.iter().map(|(part, _)| part))
    }

    /// Number of its parts and of the bytes of its texts.
    pub(crate) fn size(&self) -> usize {
        let own = if let Self::Text(text) = self { 1 + text.len() } else { 1 };
        self.parts().fold(own, |size, part| size.saturating_add(part.size()))
    }

    /// Returns whether the term or a subterm satisfies a predicate.
    pub(crate) fn any(&self, is_one: &impl Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().any(|part| part.any(is_one))
    }

    /// Returns whether the term is the same in every run.
    pub(crate) fn is_constant(&self) -> bool {
        let is_open = |part: &Self| match part {
            Self::Bool(_)
            | Self::Int(_)
            | Self::Number(_)
            | Self::Text(_)
            | Self::Template(_)
            | Self::Pose { .. } => false,
            Self::Case(..) | Self::Entity(_) | Self::List(_) | Self::Arith(..) | Self::Count(_) => false,
            Self::Binding(_) | Self::Param(_) | Self::Result | Self::Each | Self::Unknown => true,
            Self::Field(..) | Self::Measure(..) | Self::First(_) | Self::Caught(..) => true,
        };
        !self.any(&is_open)
    }

    /// Returns whether the term may have no value when it is asked for: what it observes is unknown, or a
    /// list is empty.
    pub(crate) fn may_lack_value(&self) -> bool {
        match self {
            // What is unknown in it is said to be.
            Self::Template(_) => false,
            Self::Field(..) | Self::Measure(..) | Self::First(_) | Self::Arith(..) => true,
            whole => whole.parts().any(Self::may_lack_value),
        }
    }

    /// Adds the measures in the term.
    pub(crate) fn measures(&self, found: &mut Vec<Measure>) {
        if let Self::Measure(id, _) = self {
            found.push(*id);
        }
        self.parts().for_each(|part| part.measures(found));
    }

    /// Highest index of a parameter of the contract in the term.
    pub(crate) fn last_param(&self) -> Option<u16> {
        match self {
            Self::Param(index) => Some(*index),
            whole => whole.parts().filter_map(Self::last_param).max(),
        }
    }
}

impl Condition {
    /// Parts that hold exactly if the condition does, as many as there are.
    pub(crate) fn conjuncts(&self) -> Vec<&Self> {
        match self {
            Self::All(parts) => parts.iter().flat_map(Self::conjuncts).collect(),
            whole => vec![whole],
        }
    }

    pub(crate) fn parts(&self) -> &[Self] {
        match self {
            Self::Not(inner) => std::slice::from_ref(inner),
            Self::All(parts) | Self::AnyOf(parts) => parts,
            Self::Literal(_)
            | Self::Fact(_)
            | Self::Compare(..)
            | Self::MonitoredMeasure(_)
            | Self::MonitoredFluent(_)
            | Self::Unknown => &[],
        }
    }

    /// Terms of the condition itself.
    fn terms(&self) -> impl Iterator<Item = &Term> {
        let (args, sides): (&[Option<Term>], _) = match self {
            Self::Fact(fact) => (&fact.args, [None, None]),
            Self::Compare(_, left, right) => (&[], [Some(left), Some(right)]),
            _ => (&[], [None, None]),
        };
        args.iter().flatten().chain(sides.into_iter().flatten())
    }

    /// Returns whether the condition or a subcondition satisfies a predicate.
    pub(crate) fn any(&self, is_one: &impl Fn(&Self) -> bool) -> bool {
        is_one(self) || self.parts().iter().any(|part| part.any(is_one))
    }

    /// Returns whether any term in the condition, or a subterm, satisfies a predicate.
    pub(crate) fn any_term(&self, is_one: &impl Fn(&Term) -> bool) -> bool {
        self.any(&|part| part.terms().any(|term| term.any(is_one)))
    }

    /// Returns whether the condition is about no fact, measure or binding, so that nothing changes it.
    pub(crate) fn is_constant(&self) -> bool {
        let is_open = |part: &Self| match part {
            Self::Fact(_) | Self::MonitoredMeasure(_) | Self::MonitoredFluent(_) | Self::Unknown => true,
            Self::Literal(_) | Self::Compare(..) | Self::Not(_) | Self::All(_) | Self::AnyOf(_) => false,
        };
        let is_variable = |term: &Term| {
            matches!(
                term,
                Term::Binding(_)
                    | Term::Param(_)
                    | Term::Result
                    | Term::Each
                    | Term::Measure(..)
                    | Term::Unknown
            )
        };
        !self.any(&is_open) && !self.any_term(&is_variable)
    }

    /// Highest index of a parameter of the contract in the condition.
    pub(crate) fn last_param(&self) -> Option<u16> {
        let within = self.parts().iter().filter_map(Self::last_param);
        self.terms().filter_map(Term::last_param).chain(within).max()
    }
}

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
    /// A failure that a handler caught, with its kind and its text.
    Failure,
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
    /// The type `Length`.
    pub(crate) const LENGTH: Self = Self::plain(Base::Quantity(Dimension::LENGTH));
    /// The type `Angle`.
    pub(crate) const ANGLE: Self = Self::plain(Base::Quantity(Dimension::ANGLE));
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

    /// Kind of a single entity, or of the entities of a list; `None` for other types.
    pub(crate) fn kind_within(self) -> Option<Kind> {
        self.kind().or_else(|| self.element()?.kind())
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

/// Kind of a motion query.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum MotionKind {
    GoTo,
    StandAt,
    Reach,
    ReachAt,
    Put,
    PutAt,
    Pull,
    Push,
    Offer,
    Look,
    Posture,
}

impl MotionKind {
    /// All kinds, in the order of the language page.
    pub(crate) const ALL: &[Self] = &[
        Self::GoTo,
        Self::StandAt,
        Self::Reach,
        Self::ReachAt,
        Self::Put,
        Self::PutAt,
        Self::Pull,
        Self::Push,
        Self::Offer,
        Self::Look,
        Self::Posture,
    ];

    /// Name of the motion in a contract.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::GoTo => "go_to",
            Self::StandAt => "stand_at",
            Self::Reach => "reach",
            Self::ReachAt => "reach_at",
            Self::Put => "put",
            Self::PutAt => "put_at",
            Self::Pull => "pull",
            Self::Push => "push",
            Self::Offer => "offer",
            Self::Look => "look",
            Self::Posture => "posture",
        }
    }

    /// Kind with a name.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|kind| kind.name() == name)
    }

    /// Number of arguments that it must have.
    pub(crate) const fn arity(self) -> usize {
        match self {
            Self::PutAt => 3,
            Self::ReachAt | Self::Put | Self::Offer => 2,
            Self::GoTo | Self::StandAt | Self::Reach | Self::Pull | Self::Push | Self::Look => 1,
            Self::Posture => 1,
        }
    }

    /// Further arguments that it may have, in order: the rules of a place.
    pub(crate) const fn options(self) -> &'static [&'static str] {
        match self {
            Self::Put => &["near", "beside", "away_from_edge", "upright"],
            Self::GoTo | Self::StandAt | Self::Reach | Self::ReachAt | Self::PutAt | Self::Pull => &[],
            Self::Push | Self::Offer | Self::Look | Self::Posture => &[],
        }
    }

    /// Returns whether the motion changes the pose of the robot or of a thing. The head may turn in `look`,
    /// but no pose that is tracked changes.
    pub(crate) fn moves(self) -> bool {
        self != Self::Look
    }
}

impl fmt::Display for MotionKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::MotionKind;

    #[test]
    fn motion_kind_from_name_inverts_name() {
        for kind in MotionKind::ALL {
            assert_eq!(MotionKind::from_name(kind.name()), Some(*kind));
        }
        assert_eq!(MotionKind::from_name("fly"), None);
    }
}
