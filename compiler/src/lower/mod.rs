//! Stage 5, lowering: from a proved program to an execution graph. Proven needs are noted, deferred needs
//! become guards.
//!
//! Guarded by the graph snapshots of `tests/tests` and the validation in `motet_graph`.

mod deferred_notes;
mod inspection;
mod table;

use motet_graph as graph;
use motet_graph::{NodeId, NodeKind, RegionId};
use motet_stdlib::lang;
use motet_syntax::ast::EndKind;
use rustc_hash::FxHashSet;
use smol_str::SmolStr;

pub(crate) use self::deferred_notes::deferred_notes;
pub(crate) use self::inspection::inspect;
pub use self::inspection::{CallInspection, MotionInspection, StepInspection};
use self::table::Tables;
use crate::declare::{EffectDef, Library, NeedDef, PrimitiveDef};
use crate::environment::Environment;
use crate::feasibility::{MotionVerdict, MotionVerdicts};
use crate::ir::{Block, Call, Condition, MotionKind, Program, Reaction, StepId, StepKind, Term};
use crate::limits::bounds_of;
use crate::prove::{NeedVerdict, Proof};

/// Lowers a program that has no errors.
pub(crate) fn lower(
    program: &Program,
    proof: &Proof,
    placed: MotionVerdicts,
    library: &Library,
    environment: &Environment,
) -> graph::Graph {
    let mut lowering = Lowering {
        program,
        proof,
        placed,
        library,
        tables: Tables::new(program, library, environment),
        nodes: Vec::with_capacity(program.steps.len()),
        regions: Vec::new(),
        ids: vec![None; program.steps.len()],
    };
    lowering.region(&program.body, None);
    // What is said of many things, or follows from the pose of the base, is told only where a condition looks
    // at it: a driver that does not know it, or a policy that takes over when it holds no longer, would else
    // contradict the proof. Where it names a thing, only tests count: a graph does not grow with the room.
    let tests = SeenFacts::of_tests(&lowering.nodes);
    let seen = SeenFacts::of_calls(&lowering.nodes, tests.clone());
    let given = environment.given.iter().map(|(fact, value)| (fact, *value, fact.args.contains(&None)));
    let of_pose = environment.base_pose_facts.facts().map(|(fact, value)| (fact, value, true));
    let initial = given.chain(of_pose).filter_map(|(known, value, is_wide)| {
        let fact = lowering.tables.fact(known, &[], None)?;
        let seen = if known.args.iter().all(Option::is_none) { &seen } else { &tests };
        let is_told = !is_wide || (seen.meet(&fact) && !environment.leaves_open(known));
        is_told.then_some(graph::InitialFact { fact, value })
    });
    let given: Vec<_> = initial.collect();
    let goal = lowering.goal();
    let sentences = lowering.sentences();
    let steps = proof.drops.iter().filter_map(|(step, _)| *lowering.ids.get(step.index())?);
    let mut hands: Vec<_> = steps.collect();
    hands.sort_unstable();
    hands.dedup();
    let Lowering { nodes, regions, tables, .. } = lowering;
    // In a closed world nothing holds but what is given: the engine has to know it as the proof does.
    let closed = tables.fluents.iter().zip(0..).filter(|_| library.closed_world).map(|(fluent, index)| {
        let args = vec![graph::FactArg::Any; fluent.params.len()];
        graph::InitialFact { fact: graph::Fact { fluent: graph::FluentId(index), args }, value: false }
    });
    let initial = closed.chain(given).collect();
    let (least_secs, greatest_secs) = bounds_of(&program.body, program);
    graph::Graph {
        policy: program.name.clone(),
        robot: program.robot.clone(),
        kinds: tables.kinds(),
        fluents: tables.fluents,
        measures: tables.measures,
        primitives: tables.primitives,
        failures: tables.failures,
        resources: tables.resources,
        bindings: tables.bindings,
        entities: declared_entities(&nodes, library),
        names: tables.names.into_iter().map(|(entity, name)| graph::EntityName { entity, name }).collect(),
        sentences,
        result: program.result.map(|id| graph::BindingId(id.0)),
        goal,
        hands,
        nodes,
        regions,
        initial,
        observe_within_secs: library.observe_within_secs,
        duration: graph::DurationBounds { least_secs, greatest_secs },
    }
}

