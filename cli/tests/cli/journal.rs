//! `motet run --record`, `motet replay` and `motet run --resume` from outside, also after a kill at a random
//! moment.

use crate::driver::has_python;
use crate::support::{GOOD, Place, eventually};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng as _};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead as _, BufReader};
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
fn driver_goals(folder: &Path) -> Vec<String> {
    let mut driver_goals = Vec::new();
    for entry in entries(folder) {
        let step = &entry["step"];
        let (at, event) = (&step["at"], &step["event"]["driver"]);
        for what in ["acknowledged", "ended", "refused"] {
            if let Some(event) = event.get(what) {
                driver_goals.push(format!("{at} {what} {event}"));
            }
        }
        for effect in step["effects"].as_array().into_iter().flatten() {
            if let Some(start) = effect.get("start") {
                driver_goals.push(format!("{at} start {start}"));
            }
        }
    }
    driver_goals
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
    assert_eq!(driver_goals(&place.path("cut")), driver_goals(&place.path("whole")));
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

#[cfg(unix)]
#[test]
fn journal_that_is_as_large_as_a_file_may_be_ends_the_run_safely() {
    let place = Place::new("journal_limit").file("good.motet", GOOD);
    let line = "run good.motet --robot hsr --scene kitchen --speed max";
    place.run(&format!("{line} --record whole")).check(0, &[]);
    let whole = std::fs::read_to_string(journal(&place.path("whole"))).unwrap();
    let head = whole.lines().next().unwrap().len();
    let blocks = (head + whole.len()) / 2 / 512;
    let shell = format!("ulimit -f {blocks}; {} {line} --record run", env!("CARGO_BIN_EXE_motet"));
    place.shell(&shell).check(2, &["err:cannot write", "err:File too large"]);
    place.run("run --resume run --speed max").check(0, &["out:✓ tidy: done", "err:cut off"]);
    place.run("replay run").check(0, &["out:identical"]);
}

#[cfg(unix)]
#[test]
fn journal_with_a_named_pipe_is_refused() {
    let place = Place::new("journal_pipes").file("good.motet", GOOD);
    place.run("run good.motet --scene kitchen --speed max --record run").check(0, &[]);
    place
        .shell(
            "mkdir pipe link && mkfifo pipe/000000000000.journal run/motion.jsonl && \
             ln -s ../pipe/000000000000.journal link",
        )
        .check(0, &[]);
    for line in ["replay", "run --resume", "export mcap -o run.mcap"] {
        for folder in ["pipe", "link"] {
            place
                .run(&format!("{line} {folder}"))
                .check(2, &[&format!("err:`{folder}/000000000000.journal` is no regular file")]);
        }
    }
    place.run("view -o page.html pipe").check(2, &["err:`pipe` holds no journal"]);
    place.run("export mcap -o run.mcap run").check(0, &[]);
    place.shell("rm run/lock && mkfifo run/lock").check(0, &[]);
    place.run("run --resume run").check(2, &["err:`run/lock` is no regular file"]);
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
    kill_and_resume("journal_crash", "run good.motet --robot hsr --scene kitchen", "", 1.0);
}

#[test]
fn killed_at_any_moment_the_run_of_a_request_goes_on_as_if_nothing_had_been() {
    let line = "do bring~me~the~coke --robot hsr --scene kitchen --no-geometry --ask never";
    kill_and_resume("journal_do_crash", line, "/run_1", 1.4);
}

#[test]
fn killed_at_any_moment_the_run_of_a_conversation_goes_on_as_if_nothing_had_been() {
    let line = "talk --robot hsr --scene kitchen --no-geometry --profile ideal";
    kill_and_resume("journal_talk_crash", line, "/run_1", 1.4);
}

/// Kills a recorded command at random moments of its time, so long as `longest` of it, and resumes the run,
/// whose journal is in a folder of the record.
fn kill_and_resume(name: &str, command: &str, inner: &str, longest: f64) {
    // Only a conversation reads them.
    let lines = "bring me the coke\nwhat did you do?\n";
    let place = Place::new(name).file("good.motet", GOOD).file("lines", lines);
    let begun = Instant::now();
    let whole = run_and_kill(&place, &format!("{command} --speed 60 --record whole"), Duration::MAX);
    let span = begun.elapsed();
    let expected = driver_goals(&place.path(&format!("whole{inner}")));
    assert!(!whole.0 && expected.len() > 5, "{expected:?}");
    let (mut kills, mut runs, mut dice) = (0, 0, SplitMix64::seed_from_u64(7));
    let mut late = 0;
    while kills < crashes() {
        runs += 1;
        let record = format!("run{runs}");
        let folder = format!("{record}{inner}");
        let mut line = format!("{command} --speed 60 --format json --record {record}");
        loop {
            let delay = span.mul_f64((dice.next_u64() % 1_000) as f64 / 900.0 * longest);
            let (was_killed, shown) = run_and_kill(&place, &line, delay);
            // The head may not have been written yet: then there is no run to go on with.
            kills += u64::from(was_killed);
            if !was_begun(&place, &folder) {
                assert_eq!(shown, 0, "nothing goes out before the head is written");
                break;
            }
            let started =
                driver_goals(&place.path(&folder)).iter().filter(|goal| goal.contains(" start ")).count();
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
        assert_eq!(driver_goals(&place.path(&folder)), expected, "{folder}: as without a crash");
        place.run(&format!("replay {folder}")).check(0, &["out:identical"]);
        once_each(&place.path(&folder));
    }
    println!("{kills} kills in {runs} runs, {late} of them ended by themselves");
}

/// Words of a command line; `~` is a blank within one.
fn words(line: &str) -> Vec<String> {
    line.split_whitespace().map(|word| word.replace('~', " ")).collect()
}

/// Driver that writes down what it begins and ends, and the process in which it does.
fn logged_driver(place: &Place) -> String {
    let drivers = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/drivers");
    let text = format!(
        "import os, sys, types\nsys.path.insert(0, {drivers:?})\nimport echo, motet\n\
         def log(*words):\n\
         \x20   with open('log', 'a') as file: print(os.getpid(), *words, file=file)\n\
         class Logged(echo.Echo):\n\
         \x20   async def perform(self, goal, **args):\n\
         \x20       log('begins', goal.number)\n\
         \x20       result = await super().perform(goal, **args)\n\
         \x20       log('ends', goal.number)\n\
         \x20       return result\n\
         \x20   def begin_run(self, run):\n\
         \x20       super().begin_run(run)\n\
         \x20       with open('instance', 'w') as file:\n\
         \x20           file.write(f'{{self._session.instance}}-{{self._session.forgets}}')\n\
         log('greets', 0)\n\
         port = int(sys.argv[1]) if sys.argv[1:] else None\n\
         motet.serve(Logged(types.SimpleNamespace(seconds=0.15, refuse=[], clock='wall')), port, 10.0)\n"
    );
    std::fs::write(place.path("logged.py"), text).unwrap();
    "python3 logged.py".to_owned()
}

/// Lines of the log of a driver: process, what, and the goal.
fn log(place: &Place) -> Vec<(u32, String, u64)> {
    let text = std::fs::read_to_string(place.path("log")).unwrap_or_default();
    let line = |line: &str| {
        let mut words = line.split(' ');
        let mut next = || words.next().unwrap_or_default().to_owned();
        (next().parse().unwrap(), next(), next().parse().unwrap())
    };
    text.lines().map(line).collect()
}

/// No goal begins twice, and none while another goes on in the same process.
fn begins_once(log: &[(u32, String, u64)]) {
    let mut begun = BTreeSet::new();
    let mut open = None;
    for (process, what, goal) in log {
        match what.as_str() {
            "begins" => {
                assert!(begun.insert(goal), "goal {goal} begins twice: {log:?}");
                assert!(open.is_none_or(|(other, _)| other != process), "{goal} begins too early: {log:?}");
                open = Some((process, goal));
            }
            "ends" => assert_eq!(open.take(), Some((process, goal)), "{log:?}"),
            _ => {}
        }
    }
}

#[test]
fn killed_driver_begins_nothing_twice() {
    if !has_python() {
        return;
    }
    let place = Place::new("journal_driver_crash").file("good.motet", GOOD);
    let driver = logged_driver(&place);
    let (mut dice, mut ended) = (SplitMix64::seed_from_u64(11), BTreeMap::<_, u32>::new());
    for number in 0..crashes() {
        let _ = std::fs::remove_file(place.path("log"));
        let line = ["run", "good.motet", "--robot", "hsr", "--scene", "kitchen", "--driver", &driver];
        let more = ["--record".to_owned(), format!("run{number}")];
        let args: Vec<String> = line.map(str::to_owned).into_iter().chain(more).collect();
        let child = Command::new(env!("CARGO_BIN_EXE_motet"))
            .args(&args)
            .current_dir(place.path(""))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        assert!(eventually(|| !log(&place).is_empty()));
        std::thread::sleep(Duration::from_millis(dice.next_u64() % 1_000));
        let process = log(&place)[0].0.to_string();
        Command::new("kill").args(["-9", &process]).status().unwrap();
        let killed = Instant::now();
        let output = child.wait_with_output().unwrap();
        let code = output.status.code();
        assert!(killed.elapsed().as_secs() < 15, "{:?}", killed.elapsed());
        *ended.entry(code).or_default() += 1;
        let shown = String::from_utf8_lossy(&output.stdout);
        let is_clear = match code {
            Some(0) => shown.contains("tidy: done"),
            // The goal that was lost was stopped safely, and its step failed.
            Some(3) => shown.contains("tidy: failed with"),
            // It died before it had greeted.
            Some(2) => String::from_utf8_lossy(&output.stderr).contains("the driver ended"),
            _ => false,
        };
        assert!(is_clear, "{output:?}");
        begins_once(&log(&place));
        if code != Some(2) {
            place.run(&format!("replay run{number}")).check(0, &["out:identical"]);
        }
    }
    println!("{} kills of drivers, runs by their exit code: {ended:?}", crashes());
}

#[test]
fn killed_host_of_a_driver_in_another_process_begins_nothing_twice_and_loses_nothing() {
    if !has_python() {
        return;
    }
    let place = Place::new("journal_host_crash").file("good.motet", GOOD);
    logged_driver(&place);
    let mut process = Command::new("python3")
        .args(["logged.py", "0"])
        .current_dir(place.path(""))
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    BufReader::new(process.stdout.take().unwrap()).read_line(&mut first).unwrap();
    let driver = first.trim().strip_prefix("listening on ").unwrap().to_owned();
    let (mut kills, mut runs, mut dice) = (0, 0, SplitMix64::seed_from_u64(13));
    while kills < crashes() {
        runs += 1;
        let _ = std::fs::remove_file(place.path("log"));
        let is_request = runs % 2 == 0;
        let command = if is_request { "do bring~me~the~coke --ask never" } else { "run good.motet" };
        let world = "--robot hsr --scene kitchen --no-geometry";
        let folder = if is_request { format!("run{runs}/run_1") } else { format!("run{runs}") };
        let mut line = format!("{command} {world} --format json --driver {driver} --record run{runs}");
        loop {
            let delay = Duration::from_millis(dice.next_u64() % if is_request { 4_000 } else { 2_000 });
            let (was_killed, _) = run_and_kill(&place, &line, delay);
            kills += u64::from(was_killed);
            if !was_killed || !was_begun(&place, &folder) {
                break;
            }
            line = format!("run --resume {folder} --format json --driver {driver}");
        }
        if was_begun(&place, &folder) {
            place.run(&format!("run --resume {folder} --driver {driver}")).check(0, &["out:: done"]);
            place.run(&format!("replay {folder}")).check(0, &["out:identical"]);
            once_each(&place.path(&folder));
            let journal = std::fs::read_to_string(journal(&place.path(&folder))).unwrap();
            assert!(journal.contains(&place.read("instance")), "the driver of the run is not the journal's");
            let log = log(&place);
            begins_once(&log);
            let count = |what: &str| log.iter().filter(|(_, told, _)| told == what).count();
            assert_eq!(count("begins"), count("ends"), "{log:?}");
        }
    }
    println!("{kills} kills of hosts in {runs} runs");
    process.kill().unwrap();
    process.wait().unwrap();
}

/// The physics end with their host, so a run that is resumed begins in the room as it was at the start: what
/// it had begun counts as lost, and it goes on or fails from there.
#[test]
fn killed_run_in_physics_begins_nothing_twice() {
    let finds = Command::new("python3").args(["-c", "import mujoco, motet_mujoco"]).output();
    if !finds.is_ok_and(|output| output.status.success()) {
        println!("skipped: there are no physics");
        return;
    }
    let place = Place::new("journal_physics_crash").file("good.motet", GOOD);
    let line = "run good.motet --robot hsr --scene kitchen --driver mujoco --speed max --format json";
    let begun = Instant::now();
    let whole = run_and_kill(&place, &format!("{line} --record whole"), Duration::MAX);
    assert!(!whole.0 && was_begun(&place, "whole"));
    let (span, mut dice) = (begun.elapsed(), SplitMix64::seed_from_u64(17));
    let (mut kills, mut runs, mut ended) = (0, 0, BTreeMap::<_, u32>::new());
    while kills < crashes() {
        runs += 1;
        let folder = format!("run{runs}");
        let delay = span.mul_f64((dice.next_u64() % 1_000) as f64 / 1_000.0);
        let (was_killed, shown) = run_and_kill(&place, &format!("{line} --record {folder}"), delay);
        kills += u64::from(was_killed);
        if !was_begun(&place, &folder) {
            assert_eq!(shown, 0, "nothing goes out before the head is written");
            continue;
        }
        let ran = place.run(&format!("run --resume {folder} --driver mujoco --speed max"));
        assert!(matches!(ran.code, Some(0 | 3)), "{ran:#?}");
        *ended.entry(ran.code).or_default() += 1;
        place.run(&format!("replay {folder}")).check(0, &["out:identical"]);
        once_each(&place.path(&folder));
    }
    println!("{kills} kills in {runs} runs in physics, by their exit code: {ended:?}");
}

fn was_begun(place: &Place, folder: &str) -> bool {
    std::fs::read(journal(&place.path(folder))).is_ok_and(|bytes| bytes.contains(&b'\n'))
}

/// Runs the command and kills it after a while. Whether it was still running, and how many starts it had
/// shown.
fn run_and_kill(place: &Place, line: &str, delay: Duration) -> (bool, usize) {
    let shown = place.path("shown.jsonl");
    let mut child = Command::new(env!("CARGO_BIN_EXE_motet"))
        .args(words(line))
        .current_dir(place.path(""))
        .stdin(if line.starts_with("talk") {
            std::fs::File::open(place.path("lines")).unwrap().into()
        } else {
            Stdio::null()
        })
        .stdout(std::fs::File::create(&shown).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    if delay == Duration::MAX {
        child.wait().unwrap();
    }
    std::thread::sleep(if delay == Duration::MAX { Duration::ZERO } else { delay });
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
    // It is over; one that was cut off goes on.
    place.run(&format!("run --resume talk/{run}")).check(0, &["err:the run is over"]);
    place.run_args(&words).check(2, &["err:talk.jsonl"]);
}
