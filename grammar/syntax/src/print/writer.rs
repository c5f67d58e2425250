//! Lines of the text syntax: indentation, blank lines, and the comments of a text, which are printed as the
//! writer passes their places. The content of the lines is in [`super::declaration`], [`super::step`] and
//! [`super::expr`].

use std::iter::Peekable;
use std::vec::IntoIter;

use crate::text::lexer::{TokenKind, tokens};

/// The printer of a file.
pub(super) struct Writer<'s> {
    pub(super) text: String,
    indent: usize,
    comments: Comments<'s>,
    /// True if the next line is the first of its block.
    is_first: bool,
}

impl<'s> Writer<'s> {
    pub(super) fn new(comments: Comments<'s>) -> Self {
        Self { text: String::new(), indent: 0, comments, is_first: true }
    }

    /// The whole text, with the comments that are left.
    pub(super) fn finish(mut self) -> String {
        while let Some((comment, is_apart)) = self.comments.before(u32::MAX) {
            self.comment(comment, is_apart);
        }
        self.text
    }

    /// Begins the line of something that stands at `offset`: the comments before it, each on its line, and a
    /// blank line where there was one.
    pub(super) fn begin(&mut self, offset: u32, blank: Blank) {
        self.leading(offset, offset, blank);
        self.is_first = false;
        self.start_line();
    }

    /// [`Self::begin`] of a declaration with so many lines of documentation above it.
    pub(super) fn begin_documented(&mut self, offset: u32, lines: usize, blank: Blank) {
        let doc = self.comments.doc_start(offset, lines);
        self.leading(offset, doc, blank);
        self.is_first = false;
    }

    /// Ends a line whose last thing ends at `offset`, with the comment that follows it there.
    pub(super) fn end(&mut self, offset: u32) {
        if let Some(comment) = self.comments.trailing(offset) {
            self.text.push_str("  ");
            self.text.push_str(comment);
        }
        self.comments.pass(offset);
        self.text.push('\n');
    }

    /// Opens a block on this line; what is in it begins at `offset`.
    pub(super) fn open(&mut self, offset: u32) {
        self.text.push('{');
        self.end(offset);
        self.indent += 1;
        self.is_first = true;
    }

    /// Closes a block whose closing brace is at `offset`. The line is left open.
    pub(super) fn close(&mut self, offset: u32) {
        while let Some((comment, is_apart)) = self.comments.before(offset) {
            self.comment(comment, is_apart);
        }
        self.indent = self.indent.saturating_sub(1);
        self.is_first = false;
        self.comments.pass(offset + 1);
        self.start_line();
        self.text.push('}');
    }

    /// Checks for a comment before `offset`.
    pub(super) fn has_comment_before(&mut self, offset: u32) -> bool {
        self.comments.is_next_before(offset)
    }

    /// Columns that are used on the current line.
    pub(super) fn column(&self) -> usize {
        let line = self.text.rsplit('\n').next().unwrap_or("");
        line.chars().count()
    }

    /// Spaces of the current indentation.
    pub(super) fn start_line(&mut self) {
        for _ in 0..self.indent {
            self.text.push_str("    ");
        }
    }

    /// Clauses are indented under their declaration.
    pub(super) fn indented(&mut self, inside: impl FnOnce(&mut Self)) {
        self.indent += 1;
        inside(self);
        self.indent = self.indent.saturating_sub(1);
    }

    /// The comments before `offset`, and the blank line before `head`, which is where the thing itself
    /// begins.
    fn leading(&mut self, offset: u32, head: u32, blank: Blank) {
        let mut is_forced = blank == Blank::Always;
        while let Some((comment, is_apart)) = self.comments.before(offset) {
            self.comment(comment, is_apart || is_forced);
            is_forced = false;
        }
        if self.comments.passes_blank(head) || is_forced {
            self.blank_line();
        }
    }

    fn comment(&mut self, comment: &str, is_apart: bool) {
        if is_apart {
            self.blank_line();
        }
        self.is_first = false;
        self.start_line();
        self.text.push_str(comment);
        self.text.push('\n');
    }

    /// A blank line, but never at the beginning of a block or of the file.
    fn blank_line(&mut self) {
        if !self.is_first {
            self.text.push('\n');
        }
    }
}

/// Rule for the blank line above a node.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Blank {
    /// As in the source text.
    AsWritten,
    /// Always a blank line.
    Always,
}

/// The comments that are still to be printed, in order.
pub(super) struct Comments<'s> {
    text: &'s str,
    rest: Peekable<IntoIter<(usize, &'s str)>>,
    /// Offset of the end of the last printed node in the text.
    at: usize,
}

impl<'s> Comments<'s> {
    /// No comments, and no text to look for blank lines in.
    pub(super) fn none() -> Self {
        Self { text: "", rest: Vec::new().into_iter().peekable(), at: 0 }
    }

    /// All comments of a text.
    pub(super) fn of(text: &'s str) -> Self {
        let comments = tokens(text, 0).filter(|token| token.kind == TokenKind::Comment);
        let comments: Vec<_> = comments.map(|token| (token.start, token.text.trim_end())).collect();
        Self { text, rest: comments.into_iter().peekable(), at: 0 }
    }

    /// The next comment that begins before an offset, and whether a blank line stands before it.
    pub(super) fn before(&mut self, offset: u32) -> Option<(&'s str, bool)> {
        let (start, comment) = self.rest.next_if(|(start, _)| *start < offset as usize)?;
        let is_apart = self.blank_before(start);
        self.at = start + comment.len();
        Some((comment, is_apart))
    }

    /// The next comment, if it is inside of what ends at an offset or follows it on the same line.
    pub(super) fn trailing(&mut self, offset: u32) -> Option<&'s str> {
        let end = offset as usize;
        let text = self.text;
        let follows =
            |start: usize| start < end || text.get(end..start).is_some_and(|gap| !gap.contains('\n'));
        let (start, comment) = self.rest.next_if(|(start, _)| follows(*start))?;
        self.at = self.at.max(end).max(start + comment.len());
        Some(comment)
    }

    /// Checks for a blank line between the last printed node and an offset.
    pub(super) fn passes_blank(&mut self, offset: u32) -> bool {
        self.blank_before(offset as usize)
    }

    /// Checks for a comment before an offset that is still to be printed.
    pub(super) fn is_next_before(&mut self, offset: u32) -> bool {
        self.rest.peek().is_some_and(|(start, _)| *start < offset as usize)
    }

    /// Offset of the documentation, of so many `///` lines, above the declaration at an offset.
    pub(super) fn doc_start(&self, offset: u32, lines: usize) -> u32 {
        let before = self.text.get(..offset as usize).unwrap_or("");
        let mut lines_before = before.rsplit('\n');
        let mut start = before.len() - lines_before.next().map_or(0, str::len);
        let mut missing = lines;
        while missing > 0 {
            let Some(line) = lines_before.next() else { break };
            start = start.saturating_sub(line.len() + 1);
            let line = line.trim_start();
            missing -= usize::from(line.starts_with("///") && !line.starts_with("////"));
        }
        u32::try_from(start).unwrap_or(offset)
    }

    /// Notes that the printer has passed an offset.
    pub(super) fn pass(&mut self, offset: u32) {
        self.at = self.at.max(offset as usize);
    }

    fn blank_before(&self, offset: usize) -> bool {
        let gap = self.text.get(self.at..offset).unwrap_or("");
        gap.bytes().filter(|byte| *byte == b'\n').count() > 1
    }
}
