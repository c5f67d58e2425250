//! An independent check of a witness: own forward kinematics from the URDF's joints, own placing of its
//! shapes, distances from parry3d, and samples along every leg no farther than 5 mm and 0.6° apart. Shared
//! with the query are the reader of the URDF and which links may touch.

use std::collections::BTreeSet;

use glamx::{DPose3, DVec3};
use motet_geometry::planning::{Articulation, Configuration, MotionWitness, RobotModel, SceneState};
use motet_robots::scene::{self, Scene};
use motet_robots::urdf::{JointKind, Pose, Urdf, UrdfShape};
use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use parry3d_f64::query;
use parry3d_f64::shape;

type Solid = (Isometry3<f64>, Box<dyn shape::Shape>);

pub(crate) fn isometry(pose: &Pose) -> Isometry3<f64> {
    let [x, y, z] = pose.xyz;
    let [i, j, k, w] = pose.quaternion_xyzw;
    Isometry3::from_parts(
        Translation3::new(x, y, z),
        UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k)),
    )
}

/// Poses of links in the map.
fn links(machine: &RobotModel, urdf: &Urdf, state: &Configuration) -> Vec<Isometry3<f64>> {
    let value = |joint: usize| {
        let (mut factor, mut offset, mut at) = (1.0, 0.0, joint);
        while let Some(mimic) = urdf.joints[at].mimic {
            offset += factor * mimic.offset;
            factor *= mimic.multiplier;
            at = mimic.joint;
        }
        let own = machine.tree().dof(&urdf.joints[at].name).map_or(0.0, |at| state.joints[at]);
        factor * own + offset
    };
    let mut poses = vec![Isometry3::identity(); urdf.links.len()];
    for (joint, at) in urdf.joints.iter().zip(0..) {
        let axis = Unit::new_normalize(Vector3::from(joint.axis));
        let moved = match joint.kind {
            JointKind::Revolute | JointKind::Continuous => Isometry3::from_parts(
                Translation3::identity(),
                UnitQuaternion::from_axis_angle(&axis, value(at)),
            ),
            JointKind::Prismatic => Translation3::from(axis.into_inner() * value(at)).into(),
            _ => Isometry3::identity(),
        };
        poses[joint.child] = poses[joint.parent] * isometry(&joint.parent_from_joint) * moved;
    }
    let model = machine.card().model.as_ref().unwrap();
    let base = model.base.as_ref().map_or(urdf.root, |base| urdf.link(base).unwrap());
    let [x, y, yaw] = state.base;
    let map_from_base = Isometry3::from_parts(
        Translation3::new(x, y, model.height_m),
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw),
    );
    let map_from_root = map_from_base * poses[base].inverse();
    poses.iter().map(|pose| map_from_root * pose).collect()
}

fn upright(pose: Isometry3<f64>) -> Isometry3<f64> {
    // parry's cylinder lies along y.
    pose * UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::FRAC_PI_2)
}

fn of_urdf(shape: &UrdfShape, pose: Isometry3<f64>) -> Solid {
    match *shape {
        UrdfShape::Box([x, y, z]) => (pose, Box::new(shape::Cuboid::new(DVec3::new(x, y, z) / 2.0))),
        UrdfShape::Cylinder { radius, length } => {
            (upright(pose), Box::new(shape::Cylinder::new(length / 2.0, radius)))
        }
        UrdfShape::Capsule { radius, length } => {
            (pose, Box::new(shape::Capsule::new_z(length / 2.0, radius)))
        }
        UrdfShape::Sphere { radius } => (pose, Box::new(shape::Ball::new(radius))),
        UrdfShape::Mesh { .. } => panic!("no meshes here"),
    }
}

fn of_scene(shape: &scene::EntityShape, pose: Isometry3<f64>) -> Solid {
    match *shape {
        scene::EntityShape::Box([x, y, z]) => (pose, Box::new(shape::Cuboid::new(DVec3::new(x, y, z) / 2.0))),
        scene::EntityShape::Cylinder { radius, height } => {
            (upright(pose), Box::new(shape::Cylinder::new(height / 2.0, radius)))
        }
        scene::EntityShape::Capsule { radius, height } => {
            (pose, Box::new(shape::Capsule::new_z(height / 2.0, radius)))
        }
        scene::EntityShape::Sphere { radius } => (pose, Box::new(shape::Ball::new(radius))),
        scene::EntityShape::Mesh { .. } => panic!("no meshes here"),
    }
}

fn distance(one: &Solid, other: &Solid) -> f64 {
    let ball = |solid: &Solid| solid.1.compute_bounding_sphere(&DPose3::from(solid.0));
    let (near, far) = (ball(one), ball(other));
    let between = (near.center - far.center).length() - near.radius - far.radius;
    if between.is_finite() && between > 0.01 {
        return between;
    }
    query::distance(&DPose3::from(one.0), one.1.as_ref(), &DPose3::from(other.0), other.1.as_ref())
        .unwrap()
        .distance
}

