//! Vocabularies from plain lists of byte strings: JSON, or lines of base64 as tiktoken keeps its ranks.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;

use super::huggingface::wrong;
use super::token_list::{MAX_FILE_BYTES, Tokens};
use super::{EndToken, Vocabulary, VocabularyError};

impl Vocabulary {
    /// The vocabulary of a file in any of the forms that are read: `tokenizer.json` where it is an object, a list of JSON where
    /// it is one, else lines of base64.
    ///
    /// # Errors
    ///
    /// As the form has them.
    pub fn from_file(file: &[u8], end: EndToken<'_>) -> Result<Self, VocabularyError> {
        match file.trim_ascii_start().first() {
            Some(b'{') => Self::from_tokenizer_json(file, end),
            Some(b'[') => Self::from_json_list(file, end),
            _ => Self::from_base64_lines(file, end),
        }
    }

    /// The vocabulary of a list in JSON: of each token, in the order of their numbers, a text, a list of bytes, or `null` for a
    /// special one.
    ///
    /// # Errors
    ///
    /// It is no such list, over a limit of [`super`], or lacks the end, which has to be said by its number.
    pub fn from_json_list(file: &[u8], end: EndToken<'_>) -> Result<Self, VocabularyError> {
        if file.len() > MAX_FILE_BYTES {
            return Err(VocabularyError::TooMuch { what: "bytes", found: file.len(), most: MAX_FILE_BYTES });
        }
        let list: Vec<Value> =
            serde_json::from_slice(file).map_err(|error| VocabularyError::NotJson(error.to_string()))?;
        let mut tokens = Tokens::default();
        for (number, token) in (0u32..).zip(&list) {
            let wanted = || wrong(number.to_string(), "a text, a list of bytes or null");
            let bytes = match token {
                Value::Null => Vec::new(),
                Value::String(text) => {
                    tokens.name(text, number);
                    text.clone().into_bytes()
                }
                Value::Array(bytes) => {
                    let byte = |byte: &Value| byte.as_u64().and_then(|byte| u8::try_from(byte).ok());
                    bytes.iter().map(byte).collect::<Option<_>>().ok_or_else(wanted)?
                }
                Value::Bool(_) | Value::Number(_) | Value::Object(_) => return Err(wanted()),
            };
            tokens.add(number, bytes)?;
        }
        tokens.vocabulary(end)
    }

    /// The vocabulary of lines in base64, each with its number behind a space or in their order. An empty line is a special
    /// token. Ranks have no special tokens: the end may have the number behind the last.
    ///
    /// # Errors
    ///
    /// A line is no base64, the list is over a limit of [`super`], or lacks the end, which has to be said by its number.
    pub fn from_base64_lines(file: &[u8], end: EndToken<'_>) -> Result<Self, VocabularyError> {
        if file.len() > MAX_FILE_BYTES {
            return Err(VocabularyError::TooMuch { what: "bytes", found: file.len(), most: MAX_FILE_BYTES });
        }
        let file = file.strip_suffix(b"\n").unwrap_or(file);
        let (mut tokens, mut next) = (Tokens::default(), 0u32);
        for (index, line) in file.split(|byte| *byte == b'\n').enumerate() {
            let unread = || VocabularyError::Line { line: index + 1 };
            let line = std::str::from_utf8(line.trim_ascii()).map_err(|_| unread())?;
            let (token, number) = match line.split_once(' ') {
                Some((token, number)) => (token, number.parse().map_err(|_| unread())?),
                None => (line, next),
            };
            tokens.add(number, STANDARD.decode(token).map_err(|_| unread())?)?;
            next = number.saturating_add(1);
        }
        if let EndToken::Number(number) = end
            && number == next
        {
            tokens.add(number, Vec::new())?;
        }
        tokens.vocabulary(end)
    }
}
