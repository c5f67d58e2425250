//! Replacing the graph that runs, at any moment, in two phases.
//!
//! A new graph is **prepared** away from the stepping path ([`PreparedSwap::new`]): it is validated, and all
//! that does not depend on the moment is worked out. Then [`Engine::swap`] **commits** it between two events,
//! in one move. What the new policy was proved from is checked against what is believed at that moment; a
//! refused swap changes nothing at all.

use crate::belief::{Beliefs, Entities, FactStanding, covers};
use crate::driver::{Capabilities, MissingPrimitive};
use crate::effect::Effect;
use crate::engine::Engine;
use crate::prepared_graph::PreparedGraph;
use crate::query::{Pattern, Query, Truth};
use crate::start::{self, StartState};
use crate::state::Run;
use crate::time::Time;
use motet_graph::{FactArg, Graph, InvalidGraph, Term, Type};
use smol_str::SmolStr;
use std::fmt;
use std::sync::Arc;

/// A graph that runs, for others to prepare a swap against. Cheap to clone, and may go to another thread.
#[derive(Clone, Debug)]
pub struct RunningGraph {
    plan: Arc<PreparedGraph>,
}

/// A graph made ready to take over.
#[derive(Clone, Debug)]
pub struct PreparedSwap {
    plan: Arc<PreparedGraph>,
    run: Box<Run>,
    /// The graph that it was prepared against.
    against: Arc<PreparedGraph>,
    /// True if fluents stand at the same places in both.
    same_fluents: bool,
    /// Names of the old graph that are carried, with their places in both.
    carried: Vec<(u32, u32)>,
    /// Facts from which it was proved.
    told: Vec<InitialFact>,
}

/// A fact that a policy was proved from.
#[derive(Clone, Debug)]
struct InitialFact {
    fluent: SmolStr,
    args: Vec<Pattern>,
    value: bool,
}

/// Remains of a swap. Dropping them costs O(graph), so do it away from the stepping path.
#[derive(Debug)]
pub struct RetiredGraph {
    revision: u32,
    plan: Arc<PreparedGraph>,
    _run: (Box<Run>, Entities),
}

/// Reason for which a swap was refused. The run continues unchanged.
#[derive(Clone, PartialEq, Debug)]
pub enum SwapRefusal {
    /// The graph is not valid.
    Invalid(Vec<InvalidGraph>),
    /// It was compiled for another robot.
    Robot {
        /// The robot that runs.
        running: SmolStr,
        /// The new graph's.
        wanted: SmolStr,
    },
    /// It was proved from a fact that does not hold, or that is no longer known.
    Start {
        fact: Query,
        /// Facts from which it was proved.
        told: bool,
        believed: Truth,
    },
    /// It calls primitives that the driver does not have.
    Primitives(Vec<MissingPrimitive>),
    /// It needs a name that the run has not bound, or not with that type.
    Binding { name: SmolStr },
    /// The run is over, or a person stops it.
    Over,
}

impl RunningGraph {
    /// The prepared or running graph.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        &self.plan.graph
    }
}

impl RetiredGraph {
    /// The graph that was replaced.
    #[must_use]
    pub fn graph(&self) -> &Arc<Graph> {
        &self.plan.graph
    }

    /// Its number in the trace.
    #[must_use]
    pub const fn revision(&self) -> u32 {
        self.revision
    }
}

impl PreparedSwap {
    /// Makes a graph ready to take over from the one that runs. Costs the size of the graph. Where another
    /// swap is committed first, it stays good.
    ///
    /// # Errors
    ///
    /// [`SwapRefusal::Invalid`], [`SwapRefusal::Robot`].
    pub fn new(graph: Graph, running: &RunningGraph) -> Result<Self, SwapRefusal> {
        motet_graph::validate(&graph).map_err(SwapRefusal::Invalid)?;
        let old = &running.plan.graph;
        if graph.robot != old.robot {
            return Err(SwapRefusal::Robot { running: old.robot.clone(), wanted: graph.robot });
        }
        let told = told(&graph);
        let plan = PreparedGraph::new(Arc::new(graph));
        let beliefs = start::believe(&plan.graph, &StartState::default());
        let run = Box::new(Run::new(&plan, beliefs));
        let mut prepared = Self {
            plan: Arc::new(plan),
            run,
            against: running.plan.clone(),
            same_fluents: false,
            carried: Vec::new(),
            told,
        };
        prepared.map();
        Ok(prepared)
    }

    /// The prepared or running graph.
    #[must_use]
    pub fn graph(&self) -> &Arc<Graph> {
        &self.plan.graph
    }

