//! A run of a sketched policy with a driver that does everything in a second, written into lines.

use motet_graph::{Graph, Value};
use motet_runtime::journal::{JournalHead, LineChain};
use motet_runtime::{Answer, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Query, StartState, Time};
use std::collections::VecDeque;

/// Lines of the journal of a run, and everything that went in and came out.
pub(crate) struct Run {
    pub(crate) lines: Vec<String>,
    pub(crate) steps: Vec<(Time, Event, Vec<Effect>)>,
    pub(crate) engine: Engine,
}

/// Runs a graph. `outcome` says how the n-th start ends, and the answer to the n-th question; at most `limit`
/// events.
pub(crate) fn run(
    graph: Graph,
    mut outcome: impl FnMut(usize, &str) -> Outcome,
    mut answer: impl FnMut(usize, &Query) -> Answer,
    limit: usize,
) -> Run {
    let mut chain = LineChain::default();
    let mut lines = vec![chain.head(JournalHead::new(&graph))];
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let (mut steps, mut now) = (Vec::new(), Time::ZERO);
    let mut queue: VecDeque<(Time, Event)> = VecDeque::from([(now, Event::Begin)]);
    let (mut starts, mut questions) = (0, 0);
    while steps.len() < limit && !engine.is_over() {
        queue.make_contiguous().sort_by_key(|(at, _)| *at);
        let wake = engine.wake_at().unwrap_or(Time::NEVER);
        let (at, event) = match queue.pop_front_if(|(at, _)| *at <= wake) {
            Some(next) => next,
            None if wake == Time::NEVER => break,
            None => (wake, Event::Tick),
        };
        now = at.max(now);
        let mut out = Vec::new();
        engine.handle(now, event.clone(), &mut out);
        lines.push(chain.step(now, &event, &out));
        for effect in &out {
            let later = now.after(Time::from_secs(1.0));
            let mut say = |event| queue.push_back((later, Event::Driver(event)));
            match effect {
                Effect::Start { goal, command, .. } => {
                    starts += 1;
                    say(DriverEvent::Ended { goal: *goal, outcome: outcome(starts, &command.primitive) });
                }
                Effect::Cancel { goal } => {
                    say(DriverEvent::Ended { goal: *goal, outcome: Outcome::Interrupted })
                }
                Effect::SafeStop { goal } => say(DriverEvent::Stopped { goal: *goal }),
                Effect::Observe { query } | Effect::Watch { query } => {
                    questions += 1;
                    let answer = answer(questions, query);
                    say(DriverEvent::Observed { query: (**query).clone(), answer });
                }
                _ => {}
            }
        }
        steps.push((now, event, out));
    }
    if !engine.is_over() && engine.wake_at().is_none() {
        let mut out = Vec::new();
        engine.give_up(&mut out);
        lines.push(chain.gave_up(now, &out));
    }
    Run { lines, steps, engine }
}

/// What a primitive of the test vocabulary gives.
pub(crate) fn success(primitive: &str) -> Outcome {
    let mug = || Value::Entity("mug_1".into());
    Outcome::Success(match primitive {
        "detect" => Some(mug()),
        "detect_all" => Some(Value::List(vec![mug()])),
        _ => None,
    })
}

/// The goal of the n-th start.
pub(crate) fn goal(run: &Run, number: usize) -> GoalId {
    let starts = run.steps.iter().flat_map(|(_, _, effects)| effects).filter_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    starts.into_iter().nth(number - 1).unwrap()
}
