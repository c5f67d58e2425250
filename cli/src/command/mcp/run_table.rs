//! Runs of the robot, the latest ones, as clients see them: as tasks whose ids are the folders of their
//! journals. One run goes on at a time.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use indexmap::IndexMap;
use rmcp::task_manager::current_timestamp;
use serde_json::{Value, json};
use tokio::sync::{oneshot, watch};

use super::answer::Refusal;
use crate::output::{escape, note};

/// The most runs that are kept.
const MAX_RUNS: usize = 64;
/// The most lines of a run that are kept, the latest.
const MAX_LINES: usize = 200;

/// Question of a policy that waits for an answer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct OpenQuestion {
    /// Name of the question, unique within the run.
    pub(super) key: String,
    pub(super) text: String,
    /// Answers to choose from; empty if any text will do.
    pub(super) options: Vec<String>,
}

/// Answer to a question; `None` if it is declined.
pub(super) type GivenAnswer = Option<String>;

/// Sender of the findings of a check, or of the reason why it refuses.
pub(super) type ReplySender = oneshot::Sender<Result<Value, Refusal>>;

/// Policy that shall take over from the one that runs.
#[derive(Debug)]
pub(super) struct SwapOrder {
    pub(super) policy: String,
    pub(super) reply: ReplySender,
}

/// Ending of a run.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct RunEnding {
    /// `done`, `failed`, `declined`, `replan`, `interrupted` or `fault`.
    pub(super) outcome: &'static str,
    pub(super) says: String,
}

/// A run as clients see it.
#[derive(Debug)]
pub(super) struct RunRecord {
    pub(super) id: String,
    pub(super) policy: String,
    pub(super) created: String,
    pub(super) updated: String,
    /// News for a person: the latest firing of a monitor, question or ending.
    pub(super) message: String,
    pub(super) question: Option<OpenQuestion>,
    pub(super) ending: Option<RunEnding>,
    /// True once a client or a person wants it to stop.
    pub(super) is_stopped: bool,
    lines: VecDeque<String>,
    /// Number of lines that are no longer kept.
    forgotten: usize,
    answer: Option<GivenAnswer>,
    questions: usize,
    swap: Option<SwapOrder>,
}

impl RunRecord {
    fn new(id: &str) -> Self {
        let now = current_timestamp();
        Self {
            id: id.to_owned(),
            policy: String::new(),
            created: now.clone(),
            updated: now,
            message: "the policy is checked".to_owned(),
            question: None,
            ending: None,
            is_stopped: false,
            lines: VecDeque::new(),
            forgotten: 0,
            answer: None,
            questions: 0,
            swap: None,
        }
    }

    fn say(&mut self, message: &str) {
        self.message = escape(message);
        self.updated = current_timestamp();
    }

    fn line(&mut self, line: &str) {
        if self.lines.len() == MAX_LINES {
            self.lines.pop_front();
            self.forgotten += 1;
        }
        self.lines.push_back(escape(line));
    }

    /// State of the run for a client.
    pub(super) fn report(&self) -> Value {
        let status = match (&self.ending, &self.question) {
            (Some(ending), _) => ending.outcome,
            (None, Some(_)) => "input_required",
            (None, None) => "working",
        };
        let mut report = json!({
            "run": self.id,
            "policy": self.policy,
            "status": status,
            "message": self.message,
            "events": self.lines,
            "earlier_events": self.forgotten,
            "journal": format!("motet://journal/{}", self.id),
        });
        if let (Some(question), Some(report)) = (&self.question, report.as_object_mut()) {
            let question =
                json!({"question": question.text, "options": question.options, "key": question.key});
            report.insert("question".to_owned(), question);
        }
        if let (Some(ending), Some(report)) = (&self.ending, report.as_object_mut()) {
            report.insert("says".to_owned(), ending.says.clone().into());
        }
        report
    }
}

/// Table of the runs.
pub(crate) struct RunTable {
    state: Mutex<TableState>,
    /// Number of changes, for those who wait for one.
    changed: watch::Sender<u64>,
}

