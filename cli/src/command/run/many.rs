//! `motet run` with a file of policies: checks and simulates each of them, on several threads, with one line
//! of JSON for each.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use motet::batch;
use motet::run::events::outcome;
use motet::run::{engine, start_state};
use motet_graph::Graph;
use motet_planner::runtime_check::{CheckMode, Guard};
use motet_project::{ProjectSession, SimulationInputs, named_robot};
use motet_runtime::{Driver as _, Effect, EngineSettings, Event, RunEnd, Time};
use motet_sim::Sim;
use motet_syntax::{Parsed, Severity, render};
use serde_json::{Value, json};

use super::RunArgs;
use crate::documents::{self, Document};
use crate::error::{CliError, Exit};
use crate::flags::{DriverChoice, Speed, folder_of};
use crate::interrupt::{catch_interrupts, is_interrupted};
use crate::output::{count_irregular, note};
use crate::projects::Projects;
use crate::ready_driver::no_robot;
use crate::report::{Progress, Report};
use crate::result_file::ResultFile;
use crate::run_view::View;
use crate::runner::{PacedView, exit_of};
use crate::shared_sessions::{SharedSession, SharedSessions};

/// Outcome of a policy that the check refuses.
const REFUSED: &str = "refused";

/// Is `true` for a file with one policy per line.
pub(super) fn is_lines(file: &Path) -> bool {
    file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("jsonl"))
}

/// Refuses flags that mean nothing for one policy, or for many.
pub(super) fn refuse_flags(args: &RunArgs) -> Result<(), CliError> {
    let is_many = args.file.as_deref().is_some_and(is_lines);
    let wrong = |flag: &str, why: &str| Err(CliError::Message(format!("`{flag}` {why}")));
    if !is_many {
        return match (&args.results.out, args.jobs.is_given()) {
            (Some(_), _) => wrong("--out", "is for a .jsonl file of policies; `--record` keeps one run"),
            (None, true) => wrong("--jobs, --shard", "are for a .jsonl file of policies"),
            (None, false) => Ok(()),
        };
    }
    let simulated = "is not for a .jsonl file of policies, which are simulated at full speed";
    if args.driver.driver != DriverChoice::Kinematic {
        return wrong("--driver", simulated);
    }
    if args.driver.speed.is_some_and(|speed| speed != Speed::Max) {
        return wrong("--speed", simulated);
    }
    if args.record.is_some() {
        return wrong("--record", "is for one policy; `--out` keeps the results of a .jsonl file");
    }
    if args.words.live || !args.words.say.is_empty() {
        return wrong("--say, --live", simulated);
    }
    if args.check {
        return wrong("--check", "is for one policy");
    }
    Ok(())
}

/// Result of one policy.
struct PolicyRun {
    session: Arc<SharedSession>,
    /// Members of its line; `None` if it was interrupted.
    line: Option<Value>,
    exit: Exit,
}

/// Runs the policies of a file.
pub(super) fn run(file: &Path, args: &RunArgs, report: &mut Report) -> Result<Exit, CliError> {
    let inputs = documents::collect(&[file.to_owned()])?;
    let mut projects = Projects::new(&args.session);
    projects.of(folder_of(file), report)?;
    let simulation = args.driver.inputs(None, report)?;
    let flags = format!("run {:?} {:?} {:?}", args.session, args.driver, args.policy);
    let results = RefCell::new(ResultFile::open(&args.results, &flags)?);
    let progress = Progress::new(usize::MAX, inputs.size, "running");
    let runs = Runs { args, simulation, sessions: SharedSessions::new(projects) };
    catch_interrupts()?;
    let shard = args.jobs.shard();
    let found = inputs.documents().enumerate().filter_map(|(index, found)| {
        let due = |found| ResultFile::due(&results, shard.has(index), found, &progress);
        found.and_then(due).transpose()
    });
    let (mut worst, mut tally, mut policies) = (Exit::Success, [0_usize; 2], 0_usize);
    let work = |found: Result<(Option<_>, Document), CliError>| {
        found.and_then(|(done, found)| match done {
            Some(done) => Ok((Err(done), found)),
            None => Ok((Ok(runs.run(&found)?), found)),
        })
    };
    let ended = batch::in_order(args.jobs.jobs(), 1, found, work, |ran| {
        let (ran, found) = match ran {
            Ok(ran) => ran,
            Err(error) => return ControlFlow::Break(Some(error)),
        };
        let exit = match ran {
            Err(done) => {
                progress.skip(found.size());
                let is_done = done.line.get("outcome").and_then(Value::as_str) == Some("done");
                let is_refused = done.line.get("outcome").and_then(Value::as_str) == Some(REFUSED);
                if is_done {
                    Exit::Success
                } else if is_refused {
                    Exit::Findings
                } else {
                    Exit::Failed
                }
            }
            Ok(PolicyRun { line: None, .. }) => return ControlFlow::Break(None),
            Ok(PolicyRun { session, line: Some(line), exit }) => {
                progress.advance(found.size());
                let added = session.announce(report).and_then(|()| match &mut *results.borrow_mut() {
                    Some(results) => {
                        let checksum = results.checksum(&found);
                        results.add(&found.name, &checksum, line)
                    }
                    None => {
                        let mut all = json!({"document": found.name});
                        if let (Value::Object(all), Value::Object(line)) = (&mut all, line) {
                            all.extend(line);
                        }
                        progress.suspend(|| report.out.json_line(&all.to_string()));
                        Ok(())
                    }
                });
                if let Err(error) = added {
                    return ControlFlow::Break(Some(error));
                }
                exit
            }
        };
        policies += 1;
        let [done, refused] = &mut tally;
        *done += usize::from(exit == Exit::Success);
        *refused += usize::from(exit == Exit::Findings);
        worst = worst.or_worse(exit);
        if report.out.is_closed() { ControlFlow::Break(None) } else { ControlFlow::Continue(()) }
    });
    drop(progress);
    if let ControlFlow::Break(Some(error)) = ended {
        return Err(error);
    }
    let [done, refused] = tally;
    let failed = policies - done - refused;
    note(&format!(
        "ran {}: {done} done, {failed} not done, {refused} refused",
        count_irregular(policies, "policy", "policies")
    ));
    Ok(if is_interrupted() { Exit::Interrupted } else { worst })
}

