//! `motet explain`: the page of a diagnostic code.

use clap::Args;
use motet_compiler::explain_pages;
use motet_syntax::suggest;

use crate::error::{CliError, Exit};
use crate::output::Output;
use crate::report;

/// Flags of `motet explain`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet explain M0501")]
pub(crate) struct ExplainArgs {
    /// Code such as M0501; without one, all codes are listed
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

/// Runs the command.
pub(crate) fn run(args: &ExplainArgs) -> Result<Exit, CliError> {
    let mut out = Output::default();
    let result = match &args.code {
        Some(code) => explain(code, &mut out),
        None => {
            list(&mut out);
            Ok(Exit::Success)
        }
    };
    report::close(&mut out, result)
}

fn explain(code: &str, out: &mut Output) -> Result<Exit, CliError> {
    match explain_pages::page(code.trim()) {
        Some(page) => {
            out.line(page.text.trim_end());
            Ok(Exit::Success)
        }
        None => Err(unknown(code)),
    }
}

/// Lists each code with the title of its page.
fn list(out: &mut Output) {
    for page in explain_pages::PAGES {
        let title = page.text.lines().find(|line| line.starts_with('#')).unwrap_or_default();
        let title = title.trim_start_matches('#').trim();
        let title =
            title.strip_prefix(page.code).unwrap_or(title).trim_start_matches([':', ' ', '—', '-', '·']);
        out.line(&format!("{}  {title}", page.code));
    }
}

fn unknown(code: &str) -> CliError {
    let upper = code.trim().to_ascii_uppercase();
    let near = suggest::closest(&upper, explain_pages::PAGES.iter().map(|page| page.code));
    let help = match near {
        Some(near) => format!("did you mean `{near}`? `motet explain` lists all codes"),
        None => "a code looks like M0501; `motet explain` lists all codes".to_owned(),
    };
    CliError::Unknown { what: "diagnostic code", name: code.to_owned(), help }
}
