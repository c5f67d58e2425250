//! Recovery from syntax errors, so that all of a text are told at once: the line that an error blames is
//! blanked out, and the rest is parsed again.

use std::ops::Range;

use super::lexer::{TokenKind, tokens};
use crate::diagnostic::Diagnostic;

/// The most errors that are looked for in one text.
const MAX_ERRORS: usize = 16;
/// The longest text in which more than one is looked for, in bytes.
const MAX_TEXT: usize = 64 * 1024;

/// An error of the lexer or the parser.
pub(super) struct Refusal {
    pub(super) diagnostic: Box<Diagnostic>,
    /// True if a step or a declaration could have begun where the parser stopped.
    pub(super) is_between: bool,
}

/// A text after recovery.
pub(super) struct Recovered {
    /// The text with blanks for what could not be read; `None` where not enough of it is left.
    pub(super) rest: Option<String>,
    /// Offset of each place that is blank, in order.
    pub(super) gaps: Vec<usize>,
    /// All errors, in the order of the text.
    pub(super) found: Vec<Diagnostic>,
}

/// Looks for the errors behind the first one. `parse` returns the error of a text. O(errors × text).
///
/// Of steps without a policy `is_bare` is true.
pub(super) fn recover(
    text: &str,
    first: Refusal,
    is_bare: bool,
    parse: impl Fn(&str) -> Option<Refusal>,
) -> Recovered {
    let mut recovered = Recovered { rest: None, gaps: Vec::new(), found: Vec::new() };
    let mut rest = text.as_bytes().to_vec();
    let mut next = Some(first);
    let mut blanked: Vec<Range<usize>> = Vec::new();
    while let Some(refusal) = next.take() {
        let at = refusal.diagnostic.span.start as usize;
        let is_told = recovered.found.iter().any(|told| told.span == refusal.diagnostic.span);
        let follows =
            is_told || blanked.iter().any(|place| place.contains(&at)) || at >= text.trim_end().len();
        if recovered.found.is_empty() || !follows {
            recovered.found.push((*refusal.diagnostic).clone());
        }
        if follows || recovered.found.len() >= MAX_ERRORS || text.len() > MAX_TEXT {
            return recovered;
        }
        let Ok(before) = std::str::from_utf8(&rest) else { return recovered };
        let Some(place) = blamed(before, &refusal).filter(|place| is_bare || is_inside(before, place.start))
        else {
            return recovered;
        };
        let head = head(before, place.clone());
        let Some(place) = head.clone().or_else(|| balanced(before, place)) else { return recovered };
        for byte in rest.get_mut(place.clone()).into_iter().flatten().filter(|byte| **byte != b'\n') {
            *byte = b' ';
        }
        if head.is_some() {
            // The block stays, under a condition that nobody knows. Its place is behind that of the gap.
            let written = rest.get_mut(place.start + 1..).unwrap_or_default();
            written.iter_mut().zip(UNKNOWN_HEAD).for_each(|(byte, letter)| *byte = *letter);
        }
        recovered.gaps.push(place.start);
        blanked.push(place);
        next = std::str::from_utf8(&rest).ok().and_then(&parse);
    }
    recovered.gaps.sort_unstable();
    recovered.rest = String::from_utf8(rest).ok();
    recovered
}

/// Head of a block in place of one that cannot be read.
const UNKNOWN_HEAD: &[u8] = b"if _ ";

/// The head of a condition on a line that opens a block and has nothing behind its brace; `None` for another
/// line, and where there is no room for [`UNKNOWN_HEAD`].
fn head(text: &str, place: Range<usize>) -> Option<Range<usize>> {
    let line = text.get(place.clone())?;
    let before = line.strip_suffix('{')?;
    let is_head = ["if ", "while ", "for "].iter().any(|word| before.starts_with(word));
    let has_room = before.len() > UNKNOWN_HEAD.len() && !before.contains(['{', '}']);
    (is_head && has_room).then_some(place.start..place.start + before.len())
}

/// The line that an error blames: its own, or the one before where that one does not end.
fn blamed(text: &str, refusal: &Refusal) -> Option<Range<usize>> {
    let at = refusal.diagnostic.span.start as usize;
    let line = line_at(text, at);
    let bracket = |at: usize| text.as_bytes().get(at).copied();
    let opened = refusal.diagnostic.related.iter().find_map(|related| related.span);
    if let Some(opening) = opened.map(|opening| opening.start as usize) {
        let is_brace = bracket(opening) == Some(b'{');
        // A bracket that closes nothing, or one that nothing closes.
        return (!is_brace || at < text.trim_end().len())
            .then(|| if is_brace { line } else { line_at(text, opening) });
    }
    let begins_line = text.get(line.start..at).is_some_and(|before| before.trim().is_empty());
    if refusal.is_between || !begins_line {
        return Some(line);
    }
    let before = text.get(..line.start)?.trim_end();
    (!before.is_empty()).then(|| line_at(text, before.len() - 1))
}

/// Checks if an offset is in the braces of a declaration. Behind a wrong head of one, all is wrong.
fn is_inside(text: &str, at: usize) -> bool {
    let marks = tokens(text, 0).take_while(|token| token.start < at);
    let depth = marks
        .filter(|token| token.kind == TokenKind::Mark)
        .fold(0_i64, |depth, token| depth + i64::from(token.text == "{") - i64::from(token.text == "}"));
    depth > 0
}

/// The line around an offset, without the blanks about it.
fn line_at(text: &str, at: usize) -> Range<usize> {
    let at = at.min(text.len());
    let start = text.as_bytes().iter().take(at).rposition(|byte| *byte == b'\n').map_or(0, |found| found + 1);
    let end =
        text.as_bytes().iter().skip(at).position(|byte| *byte == b'\n').map_or(text.len(), |len| at + len);
    let line = text.get(start..end).unwrap_or_default();
    let from = start + line.len() - line.trim_start().len();
    from..start + line.trim_end().len()
}

/// The place with the block that it opens, and without the braces that close an outer one. `None` if that is
/// nothing, or has no end.
fn balanced(text: &str, place: Range<usize>) -> Option<Range<usize>> {
    let (mut depth, mut end) = (0_usize, place.start);
    for token in tokens(text, place.start) {
        if depth == 0 && token.start >= place.end {
            break;
        }
        match (token.kind, token.text) {
            (TokenKind::Mark, "{") => depth += 1,
            (TokenKind::Mark, "}") => match depth.checked_sub(1) {
                Some(less) => depth = less,
                None if end == place.start => return None,
                None => break,
            },
            (_, _) => {}
        }
        end = token.end();
    }
    (depth == 0 && end > place.start).then_some(place.start..end)
}
