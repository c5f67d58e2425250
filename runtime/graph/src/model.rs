//! The graph in memory: tables of declarations, nodes in an arena, regions that chain them.
//!
//! A **region** is a list of nodes that run one after the other with a single thread of control: the policy's body, a
//! branch, a handler. A **node** belongs to one region; its success edge leads to the next node of the region, or
//! ends the region in success. A node's failure ends its region in that failure, which fails the region's owner; a
//! [`NodeKind::Try`] owner has failure edges, its handlers. Ids are indices: stable for one graph, in document order.

use smol_str::SmolStr;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
        pub struct $name(pub u32);
        impl $name {
            /// The index into its table.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// Index into [`Graph::nodes`].
    NodeId
    /// Index into [`Graph::regions`].
    RegionId
    /// Index into [`Graph::bindings`].
    BindingId
    /// Index into [`Graph::kinds`].
    KindId
    /// Index into [`Graph::fluents`].
    FluentId
    /// Index into [`Graph::measures`].
    MeasureId
    /// Index into [`Graph::primitives`].
    PrimitiveId
    /// Index into [`Graph::failures`].
    FailureId
    /// Index into [`Graph::resources`].
    ResourceId
}

/// A compiled policy.
#[derive(Clone, PartialEq, Debug)]
pub struct Graph {
    /// The policy's name.
    pub policy: SmolStr,
    /// The robot that it was compiled for; empty for a domain without a robot.
    pub robot: SmolStr,
    /// Entity kinds that the tables below name, parents before children.
    pub kinds: Vec<Kind>,
    /// Fluents that the graph uses.
    pub fluents: Vec<Fluent>,
    /// Measures that the graph uses.
    pub measures: Vec<Measure>,
    /// Primitives that the graph calls.
    pub primitives: Vec<Primitive>,
    /// Failure kinds that can occur or are caught. `timeout` is always the first.
    pub failures: Vec<SmolStr>,
    /// The robot's exclusive resources that the graph uses.
    pub resources: Vec<Resource>,
    /// Named results.
    pub bindings: Vec<Binding>,
    /// The nodes, in document order: a parent before its children.
    pub nodes: Vec<Node>,
    /// The regions; the first is the policy's body.
    pub regions: Vec<Region>,
    /// What the compiler was told of the state at the start, in order: facts with their value.
    pub initial: Vec<(Fact, bool)>,
    /// Seconds that one observation may take.
    pub observe_within_secs: f64,
    /// Least and greatest duration of the whole policy.
    pub duration: Bounds,
}

/// The policy's own region.
pub const ROOT: RegionId = RegionId(0);
/// The failure that every primitive can end in.
pub const TIMEOUT: FailureId = FailureId(0);

/// Least and greatest duration in seconds; `0 <= least <= greatest`, both finite.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Bounds {
    /// Least.
    pub least_secs: f64,
    /// Greatest.
    pub greatest_secs: f64,
}

/// An entity kind.
#[derive(Clone, PartialEq, Debug)]
pub struct Kind {
    /// Its name.
    pub name: SmolStr,
    /// Its parent; none for `Entity`.
    pub parent: Option<KindId>,
}

/// The type of a value.
#[derive(Clone, PartialEq, Debug)]
pub enum Type {
    /// `true` or `false`
    Bool,
    /// A whole number.
    Int,
    /// A number without a dimension.
    Number,
    /// A number in the SI unit of the named quantity type (`Length`, `Angle`, …).
    Quantity(SmolStr),
    /// Text.
    Text,
    /// A position and an orientation in the frame `map`.
    Pose,
    /// An entity of a kind.
    Entity(KindId),
    /// A case of the named enumeration; resources are cases of theirs (`Hand`, `Camera`).
    Case(SmolStr),
    /// A list.
    List(Box<Type>),
}

