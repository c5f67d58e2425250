//! The values that may stand at one place.

use motet_compiler::signature::Type;
use smol_str::SmolStr;

use super::{Grammar, ValuePlace};
use crate::subset::NumberRange;

/// The values that an exported grammar allows at a place.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ValueSet {
    /// A name for the rule, after the type.
    pub(crate) name: String,
    /// The entities or cases.
    pub(crate) names: Vec<SmolStr>,
    pub(crate) number: Option<NumberRange>,
    pub(crate) text: bool,
    pub(crate) bool: bool,
    pub(crate) any: bool,
    /// A name that a step has bound.
    pub(crate) binding: bool,
    /// The items of a list that is written out.
    pub(crate) items: Option<Box<Self>>,
}

impl ValueSet {
    /// The values of a type at a place; in a goal nothing is bound.
    pub(crate) fn of(
        ty: &Type,
        range: Option<(f64, f64)>,
        place: ValuePlace,
        in_goal: bool,
        grammar: &Grammar,
    ) -> Self {
        let signatures = &grammar.signatures;
        let binds = !in_goal && place != ValuePlace::Operand;
        let any = place == ValuePlace::OfFluent;
        let names = match ty {
            // `any` means something else where it may stand.
            Type::Entity(kind) => {
                signatures.entities_of(*kind).filter(|name| *name != "any").cloned().collect()
            }
            Type::Enum(id) => signatures.enums.get(*id).map(|def| def.cases.clone()).unwrap_or_default(),
            Type::Bool
            | Type::Int
            | Type::Number
            | Type::Quantity(_)
            | Type::Text
            | Type::Pose
            | Type::List(_) => Vec::new(),
        };
        let items = match ty {
            Type::List(element) => Some(Self::of(element, None, place, in_goal, grammar)),
            _ => None,
        };
        let (any_mark, goal_mark) = (if any { "_any" } else { "" }, if binds { "" } else { "_fixed" });
        Self {
            name: format!("{}{any_mark}{goal_mark}", signatures.type_name(ty)),
            names,
            number: NumberRange::of(ty, range),
            text: *ty == Type::Text,
            bool: *ty == Type::Bool,
            any,
            binding: binds && grammar.can_bind(ty),
            items: items.filter(|items| !items.is_empty()).map(Box::new),
        }
    }

    /// Something can stand at a place for a value of a type.
    pub(crate) fn is_fillable(
        ty: &Type,
        range: Option<(f64, f64)>,
        place: ValuePlace,
        grammar: &Grammar,
    ) -> bool {
        let signatures = &grammar.signatures;
        let is_written = match ty {
            Type::Entity(kind) => signatures.entities_of(*kind).any(|name| name != "any"),
            Type::Enum(id) => signatures.enums.get(*id).is_some_and(|def| !def.cases.is_empty()),
            Type::Text | Type::Bool => true,
            Type::Int | Type::Number | Type::Quantity(_) => NumberRange::of(ty, range).is_some(),
            Type::Pose => false,
            Type::List(element) => Self::is_fillable(element, None, place, grammar),
        };
        is_written || place == ValuePlace::OfFluent || (place != ValuePlace::Operand && grammar.can_bind(ty))
    }

    /// Nothing can stand at the place.
    pub(crate) fn is_empty(&self) -> bool {
        self.names.is_empty()
            && self.number.is_none()
            && !(self.text || self.bool || self.any || self.binding)
            && self.items.is_none()
    }

    /// The values have an order, so that they can be compared by more than equality.
    pub(crate) fn is_ordered(ty: &Type) -> bool {
        NumberRange::of(ty, None).is_some()
    }
}

impl Grammar {
    /// Some step or loop can bind a name that fits a type.
    pub(crate) fn can_bind(&self, ty: &Type) -> bool {
        self.bindable.iter().any(|actual| self.signatures.fits(ty, actual))
    }
}
