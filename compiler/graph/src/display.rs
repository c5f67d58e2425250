//! How values look to people and in traces: as in the text form, without units.

use crate::model::Value;
use std::fmt;

impl fmt::Display for Value {
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
