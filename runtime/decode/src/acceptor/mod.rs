//! The acceptor: bytes in, and whether a policy can go on like that.

mod batch_probe;
mod byte_set;
mod decoder;
mod digits;
mod epsilon;
mod event_log;
mod guard;
mod independence;
mod lexeme;
mod lookahead;
mod machine;
mod memo;
mod oracle;
mod placeholder;
mod proof_cursor;
mod safe_condition;
mod step_builder;
mod word;

use std::sync::Arc;

use motet_compiler::Session;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Syntax};

pub use self::decoder::Decoder;
pub(crate) use self::digits::Digits;
use self::machine::{Context, Machine};
use self::memo::Memo;
use crate::automaton::Automaton;
use crate::subset::Subset;

/// What all acceptors of one session share: made once for a robot, a scene and a state.
#[derive(Clone, Debug)]
pub struct AcceptorFactory(Arc<Context>);

impl AcceptorFactory {
    /// Compiles the automaton of a session's policies. O(declarations × entities).
    #[must_use]
    pub fn new(session: &Session, subset: Subset) -> Self {
        Self::with_verdicts(session, subset, &[])
    }

    /// The same, where motion queries found for some callables and entities that there is no motion: such an entity is then
    /// no argument for what the motion of the callable is about. What is not known is left out.
    #[must_use]
    pub fn with_verdicts(session: &Session, subset: Subset, infeasible: &[(&str, &str)]) -> Self {
        let automaton = Automaton::new(session, subset);
        let number = |(callable, entity): &(&str, &str)| {
            let signatures = &automaton.signatures;
            let callable = signatures.callables.iter().position(|known| known.name == *callable)?;
            let entity = signatures.entities.iter().position(|(known, _)| known == *entity)?;
            Some((callable, u16::try_from(entity).ok()?))
        };
        let infeasible = infeasible.iter().filter_map(number).collect();
        let (automaton, session, memo) = (Arc::new(automaton), session.clone(), Memo::default());
        Self(Arc::new(Context { automaton, session, infeasible, memo }))
    }

    /// The same for another session, without verdicts. O(1) where that came from this one's by [`Session::elsewhere`] and has
    /// the same entities: the automaton does not depend on what is true.
    #[must_use]
    pub fn elsewhere(&self, session: &Session) -> Self {
        let automaton = &self.0.automaton;
        if !Arc::ptr_eq(&automaton.signatures, &session.signatures()) {
            return Self::new(session, automaton.subset);
        }
        let (automaton, session) = (Arc::clone(automaton), session.clone());
        Self(Arc::new(Context { automaton, session, infeasible: Default::default(), memo: Memo::default() }))
    }

    /// An acceptor of a policy of at most `budget` bytes; none where no policy is that short.
    #[must_use]
    pub fn acceptor(&self, budget: usize) -> Option<Acceptor> {
        Machine::new(Arc::clone(&self.0), budget).map(|machine| Acceptor { machine })
    }
}

/// What may follow in a policy that is being written, byte by byte.
#[derive(Clone, Debug)]
pub struct Acceptor {
    machine: Machine,
}

impl Acceptor {
    /// Takes bytes, as many as may follow; how many were taken.
    pub fn accept(&mut self, bytes: &[u8]) -> usize {
        bytes.iter().take_while(|byte| self.machine.push(**byte)).count()
    }

    /// Forgets the last bytes.
    pub fn forget(&mut self, count: usize) {
        self.machine.pop(count);
    }

    /// The bytes that must come next, whatever is meant: none where there is a choice. A host can write them without asking
    /// the model.
    #[must_use]
    pub fn forced(&mut self) -> Vec<u8> {
        let (before, mark) = (self.machine.bytes.len(), self.machine.mark());
        while let Some(byte) = self.machine.only_byte() {
            if !self.machine.push(byte) {
                break;
            }
        }
        let forced = self.machine.bytes.get(before..).unwrap_or_default().to_vec();
        self.machine.pop(forced.len());
        self.machine.restore(mark);
        forced
    }

    /// What the checker says of bytes that may not follow: of the policy so far with them behind it, closed where it is
    /// open. Empty where it is only the spelling that is not the one of the subset, or where they may follow.
    #[must_use]
    pub fn why_not(&self, bytes: &[u8]) -> Vec<Diagnostic> {
        let mut attempt = self.clone();
        let taken = attempt.accept(bytes);
        if taken == bytes.len() {
            return Vec::new();
        }
        let mut text = self.machine.bytes.clone();
        text.extend_from_slice(bytes);
        let form = self.machine.context.automaton.subset.syntax;
        let text = closed(&String::from_utf8_lossy(&text), form);
        let parsed = motet_syntax::read(&Source::new("policy", text), FileId(0));
        let diagnostics = self.machine.context.session.check(&parsed).into_iter();
        diagnostics.filter(|diagnostic| diagnostic.severity == Severity::Error).collect()
    }

    /// Whether the bytes so far are a whole policy.
    #[must_use]
    pub fn is_accepting(&self) -> bool {
        self.machine.is_accepting()
    }

    /// The bytes so far.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.machine.bytes
    }

    /// The bytes that may follow next.
    pub fn next_bytes(&mut self) -> Vec<u8> {
        let mark = self.machine.mark();
        let (mut found, seen) = (Vec::new(), self.machine.candidate_bytes());
        for byte in 0..=u8::MAX {
            if seen.has(byte) && self.machine.push(byte) {
                self.machine.pop(1);
                found.push(byte);
            }
        }
        // What the state itself was found to allow stays.
        self.machine.restore(mark);
        found
    }
}

/// A policy that breaks off, with its strings, brackets and braces closed.
fn closed(text: &str, form: Syntax) -> String {
    let (mut open, mut in_string, mut escaped) = (Vec::new(), false, false);
    for character in text.chars() {
        match character {
            _ if escaped => escaped = false,
            '\\' if in_string => escaped = true,
            '"' => in_string = !in_string,
            _ if in_string => {}
            '{' => open.push('}'),
            '[' => open.push(']'),
            '(' if form == Syntax::Text => open.push(')'),
            ')' if form == Syntax::Json => {}
            '}' | ']' | ')' => {
                open.pop();
            }
            _ => {}
        }
    }
    let mut closed = text.to_owned();
    if in_string {
        closed.push('"');
    }
    // A key or a comma at the end leads nowhere.
    let state_mut = closed.trim_end_matches([',', ':', ' ']).len();
    closed.truncate(state_mut);
    closed.extend(open.into_iter().rev());
    closed
}
