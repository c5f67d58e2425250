//! `motet feasible`: decides which motions are feasible for a robot in a scene, with the path or the reason.

pub(crate) mod drawing;

use std::path::PathBuf;

use clap::{Args, value_parser};
use motet_compiler::Session;
use motet_geometry::planning::{
    Configuration, ExactNumber, GraspSide, InfeasibleReason, MIN_CLEARANCE, MapPose, Misfit, MotionAnswer,
    MotionQuery, MotionWitness, PlaceRules, QueryContext, RobotModel, SceneState, SearchBudget,
    UnknownReason, components,
};
use motet_project::{open_robot, read_scene, require};
use motet_robots::scene::{self, Scene};
use motet_stdlib::lang;
use motet_syntax::ast::{Arg, Call, Expr, ExprKind};
use motet_syntax::text::parse_condition;
use motet_syntax::unit::Dimension;
use motet_syntax::{Diagnostic, FileId, Source, Sources, Span, suggest};
use serde_json::{Map, Value, json};
use smol_str::SmolStr;

use crate::error::{CliError, Exit};
use crate::flags::{ClearanceArgs, OutputFormat};
use crate::output::{Colors, count, replace_file};
use crate::report::Report;

/// Flags of `motet feasible`.
#[derive(Args, Debug)]
#[command(after_help = "Examples:\n  \
    motet feasible --robot hsr --scene kitchen --for 'reach(mug_1)'\n  \
    motet feasible --robot hsr --scene kitchen --for 'reach(coke, top)' --svg coke.svg\n  \
    motet feasible --robot hsr --scene kitchen --all --format json\n\n\
    A motion is go_to(ENTITY), reach(OBJECT), reach(OBJECT, top|side|front), put(OBJECT, ENTITY),\n\
    offer(OBJECT, PERSON), pull(CONTAINER), push(ENTITY), look(ENTITY), posture(NAME) or\n\
    stand_at(pose(1.2 m, 0.5 m, 90 deg)). A place has rules: put(OBJECT, ENTITY, near: ENTITY),\n\
    and likewise beside: ENTITY, away_from_edge: 10 cm, upright: false, at: pose(…).\n\
    The scene defines the object in the hand:\n\
    \"robot\": {\"holding\": …}.\n\
    Exit codes: 0 all motions of --for are feasible, 1 one is not or is unknown, 2 could not run.")]
pub(crate) struct FeasibleArgs {
    /// Robot: a built-in name (see `motet robots`), or a folder with a robot.toml
    #[arg(long, value_name = "NAME|FOLDER")]
    robot: String,
    /// Scene: a built-in name, or a JSON file
    #[arg(long, value_name = "NAME|FILE")]
    scene: String,
    /// Motion to decide; repeatable
    #[arg(long = "for", value_name = "MOTION", required_unless_present = "all")]
    motions: Vec<String>,
    /// Decide go_to for all entities, reach for all objects, pull or push for all doors, and all postures,
    /// each from the start; the exit code is 0
    #[arg(long, conflicts_with = "motions")]
    all: bool,
    /// Search budget of a motion: 4 tries four times as often
    #[arg(long, value_name = "FACTOR", default_value_t = 1,
          value_parser = value_parser!(u16).range(1..=1000))]
    effort: u16,
    #[command(flatten)]
    clearance: ClearanceArgs,
    /// Format of the answers
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    format: OutputFormat,
    /// Draw the scene from above with the robot and the paths
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(args: &FeasibleArgs, colors: Colors) -> Result<Exit, CliError> {
    Report::run(args.format.into(), colors, |report| answer(args, report))
}

