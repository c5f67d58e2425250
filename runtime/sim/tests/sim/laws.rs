//! The laws of a driver, over any calls at any times: what is acknowledged ends once, every question and
//! every safe stop is answered, time does not run backwards, and the same calls give the same reports.

use crate::{Bench, entity, text};
use motet_graph::Value;
use motet_runtime::{Driver, DriverEvent, GoalId, Pattern, Query, Time};
use motet_sim::SimOptions;
use proptest::prelude::*;

/// Commands that can and that cannot be done, and some that are none.
fn commands() -> Vec<(&'static str, Vec<(&'static str, Value)>)> {
    let mug = || ("object", entity("mug_1"));
    let list = |ids: [&str; 2]| Value::List(ids.map(entity).to_vec());
    vec![
        ("go", vec![("to", entity("kitchen_table"))]),
        ("go", vec![("to", entity("user"))]),
        ("go", vec![("to", entity("drawer_1"))]),
        ("go", vec![("to", entity("start"))]),
        ("go", vec![("to", entity("mug_1"))]),
        ("go", Vec::new()),
        ("turn", vec![("by", Value::Number(2.5))]),
        ("detect", vec![("what", text("red mug"))]),
        ("detect_all", vec![("what", text("drinkware"))]),
        ("search", vec![("what", text("blue mug")), ("around", Value::List(vec![entity("shelf")]))]),
        ("pick", vec![mug()]),
        ("pick", vec![("object", entity("nothing"))]),
        ("grasp", vec![("object", entity("apple"))]),
        ("lift", Vec::new()),
        ("place", vec![mug(), ("on", entity("counter"))]),
        ("place", vec![mug(), ("on", entity("mug_1"))]),
        ("place", vec![mug(), ("on", entity("drawer_1"))]),
        ("handover", vec![mug(), ("to", entity("user"))]),
        ("open", vec![("what", entity("drawer_1"))]),
        ("close", vec![("what", entity("drawer_1"))]),
        ("push", vec![("what", entity("mug_1"))]),
        ("inspect", vec![("what", entity("fridge_1"))]),
        ("ask", vec![("question", text("Why?"))]),
        ("choose", vec![("question", text("Which?")), ("among", list(["mug_1", "mug_2"]))]),
        ("say", vec![("text", text("Hello."))]),
        ("dance", vec![("how", text("well"))]),
    ]
}

fn query(which: usize) -> Query {
    let is = |id: &str| Pattern::Is(entity(id));
    let facts = [
        ("holding", vec![Pattern::Any]),
        ("visible", vec![is("mug_1")]),
        ("at", vec![is("robot"), Pattern::Any]),
        ("on", vec![Pattern::Any, is("counter")]),
        ("near", vec![is("user")]),
        ("unheard_of", vec![Pattern::Any, Pattern::Any]),
    ];
    let index = which % (facts.len() + 1);
    match facts.get(index) {
        Some((fluent, args)) => Query::Fact { fluent: (*fluent).into(), args: args.clone() },
        None => Query::Measure { measure: "distance".into(), args: vec![entity("user")] },
    }
}

/// What was reported, and how many answers were owed at least.
struct Played {
    events: Vec<(Time, DriverEvent)>,
    started: u64,
    observed: usize,
    stops: Vec<GoalId>,
}

/// Plays calls: which, of which goal or query, and how many hundredths of a second pass after it.
fn play(calls: &[(u8, usize, u16)], seed: u64) -> Played {
    let mut bench = Bench::with(SimOptions { seed, ..SimOptions::default() });
    let commands = commands();
    let mut played = Played { events: Vec::new(), started: 0, observed: 0, stops: Vec::new() };
    let mut live: Vec<GoalId> = Vec::new();
    for (what, which, later) in calls {
        let goal = live.get(which % live.len().max(1)).copied();
        match (what % 8, goal) {
            (0, Some(goal)) => bench.sim.cancel(bench.now, goal),
            (1, Some(goal)) => bench.sim.hold(bench.now, goal),
            (2, Some(goal)) => bench.sim.proceed(bench.now, goal),
            (3, Some(goal)) => {
                bench.sim.safe_stop(bench.now, goal);
                played.stops.push(goal);
            }
            (4, _) => bench.sim.watch(bench.now, &query(*which)),
            (5, _) => bench.sim.unwatch(bench.now, &query(*which)),
            (6, _) => {
                bench.sim.observe(bench.now, &query(*which));
                played.observed += 1;
            }
            (_, _) => {
                let (primitive, args) = &commands[which % commands.len()];
                live.push(bench.start(primitive, args));
                played.started += 1;
            }
        }
        drain(&mut bench, f64::from(*later) / 100.0, &mut played.events);
    }
    for goal in live {
        bench.sim.proceed(bench.now, goal);
    }
    drain(&mut bench, 3600.0, &mut played.events);
    played
}

/// Lets so many seconds pass.
fn drain(bench: &mut Bench, secs: f64, events: &mut Vec<(Time, DriverEvent)>) {
    let end = bench.now.after(Time::from_secs(secs));
    while let Some(event) = bench.next(end.since(bench.now).secs()) {
        events.push((bench.now, event));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, ..ProptestConfig::default() })]

    #[test]
    fn sim_laws_hold(
        calls in prop::collection::vec((any::<u8>(), any::<usize>(), 0u16..3000), 0..24),
        seed in any::<u64>(),
    ) {
        let played = play(&calls, seed);
        prop_assert!(played.events.is_sorted_by_key(|(at, _)| *at));
        let events = || played.events.iter().map(|(_, event)| event);
        let count = |is: &dyn Fn(&DriverEvent) -> bool| events().filter(|event| is(event)).count();
        for goal in (1..=played.started).map(GoalId::from_number) {
            let accepted = count(&|event| *event == DriverEvent::Acknowledged { goal });
            let ended = count(&|event| matches!(event, DriverEvent::Ended { goal: of, .. } if *of == goal));
            let stopped = count(&|event| *event == DriverEvent::Stopped { goal });
            prop_assert_eq!(accepted, 1);
            prop_assert_eq!(stopped, played.stops.iter().filter(|stop| **stop == goal).count());
            prop_assert!(ended == 1 || ended == 0 && stopped > 0, "{} ended {} times", goal.number(), ended);
        }
        let observed = count(&|event| matches!(event, DriverEvent::Observed { .. }));
        prop_assert!(observed >= played.observed);
        prop_assert_eq!(play(&calls, seed).events, played.events);
    }
}

#[test]
fn sim_safe_stop_of_a_goal_that_nobody_knows_is_answered() {
    let mut bench = Bench::kitchen();
    let goal = GoalId::from_number(77);
    bench.sim.safe_stop(Time::ZERO, goal);
    assert_eq!(bench.next(1.0), Some(DriverEvent::Stopped { goal }));
    assert_eq!(bench.sim.advance(Time::NEVER), None);
}
