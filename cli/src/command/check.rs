//! `motet check`: finds the errors of policies before a robot moves.

use std::path::PathBuf;

use clap::Args;
use motet_compiler::fix::{Applicability, FixLimits, fix};
use motet_graph::{Graph, NodeKind, Verdict};
use motet_project::files::Bytes;
use motet_project::{DOCUMENT, Project, named_robot};

use crate::documents::{self, Document, Flow, is_reply};
use crate::error::{CliError, Exit};
use crate::flags::{DocumentArgs, FormatArgs, SessionArgs};
use crate::output::{Colors, count, count_irregular, note, replace_file};
use crate::report::Progress;
use crate::report::Report;

/// Flags of `motet check`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet check fetch_mug.motet --robot hsr --scene kitchen\n  \
    motet check policies/ --format sarif > findings.sarif\n  \
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

/// Maximum number of fixes that are applied to one document.
const MAX_FIXES: usize = 100;

/// Runs the command.
pub(crate) fn run(args: &CheckArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.format, colors, |report| {
        // The fixed document goes to stdout.
        if args.fixes.is_fixing() && args.documents.paths.iter().any(|path| path.as_os_str() == "-") {
            report.hold();
        }
        check(args, report)
    })
}

fn check(args: &CheckArgs, report: &mut Report) -> Result<Exit, CliError> {
    let inputs = documents::collect(&args.documents.paths)?;
    let mut project = args.session.project().open_with(report)?;
    let progress = Progress::new(inputs.inputs.len(), inputs.size, "checking");
    let mut tally = Tally { denies_deferred: args.deny_deferred, ..Tally::default() };
    for input in &inputs.inputs {
        let flow = input.documents(&mut |found| {
            let found = if args.fixes.is_fixing() {
                tally.fix(found, args.fixes, &mut project, report)?
            } else {
                found
            };
            if args.fixes.diff {
                // What a fix would leave is for the run that writes it.
                tally.documents += 1;
                return Ok(if report.out.is_closed() { Flow::Stop } else { Flow::Continue });
            }
            tally.add(&found, &mut project, report, &progress)?;
            Ok(if report.out.is_closed() { Flow::Stop } else { Flow::Continue })
        })?;
        if flow == Flow::Stop {
            break;
        }
    }
    drop(progress);
    tally.print(&project, &inputs.skipped);
    if args.fixes.diff {
        let fixes = count_irregular(tally.fixed, "fix", "fixes");
        note(&format!("{fixes} would be applied to {}", count(tally.documents, "document")));
        return Ok(if tally.fixed > 0 { Exit::Findings } else { Exit::Success });
    }
    if args.fixes.is_fixing() {
        note(&format!("applied {}", count_irregular(tally.fixed, "fix", "fixes")));
    }
    note(&format!("checked {}: {}", count(tally.documents, "document"), report.tally()));
    let is_refused = args.deny_deferred && tally.is_deferred();
    Ok(if report.errors() > 0 || is_refused { Exit::Findings } else { Exit::Success })
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
    /// Fixes a document in place. Returns the fixed document.
    fn fix(
        &mut self,
        mut found: Document,
        args: FixArgs,
        project: &mut Project,
        report: &mut Report,
    ) -> Result<Document, CliError> {
        let is_stdin = found.name == "-";
        if found.path.is_none() && !is_stdin {
            self.lines += 1;
            return Ok(found);
        }
        let (source, parsed) = found.parse();
        let is_text = matches!(&found.bytes, Bytes::All(bytes) if std::str::from_utf8(bytes).is_ok());
        let is_reply = is_reply(&parsed);
        self.replies += usize::from(is_reply);
        if is_text && !is_reply {
            let opened = project.session_for(&parsed.file, report)?;
            let fixed = fix(&opened.session, &source, DOCUMENT, args.limits());
            self.fixed += fixed.applied.len();
            for applied in &fixed.applied {
                let kind = match applied.applicability {
                    Applicability::Safe => "",
                    Applicability::Unsafe | Applicability::Shown => "unsafe ",
                };
                let verb = if args.diff { "would fix" } else { "fixed" };
                note(&format!("{verb} {}: {} ({kind}{})", found.name, applied.title, applied.code));
            }
            if args.diff {
                if !fixed.applied.is_empty() {
                    report.out.text(&diff(&found.name, &source.text, &fixed.text));
                }
                return Ok(found);
            }
            if !fixed.applied.is_empty() {
                if let Some(path) = &found.path {
                    replace_file(path, &fixed.text)?;
                }
                found.bytes = Bytes::All(fixed.text.into_bytes());
            }
        }
        if let (true, false, Bytes::All(bytes)) = (is_stdin, args.diff, &found.bytes) {
            report.out.text(&String::from_utf8_lossy(bytes));
        }
        Ok(found)
    }

    fn add(
        &mut self,
        found: &Document,
        project: &mut Project,
        report: &mut Report,
        progress: &Progress,
    ) -> Result<(), CliError> {
        self.documents += 1;
        let (source, parsed) = found.parse();
        let has_scene = project.has_scene();
        let opened = project.session_for(&parsed.file, report)?;
        if opened.robot.is_none() && parsed.file.runnable().next().is_some() {
            self.without_robot += usize::from(named_robot(&parsed.file).is_none());
        }
        let checked = opened.session.check_document(&parsed);
        for policy in &checked.policies {
            self.unseen += policy.skipped_motions;
            self.motions += policy.graph.as_ref().map_or(0, deferred_motions);
        }
        if let Bytes::All(bytes) = &found.bytes {
            progress.advance(bytes.len());
        }
        self.left += checked.deferred_notes.len();
        // Without a scene nearly everything is left to the run.
        let lists_left = self.denies_deferred || has_scene;
        let left = checked.deferred_notes.into_iter().filter(|_| lists_left);
        let diagnostics: Vec<_> = checked.diagnostics.into_iter().chain(left).collect();
        if !diagnostics.is_empty() {
            let sources = opened.sources(source);
            progress.suspend(|| report.print(&diagnostics, &sources));
        }
        Ok(())
    }

    /// Returns whether anything is left to the run.
    fn is_deferred(&self) -> bool {
        self.left + self.motions > 0
    }

    fn print(&self, project: &Project, skipped: &[PathBuf]) {
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
        let (motions, unseen) = match project.has_scene() {
            true => (self.motions, self.unseen),
            false => (self.motions + self.unseen, 0),
        };
        if unseen > 0 {
            note(&format!("note: {} not checked because of earlier errors", were(unseen)));
        }
        if motions > 0 {
            let (what, why) = match (project.has_scene(), project.has_geometry()) {
                (false, _) => ("not checked", ", because no scene was given (--scene NAME)"),
                (true, false) => ("not checked", ""),
                (true, true) => ("deferred to the run", " (`motet compile --emit tree` shows the reasons)"),
            };
            note(&format!("note: {} {what}{why}", were(motions)));
        }
        if self.left > 0 && !project.has_scene() && !self.denies_deferred {
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

/// Number of motions that the compiler deferred to the run.
pub(crate) fn deferred_motions(graph: &Graph) -> usize {
    let is_deferred = |kind: &NodeKind| {
        let NodeKind::Call(call) = kind else { return false };
        call.motion.as_ref().is_some_and(|motion| motion.verdict == Verdict::Deferred)
    };
    graph.nodes.iter().filter(|node| is_deferred(&node.kind)).count()
}