/// Inputs of all runs.
struct Runs<'a> {
    args: &'a RunArgs,
    simulation: SimulationInputs,
    sessions: SharedSessions<'a>,
}

impl Runs<'_> {
    /// Checks and simulates a policy.
    fn run(&self, found: &Document) -> Result<PolicyRun, CliError> {
        let (source, parsed) = found.parse();
        let session = self.sessions.session_for(&found.folder(), &parsed.file);
        let Some(opened) = session.session.clone() else {
            return Ok(PolicyRun { session, line: Some(Value::Null), exit: Exit::CouldNotRun });
        };
        let compiled = opened.session.compile(&parsed, self.args.policy.as_deref());
        let Some(graph) = compiled.graph else {
            let lines = render::json(&compiled.diagnostics, &opened.sources(source));
            let lines = lines.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
            let is_error = |found: &&motet_syntax::Diagnostic| found.severity == Severity::Error;
            let line = json!({
                "outcome": REFUSED,
                "errors": compiled.diagnostics.iter().filter(is_error).count(),
                "diagnostics": lines.collect::<Vec<_>>(),
            });
            return Ok(PolicyRun { session, line: Some(line), exit: Exit::Findings });
        };
        let name = graph.policy.to_string();
        let (now, end) = self.simulate(graph, &parsed, &opened)?;
        if end == RunEnd::Interrupted && is_interrupted() {
            return Ok(PolicyRun { session, line: None, exit: Exit::Interrupted });
        }
        let mut line = json!({"policy": name, "seed": self.args.driver.seed(), "at": now.secs()});
        if let (Value::Object(line), Value::Object(end)) = (&mut line, outcome(&end)) {
            line.extend(end);
        }
        Ok(PolicyRun { session, line: Some(line), exit: exit_of(&end) })
    }

    fn simulate(
        &self,
        graph: Graph,
        parsed: &Parsed,
        opened: &ProjectSession,
    ) -> Result<(Time, RunEnd), CliError> {
        let Some(robot) = &opened.robot else { return Err(no_robot(named_robot(&parsed.file))) };
        let eye = opened.geometry.as_ref().and_then(|geometry| geometry.eye());
        let inputs = self.simulation.clone().with_eye(eye);
        inputs.check_names(&opened.session.signatures())?;
        let declarations: Vec<_> = opened.domains.iter().chain([&parsed.file]).collect();
        let options = inputs.for_policy(&graph, &declarations).with_facts(opened.told_facts());
        let scene = opened.scene.clone().unwrap_or_default();
        let mut driver = Sim::new(robot, &scene, options);
        let guard = opened.session.world_tracker().map(|course| Guard::new(course, CheckMode::AtOnce));
        let start = start_state(opened.scene.as_ref());
        let settings = EngineSettings::default();
        let mut engine = engine(graph, &start, driver.capabilities(), guard.as_ref(), settings)?;
        let mut view =
            PacedView::new(Box::new(Unseen), Speed::Max).with_guard(guard).with_room(opened.scene.clone());
        let end = motet_runtime::run(&mut engine, &mut driver, &mut view, Time::ZERO);
        Ok((view.now(), end))
    }
}

/// View that shows nothing.
struct Unseen;

impl View for Unseen {
    fn effect(&mut self, _now: Time, _effect: &Effect) {}
    fn event(&mut self, _event: &Event) {}
    fn past(&mut self, _now: Time, _effect: &Effect) {}
    fn reached(&mut self, _now: Time) {}
    fn is_closed(&self) -> bool {
        false
    }
    fn finish(&mut self, _now: Time, _end: &RunEnd) {}
}
