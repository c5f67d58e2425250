//! The acceptor: the automaton together with the checker, fed byte by byte ([`Acceptor`]) or token by token
//! ([`Decoder`]).
//!
//! [`context`] is shared; [`machine`] runs the automaton and keeps its log of events; [`oracle`] asks the
//! checker what the log means; the other modules each answer one question about the next byte.

mod context;
mod decoder;
mod epsilon;
mod event_log;
mod guard;
mod independence;
mod lookahead;
mod machine;
mod open_node;
mod oracle;
mod proof_cursor;
mod question;
mod safe_condition;
mod scope;
mod step_builder;
mod syntax_node;
mod word;

use std::sync::Arc;

use motet_compiler::Session;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Syntax};

use self::context::{Context, Memo};
pub use self::decoder::Decoder;
use self::machine::Machine;
use crate::automaton::Automaton;
use crate::grammar::Grammar;
use crate::subset::Subset;

/// The shared, immutable part of all acceptors of one session: the automaton, the session, and the memo of
/// the checker's answers. Made once for a robot, a scene and a state. Cloning is cheap, and threads may
/// share it.
#[derive(Clone, Debug)]
pub struct AcceptorFactory(Arc<Context>);

impl AcceptorFactory {
    /// Lowers the grammar of a session's policies. O(declarations × entities).
    #[must_use]
    pub fn new(session: &Session, subset: Subset) -> Self {
        Self::with_verdicts(session, subset, &[])
    }

    /// As [`new`](Self::new), excluding arguments for which a motion query found no motion: `infeasible`
    /// lists pairs of a callable and an entity. Unknown names are ignored.
    #[must_use]
    pub fn with_verdicts(session: &Session, subset: Subset, infeasible: &[(&str, &str)]) -> Self {
        let automaton = Automaton::new(session, &Grammar::new(&session.signatures(), subset));
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

    /// A factory for another session, without verdicts. O(1) if that session came from this one's by
    /// [`Session::elsewhere`] and has the same entities, because the automaton does not depend on facts.
    #[must_use]
    pub fn elsewhere(&self, session: &Session) -> Self {
        let automaton = &self.0.automaton;
        if !Arc::ptr_eq(&automaton.signatures, &session.signatures()) {
            return Self::new(session, automaton.subset);
        }
        let (automaton, session) = (Arc::clone(automaton), session.clone());
        Self(Arc::new(Context { automaton, session, infeasible: Default::default(), memo: Memo::default() }))
    }

    /// An acceptor for a policy of at most `budget` bytes; `None` if no policy is that short.
    #[must_use]
    pub fn acceptor(&self, budget: usize) -> Option<Acceptor> {
        Machine::new(Arc::clone(&self.0), budget).map(|machine| Acceptor { machine, together: Vec::new() })
    }
}

/// Follows a policy byte by byte and knows which bytes may come next, such that the policy can still be
/// completed and will check without an error. One policy, one thread at a time; clone it to branch.
///
/// ```
/// use motet_decode::{AcceptorFactory, Environment, Modifiers, Subset};
/// use motet_syntax::Syntax;
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let subset = Subset { syntax: Syntax::Text, modifiers: Modifiers::Written, ..Subset::default() };
/// let mut acceptor = AcceptorFactory::new(&texts.session()?, subset).acceptor(2000).expect("a policy fits");
/// assert_eq!(acceptor.forced(), b"policy ");
/// let taken = acceptor.accept(b"policy p for hsr { place(mug_1, sink) }");
/// assert_eq!(&acceptor.bytes()[..taken], b"policy p for hsr { p");
/// // Nothing is held that could be placed.
/// assert!(!acceptor.why_not(b"lace(mug_1, sink)").is_empty());
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Acceptor {
    machine: Machine,
    /// The beginnings and ends of bytes that were taken together.
    together: Vec<(usize, usize)>,
}

impl Acceptor {
    /// Takes bytes until one may not follow; returns how many it took.
    pub fn accept(&mut self, bytes: &[u8]) -> usize {
        let begin = self.machine.bytes.len();
        let count = self.machine.take(bytes);
        if count > 1 {
            self.together.push((begin, begin + count));
        }
        count
    }

    /// Takes back the last `count` bytes.
    pub fn forget(&mut self, count: usize) {
        let left = self.machine.bytes.len().saturating_sub(count);
        while self.together.last().is_some_and(|(begin, _)| *begin >= left) {
            self.together.pop();
        }
        // Amid bytes that were taken together not all words were judged.
        let amid = self.together.pop_if(|(_, end)| *end > left).map(|(begin, _)| begin);
        let again = self.machine.bytes.get(amid.unwrap_or(left)..left).unwrap_or_default().to_vec();
        self.machine.pop(self.machine.bytes.len() - amid.unwrap_or(left));
        self.accept(&again);
    }

    /// The bytes that must come next whatever the model means; empty if there is a choice. A host can
    /// append them without asking the model.
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

    /// The checker's errors for the policy so far with `bytes` behind it, closed where it is open. Empty if
    /// the bytes may follow, or if only their spelling is not canonical.
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

    /// The bytes so far are a whole policy.
    #[must_use]
    pub fn is_accepting(&self) -> bool {
        self.machine.is_accepting()
    }

    /// The bytes taken so far.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.machine.bytes
    }

    /// The bytes that may come next, in ascending order.
    pub fn next_bytes(&mut self) -> Vec<u8> {
        let mark = self.machine.mark();
        let (mut found, seen) = (Vec::new(), self.machine.candidate_bytes());
        for byte in 0..=u8::MAX {
            if seen.has(byte) && self.machine.push(byte) {
                self.machine.pop(1);
                found.push(byte);
            }
        }
        // The facts found about the current state stay.
        self.machine.restore(mark);
        found
    }
}

/// Closes the strings, brackets and braces of a policy that breaks off.
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
    let end = closed.trim_end_matches([',', ':', ' ']).len();
    closed.truncate(end);
    closed.extend(open.into_iter().rev());
    closed
}
