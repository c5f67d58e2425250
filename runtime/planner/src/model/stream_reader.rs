//! A reply that is read as it arrives, and stopped where it is wrong.
//!
//! As long as it is written like the model surface the acceptor follows it byte by byte. Where it leaves
//! the surface it may
//! be wrong, or only spelt otherwise: the checker is asked as soon as the value, or else the object, is
//! complete in which
//! that happened. Each step of the policy's own is checked with the steps before it once it is complete,
//! motions included.
//! What a known fix mends is no reason to stop.

use std::borrow::Cow;

use motet_compiler::Session;
use motet_decode::Acceptor;
use motet_syntax::Diagnostic;

use super::reply_verdict::{errors, mend, read};
use super::scanner::{Mark, Scan};

/// Behind the steps so far, where a policy is checked that is not complete: what it leaves undone is not
/// held against it.
const UNFINISHED: &str = r#"{"end":"fail","why":"unfinished"}"#;

/// Steps whose body may run again, or beside another.
const COMING_BACK: &[&str] = &["\"repeat\"", "\"each\"", "\"react\"", "\"parallel\""];

/// A reply that is being read.
#[derive(Debug)]
pub struct StreamReader<'s> {
    session: Cow<'s, Session>,
    /// As long as the reply keeps to the model surface.
    acceptor: Option<Acceptor>,
    scan: Scan,
    reply: String,
    /// Place where the reply left the canonical subset, until the reason is known.
    suspect: Option<Suspect>,
    steps: usize,
    /// Offset of the current step in the scanned text.
    step_from: usize,
    /// Offset of the first step's end.
    first_to: Option<usize>,
}

/// Place where a reply left the canonical subset.
#[derive(Clone, Copy, Debug)]
struct Suspect {
    /// Byte of the reply.
    at: usize,
    /// Offset of the surrounding string in the scanned text, if there is one.
    string: Option<usize>,
    /// Offset of the innermost surrounding object or array.
    object: usize,
}

/// State of a reply after one more piece.
#[derive(Clone, PartialEq, Debug)]
pub enum StreamVerdict {
    /// Nothing speaks against it so far.
    GoOn,
    /// The same, and this many of its steps are complete and checked.
    Steps(usize),
    /// Its policy is complete; what may follow it says nothing.
    Whole,
    /// It is wrong whatever follows.
    Wrong(Wrong),
}

/// Reason to stop a reply.
#[derive(Clone, PartialEq, Debug)]
pub struct Wrong {
    /// The first byte of the reply that is wrong.
    pub at: usize,
    /// Errors that stopped the reply.
    pub findings: Vec<Diagnostic>,
}

impl<'s> StreamReader<'s> {
    /// Begins to read a reply: the acceptor is that of the session, or none.
    #[must_use]
    pub fn new(session: &'s Session, acceptor: Option<Acceptor>) -> Self {
        let (scan, reply) = (Scan::default(), String::new());
        Self {
            session: Cow::Borrowed(session),
            acceptor,
            scan,
            reply,
            suspect: None,
            steps: 0,
            step_from: 0,
            first_to: None,
        }
    }

