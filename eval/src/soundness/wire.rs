//! A world as a driver: called directly, or in this process over the driver protocol, a line of JSON a
//! message, as a driver in another process would be. Time is the world's own in both.

#[cfg(unix)]
use std::io::{BufRead as _, BufReader, Write as _};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
#[cfg(unix)]
use std::{thread, time::Duration};

use motet_graph::Graph;
use motet_host::remote::protocol::{
    AdvanceResult, DriverCall, DriverReport, EndedParams, GoalParams, ObservedParams, QueryResult, REFUSED,
    RefusedData, VERSION, Welcome,
};
#[cfg(unix)]
use motet_host::remote::{DriverTimeouts, RemoteDriver, protocol::Hello};
use motet_runtime::{Capabilities, Command, Driver, DriverClock, DriverEvent, GoalId, Query, Time};
use serde::Serialize;
use serde_json::{Value, json};

use super::world::World;

/// World that a driver plays and a judge looks at.
#[derive(Clone)]
pub(super) struct Shared<'d>(Arc<Mutex<World<'d>>>);

impl<'d> Shared<'d> {
    pub(super) fn new(world: World<'d>) -> Self {
        Self(Arc::new(Mutex::new(world)))
    }

    /// The world as it is now.
    pub(super) fn world(&self) -> MutexGuard<'_, World<'d>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Driver for Shared<'_> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.world().start(now, goal, command);
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.world().cancel(now, goal);
    }

    fn capabilities(&self) -> Capabilities {
        self.world().capabilities()
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.world().update(now, goal, command);
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        self.world().hold(now, goal);
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        self.world().proceed(now, goal);
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.world().safe_stop(now, goal);
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.world().observe(now, query);
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.world().watch(now, query);
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.world().unwatch(now, query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        self.world().advance(until)
    }
}

/// Plays with a world behind the driver protocol. Gives what came of it, and what the host had to say of the
/// driver.
///
/// # Errors
///
/// The world cannot be reached, in words.
#[cfg(unix)]
pub(super) fn speak<R>(
    world: &Shared<'_>,
    graph: &Graph,
    play: impl FnOnce(&mut dyn Driver) -> R,
) -> Result<(R, Vec<String>), String> {
    // However busy the machine is, a run ends as it would in a quiet hour.
    let long = Duration::from_secs(600);
    let patience = DriverTimeouts {
        greeting: long,
        answer: long,
        step: long,
        heartbeat: long,
        silence: long,
        ..DriverTimeouts::default()
    };
    let (own, theirs) = UnixStream::pair().map_err(|why| why.to_string())?;
    let notes = Arc::new(Mutex::new(Vec::new()));
    let told = Arc::clone(&notes);
    let log = Box::new(move |note: &str| {
        told.lock().unwrap_or_else(PoisonError::into_inner).push(note.to_owned());
    });
    world.world().answers_at_once = true;
    thread::scope(|scope| {
        scope.spawn(|| serve(world, theirs));
        let hello = Hello::of(graph, "soundness");
        let mut driver = RemoteDriver::over_stream(own, hello, patience, Time::ZERO, log)
            .map_err(|why| why.to_string())?;
        let played = play(&mut driver);
        drop(driver);
        let notes = std::mem::take(&mut *notes.lock().unwrap_or_else(PoisonError::into_inner));
        Ok((played, notes))
    })
}

/// Plays with a world directly: there are no streams in this process.
#[cfg(not(unix))]
pub(super) fn speak<R>(
    world: &Shared<'_>,
    _graph: &Graph,
    play: impl FnOnce(&mut dyn Driver) -> R,
) -> Result<(R, Vec<String>), String> {
    Ok((play(&mut world.clone()), Vec::new()))
}

/// Answers a host until it goes.
#[cfg(unix)]
fn serve(world: &Shared<'_>, mut stream: UnixStream) {
    let Ok(reader) = stream.try_clone() else { return };
    for line in BufReader::new(reader).lines() {
        let said = line.ok().and_then(|line| replies(&mut world.world(), &line));
        let Some(said) = said else { return };
        if stream.write_all(said.as_bytes()).is_err() {
            return;
        }
    }
}

/// Reports and the answer to a call, a line each; `None` where the host goes or is not understood.
fn replies(world: &mut World<'_>, line: &str) -> Option<String> {
    let message: Value = serde_json::from_str(line).ok()?;
    let at = message.pointer("/params/at").and_then(Value::as_f64).map(Time::from_secs);
    let now = at.unwrap_or(Time::ZERO).max(world.now());
    let id = message.get("id").cloned();
    let (mut reports, result) = carry_out(world, now, serde_json::from_value(message).ok()?)?;
    let answer = match result {
        Ok(result) => json!({"jsonrpc": "2.0", "id": id, "result": result}),
        Err(error) => json!({"jsonrpc": "2.0", "id": id, "error": error}),
    };
    reports.push(answer);
    Some(reports.into_iter().map(|line| format!("{line}\n")).collect())
}

