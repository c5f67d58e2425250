//! `motet schema`: the JSON Schema of a file format, generated from the types that read it.

use crate::args::{SchemaArgs, SchemaOf};
use crate::exit::{Exit, Trouble};
use crate::out::Out;
use crate::report;

/// Runs the command.
///
/// # Errors
///
/// Standard output cannot be written.
pub(crate) fn run(args: &SchemaArgs) -> Result<Exit, Trouble> {
    let schema = match args.of {
        SchemaOf::Policy => motet_syntax::json::policy_schema(),
        SchemaOf::Scene => motet_robots::scene::schema(),
        SchemaOf::Robot => motet_robots::card::schema(),
        SchemaOf::Diagnostic => schemars::schema_for!(motet_syntax::render::DiagnosticRecord),
        SchemaOf::Driver => motet_host::remote::protocol::schema(),
        SchemaOf::Journal => schemars::schema_for!(motet_runtime::journal::JournalEntry),
        SchemaOf::Faults => schemars::schema_for!(motet_sim::Faults),
    };
    let text = serde_json::to_string_pretty(&schema)
        .map_err(|error| Trouble::Other(format!("the schema cannot be written: {error}")))?;
    let mut out = Out::default();
    out.line(&text);
    report::close(&mut out, Ok(Exit::Clean))
}
