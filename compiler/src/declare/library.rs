//! The library: all declarations in force with typed ids, and the language items among them. Built once, then
//! only read.

use std::sync::Arc;

use indexmap::IndexMap;
use motet_graph::Manner;
use motet_robots::scene::ServingReach;
use motet_stdlib::lang;
use motet_syntax::Span;
use motet_syntax::ast::{self, PrimitiveKind};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use crate::ir::{
    Base, Condition, Entity, EnumId, Fact, Failure, Fluent, Kind, Measure, MotionKind, Primitive, Term, Ty,
};

/// Name of the type of a failure that a handler caught.
pub(crate) const FAILURE: &str = "Failure";
/// Name of the enumeration of the kinds of failures, in messages.
const FAILURE_KIND: SmolStr = SmolStr::new_static("FailureKind");

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
    pub(crate) failures: Vec<FailureDef>,
    pub(crate) primitives: Vec<PrimitiveDef>,
    pub(crate) policies: Vec<Arc<ast::Policy>>,
    pub(crate) resources: Vec<ResourceDef>,
    pub(crate) entities: Vec<(SmolStr, Kind, Span)>,
    pub(crate) initially: Vec<(Fact, bool, Span)>,
    pub(crate) closed_world: bool,
    /// Numbers of the robot's card, in SI units, with their types.
    pub(crate) numbers: IndexMap<SmolStr, (f64, Ty)>,
    /// Distances from which the robot serves things; `None` without a robot or without hands.
    pub(crate) serving_reach: Option<ServingReach>,
    /// Time limit of one observation, in seconds.
    pub(crate) observe_within_secs: f64,
    /// Meanings of the words for manners.
    pub(crate) manners: Manners,
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

/// Definition of a failure.
#[derive(Clone, Debug)]
pub(crate) struct FailureDef {
    pub(crate) name: SmolStr,
    /// A clause about it without a full stop, from the first sentence of its documentation.
    pub(crate) text: SmolStr,
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
    /// Default argument: a constant, or an earlier parameter.
    pub(crate) default: Option<Term>,
    /// Least and greatest value from the card, in SI units.
    pub(crate) range: Option<(f64, f64)>,
}

impl ParamDef {
    /// Default argument of a call with these arguments for the earlier parameters; `None` without one.
    pub(crate) fn default_after<'t>(
        &'t self,
        arg: impl FnOnce(usize) -> Option<&'t Term>,
    ) -> Option<&'t Term> {
        match self.default.as_ref()? {
            Term::Param(earlier) => arg(usize::from(*earlier)),
            constant => Some(constant),
        }
    }
}

impl PrimitiveDef {
    /// Arguments of a call that are not the defaults of their parameters.
    pub(crate) fn asked<'t>(&'t self, args: &'t [Term]) -> impl Iterator<Item = &'t Term> {
        let is_asked = |(arg, param): &(&'t Term, &'t ParamDef)| {
            param.default_after(|earlier| args.get(earlier)) != Some(*arg)
        };
        args.iter().zip(&self.params).filter(is_asked).map(|(arg, _)| arg)
    }
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

/// Lifetime of the facts that a perception has made.
#[derive(Clone, Debug)]
pub(crate) struct PerceptionLifetime {
    pub(crate) resources: ResourceSet,
    pub(crate) entities: Vec<Entity>,
}

impl NeedDef {
    /// Highest index of a parameter that the need mentions.
    pub(crate) fn last_param(&self) -> Option<u16> {
        self.condition.last_param().max(self.when.as_ref().and_then(Condition::last_param))
    }
}

/// Meanings of the words for manners.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Manners {
    pub(crate) slowly: Manner,
    pub(crate) gently: Manner,
}

impl Manners {
    /// The manners of a robot's card.
    pub(crate) fn of(manners: &motet_robots::card::Manners) -> Self {
        let manner = |spec: motet_robots::card::MannerSpec| Manner {
            speed: spec.speed,
            acceleration: spec.acceleration,
        };
        Self { slowly: manner(manners.slowly), gently: manner(manners.gently) }
    }
}

impl Default for Manners {
    fn default() -> Self {
        Self::of(&motet_robots::card::Manners::default())
    }
}

impl Library {
    /// Adds the enumeration of the kinds of failures, behind all others. Its cases are in the order of the
    /// failures, and no declaration can name it.
    pub(super) fn add_failure_kinds(&mut self) {
        let cases = self.failures.iter().map(|def| def.name.clone()).collect();
        self.enums.push(EnumDef { name: FAILURE_KIND, cases });
    }

