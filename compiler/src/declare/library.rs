//! The library: all declarations in force with typed ids. Built once, then only read.

use std::sync::Arc;

use indexmap::IndexMap;
use motet_stdlib::lang;
use motet_syntax::Span;
use motet_syntax::ast::{self, PrimitiveKind};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use super::lang_items::LangItems;
use crate::ir::{
    Base, Condition, Entity, EnumId, Fact, Failure, Fluent, Kind, Measure, MotionKind, Primitive, Term, Ty,
};

/// Set of at most 64 resources, as bits.
pub(crate) type ResourceSet = u64;

/// All declarations in force, by id and by name.
#[derive(Clone, Debug, Default)]
pub struct Library {
    /// Name of the robot; empty without one.
    pub robot: SmolStr,
    pub(crate) kinds: Vec<KindDef>,
    pub(crate) enums: Vec<EnumDef>,
    pub(crate) fluents: Vec<FluentDef>,
    pub(crate) measures: Vec<MeasureDef>,
    pub(crate) failures: Vec<(SmolStr, Span)>,
    pub(crate) primitives: Vec<PrimitiveDef>,
    pub(crate) policies: Vec<Arc<ast::Policy>>,
    pub(crate) resources: Vec<ResourceDef>,
    pub(crate) entities: Vec<(SmolStr, Kind, Span)>,
    pub(crate) initially: Vec<(Fact, bool, Span)>,
    pub(crate) closed_world: bool,
    /// Numbers of the robot's card, in SI units, with their types.
    pub(crate) numbers: IndexMap<SmolStr, (f64, Ty)>,
    /// Time limit of one observation, in seconds.
    pub(crate) observe_within_secs: f64,
    pub(crate) names: Names,
    pub(crate) lang_items: LangItems,
    /// Fluents that a perception makes and that become stale.
    pub(crate) perceived: Vec<Fluent>,
}

/// Ids by name, one table for each name space.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    pub(crate) kinds: FxHashMap<SmolStr, Kind>,
    pub(crate) enums: FxHashMap<SmolStr, EnumId>,
    pub(crate) fluents: FxHashMap<SmolStr, Fluent>,
    pub(crate) measures: FxHashMap<SmolStr, Measure>,
    pub(crate) failures: FxHashMap<SmolStr, Failure>,
    pub(crate) primitives: FxHashMap<SmolStr, Primitive>,
    pub(crate) policies: FxHashMap<SmolStr, usize>,
    pub(crate) entities: FxHashMap<SmolStr, Entity>,
    /// Enumeration and index of each case; the first enumeration wins where two share a case.
    pub(crate) cases: FxHashMap<SmolStr, (EnumId, u16)>,
}

/// Definition of an entity kind.
#[derive(Clone, Debug)]
pub(crate) struct KindDef {
    pub(crate) name: SmolStr,
    pub(crate) parent: Option<Kind>,
    pub(crate) fields: IndexMap<SmolStr, Ty>,
}

/// Definition of an enumeration; `Hand`, `Camera` and `Resource` come from the card.
#[derive(Clone, Debug)]
pub(crate) struct EnumDef {
    pub(crate) name: SmolStr,
    pub(crate) cases: Vec<SmolStr>,
}

/// Definition of a fluent.
#[derive(Clone, Debug)]
pub(crate) struct FluentDef {
    pub(crate) name: SmolStr,
    pub(crate) params: Vec<(SmolStr, Ty)>,
    /// True if the verdict of a motion decides the fluent (`reachable`).
    pub(crate) derived: bool,
    pub(crate) observable: bool,
}

/// Definition of a measure.
#[derive(Clone, Debug)]
pub(crate) struct MeasureDef {
    pub(crate) name: SmolStr,
    pub(crate) params: Vec<(SmolStr, Ty)>,
    pub(crate) result: Ty,
    pub(crate) observable: bool,
}

