//! Bytes to [`Tree`]: JSON as RFC 8259 has it, without recursion, with a limit on brackets. One syntax error ends the
//! reading; duplicate keys are collected and the first of them counts.

use std::borrow::Cow;

use rustc_hash::FxHashSet;

use super::errors::{DuplicateKey, JsonSyntax, SyntaxFault};
use super::scan::Scanner;
use super::tree::{Kind, Node, Tree};
use crate::ast::MAX_TOKENS;
use crate::diagnostic::Diagnostic;
use crate::errors::{TooDeep, TooManyTokens};
use crate::source::{FileId, Span};

/// Objects with more keys than this look for duplicates in a hash set.
const FEW_KEYS: usize = 16;

/// The tree of a document, where its syntax is right, and what is wrong with it.
pub(crate) fn parse(text: &str, file: FileId) -> (Option<Tree<'_>>, Vec<Diagnostic>) {
    let mut parser = Parser {
        scanner: Scanner::new(text, file),
        tree: Tree { nodes: Vec::with_capacity(text.len() / 12 + 4), file },
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
    seen: FxHashSet<Cow<'s, str>>,
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
            if self.open.is_empty() {
                break;
            }
        }
        self.scanner.skip_space();
        match self.scanner.peek() {
            None => Ok(()),
            Some(_) => Err(self.scanner.fault(SyntaxFault::Trailing)),
        }
    }

    /// Reads a scalar (`false`) or the opening of a container that is not empty (`true`), up to its first value.
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
        self.open.push(Open { node, is_object, count: 0, seen: FxHashSet::default(), discard: None });
        if self.scanner.peek() == Some(closing) {
            self.close_finished_container();
            return Ok(false);
        }
        if is_object {
            self.key()?;
        }
        Ok(true)
    }

    /// After a value: reads `,` up to the next value, or closes what ends here.
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
                    return if is_object { self.key() } else { Ok(()) };
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
    fn key(&mut self) -> Step {
        let start = self.scanner.at;
        match self.scanner.peek() {
            Some(b'"') => {}
            Some(_) => return Err(self.scanner.fault(SyntaxFault::KeyNotText)),
            None => return Err(self.ended()),
        }
        let key = self.scanner.string()?;
        let span = Span::new(self.tree.file, start, self.scanner.at);
        let length = self.tree.nodes.len();
        if let Some(first) = self.earlier(&key) {
            self.found.push(DuplicateKey { key: key.as_ref().into(), span, first }.into());
            if let Some(open) = self.open.last_mut() {
                open.discard = Some(length);
            }
        } else if let Some(open) = self.open.last_mut() {
            open.count += 1;
            if open.count > FEW_KEYS {
                open.seen.insert(key.clone());
            }
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
    fn earlier(&mut self, key: &str) -> Option<Span> {
        let end = self.count();
        let open = self.open.last_mut()?;
        if open.count > FEW_KEYS && !open.seen.contains(key) {
            return None;
        }
        let first = open.node + 1;
        let tree = &self.tree;
        let mut keys =
            std::iter::successors(Some(first), |at| Some(tree.next(at + 1))).take_while(|at| *at < end);
        if open.count == FEW_KEYS {
            open.seen.extend(keys.clone().filter_map(|at| match &tree.get(at)?.kind {
                Kind::Text(text) => Some(text.clone()),
                Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::Array | Kind::Object => None,
            }));
        }
        keys.find(|at| tree.text(*at) == key).map(|at| tree.span(at))
    }

    fn push(&mut self, start: usize, kind: Kind<'s>) -> u32 {
        let at = self.count();
        let span = Span::new(self.tree.file, start, self.scanner.at);
        self.tree.nodes.push(Node { start: span.start, end: span.end, next: at + 1, kind });
        at
    }

    /// How many nodes there are; documents of at most 16 MiB have fewer than 2^32.
    fn count(&self) -> u32 {
        u32::try_from(self.tree.nodes.len()).unwrap_or(u32::MAX)
    }

    /// The document ends where something is missing.
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
