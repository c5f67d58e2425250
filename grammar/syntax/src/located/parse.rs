//! Parser of JSON (RFC 8259) into a [`Located`] tree. One syntax error ends it; a duplicate key is reported,
//! and the first of its values counts. It is our own because no library tells apart the mistakes that
//! language models make (`None`, comments, single quotes, cut documents) with their ranges and under limits
//! on depth and size.

use std::borrow::Cow;

use rustc_hash::FxHashSet;

use super::{Located, LocatedValue, Number};
use crate::ast::{MAX_MISTAKES, MAX_NESTING, MAX_TOKENS};
use crate::diagnostic::Diagnostic;
use crate::diagnostics::{DuplicateKey, JsonSyntax, NumberRange, SyntaxFault, TooDeep, TooManyTokens};
use crate::source::{FileId, Span};

/// Greatest depth of brackets in a JSON document. One block of a policy takes up to four: the handlers of a
/// `try` are an object in an array in an object in an array.
pub const MAX_BRACKETS: usize = 4 * MAX_NESTING + 8;

/// Objects with more keys than this look for duplicates in a hash set.
const FEW_KEYS: usize = 16;

type Parsed<T> = Result<T, Box<Diagnostic>>;

/// Parses a document. Returns its tree where the syntax is right, and all diagnostics. Recursion is bounded
/// by [`MAX_BRACKETS`]. O(bytes).
#[must_use]
pub fn parse_json(text: &str, file: FileId) -> (Option<Located<'_>>, Vec<Diagnostic>) {
    let mut parser = Parser {
        text,
        bytes: text.as_bytes(),
        file,
        at: 0,
        open: Vec::new(),
        count: 0,
        diagnostics: Vec::new(),
    };
    match parser.document() {
        Ok(tree) => {
            // A duplicate is not in the tree: the pointer of the first key is its pointer.
            for duplicate in &mut parser.diagnostics {
                let first = duplicate.related.first().and_then(|related| related.span);
                duplicate.path = first.map(|span| tree.pointer_at(span)).unwrap_or_default();
            }
            (Some(tree), parser.diagnostics)
        }
        Err(diagnostic) => {
            parser.diagnostics.push(*diagnostic);
            (None, parser.diagnostics)
        }
    }
}

struct Parser<'s> {
    text: &'s str,
    bytes: &'s [u8],
    file: FileId,
    /// Offset of the next byte.
    at: usize,
    /// Open brackets: offset, and true for a `{`.
    open: Vec<(usize, bool)>,
    /// Number of keys and values so far.
    count: usize,
    diagnostics: Vec<Diagnostic>,
}

