//! Mutations of the examples: a step left out, or two neighbours swapped. Of those that the check passes
//! without a word, few may fail in simulation by a need that it did not list.
//!
//! A word is an error, a warning, or a note on what is left to the run before the step that fails.

use std::path::{Path, PathBuf};

use indexmap::IndexMap;
use motet_compiler::Session;
use motet_graph::{Graph, Node, NodeKind, Verdict};
use motet_robots::builtin;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{
    Effect, EndCause, Engine, NodeEnding, Observer, RunEnd, StartState, Time, TraceEventKind, run,
};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{FileId, Severity, Source, Sources};
use serde::Serialize;
use serde_json::Value;

use crate::{Workers, setup};

/// Keys that only steps have as their first.
const STEP_KEYS: &[&str] =
    &["do", "sequence", "if", "wait", "monitor", "try", "repeat", "each", "parallel", "end"];

/// Example that was changed.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Name of the example, and what was changed: `fetch_mug: without /steps/2`.
    pub name: String,
    /// The policy in JSON.
    pub text: String,
    /// Name of the robot.
    pub robot: String,
    /// Name of the scene.
    pub scene: String,
}

/// Result for a mutant.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MutantEnd {
    /// The check refuses it.
    Refused,
    /// The check has a warning about it.
    Warned,
    /// It runs to its end, or to an end that it has chosen.
    Passed,
    /// It fails by a need, a motion or a goal that the check had left to the run.
    Listed,
    /// It fails by something that the check had not listed: the step with its failure.
    Unlisted(String),
}

/// The sums over all mutants.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Summary {
    /// Mutants.
    pub total: usize,
    /// Mutants that the check refuses.
    pub refused: usize,
    /// Mutants about which the check warns.
    pub warned: usize,
    /// Mutants that the check passes without an error or a warning.
    pub silent: usize,
    /// Silent mutants that fail by a need or a motion that was listed.
    pub listed: usize,
    /// Silent mutants that fail otherwise.
    pub unlisted: usize,
}

/// Example with its robot and its scene.
pub(crate) struct Example {
    pub(crate) name: String,
    /// The policy as text.
    pub(crate) text: String,
    pub(crate) robot: String,
    pub(crate) scene: String,
    path: PathBuf,
}

/// Examples in a folder, in the order of their names.
pub(crate) fn examples(folder: &Path) -> Result<Vec<Example>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| wrong(folder, &error))?;
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "motet"));
    paths.sort();
    let mut all = Vec::new();
    for path in paths {
        let text = std::fs::read_to_string(&path).map_err(|error| wrong(&path, &error))?;
        let words = text.split_once("Robot ").and_then(|(_, rest)| rest.split_once(", scene "));
        let named = words.and_then(|(robot, rest)| Some((robot, rest.split_once('.')?.0)));
        let (robot, scene) = named.ok_or_else(|| wrong(&path, &"it names no robot and no scene"))?;
        let (robot, scene) = (robot.to_owned(), scene.to_owned());
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        all.push(Example { name, robot, scene, text, path });
    }
    Ok(all)
}

fn wrong(path: &Path, why: &dyn std::fmt::Display) -> String {
    format!("{}: {why}", path.display())
}

/// Mutants of the examples in a folder, in the order of their names.
///
/// # Errors
///
/// A file cannot be read, or does not name its robot and its scene.
pub fn mutants(folder: &Path) -> Result<Vec<Mutant>, String> {
    let mut all = Vec::new();
    for Example { name: stem, robot, scene, path, .. } in examples(folder)? {
        let json = path.with_extension("json");
        let policy = std::fs::read_to_string(&json).map_err(|error| wrong(&json, &error))?;
        let policy: Value = serde_json::from_str(&policy).map_err(|error| wrong(&json, &error))?;
        all.extend(of_policy(&policy).into_iter().map(|(change, text)| Mutant {
            name: format!("{stem}: {change}"),
            text,
            robot: robot.clone(),
            scene: scene.clone(),
        }));
    }
    Ok(all)
}

