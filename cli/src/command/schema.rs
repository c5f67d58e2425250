//! `motet schema`: the JSON Schema of a file format, derived from the types that read it.

use clap::{Args, ValueEnum};

use crate::error::{CliError, Exit};
use crate::output::Output;
use crate::report;

/// Flags of `motet schema`.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  motet schema policy > policy.schema.json")]
pub(crate) struct SchemaArgs {
    /// File format to describe
    #[arg(value_enum, value_name = "FORMAT")]
    of: FileFormat,
}

/// File formats with a schema.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum FileFormat {
    /// Policy in JSON
    Policy,
    /// Scene of a room
    Scene,
    /// Robot card (robot.toml, as JSON)
    Robot,
    /// Diagnostic, as `--format json` prints it
    Diagnostic,
    /// Message between host and driver (docs/drivers.md)
    Driver,
    /// Line of a journal (docs/journal.md)
    Journal,
    /// File for `motet run --faults` (docs/runtime.md)
    Faults,
}

/// Runs the command.
pub(crate) fn run(args: &SchemaArgs) -> Result<Exit, CliError> {
    let schema = match args.of {
        FileFormat::Policy => motet_syntax::json::policy_schema(),
        FileFormat::Scene => motet_robots::scene::schema(),
        FileFormat::Robot => motet_robots::card::schema(),
        FileFormat::Diagnostic => schemars::schema_for!(motet_syntax::render::DiagnosticRecord),
        FileFormat::Driver => motet_host::remote::protocol::schema(),
        FileFormat::Journal => schemars::schema_for!(motet_runtime::journal::JournalEntry),
        FileFormat::Faults => schemars::schema_for!(motet_sim::Faults),
    };
    let text = serde_json::to_string_pretty(&schema)
        .map_err(|error| CliError::Message(format!("cannot write the schema: {error}")))?;
    let mut out = Output::default();
    out.json_line(&text);
    report::close(&mut out, Ok(Exit::Success))
}
