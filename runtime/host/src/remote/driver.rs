//! The driver that the engine's host sees.

mod ask;
mod carry_out;
mod goals;
mod hear;
mod log;
mod run_time;
mod telemetry;

pub use self::log::{DriverLog, LineFrom};

use self::goals::GoalLedger;
use self::run_time::RunTime;
use self::telemetry::TelemetryQueue;
use super::connect::{DriverAddress, Route};
use super::link::{Clock, KeepAlive, Link, LinkError};
use super::protocol::{
    DriverCall, DriverMessage, DriverTimeouts, EmptyParams, GoalParams, GoalStatus, Hello, MAX_BREACHES,
    MAX_WAITING, QueryParams, StatusResult, VERSION, Welcome, hear, say,
};
use super::rate::LineRate;
use motet_graph::Graph;
use motet_runtime::journal::{OpenGoal, OpenGoals};
use motet_runtime::{Capabilities, Driver, DriverClock, DriverEvent, Effect, Event, GoalId, Query, Time};
use motet_stdlib::lang;
use serde_json::Value;
use smol_str::SmolStr;
use std::collections::{BTreeMap, VecDeque};
#[cfg(unix)]
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// The most breaches of promises that are told.
const MOST_BREACHES: u32 = 20;

/// A driver in another process. Its time is the wall clock's from where it was connected, or its own
/// ([`DriverClock`]): then each call is waited for, and time passes only in [`Driver::advance`].
///
/// A driver that ends, is silent, floods or says what is no message is spoken with no more, and
/// [`DriverEvent::DriverLost`] is reported. The next start or safe stop starts or calls it again, a few
/// times; these calls then wait for its greeting. What it used is safe once it has answered the safe stop.
/// Once it is called no more, [`DriverEvent::DriverGone`] is the answer to a safe stop.
pub struct RemoteDriver {
    route: Route,
    patience: DriverTimeouts,
    hello: Hello,
    time: RunTime,
    link: Option<Link>,
    welcome: Welcome,
    /// Number of the next call, which the link takes one of for each sign of life that it gives by itself.
    next_id: Arc<AtomicU64>,
    waiting: BTreeMap<u64, Waiting>,
    outbox: VecDeque<(Time, DriverEvent)>,
    telemetry: TelemetryQueue,
    watches: Vec<Query>,
    goals: GoalLedger,
    breaches: u32,
    heard_at: Instant,
    rate: LineRate,
    /// Feedback, reported facts and detections of this second.
    feedback: LineRate,
    facts: LineRate,
    detections: LineRate,
    /// Bytes of reports.
    bytes: LineRate,
    said_at: Instant,
    /// It was asked for more than a sign of life since it said something.
    is_asked: bool,
    restarts: u32,
    /// Time from which it is called again, for what may still move.
    call_at: Instant,
    last: Time,
    log: Box<dyn DriverLog>,
}

/// A call that is not answered.
struct Waiting {
    call: DriverCall,
    due: Instant,
    sayings: u32,
}

impl RemoteDriver {
    /// Starts or calls a driver and greets it. It is `from` then. `log` hears in words what goes wrong, and
    /// feedback.
    ///
    /// # Errors
    ///
    /// It cannot be reached, or does not speak this protocol.
    pub fn connect(
        address: DriverAddress,
        hello: Hello,
        patience: DriverTimeouts,
        from: Time,
        log: Box<dyn DriverLog>,
    ) -> Result<Self, LinkError> {
        Self::on_route(Route::Address(address), hello, patience, from, log)
    }

    /// Greets a driver in this process, at the other end of a stream. It is `from` then. What ends the stream
    /// ends the driver: it is not called again.
    ///
    /// # Errors
    ///
    /// It does not speak this protocol.
    #[cfg(unix)]
    pub fn over_stream(
        stream: UnixStream,
        hello: Hello,
        patience: DriverTimeouts,
        from: Time,
        log: Box<dyn DriverLog>,
    ) -> Result<Self, LinkError> {
        let patience = DriverTimeouts { restarts: 0, ..patience };
        Self::on_route(Route::Stream(Some(stream)), hello, patience, from, log)
    }

