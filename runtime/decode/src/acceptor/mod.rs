//! The acceptor: bytes in, and whether a policy can go on like that.

mod ahead;
mod apart;
mod arena;
mod ask;
mod build;
mod bytes;
mod condition;
mod follow;
mod foresee;
mod mask;
mod memo;
mod number;
mod open;
mod parts;
mod settle;
mod spell;
mod walk;
mod word;

use std::sync::Arc;

use motet_compiler::Session;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Syntax};

pub use self::mask::Decoder;
use self::memo::Memo;
pub(crate) use self::number::Digits;
use self::walk::{Machine, Walk};
use crate::program::Program;
use crate::surface::Surface;

/// What all acceptors of one session share: made once for a robot, a scene and a state.
#[derive(Clone, Debug)]
pub struct Prepared(Arc<Machine>);

impl Prepared {
    /// Compiles the program of a session's policies. O(declarations × entities).
    #[must_use]
    pub fn new(session: &Session, surface: Surface) -> Self {
        Self::with_verdicts(session, surface, &[])
    }

    /// The same, where motion queries found for some callables and entities that there is no motion: such an entity is then
    /// no argument for what the motion of the callable is about. What is not known is left out.
    #[must_use]
    pub fn with_verdicts(session: &Session, surface: Surface, infeasible: &[(&str, &str)]) -> Self {
        let program = Program::new(session, surface);
        let number = |(callable, entity): &(&str, &str)| {
            let signatures = &program.signatures;
            let callable = signatures.callables.iter().position(|known| known.name == *callable)?;
            let entity = signatures.entities.iter().position(|(known, _)| known == *entity)?;
            Some((callable, u16::try_from(entity).ok()?))
        };
        let infeasible = infeasible.iter().filter_map(number).collect();
        let (program, session, memo) = (Arc::new(program), session.clone(), Memo::default());
        Self(Arc::new(Machine { program, session, infeasible, memo }))
    }

    /// The same for another session, without verdicts. O(1) where that came from this one's by [`Session::elsewhere`] and has
    /// the same entities: the program does not depend on what is true.
    #[must_use]
    pub fn elsewhere(&self, session: &Session) -> Self {
        let program = &self.0.program;
        if !Arc::ptr_eq(&program.signatures, &session.signatures()) {
            return Self::new(session, program.surface);
        }
        let (program, session) = (Arc::clone(program), session.clone());
        Self(Arc::new(Machine { program, session, infeasible: Default::default(), memo: Memo::default() }))
    }

    /// An acceptor of a policy of at most `budget` bytes; none where no policy is that short.
    #[must_use]
    pub fn acceptor(&self, budget: usize) -> Option<Acceptor> {
        Walk::new(Arc::clone(&self.0), budget).map(|walk| Acceptor { walk })
    }
}

/// What may follow in a policy that is being written, byte by byte.
#[derive(Clone, Debug)]
pub struct Acceptor {
    walk: Walk,
}

impl Acceptor {
    /// Takes bytes, as many as may follow; how many were taken.
    pub fn accept(&mut self, bytes: &[u8]) -> usize {
        bytes.iter().take_while(|byte| self.walk.push(**byte)).count()
    }

    /// Forgets the last bytes.
    pub fn forget(&mut self, count: usize) {
        self.walk.pop(count);
    }

    /// The bytes that must come next, whatever is meant: none where there is a choice. A host can write them without asking
    /// the model.
    #[must_use]
    pub fn forced(&mut self) -> Vec<u8> {
        let (before, lengths) = (self.walk.bytes.len(), self.walk.lengths());
        while let Some(byte) = self.walk.only_byte() {
            if !self.walk.push(byte) {
                break;
            }
        }
        let forced = self.walk.bytes.get(before..).unwrap_or_default().to_vec();
        self.walk.pop(forced.len());
        self.walk.keep(lengths);
        forced
    }

    /// What the checker says of bytes that may not follow: of the policy so far with them behind it, closed where it is
    /// open. Empty where it is only the spelling that is not the one of the surface, or where they may follow.
    #[must_use]
    pub fn why_not(&self, bytes: &[u8]) -> Vec<Diagnostic> {
        let mut attempt = self.clone();
        let taken = attempt.accept(bytes);
        if taken == bytes.len() {
            return Vec::new();
        }
        let mut text = self.walk.bytes.clone();
        text.extend_from_slice(bytes);
        let form = self.walk.machine.program.surface.form;
        let text = closed(&String::from_utf8_lossy(&text), form);
        let parsed = motet_syntax::read(&Source::new("policy", text), FileId(0));
        let said = self.walk.machine.session.check(&parsed).into_iter();
        said.filter(|said| said.severity == Severity::Error).collect()
    }

    /// Whether the bytes so far are a whole policy.
    #[must_use]
    pub fn is_accepting(&self) -> bool {
        self.walk.is_accepting()
    }

    /// The bytes so far.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.walk.bytes
    }

    /// The bytes that may follow next.
    pub fn next_bytes(&mut self) -> Vec<u8> {
        let lengths = self.walk.lengths();
        let (mut found, seen) = (Vec::new(), self.walk.seen_bytes());
        for byte in 0..=u8::MAX {
            if seen.has(byte) && self.walk.push(byte) {
                self.walk.pop(1);
                found.push(byte);
            }
        }
        // What the state itself was found to allow stays.
        self.walk.keep(lengths);
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
    let kept = closed.trim_end_matches([',', ':', ' ']).len();
    closed.truncate(kept);
    closed.extend(open.into_iter().rev());
    closed
}
