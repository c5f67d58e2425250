//! Bytes to [`Tree`]: JSON as RFC 8259 has it, without recursion, with a limit on brackets. One syntax error ends the
//! reading; duplicate keys are collected and the first of them counts.

use std::borrow::Cow;

use rustc_hash::FxHashSet;

use super::scan::Scanner;
use super::tree::{Kind, Node, Tree};
use crate::ast::MAX_TOKENS;
use crate::diagnostic::Diagnostic;
use crate::errors::{DuplicateKey, JsonSyntax, SyntaxFault};
use crate::errors::{TooDeep, TooManyTokens};
use crate::source::{FileId, Span};

/// Objects with more keys than this look for duplicates in a hash set.
const FEW_KEYS: usize = 16;

/// A document without white space has about so many bytes for each key and value.
const BYTES_PER_NODE: usize = 5;

/// The tree of a document, where its syntax is right, and what is wrong with it.
pub(crate) fn parse(text: &str, file: FileId) -> (Option<Tree<'_>>, Vec<Diagnostic>) {
    let mut parser = Parser {
        scanner: Scanner::new(text, file),
        tree: Tree { nodes: Vec::with_capacity(text.len() / BYTES_PER_NODE + 4), file },
        open: Vec::with_capacity(16),
        found: Vec::new(),
    };
    match parser.document() {
        Ok(()) => (Some(parser.tree), parser.found),
        Err(diagnostic) => {
            parser.found.push(*diagnostic);
            (None, parser.found)
        }
    }
}

/// A container that is not closed yet.
struct Open<'s> {
    /// Its node.
    node: u32,
    is_object: bool,
    /// Keys so far.
    count: usize,
    /// All keys, once there are many.
    seen: Option<Box<FxHashSet<Cow<'s, str>>>>,
    /// Where the tree is cut back to when the value of a duplicate key is complete.
    discard: Option<usize>,
}

struct Parser<'s> {
    scanner: Scanner<'s>,
    tree: Tree<'s>,
    open: Vec<Open<'s>>,
    found: Vec<Diagnostic>,
}

type Step = Result<(), Box<Diagnostic>>;

impl<'s> Parser<'s> {
    fn document(&mut self) -> Step {
        self.scanner.skip_space();
        loop {
            if self.tree.nodes.len() > MAX_TOKENS {
                let span = Span::new(self.tree.file, self.scanner.at, self.scanner.at);
                return Err(Box::new(TooManyTokens { span }.into()));
            }
            // One value, or the opening of one.
            let opened = self.value()?;
            if !opened {
                self.close_finished()?;
            }
            match self.open.last() {
                Some(open) if open.is_object => self.key()?,
                Some(_) => {}
                None => break,
            }
        }
        self.scanner.skip_space();
        match self.scanner.peek() {
            None => Ok(()),
            Some(_) => Err(self.scanner.fault(SyntaxFault::Trailing)),
        }
    }

    /// Reads a scalar (`false`) or the opening of a container that is not empty (`true`), up to its first key or value.
    #[inline]
    fn value(&mut self) -> Result<bool, Box<Diagnostic>> {
        let start = self.scanner.at;
        let kind = match self.scanner.peek() {
            Some(b'"') => Kind::Text(self.scanner.string()?),
            Some(b'{') => return self.enter(start, true),
            Some(b'[') => return self.enter(start, false),
            Some(b'-' | b'0'..=b'9') => Kind::Number(self.scanner.number()?),
            Some(_) => self.scanner.word()?,
            None => return Err(self.ended()),
        };
        self.push(start, kind);
        Ok(false)
    }

    fn enter(&mut self, start: usize, is_object: bool) -> Result<bool, Box<Diagnostic>> {
        let span = Span::new(self.tree.file, start, start + 1);
        if self.open.len() >= super::MAX_BRACKETS {
            return Err(Box::new(TooDeep { span, limit: super::MAX_BRACKETS }.into()));
        }
        self.scanner.at += 1;
        let node = self.push(start, if is_object { Kind::Object } else { Kind::Array });
        self.scanner.skip_space();
        let closing = if is_object { b'}' } else { b']' };
        self.open.push(Open { node, is_object, count: 0, seen: None, discard: None });
        if self.scanner.peek() == Some(closing) {
            self.close_finished_container();
            return Ok(false);
        }
        Ok(true)
    }