/// Every policy that lacks one step of a policy, or has two neighbours swapped, with the change.
#[must_use]
pub fn of_policy(policy: &Value) -> Vec<(String, String)> {
    let mut places = Vec::new();
    blocks(policy, String::new(), &mut places);
    let mut found = Vec::new();
    for (place, count) in places {
        let changed = |change: &dyn Fn(&mut Vec<Value>)| {
            let mut policy = policy.clone();
            if let Some(Value::Array(steps)) = policy.pointer_mut(&place) {
                change(steps);
            }
            policy.to_string()
        };
        // A block has at least one step.
        for index in (0..count).filter(|_| count > 1) {
            let without = changed(&|steps| drop(steps.remove(index)));
            found.push((format!("without {place}/{index}"), without));
        }
        for index in 1..count {
            let swapped = changed(&|steps| steps.swap(index - 1, index));
            found.push((format!("{place}/{index} before its neighbour"), swapped));
        }
    }
    found
}

/// Pointers to the blocks of steps, with their numbers of steps.
fn blocks(value: &Value, at: String, found: &mut Vec<(String, usize)>) {
    match value {
        Value::Array(items) => {
            let is_step = |item: &Value| STEP_KEYS.iter().any(|key| item.get(key).is_some());
            if !items.is_empty() && items.iter().all(is_step) {
                found.push((at.clone(), items.len()));
            }
            for (index, item) in items.iter().enumerate() {
                blocks(item, format!("{at}/{index}"), found);
            }
        }
        Value::Object(fields) => {
            for (key, value) in fields {
                blocks(value, format!("{at}/{}", key.replace('~', "~0").replace('/', "~1")), found);
            }
        }
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
    }
}

/// A robot in a scene, with its session.
pub(crate) struct Setting {
    robot: Robot,
    scene: Scene,
    pub(crate) session: Session,
}

/// Checks mutants, and runs in simulation what passes without an error or a warning.
///
/// # Errors
///
/// A mutant names a robot or a scene that is not built in.
pub fn judge(workers: Workers, mutants: Vec<Mutant>, seed: u64) -> Result<Vec<(Mutant, MutantEnd)>, String> {
    let settings = settings(&mutants)?;
    Ok(workers.spread(mutants, |mutant| {
        let setting = settings.get(&(mutant.robot.clone(), mutant.scene.clone()));
        let end = setting.map_or(MutantEnd::Refused, |setting| setting.judge(&mutant, seed));
        (mutant, end)
    }))
}

/// Settings of mutants by the names of robot and scene.
pub(crate) fn settings(mutants: &[Mutant]) -> Result<IndexMap<(String, String), Setting>, String> {
    let mut settings = IndexMap::new();
    for mutant in mutants {
        let key = (mutant.robot.clone(), mutant.scene.clone());
        if !settings.contains_key(&key) {
            settings.insert(key, setting(&mutant.robot, &mutant.scene)?);
        }
    }
    Ok(settings)
}

fn setting(robot: &str, scene: &str) -> Result<Setting, String> {
    let body = builtin::robot(robot).ok_or_else(|| format!("no robot `{robot}`"))?;
    let scene = builtin::scene(scene).ok_or_else(|| format!("no scene `{scene}`"))?;
    let (session, _) = setup::session(Some(&body.robot), Some(&scene), &mut Sources::default());
    let session = session.with_geometry(setup::geometry(&body, &scene));
    Ok(Setting { session, robot: body.robot, scene })
}

impl Setting {
    fn judge(&self, mutant: &Mutant, seed: u64) -> MutantEnd {
        let parsed = motet_syntax::read(&Source::new("mutant.json", mutant.text.as_str()), FileId(99));
        let compiled = self.session.compile(&parsed, None);
        let has = |severity| compiled.diagnostics.iter().any(|said| said.severity == severity);
        if has(Severity::Error) {
            return MutantEnd::Refused;
        }
        if has(Severity::Warning) {
            return MutantEnd::Warned;
        }
        let Some(graph) = compiled.graph else { return MutantEnd::Refused };
        self.run(graph, seed)
    }

