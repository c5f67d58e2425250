//! `motet import btcpp`: a behaviour tree of BehaviorTree.CPP 4 as a policy.

use std::path::PathBuf;

use clap::Args;
use motet::document;
use motet_project::DOCUMENT;
use motet_project::files::{add_source, read_small};
use motet_syntax::ast::File;
use motet_syntax::{Parsed, Severity, Sources, Syntax};

use crate::error::{CliError, Exit};
use crate::flags::{FormatArgs, SessionArgs};
use crate::report::Report;

/// Flags of `motet import btcpp`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  \
    motet import btcpp fetch.xml --robot hsr --scene kitchen -o fetch.motet")]
pub(super) struct BtcppArgs {
    /// XML file of the trees; the leaves are the primitives, fluents and measures of the robot
    #[arg(value_name = "XML")]
    trees: PathBuf,
    /// File to write [default: stdout]
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    #[command(flatten)]
    session: SessionArgs,
    #[command(flatten)]
    pub(super) format: FormatArgs,
}

/// Runs the command: writes the policy, and prints what its check finds with the places in the XML.
pub(super) fn run(args: &BtcppArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project_here()?.open_with(report)?;
    let opened = project.session_for(&File::default(), report)?;
    let mut read = Sources::default();
    let (source, file, broken) =
        add_source(&args.trees.display().to_string(), &read_small(&args.trees)?, &mut read);
    if !broken.is_empty() {
        report.print(&broken, &read);
        return Ok(Exit::Findings);
    }
    debug_assert_eq!(file, DOCUMENT, "the first source of its own");
    let (policy, diagnostics) = motet_btcpp::import(&source, DOCUMENT, &opened.session.signatures().leaves());
    let sources = opened.sources(source.clone());
    report.print(&diagnostics, &sources);
    let Some(policy) = policy else { return Ok(Exit::Findings) };
    let text = source.text.clone();
    let parsed = Parsed { file: policy, syntax: Syntax::Text, text, diagnostics: Vec::new(), written: None };
    let written = document::write(&parsed, None, opened.session.library(), Syntax::Text);
    let mut found = opened.session.check(&parsed);
    for finding in &mut found {
        // An edit of a policy does not fit the XML.
        finding.fix = None;
    }
    report.print(&found, &sources);
    match written {
        Ok(text) => report.out.file(args.output.as_deref(), &text, false)?,
        Err(why) => return Err(CliError::Message(why)),
    }
    let is_refused = found.iter().any(|finding| finding.severity == Severity::Error);
    Ok(if is_refused { Exit::Findings } else { Exit::Success })
}
