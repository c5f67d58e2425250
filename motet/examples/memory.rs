//! Memory and open files of one process that runs, checks and swaps for long, soon after the start, half way
//! and at the end: rows for the table in `docs/benchmarks.md`. Linux only.

#![allow(clippy::print_stdout, reason = "an example prints")]

use motet::runtime::{Effect, Event, PreparedSwap, RunControl, StartState, Time, run};
use motet::{Engine, Error, Graph, Motet, Observer, ProjectBuilder, RunEnd};

const EVENTS: usize = 1_000_000;
const POLICIES: usize = 10_000;
const SWAPS: usize = 10_000;

/// Resident memory in KiB, and the number of open files.
fn held() -> (usize, usize) {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let memory = line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok());
    let files = std::fs::read_dir("/proc/self/fd").map_or(0, Iterator::count);
    (memory.unwrap_or(0), files)
}

/// Count of what is done, with what was held at its marks.
struct Count {
    most: usize,
    done: usize,
    held: Vec<(usize, usize)>,
}

impl Count {
    fn new(most: usize) -> Self {
        Self { most, done: 0, held: Vec::new() }
    }

    /// Counts one more. True if that was the last.
    fn next(&mut self) -> bool {
        self.done += 1;
        // The first hundredth fills what grows once.
        if [self.most / 100, self.most / 2, self.most].contains(&self.done) {
            self.held.push(held());
        }
        self.done >= self.most
    }

    fn print(&self, what: &str) {
        let memory: Vec<String> =
            self.held.iter().map(|(memory, _)| format!("{:.1} MB", *memory as f64 / 1024.0)).collect();
        let files: Vec<String> = self.held.iter().map(|(_, files)| files.to_string()).collect();
        println!("| {} {what} | {} | {} |", self.done, memory.join(" | "), files.join(", "));
    }
}

/// Observer that ends a run after so many events or swaps.
struct Counting<'g> {
    events: Count,
    swaps: Count,
    /// Policies that take over in turn; none where none does.
    offers: &'g [Graph],
}

impl Observer for Counting<'_> {
    fn commit(&mut self, _now: Time, _effects: &[Effect]) -> RunControl {
        let is_over = self.swaps.done >= self.swaps.most || self.events.done >= self.events.most;
        if is_over { RunControl::Stop } else { RunControl::Continue }
    }

    fn event(&mut self, _now: Time, _event: &Event) {
        if self.events.done < self.events.most {
            self.events.next();
        }
    }

    fn swap(&mut self, _now: Time, engine: &Engine) -> Option<PreparedSwap> {
        let count = self.offers.len();
        let offer = self.offers.get(self.swaps.done.checked_rem(count)?)?;
        if self.swaps.done >= self.swaps.most {
            return None;
        }
        self.swaps.next();
        PreparedSwap::new(offer.clone(), &engine.running()).ok()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let room = ProjectBuilder::default().robot("hsr").scene("kitchen").without_motions();
    let motet = Motet::from_builder(room)?;
    let policy = |steps: &str| {
        motet.compile(&format!("policy long for hsr {{ repeat 1000 {{ repeat 1000 {{ {steps} }} }} }}"))
    };
    let policies = [policy("go(counter) say(\"here\")")?, policy("go(kitchen_table) say(\"there\")")?];
    let graphs = policies.each_ref().map(|policy| policy.graph().clone());
    println!(
        "| what one process does | after 1 % | half way | at the end | open files |\n|---|---|---|---|---|"
    );
    for (events, swaps, offers) in [(EVENTS, usize::MAX, &[][..]), (usize::MAX, SWAPS, &graphs[..])] {
        let mut counting = Counting { events: Count::new(events), swaps: Count::new(swaps), offers };
        let mut engine = Engine::new(graphs[0].clone(), &StartState::default()).map_err(Error::Graph)?;
        let mut driver = motet.simulator(&policies[0], 0)?;
        let end = run(&mut engine, &mut driver, &mut counting, Time::ZERO);
        assert_eq!(end, RunEnd::Interrupted, "after {} events", counting.events.done);
        if offers.is_empty() {
            counting.events.print("events of a run in the simulator");
        } else {
            counting.swaps.print("swaps of its policy");
        }
    }
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    let paths = std::fs::read_dir(folder)?.flatten().map(|entry| entry.path());
    let paths = paths.filter(|path| path.extension().is_some_and(|ending| ending == "motet"));
    let texts = paths.map(std::fs::read_to_string).collect::<Result<Vec<_>, _>>()?;
    let mut checks = Count::new(POLICIES);
    for text in texts.iter().cycle() {
        // Some of them are for another robot, and are refused.
        let _ = motet.compile(text);
        if checks.next() {
            break;
        }
    }
    checks.print("policies checked and compiled");
    Ok(())
}
