//! `motet check`: what is wrong with policies, before a robot moves.

use std::path::PathBuf;

use motet_compiler::fix::fix;

use crate::args::CheckArgs;
use crate::document;
use crate::exit::{Exit, Trouble};
use crate::input::{self, Bytes, Document, Flow};
use crate::out::{Colors, count, note};
use crate::progress::Progress;
use crate::report::Report;
use crate::workbench::{DOCUMENT, Workbench, wanted_robot};

/// The most fixes that are made to one document.
const MOST_FIXES: usize = 100;

/// Runs the command.
///
/// # Errors
///
/// An input cannot be read, or what it is checked against cannot be used.
pub(crate) fn run(args: &CheckArgs, colors: Colors) -> Result<Exit, Trouble> {
    let mut report = Report::new(args.format.format, colors);
    // The mended document takes standard output.
    if args.fix && args.documents.paths.iter().any(|path| path.as_os_str() == "-") {
        report.hold();
    }
    let result = check(args, &mut report);
    report.close(result)
}

fn check(args: &CheckArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let inputs = input::collect(&args.documents.paths)?;
    let mut bench = Workbench::open(&args.world, report)?;
    let progress = Progress::new(inputs.inputs.len(), inputs.size, "checking");
    let mut tally = Tally::default();
    for input in &inputs.inputs {
        let flow = input.documents(&mut |found| {
            let found = if args.fix { tally.mend(found, &mut bench, report)? } else { found };
            tally.add(&found, &mut bench, report, &progress)?;
            Ok(if report.out.is_closed() { Flow::Stop } else { Flow::GoOn })
        })?;
        if flow == Flow::Stop {
            break;
        }
    }
    drop(progress);
    tally.tell(&bench, &inputs.skipped);
    if args.fix {
        note(&format!("made {} fix{}", tally.fixed, if tally.fixed == 1 { "" } else { "es" }));
    }
    note(&format!("checked {}: {}", count(tally.documents, "document"), report.tally()));
    Ok(if report.errors() > 0 { Exit::Findings } else { Exit::Clean })
}

/// What the last lines say, beside the number of errors.
#[derive(Default)]
struct Tally {
    documents: usize,
    /// Fixes that were made.
    fixed: usize,
    /// Documents of which only a line could be rewritten.
    lines: usize,
    /// Documents with text beside the policy, which a rewrite would lose.
    replies: usize,
    /// Motions whose geometry nobody looked at.
    motions: usize,
    /// The same of documents with errors.
    unseen: usize,
    /// Documents that were checked against no robot.
    without_robot: usize,
}

impl Tally {
    /// Mends a document where it lies, and gives what it then is.
    fn mend(
        &mut self,
        mut found: Document,
        bench: &mut Workbench,
        report: &mut Report,
    ) -> Result<Document, Trouble> {
        let is_stdin = found.name == "-";
        if found.path.is_none() && !is_stdin {
            self.lines += 1;
            return Ok(found);
        }
        let (source, parsed) = document::read(&found);
        let is_text = matches!(&found.bytes, Bytes::All(bytes) if std::str::from_utf8(bytes).is_ok());
        let is_reply = document::is_reply(&parsed);
        self.replies += usize::from(is_reply);
        if is_text && !is_reply {
            let setting = bench.setting(&parsed.file, report)?;
            let fixed = fix(&setting.session, &source, DOCUMENT, MOST_FIXES);
            self.fixed += fixed.applied.len();
            if !fixed.applied.is_empty() {
                if let Some(path) = &found.path {
                    let fail = |source| Trouble::Write { path: path.clone(), source };
                    std::fs::write(path, &fixed.text).map_err(fail)?;
                }
                found.bytes = Bytes::All(fixed.text.into_bytes());
            }
        }
        if let (true, Bytes::All(bytes)) = (is_stdin, &found.bytes) {
            report.out.text(&String::from_utf8_lossy(bytes));
        }
        Ok(found)
    }

    fn add(
        &mut self,
        found: &Document,
        bench: &mut Workbench,
        report: &mut Report,
        progress: &Progress,
    ) -> Result<(), Trouble> {
        self.documents += 1;
        let (source, parsed) = document::read(found);
        let setting = bench.setting(&parsed.file, report)?;
        let runnable = parsed.file.runnable();
        if setting.robot.is_none() && parsed.file.runnable().next().is_some() {
            self.without_robot += usize::from(wanted_robot(&parsed.file).is_none());
        }
        // A document that is one policy is checked by compiling it, which also tells of its motions.
        let said = if parsed.file.items.len() == 1 && parsed.file.runnable().count() == 1 {
            let compiled = setting.session.compile(&parsed, None);
            self.unseen += compiled.skipped_motions;
            self.motions += compiled.graph.as_ref().map_or(0, crate::graph::deferred_motions);
            compiled.diagnostics
        } else {
            for policy in runnable {
                let compiled = setting.session.compile(&parsed, Some(&policy.name.text));
                self.unseen += compiled.skipped_motions;
                self.motions += compiled.graph.as_ref().map_or(0, crate::graph::deferred_motions);
            }
            setting.session.check(&parsed)
        };
        if let Bytes::All(bytes) = &found.bytes {
            progress.advance(bytes.len());
        }
        if !said.is_empty() {
            let sources = setting.sources(source);
            progress.suspend(|| report.say(&said, &sources));
        }
        Ok(())
    }

    fn tell(&self, bench: &Workbench, skipped: &[PathBuf]) {
        if self.documents == 0 {
            note("warning: there was nothing to check: no .motet file, no policy in JSON");
        }
        if !skipped.is_empty() {
            let files = if skipped.len() == 1 {
                "1 JSON file that is no policy".to_owned()
            } else {
                format!("{} JSON files that are no policies", skipped.len())
            };
            let named = skipped.iter().take(3).map(|path| format!("`{}`", path.display()));
            let rest = if skipped.len() > 3 { ", …" } else { "" };
            note(&format!("note: skipped {files}: {}{rest}", named.collect::<Vec<_>>().join(", ")));
        }
        if self.replies > 0 {
            note(
                "note: text beside a policy (M0116) is left as it is, and the policy with it: take the text out for --fix",
            );
        }
        if self.lines > 0 {
            note(
                "note: a .jsonl file keeps a policy a line and is left as it is: --fix rewrites whole files",
            );
        }
        if self.without_robot > 0 {
            note(
                "note: no robot was given, so all that the standard library declares was allowed (--robot NAME)",
            );
        }
        // Without a scene nothing was looked at, errors or not.
        let (motions, unseen) = match bench.has_scene() {
            true => (self.motions, self.unseen),
            false => (self.motions + self.unseen, 0),
        };
        if unseen > 0 {
            note(&format!("note: {} not checked geometrically, because of the errors", were(unseen)));
        }
        if motions > 0 {
            let (what, why) = match (bench.has_scene(), bench.has_geometry()) {
                (false, _) => ("not checked geometrically", ", because no scene was given (--scene NAME)"),
                (true, false) => ("not checked geometrically", ""),
                (true, true) => ("left to the run", " (`motet compile --emit tree` says why)"),
            };
            note(&format!("note: {} {what}{why}", were(motions)));
        }
    }
}

fn were(motions: usize) -> String {
    if motions == 1 { "1 motion was".to_owned() } else { format!("{motions} motions were") }
}
