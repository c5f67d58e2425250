//! The fuzzers' seeds, and what once did harm, go through every reader and every stage: none panics or hangs.

use std::path::PathBuf;

use motet_compiler::Session;
use motet_syntax::{FileId, Source, Sources, print};

const CORPUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/corpus");

#[test]
fn reader_every_seed_is_survived() {
    let session = Session::builder().build(&mut Sources::default());
    let mut seeds = 0;
    let mut waiting = vec![PathBuf::from(CORPUS)];
    while let Some(path) = waiting.pop() {
        if path.is_dir() {
            waiting.extend(std::fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            continue;
        }
        let bytes = std::fs::read(&path).unwrap();
        seeds += 1;
        let Ok(text) = motet_syntax::decode(&bytes, FileId(u16::MAX)) else { continue };
        let source = Source::new(path.display().to_string(), text);
        let parsed = motet_syntax::read(&source, FileId(u16::MAX));
        let _ = session.check(&parsed);
        let _ = session.compile(&parsed, None);
        let _ = print::text(&parsed.file);
        for policy in parsed.file.policies() {
            let _ = print::policy_json(policy);
        }
        let _ = motet_syntax::format(&source);
        let _ = motet_robots::scene::read(&source, FileId(0));
        let _ = motet_robots::card::read(&source, FileId(0), None);
    }
    assert!(seeds >= 15, "there are {seeds} seeds");
}