#[derive(Default)]
struct TableState {
    runs: IndexMap<String, RunRecord>,
    current: Option<String>,
    is_closed: bool,
}

impl Default for RunTable {
    fn default() -> Self {
        Self { state: Mutex::default(), changed: watch::channel(0).0 }
    }
}

impl RunTable {
    fn state(&self) -> MutexGuard<'_, TableState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn notify(&self) {
        self.changed.send_modify(|count| *count += 1);
    }

    /// Changes a run that has not ended.
    fn change<T>(&self, id: &str, change: impl FnOnce(&mut RunRecord) -> T) -> Option<T> {
        let changed = self.state().runs.get_mut(id).filter(|run| run.ending.is_none()).map(change);
        self.notify();
        changed
    }

    /// Reserves the robot for a run.
    pub(super) fn reserve(&self, id: &str) -> Result<(), Refusal> {
        let mut state = self.state();
        if state.is_closed {
            return Err(Refusal::new("the server ends"));
        }
        if let Some(current) = &state.current {
            return Err(Refusal::new(format!("the run {current} goes on, and there is one at a time"))
                .with_help("`swap_policy` replaces its policy, `stop` ends it"));
        }
        if state.runs.len() == MAX_RUNS {
            state.runs.shift_remove_index(0);
        }
        state.current = Some(id.to_owned());
        state.runs.insert(id.to_owned(), RunRecord::new(id));
        Ok(())
    }

    /// Gives the robot free again after a policy that was refused: it was never a run.
    pub(super) fn release(&self, id: &str) {
        let mut state = self.state();
        state.runs.shift_remove(id);
        state.current = None;
        drop(state);
        self.notify();
    }

    /// Notes the name of the policy that runs.
    pub(super) fn started(&self, id: &str, policy: &str) {
        self.change(id, |run| {
            run.policy = escape(policy);
            run.say("the policy runs");
        });
    }

    /// Notes what happened, for the list of events.
    pub(super) fn line(&self, id: &str, line: &str) {
        self.change(id, |run| run.line(line));
    }

    /// Notes what happened, and makes it the message of the run.
    pub(super) fn say(&self, id: &str, line: &str) {
        self.change(id, |run| {
            run.line(line);
            run.say(line);
        });
    }

    /// Asks a question.
    pub(super) fn ask(&self, id: &str, text: &str, options: &[String]) {
        self.change(id, |run| {
            run.questions += 1;
            let key = format!("question-{}", run.questions);
            run.answer = None;
            run.say(&format!("the policy asks: {text}"));
            run.line(&format!("asks: {text}"));
            run.question = Some(OpenQuestion { key, text: escape(text), options: options.to_vec() });
        });
    }

    /// Takes the answer to the open question, once it is there.
    pub(super) fn take_answer(&self, id: &str) -> Option<GivenAnswer> {
        self.state().runs.get_mut(id)?.answer.take()
    }

    /// Withdraws the open question.
    pub(super) fn withdraw(&self, id: &str) {
        self.change(id, |run| (run.question, run.answer) = (None, None));
    }

    /// Answers the open question.
    pub(super) fn answer(&self, id: &str, key: Option<&str>, answer: GivenAnswer) -> Result<(), Refusal> {
        let answered = self.change(id, |run| {
            let Some(question) = &run.question else {
                return Err(Refusal::new("no question of the policy is open"));
            };
            if key.is_some_and(|key| key != question.key) {
                return Err(Refusal::new("this question is not open"));
            }
            if let Some(answer) = &answer
                && !question.options.is_empty()
                && !question.options.contains(answer)
            {
                return Err(Refusal::new("the answer is none of the options")
                    .with_help(format!("options: {}", question.options.join(", "))));
            }
            let said = answer.as_deref().unwrap_or("declined");
            run.line(&format!("answered: {said}"));
            run.say("the question is answered");
            (run.question, run.answer) = (None, Some(answer));
            Ok(())
        });
        answered.unwrap_or_else(|| Err(unknown(id)))
    }

    /// True while a question of the run waits for its answer.
    pub(super) fn is_asking(&self, id: &str) -> bool {
        self.state().runs.get(id).is_some_and(|run| run.question.is_some())
    }

    /// True once the run shall stop.
    pub(super) fn is_stopped(&self, id: &str) -> bool {
        let state = self.state();
        state.is_closed || state.runs.get(id).is_some_and(|run| run.is_stopped)
    }

    /// Wants a run to stop; without an id, the one that goes on. Returns its id.
    pub(super) fn stop(&self, id: Option<&str>) -> Result<String, Refusal> {
        let mut state = self.state();
        let current = state.current.clone();
        let wanted = match (id, current) {
            (None, None) => return Err(Refusal::new("no run goes on")),
            (None, Some(current)) => current,
            (Some(id), _) if !state.runs.contains_key(id) => return Err(unknown(id)),
            (Some(id), _) => id.to_owned(),
        };
        if let Some(run) = state.runs.get_mut(&wanted).filter(|run| run.ending.is_none()) {
            run.is_stopped = true;
            run.say("stopping");
        }
        drop(state);
        self.notify();
        Ok(wanted)
    }

    /// Offers a policy to the run that goes on. An earlier offer that was not taken is void.
    pub(super) fn offer(&self, id: Option<&str>, order: SwapOrder) -> Result<(), Refusal> {
        let mut state = self.state();
        let Some(current) = state.current.clone() else {
            return Err(Refusal::new("no run goes on").with_help("`run_policy` begins one"));
        };
        if id.is_some_and(|id| id != current) {
            return Err(Refusal::new("this run does not go on").with_help(format!("{current} does")));
        }
        if let Some(run) = state.runs.get_mut(&current) {
            run.swap = Some(order);
        }
        Ok(())
    }

    /// Takes the policy that was offered to a run.
    pub(super) fn take_offer(&self, id: &str) -> Option<SwapOrder> {
        self.state().runs.get_mut(id)?.swap.take()
    }

    /// Ends a run: from the moment in which clients see its ending, another one may begin.
    pub(super) fn end(&self, id: &str, ending: RunEnding) {
        let mut state = self.state();
        state.current = None;
        if let Some(run) = state.runs.get_mut(id) {
            run.say(&ending.says);
            (run.question, run.answer, run.swap) = (None, None, None);
            run.ending = Some(ending);
        }
        drop(state);
        self.notify();
    }

    /// Lets no further run begin, and wants the one that goes on to stop.
    pub(crate) fn close(&self) {
        let mut state = self.state();
        state.is_closed = true;
        if let Some(current) = &state.current {
            note(&format!("stopping the run {current}"));
        }
        drop(state);
        self.notify();
    }

    /// Id of the run that goes on.
    pub(super) fn current(&self) -> Option<String> {
        self.state().current.clone()
    }

    /// Reads a run; without an id, the one that goes on or else the latest.
    pub(super) fn read<T>(&self, id: Option<&str>, read: impl FnOnce(&RunRecord) -> T) -> Result<T, Refusal> {
        let state = self.state();
        let found = match id {
            Some(id) => state.runs.get(id).ok_or_else(|| unknown(id)),
            None => state.runs.last().map(|(_, run)| run).ok_or_else(|| Refusal::new("nothing has run yet")),
        };
        found.map(read)
    }

    /// Waits until a run has ended or asks a question, at most for a time. Returns its state.
    pub(super) async fn wait(&self, id: &str, patience: Duration) -> Result<Value, Refusal> {
        let mut changes = self.changed.subscribe();
        let until = Instant::now() + patience;
        loop {
            changes.borrow_and_update();
            let (report, is_waiting) = self.read(Some(id), |run| {
                (run.report(), run.ending.is_none() && (run.question.is_none() || run.is_stopped))
            })?;
            let left = until.saturating_duration_since(Instant::now());
            if !is_waiting || left.is_zero() {
                return Ok(report);
            }
            // What happens meanwhile ends the wait, and so does the time.
            let _ = tokio::time::timeout(left, changes.changed()).await;
        }
    }
}

fn unknown(id: &str) -> Refusal {
    Refusal::unknown("run", id, "`run_status` without an id shows the latest one")
}
