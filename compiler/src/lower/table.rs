//! The graph's tables: only what the policy speaks of, in the order in which it does.

use motet_graph as graph;
use rustc_hash::FxHashMap;
use smol_str::{SmolStr, format_smolstr};

use crate::ir::{Base, Condition, Failure, Fluent, Measure, Primitive, Program, Ty};
use crate::library::Library;
use crate::world::World;

/// Which failure a guard ends in, by the fluent or field that it asks about.
const GUARDS: &[(&str, &str)] = &[
    ("reachable", "unreachable"),
    ("at", "unreachable"),
    ("near", "unreachable"),
    ("visible", "not_found"),
    ("located", "not_found"),
    ("clear", "blocked"),
    ("open", "blocked"),
    ("locked", "blocked"),
    ("mass", "too_heavy"),
    ("width", "unreachable"),
];

pub(super) struct Tables<'a> {
    pub(super) library: &'a Library,
    pub(super) world: &'a World,
    pub(super) fluents: Vec<graph::Fluent>,
    pub(super) measures: Vec<graph::Measure>,
    pub(super) primitives: Vec<graph::Primitive>,
    pub(super) failures: Vec<SmolStr>,
    pub(super) resources: Vec<graph::Resource>,
    pub(super) bindings: Vec<graph::Binding>,
    fluent_ids: FxHashMap<Fluent, graph::FluentId>,
    measure_ids: FxHashMap<Measure, graph::MeasureId>,
    primitive_ids: FxHashMap<Primitive, graph::PrimitiveId>,
    failure_ids: FxHashMap<Failure, graph::FailureId>,
}

fn next<T>(table: &[T]) -> u32 {
    u32::try_from(table.len()).unwrap_or(u32::MAX)
}

impl<'a> Tables<'a> {
    pub(super) fn new(program: &Program, library: &'a Library, world: &'a World) -> Self {
        let mut tables = Self {
            library,
            world,
            fluents: Vec::new(),
            measures: Vec::new(),
            primitives: Vec::new(),
            failures: Vec::new(),
            resources: Vec::new(),
            bindings: Vec::new(),
            fluent_ids: FxHashMap::default(),
            measure_ids: FxHashMap::default(),
            primitive_ids: FxHashMap::default(),
            failure_ids: FxHashMap::default(),
        };
        tables.failure(crate::ir::TIMEOUT);
        tables.bind(program);
        // All of the robot's resources, so that what contains what can be said by index.
        for def in &library.resources {
            let contains = (0..library.resources.len()).filter(|index| def.closure & (1 << index) != 0);
            let contains =
                contains.filter(|index| library.resources.get(*index).is_some_and(|it| it.name != def.name));
            let contains =
                contains.filter_map(|index| u32::try_from(index).ok()).map(graph::ResourceId).collect();
            tables.resources.push(graph::Resource { name: def.name.clone(), contains });
        }
        tables
    }

    /// Bindings with names that are unique: inlining a policy twice repeats those inside it.
    fn bind(&mut self, program: &Program) {
        let mut seen: FxHashMap<&SmolStr, u32> = FxHashMap::default();
        for binding in &program.bindings {
            let count = seen.entry(&binding.name).or_insert(0);
            *count += 1;
            let name = match (binding.name.as_str(), *count) {
                ("_", _) | (_, 1) => binding.name.clone(),
                (name, count) => format_smolstr!("{name}'{count}"),
            };
            let ty = self.ty(binding.ty);
            self.bindings.push(graph::Binding { name, ty, given: false });
        }
    }

    /// All kinds of the library, in its order: parents before children.
    pub(super) fn kinds(&self) -> Vec<graph::Kind> {
        let kinds = self.library.kinds.iter();
        let parent =
            |def: &crate::library::model::KindDef| def.parent.map(|kind| graph::KindId(u32::from(kind.0)));
        kinds.map(|def| graph::Kind { name: def.name.clone(), parent: parent(def) }).collect()
    }

