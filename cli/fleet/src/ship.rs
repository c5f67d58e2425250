//! Lines of journals on their way to the server. The journal on the robot's disk is the truth; the server
//! gets each line once and in order, however often the link is cut.

use crate::link::{Fleet, JOURNALS};
use crate::run::{OrderFolder, segments};
use async_nats::HeaderMap;
use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _, Seek as _, SeekFrom};
use std::path::PathBuf;

/// Number of the first line of a message in its journal.
pub(crate) const SEQ: &str = "Motet-Seq";
/// Parts of a line that is larger than a message, and the number of this one.
pub(crate) const PART: &str = "Motet-Part";
/// Greatest number of bytes of a message.
const MAX_MESSAGE: usize = 700 * 1024;
/// Greatest number of lines that are shipped at a time.
const BATCH: usize = 256;
/// Greatest number of bytes of a line.
const MAX_LINE: u64 = 64 * 1024 * 1024;

/// Progress of a journal on its way to the server.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Shipped {
    /// Number of the first line that it does not have whole.
    next: u64,
    /// Number of its last message of the journal in the stream.
    last: u64,
}

/// Shipping of one journal.
#[derive(Debug, Default)]
pub(crate) struct Shipment {
    /// `None` until the server has said what it has, and while something is under way.
    shipped: Option<Shipped>,
    segment: Option<PathBuf>,
    offset: u64,
    /// Number of the line at the offset.
    line: u64,
}

impl Shipment {
    /// Ships what is new. True if everything that is on disk has arrived.
    pub(crate) async fn ship(
        &mut self,
        fleet: &Fleet,
        robot: &str,
        order: &str,
        folder: &OrderFolder,
    ) -> Result<bool, String> {
        let subject = format!("motet.journal.{robot}.{order}");
        // If the shipping breaks off here or is given up, the server says again what it has.
        let mut shipped = match self.shipped.take() {
            Some(shipped) => shipped,
            None => {
                (self.segment, self.offset, self.line) = (None, 0, 0);
                shipped(fleet, &subject).await?
            }
        };
        let mut lines = Vec::new();
        let mut is_all = true;
        while let Some((number, line)) = self.read(folder)? {
            if number < shipped.next {
                continue;
            }
            lines.push(line);
            if lines.len() >= BATCH {
                is_all = false;
                break;
            }
        }
        self.sync(folder)?;
        let id = |number: u64, part: usize| format!("{robot}.{order}-{number}-{part}");
        for message in messages(lines) {
            let count = message.len() as u64;
            let bytes = message.concat();
            let parts: Vec<&[u8]> = bytes.chunks(MAX_MESSAGE).collect();
            for (part, bytes) in parts.iter().enumerate() {
                let mut headers = HeaderMap::new();
                headers.insert("Nats-Msg-Id", id(shipped.next, part).as_str());
                // A message whose predecessor was lost is not taken.
                headers.insert("Nats-Expected-Last-Subject-Sequence", shipped.last.to_string().as_str());
                headers.insert(SEQ, shipped.next.to_string().as_str());
                headers.insert(PART, format!("{part}/{}", parts.len()).as_str());
                let wrong = |error: &dyn std::fmt::Display| format!("the journal waits: {error}");
                let sent =
                    fleet.js.publish_with_headers(subject.clone(), headers, bytes.to_vec().into()).await;
                let taken = sent.map_err(|error| wrong(&error))?.await.map_err(|error| wrong(&error))?;
                shipped.last = taken.sequence;
            }
            shipped.next += count;
        }
        self.shipped = Some(shipped);
        Ok(is_all)
    }

    /// Makes sure that what was read is on disk: a line that a loss of power takes back would have another
    /// one in its place.
    fn sync(&self, folder: &OrderFolder) -> Result<(), String> {
        let Some(segment) = &self.segment else { return Ok(()) };
        let read = segments(&folder.journal()).into_iter().rev().skip_while(|path| path != segment).take(2);
        for path in read {
            let synced = File::open(&path).and_then(|file| file.sync_data());
            synced.map_err(|error| format!("{}: {error}", path.display()))?;
        }
        Ok(())
    }

