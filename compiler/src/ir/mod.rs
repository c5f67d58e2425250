//! The resolved form of a policy: every name is an index, every argument is in its place, sub-policies are inlined.
//!
//! Made by `resolve`, read by `check`, `prove`, `place` and `lower`. Steps live in one arena in document order, so a
//! [`StepId`] also says who caused a fact.

mod entities;
mod program;
mod term;
mod ty;

pub(crate) use entities::Entities;
pub use entities::MAX_ENTITIES;
pub(crate) use program::{
    Binding, Block, BlockSlot, Call, Catch, Program, Reaction, Step, StepKind, StepPosition, When,
};
pub(crate) use term::{Condition, Fact, Term};
pub(crate) use ty::{Base, Ty};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident: $int:ty)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
        pub(crate) struct $name(pub(crate) $int);
        impl $name {
            /// The index into its table.
            #[must_use]
            pub(crate) fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// An entity kind of the library.
    Kind: u16
    /// An enumeration of the library.
    EnumId: u16
    /// A fluent of the library.
    Fluent: u16
    /// A measure of the library.
    Measure: u16
    /// A failure kind of the library.
    Failure: u16
    /// A primitive of the library.
    Primitive: u16
    /// An entity of the environment; above the environment's own, a symbol of the prover.
    Entity: u16
    /// A step of the program.
    StepId: u32
    /// A binding of the program.
    BindingId: u32
}

/// Always there, at these indices.
pub(crate) const ROBOT: Entity = Entity(0);
/// The person who gives the instructions.
pub(crate) const USER: Entity = Entity(1);
/// Where the robot stood when the policy began.
pub(crate) const START: Entity = Entity(2);
/// The failure that every primitive can end in.
pub(crate) const TIMEOUT: Failure = Failure(0);
