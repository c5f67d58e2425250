//! `motet run --record`, `motet replay` and `motet run --resume` from outside, also after a kill at a random
//! moment.

use crate::support::{GOOD, Place};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng as _};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const ASKS: &str = "policy asks for hsr {\n    let answer = ask(\"Which one?\")\n    say(answer)\n}\n";

fn journal(folder: &Path) -> PathBuf {
    folder.join("000000000000.journal")
}

/// The entries of a journal, as JSON.
fn entries(folder: &Path) -> Vec<Value> {
    let text = std::fs::read_to_string(journal(folder)).unwrap();
    let json = |line: &str| serde_json::from_str::<Value>(line.split_once(' ').unwrap().1).unwrap();
    text.lines().map(|line| json(line)["entry"].clone()).collect()
}

/// Starts and ends with their times: what a robot would have done.
fn deeds(folder: &Path) -> Vec<String> {
    let mut deeds = Vec::new();
    for entry in entries(folder) {
        let step = &entry["step"];
        let (at, event) = (&step["at"], &step["event"]["driver"]);
        for what in ["acknowledged", "ended", "refused"] {
            if let Some(event) = event.get(what) {
                deeds.push(format!("{at} {what} {event}"));
            }
        }
        for effect in step["effects"].as_array().into_iter().flatten() {
            if let Some(start) = effect.get("start") {
                deeds.push(format!("{at} start {start}"));
            }
        }
    }
    deeds
}

#[test]
fn records_replays_and_resumes() {
    let place = Place::new("journal").file("good.motet", GOOD).file("asks.motet", ASKS);
    let world = "--robot hsr --scene kitchen --speed max";
    place.run(&format!("run good.motet {world} --record run")).check(0, &["out:✓ tidy: done"]);
    place.run("replay run").check(0, &["out:identical"]);
    place.run("replay run --until 3").check(0, &["out:replayed 4 entries"]);
    place.run("replay run --at 9s").check(0, &["out:`tidy` at ", "out:standing(robot): true", "out:runs #"]);
    let ran = place.run("replay run --at 9s --json");
    let state: Value = serde_json::from_str(&ran.check(0, &[]).stdout).unwrap();
    assert_eq!((&state["difference"], &state["state"]["policy"]), (&Value::Null, &"tidy".into()));
    // It may have been cut off before it said how it ended.
    place.run("run --resume run").check(0, &["err:the run is over", "out:: done"]);
    let json = place.run("run --resume run --format json");
    json.check(0, &["out:\"event\":\"finished\""]);
    place.run(&format!("run good.motet {world} --record run")).check(2, &["err:is not empty"]);
    place.run("run --resume run --seed 3").check(2, &["err:cannot be used with"]);
    place.run("replay nowhere").check(2, &["err:cannot read `nowhere`"]);
    place.run("run").check(2, &["err:FILE"]);
    place.run(&format!("run asks.motet {world} --record asks")).check(0, &[]);
    place.run("replay asks --at 100s").check(0, &["out:let answer = \"yes\""]);
    place.run("replay asks --until 100s").check(0, &["out:let answer = \"yes\"", "out:identical"]);
}

#[test]
fn motions_are_verified_also_after_a_resumption() {
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/inspection_round.motet");
    let place = Place::new("journal_guard").file("round.motet", std::fs::read(example).unwrap());
    place.run("run round.motet --robot anymal_z1 --scene lab --speed max --record whole").check(0, &[]);
    let text = std::fs::read_to_string(journal(&place.path("whole"))).unwrap();
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let begun = lines[..lines.len() / 2].concat();
    let place = place.file("cut/000000000000.journal", begun);
    place.run("run --resume cut --speed max").check(0, &["out:✓ inspection_round: done"]);
    assert_eq!(deeds(&place.path("cut")), deeds(&place.path("whole")));
    let cut = std::fs::read_to_string(journal(&place.path("cut"))).unwrap();
    let verdicts =
        |text: &str| (text.matches("\"feasible\"").count(), text.matches("nobody is there").count());
    assert_eq!(verdicts(&cut), verdicts(&text));
    assert!(verdicts(&cut).0 > 0 && verdicts(&cut).1 == 0, "{:?}", verdicts(&cut));
}

