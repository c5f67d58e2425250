//! What a mask costs with the vocabulary o200k over the examples, what preparing a scene costs, and which share of the
//! bytes must come next whatever the model means.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::disallowed_methods,
    clippy::indexing_slicing,
    missing_docs,
    reason = "a benchmark that cannot be set up has failed"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::{Duration, Instant};

use motet_decode::{Modifiers, Prepared, Surface, Vocabulary, canonical};
use motet_syntax::{FileId, Source};

/// The tokens with bytes; those above are special.
const TOKENS: u32 = 199_998;
/// `<|endoftext|>`
const END: u32 = 199_999;

fn main() {
    let encoding = tiktoken_rs::o200k_base_singleton();
    let mut tokens: Vec<Vec<u8>> =
        (0..TOKENS).map(|token| encoding.decode_bytes(&[token]).unwrap()).collect();
    tokens.resize(END as usize + 1, Vec::new());
    let vocabulary = Vocabulary::new(&tokens, END);
    let surface = Surface { modifiers: Modifiers::Written, ..Surface::default() };
    let (mut times, mut forced, mut all) = (Vec::new(), 0, 0);
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    for (robot, scene) in [("hsr", "kitchen"), ("hsr", "living_room"), ("anymal_z1", "lab")] {
        let session = common::session(robot, scene);
        let start = Instant::now();
        let prepared = Prepared::new(&session, surface);
        println!("{robot} in {scene}: prepared in {:?}", start.elapsed());
        for file in files.iter().filter(|file| file.extension().is_some_and(|kind| kind == "json")) {
            let text = std::fs::read_to_string(file).unwrap();
            let parsed = motet_syntax::read(&Source::new("policy.json", text.as_str()), FileId(7));
            let policy = parsed.file.policies().next().unwrap();
            if !common::errors(&session, &text).is_empty() {
                continue;
            }
            let Ok(spelled) = canonical(policy, &session.signatures(), surface) else { continue };
            let mut decoder = prepared.decoder(&vocabulary, 20_000).unwrap();
            for token in encoding.encode_ordinary(&spelled) {
                let start = Instant::now();
                let mask = decoder.mask();
                let taken = start.elapsed();
                times.push(taken);
                let is_set = mask[token as usize / 32] >> (token % 32) & 1 == 1;
                if taken > Duration::from_millis(5) {
                    let bytes = decoder.acceptor().bytes();
                    let from = bytes.len().saturating_sub(60);
                    println!("{taken:?} after …{}", String::from_utf8_lossy(&bytes[from..]));
                }
                assert!(is_set);
                assert!(decoder.accept(token));
            }
            let mut acceptor = prepared.acceptor(20_000).unwrap();
            while !acceptor.is_accepting() {
                let must = acceptor.forced();
                forced += must.len();
                acceptor.accept(&must);
                let at = acceptor.bytes().len();
                acceptor.accept(&spelled.as_bytes()[at..(at + 1).min(spelled.len())]);
            }
            all += spelled.len();
        }
    }
    times.sort_unstable();
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    let mean = times.iter().sum::<Duration>() / u32::try_from(times.len()).unwrap();
    println!(
        "{} masks: mean {mean:?}, p50 {:?}, p99 {:?}, max {:?}",
        times.len(),
        at(0.5),
        at(0.99),
        at(1.0)
    );
    println!("{forced} of {all} bytes are forced");
}