/// A value.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// A truth value.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A finite number; of a quantity in SI units and radians.
    Number(f64),
    /// Text.
    Text(SmolStr),
    /// An entity's id.
    Entity(SmolStr),
    /// A case of an enumeration or a resource.
    Case(SmolStr),
    /// A pose.
    Pose(Pose),
    /// A list.
    List(Vec<Value>),
}

/// A pose in the frame `map`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Pose {
    /// Position in metres.
    pub xyz: [f64; 3],
    /// Unit quaternion, order x, y, z, w.
    pub quaternion: [f64; 4],
}

/// A fluent: something that is true, false or unknown of entities.
#[derive(Clone, PartialEq, Debug)]
pub struct Fluent {
    /// Its name.
    pub name: SmolStr,
    /// The types of its parameters.
    pub params: Vec<Type>,
    /// Whether the robot can observe it. One that it cannot observe is known only by effects and by what it was told.
    pub observable: bool,
}

/// A measure: a number that can be observed.
#[derive(Clone, PartialEq, Debug)]
pub struct Measure {
    /// Its name.
    pub name: SmolStr,
    /// The types of its parameters.
    pub params: Vec<Type>,
    /// The type of what it gives.
    pub result: Type,
}

/// A primitive's signature, for typing a call and talking to a driver.
#[derive(Clone, PartialEq, Debug)]
pub struct Primitive {
    /// Its name.
    pub name: SmolStr,
    /// Its parameters, in order.
    pub params: Vec<(SmolStr, Type)>,
    /// The type of its result.
    pub result: Option<Type>,
    /// Whether it only perceives.
    pub perceives: bool,
    /// Resources that it holds while it runs.
    pub uses: Vec<ResourceId>,
    /// Failures that it can end in, `timeout` among them.
    pub fails: Vec<FailureId>,
}

/// An exclusive resource. Two resources conflict if they are the same or one contains the other.
#[derive(Clone, PartialEq, Debug)]
pub struct Resource {
    /// Its name.
    pub name: SmolStr,
    /// Everything that it contains, directly or not.
    pub contains: Vec<ResourceId>,
}

/// A named result.
#[derive(Clone, PartialEq, Debug)]
pub struct Binding {
    /// Its name; made unique by a suffix `'2`, `'3` … where inlining repeats it. An unnamed result is `_`.
    pub name: SmolStr,
    /// Its type.
    pub ty: Type,
}

/// A list of nodes with one thread of control.
#[derive(Clone, PartialEq, Debug)]
pub struct Region {
    /// The node that it belongs to; none for [`ROOT`].
    pub owner: Option<NodeId>,
    /// Its first node; an empty region succeeds at once.
    pub entry: Option<NodeId>,
}

/// A step of the policy.
#[derive(Clone, PartialEq, Debug)]
pub struct Node {
    /// JSON Pointer to the step in the policy's JSON form, such as `/steps/2/try/0`. Nodes of an inlined policy have the
    /// call's path followed by `:` and the path in that policy.
    pub path: SmolStr,
    /// The region that it runs in.
    pub region: RegionId,
    /// The success edge: the next node of the region; none ends the region in success.
    pub next: Option<NodeId>,
    /// Least and greatest duration, retries included.
    pub duration: Bounds,
    /// What it does.
    pub kind: NodeKind,
}

