//! `motet fmt`: formats policies in the canonical layout, or converts them between text and JSON. Comments
//! of a text stay.

use std::path::{Path, PathBuf};

use clap::Args;
use motet::document::{self, is_broken, is_reply};
use motet_project::Project;
use motet_project::files::Bytes;

use crate::documents::{self, Document, Flow, Input};
use crate::error::{CliError, Exit};
use crate::flags::{DocumentArgs, EnvironmentArgs, FormatArgs, SyntaxArg, folder_of};
use crate::output::{Colors, count, note, replace_file};
use crate::report::Report;

/// Flags of `motet fmt`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet fmt .                       format all policies in this folder\n  \
    motet fmt --check .               list files that would change; exit 1 if there are any\n  \
    motet fmt --to json a.motet       print the policy as JSON\n  \
    motet fmt --to text reply.json    print the policy as text")]
pub(crate) struct FmtArgs {
    #[command(flatten)]
    documents: DocumentArgs,
    /// List the files that would change, without changing them
    #[arg(long)]
    check: bool,
    /// Print the policies in this syntax, and leave the files as they are
    #[arg(long, value_enum, value_name = "SYNTAX", conflicts_with = "check")]
    to: Option<SyntaxArg>,
    /// Robot whose signatures name and order the arguments: a built-in name, or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: Option<String>,
    /// File with further declarations; repeatable
    #[arg(long, value_name = "FILE")]
    domain: Vec<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// Runs the command.
pub(crate) fn run(args: &FmtArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.format, colors, |report| {
        // The documents go to stdout.
        if args.to.is_some() || args.documents.paths.iter().any(|path| path.as_os_str() == "-") {
            report.hold();
        }
        fmt(args, report)
    })
}

fn fmt(args: &FmtArgs, report: &mut Report) -> Result<Exit, CliError> {
    let inputs = documents::collect(&args.documents.paths)?;
    let (robot, domain) = (args.robot.clone(), args.domain.clone());
    let environment = EnvironmentArgs { robot, domain, ..EnvironmentArgs::default() };
    let folder = args.documents.paths.first().map_or(Path::new("."), |path| match path.is_dir() {
        true => path.as_path(),
        false => folder_of(path),
    });
    let mut project = environment.without_motions_in(folder)?.open_with(report)?;
    let mut tally = Tally { is_batch: is_batch(&inputs.inputs), ..Tally::default() };
    for input in &inputs.inputs {
        let flow = input.documents(&mut |found| {
            match args.to {
                Some(to) => tally.convert(&found, to, &mut project, report)?,
                None => tally.format(&found, args.check, &mut project, report)?,
            }
            Ok(if report.out.is_closed() { Flow::Stop } else { Flow::Continue })
        })?;
        if flow == Flow::Stop {
            break;
        }
    }
    tally.print(args);
    let is_clean = tally.failed + tally.replies == 0 && !(args.check && tally.changed > 0);
    Ok(if is_clean { Exit::Success } else { Exit::Findings })
}

fn is_batch(inputs: &[Input]) -> bool {
    inputs.len() > 1 || inputs.iter().any(|input| matches!(input, Input::Lines(_)))
}

/// Numbers for the summary.
#[derive(Default)]
struct Tally {
    /// Is `true` if there may be several documents.
    is_batch: bool,
    written: usize,
    changed: usize,
    unchanged: usize,
    failed: usize,
    /// Documents with prose around the policy, which formatting would lose.
    replies: usize,
    lines: usize,
}

impl Tally {
    /// Prints a document in a syntax: of several, JSON on one line each, text with an empty line between.
    fn convert(
        &mut self,
        found: &Document,
        to: SyntaxArg,
        project: &mut Project,
        report: &mut Report,
    ) -> Result<(), CliError> {
        let (source, parsed) = found.parse();
        let opened = project.session_for(&parsed.file, report)?;
        let sources = opened.sources(source);
        report.print(&parsed.diagnostics, &sources);
        if is_broken(&parsed) {
            self.failed += 1;
            return Ok(());
        }
        match document::write(&parsed, None, opened.session.library(), to.into()) {
            Ok(text) => {
                let text = match to {
                    SyntaxArg::Json if self.is_batch => one_line(&text),
                    SyntaxArg::Text if self.written > 0 => format!("\n{text}"),
                    SyntaxArg::Json | SyntaxArg::Text => text,
                };
                let text = format!("{}\n", text.trim_end_matches('\n'));
                report.out.document(&text, to == SyntaxArg::Json);
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
        project: &mut Project,
        report: &mut Report,
    ) -> Result<(), CliError> {
        let is_stdin = found.name == "-";
        if found.path.is_none() && !is_stdin {
            self.lines += 1;
            return Ok(());
        }
        let (source, parsed) = found.parse();
        let is_reply = is_reply(&parsed);
        if is_broken(&parsed) || is_reply {
            let sources = project.session_for(&parsed.file, report)?.sources(source);
            report.print(&parsed.diagnostics, &sources);
            self.failed += usize::from(!is_reply);
            self.replies += usize::from(is_reply);
            if let (true, None, Bytes::All(bytes)) = (is_reply, &found.path, &found.bytes) {
                report
                    .out
                    .document(&String::from_utf8_lossy(bytes), parsed.syntax == motet_syntax::Syntax::Json);
            }
            return Ok(());
        }
        let text = motet_syntax::format(&source).unwrap_or_else(|_| source.text.to_string());
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
            Some(path) if !is_same => replace_file(path, &text)?,
            Some(_) => {}
            None => report.out.document(&text, parsed.syntax == motet_syntax::Syntax::Json),
        }
        Ok(())
    }

    fn print(&self, args: &FmtArgs) {
        if self.lines > 0 {
            note(
                "note: skipped the .jsonl files: fmt rewrites whole files only (--to prints their policies)",
            );
        }
        if args.to.is_none() {
            let verb = if args.check { "would be reformatted" } else { "reformatted" };
            let mut parts = vec![format!("{} {verb}", count(self.changed, "file"))];
            parts.push(format!("{} unchanged", self.unchanged));
            if self.failed > 0 {
                parts.push(format!("{} with errors skipped", self.failed));
            }
            if self.replies > 0 {
                parts.push(format!("{} with prose skipped", self.replies));
            }
            note(&parts.join(", "));
        }
    }
}

/// JSON on one line; other text stays as it is.
fn one_line(text: &str) -> String {
    serde_json::from_str::<serde_json::Value>(text)
        .map_or_else(|_| text.to_owned(), |value| value.to_string())
}
