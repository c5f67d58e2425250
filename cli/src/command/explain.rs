//! `motet explain`: the page behind a diagnostic code.

use motet_compiler::codes;
use motet_syntax::suggest;

use crate::args::ExplainArgs;
use crate::exit::{Exit, Trouble};
use crate::out::Out;
use crate::report;

/// Runs the command.
///
/// # Errors
///
/// There is no such code.
pub(crate) fn run(args: &ExplainArgs) -> Result<Exit, Trouble> {
    let mut out = Out::default();
    let result = match &args.code {
        Some(code) => explain(code, &mut out),
        None => {
            list(&mut out);
            Ok(Exit::Clean)
        }
    };
    report::close(&mut out, result)
}

fn explain(code: &str, out: &mut Out) -> Result<Exit, Trouble> {
    match codes::page(code.trim()) {
        Some(page) => {
            out.line(page.text.trim_end());
            Ok(Exit::Clean)
        }
        None => Err(unknown(code)),
    }
}

/// Every code with the title of its page.
fn list(out: &mut Out) {
    for page in codes::PAGES {
        let title = page.text.lines().find(|line| line.starts_with('#')).unwrap_or_default();
        let title = title.trim_start_matches('#').trim();
        let title =
            title.strip_prefix(page.code).unwrap_or(title).trim_start_matches([':', ' ', '—', '-', '·']);
        out.line(&format!("{}  {title}", page.code));
    }
}

fn unknown(code: &str) -> Trouble {
    let upper = code.trim().to_ascii_uppercase();
    let near = suggest::closest(&upper, codes::PAGES.iter().map(|page| page.code));
    let help = match near {
        Some(near) => format!("did you mean `{near}`? `motet explain` lists every code"),
        None => "a code is written M0501; `motet explain` lists every code".to_owned(),
    };
    Trouble::Unknown { what: "diagnostic code", name: code.to_owned(), help }
}
