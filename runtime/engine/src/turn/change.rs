//! Belief changes of calls: effects after success, doubt after every other outcome.

use super::Turn;
use crate::belief::{BeliefChange, Beliefs, Evaluator, Freshness, OfKind, PerceivedFact};
use crate::query::{Pattern, Query, Truth};
use crate::time::Time;
use motet_graph::{
    CallNode, Condition, Fact, FactArg, FluentId, Graph, KindId, Lifetime, Need, NodeId, ResourceId, Term,
    Value,
};
use smol_str::SmolStr;

/// An entry of `makes` or `unsettles`.
#[derive(Clone, Copy)]
struct ContractEntry<'a> {
    fact: &'a Fact,
    value: Truth,
    when: Option<&'a Condition>,
    each: Option<KindId>,
}

/// All that a call may change, as unknown.
fn changed(call: &CallNode) -> impl Iterator<Item = ContractEntry<'_>> {
    let made = call.effects.iter().map(|effect| {
        let (fact, when) = (&effect.fact, effect.when.as_ref());
        ContractEntry { fact, value: Truth::Unknown, when, each: effect.each }
    });
    made.chain(unsettled(call))
}

/// What a call unsettles.
fn unsettled(call: &CallNode) -> impl Iterator<Item = ContractEntry<'_>> {
    call.unsettles.iter().map(|unsettled| {
        let (fact, when) = (&unsettled.fact, unsettled.when.as_ref());
        ContractEntry { fact, value: Truth::Unknown, when, each: unsettled.each }
    })
}

/// True if a call may change what a need of it asks.
pub(super) fn changes_need(call: &CallNode, need: &Need) -> bool {
    let effects = call.effects.iter().map(|effect| effect.fact.fluent);
    let own: Vec<_> = effects.chain(call.unsettles.iter().map(|entry| entry.fact.fluent)).collect();
    std::iter::once(&need.condition).chain(&need.when).any(|condition| mentions(condition, &own))
}

/// True if a condition is about one of some fluents.
fn mentions(condition: &Condition, fluents: &[FluentId]) -> bool {
    match condition {
        Condition::Literal(_) | Condition::Compare(..) => false,
        Condition::Fact(fact) => fluents.contains(&fact.fluent),
        Condition::Not(inner) => mentions(inner, fluents),
        Condition::All(parts) | Condition::AnyOf(parts) => parts.iter().any(|part| mentions(part, fluents)),
    }
}

/// An id that no entity has: it stands for all that nobody has heard of.
const NOBODY: SmolStr = SmolStr::new_static("");

/// Beliefs, and the graph and bindings in which a contract is read: those of the run, or those of an older
/// policy whose goals have not ended.
pub(super) struct Contracts<'a> {
    pub(super) graph: &'a Graph,
    pub(super) bindings: &'a [Option<Value>],
    pub(super) beliefs: &'a mut Beliefs,
    pub(super) now: Time,
    /// Number of the last observation or effect before the call began: its conditions are about the state
    /// before it. The greatest number if all count.
    pub(super) begun: u64,
    /// Changes that other calls which run may make at any moment.
    pub(super) busy: Vec<BeliefChange>,
    /// Resources and entities by which these calls end lifetimes.
    pub(super) ends: Vec<LifetimeEnd>,
}

/// Resources that a call uses, and entities that it moves: they end the lifetimes of perceived facts.
pub(super) struct LifetimeEnd {
    uses: Vec<SmolStr>,
    moves: Vec<SmolStr>,
}

impl LifetimeEnd {
    fn ends(&self, fact: &PerceivedFact) -> bool {
        self.uses.iter().any(|resource| fact.uses.contains(resource))
            || self.moves.iter().any(|entity| fact.entities.contains(entity))
    }
}

