//! `motet run --check`: leads a driver in another process through the scenes of the conformance suite.

use std::ops::ControlFlow;
use std::path::Path;

use motet::conformance::{self, DriverResult, DriverScene, SAY, first_call};
use motet::run::{run_id, state_facts};
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverLog, DriverTimeouts, RemoteDriver};
use motet_project::files::Bytes;
use motet_runtime::Time;
use serde_json::json;

use super::{CompiledPolicy, RunArgs, compile};
use crate::documents::{Document, one_document};
use crate::error::{CliError, Exit};
use crate::flags::{OutputFormat, folder_of};
use crate::interrupt::{guard_runs, is_interrupted};
use crate::output::queue::WhenFull;
use crate::output::{count, escape, note};
use crate::ready_driver::{WithErrors, address};
use crate::report::Report;

/// Robot whose `say` a check uses where none is named.
const ROBOT: &str = "hsr";

/// Runs the scenes and prints the laws that are broken.
pub(super) fn check(file: Option<&Path>, args: &RunArgs, report: &mut Report) -> Result<Exit, CliError> {
    let folder = file.map_or(Path::new("."), folder_of);
    let settings = args.session.project_in(folder)?;
    let has_robot = settings.robot_name().is_some();
    let mut project = settings.open_with(report)?;
    let document = match file {
        Some(file) => one_document(file)?,
        None => test_policy(has_robot),
    };
    let compiled = compile(&document, args.policy.as_deref(), args.format, &mut project, report)?;
    let Some(CompiledPolicy { graph, parsed, opened, .. }) = compiled else { return Ok(Exit::Findings) };
    let command = first_call(&graph).map_err(CliError::Message)?;
    let Some(address) = address(&args.driver, &args.session.environment.or_of(&opened), &parsed.file)? else {
        let why = "`--check` leads a driver in another process: name it with `--driver`";
        return Err(CliError::Message(why.to_owned()));
    };
    guard_runs(WhenFull::GoOn)?;
    let mut connect = |log: Box<dyn DriverLog>| {
        let mut hello = Hello { state: state_facts(&opened), ..Hello::of(&graph, &run_id()) };
        if file.is_none() && !has_robot {
            hello.robot.clear();
        }
        let log = Box::new(WithErrors(log));
        let patience = DriverTimeouts { is_over: is_interrupted, ..DriverTimeouts::default() };
        RemoteDriver::connect(address.clone(), hello, patience, Time::ZERO, log)
            .map_err(|breakage| format!("{} ({})", escape(&breakage.to_string()), address))
    };
    let said = command.to_string();
    let log = Box::new(|text: &str| note(&escape(text)));
    let result = conformance::check(command, args.patience, log, &mut connect, &mut |scene| {
        // What was broken off says nothing about the driver.
        if is_interrupted() {
            return ControlFlow::Break(());
        }
        print_scene(&scene, args.format, report);
        if report.out.is_closed() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if is_interrupted() || report.out.is_closed() {
        return Ok(Exit::Interrupted);
    }
    let DriverResult { driver, broken } = result.map_err(CliError::Message)?;
    if args.format == OutputFormat::Human {
        let result = match broken {
            0 => "keeps the laws".to_owned(),
            broken => format!("breaks {} ", count(broken, "law")).trim_end().to_owned(),
        };
        report.out.line(&format!("{driver} {result}, with {said}"));
    }
    Ok(if broken == 0 { Exit::Success } else { Exit::Findings })
}

/// Policy of a check without a file.
fn test_policy(has_robot: bool) -> Document {
    let of = if has_robot { String::new() } else { format!(" for {ROBOT}") };
    let text = format!("policy conformance{of} {SAY}\n");
    Document { name: "conformance".to_owned(), line_of: None, path: None, bytes: Bytes::All(text.into()) }
}

fn print_scene(scene: &DriverScene, format: OutputFormat, report: &mut Report) {
    let DriverScene { name, broken, messages } = scene;
    match format {
        OutputFormat::Human if broken.is_empty() => report.out.line(&format!("✓ {name}")),
        OutputFormat::Human => {
            for (law, told) in broken {
                report.out.line(&format!("✗ {name}: {law}: {}", escape(told)));
            }
            for line in messages {
                report.out.line(&format!("    {line}"));
            }
        }
        OutputFormat::Json => {
            let laws: Vec<_> = broken.iter().map(|(law, told)| json!({"law": law, "told": told})).collect();
            let messages = if broken.is_empty() { None } else { Some(messages) };
            report.out.json_line(&json!({"scene": name, "broken": laws, "messages": messages}).to_string());
        }
    }
}
