//! `motet robots check`: whether a card and its URDF are sound and fit each other, and what they come to.

use motet_geometry::Tree;
use motet_geometry::inverse::{LiftArm, ParallelArm};
use motet_geometry::kinematics::Chain;
use motet_robots::card::{Drive, Robot};
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
    let found = card
        .read(&mut sources, report)
        .and_then(|robot| card.body(&robot, &mut sources, report).map(|urdf| (robot, urdf)));
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
    let tree = Tree::new(urdf);
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
        let Some(chain) = tip.and_then(|tip| Chain::new(&tree, base, tip)) else {
            lines.push(format!("{name:8}  not carried by the base's link"));
            continue;
        };
        lines.push(format!("{name:8}  {}: {}", count(chain.variables.len(), "joint"), solver(robot, &chain)));
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
