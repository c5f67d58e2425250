//! Edits of a JSON text, and the way back from the edited text to the places of the original.

use crate::diagnostic::{Diagnostic, Edit};
use crate::located::{Located, LocatedValue};
use crate::source::Span;

/// A text after edits, which remembers where each of its parts comes from.
pub(crate) struct EditedText {
    pub(crate) text: String,
    segments: Vec<Segment>,
}

/// Part of the edited text: copied from the original, or written in place of a range of it.
struct Segment {
    start: u32,
    end: u32,
    original: Span,
    is_copy: bool,
}

impl EditedText {
    /// Applies edits that do not overlap. `None` if two do, or one lies outside of the text.
    pub(crate) fn new(original: &str, edits: &mut [Edit]) -> Option<Self> {
        edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
        let file = edits.first()?.span.file;
        let mut edited = Self { text: String::with_capacity(original.len()), segments: Vec::new() };
        let mut at = 0;
        for edit in edits.iter() {
            let range = edit.span.range();
            let copied = original.get(at..range.start)?;
            edited.push(copied, Span::new(file, at, range.start), true);
            edited.push(&edit.text, edit.span, false);
            at = range.end;
        }
        edited.push(original.get(at..)?, Span::new(file, at, original.len()), true);
        Some(edited)
    }

    fn push(&mut self, text: &str, original: Span, is_copy: bool) {
        if text.is_empty() {
            return;
        }
        let start = self.segments.last().map_or(0, |last| last.end);
        self.text.push_str(text);
        let end = Span::new(original.file, 0, self.text.len()).end;
        self.segments.push(Segment { start, end, original, is_copy });
    }

    /// Range of the original text for a range of the edited one.
    fn original(&self, span: Span) -> Span {
        let first = self.segments.partition_point(|segment| segment.end <= span.start);
        let start = match self.segments.get(first) {
            Some(segment) if segment.is_copy => segment.original.start + (span.start - segment.start),
            Some(segment) => segment.original.start,
            None => self.segments.last().map_or(0, |segment| segment.original.end),
        };
        let last = self.segments.partition_point(|segment| segment.end < span.end);
        let end = match self.segments.get(last) {
            Some(segment) if segment.is_copy => {
                segment.original.start + span.end.saturating_sub(segment.start)
            }
            Some(segment) => segment.original.end,
            None => start,
        };
        Span { start, end: end.max(start), ..span }
    }

    /// Moves all ranges of a tree of the edited text to the original.
    pub(crate) fn move_tree(&self, tree: &mut Located<'_>) {
        tree.span = self.original(tree.span);
        match &mut tree.value {
            LocatedValue::Array(items) => items.iter_mut().for_each(|item| self.move_tree(item)),
            LocatedValue::Object(members) => {
                for (key, value) in members {
                    key.span = self.original(key.span);
                    self.move_tree(value);
                }
            }
            LocatedValue::Null
            | LocatedValue::Bool(_)
            | LocatedValue::Number(_)
            | LocatedValue::Text(_)
            | LocatedValue::Date => {}
        }
    }

    /// Moves a diagnostic about the edited text to the original. Its pointer and its fix are about another
    /// text.
    pub(crate) fn move_diagnostic(&self, found: &mut Diagnostic) {
        found.span = self.original(found.span);
        for related in &mut found.related {
            related.span = related.span.map(|span| self.original(span));
        }
        found.fix = None;
        found.path.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::EditedText;
    use crate::diagnostic::Edit;
    use crate::source::{FileId, Span};

    #[test]
    fn edited_text_leads_back_to_the_original() {
        let edit =
            |start, end, text: &str| Edit { span: Span::new(FileId(0), start, end), text: text.into() };
        let mut edits = [edit(4, 6, "XYZ"), edit(1, 2, ""), edit(9, 9, "!")];
        let edited = EditedText::new("abcdefghi", &mut edits).unwrap();
        assert_eq!(edited.text, "acdXYZghi!");
        for ((start, end), expected) in [
            ((0, 1), (0, 1)),
            ((0, 2), (0, 3)),
            ((1, 3), (2, 4)),
            ((3, 6), (4, 6)),
            ((4, 5), (4, 6)),
            ((2, 4), (3, 6)),
            ((6, 9), (6, 9)),
            ((9, 10), (9, 9)),
            ((10, 10), (9, 9)),
            ((0, 10), (0, 9)),
        ] {
            let found = edited.original(Span::new(FileId(0), start, end));
            assert_eq!((found.start, found.end), expected, "{start}..{end}");
        }
        assert!(EditedText::new("ab", &mut [edit(0, 2, ""), edit(1, 2, "")]).is_none());
        assert!(EditedText::new("ab", &mut [edit(1, 3, "")]).is_none());
    }
}
