//! Observer of a conversation: shows and paces its runs, brings typed requests, and writes the record.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use motet_graph::Graph;
use motet_planner::builtin::PlannedRequest;
use motet_planner::dialogue::{DialogueObserver, Outcome, Problem, RunRecorder};
use motet_planner::runtime_check::CheckMode;
use motet_planner::vision::{GroundedPoint, GroundingDriver, GroundingTask};
use motet_project::SavedDriver;
use motet_robots::scene::Scene;
use motet_runtime::{
    Driver, Effect, Engine, Event, Fault, Observer as _, Perception, RunControl, RunEnd, StartState,
    SwapRefusal, Time,
};
use serde_json::json;

use super::flags::{ConversationArgs, ModelArgs};
use super::operator::OperatorInput;
use super::planner::client;
use super::record::{ConversationRecord, RunJournal};
use super::words::{TypedLines, note_held};
use crate::error::CliError;
use crate::flags::{OutputFormat, Speed};
use crate::interrupt::{SLICE, is_interrupted, note_event};
use crate::output::{Colors, Output, escape, note, printable};
use crate::run_view::{Clock, view};
use crate::runner::PacedView;
use crate::view::live::SharedPage;
use motet::page::source::PolicyText;

/// The longest time for which a run waits for the policy of an instruction, if nobody could let it go on.
const PLANNING: Duration = Duration::from_secs(60);

/// Observer of a conversation.
pub(super) struct RunObserver<'a> {
    args: &'a ConversationArgs,
    colors: Colors,
    /// Clock of the driver, and speed of the runs.
    pace: (Clock, Speed),
    lines: TypedLines,
    record: Option<ConversationRecord>,
    /// Page that shows the conversation.
    pub(super) page: Option<SharedPage>,
    /// Driver as it is at the beginning, for journals; `None` where runs cannot be resumed.
    pub(super) driver: Option<SavedDriver>,
    request: String,
    task: Rc<RefCell<GroundingTask>>,
    view: Option<PacedView>,
    /// Revision of the shown policy within its run.
    revision: u32,
    /// Policy that takes over; shown once the engine reports its first trace event.
    next: Option<(String, Arc<Graph>)>,
    /// View of the policy before.
    older: Option<PacedView>,
    is_swapping: bool,
    /// While a person holds the run, the time until which it waits if nobody is there any more.
    held_until: Option<Instant>,
    /// The time for which it does after the last words: none after `wait`, which asks for no policy.
    patience: Duration,
    /// True once nobody could answer a question in the middle of a run.
    pub(super) is_unanswered: bool,
    /// True if the driver did not confirm the stop of the latest run.
    pub(super) is_unstopped: bool,
    /// Output of answers.
    out: Output,
}

impl<'a> RunObserver<'a> {
    pub(super) fn new(
        args: &'a ConversationArgs,
        colors: Colors,
        pace: (Clock, Speed),
        operator: Rc<OperatorInput>,
        record: Option<ConversationRecord>,
    ) -> Self {
        Self {
            args,
            colors,
            pace,
            lines: TypedLines::new(&args.words, operator),
            record,
            page: None,
            driver: None,
            request: String::new(),
            task: Rc::default(),
            view: None,
            revision: 0,
            next: None,
            older: None,
            is_swapping: false,
            held_until: None,
            patience: PLANNING,
            is_unanswered: false,
            is_unstopped: false,
            out: Output::default(),
        }
    }

    /// Adds the task that is told with questions about points.
    pub(super) fn with_task(self, task: Rc<RefCell<GroundingTask>>) -> Self {
        Self { task, ..self }
    }

    fn write(&mut self, what: &str, more: serde_json::Value) {
        if let Some(record) = &self.record {
            record.write(what, more);
        }
    }

    /// Adds an item to the page.
    fn tell_page(&self, item: &serde_json::Value) {
        self.page.iter().for_each(|page| page.borrow_mut().item(item));
    }