fn answer(args: &FeasibleArgs, report: &mut Report) -> Result<Exit, CliError> {
    let mut sources = Sources::default();
    let (robot, urdf) = open_robot(&args.robot, &mut sources, report)?;
    let Some(urdf) = urdf else {
        return Err(CliError::Message(format!("the card of `{}` names no URDF under [model]", robot.name)));
    };
    let mut scene = read_scene(&args.scene, &mut sources, report)?;
    scene.clearance = args.clearance.given().or(scene.clearance);
    require("scene", &scene::fit(&scene, &urdf), &sources, report)?;
    let machine = RobotModel::new(&robot, &urdf);
    let queries = if args.all {
        all_motions(&machine, &scene)
    } else {
        parse_motions(&args.motions, &machine, &scene)?
    };
    let session = Session::builder().robot(&robot).scene(&scene).build(&mut sources);
    let diagnostics = session.input_diagnostics().to_vec();
    require("robot or scene", &diagnostics, &sources, report)?;
    let diagnostics: Vec<Diagnostic> =
        args.motions.iter().flat_map(|motion| check_kinds(motion, &session, &mut sources)).collect();
    require("motion", &diagnostics, &sources, report)?;
    let world = SceneState::new(&machine, &scene);
    let room = QueryContext::new(&machine, &scene, &world);
    let mut answers = Vec::new();
    let mut exit = Exit::Success;
    for query in queries {
        let budget = SearchBudget::default().times(usize::from(args.effort));
        let mut answer = room.answer(&query, budget);
        if let MotionAnswer::Infeasible(why) = &mut answer {
            *why = room.explain(&query, why, budget);
        }
        match args.format {
            OutputFormat::Human => report.out.text(&describe(&query, &answer)),
            OutputFormat::Json => report.out.line(&json_of(&machine, &query, &answer).to_string()),
        }
        if !args.all && !matches!(answer, MotionAnswer::Feasible(_)) {
            exit = Exit::Findings;
        }
        answers.push((query, answer));
    }
    if let Some(path) = &args.svg {
        let drawing = drawing::top_view(&room, &scene, &world, &answers);
        replace_file(path, &drawing)?;
    }
    Ok(exit)
}

/// Parses motions, and requires that their names are known.
pub(crate) fn parse_motions(
    motions: &[String],
    machine: &RobotModel,
    scene: &Scene,
) -> Result<Vec<MotionQuery>, CliError> {
    let parsed = motions.iter().map(|motion| {
        let query = parse_motion(motion).ok_or_else(|| CliError::Unknown {
            what: "motion",
            name: motion.clone(),
            help: "write go_to(ENTITY), reach(OBJECT), reach(OBJECT, top|side|front), \
                   put(OBJECT, ENTITY), put(OBJECT, ENTITY, near: ENTITY), stand_at(pose(X, Y, YAW)), \
                   offer(OBJECT, PERSON), pull(CONTAINER), push(ENTITY), look(ENTITY) \
                   or posture(NAME)"
                .to_owned(),
        })?;
        let entities = || scene.entities.keys().map(SmolStr::as_str);
        match &query {
            MotionQuery::Put(object, on, rules) => {
                let named = [Some(object), Some(on), rules.near.as_ref(), rules.beside.as_ref()];
                named.into_iter().flatten().try_for_each(|id| require_known("entity", id, entities))?;
            }
            MotionQuery::Offer(object, other) => {
                require_known("entity", object, entities)?;
                require_known("entity", other, entities)?;
            }
            MotionQuery::GoTo(id)
            | MotionQuery::Reach(id, _)
            | MotionQuery::Look(id)
            | MotionQuery::Pull(id)
            | MotionQuery::Push(id) => {
                require_known("entity", id, entities)?;
            }
            MotionQuery::Posture(name) => {
                require_known("posture", name, || machine.card().postures.keys().map(SmolStr::as_str))?;
            }
            MotionQuery::StandAt(_) | MotionQuery::Other(_) => {}
        }
        Ok(query)
    });
    parsed.collect()
}

