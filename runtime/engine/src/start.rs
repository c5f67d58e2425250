//! Knowledge at the beginning of a run: from the graph and from the host.

use crate::belief::{Beliefs, PerceivedFact};
use crate::cleanup::PendingCleanup;
use crate::json;
use crate::query::{Answer, Pattern, Query, Truth};
use crate::time::Time;
use motet_graph::{
    CallNode, Condition, Fact, FactArg, Graph, InitialFact, NodeKind, Term, TextPart, Type, Value,
};
use motet_stdlib::lang::{entities, kinds};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

/// Knowledge of the host at the start of a run. Facts and kinds that the graph does not mention are left out.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartState {
    /// Facts with their truth values, in order: a later one overrides an earlier one, and one with `any`
    /// holds for every entity. Queries that are not facts are ignored.
    #[serde(with = "json::facts")]
    #[schemars(with = "Vec<json::FactRow>")]
    pub facts: Vec<(Query, Truth)>,
    /// Facts with `any` that hold for some entity, which one is not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub some: Vec<Query>,
    /// Of the facts that hold or do not hold, those that last only so long.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lasting: Vec<PerceivedFact>,
    /// Entities with the names of their kinds. Effects that quantify over a kind range over these and over
    /// every entity that a graph, a result or an observation names.
    #[serde(with = "json::entities")]
    #[schemars(with = "Vec<json::EntityRow>")]
    pub entities: Vec<(SmolStr, SmolStr)>,
    /// Values for bindings that the graph is to be given; others are ignored.
    #[serde(default, skip_serializing_if = "Vec::is_empty", with = "json::bindings")]
    #[schemars(with = "Vec<json::BindingRow>")]
    pub bindings: Vec<(SmolStr, Value)>,
    /// Cleanups of earlier policies that have not run to their end.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pending: Vec<PendingCleanup>,
}

/// First what the compiler was told, then what the host knows.
pub(crate) fn believe(graph: &Graph, start: &StartState) -> Beliefs {
    let mut beliefs = Beliefs::new(graph);
    let mut ears = EntityCollector { graph, beliefs: &mut beliefs };
    // Those that always exist.
    for (id, kind) in
        [(entities::ROBOT, kinds::ENTITY), (entities::USER, kinds::PERSON), (entities::START, kinds::PLACE)]
    {
        ears.hear(&SmolStr::new_static(id), kind);
    }
    start.entities.iter().for_each(|(id, kind)| ears.hear(id, kind));
    ears.graph();
    for InitialFact { fact, value } in &graph.initial {
        let args = fact.args.iter().map(|arg| match arg {
            FactArg::Term(Term::Literal(value)) => Some(Pattern::Is(value.clone())),
            FactArg::Any => Some(Pattern::Any),
            FactArg::Term(_) => None,
        });
        let fluent = graph.fluents.get(fact.fluent.index());
        if let (Some(args), Some(fluent)) = (args.collect::<Option<Vec<_>>>(), fluent) {
            beliefs.tell(&fluent.name, args, Truth::from(*value));
        }
    }
    for (query, value) in &start.facts {
        if let Query::Fact { fluent, args } = query
            && beliefs.fluents.contains_key(fluent)
        {
            beliefs.tell(fluent, args.clone(), *value);
        }
    }
    for query in &start.some {
        if let Query::Fact { fluent, .. } = query
            && beliefs.fluents.contains_key(fluent)
        {
            let cell = beliefs.intern(query.clone());
            beliefs.observe(cell, Answer::Truth(true), Time::ZERO);
        }
    }
    let is_known =
        |fact: &Query| matches!(fact, Query::Fact { fluent, .. } if beliefs.fluents.contains_key(fluent));
    let lasting = start.lasting.iter().filter(|lasting| is_known(&lasting.fact)).cloned();
    beliefs.lasting = lasting.collect();
    beliefs.changed.clear();
    beliefs
}

/// Collects the entities that a graph names, with the kinds that their places say.
struct EntityCollector<'a> {
    graph: &'a Graph,
    beliefs: &'a mut Beliefs,
}

