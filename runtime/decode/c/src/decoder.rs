//! Decoders: token masks for one policy that is being written.

use std::ffi::c_char;

use motet_decode::Decoder;
use motet_syntax::{Source, Sources, render};

use crate::border::{exclusive, free, guarded, handle, shared, slice, slice_mut, string_out};
use crate::environment::MotetEnvironment;
use crate::vocabulary::MotetVocabulary;

/// The outcome of a function.
#[repr(C)]
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum MotetStatus {
    /// Done, or yes.
    Ok = 0,
    /// Not allowed, or no: nothing has changed.
    Refused = 1,
    /// Failed: see `motet_last_error`.
    Error = 2,
}

/// Follows one policy, token by token. After a fault in the library itself it cannot be used any more.
pub struct MotetDecoder {
    decoder: Option<Decoder>,
    /// The number of words of a mask.
    words: usize,
}

impl MotetDecoder {
    /// Runs an operation that may fail half-way: the decoder is put back only if it did not.
    fn with<T>(&mut self, run: impl FnOnce(&mut Decoder) -> Result<T, String>) -> Result<T, String> {
        let mut decoder = self.decoder.take().ok_or_else(|| "the decoder failed before".to_owned())?;
        let ran = run(&mut decoder);
        self.decoder = Some(decoder);
        ran
    }
}

/// Creates a decoder for a policy of at most `budget` bytes. Null on an error, such as a budget that no
/// policy fits.
///
/// # Safety
///
/// `environment` and `vocabulary` are null or live.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_new(
    environment: *const MotetEnvironment,
    vocabulary: *const MotetVocabulary,
    budget: usize,
) -> *mut MotetDecoder {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let environment = unsafe { shared(environment, "environment")? };
        // SAFETY: as the function's.
        let vocabulary = unsafe { shared(vocabulary, "vocabulary")? };
        let decoder = environment.prepared.decoder(&vocabulary.0, budget);
        let decoder = decoder.ok_or_else(|| format!("no policy has at most {budget} bytes"))?;
        Ok(handle(MotetDecoder { decoder: Some(decoder), words: vocabulary.0.len().div_ceil(32) }))
    })
}

/// Creates another decoder in the same state. Null on an error.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_clone(decoder: *mut MotetDecoder) -> *mut MotetDecoder {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        let clone = decoder.with(|decoder| Ok(decoder.clone()))?;
        Ok(handle(MotetDecoder { decoder: Some(clone), words: decoder.words }))
    })
}

/// Frees a decoder; null does nothing.
///
/// # Safety
///
/// `decoder` is null or live, and is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_free(decoder: *mut MotetDecoder) {
    // SAFETY: as the function's.
    unsafe { free(decoder) };
}

/// Writes the mask of the tokens that may follow: token `t` is bit `t % 32` of word `t / 32`. `count` is at
/// least `motet_vocabulary_mask_words`; further words become 0.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile; `words` is null or has room for `count`
/// words.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_mask(
    decoder: *mut MotetDecoder,
    words: *mut u32,
    count: usize,
) -> MotetStatus {
    // SAFETY: as the function's.
    unsafe { write_mask(decoder, words, count, Decoder::mask) }
}

/// Writes the mask as `motet_decoder_mask` does, with a limit of its time: `effort` is what the checker may
/// look at, and 20,000 take about half a millisecond. `Refused` if that was not enough. Then the mask has all
/// tokens that may follow, and others that only names and types allow: where `motet_decoder_accept` refuses
/// the chosen token, ask for the mask again, which lacks that token, and choose another one.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile; `words` is null or has room for `count`
/// words.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_mask_within(
    decoder: *mut MotetDecoder,
    effort: u64,
    words: *mut u32,
    count: usize,
) -> MotetStatus {
    // SAFETY: as the function's.
    unsafe { write_mask(decoder, words, count, |decoder| decoder.mask_within(effort)) }
}

/// Writes a mask that a decoder computes.
///
/// # Safety
///
/// As [`motet_decoder_mask`].
unsafe fn write_mask(
    decoder: *mut MotetDecoder,
    words: *mut u32,
    count: usize,
    mask: impl FnOnce(&mut Decoder) -> &[u32],
) -> MotetStatus {
    guarded(MotetStatus::Error, || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        // SAFETY: as the function's.
        let words = unsafe { slice_mut(words, count, "mask")? };
        let wanted = decoder.words;
        decoder.with(|decoder| {
            let mask = mask(decoder).get(..wanted).unwrap_or_default();
            let Some((begin, rest)) = words.split_at_mut_checked(mask.len()) else {
                return Err(format!("the mask has room for {count} words and needs {wanted}"));
            };
            begin.copy_from_slice(mask);
            rest.fill(0);
            Ok(yes(!decoder.is_wide()))
        })
    })
}

/// Takes a token if it may follow.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_accept(decoder: *mut MotetDecoder, token: u32) -> MotetStatus {
    guarded(MotetStatus::Error, || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        decoder.with(|decoder| Ok(yes(decoder.accept(token))))
    })
}

/// Takes back the last tokens, or all if there are fewer.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_rollback(decoder: *mut MotetDecoder, tokens: usize) -> MotetStatus {
    guarded(MotetStatus::Error, || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        decoder.with(|decoder| {
            decoder.rollback(tokens);
            Ok(MotetStatus::Ok)
        })
    })
}

/// Answers if the text so far is a whole policy: then, and only then, the end of the sequence may follow.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_is_accepting(decoder: *mut MotetDecoder) -> MotetStatus {
    guarded(MotetStatus::Error, || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        decoder.with(|decoder| Ok(yes(decoder.acceptor().is_accepting())))
    })
}

/// Returns the text that must come next whatever the model means; empty if there is a choice. Freed with
/// `motet_string_free`. Null on an error.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_forced(decoder: *mut MotetDecoder) -> *mut c_char {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        decoder.with(|decoder| Ok(string_out(decoder.acceptor().forced())))
    })
}

/// Returns the text so far. Freed with `motet_string_free`. Null on an error.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_text(decoder: *mut MotetDecoder) -> *mut c_char {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        decoder.with(|decoder| Ok(string_out(decoder.acceptor().bytes())))
    })
}

/// Explains the refusal of bytes: the errors of the checker as JSON objects, one a line; empty if the bytes
/// may follow, or if only their spelling is refused. Freed with `motet_string_free`. Null on an error.
///
/// # Safety
///
/// `decoder` is null or live, and nobody else uses it meanwhile; `bytes` is null or points to `len` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_decoder_why_not(
    decoder: *mut MotetDecoder,
    bytes: *const u8,
    len: usize,
) -> *mut c_char {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let decoder = unsafe { exclusive(decoder, "decoder")? };
        // SAFETY: as the function's.
        let bytes = unsafe { slice(bytes, len, "continuation")? };
        decoder.with(|decoder| {
            let mut text = decoder.acceptor().bytes().to_vec();
            text.extend_from_slice(bytes);
            let mut sources = Sources::default();
            sources.add(Source::new("policy.json", String::from_utf8_lossy(&text)));
            Ok(string_out(render::json(&decoder.acceptor().why_not(bytes), &sources)))
        })
    })
}

fn yes(holds: bool) -> MotetStatus {
    if holds { MotetStatus::Ok } else { MotetStatus::Refused }
}

/// The thread safety that the documentation promises.
const _: fn() = || {
    fn is_shared<T: Send + Sync>() {}
    fn is_sent<T: Send>() {}
    is_shared::<MotetEnvironment>();
    is_shared::<MotetVocabulary>();
    is_sent::<MotetDecoder>();
};
