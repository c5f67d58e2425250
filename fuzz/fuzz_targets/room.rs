//! Any bytes as a scene and as a robot card.

#![no_main]

use libfuzzer_sys::fuzz_target;
use motet_syntax::{FileId, Source};

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = motet_syntax::decode(bytes, FileId(0)) else { return };
    let source = Source::new("fuzz", text);
    let _ = motet_robots::scene::read(&source, FileId(0));
    let _ = motet_robots::card::read(&source, FileId(0), None);
});
