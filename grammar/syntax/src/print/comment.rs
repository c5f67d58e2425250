//! The comments of a text, handed to the printer as it passes their places.

use std::iter::Peekable;
use std::vec::IntoIter;

use crate::text::lexer::{TokenKind, tokens};

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
