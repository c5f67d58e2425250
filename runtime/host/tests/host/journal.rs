//! Journals on disk: cut where torn, refused where damaged, written by one process at a time.

use motet_arbitrary::graph::{StepSketch, graph};
use motet_graph::Graph;
use motet_host::journal::{JournalError, JournalWriter, RunRecorder, SyncGrouping, read};
use motet_runtime::journal::{EngineReplay, JournalEntry, JournalHead};
use motet_runtime::{
    Command, Driver, DriverEvent, Effect, Engine, GoalId, Observer, Outcome, PreparedSwap, Query,
    RetiredGraph, RunControl, RunEnd, StartState, SwapRefusal, Time, run,
};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Every goal takes a second.
#[derive(Default)]
struct OneSecond(Vec<(Time, GoalId)>);

impl Driver for OneSecond {
    fn start(&mut self, now: Time, goal: GoalId, _command: &Command) {
        self.0.push((now.after(Time::from_secs(1.0)), goal));
    }
    fn cancel(&mut self, _now: Time, _goal: GoalId) {}
    fn update(&mut self, _now: Time, _goal: GoalId, _command: &Command) {}
    fn hold(&mut self, _now: Time, _goal: GoalId) {}
    fn proceed(&mut self, _now: Time, _goal: GoalId) {}
    fn safe_stop(&mut self, _now: Time, _goal: GoalId) {}
    fn observe(&mut self, _now: Time, _query: &Query) {}
    fn watch(&mut self, _now: Time, _query: &Query) {}
    fn unwatch(&mut self, _now: Time, _query: &Query) {}
    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let (at, goal) = *self.0.first().filter(|(at, _)| *at <= until)?;
        self.0.remove(0);
        Some((at, DriverEvent::Ended { goal, outcome: Outcome::Success(None) }))
    }
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("host_journal").join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// Records a run of so many calls; segments begin anew after so many bytes.
fn record(folder: &Path, calls: usize, segment_bytes: u64) -> RunEnd {
    let graph = graph(&vec![StepSketch::say("hello"); calls]);
    let writer =
        JournalWriter::create(folder, JournalHead::new(&graph)).unwrap().with_segment_bytes(segment_bytes);
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut nobody = ();
    let mut recorder = RunRecorder::new(writer, &mut nobody);
    let end = run(&mut engine, &mut OneSecond::default(), &mut recorder, Time::ZERO);
    recorder.finish().unwrap();
    end
}

fn entries(folder: &Path) -> Result<Vec<JournalEntry>, JournalError> {
    let mut entries = Vec::new();
    read(folder, &mut |_, entry| entries.push(entry))?;
    Ok(entries)
}

fn replays(entries: &[JournalEntry]) {
    let Some(JournalEntry::Head(head)) = entries.first() else { panic!("no head") };
    let mut replay = EngineReplay::new(head).unwrap();
    entries.iter().for_each(|entry| assert_eq!(replay.take(entry).unwrap(), None));
}

fn segments(folder: &Path) -> Vec<PathBuf> {
    let mut found: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    found.retain(|path| path.extension().is_some_and(|extension| extension == "journal"));
    found.sort();
    found
}

#[test]
fn journal_segments_are_read_as_one() {
    let folder = folder("segments");
    assert_eq!(record(&folder, 20, 1_000), RunEnd::Done { why: None, result: None });
    assert!(segments(&folder).len() > 5);
    let all = entries(&folder).unwrap();
    assert_eq!(all.len(), 22);
    replays(&all);
    fs::remove_file(&segments(&folder)[2]).unwrap();
    let error = entries(&folder).unwrap_err().to_string();
    assert!(error.contains("the segment that begins with line "), "{error}");
}

#[test]
fn journal_cut_at_every_byte_it_is_opened_and_written_on() {
    let whole = folder("whole");
    record(&whole, 2, u64::MAX);
    let bytes = fs::read(&segments(&whole)[0]).unwrap();
    let cut = folder("cut");
    fs::create_dir_all(&cut).unwrap();
    let segment = cut.join("000000000000.journal");
    let head = bytes.iter().position(|byte| *byte == b'\n').unwrap() + 1;
    // Every byte after the head, and some of the head.
    for length in (0..head).step_by(97).chain(head..=bytes.len()) {
        fs::write(&segment, &bytes[..length]).unwrap();
        let mut seen = Vec::new();
        let opened = JournalWriter::open(&cut, &mut |_, entry| seen.push(entry));
        if length < head {
            assert!(matches!(opened, Err(JournalError::None { .. })), "{length}");
            continue;
        }
        let (mut writer, tail) = opened.unwrap();
        let lines = bytes[..length].iter().filter(|byte| **byte == b'\n').count();
        assert_eq!(seen.len(), lines);
        assert_eq!(tail.good_bytes + tail.torn_bytes, length as u64);
        // What is appended follows from what holds.
        writer.append(|chain| chain.gave_up(Time::ZERO, &[])).unwrap();
        drop(writer);
        assert_eq!(entries(&cut).unwrap().len(), lines + 1, "{length}");
    }
}

