//! Knowledge between two policies: the beliefs at the end of a run, and statements of people. The scene and
//! the state of the next check, and the start of the next run, come from it.

mod locations;
mod statements;

use motet_compiler::{InitialFact, Session};
use motet_graph::Graph;
use motet_runtime::{Engine, Pattern, Query, Snapshot, Truth};
use smol_str::SmolStr;

/// Knowledge beyond a scene.
#[derive(Clone, Debug, Default)]
pub struct Knowledge {
    /// In order: a later fact wins, and one with `any` is meant of every entity.
    facts: Vec<(Query, Truth)>,
    some: Vec<Query>,
    /// Entities that were mentioned, the latest last.
    pub(super) spoken_of: Vec<SmolStr>,
    /// Earlier locations of moved things, the latest last.
    came_from: Vec<(SmolStr, SmolStr)>,
}

impl Knowledge {
    /// Returns `true` if nothing is known beyond the scene.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.facts.is_empty()
    }

    /// Takes over what a run believes. Of what its graph does not speak of, what was known before stays; of
    /// what the scene
    /// says, as a session was `given` it, nothing stays that is no longer believed.
    pub fn learn(&mut self, engine: &Engine, given: &Session) {
        self.take(engine.snapshot(), engine.graph(), given);
    }

    /// The same in the middle of a run, for a policy that is to take over: of what running steps change
    /// nothing is known then.
    pub fn learn_midway(&mut self, engine: &Engine, given: &Session) {
        self.take(engine.interrupted(), engine.graph(), given);
    }

    fn take(&mut self, snapshot: Snapshot, graph: &Graph, given: &Session) {
        let speaks = |query: &Query| match query {
            Query::Fact { fluent, .. } => graph.fluents.iter().any(|known| known.name == *fluent),
            Query::Measure { .. } | Query::Field { .. } => true,
        };
        self.facts.retain(|(query, _)| !speaks(query));
        let said = given.initial_facts().map(|given| (query(given), Truth::Unknown));
        self.facts.extend(said.filter(|(query, _)| speaks(query)));
        self.facts.extend(snapshot.facts);
        self.some.retain(|query| !speaks(query));
        self.some.extend(snapshot.some);
    }
}

fn query(given: InitialFact) -> Query {
    let args = given.args.into_iter().map(|arg| arg.map_or(Pattern::Any, Pattern::Is));
    Query::Fact { fluent: given.fluent, args: args.collect() }
}
