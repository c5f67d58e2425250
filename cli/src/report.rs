//! Diagnostics of a command: printed to stdout in the chosen format, and counted.

use std::collections::HashMap;
use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::sync::Arc;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use motet_project::DiagnosticSink;
use motet_syntax::{Diagnostic, FileId, Severity, Sources, Span, render};

use crate::error::{CliError, Exit};
use crate::flags::DiagnosticFormat;
use crate::output::{Colors, Output, count, note};

/// Prints and counts diagnostics.
#[derive(Debug)]
pub(crate) struct Report {
    format: DiagnosticFormat,
    colors: Colors,
    pub(crate) out: Output,
    collected: Collected,
    is_held: bool,
    errors: usize,
    warnings: usize,
}

impl Report {
    /// Report in a format.
    fn new(format: DiagnosticFormat, colors: Colors) -> Self {
        Self {
            format,
            colors,
            out: Output::default(),
            collected: Collected::default(),
            is_held: false,
            errors: 0,
            warnings: 0,
        }
    }

    /// Runs a command with a report, and closes the report.
    pub(crate) fn run(
        format: DiagnosticFormat,
        colors: Colors,
        command: impl FnOnce(&mut Self) -> Result<Exit, CliError>,
    ) -> Result<Exit, CliError> {
        let mut report = Self::new(format, colors);
        let result = command(&mut report);
        report.close(result)
    }

    /// Runs a command that prints a result: its diagnostics are held back until the end.
    pub(crate) fn run_held(
        format: DiagnosticFormat,
        colors: Colors,
        command: impl FnOnce(&mut Self) -> Result<Exit, CliError>,
    ) -> Result<Exit, CliError> {
        Self::run(format, colors, |report| {
            report.hold();
            command(report)
        })
    }

    /// Counts warnings that are not diagnostics.
    pub(crate) fn count_warnings(&mut self, count: usize) {
        self.warnings += count;
    }

    /// Holds the diagnostics back until the end. They go to stdout, or to stderr if the command has written
    /// a result to stdout.
    pub(crate) fn hold(&mut self) {
        self.is_held = true;
    }

    /// Prints diagnostics now, or collects them if the report is held or its format is one document.
    pub(crate) fn print(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        for found in diagnostics {
            match found.severity {
                Severity::Error => self.errors += 1,
                Severity::Warning => self.warnings += 1,
                Severity::Note => {}
            }
        }
        if self.is_held || self.format == DiagnosticFormat::Sarif {
            self.collected.add(diagnostics, sources);
            return;
        }
        let text = self.text(diagnostics, sources);
        let needs_gap = self.format == DiagnosticFormat::Human && self.out.is_used() && !text.is_empty();
        let gap = if needs_gap { "\n" } else { "" };
        self.out.text(&format!("{gap}{text}"));
    }

    fn text(&self, diagnostics: &[Diagnostic], sources: &Sources) -> String {
        let goes_to_stderr = self.is_held && self.out.is_used();
        let is_colored = if goes_to_stderr { self.colors.stderr } else { self.colors.stdout };
        match self.format {
            DiagnosticFormat::Human => {
                let color = if is_colored { render::ColorChoice::On } else { render::ColorChoice::Off };
                render::human(diagnostics, sources, color, width())
            }
            DiagnosticFormat::Github => render::github(diagnostics, sources),
            DiagnosticFormat::Json => render::json(diagnostics, sources),
            DiagnosticFormat::Sarif => render::sarif(diagnostics, sources, &help),
            DiagnosticFormat::Llm => render::llm(diagnostics, sources),
        }
    }

    /// Number of errors so far.
    pub(crate) fn errors(&self) -> usize {
        self.errors
    }

    /// `2 errors, 1 warning`, or `no errors`.
    pub(crate) fn tally(&self) -> String {
        match (self.errors, self.warnings) {
            (0, 0) => "no errors".to_owned(),
            (errors, 0) => count(errors, "error"),
            (0, warnings) => format!("no errors, {}", count(warnings, "warning")),
            (errors, warnings) => format!("{}, {}", count(errors, "error"), count(warnings, "warning")),
        }
    }

