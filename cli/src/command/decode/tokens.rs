//! Tokens of a vocabulary that may continue a policy prefix.

use std::io::Read;
use std::path::Path;

use motet_decode::vocabulary::{Encoding, MAX_FILE_BYTES};
use motet_decode::{AcceptorFactory, EndToken, Vocabulary};

use super::quoted;
use crate::error::CliError;

/// Maximum number of tokens that are shown.
const SHOWN: usize = 32;

/// Reads the vocabulary of an encoding or a file.
///
/// # Errors
///
/// The file cannot be read, or is not a vocabulary.
pub(super) fn vocabulary(name: &str, end: Option<&str>) -> Result<Vocabulary, CliError> {
    let wrong = |error: motet_decode::VocabularyError| CliError::Message(format!("`{name}`: {error}"));
    if let Some(encoding) = Encoding::named(name) {
        if end.is_some() {
            return Err(CliError::Message(format!("`{name}` defines its end; `--end` is only for files")));
        }
        return Vocabulary::of_encoding(encoding).map_err(wrong);
    }
    let end = match end {
        None => EndToken::Known,
        Some(end) => end.parse().map_or(EndToken::Named(end), EndToken::Number),
    };
    let path = Path::new(name);
    let unread = |source| CliError::read(path, source);
    let file = std::fs::File::open(path).map_err(unread)?;
    let mut bytes = Vec::new();
    // One byte above the limit shows that the file is too large.
    file.take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(unread)?;
    Vocabulary::from_file(&bytes, end).map_err(wrong)
}

/// Describes the tokens that may follow an accepted prefix.
///
/// # Errors
///
/// No policy fits into the budget.
pub(super) fn describe(
    prepared: &AcceptorFactory,
    vocabulary: &Vocabulary,
    prefix: &[u8],
    budget: usize,
) -> Result<String, CliError> {
    let decoder = prepared.decoder(vocabulary, budget);
    let mut decoder =
        decoder.ok_or_else(|| CliError::Message(format!("no policy fits into {budget} bytes")))?;
    decoder.acceptor().accept(prefix);
    let mask = decoder.mask();
    let may = |token: &u32| mask.get(*token as usize / 32).is_some_and(|word| word >> (token % 32) & 1 == 1);
    let count = u32::try_from(vocabulary.len()).unwrap_or(u32::MAX);
    let tokens: Vec<u32> = (0..count).filter(may).collect();
    let mut text = format!("tokens: {} of {count}\n", tokens.len());
    for token in tokens.iter().take(SHOWN) {
        let bytes = vocabulary.bytes(*token);
        let shown = if bytes.is_empty() { "the end".to_owned() } else { quoted(bytes) };
        text.push_str(&format!("  {token} {shown}\n"));
    }
    if tokens.len() > SHOWN {
        text.push_str(&format!("  … {} more\n", tokens.len() - SHOWN));
    }
    Ok(text)
}
