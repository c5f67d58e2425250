//! Any bytes as a document: read it, print it in both syntaxes, format it.

#![no_main]

use libfuzzer_sys::fuzz_target;
use motet_syntax::{FileId, Source, print};

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = motet_syntax::decode(bytes, FileId(0)) else { return };
    let source = Source::new("fuzz", text);
    let parsed = motet_syntax::read(&source, FileId(0));
    let _ = print::text(&parsed.file);
    for policy in parsed.file.policies() {
        let _ = print::policy_json(policy);
    }
    let _ = motet_syntax::format(&source);
});
