//! Operator of a conversation: a person at the terminal, a script, or nobody. Answers questions of the
//! dialogue manager and of `ask` steps.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::io::{self, BufRead, IsTerminal, Write as _};
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::thread;
use std::time::Duration;

use motet_graph::{Graph, Value};
use motet_planner::dialogue::{Kind, Person, Problem};
use motet_project::files::read_small;
use motet_requests::RequestContext;
use motet_robots::scene::Scene;
use motet_runtime::{Capabilities, Command, Driver, DriverEvent, GoalId, Outcome, Query, Time};
use motet_stdlib::lang::{failures, primitives};
use smol_str::SmolStr;

use super::planner::printable;
use crate::error::CliError;
use crate::interrupt::is_interrupted;
use crate::output::{escape, note};
use crate::typed_line::{self, LetterReader};
use crate::view::hub::Hub;
use crate::view::live::SharedPage;

/// Interval at which a waiting question checks for an interrupt.
const SLICE: Duration = Duration::from_millis(50);

/// Source of answers.
pub(crate) enum OperatorInput {
    /// A person; a thread reads their lines from stdin.
    Terminal {
        lines: RefCell<Receiver<String>>,
        /// True if lines count when they come, also while the robot moves.
        is_live: bool,
        /// True once no more lines can come.
        is_over: Cell<bool>,
        /// Reader of letters, at a terminal.
        letters: Option<LetterReader>,
        /// True if lines come from stdin too, not from a page alone.
        reads_stdin: bool,
        /// Page whose operator may type lines.
        hub: Option<Arc<Hub>>,
    },
    /// Lines of a file, in order.
    Script(RefCell<VecDeque<String>>),
    Never,
}

impl OperatorInput {
    /// Reads the flag `--ask`.
    pub(crate) fn read(words: &[String], is_live: bool, page: Option<&SharedPage>) -> Result<Self, CliError> {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        match words.as_slice() {
            [] | ["terminal"] => Ok(Self::terminal(is_live, page)),
            ["never"] => Ok(Self::Never),
            ["script", file] => {
                let text = String::from_utf8_lossy(&read_small(Path::new(file))?).into_owned();
                let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
                Ok(Self::Script(RefCell::new(lines.map(ToOwned::to_owned).collect())))
            }
            ["script"] => {
                Err(CliError::Message("`--ask script` needs a file with one answer per line".to_owned()))
            }
            _ => Err(CliError::Message(format!(
                "`--ask {}`: write `terminal`, `never`, or `script FILE`",
                words.join(" ")
            ))),
        }
    }

    /// Person at a page alone.
    pub(crate) fn of_page(page: &SharedPage) -> Self {
        let (sender, lines) = mpsc::channel();
        let hub = page.borrow().hub();
        hub.take_lines(sender);
        Self::Terminal {
            lines: RefCell::new(lines),
            is_live: true,
            is_over: Cell::new(false),
            letters: None,
            reads_stdin: false,
            hub: Some(hub),
        }
    }

    fn terminal(is_live: bool, page: Option<&SharedPage>) -> Self {
        let (sender, lines) = mpsc::channel();
        let hub = page.map(|page| page.borrow().hub());
        hub.iter().for_each(|hub| hub.take_lines(sender.clone()));
        let letters = typed_line::read(&sender);
        if letters.is_none() {
            thread::spawn(move || {
                for line in io::stdin().lock().lines() {
                    let Ok(line) = line else { return };
                    if sender.send(line).is_err() {
                        return;
                    }
                }
            });
        }
        let is_live = is_live || hub.is_some() || io::stdin().is_terminal();
        Self::Terminal {
            lines: RefCell::new(lines),
            is_live,
            is_over: Cell::new(false),
            letters,
            reads_stdin: true,
            hub,
        }
    }

