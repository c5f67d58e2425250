//! Files of the project that are not files of the user: the standard library, built-in robots and scenes. A
//! definition in one leads to a copy in a cache folder, since editors open files.

use std::fs;
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use motet_project::DOCUMENT;
use motet_syntax::{Source, Span};

use crate::checker::Snapshot;
use crate::convert::{self, Locate};
use crate::lines::LineIndex;
use crate::protocol::Location;

/// Folder with copies of the library's files.
#[derive(Clone, Debug)]
pub(crate) struct LibraryFolder {
    folder: PathBuf,
}

impl LibraryFolder {
    pub(crate) fn new(folder: PathBuf) -> Self {
        Self { folder }
    }

    /// File with the text of a source: the user's own, or a copy. `None` if it cannot be written.
    pub(crate) fn file(&self, source: &Source) -> Option<PathBuf> {
        let own = Path::new(&*source.name);
        if own.is_file() { Some(own.to_owned()) } else { self.write(own, &source.text) }
    }

    /// Writes a file of the folder, unless it has the text already. `None` if it cannot be written.
    pub(crate) fn write(&self, name: &Path, text: &str) -> Option<PathBuf> {
        if !name.components().all(|part| matches!(part, Component::Normal(_))) {
            return None;
        }
        let copy = self.folder.join(name);
        let is_current = fs::read(&copy).is_ok_and(|bytes| bytes == text.as_bytes());
        if !is_current {
            fs::create_dir_all(copy.parent()?).ok()?;
            // Other servers may write the same at the same time.
            let draft = copy.with_extension(format!("draft-{}", std::process::id()));
            fs::write(&draft, text).ok()?;
            fs::rename(&draft, &copy).ok()?;
        }
        Some(copy)
    }
}

/// Locations of spans in the files of a project.
pub(crate) struct SourceLocations<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) library: &'a LibraryFolder,
}

impl Locate for SourceLocations<'_> {
    fn location(&self, span: Span) -> Option<Location> {
        if span.file == DOCUMENT {
            let uri = self.snapshot.uri.parse().ok()?;
            return Some(Location { uri, range: convert::range(&self.snapshot.lines, span) });
        }
        let opened = self.snapshot.session.as_ref().ok()?;
        let sources = opened.sources(self.snapshot.source.clone());
        let source = sources.get(span.file)?;
        let uri = convert::uri(&self.library.file(source)?)?;
        let lines = LineIndex::new(Arc::clone(&source.text));
        Some(Location { uri, range: convert::range(&lines, span) })
    }
}
