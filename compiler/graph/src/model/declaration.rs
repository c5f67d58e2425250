//! Declarations of a graph: kinds, fluents, measures, signatures of primitives, resources, bindings, initial
//! facts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::{Fact, FailureId, KindId, ResourceId, Type, Value};

/// An entity kind in the hierarchy of kinds.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Kind {
    pub name: SmolStr,
    /// The more general kind; absent for `Entity`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parent: Option<KindId>,
}

/// An entity that a document declares.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeclaredEntity {
    /// Id of the entity.
    pub entity: SmolStr,
    pub kind: KindId,
}

/// What people call an entity.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EntityName {
    /// Id of the entity.
    pub entity: SmolStr,
    pub name: SmolStr,
}

/// Meaning of a kind of failure, in words.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FailureSentence {
    pub failure: FailureId,
    /// A clause such as "the object left the hand".
    pub text: SmolStr,
}

/// A fluent: a relation between entities that is true, false or unknown.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluent {
    pub name: SmolStr,
    /// Types of the parameters.
    pub params: Vec<Type>,
    /// True if the robot can observe it. Another one is known only from effects and from the initial facts.
    pub observable: bool,
}

/// A measure: a number that the robot observes.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    pub name: SmolStr,
    /// Types of the parameters.
    pub params: Vec<Type>,
    /// Type of the reading.
    pub result: Type,
}

/// Signature of a primitive, for typing a call and for the driver.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Primitive {
    pub name: SmolStr,
    /// Parameters in the order of the declaration.
    pub params: Vec<Param>,
    /// Type of the result; absent for a primitive without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub result: Option<Type>,
    /// True if the primitive only perceives and moves nothing.
    pub perceives: bool,
    /// Resources that the primitive holds while it runs.
    pub uses: Vec<ResourceId>,
    /// Failures in which the primitive can end, `timeout` among them.
    pub fails: Vec<FailureId>,
}

/// A parameter of a primitive.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Param {
    pub name: SmolStr,
    #[serde(rename = "type")]
    pub ty: Type,
    /// Default argument, which labels leave out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub default: Option<ParamDefault>,
}

/// Default argument of a parameter.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ParamDefault {
    /// The same value for every call.
    Value(Value),
    /// The argument of an earlier parameter, by its index.
    Param(u32),
}

/// An exclusive resource. Two resources conflict if they are the same or one contains the other.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Resource {
    pub name: SmolStr,
    /// All resources that this one contains, directly or through another.
    pub contains: Vec<ResourceId>,
}

/// A name for the result of a step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Binding {
    /// The name in the policy. A suffix `'2`, `'3` … makes it unique where inlining repeats it; an unnamed
    /// result is `_`.
    pub name: SmolStr,
    #[serde(rename = "type")]
    pub ty: Type,
    /// True if the name is bound before the first step: by the run that this policy takes over, or by a host.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub given: bool,
    /// Entities of which a found value is one, as the proofs assume; behind another one, whatever they proved
    /// is a guard. Empty where the proofs assume nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub among: Vec<SmolStr>,
}

impl Binding {
    /// Checks if a value is one that the proofs assume.
    #[must_use]
    pub fn is_assumed(&self, value: &Value) -> bool {
        match value {
            Value::Entity(id) => self.among.is_empty() || self.among.contains(id),
            Value::Bool(_) | Value::Int(_) | Value::Number(_) | Value::Text(_) | Value::Case(_) => true,
            Value::List(_) | Value::Pose(_) => true,
        }
    }
}

/// A fact from which the policy was proved.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialFact {
    /// The fact; its arguments are literals or `any`.
    pub fact: Fact,
    /// Truth value at the start.
    pub value: bool,
}
