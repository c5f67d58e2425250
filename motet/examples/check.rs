//! Checks a policy file against a robot in a scene: `cargo run -p motet --example check --
//! examples/fetch_mug.motet`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example prints")]

use std::process::ExitCode;

use motet::Motet;

fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "examples/fetch_mug.motet".to_owned());
    let motet = Motet::open("hsr", "kitchen")?;
    match motet.compile(&std::fs::read_to_string(&path)?) {
        Ok(policy) => {
            println!("{path}: no errors, {} steps", policy.graph().nodes.len());
            Ok(ExitCode::SUCCESS)
        }
        Err(error) => {
            eprint!("{}", error.render(100));
            Ok(ExitCode::FAILURE)
        }
    }
}
