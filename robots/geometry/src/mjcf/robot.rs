//! Robot of a MuJoCo model: its links, joints and cameras, the position control of its joints, and the
//! grip of its hand.

use motet_robots::urdf::{Joint, JointKind, Pose, Urdf};
use nalgebra::{Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3};

use super::element::{XmlText, name, number, numbers, pose, vector};
use super::geom::{geom, volume};
use crate::kinematics::{JointCoupling, planar};
use crate::planning::{HandModel, RobotModel};

/// Horizontal angle of a camera's picture in rad, as far as the card does not give a smaller one.
const VIEW_RAD: f64 = 1.4;
/// Columns and rows of a picture.
pub(super) const PICTURE: [f64; 2] = [640.0, 480.0];
/// Density of the links in kg/m³: shapes that enclose a part are mostly air.
pub(super) const DENSITY: f64 = 150.0;
/// Volume in m³ below which a link has the inertia of a small part instead of that of its shapes.
const LEAST_VOLUME: f64 = 1e-6;
/// Weights of the heaviest object with which the hand presses from both sides together.
const GRIP_WEIGHTS: f64 = 4.0;
/// Standard gravity in m/s².
const GRAVITY: f64 = 9.81;

/// Position control of a joint.
#[derive(Clone, Copy, Debug)]
struct Servo {
    /// Stiffness in N/m or Nm/rad.
    stiffness: f64,
    /// Greatest force in N or Nm.
    force: f64,
    /// Inertia of the motor in kg or kg·m².
    inertia: f64,
}

/// Inertia of a joint that follows another, in kg or kg·m².
const FOLLOWER_INERTIA: f64 = 0.01;
/// Servo of the base's slides.
const BASE: Servo = Servo { stiffness: 60_000.0, force: 1_500.0, inertia: 20.0 };
/// Servo of the base's turns.
const TURN: Servo = Servo { stiffness: 20_000.0, force: 600.0, inertia: 2.0 };
/// Servo of a sliding joint.
const SLIDE: Servo = Servo { stiffness: 40_000.0, force: 2_000.0, inertia: 5.0 };
/// Servo of a turning joint.
const HINGE: Servo = Servo { stiffness: 3_000.0, force: 250.0, inertia: 0.2 };

/// Joints of the robot in the order of the model.
#[derive(Debug)]
pub(super) struct RobotLayout {
    drives: bool,
    /// Coupling of each joint to a degree of freedom.
    joints: Vec<JointCoupling>,
    /// Degree of freedom and servo of each actuator after those of the base.
    actuators: Vec<(usize, Servo)>,
    /// Names of joints that follow others, with the leader's name and the coupling.
    followers: Vec<(String, String, JointCoupling)>,
}

/// Part of a degree of freedom in the robot.
#[derive(Clone, Copy, PartialEq, Debug)]
enum DofRole {
    /// Joint of the hand that opens and closes it.
    Grip,
    /// Joint of a finger that gives way.
    Spring,
    /// Any other joint: it keeps its position.
    Servo,
}

/// Writes the links, with the base at a pose.
pub(super) fn body(xml: &mut XmlText, model: &RobotModel, urdf: &Urdf, base: [f64; 3]) -> RobotLayout {
    let drives = model.drives();
    let [x, y, yaw] = if drives { [0.0; 3] } else { base };
    let mut attributes = vec![("name", "robot".to_owned()), ("gravcomp", "1".into())];
    attributes.extend(pose(&planar(x, y, yaw)));
    xml.open("body", &attributes);
    if drives {
        for (at, kind, axis, servo) in [
            ("base/x", "slide", "1 0 0", BASE),
            ("base/y", "slide", "0 1 0", BASE),
            ("base/yaw", "hinge", "0 0 1", TURN),
        ] {
            xml.leaf(
                "joint",
                &[
                    ("name", at.into()),
                    ("type", kind.into()),
                    ("axis", axis.into()),
                    ("armature", number(servo.inertia)),
                ],
            );
        }
        small_part(xml);
    }
    let mut layout = RobotLayout { drives, joints: vec![], actuators: vec![], followers: vec![] };
    links(xml, model, urdf, &mut layout);
    xml.close();
    layout
}