/// Parses a motion such as `reach(mug_1, top)`; `None` for any other text.
fn parse_motion(motion: &str) -> Option<MotionQuery> {
    let ExprKind::Call(call) = parse_condition(motion).ok()?.kind else { return None };
    if let ("stand_at", [Arg { name: None, value, .. }]) = (call.name.text.as_str(), call.args.as_slice()) {
        return parse_pose(value).map(MotionQuery::StandAt);
    }
    let rules = parse_rules(&call)?;
    let (name, mut args) = parse_call(motion, FileId::default())?;
    let side = if name == "reach" && args.len() == 2 { args.pop() } else { None };
    let side = match side.filter(|(side, _)| side != "auto") {
        Some((side, _)) => Some(GraspSide::from_name(&side)?),
        None => None,
    };
    let query = MotionQuery::from_call(&name, args.into_iter().map(|(id, _)| id), side)?;
    Some(match query {
        MotionQuery::Put(object, on, _) => MotionQuery::Put(object, on, rules),
        query if rules == PlaceRules::default() => query,
        _ => return None,
    })
}

/// Parses the rules of a place, which are the named arguments of a motion; `None` for anything else.
fn parse_rules(call: &Call) -> Option<PlaceRules> {
    let mut rules = PlaceRules::default();
    for arg in &call.args {
        let Some(name) = &arg.name else { continue };
        match (name.text.as_str(), &arg.value.kind) {
            ("near", ExprKind::Name(id)) => rules.near = Some(id.clone()),
            ("beside", ExprKind::Name(id)) => rules.beside = Some(id.clone()),
            ("away_from_edge", ExprKind::Quantity(far, unit)) if unit.dimension() == Dimension::LENGTH => {
                rules.from_edge = ExactNumber::new(unit.to_si(*far).max(0.0));
            }
            ("upright", ExprKind::Bool(upright)) => rules.may_lie = !upright,
            ("at", _) => rules.at = Some(parse_pose(&arg.value)?),
            _ => return None,
        }
    }
    Some(rules)
}

/// Parses a pose such as `pose(1.2 m, 0.5 m, 90 deg)`; `None` for anything else.
fn parse_pose(expr: &Expr) -> Option<MapPose> {
    let ExprKind::Call(call) = &expr.kind else { return None };
    let number = |arg: &Arg| match arg.value.kind {
        ExprKind::Quantity(value, unit) => Some((unit.to_si(value), unit.dimension())),
        _ => None,
    };
    let numbers = call.args.iter().map(number).collect::<Option<Vec<_>>>().filter(|_| call.is_pose())?;
    let (length, angle) = (Dimension::LENGTH, Dimension::ANGLE);
    match *numbers.as_slice() {
        [(x, a), (y, b), (yaw, c)] if [a, b, c] == [length, length, angle] => {
            Some(MapPose::new([x, y, 0.0], yaw))
        }
        [(x, a), (y, b), (z, c), (yaw, d)] if [a, b, c, d] == [length, length, length, angle] => {
            Some(MapPose::new([x, y, z], yaw))
        }
        _ => None,
    }
}

/// Parses the name of a motion and its arguments without names, with their spans in a file.
fn parse_call(motion: &str, file: FileId) -> Option<(SmolStr, Vec<(SmolStr, Span)>)> {
    let ExprKind::Call(call) = parse_condition(motion).ok()?.kind else { return None };
    let arg = |arg: Arg| match arg.value.kind {
        ExprKind::Name(id) if arg.name.is_none() => Some((id, Span { file, ..arg.value.span })),
        _ => None,
    };
    let plain = call.args.into_iter().filter(|arg| arg.name.is_none());
    Some((call.name.text, plain.map(arg).collect::<Option<_>>()?))
}

/// Type-checks the entities of a motion.
pub(crate) fn check_kinds(motion: &str, session: &Session, sources: &mut Sources) -> Vec<Diagnostic> {
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    sources.add(Source::new("--for", motion));
    let Some((name, mut args)) = parse_call(motion, file) else { return vec![] };
    // The side of a reach is not an entity.
    if name == "reach" {
        args.truncate(1);
    }
    session.check_motion(&name, &args)
}