/// What a node does.
#[derive(Clone, PartialEq, Debug)]
pub enum NodeKind {
    /// Runs a primitive.
    Call(CallNode),
    /// A named group.
    Sequence {
        /// Its name.
        name: SmolStr,
        /// Its steps.
        body: RegionId,
    },
    /// An inlined sub-policy. `End` nodes may name it: `done` ends it in success, `fail` in the failure `failed`.
    Inline {
        /// The sub-policy's name.
        policy: SmolStr,
        /// Its steps.
        body: RegionId,
    },
    /// A condition; unknown is first observed, and counts as false if it stays unknown.
    If {
        /// The condition.
        condition: Condition,
        /// Where it holds.
        then: RegionId,
        /// Where it does not.
        otherwise: Option<RegionId>,
    },
    /// Blocks until a condition holds, else fails with `timeout`.
    Wait {
        /// What is waited for.
        condition: Condition,
        /// The deadline in seconds.
        within_secs: f64,
    },
    /// Watches conditions while the body runs. An outer monitor wins over an inner one, an earlier watch over a later.
    Monitor {
        /// What is watched.
        watches: Vec<Watch>,
        /// What runs.
        body: RegionId,
    },
    /// Handles failures of its body.
    Try {
        /// What may fail.
        body: RegionId,
        /// The failure edges; the first that fits wins.
        handlers: Vec<Handler>,
    },
    /// A bounded loop: the body, then the test. With a test that never held after the last run: `exhausted`.
    Repeat {
        /// How often at most; at least once.
        times: u32,
        /// The body.
        body: RegionId,
        /// The test.
        until: Option<Condition>,
    },
    /// A loop over a list. A longer list is the failure `exhausted`, before the first item.
    Each {
        /// The loop's binding.
        item: BindingId,
        /// The list.
        list: Term,
        /// The longest list that is taken.
        at_most: u32,
        /// The body.
        body: RegionId,
    },
    /// All branches at once; succeeds when all have, and a failing branch interrupts the others.
    Parallel {
        /// The branches.
        branches: Vec<RegionId>,
    },
    /// Ends the policy, or the inlined policy `of`.
    End {
        /// How.
        how: Ending,
        /// The [`NodeKind::Inline`] node that ends; none for the whole policy.
        of: Option<NodeId>,
        /// The reason.
        why: Option<Term>,
    },
}

/// The ways a policy can end by its own word.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Ending {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It asks for a new policy.
    Replan,
}

/// A call of a primitive.
#[derive(Clone, PartialEq, Debug)]
pub struct CallNode {
    /// The primitive.
    pub primitive: PrimitiveId,
    /// An argument for each parameter, in order, defaults filled in.
    pub args: Vec<Term>,
    /// Where the result goes; always given where the primitive has a result.
    pub binds: Option<BindingId>,
    /// The deadline of one attempt in seconds.
    pub deadline_secs: f64,
    /// How often it is tried again after a failure.
    pub retries: u32,
    /// Its preconditions with their verdicts. Those that are deferred are the guards, checked before each start.
    pub needs: Vec<Need>,
    /// Its motion with its verdict.
    pub motion: Option<Motion>,
    /// What is true after success, applied in order after all conditions were evaluated.
    pub effects: Vec<Effect>,
    /// Facts that are unknown as soon as it starts; after a failure also those that `effects` name.
    pub unsettles: Vec<Unsettled>,
}

/// Facts that a step leaves unknown.
#[derive(Clone, PartialEq, Debug)]
pub struct Unsettled {
    /// Which.
    pub fact: Fact,
    /// The condition, in the state before the step; [`Term::Each`] may occur in it.
    pub when: Option<Condition>,
    /// The kind over which [`Term::Each`] ranges.
    pub each: Option<KindId>,
}

/// What the prover found.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Verdict {
    /// It holds on every path: nothing is left to check.
    Proven,
    /// Only observation can tell: the engine checks it before the step starts.
    Deferred,
}

/// A precondition.
#[derive(Clone, PartialEq, Debug)]
pub struct Need {
    /// What must hold when the step starts. With `each`, for every entity of that kind that the engine has heard of.
    pub condition: Condition,
    /// Asked only where this is true; unknown counts as false. [`Term::Each`] may occur in it.
    pub when: Option<Condition>,
    /// The kind over which [`Term::Each`] ranges in `condition` and `when`.
    pub each: Option<KindId>,
    /// Whether that is known.
    pub verdict: Verdict,
    /// The failure in which the step ends where the guard is refuted.
    pub failure: FailureId,
}