/// Inertia of a part without shapes.
fn small_part(xml: &mut XmlText) {
    xml.leaf(
        "inertial",
        &[("pos", "0 0 0".into()), ("mass", "0.05".into()), ("diaginertia", "0.0001 0.0001 0.0001".into())],
    );
}

/// Writes the tree of links, without recursion: a chain may be long.
fn links(xml: &mut XmlText, model: &RobotModel, urdf: &Urdf, layout: &mut RobotLayout) {
    let mut children: Vec<Vec<&Joint>> = vec![vec![]; urdf.links.len()];
    for joint in &urdf.joints {
        if let Some(list) = children.get_mut(joint.parent) {
            list.push(joint);
        }
    }
    enum Step<'u> {
        Enter(usize, Option<&'u Joint>),
        Leave,
    }
    let mut hand_parts = 0;
    let mut open = vec![Step::Enter(urdf.root, None)];
    while let Some(step) = open.pop() {
        let Step::Enter(link, joint) = step else {
            xml.close();
            continue;
        };
        let parent_from_link = match joint {
            Some(joint) => isometry(&joint.parent_from_joint),
            None => model.map_from_root([0.0; 3]),
        };
        let called = urdf.links.get(link).map(|link| name(&link.name)).unwrap_or_default();
        let mut attributes = vec![("name", format!("robot/{called}")), ("gravcomp", "1".into())];
        attributes.extend(pose(&parent_from_link));
        xml.open("body", &attributes);
        if let Some(joint) = joint {
            self::joint(xml, model, joint, layout);
        }
        parts(xml, model, link, &mut hand_parts);
        open.push(Step::Leave);
        let list = children.get(link).into_iter().flatten().rev();
        open.extend(list.map(|joint| Step::Enter(joint.child, Some(*joint))));
    }
}

/// Writes the joints of a link.
fn joint(xml: &mut XmlText, model: &RobotModel, joint: &Joint, layout: &mut RobotLayout) {
    let tree = model.tree();
    let own = tree.ancestor_joints(joint.child).into_iter().filter(|own| own.frame == joint.child);
    let is_planar = joint.kind == JointKind::Planar;
    for own in own {
        let coupling = own.coupling;
        let Some(dof) = tree.dofs().get(coupling.dof) else { continue };
        let follows = !is_planar && joint.name != dof.name;
        let called = if is_planar { joint_name(&dof.name) } else { format!("robot/{}", name(&joint.name)) };
        let mut attributes = vec![
            ("name", called.clone()),
            ("type", if own.is_prismatic { "slide" } else { "hinge" }.to_owned()),
            ("axis", vector(&own.axis)),
        ];
        if let Some((lower, upper)) = dof.limits.filter(|_| !follows) {
            // MuJoCo has no joint with one position.
            attributes.push(("range", numbers([lower, upper.max(lower + 1e-6)])));
        }
        let role = role(model, coupling.dof);
        let servo = servo(model, coupling.dof, role);
        attributes.push(("armature", number(if follows { FOLLOWER_INERTIA } else { servo.inertia })));
        if role == DofRole::Spring && !follows {
            let rest = model.rest().get(coupling.dof).copied().unwrap_or_default();
            attributes.extend([
                ("stiffness", number(servo.stiffness)),
                ("springref", number(rest)),
                ("damping", number(servo.stiffness * 0.02)),
            ]);
        }
        xml.leaf("joint", &attributes);
        layout.joints.push(coupling);
        if follows {
            layout.followers.push((called, joint_name(&dof.name), coupling));
        } else if role != DofRole::Spring {
            layout.actuators.push((coupling.dof, servo));
        }
    }
}

/// Name of the joint of a degree of freedom. Those of a planar joint are `NAME/x`, `NAME/y` and `NAME/theta`.
fn joint_name(dof: &str) -> String {
    let part = ["/x", "/y", "/theta"].into_iter().find_map(|end| Some((dof.strip_suffix(end)?, end)));
    part.map_or_else(|| format!("robot/{}", name(dof)), |(stem, end)| format!("robot/{}{end}", name(stem)))
}

fn role(model: &RobotModel, dof: usize) -> DofRole {
    let Some(hand) = model.hand() else { return DofRole::Servo };
    if hand.open.iter().any(|(at, _)| *at == dof) {
        return DofRole::Grip;
    }
    let moved = moved_links(model, dof);
    let is_finger = moved.iter().all(|link| hand.members.get(*link) == Some(&true));
    let is_arm = hand.solver.chain().in_tree.contains(&dof);
    if is_finger && !is_arm && !moved.is_empty() { DofRole::Spring } else { DofRole::Servo }
}