    /// Line that was typed while the robot moves.
    pub(crate) fn typed(&self) -> Option<String> {
        let Self::Terminal { lines, is_live: true, is_over, .. } = self else { return None };
        match lines.borrow().try_recv() {
            Ok(line) => Some(line).filter(|line| !line.trim().is_empty()),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                is_over.set(true);
                None
            }
        }
    }

    /// True if nobody can say anything more while the robot moves.
    pub(crate) fn is_over(&self) -> bool {
        match self {
            Self::Terminal { is_live, is_over, .. } => !is_live || is_over.get(),
            Self::Script(_) | Self::Never => true,
        }
    }

    /// Next line, which is waited for; `rest` is called meanwhile. `None` at the end, and after Ctrl-C.
    pub(crate) fn line(&self, rest: &mut dyn FnMut() -> Option<String>) -> Option<String> {
        match self {
            Self::Never => None,
            Self::Script(lines) => lines.borrow_mut().pop_front(),
            Self::Terminal { lines, hub, .. } => loop {
                match lines.borrow().recv_timeout(SLICE) {
                    Ok(line) if line.trim().is_empty() => {}
                    Ok(line) => return Some(line),
                    Err(RecvTimeoutError::Disconnected) => return None,
                    Err(RecvTimeoutError::Timeout) if is_interrupted() => return None,
                    Err(RecvTimeoutError::Timeout) if hub.as_ref().is_some_and(|hub| hub.is_stopped()) => {
                        return None;
                    }
                    Err(RecvTimeoutError::Timeout) => {
                        if let Some(line) = rest() {
                            return Some(line);
                        }
                    }
                }
            },
        }
    }

    /// Shows a person at a terminal that it is their turn.
    pub(crate) fn prompt(&self) {
        match self {
            Self::Terminal { letters: Some(_), .. } => typed_line::show(),
            Self::Terminal { .. } if self.is_echoed() => {
                // An error of stderr cannot be reported.
                let _ = write!(io::stderr().lock(), "> ");
            }
            Self::Terminal { .. } | Self::Script(_) | Self::Never => {}
        }
    }

    /// True if a person sees what they type.
    pub(crate) fn is_echoed(&self) -> bool {
        matches!(self, Self::Terminal { reads_stdin: true, .. }) && io::stdin().is_terminal()
    }
}

/// Question with its options.
fn question(problem: &Problem) -> String {
    let mut text = format!("? {}", printable(&problem.question));
    // An ambiguous reference names its options in the question already, in everyday words.
    if !problem.options.is_empty() && problem.kind != Kind::AmbiguousReference {
        let options: Vec<&str> = problem.options.iter().map(|option| option.as_str()).collect();
        text.push_str(&format!("\n  ({})", options.join(", ")));
    }
    text
}

/// Prompt that shows questions to the operator.
#[derive(Clone)]
pub(crate) struct OperatorPrompt {
    pub(crate) input: Rc<OperatorInput>,
    /// Page that shows them too.
    pub(crate) page: Option<SharedPage>,
}

impl OperatorPrompt {
    /// Asks a question that the page knows by an id.
    fn ask_as(&self, id: Option<&str>, problem: &Problem) -> Option<String> {
        note(&question(problem));
        let hub = self.page.as_ref().map(|page| page.borrow().hub());
        hub.iter().for_each(|hub| hub.ask(id));
        self.input.prompt();
        let answer = self.input.line(&mut || None);
        hub.iter().for_each(|hub| hub.ask(None));
        if let Some(answer) = answer.as_deref().filter(|_| !self.input.is_echoed()) {
            note(&format!("> {}", escape(answer)));
        }
        answer
    }
}

impl Person for OperatorPrompt {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        let id = self
            .page
            .as_ref()
            .map(|page| page.borrow_mut().question(&printable(&problem.question), &problem.options));
        let answer = self.ask_as(id.as_deref(), problem);
        if let (Some(page), Some(id)) = (&self.page, &id) {
            page.borrow_mut().answered(id, answer.as_deref());
        }
        answer
    }
}

