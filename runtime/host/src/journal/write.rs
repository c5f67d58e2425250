//! Writing a journal to disk.

use super::read::require_file;
use super::{JournalError, JournalTail, LOCK, read, segment_name};
use motet_runtime::journal::{JournalEntry, JournalHead, LineChain, SEGMENT_BYTES};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Time at which lines that need not be on disk at once are synced: as soon as one of these is reached.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SyncGrouping {
    /// So many lines were written since.
    pub lines: u32,
    /// So many bytes were written since.
    pub bytes: u64,
    /// The first of them is so old.
    pub age: Duration,
}

impl Default for SyncGrouping {
    /// 64 lines, 256 KiB, 200 ms.
    fn default() -> Self {
        Self { lines: 64, bytes: 256 * 1024, age: Duration::from_millis(200) }
    }
}

/// Appends lines to the journal in a folder.
#[derive(Debug)]
pub struct JournalWriter {
    folder: PathBuf,
    file: File,
    path: PathBuf,
    bytes: u64,
    chain: LineChain,
    grouping: SyncGrouping,
    segment_bytes: u64,
    waiting: Option<Waiting>,
    _lock: Lock,
}

/// Lock of a journal's folder. The system releases it when the process ends.
#[derive(Debug)]
struct Lock(File);

impl Drop for Lock {
    /// Closing the file alone would not do: a process that is just being started may still have it open.
    fn drop(&mut self) {
        let _ = self.0.unlock();
    }
}

/// Lines that are written and not synced.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    lines: u32,
    bytes: u64,
    since: Instant,
}

impl JournalWriter {
    /// Begins a journal in a folder, which is made where it does not exist, and must be empty. When this
    /// returns, the head is on disk.
    ///
    /// # Errors
    ///
    /// The folder cannot be used, or another process uses it.
    pub fn create(folder: &Path, head: JournalHead) -> Result<Self, JournalError> {
        fs::create_dir_all(folder).map_err(JournalError::io("cannot make", folder))?;
        let lock = lock(folder)?;
        let others = fs::read_dir(folder).map_err(JournalError::io("cannot read", folder))?;
        let mut others = others.flatten().filter(|entry| entry.file_name() != LOCK);
        match (others.next(), others.next()) {
            (None, _) => {}
            (Some(only), None) if has_no_entry(&only.path()) => {
                fs::remove_file(only.path()).map_err(JournalError::io("cannot remove", &only.path()))?;
            }
            (Some(_), _) => return Err(JournalError::NotEmpty { path: folder.to_owned() }),
        }
        let (path, file) = new_segment(folder, 0)?;
        let chain = LineChain::default();
        let mut writer = Self {
            folder: folder.to_owned(),
            file,
            path,
            bytes: 0,
            chain,
            grouping: SyncGrouping::default(),
            segment_bytes: SEGMENT_BYTES,
            waiting: None,
            _lock: lock,
        };
        writer.append(|chain| chain.head(head))?;
        writer.sync()?;
        Ok(writer)
    }

    /// Folder of the journal.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Goes on with the journal in a folder. Every entry is given to `take`; then a torn tail is cut off, and
    /// the cut synced, before anything is appended. The tail tells how much was cut.
    ///
    /// # Errors
    ///
    /// It cannot be read or written, is damaged, or another process writes it.
    pub fn open(
        folder: &Path,
        take: &mut dyn FnMut(u64, JournalEntry),
    ) -> Result<(Self, JournalTail), JournalError> {
        if !folder.is_dir() {
            return Err(JournalError::None { path: folder.to_owned() });
        }
        let lock = lock(folder)?;
        let tail = read(folder, take)?;
        let path = tail.segment.clone();
        let file = OpenOptions::new().append(true).open(&path);
        let file = file.map_err(JournalError::io("cannot write", &path))?;
        if tail.torn_bytes > 0 {
            let cut = file.set_len(tail.good_bytes).and_then(|()| file.sync_all());
            cut.map_err(JournalError::io("cannot cut", &path))?;
        }
        let writer = Self {
            folder: folder.to_owned(),
            file,
            path,
            bytes: tail.good_bytes,
            chain: tail.chain.clone(),
            grouping: SyncGrouping::default(),
            segment_bytes: SEGMENT_BYTES,
            waiting: None,
            _lock: lock,
        };
        Ok((writer, tail))
    }

