//! A journal is read as it was written, cut where it is torn, refused where it is damaged, and replayed to
//! the byte.

use crate::ready::{Run, run, success};
use motet_arbitrary::graph::{StepSketch, graph, steps};
use motet_runtime::journal::{
    EngineReplay, JournalDamage, JournalEntry, JournalReader, SegmentEnd, SegmentPosition,
};
use motet_runtime::{Answer, Outcome};
use proptest::prelude::*;

fn small() -> Run {
    run(
        graph(&[StepSketch::go("table"), StepSketch::say("hello")]),
        |_, name| success(name),
        |_, _| Answer::Unknown,
        100,
    )
}

fn read(bytes: &[u8], place: SegmentPosition) -> Result<(Vec<JournalEntry>, SegmentEnd), JournalDamage> {
    let mut entries = Vec::new();
    let ending = JournalReader::default().segment("00000000.log", bytes, place, &mut |seq, entry| {
        assert_eq!(seq as usize, entries.len());
        entries.push(entry);
    })?;
    Ok((entries, ending))
}

/// The first difference of a replay, with its line.
fn replay(entries: &[JournalEntry]) -> Option<String> {
    let Some(JournalEntry::Head(head)) = entries.first() else { panic!("no head") };
    let mut replay = EngineReplay::new(head).unwrap();
    entries.iter().enumerate().find_map(|(seq, entry)| {
        let difference = replay.take(entry).unwrap()?;
        Some(format!("{seq}: {difference:?}"))
    })
}

#[test]
fn journal_replay_is_the_same() {
    let run = small();
    let (entries, ending) = read(run.lines.concat().as_bytes(), SegmentPosition::Middle).unwrap();
    assert_eq!((entries.len(), ending), (run.lines.len(), SegmentEnd::Whole));
    assert_eq!(replay(&entries), None);
    let Some(JournalEntry::Head(head)) = entries.first() else { panic!("no head") };
    let mut replay = EngineReplay::new(head).unwrap();
    entries.iter().for_each(|entry| assert_eq!(replay.take(entry).unwrap(), None));
    assert_eq!(replay.engine().snapshot(), run.engine.snapshot());
}

#[test]
fn journal_replay_tells_where_it_differs() {
    let run = small();
    let (mut entries, _) = read(run.lines.concat().as_bytes(), SegmentPosition::Middle).unwrap();
    let JournalEntry::Step(step) = &mut entries[2] else { panic!("no step") };
    let dropped = step.effects.remove(1);
    let said = replay(&entries).unwrap();
    assert!(said.starts_with("2: EffectMismatch { index: 1, "), "{said}");
    assert!(said.contains(&format!("{:?}", serde_json::to_string(&dropped).unwrap())), "{said}");
}

#[test]
fn journal_cut_anywhere_at_most_the_last_line_is_lost() {
    let text = small().lines.concat();
    for length in 0..=text.len() {
        let bytes = &text.as_bytes()[..length];
        let whole = bytes.iter().filter(|byte| **byte == b'\n').count();
        let (entries, ending) = read(bytes, SegmentPosition::Last).unwrap();
        assert_eq!(entries.len(), whole);
        let good = bytes.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        let expected = if good == length {
            SegmentEnd::Whole
        } else {
            SegmentEnd::Torn { good_bytes: good as u64, torn_bytes: (length - good) as u64 }
        };
        assert_eq!(ending, expected);
        if good < length {
            let damage = read(bytes, SegmentPosition::Middle).unwrap_err();
            assert_eq!((damage.line, damage.offset), (whole as u64 + 1, good as u64));
        }
    }
}

#[test]
fn journal_every_changed_byte_is_found() {
    let text = small().lines.concat();
    for place in 0..text.len() {
        for bit in [0, 3, 7] {
            let mut bytes = text.clone().into_bytes();
            bytes[place] ^= 1 << bit;
            let line = text.as_bytes()[..place].iter().filter(|byte| **byte == b'\n').count() + 1;
            match read(&bytes, SegmentPosition::Last) {
                Err(damage) => assert_eq!(damage.line, line as u64, "byte {place}, bit {bit}: {damage}"),
                // Without its line feed the last line is torn.
                Ok((_, SegmentEnd::Torn { .. })) => assert_eq!(place, text.len() - 1),
                Ok((_, SegmentEnd::Whole)) => panic!("byte {place}, bit {bit} was not missed"),
            }
        }
    }
}

#[test]
fn journal_damage_says_where_and_what() {
    let lines = small().lines;
    let said = |bytes: &[u8], place| read(bytes, place).unwrap_err().to_string();
    let start = "the journal is damaged in 00000000.log, ";
    let second = lines[0].len();
    let without = [&lines[0], &lines[2]].map(|line| line.as_str()).concat();
    assert_eq!(
        said(without.as_bytes(), SegmentPosition::Last),
        format!("{start}line 2 (byte {second}): it has number 2, number 1 was to come")
    );
    assert_eq!(
        said(lines[1].as_bytes(), SegmentPosition::Last),
        format!("{start}line 1 (byte 0): it has number 1, number 0 was to come")
    );
    assert_eq!(
        said(b"what is this\n", SegmentPosition::Last),
        format!("{start}line 1 (byte 0): it does not begin with a checksum")
    );
    // A line of another run with the same number.
    let other =
        run(graph(&[StepSketch::go("shelf")]), |_, name| success(name), |_, _| Answer::Unknown, 100).lines;
    let mixed = [&lines[0], &other[1]].map(|line| line.as_str()).concat();
    let chain =
        "it does not follow from the line before: that one was changed, or belongs to another journal";
    assert_eq!(
        said(mixed.as_bytes(), SegmentPosition::Last),
        format!("{start}line 2 (byte {second}): {chain}")
    );
}

#[test]
fn journal_block_that_was_never_written_is_torn() {
    let lines = small().lines;
    let good = lines[..2].concat();
    let mut bytes = lines[..3].concat().into_bytes();
    let from = good.len() + lines[2].len() / 2;
    bytes[from..].fill(0);
    for with_line_feed in [false, true] {
        if with_line_feed {
            *bytes.last_mut().unwrap() = b'\n';
        }
        let (entries, ending) = read(&bytes, SegmentPosition::Last).unwrap();
        let torn_bytes = (bytes.len() - good.len()) as u64;
        assert_eq!(entries.len(), 2);
        assert_eq!(ending, SegmentEnd::Torn { good_bytes: good.len() as u64, torn_bytes });
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn journal_random_runs_are_replayed_to_the_byte(steps in steps(), dice in any::<u64>()) {
        let roll = |number: usize, sides: u64| dice.rotate_left(number as u32 * 7) % sides;
        let run = run(
            graph(&steps),
            |number, name| match roll(number, 5) {
                0 => Outcome::Failure("unreachable".into()),
                1 => Outcome::Failure("made_up".into()),
                2 => Outcome::Interrupted,
                _ => success(name),
            },
            |number, _| match roll(number, 3) {
                0 => Answer::Unknown,
                1 => Answer::Truth(true),
                _ => Answer::Value(motet_graph::Value::Number(0.1 * number as f64)),
            },
            300,
        );
        let (entries, _) = read(run.lines.concat().as_bytes(), SegmentPosition::Last).unwrap();
        prop_assert_eq!(entries.len(), run.lines.len());
        prop_assert_eq!(replay(&entries), None);
    }
}
