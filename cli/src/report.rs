//! What is said about documents: printed on standard output in the form that was asked for, and counted.

mod gather;

use std::path::PathBuf;

use motet_syntax::{Diagnostic, Severity, Sources, render};

use crate::args::Format;
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, Out, count, note};
use gather::Gathered;

/// Prints and counts diagnostics.
#[derive(Debug)]
pub(crate) struct Report {
    format: Format,
    colors: Colors,
    /// Standard output.
    pub(crate) out: Out,
    gathered: Gathered,
    is_held: bool,
    errors: usize,
    warnings: usize,
}

impl Report {
    /// A report in a format.
    #[must_use]
    pub(crate) fn new(format: Format, colors: Colors) -> Self {
        Self {
            format,
            colors,
            out: Out::default(),
            gathered: Gathered::default(),
            is_held: false,
            errors: 0,
            warnings: 0,
        }
    }

    /// A report that says nothing: for what is said elsewhere.
    #[must_use]
    pub(crate) fn silent() -> Self {
        Self { is_held: true, ..Self::new(Format::Human, Colors { stdout: false, stderr: false }) }
    }

    /// Counts warnings that are no diagnostics.
    pub(crate) fn warned(&mut self, count: usize) {
        self.warnings += count;
    }

    /// Keeps what is said until the end: then it goes to standard output, or to standard error where something else was
    /// written to standard output.
    pub(crate) fn hold(&mut self) {
        self.is_held = true;
    }

    /// Says diagnostics: at once for people, at the end where the format is one document.
    pub(crate) fn say(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        for said in diagnostics {
            match said.severity {
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
                Severity::Note => {}
            }
        }
        match self.format {
            Format::Human | Format::Github | Format::Json | Format::Llm if !self.is_held => {
                let text = self.text(diagnostics, sources);
                let gap = if self.format == Format::Human && self.out.is_used() && !text.is_empty() {
                    "\n"
                } else {
                    ""
                };
                self.out.text(&format!("{gap}{text}"));
            }
            Format::Human | Format::Github | Format::Json | Format::Sarif | Format::Llm => {
                self.gathered.add(diagnostics, sources)
            }
        }
    }

    fn text(&self, diagnostics: &[Diagnostic], sources: &Sources) -> String {
        let is_apart = self.is_held && self.out.is_used();
        let is_colored = if is_apart { self.colors.stderr } else { self.colors.stdout };
        match self.format {
            Format::Human => {
                let color = if is_colored { render::ColorChoice::On } else { render::ColorChoice::Off };
                render::human(diagnostics, sources, color, width())
            }
            Format::Github => render::github(diagnostics, sources),
            Format::Json => render::json(diagnostics, sources),
            Format::Sarif => render::sarif(diagnostics, sources, &help),
            Format::Llm => render::llm(diagnostics, sources),
        }
    }

    /// Says what there is to say about a file that everything rests on.
    ///
    /// # Errors
    ///
    /// There is an error in it.
    pub(crate) fn usable(
        &mut self,
        what: &'static str,
        said: &[Diagnostic],
        sources: &Sources,
    ) -> Result<(), Trouble> {
        self.say(said, sources);
        let is_broken = said.iter().any(|said| said.severity == Severity::Error);
        if is_broken { Err(Trouble::Diagnosed(what)) } else { Ok(()) }
    }

    /// How many errors there were.
    #[must_use]
    pub(crate) fn errors(&self) -> usize {
        self.errors
    }

    /// `2 errors, 1 warning`, or `no errors`.
    #[must_use]
    pub(crate) fn tally(&self) -> String {
        match (self.errors, self.warnings) {
            (0, 0) => "no errors".to_owned(),
            (errors, 0) => count(errors, "error"),
            (0, warnings) => format!("no errors, {}", count(warnings, "warning")),
            (errors, warnings) => format!("{}, {}", count(errors, "error"), count(warnings, "warning")),
        }
    }

    /// Prints what was gathered, whatever the command came to.
    ///
    /// # Errors
    ///
    /// What the command came to, and a standard output that cannot be written.
    pub(crate) fn close(mut self, result: Result<Exit, Trouble>) -> Result<Exit, Trouble> {
        if self.is_held || self.format == Format::Sarif {
            let text = self.text(&self.gathered.diagnostics, &self.gathered.sources);
            if self.is_held && self.out.is_used() {
                if !self.gathered.diagnostics.is_empty() {
                    note(text.trim_end());
                }
            } else {
                self.out.text(&text);
            }
        }
        close(&mut self.out, result)
    }
}

/// Columns of the terminal, within reason; 100 where there is none.
fn width() -> usize {
    let (_, columns) = console::Term::stdout().size_checked().unwrap_or((0, 100));
    usize::from(columns).clamp(60, 140)
}

/// What a command came to, unless standard output could not be written.
///
/// # Errors
///
/// Those of the result, and a standard output that cannot be written.
pub(crate) fn close(out: &mut Out, result: Result<Exit, Trouble>) -> Result<Exit, Trouble> {
    match out.take_error() {
        Some(source) => Err(Trouble::Write { path: PathBuf::from("standard output"), source }),
        None => result,
    }
}

/// The title and the text of a code's page.
fn help(code: &str) -> Option<render::CodePage<'static>> {
    let page = motet_compiler::codes::page(code)?;
    let title =
        page.text.lines().next().and_then(|line| line.split_once(": ")).map_or("", |(_, title)| title);
    Some(render::CodePage { title, markdown: page.text })
}