    /// Shows a policy from now on.
    fn show(&mut self, text: &str, graph: &Graph) {
        if self.args.format == OutputFormat::Human {
            note(&printable(text.trim_end()));
        }
        let (clock, speed) = self.pace;
        let view = view(self.args.format, graph, self.colors, clock);
        self.older = self.view.replace(PacedView::new(view, speed));
    }

    /// Notes a request.
    pub(super) fn requested(&mut self, request: &str) {
        self.write("request", json!({"text": request}));
        self.tell_page(&json!({"t": "say", "who": "person", "text": escape(request)}));
        request.clone_into(&mut self.request);
        request.clone_into(&mut self.task.borrow_mut().instruction);
    }

    /// Notes the outcome of a request.
    pub(super) fn outcome(&mut self, outcome: &Outcome) {
        let word = match outcome {
            Outcome::Done => "done",
            Outcome::Declined(_) => "declined",
            Outcome::GivenUp => "given_up",
            Outcome::Stopped => "stopped",
            Outcome::Failed(_) => "failed",
        };
        self.write("outcome", json!({"outcome": word}));
        self.tell_page(&json!({"t": "outcome", "is": word}));
    }

    /// Ends the record.
    pub(super) fn finish(self) -> Result<(), CliError> {
        self.record.map_or(Ok(()), ConversationRecord::finish)
    }

    /// Says something to the person.
    pub(super) fn say(&mut self, question: &str, answer: &str) {
        match self.args.format {
            OutputFormat::Human => self.out.line(&printable(answer)),
            OutputFormat::Json => {
                let line = json!({"event": "answered", "question": question, "answer": answer});
                self.out.json_line(&line.to_string());
            }
        }
        self.tell_page(&json!({"t": "say", "who": "robot", "text": escape(answer)}));
        self.go_below();
    }

    /// Lets the view go on below what was printed.
    fn go_below(&mut self) {
        self.view.iter_mut().for_each(PacedView::go_below);
    }
}

