//! The lines that are shown around a place. A document on one line, as models write JSON, is cut to what is
//! near the place: no terminal has room for more.

use std::sync::Arc;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// Lines that are longer than this, in bytes, are cut.
const LONG_LINE: usize = 240;
/// Bytes of a long line that are shown on either side.
const AROUND: usize = 60;
/// Places that cover more lines than this are shown by their first line.
const MANY_LINES: usize = 6;

/// The text of a file.
#[derive(Debug)]
pub(super) struct Excerpt(pub(super) Arc<str>);

impl Excerpt {
    /// Underlined part of a range: all of it, or its beginning.
    pub(super) fn clipped(text: &str, start: usize, end: usize) -> (usize, usize) {
        let length = text.len();
        let start = boundary(text, start.min(length));
        let end = boundary(text, end.clamp(start, length));
        let place = text.get(start..end).unwrap_or("");
        let is_short =
            place.lines().count() <= MANY_LINES && place.lines().all(|line| line.len() <= LONG_LINE);
        if is_short {
            return (start, end);
        }
        let first = place.lines().next().map_or(0, |line| line.trim_end().len());
        (start, boundary(text, start + first.min(LONG_LINE / 2)))
    }

    /// Checks if a range is on a line that is cut.
    pub(super) fn is_cut(text: &str, at: usize) -> bool {
        let (start, end) = line_about(text, boundary(text, at.min(text.len())));
        end - start > LONG_LINE
    }
}

/// The line, without its break, that an offset on a character boundary is in.
fn line_about(text: &str, at: usize) -> (usize, usize) {
    let start = text.get(..at).and_then(|before| before.rfind('\n')).map_or(0, |line_break| line_break + 1);
    let end = text.get(at..).and_then(|rest| rest.find('\n')).map_or(text.len(), |length| at + length);
    (start, end)
}

/// The nearest character boundary at or before an offset.
fn boundary(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.0.read_span(span, before, after)?;
        if contents.data().split(|byte| *byte == b'\n').all(|line| line.len() <= LONG_LINE) {
            return Ok(contents);
        }
        let text: &str = &self.0;
        let place = boundary(text, span.offset().min(text.len()));
        let (line_start, _) = line_about(text, place);
        let (_, line_end) = line_about(text, boundary(text, place + span.len()));
        let reach = if before == 0 { 0 } else { AROUND };
        let start = boundary(text, place.saturating_sub(reach).max(line_start));
        let end = boundary(text, (place + span.len() + reach).min(line_end));
        let above = text.get(..start).unwrap_or("");
        let line = above.bytes().filter(|byte| *byte == b'\n').count();
        let column = text.get(line_start..start).map_or(0, |left| left.chars().count());
        let data = text.get(start..end).unwrap_or("").as_bytes();
        let shown = SourceSpan::from((start, end - start));
        Ok(Box::new(MietteSpanContents::new(data, shown, line, column, 1)))
    }
}
