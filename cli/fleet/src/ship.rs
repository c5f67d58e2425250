//! Lines of journals on their way to the server. The journal on the robot's disk is the truth; the server
//! gets each line once and in order, however often the link is cut.

use crate::link::{Fleet, JOURNALS};
use crate::run::OrderFolder;
use async_nats::HeaderMap;
use async_nats::jetstream::context::PublishAckFuture;
use std::fs::File;
use std::io::{BufRead as _, BufReader, Read as _, Seek as _, SeekFrom};
use std::path::PathBuf;

/// Number of a line in a journal, in a message.
pub(crate) const SEQ: &str = "Motet-Seq";
/// Parts of a line that is larger than a message, and the number of this one.
pub(crate) const PART: &str = "Motet-Part";
/// Greatest number of bytes of a message.
const MAX_MESSAGE: usize = 700 * 1024;
/// Messages that are sent before the first is acknowledged.
const BATCH: usize = 64;
/// Greatest number of bytes of a line.
const MAX_LINE: u64 = 64 * 1024 * 1024;

/// Shipping of one journal.
#[derive(Debug, Default)]
pub(crate) struct Shipment {
    /// Number of the next line, and of its next part; `None` until the server has said what it has.
    next: Option<u64>,
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
        if self.next.is_none() {
            self.next = Some(shipped(fleet, &subject).await?);
            (self.segment, self.offset, self.line) = (None, 0, 0);
        }
        let mut acks: Vec<PublishAckFuture> = Vec::new();
        let mut is_all = true;
        while let Some((number, line)) = self.read(folder)? {
            if self.next.is_some_and(|next| number < next) {
                continue;
            }
            let parts: Vec<&[u8]> = line.chunks(MAX_MESSAGE).collect();
            for (part, bytes) in parts.iter().enumerate() {
                let mut headers = HeaderMap::new();
                headers.insert("Nats-Msg-Id", format!("{order}-{number}-{part}").as_str());
                headers.insert(SEQ, number.to_string().as_str());
                headers.insert(PART, format!("{part}/{}", parts.len()).as_str());
                let sent =
                    fleet.js.publish_with_headers(subject.clone(), headers, bytes.to_vec().into()).await;
                acks.push(sent.map_err(|error| self.again(&error.to_string()))?);
            }
            self.next = Some(number + 1);
            if acks.len() >= BATCH {
                is_all = false;
                break;
            }
        }
        for ack in acks {
            ack.await.map_err(|error| self.again(&error.to_string()))?;
        }
        Ok(is_all)
    }

    /// Begins again at what the server has.
    fn again(&mut self, why: &str) -> String {
        self.next = None;
        format!("the journal waits: {why}")
    }

    /// Next whole line with its number.
    fn read(&mut self, folder: &OrderFolder) -> Result<Option<(u64, Vec<u8>)>, String> {
        loop {
            let segments = segments(folder);
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

fn segments(folder: &OrderFolder) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder.journal()).into_iter().flatten();
    let paths = files.filter_map(|file| Some(file.ok()?.path()));
    let mut segments: Vec<PathBuf> =
        paths.filter(|path| path.extension().is_some_and(|end| end == "journal")).collect();
    segments.sort();
    segments
}

/// Number of the first line that the server does not have whole.
async fn shipped(fleet: &Fleet, subject: &str) -> Result<u64, String> {
    let wrong = |error: String| format!("the journals: {error}");
    let stream = fleet.js.get_stream(JOURNALS).await.map_err(|error| wrong(error.to_string()))?;
    let last = match stream.get_last_raw_message_by_subject(subject).await {
        Ok(last) => last,
        Err(error) => {
            use async_nats::jetstream::stream::LastRawMessageErrorKind;
            return match error.kind() {
                LastRawMessageErrorKind::NoMessageFound => Ok(0),
                _ => Err(wrong(error.to_string())),
            };
        }
    };
    let header = |name: &str| last.headers.get(name).map(|value| value.as_str().to_owned());
    let number: Option<u64> = header(SEQ).and_then(|text| text.parse().ok());
    let number = number.ok_or_else(|| wrong(format!("a message of {subject} has no number")))?;
    let parts = header(PART).and_then(|text| {
        let (part, count) = text.split_once('/')?;
        Some((part.parse::<u64>().ok()?, count.parse::<u64>().ok()?))
    });
    // A line whose last part is missing is sent again as a whole; readers take its last parts.
    Ok(match parts {
        Some((part, count)) if part + 1 < count => number,
        _ => number + 1,
    })
}
