//! `motet run --check`: leads a driver in another process through the scenes of the conformance suite.

use std::cell::RefCell;
use std::collections::{BTreeSet, VecDeque};
use std::ops::ControlFlow;
use std::path::Path;
use std::rc::Rc;

use motet::run::run_id;
use motet_graph::Graph;
use motet_host::remote::protocol::Hello;
use motet_host::remote::{DriverLog, DriverTimeouts, LineFrom, RemoteDriver};
use motet_project::files::Bytes;
use motet_runtime::conformance::{ConformanceSubject, LawViolation, check_scenes};
use motet_runtime::{
    Command, Driver, DriverClock, DriverEvent, Effect, Engine, Event, GoalId, Pattern, Query, StartState,
    Time,
};
use motet_stdlib::lang;
use serde_json::json;
use smol_str::SmolStr;

use super::{CompiledPolicy, RunArgs, compile};
use crate::documents::{Document, one_document};
use crate::error::{CliError, Exit};
use crate::flags::OutputFormat;
use crate::interrupt::{catch_interrupts, is_interrupted};
use crate::output::{count, escape, note};
use crate::ready_driver::address;
use crate::report::Report;

/// Policy whose call harms nothing and nobody.
const SAY: &str = "{ say(\"This is a test.\") }";
/// Robot whose `say` a check uses where none is named.
const ROBOT: &str = "hsr";
/// Seconds within which a driver answers a question, and nothing changes of its own accord.
const MOMENT_SECS: f64 = 1.0;
/// Seconds that a call may take on the wall.
const PATIENCE_SECS: f64 = 5.0;
/// The most lines that are shown of a scene, and the most characters of a line.
const SHOWN: (usize, usize) = (24, 240);

/// Messages of a scene, and the promises that were broken besides the laws.
#[derive(Default)]
struct Transcript {
    lines: VecDeque<String>,
    breaches: BTreeSet<String>,
    /// Reason why the driver could not be reached.
    unreachable: Option<String>,
}

impl Transcript {
    fn push(&mut self, mark: char, line: &str) {
        let (most, letters) = SHOWN;
        if self.lines.len() == most {
            self.lines.pop_front();
        }
        let more = if line.chars().nth(letters).is_some() { "…" } else { "" };
        let beginning: String = line.chars().take(letters).collect();
        self.lines.push_back(format!("{mark} {}{more}", escape(&beginning)));
    }
}

/// Log that writes a transcript.
struct TranscriptLog(Rc<RefCell<Transcript>>);

impl DriverLog for TranscriptLog {
    fn note(&mut self, text: &str) {
        self.0.borrow_mut().push('#', text);
    }

    fn breach(&mut self, text: &str) {
        self.note(text);
        self.0.borrow_mut().breaches.insert(text.to_owned());
    }

    fn line(&mut self, from: LineFrom, line: &str) {
        let mark = if from == LineFrom::Host { '>' } else { '<' };
        self.0.borrow_mut().push(mark, line);
    }
}