/// Definition of a resource of the robot.
#[derive(Clone, Debug)]
pub(crate) struct ResourceDef {
    pub(crate) name: SmolStr,
    /// The resource and all that it contains.
    pub(crate) closure: ResourceSet,
}

/// Definition of a primitive with its contract.
#[derive(Clone, Debug)]
pub(crate) struct PrimitiveDef {
    pub(crate) name: SmolStr,
    pub(crate) form: PrimitiveKind,
    pub(crate) params: Vec<ParamDef>,
    pub(crate) result: Option<Ty>,
    pub(crate) needs: Vec<NeedDef>,
    pub(crate) makes: Vec<EffectDef>,
    pub(crate) unsettles: Vec<EffectDef>,
    pub(crate) motion: Option<(MotionKind, Vec<Term>)>,
    /// Resources in use, with all that they contain.
    pub(crate) uses: ResourceSet,
    /// Resources as the contract names them, for the graph.
    pub(crate) uses_named: Vec<u8>,
    pub(crate) takes: (f64, f64),
    pub(crate) fails: Vec<Failure>,
    pub(crate) lasts: Option<LastsDef>,
    /// True if the robot's card provides the primitive, or if there is no robot.
    pub(crate) provided: bool,
    /// The declaration as written.
    pub(crate) source: Arc<ast::PrimitiveDecl>,
}

/// Definition of a parameter of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct ParamDef {
    pub(crate) name: SmolStr,
    pub(crate) ty: Ty,
    pub(crate) default: Option<Term>,
    /// Least and greatest value from the card, in SI units.
    pub(crate) range: Option<(f64, f64)>,
}

/// Need of a primitive: a condition that must hold when the call starts.
#[derive(Clone, Debug)]
pub(crate) struct NeedDef {
    pub(crate) condition: Condition,
    pub(crate) each: Option<Kind>,
    pub(crate) when: Option<Condition>,
    pub(crate) span: Span,
}

/// Effect of a primitive; in `unsettles`, `value` has no meaning.
#[derive(Clone, Debug)]
pub(crate) struct EffectDef {
    pub(crate) fact: Fact,
    pub(crate) value: bool,
    pub(crate) each: Option<Kind>,
    pub(crate) when: Option<Condition>,
}

/// Lifetime of a perceived fact, from the clause `lasts`.
#[derive(Clone, Debug)]
pub(crate) struct LastsDef {
    /// Resources whose next use ends the lifetime.
    pub(crate) resources: ResourceSet,
    /// Entities whose next motion ends the lifetime.
    pub(crate) entities: Vec<Term>,
}

impl NeedDef {
    /// Highest index of a parameter that the need mentions.
    pub(crate) fn last_param(&self) -> Option<u16> {
        self.condition.last_param().max(self.when.as_ref().and_then(Condition::last_param))
    }
}

impl Library {
    /// Returns whether `kind` is `ancestor` or a descendant of it. O(depth).
    #[must_use]
    pub(crate) fn is_kind(&self, kind: Kind, ancestor: Kind) -> bool {
        let mut at = Some(kind);
        while let Some(current) = at {
            if current == ancestor {
                return true;
            }
            at = self.kinds.get(current.index()).and_then(|def| def.parent);
        }
        false
    }

    /// Type of a field of a kind or of one of its ancestors.
    #[must_use]
    pub(crate) fn field(&self, kind: Kind, name: &str) -> Option<Ty> {
        let mut at = Some(kind);
        while let Some(current) = at {
            let def = self.kinds.get(current.index())?;
            if let Some(ty) = def.fields.get(name) {
                return Some(*ty);
            }
            at = def.parent;
        }
        None
    }

    /// Names of the fields of a kind and of its ancestors, its own first.
    pub(crate) fn fields_of(&self, kind: Kind) -> impl Iterator<Item = &SmolStr> {
        let kinds = std::iter::successors(self.kinds.get(kind.index()), |def| {
            def.parent.and_then(|parent| self.kinds.get(parent.index()))
        });
        kinds.flat_map(|def| def.fields.keys())
    }

