//! MuJoCo models of robots in scenes: snapshots, names, and strange robots. `runtime/mujoco/tests` loads
//! them.

use motet_geometry::mjcf::{self, MjcfError};
use motet_geometry::planning::RobotModel;
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::card::Robot;
use motet_robots::scene::{self, Scene};
use motet_robots::urdf::{self, Urdf};
use motet_syntax::{FileId, Source};

/// Scene with one entity of each sort, and a name with special characters.
const ROOM: &str = r#"{"motet_scene": 1, "robot": {"base": [0.2, -0.1, 0.5]}, "entities": [
  {"id": "table", "kind": "Surface", "fixed": true, "pose": {"xyz": [1.5, 0, 0.35], "rpy": [0, 0, 0]},
   "shape": {"box": [0.6, 1, 0.7]}},
  {"id": "drawer", "kind": "Container", "fixed": true, "pose": {"xyz": [0, 2, 0.5], "rpy": [0, 0, -1.5708]},
   "shape": {"box": [0.4, 0.5, 0.2]}, "travel": {"slide": {"axis": [1, 0, 0], "distance": 0.3}},
   "open": true, "locked": false},
  {"id": "fridge", "kind": "Container", "fixed": true, "pose": {"xyz": [-2, 0, 0.6], "rpy": [0, 0, 0]},
   "shape": {"box": [0.5, 0.6, 1.2]}, "locked": true,
   "travel": {"hinge": {"axis": [0, 0, -1], "at": [0.25, 0.3, 0], "angle": 1.57}}},
  {"id": "bin", "kind": "Container", "fixed": true, "pose": {"xyz": [-1, -1, 0.2], "rpy": [0, 0, 0]},
   "shape": {"cylinder": {"radius": 0.15, "height": 0.4}}},
  {"id": "mug <\"&/%>", "kind": "Object", "names": ["red mug"], "mass": 0.3, "on": "table",
   "pose": {"xyz": [1.3, 0, 0.75], "rpy": [0, 0, 0]}, "shape": {"cylinder": {"radius": 0.04, "height": 0.1}}},
  {"id": "world", "kind": "Object", "on": "table", "pose": {"xyz": [1.3, 0.3, 0.74], "rpy": [0, 0, 0]},
   "shape": {"sphere": {"radius": 0.04}}},
  {"id": "anna", "kind": "Person", "pose": {"xyz": [0, -2, 0], "rpy": [0, 0, 0]}},
  {"id": "door", "kind": "Place", "pose": {"xyz": [3, 0, 0], "rpy": [0, 0, 0]}},
  {"id": "lost", "kind": "Object"}]}"#;

fn scene(text: &str) -> Scene {
    let (room, diagnostics) = scene::read(&Source::new("room.json", text), FileId(0));
    assert_eq!(diagnostics, []);
    room.unwrap()
}

fn model(name: &str, room: &Scene) -> String {
    let RobotWithBody { robot, urdf } = builtin::robot(name).unwrap();
    mjcf::write(&RobotModel::new(&robot, &urdf), &urdf, room).unwrap()
}

#[test]
fn models_of_the_robots() {
    for name in ["hsr", "anymal_z1", "panda"] {
        let written = model(name, &scene(ROOM));
        assert_eq!(written, model(name, &scene(ROOM)), "the same input gives the same model");
        insta::assert_snapshot!(format!("mjcf_{name}"), written);
    }
}

#[test]
fn model_has_the_mass_of_a_held_thing_in_the_hand() {
    let mut room = scene(ROOM);
    room.robot.holding = Some(Some("world".into()));
    let written = model("hsr", &room);
    let body = written.lines().find(|line| line.contains("%77orld\" pos=")).unwrap();
    assert!(!body.contains("1.3 0.3 0.74"), "it is in the hand: {body}");
}

/// Robot with a card that names nothing but a body.
fn plain(urdf: &str) -> (Robot, Urdf) {
    let (body, diagnostics) = urdf::read(&Source::new("robot.urdf", urdf), FileId(0));
    let body = body.unwrap_or_else(|| panic!("{diagnostics:?}"));
    let RobotWithBody { mut robot, .. } = builtin::robot("panda").unwrap();
    robot.hands.clear();
    robot.cameras.clear();
    robot.postures.clear();
    let spec = robot.model.as_mut().unwrap();
    (spec.base, spec.height_m) = (None, 0.0);
    spec.rest.clear();
    (robot, body)
}

fn strange(urdf: &str) -> Result<String, MjcfError> {
    let (robot, body) = plain(urdf);
    mjcf::write(&RobotModel::new(&robot, &body), &body, &scene(ROOM))
}

#[test]
fn strange_robots_have_a_model_or_an_error() {
    let odd = r#"<robot name="r"><link name="a/b"/>
      <link name="b"><collision><geometry><box size="0 0 0"/></geometry></collision></link>
      <link name="c"/><link name="d"/>
      <joint name="p/x" type="planar"><parent link="a/b"/><child link="b"/><axis xyz="0 0 1"/></joint>
      <joint name="q" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/></joint>
      <joint name="m" type="revolute"><parent link="b"/><child link="d"/><limit lower="0" upper="0"/>
        <mimic joint="q" multiplier="2" offset="0.1"/></joint></robot>"#;
    let written = strange(odd).unwrap();
    for part in [
        "name=\"robot/a%2Fb\"",
        "name=\"robot/p%2Fx/theta\"",
        "joint1=\"robot/m\" joint2=\"robot/q\" polycoef=\"0.1 2 0 0 0\"",
        "size=\"0.0001 0.0001 0.0001\"",
    ] {
        assert!(written.contains(part), "{part} in {written}");
    }
    let mut chain = String::from("<robot name=\"r\"><link name=\"l0\"/>");
    for at in 1..600 {
        let (link, parent) = (format!("l{at}"), at - 1);
        chain.push_str(&format!(
            "<link name=\"{link}\"/><joint name=\"j{at}\" type=\"fixed\"><parent link=\"l{parent}\"/>\
             <child link=\"{link}\"/></joint>"
        ));
    }
    chain.push_str("</robot>");
    assert!(matches!(strange(&chain), Err(MjcfError::LongChain(_))));
    let mesh = r#"<robot name="r"><link name="a"><collision><geometry><mesh filename="a.stl"/></geometry>
      </collision></link></robot>"#;
    assert_eq!(strange(mesh), Err(MjcfError::LinkMesh("a".into())));
}
