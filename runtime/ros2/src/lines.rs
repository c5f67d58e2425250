//! Lines of the host on standard input.

use crossbeam_channel::Receiver;
use std::io::BufRead;

/// Longest line in bytes.
const MAX_LINE: u64 = 1024 * 1024;

/// Line of the host, or the end of its lines.
pub(crate) enum Line {
    Text(String),
    Wrong(String),
    End,
}

/// Reads the lines of the host on a thread.
pub(crate) fn read_lines(mut input: impl BufRead + Send + 'static) -> Receiver<Line> {
    let (sender, lines) = crossbeam_channel::bounded(1024);
    std::thread::spawn(move || {
        loop {
            let mut bytes = Vec::new();
            let read = std::io::Read::take(&mut input, MAX_LINE + 1).read_until(b'\n', &mut bytes);
            let line = match read {
                Ok(0) | Err(_) => Line::End,
                Ok(_) if bytes.len() as u64 > MAX_LINE => {
                    Line::Wrong(format!("a line has more than {MAX_LINE} bytes"))
                }
                Ok(_) => String::from_utf8(bytes)
                    .map_or_else(|_| Line::Wrong("a line is not UTF-8".to_owned()), Line::Text),
            };
            let is_last = !matches!(line, Line::Text(_));
            if sender.send(line).is_err() || is_last {
                return;
            }
        }
    });
    lines
}
