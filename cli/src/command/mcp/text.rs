//! Texts of calls, which are bounded.

use motet_project::DOCUMENT;
use motet_syntax::{Parsed, Source};

use super::answer::Refusal;

/// The most bytes of a policy, a request or another text of a call.
pub(super) const MAX_TEXT_BYTES: usize = 128 * 1024;

/// Refuses a text that is too long.
pub(super) fn within(what: &str, text: &str) -> Result<(), Refusal> {
    if text.len() <= MAX_TEXT_BYTES {
        return Ok(());
    }
    Err(Refusal::new(format!("the {what} has {} bytes, at most {MAX_TEXT_BYTES} are taken", text.len())))
}

/// Reads a policy of a call.
pub(super) fn read(text: &str) -> Result<(Source, Parsed), Refusal> {
    within("policy", text)?;
    let source = Source::new("policy", text);
    let parsed = motet_syntax::read(&source, DOCUMENT);
    Ok((source, parsed))
}
