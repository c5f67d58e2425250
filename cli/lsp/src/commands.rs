//! Commands of code lenses: a run in simulation, and the motions of a policy with a drawing.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use motet::feasible::decide_in;
use motet_geometry::planning::{MotionQuery, RobotModel};
use motet_graph::{Graph, Motion, NodeKind, Term, Value, Verdict};
use motet_planner::runtime_check::CheckMode;
use motet_project::{Discard, SimulationInputs};
use motet_runtime::{Driver as _, EngineSettings, RunControl, RunEnd, Time};
use motet_syntax::{Severity, Sources};
use serde_json::json;

use crate::checker::Snapshot;

/// Result of a command.
#[derive(Clone, Debug)]
pub(crate) struct CommandResult {
    /// Sentence for the person who chose the command.
    pub(crate) summary: String,
    pub(crate) is_success: bool,
    /// Drawing as SVG, if there is one.
    pub(crate) drawing: Option<String>,
    /// The same for programs.
    pub(crate) value: serde_json::Value,
}

/// Runs a policy in simulation, as fast as possible, on the unsaved text.
///
/// # Errors
///
/// A clause that says why it cannot be run.
pub(crate) fn run(
    snapshot: &Snapshot,
    policy: &str,
    is_stopped: &AtomicBool,
) -> Result<CommandResult, String> {
    let opened = snapshot.session.as_ref().map_err(Clone::clone)?;
    let graph = compiled(snapshot, policy)?;
    let inputs = SimulationInputs::with_seed(0);
    let document = &snapshot.parsed.file;
    let (mut simulator, _) =
        motet::run::simulator(opened, (&graph, document), inputs).map_err(|error| error.to_string())?;
    let run = motet::run::run_id();
    let _begun = simulator.begin_run(Time::ZERO, &run, Some(&graph));
    let plan = motet::run::RunPlan {
        opened,
        graph: &graph,
        run: &run,
        verifies: CheckMode::AtOnce,
        settings: EngineSettings::default(),
        record: None,
        looks_every: Time::from_secs(1.0),
    };
    let recorded = motet::run::recorded(&plan, &mut simulator, &mut || {
        if is_stopped.load(Ordering::Relaxed) { RunControl::Stop } else { RunControl::Continue }
    });
    let recorded = recorded.map_err(|error| error.to_string())?;
    let is_success = matches!(recorded.end, RunEnd::Done { .. });
    let summary = format!("`{policy}` in simulation: {} after {}", recorded.end, recorded.at);
    let value = json!({"end": recorded.end, "secs": recorded.at.secs(), "events": recorded.events});
    Ok(CommandResult { summary, is_success, drawing: None, value })
}

/// Graph of a policy of the unsaved text.
fn compiled(snapshot: &Snapshot, policy: &str) -> Result<Graph, String> {
    let opened = snapshot.session.as_ref().map_err(Clone::clone)?;
    let compiled = opened.session.compile(&snapshot.parsed, Some(policy));
    compiled.graph.ok_or_else(|| {
        let mut errors = compiled.diagnostics.iter().filter(|found| found.severity == Severity::Error);
        match errors.next() {
            Some(error) => {
                let (line, _) = snapshot.source.line_column(error.span.start);
                format!("`{policy}` has errors: line {line}: {}", error.message)
            }
            None => format!("there is no policy `{policy}`"),
        }
    })
}

/// Lists the verdicts on the motions of a policy, each where it stands in the policy, and draws those that
/// name their things from the start of the scene.
///
/// # Errors
///
/// A clause that says why no motion can be decided.
pub(crate) fn feasible(
    snapshot: &Snapshot,
    policy: &str,
    is_stopped: &AtomicBool,
) -> Result<CommandResult, String> {
    let opened = snapshot.session.as_ref().map_err(Clone::clone)?;
    let (Some(robot), Some(files), Some(scene)) = (&opened.robot, &opened.files, &opened.scene) else {
        return Err("motions need a robot and a scene: name both in `motet.toml`".to_owned());
    };
    let body = files.body(robot, &mut Sources::default(), &mut Discard).map_err(|error| error.to_string())?;
    let urdf = body.ok_or_else(|| format!("the card of `{}` names no body", robot.name))?;
    let graph = compiled(snapshot, policy)?;
    let motions: Vec<&Motion> = graph
        .nodes
        .iter()
        .filter_map(|node| match &node.kind {
            NodeKind::Call(call) => call.motion.as_ref(),
            _ => None,
        })
        .collect();
    let mut verdicts = Vec::new();
    let (mut queries, mut seen) = (Vec::new(), BTreeSet::new());
    for motion in &motions {
        let query = query(motion);
        let name = query.as_ref().map_or_else(|| motion.query.to_string(), ToString::to_string);
        let verdict = match motion.verdict {
            Verdict::Proven => "feasible".to_owned(),
            Verdict::Deferred => match &motion.why {
                Some(why) => format!("left to the run: {why}"),
                None => "left to the run".to_owned(),
            },
        };
        verdicts.push(json!({"motion": name, "verdict": verdict}));
        queries.extend(query.filter(|query| seen.insert(query.to_string())));
    }
    let machine = RobotModel::new(robot, &urdf);
    let mut from_start = Vec::new();
    let drawing = decide_in((&machine, scene), queries, 1, &mut |verdict| {
        from_start.push(verdict.text.trim_end().to_owned());
        if is_stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let proven = motions.iter().filter(|motion| motion.verdict == Verdict::Proven).count();
    let summary = format!("`{policy}`: {proven} of {} motions are proven feasible", motions.len());
    let value = json!({"motions": verdicts, "from_start": from_start});
    Ok(CommandResult { summary, is_success: proven == motions.len(), drawing: Some(drawing), value })
}

/// Query of a motion whose arguments are named; `None` for one that only the run knows.
fn query(motion: &Motion) -> Option<MotionQuery> {
    let mut names = Vec::new();
    for arg in &motion.args {
        match arg {
            Term::Literal(Value::Entity(id)) => names.push(id.clone()),
            Term::Literal(Value::Case(_)) => {}
            _ => return None,
        }
    }
    MotionQuery::from_call(&motion.query, names, None)
}
