//! The driver: what moves the robot, or pretends to.

use crate::effect::{Command, Effect};
use crate::event::DriverEvent;
use crate::ids::GoalId;
use crate::perception::{Detection, RgbdView};
use crate::query::Query;
use crate::telemetry::{Heard, Moved, ToldThing};
use crate::time::Time;
use motet_graph::{Graph, NodeKind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::fmt;
use std::rc::Rc;

/// Interface to a robot or a simulator. The run loop ([`crate::run`]) passes it the engine's effects and
/// feeds its reports to the engine.
///
/// A driver need not be `Send`: [`crate::run`] borrows it and calls it from one thread only. `Command::args`
/// holds every parameter of the primitive by name ([`Command::arg`]): entities by id, numbers in SI units and
/// radians, poses in the frame `map`.
///
/// # Laws
///
/// 1. Every goal that was started is answered by [`DriverEvent::Acknowledged`] or [`DriverEvent::Refused`],
///    and an acknowledged one ends exactly once, by [`DriverEvent::Ended`] or [`DriverEvent::Stopped`]. After
///    that the driver says nothing of it and uses none of its resources.
/// 2. A cancelled goal ends soon, by its own end or as interrupted. A cancel of a goal that has ended is
///    ignored.
/// 3. A safe stop is always answered by [`DriverEvent::Stopped`], for a goal that has ended too.
/// 4. While it is held a goal does not move the robot and does not end by itself, unless the world makes it
///    fail. A driver that cannot hold it answers [`DriverEvent::NotHeld`] and goes on until it is cancelled.
/// 5. Every observation is answered by one [`DriverEvent::Observed`], within the card's `observe_within`. A
///    watch is answered at once and then whenever the answer differs from the last; watching twice is
///    watching once.
/// 6. Time never runs backwards, and with the same calls at the same times it reports the same events at the
///    same times.
/// 7. A goal is updated only where [`Driver::capabilities`] says so. From then on it pursues the new
///    arguments, under the same number and deadline rules; where it cannot, it ends in a failure.
/// 8. What it cannot answer for it reports as [`DriverEvent::Lost`], or [`DriverEvent::DriverLost`] for
///    everything: an answer that never comes means unknown, not refused. A safe stop of a lost goal is
///    answered like any other.
/// 9. After [`Driver::begin_run`] it says nothing of a goal of an earlier run, and its numbers may come
///    again.
/// 10. It never reports from within a call: everything goes out through [`Driver::advance`]. Telemetry,
///     detections and words are fetched after it.
/// 11. It refuses a start of a primitive that [`Driver::capabilities`] says it does not have.
pub trait Driver {
    /// Starts a primitive.
    fn start(&mut self, now: Time, goal: GoalId, command: &Command);
    /// Ends a goal early.
    fn cancel(&mut self, now: Time, goal: GoalId);
    /// Optional abilities of the driver, constant during a run.
    fn capabilities(&self) -> Capabilities {
        Capabilities::default()
    }
    /// Position where the base stands: x and y in m and the heading in rad in the frame `map`, where it
    /// knows.
    fn base(&self) -> Option<[f64; 3]> {
        None
    }
    /// Name that the driver gave itself when the run began, another one wherever it has forgotten goals.
    /// `None` for a driver that ends with its host.
    fn instance(&mut self) -> Option<String> {
        self.inner()?.instance()
    }
    /// Begins a run with an id of its own, of this graph where it is known; `now` is the host's time. Goals
    /// are counted anew: what still moves for an earlier run comes to a stop, and its goals and watches are
    /// forgotten. Returns the present time, not before `now`.
    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        self.inner().map_or(now, |inner| inner.begin_run(now, run, graph))
    }
    /// Looks after the driver while no run goes on, however long that takes; `now` is the host's time.
    /// Returns the present time. What is reported meanwhile is dropped, but for telemetry, detections and
    /// words.
    fn rest(&mut self, now: Time) -> Time {
        self.inner().map_or(now, |inner| inner.rest(now))
    }
    /// Gives a running goal new arguments of the same primitive. Called only where [`Driver::capabilities`]
    /// says so.
    fn update(&mut self, now: Time, goal: GoalId, command: &Command);
    /// Keeps a goal still until [`Driver::proceed`].
    fn hold(&mut self, now: Time, goal: GoalId);
    /// Lets a held goal go on.
    fn proceed(&mut self, now: Time, goal: GoalId);
    /// Brings everything that a goal uses to a safe stop.
    fn safe_stop(&mut self, now: Time, goal: GoalId);
    /// Answers a query once, in the order in which it is asked again.
    fn observe(&mut self, now: Time, query: &Query);
    /// Answers a query now and whenever the answer changes.
    fn watch(&mut self, now: Time, query: &Query);
    /// No longer watches a query.
    fn unwatch(&mut self, now: Time, query: &Query);
    /// Lets time pass until the next report, but not beyond `until`. Returns the report with its time, at
    /// most `until`, or `None` if `until` was reached without one. With [`Time::NEVER`], `None` means that no
    /// report will ever come.
    ///
    /// A simulator jumps in virtual time. A driver of a real robot blocks: the robot's thread or the
    /// callbacks of a ROS action send reports into a channel, and `advance` waits for it.
    ///
    /// ```
    /// use motet_runtime::{DriverEvent, Time};
    /// use std::sync::mpsc::Receiver;
    /// use std::time::{Duration, Instant};
    ///
    /// fn advance(reports: &Receiver<DriverEvent>, origin: Instant, until: Time) -> Option<(Time,
    /// DriverEvent)> {
    ///     let now = || Time::from_nanos(origin.elapsed().as_nanos() as u64);
    ///     let event = if until == Time::NEVER {
    ///         reports.recv().ok()?
    ///     } else {
    ///         reports.recv_timeout(Duration::from_nanos(until.since(now()).nanos())).ok()?
    ///     };
    ///     Some((now().min(until), event))
    /// }
    /// ```
    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)>;

    /// Driver behind this one, whose telemetry, words and sight this one passes on. `None` for a driver that
    /// stands alone.
    fn inner(&mut self) -> Option<&mut dyn Driver> {
        None
    }
    /// Next telemetry that was not read yet, the oldest first. The run loop reads all of it after each
    /// [`Driver::advance`]. A driver keeps a bounded number and drops the oldest.
    fn telemetry(&mut self) -> Option<Moved> {
        self.inner()?.telemetry()
    }
    /// Next detections that the driver reported by itself, read like [`Driver::telemetry`].
    fn detected(&mut self) -> Option<Vec<Detection>> {
        self.inner()?.detected()
    }
    /// Next words that a person said without being asked, read like [`Driver::telemetry`].
    fn heard(&mut self) -> Option<Heard> {
        self.inner()?.heard()
    }
    /// Picture of a camera as it is turned now, with depth; of the first camera if none is named. `None` if
    /// there is no such camera or no picture. Looking changes nothing.
    fn look(&mut self, now: Time, camera: Option<&str>) -> Option<RgbdView> {
        self.inner()?.look(now, camera)
    }
    /// Detections in the current view, the surest first. Looking changes nothing.
    fn detections(&mut self, now: Time) -> Vec<Detection> {
        self.inner().map(|inner| inner.detections(now)).unwrap_or_default()
    }

    /// Takes in where a thing is, for what it does from now on. Called only where [`Driver::capabilities`]
    /// says so. It believes this until it sees something else.
    fn told(&mut self, now: Time, thing: &ToldThing) {
        if let Some(inner) = self.inner() {
            inner.told(now, thing);
        }
    }

    /// Carries an effect out by the call that is meant by it. Records, verdicts and the end of the run are
    /// none of its affair.
    fn carry_out(&mut self, now: Time, effect: &Effect) {
        match effect {
            Effect::Start { goal, command, .. } => self.start(now, *goal, command),
            Effect::Cancel { goal } => self.cancel(now, *goal),
            Effect::Update { goal, command, .. } => self.update(now, *goal, command),
            Effect::Hold { goal } => self.hold(now, *goal),
            Effect::Proceed { goal } => self.proceed(now, *goal),
            Effect::SafeStop { goal } => self.safe_stop(now, *goal),
            Effect::Observe { query } => self.observe(now, query),
            Effect::Watch { query } => self.watch(now, query),
            Effect::Unwatch { query } => self.unwatch(now, query),
            Effect::Verify { .. } | Effect::Report(_) | Effect::Finished(_) => {}
        }
    }
}