    /// Returns whether a value of type `actual` is allowed where `expected` is. There is no conversion, but
    /// an integer is a number, and a subkind is its parent.
    #[must_use]
    pub(crate) fn fits(&self, expected: Ty, actual: Ty) -> bool {
        match (expected.base, actual.base) {
            (Base::Unknown, _) | (_, Base::Unknown) => true,
            (Base::Entity(parent), Base::Entity(kind)) => {
                expected.lists == actual.lists && self.is_kind(kind, parent)
            }
            (Base::Number, Base::Int) => expected.lists == actual.lists,
            _ => expected == actual,
        }
    }

    /// Spelling of a type in the language.
    #[must_use]
    pub(crate) fn type_name(&self, ty: Ty) -> String {
        let base = match ty.base {
            Base::Bool => "Bool",
            Base::Int => "Int",
            Base::Number => "Number",
            Base::Quantity(dimension) => dimension.type_name().unwrap_or("a quantity"),
            Base::Text => "Text",
            Base::Pose => "Pose",
            Base::Entity(kind) => {
                self.kinds.get(kind.index()).map_or(lang::kinds::ENTITY, |def| def.name.as_str())
            }
            Base::Enum(id) => self.enums.get(id.index()).map_or("an enumeration", |def| def.name.as_str()),
            Base::Unknown => "unknown",
        };
        (0..ty.lists).fold(base.to_owned(), |inner, _| format!("List<{inner}>"))
    }

    /// Entities of every environment, with their kinds, at the ids [`crate::ir::ROBOT`],
    /// [`crate::ir::USER`] and
    /// [`crate::ir::START`].
    pub(crate) fn standard_entities(&self) -> [(&'static str, Kind); 3] {
        [
            (lang::entities::ROBOT, Kind::ROOT),
            (lang::entities::USER, self.lang_items.person.unwrap_or(Kind::ROOT)),
            (lang::entities::START, self.lang_items.place.unwrap_or(Kind::ROOT)),
        ]
    }

    /// Declarations of the primitives that the robot provides, in the order of reading.
    pub fn signatures(&self) -> impl Iterator<Item = &ast::PrimitiveDecl> {
        self.primitives.iter().filter(|def| def.provided).map(|def| &*def.source)
    }

    /// Name of a parameter of a primitive or policy by its position, from 0.
    pub(crate) fn parameter(&self, callee: &str, position: usize) -> Option<SmolStr> {
        if let Some(primitive) = self.names.primitives.get(callee) {
            return self.primitive(*primitive)?.params.get(position).map(|param| param.name.clone());
        }
        let policy = self.policies.get(*self.names.policies.get(callee)?)?;
        policy.params.get(position).map(|param| param.name.text.clone())
    }

    /// Policies that a step can call.
    pub fn policies(&self) -> impl Iterator<Item = &ast::Policy> {
        self.policies.iter().map(|policy| &**policy)
    }

    pub(crate) fn primitive(&self, id: Primitive) -> Option<&PrimitiveDef> {
        self.primitives.get(id.index())
    }

    pub(crate) fn fluent(&self, id: Fluent) -> Option<&FluentDef> {
        self.fluents.get(id.index())
    }

    pub(crate) fn measure(&self, id: Measure) -> Option<&MeasureDef> {
        self.measures.get(id.index())
    }

    pub(crate) fn failure_name(&self, id: Failure) -> &str {
        self.failures.get(id.index()).map_or(lang::failures::FAILED, |(name, _)| name.as_str())
    }

    pub(crate) fn case_name(&self, id: EnumId, case: u16) -> &str {
        self.enums.get(id.index()).and_then(|def| def.cases.get(case as usize)).map_or("?", SmolStr::as_str)
    }
}
