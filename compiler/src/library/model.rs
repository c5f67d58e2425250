//! The declarations in force: the standard library, the robot's own, a domain's. Built once, then only read.

use std::sync::Arc;

use indexmap::IndexMap;
use motet_syntax::Span;
use motet_syntax::ast::{self, PrimitiveKind};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use crate::ir::{Base, Condition, Entity, EnumId, Fact, Failure, Fluent, Kind, Measure, Primitive, Term, Ty};

/// A set of resources, as bits; at most 64 of them.
pub(crate) type ResourceSet = u64;

/// The declarations in force.
#[derive(Clone, Debug, Default)]
pub struct Library {
    /// The robot's name; empty without one.
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
    /// Numbers of the robot's card.
    pub(crate) numbers: IndexMap<SmolStr, (f64, Ty)>,
    /// Seconds that one observation may take.
    pub(crate) observe_within_secs: f64,
    pub(crate) names: Names,
    pub(crate) known: Known,
    /// Fluents that some perception makes and that do not last.
    pub(crate) perceived: Vec<Fluent>,
}

/// Name to index, one table a name space.
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
    /// A case to its enumeration and place there; of two enumerations with the same case the first.
    pub(crate) cases: FxHashMap<SmolStr, (EnumId, u16)>,
}

/// What the prover asks for by name at every step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Known {
    pub(crate) person: Option<Kind>,
    pub(crate) open: Option<Fluent>,
    pub(crate) holding: Option<Fluent>,
    pub(crate) distance: Option<Measure>,
    pub(crate) exhausted: Option<Failure>,
    pub(crate) failed: Option<Failure>,
    /// `unsafe`
    pub(crate) harm: Option<Failure>,
}

impl Known {
    /// Those among the names of a library that has its kinds, fluents, measures and failures.
    pub(super) fn of(names: &Names) -> Self {
        let Names { kinds, fluents, measures, failures, .. } = names;
        Self {
            person: kinds.get("Person").copied(),
            open: fluents.get("open").copied(),
            holding: fluents.get("holding").copied(),
            distance: measures.get("distance").copied(),
            exhausted: failures.get("exhausted").copied(),
            failed: failures.get("failed").copied(),
            harm: failures.get("unsafe").copied(),
        }
    }
}

/// An entity kind.
#[derive(Clone, Debug)]
pub(crate) struct KindDef {
    pub(crate) name: SmolStr,
    pub(crate) parent: Option<Kind>,
    pub(crate) fields: IndexMap<SmolStr, Ty>,
}

/// An enumeration; `Hand`, `Camera` and `Resource` come from the card.
#[derive(Clone, Debug)]
pub(crate) struct EnumDef {
    pub(crate) name: SmolStr,
    pub(crate) cases: Vec<SmolStr>,
}

/// A fluent.
#[derive(Clone, Debug)]
pub(crate) struct FluentDef {
    pub(crate) name: SmolStr,
    pub(crate) params: Vec<(SmolStr, Ty)>,
    /// Whether the verdict of a motion decides it (`reachable`).
    pub(crate) derived: bool,
    pub(crate) observable: bool,
}

/// A measure.
#[derive(Clone, Debug)]
pub(crate) struct MeasureDef {
    pub(crate) name: SmolStr,
    pub(crate) params: Vec<(SmolStr, Ty)>,
    pub(crate) result: Ty,
    pub(crate) observable: bool,
}

/// A resource of the robot.
#[derive(Clone, Debug)]
pub(crate) struct ResourceDef {
    pub(crate) name: SmolStr,
    /// Itself and all that it contains.
    pub(crate) closure: ResourceSet,
}

/// A primitive with its contract.
#[derive(Clone, Debug)]
pub(crate) struct PrimitiveDef {
    pub(crate) name: SmolStr,
    pub(crate) form: PrimitiveKind,
    pub(crate) params: Vec<ParamDef>,
    pub(crate) result: Option<Ty>,
    pub(crate) needs: Vec<NeedDef>,
    pub(crate) makes: Vec<EffectDef>,
    pub(crate) unsettles: Vec<EffectDef>,
    pub(crate) motion: Option<(SmolStr, Vec<Term>)>,
    /// With all that they contain.
    pub(crate) uses: ResourceSet,
    /// As written, for the graph.
    pub(crate) uses_named: Vec<u8>,
    pub(crate) takes: (f64, f64),
    pub(crate) fails: Vec<Failure>,
    pub(crate) lasts: Option<LastsDef>,
    /// Whether the robot's card provides it; without a robot every primitive counts as provided.
    pub(crate) provided: bool,
    /// The declaration as written.
    pub(crate) source: Arc<ast::PrimitiveDecl>,
}

