//! Messages of the driver, and overdue answers.

use super::super::link::LinkError;
use super::super::protocol::{
    DriverCall, DriverMessage, DriverReport, EmptyParams, FeedbackParams, GoalParams,
    MAX_DETECTIONS_A_SECOND, MAX_FACT_BYTES, MAX_FACTS_A_SECOND, MAX_FEEDBACK, MAX_FEEDBACK_A_SECOND,
    MAX_KIND_BYTES, MAX_LINES_A_SECOND, MAX_MOVED_NAMES, MAX_REPORT_BYTES_A_SECOND, MAX_WAITING, QueryParams,
    QueryResult, REFUSED, RefusedData, RpcError, SAYINGS, hear, heard,
};
use super::{LineFrom, RemoteDriver, Waiting, failed, nonsense};
use motet_runtime::{Answer, DriverEvent, FailureReport, GoalId, OWN_MOTION, Outcome};
use serde_json::Value;
use smol_str::SmolStr;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

/// The most reports that wait to be handed on before feedback is dropped.
const MOST_WORDS: usize = 256;
/// The most lines that are heard before what they say is handed on.
const BATCH: usize = 64;

/// Goal of which a driver tells something, in words; its number may be any.
fn told_goal(goal: GoalId) -> String {
    let kind = if GoalId::FIRST <= goal { "goal" } else { "an unknown goal" };
    format!("{kind} {goal}")
}

impl RemoteDriver {
    /// Hears what is said, for so long at most until something is.
    pub(super) fn listen(&mut self, within: Duration) {
        let mut within = within;
        for _ in 0..BATCH {
            // What is not handed on fast enough waits in the pipe, and then in the driver.
            if self.outbox.len() >= MAX_WAITING {
                return;
            }
            let Some(link) = &self.link else { return };
            match link.hear(within) {
                Ok(Some(line)) => self.hear_line(&line),
                Ok(None) => return,
                Err(breakage) => self.broke(&breakage),
            }
            within = Duration::ZERO;
        }
    }

    pub(super) fn hear_line(&mut self, line: &str) {
        self.log.line(LineFrom::Driver, line);
        (self.heard_at, self.is_asked) = (Instant::now(), false);
        if self.rate.exceeds(MAX_LINES_A_SECOND, self.heard_at) {
            return self.broke(&LinkError::Hasty(MAX_LINES_A_SECOND, "lines"));
        }
        match hear(line) {
            Ok(DriverMessage::Answer(id, answer)) => {
                // An answer to what is no longer waited for says nothing new.
                if let Some(waiting) = self.waiting.remove(&id) {
                    self.answered(waiting.call, answer, line);
                } else if id >= self.next_id.load(Ordering::SeqCst) {
                    self.broke(&nonsense(line, "nothing with this number was asked".to_owned()));
                }
            }
            Ok(DriverMessage::Report(_))
                if self.bytes.exceeds_by(line.len(), MAX_REPORT_BYTES_A_SECOND, self.heard_at) =>
            {
                self.broke(&LinkError::Hasty(MAX_REPORT_BYTES_A_SECOND, "bytes of reports"));
            }
            Ok(DriverMessage::Report(report)) => self.told(report, line.len()),
            Err(why) => self.broke(&nonsense(line, why)),
        }
    }

