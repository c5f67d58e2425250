//! `motet export btcpp`: a policy as a behaviour tree of BehaviorTree.CPP 4.

use std::path::PathBuf;

use clap::Args;

use crate::documents::one_document;
use crate::error::{CliError, Exit};
use crate::flags::{FormatArgs, SessionArgs, folder_of};
use crate::output::{Colors, note};
use crate::report::Report;

/// Flags of `motet export btcpp`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  \
    motet export btcpp inspection_round.motet --robot anymal_z1 --scene lab -o inspection_round.xml")]
pub(super) struct BtcppArgs {
    /// Policy file, or `-` for stdin
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Policy to export; required if the file has several
    #[arg(long, value_name = "NAME")]
    policy: Option<String>,
    #[command(flatten)]
    session: SessionArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// Runs the command.
pub(super) fn run(args: &BtcppArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.format, colors, |report| {
        if args.output.is_none() {
            report.hold();
        }
        let (source, parsed) = one_document(&args.file)?.parse();
        let mut project = args.session.project_in(folder_of(&args.file))?.open_with(report)?;
        let opened = project.session_for(&parsed.file, report)?;
        let compiled = opened.session.compile(&parsed, args.policy.as_deref());
        report.print(&compiled.diagnostics, &opened.sources(source));
        let Some(graph) = compiled.graph else { return Ok(Exit::Findings) };
        match motet_btcpp::export(&graph, &opened.session.signatures().leaves()) {
            Ok(text) => {
                report.out.file(args.output.as_deref(), &text, false)?;
                Ok(Exit::Success)
            }
            Err(refused) => {
                for part in refused {
                    note(&format!("error: {}: {part}", args.file.display()));
                }
                Ok(Exit::Findings)
            }
        }
    })
}
