//! The tokens of JSON: strings, numbers and the three words. [`super::parse`] puts them together.

use std::borrow::Cow;

use super::tree::{Kind, Number};
use crate::diagnostic::Diagnostic;
use crate::errors::{JsonSyntax, NumberRange, SyntaxFault};
use crate::source::{FileId, Span};

/// A position in a document.
pub(crate) struct Scanner<'s> {
    text: &'s str,
    bytes: &'s [u8],
    file: FileId,
    /// Offset of the next byte.
    pub(crate) at: usize,
}

type Token<T> = Result<T, Box<Diagnostic>>;

impl<'s> Scanner<'s> {
    pub(crate) fn new(text: &'s str, file: FileId) -> Self {
        Self { text, bytes: text.as_bytes(), file, at: 0 }
    }

    /// The next byte.
    #[inline]
    pub(crate) fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Steps over white space.
    #[inline]
    pub(crate) fn skip_space(&mut self) {
        while let Some(b' ' | b'\n' | b'\r' | b'\t') = self.peek() {
            self.at += 1;
        }
    }

    /// A fault of the character that comes next.
    #[cold]
    pub(crate) fn fault(&self, fault: SyntaxFault) -> Box<Diagnostic> {
        let rest = self.text.get(self.at..).unwrap_or("");
        if let Some(mark) = ["//", "/*", "#"].into_iter().find(|mark| rest.starts_with(mark)) {
            return self.fault_at(self.at, self.at + mark.len(), SyntaxFault::Comment);
        }
        let length = rest.chars().next().map_or(0, char::len_utf8);
        self.fault_at(self.at, self.at + length, fault)
    }

    /// A fault of a range of bytes.
    #[cold]
    pub(crate) fn fault_at(&self, start: usize, end: usize, fault: SyntaxFault) -> Box<Diagnostic> {
        Box::new(JsonSyntax { span: Span::new(self.file, start, end), fault }.into())
    }

