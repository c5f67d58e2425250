//! Times of masks with the vocabulary o200k, in both syntaxes: at each token of the examples and of policies
//! written at random, 200 to 600 tokens long, beside those of llguidance on the exported grammar. Also the
//! times of preparing a scene and of 5,000 entities, and the share of forced bytes in the examples. A time is
//! of the mask alone; taking the token is measured apart.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::disallowed_methods,
    clippy::indexing_slicing,
    missing_docs,
    reason = "a benchmark that cannot be set up has failed"
)]

#[path = "../tests/decode/common/mod.rs"]
mod common;

use std::time::{Duration, Instant};

use common::peer::Peer;
use motet_compiler::Session;
use motet_decode::{AcceptorFactory, Grammar, Modifiers, Subset, Vocabulary, canonical};
use motet_syntax::{FileId, Source, Sources, Syntax};

/// The tokens with bytes; those above are special.
const TOKENS: u32 = 199_998;
/// `<|endoftext|>`
const END: u32 = 199_999;
/// The limit of a mask: facts that proofs look at.
const EFFORT: u64 = 20_000;
/// The number of policies written at random for each robot and scene: 21 in all.
const WRITTEN: usize = 7;

fn main() {
    let encoding = tiktoken_rs::o200k_base_singleton();
    let mut tokens: Vec<Vec<u8>> =
        (0..TOKENS).map(|token| encoding.decode_bytes(&[token]).unwrap()).collect();
    tokens.resize(END as usize + 1, Vec::new());
    let vocabulary = Vocabulary::new(&tokens, END);
    let environment = common::peer::environment(&tokens, END);
    for syntax in [Syntax::Json, Syntax::Text] {
        println!("{syntax:?}");
        let subset = Subset { modifiers: Modifiers::Written, syntax, ..Subset::default() };
        let (mut examples, mut written) = (Times::default(), Times::default());
        let (mut forced, mut all) = (0, 0);
        for (robot, scene) in [("hsr", "kitchen"), ("hsr", "living_room"), ("anymal_z1", "lab")] {
            let session = common::session(robot, scene);
            let mut taken: Vec<Duration> =
                (0..21).map(|_| time(|| AcceptorFactory::new(&session, subset)).1).collect();
            taken.sort_unstable();
            println!("{robot} in {scene}: prepared in {:?} at the median of 21", taken[10]);
            let prepared = AcceptorFactory::new(&session, subset);
            // With a memo of its own.
            let limited = AcceptorFactory::new(&session, subset);
            let (peer, taken) = time(|| Peer::new(&environment, &session, subset));
            println!("{robot} in {scene}: llguidance prepared in {taken:?}");
            for policy in canonical_examples(&session, subset) {
                let tokens = encoding.encode_ordinary(&policy);
                follow((&prepared, &limited, &peer), &vocabulary, &tokens, &mut examples);
                forced += forced_bytes(&prepared, &policy);
                all += policy.len();
            }
            for policy in common::walks::written(&session, subset, WRITTEN, |policy| {
                (200..=600).contains(&encoding.encode_ordinary(policy).len())
            }) {
                let tokens = encoding.encode_ordinary(&policy);
                follow((&prepared, &limited, &peer), &vocabulary, &tokens, &mut written);
            }
        }
        examples.print("examples");
        written.print("written at random");
        println!("{forced} of {all} bytes of the examples are forced");
        many_entities(subset);
    }
}

/// The time by the clock, or that of the processor where something else ran in between.
fn time<T>(run: impl FnOnce() -> T) -> (T, Duration) {
    let (before, start) = (processor(), Instant::now());
    let made = run();
    let taken = start.elapsed();
    (made, taken.min(processor().saturating_sub(before)))
}

/// The time of the processor that this thread has taken.
fn processor() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or_default())
}

#[derive(Default)]
struct Times {
    masks: Vec<Duration>,
    both: Vec<Duration>,
    /// Those of llguidance.
    peer: Vec<Duration>,
    /// Masks that have a token which llguidance's has not.
    wider: usize,
    slow: Vec<(Duration, String)>,
    /// Policies that llguidance gave up.
    left: usize,
    /// Those of masks with a limit, of the tokens behind them, and of both.
    limited: [Vec<Duration>; 3],
    /// Masks with a limit that have a token which cannot follow, those that may have one, and the tokens.
    wide: [usize; 3],
}

impl Times {
    fn print(&mut self, what: &str) {
        let [limited, token, limited_both] = &mut self.limited;
        let all = [
            ("mask", &mut self.masks),
            ("mask and token", &mut self.both),
            ("mask with a limit", limited),
            ("token behind it", token),
            ("both", limited_both),
            ("mask of llguidance", &mut self.peer),
        ];
        for (name, times) in all {
            times.sort_unstable();
            let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
            let mean = times.iter().sum::<Duration>() / u32::try_from(times.len()).unwrap();
            let (count, half, most) = (times.len(), at(0.5), at(1.0));
            println!(
                "{what}: {count} times {name}: mean {mean:?}, p50 {half:?}, p90 {:?}, p99 {:?}, max {most:?}",
                at(0.9),
                at(0.99)
            );
        }
        println!(
            "{what}: {} masks have a token that llguidance refuses; it gave {} up",
            self.wider, self.left
        );
        let [wide, maybe, more] = self.wide;
        println!("{what}: {maybe} masks with a limit may be wide, {wide} are, by {more} tokens in all");
        self.slow.sort_by_key(|(taken, _)| std::cmp::Reverse(*taken));
        for (taken, place) in self.slow.iter().take(25) {
            println!("    {taken:?} after …{place}");
        }
    }
}

