//! Chores of the workspace. `cargo run -p xtask -- house` measures the code against `xtask/house.toml`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a chore reports on its output")]

mod house;

use std::path::Path;
use std::process::ExitCode;

/// The usage text.
const USAGE: &str = "usage: cargo run -p xtask -- house [--list MEASURE] [--under FOLDER]

house   measures the code and compares each figure with its limit in xtask/house.toml
        --list MEASURE   prints the places that a measure counts, such as `wh-docs`
        --under FOLDER   reads one folder only, without limits";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let result = match words.as_slice() {
        ["house", options @ ..] => house::run(&root, options),
        _ => Err(USAGE.to_owned()),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}
