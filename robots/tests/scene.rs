//! What is said of scenes that are wrong, and what a scene that is right means.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test fails by panicking")]

use std::fmt::Write;

use insta::assert_snapshot;
use motet_robots::scene::{self, Scene};
use motet_syntax::{FileId, Source};
use proptest::prelude::*;

/// Every finding on a line: code, the text it points at, message, help.
fn said(text: &str) -> String {
    let source = Source::new("scene.json", text);
    let (_, diagnostics) = scene::read(&source, FileId(0));
    let mut lines = String::new();
    for it in diagnostics {
        let help = it.help.map_or(String::new(), |help| format!(" ({help})"));
        writeln!(lines, "{} {}: {}{help}", it.code, source.slice(it.span), it.message).unwrap();
        for related in it.related {
            let place = related.span.map_or("", |span| source.slice(span));
            writeln!(lines, "      {place}: {}", related.message).unwrap();
        }
    }
    lines
}

/// A scene of these entities.
fn room(entities: &str) -> String {
    format!(r#"{{"motet_scene": 1, "entities": [{entities}]}}"#)
}

fn right(text: &str) -> Scene {
    assert_eq!(said(text), "");
    scene::read(&Source::new("scene.json", text), FileId(0)).0.unwrap()
}

#[test]
fn the_head_of_a_scene_is_checked() {
    assert_snapshot!(said(r#"{"motet_scene": 2}"#), @r#"
    M0431 2: this scene is of version 2, known is version 1 (write `"motet_scene": 1`)
    "#);
    assert_snapshot!(said(r#"{"motet_scene": 1, "frame": "odom"}"#), @r#"
    M0432 "odom": the frame `odom` is not known, poses of a scene are in the frame `map` (transform the poses into `map` and write `"frame": "map"`)
    "#);
    assert_snapshot!(said(r#"{"motet_scene": 1, "entitys": []}"#), @r#"
    M0103 "entitys": unknown key `entitys` (did you mean `entities`?)
    "#);
    assert_eq!(said(r#"{"motet_scene": 1, "frame": "map"}"#), "");
}

#[test]
fn joints_are_those_of_the_robot() {
    let text = motet_robots::card::embedded_urdf("hsr").unwrap();
    let urdf = motet_robots::urdf::read(&Source::new("robot.urdf", text), FileId(1)).0.unwrap();
    let fit = |joints: &str| {
        let text = format!(r#"{{"motet_scene": 1, "robot": {{"joints": {{{joints}}}}}}}"#);
        let source = Source::new("scene.json", text.as_str());
        let told = scene::fit(&right(&text), &urdf).into_iter().map(|it| {
            let help = it.help.map_or(String::new(), |help| format!(" ({help})"));
            format!("{} {}: {}{help}\n", it.code, source.slice(it.span), it.message)
        });
        told.collect::<String>()
    };
    assert_eq!(
        fit(r#""arm_lift_joint": 0.7, "wrist_flex_joint": -1.57"#),
        "M0428 0.7: joint `arm_lift_joint` is put at 0.7, and goes from 0 to 0.69\n"
    );
    assert_eq!(
        fit(r#""arm_lift": 0.1, "head_pan_joint": 0.2"#),
        "M0427 0.1: the URDF has no joint that moves by itself called `arm_lift` (did you mean `arm_lift_joint`?)\n"
    );
    // It follows the lift of the arm.
    assert_eq!(
        fit(r#""torso_lift_joint": 0.1"#),
        "M0427 0.1: the URDF has no joint that moves by itself called `torso_lift_joint` (did you mean `arm_lift_joint`?)\n"
    );
    assert_eq!(fit(r#""arm_lift_joint": 0.69, "hand_motor_joint": 1.24"#), "");
    // No number of JSON is more than a joint can be put at.
    let text = r#"{"motet_scene": 1, "robot": {"joints": {"arm_lift_joint": 1e999}}}"#;
    assert!(said(text).starts_with("M01"), "{}", said(text));
}

#[test]
fn ids_are_checked() {
    assert_snapshot!(said(&room(r#"{"id": "a", "kind": "Object"}, {"id": "a", "kind": "Place"}"#)), @r#"
    M0433 "a": the id `a` is taken (give each entity an id of its own)
          "a": it is first used here
    "#);
    assert_snapshot!(said(&room(r#"{"id": "", "kind": "Object"}, {"id": "a`b", "kind": "Object"}"#)), @r#"
    M0434 "": an id is empty (an id has at least one character, no back-quote and no control character)
    M0434 "a`b": `a`b` cannot be named in a policy (an id has at least one character, no back-quote and no control character)
    "#);
    assert_snapshot!(said(&room(r#"{"id": "robot", "kind": "Object"}, {"id": "any", "kind": "Object"}"#)), @r#"
    M0435 "robot": the id `robot` is reserved (the robot stands under `"robot"`, not among the entities)
    M0435 "any": the id `any` is reserved (name it otherwise, such as `any_1`)
    "#);
    assert_snapshot!(said(&room(r#"{"id": "a", "kind": ""}"#)), @r#"
    M0445 "": `kind` is empty (write the name of a kind such as `Object`)
    "#);
    assert_eq!(said(&room(r#"{"id": "7up", "kind": "Object"}, {"id": "my mug", "kind": "Object"}"#)), "");
}

#[test]
fn numbers_are_checked() {
    let shape = |shape: &str| said(&room(&format!(r#"{{"id": "a", "kind": "Object", "shape": {shape}}}"#)));
    assert_snapshot!(shape(r#"{"box": [1, 0, 1]}"#), @r#"
    M0441 [1, 0, 1]: a size is 0 m, it has to be above zero
    "#);
    assert_snapshot!(shape(r#"{"cylinder": {"radius": -0.1, "height": 2000}}"#), @r#"
    M0441 -0.1: a size is -0.1 m, it has to be above zero
    M0442 2000: a size is 2000 m, at most 1000 m are taken (lengths are in metres: 72 cm is 0.72)
    "#);
    assert_snapshot!(shape(r#"{"mesh": {"file": "a.stl", "scale": [1, 1, 0]}}"#), @r#"
    M0441 [1, 1, 0]: a scale is 0, it has to be above zero
    "#);
    assert_snapshot!(shape(r#"{"cone": {"radius": 1}}"#), @r#"
    M0109 "cone": no key says what this object is (it has one of the keys `box`, `cylinder`, `sphere`, `capsule` or `mesh`)
    "#);
    assert_eq!(shape(r#"{"capsule": {"radius": 0.1, "height": 1}}"#), "");
    let more = |more: &str| said(&room(&format!(r#"{{"id": "a", "kind": "Object", {more}}}"#)));
    assert_snapshot!(more(r#""mass": -1, "width": 0"#), @r#"
    M0441 -1: the mass is -1 kg, it has to be above zero
    M0441 0: a size is 0 m, it has to be above zero
    "#);
    assert_snapshot!(more(r#""pose": {"xyz": [0, 0, 1500]}"#), @r#"
    M0442 [0, 0, 1500]: a coordinate is 1500 m, at most 1000 m are taken (lengths are in metres: 72 cm is 0.72)
    "#);
    assert_snapshot!(more(r#""pose": {"xyz": [0, 0, 0], "rpy": [0, 0, 1e17]}"#), @r#"
    M0442 [0, 0, 1e17]: an angle is 100000000000000000 rad, at most 1000 rad are taken (angles are in radians, and a full turn, 6.28, leaves them as they are)
    "#);
    let robot = |robot: &str| said(&format!(r#"{{"motet_scene": 1, "robot": {{{robot}}}}}"#));
    assert_snapshot!(robot(r#""base": [0, 0, -2e3]"#), @r#"
    M0442 [0, 0, -2e3]: an angle is -2000 rad, at most 1000 rad are taken (angles are in radians, and a full turn, 6.28, leaves them as they are)
    "#);
    assert_snapshot!(robot(r#""joints": {"lift": 1001}"#), @r#"
    M0442 1001: a joint value is 1001, at most 1000 are taken (joints are in radians, or in metres where they slide)
    "#);
    assert_eq!(robot(r#""base": [0, 0, 1000]"#), "");
    assert_snapshot!(more(r#""pose": {"xyz": [0, 0, 1e999]}"#), @r#"
    M0107 1e999: the number `1e999` is out of range (numbers range from -1.8e308 to 1.8e308)
    "#);
    assert_snapshot!(more(r#""fields": {"mass": 1, "fullness": 0.5}"#), @r#"
    M0440 1: the field `mass` has a key of its own (write `"mass": …` beside `fields`, not in it)
    "#);
    assert_eq!(more(r#""pose": {"xyz": [0, 0, 1000]}, "fields": {"fullness": 0}"#), "");
}

#[test]
fn what_opens_is_checked() {
    let travel =
        |travel: &str| said(&room(&format!(r#"{{"id": "a", "kind": "Container", "travel": {travel}}}"#)));
    assert_snapshot!(travel(r#"{"slide": {"axis": [0, 0, 0], "distance": 0}}"#), @r#"
    M0443 [0, 0, 0]: the axis has length 0, so it has no direction (write a direction such as `[0, 0, 1]`)
    M0441 0: a size is 0 m, it has to be above zero
    "#);
    assert_snapshot!(travel(r#"{"hinge": {"axis": [0, 0, 1], "at": [0, 0, 0], "angle": 90}}"#), @r#"
    M0444 90: the door opens by 90.00 rad, at most 6.28 rad are possible (angles are in radians: 90 deg is 1.5708)
    "#);
    assert_eq!(travel(r#"{"slide": {"axis": [0, 0, 1e-300], "distance": 0.3}}"#), "");
}

#[test]
fn relations_are_checked() {
    let two =
        r#"{"id": "table", "kind": "Surface"}, {"id": "mug", "kind": "Object", "on": "tabel", "in": "box"}"#;
    assert_snapshot!(said(&room(two)), @r#"
    M0437 "tabel": `on` names the entity `tabel`, which the scene does not have (did you mean `table`?)
    M0437 "box": `in` names the entity `box`, which the scene does not have (add it to `entities`, or leave out `in`)
    "#);
    let robot = |robot: &str| {
        said(&format!(
            r#"{{"motet_scene": 1, "robot": {robot}, "entities": [{{"id": "mug", "kind": "Object", "on": "table"}},
            {{"id": "table", "kind": "Surface"}}]}}"#
        ))
    };
    assert_snapshot!(robot(r#"{"holding": "mugg", "at": "door"}"#), @r#"
    M0437 "mugg": `holding` names the entity `mugg`, which the scene does not have (did you mean `mug`?)
    M0437 "door": `at` names the entity `door`, which the scene does not have (add it to `entities`, or leave out `at`)
    "#);
    assert_snapshot!(robot(r#"{"holding": "mug"}"#), @r#"
    M0439 "table": `mug` is held, and is on or in something too (leave out `on` and `in` of what the robot holds)
          "mug": it is held here
    "#);
    assert_eq!(robot(r#"{"holding": null, "at": "table"}"#), "");
}

#[test]
fn nothing_carries_itself() {
    assert_snapshot!(said(&room(r#"{"id": "a", "kind": "Object", "on": "a"}"#)), @r#"
    M0438 "a": `a` is on or in itself (say for at least one of them that it stands on something else, or nothing)
    "#);
    let ring = r#"{"id": "a", "kind": "Object", "on": "b"}, {"id": "b", "kind": "Object", "in": "c"},
        {"id": "c", "kind": "Container", "on": "a"}, {"id": "d", "kind": "Object", "on": "a"}"#;
    assert_snapshot!(said(&room(ring)), @r#"
    M0438 "a": things stand on or in each other in a ring: `a`, `b`, `c`, `a` (say for at least one of them that it stands on something else, or nothing)
          "b": `a` says where it stands here
          "c": `b` says where it stands here
    "#);
    let diamond = r#"{"id": "a", "kind": "Object", "on": "b", "in": "c"}, {"id": "b", "kind": "Object", "on": "c"},
        {"id": "c", "kind": "Container"}"#;
    assert_eq!(said(&room(diamond)), "");
}

#[test]
fn there_is_an_end_to_entities() {
    let entities = |count: usize| {
        let all: Vec<_> = (0..count).map(|n| format!(r#"{{"id": "e{n}", "kind": "Object"}}"#)).collect();
        room(&all.join(", "))
    };
    assert_eq!(said(&entities(scene::MAX_ENTITIES)), "");
    assert_snapshot!(said(&entities(scene::MAX_ENTITIES + 1)), @r#"
    M0436 "e20000": the scene has 20001 entities, at most 20000 are read (leave out what the robot does not need to know of)
    "#);
}

#[test]
fn a_long_stack_is_no_trouble() {
    let thing = |n: usize, on: usize| format!(r#"{{"id": "e{n}", "kind": "Object", "on": "e{on}"}}"#);
    let stack = |last: &str| {
        // From the top, so that the first walk goes all the way down.
        let things = (1..10_000).rev().map(|n| thing(n, n - 1));
        room(&things.chain([last.to_owned()]).collect::<Vec<_>>().join(", "))
    };
    assert_eq!(said(&stack(r#"{"id": "e0", "kind": "Surface"}"#)), "");
    assert!(said(&stack(&thing(0, 9_999))).starts_with("M0438"));
}

#[test]
fn holding_is_nothing_or_not_said() {
    let holding = |robot: &str| {
        right(&format!(
            r#"{{"motet_scene": 1, "robot": {robot}, "entities": [{{"id": "m", "kind": "Object"}}]}}"#
        ))
        .robot
        .holding
    };
    assert_eq!(holding("{}"), None);
    assert_eq!(holding(r#"{"holding": null}"#), Some(None));
    assert_eq!(holding(r#"{"holding": "m"}"#), Some(Some("m".into())));
}

#[test]
fn axes_have_length_one() {
    let scene = right(&room(
        r#"{"id": "a", "kind": "Container", "travel": {"slide": {"axis": [-3, 0, 4], "distance": 0.3}}}"#,
    ));
    let axis = [-0.6, 0.0, 0.8];
    assert_eq!(scene.entities["a"].travel, Some(scene::Travel::Slide { axis, distance: 0.3 }));
}

#[test]
fn descriptions_fit_by_any_name() {
    let scene = right(&room(
        r#"{"id": "mug_1", "kind": "Object", "class": "mug", "names": ["Red Mug"], "categories": ["drinkware"]},
           {"id": "mug_2", "kind": "Object", "class": "mug", "names": ["blue-mug"]},
           {"id": "table", "kind": "Surface"}"#,
    ));
    let check = |description: &str, expected: &[&str]| {
        let ids: Vec<_> = scene.matches(description).iter().map(|entity| entity.id.as_str()).collect();
        assert_eq!(ids, expected, "{description:?}");
    };
    check("mug_1", &["mug_1"]);
    check("MUG 1", &["mug_1"]);
    check("the red  mug", &["mug_1"]);
    check("A blue mug", &["mug_2"]);
    check("mug", &["mug_1", "mug_2"]);
    check("drinkware", &["mug_1"]);
    check("red", &[]);
    check("red mug on the table", &[]);
    check("", &[]);
    check("the", &[]);
}

#[test]
fn a_thing_is_as_wide_as_its_shape() {
    let check = |shape: &str, expected: Option<f64>| {
        let scene = right(&room(&format!(r#"{{"id": "a", "kind": "Object"{shape}}}"#)));
        assert_eq!(scene.entities["a"].width(), expected, "{shape}");
    };
    check(r#", "shape": {"box": [0.3, 0.2, 0.1]}"#, Some(0.2));
    check(r#", "shape": {"cylinder": {"radius": 0.04, "height": 0.01}}"#, Some(0.08));
    check(r#", "shape": {"sphere": {"radius": 0.5}}"#, Some(1.0));
    let mesh = room(r#"{"id": "a", "kind": "Object", "shape": {"mesh": {"file": "a.stl"}}}"#);
    let (scene, told) = scene::read(&Source::new("room", mesh), FileId(0));
    assert_eq!(scene.unwrap().entities["a"].width(), None);
    assert_eq!(told.iter().map(|told| told.code.to_string()).collect::<Vec<_>>(), ["M0448"]);
    check(r#", "shape": {"box": [0.3, 0.2, 0.1]}, "width": 0.02"#, Some(0.02));
    check("", None);
}

#[test]
fn built_in_scenes_are_right() {
    for (_, text) in scene::embedded() {
        right(text);
    }
}

proptest! {
    #[test]
    fn no_text_makes_it_panic(text in ".{0,200}") {
        said(&text);
    }

    #[test]
    fn no_damage_makes_it_panic(which in 0..3_usize, at in 0.0..1.0_f64, cut in 0..40_usize, put in ".{0,8}") {
        let text: Vec<char> = scene::embedded()[which].1.chars().collect();
        let start = (at * text.len() as f64) as usize;
        let rest = text.iter().skip(start + cut);
        let damaged: String = text.iter().take(start).copied().chain(put.chars()).chain(rest.copied()).collect();
        said(&damaged);
    }

    #[test]
    fn no_ring_makes_it_hang(supports in prop::collection::vec((0..12_usize, 0..12_usize), 1..12)) {
        let things: Vec<_> = supports
            .iter()
            .enumerate()
            .map(|(n, (on, within))| format!(r#"{{"id": "e{n}", "kind": "Object", "on": "e{on}", "in": "e{within}"}}"#))
            .collect();
        let source = Source::new("scene.json", room(&things.join(", ")));
        let (scene, _) = scene::read(&source, FileId(0));
        let scene = scene.unwrap();
        // What is left can be put in an order in which everything comes after what carries it.
        let mut left: Vec<_> = scene.entities.values().collect();
        while !left.is_empty() {
            let ids: Vec<_> = left.iter().map(|entity| &entity.id).collect();
            let waits = |name: &Option<_>| name.as_ref().is_some_and(|name| ids.contains(&name));
            let next: Vec<_> =
                left.iter().copied().filter(|entity| waits(&entity.on) || waits(&entity.inside)).collect();
            prop_assert!(next.len() < left.len(), "a ring is left");
            left = next;
        }
    }
}