    /// With other limits of what waits for a sync.
    #[must_use]
    pub fn with_grouping(mut self, grouping: SyncGrouping) -> Self {
        self.grouping = grouping;
        self
    }

    /// With segments of another size.
    #[must_use]
    pub fn with_segment_bytes(mut self, segment_bytes: u64) -> Self {
        self.segment_bytes = segment_bytes;
        self
    }

    /// Writes a line that `make` adds to the chain, with its line feed. It is on its way to the disk, and
    /// there after the next [`JournalWriter::sync`].
    ///
    /// # Errors
    ///
    /// It cannot be written. The journal is then to be left alone: whether the line is there, only reading it
    /// anew can tell.
    pub fn append(&mut self, make: impl FnOnce(&mut LineChain) -> String) -> Result<(), JournalError> {
        if self.bytes >= self.segment_bytes {
            self.sync()?;
            (self.path, self.file) = new_segment(&self.folder, self.chain.next_seq())?;
            self.bytes = 0;
        }
        let line = make(&mut self.chain);
        self.file.write_all(line.as_bytes()).map_err(JournalError::io("cannot write", &self.path))?;
        let bytes = line.len() as u64;
        self.bytes += bytes;
        let waiting =
            self.waiting.get_or_insert_with(|| Waiting { lines: 0, bytes: 0, since: Instant::now() });
        waiting.lines += 1;
        waiting.bytes += bytes;
        Ok(())
    }

    /// Waits until everything that was written is on disk.
    ///
    /// # Errors
    ///
    /// The system does not say that it is, or the file was deleted.
    pub fn sync(&mut self) -> Result<(), JournalError> {
        if self.waiting.take().is_some() {
            let synced = self.file.sync_data().and_then(|()| require_name(&self.file));
            synced.map_err(JournalError::io("cannot sync", &self.path))?;
        }
        Ok(())
    }

    /// Syncs where enough waits for it.
    ///
    /// # Errors
    ///
    /// As [`JournalWriter::sync`].
    pub fn sync_group(&mut self) -> Result<(), JournalError> {
        let SyncGrouping { lines, bytes, age } = self.grouping;
        let is_due = |waiting: Waiting| {
            waiting.lines >= lines || waiting.bytes >= bytes || waiting.since.elapsed() >= age
        };
        if self.waiting.is_some_and(is_due) { self.sync() } else { Ok(()) }
    }
}

impl Drop for JournalWriter {
    /// Syncs the pending lines; an error has no receiver here.
    fn drop(&mut self) {
        let _ = self.sync();
    }
}

/// True for the first segment of a journal whose process ended before the head was on disk: nothing has run.
fn has_no_entry(path: &Path) -> bool {
    let is_first = path.file_name().is_some_and(|name| name == segment_name(0).as_str());
    let is_small = fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() <= SEGMENT_BYTES);
    is_first && is_small && fs::read(path).is_ok_and(|bytes| !bytes.contains(&b'\n'))
}

fn lock(folder: &Path) -> Result<Lock, JournalError> {
    let path = folder.join(LOCK);
    require_file(&path)?;
    let file = OpenOptions::new().create(true).truncate(false).write(true).open(&path);
    let file = file.map_err(JournalError::io("cannot write", &path))?;
    match file.try_lock() {
        Ok(()) => Ok(Lock(file)),
        Err(fs::TryLockError::WouldBlock) => Err(JournalError::Busy { path: folder.to_owned() }),
        Err(fs::TryLockError::Error(source)) => Err(JournalError::Io { what: "cannot lock", path, source }),
    }
}

/// Refuses a file that was deleted: nobody finds what is written to it.
fn require_name(file: &File) -> io::Result<()> {
    #[cfg(unix)]
    if std::os::unix::fs::MetadataExt::nlink(&file.metadata()?) == 0 {
        return Err(io::Error::new(io::ErrorKind::NotFound, "the file was deleted"));
    }
    Ok(())
}

/// A new file for lines. It is in its folder for good before anything is written to it.
fn new_segment(folder: &Path, seq: u64) -> Result<(PathBuf, File), JournalError> {
    let path = folder.join(segment_name(seq));
    let file = OpenOptions::new().create_new(true).append(true).open(&path);
    let file = file.map_err(JournalError::io("cannot make", &path))?;
    file.sync_all().map_err(JournalError::io("cannot sync", &path))?;
    // A folder cannot be opened as a file everywhere; where it can, its entries are synced this way.
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
    Ok((path, file))
}