/// Entities of the documents, if a call is about each entity of a kind.
fn declared_entities(nodes: &[graph::Node], library: &Library) -> Vec<graph::DeclaredEntity> {
    let quantifies = |node: &graph::Node| match &node.kind {
        graph::NodeKind::Call(call) => {
            call.needs.iter().any(|need| need.each.is_some())
                || call.effects.iter().any(|effect| effect.each.is_some())
                || call.unsettles.iter().any(|effect| effect.each.is_some())
        }
        _ => false,
    };
    if !nodes.iter().any(quantifies) {
        return Vec::new();
    }
    let declared = library.entities.iter().map(|(name, kind, _)| graph::DeclaredEntity {
        entity: name.clone(),
        kind: graph::KindId(u32::from(kind.0)),
    });
    declared.collect()
}

/// Returns whether a step or a step in it binds a name. The nesting of steps bounds the recursion.
fn binds(program: &Program, step: StepId) -> bool {
    let Some(step) = program.step(step) else { return false };
    match &step.kind {
        StepKind::Call(call) => {
            let binding = call.binds.and_then(|id| program.bindings.get(id.index()));
            binding.is_some_and(|binding| binding.name != "_")
        }
        StepKind::Let { .. } => true,
        kind => kind.blocks().into_iter().flatten().any(|step| binds(program, *step)),
    }
}

/// Returns whether the robot can observe all that a condition is about.
fn is_observable(condition: &Condition, library: &Library) -> bool {
    let is_hidden = |part: &Condition| match part {
        Condition::Fact(fact) => library.fluent(fact.fluent).is_none_or(|def| def.derived || !def.observable),
        Condition::Literal(_) | Condition::Compare(..) | Condition::Not(_) => false,
        Condition::All(_) | Condition::AnyOf(_) => false,
        Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) | Condition::Unknown => true,
    };
    let is_hidden_term = |term: &Term| match term {
        Term::Measure(id, _) => library.measure(*id).is_none_or(|def| !def.observable),
        _ => false,
    };
    !condition.any(&is_hidden) && !condition.any_term(&is_hidden_term)
}

/// The facts that conditions look at: for each argument of each fluent the values, or `None` for any. An
/// argument behind the last stands for the fluent.
#[derive(Clone, Default)]
struct SeenFacts(FxHashSet<(graph::FluentId, usize, Option<SmolStr>)>);

impl SeenFacts {
    /// Facts at which `if`, `wait`, `repeat until` and monitors look.
    fn of_tests(nodes: &[graph::Node]) -> Self {
        let mut seen = Self::default();
        for node in nodes {
            match &node.kind {
                NodeKind::If { condition, .. } | NodeKind::Wait { condition, .. } => seen.add(condition),
                NodeKind::Repeat { until: Some(condition), .. } => seen.add(condition),
                NodeKind::Monitor { watches, .. } => watches.iter().for_each(|it| seen.add(&it.condition)),
                _ => {}
            }
        }
        seen
    }

    /// Facts at which needs and effects look, beside some.
    fn of_calls(nodes: &[graph::Node], mut seen: Self) -> Self {
        for node in nodes {
            let NodeKind::Call(call) = &node.kind else { continue };
            call.needs.iter().for_each(|need| seen.add(&need.condition));
            let whens = call.needs.iter().filter_map(|need| need.when.as_ref());
            let whens = whens.chain(call.effects.iter().filter_map(|made| made.when.as_ref()));
            whens.for_each(|when| seen.add(when));
        }
        seen
    }

    fn add(&mut self, condition: &graph::Condition) {
        match condition {
            graph::Condition::Fact(fact) => {
                self.0.insert((fact.fluent, fact.args.len(), None));
                self.0.extend(fact.args.iter().zip(0..).map(|(arg, place)| (fact.fluent, place, named(arg))));
            }
            graph::Condition::Not(inner) => self.add(inner),
            graph::Condition::All(parts) | graph::Condition::AnyOf(parts) => {
                parts.iter().for_each(|part| self.add(part));
            }
            graph::Condition::Literal(_) | graph::Condition::Compare(..) => {}
        }
    }

