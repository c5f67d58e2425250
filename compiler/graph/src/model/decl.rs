//! What a graph declares: kinds, types, values, signatures, bindings.

use smol_str::SmolStr;

use super::{FailureId, KindId, ResourceId};

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
    /// Whether it is bound before the first step: by the run that this policy takes over, or by a host.
    pub given: bool,
}
