//! The resolved form of a policy: every name is an index, every argument is in its place, sub-policies are inlined.
//!
//! Made by `resolve`, read by `check`, `prove`, `place` and `lower`. Steps live in one arena in document order, so a
//! [`StepId`] also says who caused a fact.

use motet_syntax::Span;
use motet_syntax::ast::{ArithOp, CompareOp, EndKind};
use motet_syntax::unit::Dimension;
use smol_str::SmolStr;

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
    /// An entity of the world; above the world's own, a symbol of the prover.
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

/// Something that has a value.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Term {
    /// `true`
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number in SI units.
    Number(f64),
    /// A text.
    Text(SmolStr),
    /// A case of an enumeration.
    Case(EnumId, u16),
    /// An entity.
    Entity(Entity),
    /// A list.
    List(Vec<Term>),
    /// A binding.
    Binding(BindingId),
    /// A parameter of the contract it stands in.
    Param(u16),
    /// The result of the contract it stands in.
    Result,
    /// The variable of a quantified entry of a contract.
    Each,
    /// A field of an entity.
    Field(Box<Term>, SmolStr),
    /// A measure.
    Measure(Measure, Vec<Term>),
    /// Arithmetic.
    Arith(ArithOp, Box<Term>, Box<Term>),
    /// After an error.
    Unknown,
}

/// A condition.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Condition {
    /// `true`
    Literal(bool),
    /// A fluent.
    Fact(Fact),
    /// A comparison.
    Compare(CompareOp, Term, Term),
    /// An enclosing monitor watches this measure.
    MonitoredMeasure(Measure),
    /// An enclosing monitor watches this fluent.
    MonitoredFluent(Fluent),
    /// Negation.
    Not(Box<Condition>),
    /// All of them.
    All(Vec<Condition>),
    /// At least one of them.
    AnyOf(Vec<Condition>),
    /// After an error: nothing is known of it and nothing is said about it.
    Unknown,
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Fact {
    /// The fluent.
    pub(crate) fluent: Fluent,
    /// Its arguments; none stands for `any`.
    pub(crate) args: Vec<Option<Term>>,
}

/// A policy, resolved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program {
    /// Its name.
    pub(crate) name: SmolStr,
    /// The robot's name; empty without one.
    pub(crate) robot: SmolStr,
    /// Where it stands.
    pub(crate) span: Span,
    /// All steps, parents before children, in document order.
    pub(crate) steps: Vec<Step>,
    /// The body.
    pub(crate) body: Block,
    /// The bindings.
    pub(crate) bindings: Vec<Binding>,
    /// Its goal.
    pub(crate) achieves: Option<(Condition, Span)>,
}

/// Steps that run one after the other.
pub(crate) type Block = Vec<StepId>;

/// A binding.
#[derive(Clone, Debug)]
pub(crate) struct Binding {
    /// Its name; `_` for a result that is not named.
    pub(crate) name: SmolStr,
    /// Its type.
    pub(crate) ty: Ty,
    /// Where it is bound.
    pub(crate) span: Span,
    /// The description that it was found by, where it is a literal.
    pub(crate) description: Option<SmolStr>,
    /// Whether it stands for the parameter of a sub-policy that is checked by itself.
    pub(crate) is_param: bool,
    /// How often it is used.
    pub(crate) uses: u32,
}

/// A step, resolved.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// What it does.
    pub(crate) kind: StepKind,
    /// Where it is written.
    pub(crate) span: Span,
    /// The step that it lies in, and in which of its blocks.
    pub(crate) place: Place,
    /// Least and greatest duration in seconds; filled in by `check`.
    pub(crate) bounds: (f64, f64),
}

/// Where a step lies.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Place {
    /// The step around it; none for the policy's own body.
    pub(crate) parent: Option<StepId>,
    /// Which block of it.
    pub(crate) slot: Slot,
    /// The position in that block, from 0.
    pub(crate) index: u32,
}

