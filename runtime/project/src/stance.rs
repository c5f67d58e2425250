//! DraftStance of a robot with a first card: the height of its base above the floor, and a posture free of
//! contacts. `motet robots add` writes it into the card.

use motet_geometry::kinematics::{Dof, quasi_random};
use motet_geometry::planning::{
    AllowedCollisions, Configuration, HandModel, MIN_CLEARANCE, QueryContext, RobotModel, SceneState,
};
use motet_robots::card::{DraftStance, Robot};
use motet_robots::scene::Scene;
use motet_robots::urdf::Urdf;

/// Maximum number of postures that are tried besides the one with every joint at 0.
const POSTURES: usize = 256;

/// Finds the stance of a robot whose card has none.
#[must_use]
pub fn find_stance(robot: &Robot, urdf: &Urdf) -> DraftStance {
    let machine = RobotModel::new(robot, urdf);
    let is_arm = |hand: &HandModel, link: usize| hand.carried.get(link) == Some(&true);
    if machine.drives() {
        let stands = |link: usize| !machine.hand().is_some_and(|hand| is_arm(hand, link));
        let height = above(&machine, stands, 0.0);
        let raised = (height > 0.0).then(|| raised(robot, urdf, height));
        return posture(raised.as_ref().unwrap_or(&machine), height).0;
    }
    let (stance, against) = posture(&machine, 0.0);
    // What is bolted down is on the floor, unless a shape of the arm then is below it wherever its joints
    // are.
    let height =
        if against == Some(Against::Floor) { above(&machine, |_| true, MIN_CLEARANCE + 1e-3) } else { 0.0 };
    let above = (height > 0.0).then(|| posture(&raised(robot, urdf, height), height).0);
    above.filter(|above| above.touch.is_none()).unwrap_or(stance)
}

/// Robot model with its base link raised to `height_m` above the floor.
fn raised(robot: &Robot, urdf: &Urdf, height_m: f64) -> RobotModel {
    let mut robot = robot.clone();
    if let Some(model) = &mut robot.model {
        model.height_m = height_m;
    }
    RobotModel::new(&robot, urdf)
}

/// Other side of a contact.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Against {
    Itself,
    Floor,
}

/// The first posture of the arm in which nothing touches, at a height; where there is none, what the robot
/// touches in the first that was tried.
fn posture(machine: &RobotModel, height_m: f64) -> (DraftStance, Option<Against>) {
    let scene = Scene::default();
    let world = SceneState::new(machine, &scene);
    let room = QueryContext::new(machine, &scene, &world);
    let touch = |joints: &[f64]| {
        let state = Configuration { base: [0.0; 3], joints: joints.to_vec() };
        room.contact(&state, AllowedCollisions::default())
    };
    let Some(first) = touch(machine.rest()) else {
        return (DraftStance { height_m, ..DraftStance::default() }, None);
    };
    let found = machine.hand().and_then(|hand| {
        let chain = hand.solver.chain();
        (0..POSTURES).map(|index| written(&chain.dofs, index)).find(|values| {
            let mut joints = machine.rest().to_vec();
            for (at, value) in chain.in_tree.iter().zip(values) {
                if let Some(slot) = joints.get_mut(*at) {
                    *slot = *value;
                }
            }
            touch(&joints).is_none()
        })
    });
    let dofs = machine.hand().map(|hand| hand.solver.chain().dofs.as_slice()).unwrap_or_default();
    // In a room without a thing, what is not the robot's own is the floor.
    let against = if first.is_own { Against::Itself } else { Against::Floor };
    let against = found.is_none().then_some(against);
    let touch = against.map(|_| [first.link, first.other]);
    let joints = dofs.iter().map(|dof| dof.name.clone()).zip(found.into_iter().flatten());
    (DraftStance { height_m, joints: joints.collect(), touch }, against)
}

/// Height of the base link above the floor, in m and rounded up to a millimetre, with which the chosen links
/// clear the floor by `gap`; 0 if the base link may be on the floor.
fn above(machine: &RobotModel, counts: impl Fn(usize) -> bool, gap: f64) -> f64 {
    let state = Configuration { base: [0.0; 3], joints: machine.rest().to_vec() };
    let below = machine.lowest(&state, counts).map_or(0.0, |(_, height)| gap - height);
    // Less than a hundredth of a millimetre is rounding.
    if below > 1e-5 { ((below - 1e-5) * 1e3).ceil() / 1e3 } else { 0.0 }
}

/// Posture number `index`, rounded to three digits as in a card: the middle of the limits, then a Halton
/// sequence over them.
fn written(dofs: &[Dof], index: usize) -> Vec<f64> {
    let values = quasi_random(dofs, index).into_iter().zip(dofs).map(|(value, dof)| {
        let value = (value * 1e3).round() / 1e3;
        dof.limits.map_or(value, |(lower, upper)| value.clamp(lower, upper))
    });
    values.collect()
}
