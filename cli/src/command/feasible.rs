//! `motet feasible`: whether a robot can do a motion in a scene, with the path or the reason.

mod drawing;
mod wire;

use motet_compiler::{Options, Session};
use motet_geometry::planning::{
    InfeasibleReason, MotionAnswer, MotionQuery, QueryContext, RobotModel, SceneState, SearchBudget,
    UnknownReason,
};
use motet_robots::scene::{self, Scene};
use motet_syntax::{Diagnostic, FileId, Source, Sources, Span, suggest};
use smol_str::SmolStr;

use crate::args::{FeasibleArgs, FeasibleFormat, Format};
use crate::exit::{Exit, Trouble};
use crate::out::{Colors, count};
use crate::report::Report;
use crate::workbench::{Card, read_scene};

/// Runs the command.
///
/// # Errors
///
/// The robot, the scene or a motion cannot be read, or the drawing not be written.
pub(crate) fn run(args: &FeasibleArgs, colors: Colors) -> Result<Exit, Trouble> {
    let format = match args.format {
        FeasibleFormat::Human => Format::Human,
        FeasibleFormat::Json => Format::Json,
    };
    let mut report = Report::new(format, colors);
    let result = answer(args, &mut report);
    report.close(result)
}

fn answer(args: &FeasibleArgs, report: &mut Report) -> Result<Exit, Trouble> {
    let mut sources = Sources::default();
    let card = Card::find(&args.robot)?;
    let robot = card.read(&mut sources, report)?;
    let Some(urdf) = card.body(&robot, &mut sources, report)? else {
        return Err(Trouble::Other(format!("the card of `{}` names no URDF under [model]", robot.name)));
    };
    let scene = read_scene(&args.scene, &mut sources, report)?;
    report.usable("scene", &scene::fit(&scene, &urdf), &sources)?;
    let machine = RobotModel::new(&robot, &urdf);
    let queries = if args.all { all(&machine, &scene) } else { asked(&args.motions, &machine, &scene)? };
    let (session, said) =
        Session::new(Some(&robot), &[], Some(&scene), None, Options::default(), &mut sources);
    report.usable("robot or scene", &said, &sources)?;
    let said: Vec<Diagnostic> =
        args.motions.iter().flat_map(|motion| kinds(motion, &session, &mut sources)).collect();
    report.usable("motion", &said, &sources)?;
    let world = SceneState::new(&machine, &scene);
    let room = QueryContext::new(&machine, &scene, &world);
    let mut answers = Vec::new();
    let mut exit = Exit::Clean;
    for query in queries {
        let budget = SearchBudget::default().times(usize::from(args.effort));
        let mut answer = room.answer(&query, budget);
        if let MotionAnswer::Infeasible(why) = &mut answer {
            *why = room.explain(&query, why, budget);
        }
        match args.format {
            FeasibleFormat::Human => report.out.text(&told(&query, &answer)),
            FeasibleFormat::Json => report.out.line(&wire::line(&machine, &query, &answer)),
        }
        if !args.all && !matches!(answer, MotionAnswer::Feasible(_)) {
            exit = Exit::Findings;
        }
        answers.push((query, answer));
    }
    if let Some(path) = &args.svg {
        let drawing = drawing::top_view(&room, &scene, &world, &answers);
        std::fs::write(path, drawing).map_err(|source| Trouble::Write { path: path.clone(), source })?;
    }
    Ok(exit)
}

fn asked(motions: &[String], machine: &RobotModel, scene: &Scene) -> Result<Vec<MotionQuery>, Trouble> {
    let parsed = motions.iter().map(|motion| {
        let query = MotionQuery::parse(motion).ok_or_else(|| Trouble::Unknown {
            what: "motion",
            name: motion.clone(),
            help: "write go_to(ENTITY), reach(OBJECT), reach(OBJECT, top|side|front), put(OBJECT, ENTITY), offer(OBJECT, PERSON), pull(CONTAINER), push(ENTITY), look(ENTITY) or posture(NAME)"
                .to_owned(),
        })?;
        let entities = || scene.entities.keys().map(SmolStr::as_str);
        match &query {
            MotionQuery::Put(object, other) | MotionQuery::Offer(object, other) => {
                known("entity", object, entities)?;
                known("entity", other, entities)?;
            }
            MotionQuery::GoTo(id) | MotionQuery::Reach(id, _) | MotionQuery::Look(id) | MotionQuery::Pull(id) | MotionQuery::Push(id) => {
                known("entity", id, entities)?;
            }
            MotionQuery::Posture(name) => {
                known("posture", name, || machine.card().postures.keys().map(SmolStr::as_str))?;
            }
            MotionQuery::Other(_) => {}
        }
        Ok(query)
    });
    parsed.collect()
}