/// The blocks that a step can have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Slot {
    /// `steps`: of a policy, a sequence, a loop.
    Steps,
    /// `then`
    Then,
    /// `else`
    Else,
    /// `try`
    Try,
    /// `catch/N/steps`
    Catch(u16),
    /// `during`
    During,
    /// `monitor/N/then/steps`
    Reaction(u16),
    /// `parallel/N`
    Branch(u16),
    /// The body of an inlined policy.
    Inlined,
}

/// What a step does.
#[derive(Clone, Debug)]
pub(crate) enum StepKind {
    /// Runs a primitive.
    Call(Call),
    /// A named group.
    Sequence {
        /// Its name.
        name: SmolStr,
        /// Its steps.
        body: Block,
    },
    /// A sub-policy.
    Inline {
        /// Its name.
        policy: SmolStr,
        /// Its steps.
        body: Block,
    },
    /// A branch.
    If {
        /// The condition.
        condition: Condition,
        /// Where it stands.
        span: Span,
        /// Where it holds.
        then: Block,
        /// Where it does not.
        otherwise: Option<Block>,
    },
    /// Blocks until a condition holds.
    Wait {
        /// The condition.
        condition: Condition,
        /// The deadline.
        within_secs: f64,
    },
    /// Watches conditions.
    Monitor {
        /// What is watched.
        whens: Vec<When>,
        /// What runs.
        body: Block,
    },
    /// Handles failures.
    Try {
        /// What may fail.
        body: Block,
        /// The handlers.
        catches: Vec<Catch>,
    },
    /// A bounded loop.
    Repeat {
        /// How often at most.
        times: u32,
        /// The body.
        body: Block,
        /// The test.
        until: Option<(Condition, Span)>,
    },
    /// A loop over a list.
    Each {
        /// The loop's binding.
        item: BindingId,
        /// The list.
        list: Term,
        /// The longest list.
        at_most: u32,
        /// The body.
        body: Block,
    },
    /// Branches at once.
    Parallel {
        /// The branches.
        branches: Vec<Block>,
    },
    /// Ends the policy or the inlined policy `of`.
    End {
        /// How.
        kind: EndKind,
        /// Which inlined policy.
        of: Option<StepId>,
        /// The reason.
        why: Option<Term>,
    },
    /// After an error: it may do anything.
    Unknown,
}

/// A call of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct Call {
    /// Which.
    pub(crate) primitive: Primitive,
    /// An argument for each parameter.
    pub(crate) args: Vec<Term>,
    /// Where each argument stands; of a default, the call.
    pub(crate) spans: Vec<Span>,
    /// Where the result goes.
    pub(crate) binds: Option<BindingId>,
    /// The deadline where one is written.
    pub(crate) within_secs: Option<f64>,
    /// How often it is tried again.
    pub(crate) retries: u32,
}

/// A watched condition.
#[derive(Clone, Debug)]
pub(crate) struct When {
    /// The condition.
    pub(crate) condition: Condition,
    /// Where it stands.
    pub(crate) span: Span,
    /// Seconds for which it must hold.
    pub(crate) hold_secs: f64,
    /// What then happens.
    pub(crate) reaction: Reaction,
}

/// What a monitor does.
#[derive(Clone, Debug)]
pub(crate) enum Reaction {
    /// Holds the body.
    Pause {
        /// The longest pause.
        within_secs: f64,
    },
    /// Starts the body again.
    Restart {
        /// How often.
        at_most: u32,
    },
    /// Interrupts for a block.
    Resume {
        /// How often.
        at_most: u32,
        /// The block.
        body: Block,
    },
    /// Ends the policy or the inlined policy `of`.
    End {
        /// How.
        kind: EndKind,
        /// Which inlined policy.
        of: Option<StepId>,
        /// The reason.
        why: Option<Term>,
    },
}

/// A handler.
#[derive(Clone, Debug)]
pub(crate) struct Catch {
    /// The failures with their places; none for `any`.
    pub(crate) on: Option<Vec<(Failure, Span)>>,
    /// Where it says which failures it takes, or as a whole.
    pub(crate) span: Span,
    /// What then runs.
    pub(crate) body: Block,
}