    pub(super) fn ty(&self, ty: Ty) -> graph::Type {
        let base = match ty.base {
            Base::Bool => graph::Type::Bool,
            Base::Int => graph::Type::Int,
            Base::Number | Base::Unknown => graph::Type::Number,
            Base::Quantity(dimension) => {
                dimension.type_name().map_or(graph::Type::Number, |name| graph::Type::Quantity(name.into()))
            }
            Base::Text => graph::Type::Text,
            Base::Pose => graph::Type::Pose,
            Base::Entity(kind) => graph::Type::Entity(graph::KindId(u32::from(kind.0))),
            Base::Enum(id) => graph::Type::Case(
                self.library.enums.get(id.index()).map(|def| def.name.clone()).unwrap_or_default(),
            ),
        };
        (0..ty.lists).fold(base, |inner, _| graph::Type::List(Box::new(inner)))
    }

    pub(super) fn fluent(&mut self, id: Fluent) -> graph::FluentId {
        if let Some(known) = self.fluent_ids.get(&id) {
            return *known;
        }
        let new = graph::FluentId(next(&self.fluents));
        self.fluent_ids.insert(id, new);
        if let Some(def) = self.library.fluent(id) {
            let params = def.params.iter().map(|(_, ty)| self.ty(*ty)).collect();
            self.fluents.push(graph::Fluent { name: def.name.clone(), params, observable: def.observable });
        }
        new
    }

    pub(super) fn measure(&mut self, id: Measure) -> graph::MeasureId {
        if let Some(known) = self.measure_ids.get(&id) {
            return *known;
        }
        let new = graph::MeasureId(next(&self.measures));
        self.measure_ids.insert(id, new);
        if let Some(def) = self.library.measure(id) {
            let params = def.params.iter().map(|(_, ty)| self.ty(*ty)).collect();
            self.measures.push(graph::Measure {
                name: def.name.clone(),
                params,
                result: self.ty(def.result),
            });
        }
        new
    }

    pub(super) fn failure(&mut self, id: Failure) -> graph::FailureId {
        if let Some(known) = self.failure_ids.get(&id) {
            return *known;
        }
        let new = graph::FailureId(next(&self.failures));
        self.failure_ids.insert(id, new);
        self.failures.push(self.library.failure_name(id).into());
        new
    }

    pub(super) fn primitive(&mut self, id: Primitive) -> graph::PrimitiveId {
        if let Some(known) = self.primitive_ids.get(&id) {
            return *known;
        }
        let new = graph::PrimitiveId(next(&self.primitives));
        self.primitive_ids.insert(id, new);
        if let Some(def) = self.library.primitive(id) {
            let params = def
                .params
                .iter()
                .map(|param| graph::Param { name: param.name.clone(), ty: self.ty(param.ty) });
            let params = params.collect();
            let fails = def.fails.iter().map(|kind| self.failure(*kind)).collect();
            self.primitives.push(graph::Primitive {
                name: def.name.clone(),
                params,
                result: def.result.map(|ty| self.ty(ty)),
                perceives: def.form == motet_syntax::ast::PrimitiveKind::Perception,
                uses: def.uses_named.iter().map(|index| graph::ResourceId(u32::from(*index))).collect(),
                fails,
            });
        }
        new
    }

    /// The failure of a refuted guard: what the need is about, where the primitive can fail so, else `failed`.
    pub(super) fn guard_failure(&mut self, condition: &Condition, fails: &[Failure]) -> graph::FailureId {
        let about = self.about(condition);
        let named =
            GUARDS.iter().find(|(word, _)| Some(*word) == about.as_deref()).map(|(_, failure)| *failure);
        let names = &self.library.names.failures;
        let kind = named.and_then(|name| names.get(name)).filter(|kind| fails.contains(kind));
        let kind = kind.or_else(|| names.get("failed")).copied();
        self.failure(kind.unwrap_or(crate::ir::TIMEOUT))
    }

    fn about(&self, condition: &Condition) -> Option<SmolStr> {
        match condition {
            Condition::Fact(fact) => self.library.fluent(fact.fluent).map(|def| def.name.clone()),
            Condition::Compare(_, crate::ir::Term::Field(_, name), _) => Some(name.clone()),
            Condition::Not(inner) => self.about(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.first().and_then(|part| self.about(part))
            }
            Condition::Compare(..)
            | Condition::Literal(_)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => None,
        }
    }
}