    /// Enumeration of the kinds of failures: the last one.
    pub(crate) fn failure_kinds(&self) -> EnumId {
        EnumId(u16::try_from(self.enums.len().saturating_sub(1)).unwrap_or(u16::MAX))
    }

    /// Enumerations that a declaration can name.
    pub(crate) fn named_enums(&self) -> impl Iterator<Item = &EnumDef> {
        self.enums.iter().take(self.failure_kinds().index())
    }

    /// Checks if a primitive moves the robot: by a motion of its own other than a look, or by a resource that
    /// such a motion of an action uses. O(primitives × resources).
    #[must_use]
    pub(crate) fn moves(&self, def: &PrimitiveDef) -> bool {
        let has_motion = |def: &PrimitiveDef| def.motion.as_ref().is_some_and(|(motion, _)| motion.moves());
        let mut actions = self.primitives.iter().filter(|other| other.form == PrimitiveKind::Action);
        has_motion(def)
            || actions.any(|other| {
                has_motion(other) && other.uses_named.iter().any(|resource| def.uses_named.contains(resource))
            })
    }

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

    /// The nearest type that values of both types have; `None` if there is none.
    pub(crate) fn common(&self, one: Ty, other: Ty) -> Option<Ty> {
        if self.fits(one, other) || self.fits(other, one) {
            return Some(if self.fits(one, other) { one } else { other });
        }
        let (Base::Entity(kind), Base::Entity(of)) = (one.base, other.base) else { return None };
        let parent = |kind: &Kind| self.kinds.get(kind.index())?.parent;
        let kind = std::iter::successors(Some(kind), parent).find(|kind| self.is_kind(of, *kind))?;
        (one.lists == other.lists).then_some(Ty { base: Base::Entity(kind), ..one })
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
            Base::Failure => FAILURE,
            Base::Unknown => "unknown",
        };
        (0..ty.lists).fold(base.to_owned(), |inner, _| format!("List<{inner}>"))
    }

    /// Entities of every environment, with their kinds, at the ids [`crate::ir::ROBOT`], [`crate::ir::USER`]
    /// and [`crate::ir::START`].
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
        self.failures.get(id.index()).map_or(lang::failures::FAILED, |def| def.name.as_str())
    }

    pub(crate) fn case_name(&self, id: EnumId, case: u16) -> &str {
        self.enums.get(id.index()).and_then(|def| def.cases.get(case as usize)).map_or("?", SmolStr::as_str)
    }
}

/// Declarations of the standard library that the compiler knows by name; `None` for one that a library does
/// not declare.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LangItems {
    pub(crate) place: Option<Kind>,
    pub(crate) surface: Option<Kind>,
    pub(crate) container: Option<Kind>,
    pub(crate) object: Option<Kind>,
    pub(crate) person: Option<Kind>,
    pub(crate) zone: Option<Kind>,
    pub(crate) approach: Option<EnumId>,
    pub(crate) hand: Option<EnumId>,
    pub(crate) at: Option<Fluent>,
    pub(crate) clear: Option<Fluent>,
    pub(crate) free: Option<Fluent>,
    pub(crate) holding: Option<Fluent>,
    pub(crate) inside: Option<Fluent>,
    pub(crate) lifted: Option<Fluent>,
    pub(crate) located: Option<Fluent>,
    pub(crate) locked: Option<Fluent>,
    pub(crate) near: Option<Fluent>,
    pub(crate) on: Option<Fluent>,
    pub(crate) open: Option<Fluent>,
    pub(crate) reachable: Option<Fluent>,
    pub(crate) visible: Option<Fluent>,
    pub(crate) visited: Option<Fluent>,
    pub(crate) distance: Option<Measure>,
    pub(crate) ambiguous: Option<Failure>,
    pub(crate) blocked: Option<Failure>,
    pub(crate) exhausted: Option<Failure>,
    pub(crate) failed: Option<Failure>,
    pub(crate) not_found: Option<Failure>,
    pub(crate) too_heavy: Option<Failure>,
    pub(crate) unreachable: Option<Failure>,
    pub(crate) harm: Option<Failure>,
}

