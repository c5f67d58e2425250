//! The driver that the engine's host sees.

mod carry_out;
mod hear;

use super::connect::DriverAddress;
use super::link::{Clock, Link, LinkError};
use super::protocol::{
    DriverCall, DriverMessage, DriverTimeouts, EmptyParams, GoalParams, GoalStatus, Hello, QueryParams,
    StatusParams, StatusResult, VERSION, Welcome, hear, say,
};
use motet_runtime::journal::{OpenGoal, OpenGoals};
use motet_runtime::{Capabilities, Driver, DriverEvent, Effect, Event, GoalId, Query, Time};
use smol_str::SmolStr;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::time::Instant;

/// A driver in another process. Its time is the wall clock's, from where it was connected.
///
/// A driver that ends, is silent, floods or says what is no message is spoken with no more, and
/// [`DriverEvent::DriverLost`] is reported. The next start or safe stop starts or calls it again, a few
/// times; these calls then wait for its greeting. What it used is safe once it has answered the safe stop.
pub struct RemoteDriver {
    address: DriverAddress,
    patience: DriverTimeouts,
    hello: Hello,
    clock: Clock,
    link: Option<Link>,
    welcome: Welcome,
    next_id: u64,
    waiting: BTreeMap<u64, Waiting>,
    outbox: VecDeque<(Time, DriverEvent)>,
    watches: Vec<Query>,
    /// Goals whose safe stop was asked for and is not acknowledged.
    stopping: BTreeSet<GoalId>,
    heard_at: Instant,
    said_at: Instant,
    restarts: u32,
    last: Time,
    note: Box<dyn FnMut(&str)>,
}

/// A call that is not answered.
struct Waiting {
    call: DriverCall,
    due: Instant,
    sayings: u32,
}

