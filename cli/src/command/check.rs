//! `motet check`: finds the errors of policies before a robot moves.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use motet::batch;
use motet::document::{MAX_FIXES, is_reply, listed};
use motet_compiler::fix::{Applicability, AppliedFix, FixLimits, fix};
use motet_project::files::Bytes;
use motet_project::{DOCUMENT, ProjectSession, named_robot};
use motet_syntax::{Parsed, Source, render};
use serde_json::{Value, json};

use crate::documents::{self, Document};
use crate::error::{CliError, Exit};
use crate::flags::{DocumentArgs, FormatArgs, JobArgs, ResultArgs, SessionArgs};
use crate::output::{Colors, count, count_irregular, note, replace_file};
use crate::projects::Projects;
use crate::report::{Progress, Report, SHOWN, Style, Written};
use crate::result_file::{DoneResult, ResultFile};
use crate::shared_sessions::{SharedSession, SharedSessions};

/// Flags of `motet check`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet check fetch_mug.motet --robot hsr --scene kitchen\n  \
    motet check policies/ --format sarif > findings.sarif\n  \
    motet check policies.jsonl --scene kitchen --out verdicts.jsonl --shard 0/4\n  \
    motet check --fix reply.json --robot hsr --scene kitchen\n  \
    motet check --diff --unsafe-fixes reply.json --robot hsr --scene kitchen\n  \
    cat reply.txt | motet check - --robot hsr")]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    documents: DocumentArgs,
    #[command(flatten)]
    session: SessionArgs,
    #[command(flatten)]
    fixes: FixArgs,
    /// Refuse policies that leave a need or a motion to the run
    #[arg(long)]
    deny_deferred: bool,
    #[command(flatten)]
    format: FormatArgs,
    /// Findings of a document that are shown to people; other formats have all
    #[arg(long, value_name = "NUMBER", default_value_t = SHOWN)]
    findings: usize,
    #[command(flatten)]
    jobs: JobArgs,
    #[command(flatten)]
    results: ResultArgs,
}

/// Flags that choose which fixes are applied, and how.
#[derive(Args, Clone, Copy, Debug)]
struct FixArgs {
    /// Apply safe fixes in place; for stdin, print the fixed document
    #[arg(long)]
    fix: bool,
    /// Apply unsafe fixes too: they take steps away, or undo what the policy ends with
    #[arg(long)]
    unsafe_fixes: bool,
    /// Print what the fixes would change, and write nothing
    #[arg(long)]
    diff: bool,
}

impl FixArgs {
    fn is_fixing(self) -> bool {
        self.fix || self.unsafe_fixes || self.diff
    }

    fn limits(self) -> FixLimits {
        if self.unsafe_fixes { FixLimits::all(MAX_FIXES) } else { FixLimits::safe(MAX_FIXES) }
    }
}

/// Runs the command.
pub(crate) fn run(args: &CheckArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.format, colors, |report| {
        // The fixed document goes to stdout.
        if args.fixes.is_fixing() && args.documents.paths.iter().any(|path| path.as_os_str() == "-") {
            report.hold();
        }
        report.show_at_most(args.findings);
        check(args, report)
    })
}

