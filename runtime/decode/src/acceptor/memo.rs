//! What was asked before: the answers of the checker, by everything that they depend on. All machines of a session share them,
//! so a question that comes again, behind a token that crosses a choice or after a way back, costs a look-up.

use std::hash::{Hash, Hasher};
use std::sync::{Mutex, PoisonError};

use rustc_hash::{FxHashMap, FxHasher};

use super::event_log::{Event, Id, mix};
use super::machine::Machine;

/// Answers beyond this many are forgotten, all at once.
const MOST: usize = 1 << 18;

/// Answers, by hashes of what was said and of what was asked.
#[derive(Debug, Default)]
pub(crate) struct Memo(Mutex<FxHashMap<u64, bool>>);

/// What was asked of a place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Question {
    /// Whether the step of the body is no error.
    Verify = 1,
    /// Whether the policy may be done.
    Done,
    /// Whether a call can be completed.
    Call,
    /// The same, beside what runs at once.
    SharedCall,
    /// Whether nothing refutes a call at its place, with the arguments so far.
    Permitted,
    /// Whether a test keeps a loop's back edge from being wrong.
    Test,
    /// Whether a loop may come round where its body ends.
    Round,
    /// Whether what can be called was asked of all that runs at once.
    Probed,
    /// Whether all is well beside a loop where some test leaves certain facts.
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

impl Machine {
    /// Says something: puts it behind what was said.
    pub(crate) fn record(&mut self, below: Id, event: Event) -> Id {
        // What a policy is called tells nothing, unless it is called like one that its steps could call.
        let is_title =
            matches!(event, Event::Name(start, len) if below == 0 && !self.is_callable(start, len));
        let content = if is_title { 0 } else { self.content(event) };
        self.arenas.record(below, event, content)
    }

    fn is_callable(&self, start: u32, len: u32) -> bool {
        let name = self.bytes.get(start as usize..(start.saturating_add(len)) as usize).unwrap_or_default();
        self.context.automaton.signatures.callables.iter().any(|callable| callable.name.as_bytes() == name)
    }

    /// A hash of what an event says, wherever in the machine its bytes stand.
    fn content(&self, event: Event) -> u64 {
        let mut hasher = FxHasher::default();
        let mut spelled = |sort: u8, start: u32, len: u32| {
            sort.hash(&mut hasher);
            self.bytes.get(start as usize..(start.saturating_add(len)) as usize).hash(&mut hasher);
        };
        match event {
            Event::Bound(id) => {
                if let Some(name) = self.arenas.name(id) {
                    spelled(1, name.start, name.len);
                }
            }
            Event::Text(start, len) => spelled(2, start, len),
            Event::Name(start, len) => spelled(3, start, len),
            Event::Open(_)
            | Event::Close
            | Event::Word(..)
            | Event::Number(..)
            | Event::Constant(_)
            | Event::AnyText
            | Event::Joined(_)
            | Event::Hole => event.hash(&mut hasher),
        }
        mix(hasher.finish(), 0)
    }

    /// A question about what was said up to an event, with `more` behind it.
    pub(crate) fn key(&self, question: Question, event: Id, more: impl IntoIterator<Item = Event>) -> u64 {
        let said =
            more.into_iter().fold(self.arenas.hash(event), |hash, event| mix(hash, self.content(event)));
        mix(said, question as u64)
    }

    /// The answer to a question that was asked before.
    pub(crate) fn known(&self, key: u64) -> Option<bool> {
        self.context.memo.get(key)
    }

    /// The answer to a question, asked only where it is not known.
    pub(crate) fn answer(&mut self, key: u64, ask: impl FnOnce(&mut Self) -> bool) -> bool {
        if let Some(answer) = self.context.memo.get(key) {
            return answer;
        }
        let answer = ask(self);
        self.context.memo.put(key, answer);
        answer
    }
}
