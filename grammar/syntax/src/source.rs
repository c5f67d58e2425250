//! Source files and byte ranges in them. Nothing here reads a file: the host hands the text over.

use std::sync::{Arc, OnceLock};

/// Index of a file in [`Sources`].
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct FileId(pub u16);

/// A half-open range of bytes, `start..end`, in one file.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default)]
pub struct Span {
    pub file: FileId,
    /// Offset of the first byte.
    pub start: u32,
    /// Offset one past the last byte.
    pub end: u32,
}

impl Span {
    /// The range `start..end` of `file`; offsets beyond 4 GiB saturate (inputs are limited to 16 MiB).
    #[must_use]
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        let clamp = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Self { file, start: clamp(start), end: clamp(end) }
    }

    /// Range as `usize`, for slicing.
    #[must_use]
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }

    /// The smallest span that covers both; `self` where the files differ.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        if self.file != other.file {
            return self;
        }
        Self { file: self.file, start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// Checks if `other` lies within this span.
    #[must_use]
    pub fn contains(self, other: Self) -> bool {
        self.file == other.file && self.start <= other.start && other.end <= self.end
    }
}

/// Notation of a document.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Syntax {
    /// The text syntax, in `.motet` files.
    Text,
    /// The JSON syntax, in `.json` files.
    Json,
}

/// One source file: its name as the user knows it, and its text.
#[derive(Clone, Debug)]
pub struct Source {
    /// Name shown in diagnostics; `-` for standard input.
    pub name: Arc<str>,
    /// The whole text.
    pub text: Arc<str>,
    /// For one line of a larger file: that file's name, and the line's number from 1.
    line_of: Option<(Arc<str>, usize)>,
    /// Byte offset of the first byte of each line, once a place is asked for: most documents have no mistake.
    lines: OnceLock<Arc<[u32]>>,
}

impl Source {
    /// A source with the given name and text.
    #[must_use]
    pub fn new(name: impl Into<Arc<str>>, text: impl Into<Arc<str>>) -> Self {
        Self { name: name.into(), text: text.into(), line_of: None, lines: OnceLock::new() }
    }

    /// Marks the source as line `line`, from 1, of the file `file`: diagnostics for tools name that file.
    #[must_use]
    pub fn as_line(mut self, file: impl Into<Arc<str>>, line: usize) -> Self {
        self.line_of = Some((file.into(), line));
        self
    }

    /// The file that holds it, and how many of that file's lines come before it.
    #[must_use]
    pub fn file(&self) -> (&str, usize) {
        match &self.line_of {
            Some((file, line)) => (file, line.saturating_sub(1)),
            None => (&self.name, 0),
        }
    }

    /// Checks if the source is one line of a larger file.
    #[must_use]
    pub fn is_line(&self) -> bool {
        self.line_of.is_some()
    }

    /// Line and column, both from 1, of a byte offset; the column counts characters.
    ///
    /// ```
    /// let source = motet_syntax::Source::new("p.motet", "policy p {\n  done\n}");
    /// assert_eq!(source.line_column(13), (2, 3));
    /// ```
    #[must_use]
    pub fn line_column(&self, offset: u32) -> (usize, usize) {
        let lines = self.lines.get_or_init(|| line_starts(&self.text));
        let line = lines.partition_point(|start| *start <= offset).max(1);
        let start = lines.get(line - 1).copied().unwrap_or(0) as usize;
        let column = self.text.get(start..offset as usize).map_or(1, |before| before.chars().count() + 1);
        (line, column)
    }

    /// The text under a span of this file; empty where the span is not on character boundaries.
    #[must_use]
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.range()).unwrap_or("")
    }
}

/// Byte offset of the first byte of each line.
fn line_starts(text: &str) -> Arc<[u32]> {
    let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
    std::iter::once(0).chain(breaks.map(|(at, _)| Span::new(FileId(0), 0, at + 1).end)).collect()
}

/// All files of one compilation, by [`FileId`].
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<Source>,
}

impl Sources {
    /// Adds a file. At most 65,535 files fit in one compilation; the last id is shared beyond that.
    pub fn add(&mut self, source: Source) -> FileId {
        let id = FileId(u16::try_from(self.files.len()).unwrap_or(u16::MAX));
        self.files.push(source);
        id
    }

    /// Looks a file up by its id.
    #[must_use]
    pub fn get(&self, id: FileId) -> Option<&Source> {
        self.files.get(id.0 as usize)
    }

    /// Number of files in the compilation.
    #[must_use]
    pub fn len(&self) -> usize {
        self.files.len()
    }

    /// Checks if there is no file.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }
}
