//! Compares the compiler's verdicts with other people's: `eval SUITE FILE [--json]`.
//!
//! Prints a line a disagreement and a summary object at the end; exits 0 where every verdict agrees, else 1.

use std::io::Write as _;
use std::process::ExitCode;

use motet_tests::eval::{Judged, planbench, saycan, scenarios, summary};

/// Judges a line of a file.
type Judge = fn(&str) -> Result<Judged, String>;

const SUITES: &[(&str, Judge)] =
    &[("planbench", planbench::judge), ("scenarios", scenarios::judge), ("saycan", saycan::judge)];

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(problem) => {
            let _ = writeln!(std::io::stderr(), "eval: {problem}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<bool, String> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let only_json = args.iter().any(|arg| arg == "--json");
    let words: Vec<&str> = args.iter().map(String::as_str).filter(|arg| *arg != "--json").collect();
    let usage = || {
        let names: Vec<_> = SUITES.iter().map(|(name, _)| *name).collect();
        format!("usage: eval {} FILE [--json]", names.join("|"))
    };
    let [suite, file] = words.as_slice() else { return Err(usage()) };
    let Some((_, judge)) = SUITES.iter().find(|(name, _)| name == suite) else { return Err(usage()) };
    let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    let mut rows = Vec::new();
    for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        rows.push(judge(line).map_err(|error| format!("{file}:{}: {error}", index + 1))?);
    }
    let mut out = std::io::stdout().lock();
    let mut print = |line: String| writeln!(out, "{line}").map_err(|error| error.to_string());
    for line in rows.iter().filter(|_| !only_json).filter_map(Judged::disagreement) {
        print(line)?;
    }
    let summary = summary(&rows);
    print(serde_json::to_string(&summary).map_err(|error| error.to_string())?)?;
    Ok(summary.agree == summary.total)
}
