//! Conformance suite for the laws of [`crate::Driver`], and the bench on which a driver is led through its
//! scenes.

use super::law::{Law, LawViolation};
use crate::driver::Driver;
use crate::effect::Command;
use crate::event::{DriverEvent, Outcome};
use crate::ids::GoalId;
use crate::query::Query;
use crate::time::Time;
use smol_str::SmolStr;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

/// Span after the acknowledgement in which an end may cross the call that holds the goal: what ends so soon
/// cannot be held.
const CROSSING: Time = Time::from_nanos(100_000_000);

/// A driver to be checked, and what to check it with.
pub struct ConformanceSubject<'a> {
    /// Makes a driver at time 0 that has done nothing.
    pub fresh: &'a mut dyn FnMut() -> Box<dyn Driver>,
    /// Something that it accepts, and that takes less than `patience` from its acknowledgement.
    pub command: Command,
    /// Something that it can observe.
    pub query: Query,
    /// A short span: within it a driver answers questions, and nothing changes of its own accord.
    pub moment: Time,
    /// The longest span that is waited for something.
    pub patience: Time,
    /// True if its time is virtual, so that the same calls have to give the same reports.
    pub is_virtual: bool,
}

/// Runs a driver through all scenes, each with a fresh one, and tells every law that it breaks, each breach
/// once.
///
/// What a driver does to a robot, such as whether a goal still uses a resource after its end, cannot be seen
/// from here.
#[must_use]
pub fn check(subject: &mut ConformanceSubject<'_>) -> Vec<LawViolation> {
    let mut all = BTreeSet::new();
    check_scenes(subject, &mut |_, broken| {
        all.extend(broken.iter().cloned());
        ControlFlow::Continue(())
    });
    all.into_iter().collect()
}