    fn on_route(
        route: Route,
        hello: Hello,
        patience: DriverTimeouts,
        from: Time,
        log: Box<dyn DriverLog>,
    ) -> Result<Self, LinkError> {
        let hello = Hello { protocol: VERSION, ..hello };
        let goals = GoalLedger::new(&hello.primitives);
        let capabilities = Capabilities::default();
        let (driver, instance) = (String::new(), String::new());
        let mut this = Self {
            route,
            patience,
            hello,
            time: RunTime::Own { now: from, stall: None },
            link: None,
            welcome: Welcome { protocol: VERSION, driver, instance, capabilities },
            next_id: Arc::default(),
            waiting: BTreeMap::new(),
            outbox: VecDeque::new(),
            telemetry: TelemetryQueue::default(),
            watches: Vec::new(),
            goals,
            breaches: 0,
            heard_at: Instant::now(),
            rate: LineRate::default(),
            feedback: LineRate::default(),
            facts: LineRate::default(),
            detections: LineRate::default(),
            bytes: LineRate::default(),
            said_at: Instant::now(),
            is_asked: false,
            restarts: patience.restarts,
            call_at: Instant::now(),
            last: from,
            log,
        };
        let early = this.greet()?;
        this.set_time(from);
        early.iter().for_each(|line| this.hear_line(line));
        Ok(this)
    }

    /// The driver's answer to the greeting.
    #[must_use]
    pub const fn welcome(&self) -> &Welcome {
        &self.welcome
    }

    /// It is `now`, by the clock that the driver names.
    fn set_time(&mut self, now: Time) {
        self.time = match self.welcome.capabilities.clock {
            DriverClock::Wall => RunTime::Wall(Clock::new(now)),
            DriverClock::Driver => RunTime::Own { now, stall: None },
        };
    }

    /// Opens a connection and greets. Gives the reports that came before the answer: what a driver went on
    /// with may end just then.
    fn greet(&mut self) -> Result<Vec<String>, LinkError> {
        let ids = Arc::clone(&self.next_id);
        let ping = move || {
            let id = ids.fetch_add(1, Ordering::SeqCst);
            say(id, &DriverCall::Ping(EmptyParams {}), None)
        };
        let keep_alive = KeepAlive { line: Box::new(ping), after: self.patience.heartbeat * 2 };
        let link = self.route.open(self.patience.greeting, keep_alive, self.log.error_output())?;
        self.greet_on(link)
    }

    /// Greets on a connection, which is kept if the answer is good.
    fn greet_on(&mut self, link: Link) -> Result<Vec<String>, LinkError> {
        let (mut early, call) = (Vec::new(), DriverCall::Hello(self.hello.clone()));
        let greeted = self.ask_on(&link, &call, self.patience.greeting, &mut early)?;
        let Some((welcome, line)) = greeted else {
            let secs = self.patience.greeting.as_secs_f64();
            return Err(LinkError::Greeting(format!("nothing for {secs:.1} s")));
        };
        let welcome: Welcome =
            serde_json::from_value(welcome).map_err(|why| nonsense(&line, why.to_string()))?;
        if welcome.protocol != VERSION {
            let found = welcome.protocol;
            let why = format!("it speaks version {found} of the protocol, this program speaks {VERSION}");
            return Err(LinkError::Greeting(why));
        }
        let is_first = self.welcome.instance.is_empty();
        if !is_first && welcome.capabilities.clock != self.welcome.capabilities.clock {
            return Err(LinkError::Greeting("the owner of the clock has changed".to_owned()));
        }
        // One that hears nothing is told nothing that moves the robot.
        if welcome.capabilities.clock == DriverClock::Wall {
            let (call, within) = (DriverCall::Ping(EmptyParams {}), self.patience.answer);
            self.ask_on(&link, &call, within, &mut early)?.ok_or(LinkError::Mute(within))?;
        }
        self.welcome = welcome;
        if let RunTime::Own { stall, .. } = &mut self.time {
            *stall = None;
        }
        // Whoever is called again goes on with the same run.
        self.hello.resumed = true;
        self.heard_at = Instant::now();
        if self.welcome.capabilities.clock == DriverClock::Wall {
            link.keep_alive();
        }
        self.link = Some(link);
        Ok(early)
    }

    /// Asks on a connection that is being made; `None` where no answer comes in time. Reports before it are
    /// kept.
    fn ask_on(
        &mut self,
        link: &Link,
        call: &DriverCall,
        within: Duration,
        early: &mut Vec<String>,
    ) -> Result<Option<(Value, String)>, LinkError> {
        let id = self.id();
        let said = say(id, call, Some(self.time.now()));
        self.log.line(LineFrom::Host, &said);
        link.say(said)?;
        let due = Instant::now() + within;
        let left = || due.saturating_duration_since(Instant::now());
        while let Some(line) = link.hear_unless(left(), self.patience.is_over)? {
            match hear(&line).map_err(|why| nonsense(&line, why))? {
                DriverMessage::Answer(answered, Ok(answer)) if answered == id => {
                    self.log.line(LineFrom::Driver, &line);
                    return Ok(Some((answer, line)));
                }
                DriverMessage::Answer(answered, Err(wrong)) if answered == id => {
                    return Err(LinkError::Greeting(wrong.message));
                }
                DriverMessage::Report(_) if early.len() < MAX_WAITING => early.push(line),
                // The answer to a call of the run before, or to a sign of life.
                DriverMessage::Answer(answered, _) if answered < self.next_id.load(Ordering::SeqCst) => {}
                DriverMessage::Answer(..) | DriverMessage::Report(_) => {
                    return Err(LinkError::Greeting("it said something else first".to_owned()));
                }
            }
        }
        Ok(None)
    }