    /// Runs a graph in simulation to its end.
    fn run(&self, graph: Graph, seed: u64) -> MutantEnd {
        let parents = graph.kinds.iter().filter_map(|kind| {
            let parent = graph.kinds.get(kind.parent?.index())?;
            Some((kind.name.clone(), parent.name.clone()))
        });
        let options = SimOptions { seed, kinds: parents.collect(), ..SimOptions::default() };
        let mut sim = Sim::new(&self.robot, &self.scene, options);
        let Ok(engine) = Engine::new(graph.clone(), &StartState::default()) else {
            return MutantEnd::Unlisted("the graph is refused".to_owned());
        };
        let mut engine = engine.with_capabilities(motet_runtime::Driver::capabilities(&sim));
        let mut causes = Causes::default();
        match run(&mut engine, &mut sim, &mut causes, Time::ZERO) {
            RunEnd::Failed { kind, node, .. } => {
                let failed = graph.nodes.get(node.index());
                let is_guard = causes.ends.get(&node) == Some(&EndCause::GuardRefuted);
                match failed {
                    Some(_) if causes.misses_goal => MutantEnd::Listed,
                    Some(failed) if is_guard || is_deferred_motion(failed, &kind) => MutantEnd::Listed,
                    // What the policy itself ends is no need.
                    Some(Node { kind: NodeKind::End { .. }, .. }) => MutantEnd::Passed,
                    Some(failed) => MutantEnd::Unlisted(format!(
                        "{} ends in {kind} ({:?})",
                        failed.path,
                        causes.ends.get(&node)
                    )),
                    None => MutantEnd::Unlisted(format!("a step ends in {kind}")),
                }
            }
            RunEnd::Fault(fault) => MutantEnd::Unlisted(format!("{fault:?}")),
            RunEnd::Done { .. } | RunEnd::Declined { .. } | RunEnd::Replan { .. } | RunEnd::Interrupted => {
                MutantEnd::Passed
            }
        }
    }
}

/// Returns whether a step failed as a motion fails that was left to the run.
fn is_deferred_motion(node: &Node, failure: &str) -> bool {
    let NodeKind::Call(call) = &node.kind else { return false };
    let is_deferred = call.motion.as_ref().is_some_and(|motion| motion.verdict == Verdict::Deferred);
    is_deferred && matches!(failure, "unreachable" | "blocked" | "not_found")
}

/// Causes of the failures of a run, as its trace reports them.
#[derive(Default)]
struct Causes {
    /// Causes for which steps ended in a failure, the latest of each step.
    ends: std::collections::BTreeMap<motet_graph::NodeId, EndCause>,
    /// Set if the goal was observed to be false at the end.
    misses_goal: bool,
}

impl Observer for Causes {
    fn effect(&mut self, _now: Time, effect: &Effect) {
        let Effect::Report(event) = effect else { return };
        match &event.what {
            TraceEventKind::Ended { node, ending: NodeEnding::Failure(_), cause } => {
                self.ends.insert(*node, *cause);
            }
            TraceEventKind::GoalObserved { truth } => {
                self.misses_goal = *truth == motet_runtime::Truth::False
            }
            _ => {}
        }
    }
}

/// Adds up the ends of mutants.
#[must_use]
pub fn summary(ends: &[(Mutant, MutantEnd)]) -> Summary {
    let mut sums = Summary { total: ends.len(), ..Summary::default() };
    for (_, end) in ends {
        match end {
            MutantEnd::Refused => sums.refused += 1,
            MutantEnd::Warned => sums.warned += 1,
            MutantEnd::Passed => sums.silent += 1,
            MutantEnd::Listed => {
                sums.silent += 1;
                sums.listed += 1;
            }
            MutantEnd::Unlisted(_) => {
                sums.silent += 1;
                sums.unlisted += 1;
            }
        }
    }
    sums
}
