//! The driver that the engine's host sees.

use super::clock::Clock;
use super::connect::Address;
use super::link::{Breakage, Link};
use super::protocol::{
    Answered, Asked, Call, Goal, Goals, Heard, Hello, Nothing, REFUSED, RefusedData, Report, Start, Told,
    VERSION, Welcome, Wrong, hear, say,
};
use super::settings::{Patience, SAYINGS};
use motet_runtime::{Answer, Capabilities, Command, Driver, DriverEvent, GoalId, Query, Time, wire};
use serde_json::Value;
use smol_str::SmolStr;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::thread;
use std::time::{Duration, Instant};

/// The longest wait without looking after what is due.
const SLICE: Duration = Duration::from_millis(50);
/// The most lines that are heard before what they say is handed on.
const BATCH: usize = 64;

/// A driver in another process. Its time is the wall clock's, from where it was connected.
///
/// A driver that ends, is silent, floods or says what is no message is spoken with no more, and
/// [`DriverEvent::DriverLost`] is reported. The next start or safe stop starts or calls it again, a few times; these calls
/// then wait for its greeting. What it used is safe once it has answered the safe stop.
pub struct RemoteDriver {
    address: Address,
    patience: Patience,
    hello: Hello,
    clock: Clock,
    link: Option<Link>,
    welcome: Welcome,
    next_id: u64,
    waiting: BTreeMap<u64, Waiting>,
    outbox: VecDeque<(Time, DriverEvent)>,
    watches: Vec<Query>,
    /// Goals whose safe stop was asked for and is not acknowledged.
    stopping: BTreeSet<u64>,
    heard_at: Instant,
    restarts: u32,
    last: Time,
    note: Box<dyn FnMut(&str)>,
}

/// A call that is not answered.
struct Waiting {
    call: Call,
    due: Instant,
    sayings: u32,
}

