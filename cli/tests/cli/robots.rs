//! `motet robots add` and `check` with files of ROS packages: a xacro, meshes, several arms.

use super::support::Place;

/// A box of 0.6 × 0.05 × 0.05 m around a centre, as COLLADA in millimetres.
fn collada(centre_x_mm: f64) -> String {
    let corner = |at: usize| {
        let side = |axis: usize, half: f64| if at >> axis & 1 == 0 { -half } else { half };
        format!("{} {} {}", centre_x_mm + side(0, 300.0), side(1, 25.0), side(2, 25.0))
    };
    let corners: Vec<String> = (0..8).map(corner).collect();
    let faces = "0 1 3 2 4 5 7 6 0 1 5 4 2 3 7 6 0 2 6 4 1 3 7 5";
    format!(
        r##"<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"><asset><unit meter="0.001"/></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="24">{}</float_array>
<technique_common><accessor source="#a" count="8" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="6"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4 4 4 4 4 4</vcount>
<p>{faces}</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>"##,
        corners.join(" ")
    )
}

/// An arm of three joints whose last link, a mesh, is in the base where every joint is at 0.
const FOLDED: &str = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="folded">
<xacro:arg name="size" default="0.02"/>
<xacro:include filename="$(find parts)/urdf/turn.xacro"/>
<link name="base"><collision><origin xyz="0 0 0.5"/><geometry>
    <box size="$(arg size) $(arg size) $(arg size)"/>
</geometry></collision></link><link name="one"/><link name="two"/>
<link name="tool0"><collision><geometry><mesh filename="package://parts/meshes/blade.dae"/></geometry>
    </collision>
</link>
<xacro:turn name="turn" parent="base" child="one" at="0 0 0.5" axis="0 0 1" lower="-3" upper="3"/>
<xacro:turn name="lift" parent="one" child="two" at="0 0 0" axis="0 1 0" lower="-1" upper="0"/>
<xacro:turn name="bend" parent="two" child="tool0" at="0.5 0 0" axis="0 1 0" lower="0" upper="3"/></robot>"#;

const TURN: &str = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="turn" params="name parent child at axis lower upper"><joint name="${name}" type="revolute">
<origin xyz="${at}"/><parent link="${parent}"/><child link="${child}"/><axis xyz="${axis}"/>
<limit lower="${lower}" upper="${upper}" velocity="1" effort="1"/></joint></xacro:macro></robot>"#;

/// The packages of the folded arm; `mesh` is the blade.
fn packages(name: &str, mesh: Option<&str>) -> Place {
    let place = Place::new(name)
        .file("ros/folded/package.xml", "")
        .file("ros/folded/urdf/folded.urdf.xacro", FOLDED)
        .file("ros/parts/package.xml", "")
        .file("ros/parts/urdf/turn.xacro", TURN);
    match mesh {
        Some(mesh) => place.file("ros/parts/meshes/blade.dae", mesh),
        None => place,
    }
}

const ADD: &str = "robots add ros/folded/urdf/folded.urdf.xacro --packages ros --arg size:=0.2 --to card";

#[test]
fn add_expands_a_xacro_and_chooses_a_posture_with_its_meshes() {
    let place = packages("robots_xacro", Some(&collada(-150.0)));
    let ran = place.run(ADD);
    ran.check(0, &["out:wrote card/robot.urdf, expanded from the xacro", "out:wrote card/robot.toml"]);
    assert!(!ran.stdout.contains("warning"), "{ran:#?}");
    assert!(place.read("card/robot.urdf").contains("size=\"0.2 0.2 0.2\""));
    let card = place.read("card/robot.toml");
    assert!(card.contains("/ros\"]") && !card.contains("\"bend\" = 0\n"), "{card}");
    place
        .run("robots check card")
        .check(0, &["out:no errors\n", "out:home      touches neither itself nor the floor\n"]);
    place.run(ADD).check(2, &["err:exists already"]);
    // Without the argument the base is too small to be in the way.
    place.run(&ADD.replace("--arg size:=0.2 --to card", "--to small")).check(0, &[]);
    assert!(place.read("small/robot.toml").contains("\"bend\" = 0\n"));
    place.run(&ADD.replace("size:=0.2 --to card", "size --to other")).check(2, &["err:is no NAME:=VALUE"]);
    let lost = ADD.replace("--packages ros", "--packages ros/folded").replace("--to card", "--to lost");
    place.run(&lost).check(2, &["err:parts"]);
}

#[test]
fn add_tells_the_meshes_that_it_could_not_read() {
    let place = packages("robots_unread", None);
    let ran = place.run(ADD);
    ran.check(
        0,
        &["out:the meshes of 1 link were not read, so no motion is computed: `tool0`", "out:--packages"],
    );
    // The shape that is not known cannot be in the way.
    assert!(place.read("card/robot.toml").contains("\"bend\" = 0\n"));
    let known = "out:touches neither itself nor the floor, as far as shapes are known: 1 link without one";
    place.run("robots check card").check(0, &["out:M0448", "out:the mesh of `tool0` was not read", known]);
    let place = place.file("ros/parts/meshes/blade.dae", collada(-150.0));
    place.run("robots check card").check(0, &["out:warning: `", "out:touches `"]);
    let place = place.file("ros/parts/meshes/blade.dae", collada(-150.0).replace("0 1 3 2 4", "0 1 3 2 99"));
    place.run("robots check card").check(1, &["out:M0449", "out:it names the vertex 99"]);
}

