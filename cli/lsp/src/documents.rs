//! Open documents with their unsaved text.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::convert;
use crate::lines::LineIndex;
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

    /// Applies changes one after the other. Returns false if the document is not open.
    pub(crate) fn change(
        &mut self,
        uri: &str,
        version: i32,
        changes: &[TextDocumentContentChangeEvent],
    ) -> bool {
        let Some(document) = self.documents.get_mut(uri) else { return false };
        for change in changes {
            let text = match change.range {
                Some(range) => {
                    let (from, to) = convert::positions(range);
                    document.lines.replaced(from, to, &change.text)
                }
                None => change.text.clone(),
            };
            document.lines = LineIndex::new(text);
        }
        self.generations += 1;
        (document.version, document.generation) = (version, self.generations);
        true
    }

    pub(crate) fn close(&mut self, uri: &str) -> bool {
        self.documents.remove(uri).is_some()
    }
}