impl Turn<'_> {
    /// Applies a call's declared effects.
    pub(super) fn make(&mut self, node: NodeId) {
        let plan = self.plan;
        let Some(call) = plan.call(node) else { return };
        let ends_lifetimes = !self.run.beliefs.lasting.is_empty();
        if ends_lifetimes || !call.effects.is_empty() || !call.unsettles.is_empty() {
            let (busy, ends) = self.busy(Some(node), call);
            Contracts { busy, ends, ..self.contracts_at(node) }.make(call);
        }
    }

    /// Changes that the other calls which run may make, if conditions of a call are judged by them, and what
    /// they end, if its facts have a lifetime: calls of this policy, and of those before it.
    pub(super) fn busy(
        &mut self,
        node: Option<NodeId>,
        call: &CallNode,
    ) -> (Vec<BeliefChange>, Vec<LifetimeEnd>) {
        let mut conditions = call.effects.iter().map(|effect| &effect.when);
        let has_conditions =
            conditions.any(Option::is_some) || call.unsettles.iter().any(|entry| entry.when.is_some());
        let (mut busy, mut ends) = (Vec::new(), Vec::new());
        if !has_conditions && call.lasts.is_none() {
            return (busy, ends);
        }
        let plan = self.plan;
        let others = self.run.goals.live().into_iter().map(|(_, other)| other);
        let others: Vec<_> = others.filter(|other| Some(*other) != node).collect();
        for call in others.into_iter().filter_map(|other| plan.call(other)) {
            let mut contracts = self.contracts();
            contracts.expand_all(call, &mut busy);
            ends.push(contracts.end_of(call));
        }
        for orphan in self.run.orphans.clone() {
            if let Some(call) = orphan.plan.call(orphan.node) {
                let mut contracts = self.contracts_of(&orphan);
                contracts.expand_all(call, &mut busy);
                ends.push(contracts.end_of(call));
            }
        }
        (busy, ends)
    }

    /// Applies what a call unsettles as soon as it starts.
    pub(super) fn unsettle(&mut self, call: &CallNode) {
        self.contracts().unsettle(call);
    }

    /// After a failure or an interruption nothing is known of what a call makes or unsettles.
    pub(super) fn doubt(&mut self, node: NodeId) {
        let plan = self.plan;
        if let Some(call) = plan.call(node) {
            self.contracts_at(node).doubt(call);
        }
    }

    /// Nothing is known any more of what running calls make or unsettle.
    pub(crate) fn doubt_running(&mut self) {
        self.run.goals.live().into_iter().for_each(|(_, node)| self.doubt(node));
        self.doubt_orphans();
    }

    fn contracts(&mut self) -> Contracts<'_> {
        Contracts {
            graph: &self.plan.graph,
            bindings: &self.run.bindings,
            beliefs: &mut self.run.beliefs,
            now: self.run.now,
            begun: u64::MAX,
            busy: Vec::new(),
            ends: Vec::new(),
        }
    }

    /// Contracts for the end of a call.
    fn contracts_at(&mut self, node: NodeId) -> Contracts<'_> {
        let begun = self.run.nodes.at(node.index()).seen;
        Contracts { begun, ..self.contracts() }
    }

    /// True if a need holds; of a quantified one, whether it holds for every entity that the engine has heard
    /// of.
    pub(super) fn need(&mut self, need: &Need, fresh: Freshness) -> Truth {
        let Some(kind) = need.each else { return self.need_of(need, None, fresh) };
        let mut truth = Truth::True;
        let sorting = self.run.beliefs.entities.sorting(&self.plan.graph, kind);
        for index in 0..self.run.beliefs.entities.len() {
            let Some((id, of_kind)) = self.run.beliefs.entities.get(index, &sorting) else { continue };
            if of_kind == OfKind::No {
                continue;
            }
            let own = self.need_of(need, Some(Value::Entity(id)), fresh);
            // The need may not apply to an entity that may be of another kind.
            let is_open = of_kind == OfKind::Perhaps && own == Truth::False;
            truth = truth.and(if is_open { Truth::Unknown } else { own });
        }
        truth
    }

    /// True if a need holds of one entity: what it asks holds, or the condition under which it asks does not.
    /// If neither is known, both are worth an observation.
    fn need_of(&mut self, need: &Need, each: Option<Value>, fresh: Freshness) -> Truth {
        let Some(when) = &need.when else {
            let mut judge = self.judge_missing(fresh);
            judge.each = each;
            return judge.condition(&need.condition);
        };
        let mut judge = self.judge(fresh);
        judge.each.clone_from(&each);
        // What is believed may settle it without an observation.
        let is_asked = judge.condition(when);
        if is_asked == Truth::False
            || is_asked == Truth::Unknown && judge.condition(&need.condition) == Truth::True
        {
            return Truth::True;
        }
        let mut judge = self.judge_missing(fresh);
        judge.each = each;
        let is_asked = if is_asked == Truth::Unknown { judge.condition(when) } else { is_asked };
        is_asked.negated().or(judge.condition(&need.condition))
    }
}

