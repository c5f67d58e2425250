//! Forward kinematics: reference poses, and its laws.

use motet_geometry::kinematics::{KinematicChain, KinematicTree, planar};
use motet_robots::urdf;
use motet_syntax::{FileId, Source};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use serde_json::Value;

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/robots");
const MODELS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../models");

fn tree(path: &str) -> KinematicTree {
    let text = std::fs::read_to_string(path).unwrap();
    let (urdf, found) = urdf::read(&Source::new(path, text), FileId(0));
    assert_eq!(found, []);
    KinematicTree::new(&urdf.unwrap())
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Every row of a file of poses holds, within 1e-9 m and 1e-9 rad. `standing` is where the base's frame is
/// above the floor, for a URDF that leaves the motion of the base to its card.
fn check(poses: &str, urdf: &str, standing: Option<(&str, f64)>) {
    let path = format!("{DATA}/fk/{poses}.jsonl");
    let tree = tree(urdf);
    let mut rows = 0;
    for line in std::fs::read_to_string(path).unwrap().lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        let mut configuration = vec![0.0; tree.dofs().len()];
        let mut base = [0.0; 3];
        for (name, value) in row["q"].as_object().unwrap() {
            let value = value.as_f64().unwrap();
            match (name.as_str(), standing) {
                ("odom_x", Some(_)) => base[0] = value,
                ("odom_y", Some(_)) => base[1] = value,
                ("odom_t", Some(_)) => base[2] = value,
                (name, _) => configuration[tree.dof(name).unwrap()] = value,
            }
        }
        let tip = tree.link(row["tip"].as_str().unwrap()).unwrap();
        let found = match standing {
            Some((root, height)) => {
                let map_from_base = planar(base[0], base[1], base[2]) * Translation3::new(0.0, 0.0, height);
                map_from_base * tree.pose(&configuration, tree.link(root).unwrap(), tip)
            }
            None => tree.pose(&configuration, tree.link(row["base"].as_str().unwrap()).unwrap(), tip),
        };
        let (xyz, q) = (numbers(&row["position"]), numbers(&row["quaternion_xyzw"]));
        let wanted = Isometry3::from_parts(
            Translation3::new(xyz[0], xyz[1], xyz[2]),
            UnitQuaternion::from_quaternion(Quaternion::new(q[3], q[0], q[1], q[2])),
        );
        let (metres, radians) = difference(&found, &wanted);
        assert!(metres < 1e-9 && radians < 1e-9, "{poses} row {rows}: {metres} m, {radians} rad");
        rows += 1;
    }
    println!("{poses} with {urdf}: {rows} rows");
}

fn difference(one: &Isometry3<f64>, other: &Isometry3<f64>) -> (f64, f64) {
    let turned = one.rotation.inverse() * other.rotation;
    let metres = (one.translation.vector - other.translation.vector).norm();
    (metres, 2.0 * turned.imag().norm().atan2(turned.w.abs()))
}

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn forward_kinematics_matches_reference_poses_of_published_urdfs() {
    let urdf = |name: &str| format!("{DATA}/urdf/{name}.urdf");
    check("hsr", &urdf("hsr/hsrb4s"), None);
    check("hsr", &urdf("hsr/hsrb4s_ros2_expanded"), None);
    check("hsr_planar", &urdf("hsr/hsrb4s_planar_base"), None);
    check("anymal_d_z1", &urdf("anymal_d_z1/anymal_d_z1"), None);
    check("anymal_d_z1_planar", &urdf("anymal_d_z1/anymal_d_z1_planar_base"), None);
    check("z1", &urdf("z1/z1_gripper"), None);
    check("z1", &urdf("z1/z1"), None);
    check("panda", &urdf("panda/panda_franka_ros"), None);
}

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn forward_kinematics_matches_reference_poses_of_builtin_robots() {
    let urdf = |name: &str| format!("{MODELS}/{name}/robot.urdf");
    check("hsr", &urdf("hsr"), None);
    check("hsr_planar", &urdf("hsr"), Some(("base_footprint", 0.0)));
    check("anymal_d_z1", &urdf("anymal_z1"), None);
    check("anymal_d_z1_planar", &urdf("anymal_z1"), Some(("base", 0.57)));
    check("z1", &urdf("anymal_z1"), None);
    check("panda", &urdf("panda"), None);
}

#[test]
fn forward_kinematics_agrees_with_itself() {
    let tree = tree(&format!("{MODELS}/hsr/robot.urdf"));
    let configuration: Vec<f64> = (0..tree.dofs().len()).map(|n| 0.1 * (n as f64) - 0.3).collect();
    let all = tree.root_from_links(&configuration);
    let (palm, head) = (tree.link("hand_palm_link").unwrap(), tree.link("head_tilt_link").unwrap());
    let between = tree.pose(&configuration, head, palm);
    assert!(difference(&(all[head].inverse() * all[palm]), &between).0 < 1e-12);
    let chain = KinematicChain::new(&tree, tree.root(), palm).unwrap();
    let values: Vec<f64> = chain.in_tree.iter().map(|at| configuration[*at]).collect();
    assert!(difference(&chain.base_from_tip(&values), &all[palm]).0 < 1e-12);
    assert!(KinematicChain::new(&tree, palm, head).is_none());
    assert_eq!(chain.dofs.len(), 5);
}

#[test]
fn forward_kinematics_moves_mimic_and_planar_joints() {
    let text = "<robot><link name='a'/><link name='b'/><link name='c'/><link name='d'/>
        <joint name='drive' type='planar'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>
        <joint name='one' type='prismatic'><parent link='b'/><child link='c'/><axis xyz='1 0 0'/>
          <limit lower='0' upper='1' velocity='1' effort='1'/></joint>
        <joint name='two' type='prismatic'><parent link='c'/><child link='d'/><axis xyz='1 0 0'/>
          <limit lower='0' upper='1' velocity='1' effort='1'/><mimic joint='one' multiplier='2' \
              offset='0.5'/></joint></robot>";
    let tree = KinematicTree::new(&urdf::read(&Source::new("x", text), FileId(0)).0.unwrap());
    let names: Vec<&str> = tree.dofs().iter().map(|known| known.name.as_str()).collect();
    assert_eq!(names, ["drive/x", "drive/y", "drive/theta", "one"]);
    let pose = tree.pose(&[1.0, 2.0, std::f64::consts::FRAC_PI_2, 0.25], 0, 3);
    let wanted = Isometry3::translation(1.0, 2.0 + 0.25 + 1.0, 0.0);
    assert!((pose.translation.vector - wanted.translation.vector).norm() < 1e-15);
}
