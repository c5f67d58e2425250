//! Telemetry of a run beside its journal, so that a page can show its motion later. It is no part of the
//! journal: nothing is synced, and a lost or broken file loses nothing but the picture.

use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _, Take, Write as _};
use std::path::Path;

use motet_runtime::{Moved, Time};

use super::read::require_file;
use crate::remote::protocol::MovedParams;

/// Name of the file in the folder of a journal, with one message `moved` of the driver protocol on each line.
const FILE: &str = "motion.jsonl";
/// Shortest time between two lines.
const EVERY: Time = Time::from_nanos(100_000_000);
/// Maximum size of the file in bytes: some hours.
const MAX_BYTES: u64 = 64 << 20;

/// File that telemetry is written to.
pub(super) struct MotionFile {
    file: File,
    bytes: u64,
    last: Option<Time>,
    /// Telemetry since the last line.
    unwritten: Moved,
}

impl MotionFile {
    /// Continues the file in a folder; `None` if it cannot be written.
    pub(super) fn open(folder: &Path) -> Option<Self> {
        require_file(&folder.join(FILE)).ok()?;
        let file = File::options().create(true).append(true).open(folder.join(FILE)).ok()?;
        let bytes = file.metadata().ok()?.len();
        Some(Self { file, bytes, last: None, unwritten: Moved::default() })
    }

    /// Writes telemetry, unless the last line is recent: then with the next one.
    pub(super) fn write(&mut self, moved: &Moved) {
        self.unwritten.merge(moved);
        if self.last.is_some_and(|last| moved.at < last.after(EVERY)) || self.bytes > MAX_BYTES {
            return;
        }
        self.last = Some(moved.at);
        let mut line = serde_json::to_vec(&MovedParams::of(std::mem::take(&mut self.unwritten)));
        if let Ok(line) = &mut line {
            line.push(b'\n');
            self.bytes += line.len() as u64;
            // A full disk ends the run by its journal.
            let _ = self.file.write_all(line);
        }
    }
}

/// Reader of the telemetry beside a journal, also while another process writes it.
#[derive(Debug, Default)]
pub struct MotionReader {
    /// The file, once it is there.
    file: Option<BufReader<Take<File>>>,
    /// Line of which the end is not there yet.
    line: Vec<u8>,
    /// First telemetry that was not given yet.
    next: Option<Moved>,
}

impl MotionReader {
    /// Gives the telemetry up to a time that was not given yet, in order.
    pub fn until(&mut self, folder: &Path, at: Time, take: &mut dyn FnMut(&Moved)) {
        if self.next.as_ref().is_some_and(|next| next.at > at) {
            return;
        }
        self.next.take().iter().for_each(&mut *take);
        if self.file.is_none() {
            let path = folder.join(FILE);
            let file = require_file(&path).ok().and_then(|()| File::open(&path).ok());
            self.file = file.map(|file| BufReader::new(file.take(2 * MAX_BYTES)));
        }
        let Some(file) = &mut self.file else { return };
        while file.read_until(b'\n', &mut self.line).is_ok_and(|bytes| bytes > 0)
            && self.line.ends_with(b"\n")
        {
            let moved = serde_json::from_slice::<MovedParams>(&self.line).ok();
            self.line.clear();
            // A line of another version says nothing.
            let Some(moved) = moved.and_then(|moved| moved.moved(Time::ZERO, true)) else { continue };
            if moved.at > at {
                self.next = Some(moved);
                return;
            }
            take(&moved);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_is_given_up_to_a_time_and_once() {
        let folder = std::env::temp_dir().join(format!("motet-motion-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let mut file = MotionFile::open(&folder).unwrap();
        for tenths in 0..20_u64 {
            let at = Time::from_nanos(tenths * 50_000_000);
            let joints = [("arm".into(), tenths as f64)].into();
            file.write(&Moved { at, base: [tenths as f64, 0.0, 0.0], joints, things: Vec::new() });
        }
        let mut reader = MotionReader::default();
        let mut given = |secs: f64| {
            let mut places = Vec::new();
            reader.until(&folder, Time::from_secs(secs), &mut |moved| places.push(moved.base[0]));
            places
        };
        assert_eq!(given(0.25), [0.0, 2.0, 4.0]);
        assert_eq!(given(0.25), [0.0; 0]);
        assert_eq!(given(0.45), [6.0, 8.0]);
        assert_eq!(given(9.0), [10.0, 12.0, 14.0, 16.0, 18.0]);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
