//! Vocabularies from `tokenizer.json` of Hugging Face.
//!
//! Only what a mask needs is read: the bytes that each token stands for. Splitting a text into tokens is the host's, which
//! has its tokenizer anyhow; so the crate `tokenizers`, with its regular expressions and normalisers, is not needed here.

use serde_json::{Map, Value};

use super::token_list::{MAX_FILE_BYTES, Tokens};
use super::{EndToken, Vocabulary, VocabularyError};

/// How tokens say their bytes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Spelling {
    /// A printable character for each byte, as GPT-2 has it.
    ByteLevel,
    /// Characters as they are, a space as `▁`, and `<0x0A>` for a byte by itself, as SentencePiece has it.
    Pieces,
}

impl Vocabulary {
    /// The vocabulary of a `tokenizer.json`: byte-level BPE, and SentencePiece-like BPE or Unigram with or without bytes to fall
    /// back to. Special tokens are never allowed, but for the end. O(bytes of the file).
    ///
    /// # Errors
    ///
    /// The file is no `tokenizer.json`, of a kind whose tokens are not joined byte by byte (`WordPiece`, `WordLevel`), over a
    /// limit of [`super`], or the end is not to be found.
    pub fn from_tokenizer_json(file: &[u8], end: EndToken<'_>) -> Result<Self, VocabularyError> {
        let file = json(file)?;
        let model = object(file.get("model"), "model")?;
        let kind = model.get("type").and_then(Value::as_str).unwrap_or("BPE");
        if !matches!(kind, "BPE" | "Unigram") {
            return Err(VocabularyError::Unsupported(kind.to_owned()));
        }
        let spelling = spelling(&file, kind)?;
        let mut tokens = Tokens::default();
        match model.get("vocab") {
            Some(Value::Object(vocab)) => {
                for (name, number) in vocab {
                    let number =
                        id(Some(number)).ok_or_else(|| wrong(format!("model.vocab.{name}"), NUMBER))?;
                    tokens.add(number, spelling.bytes(number, name)?)?;
                    tokens.name(name, number);
                }
            }
            Some(Value::Array(vocab)) => {
                for (number, piece) in (0u32..).zip(vocab) {
                    let name = piece.get(0).and_then(Value::as_str);
                    let name = name.ok_or_else(|| wrong(format!("model.vocab.{number}.0"), "a text"))?;
                    tokens.add(number, spelling.bytes(number, name)?)?;
                    tokens.name(name, number);
                }
            }
            _ => return Err(wrong("model.vocab", "an object or a list")),
        }
        // What stands for the unknown stands for no bytes.
        let unknown = model.get("unk_token").and_then(Value::as_str);
        let by_name = unknown.and_then(|name| id(model.get("vocab").and_then(|vocab| vocab.get(name))));
        if let Some(number) = by_name.or_else(|| id(model.get("unk_id"))) {
            tokens.replace(number, Vec::new())?;
        }
        added(&file, &mut tokens)?;
        tokens.vocabulary(end)
    }
}

const NUMBER: &str = "the number of a token";

/// Adds what is not in the model's own vocabulary, and marks what is special.
fn added(file: &Map<String, Value>, tokens: &mut Tokens) -> Result<(), VocabularyError> {
    let list = match file.get("added_tokens") {
        None | Some(Value::Null) => return Ok(()),
        Some(Value::Array(list)) => list,
        Some(_) => return Err(wrong("added_tokens", "a list")),
    };
    for (index, token) in list.iter().enumerate() {
        let place = |key| format!("added_tokens.{index}.{key}");
        let number = id(token.get("id")).ok_or_else(|| wrong(place("id"), NUMBER))?;
        let text = token.get("content").and_then(Value::as_str);
        let text = text.ok_or_else(|| wrong(place("content"), "a text"))?;
        let is_special = token.get("special").and_then(Value::as_bool).unwrap_or(false);
        let bytes = if is_special { Vec::new() } else { text.as_bytes().to_vec() };
        tokens.replace(number, bytes)?;
        tokens.name(text, number);
    }
    Ok(())
}

