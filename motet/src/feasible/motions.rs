//! Motions as people write them, such as `reach(mug_1, top)`, and all motions of a scene.

use motet_compiler::Session;
use motet_geometry::planning::{
    ExactNumber, GraspSide, MapPose, MotionQuery, PlaceRules, RobotModel, SceneState,
};
use motet_project::ProjectError;
use motet_robots::scene::Scene;
use motet_stdlib::lang;
use motet_syntax::ast::{Arg, Call, Expr, ExprKind};
use motet_syntax::text::parse_condition;
use motet_syntax::unit::Dimension;
use motet_syntax::{Diagnostic, FileId, Source, Sources, Span, suggest};
use smol_str::SmolStr;

/// Parses motions, whose names must be those of the scene and the robot.
pub(super) fn parse_motions(
    motions: &[String],
    machine: &RobotModel,
    scene: &Scene,
) -> Result<Vec<MotionQuery>, ProjectError> {
    let parsed = motions.iter().map(|motion| {
        let query = parse_motion(motion).ok_or_else(|| ProjectError::Unknown {
            what: "motion",
            name: motion.clone(),
            help: "write go_to(ENTITY), reach(OBJECT), reach(OBJECT, top|side|front), \
                   reach_at(OBJECT, pose(X, Y, Z, YAW)), \
                   put(OBJECT, ENTITY), put(OBJECT, ENTITY, near: ENTITY), \
                   put_at(OBJECT, ENTITY, pose(X, Y, Z, YAW)), stand_at(pose(X, Y, YAW)), \
                   offer(OBJECT, PERSON), pull(CONTAINER), push(ENTITY), look(ENTITY) \
                   or posture(NAME)"
                .to_owned(),
        })?;
        let entities = || scene.entities.keys().map(SmolStr::as_str);
        query.entities().try_for_each(|id| require_known("entity", id, entities))?;
        match &query {
            MotionQuery::Put(_, _, rules) => {
                let named = [rules.near.as_ref(), rules.beside.as_ref()];
                named.into_iter().flatten().try_for_each(|id| require_known("entity", id, entities))?;
            }
            MotionQuery::Posture(name) => {
                require_known("posture", name, || machine.card().postures.keys().map(SmolStr::as_str))?;
            }
            _ => {}
        }
        Ok(query)
    });
    parsed.collect()
}

/// Parses a motion such as `reach(mug_1, top)`; `None` for any other text.
fn parse_motion(motion: &str) -> Option<MotionQuery> {
    let ExprKind::Call(call) = parse_condition(motion).ok()?.kind else { return None };
    let id = |arg: &Arg| match &arg.value.kind {
        ExprKind::Name(id) if arg.name.is_none() => Some(id.clone()),
        _ => None,
    };
    match (call.name.text.as_str(), call.args.as_slice()) {
        ("stand_at", [Arg { name: None, value, .. }]) => return parse_pose(value).map(MotionQuery::StandAt),
        ("reach_at", [object, Arg { name: None, value: at, .. }]) => {
            return Some(MotionQuery::ReachAt(id(object)?, Some(parse_pose(at)?)));
        }
        ("put_at", [object, on, Arg { name: None, value: at, .. }]) => {
            let rules = PlaceRules { at: Some(parse_pose(at)?), ..PlaceRules::default() };
            return Some(MotionQuery::Put(id(object)?, id(on)?, rules));
        }
        (_, args) if args.iter().any(|arg| arg.name.is_none() && is_pose(arg)) => return None,
        _ => {}
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

fn is_pose(arg: &Arg) -> bool {
    matches!(&arg.value.kind, ExprKind::Call(call) if call.is_pose())
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

/// Parses the name of a motion and its arguments without names, except poses, with their spans in a file.
fn parse_call(motion: &str, file: FileId) -> Option<(SmolStr, Vec<(SmolStr, Span)>)> {
    let ExprKind::Call(call) = parse_condition(motion).ok()?.kind else { return None };
    let arg = |arg: Arg| match arg.value.kind {
        ExprKind::Name(id) if arg.name.is_none() => Some((id, Span { file, ..arg.value.span })),
        _ => None,
    };
    let plain = call.args.into_iter().filter(|arg| arg.name.is_none() && !is_pose(arg));
    Some((call.name.text, plain.map(arg).collect::<Option<_>>()?))
}

/// Type-checks the entities of a motion.
pub(super) fn check_kinds(motion: &str, session: &Session, sources: &mut Sources) -> Vec<Diagnostic> {
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    sources.add(Source::new("--for", motion));
    let Some((name, mut args)) = parse_call(motion, file) else { return vec![] };
    // The side of a reach is not an entity.
    if name == "reach" {
        args.truncate(1);
    }
    session.check_motion(&name, &args)
}

/// Requires a known name.
fn require_known<'a, I: Iterator<Item = &'a str>>(
    what: &'static str,
    name: &str,
    names: impl Fn() -> I,
) -> Result<(), ProjectError> {
    if names().any(|known| known == name) {
        return Ok(());
    }
    let help = match suggest::closest(name, names()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if names().next().is_none() => format!("the robot or scene has no {what}"),
        None => format!("known: {}", suggest::one_of(names())),
    };
    Err(ProjectError::Unknown { what, name: name.to_owned(), help })
}

/// All motions of a scene.
pub(super) fn all_motions(machine: &RobotModel, scene: &Scene) -> Vec<MotionQuery> {
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
