//! Files with one result a line, which a later call continues.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead as _, BufReader, Seek as _, SeekFrom, Write as _};
use std::path::Path;

/// File of results, open at its end.
///
/// ```
/// use motet::line_file::LineFile;
///
/// let path = std::env::temp_dir().join(format!("motet-lines-{}", std::process::id()));
/// LineFile::create(&path)?.add("first")?;
/// assert!(LineFile::create(&path).is_err());
/// std::fs::write(&path, "first\nsec")?;
/// let (mut file, lines) = LineFile::continued(&path)?;
/// assert_eq!(lines, [b"first".to_vec()]);
/// file.add("second")?;
/// assert_eq!(std::fs::read_to_string(&path)?, "first\nsecond\n");
/// # std::fs::remove_file(path)?;
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct LineFile(File);

impl LineFile {
    /// Creates a file.
    ///
    /// # Errors
    ///
    /// The file exists, or cannot be created.
    pub fn create(path: &Path) -> io::Result<Self> {
        File::create_new(path).map(Self)
    }

    /// Opens a file, or creates it, and reads its lines. A line that is not whole, since a call was ended
    /// while it wrote it, is cut off.
    ///
    /// # Errors
    ///
    /// The file cannot be opened, read or cut.
    pub fn continued(path: &Path) -> io::Result<(Self, Vec<Vec<u8>>)> {
        let mut file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path)?;
        let (mut reader, mut lines, mut length) = (BufReader::new(&file), Vec::new(), 0);
        loop {
            let mut line = Vec::new();
            let read = reader.read_until(b'\n', &mut line)?;
            if line.pop() != Some(b'\n') {
                break;
            }
            lines.push(line);
            length += u64::try_from(read).unwrap_or_default();
        }
        file.set_len(length)?;
        file.seek(SeekFrom::Start(length))?;
        Ok((Self(file), lines))
    }

    /// Opens a file as [`LineFile::continued`] does, with a first line that says of what it is. A new file
    /// gets that line; `None` if the file has another one.
    ///
    /// # Errors
    ///
    /// The file cannot be opened, read, cut or written.
    pub fn headed(path: &Path, head: &str) -> io::Result<Option<(Self, Vec<Vec<u8>>)>> {
        let (mut file, mut lines) = Self::continued(path)?;
        if lines.is_empty() {
            file.add(head)?;
        } else if lines.remove(0) != head.as_bytes() {
            return Ok(None);
        }
        Ok(Some((file, lines)))
    }

    /// Adds a line.
    ///
    /// # Errors
    ///
    /// The line cannot be written.
    pub fn add(&mut self, line: &str) -> io::Result<()> {
        self.0.write_all(format!("{line}\n").as_bytes())
    }
}
