//! Tool that decides motions, with a drawing of the answers from above.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use motet::feasible::{Motions, decide_in, queries};
use motet_geometry::planning::RobotModel;
use motet_syntax::Sources;
use serde_json::{Value, json};

use super::answer::{Refusal, ToolAnswer};
use super::environment::{AgentEnvironment, StderrSink};
use super::text::within;

/// The most motions of a call.
const MAX_MOTIONS: usize = 40;
/// Time after which no further motion is searched.
const PATIENCE: Duration = Duration::from_secs(20);
/// The most waypoints of the base in an answer.
const MAX_WAYPOINTS: usize = 30;

/// Decides motions; without any, all of the scene.
pub(super) fn feasible(situation: &AgentEnvironment, motions: &[String]) -> Result<ToolAnswer, Refusal> {
    if motions.len() > MAX_MOTIONS {
        return Err(Refusal::new(format!("{} motions, at most {MAX_MOTIONS} are taken", motions.len())));
    }
    motions.iter().try_for_each(|motion| within("motion", motion))?;
    let robot = situation.robot()?;
    let files = situation.project.files.as_ref();
    let urdf = match files {
        Some(files) => files.body(robot, &mut Sources::default(), &mut StderrSink)?,
        None => None,
    };
    let urdf = urdf.ok_or_else(|| Refusal::new(format!("the card of `{}` names no URDF", robot.name)))?;
    let (machine, scene) = (RobotModel::new(robot, &urdf), &situation.scene);
    let room = (&machine, scene);
    let wanted = if motions.is_empty() { Motions::All } else { Motions::These(motions) };
    let mut queries = queries(wanted, room, &situation.session, &mut Sources::default(), &mut StderrSink)?;
    queries.truncate(MAX_MOTIONS);
    let (begun, wanted) = (Instant::now(), queries.len());
    let (mut data, mut says) = (Vec::new(), Vec::new());
    let picture = decide_in(room, queries, 1, &mut |verdict| {
        says.push(verdict.text.trim_end().to_owned());
        data.push(brief(serde_json::from_str(&verdict.json).unwrap_or_default()));
        if begun.elapsed() > PATIENCE { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    let not_decided = wanted - says.len();
    let answer = json!({"says": says, "answers": data, "not_decided_in_time": not_decided});
    Ok(ToolAnswer::from(answer).with_picture(picture))
}

/// Answer with the way of the base in place of the configurations of its path.
fn brief(mut answer: Value) -> Value {
    if let Some(Value::Array(path)) = answer.pointer_mut("/witness/path") {
        let last = path.len().saturating_sub(1);
        let is_shown = |index: usize| index + 1 < MAX_WAYPOINTS || index == last;
        let bases = path.iter().enumerate().filter(|(index, _)| is_shown(*index));
        *path = bases.map(|(_, state)| state.get("base").cloned().unwrap_or_default()).collect();
    }
    answer
}