/// A driver that somebody else looks at meanwhile: a simulator with its eyes.
impl<D: Driver> Driver for Rc<RefCell<D>> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.borrow_mut().start(now, goal, command);
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.borrow_mut().cancel(now, goal);
    }

    fn capabilities(&self) -> Capabilities {
        self.borrow().capabilities()
    }

    fn base(&self) -> Option<[f64; 3]> {
        self.borrow().base()
    }

    fn instance(&mut self) -> Option<String> {
        self.borrow_mut().instance()
    }

    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        self.borrow_mut().begin_run(now, run, graph)
    }

    fn rest(&mut self, now: Time) -> Time {
        self.borrow_mut().rest(now)
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.borrow_mut().update(now, goal, command);
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        self.borrow_mut().hold(now, goal);
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        self.borrow_mut().proceed(now, goal);
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.borrow_mut().safe_stop(now, goal);
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.borrow_mut().observe(now, query);
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.borrow_mut().watch(now, query);
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.borrow_mut().unwatch(now, query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        self.borrow_mut().advance(until)
    }

    fn telemetry(&mut self) -> Option<Moved> {
        self.borrow_mut().telemetry()
    }

    fn detected(&mut self) -> Option<Vec<Detection>> {
        self.borrow_mut().detected()
    }

    fn heard(&mut self) -> Option<Heard> {
        self.borrow_mut().heard()
    }

    fn look(&mut self, now: Time, camera: Option<&str>) -> Option<RgbdView> {
        self.borrow_mut().look(now, camera)
    }

    fn detections(&mut self, now: Time) -> Vec<Detection> {
        self.borrow_mut().detections(now)
    }

    fn told(&mut self, now: Time, thing: &ToldThing) {
        self.borrow_mut().told(now, thing);
    }
}

