//! Diagnostics as a person reads them in a terminal: the code, the message, the lines with the place
//! underlined, help.
//!
//! A document on one line, as models write JSON, is cut to the part near the place: no terminal has room for
//! more.

use std::fmt::{self, Display};
use std::sync::Arc;

use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, NamedSource,
    SourceCode, SourceSpan, SpanContents,
};

use rustc_hash::FxHashMap;

use super::{escaped, masked, source};
use crate::diagnostic::{Diagnostic, Related, Severity};
use crate::source::{FileId, Sources, Span};

/// Choice to write escape sequences for colours.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ColorChoice {
    On,
    Off,
}

/// All diagnostics, one below the other, wrapped at `width` columns. Empty where there is none.
#[must_use]
pub fn human(diagnostics: &[Diagnostic], sources: &Sources, color: ColorChoice, width: usize) -> String {
    let theme = match color {
        ColorChoice::On => GraphicalTheme::unicode(),
        ColorChoice::Off => GraphicalTheme::unicode_nocolor(),
    };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(width.max(40)).with_links(false);
    let mut text = String::new();
    let mut texts = MaskedTexts::default();
    for diagnostic in diagnostics {
        if !text.is_empty() {
            text.push('\n');
        }
        let report = Report::new(diagnostic, sources, &mut texts);
        if handler.render_report(&mut text, &report).is_err() {
            // Nothing in a report can fail to be formatted; if it did, the message alone is still worth
            // having.
            text.push_str(&format!("{}: {}\n", diagnostic.code, diagnostic.message));
        }
    }
    text
}

/// Masked texts of the files that were shown.
type MaskedTexts = FxHashMap<FileId, Arc<str>>;

/// A diagnostic as miette takes it.
#[derive(Debug)]
struct Report {
    code: &'static str,
    severity: Severity,
    message: String,
    help: Option<String>,
    source: Option<NamedSource<Excerpt>>,
    labels: Vec<LabeledSpan>,
    /// Places in other files.
    elsewhere: Vec<Report>,
}

impl Report {
    fn new(diagnostic: &Diagnostic, sources: &Sources, texts: &mut MaskedTexts) -> Self {
        let span = diagnostic.span;
        let mut report = Self::at(span, sources, texts);
        report.code = diagnostic.code.0;
        report.severity = diagnostic.severity;
        report.message = escaped(&diagnostic.message);
        report.help = diagnostic.help.as_deref().map(escaped);
        let inner = diagnostic.related.iter().filter_map(|related| related.span);
        let inner = inner
            .filter(|inner| inner.file == span.file && span.contains(*inner) && !is_cut(*inner, sources));
        // Underlines in one another cannot be drawn: of a place with others in it, the beginning is shown.
        let drawn = match inner.map(|inner| inner.start).min() {
            Some(first) => Span { end: head(span, sources).min(first), ..span },
            None => span,
        };
        // The place of the mistake itself is the one that the header names.
        let main = label(drawn, None, sources).filter(|main| !main.is_empty() || drawn == span);
        report.labels.extend(main.map(|main| LabeledSpan::new_primary_with_span(None, *main.inner())));
        for related in &diagnostic.related {
            report.relate(related, span, sources, texts);
        }
        if let [only] = report.labels.as_slice()
            && !only.primary()
        {
            let words = only.label().map(str::to_owned);
            report.labels = vec![LabeledSpan::new_primary_with_span(words, *only.inner())];
        }
        report
    }

    fn at(span: Span, sources: &Sources, texts: &mut MaskedTexts) -> Self {
        let source = source(sources, span);
        let source = source.map(|source| {
            let text = texts.entry(span.file).or_insert_with(|| masked(&source.text));
            NamedSource::new(escaped(&source.name), Excerpt(Arc::clone(text)))
        });
        Self {
            code: "",
            severity: Severity::Note,
            message: String::new(),
            help: None,
            source,
            labels: Vec::new(),
            elsewhere: Vec::new(),
        }
    }

    /// A remark in the same file is a second label; any other is a report of its own below.
    fn relate(&mut self, related: &Related, main: Span, sources: &Sources, texts: &mut MaskedTexts) {
        match related.span {
            Some(span) if span.file == main.file && !is_cut(main, sources) && !is_cut(span, sources) => {
                self.labels.extend(label(span, Some(escaped(&related.message)), sources));
            }
            Some(span) => {
                let mut report = Self::at(span, sources, texts);
                report.message = escaped(&related.message);
                report.labels.extend(label(span, None, sources));
                self.elsewhere.push(report);
            }
            None => {
                let mut report = Self::at(main, &Sources::default(), texts);
                report.message = escaped(&related.message);
                self.elsewhere.push(report);
            }
        }
    }
}

/// One past the first word of a place.
fn head(span: Span, sources: &Sources) -> u32 {
    let text = source(sources, span).and_then(|source| source.text.get(span.range())).unwrap_or("");
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let length = text.find(|c| !is_word(c)).filter(|length| *length > 0);
    let length = length.unwrap_or_else(|| text.chars().next().map_or(0, char::len_utf8));
    span.start.saturating_add(u32::try_from(length).unwrap_or(0))
}

