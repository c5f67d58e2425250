//! Open documents with their unsaved text.

use std::collections::BTreeMap;
use std::path::PathBuf;

use ropey::Rope;

use crate::convert;
use crate::lines::{LineIndex, LinePosition};
use crate::protocol::TextDocumentContentChangeEvent;

/// Document that an editor holds open.
#[derive(Clone, Debug)]
pub(crate) struct OpenDocument {
    pub(crate) uri: String,
    /// File of the document; `None` for one that has none yet.
    pub(crate) path: Option<PathBuf>,
    pub(crate) version: i32,
    pub(crate) lines: LineIndex,
    /// Number of the content, which no other content of any document has.
    pub(crate) generation: u64,
}

/// All open documents by URI.
#[derive(Debug, Default)]
pub(crate) struct OpenDocuments {
    documents: BTreeMap<String, OpenDocument>,
    generations: u64,
}

impl OpenDocuments {
    pub(crate) fn get(&self, uri: &str) -> Option<&OpenDocument> {
        self.documents.get(uri)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &OpenDocument> {
        self.documents.values()
    }

    /// Opens a document, or replaces one that is open.
    pub(crate) fn open(&mut self, uri: &str, version: i32, text: String) {
        self.generations += 1;
        let document = OpenDocument {
            uri: uri.to_owned(),
            path: convert::path(uri),
            version,
            lines: LineIndex::new(text),
            generation: self.generations,
        };
        self.documents.insert(uri.to_owned(), document);
    }

    /// Applies changes one after the other, in O(bytes + changes · log bytes). Returns false if the document
    /// is not open.
    pub(crate) fn change(
        &mut self,
        uri: &str,
        version: i32,
        changes: &[TextDocumentContentChangeEvent],
    ) -> bool {
        let Some(document) = self.documents.get_mut(uri) else { return false };
        let mut text = Rope::from_str(document.lines.text());
        for change in changes {
            match change.range.map(convert::positions) {
                Some((from, to)) => replace(&mut text, from, to, &change.text),
                None => text = Rope::from_str(&change.text),
            }
        }
        document.lines = LineIndex::new(String::from(text));
        self.generations += 1;
        (document.version, document.generation) = (version, self.generations);
        true
    }

    pub(crate) fn close(&mut self, uri: &str) -> bool {
        self.documents.remove(uri).is_some()
    }
}

/// Replaces a range of a text.
fn replace(text: &mut Rope, from: LinePosition, to: LinePosition, by: &str) {
    let (from, to) = (character(text, from), character(text, to));
    let (from, to) = (from.min(to), from.max(to));
    text.remove(from..to);
    text.insert(from, by);
}

/// Number of characters before a position, which means the same as in [`LineIndex::offset`].
fn character(text: &Rope, position: LinePosition) -> usize {
    let line = position.line as usize;
    if line >= text.len_lines() {
        return text.len_chars();
    }
    let start = text.line_to_char(line);
    let line = text.line(line);
    let ends = line.chars_at(line.len_chars()).reversed().take_while(|letter| matches!(letter, '\n' | '\r'));
    let end = line.len_chars() - ends.count();
    let column = (position.column as usize).min(line.char_to_utf16_cu(end));
    start + line.utf16_cu_to_char(column)
}

#[cfg(test)]
mod tests {
    use ropey::Rope;

    use super::{character, replace};
    use crate::lines::{LineIndex, LinePosition};

    #[test]
    fn replace_changes_a_range() {
        let at = |line, column| LinePosition { line, column };
        for (from, to, by, expected) in [
            (at(0, 1), at(0, 3), "-", "a-b\nc"),
            (at(1, 1), at(0, 3), "", "a😀"),
            (at(7, 0), at(7, 0), "!", "a😀b\nc!"),
        ] {
            let mut text = Rope::from_str("a😀b\nc");
            replace(&mut text, from, to, by);
            assert_eq!(text, expected);
        }
    }

    #[test]
    fn character_is_that_of_the_line_index() {
        let text = "a😀b\nçé\r\n\u{10ffff}x\r\u{2028}end\r\r\n";
        let (lines, rope) = (LineIndex::new(text), Rope::from_str(text));
        for (line, column) in (0..8).flat_map(|line| (0..8).map(move |column| (line, column))) {
            let at = LinePosition { line, column };
            assert_eq!(rope.char_to_byte(character(&rope, at)), lines.offset(at), "{at:?}");
        }
    }
}
