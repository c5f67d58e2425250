//! The evaluation by itself, without the compiler's:
//! `reach [SCENE] [--robot NAME] [--rooms N] [--seed S] [--quick] [--cells N] [--unjudged]
//! [--witnesses FILE] [--json]`.
//! The same as `eval reach`.

use std::io::Write as _;
use std::process::ExitCode;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    match motet_reach::command(&args) {
        Ok((text, is_good)) => {
            let _ = writeln!(std::io::stdout(), "{text}");
            if is_good { ExitCode::SUCCESS } else { ExitCode::from(1) }
        }
        Err(problem) => {
            let _ = writeln!(std::io::stderr(), "reach: {problem}");
            ExitCode::from(2)
        }
    }
}
