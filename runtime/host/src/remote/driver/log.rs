//! Listener to what passes between the host and a driver, for people and for tests of drivers.

use crate::remote::link::ErrorOutput;

/// Listener to a connection with a driver. A closure that takes a text is one that hears the notes.
pub trait DriverLog {
    /// Something for people: feedback, and what goes wrong with the connection.
    fn note(&mut self, text: &str);

    /// A promise that the driver broke, without effect on the run.
    fn breach(&mut self, text: &str) {
        self.note(text);
    }

    /// A line is said or was heard.
    fn line(&mut self, _from: LineFrom, _line: &str) {}

    /// Function that takes each line of the standard error of a driver that is started, on a thread of its
    /// own. Without it the driver has that of this process.
    fn error_output(&self) -> Option<ErrorOutput> {
        None
    }
}

impl<F: FnMut(&str)> DriverLog for F {
    fn note(&mut self, text: &str) {
        self(text);
    }
}

/// Side of a connection.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LineFrom {
    Host,
    Driver,
}
