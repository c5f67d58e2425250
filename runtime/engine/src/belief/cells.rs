//! One cell for each query that somebody asked: the last answer, its time, and who depends on it.

use super::entities::Entities;
use crate::query::{Answer, Pattern, Query, Reading};
use crate::time::Time;
use motet_graph::{FluentId, Graph, Value};
use rustc_hash::{FxHashMap, FxHasher};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

/// Index of a cell.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct CellId(pub(crate) u32);

/// The most cells that things seen in passing may fill: what nobody asks for is then forgotten.
const MAX_IN_PASSING: usize = 100_000;

/// Belief about one query.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    pub(crate) query: Arc<Query>,
    pub(crate) answer: Answer,
    /// Time at which it was last observed or changed by an effect.
    pub(crate) at: Time,
    /// The number of the observation that gave the answer; 0 where an effect gave it.
    pub(crate) seen: u64,
    /// The number of the observation or the effect that changed the answer last.
    pub(crate) changed: u64,
    /// Keys of the watches and nodes to evaluate again after a change.
    pub(crate) dependents: Vec<u32>,
    /// Number of watches and waits that need it kept current.
    pub(crate) watchers: u32,
    /// It is watched, and its driver knows it by the last report since the watch began.
    pub(crate) live: bool,
    /// True if the robot can observe it.
    pub(crate) observable: bool,
    /// True if an effect, an observation or a host ever said something of it.
    pub(crate) written: bool,
    /// Its last watcher went away in a swap that is being made.
    pub(crate) idle: bool,
    /// Number of answers that are outstanding: one for each question, and the first one of a watch.
    pub(crate) due: u32,
    /// Number of outstanding answers to questions that are older than the last effect: such an answer may
    /// have been observed before it.
    pub(crate) late: u32,
    /// True if the answer is such a late one. Watches go by it; a guard asks again.
    pub(crate) tainted: bool,
    next: Option<CellId>,
}

/// A write to all facts that a pattern covers.
#[derive(Clone, Debug)]
pub(crate) struct PatternWrite {
    pub(crate) args: Vec<Pattern>,
    pub(crate) answer: Answer,
    pub(crate) seen: u64,
    pub(crate) changed: u64,
}

/// A fluent's facts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facts {
    /// Position where it stands in the graph.
    pub(crate) fluent: Option<FluentId>,
    pub(crate) cells: Vec<CellId>,
    /// Facts with `any`.
    pub(crate) patterns: Vec<CellId>,
    /// Later ones win.
    pub(crate) wides: Vec<PatternWrite>,
    pub(crate) observable: bool,
}

/// Fact that a perception has made, with its lifetime. After its end the fact is unknown.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PerceivedFact {
    pub fact: Query,
    /// Names of the resources whose use ends it.
    pub uses: Vec<SmolStr>,
    /// Entities: an action that changes something about one of them ends it.
    pub entities: Vec<SmolStr>,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Beliefs {
    pub(crate) entities: Entities,
    pub(crate) fluents: FxHashMap<SmolStr, Facts>,
    /// Keys of those who depend on something that has changed.
    pub(crate) changed: Vec<u32>,
    /// Number of observations and effects so far.
    pub(crate) observations: u64,
    /// The number of the observation that is being taken in; 0 where there is none.
    pub(super) observing: u64,
    /// Facts that last only so long, in the order in which they were made.
    pub(crate) lasting: Vec<PerceivedFact>,
    /// Cells that are watched and that the effects of one call have changed so far, with what was seen.
    pub(super) watched: Vec<(CellId, Answer)>,
    cells: Vec<Cell>,
    index: FxHashMap<u64, CellId>,
}

impl Beliefs {
    /// Nothing is known.
    pub(crate) fn new(graph: &Graph) -> Self {
        let mut beliefs = Self::default();
        for (index, fluent) in graph.fluents.iter().enumerate() {
            let id = FluentId(index as u32);
            let facts = Facts { fluent: Some(id), observable: fluent.observable, ..Facts::default() };
            beliefs.fluents.insert(fluent.name.clone(), facts);
        }
        beliefs
    }

    /// The same beliefs, read by another graph.
    pub(crate) fn read_by(&mut self, graph: &Graph) {
        self.fluents.values_mut().for_each(|facts| facts.fluent = None);
        for (index, fluent) in graph.fluents.iter().enumerate() {
            let facts = self.fluents.entry(fluent.name.clone()).or_default();
            facts.fluent = Some(FluentId(index as u32));
            if facts.observable != fluent.observable {
                facts.observable = fluent.observable;
                for id in facts.cells.iter().chain(&facts.patterns) {
                    if let Some(cell) = self.cells.get_mut(id.0 as usize) {
                        cell.observable = fluent.observable;
                    }
                }
            }
        }
    }