fn check(args: &CheckArgs, report: &mut Report) -> Result<Exit, CliError> {
    if args.results.out.is_some() && args.fixes.is_fixing() {
        return Err(CliError::Message(
            "`--out` writes results, and fixes change documents: give one".to_owned(),
        ));
    }
    let inputs = documents::collect(&args.documents.paths)?;
    let mut projects = Projects::new(&args.session);
    if inputs.inputs.is_empty() {
        projects.of(Path::new("."), report)?;
    }
    let progress = Progress::new(inputs.inputs.len(), inputs.size, "checking");
    let results =
        ResultFile::open(&args.results, &format!("check {:?} {}", args.session, args.deny_deferred))?;
    let (has_results, results) = (results.is_some(), RefCell::new(results));
    let checker = Checker {
        fixes: args.fixes,
        denies_deferred: args.deny_deferred,
        style: report.style(),
        has_results,
        sessions: SharedSessions::new(projects),
    };
    let mut tally = Tally { denies_deferred: args.deny_deferred, ..Tally::default() };
    let shard = args.jobs.shard();
    let documents = inputs.documents().enumerate().filter_map(|(index, found)| {
        let due = |found| ResultFile::due(&results, shard.has(index), found, &progress);
        found.and_then(due).transpose()
    });
    let ended = batch::in_order(
        args.jobs.jobs(),
        PACKET,
        documents,
        |found| found.map(|(done, found)| (done.is_none().then(|| checker.check(&found)), done, found)),
        |checked| {
            let added = checked.and_then(|(checked, done, found)| match (checked, done) {
                (Some(checked), _) => {
                    tally.add(checked, &found, (args.fixes, report, &progress), &mut results.borrow_mut())
                }
                (None, done) => {
                    tally.add_done(&done, report);
                    progress.skip(found.size());
                    Ok(())
                }
            });
            match added {
                Err(error) => ControlFlow::Break(Some(error)),
                Ok(()) if report.out.is_closed() => ControlFlow::Break(None),
                Ok(()) => ControlFlow::Continue(()),
            }
        },
    );
    drop(progress);
    if let ControlFlow::Break(Some(error)) = ended {
        return Err(error);
    }
    if results.into_inner().is_some_and(|results| results.left() > 0) {
        return Err(CliError::Message(
            "the file of results has more lines than there are documents".to_owned(),
        ));
    }
    tally.print(&checker.sessions.into_projects(), &inputs.skipped);
    let is_refused = args.deny_deferred && tally.is_deferred();
    if args.fixes.diff {
        let fixes = count_irregular(tally.fixed, "fix", "fixes");
        let rest = match report.errors() {
            0 => String::new(),
            errors => format!("; {} would be left", count(errors, "error")),
        };
        note(&format!("{fixes} would be applied to {}{rest}", count(tally.documents, "document")));
        let is_refused = is_refused || tally.fixed + report.errors() > 0;
        return Ok(if is_refused { Exit::Findings } else { Exit::Success });
    }
    if args.fixes.is_fixing() {
        note(&format!("applied {}", count_irregular(tally.fixed, "fix", "fixes")));
    }
    note(&format!("checked {}: {}", count(tally.documents, "document"), report.tally()));
    Ok(if report.errors() > 0 || is_refused { Exit::Findings } else { Exit::Success })
}

/// Number of documents that a thread takes at once: a check takes some 50 µs.
const PACKET: usize = 32;

/// Checks documents, on any thread.
struct Checker<'a> {
    fixes: FixArgs,
    /// Is `true` if nothing may be left to the run.
    denies_deferred: bool,
    style: Style,
    /// Is `true` if the diagnostics go to a file of results.
    has_results: bool,
    sessions: SharedSessions<'a>,
}

/// Result of checking one document.
struct CheckedDocument {
    session: Arc<SharedSession>,
    fixed: FixedDocument,
    /// Diagnostics; `None` if there are none.
    written: Option<Written>,
    /// The same for a file of results.
    diagnostics: Vec<Value>,
    /// Numbers of the document.
    tally: Tally,
}

/// Result of fixing a document.
#[derive(Default)]
struct FixedDocument {
    applied: Vec<AppliedFix>,
    /// The text before and after the fixes.
    change: Option<(Arc<str>, String)>,
}