/// Runs the scenes and prints the laws that are broken.
pub(super) fn check(file: Option<&Path>, args: &RunArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut project = args.session.project().open_with(report)?;
    let document = match file {
        Some(file) => one_document(file)?,
        None => test_policy(args.session.environment.robot.is_some()),
    };
    let compiled = compile(&document, args.policy.as_deref(), args.format, &mut project, report)?;
    let Some(CompiledPolicy { graph, parsed, .. }) = compiled else { return Ok(Exit::Findings) };
    let (command, query) = (first_call(&graph)?, question());
    let Some(address) = address(&args.driver, &args.session.environment, &parsed.file)? else {
        let why = "`--check` leads a driver in another process: name it with `--driver`";
        return Err(CliError::Message(why.to_owned()));
    };
    catch_interrupts()?;
    let connect = |log: Box<dyn DriverLog>| {
        let hello = Hello::of(&graph, &run_id());
        RemoteDriver::connect(address.clone(), hello, DriverTimeouts::default(), Time::ZERO, log)
            .map_err(|breakage| format!("{} ({})", escape(&breakage.to_string()), address))
    };
    let greeted = connect(Box::new(|text: &str| note(&escape(text)))).map_err(CliError::Message)?;
    let is_virtual = greeted.capabilities().clock == DriverClock::Driver;
    let name = escape(&greeted.welcome().driver);
    drop(greeted);
    let patience = match (args.patience, is_virtual) {
        (Some(secs), _) => secs,
        (None, true) => command.deadline_secs,
        (None, false) => PATIENCE_SECS,
    };
    if !(patience.is_finite() && patience > 0.0) {
        return Err(CliError::Message("`--patience` is a number of seconds above 0".to_owned()));
    }
    let transcript = Rc::new(RefCell::new(Transcript::default()));
    let mut fresh = || -> Box<dyn Driver> {
        match connect(Box::new(TranscriptLog(Rc::clone(&transcript)))) {
            Ok(driver) => Box::new(driver),
            Err(why) => {
                transcript.borrow_mut().unreachable = Some(why);
                Box::new(NoDriver)
            }
        }
    };
    let said = command.to_string();
    let mut subject = ConformanceSubject {
        fresh: &mut fresh,
        command,
        query,
        moment: Time::from_secs(MOMENT_SECS),
        patience: Time::from_secs(patience),
        is_virtual,
    };
    let (mut broken, mut unreachable) = (0, None);
    check_scenes(&mut subject, &mut |scene, violations| {
        let transcript = transcript.take();
        if transcript.unreachable.is_some() {
            unreachable = transcript.unreachable;
            return ControlFlow::Break(());
        }
        broken += violations.len() + transcript.breaches.len();
        print_scene(scene, violations, &transcript, args.format, report);
        if is_interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if let Some(why) = unreachable {
        return Err(CliError::Message(why));
    }
    if is_interrupted() {
        return Ok(Exit::Interrupted);
    }
    if args.format == OutputFormat::Human {
        let result = match broken {
            0 => "keeps the laws".to_owned(),
            broken => format!("breaks {} ", count(broken, "law")).trim_end().to_owned(),
        };
        report.out.line(&format!("{name} {result}, with {said}"));
    }
    Ok(if broken == 0 { Exit::Success } else { Exit::Findings })
}

/// Policy of a check without a file.
fn test_policy(has_robot: bool) -> Document {
    let of = if has_robot { String::new() } else { format!(" for {ROBOT}") };
    let text = format!("policy conformance{of} {SAY}\n");
    Document { name: "conformance".to_owned(), line_of: None, path: None, bytes: Bytes::All(text.into()) }
}

/// First call of a policy, if it starts before anything is observed.
fn first_call(graph: &Graph) -> Result<Command, CliError> {
    let mut engine = Engine::new(graph.clone(), &StartState::default())
        .map_err(|errors| CliError::Message(format!("the graph is not valid: {errors:?}")))?;
    let mut effects = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut effects);
    let call = effects.into_iter().find_map(|effect| match effect {
        Effect::Start { command, .. } => Some(Command::clone(&command)),
        _ => None,
    });
    call.ok_or_else(|| {
        let why = "the policy does not begin with a call, or observes something before it";
        CliError::Message(why.to_owned())
    })
}

/// Something that every robot with a hand observes, without the name of an entity.
fn question() -> Query {
    Query::Fact { fluent: SmolStr::new_static(lang::fluents::HOLDING), args: vec![Pattern::Any] }
}

fn print_scene(
    scene: &str,
    violations: &BTreeSet<LawViolation>,
    transcript: &Transcript,
    format: OutputFormat,
    report: &mut Report,
) {
    let laws = violations.iter().map(|broken| (broken.law.text(), broken.told.as_str()));
    let others = transcript.breaches.iter().map(|told| ("a driver reports only what is so", told.as_str()));
    let broken: Vec<(&str, &str)> = laws.chain(others).collect();
    match format {
        OutputFormat::Human if broken.is_empty() => report.out.line(&format!("✓ {scene}")),
        OutputFormat::Human => {
            for (law, told) in &broken {
                report.out.line(&format!("✗ {scene}: {law}: {}", escape(told)));
            }
            for line in &transcript.lines {
                report.out.line(&format!("    {line}"));
            }
        }
        OutputFormat::Json => {
            let laws: Vec<_> = broken.iter().map(|(law, told)| json!({"law": law, "told": told})).collect();
            let messages = if broken.is_empty() { None } else { Some(&transcript.lines) };
            report.out.line(&json!({"scene": scene, "broken": laws, "messages": messages}).to_string());
        }
    }
}

/// Stand-in for a driver that cannot be reached.
struct NoDriver;

impl Driver for NoDriver {
    fn start(&mut self, _: Time, _: GoalId, _: &Command) {}
    fn cancel(&mut self, _: Time, _: GoalId) {}
    fn update(&mut self, _: Time, _: GoalId, _: &Command) {}
    fn hold(&mut self, _: Time, _: GoalId) {}
    fn proceed(&mut self, _: Time, _: GoalId) {}
    fn safe_stop(&mut self, _: Time, _: GoalId) {}
    fn observe(&mut self, _: Time, _: &Query) {}
    fn watch(&mut self, _: Time, _: &Query) {}
    fn unwatch(&mut self, _: Time, _: &Query) {}
    fn advance(&mut self, _: Time) -> Option<(Time, DriverEvent)> {
        None
    }
}