    pub(crate) fn cell(&self, id: CellId) -> Option<&Cell> {
        self.cells.get(id.0 as usize)
    }

    pub(crate) fn cell_mut(&mut self, id: CellId) -> Option<&mut Cell> {
        self.cells.get_mut(id.0 as usize)
    }

    /// The cell of a fact, if somebody asked for it.
    pub(crate) fn find_fact(&self, fluent: &str, args: &[Pattern]) -> Option<CellId> {
        self.find(
            fact_hash(fluent, args),
            |query| matches!(query, Query::Fact { fluent: f, args: a } if f == fluent && a == args),
        )
    }

    /// The cell of a query, if somebody asked for it.
    pub(crate) fn find_query(&self, query: &Query) -> Option<CellId> {
        self.find(query_hash(query), |known| known == query)
    }

    /// The last readings of measures and fields.
    pub(crate) fn readings(&self) -> impl Iterator<Item = Reading> + '_ {
        self.cells.iter().filter_map(|cell| match (&*cell.query, &cell.answer) {
            (Query::Measure { .. } | Query::Field { .. }, Answer::Value(value)) => {
                Some(Reading { query: (*cell.query).clone(), value: value.clone(), at: cell.at })
            }
            (Query::Fact { .. } | Query::Measure { .. } | Query::Field { .. }, _) => None,
        })
    }

    /// True if a fact that nobody asked for may still be kept.
    pub(crate) fn has_room(&self) -> bool {
        self.cells.len() < MAX_IN_PASSING
    }

    /// The cell of a query.
    pub(crate) fn intern(&mut self, query: Query) -> CellId {
        if let Some(id) = self.find_query(&query) {
            return id;
        }
        let id = CellId(self.cells.len() as u32);
        let (answer, (seen, changed), observable) = match &query {
            Query::Fact { fluent, args } => {
                let pattern = args.contains(&Pattern::Any);
                let (answer, numbers) = self.wide_answer(fluent, args);
                let facts = self.fluents.entry(fluent.clone()).or_default();
                if pattern {
                    facts.patterns.push(id)
                } else {
                    facts.cells.push(id)
                }
                (answer, numbers, facts.observable)
            }
            Query::Measure { .. } | Query::Field { .. } => (Answer::Unknown, (0, 0), true),
        };
        let next = self.index.insert(query_hash(&query), id);
        let query = Arc::new(query);
        let dependents = Vec::new();
        self.cells.push(Cell {
            query,
            answer,
            at: Time::ZERO,
            seen,
            changed,
            dependents,
            watchers: 0,
            live: false,
            observable,
            written: false,
            idle: false,
            due: 0,
            late: 0,
            tainted: false,
            next,
        });
        id
    }

    fn find(&self, hash: u64, is_it: impl Fn(&Query) -> bool) -> Option<CellId> {
        let mut at = self.index.get(&hash).copied();
        while let Some(id) = at {
            let cell = self.cell(id)?;
            if is_it(&cell.query) {
                return Some(id);
            }
            at = cell.next;
        }
        None
    }
}

fn query_hash(query: &Query) -> u64 {
    let mut hasher = FxHasher::default();
    match query {
        Query::Fact { fluent, args } => return fact_hash(fluent, args),
        Query::Measure { measure, args } => {
            (1_u8, measure.as_str()).hash(&mut hasher);
            args.iter().for_each(|arg| hash_value(arg, &mut hasher));
        }
        Query::Field { entity, field } => (2_u8, entity.as_str(), field.as_str()).hash(&mut hasher),
    }
    hasher.finish()
}

fn fact_hash(fluent: &str, args: &[Pattern]) -> u64 {
    let mut hasher = FxHasher::default();
    fluent.hash(&mut hasher);
    for arg in args {
        match arg {
            Pattern::Is(value) => hash_value(value, &mut hasher),
            Pattern::Any => 0_u8.hash(&mut hasher),
        }
    }
    hasher.finish()
}

fn hash_value(value: &Value, hasher: &mut FxHasher) {
    match value {
        Value::Bool(value) => value.hash(hasher),
        Value::Int(value) => value.hash(hasher),
        // Zero equals minus zero.
        Value::Number(value) => (value + 0.0).to_bits().hash(hasher),
        Value::Text(text) | Value::Entity(text) | Value::Case(text) => text.as_str().hash(hasher),
        Value::Pose(_) => 1_u8.hash(hasher),
        Value::List(items) => items.iter().for_each(|item| hash_value(item, hasher)),
    }
}