/// What is wrong with the kinds of the things that a motion names.
fn kinds(motion: &str, session: &Session, sources: &mut Sources) -> Vec<Diagnostic> {
    let Some((name, listed)) = motion.split_once('(') else { return vec![] };
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    sources.add(Source::new("--for", motion));
    let mut at = name.len() + 1;
    let mut args = Vec::new();
    for arg in listed.split(',') {
        let bare = arg.trim_matches([' ', ')', '`']);
        let start = at + arg.find(bare).unwrap_or(0);
        args.push((SmolStr::new(bare), Span::new(file, start, start + bare.len())));
        at += arg.len() + 1;
    }
    // From which side is no thing.
    if name.trim() == "reach" {
        args.truncate(1);
    }
    session.check_motion(name.trim(), &args)
}

/// That there is something of a name.
fn known<'a, I: Iterator<Item = &'a str>>(
    what: &'static str,
    name: &str,
    names: impl Fn() -> I,
) -> Result<(), Trouble> {
    if names().any(|known| known == name) {
        return Ok(());
    }
    let help = match suggest::closest(name, names()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if names().next().is_none() => format!("no {what} is known here"),
        None => format!("known here: {}", suggest::one_of(names())),
    };
    Err(Trouble::Unknown { what, name: name.to_owned(), help })
}

/// Every motion that can be asked for in a scene.
fn all(machine: &RobotModel, scene: &Scene) -> Vec<MotionQuery> {
    let drives = scene.entities.keys().filter(|_| machine.drives()).cloned().map(MotionQuery::GoTo);
    let objects = scene.entities.iter().filter(|(_, entity)| entity.kind == "Object");
    let reaches = objects.map(|(id, _)| MotionQuery::Reach(id.clone(), None));
    let world = SceneState::new(machine, scene);
    let doors = scene.entities.iter().filter(|(_, entity)| entity.travel.is_some()).map(|(id, entity)| {
        if world.is_open(entity) { MotionQuery::Push(id.clone()) } else { MotionQuery::Pull(id.clone()) }
    });
    let postures = machine.card().postures.keys().cloned().map(MotionQuery::Posture);
    drives.chain(reaches).chain(doors).chain(postures).collect()
}

fn told(query: &MotionQuery, answer: &MotionAnswer) -> String {
    match answer {
        MotionAnswer::Feasible(witness) => {
            let [x, y, yaw] = witness.path.last().map_or([0.0; 3], |state| state.base);
            let mut line = format!(
                "{query}: feasible, base at ({x:.2}, {y:.2}) m, {:.0}°, {}, {:.3} m clear",
                degrees(yaw),
                count(witness.path.len().saturating_sub(1), "leg"),
                witness.margins.clearance,
            );
            if let Some(limit) = witness.margins.limit {
                line.push_str(&format!(", {limit:.2} rad or m from a joint's limit"));
            }
            if let Some(payload) = witness.margins.payload {
                line.push_str(&format!(", {payload:.2} kg to spare"));
            }
            line + "\n"
        }
        MotionAnswer::Infeasible(why) => {
            let proof = if why.certified { "proven" } else { "the search ended" };
            let help = why.change.as_ref().map_or_else(String::new, |change| format!("  help: {change}\n"));
            format!("{query}: {}, {} ({proof})\n{help}", why.reason.name(), why.reason)
        }
        MotionAnswer::Unknown(UnknownReason::Budget) => format!(
            "{query}: unknown, the search was cut short\n  help: `--effort 4` searches four times as long\n"
        ),
        MotionAnswer::Unknown(UnknownReason::Because(why)) => format!("{query}: unknown, {why}\n"),
    }
}

/// An angle in degrees within a half turn to either side: along a path a base may turn further than that.
fn degrees(angle: f64) -> f64 {
    let rounded = angle.to_degrees().round();
    let within = (rounded + 180.0).rem_euclid(360.0) - 180.0;
    if within == -180.0 { 180.0 } else { within }
}

/// The numbers of a reason, by name.
fn numbers(reason: &InfeasibleReason) -> Vec<(&'static str, f64)> {
    match reason {
        InfeasibleReason::OutOfReach { needs, reach, .. } => vec![("needs", *needs), ("reach", *reach)],
        InfeasibleReason::TooHeavy { needs, limit } | InfeasibleReason::TooWide { needs, limit } => {
            vec![("needs", *needs), ("limit", *limit)]
        }
        InfeasibleReason::NotInView { aside: Some(aside), .. } => {
            vec![("needs", aside.needs.abs()), ("limit", aside.limit)]
        }
        InfeasibleReason::NoFreePose { .. }
        | InfeasibleReason::BlockedPath { .. }
        | InfeasibleReason::NotInView { aside: None, .. } => {
            vec![]
        }
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn angles_are_told_within_a_half_turn() {
        for (angle, told) in [(-3.16, 179.0), (3.15, 180.0), (0.0, 0.0), (7.0, 41.0), (-1.57, -90.0)] {
            assert_eq!(super::degrees(angle), told, "{angle}");
        }
    }
}
