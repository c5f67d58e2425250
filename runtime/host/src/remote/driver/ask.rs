//! Calls whose answer the host waits for: the state of goals, pictures, detections, and every call to a
//! driver that owns the clock, whose time stands still meanwhile.

use super::super::link::LinkError;
use super::super::protocol::{
    AdvanceParams, AdvanceResult, Detections, DriverCall, DriverMessage, EmptyParams, LookParams, LookResult,
    MAX_BEFORE_ANSWER, PIECE, QueryParams, QueryResult, RpcError, StatusParams, StatusResult, hear,
};
use super::run_time::{RunTime, Stall};
use super::{LineFrom, RemoteDriver, nonsense};
use motet_runtime::{Answer, Detection, DriverEvent, GoalId, Query, RgbdView, Time};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::time::{Duration, Instant};

/// Difference of times that a driver's rounding may make.
const SLACK: Time = Time::from_nanos(1_000);
/// Time by which a clock that is asked to advance gets on, or its driver reports something.
const LEAST_STEP: Time = Time::from_nanos(1_000_000);
/// Answers in a row with less, after which a driver is of no use.
const MOST_STALLS: u32 = 100;

impl RemoteDriver {
    /// Asks for the state of some goals and waits for the answer.
    ///
    /// # Errors
    ///
    /// It does not say.
    pub fn status(&mut self, goals: Vec<GoalId>) -> Result<StatusResult, LinkError> {
        self.ask(DriverCall::Status(StatusParams { goals }), self.patience.answer)
    }

    /// Asks for the truth of a query in a simulated world, and waits for the answer. It is unknown where the
    /// driver knows no more than its robot.
    pub fn truth(&mut self, query: &Query) -> Answer {
        let call = DriverCall::Truth(QueryParams::from(query));
        match self.ask::<QueryResult>(call, self.patience.silence) {
            Ok(said) => said.answer,
            Err(why) => {
                self.log.note(&format!("no truth: {why}"));
                Answer::Unknown
            }
        }
    }

    /// Asks for a picture; `None`, with a note, where none comes.
    pub(super) fn ask_for_picture(&mut self, camera: Option<&str>) -> Option<RgbdView> {
        let link = self.link.as_ref()?;
        link.await_picture(true);
        let call = DriverCall::Look(LookParams { camera: camera.map(str::to_owned) });
        let taken = self.ask::<LookResult>(call, self.patience.silence);
        // The line of an answer that is late may still come.
        let is_late = matches!(taken, Err(LinkError::Silent(_)));
        if let Some(link) = self.link.as_ref().filter(|_| !is_late) {
            link.await_picture(false);
        }
        let now = self.time.now();
        match taken.map_err(|why| why.to_string()).and_then(|taken| taken.view(now)) {
            Ok(view) => Some(view),
            Err(why) => {
                self.log.note(&format!("no picture: {why}"));
                None
            }
        }
    }

    /// Asks for what is in view; nothing, with a note, where no answer comes.
    pub(super) fn ask_for_detections(&mut self) -> Vec<Detection> {
        match self.ask::<Detections>(DriverCall::Detections(EmptyParams {}), self.patience.silence) {
            Ok(seen) => seen.seen(self.time.now()),
            Err(why) => {
                self.log.note(&format!("no detections: {why}"));
                Vec::new()
            }
        }
    }

    /// Makes a call and waits for its answer; hears meanwhile what else is said.
    fn ask<T: DeserializeOwned>(&mut self, call: DriverCall, within: Duration) -> Result<T, LinkError> {
        let within = if self.time.is_own() { self.patience.step } else { within };
        let asked = self.say(&call)?;
        let due = Instant::now() + within;
        while let Some(left) = due.checked_duration_since(Instant::now()) {
            let link = self.link.as_ref().ok_or(LinkError::Closed)?;
            if self.outbox.len() >= MAX_BEFORE_ANSWER {
                self.broke(&LinkError::Crowded);
                return Err(LinkError::Crowded);
            }
            let line = match link.hear_unless(left, self.patience.is_over) {
                Ok(Some(line)) => line,
                Ok(None) => break,
                Err(breakage) => {
                    self.broke(&breakage);
                    return Err(breakage);
                }
            };
            if let Ok(DriverMessage::Answer(id, answer)) = hear(&line)
                && id == asked
            {
                self.log.line(LineFrom::Driver, &line);
                self.heard_at = Instant::now();
                return read(answer, &line);
            }
            self.hear_line(&line);
        }
        Err(LinkError::Silent(within))
    }

