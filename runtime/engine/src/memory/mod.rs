//! Memory of a run for people and for models: instructions, steps with their results, failures, questions and
//! answers, new policies, endings. Bounded, with what was dropped counted.
//!
//! A [`Memory`] is fed with the events and effects of a run, by its host, and changes nothing. It has two
//! views for a language model: [`ShortHistory`], the first request and the latest failure, as InteLiPlan
//! keeps it, and [`WorkingMemory`], the state and the executed steps, as VLP keeps its working memory; and
//! [`FullMemory`], everything.
//!
//! ```
//! use motet_runtime::memory::{MemoryLimits, Memory};
//! use motet_runtime::Time;
//!
//! let mut memory = Memory::new(MemoryLimits::default());
//! memory.instruct(Time::ZERO, "bring me the red mug");
//! // … for each event: memory.event(now, &event), and memory.effect(now, &effect) for each effect.
//! assert_eq!(memory.short().to_string(), "request: bring me the red mug\n");
//! ```

mod feed;
mod store;
mod views;

pub use store::{DroppedCounts, Memory, MemoryEntry, MemoryEvent, MemoryLimits, RunningStep, StepEnd};
pub use views::{FullMemory, ShortHistory, WorkingMemory};
