//! Values and their types.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::fmt;

use super::KindId;
use super::number::{self, Number};

/// Type of a value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Type {
    Bool,
    /// A whole number.
    Int,
    /// A number without a dimension.
    Number,
    Text,
    /// A position and an orientation in the frame `map`.
    Pose,
    /// A number in the SI unit of the named quantity (`Length`, `Angle`, …).
    Quantity(SmolStr),
    /// An entity of a kind.
    Entity(KindId),
    /// A case of the named enumeration; resources are cases of theirs (`Hand`, `Camera`).
    Case(SmolStr),
    List(Box<Type>),
}

/// A value of a binding, an argument or a reading.
///
/// JSON has no numbers that are not finite: they are written as the texts `"NaN"`, `"Infinity"` and
/// `"-Infinity"`. No valid graph holds one, but a driver may report one.
///
/// ```
/// use motet_graph::{Type, Value};
///
/// let width = Value::Number(0.08);
/// assert!(width.fits(&Type::Quantity("Length".into())));
/// assert!(!width.fits(&Type::Text));
/// assert_eq!(Value::List(vec![Value::Entity("mug_1".into()), Value::Int(2)]).to_string(), "[mug_1, 2]");
/// ```
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Value {
    Bool(bool),
    Int(i64),
    /// A finite number; of a quantity in SI units and radians.
    Number(
        #[serde(with = "number")]
        #[schemars(with = "Number")]
        f64,
    ),
    Text(SmolStr),
    /// Id of an entity.
    Entity(SmolStr),
    /// A case of an enumeration, or a resource.
    Case(SmolStr),
    Pose(Pose),
    List(Vec<Value>),
}

/// A pose in the frame `map`.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Pose {
    /// Position in m.
    #[serde(with = "number::array")]
    #[schemars(with = "[Number; 3]")]
    pub xyz: [f64; 3],
    /// Orientation as a unit quaternion in the order x, y, z, w.
    #[serde(with = "number::array")]
    #[schemars(with = "[Number; 4]")]
    pub quaternion: [f64; 4],
}

impl Pose {
    /// Turn about the vertical in rad, from -pi to pi.
    #[must_use]
    pub fn yaw(&self) -> f64 {
        let [x, y, z, w] = self.quaternion;
        (2.0 * (w * z + x * y)).atan2(1.0 - 2.0 * (y * y + z * z))
    }
}

impl Value {
    /// True if this is a value of the type. Numbers must be finite; a whole number also stands for a number.
    /// The kind of an entity is not checked, because a value does not carry it.
    #[must_use]
    pub fn fits(&self, ty: &Type) -> bool {
        match (self, ty) {
            (Self::Bool(_), Type::Bool) | (Self::Int(_), Type::Int | Type::Number | Type::Quantity(_)) => {
                true
            }
            (Self::Number(number), Type::Number | Type::Quantity(_)) => number.is_finite(),
            (Self::Text(_), Type::Text)
            | (Self::Entity(_), Type::Entity(_))
            | (Self::Case(_), Type::Case(_)) => true,
            (Self::Pose(pose), Type::Pose) => {
                pose.xyz.iter().chain(&pose.quaternion).all(|number| number.is_finite())
            }
            (Self::List(items), Type::List(inner)) => items.iter().all(|item| item.fits(inner)),
            (Self::Bool(_) | Self::Int(_) | Self::Number(_) | Self::Text(_) | Self::Entity(_), _) => false,
            (Self::Case(_) | Self::Pose(_) | Self::List(_), _) => false,
        }
    }
}

impl fmt::Display for Value {
    /// Writes the value as the text syntax does, without units.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bool(value) => write!(f, "{value}"),
            Self::Int(value) => write!(f, "{value}"),
            Self::Number(value) => write!(f, "{value}"),
            Self::Text(text) => write!(f, "{text:?}"),
            Self::Entity(id) => f.write_str(id),
            Self::Case(case) => f.write_str(case),
            Self::Pose(pose) => {
                let [x, y, z] = pose.xyz;
                let [qx, qy, qz, qw] = pose.quaternion;
                write!(f, "pose({x}, {y}, {z}; {qx}, {qy}, {qz}, {qw})")
            }
            Self::List(items) => {
                f.write_str("[")?;
                for (index, item) in items.iter().enumerate() {
                    if index > 0 {
                        f.write_str(", ")?;
                    }
                    write!(f, "{item}")?;
                }
                f.write_str("]")
            }
        }
    }
}