    /// Takes in a report, which was said in so many bytes.
    fn told(&mut self, report: DriverReport, bytes: usize) {
        match report {
            DriverReport::Ended(ended) => {
                let (goal, outcome) = (ended.goal, self.named(ended.outcome));
                let Some(primitive) = self.goals.ended(goal) else {
                    return self.idle(goal, "has ended");
                };
                if let Outcome::Failure(failure) = &outcome
                    && let Some(told) = self.goals.undeclared(&primitive, failure)
                {
                    self.breach(&told);
                }
                self.report(DriverEvent::Ended { goal, outcome });
            }
            DriverReport::NotHeld(GoalParams { goal }) => {
                if self.runs(goal, "is not held") {
                    self.report(DriverEvent::NotHeld { goal });
                }
            }
            DriverReport::Stopped(GoalParams { goal }) => {
                if self.goals.stopped(goal) {
                    self.report(DriverEvent::Stopped { goal });
                } else {
                    let told = told_goal(goal);
                    self.breach(&format!("{told} is stopped, it says, but nobody asked for it"));
                    if self.goals.is_live(goal) {
                        // It is asked for now, and the step fails.
                        self.report(DriverEvent::Lost { goal });
                    }
                }
            }
            DriverReport::Lost(GoalParams { goal }) => {
                if self.runs(goal, "is lost") {
                    self.report(DriverEvent::Lost { goal });
                }
            }
            DriverReport::Observed(observed) => {
                let (query, answer) = (observed.query, observed.answer);
                if !self.watches.contains(&query) {
                    if bytes > MAX_FACT_BYTES {
                        return self.broke(&LinkError::LongFact);
                    }
                    if self.facts.exceeds(MAX_FACTS_A_SECOND, self.heard_at) {
                        let what = "`observed` that are not watched";
                        return self.broke(&LinkError::Hasty(MAX_FACTS_A_SECOND, what));
                    }
                }
                self.report(DriverEvent::Observed { query, answer });
            }
            DriverReport::Feedback(feedback) if self.outbox.len() >= MOST_WORDS => {
                let goal = feedback.goal;
                self.breach(&format!("feedback of goal {goal} is dropped: there is too much of it"));
            }
            DriverReport::Feedback(feedback) if !self.runs(feedback.goal, "has feedback") => {}
            DriverReport::Feedback(feedback)
                if self.feedback.exceeds(MAX_FEEDBACK_A_SECOND, self.heard_at) =>
            {
                let told = told_goal(feedback.goal);
                self.breach(&format!(
                    "feedback of {told} is dropped: there were more than {MAX_FEEDBACK_A_SECOND} in a second"
                ));
            }
            DriverReport::Feedback(feedback) => {
                let text: SmolStr = feedback.text.chars().take(MAX_FEEDBACK).collect();
                let FeedbackParams { goal, own_motion, .. } = feedback;
                let own = if own_motion { OWN_MOTION } else { "" };
                self.log.note(&format!("goal {goal}: {own}{text}"));
                self.report(DriverEvent::Feedback { goal, text, own_motion });
            }
            DriverReport::Moved(moved) => {
                let Some(mut moved) = moved.moved(self.time.now(), self.time.is_own()) else { return };
                if self.telemetry.cut(&mut moved) {
                    self.breach(&format!("telemetry of more than {MAX_MOVED_NAMES} joints and things"));
                }
                self.telemetry.push_moved(moved);
            }
            DriverReport::Detected(seen)
                if self.detections.exceeds_by(
                    seen.detections.len(),
                    MAX_DETECTIONS_A_SECOND,
                    self.heard_at,
                ) =>
            {
                self.broke(&LinkError::Hasty(MAX_DETECTIONS_A_SECOND, "things `detected`"));
            }
            DriverReport::Detected(seen) => {
                let seen = seen.seen(self.time.now());
                self.telemetry.push_detected(seen);
            }
            DriverReport::Heard(words) => {
                heard(&words).into_iter().for_each(|words| self.telemetry.push_heard(words));
            }
        }
    }

    /// True if a goal runs; else what is said of it is a broken promise.
    fn runs(&mut self, goal: GoalId, says: &str) -> bool {
        let is_live = self.goals.is_live(goal);
        if !is_live {
            self.idle(goal, says);
        }
        is_live
    }

    /// Tells a report about a goal that does not run.
    fn idle(&mut self, goal: GoalId, says: &str) {
        self.breach(&format!("{} {says}, it says, but it does not run", told_goal(goal)));
    }

    /// The failure kind that a driver names: a name of at most [`MAX_KIND_BYTES`]. Anything else is `failed`,
    /// and is told to people.
    pub(super) fn kind(&mut self, named: &str) -> SmolStr {
        let mut letters = named.chars();
        let is_name = letters.next().is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
            && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
        if is_name && named.len() <= MAX_KIND_BYTES {
            return named.into();
        }
        let beginning: String = named.chars().take(MAX_KIND_BYTES).collect();
        self.log.note(&format!("the driver's kind of a failure is no name, so it is `failed`: {beginning}"));
        failed()
    }

    /// A failure whose kind is a name, and whose text is not too long.
    pub(super) fn failure(&mut self, told: &FailureReport) -> FailureReport {
        let cut = |text: &SmolStr| text.chars().take(MAX_FEEDBACK).collect::<SmolStr>();
        let text = told.text.as_ref().map(cut).filter(|text| !text.trim().is_empty());
        FailureReport { kind: self.kind(&told.kind), text }
    }

    /// An outcome whose failure has a name.
    pub(super) fn named(&mut self, outcome: Outcome) -> Outcome {
        match outcome {
            Outcome::Failure(failure) => Outcome::Failure(self.failure(&failure)),
            Outcome::Success(_) | Outcome::Interrupted => outcome,
        }
    }