impl Checker<'_> {
    fn check(&self, found: &Document) -> CheckedDocument {
        let mut tally = Tally { documents: 1, ..Tally::default() };
        let (mut source, mut parsed) = found.parse();
        let shared = self.sessions.session_for(&found.folder(), &parsed.file);
        let Some(opened) = &shared.session else {
            let (fixed, written, diagnostics) = (FixedDocument::default(), None, Vec::new());
            return CheckedDocument { session: Arc::clone(&shared), fixed, written, diagnostics, tally };
        };
        let fixed = match self.fixes.is_fixing() {
            true => self.fix(found, (&source, &parsed), opened, &mut tally),
            false => FixedDocument::default(),
        };
        if let Some((_, text)) = &fixed.change {
            let bytes = Bytes::All(text.clone().into_bytes());
            let (name, path) = (found.name.clone(), found.path.clone());
            (source, parsed) = Document { name, line_of: None, path, bytes }.parse();
        }
        if opened.robot.is_none() && parsed.file.runnable().next().is_some() {
            tally.without_robot += usize::from(named_robot(&parsed.file).is_none());
        }
        let checked = opened.session.check_document(&parsed);
        for policy in &checked.policies {
            tally.unseen += policy.skipped_motions;
            tally.motions += policy.deferred_motions;
        }
        tally.left += checked.deferred_notes.len();
        let all = listed(checked, opened, self.denies_deferred);
        let (mut written, mut diagnostics) = (None, Vec::new());
        if !all.is_empty() {
            let sources = opened.sources(source);
            // What a fix would leave is told by the run that writes it.
            written = Some(match self.has_results || self.fixes.diff {
                true => Written::unseen(&all),
                false => self.style.write(&all, &sources),
            });
            if self.has_results {
                let lines = render::json(&all, &sources);
                diagnostics.extend(lines.lines().filter_map(|line| serde_json::from_str(line).ok()));
            }
        }
        CheckedDocument { session: Arc::clone(&shared), fixed, written, diagnostics, tally }
    }

    /// Fixes a document in memory.
    fn fix(
        &self,
        found: &Document,
        (source, parsed): (&Source, &Parsed),
        opened: &ProjectSession,
        tally: &mut Tally,
    ) -> FixedDocument {
        if found.path.is_none() && found.name != "-" {
            tally.lines += 1;
            return FixedDocument::default();
        }
        let is_text = matches!(&found.bytes, Bytes::All(bytes) if std::str::from_utf8(bytes).is_ok());
        let is_reply = is_reply(parsed);
        tally.replies += usize::from(is_reply);
        if !is_text || is_reply {
            return FixedDocument::default();
        }
        let fixed = fix(&opened.session, source, DOCUMENT, self.fixes.limits());
        tally.fixed += fixed.applied.len();
        let change = (!fixed.applied.is_empty()).then(|| (Arc::clone(&source.text), fixed.text));
        FixedDocument { applied: fixed.applied, change }
    }
}

/// Numbers for the summary, besides those of errors and warnings.
#[derive(Default)]
struct Tally {
    documents: usize,
    fixed: usize,
    /// Documents that are lines of a .jsonl file.
    lines: usize,
    /// Documents with prose around the policy, which a rewrite would lose.
    replies: usize,
    motions: usize,
    /// Steps with needs or motions that are left to the run.
    left: usize,
    /// True if nothing may be left to the run.
    denies_deferred: bool,
    /// Motions that were not checked because of earlier errors.
    unseen: usize,
    /// Documents that were checked without a robot.
    without_robot: usize,
}

impl Tally {
    /// Adds a checked document: prints its diagnostics and writes its fixes.
    fn add(
        &mut self,
        checked: CheckedDocument,
        found: &Document,
        (fixes, report, progress): (FixArgs, &mut Report, &Progress),
        results: &mut Option<ResultFile>,
    ) -> Result<(), CliError> {
        checked.session.announce(report)?;
        self.add_fixed(&checked.fixed, found, fixes, report)?;
        self.sum(&checked.tally);
        let numbers = checked.written.as_ref().map_or((0, 0), |written| (written.errors, written.warnings));
        if let Some(written) = checked.written {
            progress.suspend(|| report.show(written));
        }
        progress.advance(found.size());
        let Some(results) = results else { return Ok(()) };
        let checksum = results.checksum(found);
        let (errors, warnings) = numbers;
        let line = json!({
            "ok": errors == 0,
            "errors": errors,
            "warnings": warnings,
            "deferred": checked.tally.left + checked.tally.motions,
            "diagnostics": checked.diagnostics,
        });
        results.add(&found.name, &checksum, line)
    }

    /// Adds a document whose result an earlier call has written.
    fn add_done(&mut self, done: &Option<DoneResult>, report: &mut Report) {
        let number = |key: &str| {
            let number = done.as_ref().and_then(|done| done.line.get(key)?.as_u64());
            number.and_then(|number| usize::try_from(number).ok()).unwrap_or_default()
        };
        self.documents += 1;
        self.left += number("deferred");
        report.count(number("errors"), number("warnings"));
    }

