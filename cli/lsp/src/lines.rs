//! Positions in a text as editors count them: lines from 0, and columns in UTF-16 code units.

use std::sync::Arc;

use motet_syntax::Span;

/// Line and column from 0; the column counts UTF-16 code units.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub(crate) struct LinePosition {
    pub(crate) line: u32,
    pub(crate) column: u32,
}

/// Text with the starts of its lines. A line ends with `\n`, `\r\n` or a lone `\r`.
#[derive(Clone, Debug)]
pub(crate) struct LineIndex {
    text: Arc<str>,
    /// Byte offset of the first byte of each line.
    starts: Vec<usize>,
}

impl LineIndex {
    /// Index of a text. O(bytes).
    pub(crate) fn new(text: impl Into<Arc<str>>) -> Self {
        let text: Arc<str> = text.into();
        let bytes = text.as_bytes();
        let ends = bytes.iter().enumerate().filter(|(at, byte)| match byte {
            b'\n' => true,
            b'\r' => bytes.get(at + 1) != Some(&b'\n'),
            _ => false,
        });
        let starts = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        Self { text, starts }
    }

    pub(crate) fn text(&self) -> &Arc<str> {
        &self.text
    }

    /// Line without its end.
    fn line(&self, line: usize) -> &str {
        let start = self.starts.get(line).copied().unwrap_or(self.text.len());
        let end = self.starts.get(line + 1).copied().unwrap_or(self.text.len());
        self.text.get(start..end).unwrap_or("").trim_end_matches(['\n', '\r'])
    }

    /// Position of a byte offset; one inside a character or behind the text is moved to before it. O(log
    /// lines + bytes of the line).
    pub(crate) fn position(&self, offset: usize) -> LinePosition {
        let mut offset = offset.min(self.text.len());
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let line = self.starts.partition_point(|start| *start <= offset).saturating_sub(1);
        let start = self.starts.get(line).copied().unwrap_or_default();
        let before = self.text.get(start..offset).unwrap_or("");
        let column = before.chars().map(char::len_utf16).sum::<usize>();
        LinePosition { line: saturated(line), column: saturated(column) }
    }

    /// Byte offset of a position. A column behind the line means its end, as does one in the middle of a
    /// surrogate pair mean the character's start; a line behind the text means the end of the text.
    pub(crate) fn offset(&self, position: LinePosition) -> usize {
        let line = position.line as usize;
        let Some(start) = self.starts.get(line) else { return self.text.len() };
        let mut left = position.column as usize;
        let text = self.line(line);
        let stop = text.char_indices().find(|(_, letter)| match left.checked_sub(letter.len_utf16()) {
            Some(rest) => {
                left = rest;
                false
            }
            None => true,
        });
        start + stop.map_or(text.len(), |(at, _)| at)
    }

    /// First and last position of a range of bytes.
    pub(crate) fn range(&self, span: Span) -> (LinePosition, LinePosition) {
        (self.position(span.start as usize), self.position(span.end.max(span.start) as usize))
    }

    /// End of a line, before its break.
    pub(crate) fn line_end(&self, line: usize) -> LinePosition {
        let start = self.starts.get(line).copied().unwrap_or(self.text.len());
        self.position(start + self.line(line).len())
    }
}

fn saturated(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::{LineIndex, LinePosition};

    const TEXT: &str = "a😀b\nçé\r\n\u{10ffff}x\rend";

    #[test]
    fn line_index_counts_utf16_code_units() {
        let lines = LineIndex::new(TEXT);
        let at = |line, column| LinePosition { line, column };
        assert_eq!(lines.position(0), at(0, 0));
        assert_eq!(lines.position(5), at(0, 3), "behind the emoji, which has two code units");
        assert_eq!(lines.position(3), at(0, 1), "inside the emoji");
        assert_eq!(lines.position(TEXT.find('é').unwrap()), at(1, 1));
        assert_eq!(lines.position(TEXT.find('x').unwrap()), at(2, 2));
        assert_eq!(lines.position(TEXT.find("end").unwrap()), at(3, 0), "a lone \\r ends a line");
        assert_eq!(lines.position(9_999), at(3, 3));
    }

    #[test]
    fn line_index_finds_offsets_of_all_positions() {
        let lines = LineIndex::new(TEXT);
        for (offset, _) in TEXT.char_indices().filter(|(_, letter)| !matches!(letter, '\r' | '\n')) {
            assert_eq!(lines.offset(lines.position(offset)), offset, "{offset}");
        }
        let at = |line, column| LinePosition { line, column };
        assert_eq!(lines.offset(at(0, 2)), 1, "the middle of a surrogate pair");
        assert_eq!(lines.offset(at(0, 99)), 6, "behind the line");
        assert_eq!(lines.offset(at(1, 99)), TEXT.find('\r').unwrap(), "before \\r\\n");
        assert_eq!(lines.offset(at(99, 0)), TEXT.len());
    }
}