impl RemoteDriver {
    /// Starts or calls a driver and greets it. It is `from` then. `note` hears in words what goes wrong, and feedback.
    ///
    /// # Errors
    ///
    /// It cannot be reached, or does not speak this protocol.
    pub fn connect(
        address: Address,
        hello: Hello,
        patience: Patience,
        from: Time,
        note: Box<dyn FnMut(&str)>,
    ) -> Result<Self, Breakage> {
        let hello = Hello { protocol: VERSION, ..hello };
        let capabilities = (&Capabilities::default()).into();
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
            restarts: patience.restarts,
            last: from,
            note,
        };
        this.greet()?;
        this.clock = Clock::new(from);
        Ok(this)
    }

    /// What the driver said of itself.
    #[must_use]
    pub const fn welcome(&self) -> &Welcome {
        &self.welcome
    }

    /// What became of some goals, asked for and waited for.
    ///
    /// # Errors
    ///
    /// It does not say.
    pub fn status(&mut self, goals: Vec<u64>) -> Result<Told, Breakage> {
        let asked = self.next_id;
        self.call(Call::Status(Goals { goals }));
        let due = Instant::now() + self.patience.answer;
        while let Some(left) = due.checked_duration_since(Instant::now()) {
            let Some(line) = self.link.as_ref().ok_or(Breakage::Closed)?.hear(left)? else { break };
            match hear(&line).map_err(|why| nonsense(&line, why))? {
                Heard::Answer(id, Ok(told)) if id == asked => {
                    self.waiting.remove(&asked);
                    return serde_json::from_value(told).map_err(|why| nonsense(&line, why.to_string()));
                }
                Heard::Answer(id, Err(wrong)) if id == asked => {
                    return Err(Breakage::Greeting(wrong.message));
                }
                Heard::Answer(..) | Heard::Report(_) => self.heard(&line),
            }
        }
        Err(Breakage::Silent(self.patience.answer))
    }

    /// Opens a connection and greets.
    fn greet(&mut self) -> Result<(), Breakage> {
        let link = self.address.open(self.patience.greeting)?;
        let id = self.id();
        link.say(say(id, &Call::Hello(self.hello.clone())))?;
        let Some(line) = link.hear(self.patience.greeting)? else {
            let secs = self.patience.greeting.as_secs_f64();
            return Err(Breakage::Greeting(format!("nothing for {secs:.1} s")));
        };
        let answer = hear(&line).map_err(|why| nonsense(&line, why))?;
        let welcome = match answer {
            Heard::Answer(answered, Ok(welcome)) if answered == id => welcome,
            Heard::Answer(_, Err(wrong)) => return Err(Breakage::Greeting(wrong.message)),
            Heard::Answer(_, Ok(_)) | Heard::Report(_) => {
                return Err(Breakage::Greeting("it said something else first".to_owned()));
            }
        };
        let welcome: Welcome =
            serde_json::from_value(welcome).map_err(|why| nonsense(&line, why.to_string()))?;
        if welcome.protocol != VERSION {
            let found = welcome.protocol;
            let why = format!("it speaks version {found} of the protocol, this program speaks {VERSION}");
            return Err(Breakage::Greeting(why));
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
            self.call(Call::Watch(asked(&query)));
        }
        for goal in self.stopping.clone() {
            self.call(Call::SafeStop(Goal { goal }));
        }
        self.link.is_some()
    }

    fn id(&mut self) -> u64 {
        self.next_id += 1;
        self.next_id - 1
    }

    fn call(&mut self, call: Call) {
        self.call_again(call, 1);
    }

    fn call_again(&mut self, call: Call, sayings: u32) {
        let Some(link) = &self.link else { return };
        let said = link.say(say(self.next_id, &call));
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
    fn broke(&mut self, breakage: &Breakage) {
        if self.link.take().is_some() {
            (self.note)(&breakage.to_string());
            self.waiting.clear();
            self.report(DriverEvent::DriverLost);
        }
    }

    /// Hears what is said, for so long at most until something is.
    fn listen(&mut self, within: Duration) {
        let mut within = within;
        for _ in 0..BATCH {
            let Some(link) = &self.link else { return };
            match link.hear(within) {
                Ok(Some(line)) => self.heard(&line),
                Ok(None) => return,
                Err(breakage) => self.broke(&breakage),
            }
            within = Duration::ZERO;
        }
    }

    fn heard(&mut self, line: &str) {
        self.heard_at = Instant::now();
        match hear(line) {
            Ok(Heard::Answer(id, answer)) => {
                // An answer to what is no longer waited for says nothing new.
                if let Some(waiting) = self.waiting.remove(&id) {
                    self.answered(waiting.call, answer, line);
                } else if id >= self.next_id {
                    self.broke(&nonsense(line, "nothing with this number was asked".to_owned()));
                }
            }
            Ok(Heard::Report(report)) => self.told(report),
            Err(why) => self.broke(&nonsense(line, why)),
        }
    }

    fn told(&mut self, report: Report) {
        let id = GoalId::from_number;
        match report {
            Report::Ended(ended) => {
                self.report(DriverEvent::Ended { goal: id(ended.goal), outcome: ended.outcome.into() });
            }
            Report::NotHeld(Goal { goal }) => self.report(DriverEvent::NotHeld { goal: id(goal) }),
            Report::Stopped(Goal { goal }) => {
                self.stopping.remove(&goal);
                self.report(DriverEvent::Stopped { goal: id(goal) });
            }
            Report::Lost(Goal { goal }) => self.report(DriverEvent::Lost { goal: id(goal) }),
            Report::Observed(observed) => {
                let (query, answer) = (observed.query.into(), observed.answer.into());
                self.report(DriverEvent::Observed { query, answer });
            }
            Report::Feedback(feedback) => {
                (self.note)(&format!("goal {}: {}", id(feedback.goal), feedback.text));
            }
        }
    }

    fn answered(&mut self, call: Call, answer: Result<Value, Wrong>, line: &str) {
        match (call, answer) {
            (Call::Start(start), Ok(_)) => {
                self.report(DriverEvent::Acknowledged { goal: GoalId::from_number(start.goal) });
            }
            (Call::Start(start), Err(wrong)) => {
                let data: Option<RefusedData> = serde_json::from_value(wrong.data.clone()).ok();
                if wrong.code != REFUSED {
                    (self.note)(&format!("the driver does not start a goal: {}", wrong.message));
                }
                let failure = data.map_or_else(failed, |data| data.failure.into());
                self.report(DriverEvent::Refused { goal: GoalId::from_number(start.goal), failure });
            }
            (Call::Observe(asked) | Call::Watch(asked), Ok(value)) => {
                match serde_json::from_value::<Answered>(value) {
                    Ok(answered) => self.observed(asked, answered.answer.into()),
                    Err(why) => self.broke(&nonsense(line, why.to_string())),
                }
            }
            (Call::Observe(asked) | Call::Watch(asked), Err(_)) => self.observed(asked, Answer::Unknown),
            (Call::Hold(Goal { goal }), Err(_)) => {
                self.report(DriverEvent::NotHeld { goal: GoalId::from_number(goal) });
            }
            (Call::Update(start), Err(wrong)) => {
                (self.note)(&format!("the driver does not update a goal: {}", wrong.message));
                self.report(DriverEvent::Lost { goal: GoalId::from_number(start.goal) });
            }
            (
                Call::Cancel(_)
                | Call::Proceed(_)
                | Call::SafeStop(_)
                | Call::Unwatch(_)
                | Call::Ping(_)
                | Call::Status(_)
                | Call::Hello(_)
                | Call::Bye(_),
                Err(wrong),
            ) => (self.note)(&format!("the driver says: {}", wrong.message)),
            (_, Ok(_)) => {}
        }
    }

    fn observed(&mut self, asked: Asked, answer: Answer) {
        self.report(DriverEvent::Observed { query: asked.query.into(), answer });
    }

    /// Looks after answers that are overdue, and signs of life.
    fn tend(&mut self) {
        if self.link.is_none() {
            // What may still move is to be stopped, whoever has to be called for it.
            if !self.stopping.is_empty() {
                self.reach();
            }
            return;
        }
        let now = Instant::now();
        let overdue: Vec<u64> =
            self.waiting.iter().filter(|(_, waiting)| waiting.due <= now).map(|(id, _)| *id).collect();
        for id in overdue {
            if let Some(Waiting { call, sayings, .. }) = self.waiting.remove(&id) {
                self.overdue(call, sayings);
            }
        }
        let silent = self.heard_at.elapsed();
        if silent >= self.patience.silence {
            self.broke(&Breakage::Silent(silent));
        } else if silent >= self.patience.heartbeat
            && !self.waiting.values().any(|waiting| matches!(waiting.call, Call::Ping(_)))
        {
            self.call(Call::Ping(Nothing {}));
        }
    }

    /// An answer did not come in time. That says nothing of what was done.
    fn overdue(&mut self, call: Call, sayings: u32) {
        match call {
            Call::Start(start) if sayings < SAYINGS => self.call_again(Call::Start(start), sayings + 1),
            Call::Start(start) | Call::Update(start) => {
                let goal = GoalId::from_number(start.goal);
                (self.note)(&format!("the driver does not say whether goal {goal} runs"));
                self.report(DriverEvent::Lost { goal });
            }
            Call::Observe(asked) | Call::Watch(asked) => self.observed(asked, Answer::Unknown),
            // The engine waits for what follows from these, and not for ever.
            Call::Cancel(_) | Call::Hold(_) | Call::Proceed(_) | Call::SafeStop(_) | Call::Unwatch(_) => {}
            Call::Status(_) | Call::Ping(_) | Call::Hello(_) | Call::Bye(_) => {}
        }
    }
}

