//! Verdicts on motions of a robot in a scene, with the path or the reason: the answers of `motet feasible`.

mod answers;
mod drawing;
mod motions;

use std::ops::ControlFlow;
use std::path::Path;

use motet_compiler::Session;
use motet_geometry::planning::{
    MotionAnswer, MotionQuery, QueryContext, RobotModel, SceneState, SearchBudget,
};
use motet_project::{DiagnosticSink, SessionInputs, open_robot, read_scene, read_state_into, require};
use motet_robots::clearance::ClearanceOverride;
use motet_robots::scene::{self, Scene};
use motet_syntax::{Diagnostic, Sources};

use crate::Error;

/// Motions to decide.
#[derive(Clone, Copy, Debug)]
pub enum Motions<'a> {
    /// Each in the notation of the language, such as `reach(mug_1, top)`.
    These(&'a [String]),
    /// `go_to` for all entities, `reach` for all objects, `pull` or `push` for all doors, and all postures.
    All,
}

/// Motions of a robot in a scene. Each begins at the start of the scene.
#[derive(Clone, Copy, Debug)]
pub struct FeasibilityQuestion<'a> {
    /// Name, folder or JSON of a robot, as in [`motet_project::ProjectBuilder::robot`].
    pub robot: &'a str,
    /// Name, file or JSON of a scene, as in [`motet_project::ProjectBuilder::scene`].
    pub scene: &'a str,
    /// File or JSON of facts at the start, beside those of the scene.
    pub state: Option<&'a Path>,
    pub motions: Motions<'a>,
    /// Factor of the default search budget.
    pub effort: u16,
    /// Distances from obstacles in place of those of scene and robot, in m.
    pub clearance: ClearanceOverride,
}

/// Verdict on one motion.
#[derive(Clone, Debug)]
pub struct MotionVerdict {
    pub query: MotionQuery,
    pub answer: MotionAnswer,
    /// Answer for people, one or two lines.
    pub text: String,
    /// Answer as a JSON object on one line.
    pub json: String,
    /// Number of motions that are decided after it.
    pub left: usize,
}

/// Decides motions one after the other, and gives each verdict to `each`, with the sink, at once. Returns a
/// drawing of the scene from above as SVG, with the robot and the paths.
///
/// ```
/// use motet::feasible::{FeasibilityQuestion, Motions, decide};
///
/// let question = FeasibilityQuestion {
///     robot: "hsr",
///     scene: "kitchen",
///     state: None,
///     motions: Motions::These(&["reach(mug_1)".to_owned()]),
///     effort: 1,
///     clearance: Default::default(),
/// };
/// let mut verdicts = Vec::new();
/// let svg = decide(&question, &mut motet::project::Discard, &mut |_, verdict| verdicts.push(verdict))?;
/// assert!(verdicts[0].text.starts_with("reach(mug_1): feasible"));
/// assert!(svg.starts_with("<svg"));
/// # Ok::<(), motet::Error>(())
/// ```
///
/// # Errors
///
/// [`Error::Project`] for an unknown name and for files with errors, [`Error::NoBody`].
pub fn decide<S: DiagnosticSink>(
    question: &FeasibilityQuestion<'_>,
    sink: &mut S,
    each: &mut dyn FnMut(&mut S, MotionVerdict),
) -> Result<String, Error> {
    let mut sources = Sources::default();
    let (robot, urdf) = open_robot(question.robot, &mut sources, sink)?;
    let Some(urdf) = urdf else { return Err(Error::NoBody(robot.name.to_string())) };
    let mut scene = read_scene(question.scene, &mut sources, sink)?;
    scene.clearance = question.clearance.or(scene.clearance);
    require("scene", &scene::fit(&scene, &urdf), &sources, sink)?;
    let state =
        question.state.map(|path| read_state_into(&mut scene, path, &mut sources, sink)).transpose()?;
    let machine = RobotModel::new(&robot, &urdf);
    let inputs = SessionInputs::of(&robot, &scene, state.as_ref());
    let session = inputs.open("robot or scene", &mut sources, sink)?;
    let queries = queries(question.motions, (&machine, &scene), &session, &mut sources, sink)?;
    Ok(decide_in((&machine, &scene), queries, question.effort, &mut |verdict| {
        each(sink, verdict);
        ControlFlow::Continue(())
    }))
}

/// Motion queries of a robot in a scene, in the order in which they are written.
///
/// # Errors
///
/// [`Error::Project`] for a motion that cannot be read, for an unknown name, and for an argument of the wrong
/// kind.
pub fn queries(
    motions: Motions<'_>,
    (machine, scene): (&RobotModel, &Scene),
    session: &Session,
    sources: &mut Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<Vec<MotionQuery>, Error> {
    let Motions::These(named) = motions else { return Ok(motions::all_motions(machine, scene)) };
    let queries = motions::parse_motions(named, machine, scene)?;
    let diagnostics: Vec<Diagnostic> =
        named.iter().flat_map(|motion| motions::check_kinds(motion, session, sources)).collect();
    require("motion", &diagnostics, sources, sink)?;
    Ok(queries)
}

/// Decides motions of a robot in a scene one after the other, as [`decide`] does, until `each` ends it.
/// `effort` is the factor of the default search budget. Returns the drawing.
pub fn decide_in(
    (machine, scene): (&RobotModel, &Scene),
    queries: impl IntoIterator<Item = MotionQuery>,
    effort: u16,
    each: &mut dyn FnMut(MotionVerdict) -> ControlFlow<()>,
) -> String {
    let world = SceneState::new(machine, scene);
    let room = QueryContext::new(machine, scene, &world);
    let budget = SearchBudget::default().times(usize::from(effort));
    let mut answered = Vec::new();
    let queries: Vec<MotionQuery> = queries.into_iter().collect();
    let mut left = queries.len();
    for query in queries {
        left -= 1;
        let mut answer = room.answer(&query, budget);
        if let MotionAnswer::Infeasible(why) = &mut answer {
            *why = room.explain(&query, why, budget);
        }
        let text = answers::describe(&query, &answer);
        let json = answers::json_line((machine, &world), &query, &answer);
        answered.push((query.clone(), answer.clone()));
        if each(MotionVerdict { query, answer, text, json, left }).is_break() {
            break;
        }
    }
    drawing::top_view(&room, scene, &world, &answered)
}