#[test]
fn export_that_fails_leaves_what_was_there() {
    let place = Place::new("journal_export").file("good.motet", GOOD).file("run.mcap", "kept");
    place.run("export mcap nowhere -o run.mcap").check(2, &["err:cannot read `nowhere`"]);
    assert_eq!(place.read("run.mcap"), "kept");
    assert!(!place.path("run.mcap.partial").exists());
    place.run("run good.motet --scene kitchen --speed max --record run").check(0, &[]);
    place.run("export mcap run -o run.mcap").check(0, &["err:entries to run.mcap"]);
    let whole = std::fs::read(place.path("run.mcap")).unwrap();
    assert_ne!(whole, b"kept");
    place.run("export mcap run -o slow.mcap --rate 0.1").check(0, &[]);
    assert!(std::fs::read(place.path("slow.mcap")).unwrap().len() < whole.len());
    place.run("export mcap run -o none.mcap --max-size 0").check(1, &["err:more entries are left out"]);
    place.run("export mcap run -o none.mcap --rate 0").check(2, &["err:a rate is from 0.001"]);
}

#[test]
fn run_that_was_killed_before_its_first_entry_is_begun_again() {
    let place =
        Place::new("journal_unbegun").file("good.motet", GOOD).file("run/000000000000.journal", "{\"v");
    place.run("run --resume run").check(2, &["err:no run has begun in it"]);
    place.run("run good.motet --scene kitchen --speed max --record run").check(0, &[]);
    place.run("replay run").check(0, &["out:identical"]);
    let again = "run good.motet --scene kitchen --speed max --record run";
    place.run(again).check(2, &["err:`run` is not empty"]);
}

#[test]
fn changed_journal_is_refused() {
    let place = Place::new("journal_changed").file("good.motet", GOOD);
    place.run("run good.motet --scene kitchen --speed max --record run").check(0, &[]);
    let path = journal(&place.path("run"));
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.replacen("kitchen_table", "kitchen_tabel", 30)).unwrap();
    for line in ["replay run", "run --resume run"] {
        place.run(line).check(2, &["err:the journal is damaged in 000000000000.journal, line 1 (byte 0): "]);
    }
}

/// Kills of a whole test run: a few in passing, as many as `MOTET_CRASHES` says where it is set.
fn crashes() -> u64 {
    std::env::var("MOTET_CRASHES").ok().and_then(|count| count.parse().ok()).unwrap_or(10)
}

#[test]
fn killed_at_any_moment_a_run_goes_on_as_if_nothing_had_been() {
    let place = Place::new("journal_crash").file("good.motet", GOOD);
    let world = "good.motet --robot hsr --scene kitchen --speed 60";
    let begun = Instant::now();
    place.run(&format!("run {world} --record whole")).check(0, &[]);
    let span = begun.elapsed();
    let expected = deeds(&place.path("whole"));
    let (mut kills, mut runs, mut dice) = (0, 0, SplitMix64::seed_from_u64(7));
    let mut late = 0;
    while kills < crashes() {
        runs += 1;
        let folder = format!("run{runs}");
        let mut line = format!("run {world} --format json --record {folder}");
        loop {
            let delay = span.mul_f64((dice.next_u64() % 1_000) as f64 / 900.0);
            let (was_killed, shown) = run_and_kill(&place, &line, delay);
            // The head may not have been written yet: then there is no run to go on with.
            let begun = journal(&place.path(&folder)).exists()
                && std::fs::read(journal(&place.path(&folder))).unwrap().contains(&b'\n');
            kills += u64::from(was_killed);
            if !begun {
                assert_eq!(shown, 0, "nothing goes out before the head is written");
                break;
            }
            let started = deeds(&place.path(&folder)).iter().filter(|deed| deed.contains(" start ")).count();
            assert!(started >= shown, "{shown} starts went out, {started} are in the journal");
            if !was_killed {
                late += 1;
                break;
            }
            line = format!("run --resume {folder} --format json --speed 60");
        }
        if !was_begun(&place, &folder) {
            continue;
        }
        place.run(&format!("run --resume {folder} --speed max")).check(0, &[]);
        assert_eq!(deeds(&place.path(&folder)), expected, "{folder}: as without a crash");
        place.run(&format!("replay {folder}")).check(0, &["out:identical"]);
        once_each(&place.path(&folder));
    }
    println!("{kills} kills in {runs} runs, {late} of them ended by themselves");
}

