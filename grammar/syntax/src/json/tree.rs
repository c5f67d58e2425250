//! A JSON document as one flat list of nodes in document order, each with its place. A container is followed by its
//! children and knows where they end; an object's children are key, value, key, value. Made by [`super::parse`], read
//! by [`super::de`].

use std::borrow::Cow;

use crate::source::{FileId, Span};

/// A parsed document; node 0 is the whole value.
#[derive(Debug)]
pub(crate) struct Tree<'s> {
    /// The nodes in document order.
    pub(crate) nodes: Vec<Node<'s>>,
    /// The file that all spans lie in.
    pub(crate) file: FileId,
}

/// One key or value.
#[derive(Debug)]
pub(crate) struct Node<'s> {
    /// First byte, quotes and brackets included.
    pub(crate) start: u32,
    /// One past the last byte.
    pub(crate) end: u32,
    /// Index of the first node that is not part of this one.
    pub(crate) next: u32,
    /// What it is.
    pub(crate) kind: Kind<'s>,
}

/// What a node is.
#[derive(Debug, PartialEq)]
pub(crate) enum Kind<'s> {
    Null,
    Bool(bool),
    Number(Number),
    /// A string or a key; borrowed where it has no escapes.
    Text(Cow<'s, str>),
    Array,
    Object,
}

/// A finite number; whole numbers keep all their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Number {
    /// A whole number from 0.
    Unsigned(u64),
    /// A whole number below 0.
    Signed(i64),
    /// Any other.
    Float(f64),
}

impl Number {
    /// A finite number; `3.0` and `3e0` are whole, `-0.0` is not.
    pub(crate) fn of(value: f64) -> Self {
        /// Beyond this not every whole number is a float.
        const EXACT: f64 = 9_007_199_254_740_992.0;
        if value.fract() != 0.0 || value.abs() >= EXACT || (value == 0.0 && value.is_sign_negative()) {
            return Self::Float(value);
        }
        #[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        let whole = value as i64;
        u64::try_from(whole).map_or(Self::Signed(whole), Self::Unsigned)
    }
}

impl<'s> Tree<'s> {
    /// The node with this index.
    #[inline]
    pub(crate) fn get(&self, at: u32) -> Option<&Node<'s>> {
        self.nodes.get(at as usize)
    }

    /// Where a node stands.
    #[inline]
    pub(crate) fn span(&self, at: u32) -> Span {
        self.get(at).map_or_else(Span::default, |node| Span {
            file: self.file,
            start: node.start,
            end: node.end,
        })
    }

    /// The index after the last node of the value at `at`.
    #[inline]
    pub(crate) fn next(&self, at: u32) -> u32 {
        self.get(at).map_or(u32::MAX, |node| node.next)
    }

    /// The text of a string or key; empty for anything else.
    #[inline]
    pub(crate) fn text(&self, at: u32) -> &str {
        match self.get(at).map(|node| &node.kind) {
            Some(Kind::Text(text)) => text,
            Some(Kind::Null | Kind::Bool(_) | Kind::Number(_) | Kind::Array | Kind::Object) | None => "",
        }
    }

    /// Indices of an object's keys; the value of a key is the node after it.
    #[inline]
    pub(crate) fn keys(&self, object: u32) -> impl Iterator<Item = u32> {
        let end = self.next(object);
        let first = Some(object + 1).filter(|at| *at < end);
        std::iter::successors(first, move |key| Some(self.next(key + 1)).filter(|at| *at < end))
    }

    /// The JSON Pointer of the innermost value that covers a span, or whose key does.
    pub(crate) fn pointer_at(&self, span: Span) -> String {
        let covers = |node: &Node<'_>| node.start <= span.start && span.end <= node.end;
        let mut target = 0;
        let mut at = 0;
        while let Some(node) = self.get(at) {
            if covers(node) {
                target = at;
                at += 1;
            } else if node.start >= span.end && span.end > span.start {
                break;
            } else {
                at = node.next;
            }
        }
        self.pointer(target)
    }

    /// The JSON Pointer of the value (or of the value of the key) at `target`. O(members before it on each level).
    pub(crate) fn pointer(&self, target: u32) -> String {
        let mut pointer = String::new();
        let mut at = 0;
        while at < target {
            let Some(node) = self.get(at) else { break };
            let is_object = matches!(node.kind, Kind::Object);
            let (mut child, mut index) = (at + 1, 0_usize);
            loop {
                let value = if is_object { child + 1 } else { child };
                let next = self.next(value);
                if next > target || next >= node.next {
                    pointer.push('/');
                    if is_object {
                        push_escaped(&mut pointer, self.text(child));
                    } else {
                        pointer.push_str(&index.to_string());
                    }
                    at = value;
                    break;
                }
                child = next;
                index += 1;
            }
        }
        pointer
    }
}

/// Appends one reference token of a JSON Pointer (RFC 6901).
pub(crate) fn push_escaped(pointer: &mut String, token: &str) {
    for character in token.chars() {
        match character {
            '~' => pointer.push_str("~0"),
            '/' => pointer.push_str("~1"),
            other => pointer.push(other),
        }
    }
}
