//! Reader of a reply as it arrives, which tells the first error at once.
//!
//! While the reply stays in the canonical subset, the acceptor follows it byte by byte. After it leaves the
//! subset, it may be wrong or only spelt differently: the checker decides as soon as the surrounding value
//! or object is complete. Each top-level step is checked with the steps before it as soon as it is complete,
//! motions included. A mistake with a known fix is no error here.

use std::borrow::Cow;

use motet_compiler::Session;
use motet_decode::Acceptor;
use motet_syntax::Diagnostic;

use crate::reply_verdict::{errors, mend, read};

/// End of an incomplete policy during a check: no goal is missed and nothing is left undone.
const UNFINISHED: &str = r#"{"end":"fail","why":"unfinished"}"#;

/// Steps whose body may run again, or beside another.
const COMING_BACK: &[&str] = &["\"repeat\"", "\"each\"", "\"react\"", "\"parallel\""];

/// A reply that is being read.
#[derive(Debug)]
pub struct StreamReader<'s> {
    session: Cow<'s, Session>,
    /// Acceptor, while the reply stays in the canonical subset.
    acceptor: Option<Acceptor>,
    scan: Scanner,
    reply: String,
    /// Place where the reply left the canonical subset, until the reason is known.
    suspect: Option<Suspect>,
    steps: usize,
    /// Offset of the current step in the scanned text.
    step_from: usize,
    /// Offset of the first step's end.
    first_to: Option<usize>,
    /// False after the first error: the rest is only read.
    is_checked: bool,
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
    /// No error so far.
    GoOn,
    /// No error so far, and this many top-level steps are complete and checked.
    Steps(usize),
    /// The policy is complete; any further text is ignored.
    Whole,
    /// The reply is wrong, whatever follows.
    Wrong(ReplyMistake),
}

/// First error of a reply.
#[derive(Clone, PartialEq, Debug)]
pub struct ReplyMistake {
    /// First wrong byte of the reply.
    pub at: usize,
    /// Errors at that place.
    pub findings: Vec<Diagnostic>,
}

impl<'s> StreamReader<'s> {
    /// Starts to read a reply, with the session's acceptor or none.
    #[must_use]
    pub fn new(session: &'s Session, acceptor: Option<Acceptor>) -> Self {
        let (scan, reply) = (Scanner::default(), String::new());
        Self {
            session: Cow::Borrowed(session),
            acceptor,
            scan,
            reply,
            suspect: None,
            steps: 0,
            step_from: 0,
            first_to: None,
            is_checked: true,
        }
    }

    /// Starts to read a reply that is judged as a whole, once it is complete.
    #[must_use]
    pub fn unchecked(session: &'s Session) -> Self {
        Self { is_checked: false, ..Self::new(session, None) }
    }

    /// The same reader with its own copy of the session.
    #[must_use]
    pub fn into_owned(self) -> StreamReader<'static> {
        let session = Cow::Owned(self.session.into_owned());
        let Self { acceptor, scan, reply, suspect, steps, step_from, first_to, is_checked, .. } = self;
        StreamReader { session, acceptor, scan, reply, suspect, steps, step_from, first_to, is_checked }
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

    /// The policy so far, on one line; empty if the reply is in the text syntax.
    #[must_use]
    pub fn policy(&self) -> &str {
        &self.scan.text
    }

