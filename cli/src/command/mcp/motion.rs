//! Tool that decides motions, with a drawing of the answers from above.

use std::time::{Duration, Instant};

use motet_geometry::planning::{MotionAnswer, QueryContext, RobotModel, SceneState, SearchBudget};
use motet_syntax::{Sources, render};
use serde_json::{Value, json};

use super::answer::{Refusal, ToolAnswer};
use super::situation::{Situation, StderrSink};
use super::text::within;
use crate::command::feasible::{all_motions, check_kinds, describe, drawing, json_of, parse_motions};

/// The most motions of a call.
const MAX_MOTIONS: usize = 40;
/// Time after which no further motion is searched.
const PATIENCE: Duration = Duration::from_secs(20);
/// The most waypoints of the base in an answer.
const MAX_WAYPOINTS: usize = 30;

/// Decides motions; without any, all of the scene.
pub(super) fn feasible(situation: &Situation, motions: &[String]) -> Result<ToolAnswer, Refusal> {
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
    let queries = match motions {
        [] => all_motions(&machine, scene),
        motions => parse_motions(motions, &machine, scene)?,
    };
    let mut sources = Sources::default();
    let kinds: Vec<_> =
        motions.iter().flat_map(|motion| check_kinds(motion, &situation.session, &mut sources)).collect();
    if !kinds.is_empty() {
        return Err(Refusal::new("a motion has arguments of the wrong kind")
            .with(json!({"says": render::llm(&kinds, &sources)})));
    }
    let world = SceneState::new(&machine, scene);
    let room = QueryContext::new(&machine, scene, &world);
    let begun = Instant::now();
    let (mut answers, mut says, mut not_decided) = (Vec::new(), Vec::new(), 0);
    for query in queries.into_iter().take(MAX_MOTIONS) {
        if begun.elapsed() > PATIENCE {
            not_decided += 1;
            continue;
        }
        let mut answer = room.answer(&query, SearchBudget::default());
        if let MotionAnswer::Infeasible(why) = &mut answer {
            *why = room.explain(&query, why, SearchBudget::default());
        }
        says.push(describe(&query, &answer).trim_end().to_owned());
        answers.push((query, answer));
    }
    let picture = drawing::top_view(&room, scene, &world, &answers);
    let data: Vec<Value> =
        answers.iter().map(|(query, answer)| brief(json_of(&machine, query, answer))).collect();
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
