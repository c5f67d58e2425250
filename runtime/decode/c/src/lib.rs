#![doc = include_str!("../README.md")]

mod border;
mod decoder;
mod environment;
mod vocabulary;

pub use border::{motet_last_error, motet_string_free};
pub use decoder::{
    MotetDecoder, MotetStatus, motet_decoder_accept, motet_decoder_clone, motet_decoder_forced,
    motet_decoder_free, motet_decoder_is_accepting, motet_decoder_mask, motet_decoder_mask_within,
    motet_decoder_new, motet_decoder_rollback, motet_decoder_text, motet_decoder_why_not,
};
pub use environment::{
    MotetEnvironment, MotetEnvironmentTexts, motet_environment_check, motet_environment_free,
    motet_environment_new,
};
pub use vocabulary::{
    MOTET_END_KNOWN, MotetBytes, MotetVocabulary, motet_vocabulary_free, motet_vocabulary_mask_words,
    motet_vocabulary_new, motet_vocabulary_read,
};