/// Links that a degree of freedom moves.
fn moved_links(model: &RobotModel, dof: usize) -> Vec<usize> {
    let is_moved = |link: &usize| model.ancestor_joints(*link).iter().any(|own| own.coupling.dof == dof);
    (0..model.tree().links().len()).filter(is_moved).collect()
}

fn servo(model: &RobotModel, dof: usize, role: DofRole) -> Servo {
    let slides = model.tree().dofs().get(dof).is_some_and(|dof| dof.is_prismatic);
    match (role, slides) {
        (DofRole::Servo, false) => HINGE,
        (DofRole::Servo, true) => SLIDE,
        (DofRole::Spring, false) => Servo { stiffness: 4.0, force: 0.0, inertia: 0.001 },
        (DofRole::Spring, true) => Servo { stiffness: 1_000.0, force: 0.0, inertia: 0.05 },
        (DofRole::Grip, _) => {
            let payload = model.hand().map_or(0.0, |hand| hand.card.payload_kg);
            let force = (payload * GRAVITY * GRIP_WEIGHTS).max(5.0);
            if slides {
                Servo { stiffness: force * 100.0, force, inertia: 0.1 }
            } else {
                let force = force * lever(model, dof);
                Servo { stiffness: force * 10.0, force, inertia: 0.002 }
            }
        }
    }
}

/// Greatest distance of a part of the hand from the joint that closes it, in m.
fn lever(model: &RobotModel, dof: usize) -> f64 {
    let poses = model.tree().root_from_links(model.rest());
    let parts = model.body().parts().iter().flat_map(|part| {
        let own = model.ancestor_joints(part.link).iter().find(|own| own.coupling.dof == dof);
        own.and_then(|own| {
            let frame = poses.get(own.frame)?.inverse() * poses.get(part.link)?;
            Some((frame * nalgebra::Point3::from(part.solid.centre)).coords.norm())
        })
    });
    parts.fold(0.02, f64::max)
}

/// Writes the shapes, cameras and the hand of a link.
fn parts(xml: &mut XmlText, model: &RobotModel, link: usize, hand_parts: &mut usize) {
    let hand = model.hand();
    let has = |flags: Option<&Vec<bool>>| flags.is_some_and(|all| all.get(link) == Some(&true));
    let class = if has(hand.map(|hand| &hand.members)) {
        "hand"
    } else if has(hand.map(|hand| &hand.carried)) {
        "arm"
    } else {
        "robot"
    };
    let solids = model.body().parts().iter().filter(|part| part.link == link);
    let solids: Vec<_> = solids.map(|part| part.solid).collect();
    if solids.iter().map(volume).sum::<f64>() < LEAST_VOLUME {
        small_part(xml);
    }
    for solid in &solids {
        let mut attributes = vec![("class", class.to_owned())];
        if class == "hand" {
            attributes.push(("name", format!("hand/{hand_parts}")));
            *hand_parts += 1;
        }
        attributes.extend(geom(solid));
        xml.leaf("geom", &attributes);
    }
    for (called, camera) in &model.card().cameras {
        if camera.frame.as_ref() == model.tree().links().get(link) {
            let half = libm::tan(camera.view_rad.min(VIEW_RAD) / 2.0);
            let upright = 2.0 * libm::atan(half * PICTURE[1] / PICTURE[0]);
            xml.leaf(
                "camera",
                &[
                    ("name", name(called)),
                    // MuJoCo's cameras look against z, with y up.
                    ("quat", "0 1 0 0".into()),
                    ("fovy", number(upright.to_degrees())),
                    ("resolution", numbers(PICTURE)),
                ],
            );
        }
    }
    if let Some(hand) = hand.filter(|hand| hand.tip == link) {
        let mut attributes = vec![("name", "robot/hand".to_owned()), ("size", "0.005".into())];
        attributes.extend(pose(&Isometry3::from_parts(Translation3::identity(), axes(hand))));
        attributes.push(("group", "4".into()));
        xml.leaf("site", &attributes);
    }
}

