//! `motet robots check`: checks that a card, its declarations and its URDF are correct and fit each other,
//! and describes the body.

use motet_compiler::{Options, Session};
use motet_geometry::kinematics::KinematicChain;
use motet_geometry::planning::{AllowedCollisions, Contact, IkSolver, QueryContext, RobotModel, SceneState};
use motet_project::{ProjectError, RobotFiles, require};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;
use motet_syntax::Sources;

use crate::error::{CliError, Exit};
use crate::output::count;
use crate::report::Report;

/// Runs the command.
///
/// # Errors
///
/// There is no such robot, or its files cannot be read.
pub(super) fn run(name: &str, report: &mut Report) -> Result<Exit, CliError> {
    let files = RobotFiles::find(name)?;
    let mut sources = Sources::default();
    let found = files.card(&mut sources, report).and_then(|robot| {
        // Both are checked, so that one run reports all errors.
        let (_, diagnostics) = Session::new(Some(&robot), &[], None, None, Options::default(), &mut sources);
        let declared = require("robot card", &diagnostics, &sources, report);
        let urdf = files.body(&robot, &mut sources, report)?;
        declared.map(|()| (robot, urdf))
    });
    match found {
        Ok((robot, urdf)) => {
            let described = urdf.map_or_else(
                || BodyReport { lines: vec![NO_BODY.to_owned()], warnings: 0 },
                |urdf| describe(&robot, &urdf),
            );
            report.count_warnings(described.warnings);
            let title = robot.title.escape_debug();
            report.out.line(&format!("{title} ({}): {}", robot.name, report.tally()));
            for line in described.lines {
                report.out.line(&format!("  {line}"));
            }
            Ok(Exit::Success)
        }
        // The errors have been printed.
        Err(ProjectError::Invalid { .. }) => Ok(Exit::Findings),
        Err(other) => Err(other.into()),
    }
}

const NO_BODY: &str = "the card names no URDF under [model], so no motion can be computed";

/// Description of a body.
struct BodyReport {
    lines: Vec<String>,
    /// Number of warnings among the lines.
    warnings: usize,
}

impl BodyReport {
    fn warn(&mut self, posture: &str, what: &str, help: &str) {
        self.warnings += 1;
        self.lines.push(format!("{posture:8}  warning: {what}"));
        self.lines.push(format!("{:8}  help: {help}", ""));
    }
}

fn describe(robot: &Robot, urdf: &Urdf) -> BodyReport {
    let machine = RobotModel::new(robot, urdf);
    let tree = machine.tree();
    let solids: usize = urdf.links.iter().map(|link| link.collisions.len()).sum();
    let mut lines = vec![format!(
        "body      {}, {} ({} independently), {} for collision",
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
            lines.push(format!("{name:8}  not connected to the base link"));
            continue;
        };
        // The height of the base does not change the solver.
        let found = IkSolver::of(&chain, robot.base.drive, 0.0);
        lines.push(format!("{name:8}  {}: {}", count(chain.dofs.len(), "joint"), solver(&found)));
    }
    lines.extend(machine.body().uncovered_links().iter().filter_map(|link| {
        Some(format!(
            "the mesh of `{}` was not read, so no motion is computed",
            tree.links().get(*link)?.escape_debug()
        ))
    }));
    let mut described = BodyReport { lines, warnings: 0 };
    postures(&machine, &mut described);
    described
}

/// Tolerance of a part below the floor, in m: the accuracy of a foot's height.
const FLOOR_TOLERANCE: f64 = 0.01;

/// Describes contacts and parts below the floor in each posture.
fn postures(machine: &RobotModel, described: &mut BodyReport) {
    let scene = Scene::default();
    let mut world = SceneState::new(machine, &scene);
    for posture in machine.card().postures.keys() {
        let Some(joints) = machine.posture(posture, machine.rest()) else { continue };
        world.robot.joints = joints;
        let room = QueryContext::new(machine, &scene, &world);
        let name = posture.escape_debug().to_string();
        let touch = room.contact(&world.robot, AllowedCollisions::default());
        let sunk = machine.lowest(&world.robot, |_| true).filter(|(_, height)| *height < -FLOOR_TOLERANCE);
        if touch.is_none() && sunk.is_none() {
            described.lines.push(format!("{name:8}  touches neither itself nor the floor"));
        }
        if let Some(Contact { link, other, is_own }) = touch {
            let (link, other) = (link.escape_debug(), other.escape_debug());
            let instead = format!("give joints other positions under `[postures.{name}]`");
            let help = if is_own {
                format!(
                    "{instead}, or allow the contact by an SRDF, named as `srdf` in `[model]`: \
                     `<disable_collisions link1=\"{link}\" link2=\"{other}\"/>`"
                )
            } else {
                format!("{instead}, or a greater `height` in `[model]`")
            };
            described.warn(&name, &format!("`{link}` touches `{other}`"), &help);
        }
        if let Some((link, height)) = sunk {
            let base = machine.card().model.as_ref().map_or(0.0, |model| model.height_m);
            let what = format!("`{}` is {:.2} m below the floor", link.escape_debug(), -height);
            let help = format!(
                "`height` in `[model]` is the height of the base link above the floor; \
                 {:.3} m puts this part on the floor",
                base - height
            );
            described.warn(&name, &what, &help);
        }
    }
}

/// Name of the inverse kinematics of a hand.
fn solver(solver: &IkSolver) -> &'static str {
    match solver {
        IkSolver::Lift(_) => "closed form: a lift and a wrist with intersecting axes",
        IkSolver::Parallel(_) => "closed form: six joints, three of them parallel",
        IkSolver::Seven(_) => "closed form: seven joints with shoulder, elbow and wrist",
        IkSolver::Steps(_) => "numeric",
    }
}