    /// Greets for another run, on the same connection or, where that is gone, on a new one. What was asked
    /// for and reported before counts no more.
    fn begin(&mut self, run: &str, graph: Option<&Graph>) -> Result<(), LinkError> {
        let hello = match graph {
            Some(graph) => Hello::of(graph, run),
            None => Hello { run: run.to_owned(), ..self.hello.clone() },
        };
        self.hello = Hello { protocol: VERSION, resumed: false, state: Vec::new(), ..hello };
        self.goals = GoalLedger::new(&self.hello.primitives);
        self.watches.clear();
        self.waiting.clear();
        self.outbox.clear();
        (self.breaches, self.restarts) = (0, self.patience.restarts);
        // Reports from before the answer are of the run before, but for words and telemetry.
        let early = match self.link.take() {
            Some(link) => self.greet_on(link)?,
            None => self.greet()?,
        };
        for line in early {
            if let Ok(DriverMessage::Report(report)) = hear(&line)
                && !report.is_of_a_run()
            {
                self.hear_line(&line);
            }
        }
        Ok(())
    }

    /// Sees to it that there is somebody to speak with.
    fn reach(&mut self) -> bool {
        if self.link.is_some() {
            return true;
        }
        if self.restarts == 0 {
            return false;
        }
        self.restarts -= 1;
        self.log.note(&format!("calling the driver again: {}", self.route));
        match self.greet() {
            Ok(early) => early.iter().for_each(|line| self.hear_line(line)),
            Err(breakage) => {
                // One that is mute again is not waited for where nothing moves.
                if matches!(breakage, LinkError::Mute(_)) && self.goals.is_idle() {
                    self.restarts = 0;
                }
                self.log.note(&breakage.to_string());
                return false;
            }
        }
        for query in self.watches.clone() {
            self.call(DriverCall::Watch(QueryParams::from(&query)));
        }
        for goal in self.goals.stopping.clone() {
            self.call(DriverCall::SafeStop(GoalParams { goal }));
        }
        self.link.is_some()
    }

    /// Sees to it that somebody stops what may still move, and reports it where nobody ever will.
    fn reach_to_stop(&mut self) -> bool {
        let is_reached = self.reach();
        if !is_reached && self.restarts == 0 {
            self.goals.stopping.clear();
            self.watches.clear();
            self.report(DriverEvent::DriverGone);
        } else if !is_reached && self.route.is_port() {
            // Whoever listens there may be starting anew.
            self.call_at = Instant::now() + self.patience.answer;
        }
        is_reached
    }

    fn id(&self) -> u64 {
        self.next_id.fetch_add(1, Ordering::SeqCst)
    }

    fn call(&mut self, call: DriverCall) {
        self.call_again(call, 1);
    }

    fn call_again(&mut self, call: DriverCall, sayings: u32) {
        let Ok(id) = self.say(&call) else { return };
        let due = Instant::now() + self.patience.answer;
        self.waiting.insert(id, Waiting { call, due, sayings });
        if self.time.is_own() {
            self.wait_for(id);
        }
    }

    /// Says a call and gives its number.
    fn say(&mut self, call: &DriverCall) -> Result<u64, LinkError> {
        let link = self.link.as_ref().ok_or(LinkError::Closed)?;
        let id = self.next_id.fetch_add(1, Ordering::SeqCst);
        let line = say(id, call, self.time.told());
        self.log.line(LineFrom::Host, &line);
        let said = link.say(line);
        self.said_at = Instant::now();
        self.is_asked |= !matches!(call, DriverCall::Ping(_));
        if let Err(breakage) = &said {
            self.broke(breakage);
        }
        said.map(|()| id)
    }

    fn report(&mut self, event: DriverEvent) {
        self.outbox.push_back((self.time.now(), event));
    }

    /// Tells a promise that the driver broke, as long as there are few.
    fn breach(&mut self, text: &str) {
        self.breaches = self.breaches.saturating_add(1);
        match self.breaches {
            ..MOST_BREACHES => self.log.breach(text),
            MOST_BREACHES => self.log.breach(&format!("{text}; further broken promises are not reported")),
            MAX_BREACHES.. => self.broke(&LinkError::Faithless),
            _ => {}
        }
    }

