//! The vocabulary by which a grammar talks to the automaton: actions between bytes, guards of alternatives,
//! and the kinds of nodes, blocks, names and conditions that they are about.

/// An action of the automaton at a place where no byte is taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Action {
    /// A node begins.
    Open(NodeKind),
    /// The innermost node ends.
    Close,
    /// A value without a word of its own stands here.
    Constant(Constant),
    /// The rule has one more member.
    Count,
    /// The rule becomes a block.
    Enter(BlockRole),
    /// The block ends.
    Leave,
    /// A step of the block ends.
    StepDone,
    /// Everything before the steps of the policy is written.
    Head,
    /// A condition of this use follows.
    Condition(ConditionUse),
    /// The condition that follows is nested one level deeper.
    Deeper,
    /// The condition that follows stands under `not`.
    Negate,
    /// The condition that follows says nothing about the facts by itself.
    Loosen,
    /// The word before is the type of the policy's result.
    Gives,
    /// The name of the failure of the handler is forgotten.
    Forget,
    /// The item of a loop gets the kind of the list that was written out.
    BindItem,
    /// The alternatives through the open node meet: what all of them have bound is in scope.
    Meet,
    /// The name given before a call or a value is bound to it; its type has this number.
    Bind(u16),
    /// The name given before the first element of a list is bound to it.
    BindFirst,
    /// The deadline that was just written is not that of the step before it, but of the block that follows.
    Split(Split),
    /// Another condition follows, joined by `and` ([`NodeKind::All`]) or `or` ([`NodeKind::Any`]).
    Join(NodeKind),
}

/// A condition under which an alternative is open.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Guard {
    Open,
    /// While the rule has fewer members.
    Below(u8),
    /// The block may end: nothing after it is refuted.
    Close,
    /// The block may be empty and end.
    Empty,
    /// Some callable may be called.
    Call,
    /// One more step with blocks may begin.
    Nest,
    /// As `Nest`, for a step that is proved to a fixed point.
    Fix,
    /// Some condition may be waited for.
    Wait,
    /// The goal is not refuted, so the policy may be done.
    Done,
    /// As `Done`, for the reaction of a monitor.
    DoneWhen,
    /// This reaction refutes nothing.
    React(NodeKind),
    /// A condition may be a conjunction.
    All,
    /// A condition may be a disjunction.
    Any,
    /// A condition may be a negation.
    Not,
    /// Some fluent may be tested.
    Is,
    /// The condition may be one that says nothing about the facts.
    Loose,
    /// The loop needs no test.
    NoTest,
    /// Always, but the alternative may turn out to be empty.
    Rare,
    /// In no policy.
    Never,
    /// This callable may be called.
    Callable(u16),
    /// Some callable with a result may be called, or some value be named.
    Let,
    /// Some value may be named.
    LetValue,
    /// A step that asks for nothing may follow.
    Room,
    /// A list is bound.
    List,
    /// A list is bound, and the condition may be one that says nothing about the facts.
    OfList,
    /// A failure is bound.
    Caught,
    /// A failure is bound, and the condition may be one that says nothing about the facts.
    OfCaught,
    /// A pose that is written out may be an argument of the call.
    Pose,
    /// The first element of a bound list may be the argument with this number, of the type with the other
    /// number.
    First(u8, u16),
    /// A step with blocks may begin that interrupts its block.
    Interrupt,
    /// A step may ask for a condition and branch on it.
    If,
    /// The step before it may end, and a block with a deadline follow.
    Split(Split),
    /// The step or policy before may have a cleanup.
    Cleanup,
    /// The cleanup, or a block in it, may end.
    Cleaned,
    /// This fluent may be tested.
    Fluent(u16),
    /// `and` may follow the condition.
    And,
    /// `or` may follow the condition.
    Or,
    /// Conditions may nest this many levels deeper, and nothing is required of them.
    Paren(u8),
    /// A comparison or several conditions may follow `not`.
    NotParen,
    /// Several conditions may stand in these parentheses.
    Several,
    /// Behind a comparison.
    Compared,
}

/// The rest of a step whose deadline turns out to be that of the block behind it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Split {
    /// The number of its modifiers from the deadline on, all of which are defaults then.
    pub(crate) modifiers: u8,
    /// The number of the type to which the name before it is bound.
    pub(crate) bind: Option<u16>,
}

/// A node of the syntax tree. Numbers are those of the declarations in the signatures.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum NodeKind {
    Do(u16),
    Sequence,
    If,
    Wait,
    Monitor,
    When,
    Pause,
    Restart,
    Resume,
    Done,
    Fail,
    Cannot,
    Replan,
    Try,
    Catch,
    Repeat,
    Each,
    Parallel,
    Delay,
    /// A block with a deadline.
    Within,
    Keep,
    OutOf,
    Distance,
    /// The cleanup of the node before it.
    Finally,
    Let(LetValue),
    Block,
    Is(u16),
    Not,
    All,
    Any,
    Get(u16),
    Field(u16),
    /// A comparison of the kind of a failure.
    Caught,
    /// A pose that is written out.
    Pose,
    /// A comparison of the length of a list.
    Count,
    IsEmpty,
    List,
    /// Conditions in parentheses.
    Group,
}

impl NodeKind {
    /// It is a step with blocks.
    pub(crate) fn has_blocks(self) -> bool {
        match self {
            Self::Sequence | Self::If | Self::Monitor | Self::Try | Self::Repeat | Self::Each => true,
            Self::Parallel | Self::Within | Self::Keep => true,
            Self::Do(_) | Self::Let(_) | Self::Delay | Self::Wait | Self::When | Self::Catch => false,
            Self::Pause | Self::Restart | Self::Resume | Self::OutOf | Self::Distance => false,
            Self::Done | Self::Fail | Self::Cannot | Self::Replan | Self::Finally | Self::Block => false,
            Self::Is(_) | Self::Not | Self::All | Self::Any | Self::Get(_) | Self::Field(_) => false,
            Self::Count | Self::IsEmpty | Self::Caught | Self::List | Self::Pose | Self::Group => false,
        }
    }
}

/// A value that a `let` gives a name. Numbers are those of the declarations in the signatures.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum LetValue {
    Count,
    First,
    Get(u16),
    Field(u16),
    /// The text of a failure.
    CaughtText,
}

/// The role of a block in its step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum BlockRole {
    Body,
    Group,
    Then,
    Else,
    Try,
    Catch,
    During,
    Reaction,
    Loop,
    Branch,
    Cleanup,
}

/// The use of a name that the policy gives.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum NameUse {
    /// Of the policy.
    Policy,
    /// Of a sequence.
    Group,
    /// Of a result, of the type with this number.
    Result(u16),
    /// Of the item of a loop, of the type of the elements of its list.
    Item,
    /// Of a result or a value whose type is not known yet.
    Let,
}

/// The use of a condition.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum ConditionUse {
    /// The goal: it need not be observable.
    Goal,
    /// `if`, `when`: it refutes nothing by itself.
    Branch,
    Wait,
    Until,
}

/// A value without a word of its own.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Constant {
    Null,
    Slowly,
    Gently,
    True,
    False,
}

/// The role of a word, which decides how it is checked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum WordRole {
    /// The callable of a step.
    Callable,
    /// The argument of a call with this number.
    Argument(u8),
    Fluent,
    /// An argument of a fluent.
    Of,
    /// An entity of the kind of the first of its list.
    Alike,
    /// A measure or a field, which decides what follows.
    Head,
    /// A keyword with a guard of its own; it records no event.
    Keyword,
    /// Any other word: each is as good as the other.
    Free,
}