    /// A string, from its opening quote over its closing one.
    #[inline(always)]
    pub(crate) fn string(&mut self) -> Token<Cow<'s, str>> {
        let quote = self.at;
        let start = quote + 1;
        let rest = self.bytes.get(start..).unwrap_or_default();
        self.at = start + plain(rest);
        match self.peek() {
            Some(b'"') => {
                let text = self.text.get(start..self.at).unwrap_or("");
                self.at += 1;
                Ok(Cow::Borrowed(text))
            }
            Some(b'\\') => self.escaped(quote, start).map(Cow::Owned),
            Some(_) => Err(self.control(quote)),
            None => Err(self.fault_at(quote, self.at, SyntaxFault::OpenText)),
        }
    }

    /// The rest of a string whose first escape is next.
    #[cold]
    fn escaped(&mut self, quote: usize, start: usize) -> Token<String> {
        let mut text = String::from(self.text.get(start..self.at).unwrap_or(""));
        let mut plain = self.at;
        loop {
            match self.peek() {
                Some(b'"') => {
                    text.push_str(self.text.get(plain..self.at).unwrap_or(""));
                    self.at += 1;
                    return Ok(text);
                }
                Some(b'\\') => {
                    text.push_str(self.text.get(plain..self.at).unwrap_or(""));
                    text.push(self.escape()?);
                    plain = self.at;
                }
                Some(0..=0x1f) => return Err(self.control(quote)),
                Some(_) => self.at += 1,
                None => return Err(self.fault_at(quote, self.at, SyntaxFault::OpenText)),
            }
        }
    }

    #[cold]
    fn control(&self, quote: usize) -> Box<Diagnostic> {
        match self.peek() {
            Some(b'\n' | b'\r') => self.fault_at(quote, self.at, SyntaxFault::OpenText),
            Some(byte) => self.fault(SyntaxFault::Control(byte)),
            None => self.fault(SyntaxFault::OpenText),
        }
    }

    /// One escape, from its backslash.
    fn escape(&mut self) -> Token<char> {
        let start = self.at;
        let letter = self.bytes.get(start + 1).copied();
        self.at += 2;
        match letter {
            Some(b'"') => Ok('"'),
            Some(b'\\') => Ok('\\'),
            Some(b'/') => Ok('/'),
            Some(b'b') => Ok('\u{8}'),
            Some(b'f') => Ok('\u{c}'),
            Some(b'n') => Ok('\n'),
            Some(b'r') => Ok('\r'),
            Some(b't') => Ok('\t'),
            Some(b'u') => self.unicode(start),
            Some(_) | None => {
                let length =
                    self.text.get(start + 1..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
                Err(self.fault_at(start, start + 1 + length, SyntaxFault::Escape))
            }
        }
    }

    /// The digits of `\u`, and of the second half of a surrogate pair.
    fn unicode(&mut self, start: usize) -> Token<char> {
        let first = self.hex(start)?;
        let code =
            if (0xd800..0xdc00).contains(&first) && self.bytes.get(self.at..self.at + 2) == Some(b"\\u") {
                let second_start = self.at;
                self.at += 2;
                let second = self.hex(second_start)?;
                if (0xdc00..0xe000).contains(&second) {
                    0x10000 + ((first - 0xd800) << 10) + (second - 0xdc00)
                } else {
                    first
                }
            } else {
                first
            };
        char::from_u32(code).ok_or_else(|| self.fault_at(start, self.at, SyntaxFault::LoneSurrogate))
    }

    fn hex(&mut self, start: usize) -> Token<u32> {
        let digits =
            self.text.get(self.at..self.at + 4).filter(|four| four.bytes().all(|b| b.is_ascii_hexdigit()));
        match digits.and_then(|four| u32::from_str_radix(four, 16).ok()) {
            Some(code) => {
                self.at += 4;
                Ok(code)
            }
            None => Err(self.fault_at(start, self.at, SyntaxFault::Escape)),
        }
    }

    /// A number, by the letter of JSON: no leading `+`, `.` or `0`.
    pub(crate) fn number(&mut self) -> Token<Number> {
        let start = self.at;
        let negative = self.peek() == Some(b'-');
        if negative {
            self.at += 1;
        }
        let whole = self.digits();
        let leading_zero = whole > 1 && self.bytes.get(self.at - whole) == Some(&b'0');
        let mut is_whole = true;
        let mut malformed = whole == 0 || leading_zero;
        if self.peek() == Some(b'.') {
            self.at += 1;
            is_whole = false;
            malformed |= self.digits() == 0;
        }
        if let Some(b'e' | b'E') = self.peek() {
            self.at += 1;
            is_whole = false;
            if let Some(b'+' | b'-') = self.peek() {
                self.at += 1;
            }
            malformed |= self.digits() == 0;
        }
        if malformed {
            return Err(self.fault_at(start, self.at, SyntaxFault::Number));
        }
        let text = self.text.get(start..self.at).unwrap_or("0");
        if is_whole
            && !negative
            && let Ok(value) = text.parse::<u64>()
        {
            return Ok(Number::Unsigned(value));
        }
        if is_whole
            && negative
            && let Ok(value @ ..0) = text.parse::<i64>()
        {
            return Ok(Number::Signed(value));
        }
        let value = text.parse::<f64>().unwrap_or(f64::INFINITY);
        if !value.is_finite() {
            let span = Span::new(self.file, start, self.at);
            return Err(Box::new(NumberRange { span, found: text.into(), expected: None }.into()));
        }
        Ok(Number::of(value))
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while let Some(b'0'..=b'9') = self.peek() {
            self.at += 1;
        }
        self.at - start
    }

    /// `true`, `false` or `null`.
    pub(crate) fn word(&mut self) -> Token<Kind<'s>> {
        let start = self.at;
        while self.peek().is_some_and(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
            self.at += 1;
        }
        let word = self.text.get(start..self.at).unwrap_or("");
        match word {
            "true" => Ok(Kind::Bool(true)),
            "false" => Ok(Kind::Bool(false)),
            "null" => Ok(Kind::Null),
            "" => Err(self.fault(SyntaxFault::NoValue)),
            _ => Err(self.fault_at(start, self.at, SyntaxFault::Word(word.into()))),
        }
    }
}

/// How many bytes come before the first quote, backslash or control character, eight at a time. Subtracting from each byte
/// of a word borrows only from bytes above one that is found, and the lowest one found counts (Mycroft's test for a zero
/// byte: x - 1 & !x has the high bit).
#[inline]
fn plain(bytes: &[u8]) -> usize {
    const LOW: u64 = u64::MAX / 255;
    const HIGH: u64 = LOW << 7;
    let (words, rest) = bytes.as_chunks::<8>();
    for (index, word) in words.iter().enumerate() {
        let word = u64::from_le_bytes(*word);
        let control = word.wrapping_sub(LOW * 0x20) & !word;
        let (quote, backslash) = (word ^ (LOW * u64::from(b'"')), word ^ (LOW * u64::from(b'\\')));
        let marks = (quote.wrapping_sub(LOW) & !quote) | (backslash.wrapping_sub(LOW) & !backslash);
        let found = (control | marks) & HIGH;
        if found != 0 {
            return index * 8 + found.trailing_zeros() as usize / 8;
        }
    }
    let is_special = |byte: &u8| matches!(byte, b'"' | b'\\' | 0..=0x1f);
    words.len() * 8 + rest.iter().position(is_special).unwrap_or(rest.len())
}
