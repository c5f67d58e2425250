//! Lines of a `.jsonl` file, each of bounded length.

use std::io::{self, BufRead, Read};

use motet_syntax::ast::MAX_BYTES;

use super::bytes::Bytes;

/// The next line without its line break; of a line that is too long only the length. Nothing at the end.
pub(super) fn next(reader: &mut impl BufRead) -> io::Result<Option<Bytes>> {
    let mut line = Vec::new();
    let mut length = reader.by_ref().take(MAX_BYTES as u64 + 1).read_until(b'\n', &mut line)?;
    if length == 0 {
        return Ok(None);
    }
    if line.last() == Some(&b'\n') {
        line.pop();
        return Ok(Some(Bytes::All(line)));
    }
    if length <= MAX_BYTES {
        return Ok(Some(Bytes::All(line)));
    }
    loop {
        let (skipped, is_over) = {
            let buffer = reader.fill_buf()?;
            match buffer.iter().position(|byte| *byte == b'\n') {
                Some(end) => (end + 1, true),
                None => (buffer.len(), buffer.is_empty()),
            }
        };
        reader.consume(skipped);
        length += skipped;
        if is_over {
            return Ok(Some(Bytes::TooMany(length)));
        }
    }
}
