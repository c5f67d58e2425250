//! Intermediate representation of a policy: every name is an id, every argument has its place, sub-policies
//! are inlined.
//!
//! `resolve` produces it; the later stages read it. Steps live in one arena in document order, so a
//! [`StepId`] also identifies the cause of a fact.

mod entities;
mod program;
mod substitution;
mod term;

pub(crate) use entities::Entities;
pub use entities::MAX_ENTITIES;
pub(crate) use program::{
    Binding, Block, BlockSlot, Call, Catch, CaughtFailure, Keep, Program, Reaction, Step, StepKind,
    StepPosition, When,
};
pub(crate) use substitution::{Renumbering, Rewrite, Substitution};
pub(crate) use term::{Base, Condition, Fact, MotionKind, Term, Ty};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident: $int:ty)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
        pub(crate) struct $name(pub(crate) $int);
        impl $name {
            /// Index into the table of this id.
            #[must_use]
            pub(crate) fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// Id of an entity kind of the library.
    Kind: u16
    /// Id of an enumeration of the library.
    EnumId: u16
    /// Id of a fluent of the library.
    Fluent: u16
    /// Id of a measure of the library.
    Measure: u16
    /// Id of a failure of the library.
    Failure: u16
    /// Id of a primitive of the library.
    Primitive: u16
    /// Id of an entity of the environment; higher ids are symbols of the prover.
    Entity: u16
    /// Id of a step of the program.
    StepId: u32
    /// Id of a binding of the program.
    BindingId: u32
}

/// The robot; always at this index.
pub(crate) const ROBOT: Entity = Entity(0);
/// The person who gives the instructions.
pub(crate) const USER: Entity = Entity(1);
/// The place where the robot stood when the policy began.
pub(crate) const START: Entity = Entity(2);
/// An entity that has no name, below the number of `any`: it stands for all that nobody has named yet.
pub(crate) const NOBODY: Entity = Entity(u16::MAX - 1);
/// The failure that every primitive can end in.
pub(crate) const TIMEOUT: Failure = Failure(0);

impl Kind {
    /// The root `Entity` of all kinds.
    pub(crate) const ROOT: Self = Self(0);
}
