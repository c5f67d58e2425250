//! C interface of the constrained decoder: the functions of `include/motet.h`.
//!
//! The crate only carries values over the border. Handles are opaque. A null pointer or a wrong length is an
//! error and no crash. A panic does not leave the library, and the value that it may have left half done is
//! not used again. A function returns a status or null, and [`motet_last_error`] has the reason, for each
//! thread.
//!
//! An environment and a vocabulary can be used by many threads at once, a decoder by one at a time.

mod border;
mod decoder;
mod environment;
mod vocabulary;

pub use border::{motet_last_error, motet_string_free};
pub use decoder::{
    MotetDecoder, MotetStatus, motet_decoder_accept, motet_decoder_clone, motet_decoder_forced,
    motet_decoder_free, motet_decoder_is_accepting, motet_decoder_mask, motet_decoder_new,
    motet_decoder_rollback, motet_decoder_text, motet_decoder_why_not,
};
pub use environment::{
    MotetEnvironment, MotetEnvironmentTexts, motet_environment_check, motet_environment_free,
    motet_environment_new,
};
pub use vocabulary::{
    MOTET_END_KNOWN, MotetBytes, MotetVocabulary, motet_vocabulary_free, motet_vocabulary_mask_words,
    motet_vocabulary_new, motet_vocabulary_read,
};
