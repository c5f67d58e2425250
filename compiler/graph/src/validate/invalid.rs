//! Reasons for which validation refuses a graph.

use smol_str::SmolStr;
use thiserror::Error;

/// One reason for which a graph cannot be run.
#[derive(Clone, PartialEq, Debug, Error)]
#[error("{at}: {reason}")]
pub struct InvalidGraph {
    /// The path of the node, or the table and the index in it.
    pub at: SmolStr,
    pub reason: InvalidReason,
}

/// Kind of a validation error.
#[derive(Clone, PartialEq, Debug, Error)]
pub enum InvalidReason {
    /// A table or the nesting is larger than a limit.
    #[error("{count} {what} are more than the limit of {limit}")]
    TooMany { what: &'static str, count: usize, limit: usize },
    /// An id names nothing.
    #[error("{what} {id} does not exist")]
    NoSuch { what: &'static str, id: u32 },
    /// The first failure is not `timeout`.
    #[error("the first failure must be `timeout`")]
    NoTimeout,
    /// A kind's parent does not come before it.
    #[error("the kind `{0}` must come after its parent")]
    KindOrder(SmolStr),
    /// There is no root region, or it has an owner, or another has none.
    #[error("region {0} must have {expected}", expected = if *.0 == 0 { "no owner" } else { "an owner" })]
    Owner(u32),
    /// A region is named by no node, by several, or by one that is not its owner.
    #[error("region {0} must be named exactly once, by the node that owns it")]
    Ownership(u32),
    /// An edge leads to a node of another region.
    #[error("the edge to node {0} leaves the region")]
    EdgeLeavesRegion(u32),
    /// An edge leads back: nodes stand in document order, so that there is no cycle.
    #[error("the edge to node {0} leads back")]
    EdgeLeadsBack(u32),
    /// A node comes before the node that it lies in.
    #[error("the node stands before the one that it lies in")]
    BeforeOwner,
    /// Two edges lead to one node.
    #[error("more than one edge leads to the node")]
    TwoEdges,
    /// No edge leads to a node.
    #[error("no edge leads to the node")]
    Unreachable,
    /// An ending names a node that is no sub-policy around it.
    #[error("the ending names node {0}, which is no sub-policy around it")]
    NotEnclosing(u32),
    /// An ending of the whole policy on behalf of a sub-policy.
    #[error("`replan` and `cannot` end the whole policy, not a sub-policy")]
    ReplanOfPart,
    /// An ending inside a cleanup that it would leave.
    #[error("an ending leaves a cleanup")]
    EndsCleanup,
    /// A part is not above 0 and at most 1.
    #[error("{what} is {value}, which is not above 0 and at most 1")]
    Part { what: &'static str, value: f64 },
    /// A number is not finite or out of its range.
    #[error("{what} is {value}, which is no finite number of at least 0")]
    Number { what: &'static str, value: f64 },
    /// A literal that is not finite.
    #[error("a literal is {0}, which is no finite number")]
    NotFinite(f64),
    /// A least duration above the greatest.
    #[error("the least duration {least} s is above the greatest {greatest} s")]
    Bounds { least: f64, greatest: f64 },
    /// A loop that never runs.
    #[error("a loop must run at least once")]
    NoRuns,
    /// Something has the wrong number of arguments.
    #[error("`{of}` takes {expected} arguments, not {given}")]
    Arity { of: SmolStr, expected: usize, given: usize },
    /// An argument has the wrong type.
    #[error("argument {index} of `{of}` has the wrong type", index = .index + 1)]
    Argument {
        of: SmolStr,
        /// Its place, from 0.
        index: usize,
    },
    /// The two sides of a comparison cannot be compared.
    #[error("the two sides of a comparison do not fit each other")]
    Comparison,
    /// Arithmetic on something that is no number.
    #[error("arithmetic needs numbers")]
    Arithmetic,
    /// A field of something that is no entity.
    #[error("only an entity has the field `{0}`")]
    FieldOf(SmolStr),
    /// An argument that would have to be observed before the query around it can be asked.
    #[error("an argument of a fluent, a measure or a field must be known without observing")]
    Nested,
    /// The variable of a quantified entry in a place where there is none.
    #[error("the variable of `for each` is used where nothing is quantified")]
    Each,
    /// A loop over something that is no list, or the number or the first of its elements.
    #[error("a loop, a count and a first element need a list")]
    NotAList,
    /// A value in a text that is not of the type by which it is to be written.
    #[error("a value in a text has the wrong type")]
    TextValue,
    /// A call whose result goes nowhere, or that binds without having a result.
    #[error("the call of `{0}` must bind its result, and only its result")]
    Result(SmolStr),
    /// A name of one type is bound to a value of another.
    #[error("`{0}` cannot hold the value that is bound to it")]
    BindingType(SmolStr),
    /// A name is used where no path has bound it.
    #[error("`{0}` is used before it is bound")]
    Unbound(SmolStr),
    /// A name that the policy is to be given was not given, or not with a value of its type.
    #[error("`{0}` is not given")]
    NotGiven(SmolStr),
    /// Two branches that run at once need the same resource.
    #[error("two branches need `{0}` at the same time")]
    Conflict(SmolStr),
    /// A motion that is proven without a solution, or has one that is none.
    #[error("the motion {0}")]
    Witness(&'static str),
    /// An initial fact that is not ground.
    #[error("the facts at the start must be made of literals")]
    NotGround,
}

/// The most nodes, and the most regions.
pub const MAX_NODES: usize = 200_000;
/// The deepest nesting of regions.
pub const MAX_DEPTH: usize = 1_024;
/// The deepest nesting of a condition, a term, a value or a type.
pub const MAX_TERM_DEPTH: usize = 48;
/// The most resources.
pub const MAX_RESOURCES: usize = 128;
/// The most findings that are reported.
pub(super) const MAX_FINDINGS: usize = 100;
