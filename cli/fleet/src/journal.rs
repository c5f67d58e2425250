//! Journals of orders as the server has them: their lines, and the page that shows them.

use crate::link::{Fleet, JOURNALS};
use crate::ship::{PART, SEQ};
use async_nats::jetstream::consumer::{self, AckPolicy, DeliverPolicy};
use futures::StreamExt as _;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::Duration;

/// Time for `motet view` to write a page.
const WRITES: Duration = Duration::from_secs(120);

/// Lines of a journal from the server, checked for gaps: at least one, and in all at most so many bytes.
pub(crate) async fn lines(
    fleet: &Fleet,
    robot: &str,
    order: &str,
    most: usize,
) -> Result<Vec<Vec<u8>>, String> {
    let wrong = |error: String| format!("the journal: {error}");
    let stream = fleet.js.get_stream(JOURNALS).await.map_err(|error| wrong(error.to_string()))?;
    let config = consumer::pull::Config {
        filter_subject: format!("motet.journal.{robot}.{order}"),
        deliver_policy: DeliverPolicy::All,
        ack_policy: AckPolicy::None,
        ..consumer::pull::Config::default()
    };
    let mut consumer = stream.create_consumer(config).await.map_err(|error| wrong(error.to_string()))?;
    let waiting = consumer.info().await.map_err(|error| wrong(error.to_string()))?.num_pending;
    let (mut lines, mut size): (Vec<Vec<u8>>, usize) = (Vec::new(), 0);
    let mut messages = consumer.messages().await.map_err(|error| wrong(error.to_string()))?;
    for _ in 0..waiting {
        let message = messages.next().await.ok_or_else(|| wrong("it ends early".to_owned()))?;
        let message = message.map_err(|error| wrong(error.to_string()))?;
        size = size.saturating_add(message.payload.len());
        if size > most {
            return Err(wrong(format!("it has more than {} MiB", most / 1024 / 1024)));
        }
        let header = |name: &str| {
            message.headers.as_ref().and_then(|headers| Some(headers.get(name)?.as_str().to_owned()))
        };
        let number: usize = header(SEQ)
            .and_then(|text| text.parse().ok())
            .ok_or_else(|| wrong("a line has no number".to_owned()))?;
        let is_first = header(PART).is_none_or(|part| part.starts_with("0/"));
        let whole = || message.payload.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec);
        match number {
            _ if number == lines.len() && is_first => lines.extend(whole()),
            // A further part of the last line, or the last line again after the link was cut.
            _ if number + 1 == lines.len() && is_first => {
                lines.truncate(number);
                lines.extend(whole());
            }
            _ if number + 1 == lines.len() => lines[number].extend(message.payload.iter()),
            _ => return Err(wrong(format!("line {} is followed by line {number}", lines.len()))),
        }
    }
    if lines.is_empty() { Err("the server has no line of this journal".to_owned()) } else { Ok(lines) }
}

/// Writes lines into a new folder, as a journal that `motet` reads.
pub(crate) fn write(lines: &[Vec<u8>], folder: &Path) -> Result<(), String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir(folder).map_err(wrong)?;
    std::fs::write(folder.join("000000000000.journal"), lines.concat()).map_err(wrong)
}

/// Page of a journal in one file, which `motet view` writes.
pub(crate) async fn page(motet: &Path, lines: &[Vec<u8>]) -> Result<Vec<u8>, String> {
    let folder = Scratch::new()?;
    let (journal, page) = (folder.0.join("run"), folder.0.join("run.html"));
    write(lines, &journal)?;
    let mut command = tokio::process::Command::new(motet);
    command.arg("view").arg(&journal).arg("--output").arg(&page);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).kill_on_drop(true);
    let ended = tokio::time::timeout(WRITES, command.output()).await;
    let ended = ended.map_err(|_| "`motet view` takes too long".to_owned())?;
    let ended = ended.map_err(|error| format!("cannot start `{}`: {error}", motet.display()))?;
    if !ended.status.success() {
        let said = String::from_utf8_lossy(&ended.stderr);
        let why: String = said.lines().last().unwrap_or("no reason").chars().take(500).collect();
        return Err(format!("`motet view` cannot show the journal: {why}"));
    }
    std::fs::read(&page).map_err(|error| format!("{}: {error}", page.display()))
}

/// Folder of its owner alone, which goes with its last use.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Result<Self, String> {
        let folder = std::env::temp_dir().join(format!("motet-fleet-{}", crate::signed::new_id()?));
        let mut builder = std::fs::DirBuilder::new();
        #[cfg(unix)]
        std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
        builder.create(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        Ok(Self(folder))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}
