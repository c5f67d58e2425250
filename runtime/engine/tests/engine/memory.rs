//! What a run remembers, and how it is bounded.

use crate::ready::{Run, goal, run, success};
use motet_arbitrary::graph::{StepSketch, graph};
use motet_runtime::memory::{Memory, MemoryEvent, MemoryLimits};
use motet_runtime::{
    Answer, DriverEvent, Effect, Engine, Event, GoalId, Outcome, PreparedSwap, StartState, Time,
};
use std::sync::Arc;

/// A memory that was fed with a run.
fn fed(run: &Run, limits: MemoryLimits) -> Memory {
    let mut memory = Memory::new(limits);
    memory.instruct(Time::ZERO, "bring me the mug");
    memory.policy(Time::ZERO, 0, Arc::new(run.engine.graph().clone()));
    for (at, event, effects) in &run.steps {
        memory.event(*at, event);
        effects.iter().for_each(|effect| memory.effect(*at, effect));
    }
    memory
}

fn lines(memory: &Memory) -> Vec<String> {
    memory.entries().map(ToString::to_string).collect()
}

fn slips(number: usize, primitive: &str) -> Outcome {
    if number == 2 { Outcome::Failure("unreachable".into()) } else { success(primitive) }
}

#[test]
fn memory_steps_with_their_results_and_the_latest_failure() {
    let steps = [StepSketch::go("table"), StepSketch::detect("mug"), StepSketch::say("never")];
    let run = run(graph(&steps), slips, |_, _| Answer::Unknown, 100);
    let memory = fed(&run, MemoryLimits::default());
    assert_eq!(
        lines(&memory),
        [
            "instruction: bring me the mug",
            "go(to: table): done",
            "detect(what: \"mug\"): failed with unreachable (failed)",
            "the policy ended: failed with `unreachable`",
        ]
    );
    assert_eq!(
        memory.short().to_string(),
        "request: bring me the mug\nlatest failure: detect(what: \"mug\"): failed with unreachable (failed)\n"
    );
    assert_eq!(memory.running().count(), 0);
    let working = memory.working(&run.engine.snapshot()).to_string();
    assert!(working.contains("state: at(robot, table) is true\n"), "{working}");
    assert!(working.ends_with("done: the policy ended: failed with `unreachable`\n"), "{working}");
}

#[test]
fn memory_what_has_no_question_is_a_step() {
    let limits = MemoryLimits { questions: vec!["detect".into()], ..MemoryLimits::default() };
    let run = run(graph(&[StepSketch::detect("mug")]), |_, name| success(name), |_, _| Answer::Unknown, 100);
    // The test vocabulary has no `ask`; what is no parameter `question` is no question.
    assert_eq!(lines(&fed(&run, limits))[1], "detect(what: \"mug\"): done, gave mug_1");
}

#[test]
fn memory_what_runs_is_told_with_its_start() {
    let run = run(
        graph(&[StepSketch::go("table"), StepSketch::say("on")]),
        |_, name| success(name),
        |_, _| Answer::Unknown,
        2,
    );
    let memory = fed(&run, MemoryLimits::default());
    let doing: Vec<_> = memory.running().map(|doing| (doing.call, doing.path, doing.since_secs)).collect();
    assert_eq!(doing, [("say(text: \"on\")".to_owned(), "/steps/1".to_owned(), 1.0)]);
    assert_eq!(goal(&run, 2).to_string(), "#2");
}

