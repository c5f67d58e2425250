//! Operator of a conversation: a person at the terminal, a script, or nobody. Answers questions of the
//! dialogue manager and of `ask` steps.

use std::cell::{Cell, RefCell};
use std::collections::VecDeque;
use std::io::{self, BufRead, IsTerminal, Read as _};
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender, TryRecvError};
use std::thread;
use std::time::Duration;

use motet_graph::Value;
use motet_planner::dialogue::{Kind, Person, Problem};
use motet_project::files::read_small;
use motet_requests::{MAX_REQUEST, RequestContext};
use motet_robots::scene::Scene;
use motet_runtime::Outcome;
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

use crate::error::CliError;
use crate::interrupt::is_interrupted;
use crate::output::{self, escape, note, printable};
use crate::questions::{Answerer, Question};
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
        /// True while the next line is the answer to a question.
        is_asked: Cell<bool>,
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
            is_asked: Cell::new(false),
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
            thread::spawn(move || send_lines(io::stdin().lock(), &sender));
        }
        let is_live = is_live || hub.is_some() || io::stdin().is_terminal();
        Self::Terminal {
            lines: RefCell::new(lines),
            is_live,
            is_over: Cell::new(false),
            is_asked: Cell::new(false),
            letters,
            reads_stdin: true,
            hub,
        }
    }

    /// Line that was typed while the robot moves.
    pub(crate) fn typed(&self) -> Option<String> {
        let Self::Terminal { lines, is_live: true, is_over, is_asked, .. } = self else { return None };
        if is_asked.get() {
            return None;
        }
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

    /// Answer to a question, once it is there: `Some(None)` if nobody answers, and after Ctrl-C.
    fn answer(&self) -> Option<Option<String>> {
        let Self::Terminal { lines, hub, .. } = self else { return Some(self.line(&mut || None)) };
        loop {
            match lines.borrow().try_recv() {
                Ok(line) if line.trim().is_empty() => {}
                Ok(line) => return Some(Some(line)),
                Err(TryRecvError::Disconnected) => return Some(None),
                Err(TryRecvError::Empty) => {
                    let is_stopped = is_interrupted() || hub.as_ref().is_some_and(|hub| hub.is_stopped());
                    return is_stopped.then_some(None);
                }
            }
        }
    }

    fn set_asked(&self, is_now: bool) {
        if let Self::Terminal { is_asked, .. } = self {
            is_asked.set(is_now);
        }
    }

    /// Shows a person at a terminal that it is their turn.
    pub(crate) fn prompt(&self) {
        match self {
            Self::Terminal { letters: Some(_), .. } => typed_line::show(),
            Self::Terminal { .. } if self.is_echoed() => {
                output::prompt("> ");
            }
            Self::Terminal { .. } | Self::Script(_) | Self::Never => {}
        }
    }

    /// True if a person sees what they type.
    pub(crate) fn is_echoed(&self) -> bool {
        matches!(self, Self::Terminal { reads_stdin: true, .. }) && io::stdin().is_terminal()
    }
}

/// Sends each line of an input until its end. What is no UTF-8 is replaced; of a line that is too long for a
/// request, only the beginning is sent, which is too long as well and is refused.
fn send_lines(mut input: impl BufRead, lines: &Sender<String>) {
    let mut line = Vec::new();
    while input.by_ref().take(MAX_REQUEST as u64 + 1).read_until(b'\n', &mut line).is_ok_and(|read| read > 0)
    {
        let is_cut = line.len() > MAX_REQUEST && !line.ends_with(b"\n");
        if is_cut && input.skip_until(b'\n').is_err() {
            return;
        }
        let text = String::from_utf8_lossy(if is_cut { &line } else { line.trim_ascii_end() });
        if lines.send(text.into_owned()).is_err() {
            return;
        }
        line.clear();
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
    /// Shows a question that the page knows by an id.
    fn begin(&self, id: Option<&str>, problem: &Problem) {
        note(&question(problem));
        self.input.set_asked(true);
        self.tell_page(id);
        self.input.prompt();
    }

    /// Takes the question away again, with its answer.
    fn end(&self, answer: Option<&str>) {
        self.input.set_asked(false);
        self.tell_page(None);
        if let Some(answer) = answer.filter(|_| !self.input.is_echoed()) {
            note(&format!("> {}", escape(answer)));
        }
    }

    /// Tells the page which question is open.
    fn tell_page(&self, id: Option<&str>) {
        let hub = self.page.as_ref().map(|page| page.borrow().hub());
        hub.iter().for_each(|hub| hub.ask(id));
    }
}

impl Person for OperatorPrompt {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        let id = self
            .page
            .as_ref()
            .map(|page| page.borrow_mut().question(&printable(&problem.question), &problem.options));
        self.begin(id.as_deref(), problem);
        let answer = self.input.line(&mut || None);
        self.end(answer.as_deref());
        if let (Some(page), Some(id)) = (&self.page, &id) {
            page.borrow_mut().answered(id, answer.as_deref());
        }
        answer
    }
}

/// Operator who answers the questions of a policy while it runs.
pub(crate) struct OperatorAnswers<'a> {
    pub(crate) operator: OperatorPrompt,
    /// Things that a choice may name.
    pub(crate) scene: &'a Scene,
}

impl OperatorAnswers<'_> {
    /// One of several things. Fails with `refused` if the answer names none of them, and with `ambiguous` if
    /// it names several.
    fn chosen(&self, answer: &str, options: &[SmolStr]) -> Outcome {
        let mut chosen = motet_requests::choose(answer, options, &RequestContext::new(self.scene));
        chosen.retain(|thing| options.contains(thing));
        match chosen.as_slice() {
            [] => Outcome::Failure(failures::REFUSED.into()),
            [only] => Outcome::Success(Some(Value::Entity(only.clone()))),
            [_, _, ..] => Outcome::Failure(failures::AMBIGUOUS.into()),
        }
    }
}

impl Answerer for OperatorAnswers<'_> {
    fn ask(&mut self, question: &Question) {
        let id = self.operator.page.as_ref().map(|page| format!("{}:{}", page.borrow().run(), question.goal));
        let problem = Problem {
            kind: Kind::AmbiguousTask,
            question: printable(&question.text),
            options: question.options.clone().unwrap_or_default(),
            about: None,
            said: None,
        };
        self.operator.begin(id.as_deref(), &problem);
    }

    fn outcome(&mut self, question: &Question) -> Option<Outcome> {
        let answer = self.operator.input.answer()?;
        self.operator.end(answer.as_deref());
        Some(match (answer, &question.options) {
            (None, _) => Outcome::Failure(failures::REFUSED.into()),
            (Some(answer), Some(options)) => self.chosen(&answer, options),
            (Some(answer), None) => Outcome::Success(Some(Value::Text(answer.into()))),
        })
    }

    fn withdraw(&mut self) {
        self.operator.end(None);
    }
}