/// Reports that are due, and the result or the error of a call; `None` for a farewell.
fn carry_out(
    world: &mut World<'_>,
    now: Time,
    call: DriverCall,
) -> Option<(Vec<Value>, Result<Value, Value>)> {
    match &call {
        DriverCall::Hello(_) => {
            let capabilities = Capabilities { clock: DriverClock::Driver, ..world.capabilities() };
            let (driver, instance) = ("world".to_owned(), "first".to_owned());
            let welcome = Welcome { protocol: VERSION, driver, instance, capabilities };
            return Some((Vec::new(), Ok(json(&welcome))));
        }
        DriverCall::Bye(_) => return None,
        DriverCall::Advance(advance) => {
            let until = Time::from_secs(advance.until);
            let (at, event) = world.advance(until).map_or((until, None), |(at, event)| (at, Some(event)));
            let result = AdvanceResult { now: at.secs() };
            return Some((event.and_then(report).into_iter().collect(), Ok(json(&result))));
        }
        DriverCall::Start(start) => world.start(now, start.goal, &start.command),
        DriverCall::Update(start) => world.update(now, start.goal, &start.command),
        DriverCall::Cancel(GoalParams { goal }) => world.cancel(now, *goal),
        DriverCall::Hold(GoalParams { goal }) => world.hold(now, *goal),
        DriverCall::Proceed(GoalParams { goal }) => world.proceed(now, *goal),
        DriverCall::SafeStop(GoalParams { goal }) => world.safe_stop(now, *goal),
        DriverCall::Observe(asked) => world.observe(now, &asked.query),
        DriverCall::Watch(asked) => world.watch(now, &asked.query),
        DriverCall::Unwatch(asked) => world.unwatch(now, &asked.query),
        DriverCall::Look(_) | DriverCall::Detections(_) | DriverCall::Told(_) => {}
        DriverCall::Truth(_) | DriverCall::Status(_) | DriverCall::Ping(_) => {}
    }
    let (mut reports, mut result) = (Vec::new(), Ok(json!({})));
    while let Some(event) = world.due() {
        match (&call, event) {
            (DriverCall::Start(start), DriverEvent::Acknowledged { goal }) if goal == start.goal => {}
            (DriverCall::Start(start), DriverEvent::Refused { goal, failure }) if goal == start.goal => {
                let data = RefusedData { failure };
                result = Err(json!({"code": REFUSED, "message": "refused", "data": data}));
            }
            // What is due before an answer was true before it: the last one is the answer.
            (
                DriverCall::Observe(asked) | DriverCall::Watch(asked),
                DriverEvent::Observed { query, answer },
            ) if query == asked.query && !world.is_due() => {
                result = Ok(json(&QueryResult { answer }));
            }
            (_, event) => reports.extend(report(event)),
        }
    }
    Some((reports, result))
}

/// Line of a report; what only answers calls has none.
fn report(event: DriverEvent) -> Option<Value> {
    let report = match event {
        DriverEvent::Ended { goal, outcome } => DriverReport::Ended(EndedParams { goal, outcome }),
        DriverEvent::Stopped { goal } => DriverReport::Stopped(GoalParams { goal }),
        DriverEvent::NotHeld { goal } => DriverReport::NotHeld(GoalParams { goal }),
        DriverEvent::Lost { goal } => DriverReport::Lost(GoalParams { goal }),
        DriverEvent::Observed { query, answer } => DriverReport::Observed(ObservedParams { query, answer }),
        DriverEvent::Acknowledged { .. } | DriverEvent::Refused { .. } => return None,
        DriverEvent::Feedback { .. } | DriverEvent::DriverLost | DriverEvent::DriverGone => return None,
    };
    let mut line = json!({"jsonrpc": "2.0"});
    if let (Value::Object(line), Value::Object(report)) = (&mut line, json(&report)) {
        line.extend(report);
    }
    Some(line)
}

fn json<T: Serialize>(value: &T) -> Value {
    // The messages are maps of names to plain values, and writing them does not fail.
    serde_json::to_value(value).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::SplitMix64;
    use rand_xoshiro::rand_core::SeedableRng as _;

    use super::super::trial::{Bench, Checked, Way};
    use super::super::{make, steps};

    #[test]
    fn speak_says_what_a_direct_run_says() {
        let mut lines = 0;
        for seed in 0..16 {
            let mut dice = SplitMix64::seed_from_u64(seed);
            let domain = make::domain(&mut dice);
            let bench = Bench::new(&domain, true, None).unwrap();
            for _ in 0..20 {
                let Checked::Accepted(graphs) = bench.check(&steps::policy(&mut dice, &domain)) else {
                    continue;
                };
                // Of an honest and of a veiled world no answer is late, so the protocol delays none either.
                for seed in [4 * seed, 4 * seed + 3] {
                    let [direct, spoken] =
                        [Way::Direct, Way::Protocol].map(|way| bench.trace_on(&graphs, seed, way));
                    assert_eq!(direct, spoken);
                    lines += spoken.len();
                }
            }
        }
        assert!(lines > 1000, "{lines}");
    }
}