    /// Waits for the answer of a driver that owns the clock.
    pub(super) fn wait_for(&mut self, asked: u64) {
        let due = Instant::now() + self.patience.step;
        while self.waiting.contains_key(&asked) {
            let Some(link) = &self.link else { return };
            let left = due.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return self.broke(&LinkError::Silent(self.patience.step));
            }
            if self.outbox.len() >= MAX_BEFORE_ANSWER {
                return self.broke(&LinkError::Crowded);
            }
            match link.hear_unless(left, self.patience.is_over) {
                Ok(Some(line)) => self.hear_line(&line),
                Ok(None) if (self.patience.is_over)() => return,
                Ok(None) => self.broke(&LinkError::Silent(self.patience.step)),
                Err(breakage) => self.broke(&breakage),
            }
        }
    }

    /// Lets the driver's own time pass until the first report, but not beyond `until`.
    pub(super) fn advance_own(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        loop {
            if let Some((at, event)) = self.outbox.pop_front() {
                return Some((at, event));
            }
            let now = self.time.now();
            if now >= until || (self.patience.is_over)() {
                return None;
            }
            if self.link.is_none() && (self.goals.stopping.is_empty() || !self.reach_to_stop()) {
                // Nobody is there whose time could pass.
                let passes = until != Time::NEVER && self.outbox.is_empty();
                if let (RunTime::Own { now, .. }, true) = (&mut self.time, passes) {
                    *now = until;
                }
                return self.outbox.pop_front();
            }
            if self.outbox.is_empty() {
                let until = until.min(now.after(PIECE)).secs();
                self.call(DriverCall::Advance(AdvanceParams { until }));
            }
        }
    }

    /// Takes the answer to `advance` in: what was reported before it is of its time.
    pub(super) fn advanced(&mut self, asked: AdvanceParams, answer: Result<Value, RpcError>, line: &str) {
        let AdvanceResult { now: told } = match read(answer, line) {
            Ok(told) => told,
            Err(breakage) => return self.broke(&breakage),
        };
        let RunTime::Own { now: before, stall } = self.time else { return };
        let until = Time::from_secs(asked.until);
        let now = Time::from_secs(told);
        let (from, to, slack) = (before.secs(), until.secs(), SLACK.secs());
        if told < from - slack || told > to + slack {
            self.breach(&format!("its time is {told:?} s after it advanced from {from} s to {to} s at most"));
        }
        let is_over = now.after(SLACK) >= until;
        let now = if is_over { until } else { now.max(before) };
        for (at, _) in &mut self.outbox {
            *at = now;
        }
        let is_stalled = !is_over && self.outbox.is_empty() && now < before.after(LEAST_STEP);
        let stall = is_stalled.then(|| {
            let Stall { answers, since } = stall.unwrap_or(Stall { answers: 0, since: Instant::now() });
            Stall { answers: answers + 1, since }
        });
        self.time = RunTime::Own { now, stall };
        let Some(Stall { answers, since }) = stall else { return };
        if answers >= MOST_STALLS || since.elapsed() >= self.patience.step {
            let until = until.secs();
            let why = format!("its clock stands at {told} s, not at {until} s, and it reports nothing");
            self.broke(&nonsense(line, why));
        }
    }
}

/// Result of a call.
fn read<T: DeserializeOwned>(answer: Result<Value, RpcError>, line: &str) -> Result<T, LinkError> {
    let result = answer.map_err(|wrong| LinkError::Refused(wrong.message))?;
    serde_json::from_value(result).map_err(|why| nonsense(line, why.to_string()))
}