impl<'s> Parser<'s> {
    fn document(&mut self) -> Parsed<Located<'s>> {
        self.skip_space();
        let tree = self.value()?;
        self.skip_space();
        match self.peek() {
            None => Ok(tree),
            Some(_) => Err(self.fault(SyntaxFault::Trailing)),
        }
    }

    fn value(&mut self) -> Parsed<Located<'s>> {
        let start = self.at;
        self.count += 1;
        if self.count > MAX_TOKENS {
            return Err(Box::new(TooManyTokens { span: self.span(start, start) }.into()));
        }
        let value = match self.peek() {
            Some(b'"') => LocatedValue::Text(self.string()?),
            Some(b'{') => LocatedValue::Object(self.object()?),
            Some(b'[') => LocatedValue::Array(self.array()?),
            Some(b'-' | b'0'..=b'9') => LocatedValue::Number(self.number()?),
            Some(_) => self.word()?,
            None => return Err(self.ended()),
        };
        Ok(Located { value, span: self.span(start, self.at) })
    }

    fn array(&mut self) -> Parsed<Vec<Located<'s>>> {
        let mut items = Vec::new();
        let mut is_open = self.enter(false)?;
        while is_open {
            items.push(self.value()?);
            is_open = self.goes_on(false)?;
        }
        Ok(items)
    }

    fn object(&mut self) -> Parsed<Vec<(Located<'s>, Located<'s>)>> {
        let mut members: Vec<(Located<'_>, Located<'_>)> = Vec::new();
        let mut seen: FxHashSet<Cow<'_, str>> = FxHashSet::default();
        let mut is_open = self.enter(true)?;
        while is_open {
            let start = self.at;
            let key = self.key()?;
            let span = self.span(start, self.at);
            self.colon()?;
            let value = self.value()?;
            let is_new = members.len() < FEW_KEYS || {
                if members.len() == FEW_KEYS {
                    seen.extend(members.iter().filter_map(|(key, _)| match &key.value {
                        LocatedValue::Text(text) => Some(text.clone()),
                        _ => None,
                    }));
                }
                seen.insert(key.clone())
            };
            let first = if members.len() >= FEW_KEYS && is_new {
                None
            } else {
                members.iter().find(|(known, _)| known.text() == Some(&key)).map(|(known, _)| known.span)
            };
            match first {
                Some(first) => {
                    let key = key.as_ref().into();
                    if self.diagnostics.len() <= MAX_MISTAKES {
                        self.diagnostics.push(DuplicateKey { key, span, first }.into());
                    }
                }
                None => members.push((Located { value: LocatedValue::Text(key), span }, value)),
            }
            is_open = self.goes_on(true)?;
        }
        Ok(members)
    }

    /// Steps over an opening bracket, up to the first key or value. Returns `false` where the container is
    /// empty.
    fn enter(&mut self, is_object: bool) -> Parsed<bool> {
        if self.open.len() >= MAX_BRACKETS {
            let span = self.span(self.at, self.at + 1);
            return Err(Box::new(TooDeep { span, limit: MAX_BRACKETS }.into()));
        }
        self.open.push((self.at, is_object));
        self.at += 1;
        self.skip_space();
        let is_empty = self.peek() == Some(if is_object { b'}' } else { b']' });
        if is_empty {
            self.close();
        }
        Ok(!is_empty)
    }

    /// After a value: steps over a comma, up to the next key or value (`true`), or over the closing bracket
    /// (`false`).
    fn goes_on(&mut self, is_object: bool) -> Parsed<bool> {
        self.skip_space();
        match self.peek() {
            Some(b',') => {
                let comma = self.at;
                self.at += 1;
                self.skip_space();
                if matches!(self.peek(), Some(b'}' | b']')) {
                    return Err(self.fault_at(comma, comma + 1, SyntaxFault::TrailingComma));
                }
                Ok(true)
            }
            Some(closing @ (b'}' | b']')) if is_object == (closing == b'}') => {
                self.close();
                Ok(false)
            }
            Some(b'}' | b']') => {
                let start = self.open.last().map_or(0, |(start, _)| *start);
                let opened = self.span(start, start + 1);
                Err(self.fault(SyntaxFault::WrongClosing { opened, is_object }))
            }
            Some(_) => Err(self.fault(SyntaxFault::NoComma { is_object })),
            None => Err(self.ended()),
        }
    }

    fn close(&mut self) {
        self.at += 1;
        self.open.pop();
    }

    fn key(&mut self) -> Parsed<Cow<'s, str>> {
        self.count += 1;
        match self.peek() {
            Some(b'"') => self.string(),
            Some(_) => Err(self.fault(SyntaxFault::KeyNotText)),
            None => Err(self.ended()),
        }
    }

    fn colon(&mut self) -> Parsed<()> {
        self.skip_space();
        match self.peek() {
            Some(b':') => {
                self.at += 1;
                self.skip_space();
                Ok(())
            }
            Some(_) => Err(self.fault(SyntaxFault::NoColon)),
            None => Err(self.ended()),
        }
    }

    /// Reads a string, from its opening quote over its closing one.
    fn string(&mut self) -> Parsed<Cow<'s, str>> {
        let quote = self.at;
        self.at += 1;
        let mut plain = self.at;
        let mut unescaped = String::new();
        loop {
            let rest = self.bytes.get(self.at..).unwrap_or_default();
            self.at +=
                rest.iter().position(|byte| matches!(byte, b'"' | b'\\' | 0..=0x1f)).unwrap_or(rest.len());
            let text = self.text;
            let run = text.get(plain..self.at).unwrap_or("");
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    if unescaped.is_empty() && plain == quote + 1 {
                        return Ok(Cow::Borrowed(run));
                    }
                    unescaped.push_str(run);
                    return Ok(Cow::Owned(unescaped));
                }
                Some(b'\\') => {
                    unescaped.push_str(run);
                    unescaped.push(self.escape()?);
                    plain = self.at;
                }
                Some(byte) if !matches!(byte, b'\n' | b'\r') => {
                    return Err(self.fault(SyntaxFault::Control(byte)));
                }
                Some(_) | None => return Err(self.fault_at(quote, self.at, SyntaxFault::OpenText)),
            }
        }
    }

    /// Reads one escape, from its backslash.
    fn escape(&mut self) -> Parsed<char> {
        let start = self.at;
        let letter = self.bytes.get(start + 1).copied();
        self.at += 2;
        Ok(match letter {
            Some(mark @ (b'"' | b'\\' | b'/')) => mark.into(),
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => return self.unicode(start),
            Some(_) | None => {
                let rest = self.text.get(start + 1..).unwrap_or("");
                let length = rest.chars().next().map_or(0, char::len_utf8);
                return Err(self.fault_at(start, start + 1 + length, SyntaxFault::Escape));
            }
        })
    }

    /// Reads the digits of `\u`, and the second half of a surrogate pair.
    fn unicode(&mut self, start: usize) -> Parsed<char> {
        let mut code = self.hex(start)?;
        if (0xd800..0xdc00).contains(&code) && self.bytes.get(self.at..self.at + 2) == Some(b"\\u") {
            let second_start = self.at;
            self.at += 2;
            let second = self.hex(second_start)?;
            if (0xdc00..0xe000).contains(&second) {
                code = 0x10000 + ((code - 0xd800) << 10) + (second - 0xdc00);
            }
        }
        char::from_u32(code).ok_or_else(|| self.fault_at(start, self.at, SyntaxFault::LoneSurrogate))
    }

    fn hex(&mut self, start: usize) -> Parsed<u32> {
        let four = self.text.get(self.at..self.at + 4);
        let digits = four.filter(|four| four.bytes().all(|byte| byte.is_ascii_hexdigit()));
        let Some(code) = digits.and_then(|four| u32::from_str_radix(four, 16).ok()) else {
            return Err(self.fault_at(start, self.at, SyntaxFault::Escape));
        };
        self.at += 4;
        Ok(code)
    }

    /// Reads a number, by the letter of JSON: no leading `+`, `.` or `0`.
    fn number(&mut self) -> Parsed<Number> {
        let start = self.at;
        let is_negative = self.peek() == Some(b'-');
        self.at += usize::from(is_negative);
        let first = self.peek();
        let whole = self.digits();
        let mut is_wrong = whole == 0 || whole > 1 && first == Some(b'0');
        let mut is_whole = true;
        if self.peek() == Some(b'.') {
            self.at += 1;
            is_whole = false;
            is_wrong |= self.digits() == 0;
        }
        if let Some(b'e' | b'E') = self.peek() {
            self.at += 1;
            is_whole = false;
            self.at += usize::from(matches!(self.peek(), Some(b'+' | b'-')));
            is_wrong |= self.digits() == 0;
        }
        if is_wrong {
            return Err(self.fault_at(start, self.at, SyntaxFault::Number));
        }
        let text = self.text.get(start..self.at).unwrap_or("0");
        let whole = match is_negative {
            _ if !is_whole => None,
            false => text.parse().ok().map(Number::Unsigned),
            true => text.parse().ok().filter(|value| *value < 0).map(Number::Signed),
        };
        if let Some(whole) = whole {
            return Ok(whole);
        }
        let value = text.parse::<f64>().unwrap_or(f64::INFINITY);
        if !value.is_finite() {
            let span = self.span(start, self.at);
            return Err(Box::new(NumberRange { span, found: text.into(), expected: None }.into()));
        }
        Ok(Number::new(value))
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while let Some(b'0'..=b'9') = self.peek() {
            self.at += 1;
        }
        self.at - start
    }

    /// Reads `true`, `false` or `null`.
    fn word(&mut self) -> Parsed<LocatedValue<'s>> {
        let start = self.at;
        while self.peek().is_some_and(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
            self.at += 1;
        }
        match self.text.get(start..self.at).unwrap_or("") {
            "true" => Ok(LocatedValue::Bool(true)),
            "false" => Ok(LocatedValue::Bool(false)),
            "null" => Ok(LocatedValue::Null),
            "" => Err(self.fault(SyntaxFault::NoValue)),
            word => Err(self.fault_at(start, self.at, SyntaxFault::Word(word.into()))),
        }
    }

    #[inline]
    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    #[inline]
    fn skip_space(&mut self) {
        while let Some(b' ' | b'\n' | b'\r' | b'\t') = self.peek() {
            self.at += 1;
        }
    }

    fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.file, start, end)
    }

    /// Reports the next character.
    #[cold]
    fn fault(&self, fault: SyntaxFault) -> Box<Diagnostic> {
        let rest = self.text.get(self.at..).unwrap_or("");
        if let Some(mark) = ["//", "/*", "#"].into_iter().find(|mark| rest.starts_with(mark)) {
            return self.fault_at(self.at, self.at + mark.len(), SyntaxFault::Comment);
        }
        let length = rest.chars().next().map_or(0, char::len_utf8);
        self.fault_at(self.at, self.at + length, fault)
    }

    #[cold]
    fn fault_at(&self, start: usize, end: usize, fault: SyntaxFault) -> Box<Diagnostic> {
        Box::new(JsonSyntax { span: self.span(start, end), fault }.into())
    }

    /// Reports a document that ends where something is missing.
    #[cold]
    fn ended(&self) -> Box<Diagnostic> {
        let opened = self.open.last().map(|(start, is_object)| (*is_object, self.span(*start, start + 1)));
        self.fault_at(self.at, self.at, SyntaxFault::Ended { opened })
    }
}