    /// The same with a session of its own. Costs a copy of the session.
    #[must_use]
    pub fn into_owned(self) -> StreamReader<'static> {
        let session = Cow::Owned(self.session.into_owned());
        let Self { acceptor, scan, reply, suspect, steps, step_from, first_to, .. } = self;
        StreamReader { session, acceptor, scan, reply, suspect, steps, step_from, first_to }
    }

    /// The policy with its first step only, once that is complete.
    #[must_use]
    pub fn first(&self) -> Option<String> {
        let written = self.scan.text.get(..self.first_to?)?;
        Some(format!("{written}]}}"))
    }

    /// Text so far, including everything around the policy.
    #[must_use]
    pub fn reply(&self) -> &str {
        &self.reply
    }

    /// The policy as far as it has come, on one line; empty where the reply is in the text form.
    #[must_use]
    pub fn policy(&self) -> &str {
        &self.scan.text
    }

    /// Takes a piece in. What stands in it behind a verdict that ends the reading is not read.
    pub fn push(&mut self, piece: &str) -> StreamVerdict {
        let mut verdict = StreamVerdict::GoOn;
        for letter in piece.chars() {
            let at = self.reply.len();
            self.reply.push(letter);
            let mark = self.scan.push(letter);
            if mark == Mark::Nothing {
                continue;
            }
            self.follow(letter, at);
            match self.judge(mark) {
                StreamVerdict::GoOn => {}
                StreamVerdict::Steps(steps) => verdict = StreamVerdict::Steps(steps),
                end @ (StreamVerdict::Whole | StreamVerdict::Wrong(_)) => return end,
            }
        }
        verdict
    }

    fn follow(&mut self, letter: char, at: usize) {
        let Some(acceptor) = &mut self.acceptor else { return };
        let mut buffer = [0; 4];
        let bytes = letter.encode_utf8(&mut buffer).as_bytes();
        if acceptor.accept(bytes) < bytes.len() {
            let string = self.scan.string_from().filter(|from| from + 1 < self.scan.text.len());
            self.suspect = Some(Suspect { at, string, object: self.scan.innermost() });
            self.acceptor = None;
        }
    }

    fn judge(&mut self, mark: Mark) -> StreamVerdict {
        match mark {
            Mark::Nothing | Mark::Kept => StreamVerdict::GoOn,
            Mark::End => StreamVerdict::Whole,
            Mark::StepEnd => self.step(),
            Mark::StringEnd { from } => match self.suspect {
                Some(suspect) if suspect.string == Some(from) => self.ask(suspect, from),
                _ => StreamVerdict::GoOn,
            },
            Mark::Closed { from } => match self.suspect {
                Some(suspect) if suspect.object == from => {
                    let verdict = self.ask(suspect, from);
                    self.suspect = None;
                    verdict
                }
                _ => StreamVerdict::GoOn,
            },
        }
    }

    /// Asks the checker about what began at `from` and is complete now. What is found elsewhere is found
    /// because the rest
    /// is missing.
    fn ask(&mut self, suspect: Suspect, from: usize) -> StreamVerdict {
        let text = self.closed();
        let to = self.scan.text.len();
        let inside = |said: &Diagnostic| said.span.start as usize >= from && said.span.end as usize <= to;
        let parsed = read(&text);
        // What comes back to its beginning may be refuted there by what is missing at its end.
        let so_far = self.scan.text.get(self.step_from..).unwrap_or_default();
        let comes_back = COMING_BACK.iter().any(|key| so_far.contains(key));
        let mut found =
            errors(if comes_back { self.session.check_names(&parsed) } else { self.session.check(&parsed) });
        found.retain(inside);
        if found.is_empty() || found.iter().any(|said| said.fix.is_some()) {
            return StreamVerdict::GoOn;
        }
        StreamVerdict::Wrong(Wrong { at: suspect.at, findings: found })
    }

    /// The policy so far with all that is open closed. Of one without steps nothing would be said.
    fn closed(&self) -> String {
        let (text, closers) = (&self.scan.text, self.scan.closers());
        match closers.strip_suffix('}') {
            Some(inner) if self.scan.steps_from.is_none() => {
                format!(r#"{text}{inner},"steps":[{UNFINISHED}]}}"#)
            }
            _ => format!("{text}{closers}"),
        }
    }

    /// A step is complete: it is checked with those before it.
    fn step(&mut self) -> StreamVerdict {
        self.steps += 1;
        let to = self.scan.text.len();
        // The acceptor asked the same of the step as it was written, motions aside.
        if self.acceptor.is_some() && !self.session.has_geometry() {
            self.step_from = to;
            self.first_to.get_or_insert(to);
            return StreamVerdict::Steps(self.steps);
        }
        let text = format!("{},{UNFINISHED}{}", self.scan.text, self.scan.closers());
        let mut found = errors(self.session.check(&read(&text)));
        found.retain(|said| said.span.end as usize <= to);
        self.step_from = to;
        self.first_to.get_or_insert(to);
        let suspect = self.suspect.take();
        if found.is_empty() || mend(&self.session, &text).is_some() {
            return StreamVerdict::Steps(self.steps);
        }
        let first = found.iter().map(|said| said.span.start as usize).min().unwrap_or(to);
        let at = suspect.map_or_else(|| self.in_reply(first), |suspect| suspect.at);
        StreamVerdict::Wrong(Wrong { at, findings: found })
    }

    /// The byte of the reply at which a byte of the scanned text stood. O(reply).
    fn in_reply(&self, byte: usize) -> usize {
        let mut scan = Scan::default();
        for (at, letter) in self.reply.char_indices() {
            if scan.push(letter) != Mark::Nothing && scan.text.len() > byte {
                return at;
            }
        }
        self.reply.len()
    }
}