/// Optional abilities of a driver. What it leaves out has the default; what nobody knows is ignored.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Capabilities {
    /// Primitives that it has. A policy that calls another one is refused before anything moves, and does not
    /// take over either.
    #[serde(skip_serializing_if = "PrimitiveSet::is_all")]
    pub primitives: PrimitiveSet,
    /// Primitives whose goals it can hold and let go on. Others are cancelled by a pause and start again
    /// after it.
    pub hold: PrimitiveSet,
    /// Primitives whose goals take new arguments while they run. Others are cancelled by a swap that changes
    /// them.
    pub update: PrimitiveSet,
    /// Owner of the time of the run.
    #[serde(skip_serializing_if = "DriverClock::is_wall")]
    pub clock: DriverClock,
    /// True if it sends telemetry ([`Driver::telemetry`]).
    #[serde(skip_serializing_if = "is_false")]
    pub moved: bool,
    /// True if it answers [`Driver::look`].
    #[serde(skip_serializing_if = "is_false")]
    pub look: bool,
    /// True if it answers [`Driver::detections`].
    #[serde(skip_serializing_if = "is_false")]
    pub detections: bool,
    /// True if it takes [`Driver::told`].
    #[serde(skip_serializing_if = "is_false")]
    pub told: bool,
    /// True if it takes the facts at the start that the host knows beside the scene.
    #[serde(skip_serializing_if = "is_false")]
    pub state: bool,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_false(value: &bool) -> bool {
    !*value
}

/// Owner of the time of a run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DriverClock {
    /// Time passes as on the wall.
    #[default]
    Wall,
    /// Time stands still between calls of [`Driver::advance`].
    Driver,
}

impl DriverClock {
    #[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
    fn is_wall(&self) -> bool {
        *self == Self::Wall
    }
}

impl Default for Capabilities {
    /// It has every primitive. Everything can be held, or is said not to be by [`DriverEvent::NotHeld`];
    /// nothing can be updated.
    fn default() -> Self {
        Self {
            primitives: PrimitiveSet::All,
            hold: PrimitiveSet::All,
            update: PrimitiveSet::Only(BTreeSet::new()),
            clock: DriverClock::Wall,
            moved: false,
            look: false,
            detections: false,
            told: false,
            state: false,
        }
    }
}

impl Capabilities {
    /// Primitives that a graph calls and the driver does not have, in the order of their first calls.
    /// O(graph).
    #[must_use]
    pub fn missing(&self, graph: &Graph) -> Vec<MissingPrimitive> {
        let mut missing: Vec<MissingPrimitive> = Vec::new();
        for node in &graph.nodes {
            let NodeKind::Call(call) = &node.kind else { continue };
            let Some(primitive) = graph.primitives.get(call.primitive.index()) else { continue };
            let name = &primitive.name;
            if !self.primitives.contains(name) && missing.iter().all(|one| one.name != *name) {
                missing.push(MissingPrimitive { name: name.clone(), path: node.path.clone() });
            }
        }
        missing
    }
}

/// Primitive that a policy calls and the driver does not have.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MissingPrimitive {
    pub name: SmolStr,
    /// Path of the first step that calls it, as a JSON Pointer.
    pub path: SmolStr,
}

impl MissingPrimitive {
    /// Some of them in words: "`wake_up` (at /steps/0), `say` (at /steps/3)".
    #[must_use]
    pub fn list(missing: &[Self]) -> String {
        missing.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
    }
}

impl fmt::Display for MissingPrimitive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` (at {})", self.name, self.path)
    }
}

/// A choice of primitives.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PrimitiveSet {
    All,
    /// Those of these names.
    Only(BTreeSet<SmolStr>),
}

impl PrimitiveSet {
    /// These and those of some names.
    #[must_use]
    pub fn with<'a>(self, more: impl IntoIterator<Item = &'a str>) -> Self {
        match self {
            Self::All => Self::All,
            Self::Only(mut names) => {
                names.extend(more.into_iter().map(SmolStr::from));
                Self::Only(names)
            }
        }
    }

    fn is_all(&self) -> bool {
        *self == Self::All
    }

    /// True if a primitive is among them.
    #[must_use]
    pub fn contains(&self, primitive: &str) -> bool {
        match self {
            Self::All => true,
            Self::Only(names) => names.contains(primitive),
        }
    }
}