/// An arm of three joints, one of two with a gripper, and a neck.
const ARMS: &str = "<robot name='arms'><link name='base'/><link name='a1'/><link name='a2'/>
    <link name='a_tool0'/>
  <link name='b1'/><link name='b_gripper'/><link name='neck'/>
  <joint name='a1_joint' type='revolute'><parent link='base'/><child link='a1'/>LIMIT</joint>
  <joint name='a2_joint' type='revolute'><origin xyz='0 0 0.3'/><parent link='a1'/>
    <child link='a2'/>LIMIT</joint>
  <joint name='a3_joint' type='revolute'><origin xyz='0 0 0.3'/><parent link='a2'/>
    <child link='a_tool0'/>LIMIT\
    </joint>
  <joint name='b1_joint' type='revolute'><parent link='base'/><child link='b1'/>LIMIT</joint>
  <joint name='b2_joint' type='revolute'><origin xyz='0 0 0.3'/><parent link='b1'/>
    <child link='b_gripper'/>LIMIT\
    </joint>
  <joint name='neck_joint' type='revolute'><parent link='base'/><child link='neck'/>LIMIT</joint></robot>";

#[test]
fn add_tells_the_other_arms_and_takes_them_by_their_tips() {
    let limit = "<axis xyz='0 1 0'/><limit lower='-1' upper='1' velocity='1' effort='1'/>";
    let place = Place::new("robots_arms").file("arms/robot.urdf", ARMS.replace("LIMIT", limit));
    let ran = place.run("robots add arms/robot.urdf --to first");
    ran.check(0, &["out:leaves out the arm of 2 joints to `b_gripper`; `--tip b_gripper` takes it instead"]);
    assert!(!ran.stdout.contains("neck"), "{ran:#?}");
    assert!(place.read("first/robot.toml").contains("\ntip = \"a_tool0\""));
    let ran = place.run("robots add arms/robot.urdf --to second --tip b_gripper");
    ran.check(0, &["out:leaves out the arm of 3 joints to `a_tool0`"]);
    assert!(place.read("second/robot.toml").contains("\ntip = \"b_gripper\"  # as it was given\n"));
    place.run("robots check second").check(0, &["out:no errors", "out:2 joints: numeric"]);
    place
        .run("robots add arms/robot.urdf --to third --tip c_gripper")
        .check(2, &["err:has no link `c_gripper`"]);
}

/// A lid that is in the base wherever its joint is, a rod that is in both at rest alone, and as many balls in
/// the base as `BALLS` says.
const SHUT: &str = "<robot name='shut'>
  <link name='base'><collision><origin xyz='0 0 0.5'/><geometry><sphere radius='0.2'/></geometry></collision>\
    </link>
  <link name='mid'/><link name='lid'><collision><geometry><sphere radius='0.15'/></geometry></collision>
    </link>
  <link name='mast'/><link name='rod'><collision><geometry><sphere radius='0.05'/></geometry></collision>
    </link>
  <joint name='turn' type='revolute'><origin xyz='0 0 0.5'/><parent link='base'/>
    <child link='mid'/>NEAR</joint>
  <joint name='open' type='prismatic'><parent link='mid'/><child link='lid'/>NEAR</joint>
  <joint name='lean' type='revolute'><origin xyz='0 0 0.5'/><parent link='base'/>
    <child link='mast'/>NEAR</joint>
  <joint name='rise' type='prismatic'><parent link='mast'/><child link='rod'/>FAR</joint>BALLS</robot>";

#[test]
fn add_and_check_list_all_pairs_that_touch_and_may_not() {
    let limit = |upper: &str| {
        format!("<axis xyz='0 0 1'/><limit lower='0' upper='{upper}' velocity='1' effort='1'/>")
    };
    let ball = |at: usize| {
        format!(
            "<link name='pin{at}'/><link name='ball{at}'><collision><geometry><sphere radius='0.01'/>
    </geometry>
            </collision></link><joint name='pin{at}_joint' type='revolute'><origin xyz='0 0 0.5'/>
            <parent link='base'/><child link='pin{at}'/>{near}</joint><joint name='ball{at}_joint'
            type='prismatic'><parent link='pin{at}'/><child link='ball{at}'/>{far}</joint>",
            near = limit("0.1"),
            far = limit("2")
        )
    };
    let urdf = SHUT.replace("NEAR", &limit("0.1")).replace("FAR", &limit("2"));
    let balls: String = (0..20).map(ball).collect();
    let place = Place::new("robots_touching")
        .file("shut/robot.urdf", urdf.replace("BALLS", ""))
        .file("full/robot.urdf", urdf.replace("BALLS", &balls));
    let line = |one: &str, other: &str, reason: &str| {
        format!("<disable_collisions link1=\"{one}\" link2=\"{other}\" reason=\"{reason}\"/>")
    };
    let ran = place.run("robots add shut/robot.urdf");
    let lines = [line("base", "rod", "Default"), line("lid", "rod", "Default")];
    ran.check(0, &lines.each_ref().map(|line| format!("out:{line}")).each_ref().map(String::as_str));
    // What touches in every posture may do so anyway.
    assert_eq!(ran.stdout.matches("<disable_collisions").count(), 2, "{ran:#?}");
    place.run("robots check shut").check(0, &[&format!("out:{}", line("base", "rod", "User"))]);
    // With these lines the robot is well.
    let srdf = format!("<robot name='shut'>{}</robot>", lines.concat());
    let place = place.file("well/robot.urdf", urdf.replace("BALLS", "")).file("well/robot.srdf", srdf);
    let ran = place.run("robots add well/robot.urdf");
    ran.check(0, &["out:used the SRDF robot.srdf"]);
    assert!(!ran.stdout.contains("warning"), "{ran:#?}");
    // 21 small things are in the base, in the lid, and in each other: 252 pairs.
    let ran = place.run("robots add full/robot.urdf");
    ran.check(0, &["out:/>` and 52 pairs more"]);
    assert_eq!(ran.stdout.matches("<disable_collisions").count(), 200);
}
