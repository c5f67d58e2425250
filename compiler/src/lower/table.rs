//! Tables of the graph: only names that the policy uses, in the order of use.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use motet_geometry::kinematics::planar;
use motet_geometry::planning::components;
use motet_graph as graph;
use motet_syntax::ast::{ArithOp, CompareOp};
use rustc_hash::FxHashMap;
use smol_str::{SmolStr, format_smolstr};

use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::{
    Base, BlockSlot, Condition, Fact, Failure, Fluent, Measure, Primitive, Program, StepId, Term, Ty,
};
use crate::prove::symbols::described;

pub(super) struct Tables<'a> {
    pub(super) library: &'a Library,
    pub(super) environment: &'a Environment,
    pub(super) fluents: Vec<graph::Fluent>,
    pub(super) measures: Vec<graph::Measure>,
    pub(super) primitives: Vec<graph::Primitive>,
    pub(super) failures: Vec<SmolStr>,
    pub(super) resources: Vec<graph::Resource>,
    pub(super) bindings: Vec<graph::Binding>,
    /// What people call the entities that a text may name, by id.
    pub(super) names: BTreeMap<SmolStr, SmolStr>,
    fluent_ids: FxHashMap<Fluent, graph::FluentId>,
    measure_ids: FxHashMap<Measure, graph::MeasureId>,
    primitive_ids: FxHashMap<Primitive, graph::PrimitiveId>,
    failure_ids: FxHashMap<Failure, graph::FailureId>,
}

fn next<T>(table: &[T]) -> u32 {
    u32::try_from(table.len()).unwrap_or(u32::MAX)
}

impl<'a> Tables<'a> {
    pub(super) fn new(program: &Program, library: &'a Library, environment: &'a Environment) -> Self {
        let mut tables = Self {
            library,
            environment,
            fluents: Vec::new(),
            measures: Vec::new(),
            primitives: Vec::new(),
            failures: Vec::new(),
            resources: Vec::new(),
            bindings: Vec::new(),
            names: BTreeMap::new(),
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

    /// Adds the bindings with unique names: inlining a policy twice repeats its names.
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
            let found = described(binding, self.library, self.environment).unwrap_or_default();
            let among =
                found.into_iter().filter_map(|entity| self.environment.entities().name(entity).cloned());
            self.bindings.push(graph::Binding { name, ty, given: false, among: among.collect() });
        }
    }

    /// All kinds of the library in its order, parents before children.
    pub(super) fn kinds(&self) -> Vec<graph::Kind> {
        let kinds = self.library.kinds.iter();
        let parent =
            |def: &crate::declare::library::KindDef| def.parent.map(|kind| graph::KindId(u32::from(kind.0)));
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
            // Of a failure the text is written.
            Base::Text | Base::Failure => graph::Type::Text,
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
            let params = def.params.iter().map(|param| {
                let default = param.default.as_ref().and_then(|default| self.default(default));
                graph::Param { name: param.name.clone(), ty: self.ty(param.ty), default }
            });
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

    /// Failure of a refuted guard: from the fluent or field of the need if the primitive lists it, else
    /// `failed`.
    pub(super) fn guard_failure(&mut self, condition: &Condition, fails: &[Failure]) -> graph::FailureId {
        let kind = self.library.lang_items.need_failure(condition, fails);
        self.failure(kind.unwrap_or(crate::ir::TIMEOUT))
    }
}

impl Tables<'_> {
    /// Default argument of a parameter: a constant, or an earlier parameter.
    fn default(&mut self, default: &Term) -> Option<graph::ParamDefault> {
        if let Term::Param(earlier) = default {
            return Some(graph::ParamDefault::Param(u32::from(*earlier)));
        }
        match self.term(default, &[], None) {
            graph::Term::Literal(value) => Some(graph::ParamDefault::Value(value)),
            _ => None,
        }
    }

