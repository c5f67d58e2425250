//! `motet robots check`: whether a card, its declarations and its URDF are sound and fit each other, and what they come to.

use motet_compiler::{Options, Session};
use motet_geometry::kinematics::KinematicChain;
use motet_geometry::planning::{AllowedCollisions, Contact, IkSolver, QueryContext, RobotModel, SceneState};
use motet_robots::card::Robot;
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
            let told = urdf.map_or_else(
                || Told { lines: vec![NO_BODY.to_owned()], warnings: 0 },
                |urdf| told(&robot, &urdf),
            );
            report.warned(told.warnings);
            let title = robot.title.escape_debug();
            report.out.line(&format!("{title} ({}): {}", robot.name, report.tally()));
            for line in told.lines {
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

/// What a body comes to.
struct Told {
    lines: Vec<String>,
    /// How many of the lines warn.
    warnings: usize,
}

impl Told {
    fn warn(&mut self, posture: &str, what: &str, help: &str) {
        self.warnings += 1;
        self.lines.push(format!("{posture:8}  warning: {what}"));
        self.lines.push(format!("{:8}  help: {help}", ""));
    }
}

fn told(robot: &Robot, urdf: &Urdf) -> Told {
    let machine = RobotModel::new(robot, urdf);
    let tree = machine.tree();
    let solids: usize = urdf.links.iter().map(|link| link.collisions.len()).sum();
    let mut lines = vec![format!(
        "body      {}, {}, of which {} by themselves, {} for collision",
        count(urdf.links.len(), "link"),
        count(urdf.joints.len(), "joint"),
        match tree.dofs().len() {
            1 => "1 moves".to_owned(),
            moving => format!("{moving} move"),
        },
        count(solids, "shape"),
    )];
    let base = robot.model.as_ref().and_then(|model| model.base.as_deref());
    let base = base.and_then(|base| tree.link(base).ok()).unwrap_or(tree.root());
    for (name, hand) in &robot.hands {
        let tip = hand.tip.as_deref().and_then(|tip| tree.link(tip).ok());
        let Some(chain) = tip.and_then(|tip| KinematicChain::new(tree, base, tip)) else {
            lines.push(format!("{name:8}  not carried by the base's link"));
            continue;
        };
        // How high the base's link is does not tell which solver it is.
        let found = IkSolver::of(&chain, robot.base.drive, 0.0);
        lines.push(format!("{name:8}  {}: {}", count(chain.dofs.len(), "joint"), solver(&found)));
    }
    lines.extend(machine.body().uncovered_links().iter().filter_map(|link| {
        Some(format!(
            "`{}` has a mesh that is not read, so no motion is computed",
            tree.links().get(*link)?.escape_debug()
        ))
    }));
    let mut told = Told { lines, warnings: 0 };
    postures(&machine, &mut told);
    told
}

/// How far a part may be below the floor: less is how a foot was measured, in m.
const SUNK: f64 = 0.01;

/// What the robot touches in its postures, and what of it is below the floor.
fn postures(machine: &RobotModel, told: &mut Told) {
    let scene = Scene::default();
    let mut world = SceneState::new(machine, &scene);
    for posture in machine.card().postures.keys() {
        let Some(joints) = machine.posture(posture, machine.rest()) else { continue };
        world.robot.joints = joints;
        let room = QueryContext::new(machine, &scene, &world);
        let name = posture.escape_debug().to_string();
        let touch = room.contact(&world.robot, AllowedCollisions::default());
        let sunk = machine.lowest(&world.robot, |_| true).filter(|(_, height)| *height < -SUNK);
        if touch.is_none() && sunk.is_none() {
            told.lines.push(format!("{name:8}  touches neither itself nor the floor"));
        }
        if let Some(Contact { link, other, is_own }) = touch {
            let (link, other) = (link.escape_debug(), other.escape_debug());
            let instead = format!("give joints other positions under `[postures.{name}]`");
            let help = if is_own {
                format!(
                    "{instead}, or an SRDF as `srdf` in `[model]` that lets the two touch: `<disable_collisions link1=\"{link}\" link2=\"{other}\"/>`"
                )
            } else {
                format!("{instead}, or a greater `height` in `[model]`")
            };
            told.warn(&name, &format!("`{link}` touches `{other}`"), &help);
        }
        if let Some((link, height)) = sunk {
            let base = machine.card().model.as_ref().map_or(0.0, |model| model.height_m);
            let what = format!("`{}` is {:.2} m below the floor", link.escape_debug(), -height);
            let help = format!(
                "`height` in `[model]` is how high the base's link is above the floor; with {:.3} m this part is on it",
                base - height
            );
            told.warn(&name, &what, &help);
        }
    }
}

/// How joint positions for a pose of a hand are found.
fn solver(solver: &IkSolver) -> &'static str {
    match solver {
        IkSolver::Lift(_) => "closed form, a lift and a wrist whose axes meet",
        IkSolver::Parallel(_) => "closed form, six joints of which three are parallel",
        IkSolver::Seven(_) => "closed form, seven joints with a shoulder, an elbow and a wrist",
        IkSolver::Steps(_) => "solved in steps",
    }
}
