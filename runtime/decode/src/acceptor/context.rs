//! The part that all machines of one session share, with a memo of the checker's answers.
//!
//! The memo is keyed by hashes of everything that an answer depends on, so a question that comes again, after
//! a rollback or for another token, costs a lookup.

use std::sync::{Arc, Mutex, PoisonError};

use motet_compiler::Session;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::automaton::{Automaton, Meaning};

/// Automaton, session and answers of all machines of one session.
#[derive(Debug)]
pub(crate) struct Context {
    pub(crate) automaton: Arc<Automaton>,
    pub(crate) session: Session,
    /// Pairs of a callable and an entity for which a motion query found no motion.
    pub(crate) infeasible: FxHashSet<(usize, u16)>,
    pub(crate) memo: Memo,
}

impl Context {
    /// A word is an argument that a motion query ruled out.
    pub(super) fn is_ruled_out(&self, callable: usize, arg: usize, meaning: Meaning) -> bool {
        let Meaning::Entity(entity) = meaning else { return false };
        let target = self.automaton.callables.get(callable).and_then(|callable| callable.target);
        target == Some(arg) && self.infeasible.contains(&(callable, entity))
    }
}

/// The memo is cleared when it has this many answers.
const MOST: usize = 1 << 18;

/// Answers by hashes of the log and the question.
#[derive(Debug, Default)]
pub(crate) struct Memo(Mutex<FxHashMap<u64, bool>>);

/// A question about a place of the log.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Question {
    /// The current step is no error.
    Verify = 1,
    /// The policy may be done.
    Done,
    /// A call can be completed.
    Call,
    /// A call beside concurrent steps can be completed.
    SharedCall,
    /// Nothing refutes a call at its place, with the arguments so far.
    Permitted,
    /// A test keeps a loop's back edge from being refuted.
    Test,
    /// A loop may iterate.
    Round,
    /// All callables were probed in a batch.
    Probed,
    /// Everything beside a loop is right with a test that leaves certain facts.
    Beside,
}

impl Memo {
    pub(crate) fn get(&self, key: u64) -> Option<bool> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get(&key).copied()
    }

    pub(crate) fn put(&self, key: u64, answer: bool) {
        let mut answers = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if answers.len() >= MOST {
            answers.clear();
        }
        answers.insert(key, answer);
    }
}