    pub(super) fn term(
        &mut self,
        term: &Term,
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> graph::Term {
        use graph::Value;
        let literal = graph::Term::Literal;
        match term {
            Term::Bool(value) => literal(Value::Bool(*value)),
            Term::Int(value) => literal(Value::Int(*value)),
            Term::Number(value) => literal(Value::Number(*value)),
            Term::Text(text) => literal(Value::Text(text.clone())),
            Term::Pose { xyz, yaw } => {
                let (_, quaternion) = components(&planar(0.0, 0.0, *yaw));
                literal(Value::Pose(graph::Pose { xyz: *xyz, quaternion }))
            }
            Term::Case(id, case) => literal(Value::Case(self.library.case_name(*id, *case).into())),
            Term::Entity(entity) => literal(Value::Entity(self.environment.name(*entity))),
            Term::List(items) => self.list(items, args, result),
            Term::Binding(id) | Term::Caught(_, id) => graph::Term::Binding(graph::BindingId(id.0)),
            Term::Param(index) => match args.get(usize::from(*index)) {
                // An argument is never itself a parameter, so this ends.
                Some(Term::Param(_)) | None => literal(Value::Bool(false)),
                Some(arg) => self.term(arg, &[], None),
            },
            Term::Result => result.map_or(literal(Value::Bool(false)), graph::Term::Binding),
            Term::Each => graph::Term::Each,
            Term::Field(of, name) => graph::Term::Field(Box::new(self.term(of, args, result)), name.clone()),
            Term::Measure(id, inner) => {
                let inner = inner.iter().map(|arg| self.term(arg, args, result)).collect();
                graph::Term::Measure(self.measure(*id), inner)
            }
            Term::Arith(op, left, right) => {
                let op = match op {
                    ArithOp::Add => graph::Arithmetic::Add,
                    ArithOp::Subtract => graph::Arithmetic::Subtract,
                    ArithOp::Multiply => graph::Arithmetic::Multiply,
                    ArithOp::Divide => graph::Arithmetic::Divide,
                };
                let (left, right) = (self.term(left, args, result), self.term(right, args, result));
                graph::Term::Arith(op, Box::new(left), Box::new(right))
            }
            Term::Count(list) => graph::Term::Count(Box::new(self.term(list, args, result))),
            Term::First(list) => {
                let list = self.term(list, args, result);
                let first = if let graph::Term::List(items) = &list {
                    items.first().cloned()
                } else if let graph::Term::Literal(graph::Value::List(items)) = &list {
                    items.first().cloned().map(graph::Term::Literal)
                } else {
                    None
                };
                first.unwrap_or_else(|| graph::Term::First(Box::new(list)))
            }
            Term::Template(parts) => {
                let parts = parts.iter().map(|part| self.part(part, args, result));
                graph::Term::Template(parts.collect())
            }
            // Only after an error, and what has errors is not lowered.
            Term::Unknown => literal(Value::Bool(false)),
        }
    }

    /// Lowers a part of a text.
    fn part(
        &mut self,
        (part, ty): &(Term, Ty),
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> graph::TextPart {
        if let Term::Text(text) = part {
            return graph::TextPart::Literal(text.clone());
        }
        self.name_entities(part, *ty);
        let ty = self.ty(*ty);
        graph::TextPart::Value(self.term(part, args, result), ty)
    }

    /// Notes what people call the entities that a part of a text may be.
    fn name_entities(&mut self, part: &Term, ty: Ty) {
        let (Base::Entity(kind), Some(scene)) = (ty.base, self.environment.scene()) else { return };
        let is_asked = |thing: &motet_robots::scene::Entity| match part {
            Term::Entity(only) => self.environment.name(*only) == thing.id,
            _ => {
                let found = self.environment.entities().find(&thing.id);
                found.is_some_and(|(_, of)| self.library.is_kind(of, kind) || self.library.is_kind(kind, of))
            }
        };
        for thing in scene.entities.values().filter(|thing| is_asked(thing)) {
            if let Some(name) = thing.names.first() {
                self.names.insert(thing.id.clone(), name.clone());
            }
        }
    }

    /// Lowers a list: to a literal if all items are, else to a list that the engine evaluates.
    fn list(&mut self, items: &[Term], args: &[Term], result: Option<graph::BindingId>) -> graph::Term {
        let terms: Vec<_> = items.iter().map(|item| self.term(item, args, result)).collect();
        let values: Option<Vec<_>> = terms
            .iter()
            .map(|term| match term {
                graph::Term::Literal(value) => Some(value.clone()),
                _ => None,
            })
            .collect();
        values.map_or(graph::Term::List(terms), |values| graph::Term::Literal(graph::Value::List(values)))
    }

    pub(super) fn condition(
        &mut self,
        condition: &Condition,
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> graph::Condition {
        match condition {
            Condition::Literal(value) => graph::Condition::Literal(*value),
            Condition::Fact(fact) => match self.fact(fact, args, result) {
                Some(fact) => graph::Condition::Fact(fact),
                None => graph::Condition::Literal(false),
            },
            Condition::Compare(op, left, right) => {
                let op = match op {
                    CompareOp::Equal => graph::Comparison::Equal,
                    CompareOp::Unequal => graph::Comparison::Unequal,
                    CompareOp::Less => graph::Comparison::Less,
                    CompareOp::AtMost => graph::Comparison::AtMost,
                    CompareOp::More => graph::Comparison::More,
                    CompareOp::AtLeast => graph::Comparison::AtLeast,
                };
                graph::Condition::Compare(op, self.term(left, args, result), self.term(right, args, result))
            }
            // Decided by the prover from the monitors around the step: in a graph it holds.
            Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) | Condition::Unknown => {
                graph::Condition::Literal(true)
            }
            Condition::Not(inner) => graph::Condition::Not(Box::new(self.condition(inner, args, result))),
            Condition::All(parts) => {
                graph::Condition::All(parts.iter().map(|part| self.condition(part, args, result)).collect())
            }
            Condition::AnyOf(parts) => {
                graph::Condition::AnyOf(parts.iter().map(|part| self.condition(part, args, result)).collect())
            }
        }
    }

    pub(super) fn fact(
        &mut self,
        fact: &Fact,
        args: &[Term],
        result: Option<graph::BindingId>,
    ) -> Option<graph::Fact> {
        let fluent = self.fluent(fact.fluent);
        let terms = fact.args.iter().map(|arg| match arg {
            None => graph::FactArg::Any,
            Some(term) => graph::FactArg::Term(self.term(term, args, result)),
        });
        let args: Vec<_> = terms.collect();
        let whole = fact.args.iter().all(|arg| *arg != Some(Term::Unknown));
        whole.then_some(graph::Fact { fluent, args })
    }
}

/// Path of a step: `/steps/2/try/0`; in an inlined policy the path of the call, `:`, and the path in that
/// policy.
pub(crate) fn pointer(program: &Program, step: StepId) -> SmolStr {
    let mut places = Vec::new();
    let mut at = Some(step);
    while let Some(place) = at.and_then(|id| program.step(id)).map(|step| step.position) {
        places.push(place);
        at = place.parent;
    }
    let mut path = String::with_capacity(places.len() * 10);
    for place in places.iter().rev() {
        let index = place.index;
        // Writing to a string cannot fail.
        let _ = match place.slot {
            BlockSlot::Steps | BlockSlot::Timed => write!(path, "/steps/{index}"),
            BlockSlot::Then => write!(path, "/then/{index}"),
            BlockSlot::Else => write!(path, "/else/{index}"),
            BlockSlot::Try => write!(path, "/try/{index}"),
            BlockSlot::Catch(handler) => write!(path, "/catch/{handler}/steps/{index}"),
            BlockSlot::During => write!(path, "/during/{index}"),
            BlockSlot::Reaction(watch) => write!(path, "/monitor/{watch}/then/steps/{index}"),
            BlockSlot::Branch(branch) => write!(path, "/parallel/{branch}/{index}"),
            BlockSlot::Inlined => write!(path, ":/steps/{index}"),
            BlockSlot::Kept => write!(path, "/steps/{index}"),
            BlockSlot::Protected | BlockSlot::KeptWhole => Ok(()),
            BlockSlot::InlinedWhole => write!(path, ":"),
            BlockSlot::Finally => write!(path, "/finally/{index}"),
        };
    }
    path.into()
}