impl RemoteDriver {
    /// Starts or calls a driver and greets it. It is `from` then. `note` hears in words what goes wrong, and
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
        note: Box<dyn FnMut(&str)>,
    ) -> Result<Self, LinkError> {
        let hello = Hello { protocol: VERSION, ..hello };
        let capabilities = Capabilities::default();
        let (driver, instance) = (String::new(), String::new());
        let mut this = Self {
            address,
            patience,
            hello,
            clock: Clock::new(from),
            link: None,
            welcome: Welcome { protocol: VERSION, driver, instance, capabilities },
            next_id: 0,
            waiting: BTreeMap::new(),
            outbox: VecDeque::new(),
            watches: Vec::new(),
            stopping: BTreeSet::new(),
            heard_at: Instant::now(),
            said_at: Instant::now(),
            restarts: patience.restarts,
            last: from,
            note,
        };
        this.greet()?;
        this.clock = Clock::new(from);
        Ok(this)
    }

    /// The driver's answer to the greeting.
    #[must_use]
    pub const fn welcome(&self) -> &Welcome {
        &self.welcome
    }

    /// Asks for the state of some goals and waits for the answer.
    ///
    /// # Errors
    ///
    /// It does not say.
    pub fn status(&mut self, goals: Vec<GoalId>) -> Result<StatusResult, LinkError> {
        let asked = self.next_id;
        self.call(DriverCall::Status(StatusParams { goals }));
        let due = Instant::now() + self.patience.answer;
        while let Some(left) = due.checked_duration_since(Instant::now()) {
            let Some(line) = self.link.as_ref().ok_or(LinkError::Closed)?.hear(left)? else { break };
            match hear(&line).map_err(|why| nonsense(&line, why))? {
                DriverMessage::Answer(id, Ok(told)) if id == asked => {
                    self.waiting.remove(&asked);
                    return serde_json::from_value(told).map_err(|why| nonsense(&line, why.to_string()));
                }
                DriverMessage::Answer(id, Err(wrong)) if id == asked => {
                    return Err(LinkError::Greeting(wrong.message));
                }
                DriverMessage::Answer(..) | DriverMessage::Report(_) => self.heard(&line),
            }
        }
        Err(LinkError::Silent(self.patience.answer))
    }

    /// Opens a connection and greets.
    fn greet(&mut self) -> Result<(), LinkError> {
        let link = self.address.open(self.patience.greeting)?;
        let id = self.id();
        link.say(say(id, &DriverCall::Hello(self.hello.clone())))?;
        let Some(line) = link.hear(self.patience.greeting)? else {
            let secs = self.patience.greeting.as_secs_f64();
            return Err(LinkError::Greeting(format!("nothing for {secs:.1} s")));
        };
        let answer = hear(&line).map_err(|why| nonsense(&line, why))?;
        let welcome = match answer {
            DriverMessage::Answer(answered, Ok(welcome)) if answered == id => welcome,
            DriverMessage::Answer(_, Err(wrong)) => return Err(LinkError::Greeting(wrong.message)),
            DriverMessage::Answer(_, Ok(_)) | DriverMessage::Report(_) => {
                return Err(LinkError::Greeting("it said something else first".to_owned()));
            }
        };
        let welcome: Welcome =
            serde_json::from_value(welcome).map_err(|why| nonsense(&line, why.to_string()))?;
        if welcome.protocol != VERSION {
            let found = welcome.protocol;
            let why = format!("it speaks version {found} of the protocol, this program speaks {VERSION}");
            return Err(LinkError::Greeting(why));
        }
        self.welcome = welcome;
        self.heard_at = Instant::now();
        self.link = Some(link);
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
        (self.note)(&format!("calling the driver again: {}", self.address));
        if let Err(breakage) = self.greet() {
            (self.note)(&breakage.to_string());
            return false;
        }
        for query in self.watches.clone() {
            self.call(DriverCall::Watch(QueryParams::from(&query)));
        }
        for goal in self.stopping.clone() {
            self.call(DriverCall::SafeStop(GoalParams { goal }));
        }
        self.link.is_some()
    }

    fn id(&mut self) -> u64 {
        self.next_id += 1;
        self.next_id - 1
    }

    fn call(&mut self, call: DriverCall) {
        self.call_again(call, 1);
    }

    fn call_again(&mut self, call: DriverCall, sayings: u32) {
        let Some(link) = &self.link else { return };
        let said = link.say(say(self.next_id, &call));
        self.said_at = Instant::now();
        let id = self.id();
        match said {
            Ok(()) => {
                let due = Instant::now() + self.patience.answer;
                self.waiting.insert(id, Waiting { call, due, sayings });
            }
            Err(breakage) => self.broke(&breakage),
        }
    }

    fn report(&mut self, event: DriverEvent) {
        self.outbox.push_back((self.clock.now(), event));
    }

    /// The connection is of no use any more.
    fn broke(&mut self, breakage: &LinkError) {
        if self.link.take().is_some() {
            (self.note)(&breakage.to_string());
            self.waiting.clear();
            self.report(DriverEvent::DriverLost);
        }
    }
}

impl Drop for RemoteDriver {
    fn drop(&mut self) {
        if let Some(link) = &mut self.link {
            let _ = link.say(say(self.next_id, &DriverCall::Bye(EmptyParams {})));
            link.end(self.patience.farewell);
        }
    }
}

const fn failed() -> SmolStr {
    SmolStr::new_static("failed")
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
    /// has it stopped safely.
    ///
    /// # Errors
    ///
    /// It does not say.
    pub fn catch_up(
        &mut self,
        ledger: &OpenGoals,
        instance: &str,
        now: Time,
    ) -> Result<Vec<Event>, LinkError> {
        let told = self.status(ledger.goals.keys().copied().collect())?;
        let states: BTreeMap<GoalId, GoalStatus> =
            told.goals.into_iter().map(|told| (told.goal, told.state)).collect();
        let is_same = self.welcome().instance == instance;
        let mut events = Vec::new();
        for (&goal, open) in &ledger.goals {
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
                    let outcome = self.named(outcome.clone());
                    events.push(DriverEvent::Ended { goal, outcome });
                }
                Some(GoalStatus::Refused(failure)) => {
                    events.push(DriverEvent::Refused { goal, failure: self.failure(failure) });
                }
                Some(GoalStatus::Stopped) => events.push(DriverEvent::Stopped { goal }),
                Some(GoalStatus::Unknown) if is_same && just_started => {
                    self.start(now, goal, &open.command);
                }
                // Whoever is asked again for a safe stop brings it about, also for what was started by
                // another.
                Some(GoalStatus::Unknown) | None if matches!(open.told, Some(Effect::SafeStop { .. })) => {
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
        Ok(events.into_iter().map(Event::Driver).collect())
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
