//! Beliefs of the engine about the world: facts, readings, and known entities.
//!
//! Beliefs change by declared effects and by observations, and every change names who depends on it.
//! Conditions are judged by [`eval`] in three values.

mod cells;
mod entities;
mod evaluator;
mod facts;

pub use cells::PerceivedFact;
pub(crate) use cells::{Beliefs, Cell, CellId, Facts};
pub(crate) use entities::{Entities, OfKind};
pub(crate) use evaluator::{Evaluator, Freshness, hand};
pub(crate) use facts::{BeliefChange, FactStanding, covers, truth_of};