    /// True if the policy is complete; any further text is ignored.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.scan.is_over
    }

    /// Takes a piece of the reply. What follows the policy is ignored. An error is told once; behind it the
    /// reply is only read.
    pub fn push(&mut self, piece: &str) -> StreamVerdict {
        let mut verdict = StreamVerdict::GoOn;
        for letter in piece.chars() {
            let at = self.reply.len();
            self.reply.push(letter);
            let mark = self.scan.push(letter);
            if mark == CharEffect::Nothing {
                self.suspect = self.suspect.take_if(|_| !self.scan.text.is_empty());
                continue;
            }
            self.follow(letter, at);
            match self.judge(mark) {
                StreamVerdict::GoOn => {}
                StreamVerdict::Steps(steps) => verdict = StreamVerdict::Steps(steps),
                StreamVerdict::Whole if matches!(verdict, StreamVerdict::Wrong(_)) => return verdict,
                StreamVerdict::Whole => return StreamVerdict::Whole,
                wrong @ StreamVerdict::Wrong(_) => (verdict, self.is_checked) = (wrong, false),
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

    fn judge(&mut self, mark: CharEffect) -> StreamVerdict {
        match mark {
            CharEffect::End => StreamVerdict::Whole,
            _ if !self.is_checked => StreamVerdict::GoOn,
            CharEffect::Nothing | CharEffect::Kept => StreamVerdict::GoOn,
            CharEffect::StepEnd => self.step(),
            CharEffect::StringEnd { from } => match self.suspect {
                Some(suspect) if suspect.string == Some(from) => self.ask(suspect, from),
                _ => StreamVerdict::GoOn,
            },
            CharEffect::Closed { from } => match self.suspect {
                Some(suspect) if suspect.object == from => {
                    let verdict = self.ask(suspect, from);
                    self.suspect = None;
                    verdict
                }
                _ => StreamVerdict::GoOn,
            },
        }
    }

    /// Asks the checker about the value that began at `from` and is complete now. Errors elsewhere come from
    /// the missing rest and are ignored.
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
        StreamVerdict::Wrong(ReplyMistake { at: suspect.at, findings: found })
    }

    /// The policy so far with all open brackets closed; `None` without steps.
    fn closed(&self) -> String {
        let (text, closers) = (&self.scan.text, self.scan.closers());
        match closers.strip_suffix('}') {
            Some(inner) if self.scan.steps_from.is_none() => {
                format!(r#"{text}{inner},"steps":[{UNFINISHED}]}}"#)
            }
            _ => format!("{text}{closers}"),
        }
    }

    /// Checks a complete step with the steps before it.
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
        StreamVerdict::Wrong(ReplyMistake { at, findings: found })
    }

    /// Byte of the reply that became a byte of the scanned text. O(reply).
    fn in_reply(&self, byte: usize) -> usize {
        let mut scan = Scanner::default();
        for (at, letter) in self.reply.char_indices() {
            if scan.push(letter) != CharEffect::Nothing && scan.text.len() > byte {
                return at;
            }
        }
        self.reply.len()
    }
}

/// Effect of one character of a reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum CharEffect {
    /// Outside of the object, or white space between its parts.
    Nothing,
    /// One more character of the object.
    Kept,
    /// End of a string that began at this byte.
    StringEnd {
        /// Offset of the opening quote.
        from: usize,
    },
    /// End of an object or an array that began at this byte.
    Closed {
        /// Offset of the opening bracket.
        from: usize,
    },
    /// End of a top-level step.
    StepEnd,
    /// End of the whole object.
    End,
}

/// Text before the object, reduced to the parts that decide its meaning.
#[derive(Clone, Debug, Default)]
struct Preamble {
    head: String,
    /// Beginning of the current line.
    line: String,
    /// End of the text, while it is inside a thought.
    tail: String,
    is_thought: bool,
}

const THINKS: &str = "<think>";
const HAS_THOUGHT: &str = "</think>";

impl Preamble {
    /// Takes a character. Returns `false` inside a thought.
    fn push(&mut self, letter: char) -> bool {
        if self.is_thought {
            self.tail.push(letter);
            if !HAS_THOUGHT.starts_with(&self.tail) {
                self.tail.clear();
                self.tail.extend((letter == '<').then_some(letter));
            }
            self.is_thought = self.tail != HAS_THOUGHT;
            return false;
        }
        if self.head.len() < THINKS.len() && !(self.head.is_empty() && letter.is_whitespace()) {
            self.head.push(letter);
            self.is_thought = self.head == THINKS;
        }
        if letter == '\n' {
            self.line.clear();
        } else if self.line.len() < 16 && !(self.line.is_empty() && letter.is_whitespace()) {
            self.line.push(letter);
        }
        true
    }
}