/// Rotation with z along the fingers and y along their closing.
fn axes(hand: &HandModel) -> UnitQuaternion<f64> {
    let (points, closes) = (Vector3::from(hand.card.points), Vector3::from(hand.card.closes));
    let columns = Matrix3::from_columns(&[closes.cross(&points), closes, points]);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(columns))
}

fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [x, y, z, w] = pose.quaternion_xyzw;
    let rotation = Unit::new_unchecked(Quaternion::new(w, x, y, z));
    Isometry3::from_parts(Translation3::from(Vector3::from(pose.xyz)), rotation)
}

impl RobotLayout {
    /// Positions of all joints.
    pub(super) fn positions(&self, base: [f64; 3], joints: &[f64]) -> Vec<f64> {
        let base = base.into_iter().filter(|_| self.drives);
        base.chain(self.joints.iter().map(|coupling| coupling.position(joints))).collect()
    }

    /// Targets of all actuators.
    pub(super) fn controls(&self, base: [f64; 3], joints: &[f64]) -> Vec<f64> {
        let base = base.into_iter().filter(|_| self.drives);
        let joints = self.actuators.iter().map(|(dof, _)| joints.get(*dof).copied().unwrap_or_default());
        base.chain(joints).collect()
    }

    /// Writes the actuators, and the numbers about what they move.
    pub(super) fn actuators(&self, xml: &mut XmlText, model: &RobotModel, urdf: &Urdf) {
        xml.open("actuator", &[]);
        if self.drives {
            for (at, servo) in [("base/x", BASE), ("base/y", BASE), ("base/yaw", TURN)] {
                position(xml, at, servo);
            }
        }
        let called =
            |dof: usize| model.tree().dofs().get(dof).map(|dof| joint_name(&dof.name)).unwrap_or_default();
        for (dof, servo) in &self.actuators {
            position(xml, &called(*dof), *servo);
        }
        xml.close();
        xml.open("custom", &[]);
        for (dof, open) in model.hand().into_iter().flat_map(|hand| &hand.open) {
            let rest = model.rest().get(*dof).copied().unwrap_or_default();
            let called = called(*dof).replacen("robot/", "hand/", 1);
            xml.leaf("numeric", &[("name", called), ("data", numbers([*open, rest]))]);
        }
        for (dof, _) in &self.actuators {
            let called = called(*dof).replacen("robot/", "speed/", 1);
            xml.leaf("numeric", &[("name", called), ("data", number(speed(model, urdf, *dof)))]);
        }
        xml.close();
    }

    /// Writes the joints that follow others.
    pub(super) fn couplings(&self, xml: &mut XmlText) {
        for (follower, leader, coupling) in &self.followers {
            xml.leaf(
                "joint",
                &[
                    ("joint1", follower.clone()),
                    ("joint2", leader.clone()),
                    ("polycoef", numbers([coupling.offset, coupling.multiplier, 0.0, 0.0, 0.0])),
                    ("solref", "0.004 1".into()),
                    // Fingers stay level under load.
                    ("solimp", "0.999 0.9999 0.001".into()),
                ],
            );
        }
    }
}

/// Speed in rad/s or m/s of joints for which the URDF gives none.
const SPEEDS: [f64; 2] = [1.0, 0.1];

/// Greatest speed of a degree of freedom: that of its joint and of all that follow it.
fn speed(model: &RobotModel, urdf: &Urdf, dof: usize) -> f64 {
    let limits = urdf.joints.iter().filter_map(|joint| {
        let own = model.ancestor_joints(joint.child).iter().rfind(|own| own.frame == joint.child)?;
        let share = own.coupling.multiplier.abs();
        Some(joint.velocity.filter(|_| own.coupling.dof == dof && share > 0.0)? / share)
    });
    let [turning, sliding] = SPEEDS;
    let slides = model.tree().dofs().get(dof).is_some_and(|dof| dof.is_prismatic);
    let limits = limits.filter(|limit| *limit > 0.0);
    limits.reduce(f64::min).unwrap_or(if slides { sliding } else { turning })
}

/// Writes an actuator that keeps a position.
fn position(xml: &mut XmlText, joint: &str, servo: Servo) {
    xml.leaf(
        "position",
        &[
            ("name", joint.to_owned()),
            ("joint", joint.to_owned()),
            ("kp", number(servo.stiffness)),
            ("dampratio", "1".into()),
            ("forcerange", numbers([-servo.force, servo.force])),
        ],
    );
}