    /// Next whole line with its number.
    fn read(&mut self, folder: &OrderFolder) -> Result<Option<(u64, Vec<u8>)>, String> {
        loop {
            let segments = segments(&folder.journal());
            let at = match &self.segment {
                None => 0,
                Some(own) => segments.iter().position(|path| path == own).unwrap_or(0),
            };
            let Some(path) = segments.get(at) else { return Ok(None) };
            self.segment = Some(path.clone());
            let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
            let mut file = File::open(path).map_err(wrong)?;
            file.seek(SeekFrom::Start(self.offset)).map_err(wrong)?;
            let mut line = Vec::new();
            BufReader::new(file.take(MAX_LINE)).read_until(b'\n', &mut line).map_err(wrong)?;
            if line.ends_with(b"\n") {
                self.offset += line.len() as u64;
                self.line += 1;
                return Ok(Some((self.line - 1, line)));
            }
            // The next segment begins when this one is whole.
            let Some(next) = segments.get(at + 1).filter(|_| line.is_empty()) else { return Ok(None) };
            (self.segment, self.offset) = (Some(next.clone()), 0);
        }
    }
}

/// Lines as messages: as many lines each as fit, or a longer line alone.
fn messages(lines: Vec<Vec<u8>>) -> Vec<Vec<Vec<u8>>> {
    let (mut messages, mut size): (Vec<Vec<Vec<u8>>>, usize) = (Vec::new(), 0);
    for line in lines {
        size += line.len();
        match messages.last_mut() {
            Some(message) if size <= MAX_MESSAGE => message.push(line),
            _ => {
                size = line.len();
                messages.push(vec![line]);
            }
        }
    }
    messages
}

/// Reads from the server how much of a journal it has.
async fn shipped(fleet: &Fleet, subject: &str) -> Result<Shipped, String> {
    let wrong = |error: String| format!("the journals: {error}");
    let stream = fleet.js.get_stream(JOURNALS).await.map_err(|error| wrong(error.to_string()))?;
    let message = match stream.get_last_raw_message_by_subject(subject).await {
        Ok(message) => message,
        Err(error) => {
            use async_nats::jetstream::stream::LastRawMessageErrorKind;
            return match error.kind() {
                LastRawMessageErrorKind::NoMessageFound => Ok(Shipped { next: 0, last: 0 }),
                _ => Err(wrong(error.to_string())),
            };
        }
    };
    let header = |name: &str| message.headers.get(name).map(|value| value.as_str().to_owned());
    let number: Option<u64> = header(SEQ).and_then(|text| text.parse().ok());
    let number = number.ok_or_else(|| wrong(format!("a message of {subject} has no number")))?;
    let parts = header(PART).and_then(|text| {
        let (part, count) = text.split_once('/')?;
        Some((part.parse::<u64>().ok()?, count.parse::<u64>().ok()?))
    });
    // A line whose last part is missing is sent again as a whole; readers take its last parts.
    let next = match parts {
        Some((part, count)) if part + 1 < count => number,
        Some((_, count)) if count > 1 => number + 1,
        _ => number + message.payload.iter().filter(|byte| **byte == b'\n').count() as u64,
    };
    Ok(Shipped { next, last: message.sequence })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_lines_share_a_message_and_a_long_one_has_its_own() {
        let line = |size: usize| vec![b'x'; size];
        let sizes = |lines: Vec<Vec<u8>>| -> Vec<usize> {
            messages(lines).iter().map(|message| message.concat().len()).collect()
        };
        assert_eq!(sizes(vec![line(10), line(20)]), [30]);
        assert_eq!(sizes(vec![line(10), line(MAX_MESSAGE + 1), line(5)]), [10, MAX_MESSAGE + 1, 5]);
        assert_eq!(sizes(vec![line(MAX_MESSAGE), line(1)]), [MAX_MESSAGE, 1]);
        assert_eq!(sizes(Vec::new()), [0; 0]);
    }
}