/// Requires that a name is known.
fn require_known<'a, I: Iterator<Item = &'a str>>(
    what: &'static str,
    name: &str,
    names: impl Fn() -> I,
) -> Result<(), CliError> {
    if names().any(|known| known == name) {
        return Ok(());
    }
    let help = match suggest::closest(name, names()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if names().next().is_none() => format!("the robot or scene has no {what}"),
        None => format!("known: {}", suggest::one_of(names())),
    };
    Err(CliError::Unknown { what, name: name.to_owned(), help })
}

/// All motions of a scene.
pub(crate) fn all_motions(machine: &RobotModel, scene: &Scene) -> Vec<MotionQuery> {
    let drives = scene.entities.keys().filter(|_| machine.drives()).cloned().map(MotionQuery::GoTo);
    let objects = scene.entities.iter().filter(|(_, entity)| entity.kind == lang::kinds::OBJECT);
    let reaches = objects.map(|(id, _)| MotionQuery::Reach(id.clone(), None));
    let world = SceneState::new(machine, scene);
    let doors = scene.entities.iter().filter(|(_, entity)| entity.travel.is_some()).map(|(id, entity)| {
        if world.is_open(entity) { MotionQuery::Push(id.clone()) } else { MotionQuery::Pull(id.clone()) }
    });
    let postures = machine.card().postures.keys().cloned().map(MotionQuery::Posture);
    drives.chain(reaches).chain(doors).chain(postures).collect()
}

/// Answer in a line for people, and the help behind it.
pub(crate) fn describe(query: &MotionQuery, answer: &MotionAnswer) -> String {
    match answer {
        MotionAnswer::Feasible(witness) => {
            let [x, y, yaw] = witness.path.last().map_or([0.0; 3], |state| state.base);
            let mut line = format!(
                "{query}: feasible, base at ({x:.2}, {y:.2}) m, {:.0}°, {}, {:.3} m clear",
                degrees(yaw),
                count(witness.path.len().saturating_sub(1), "leg"),
                witness.margins.clearance,
            );
            let required = witness.margins.required;
            if required.base_m.max(required.arm_m) > MIN_CLEARANCE {
                let [base, arm] = [required.base_m, required.arm_m].map(|metres| metres * 100.0);
                line.push_str(&format!(" (kept: base {base:.1} cm, arm {arm:.1} cm)"));
            }
            if let Some(limit) = witness.margins.limit {
                line.push_str(&format!(", {limit:.2} rad or m from a joint's limit"));
            }
            if let Some(payload) = witness.margins.payload {
                line.push_str(&format!(", {payload:.2} kg to spare"));
            }
            line + "\n"
        }
        MotionAnswer::Infeasible(why) => {
            let proof = if why.certified { "proven" } else { "the search ended without one" };
            let help = why.change.as_ref().map_or_else(String::new, |change| format!("  help: {change}\n"));
            format!("{query}: {}, {} ({proof})\n{help}", why.reason.name(), why.says())
        }
        MotionAnswer::Unknown(UnknownReason::Budget) => format!(
            "{query}: unknown, the search ran out of its budget\n  \
             help: `--effort 4` tries four times as often\n"
        ),
        MotionAnswer::Unknown(UnknownReason::Because(why)) => format!("{query}: unknown, {why}\n"),
    }
}

/// Angle in degrees from -180 (exclusive) to 180: along a path a base may turn further.
fn degrees(angle: f64) -> f64 {
    let rounded = angle.to_degrees().round();
    let within = (rounded + 180.0).rem_euclid(360.0) - 180.0;
    if within == -180.0 { 180.0 } else { within }
}