impl EntityCollector<'_> {
    fn hear(&mut self, id: &SmolStr, kind: &str) {
        self.beliefs.entities.hear(self.graph, id, Some(kind));
    }

    fn value(&mut self, value: &Value, ty: Option<&Type>) {
        self.beliefs.entities.hear_value(self.graph, value, ty);
    }

    fn graph(&mut self) {
        let graph = self.graph;
        for declared in &graph.entities {
            let kind = graph.kinds.get(declared.kind.index());
            self.beliefs.entities.hear(graph, &declared.entity, kind.map(|kind| kind.name.as_str()));
        }
        graph.initial.iter().for_each(|initial| self.fact(&initial.fact));
        graph.goal.iter().for_each(|part| self.condition(part));
        for node in &graph.nodes {
            match &node.kind {
                NodeKind::Call(call) => self.call(call),
                NodeKind::If { condition, .. } | NodeKind::Wait { condition, .. } => {
                    self.condition(condition)
                }
                NodeKind::Repeat { until, .. } => until.iter().for_each(|until| self.condition(until)),
                NodeKind::Monitor { watches, .. } => {
                    watches.iter().for_each(|watch| self.condition(&watch.condition))
                }
                NodeKind::Each { list, item, .. } => {
                    let ty = graph
                        .bindings
                        .get(item.index())
                        .map(|binding| Type::List(Box::new(binding.ty.clone())));
                    self.term(list, ty.as_ref());
                }
                NodeKind::Let { binding, value } => {
                    self.term(value, graph.bindings.get(binding.index()).map(|binding| &binding.ty));
                }
                NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::Try { .. } => {}
                NodeKind::Delay { .. } | NodeKind::Finally { .. } => {}
                NodeKind::Parallel { .. } | NodeKind::End { .. } => {}
            }
        }
    }

    fn call(&mut self, call: &CallNode) {
        let primitive = self.graph.primitives.get(call.primitive.index());
        let params = primitive.map_or(&[][..], |primitive| &primitive.params);
        for (arg, param) in call.args.iter().zip(params) {
            self.term(arg, Some(&param.ty));
        }
        for need in &call.needs {
            need.when.iter().for_each(|when| self.condition(when));
            self.condition(&need.condition);
        }
        for effect in &call.effects {
            effect.when.iter().for_each(|when| self.condition(when));
            self.fact(&effect.fact);
        }
        for unsettled in &call.unsettles {
            unsettled.when.iter().for_each(|when| self.condition(when));
            self.fact(&unsettled.fact);
        }
    }

    fn fact(&mut self, fact: &Fact) {
        let params = self.graph.fluents.get(fact.fluent.index()).map_or(&[][..], |fluent| &fluent.params);
        for (arg, ty) in fact.args.iter().zip(params) {
            if let FactArg::Term(term) = arg {
                self.term(term, Some(ty));
            }
        }
    }

    fn condition(&mut self, condition: &Condition) {
        match condition {
            Condition::Literal(_) => {}
            Condition::Fact(fact) => self.fact(fact),
            Condition::Compare(_, left, right) => {
                self.term(left, None);
                self.term(right, None);
            }
            Condition::Not(inner) => self.condition(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.iter().for_each(|part| self.condition(part))
            }
        }
    }

    fn term(&mut self, term: &Term, ty: Option<&Type>) {
        match term {
            Term::Literal(value) => self.value(value, ty),
            Term::Binding(_) | Term::Each => {}
            Term::Field(of, _) => self.term(of, None),
            Term::Measure(id, args) => {
                let params = self.graph.measures.get(id.index()).map_or(&[][..], |measure| &measure.params);
                args.iter().zip(params).for_each(|(arg, ty)| self.term(arg, Some(ty)));
            }
            Term::List(items) => {
                let inner = if let Some(Type::List(inner)) = ty { Some(&**inner) } else { None };
                items.iter().for_each(|item| self.term(item, inner));
            }
            Term::Count(list) => self.term(list, None),
            Term::First(list) => {
                self.term(list, ty.map(|ty| Type::List(Box::new(ty.clone()))).as_ref());
            }
            Term::Template(parts) => {
                for part in parts {
                    if let TextPart::Value(value, ty) = part {
                        self.term(value, Some(ty));
                    }
                }
            }
            Term::Arith(_, left, right) => {
                self.term(left, None);
                self.term(right, None);
            }
        }
    }
}

/// Time limits and budgets of the engine.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EngineSettings {
    /// Time limit for the answer to a cancel; after it the engine asks for a safe stop.
    pub cancel_within: Time,
    /// Time limit for the answer to a safe stop; after it the run ends with [`crate::Fault::NotStopped`].
    pub safe_stop_within: Time,
    /// The least time for which a watched condition may be unknown before its monitor fires.
    pub unknown_for: Time,
    /// Time limit for the verdict on a deferred motion; after it the step starts without one. `None` without
    /// a verifier: the driver then decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verify_within: Option<Time>,
    /// The most transitions at one instant.
    pub step_budget: u32,
}

impl Default for EngineSettings {
    /// 5 s for a cancel, 5 s for a safe stop, 0.5 s unknown, nobody who verifies, 10,000,000 transitions.
    fn default() -> Self {
        Self {
            cancel_within: Time::from_nanos(5_000_000_000),
            safe_stop_within: Time::from_nanos(5_000_000_000),
            unknown_for: Time::from_nanos(500_000_000),
            verify_within: None,
            step_budget: 10_000_000,
        }
    }
}
