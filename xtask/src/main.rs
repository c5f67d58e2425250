//! Chores of the workspace: `house` measures the code against `xtask/house.toml`, `docs` checks the
//! documentation, `dependencies` compares licences and versions with lists.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a chore reports on its output")]

mod dependencies;
mod docs;
mod house;

use std::path::Path;
use std::process::ExitCode;

/// The usage text.
const USAGE: &str = "usage: cargo run -p xtask -- house [--list MEASURE] [--under FOLDER]
       cargo run -p xtask -- docs MOTET [PAGE]
       cargo run -p xtask -- dependencies [--advisories FOLDER | --sbom FILE]

dependencies
        compares the licences of all dependencies with those that deny.toml permits
        --advisories FOLDER   compares their versions with a checkout of rustsec/advisory-db
        --sbom FILE           writes a list of them, CycloneDX 1.5
docs    runs the commands of the README and the book with the binary MOTET, and follows their links
house   measures the code and compares each figure with its limit in xtask/house.toml
        --list MEASURE   prints the places that a measure counts, such as `wh-docs`
        --under FOLDER   reads one folder only, without limits";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let result = match words.as_slice() {
        ["house", options @ ..] => house::run(&root, options),
        ["dependencies", options @ ..] => dependencies::run(&root, options),
        ["docs", motet] => docs::run(&root, Path::new(motet), None),
        ["docs", motet, page] => docs::run(&root, Path::new(motet), Some(page)),
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
