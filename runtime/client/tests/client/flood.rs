//! Many replies of a server with random faults: each ends in a run, a question or an error, and nothing
//! leaks.
//!
//! A few in the tests of every change; `MOTET_REPLIES=500 cargo test -p motet-client flood --
//! --nocapture` for as many as one likes.

#![allow(clippy::print_stdout, reason = "the figures are read with --nocapture")]

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use crate::kitchen::{Heard, brisk, carry_out, planner, right, setting};
use crate::server::{Act, Server};
use motet_client::ClientSettings;
use motet_planner::dialogue::Outcome;
use rand::RngExt as _;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng as _;

const REQUESTS: &[&str] = &["bring me the coke", "open the fridge", "put the red mug in the cupboard"];

/// Replies at random, and the same in each run.
struct Dice(SplitMix64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0.random_range(0..most)
    }

    /// A reply as some server gives it: often right, often not.
    fn act(&mut self, right: &[String]) -> Act {
        let good = right[self.below(right.len())].clone();
        let letters: Vec<char> = good.chars().collect();
        match self.below(14) {
            0 => Act::status("429 Too Many Requests", "Retry-After: 0\r\n"),
            1 => Act::status("500 Internal Server Error", ""),
            2 => Act::status("503 Service Unavailable", "Retry-After: soon\r\n"),
            3 => Act::status("404 Not Found", ""),
            4 => Act::BreaksOff { text: letters[..self.below(letters.len())].iter().collect() },
            5 => Act::Nonsense,
            6 => Act::Endless { text: if self.below(2) == 0 { good } else { "why not ".repeat(50) } },
            7 => Act::HangsUp,
            8 => Act::Silent,
            // Bytes of it are replaced: what a server writes that ignores the constraint.
            9 | 10 => {
                let mut letters = letters;
                for _ in 0..=self.below(3) {
                    let (at, with) = (self.below(letters.len()), self.below(64));
                    letters[at] = char::from(b' ' + with as u8);
                }
                Act::says(letters.into_iter().collect::<String>())
            }
            11 => Act::says("I think that the robot should rather have a rest."),
            12 => Act::Says { text: good, each: 40, pause: Duration::from_millis(1) },
            _ => Act::says(good),
        }
    }
}

/// Open file handles, and resident memory in KiB, of this process.
#[cfg(target_os = "linux")]
fn held() -> (usize, usize) {
    let handles = std::fs::read_dir("/proc/self/fd").unwrap().count();
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    (handles, line.trim().trim_end_matches(" kB").parse().unwrap())
}

#[cfg(not(target_os = "linux"))]
fn held() -> (usize, usize) {
    (0, 0)
}

/// Waits until what the server's own threads hold is given back.
fn settled(before: usize) -> (usize, usize) {
    for _ in 0..100 {
        if held().0 <= before {
            break;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    held()
}

/// The variable that tells the process of this test that it has been started alone.
const ALONE: &str = "MOTET_FLOOD_ALONE";

/// Handles and memory are those of a process, so the test runs in one of its own.
#[test]
fn client_ends_every_reply_and_leaks_nothing() {
    if std::env::var_os(ALONE).is_some() {
        return flood();
    }
    let mut alone = std::process::Command::new(std::env::current_exe().unwrap());
    let name = "flood::client_ends_every_reply_and_leaks_nothing";
    assert!(alone.args([name, "--exact", "--nocapture"]).env(ALONE, "1").status().unwrap().success());
}

/// Every reply ends in a run, a question or an error.
fn flood() {
    let replies: usize =
        std::env::var("MOTET_REPLIES").ok().and_then(|count| count.parse().ok()).unwrap_or(60);
    let setting = setting();
    let right: Vec<String> = REQUESTS.iter().map(|request| right(&setting, request)).collect();
    let dice = Arc::new(Mutex::new(Dice(SplitMix64::seed_from_u64(0x4d6f_7465_7453_6565))));
    let server = Server::with(move || dice.lock().unwrap().act(&right));
    let mut ended: BTreeMap<String, usize> = BTreeMap::new();
    let (mut heard, mut asked, mut begun) = (0, 0, None);
    let mut longest = Duration::ZERO;
    while heard < replies {
        let settings = ClientSettings {
            idle_timeout: Duration::from_millis(150),
            timeout: Duration::from_secs(5),
            max_bytes: 256 << 10,
            ..brisk(&server)
        };
        let listener = Heard::default();
        let from = Instant::now();
        let (outcome, _) =
            carry_out(&setting, &mut planner(settings, &listener), REQUESTS[asked % REQUESTS.len()]);
        longest = longest.max(from.elapsed());
        asked += 1;
        heard += server.heard().len();
        server.forget();
        let how = match outcome {
            Outcome::Done => "done".to_owned(),
            Outcome::Failed(problem) => {
                assert!(!problem.question.is_empty());
                let is_error = problem.question.contains("scripted at http");
                if is_error { "error".to_owned() } else { format!("question, {}", problem.kind.name()) }
            }
            other => panic!("{other:?}: {:?}", listener.0.borrow()),
        };
        *ended.entry(how).or_default() += 1;
        if begun.is_none() && heard * 4 >= replies {
            begun = Some(settled(0));
        }
    }
    let (handles, memory) = begun.unwrap();
    let (handles_now, memory_now) = settled(handles);
    println!("{heard} replies to {asked} requests: {ended:?}; longest {longest:?}");
    println!("file handles {handles} -> {handles_now}, resident {memory} KiB -> {memory_now} KiB");
    assert!(handles_now <= handles, "{handles} handles became {handles_now}");
    assert!(memory_now <= memory + (16 << 10), "{memory} KiB became {memory_now} KiB");
    assert!(ended.contains_key("done"), "{ended:?}");
}
