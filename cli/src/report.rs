//! Diagnostics of a command: printed to stdout in the chosen format, and counted.

use std::collections::HashMap;
use std::fmt;
use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
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
    /// Greatest number of findings of a document that people are shown.
    most: usize,
    errors: usize,
    warnings: usize,
}

/// Findings of a document that people are shown, unless they ask for more.
pub(crate) const SHOWN: usize = 100;

impl Report {
    /// Report in a format.
    fn new(format: DiagnosticFormat, colors: Colors) -> Self {
        Self {
            format,
            colors,
            out: Output::default(),
            collected: Collected::default(),
            is_held: false,
            most: SHOWN,
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

    /// Counts errors and warnings that an earlier call has written.
    pub(crate) fn count(&mut self, errors: usize, warnings: usize) {
        self.errors += errors;
        self.warnings += warnings;
    }

    /// Holds the diagnostics back until the end. They go to stdout, or to stderr if the command has written
    /// a result to stdout.
    pub(crate) fn hold(&mut self) {
        self.is_held = true;
    }

    /// Way of writing diagnostics, for other threads.
    pub(crate) fn style(&self) -> Style {
        Style { format: self.format, colors: self.colors, is_held: self.is_held, most: self.most }
    }

    /// Shows people so many findings of a document.
    pub(crate) fn show_at_most(&mut self, most: usize) {
        self.most = most;
    }

    /// Prints diagnostics now, or collects them if the report is held or its format is one document.
    pub(crate) fn print(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        let written = self.style().write(diagnostics, sources);
        self.show(written);
    }

    /// Prints written diagnostics, and counts them.
    pub(crate) fn show(&mut self, written: Written) {
        self.errors += written.errors;
        self.warnings += written.warnings;
        match written.body {
            Body::Collected(diagnostics, sources) => self.collected.add(&diagnostics, &sources),
            Body::Text(text) => {
                let needs_gap =
                    self.format == DiagnosticFormat::Human && self.out.is_used() && !text.is_empty();
                let gap = if needs_gap { "\n" } else { "" };
                self.out.styled(&format!("{gap}{text}"));
            }
        }
    }

    fn text(&self, diagnostics: &[Diagnostic], sources: &Sources) -> String {
        let goes_to_stderr = self.is_held && self.out.is_used();
        let is_colored = if goes_to_stderr { self.colors.stderr } else { self.colors.stdout };
        text(self.format, is_colored, self.most, diagnostics, sources)
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
                self.out.styled(&text);
            }
        }
        close(&mut self.out, result)
    }
}

/// Way of writing diagnostics.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Style {
    format: DiagnosticFormat,
    colors: Colors,
    is_held: bool,
    most: usize,
}

/// Diagnostics of one document, ready to be printed.
#[derive(Debug)]
pub(crate) struct Written {
    pub(crate) errors: usize,
    pub(crate) warnings: usize,
    body: Body,
}

#[derive(Debug)]
enum Body {
    Text(String),
    /// For a report that prints all of them at its end.
    Collected(Vec<Diagnostic>, Sources),
}

impl Written {
    /// Diagnostics that are counted and not printed.
    pub(crate) fn unseen(diagnostics: &[Diagnostic]) -> Self {
        let number = |severity| diagnostics.iter().filter(|found| found.severity == severity).count();
        let body = Body::Text(String::new());
        Self { errors: number(Severity::Error), warnings: number(Severity::Warning), body }
    }
}

impl Style {
    /// Writes diagnostics in this style.
    pub(crate) fn write(self, diagnostics: &[Diagnostic], sources: &Sources) -> Written {
        let body = match self.is_held || self.format == DiagnosticFormat::Sarif {
            true => Body::Collected(diagnostics.to_vec(), sources.clone()),
            false => Body::Text(text(self.format, self.colors.stdout, self.most, diagnostics, sources)),
        };
        Written { body, ..Written::unseen(diagnostics) }
    }
}

fn text(
    format: DiagnosticFormat,
    is_colored: bool,
    most: usize,
    diagnostics: &[Diagnostic],
    sources: &Sources,
) -> String {
    match format {
        DiagnosticFormat::Human => {
            let color = if is_colored { render::ColorChoice::On } else { render::ColorChoice::Off };
            // Each one is shown with its source: thousands take minutes, and nobody reads them.
            let (shown, more) = diagnostics.split_at(most.min(diagnostics.len()));
            let mut text = render::human(shown, sources, color, width());
            if !more.is_empty() {
                let more = count(more.len(), "more finding");
                text.push_str(&format!("\n… {more}: `--format json` lists all\n"));
            }
            text
        }
        DiagnosticFormat::Github => render::github(diagnostics, sources),
        DiagnosticFormat::Json => render::json(diagnostics, sources),
        DiagnosticFormat::Sarif => render::sarif(diagnostics, sources, &help),
        DiagnosticFormat::Llm => render::llm(diagnostics, sources),
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

/// Progress bar with the rate and the time that is left; hidden for a few inputs, or without a terminal.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    /// Number of documents, of which the rate is shown.
    documents: Arc<AtomicU64>,
}

impl Progress {
    /// Bar for `inputs` documents with `bytes` in total.
    pub(crate) fn new(inputs: usize, bytes: u64, verb: &'static str) -> Self {
        let is_batch = inputs > BATCH || bytes > 1 << 20;
        // On the terminal that shows the findings too, the bar would tear them apart.
        let is_shown = is_batch && !(io::stdout().is_terminal() && inputs <= BATCH);
        Self::with(is_shown, bytes, verb, "{msg} {wide_bar} {bytes}/{total_bytes} {rate} {eta}")
    }

    /// Bar for a number of items, all of which take about as long.
    pub(crate) fn of_items(items: usize, verb: &'static str) -> Self {
        let items = u64::try_from(items).unwrap_or(u64::MAX);
        Self::with(items > 1, items, verb, "{msg} {wide_bar} {pos}/{len} {rate} {eta}")
    }

    fn with(is_shown: bool, total: u64, verb: &'static str, template: &str) -> Self {
        let documents = Arc::new(AtomicU64::new(0));
        if !is_shown || !io::stderr().is_terminal() {
            return Self { bar: ProgressBar::hidden(), documents };
        }
        let bar = ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr_with_hz(10));
        let counted = Arc::clone(&documents);
        let rate = move |state: &ProgressState, to: &mut dyn fmt::Write| {
            let secs = state.elapsed().as_secs_f64().max(1e-3);
            // The bar is drawn again: an error of it says nothing.
            let _ = write!(to, "{:.0}/s", counted.load(Ordering::Relaxed) as f64 / secs);
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.with_key("rate", rate));
        }
        bar.set_message(verb);
        Self { bar, documents }
    }

    /// Advances the bar by a document of this size.
    pub(crate) fn advance(&self, bytes: usize) {
        self.documents.fetch_add(1, Ordering::Relaxed);
        self.bar.inc(bytes as u64);
    }

    /// Advances the bar by something that is done already.
    pub(crate) fn skip(&self, bytes: usize) {
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