/// Numbers of a reason with their names.
fn numbers(reason: &InfeasibleReason) -> Vec<(&'static str, f64)> {
    match reason {
        InfeasibleReason::OutOfReach { needs, reach, .. } => vec![("needs", *needs), ("reach", *reach)],
        InfeasibleReason::TooHeavy { needs, limit } | InfeasibleReason::TooWide { needs, limit } => {
            vec![("needs", *needs), ("limit", *limit)]
        }
        InfeasibleReason::NotInView { aside: Some(aside), .. } => {
            vec![("needs", aside.needs.abs()), ("limit", aside.limit)]
        }
        InfeasibleReason::NoPlace(Misfit::Narrow { needs, limit, .. }) => {
            vec![("needs", *needs), ("limit", *limit)]
        }
        InfeasibleReason::NoPlace(_)
        | InfeasibleReason::NoFreePose { .. }
        | InfeasibleReason::BlockedPath { .. }
        | InfeasibleReason::NotInView { aside: None, .. } => {
            vec![]
        }
    }
}

/// Answer as JSON.
pub(crate) fn json_of(machine: &RobotModel, query: &MotionQuery, answer: &MotionAnswer) -> Value {
    let mut object = Map::new();
    object.insert("query".into(), query.to_string().into());
    match answer {
        MotionAnswer::Feasible(witness) => {
            object.insert("answer".into(), "feasible".into());
            object.insert("witness".into(), witness_json(machine, witness));
        }
        MotionAnswer::Infeasible(why) => {
            object.insert("answer".into(), "infeasible".into());
            object.insert("reason".into(), why.reason.name().into());
            object.insert("says".into(), why.says().into());
            for (name, value) in numbers(&why.reason) {
                object.insert(name.into(), json!(value));
            }
            object.insert("change".into(), why.change.clone().into());
            object.insert("certified".into(), why.certified.into());
        }
        MotionAnswer::Unknown(unknown) => {
            object.insert("answer".into(), "unknown".into());
            let why = match unknown {
                UnknownReason::Budget => "the search ran out of its budget",
                UnknownReason::Because(why) => why.as_str(),
            };
            object.insert("says".into(), why.into());
        }
    }
    Value::Object(object)
}

fn witness_json(machine: &RobotModel, witness: &MotionWitness) -> Value {
    let grasp = witness.grasp.as_ref().map(|grasp| {
        let side = match grasp.side {
            GraspSide::Top => "top",
            GraspSide::Side => "side",
            GraspSide::Front => "front",
        };
        let pose = |(xyz, turn): ([f64; 3], [f64; 4])| json!({"xyz": xyz, "quaternion_xyzw": turn});
        json!({
            "object": grasp.object, "side": side, "width": grasp.width,
            "map_from_tip": pose(components(&grasp.map_from_tip)),
            "tip_from_object": pose(components(&grasp.tip_from_object)),
        })
    });
    json!({
        "path": witness.path.iter().map(|at| state(machine, at)).collect::<Vec<_>>(),
        "grasp": grasp,
        "margins": {
            "clearance": witness.margins.clearance,
            "required": {"base": witness.margins.required.base_m, "arm": witness.margins.required.arm_m},
            "limit": witness.margins.limit,
            "payload": witness.margins.payload,
        },
    })
}

fn state(machine: &RobotModel, state: &Configuration) -> Value {
    let names = machine.tree().dofs().iter().map(|dof| dof.name.to_string());
    let joints: Map<String, Value> = names.zip(state.joints.iter().map(|value| json!(value))).collect();
    json!({"base": state.base, "joints": joints})
}

#[cfg(test)]
mod tests {

    #[test]
    fn degrees_are_within_a_half_turn() {
        for (angle, shown) in [(-3.16, 179.0), (3.15, 180.0), (0.0, 0.0), (7.0, 41.0), (-1.57, -90.0)] {
            assert_eq!(super::degrees(angle), shown, "{angle}");
        }
    }
}
