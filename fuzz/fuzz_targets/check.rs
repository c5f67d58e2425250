//! Any bytes as a document, through every stage.

#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use motet_compiler::Session;
use motet_syntax::{FileId, Source, Sources};

static SESSION: LazyLock<Session> = LazyLock::new(|| Session::builder().build(&mut Sources::default()));

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = motet_syntax::decode(bytes, FileId(u16::MAX)) else { return };
    let parsed = motet_syntax::read(&Source::new("fuzz", text), FileId(u16::MAX));
    let _ = SESSION.check(&parsed);
    let _ = SESSION.compile(&parsed, None);
});
