//! Reading a journal from disk, segment by segment, and the errors of journals.

use super::EXTENSION;
use motet_runtime::journal::{
    JournalDamage, JournalEntry, JournalReader, LineChain, MAX_SEGMENTS, SegmentEnd, SegmentPosition,
};
use std::fs::{self, File};
use std::io::{self, BufRead as _, BufReader, Read as _};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// The end of a journal, to append to.
#[derive(Clone, Debug)]
pub struct JournalTail {
    /// The last segment.
    pub segment: PathBuf,
    /// Its bytes that hold.
    pub good_bytes: u64,
    /// Bytes after them that are to be cut off: a line that was not written to its end.
    pub torn_bytes: u64,
    /// The end of the chain.
    pub chain: LineChain,
}

/// Reads the journal in a folder and gives every entry with its number to `take`. Nothing is changed; a torn
/// tail is left where it is.
///
/// # Errors
///
/// It cannot be read, holds no entry, or is damaged. Entries before the damage were given.
pub fn read(folder: &Path, take: &mut dyn FnMut(u64, JournalEntry)) -> Result<JournalTail, JournalError> {
    let segments = segments(folder)?;
    let mut reader = JournalReader::default();
    let mut tail = None;
    let mut entries = 0_u64;
    for (index, (first, path)) in segments.iter().enumerate() {
        let place = if index + 1 == segments.len() { SegmentPosition::Last } else { SegmentPosition::Middle };
        if *first != entries {
            let what = format!("the segment that begins with line {entries} is missing");
            return Err(JournalError::Segments { path: folder.to_owned(), what });
        }
        require_file(path)?;
        let (bytes, size) = read_segment(path).map_err(JournalError::io("cannot read", path))?;
        if size > MAX_SEGMENT_BYTES && place == SegmentPosition::Middle {
            let what = format!("`{}` is larger than {} MiB", path.display(), MAX_SEGMENT_BYTES >> 20);
            return Err(JournalError::Segments { path: folder.to_owned(), what });
        }
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let ending = reader.segment(&name, &bytes, place, &mut |seq, entry| {
            entries = seq + 1;
            take(seq, entry);
        });
        let ending = ending.map_err(|damage| JournalError::Damaged { path: folder.to_owned(), damage })?;
        let (good_bytes, torn_bytes) = match ending {
            SegmentEnd::Whole => (bytes.len() as u64, size.saturating_sub(bytes.len() as u64)),
            SegmentEnd::Torn { good_bytes, .. } => (good_bytes, size.saturating_sub(good_bytes)),
        };
        tail = Some((path.clone(), good_bytes, torn_bytes));
    }
    match tail.filter(|_| entries > 0) {
        Some((segment, good_bytes, torn_bytes)) => {
            Ok(JournalTail { segment, good_bytes, torn_bytes, chain: reader.into_chain() })
        }
        None => Err(JournalError::None { path: folder.to_owned() }),
    }
}

/// Size of the segments of a journal in bytes; 0 if there is none. Other files of the folder do not count.
#[must_use]
pub fn size(folder: &Path) -> u64 {
    let segments = segments(folder).unwrap_or_default().into_iter();
    segments.filter_map(|(_, path)| fs::metadata(path).ok()).map(|file| file.len()).sum()
}

/// Number of lines of a journal, for a bar: a line is an entry. Reads the whole journal.
#[must_use]
pub fn lines(folder: &Path) -> usize {
    let breaks = |path: &Path| {
        require_file(path).ok()?;
        let bytes = BufReader::new(File::open(path).ok()?).split(b'\n');
        Some(bytes.take_while(Result::is_ok).count())
    };
    segments(folder).unwrap_or_default().iter().filter_map(|(_, path)| breaks(path)).sum()
}

/// The most bytes of a segment that are read. No writer makes one that large; what follows in the last one
/// counts as torn.
const MAX_SEGMENT_BYTES: u64 = 256 * 1024 * 1024;

/// Beginning of a segment, and the size of all of it.
fn read_segment(path: &Path) -> io::Result<(Vec<u8>, u64)> {
    let file = File::open(path)?;
    let size = file.metadata()?.len();
    let mut bytes = Vec::with_capacity(usize::try_from(size.min(MAX_SEGMENT_BYTES)).unwrap_or_default());
    file.take(MAX_SEGMENT_BYTES).read_to_end(&mut bytes)?;
    let size = size.max(bytes.len() as u64);
    Ok((bytes, size))
}

/// Refuses what is no regular file: to open a named pipe or a device may take for ever.
pub(super) fn require_file(path: &Path) -> Result<(), JournalError> {
    match fs::metadata(path) {
        Ok(data) if !data.is_file() => Err(JournalError::Irregular { path: path.to_owned() }),
        Ok(_) | Err(_) => Ok(()),
    }
}

/// The segments of a folder with the number of their first line, in order.
fn segments(folder: &Path) -> Result<Vec<(u64, PathBuf)>, JournalError> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(JournalError::io("cannot read", folder))? {
        let path = entry.map_err(JournalError::io("cannot read", folder))?.path();
        let number = path.file_stem().and_then(|stem| stem.to_str()).and_then(|stem| stem.parse().ok());
        if let (Some(number), true) = (number, path.extension().is_some_and(|found| found == EXTENSION)) {
            found.push((number, path));
        }
        if found.len() > MAX_SEGMENTS {
            let what = format!("it has more than {MAX_SEGMENTS} segments");
            return Err(JournalError::Segments { path: folder.to_owned(), what });
        }
    }
    found.sort();
    Ok(found)
}

/// A journal that cannot be used.
#[derive(Debug, Error)]
pub enum JournalError {
    /// The system says no.
    #[error("{what} `{}`: {source}", path.display())]
    Io {
        /// Failed action, such as `cannot read`.
        what: &'static str,
        path: PathBuf,
        source: io::Error,
    },
    /// A file of it is a named pipe, a device or a folder.
    #[error("`{}` is no regular file", path.display())]
    Irregular { path: PathBuf },
    /// It is damaged.
    #[error("`{}`: {damage}", path.display())]
    Damaged { path: PathBuf, damage: JournalDamage },
    /// A folder that is to hold a new journal is not empty.
    #[error("`{}` is not empty: a journal needs a folder of its own", path.display())]
    NotEmpty { path: PathBuf },
    /// There is no journal in a folder, or not even its first line was written.
    #[error("`{}` holds no journal: no run has begun in it", path.display())]
    None { path: PathBuf },
    /// Another process writes it.
    #[error("another process writes the journal in `{}`", path.display())]
    Busy { path: PathBuf },
    /// It has too many segments, or they do not follow from each other.
    #[error("`{}`: {what}", path.display())]
    Segments {
        path: PathBuf,
        /// Kind of a validation error.
        what: String,
    },
}

impl JournalError {
    pub(super) fn io(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { what, path, source }
    }
}