fn follow(
    (prepared, limited, peer): (&AcceptorFactory, &AcceptorFactory, &Peer),
    vocabulary: &Vocabulary,
    tokens: &[u32],
    times: &mut Times,
) {
    let mut decoder = prepared.decoder(vocabulary, 20_000).unwrap();
    let mut limited = limited.decoder(vocabulary, 20_000).unwrap();
    let mut matcher = Some(peer.start());
    for token in tokens {
        let (is_set, taken) = time(|| decoder.mask()[*token as usize / 32] >> (token % 32) & 1 == 1);
        assert!(is_set, "{}", String::from_utf8_lossy(decoder.acceptor().bytes()));
        if taken > Duration::from_micros(100) {
            let bytes = decoder.acceptor().bytes();
            let from = bytes.len().saturating_sub(70);
            times.slow.push((taken, String::from_utf8_lossy(&bytes[from..]).into_owned()));
        }
        times.masks.push(taken);
        let (mask, of_limited) = time(|| limited.mask_within(EFFORT).to_vec());
        let more = mask.iter().zip(decoder.mask()).map(|(wide, exact)| {
            assert_eq!(!wide & exact, 0, "a mask with a limit lacks a token");
            (wide & !exact).count_ones() as usize
        });
        let more: usize = more.sum();
        times.wide[0] += usize::from(more > 0);
        times.wide[1] += usize::from(limited.is_wide());
        times.wide[2] += more;
        let (accepted, of_token) = time(|| limited.accept(*token));
        assert!(accepted);
        for (times, taken) in times.limited.iter_mut().zip([of_limited, of_token, of_limited + of_token]) {
            times.push(taken);
        }
        // Some policies are more than it follows: what it would take behind that is not counted.
        if let Some(peer) = matcher.as_mut() {
            let (theirs, of_peer) = time(|| peer.compute_mask());
            match theirs {
                Ok(theirs) => {
                    times.peer.push(of_peer);
                    let mut words = decoder.mask().iter().zip(theirs.as_slice());
                    times.wider += usize::from(words.any(|(ours, theirs)| ours & !theirs != 0));
                    if peer.consume_token(*token).is_err() {
                        matcher = None;
                    }
                }
                Err(_) => matcher = None,
            }
            times.left += usize::from(matcher.is_none());
        }
        let (accepted, more) = time(|| decoder.accept(*token));
        assert!(accepted);
        times.both.push(taken + more);
    }
}

/// The examples that check for a session, as the subset spells them.
fn canonical_examples(session: &Session, subset: Subset) -> Vec<String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    let (mut found, grammar) = (Vec::new(), Grammar::new(&session.signatures(), subset));
    for file in files.iter().filter(|file| file.extension().is_some_and(|kind| kind == "json")) {
        let text = std::fs::read_to_string(file).unwrap();
        let parsed = motet_syntax::read(&Source::new("policy.json", text.as_str()), FileId(7));
        let policy = parsed.file.policies().next().unwrap();
        if common::errors(session, &text).is_empty() {
            found.extend(canonical(policy, &grammar));
        }
    }
    found
}

fn forced_bytes(prepared: &AcceptorFactory, policy: &str) -> usize {
    let mut acceptor = prepared.acceptor(20_000).unwrap();
    let mut forced = 0;
    while !acceptor.is_accepting() {
        let must = acceptor.forced();
        forced += must.len();
        acceptor.accept(&must);
        let at = acceptor.bytes().len();
        acceptor.accept(&policy.as_bytes()[at..(at + 1).min(policy.len())]);
    }
    forced
}

fn many_entities(subset: Subset) {
    let names: Vec<String> = (0..5000).map(|index| format!("thing_{index}")).collect();
    let domain = format!("entity {}: Object\n", names.join(", "));
    let mut sources = Sources::default();
    let source = Source::new("many.motet", domain.as_str());
    let id = sources.add(source.clone());
    let domain = motet_syntax::read(&source, id).file;
    let session = Session::builder().domains(&[domain]).build(&mut sources);
    let said = session.input_diagnostics().to_vec();
    assert!(said.is_empty(), "{said:?}");
    let mut taken: Vec<Duration> =
        (0..21).map(|_| time(|| AcceptorFactory::new(&session, subset)).1).collect();
    taken.sort_unstable();
    println!("5,000 entities: prepared in {:?} at the median of 21", taken[10]);
}
