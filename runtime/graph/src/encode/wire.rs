//! What stands in a document. Field by field the same as the model, with ids as plain numbers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A graph.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// The version of the encoding, 1.
    pub motet_graph: u32,
    /// `sha256:` and the hash of the document without white space and with an empty hash.
    pub hash: String,
    /// The policy's name.
    pub policy: String,
    /// The robot's name; empty without one.
    pub robot: String,
    /// Entity kinds, parents before children.
    pub kinds: Vec<Kind>,
    /// Fluents.
    pub fluents: Vec<Fluent>,
    /// Measures.
    pub measures: Vec<Measure>,
    /// Primitives.
    pub primitives: Vec<Primitive>,
    /// Failure kinds; the first is `timeout`.
    pub failures: Vec<String>,
    /// Exclusive resources.
    pub resources: Vec<Resource>,
    /// Named results.
    pub bindings: Vec<Binding>,
    /// Regions; the first is the policy's body.
    pub regions: Vec<Region>,
    /// Nodes in document order.
    pub nodes: Vec<Node>,
    /// Facts that were known at the start.
    pub initial: Vec<Known>,
    /// Seconds that one observation may take.
    pub observe_within: f64,
    /// Least and greatest duration of the policy in seconds.
    pub duration: [f64; 2],
}

/// An entity kind.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Kind {
    /// Its name.
    pub name: String,
    /// The index of its parent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parent: Option<u32>,
}

/// A type.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Type {
    /// A truth value.
    Bool,
    /// A whole number.
    Int,
    /// A number without a dimension.
    Number,
    /// Text.
    Text,
    /// A pose.
    Pose,
    /// A number in SI units of the named quantity.
    Quantity(String),
    /// An entity of the kind with this index.
    Entity(u32),
    /// A case of the named enumeration.
    Case(String),
    /// A list.
    List(Box<Type>),
}

/// A value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Value {
    /// A truth value.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number in SI units.
    Number(f64),
    /// Text.
    Text(String),
    /// An entity's id.
    Entity(String),
    /// A case of an enumeration.
    Case(String),
    /// A pose.
    Pose {
        /// Position in metres.
        xyz: [f64; 3],
        /// Unit quaternion x, y, z, w.
        quaternion: [f64; 4],
    },
    /// A list.
    List(Vec<Value>),
}

/// A fluent.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluent {
    /// Its name.
    pub name: String,
    /// The types of its parameters.
    pub params: Vec<Type>,
    /// Whether the robot can observe it.
    pub observable: bool,
}

/// A measure.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    /// Its name.
    pub name: String,
    /// The types of its parameters.
    pub params: Vec<Type>,
    /// The type of what it gives.
    pub result: Type,
}

/// A primitive.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Primitive {
    /// Its name.
    pub name: String,
    /// Its parameters.
    pub params: Vec<Param>,
    /// The type of its result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub result: Option<Type>,
    /// Whether it only perceives.
    pub perceives: bool,
    /// Indices of the resources that it holds.
    pub uses: Vec<u32>,
    /// Indices of the failures that it can end in.
    pub fails: Vec<u32>,
}

/// A parameter.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Param {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub ty: Type,
}

/// A resource.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Resource {
    /// Its name.
    pub name: String,
    /// Indices of all that it contains.
    pub contains: Vec<u32>,
}

/// A named result.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Binding {
    /// Its name.
    pub name: String,
    /// Its type.
    #[serde(rename = "type")]
    pub ty: Type,
}

/// A region.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// The node that it belongs to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub owner: Option<u32>,
    /// Its first node.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entry: Option<u32>,
}

/// A fact that was known at the start.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// Which.
    pub fact: Fact,
    /// Whether it held.
    pub value: bool,
}

/// A step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Node {
    /// JSON Pointer to the step in the policy.
    pub path: String,
    /// The region that it runs in.
    pub region: u32,
    /// The next node of the region.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<u32>,
    /// Least and greatest duration in seconds.
    pub duration: [f64; 2],
    /// What it does.
    pub kind: NodeKind,
}