impl DialogueObserver for RunObserver<'_> {
    fn scribe(&mut self, run: &str, engine: &Engine, start: &StartState) -> Option<Box<dyn RunRecorder>> {
        if self.record.is_none() && self.page.is_none() {
            return None;
        }
        let outputs = (self.record.clone(), self.page.clone());
        let named = (run, self.request.as_str());
        Some(Box::new(RunJournal::new(outputs, named, self.driver.clone(), (engine, start))))
    }

    fn held(&mut self, is_held: bool) {
        self.held_until = is_held.then(|| Instant::now() + self.patience);
        note_held(is_held);
        self.go_below();
        self.write(if is_held { "held" } else { "proceeded" }, json!({}));
    }

    fn answered(&mut self, question: &str, answer: Option<&str>) {
        self.write("answered", json!({"question": question, "answer": answer}));
        match answer {
            Some(answer) => self.say(question, answer),
            // In the middle of a run nothing else tells that nobody knows.
            None if self.view.is_some() => {
                self.is_unanswered = true;
                self.say(question, "I do not know.");
            }
            None => {}
        }
    }

    fn planned(&mut self, answered: &PlannedRequest, graph: &Arc<Graph>) {
        if let Some(record) = &self.record {
            record.policy(&answered.planned.text);
        }
        answered.understood.notes.iter().for_each(|text| note(text));
        self.task.borrow_mut().graph = Some(Arc::clone(graph));
        if let Some(page) = &self.page {
            page.borrow_mut().text(PolicyText::read("policy", &answered.planned.text));
        }
        let text = answered.planned.text.clone();
        if std::mem::take(&mut self.is_swapping) {
            self.next = Some((text, Arc::clone(graph)));
        } else {
            (self.revision, self.view, self.older) = (0, None, None);
            self.show(&text, graph);
        }
    }

    fn event(&mut self, _now: Time, event: &Event) {
        note_event(event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        if let Effect::Report(event) = effect {
            if event.revision < self.revision {
                return self.older.iter_mut().for_each(|older| older.late(now, effect));
            }
            let is_newer = event.revision > self.revision;
            self.revision = event.revision;
            if let Some((text, graph)) = self.next.take_if(|_| is_newer) {
                self.view.iter_mut().for_each(|view| view.leave(now));
                self.show(&text, &graph);
            }
        }
        if let Some(view) = &mut self.view {
            view.effect(now, effect);
        }
    }

    fn reached(&mut self, now: Time) -> RunControl {
        let control = self.view.as_mut().map_or(RunControl::Continue, |view| view.reached(now));
        let is_paced = control == RunControl::Continue && !self.lines.are_scheduled();
        if let Some(until) = self.held_until.filter(|_| is_paced) {
            if self.lines.are_over() && Instant::now() >= until {
                note("  stopped: nobody is there to let it go on");
                return RunControl::Stop;
            }
            if self.pace.1 == Speed::Max {
                std::thread::sleep(SLICE);
            }
        }
        control
    }

    fn at_least_every(&self) -> Time {
        let own = self.lines.at_least_every();
        self.view.as_ref().map_or(own, |view| view.at_least_every().min(own))
    }

    fn verifies(&self) -> CheckMode {
        self.pace.1.verifies()
    }

    fn is_stopped(&self) -> bool {
        is_interrupted() || self.page.as_ref().is_some_and(|page| page.borrow().hub().is_stopped())
    }

    fn request(&mut self, now: Time) -> Option<String> {
        // A line that is typed below a view goes with the next drawing.
        let line = self.lines.due(now)?;
        self.go_below();
        self.requested(&line);
        self.patience = if motet_requests::holds(&line) { Duration::ZERO } else { PLANNING };
        Some(line)
    }

    fn swapped(&mut self, _now: Time, refusal: Option<&SwapRefusal>) {
        match refusal {
            None => {
                self.is_swapping = true;
                self.write("swap", json!({}));
            }
            Some(refusal) => {
                let why = refusal.to_string();
                self.tell_page(&json!({"t": "say", "who": "host", "text": escape(&why)}));
                self.write("swap_refused", json!({"why": why}));
            }
        }
    }

    fn ended(&mut self, _now: Time, end: &RunEnd) {
        self.held_until = None;
        self.is_unstopped = matches!(end, RunEnd::Fault(Fault::NotStopped { .. }));
        if let Some(mut view) = self.view.take() {
            view.finish(end);
        }
        self.write("ended", json!({"how": end.to_string()}));
    }

    fn asked(&mut self, problem: &Problem, answer: Option<&str>) {
        let (kind, question) = (problem.kind.name(), problem.question.clone());
        self.write("question", json!({"kind": kind, "question": question, "answer": answer}));
    }
}

/// Log of the points that a model gives.
pub(super) struct PointLog {
    pub(super) is_shown: bool,
    pub(super) record: Option<ConversationRecord>,
}

/// Driver whose `ground` asks the model of the flags.
pub(super) fn pointing<'d>(
    model: &ModelArgs,
    driver: &'d mut dyn Driver,
    eyes: &'d mut dyn Perception,
    scene: &'d Scene,
    (log, task): (PointLog, Rc<RefCell<GroundingTask>>),
) -> Result<GroundingDriver<'d>, CliError> {
    let client = client(model)?;
    Ok(GroundingDriver::new(driver, eyes, scene, Box::new(client))
        .with_task(task)
        .with_listener(move |pointed| log.add(pointed)))
}

impl PointLog {
    fn add(&self, GroundedPoint { object, used_for, found }: GroundedPoint<'_>) {
        let used_for = printable(used_for);
        let (words, more) = match found {
            Ok(pose) => {
                let [x, y, z] = pose.xyz;
                (format!("at ({x:.2}, {y:.2}, {z:.2}) m"), json!({"xyz": pose.xyz}))
            }
            Err(why) => (format!("no point: {why}"), json!({"why": why.to_string()})),
        };
        if self.is_shown {
            note(&printable(&format!("  {used_for} of {object}: {words}")));
        }
        if let Some(record) = &self.record {
            let mut line = json!({"object": object.as_str(), "use": used_for});
            if let (Some(line), Some(more)) = (line.as_object_mut(), more.as_object()) {
                line.extend(more.clone());
            }
            record.write("pointed", line);
        }
    }
}