fn was_begun(place: &Place, folder: &str) -> bool {
    std::fs::read(journal(&place.path(folder))).is_ok_and(|bytes| bytes.contains(&b'\n'))
}

/// Runs the command and kills it after a while. Whether it was still running, and how many starts it had
/// shown.
fn run_and_kill(place: &Place, line: &str, delay: Duration) -> (bool, usize) {
    let shown = place.path("shown.jsonl");
    let mut child = Command::new(env!("CARGO_BIN_EXE_motet"))
        .args(line.split_whitespace())
        .current_dir(place.path(""))
        .stdout(std::fs::File::create(&shown).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(delay);
    let is_running = child.try_wait().unwrap().is_none();
    // SIGKILL: the process learns nothing of it.
    child.kill().unwrap();
    let was_killed = is_running && !child.wait().unwrap().success();
    let starts = std::fs::read_to_string(&shown).unwrap().matches("\"event\":\"command\"").count();
    (was_killed, if line.contains("--resume") { 0 } else { starts })
}

/// Each goal starts once and ends once.
fn once_each(folder: &Path) {
    let mut counts: BTreeMap<u64, (u32, u32)> = BTreeMap::new();
    for entry in entries(folder) {
        let step = &entry["step"];
        if let Some(goal) = step["event"]["driver"]["ended"]["goal"].as_u64() {
            counts.entry(goal).or_default().1 += 1;
        }
        for effect in step["effects"].as_array().into_iter().flatten() {
            if let Some(goal) = effect["start"]["goal"].as_u64() {
                counts.entry(goal).or_default().0 += 1;
            }
        }
    }
    assert!(!counts.is_empty());
    assert!(counts.values().all(|count| *count == (1, 1)), "{counts:?}");
}

/// The runs of a conversation are kept as well, with the policies that took over.
#[test]
fn conversation_is_recorded_and_replays() {
    let place = Place::new("journal_talk");
    let world = "--robot hsr --scene kitchen --no-geometry --speed max --ask never";
    let words = ["do", "bring me the coke", "--say", "8s: bring me the apple instead", "--record", "talk"];
    let words: Vec<_> = words.into_iter().chain(world.split(' ')).map(str::to_owned).collect();
    let ran = place.run_args(&words);
    // What came of the first policy is not told as a step of the second.
    ran.check(0, &["out:■ search(\"coke\"", "out:✓ handover(apple, user)"]);
    assert!(!ran.stdout.contains("search(\"apple\", kitchen_table)  interrupted"), "{}", ran.stdout);
    let kept = place.read("talk/talk.jsonl");
    let lines: Vec<Value> = kept.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(lines.iter().any(|line| line["what"] == "swap"), "{kept}");
    let run = lines.iter().find(|line| line["what"] == "run").unwrap()["journal"].as_str().unwrap();
    place.run(&format!("replay talk/{run}")).check(0, &["out:identical"]);
    let entries = entries(&place.path(&format!("talk/{run}")));
    assert_eq!(entries[0]["head"]["instruction"], "bring me the coke");
    assert_eq!(entries.iter().filter(|entry| entry.get("swap").is_some()).count(), 1, "{entries:?}");
    let ran = place.run(&format!("replay talk/{run} --at 1000s"));
    ran.check(0, &["out:revision 1"]);
    let world = "--robot hsr --scene kitchen";
    place.run(&format!("view talk -o talk.html {world}")).check(0, &["err:wrote"]);
    assert!(place.read("talk.html").contains(r#""t":"moved""#), "the page shows the motion");
    place.run(&format!("run --resume talk/{run}")).check(2, &["err:can be replayed but not resumed"]);
    place.run_args(&words).check(2, &["err:talk.jsonl"]);
}
