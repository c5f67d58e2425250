//! What may stand in the place of one value.

use motet_compiler::Signatures;
use motet_compiler::signature::Type;
use smol_str::SmolStr;

use crate::subset::NumberRange;

/// The values that a place takes.
#[derive(Clone, PartialEq, Debug)]
pub struct ValueSet {
    /// A name for the rule, after the type.
    pub name: String,
    /// The entities or cases.
    pub names: Vec<SmolStr>,
    /// The numbers.
    pub number: Option<NumberRange>,
    /// Whether a text may stand here.
    pub text: bool,
    /// Whether `true` and `false` may stand here.
    pub bool: bool,
    /// Whether `any` may stand here.
    pub any: bool,
    /// Whether a name may stand here that a step has bound.
    pub binding: bool,
    /// The values of a list that is written out; a place in the offer.
    pub items: Option<usize>,
}

/// In what kind of place a value stands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct ValueContext {
    /// Whether anything can be bound there: a goal stands before all steps.
    pub(super) binds: bool,
    /// Whether it is an argument of a fluent.
    pub(super) any: bool,
}

impl ValueSet {
    /// The values of a type, but for the items of a list.
    pub(super) fn of(
        ty: &Type,
        range: Option<(f64, f64)>,
        place: ValueContext,
        signatures: &Signatures,
        bindable: &[Type],
    ) -> Self {
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
        let name = signatures.type_name(ty);
        Self {
            name: format!(
                "{name}{}{}",
                if place.any { "_any" } else { "" },
                if place.binds { "" } else { "_fixed" }
            ),
            names,
            number: NumberRange::of(ty, range),
            text: *ty == Type::Text,
            bool: *ty == Type::Bool,
            any: place.any,
            binding: place.binds && bindable.iter().any(|actual| signatures.fits(ty, actual)),
            items: None,
        }
    }

    /// Whether nothing may stand here.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
            && self.number.is_none()
            && !(self.text || self.bool || self.any || self.binding)
            && self.items.is_none()
    }
}
