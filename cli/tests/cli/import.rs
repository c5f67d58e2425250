//! `motet import` from outside.

use crate::support::Place;

const DOMAIN: &str = "(define (domain lamps) (:requirements :strips :typing) (:types lamp)
  (:predicates (lit ?l - lamp))
  (:action light-it :parameters (?l - lamp) :precondition (not (lit ?l)) :effect (lit ?l)))";
const PROBLEM: &str =
    "(define (problem one) (:domain lamps) (:objects a b - lamp) (:init (lit a)) (:goal (lit b)))";

#[test]
fn plan_is_decided_by_its_domain() {
    let place = Place::new("import")
        .file("d.pddl", DOMAIN)
        .file("p.pddl", PROBLEM)
        .file("good.plan", "(light-it b)\n")
        .file("bad.plan", "(light-it a)\n")
        .file("odd.pddl", DOMAIN.replace(":strips", ":adl"));
    place.run("import pddl d.pddl p.pddl -o lamps.motet").check(0, &[]);
    for (plan, code, texts) in [("good", 0, &[][..]), ("bad", 1, &["out:M0501", "out:M0503"])] {
        place.run(&format!("import pddl d.pddl p.pddl --plan {plan}.plan -o {plan}.motet")).check(0, &[]);
        place.run(&format!("check {plan}.motet --domain lamps.motet")).check(code, texts);
    }
    place.run("import pddl d.pddl p.pddl").check(0, &["out:action `light-it`(l: lamp)", "out:closed world"]);
    place.run("import pddl odd.pddl p.pddl").check(1, &["out:M0132", "out:`:adl`", "out:odd.pddl:1:"]);
    place.run("import pddl absent.pddl p.pddl").check(2, &["err:cannot read `absent.pddl`"]);
}

const MAP: &str = "image: room.pgm\nresolution: 0.5\norigin: [-2.0, -2.0, 0.0]\nnegate: 0\n\
                   occupied_thresh: 0.65\nfree_thresh: 0.196\n";
/// A room of 4 by 4 m with a wall along its upper and its right side.
const ROOM: &str = "P2 8 8 255\n 0 0 0 0 0 0 0 0\n 254 254 254 254 254 254 205 0\n
    254 254 254 254 254 254 254 0\n 254 254 254 254 254 254 254 0\n 254 254 254 254 254 254 254 0\n
    254 254 254 254 254 254 254 0\n 254 254 254 254 254 254 254 0\n 254 254 254 254 254 254 254 0\n";

#[test]
fn map_becomes_walls_that_stand_in_the_way() {
    let place = Place::new("import_map")
        .file("room.yaml", MAP)
        .file("room.pgm", ROOM)
        .file("bad.yaml", MAP.replace("room.pgm", "bad.pgm").replace("negate: 0", "negate: maybe"))
        .file("torn.yaml", MAP.replace("room.pgm", "torn.pgm"))
        .file("torn.pgm", &ROOM[..60])
        .file("lost.yaml", MAP.replace("room.pgm", "lost.pgm"))
        .file("go.motet", "policy go_there for hsr { go_to_pose(0.0 m, 0.5 m, 0.0 rad) done }\n");
    place.run("import map room.yaml -o room.json").check(0, &[]);
    let scene = place.read("room.json");
    assert_eq!(scene.matches("\"id\"").count(), 2, "{scene}");
    assert!(scene.contains("[3.5,0.5,2.0]") && scene.contains("[0.5,4.0,2.0]"), "{scene}");
    place.run("import map room.yaml --unknown occupied").check(0, &["out:wall_3"]);
    place.run("import map bad.yaml").check(1, &["out:M0484", "out:bad.yaml:4:", "out:maybe"]);
    place.run("import map torn.yaml").check(1, &["out:M0485", "out:torn.yaml:1:", "out:row"]);
    place.run("import map lost.yaml").check(2, &["err:lost.pgm"]);
    place.run("feasible --robot hsr --scene room.json --all").check(0, &[]);
}

const SDF: &str = r#"<sdf version="1.9"><world name="w">
  <model name="desk"><static>1</static><pose>1.6 0 0 0 0 0</pose>
    <link name="top"><pose degrees="true">0 0 0.35 0 0 90</pose><collision name="c">
      <geometry><box><size>1.2 0.6 0.7</size></box></geometry></collision></link></model>
  <model name="cup"><pose relative_to="desk">-0.2 0.1 0.75 0 0 0</pose>
    <link name="body"><inertial><mass>0.2</mass></inertial><collision name="c">
      <geometry><cylinder><radius>0.035</radius><length>0.1</length></cylinder></geometry>
    </collision></link></model></world></sdf>"#;

#[test]
fn sdf_becomes_a_scene_with_things_to_grasp() {
    let place = Place::new("import_sdf")
        .file("room.sdf", SDF)
        .file("ring.sdf", SDF.replace("<pose>1.6 0 0 0 0 0", "<pose relative_to=\"cup\">0 0 0 0 0 0"))
        .file("thin.sdf", SDF.replace("1.2 0.6 0.7", "1.2 0 0.7"))
        .file("nan.sdf", SDF.replace("1.2 0.6 0.7", "1.2 NaN 0.7"))
        .file("mesh.sdf", SDF.replace("<box><size>1.2 0.6 0.7</size></box>", "<mesh/>"));
    place.run("import sdf room.sdf -o room.json").check(0, &[]);
    let scene = place.read("room.json");
    assert!(scene.contains("[1.4000000000000001,0.1,0.75]") || scene.contains("[1.4,0.1,0.75]"), "{scene}");
    place.run("feasible --robot hsr --scene room.json --for reach(cup)").check(0, &["out:feasible"]);
    place.run("import sdf ring.sdf").check(1, &["out:M0488", "out:depends on itself", "out:ring.sdf:"]);
    place.run("import sdf thin.sdf").check(1, &["out:M0457", "out:above zero"]);
    place.run("import sdf nan.sdf").check(1, &["out:M0457"]);
    place.run("import sdf mesh.sdf -o mesh.json").check(0, &["out:M0487"]);
}
