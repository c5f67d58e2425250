//! The JSON object in a reply, followed character by character: what stands before it is skipped, and white
//! space that
//! says nothing is left out, so that an indented reply is read like one on a single line.

/// Position in the text of a reply.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Mark {
    /// Outside of the object, or white space between its parts.
    Nothing,
    /// One more character of it.
    Kept,
    /// The same, and it ends a string that began at this byte.
    StringEnd {
        /// Its opening quote.
        from: usize,
    },
    /// The same, and it ends an object or an array that began at this byte.
    Closed {
        /// Its opening brace.
        from: usize,
    },
    /// The same, and it ends a step of the policy's own.
    StepEnd,
    /// The same, and it ends the whole object.
    End,
}

/// Text before the object, reduced to the parts that decide its meaning.
#[derive(Clone, Debug, Default)]
struct Before {
    head: String,
    /// Beginning of the current line.
    line: String,
    /// End of the text, while it is inside a thought.
    tail: String,
    is_thought: bool,
}

const THINKS: &str = "<think>";
const HAS_THOUGHT: &str = "</think>";

impl Before {
    /// Takes a character in. False where it belongs to a thought.
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

/// Follows the object. All offsets are in [`Scan::text`].
#[derive(Clone, Debug, Default)]
pub(super) struct Scan {
    /// The object so far, without white space between its parts.
    pub(super) text: String,
    before: Before,
    /// Open brackets: the closing character and the offset of the opening one.
    open: Vec<(char, usize)>,
    string: Option<usize>,
    is_escaped: bool,
    /// The last string among the object's own keys and values.
    key: String,
    in_steps: bool,
    /// Offset of the steps, after the bracket.
    pub(super) steps_from: Option<usize>,
    is_over: bool,
    /// The reply is in the text form: nothing is followed.
    is_text: bool,
}

impl Scan {
    /// Takes a character.
    pub(super) fn push(&mut self, letter: char) -> Mark {
        if self.is_over || self.is_text {
            return Mark::Nothing;
        }
        if self.open.is_empty() {
            return self.begin(letter);
        }
        if let Some(from) = self.string {
            self.text.push(letter);
            return self.in_string(letter, from);
        }
        if letter.is_ascii_whitespace() {
            return Mark::Nothing;
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
        Mark::Kept
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

    fn begin(&mut self, letter: char) -> Mark {
        if !self.before.push(letter) || letter != '{' {
            return Mark::Nothing;
        }
        if self.before.line.starts_with("policy ") {
            self.is_text = true;
            return Mark::Nothing;
        }
        self.open.push(('}', 0));
        self.text.push(letter);
        Mark::Kept
    }

    fn in_string(&mut self, letter: char, from: usize) -> Mark {
        if std::mem::take(&mut self.is_escaped) {
            return Mark::Kept;
        }
        match letter {
            '\\' => self.is_escaped = true,
            '"' => {
                self.string = None;
                if self.open.len() == 1 {
                    let string = self.text.get(from + 1..self.text.len() - 1);
                    self.key = string.unwrap_or_default().to_owned();
                }
                return Mark::StringEnd { from };
            }
            _ => {}
        }
        Mark::Kept
    }

    fn close(&mut self, letter: char) -> Mark {
        // A bracket that closes something else is left to the reader of JSON.
        let Some((_, from)) = self.open.pop_if(|(closer, _)| *closer == letter) else { return Mark::Kept };
        match self.open.len() {
            0 => {
                self.is_over = true;
                Mark::End
            }
            1 => {
                self.in_steps = false;
                Mark::Closed { from }
            }
            2 if self.in_steps => Mark::StepEnd,
            _ => Mark::Closed { from },
        }
    }
}