#[test]
fn journal_damage_in_the_middle_is_not_cut_off() {
    let folder = folder("damage");
    record(&folder, 3, u64::MAX);
    let segment = segments(&folder)[0].clone();
    let mut bytes = fs::read(&segment).unwrap();
    let second = bytes.iter().position(|byte| *byte == b'\n').unwrap() + 1;
    bytes[second + 30] ^= 1;
    fs::write(&segment, &bytes).unwrap();
    let error = JournalWriter::open(&folder, &mut |_, _| {}).unwrap_err().to_string();
    let expected = format!("damaged in 000000000000.journal, line 2 (byte {second}): its checksum is ");
    assert!(error.contains(&expected), "{error}");
    assert_eq!(fs::read(&segment).unwrap(), bytes, "nothing is changed");
}

#[test]
fn journal_one_process_at_a_time_and_nothing_is_overwritten() {
    let folder = folder("busy");
    let graph = graph(&[StepSketch::say("hello")]);
    let writer = JournalWriter::create(&folder, JournalHead::new(&graph)).unwrap();
    assert!(matches!(JournalWriter::open(&folder, &mut |_, _| {}), Err(JournalError::Busy { .. })));
    drop(writer);
    assert!(JournalWriter::open(&folder, &mut |_, _| {}).is_ok());
    assert!(matches!(
        JournalWriter::create(&folder, JournalHead::new(&graph)),
        Err(JournalError::NotEmpty { .. })
    ));
    assert!(matches!(entries(Path::new("/nowhere/at/all")), Err(JournalError::Io { .. })));
}

/// Counts starts, and says stop where it is asked to write.
struct Full {
    writes: usize,
    starts: usize,
}

impl Observer for Full {
    fn commit(&mut self, _now: Time, _effects: &[Effect]) -> RunControl {
        self.writes += 1;
        if self.writes > 2 { RunControl::Stop } else { RunControl::Continue }
    }
    fn effect(&mut self, _now: Time, effect: &Effect) {
        self.starts += usize::from(matches!(effect, Effect::Start { .. }));
    }
}

#[test]
fn journal_where_nothing_can_be_written_nothing_starts() {
    let mut engine = Engine::new(graph(&vec![StepSketch::say("hello"); 9]), &StartState::default()).unwrap();
    let mut full = Full { writes: 0, starts: 0 };
    let end = run(&mut engine, &mut OneSecond::default(), &mut full, Time::ZERO);
    assert_eq!(full.starts, 2, "the third start was never carried out");
    assert!(matches!(end, RunEnd::Failed { .. } | RunEnd::Interrupted), "{end}");
}

#[cfg(unix)]
#[test]
fn journal_that_is_deleted_ends_the_run() {
    let folder = folder("deleted");
    let graph = graph(&vec![StepSketch::say("hello"); 9]);
    let each = SyncGrouping { lines: 1, ..SyncGrouping::default() };
    let writer = JournalWriter::create(&folder, JournalHead::new(&graph)).unwrap().with_grouping(each);
    fs::remove_dir_all(&folder).unwrap();
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut nobody = ();
    let mut recorder = RunRecorder::new(writer, &mut nobody);
    let end = run(&mut engine, &mut OneSecond::default(), &mut recorder, Time::ZERO);
    assert!(matches!(end, RunEnd::Failed { .. } | RunEnd::Interrupted), "{end}");
    let error = recorder.finish().unwrap_err().to_string();
    assert!(error.ends_with("the file was deleted"), "{error}");
}

/// Lets these graphs take over, one after each event.
struct Swapping {
    graphs: Vec<Graph>,
    results: Vec<bool>,
}

impl Observer for Swapping {
    fn swap(&mut self, _now: Time, engine: &Engine) -> Option<PreparedSwap> {
        let graph = self.graphs.pop()?;
        Some(PreparedSwap::new(graph, &engine.running()).unwrap())
    }
    fn swapped(&mut self, _now: Time, _graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        self.results.push(result.is_ok());
    }
}

#[test]
fn journal_policy_that_takes_over_is_written_down_and_replayed() {
    let folder = folder("swap");
    let saying = |text: &str, calls: usize| graph(&vec![StepSketch::say(text); calls]);
    let first = saying("first", 3);
    let mut refuted = saying("refuted", 1);
    for motet_graph::InitialFact { value, .. } in &mut refuted.initial {
        *value = !*value;
    }
    let mut swapping =
        Swapping { graphs: vec![saying("third", 2), refuted, saying("second", 2)], results: Vec::new() };
    let writer = JournalWriter::create(&folder, JournalHead::new(&first)).unwrap();
    let mut engine = Engine::new(first, &StartState::default()).unwrap();
    let mut recorder = RunRecorder::new(writer, &mut swapping);
    let end = run(&mut engine, &mut OneSecond::default(), &mut recorder, Time::ZERO);
    recorder.finish().unwrap();
    assert_eq!(end, RunEnd::Done { why: None, result: None });
    assert_eq!(swapping.results, [true, false, true]);
    let all = entries(&folder).unwrap();
    let swaps = all.iter().filter(|entry| matches!(entry, JournalEntry::Swap(_))).count();
    assert_eq!(swaps, 2, "a refused one leaves no line");
    replays(&all);
}
