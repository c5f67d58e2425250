//! Vocabularies: the tokens of a language model as bytes.

use motet_decode::{EndToken, Vocabulary};

use crate::border::{free, guarded, handle, shared, slice};

/// The end of a sequence is the token with a well-known name.
pub const MOTET_END_KNOWN: i64 = -1;

/// Bytes; not ended by a null byte.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MotetBytes {
    /// Address of the first byte; may be null if there are none.
    pub data: *const u8,
    /// The number of bytes.
    pub len: usize,
}

/// The tokens of a language model.
pub struct MotetVocabulary(pub(crate) Vocabulary);

/// Creates a vocabulary of `count` tokens in the order of their numbers; one without bytes is special, and
/// never allowed. `end` is the token that ends a sequence. Null on an error.
///
/// # Safety
///
/// `tokens` is null or points to `count` values, and each of them to as many bytes as it says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_vocabulary_new(
    tokens: *const MotetBytes,
    count: usize,
    end: u32,
) -> *mut MotetVocabulary {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let tokens = unsafe { slice(tokens, count, "tokens")? };
        // SAFETY: as the function's.
        let bytes = |token: &MotetBytes| unsafe { slice(token.data, token.len, "token") }.map(<[u8]>::to_vec);
        let tokens = tokens.iter().map(bytes).collect::<Result<_, _>>()?;
        let vocabulary = Vocabulary::from_tokens(tokens, end).map_err(|error| error.to_string())?;
        Ok(handle(MotetVocabulary(vocabulary)))
    })
}

/// Reads a vocabulary from a file: `tokenizer.json` of Hugging Face, a list in JSON, or lines of base64 such
/// as the ranks of tiktoken. `end` is the token that ends a sequence, or [`MOTET_END_KNOWN`]. Null on an
/// error.
///
/// # Safety
///
/// `file` is null or points to `len` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_vocabulary_read(
    file: *const u8,
    len: usize,
    end: i64,
) -> *mut MotetVocabulary {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let file = unsafe { slice(file, len, "file")? };
        let end = match u32::try_from(end) {
            Ok(end) => EndToken::Number(end),
            Err(_) if end == MOTET_END_KNOWN => EndToken::Known,
            Err(_) => return Err(format!("{end} is no token")),
        };
        let vocabulary = Vocabulary::from_file(file, end).map_err(|error| error.to_string())?;
        Ok(handle(MotetVocabulary(vocabulary)))
    })
}

/// Returns the number of 32-bit words of a mask; 0 on an error.
///
/// # Safety
///
/// `vocabulary` is null or a live vocabulary.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_vocabulary_mask_words(vocabulary: *const MotetVocabulary) -> usize {
    // SAFETY: as the function's.
    guarded(0, || Ok(unsafe { shared(vocabulary, "vocabulary")? }.0.len().div_ceil(32)))
}

/// Frees a vocabulary; null does nothing. Decoders of it stay valid.
///
/// # Safety
///
/// `vocabulary` is null or a live vocabulary, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_vocabulary_free(vocabulary: *mut MotetVocabulary) {
    // SAFETY: as the function's.
    unsafe { free(vocabulary) };
}