impl LangItems {
    /// Looks up the items among the names of a library.
    pub(super) fn of(names: &Names) -> Self {
        let kind = |name: &str| names.kinds.get(name).copied();
        let enumeration = |name: &str| names.enums.get(name).copied();
        let fluent = |name: &str| names.fluents.get(name).copied();
        let failure = |name: &str| names.failures.get(name).copied();
        Self {
            place: kind(lang::kinds::PLACE),
            surface: kind(lang::kinds::SURFACE),
            container: kind(lang::kinds::CONTAINER),
            object: kind(lang::kinds::OBJECT),
            person: kind(lang::kinds::PERSON),
            zone: kind(lang::kinds::ZONE),
            approach: enumeration(lang::enums::APPROACH),
            hand: enumeration(lang::card_enums::HAND),
            at: fluent(lang::fluents::AT),
            clear: fluent(lang::fluents::CLEAR),
            free: fluent(lang::fluents::FREE),
            holding: fluent(lang::fluents::HOLDING),
            inside: fluent(lang::fluents::IN),
            lifted: fluent(lang::fluents::LIFTED),
            located: fluent(lang::fluents::LOCATED),
            locked: fluent(lang::fluents::LOCKED),
            near: fluent(lang::fluents::NEAR),
            on: fluent(lang::fluents::ON),
            open: fluent(lang::fluents::OPEN),
            reachable: fluent(lang::fluents::REACHABLE),
            visible: fluent(lang::fluents::VISIBLE),
            visited: fluent(lang::fluents::VISITED),
            distance: names.measures.get(lang::measures::DISTANCE).copied(),
            ambiguous: failure(lang::failures::AMBIGUOUS),
            blocked: failure(lang::failures::BLOCKED),
            exhausted: failure(lang::failures::EXHAUSTED),
            failed: failure(lang::failures::FAILED),
            not_found: failure(lang::failures::NOT_FOUND),
            too_heavy: failure(lang::failures::TOO_HEAVY),
            unreachable: failure(lang::failures::UNREACHABLE),
            harm: failure(lang::failures::UNSAFE),
        }
    }

    /// Fluents that depend on the poses of the robot and of things.
    pub(crate) fn poses(&self) -> impl Iterator<Item = Fluent> {
        [self.at, self.on, self.inside, self.holding, self.open, self.lifted].into_iter().flatten()
    }

    /// Failure of a refuted need: from its fluent or field if the primitive lists it, else `failed`.
    pub(crate) fn need_failure(&self, condition: &Condition, fails: &[Failure]) -> Option<Failure> {
        let kind = self.specific_failure(condition).filter(|kind| fails.contains(kind));
        kind.or(self.failed)
    }

    fn specific_failure(&self, condition: &Condition) -> Option<Failure> {
        match condition {
            Condition::Fact(fact) => self.guard_failure(fact.fluent),
            Condition::Compare(_, Term::Field(_, name), _) => match name.as_str() {
                lang::fields::MASS => self.too_heavy,
                lang::fields::WIDTH => self.unreachable,
                _ => None,
            },
            Condition::Not(inner) => self.specific_failure(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.first().and_then(|part| self.specific_failure(part))
            }
            Condition::Compare(..)
            | Condition::Literal(_)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => None,
        }
    }

    /// Failure of a guard on a fluent.
    fn guard_failure(&self, fluent: Fluent) -> Option<Failure> {
        let is_one_of = |fluents: &[Option<Fluent>]| fluents.contains(&Some(fluent));
        if is_one_of(&[self.reachable, self.at, self.near]) {
            self.unreachable
        } else if is_one_of(&[self.visible, self.located]) {
            self.not_found
        } else if is_one_of(&[self.clear, self.open, self.locked]) {
            self.blocked
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use motet_stdlib::lang;
    use motet_syntax::Sources;

    use crate::declare::Library;

    #[test]
    fn lang_items_are_declared_in_the_standard_library() {
        let library = Library::builder(None, &mut Sources::default()).build().0;
        let names = &library.names;
        let missing = |all: &[&'static str], is_declared: &dyn Fn(&str) -> bool| {
            all.iter().copied().filter(|name| !is_declared(name)).collect::<Vec<_>>()
        };
        assert_eq!(missing(lang::kinds::ALL, &|name| names.kinds.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::enums::ALL, &|name| names.enums.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::card_enums::ALL, &|name| names.enums.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::approaches::ALL, &|name| names.cases.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::entities::ALL, &|name| names.entities.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::fluents::ALL, &|name| names.fluents.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::primitives::ALL, &|name| names.primitives.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::measures::ALL, &|name| names.measures.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::failures::ALL, &|name| names.failures.contains_key(name)), [""; 0]);
        assert_eq!(missing(lang::builtin_failures::ALL, &|name| names.failures.contains_key(name)), [""; 0]);
        let object =
            library.lang_items.object.map(|kind| library.fields_of(kind).cloned().collect::<Vec<_>>());
        let object = object.unwrap_or_default();
        assert_eq!(missing(lang::fields::ALL, &|name| object.iter().any(|field| field == name)), [""; 0]);
    }
}