    fn answered(&mut self, call: DriverCall, answer: Result<Value, RpcError>, line: &str) {
        match (call, answer) {
            (DriverCall::Start(start), Ok(_)) => {
                self.report(DriverEvent::Acknowledged { goal: start.goal });
            }
            (DriverCall::Start(start), Err(wrong)) => {
                let data: Option<RefusedData> = serde_json::from_value(wrong.data.clone()).ok();
                if wrong.code != REFUSED {
                    self.log.note(&format!("the driver does not start a goal: {}", wrong.message));
                }
                let failure = data.map(|data| self.failure(&data.failure));
                let failure = failure.unwrap_or_else(|| failed().into());
                self.goals.ended(start.goal);
                self.report(DriverEvent::Refused { goal: start.goal, failure });
            }
            (DriverCall::Observe(asked) | DriverCall::Watch(asked), Ok(value)) => {
                match serde_json::from_value::<QueryResult>(value) {
                    Ok(answered) => self.observed(asked, answered.answer),
                    Err(why) => self.broke(&nonsense(line, why.to_string())),
                }
            }
            (DriverCall::Observe(asked) | DriverCall::Watch(asked), Err(_)) => {
                self.observed(asked, Answer::Unknown)
            }
            (DriverCall::Hold(GoalParams { goal }), Err(_)) => {
                self.report(DriverEvent::NotHeld { goal });
            }
            (DriverCall::Update(start), Err(wrong)) => {
                self.log.note(&format!("the driver does not update a goal: {}", wrong.message));
                self.report(DriverEvent::Lost { goal: start.goal });
            }
            (DriverCall::Advance(asked), answer) => self.advanced(asked, answer, line),
            (_, Ok(_)) => {}
            (_, Err(wrong)) => self.log.note(&format!("the driver says: {}", wrong.message)),
        }
    }

    pub(super) fn observed(&mut self, asked: QueryParams, answer: Answer) {
        self.report(DriverEvent::Observed { query: asked.query, answer });
    }

    /// Looks after answers that are overdue, and signs of life.
    pub(super) fn tend(&mut self) {
        if self.link.is_none() {
            // What may still move is to be stopped, and what is watched to be seen, whoever has to be called.
            let is_needed = !self.watches.is_empty() || !self.goals.stopping.is_empty();
            if is_needed && self.call_at <= Instant::now() {
                self.reach_to_stop();
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
        // A driver that hears nothing stops by itself, so it is spoken to also where it says much.
        let quiet = silent.max(self.said_at.elapsed());
        // One that has nothing to do but to answer is not busy.
        let is_free = self.goals.is_idle() && !self.is_asked;
        let patience =
            if is_free { self.patience.heartbeat + self.patience.answer } else { self.patience.silence };
        if silent >= patience.min(self.patience.silence) {
            self.broke(&LinkError::Silent(silent));
        } else if quiet >= self.patience.heartbeat
            && !self.waiting.values().any(|waiting| matches!(waiting.call, DriverCall::Ping(_)))
        {
            self.call(DriverCall::Ping(EmptyParams {}));
        }
    }

    /// An answer did not come in time. That says nothing of what was done.
    fn overdue(&mut self, call: DriverCall, sayings: u32) {
        match call {
            DriverCall::Start(start) if sayings < SAYINGS => {
                self.call_again(DriverCall::Start(start), sayings + 1)
            }
            DriverCall::Start(start) | DriverCall::Update(start) => {
                let goal = start.goal;
                self.log.note(&format!("the driver does not say whether goal {goal} runs"));
                self.report(DriverEvent::Lost { goal });
            }
            DriverCall::Observe(asked) | DriverCall::Watch(asked) => self.observed(asked, Answer::Unknown),
            // The engine waits for what follows from these, and not for ever.
            DriverCall::Cancel(_)
            | DriverCall::Hold(_)
            | DriverCall::Proceed(_)
            | DriverCall::SafeStop(_)
            | DriverCall::Unwatch(_)
            | DriverCall::Told(_) => {}
            DriverCall::Status(_) | DriverCall::Ping(_) | DriverCall::Hello(_) | DriverCall::Bye(_) => {}
            // These are waited for elsewhere.
            DriverCall::Advance(_)
            | DriverCall::Look(_)
            | DriverCall::Detections(_)
            | DriverCall::Truth(_) => {}
        }
    }
}