    /// The connection is of no use any more.
    fn broke(&mut self, breakage: &LinkError) {
        if self.link.take().is_some() {
            self.log.note(&breakage.to_string());
            self.waiting.clear();
            self.report(DriverEvent::DriverLost);
        }
    }
}

impl Drop for RemoteDriver {
    fn drop(&mut self) {
        if let Some(link) = &mut self.link {
            let bye = say(0, &DriverCall::Bye(EmptyParams {}), None);
            self.log.line(LineFrom::Host, &bye);
            let _ = link.say(bye);
            link.end(self.patience.farewell);
        }
    }
}

const fn failed() -> SmolStr {
    SmolStr::new_static(lang::failures::FAILED)
}

fn nonsense(line: &str, why: String) -> LinkError {
    let mut beginning: String = line.chars().take(80).collect();
    if beginning.len() < line.len() {
        beginning.push('…');
    }
    LinkError::Nonsense(beginning, why)
}

impl RemoteDriver {
    /// Asks what became of the goals that are open by the journal, says again what it was told of those that
    /// have not ended, and gives the events with which the engine goes on. `instance` is the driver's that
    /// the run began with.
    ///
    /// Commands can be said twice, and what was written down last before a crash may never have been said.
    ///
    /// A goal of which the driver has never heard was not started, if it is the same driver and the start was
    /// the last thing that was written down: then it is started now. Any other one is lost, and the engine
    /// has it stopped safely. All are lost if the driver does not answer.
    pub fn catch_up(&mut self, ledger: &OpenGoals, instance: &str, now: Time) -> Vec<Event> {
        for (&goal, open) in &ledger.goals {
            self.goals.started(goal, &open.command.primitive);
        }
        let is_stopping = |open: &OpenGoal| matches!(open.told, Some(Effect::SafeStop { .. }));
        let stopping = ledger.goals.iter().filter(|(_, open)| is_stopping(open)).map(|(goal, _)| *goal);
        self.goals.stopping.extend(stopping);
        let told = self.status(ledger.goals.keys().copied().collect()).unwrap_or_else(|why| {
            self.log.note(&format!("no status: {why}"));
            StatusResult { goals: Vec::new() }
        });
        let states: BTreeMap<GoalId, GoalStatus> =
            told.goals.into_iter().map(|told| (told.goal, told.state)).collect();
        // They are asked to stop again, unless they have.
        self.goals.stopping.retain(|goal| !ledger.goals.contains_key(goal));
        let is_same = self.welcome().instance == instance;
        let mut events = Vec::new();
        for (&goal, open) in &ledger.goals {
            if !self.goals.is_live(goal) {
                // The driver reported its end while it was asked for the status.
                continue;
            }
            let just_started = ledger
                .uncertain
                .iter()
                .any(|effect| matches!(effect, Effect::Start { goal: started, .. } if *started == goal));
            match states.get(&goal) {
                Some(GoalStatus::Running) => {
                    events.push(DriverEvent::Acknowledged { goal });
                    self.say_again(now, goal, open);
                }
                Some(GoalStatus::Ended(outcome)) => {
                    self.goals.ended(goal);
                    let outcome = self.named(outcome.clone());
                    events.push(DriverEvent::Ended { goal, outcome });
                }
                Some(GoalStatus::Refused(failure)) => {
                    self.goals.ended(goal);
                    events.push(DriverEvent::Refused { goal, failure: self.failure(failure) });
                }
                Some(GoalStatus::Stopped) => {
                    self.goals.ended(goal);
                    events.push(DriverEvent::Stopped { goal });
                }
                Some(GoalStatus::Unknown) if is_same && just_started => {
                    self.start(now, goal, &open.command);
                }
                // Whoever is asked again for a safe stop brings it about, also for what was started by
                // another.
                Some(GoalStatus::Unknown) | None if is_stopping(open) => {
                    self.say_again(now, goal, open);
                }
                Some(GoalStatus::Unknown) | None => events.push(DriverEvent::Lost { goal }),
            }
        }
        for query in &ledger.watches {
            self.watch(now, query);
        }
        for query in &ledger.observations {
            self.observe(now, query);
        }
        events.into_iter().map(Event::Driver).collect()
    }

    fn say_again(&mut self, now: Time, goal: GoalId, open: &OpenGoal) {
        if open.updated {
            self.update(now, goal, &open.command);
        }
        if let Some(told) = &open.told {
            self.carry_out(now, told);
        }
    }
}