/// Faults of a witness; none where it holds. Containers have to be closed. The held object may touch
/// `support` from where it is lowered onto it.
pub(crate) fn faults(
    machine: &RobotModel,
    urdf: &Urdf,
    scene: &Scene,
    world: &SceneState,
    witness: &MotionWitness,
    support: Option<&str>,
) -> Vec<String> {
    let hand = machine.hand().unwrap();
    let around = |_: usize, _: f64| closed(scene, world, None);
    let grasped = witness.grasp.as_ref().map(|grasp| grasp.object.as_str());
    let mut faults = legs(machine, urdf, scene, world, witness, [grasped, support], around);
    if let Some(grasp) = &witness.grasp {
        let last = links(machine, urdf, witness.path.last().unwrap())[hand.tip];
        let off = last.inverse() * grasp.map_from_tip;
        if off.translation.vector.norm() > 1e-6 || off.rotation.angle() > 1e-6 {
            faults.push("the hand does not end at the grasp".into());
        }
        if grasp.width > hand.card.opening_m {
            faults.push("too wide".into());
        }
    }
    faults
}

/// Faults of a witness of `pull` or `push`. From the way-point at which the hand is around the handle, the
/// container opens evenly, leg by leg; its solids at each part of the travel come from the code under test.
pub(crate) fn faults_of_pull(
    machine: &RobotModel,
    urdf: &Urdf,
    scene: &Scene,
    world: &SceneState,
    witness: &MotionWitness,
) -> Vec<String> {
    let hand = machine.hand().unwrap();
    let grasp = witness.grasp.as_ref().unwrap();
    let entity = &scene.entities[&grasp.object];
    let opening = Articulation::new(entity, world).unwrap();
    let was = if world.is_open(entity) { 1.0 } else { 0.0 };
    let tip = |state: &Configuration| links(machine, urdf, state)[hand.tip];
    let is_at = |state: &Configuration| {
        let off = tip(state).inverse() * grasp.map_from_tip;
        off.translation.vector.norm() < 1e-6 && off.rotation.angle() < 1e-6
    };
    let Some(begin) = witness.path.iter().rposition(is_at) else { return vec!["not at the handle".into()] };
    let count = (witness.path.len() - 1 - begin) as f64;
    let part = |leg: usize, share: f64| {
        let done = if leg < begin { 0.0 } else { ((leg - begin) as f64 + share) / count };
        (was - done).abs()
    };
    let around = |leg: usize, share: f64| {
        let mut all = closed(scene, world, Some(&grasp.object));
        // Closed and not begun it is as solid as it looks.
        let solids = if leg < begin && was == 0.0 {
            vec![of_scene(entity.shape.as_ref().unwrap(), world.pose(entity).unwrap())]
        } else {
            opening.solids(part(leg, share)).iter().map(of_box).collect()
        };
        // What lies in a drawer goes with it.
        let moved = opening.map_moved(part(leg, share)) * opening.map_moved(was).inverse();
        let inside = |id: &str| scene.entities[id].inside.as_ref() == Some(&grasp.object);
        all.iter_mut().filter(|(id, _)| inside(id)).for_each(|(_, (pose, _))| *pose = moved * *pose);
        all.extend(solids.into_iter().map(|solid| (grasp.object.as_str(), solid)));
        all
    };
    let mut faults = legs(machine, urdf, scene, world, witness, [None, None], around);
    let handle = grasp.map_from_tip * grasp.tip_from_object;
    let far = grasp.tip_from_object.translation.vector.norm();
    for leg in begin..witness.path.len() - 1 {
        for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let state = witness.path[leg].towards(&witness.path[leg + 1], share);
            let moved = opening.map_moved(part(leg, share)) * opening.map_moved(was).inverse();
            let now = (tip(&state).translation.vector - (moved * handle).translation.vector).norm();
            if (now - far).abs() > 0.003 {
                faults.push(format!("leg {leg}: the hand is {:.4} m off the handle", (now - far).abs()));
            }
        }
    }
    faults
}

/// Solids of all entities, closed, except one.
fn closed<'s>(scene: &'s Scene, world: &SceneState, but: Option<&str>) -> Vec<(&'s str, Solid)> {
    let others = scene.entities.values().filter(|entity| !world.holds(&entity.id) && but != Some(&entity.id));
    let placed = others.filter_map(|entity| {
        Some((entity.id.as_str(), of_scene(entity.shape.as_ref()?, world.pose(entity)?)))
    });
    placed.collect()
}