impl Driver for RemoteDriver {
    fn start(&mut self, _now: Time, goal: GoalId, command: &Command) {
        if self.reach() {
            self.call(Call::Start(Start { goal: goal.number(), command: command.into() }));
        } else {
            // It was never said, so it was never done.
            self.report(DriverEvent::Refused { goal, failure: failed() });
        }
    }

    fn cancel(&mut self, _now: Time, goal: GoalId) {
        self.call(Call::Cancel(Goal { goal: goal.number() }));
    }

    fn capabilities(&self) -> Capabilities {
        self.welcome.capabilities.clone().into()
    }

    fn update(&mut self, _now: Time, goal: GoalId, command: &Command) {
        self.call(Call::Update(Start { goal: goal.number(), command: command.into() }));
    }

    fn hold(&mut self, _now: Time, goal: GoalId) {
        self.call(Call::Hold(Goal { goal: goal.number() }));
    }

    fn proceed(&mut self, _now: Time, goal: GoalId) {
        self.call(Call::Proceed(Goal { goal: goal.number() }));
    }

    fn safe_stop(&mut self, _now: Time, goal: GoalId) {
        let was_reached = self.link.is_some();
        self.stopping.insert(goal.number());
        // Who is called again is told all that is to stop.
        if self.reach() && was_reached {
            self.call(Call::SafeStop(Goal { goal: goal.number() }));
        }
    }

    fn observe(&mut self, _now: Time, query: &Query) {
        if self.link.is_some() {
            self.call(Call::Observe(asked(query)));
        } else {
            self.observed(asked(query), Answer::Unknown);
        }
    }

    fn watch(&mut self, _now: Time, query: &Query) {
        if self.watches.contains(query) {
            return;
        }
        self.watches.push(query.clone());
        if self.link.is_some() {
            self.call(Call::Watch(asked(query)));
        } else {
            self.observed(asked(query), Answer::Unknown);
        }
    }

    fn unwatch(&mut self, _now: Time, query: &Query) {
        self.watches.retain(|watched| watched != query);
        self.call(Call::Unwatch(asked(query)));
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let mut wait = Duration::ZERO;
        loop {
            self.listen(wait);
            self.tend();
            if let Some((at, event)) = self.outbox.pop_front() {
                self.last = at.min(until).max(self.last);
                return Some((self.last, event));
            }
            let left = self.clock.left(until);
            match (left, &self.link) {
                (Some(Duration::ZERO), _) | (None, None) => return None,
                (Some(left), None) => {
                    thread::sleep(left.min(SLICE));
                    wait = Duration::ZERO;
                }
                (left, Some(_)) => wait = left.map_or(SLICE, |left| left.min(SLICE)),
            }
        }
    }
}

impl Drop for RemoteDriver {
    fn drop(&mut self) {
        if let Some(link) = &self.link {
            let _ = link.say(say(self.next_id, &Call::Bye(Nothing {})));
        }
    }
}

fn asked(query: &Query) -> Asked {
    Asked { query: wire::Query::from(query) }
}

const fn failed() -> SmolStr {
    SmolStr::new_static("failed")
}

fn nonsense(line: &str, why: String) -> Breakage {
    let mut beginning: String = line.chars().take(80).collect();
    if beginning.len() < line.len() {
        beginning.push('…');
    }
    Breakage::Nonsense(beginning, why)
}