    /// Reports the fixes of a document, and writes it.
    fn add_fixed(
        &self,
        fixed: &FixedDocument,
        found: &Document,
        args: FixArgs,
        report: &mut Report,
    ) -> Result<(), CliError> {
        for applied in &fixed.applied {
            let kind = match applied.applicability {
                Applicability::Safe => "",
                Applicability::Unsafe | Applicability::Shown => "unsafe ",
            };
            let verb = if args.diff { "would fix" } else { "fixed" };
            note(&format!("{verb} {}: {} ({kind}{})", found.name, applied.title, applied.code));
        }
        match (&fixed.change, &found.path) {
            (Some((before, after)), _) if args.diff => report.out.text(&diff(&found.name, before, after)),
            (Some((_, after)), Some(path)) => replace_file(path, after)?,
            (Some((_, after)), None) => report.out.document(after, found.is_json()),
            (None, _) => {
                let is_printed = found.name == "-" && args.is_fixing() && !args.diff;
                if let (true, Bytes::All(bytes)) = (is_printed, &found.bytes) {
                    report.out.document(&String::from_utf8_lossy(bytes), found.is_json());
                }
            }
        }
        Ok(())
    }

    fn sum(&mut self, other: &Self) {
        self.documents += other.documents;
        self.fixed += other.fixed;
        self.lines += other.lines;
        self.replies += other.replies;
        self.motions += other.motions;
        self.left += other.left;
        self.unseen += other.unseen;
        self.without_robot += other.without_robot;
    }

    /// Returns whether anything is left to the run.
    fn is_deferred(&self) -> bool {
        self.left + self.motions > 0
    }

    fn print(&self, projects: &Projects<'_>, skipped: &[PathBuf]) {
        if self.documents == 0 {
            note("warning: nothing to check: found no .motet file and no policy in JSON");
        }
        if !skipped.is_empty() {
            let (one, several) = ("JSON file that is not a policy", "JSON files that are not policies");
            let files = count_irregular(skipped.len(), one, several);
            let named = skipped.iter().take(3).map(|path| format!("`{}`", path.display()));
            let rest = if skipped.len() > 3 { ", …" } else { "" };
            note(&format!("note: skipped {files}: {}{rest}", named.collect::<Vec<_>>().join(", ")));
        }
        if self.replies > 0 {
            note("note: --fix skipped replies that contain prose (M0116); extract the policy first");
        }
        if self.lines > 0 {
            note("note: --fix skipped the .jsonl files: it rewrites whole files only");
        }
        if self.without_robot > 0 {
            note("note: without a robot, every primitive of the standard library is allowed (--robot NAME)");
        }
        // Without a scene no motion was checked, with or without errors.
        let (motions, unseen) = match projects.have_scene() {
            true => (self.motions, self.unseen),
            false => (self.motions + self.unseen, 0),
        };
        if unseen > 0 {
            note(&format!("note: {} not checked because of earlier errors", were(unseen)));
        }
        if motions > 0 {
            let (what, why) = match (projects.have_scene(), projects.have_geometry()) {
                (false, _) => ("not checked", ", because no scene was given (--scene NAME)"),
                (true, false) => ("not checked", ""),
                (true, true) => ("deferred to the run", " (`motet compile --emit tree` shows the reasons)"),
            };
            note(&format!("note: {} {what}{why}", were(motions)));
        }
        if self.left > 0 && !projects.have_scene() && !self.denies_deferred {
            let steps = count(self.left, "step");
            note(&format!("note: needs of {steps} are left to the run (--scene NAME decides more)"));
        }
        if self.denies_deferred && self.is_deferred() {
            note("refused by --deny-deferred: not everything is decided before the run");
        }
    }
}

/// Changes of a document as a unified diff.
fn diff(name: &str, before: &str, after: &str) -> String {
    let changes = similar::TextDiff::from_lines(before, after);
    changes.unified_diff().header(name, name).to_string()
}

fn were(motions: usize) -> String {
    if motions == 1 { "1 motion was".to_owned() } else { format!("{motions} motions were") }
}
