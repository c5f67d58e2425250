//! Which values have which type.

use crate::model::{Type, Value};

impl Value {
    /// Whether it is a value of a type. Numbers must be finite; a whole number also stands for a number. Of which kind an
    /// entity is, a value does not say.
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