/// What a step does.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NodeKind {
    /// Runs a primitive.
    Call(Box<Call>),
    /// A named group.
    Sequence {
        /// Its name.
        name: String,
        /// Its region.
        body: u32,
    },
    /// An inlined sub-policy.
    Inline {
        /// Its name.
        policy: String,
        /// Its region.
        body: u32,
    },
    /// A branch.
    If {
        /// The condition.
        condition: Condition,
        /// The region where it holds.
        then: u32,
        /// The region where it does not.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        otherwise: Option<u32>,
    },
    /// A wait.
    Wait {
        /// The condition.
        condition: Condition,
        /// The deadline in seconds.
        within: f64,
    },
    /// A monitor.
    Monitor {
        /// What is watched.
        watches: Vec<Watch>,
        /// The region that it watches over.
        body: u32,
    },
    /// A body with handlers.
    Try {
        /// The body's region.
        body: u32,
        /// The handlers.
        handlers: Vec<Handler>,
    },
    /// A bounded loop.
    Repeat {
        /// How often at most.
        times: u32,
        /// The body's region.
        body: u32,
        /// The test.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until: Option<Condition>,
    },
    /// A loop over a list.
    Each {
        /// The loop's binding.
        item: u32,
        /// The list.
        list: Term,
        /// The longest list.
        at_most: u32,
        /// The body's region.
        body: u32,
    },
    /// Branches at once.
    Parallel {
        /// Their regions.
        branches: Vec<u32>,
    },
    /// An ending.
    End(End),
}

/// An ending.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct End {
    /// How.
    pub how: Ending,
    /// The node of the inlined policy that ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<u32>,
    /// The reason.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<Term>,
}

/// The ways to end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It asks for a new policy.
    Replan,
}

/// A call.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Call {
    /// The index of the primitive.
    pub primitive: u32,
    /// An argument for each parameter.
    pub args: Vec<Term>,
    /// Where the result goes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub binds: Option<u32>,
    /// The deadline of one attempt in seconds.
    pub deadline: f64,
    /// How often it is tried again.
    pub retries: u32,
    /// Its preconditions.
    pub needs: Vec<Need>,
    /// Its motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// What is true after success.
    pub effects: Vec<Effect>,
    /// What is unknown as soon as it starts.
    pub unsettles: Vec<Unsettled>,
}

/// What the prover found.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds on every path.
    Proven,
    /// It is checked before the step starts.
    Deferred,
}

/// A precondition.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Need {
    /// What must hold.
    pub condition: Condition,
    /// Where it is asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// The kind over which it ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<u32>,
    /// Whether it is known.
    pub verdict: Verdict,
    /// The failure where it does not hold.
    pub failure: u32,
}

/// A motion.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// The query.
    pub query: String,
    /// Its arguments.
    pub args: Vec<Term>,
    /// Whether it is known to have a solution.
    pub verdict: Verdict,
}

/// A change of what is believed.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Effect {
    /// What changes.
    pub fact: Fact,
    /// Its new value.
    pub value: bool,
    /// Under which condition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// The kind over which it ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<u32>,
}

/// Facts that a step leaves unknown.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Unsettled {
    /// Which.
    pub fact: Fact,
    /// Under which condition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// The kind over which it ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<u32>,
}

/// What a monitor watches.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Watch {
    /// The condition.
    pub condition: Condition,
    /// Seconds for which it must hold.
    pub hold: f64,
    /// What then happens.
    pub reaction: Reaction,
}

/// What a monitor does.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Reaction {
    /// Holds the body.
    Pause {
        /// For so many seconds at most.
        within: f64,
    },
    /// Starts the body again.
    Restart {
        /// So often at most.
        at_most: u32,
    },
    /// Interrupts the body, runs a region, goes on.
    Resume {
        /// So often at most.
        at_most: u32,
        /// The region.
        body: u32,
    },
    /// Ends.
    End(End),
}

/// A failure edge.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Handler {
    /// The failures that it takes; without it, all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<Vec<u32>>,
    /// The region that then runs.
    pub body: u32,
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fact {
    /// The index of the fluent.
    pub fluent: u32,
    /// Its arguments.
    pub args: Vec<FactArg>,
}

/// An argument of a fluent.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FactArg {
    /// In an effect every entity, in a condition some entity.
    Any,
    /// A term.
    Term(Term),
}

/// A condition.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// A literal.
    Literal(bool),
    /// A fluent.
    Fact(Fact),
    /// A comparison of two terms.
    Compare(Comparison, Term, Term),
    /// Negation.
    Not(Box<Condition>),
    /// All hold.
    All(Vec<Condition>),
    /// At least one holds.
    Any(Vec<Condition>),
}

/// A comparison.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    /// The variable of a quantified entry.
    Each,
    /// A literal.
    Literal(Value),
    /// The index of a binding.
    Binding(u32),
    /// A field of an entity.
    Field(Box<Term>, String),
    /// A measure by its index, with its arguments.
    Measure(u32, Vec<Term>),
    /// A list.
    List(Vec<Term>),
    /// Arithmetic.
    Arith(Arithmetic, Box<Term>, Box<Term>),
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
