//! `motet fmt`: the canonical layout, or the other form. Comments of a text are kept.

use std::path::Path;

use motet_syntax::{Parsed, Severity, Syntax, print};

use crate::args::{FmtArgs, Form as To, KnownArgs, WorldArgs};
use crate::document;
use crate::exit::{Exit, Trouble};
use crate::form;
use crate::input::{self, Bytes, Document, Flow, Input};
use crate::out::{Colors, count, note};
use crate::report::Report;
use crate::workbench::Workbench;

/// Runs the command.
///
/// # Errors
///
/// A file cannot be read or written.
pub(crate) fn run(args: &FmtArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(args.format.format, colors);
    // The documents themselves take standard output where they go there.
    if args.to.is_some() || args.documents.paths.iter().any(|path| path.as_os_str() == "-") {
        report.hold();
    }
    let result = fmt(args, &mut report);
    report.close(result)
}

fn fmt(args: &FmtArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let inputs = input::collect(&args.documents.paths)?;
    let known = KnownArgs { robot: args.robot.clone(), domain: args.domain.clone(), ..KnownArgs::default() };
    let world = WorldArgs::from(known);
    let mut bench = Workbench::open(&world, report)?;
    let mut tally = Tally { is_batch: is_batch(&inputs.inputs), ..Tally::default() };
    for input in &inputs.inputs {
        let flow = input.documents(&mut |found| {
            match args.to {
                Some(to) => tally.convert(&found, to, &mut bench, report)?,
                None => tally.format(&found, args.check, &mut bench, report)?,
            }
            Ok(if report.out.is_closed() { Flow::Stop } else { Flow::GoOn })
        })?;
        if flow == Flow::Stop {
            break;
        }
    }
    tally.tell(args);
    let is_clean = tally.failed + tally.replies == 0 && !(args.check && tally.changed > 0);
    Ok(if is_clean { Exit::Clean } else { Exit::Findings })
}

fn is_batch(inputs: &[Input]) -> bool {
    inputs.len() > 1 || inputs.iter().any(|input| matches!(input, Input::Lines(_)))
}

#[derive(Default)]
struct Tally {
    /// Whether there may be several documents.
    is_batch: bool,
    written: usize,
    changed: usize,
    unchanged: usize,
    failed: usize,
    /// Files with text beside the policy, which formatting would lose.
    replies: usize,
    lines: usize,
}

impl Tally {
    /// Prints a document in a form: of several, JSON a line each, text with an empty line between.
    fn convert(
        &mut self,
        found: &Document,
        to: To,
        bench: &mut Workbench,
        report: &mut Report,
    ) -> Result<(), Trouble> {
        let (source, parsed) = document::read(found);
        let setting = bench.setting(&parsed.file, report)?;
        let sources = setting.sources(source);
        report.say(&parsed.diagnostics, &sources);
        if is_broken(&parsed) {
            self.failed += 1;
            return Ok(());
        }
        let form = match to {
            To::Text => Syntax::Text,
            To::Json => Syntax::Json,
        };
        match form::write(&parsed, None, setting.session.library(), form) {
            Ok(text) => {
                let text = match to {
                    To::Json if self.is_batch => one_line(&text),
                    To::Text if self.written > 0 => format!("\n{text}"),
                    To::Json | To::Text => text,
                };
                report.out.line(text.trim_end_matches('\n'));
                self.written += 1;
            }
            Err(why) => {
                note(&format!("error: {}: {why}", found.name));
                self.failed += 1;
            }
        }
        Ok(())
    }

    fn format(
        &mut self,
        found: &Document,
        only_check: bool,
        bench: &mut Workbench,
        report: &mut Report,
    ) -> Result<(), Trouble> {
        let is_stdin = found.name == "-";
        if found.path.is_none() && !is_stdin {
            self.lines += 1;
            return Ok(());
        }
        let (source, parsed) = document::read(found);
        let is_reply = document::is_reply(&parsed);
        if is_broken(&parsed) || is_reply {
            let sources = bench.setting(&parsed.file, report)?.sources(source);
            report.say(&parsed.diagnostics, &sources);
            self.failed += usize::from(!is_reply);
            self.replies += usize::from(is_reply);
            if let (true, None, Bytes::All(bytes)) = (is_reply, &found.path, &found.bytes) {
                report.out.text(&String::from_utf8_lossy(bytes));
            }
            return Ok(());
        }
        let text = print::format(&source).unwrap_or_else(|_| source.text.to_string());
        let is_same = found.is(&text);
        if is_same {
            self.unchanged += 1
        } else {
            self.changed += 1
        }
        match &found.path {
            _ if only_check => {
                if !is_same {
                    report.out.line(&format!("would reformat {}", found.name));
                }
            }
            Some(path) if !is_same => write(path, &text)?,
            Some(_) => {}
            None => report.out.text(&text),
        }
        Ok(())
    }

    fn tell(&self, args: &FmtArgs) {
        if self.lines > 0 {
            note(
                "note: a .jsonl file keeps a policy a line and is left as it is (--to text|json prints its policies)",
            );
        }
        if args.to.is_none() {
            let verb = if args.check { "would be reformatted" } else { "reformatted" };
            let mut parts = vec![format!("{} {verb}", count(self.changed, "file"))];
            parts.push(format!("{} unchanged", self.unchanged));
            if self.failed > 0 {
                parts.push(format!("{} with errors left alone", self.failed));
            }
            if self.replies > 0 {
                parts.push(format!("{} with text beside the policy left alone", self.replies));
            }
            note(&parts.join(", "));
        }
    }
}

fn is_broken(parsed: &Parsed) -> bool {
    parsed.diagnostics.iter().any(|said| said.severity == Severity::Error)
}

/// JSON without line breaks; what is no JSON stays.
fn one_line(text: &str) -> String {
    serde_json::from_str::<serde_json::Value>(text)
        .map_or_else(|_| text.to_owned(), |value| value.to_string())
}

fn write(path: &Path, text: &str) -> Result<(), Trouble> {
    std::fs::write(path, text).map_err(|source| Trouble::Write { path: path.to_owned(), source })
}
