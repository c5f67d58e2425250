//! `motet robots check`: whether a card, its declarations and its URDF are sound and fit each other, and what they come to.

use motet_compiler::{Options, Session};
use motet_geometry::inverse::{LiftArm, ParallelArm};
use motet_geometry::kinematics::Chain;
use motet_geometry::query::{Allowed, Machine, Room, World};
use motet_robots::card::{Drive, Robot};
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;
use motet_syntax::Sources;

use crate::exit::{Exit, Trouble};
use crate::out::count;
use crate::report::Report;
use crate::workbench::Card;

/// Runs the command.
///
/// # Errors
///
/// There is no such robot, or its files cannot be read.
pub(super) fn run(name: &str, report: &mut Report) -> Result<Exit, Trouble> {
    let card = Card::find(name)?;
    let mut sources = Sources::default();
    let found = card.read(&mut sources, report).and_then(|robot| {
        // Both are looked at, so that all there is to mend is told at once.
        let (_, said) = Session::new(Some(&robot), &[], None, None, Options::default(), &mut sources);
        let declared = report.usable("robot card", &said, &sources);
        let urdf = card.body(&robot, &mut sources, report)?;
        declared.map(|()| (robot, urdf))
    });
    match found {
        Ok((robot, urdf)) => {
            let lines = urdf.map_or_else(|| vec![NO_BODY.to_owned()], |urdf| told(&robot, &urdf));
            report.out.line(&format!("{} ({}): {}", robot.title, robot.name, report.tally()));
            for line in lines {
                report.out.line(&format!("  {line}"));
            }
            Ok(Exit::Clean)
        }
        // What is wrong has been printed.
        Err(Trouble::Diagnosed(_)) => Ok(Exit::Findings),
        Err(other) => Err(other),
    }
}

const NO_BODY: &str = "the card names no URDF under [model], so no motion can be computed";

fn told(robot: &Robot, urdf: &Urdf) -> Vec<String> {
    let machine = Machine::new(robot, urdf);
    let tree = machine.tree();
    let solids: usize = urdf.links.iter().map(|link| link.collisions.len()).sum();
    let mut lines = vec![format!(
        "body      {}, {}, of which {} by themselves, {} for collision",
        count(urdf.links.len(), "link"),
        count(urdf.joints.len(), "joint"),
        match tree.variables().len() {
            1 => "1 moves".to_owned(),
            moving => format!("{moving} move"),
        },
        count(solids, "shape"),
    )];
    let base = robot.model.as_ref().and_then(|model| model.base.as_deref());
    let base = base.and_then(|base| tree.link(base).ok()).unwrap_or(tree.root());
    for (name, hand) in &robot.hands {
        let tip = hand.tip.as_deref().and_then(|tip| tree.link(tip).ok());
        let Some(chain) = tip.and_then(|tip| Chain::new(tree, base, tip)) else {
            lines.push(format!("{name:8}  not carried by the base's link"));
            continue;
        };
        lines.push(format!("{name:8}  {}: {}", count(chain.variables.len(), "joint"), solver(robot, &chain)));
    }
    lines.extend(machine.body().unseen().iter().filter_map(|link| {
        Some(format!("`{}` has a mesh that is not read, so no motion is computed", tree.links().get(*link)?))
    }));
    lines.extend(touching(&machine));
    lines
}

/// Postures in which the robot touches itself or the floor.
fn touching(machine: &Machine) -> Vec<String> {
    let scene = Scene::default();
    let mut world = World::new(machine, &scene);
    let mut lines = Vec::new();
    for posture in machine.card().postures.keys() {
        let Some(joints) = machine.posture(posture, machine.rest()) else { continue };
        world.robot.joints = joints;
        let room = Room::new(machine, &scene, &world);
        lines.push(match room.touch(&world.robot, Allowed::default()) {
            Some(touch) => format!("{posture:8}  warning: `{}` touches `{}`", touch.link, touch.other),
            None => format!("{posture:8}  touches neither itself nor the floor"),
        });
    }
    lines
}

/// How joint positions for a pose of a hand are found.
fn solver(robot: &Robot, chain: &Chain) -> &'static str {
    let drives_anywhere = matches!(robot.base.drive, Drive::Omnidirectional | Drive::Legged);
    if LiftArm::detect(chain).is_some() && drives_anywhere {
        "closed form, a lift and a wrist whose axes meet"
    } else if ParallelArm::detect(chain).is_some() {
        "closed form, six joints of which three are parallel"
    } else {
        "solved in steps"
    }
}