    fn map(&mut self) {
        let (old, new) = (&self.against.graph, &self.plan.graph);
        self.same_fluents = old.fluents == new.fluents;
        let place = |name: &SmolStr, ty: &Type| {
            let fits =
                |known: &motet_graph::Binding| known.name == *name && same_type(&known.ty, old, ty, new);
            old.bindings.iter().position(fits)
        };
        let carried =
            new.bindings.iter().enumerate().filter_map(|(index, binding)| {
                Some((place(&binding.name, &binding.ty)? as u32, index as u32))
            });
        self.carried = carried.collect();
    }

    /// Checks the swap against the state of the run.
    fn check(&self, run: &Run, running: &Graph, can: &Capabilities) -> Result<(), SwapRefusal> {
        if run.over || run.is_stopped() {
            return Err(SwapRefusal::Over);
        }
        let graph = &self.plan.graph;
        if graph.robot != running.robot {
            return Err(SwapRefusal::Robot { running: running.robot.clone(), wanted: graph.robot.clone() });
        }
        let missing = can.missing(graph);
        if !missing.is_empty() {
            return Err(SwapRefusal::Primitives(missing));
        }
        for told in &self.told {
            let standing =
                run.beliefs.standing(&told.fluent, &told.args, told.value, &others(&self.told, told));
            if let FactStanding::Otherwise(believed) = standing {
                let fact = Query::Fact { fluent: told.fluent.clone(), args: told.args.clone() };
                return Err(SwapRefusal::Start { fact, told: told.value, believed });
            }
        }
        for (index, binding) in graph.bindings.iter().enumerate().filter(|(_, binding)| binding.given) {
            let from = self.carried.iter().find(|(_, to)| *to as usize == index);
            let value = from.and_then(|(from, _)| run.bindings.get(*from as usize)?.as_ref());
            if !value.is_some_and(|value| value.fits(&binding.ty)) {
                return Err(SwapRefusal::Binding { name: binding.name.clone() });
            }
        }
        Ok(())
    }
}

impl Engine {
    /// The graph that runs, to prepare a swap against.
    #[must_use]
    pub fn running(&self) -> RunningGraph {
        RunningGraph { plan: self.plan.clone() }
    }

    /// Lets another graph take over, at any moment between two events: while goals run, are held or are being
    /// cancelled, and also while an earlier swap still waits for goals to end. The new policy begins with its
    /// first step, in the state that the old one leaves; its monitors are judged at once. Appends what is to
    /// be done about it to `out`.
    ///
    /// A goal whose call is reached at this instant with the same primitive and arguments goes on untouched,
    /// with its deadline counted from now and its guards taken as passed. One that the driver can update
    /// ([`crate::Capabilities`]) is, where a call of its primitive is reached whose guards hold. Every other
    /// goal is cancelled, and a call that conflicts with it starts once it has ended.
    ///
    /// Names are carried where name and type agree. What is due before `now` in the old graph and has not
    /// been handled no longer happens.
    ///
    /// # Errors
    ///
    /// Why it was refused; then neither the engine nor `out` has changed.
    pub fn swap(
        &mut self,
        now: Time,
        prepared: PreparedSwap,
        out: &mut Vec<Effect>,
    ) -> Result<RetiredGraph, SwapRefusal> {
        let mut prepared = prepared;
        if !Arc::ptr_eq(&prepared.against, &self.plan) {
            prepared.against = self.plan.clone();
            prepared.map();
        }
        prepared.check(&self.run, &self.plan.graph, &self.capabilities)?;
        self.run.now = self.run.now.max(now);
        let plan = self.plan.clone();
        let bindings = self.turn(out).retire(&plan);
        let PreparedSwap { plan: next, mut run, same_fluents, carried, told, .. } = prepared;
        let heard = std::mem::take(&mut run.beliefs.entities);
        run.inherit(&mut self.run, &bindings, &carried);
        if !same_fluents {
            run.beliefs.read_by(&next.graph);
        }
        // What is said of every entity is not meant of those of which something else is said.
        let (wide, single): (Vec<_>, Vec<_>) = told.iter().partition(|one| one.args.contains(&Pattern::Any));
        for one in single.into_iter().chain(wide) {
            run.beliefs.hear_told(one, &others(&told, one));
        }
        let revision = self.run.revision;
        let old = std::mem::replace(&mut self.run, run);
        self.older.push((revision, std::mem::replace(&mut self.plan, next)));
        self.turn(out).take_over(&heard);
        Ok(RetiredGraph { revision, plan, _run: (old, heard) })
    }

    /// The graph with a number, to read a trace by: the one that runs, or one that was replaced.
    #[must_use]
    pub fn graph_at(&self, revision: u32) -> Option<&Graph> {
        if revision == self.run.revision {
            return Some(&self.plan.graph);
        }
        self.older.iter().find(|(of, _)| *of == revision).map(|(_, plan)| &*plan.graph)
    }