fn spelling(file: &Map<String, Value>, kind: &str) -> Result<Spelling, VocabularyError> {
    let parts = ["decoder", "pre_tokenizer", "normalizer"].map(|key| file.get(key));
    let any = |holds: &dyn Fn(&Value) -> bool| parts.iter().flatten().any(|part| has(part, holds));
    let named = |part: &Value, name: &str| part.get("type").and_then(Value::as_str) == Some(name);
    if any(&|part| named(part, "ByteLevel")) {
        return Ok(Spelling::ByteLevel);
    }
    let replaces_space = |part: &Value| {
        named(part, "Replace")
            && [part.get("content"), part.pointer("/pattern/String")].contains(&Some(&"▁".into()))
    };
    if kind == "Unigram"
        || any(&|part| named(part, "Metaspace") || named(part, "ByteFallback") || replaces_space(part))
    {
        return Ok(Spelling::Pieces);
    }
    Err(VocabularyError::Unsupported(format!("{kind} without ByteLevel or Metaspace")))
}

/// Whether a part, or one of those that it is a sequence of, has a property.
fn has(part: &Value, holds: &dyn Fn(&Value) -> bool) -> bool {
    let members = ["decoders", "pretokenizers", "normalizers"].into_iter();
    let mut members = members.filter_map(|key| part.get(key).and_then(Value::as_array)).flatten();
    holds(part) || members.any(|member| has(member, holds))
}

impl Spelling {
    fn bytes(self, number: u32, name: &str) -> Result<Vec<u8>, VocabularyError> {
        match self {
            Self::ByteLevel => {
                let byte =
                    |character| byte_of(character).ok_or(VocabularyError::NoByte { number, character });
                // What has other characters is a special token that is not marked as one: its mark comes later.
                let bytes: Result<Vec<u8>, _> = name.chars().map(byte).collect();
                if name.starts_with('<') && name.ends_with('>') {
                    Ok(bytes.unwrap_or_default())
                } else {
                    bytes
                }
            }
            Self::Pieces => {
                let hex = name.strip_prefix("<0x").and_then(|rest| rest.strip_suffix('>'));
                let byte = hex.filter(|hex| hex.len() == 2).and_then(|hex| u8::from_str_radix(hex, 16).ok());
                Ok(byte.map_or_else(|| name.replace('▁', " ").into_bytes(), |byte| vec![byte]))
            }
        }
    }
}

/// The byte that a character stands for: itself where it is printable and no space, else those from U+0100 on, in order.
fn byte_of(character: char) -> Option<u8> {
    let is_plain = |byte: u8| matches!(byte, b'!'..=b'~' | 0xA1..=0xAC | 0xAE..=0xFF);
    if let Ok(byte) = u8::try_from(u32::from(character)) {
        return is_plain(byte).then_some(byte);
    }
    let place = u32::from(character).checked_sub(0x100)?;
    (0..=u8::MAX).filter(|byte| !is_plain(*byte)).nth(usize::try_from(place).ok()?)
}

pub(super) fn json(file: &[u8]) -> Result<Map<String, Value>, VocabularyError> {
    if file.len() > MAX_FILE_BYTES {
        return Err(VocabularyError::TooMuch { what: "bytes", found: file.len(), most: MAX_FILE_BYTES });
    }
    serde_json::from_slice(file).map_err(|error| VocabularyError::NotJson(error.to_string()))
}

fn object<'v>(value: Option<&'v Value>, place: &str) -> Result<&'v Map<String, Value>, VocabularyError> {
    value.and_then(Value::as_object).ok_or_else(|| wrong(place, "an object"))
}

fn id(value: Option<&Value>) -> Option<u32> {
    value?.as_u64().and_then(|number| u32::try_from(number).ok())
}

pub(super) fn wrong(place: impl Into<String>, wanted: &'static str) -> VocabularyError {
    VocabularyError::Wrong { place: place.into(), wanted }
}