/// A motion that must have a solution.
#[derive(Clone, PartialEq, Debug)]
pub struct Motion {
    /// The query, one of `go_to`, `reach`, `put`, `pull`, `push`, `offer`, `look`, `posture`.
    pub query: SmolStr,
    /// Its arguments.
    pub args: Vec<Term>,
    /// Whether it is known to have a solution.
    pub verdict: Verdict,
}

/// A change of what is believed.
#[derive(Clone, PartialEq, Debug)]
pub struct Effect {
    /// What changes.
    pub fact: Fact,
    /// Its new value.
    pub value: bool,
    /// The condition, in the state before the effects; [`Term::Each`] may occur in it.
    pub when: Option<Condition>,
    /// The kind over which [`Term::Each`] ranges.
    pub each: Option<KindId>,
}

/// What a monitor watches.
#[derive(Clone, PartialEq, Debug)]
pub struct Watch {
    /// The condition that fires it.
    pub condition: Condition,
    /// Seconds for which it must hold without a break.
    pub hold_secs: f64,
    /// What then happens.
    pub reaction: Reaction,
}

/// What a monitor does when it fires.
#[derive(Clone, PartialEq, Debug)]
pub enum Reaction {
    /// Hold the body until the condition is false again; more than `within_secs` in all is the failure `timeout`.
    Pause {
        /// The longest pause, all pauses of one run of the monitor taken together.
        within_secs: f64,
    },
    /// The body again from its start, at most so often; then the failure `exhausted`.
    Restart {
        /// How often.
        at_most: u32,
    },
    /// Interrupt, run a region, go on from the interrupted step; then the failure `exhausted`.
    Resume {
        /// How often.
        at_most: u32,
        /// What runs in between.
        body: RegionId,
    },
    /// End the policy, or the inlined policy `of`.
    End {
        /// How.
        how: Ending,
        /// The [`NodeKind::Inline`] node that ends; none for the whole policy.
        of: Option<NodeId>,
        /// The reason.
        why: Option<Term>,
    },
}

/// A failure edge.
#[derive(Clone, PartialEq, Debug)]
pub struct Handler {
    /// The failures that it takes; none takes all.
    pub on: Option<Vec<FailureId>>,
    /// What then runs.
    pub body: RegionId,
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug)]
pub struct Fact {
    /// The fluent.
    pub fluent: FluentId,
    /// An argument for each parameter.
    pub args: Vec<FactArg>,
}

/// An argument of a fluent.
#[derive(Clone, PartialEq, Debug)]
pub enum FactArg {
    /// A term that gives an entity, a case or another value.
    Term(Term),
    /// In an effect every entity, in a condition some entity.
    Any,
}

/// A condition over three values: true, false and unknown (Kleene's strong logic).
#[derive(Clone, PartialEq, Debug)]
pub enum Condition {
    /// `true` or `false`.
    Literal(bool),
    /// A fluent.
    Fact(Fact),
    /// A comparison.
    Compare(Comparison, Term, Term),
    /// Negation.
    Not(Box<Condition>),
    /// All hold; true where there is none.
    All(Vec<Condition>),
    /// At least one holds; false where there is none.
    AnyOf(Vec<Condition>),
}

/// A comparison. `Equal` and `Unequal` take values of any type, the others numbers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Comparison {
    /// `==`
    Equal,
    /// `!=`
    Unequal,
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `>`
    More,
    /// `>=`
    AtLeast,
}

/// Something that has a value.
#[derive(Clone, PartialEq, Debug)]
pub enum Term {
    /// A literal.
    Literal(Value),
    /// A binding.
    Binding(BindingId),
    /// The variable of a quantified entry; only in [`Effect`], [`Unsettled`] and [`Need`].
    Each,
    /// A field of an entity, observed like a measure.
    Field(Box<Term>, SmolStr),
    /// A measure.
    Measure(MeasureId, Vec<Term>),
    /// A list whose elements are not all literals.
    List(Vec<Term>),
    /// Arithmetic on numbers.
    Arith(Arithmetic, Box<Term>, Box<Term>),
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Arithmetic {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}