fn of_box(solid: &motet_geometry::collision::Solid) -> Solid {
    let motet_geometry::collision::Shape::Box(half) = solid.shape else { panic!("walls are boxes") };
    let axes = nalgebra::Matrix3::from_columns(&solid.axes);
    let rotation = UnitQuaternion::from_matrix(&axes);
    let pose = Isometry3::from_parts(Translation3::from(solid.centre), rotation);
    (pose, Box::new(shape::Cuboid::new(DVec3::new(half.x, half.y, half.z))))
}

/// Contacts along the legs of a witness, with the obstacles at a share of each. Of `free` the hand may touch
/// the first from where it is in front of it, and the held object the second.
fn legs<'s>(
    machine: &RobotModel,
    urdf: &Urdf,
    scene: &'s Scene,
    world: &SceneState,
    witness: &MotionWitness,
    [grasped, support]: [Option<&str>; 2],
    around: impl Fn(usize, f64) -> Vec<(&'s str, Solid)>,
) -> Vec<String> {
    let mut faults = Vec::new();
    let hand = machine.hand().unwrap();
    let floor: Solid = (Isometry3::identity(), Box::new(shape::HalfSpace::new(DVec3::Z)));
    let parts = machine.body().parts();
    let pairs: BTreeSet<[usize; 2]> =
        machine.body().pairs().iter().map(|[one, other]| [parts[*one].link, parts[*other].link]).collect();
    if witness.path.first() != Some(&world.robot) {
        faults.push("does not begin where the robot is".into());
    }
    // Where the hand is in front of the thing: from there on it may touch it.
    let near = witness.grasp.as_ref().map_or(usize::MAX, |grasp| {
        let place = |state: &Configuration| links(machine, urdf, state)[hand.tip].translation.vector;
        let at = grasp.map_from_tip.translation.vector;
        witness.path.iter().position(|state| (place(state) - at).norm() < 0.11).unwrap_or(usize::MAX)
    });
    for (pair, leg) in witness.path.windows(2).zip(0..) {
        let [from, to] = pair else { unreachable!() };
        let turn = (to.base[2] - from.base[2]).abs();
        let drive = (to.base[0] - from.base[0]).hypot(to.base[1] - from.base[1]);
        let joints = from.joints.iter().zip(&to.joints).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let steps = (drive / 0.005).max(turn / 0.01).max(joints / 0.01).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let state = from.towards(to, step as f64 / steps as f64);
            if !machine.tree().allows(&state.joints) {
                faults.push(format!("leg {leg}: beyond the limits"));
            }
            let obstacles = around(leg, step as f64 / steps as f64);
            let poses = links(machine, urdf, &state);
            let solids: Vec<(usize, Solid)> = (urdf.links.iter().enumerate())
                .flat_map(|(at, link)| link.collisions.iter().map(move |solid| (at, solid)))
                .map(|(at, solid)| (at, of_urdf(&solid.shape, poses[at] * isometry(&solid.link_from_shape))))
                .collect();
            for (at, solid) in &solids {
                if !machine.drives() && !hand.carried[*at] {
                    continue;
                }
                for (name, obstacle) in &obstacles {
                    if grasped == Some(name) && hand.members[*at] && leg >= near {
                        continue;
                    }
                    if distance(solid, obstacle) <= 0.001 {
                        faults.push(format!("leg {leg}, step {step}: {} and {name}", urdf.links[*at].name));
                    }
                }
                if hand.carried[*at] && distance(solid, &floor) <= 0.001 {
                    faults.push(format!("leg {leg}, step {step}: {} and the floor", urdf.links[*at].name));
                }
            }
            let held = world.held.as_ref().map(|(id, tip_from_object)| {
                of_scene(scene.entities[id].shape.as_ref().unwrap(), poses[hand.tip] * tip_from_object)
            });
            if let Some(solid) = &held {
                for (name, obstacle) in &obstacles {
                    if !(support == Some(name) && leg >= near) && distance(solid, obstacle) <= 0.001 {
                        faults.push(format!("leg {leg}, step {step}: what is held and {name}"));
                    }
                }
                if distance(solid, &floor) <= 0.001 {
                    faults.push(format!("leg {leg}, step {step}: what is held and the floor"));
                }
                for (at, own) in solids.iter().filter(|(at, _)| !hand.members[*at]) {
                    if distance(solid, own) <= 0.001 {
                        faults.push(format!(
                            "leg {leg}, step {step}: what is held and {}",
                            urdf.links[*at].name
                        ));
                    }
                }
            }
            for (index, (one, solid)) in solids.iter().enumerate() {
                for (other, beyond) in &solids[index + 1..] {
                    if pairs.contains(&[*one, *other]) && distance(solid, beyond) <= 0.001 {
                        let name = |at: usize| &urdf.links[at].name;
                        faults.push(format!("leg {leg}, step {step}: {} and {}", name(*one), name(*other)));
                    }
                }
            }
        }
    }
    faults
}