/// Runs a driver through the scenes until `told` breaks off. It hears the name of each scene, once its driver
/// is gone, and the laws that were broken in it.
pub fn check_scenes(
    subject: &mut ConformanceSubject<'_>,
    told: &mut dyn FnMut(&'static str, &BTreeSet<LawViolation>) -> ControlFlow<()>,
) {
    type Scene = fn(&mut DriverBench, &ConformanceSubject<'_>);
    let scenes: [(&str, Scene); 12] = [
        ("to the end", to_the_end),
        ("cancelled", cancelled),
        ("stopped safely", stopped),
        ("an unknown goal stopped safely", stopped_unheard_of),
        ("held", held),
        ("cancelled while held", cancelled_while_held),
        ("stopped safely while held", stopped_while_held),
        ("updated", updated),
        ("a primitive that it lacks", lacking),
        ("observed", observed),
        ("watched", watched),
        ("begun again", begun_again),
    ];
    for (name, scene) in scenes {
        let mut bench = DriverBench::new((subject.fresh)());
        scene(&mut bench, subject);
        let DriverBench { driver, log, mut breaches, .. } = bench;
        drop(driver);
        if subject.is_virtual {
            let mut again = DriverBench::new((subject.fresh)());
            scene(&mut again, subject);
            if again.log != log {
                let told = first_difference(&log, &again.log);
                breaches.insert(LawViolation { law: Law::Repeatable, told });
            }
        }
        if told(name, &breaches).is_break() {
            return;
        }
    }
}

/// Started, it is answered, ends once, and is never heard of again; a cancel then changes nothing.
fn to_the_end(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let goal = bench.start(&subject.command);
    bench.runs(goal, subject.patience);
    end(bench, goal, subject.patience, Law::EndsOnce);
    bench.until(subject.patience, |_| false);
    bench.driver.cancel(bench.now, goal);
    bench.until(subject.moment, |_| false);
}

/// Cancelled, it ends.
fn cancelled(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let goal = bench.start(&subject.command);
    if bench.runs(goal, subject.patience) {
        bench.driver.cancel(bench.now, goal);
        end(bench, goal, subject.patience, Law::Cancelled);
        bench.until(subject.patience, |_| false);
    }
}

/// Stopped safely, it is said to be; and again where it has ended.
fn stopped(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let goal = bench.start(&subject.command);
    bench.runs(goal, subject.patience);
    for when in ["while it runs", "after its end"] {
        stop(bench, goal, subject, when);
    }
    bench.until(subject.patience, |_| false);
}

fn stop(bench: &mut DriverBench, goal: GoalId, subject: &ConformanceSubject<'_>, when: &str) {
    bench.safe_stop(goal);
    let is_answer = |event: &DriverEvent| *event == DriverEvent::Stopped { goal };
    if bench.until(subject.patience, is_answer).is_none() {
        bench.breach(Law::SafeStop, format!("no answer to that of goal {goal}, {when}"));
    }
}

/// Held, it keeps still, and then goes on.
fn held(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let Some(goal) = begin_hold(bench, subject) else { return };
    match bench.until(subject.patience, |event| matters(event, goal)) {
        Some(DriverEvent::NotHeld { .. }) => {}
        Some(other) => bench.breach(Law::Held, format!("`{other}` while it is held")),
        None => bench.driver.proceed(bench.now, goal),
    }
    end(bench, goal, subject.patience, Law::Held);
}

/// A safe stop is answered also of a goal that was never started.
fn stopped_unheard_of(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let goal = bench.unheard_of();
    stop(bench, goal, subject, "which was never started");
}

/// Cancelled while it is held, it ends.
fn cancelled_while_held(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    if let Some(goal) = hold(bench, subject) {
        bench.driver.cancel(bench.now, goal);
        end(bench, goal, subject.patience, Law::Cancelled);
    }
}

/// Stopped safely while it is held, it is said to be.
fn stopped_while_held(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    if let Some(goal) = hold(bench, subject) {
        stop(bench, goal, subject, "while it is held");
        bench.until(subject.patience, |_| false);
    }
}

/// Starts a goal and holds it for a moment. None where it does not run.
fn hold(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) -> Option<GoalId> {
    let goal = begin_hold(bench, subject)?;
    bench.until(subject.moment, |_| false);
    Some(goal)
}

/// Starts a goal and tells the driver to hold it. None where it does not run, or ends at once.
fn begin_hold(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) -> Option<GoalId> {
    let goal = bench.start(&subject.command);
    if !bench.runs(goal, subject.patience) || bench.until(CROSSING, |event| ends(event, goal)).is_some() {
        return None;
    }
    bench.driver.hold(bench.now, goal);
    Some(goal)
}

/// Given its arguments again, it goes on under its number and ends once, by itself.
fn updated(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    if !bench.driver.capabilities().update.contains(&subject.command.primitive) {
        return;
    }
    let goal = bench.start(&subject.command);
    if !bench.runs(goal, subject.patience) {
        return;
    }
    bench.driver.update(bench.now, goal, &subject.command);
    match bench.until(subject.patience, |event| ends(event, goal)) {
        Some(DriverEvent::Ended { outcome: Outcome::Success(_) | Outcome::Failure(_), .. }) => {}
        Some(other) => bench.breach(Law::Updated, format!("`{other}` after an update")),
        None => {
            bench.breach(Law::Updated, format!("goal {goal} has not ended {} after it", subject.patience));
        }
    }
    bench.until(subject.moment, |_| false);
}

/// Of a primitive that it does not have, a start is refused.
fn lacking(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let primitive = SmolStr::new_static("conformance_lacks_this");
    if bench.driver.capabilities().primitives.contains(&primitive) {
        return;
    }
    let goal = bench.start(&Command { primitive, ..subject.command.clone() });
    match bench.until(subject.patience, |event| matters(event, goal)) {
        Some(DriverEvent::Refused { .. }) => {}
        Some(other) => bench.breach(Law::Lacking, format!("`{other}` after its start")),
        None => bench.breach(Law::Lacking, format!("goal {goal} is not after {}", subject.patience)),
    }
}

/// Observed, it is answered once.
fn observed(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    bench.driver.observe(bench.now, &subject.query);
    let answers = answers(bench, subject);
    if answers != 1 {
        bench.breach(Law::Observed, format!("`{}` is answered {answers} times", subject.query));
    }
}

/// Watched, it is answered at once; watched again, not again.
fn watched(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    for (time, expected) in [("first", 1), ("second", 0)] {
        bench.driver.watch(bench.now, &subject.query);
        let answers = answers(bench, subject);
        if answers != expected {
            let query = &subject.query;
            bench.breach(Law::Watched, format!("`{query}` is answered {answers} times at the {time} watch"));
        }
    }
    bench.driver.unwatch(bench.now, &subject.query);
    bench.driver.unwatch(bench.now, &subject.query);
    bench.until(subject.moment, |_| false);
}

/// A run that begins while something runs forgets it, and its number starts anew.
fn begun_again(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) {
    let goal = bench.start(&subject.command);
    if !bench.runs(goal, subject.patience) {
        return;
    }
    bench.driver.watch(bench.now, &subject.query);
    bench.until(Time::ZERO, |_| false);
    bench.begin_run();
    // What runs on ends within this time, and tells it.
    if let Some(event) = bench.until(subject.patience, |event| of(event).is_some()) {
        bench.breach(Law::Anew, format!("`{event}`, which is of the run before"));
    }
    let again = bench.start(&subject.command);
    if bench.runs(again, subject.patience) {
        end(bench, again, subject.patience, Law::Anew);
    }
}

/// Number of times the question is answered within a moment.
fn answers(bench: &mut DriverBench, subject: &ConformanceSubject<'_>) -> usize {
    let before = bench.log.len();
    bench.until(subject.moment, |_| false);
    let is_answer =
        |event: &DriverEvent| matches!(event, DriverEvent::Observed { query, .. } if *query == subject.query);
    bench.log.iter().skip(before).filter(|(_, event)| is_answer(event)).count()
}

/// A goal ends within a span.
fn end(bench: &mut DriverBench, goal: GoalId, span: Time, law: Law) {
    if !bench.has_ended(goal) && bench.until(span, |event| ends(event, goal)).is_none() {
        bench.breach(law, format!("goal {goal} has not ended after {span}"));
    }
}

fn first_difference(one: &[(Time, DriverEvent)], two: &[(Time, DriverEvent)]) -> String {
    let length = one.len().max(two.len());
    let place = (0..length).find(|index| one.get(*index) != two.get(*index)).unwrap_or(0);
    let side = |log: &[(Time, DriverEvent)]| match log.get(place) {
        Some((at, event)) => format!("`{event}` at {at}"),
        None => "nothing".to_owned(),
    };
    format!("report {place} was {}, then {}", side(one), side(two))
}

/// The most reports in one scene; a driver that says more does not get anywhere.
const MAX_REPORTS: usize = 10_000;

pub(super) struct DriverBench {
    pub(super) driver: Box<dyn Driver>,
    pub(super) now: Time,
    pub(super) log: Vec<(Time, DriverEvent)>,
    pub(super) breaches: BTreeSet<LawViolation>,
    goals: BTreeMap<GoalId, GoalLog>,
}

/// Reports of a goal so far.
#[derive(Clone, Copy, Debug, Default)]
struct GoalLog {
    acknowledged: bool,
    ended: bool,
    /// Safe stops that are not answered.
    stops: u32,
}

impl DriverBench {
    pub(super) fn new(driver: Box<dyn Driver>) -> Self {
        let (log, breaches) = (Vec::new(), BTreeSet::new());
        Self { driver, now: Time::ZERO, log, breaches, goals: BTreeMap::new() }
    }

    pub(super) fn start(&mut self, command: &Command) -> GoalId {
        let goal = self.unheard_of();
        self.driver.start(self.now, goal, command);
        goal
    }

    /// A goal that was never started.
    pub(super) fn unheard_of(&mut self) -> GoalId {
        let goal = GoalId::from_number((self.goals.len() as u64 + 1) << crate::ids::SLOT_BITS);
        self.goals.insert(goal, GoalLog::default());
        goal
    }

    /// Begins another run: whatever goal is heard of is a new one.
    fn begin_run(&mut self) {
        self.now = self.driver.begin_run(self.now, "again", None).max(self.now);
        self.goals.clear();
    }

    pub(super) fn safe_stop(&mut self, goal: GoalId) {
        if let Some(said) = self.goals.get_mut(&goal) {
            said.stops += 1;
        }
        self.driver.safe_stop(self.now, goal);
    }

    /// Hears reports for a span, or until one is such.
    pub(super) fn until(&mut self, span: Time, wanted: impl Fn(&DriverEvent) -> bool) -> Option<DriverEvent> {
        let end = self.now.after(span);
        while self.log.len() < MAX_REPORTS {
            let Some((at, event)) = self.driver.advance(end) else { break };
            if at < self.now || at > end {
                self.breach(Law::Time, format!("`{event}` at {at}, not between {} and {end}", self.now));
            }
            self.now = at.max(self.now).min(end);
            self.log.push((at, event.clone()));
            self.judge(&event);
            if wanted(&event) {
                return Some(event);
            }
        }
        self.now = end;
        None
    }

    /// True if a goal is acknowledged within a span. It is a breach where there is no answer.
    pub(super) fn runs(&mut self, goal: GoalId, span: Time) -> bool {
        match self.until(span, |event| matters(event, goal)) {
            Some(DriverEvent::Acknowledged { .. }) => true,
            Some(_) => false,
            None => {
                self.breach(Law::Answered, format!("goal {goal} is neither after {span}"));
                false
            }
        }
    }

    pub(super) fn has_ended(&self, goal: GoalId) -> bool {
        self.goals.get(&goal).is_some_and(|said| said.ended)
    }

    pub(super) fn breach(&mut self, law: Law, told: String) {
        self.breaches.insert(LawViolation { law, told });
    }

    fn judge(&mut self, event: &DriverEvent) {
        let Some(said) = of(event).and_then(|goal| self.goals.get_mut(&goal)) else { return };
        let before = *said;
        let (mut is_stop, mut is_end) = (false, false);
        match event {
            DriverEvent::Acknowledged { .. } => said.acknowledged = true,
            DriverEvent::Refused { .. } | DriverEvent::Ended { .. } => {
                said.ended = true;
                is_end = true;
            }
            DriverEvent::Stopped { .. } => {
                is_stop = said.stops > 0;
                said.stops = said.stops.saturating_sub(1);
                said.ended = true;
            }
            DriverEvent::NotHeld { .. } | DriverEvent::Feedback { .. } | DriverEvent::Lost { .. } => {}
            DriverEvent::DriverLost | DriverEvent::DriverGone | DriverEvent::Observed { .. } => {}
        }
        if before.ended && !is_stop {
            let law = if is_end { Law::EndsOnce } else { Law::SilentAfterEnd };
            self.breach(law, format!("`{event}` after its end"));
        } else if before.acknowledged
            && matches!(event, DriverEvent::Refused { .. } | DriverEvent::Acknowledged { .. })
        {
            self.breach(Law::Answered, format!("`{event}` though it was acknowledged"));
        }
    }
}

/// The goal that an event is about.
pub(super) const fn of(event: &DriverEvent) -> Option<GoalId> {
    match event {
        DriverEvent::Acknowledged { goal }
        | DriverEvent::Refused { goal, .. }
        | DriverEvent::Ended { goal, .. }
        | DriverEvent::NotHeld { goal }
        | DriverEvent::Feedback { goal, .. }
        | DriverEvent::Stopped { goal }
        | DriverEvent::Lost { goal } => Some(*goal),
        DriverEvent::DriverLost | DriverEvent::DriverGone | DriverEvent::Observed { .. } => None,
    }
}

/// True if an event says something of a goal that is more than words.
pub(super) fn matters(event: &DriverEvent, goal: GoalId) -> bool {
    of(event) == Some(goal) && !matches!(event, DriverEvent::Feedback { .. })
}

/// True if an event ends a goal.
pub(super) fn ends(event: &DriverEvent, goal: GoalId) -> bool {
    let is_end = match event {
        DriverEvent::Ended { .. } | DriverEvent::Stopped { .. } | DriverEvent::Refused { .. } => true,
        DriverEvent::Acknowledged { .. } | DriverEvent::NotHeld { .. } | DriverEvent::Lost { .. } => false,
        DriverEvent::DriverLost | DriverEvent::DriverGone => false,
        DriverEvent::Feedback { .. } | DriverEvent::Observed { .. } => false,
    };
    is_end && of(event) == Some(goal)
}
