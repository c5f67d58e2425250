//! Who answers questions: a person at the terminal, a script, or nobody.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::io::{self, BufRead, IsTerminal};
use std::path::Path;
use std::rc::Rc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::thread;
use std::time::Duration;

use motet_planner::dialogue::{Kind, Person, Problem};

use crate::command::run;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::out::note;

/// How often a waiting question looks whether it shall stop.
const SLICE: Duration = Duration::from_millis(50);

/// Who is asked.
pub(super) enum Asked {
    /// A person, whose lines come from a thread that reads standard input.
    Terminal { lines: RefCell<Receiver<String>>, is_live: bool },
    /// Lines of a file, in order.
    Script(RefCell<VecDeque<String>>),
    /// NoOperator.
    Never,
}

impl Asked {
    /// Reads the flag.
    ///
    /// # Errors
    ///
    /// It says something else, or its file cannot be read.
    pub(super) fn read(words: &[String]) -> Result<Self, Trouble> {
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        match words.as_slice() {
            [] | ["terminal"] => Ok(Self::terminal()),
            ["never"] => Ok(Self::Never),
            ["script", file] => {
                let text = String::from_utf8_lossy(&read_small(Path::new(file))?).into_owned();
                let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
                Ok(Self::Script(RefCell::new(lines.map(ToOwned::to_owned).collect())))
            }
            ["script"] => {
                Err(Trouble::Other("`--ask script` needs a file of answers, one a line".to_owned()))
            }
            _ => Err(Trouble::Other(format!(
                "`--ask {}`: write `terminal`, `never`, or `script FILE`",
                words.join(" ")
            ))),
        }
    }

    fn terminal() -> Self {
        let (sender, lines) = mpsc::channel();
        thread::spawn(move || {
            for line in io::stdin().lock().lines() {
                let Ok(line) = line else { return };
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
        Self::Terminal { lines: RefCell::new(lines), is_live: io::stdin().is_terminal() }
    }

    /// A line that was typed while nothing was asked.
    pub(super) fn typed(&self) -> Option<String> {
        let Self::Terminal { lines, is_live: true } = self else { return None };
        match lines.borrow().try_recv() {
            Ok(line) => Some(line).filter(|line| !line.trim().is_empty()),
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => None,
        }
    }

    fn answer(&self) -> Option<String> {
        match self {
            Self::Never => None,
            Self::Script(answers) => answers.borrow_mut().pop_front(),
            Self::Terminal { lines, .. } => loop {
                match lines.borrow().recv_timeout(SLICE) {
                    Ok(line) if line.trim().is_empty() => {}
                    Ok(line) => return Some(line),
                    Err(RecvTimeoutError::Disconnected) => return None,
                    Err(RecvTimeoutError::Timeout) if run::is_interrupted() => return None,
                    Err(RecvTimeoutError::Timeout) => {}
                }
            },
        }
    }
}

/// A question as it is put.
pub(super) fn put(problem: &Problem) -> String {
    let mut text = format!("? {}", problem.question);
    // Which things could be meant stands in the question, in the words that people have for them.
    if !problem.options.is_empty() && problem.kind != Kind::AmbiguousReference {
        let options: Vec<&str> = problem.options.iter().map(|option| option.as_str()).collect();
        text.push_str(&format!("\n  ({})", options.join(", ")));
    }
    text
}

/// Puts questions to whoever is asked.
pub(super) struct Asking(pub(super) Rc<Asked>);

impl Person for Asking {
    fn ask(&mut self, problem: &Problem) -> Option<String> {
        note(&put(problem));
        let answer = self.0.answer();
        if let (Asked::Script(_), Some(answer)) = (&*self.0, &answer) {
            note(&format!("> {answer}"));
        }
        answer
    }
}