    /// The number of the graph that runs: 0, and one more with each swap.
    #[must_use]
    pub fn revision(&self) -> u32 {
        self.run.revision
    }
}

impl Run {
    /// True if a person stops the run.
    fn is_stopped(&self) -> bool {
        let stopped = |end: &Option<crate::effect::RunEnd>| *end == Some(crate::effect::RunEnd::Interrupted);
        stopped(&self.ending) || stopped(&self.closing)
    }

    /// Takes from the run before it all that outlasts a graph.
    fn inherit(&mut self, old: &mut Self, bindings: &[Option<motet_graph::Value>], carried: &[(u32, u32)]) {
        self.begun = old.begun;
        self.now = old.now;
        self.revision = old.revision + 1;
        self.swapping = true;
        self.beliefs = std::mem::take(&mut old.beliefs);
        self.goals = std::mem::take(&mut old.goals);
        self.orphans = std::mem::take(&mut old.orphans);
        self.idle = std::mem::take(&mut old.idle);
        self.left = std::mem::take(&mut old.left);
        self.walk = std::mem::take(&mut old.walk);
        self.missing = std::mem::take(&mut old.missing);
        self.checked = old.checked;
        for (from, to) in carried {
            let value = bindings.get(*from as usize).cloned().flatten();
            if let Some(slot) = self.bindings.get_mut(*to as usize) {
                *slot = value;
            }
        }
    }
}

/// The ground facts that a graph was proved from.
fn told(graph: &Graph) -> Vec<InitialFact> {
    let told = graph.initial.iter().filter_map(|motet_graph::InitialFact { fact, value }| {
        let args = fact.args.iter().map(|arg| match arg {
            FactArg::Term(Term::Literal(value)) => Some(Pattern::Is(value.clone())),
            FactArg::Any => Some(Pattern::Any),
            FactArg::Term(_) => None,
        });
        let fluent = graph.fluents.get(fact.fluent.index())?.name.clone();
        Some(InitialFact { fluent, args: args.collect::<Option<_>>()?, value: *value })
    });
    // Of one fact the later word counts, and so does one about every entity.
    let mut last: Vec<InitialFact> = Vec::new();
    for told in told {
        last.retain(|before| before.fluent != told.fluent || !covers(&told.args, &before.args));
        last.push(told);
    }
    last
}

/// Facts that say something else than one about every entity.
fn others<'a>(told: &'a [InitialFact], of: &InitialFact) -> Vec<&'a [Pattern]> {
    if !of.args.contains(&Pattern::Any) {
        return Vec::new();
    }
    let others = told.iter().filter(|one| one.fluent == of.fluent && !one.args.contains(&Pattern::Any));
    others.map(|one| one.args.as_slice()).collect()
}

/// True if two types of two graphs are the same.
fn same_type(a: &Type, of_a: &Graph, b: &Type, of_b: &Graph) -> bool {
    let kind =
        |graph: &Graph, id: &motet_graph::KindId| graph.kinds.get(id.index()).map(|kind| kind.name.clone());
    match (a, b) {
        (Type::Entity(a), Type::Entity(b)) => kind(of_a, a) == kind(of_b, b),
        (Type::List(a), Type::List(b)) => same_type(a, of_a, b, of_b),
        (a, b) => a == b,
    }
}

impl fmt::Display for SwapRefusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(wrong) => {
                f.write_str("the graph is not valid")?;
                wrong.first().map_or(Ok(()), |first| write!(f, ": {first}"))
            }
            Self::Robot { running, wanted } => write!(f, "it is for `{wanted}`, and `{running}` runs"),
            Self::Start { fact, told, believed } => {
                write!(f, "it was proved from `{fact}` being {told}, which is {believed}")
            }
            Self::Primitives(missing) => {
                write!(f, "the driver does not have {}", MissingPrimitive::list(missing))
            }
            Self::Binding { name } => write!(f, "it needs `{name}`, which is not bound"),
            Self::Over => f.write_str("the run is over"),
        }
    }
}

impl std::error::Error for SwapRefusal {}

/// Initial facts in the beliefs of a run.
impl Beliefs {
    fn hear_told(&mut self, told: &InitialFact, others: &[&[Pattern]]) {
        let InitialFact { fluent, args, value } = told;
        let standing = self.standing(fluent, args, *value, others);
        let is_partly_unheard = standing == FactStanding::So && args.contains(&Pattern::Any);
        if standing == FactStanding::Unheard || is_partly_unheard {
            self.tell_rest(fluent, args.clone(), Truth::from(*value));
        }
    }
}