/// A label on a place, as much of it as is shown.
fn label(span: Span, words: Option<String>, sources: &Sources) -> Option<LabeledSpan> {
    let (start, end) = Excerpt::clipped(&source(sources, span)?.text, span.start as usize, span.end as usize);
    Some(LabeledSpan::new(words, start, end - start))
}

fn is_cut(span: Span, sources: &Sources) -> bool {
    source(sources, span).is_some_and(|source| Excerpt::is_cut(&source.text, span.start as usize))
}

impl Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Report {}

impl miette::Diagnostic for Report {
    fn code<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        (!self.code.is_empty()).then(|| Box::new(self.code) as Box<dyn Display>)
    }
    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Note => miette::Severity::Advice,
            Severity::Warning => miette::Severity::Warning,
            Severity::Error => miette::Severity::Error,
        })
    }
    fn help<'a>(&'a self) -> Option<Box<dyn Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn Display>)
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }
    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn miette::Diagnostic> + 'a>> {
        let reports = self.elsewhere.iter().map(|report| report as &dyn miette::Diagnostic);
        (!self.elsewhere.is_empty()).then(|| Box::new(reports) as Box<dyn Iterator<Item = _>>)
    }
}

/// Lines that are longer than this, in bytes, are cut.
const LONG_LINE: usize = 240;
/// Bytes of a long line that are shown on either side.
const AROUND: usize = 60;
/// Places that cover more lines than this are shown by their first line.
const MANY_LINES: usize = 6;

/// The text of a file.
#[derive(Debug)]
pub(super) struct Excerpt(pub(super) Arc<str>);

impl Excerpt {
    /// Underlined part of a range: all of it, or its beginning.
    pub(super) fn clipped(text: &str, start: usize, end: usize) -> (usize, usize) {
        let length = text.len();
        let start = boundary(text, start.min(length));
        let end = boundary(text, end.clamp(start, length));
        let place = text.get(start..end).unwrap_or("");
        let is_short =
            place.lines().count() <= MANY_LINES && place.lines().all(|line| line.len() <= LONG_LINE);
        if is_short {
            return (start, end);
        }
        let first = place.lines().next().map_or(0, |line| line.trim_end().len());
        (start, boundary(text, start + first.min(LONG_LINE / 2)))
    }

    /// Checks if a range is on a line that is cut.
    pub(super) fn is_cut(text: &str, at: usize) -> bool {
        let (start, end) = line_about(text, boundary(text, at.min(text.len())));
        end - start > LONG_LINE
    }
}

/// The line, without its break, that an offset on a character boundary is in.
fn line_about(text: &str, at: usize) -> (usize, usize) {
    let start = text.get(..at).and_then(|before| before.rfind('\n')).map_or(0, |line_break| line_break + 1);
    let end = text.get(at..).and_then(|rest| rest.find('\n')).map_or(text.len(), |length| at + length);
    (start, end)
}

/// Start of the line so many lines before the one that starts at an offset.
fn lines_back(text: &str, start: usize, count: usize) -> usize {
    (0..count).fold(start, |start, _| line_about(text, start.saturating_sub(1)).0)
}

/// End of the line so many lines behind the one that ends at an offset.
fn lines_on(text: &str, end: usize, count: usize) -> usize {
    (0..count).fold(end, |end, _| line_about(text, boundary(text, (end + 1).min(text.len()))).1)
}

/// Number of line breaks before an offset.
fn breaks(text: &str, at: usize) -> usize {
    text.as_bytes().get(..at).map_or(0, |above| above.iter().filter(|byte| **byte == b'\n').count())
}

/// The nearest character boundary at or before an offset.
fn boundary(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let text: &str = &self.0;
        let place = boundary(text, span.offset().min(text.len()));
        let (line_start, _) = line_about(text, place);
        let (_, line_end) = line_about(text, boundary(text, (place + span.len()).min(text.len())));
        if line_end - line_start <= LONG_LINE {
            // Only these lines are searched: the whole text once for each place would be slow.
            let first = lines_back(text, line_start, before + 1);
            let lines = text.get(first..lines_on(text, line_end, after + 2)).unwrap_or("");
            let within = SourceSpan::from((span.offset().saturating_sub(first), span.len()));
            let contents = lines.read_span(&within, before, after)?;
            if contents.data().split(|byte| *byte == b'\n').all(|line| line.len() <= LONG_LINE) {
                let shown = SourceSpan::from((first + contents.span().offset(), contents.span().len()));
                let (line, column) = (breaks(text, first) + contents.line(), contents.column());
                let (data, count) = (contents.data(), contents.line_count());
                return Ok(Box::new(MietteSpanContents::new(data, shown, line, column, count)));
            }
        }
        let reach = if before == 0 { 0 } else { AROUND };
        let start = boundary(text, place.saturating_sub(reach).max(line_start));
        let end = boundary(text, (place + span.len() + reach).min(line_end));
        let line = breaks(text, start);
        let column = text.get(line_start..start).map_or(0, |left| left.chars().count());
        let data = text.get(start..end).unwrap_or("").as_bytes();
        let shown = SourceSpan::from((start, end - start));
        Ok(Box::new(MietteSpanContents::new(data, shown, line, column, 1)))
    }
}