#[test]
fn memory_old_entries_are_dropped_and_counted() {
    let steps: Vec<StepSketch> = (0..20).map(|number| StepSketch::say(&format!("number {number}"))).collect();
    let run = run(graph(&steps), slips, |_, _| Answer::Unknown, 100);
    let all = fed(&run, MemoryLimits::default());
    for limits in [
        MemoryLimits { entries: 2, ..MemoryLimits::default() },
        MemoryLimits { bytes: 200, ..MemoryLimits::default() },
        MemoryLimits { entries: 0, ..MemoryLimits::default() },
    ] {
        let memory = fed(&run, limits.clone());
        let dropped = memory.dropped();
        let kept = memory.entries().len();
        assert!(kept <= limits.entries && memory.bytes() <= limits.bytes, "{limits:?}: {kept}");
        let lost = dropped.instructions + dropped.steps + dropped.failures + dropped.endings;
        assert_eq!(lost as usize + kept, all.entries().len());
        assert_eq!(dropped.instructions, 1);
        assert_eq!(memory.short(), all.short(), "the first request and the latest failure stay");
    }
}

#[test]
fn memory_long_texts_are_cut_between_letters() {
    let mut memory = Memory::new(MemoryLimits { text_bytes: 10, ..MemoryLimits::default() });
    memory.instruct(Time::ZERO, "größer als erlaubt");
    let Some(MemoryEvent::Instruction { text }) = memory.entries().next().map(|entry| entry.what.clone())
    else {
        panic!("no instruction")
    };
    assert_eq!(text, "größe…");
    assert!(text.len() <= 10);
}

#[test]
fn memory_views_are_data_too() {
    let run = run(graph(&[StepSketch::detect("mug")]), |_, name| success(name), |_, _| Answer::Unknown, 100);
    let memory = fed(&run, MemoryLimits::default());
    let whole = memory.whole(&run.engine.snapshot());
    let text = serde_json::to_string(&whole).unwrap();
    assert_eq!(serde_json::from_str::<motet_runtime::memory::FullMemory>(&text).unwrap(), whole);
}

/// What is remembered where a policy takes over from `go(table)` while that runs, and then the goal of that
/// ends.
fn taken_over(next: &[StepSketch], outcome: Outcome) -> Vec<String> {
    let mut memory = Memory::new(MemoryLimits::default());
    let mut engine = Engine::new(graph(&[StepSketch::go("table")]), &StartState::default()).unwrap();
    memory.policy(Time::ZERO, 0, Arc::new(engine.graph().clone()));
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let goal = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let goal: GoalId = goal.unwrap();
    let mut at = Time::ZERO;
    let mut learn = |memory: &mut Memory, out: &mut Vec<Effect>| {
        out.drain(..).for_each(|effect| memory.effect(at, &effect));
        at = at.after(Time::from_secs(1.0));
        at
    };
    let now = learn(&mut memory, &mut out);
    engine.handle(now, Event::Driver(DriverEvent::Acknowledged { goal }), &mut out);
    let prepared = PreparedSwap::new(graph(next), &engine.running()).unwrap();
    memory.policy(now, 1, prepared.graph().clone());
    engine.swap(now, prepared, &mut out).unwrap();
    let now = learn(&mut memory, &mut out);
    let event = Event::Driver(DriverEvent::Ended { goal, outcome });
    memory.event(now, &event);
    engine.handle(now, event, &mut out);
    learn(&mut memory, &mut out);
    lines(&memory)
}

#[test]
fn memory_what_goes_on_for_another_policy_is_told_once_with_its_end() {
    let done = || Outcome::Success(None);
    let kept = taken_over(&[StepSketch::go("table"), StepSketch::say("on")], done());
    assert_eq!(kept, ["new policy `sketch`", "go(to: table): done"]);
    // One that is cancelled and comes to its end all the same has done what it was for.
    let late = taken_over(&[StepSketch::detect("mug")], done());
    assert_eq!(late, ["new policy `sketch`", "go(to: table): done"]);
    let cancelled = taken_over(&[StepSketch::detect("mug")], Outcome::Interrupted);
    assert_eq!(cancelled, ["new policy `sketch`", "go(to: table): interrupted (a new policy)"]);
    let failed = taken_over(&[StepSketch::detect("mug")], Outcome::Failure("unreachable".into()));
    assert_eq!(failed, ["new policy `sketch`", "go(to: table): failed with unreachable (failed)"]);
}