    /// After a value: reads `,` up to the next key or value, or closes what ends here.
    #[inline]
    fn close_finished(&mut self) -> Step {
        loop {
            let Some(open) = self.open.last_mut() else { return Ok(()) };
            if let Some(length) = open.discard.take() {
                self.tree.nodes.truncate(length);
            }
            let (is_object, node) = (open.is_object, open.node);
            self.scanner.skip_space();
            match self.scanner.peek() {
                Some(b',') => {
                    let comma = self.scanner.at;
                    self.scanner.at += 1;
                    self.scanner.skip_space();
                    if matches!(self.scanner.peek(), Some(b'}' | b']')) {
                        return Err(self.scanner.fault_at(comma, comma + 1, SyntaxFault::TrailingComma));
                    }
                    return Ok(());
                }
                Some(b'}') if is_object => self.close_finished_container(),
                Some(b']') if !is_object => self.close_finished_container(),
                Some(b'}' | b']') => {
                    let opened = Span::new(
                        self.tree.file,
                        self.tree.span(node).start as usize,
                        self.tree.span(node).start as usize + 1,
                    );
                    return Err(self.scanner.fault(SyntaxFault::WrongClosing { opened, is_object }));
                }
                Some(_) => return Err(self.scanner.fault(SyntaxFault::NoComma { is_object })),
                None => return Err(self.ended()),
            }
        }
    }

    /// Steps over a closing bracket and completes its container.
    #[inline]
    fn close_finished_container(&mut self) {
        self.scanner.at += 1;
        let next = self.count();
        let Some(open) = self.open.pop() else { return };
        let end = Span::new(self.tree.file, 0, self.scanner.at).end;
        if let Some(node) = self.tree.nodes.get_mut(open.node as usize) {
            node.end = end;
            node.next = next;
        }
    }

    /// Reads a key and its colon, up to the value.
    #[inline(always)]
    fn key(&mut self) -> Step {
        let start = self.scanner.at;
        match self.scanner.peek() {
            Some(b'"') => {}
            Some(_) => return Err(self.scanner.fault(SyntaxFault::KeyNotText)),
            None => return Err(self.ended()),
        }
        let key = self.scanner.string()?;
        match self.earlier(&key) {
            Some(first) => self.duplicate(&key, start, first),
            None => self.remember(&key),
        }
        self.push(start, Kind::Text(key));
        self.scanner.skip_space();
        match self.scanner.peek() {
            Some(b':') => {
                self.scanner.at += 1;
                self.scanner.skip_space();
                Ok(())
            }
            Some(_) => Err(self.scanner.fault(SyntaxFault::NoColon)),
            None => Err(self.ended()),
        }
    }

    /// Where the innermost open object already has this key.
    #[inline]
    fn earlier(&self, key: &str) -> Option<Span> {
        let open = self.open.last()?;
        if open.seen.as_ref().is_some_and(|seen| !seen.contains(key)) {
            return None;
        }
        // What comes after the bracket is the object's members so far.
        let mut at = open.node + 1;
        while let Some(node) = self.tree.get(at) {
            if matches!(&node.kind, Kind::Text(text) if text == key) {
                return Some(self.tree.span(at));
            }
            at = self.tree.next(at + 1);
        }
        None
    }

    /// Counts a new key of the innermost open object.
    #[inline]
    #[expect(clippy::ptr_arg, reason = "a key without escapes is kept without a copy")]
    fn remember(&mut self, key: &Cow<'s, str>) {
        let Some(open) = self.open.last_mut() else { return };
        open.count += 1;
        if open.count > FEW_KEYS {
            let (tree, first) = (&self.tree, open.node + 1);
            let seen = open.seen.get_or_insert_with(|| {
                let keys = std::iter::successors(Some(first), |at| Some(tree.next(at + 1)));
                let texts = keys.map_while(|at| tree.get(at)).filter_map(|node| match &node.kind {
                    Kind::Text(text) => Some(text.clone()),
                    Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::Array | Kind::Object => None,
                });
                Box::new(texts.collect())
            });
            seen.insert(key.clone());
        }
    }

    /// Reports a key that its object already has; it is cut off again when its value is complete.
    #[cold]
    fn duplicate(&mut self, key: &str, start: usize, first: Span) {
        let span = Span::new(self.tree.file, start, self.scanner.at);
        self.found.push(DuplicateKey { key: key.into(), span, first }.into());
        let length = self.tree.nodes.len();
        if let Some(open) = self.open.last_mut() {
            open.discard = Some(length);
        }
    }

    #[inline]
    fn push(&mut self, start: usize, kind: Kind<'s>) -> u32 {
        let at = self.count();
        let span = Span::new(self.tree.file, start, self.scanner.at);
        self.tree.nodes.push(Node { start: span.start, end: span.end, next: at + 1, kind });
        at
    }

    /// How many nodes there are; documents of at most 16 MiB have fewer than 2^32.
    #[inline]
    fn count(&self) -> u32 {
        u32::try_from(self.tree.nodes.len()).unwrap_or(u32::MAX)
    }

    /// The document ends where something is missing.
    #[cold]
    fn ended(&self) -> Box<Diagnostic> {
        let opened = self.open.last().map(|open| {
            let start = self.tree.span(open.node).start as usize;
            (open.is_object, Span::new(self.tree.file, start, start + 1))
        });
        let at = self.scanner.at;
        Box::new(
            JsonSyntax { span: Span::new(self.tree.file, at, at), fault: SyntaxFault::Ended { opened } }
                .into(),
        )
    }
}