/// A parameter of a primitive.
#[derive(Clone, Debug)]
pub(crate) struct ParamDef {
    pub(crate) name: SmolStr,
    pub(crate) ty: Ty,
    pub(crate) default: Option<Term>,
    /// Least and greatest value, from the card, in SI units.
    pub(crate) range: Option<(f64, f64)>,
}

/// A precondition.
#[derive(Clone, Debug)]
pub(crate) struct NeedDef {
    pub(crate) condition: Condition,
    pub(crate) each: Option<Kind>,
    pub(crate) when: Option<Condition>,
    pub(crate) span: Span,
}

/// An effect; of `unsettles`, `value` says nothing.
#[derive(Clone, Debug)]
pub(crate) struct EffectDef {
    pub(crate) fact: Fact,
    pub(crate) value: bool,
    pub(crate) each: Option<Kind>,
    pub(crate) when: Option<Condition>,
}

/// How long what was perceived stays true.
#[derive(Clone, Debug)]
pub(crate) struct LastsDef {
    /// Until a later step uses one of these.
    pub(crate) resources: ResourceSet,
    /// Until one of these moves.
    pub(crate) entities: Vec<Term>,
}

impl NeedDef {
    /// The last parameter of the primitive that it speaks of.
    pub(crate) fn last_param(&self) -> Option<u16> {
        self.condition.last_param().max(self.when.as_ref().and_then(Condition::last_param))
    }
}

impl Library {
    /// Whether `kind` is `ancestor` or below it.
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

    /// The field of a kind or of one above it.
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

    /// The fields of a kind and of those above it, its own first.
    pub(crate) fn fields_of(&self, kind: Kind) -> impl Iterator<Item = &SmolStr> {
        let kinds = std::iter::successors(self.kinds.get(kind.index()), |def| {
            def.parent.and_then(|parent| self.kinds.get(parent.index()))
        });
        kinds.flat_map(|def| def.fields.keys())
    }

    /// Whether a value of type `actual` may stand where `expected` is asked for. There is no conversion, but a whole
    /// number is a number and a subkind is its parent.
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

    /// A type as the language writes it.
    #[must_use]
    pub(crate) fn type_name(&self, ty: Ty) -> String {
        let base = match ty.base {
            Base::Bool => "Bool",
            Base::Int => "Int",
            Base::Number => "Number",
            Base::Quantity(dimension) => dimension.type_name().unwrap_or("a quantity"),
            Base::Text => "Text",
            Base::Pose => "Pose",
            Base::Entity(kind) => self.kinds.get(kind.index()).map_or("Entity", |def| def.name.as_str()),
            Base::Enum(id) => self.enums.get(id.index()).map_or("an enumeration", |def| def.name.as_str()),
            Base::Unknown => "unknown",
        };
        (0..ty.lists).fold(base.to_owned(), |inner, _| format!("List<{inner}>"))
    }

    /// The kind with this name, or the root kind.
    #[must_use]
    pub(crate) fn kind_named(&self, name: &str) -> Kind {
        self.names.kinds.get(name).copied().unwrap_or(Kind(0))
    }

    /// The declarations of the primitives that the robot provides, in the order in which they were read.
    pub fn signatures(&self) -> impl Iterator<Item = &ast::PrimitiveDecl> {
        self.primitives.iter().filter(|def| def.provided).map(|def| &*def.source)
    }

    /// The name of the parameter at a position, from 0, of a primitive or policy.
    pub(crate) fn parameter(&self, callee: &str, position: usize) -> Option<SmolStr> {
        if let Some(primitive) = self.names.primitives.get(callee) {
            return self.primitive(*primitive)?.params.get(position).map(|param| param.name.clone());
        }
        let policy = self.policies.get(*self.names.policies.get(callee)?)?;
        policy.params.get(position).map(|param| param.name.text.clone())
    }

    /// The policies that can be called.
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
        self.failures.get(id.index()).map_or("failed", |(name, _)| name.as_str())
    }

    pub(crate) fn case_name(&self, id: EnumId, case: u16) -> &str {
        self.enums.get(id.index()).and_then(|def| def.cases.get(case as usize)).map_or("?", SmolStr::as_str)
    }
}