fn entity(value: Value) -> Option<SmolStr> {
    if let Value::Entity(id) = value { Some(id) } else { None }
}

impl Contracts<'_> {
    /// Applies the effects of a successful call. What it unsettles stays unknown until its end: an
    /// observation in between does not count, and the result has a name only now.
    pub(super) fn make(&mut self, call: &CallNode) {
        self.unsettle(call);
        let mut changes = Vec::new();
        for effect in &call.effects {
            let value = Truth::from(effect.value);
            let entry =
                ContractEntry { fact: &effect.fact, value, when: effect.when.as_ref(), each: effect.each };
            self.expand(entry, &mut changes);
        }
        // What is both made and unmade is made.
        changes.sort_by_key(|change| change.value == Truth::True);
        self.apply(&changes);
        if let Some(lifetime) = &call.lasts {
            self.limit(&changes, lifetime);
        }
    }

    /// Gives a lifetime to what a perception has made.
    fn limit(&mut self, changes: &[BeliefChange], lifetime: &Lifetime) {
        let uses = self.names(&lifetime.uses);
        let mut judge = self.judge(None);
        let entities = lifetime.entities.iter().filter_map(|term| entity(judge.term(term)?));
        let entities: Vec<SmolStr> = entities.collect();
        // What was perhaps made gets a lifetime, too: it may be so only because it was seen.
        for BeliefChange { fluent, args, .. } in changes.iter().filter(|change| !change.rest) {
            let fact = Query::Fact { fluent: fluent.clone(), args: args.clone() };
            let perceived = PerceivedFact { fact, uses: uses.clone(), entities: entities.clone() };
            // What is both made and unmade stands once.
            if !self.beliefs.lasting.contains(&perceived) {
                self.beliefs.lasting.push(perceived);
            }
        }
        for end in std::mem::take(&mut self.ends) {
            self.end(&end);
        }
    }

    /// Makes the facts unknown that the start of a call unsettles, and those whose lifetime it ends.
    pub(super) fn unsettle(&mut self, call: &CallNode) {
        self.end_lifetimes(call);
        let mut changes = Vec::new();
        self.expand_unsettled(call, &mut changes);
        self.apply(&changes);
    }

    /// Makes all facts unknown that a call may have changed, after any outcome but success.
    pub(super) fn doubt(&mut self, call: &CallNode) {
        self.end_lifetimes(call);
        if call.effects.is_empty() && call.unsettles.is_empty() {
            return;
        }
        let mut changes = Vec::new();
        self.expand_all(call, &mut changes);
        self.apply(&changes);
    }

    fn end_lifetimes(&mut self, call: &CallNode) {
        if !self.beliefs.lasting.is_empty() {
            let end = self.end_of(call);
            self.end(&end);
        }
    }

    fn end(&mut self, end: &LifetimeEnd) {
        let over = |fact: &mut PerceivedFact| end.ends(fact);
        for PerceivedFact { fact, .. } in self.beliefs.lasting.extract_if(.., over).collect::<Vec<_>>() {
            if let Query::Fact { fluent, args } = fact {
                let value = Truth::Unknown;
                self.apply(&[BeliefChange { fluent, args, value, sure: true, rest: false }]);
            }
        }
    }

    /// Resources of a call, and the first arguments of what an action changes.
    fn end_of(&mut self, call: &CallNode) -> LifetimeEnd {
        let graph = self.graph;
        let primitive = graph.primitives.get(call.primitive.index());
        let uses = self.names(primitive.map_or(&[], |primitive| &primitive.uses));
        let mut moves = Vec::new();
        if primitive.is_some_and(|primitive| !primitive.perceives) {
            changed(call).for_each(|entry| self.moved(entry, &mut moves));
        }
        LifetimeEnd { uses, moves }
    }

    /// Adds the entities that one entry moves, each that it may be about where it is about several.
    fn moved(&mut self, entry: ContractEntry<'_>, moves: &mut Vec<SmolStr>) {
        match entry.fact.args.first() {
            Some(FactArg::Term(Term::Each)) if entry.each.is_some() => {
                let mut changes = Vec::new();
                self.expand(entry, &mut changes);
                let first = |change: &BeliefChange| match change.args.first()? {
                    Pattern::Is(Value::Entity(id)) => Some(id.clone()),
                    _ => None,
                };
                moves.extend(changes.iter().filter_map(first));
            }
            Some(FactArg::Term(term)) => moves.extend(self.judge(None).term(term).and_then(entity)),
            Some(FactArg::Any) | None => {}
        }
    }

    fn names(&self, resources: &[ResourceId]) -> Vec<SmolStr> {
        let named = |id: &ResourceId| Some(self.graph.resources.get(id.index())?.name.clone());
        resources.iter().filter_map(named).collect()
    }

    /// Works out all that a call may change, as unknown.
    pub(super) fn expand_all(&mut self, call: &CallNode, changes: &mut Vec<BeliefChange>) {
        changed(call).for_each(|entry| self.expand(entry, changes));
    }

    fn expand_unsettled(&mut self, call: &CallNode, changes: &mut Vec<BeliefChange>) {
        unsettled(call).for_each(|entry| self.expand(entry, changes));
    }

    fn apply(&mut self, changes: &[BeliefChange]) {
        self.beliefs.apply_all(changes, self.now);
    }

    /// Works out the changes of one entry in the state as it is.
    fn expand(&mut self, entry: ContractEntry<'_>, changes: &mut Vec<BeliefChange>) {
        let Some(kind) = entry.each else {
            self.expand_for(entry, None, OfKind::Surely, changes);
            return;
        };
        // For those nobody has heard of it is the new default, before what is said of single ones.
        self.expand_rest(entry, changes);
        let sorting = self.beliefs.entities.sorting(self.graph, kind);
        for index in 0..self.beliefs.entities.len() {
            let Some((id, of_kind)) = self.beliefs.entities.get(index, &sorting) else { continue };
            if of_kind != OfKind::No {
                self.expand_for(entry, Some(Value::Entity(id)), of_kind, changes);
            }
        }
    }

    fn expand_for(
        &mut self,
        entry: ContractEntry<'_>,
        each: Option<Value>,
        of_kind: OfKind,
        changes: &mut Vec<BeliefChange>,
    ) {
        let mut judge = self.judge(each);
        let holds = entry.when.map_or(Truth::True, |when| judge.condition(when));
        if holds == Truth::False {
            return;
        }
        let Some(args) = judge.patterns(entry.fact) else { return };
        let Some(fluent) = judge.graph.fluents.get(entry.fact.fluent.index()) else { return };
        let sure = holds == Truth::True && of_kind == OfKind::Surely;
        changes.push(BeliefChange {
            fluent: fluent.name.clone(),
            args,
            value: entry.value,
            sure,
            rest: false,
        });
    }

    fn expand_rest(&mut self, entry: ContractEntry<'_>, changes: &mut Vec<BeliefChange>) {
        let mut judge = self.judge(Some(Value::Entity(NOBODY)));
        if entry.when.is_some_and(|when| judge.condition(when) == Truth::False) {
            return;
        }
        let args = entry.fact.args.iter().map(|arg| match arg {
            FactArg::Any | FactArg::Term(Term::Each) => Some(Pattern::Any),
            FactArg::Term(term) => judge.term(term).map(Pattern::Is),
        });
        let Some(args) = args.collect::<Option<Vec<_>>>() else { return };
        let Some(fluent) = judge.graph.fluents.get(entry.fact.fluent.index()) else { return };
        // Some of them may be of another kind, so it is never sure. An entry that does not mention them also
        // changes facts that are known by name.
        let rest = entry.fact.args.contains(&FactArg::Term(Term::Each));
        changes.push(BeliefChange {
            fluent: fluent.name.clone(),
            args,
            value: entry.value,
            sure: false,
            rest,
        });
    }

    fn judge(&mut self, each: Option<Value>) -> Evaluator<'_> {
        Evaluator {
            graph: self.graph,
            beliefs: self.beliefs,
            bindings: self.bindings,
            each,
            fresh: Freshness::Before(self.now, self.begun),
            busy: &self.busy,
            vague: false,
            missing: None,
        }
    }
}