/// Scanner of the object. All offsets are in [`Scanner::text`].
#[derive(Clone, Debug, Default)]
pub(super) struct Scanner {
    /// The object so far, without white space between its parts.
    pub(super) text: String,
    before: Preamble,
    /// Open brackets: the closing character and the offset of the opening one.
    open: Vec<(char, usize)>,
    string: Option<usize>,
    is_escaped: bool,
    /// The last string among the object's own keys and values.
    key: String,
    in_steps: bool,
    /// Is `true` if one of those strings is a key that only a policy has.
    is_policy: bool,
    /// Offset of the steps, after the bracket.
    pub(super) steps_from: Option<usize>,
    is_over: bool,
    /// Is `true` behind the bracket of a list.
    in_list: bool,
    /// Is `true` if the reply is in the text syntax or a list of steps, which are not scanned.
    is_text: bool,
}

impl Scanner {
    /// Takes a character.
    pub(super) fn push(&mut self, letter: char) -> CharEffect {
        if self.is_over || self.is_text {
            return CharEffect::Nothing;
        }
        if self.open.is_empty() {
            return self.begin(letter);
        }
        if let Some(from) = self.string {
            self.text.push(letter);
            return self.in_string(letter, from);
        }
        if letter.is_ascii_whitespace() {
            return CharEffect::Nothing;
        }
        let at = self.text.len();
        self.text.push(letter);
        match letter {
            '"' => self.string = Some(at),
            '{' => self.open.push(('}', at)),
            '[' => {
                if self.open.len() == 1 && self.key == "steps" {
                    (self.in_steps, self.steps_from) = (true, Some(at + 1));
                }
                self.open.push((']', at));
            }
            '}' | ']' => return self.close(letter),
            _ => {}
        }
        CharEffect::Kept
    }

    /// Text that would close everything open.
    pub(super) fn closers(&self) -> String {
        self.open.iter().rev().map(|(closer, _)| *closer).collect()
    }

    /// Offset of the innermost open bracket.
    pub(super) fn innermost(&self) -> usize {
        self.open.last().map_or(0, |(_, from)| *from)
    }

    /// Offset of the open string.
    pub(super) fn string_from(&self) -> Option<usize> {
        self.string
    }

    fn begin(&mut self, letter: char) -> CharEffect {
        if !self.before.push(letter) || letter != '{' {
            self.in_list = letter == '[' || self.in_list && letter.is_whitespace();
            return CharEffect::Nothing;
        }
        if self.in_list || self.before.line.starts_with("policy ") {
            self.is_text = true;
            return CharEffect::Nothing;
        }
        self.open.push(('}', 0));
        self.text.push(letter);
        CharEffect::Kept
    }

    fn in_string(&mut self, letter: char, from: usize) -> CharEffect {
        if std::mem::take(&mut self.is_escaped) {
            return CharEffect::Kept;
        }
        match letter {
            '\\' => self.is_escaped = true,
            '"' => {
                self.string = None;
                if self.open.len() == 1 {
                    let string = self.text.get(from + 1..self.text.len() - 1);
                    self.key = string.unwrap_or_default().to_owned();
                    self.is_policy |= matches!(self.key.as_str(), "motet" | "policy");
                }
                return CharEffect::StringEnd { from };
            }
            _ => {}
        }
        CharEffect::Kept
    }

    fn close(&mut self, letter: char) -> CharEffect {
        // A bracket that closes something else is left to the reader of JSON.
        let Some((_, from)) = self.open.pop_if(|(closer, _)| *closer == letter) else {
            return CharEffect::Kept;
        };
        match self.open.len() {
            // An object in the prose before the policy, or a step alone.
            0 if self.steps_from.is_none() || !self.is_policy => {
                *self = Self { before: std::mem::take(&mut self.before), ..Self::default() };
                CharEffect::Nothing
            }
            0 => {
                self.is_over = true;
                CharEffect::End
            }
            1 => {
                self.in_steps = false;
                CharEffect::Closed { from }
            }
            2 if self.in_steps => CharEffect::StepEnd,
            _ => CharEffect::Closed { from },
        }
    }
}
