//! What a language model may write next, for hosts in C: `include/motet.h` says what there is.
//!
//! What is here only carries values over the border. Handles are opaque; a null pointer or a wrong length
//! is an error and no crash; a panic does not leave the library, and what it may have left half done is not
//! used again. An error is told by what a function returns, and in words by [`motet_last_error`], a thread
//! at a time.
//!
//! A world and a vocabulary can be used by many threads at once, a decoder by one at a time.

mod border;
mod decoder;
mod vocabulary;
mod world;

pub use border::{motet_last_error, motet_string_free};
pub use decoder::{
    MotetDecoder, MotetStatus, motet_decoder_accept, motet_decoder_clone, motet_decoder_forced,
    motet_decoder_free, motet_decoder_is_accepting, motet_decoder_mask, motet_decoder_new,
    motet_decoder_rollback, motet_decoder_text, motet_decoder_why_not,
};
pub use vocabulary::{
    MOTET_END_KNOWN, MotetBytes, MotetVocabulary, motet_vocabulary_free, motet_vocabulary_mask_words,
    motet_vocabulary_new, motet_vocabulary_read,
};
pub use world::{MotetWorld, MotetWorldTexts, motet_world_check, motet_world_free, motet_world_new};