    /// Some condition may look at a fact.
    fn meet(&self, fact: &graph::Fact) -> bool {
        let has = |place: usize, arg: Option<SmolStr>| self.0.contains(&(fact.fluent, place, arg));
        fact.args.iter().zip(0..).all(|(arg, place)| match named(arg) {
            None => has(fact.args.len(), None),
            own => has(place, None) || has(place, own),
        })
    }
}

/// The entity or case of an argument.
fn named(arg: &graph::FactArg) -> Option<SmolStr> {
    match arg {
        graph::FactArg::Term(graph::Term::Literal(graph::Value::Entity(name) | graph::Value::Case(name))) => {
            Some(name.clone())
        }
        _ => None,
    }
}

struct Lowering<'a> {
    program: &'a Program,
    proof: &'a Proof,
    placed: MotionVerdicts,
    library: &'a Library,
    tables: Tables<'a>,
    nodes: Vec<graph::Node>,
    regions: Vec<graph::Region>,
    /// Node of each step; `None` for a step that is never reached.
    ids: Vec<Option<NodeId>>,
}

impl Lowering<'_> {
    /// Lowers a block to a region: its reachable steps in a chain.
    fn region(&mut self, block: &Block, owner: Option<NodeId>) -> RegionId {
        let id = RegionId(u32::try_from(self.regions.len()).unwrap_or(u32::MAX));
        self.regions.push(graph::Region { owner, entry: None });
        let is_reached = |step: &&StepId| self.proof.reached.get(step.index()).copied().unwrap_or(false);
        let (reached, rest) = block.split_at(block.iter().take_while(is_reached).count());
        let mut chain = Vec::with_capacity(reached.len());
        for step in reached {
            chain.extend(self.node(*step, id));
        }
        chain.extend(self.refusal(rest, id));
        if let Some(region) = self.regions.get_mut(id.index()) {
            region.entry = chain.first().copied();
        }
        for (before, next) in chain.iter().zip(chain.iter().skip(1)) {
            if let Some(before) = self.nodes.get_mut(before.index()) {
                before.next = Some(*next);
            }
        }
        id
    }

    /// Ends the policy in place of steps that are never reached, if they bind names: should a run come here
    /// against all that was proven, it must not go on without them.
    fn refusal(&mut self, steps: &[StepId], region: RegionId) -> Option<NodeId> {
        let (first, program) = (*steps.first()?, self.program);
        if !steps.iter().any(|step| binds(program, *step)) {
            return None;
        }
        let why = Term::Text("this step was proven never to be reached".into());
        let (how, of, why) = self.ending(EndKind::Fail, None, Some(&why));
        let id = NodeId(u32::try_from(self.nodes.len()).ok()?);
        self.nodes.push(graph::Node {
            path: table::pointer(program, first),
            region,
            next: None,
            duration: graph::DurationBounds { least_secs: 0.0, greatest_secs: 0.0 },
            kind: graph::NodeKind::End { how, of, why },
        });
        Some(id)
    }

    /// The parts of the goal that the robot can observe.
    fn goal(&mut self) -> Vec<graph::Condition> {
        let Some((goal, _)) = &self.program.achieves else { return Vec::new() };
        let library = self.library;
        let parts = goal.conjuncts().into_iter().filter(|part| is_observable(part, library));
        parts.map(|part| self.tables.condition(part, &[], None)).collect()
    }

    /// Sentences for the failures of the graph, if a handler names its failure.
    fn sentences(&mut self) -> Vec<graph::FailureSentence> {
        let names = |handler: &graph::Handler| handler.binds.is_some();
        let is_asked = self.nodes.iter().any(|node| match &node.kind {
            graph::NodeKind::Try { handlers, .. } => handlers.iter().any(names),
            _ => false,
        });
        if !is_asked {
            return Vec::new();
        }
        // No part of the graph says that its loops can run out, so nothing else has put it in the table.
        if let Some(exhausted) = self.library.names.failures.get(lang::failures::EXHAUSTED) {
            self.tables.failure(*exhausted);
        }
        let failures = self.tables.failures.iter().zip(0_u32..);
        let sentences = failures.filter_map(|(name, index)| {
            let def = self.library.failures.iter().find(|def| def.name == *name)?;
            Some(graph::FailureSentence { failure: graph::FailureId(index), text: def.text.clone() })
        });
        sentences.collect()
    }

    fn node(&mut self, step: StepId, region: RegionId) -> Option<NodeId> {
        let program = self.program;
        let source = program.step(step)?;
        let id = NodeId(u32::try_from(self.nodes.len()).ok()?);
        *self.ids.get_mut(step.index())? = Some(id);
        let (least_secs, greatest_secs) = source.bounds;
        // The place in the arena is taken first, so that a parent comes before its children.
        self.nodes.push(graph::Node {
            path: table::pointer(program, step),
            region,
            next: None,
            duration: graph::DurationBounds { least_secs, greatest_secs },
            kind: graph::NodeKind::End { how: graph::Ending::Done, of: None, why: None },
        });
        let kind = self.kind(&source.kind, step, id);
        self.nodes.get_mut(id.index())?.kind = kind;
        Some(id)
    }

    fn kind(&mut self, kind: &StepKind, step: StepId, id: NodeId) -> graph::NodeKind {
        let owner = Some(id);
        match kind {
            StepKind::Call(call) => graph::NodeKind::Call(self.call(call, step)),
            StepKind::Let { binding, value } => graph::NodeKind::Let {
                binding: graph::BindingId(binding.0),
                value: self.tables.term(value, &[], None),
            },
            StepKind::Sequence { name, body } => {
                graph::NodeKind::Sequence { name: name.clone(), body: self.region(body, owner) }
            }
            StepKind::Inline { policy, body } => {
                graph::NodeKind::Inline { policy: policy.clone(), body: self.region(body, owner) }
            }
            StepKind::If { condition, then, otherwise, .. } => graph::NodeKind::If {
                condition: self.tables.condition(condition, &[], None),
                then: self.region(then, owner),
                otherwise: otherwise.as_ref().map(|block| self.region(block, owner)),
            },
            StepKind::Wait { condition, within_secs } => graph::NodeKind::Wait {
                condition: self.tables.condition(condition, &[], None),
                within_secs: *within_secs,
            },
            StepKind::Delay { secs } => graph::NodeKind::Delay { secs: *secs },
            StepKind::Finally { body, cleanup } => {
                let body = self.region(body, owner);
                graph::NodeKind::Finally { body, cleanup: self.region(cleanup, owner) }
            }
            StepKind::Monitor { whens, body } => {
                let mut watches = Vec::with_capacity(whens.len());
                for when in whens {
                    watches.push(graph::Watch {
                        condition: self.tables.condition(&when.condition, &[], None),
                        hold_secs: when.hold_secs,
                        reaction: self.reaction(&when.reaction, owner),
                    });
                }
                graph::NodeKind::Monitor { watches, body: self.region(body, owner) }
            }
            StepKind::Try { body, catches } => {
                let body = self.region(body, owner);
                let mut handlers = Vec::with_capacity(catches.len());
                for catch in catches {
                    let on = catch.on.as_ref();
                    let on =
                        on.map(|kinds| kinds.iter().map(|(kind, _)| self.tables.failure(*kind)).collect());
                    let binds = catch.binds.map(|caught| graph::CaughtFailure {
                        kind: graph::BindingId(caught.kind.0),
                        text: graph::BindingId(caught.text.0),
                    });
                    handlers.push(graph::Handler { on, binds, body: self.region(&catch.body, owner) });
                }
                graph::NodeKind::Try { body, handlers }
            }
            StepKind::Repeat { times, body, until } => graph::NodeKind::Repeat {
                times: *times,
                body: self.region(body, owner),
                until: until.as_ref().map(|(condition, _)| self.tables.condition(condition, &[], None)),
            },
            StepKind::Each { item, list, at_most, body } => graph::NodeKind::Each {
                item: graph::BindingId(item.0),
                list: self.tables.term(list, &[], None),
                at_most: *at_most,
                body: self.region(body, owner),
            },
            StepKind::Parallel { branches } => graph::NodeKind::Parallel {
                branches: branches.iter().map(|branch| self.region(branch, owner)).collect(),
            },
            StepKind::End { kind, of, why } => {
                let (how, of, why) = self.ending(*kind, *of, why.as_ref());
                graph::NodeKind::End { how, of, why }
            }
            // What has errors is not lowered.
            StepKind::Unknown => graph::NodeKind::End { how: graph::Ending::Fail, of: None, why: None },
        }
    }

    fn ending(
        &mut self,
        kind: EndKind,
        of: Option<StepId>,
        why: Option<&Term>,
    ) -> (graph::Ending, Option<NodeId>, Option<graph::Term>) {
        let how = match kind {
            EndKind::Done => graph::Ending::Done,
            EndKind::Fail => graph::Ending::Fail,
            EndKind::Cannot => graph::Ending::Cannot,
            EndKind::Replan => graph::Ending::Replan,
        };
        // These end the whole policy, wherever they stand.
        let of = of
            .filter(|_| matches!(kind, EndKind::Done | EndKind::Fail))
            .and_then(|step| self.ids.get(step.index()).copied().flatten());
        (how, of, why.map(|why| self.tables.term(&self.with_known_fields(why), &[], None)))
    }

    /// The reason of an ending with the fields that the scene gives: nothing is observed for a reason.
    fn with_known_fields(&self, term: &Term) -> Term {
        match term {
            Term::Field(of, name) => match **of {
                Term::Entity(entity) => {
                    self.tables.environment.number(entity, name).map_or_else(|| term.clone(), Term::Number)
                }
                _ => term.clone(),
            },
            Term::Arith(op, left, right) => Term::Arith(
                *op,
                Box::new(self.with_known_fields(left)),
                Box::new(self.with_known_fields(right)),
            ),
            Term::Template(parts) => {
                Term::Template(parts.iter().map(|(part, ty)| (self.with_known_fields(part), *ty)).collect())
            }
            _ => term.clone(),
        }
    }

    fn reaction(&mut self, reaction: &Reaction, owner: Option<NodeId>) -> graph::Reaction {
        match reaction {
            Reaction::Pause { within_secs } => graph::Reaction::Pause { within_secs: *within_secs },
            // No time to pause is the failure at once.
            Reaction::Timeout => graph::Reaction::Pause { within_secs: 0.0 },
            Reaction::Restart { at_most } => graph::Reaction::Restart { at_most: *at_most },
            Reaction::Resume { at_most, body } => {
                graph::Reaction::Resume { at_most: *at_most, body: self.region(body, owner) }
            }
            Reaction::End { kind, of, why } => {
                let (how, of, why) = self.ending(*kind, *of, why.as_ref());
                graph::Reaction::End { how, of, why }
            }
        }
    }

    fn call(&mut self, call: &Call, step: StepId) -> graph::CallNode {
        let library = self.library;
        let primitive = self.tables.primitive(call.primitive);
        let args = call.args.iter().map(|arg| self.tables.term(arg, &[], None)).collect();
        let binds = call.binds.map(|binding| graph::BindingId(binding.0));
        let Some(def) = library.primitive(call.primitive) else {
            return graph::CallNode {
                primitive,
                args,
                binds,
                manner: call.manner,
                deadline_secs: 0.0,
                retries: 0,
                needs: Vec::new(),
                motion: None,
                effects: Vec::new(),
                unsettles: Vec::new(),
                lasts: None,
            };
        };
        let mut needs = Vec::with_capacity(def.needs.len());
        let placed = self.placed.get_mut(step.index()).and_then(Option::take);
        for (index, need) in def.needs.iter().enumerate() {
            let verdict =
                deferred_notes::need_verdict(self.proof, placed.as_ref(), (step, index), def, library);
            // No path of the proof reaches such a step; a policy that takes over may reach it all the same.
            needs.push(self.need(need, verdict.unwrap_or(NeedVerdict::Deferred), call, &def.fails));
        }
        graph::CallNode {
            primitive,
            args,
            binds,
            manner: call.manner,
            deadline_secs: call.deadline_secs(def.takes),
            retries: call.retries,
            needs,
            motion: def.motion.as_ref().map(|(query, args)| {
                let (verdict, (witness, leaves), why) = match placed {
                    Some(MotionVerdict::Feasible(witness, leaves)) => {
                        (graph::Verdict::Proven, (Some(witness), leaves), None)
                    }
                    Some(MotionVerdict::Deferred(why)) => (graph::Verdict::Deferred, (None, None), why),
                    Some(MotionVerdict::Caught(why)) => (graph::Verdict::Deferred, (None, None), Some(why)),
                    None => (graph::Verdict::Deferred, (None, None), None),
                };
                let args = args.iter().map(|arg| self.tables.term(arg, &call.args, binds)).collect();
                graph::Motion { query: query.name().into(), args, verdict, witness, leaves, why }
            }),
            effects: def.makes.iter().filter_map(|effect| self.effect(effect, call)).collect(),
            unsettles: def.unsettles.iter().filter_map(|effect| self.unsettled(effect, call)).collect(),
            lasts: def.lasts.as_ref().filter(|_| !def.makes.is_empty()).map(|lasts| {
                let (used, uses) = (lasts.resources, library.resources.iter().enumerate());
                let uses = uses.filter(|(_, resource)| resource.closure & used != 0);
                let entities = lasts.entities.iter().map(|term| self.tables.term(term, &call.args, binds));
                graph::Lifetime {
                    uses: uses
                        .filter_map(|(index, _)| u32::try_from(index).ok().map(graph::ResourceId))
                        .collect(),
                    entities: entities.collect(),
                }
            }),
        }
    }

    fn need(
        &mut self,
        need: &NeedDef,
        verdict: NeedVerdict,
        call: &Call,
        fails: &[crate::ir::Failure],
    ) -> graph::Need {
        let binds = call.binds.map(|binding| graph::BindingId(binding.0));
        graph::Need {
            condition: self.tables.condition(&need.condition, &call.args, binds),
            when: need.when.as_ref().map(|when| self.tables.condition(when, &call.args, binds)),
            each: need.each.map(|kind| graph::KindId(u32::from(kind.0))),
            verdict: match verdict {
                NeedVerdict::Proven => graph::Verdict::Proven,
                // A graph is made of policies without errors only, so nothing here was refuted.
                NeedVerdict::Deferred | NeedVerdict::Caught | NeedVerdict::Refuted => {
                    graph::Verdict::Deferred
                }
            },
            failure: self.tables.guard_failure(&need.condition, fails),
        }
    }

    fn effect(&mut self, effect: &EffectDef, call: &Call) -> Option<graph::CallEffect> {
        let binds = call.binds.map(|binding| graph::BindingId(binding.0));
        Some(graph::CallEffect {
            fact: self.tables.fact(&effect.fact, &call.args, binds)?,
            value: effect.value,
            when: effect.when.as_ref().map(|when| self.tables.condition(when, &call.args, binds)),
            each: effect.each.map(|kind| graph::KindId(u32::from(kind.0))),
        })
    }

    fn unsettled(&mut self, effect: &EffectDef, call: &Call) -> Option<graph::Unsettled> {
        let graph::CallEffect { fact, when, each, .. } = self.effect(effect, call)?;
        Some(graph::Unsettled { fact, when, each })
    }
}

/// Returns whether a need is the verdict of the primitive's own motion, such as `reachable(object)` with
/// `reach(object)`.
fn is_of_motion(need: &NeedDef, def: &PrimitiveDef, library: &Library) -> bool {
    let (Condition::Fact(fact), Some((motion, args))) = (&need.condition, &def.motion) else {
        return false;
    };
    library.fluent(fact.fluent).is_some_and(|def| def.derived)
        && matches!(motion, MotionKind::Reach | MotionKind::ReachAt)
        && need.when.is_none()
        && need.each.is_none()
        && fact.args.iter().map(Option::as_ref).eq(args.iter().take(1).map(Some))
}