    /// Prints the collected diagnostics, and passes on the result of the command.
    fn close(mut self, result: Result<Exit, CliError>) -> Result<Exit, CliError> {
        if self.is_held || self.format == DiagnosticFormat::Sarif {
            let text = self.text(&self.collected.diagnostics, &self.collected.sources);
            if self.is_held && self.out.is_used() {
                if !self.collected.diagnostics.is_empty() {
                    note(text.trim_end());
                }
            } else {
                self.out.text(&text);
            }
        }
        close(&mut self.out, result)
    }
}

impl DiagnosticSink for Report {
    fn report(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        self.print(diagnostics, sources);
    }
}

/// Columns of the terminal, from 60 to 140; 100 without a terminal.
fn width() -> usize {
    let (_, columns) = console::Term::stdout().size_checked().unwrap_or((0, 100));
    usize::from(columns).clamp(60, 140)
}

/// Result of a command, or the error of writing stdout.
pub(crate) fn close(out: &mut Output, result: Result<Exit, CliError>) -> Result<Exit, CliError> {
    match out.take_error() {
        Some(source) => Err(CliError::Write { path: PathBuf::from("stdout"), source }),
        None => result,
    }
}

/// Title and text of the page of a diagnostic code.
fn help(code: &str) -> Option<render::CodePage<'static>> {
    let page = motet_compiler::explain_pages::page(code)?;
    let title =
        page.text.lines().next().and_then(|line| line.split_once(": ")).map_or("", |(_, title)| title);
    Some(render::CodePage { title, markdown: page.text })
}

/// Diagnostics of many documents under one set of sources. Each document comes with sources in which it is
/// the first file; here files are told apart by name.
#[derive(Debug, Default)]
struct Collected {
    diagnostics: Vec<Diagnostic>,
    sources: Sources,
    known: HashMap<Arc<str>, FileId>,
}

impl Collected {
    /// Adds diagnostics whose spans are places in `sources`.
    fn add(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        for found in diagnostics {
            let mut found = found.clone();
            self.renumber(&mut found.span, sources);
            for related in &mut found.related {
                if let Some(span) = &mut related.span {
                    self.renumber(span, sources);
                }
            }
            for edit in found.fix.iter_mut().flat_map(|fix| &mut fix.edits) {
                self.renumber(&mut edit.span, sources);
            }
            self.diagnostics.push(found);
        }
    }

    fn renumber(&mut self, span: &mut Span, sources: &Sources) {
        let Some(source) = sources.get(span.file) else { return };
        span.file = match self.known.get(&source.name) {
            Some(known) => *known,
            None => {
                let file = self.sources.add(source.clone());
                self.known.insert(Arc::clone(&source.name), file);
                file
            }
        };
    }
}

/// Number of inputs above which a bar is shown.
const BATCH: usize = 8;

/// Progress bar over the bytes of the inputs; hidden for a few inputs, or without a terminal.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Bar for `inputs` documents with `bytes` in total.
    pub(crate) fn new(inputs: usize, bytes: u64, verb: &'static str) -> Self {
        let is_batch = inputs > BATCH || bytes > 1 << 20;
        // On the terminal that shows the findings too, the bar would tear them apart.
        if !is_batch || !io::stderr().is_terminal() || io::stdout().is_terminal() && inputs <= BATCH {
            return Self { bar: ProgressBar::hidden() };
        }
        let bar = ProgressBar::with_draw_target(Some(bytes), ProgressDrawTarget::stderr_with_hz(10));
        let template = "{msg} {wide_bar} {bytes}/{total_bytes} {eta}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        bar.set_message(verb);
        Self { bar }
    }

    /// Advances the bar by a document of this size.
    pub(crate) fn advance(&self, bytes: usize) {
        self.bar.inc(bytes as u64);
    }

    /// Hides the bar while `print` runs.
    pub(crate) fn suspend<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