/// Driver that answers `ask` and `choose` by the operator, and leaves everything else to the robot's driver.
pub(crate) struct AskingDriver<'a> {
    driver: &'a mut dyn Driver,
    operator: OperatorPrompt,
    /// Things that a choice may name.
    scene: &'a Scene,
    /// Events of questions, which are answered at once.
    outbox: VecDeque<(Time, DriverEvent)>,
}

impl<'a> AskingDriver<'a> {
    pub(crate) fn new(driver: &'a mut dyn Driver, operator: OperatorPrompt, scene: &'a Scene) -> Self {
        Self { driver, operator, scene, outbox: VecDeque::new() }
    }

    /// Id of the question of a goal on the page.
    fn id(&self, goal: GoalId) -> Option<String> {
        self.operator.page.as_ref().map(|page| format!("{}:{goal}", page.borrow().run()))
    }

    /// Asks for one of several things. Fails with `refused` if the answer names none of them, and with
    /// `ambiguous` if it names several.
    fn choose(&mut self, goal: GoalId, problem: &Problem) -> Outcome {
        let answer = self.operator.ask_as(self.id(goal).as_deref(), problem);
        let situation = RequestContext::new(self.scene);
        let chosen = answer.map(|answer| motet_requests::choose(&answer, &problem.options, &situation));
        let mut chosen = chosen.unwrap_or_default();
        chosen.retain(|thing| problem.options.contains(thing));
        match chosen.as_slice() {
            [] => Outcome::Failure(failures::REFUSED.into()),
            [only] => Outcome::Success(Some(Value::Entity(only.clone()))),
            [_, _, ..] => Outcome::Failure(failures::AMBIGUOUS.into()),
        }
    }

    fn ask(&mut self, goal: GoalId, problem: &Problem) -> Outcome {
        match self.operator.ask_as(self.id(goal).as_deref(), problem) {
            Some(answer) => Outcome::Success(Some(Value::Text(answer.into()))),
            None => Outcome::Failure(failures::REFUSED.into()),
        }
    }
}

/// Things among which a command lets a person choose; none for other commands.
fn options(command: &Command) -> Option<Vec<SmolStr>> {
    let Some(Value::List(among)) = command.arg("among").filter(|_| command.primitive == primitives::CHOOSE)
    else {
        return None;
    };
    let id = |value: &Value| if let Value::Entity(id) = value { Some(id.clone()) } else { None };
    among.iter().map(id).collect()
}

impl Driver for AskingDriver<'_> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        let Some(Value::Text(question)) = command.arg("question") else {
            return self.driver.start(now, goal, command);
        };
        let mut problem = Problem {
            kind: Kind::AmbiguousTask,
            question: printable(question),
            options: Vec::new(),
            about: None,
            said: None,
        };
        let outcome = if let Some(options) = options(command) {
            problem.options = options;
            self.choose(goal, &problem)
        } else if command.primitive == primitives::ASK {
            self.ask(goal, &problem)
        } else {
            return self.driver.start(now, goal, command);
        };
        self.outbox.push_back((now, DriverEvent::Acknowledged { goal }));
        self.outbox.push_back((now, DriverEvent::Ended { goal, outcome }));
    }

    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        // Goals of the run before have the same numbers.
        self.outbox.clear();
        self.driver.begin_run(now, run, graph)
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.driver.cancel(now, goal);
    }

    fn capabilities(&self) -> Capabilities {
        self.driver.capabilities()
    }

    fn base(&self) -> Option<[f64; 3]> {
        self.driver.base()
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        self.driver.update(now, goal, command);
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        self.driver.hold(now, goal);
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        self.driver.proceed(now, goal);
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.driver.safe_stop(now, goal);
    }

    fn observe(&mut self, now: Time, query: &Query) {
        self.driver.observe(now, query);
    }

    fn watch(&mut self, now: Time, query: &Query) {
        self.driver.watch(now, query);
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        self.driver.unwatch(now, query);
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        self.outbox.pop_front().or_else(|| self.driver.advance(until))
    }

    fn inner(&mut self) -> Option<&mut dyn Driver> {
        Some(&mut *self.driver)
    }
}
