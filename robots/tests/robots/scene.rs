//! Diagnostics of wrong scenes, and the meaning of right ones.

use std::fmt::Write;

use insta::assert_snapshot;
use motet_robots::builtin;
use motet_robots::scene::{self, Scene};
use motet_syntax::{FileId, Source};
use proptest::prelude::*;

/// Diagnostics, each on a line with code, the text at its span and message, then its help.
fn said(text: &str) -> String {
    let source = Source::new("scene.json", text);
    let (_, diagnostics) = scene::read(&source, FileId(0));
    let mut lines = String::new();
    for it in diagnostics {
        writeln!(lines, "{} {}: {}", it.code, source.slice(it.span), it.message).unwrap();
        if let Some(help) = it.help {
            writeln!(lines, "  {help}").unwrap();
        }
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
fn scene_reader_checks_version_and_frame() {
    assert_snapshot!(said(r#"{"motet_scene": 2}"#), @r#"
    M0431 2: the scene has format version 2; only version 1 is supported
      write `"motet_scene": 1`
    "#);
    assert_snapshot!(said(r#"{"motet_scene": 1, "frame": "odom"}"#), @r#"
    M0432 "odom": unknown frame `odom`: the poses of a scene are in the frame `map`
      transform the poses into `map` and write `"frame": "map"`
    "#);
    assert_snapshot!(said(r#"{"motet_scene": 1, "entitys": []}"#), @r#"
    M0103 "entitys": unknown key `entitys`
      did you mean `entities`?
    "#);
    assert_eq!(said(r#"{"motet_scene": 1, "frame": "map"}"#), "");
}

#[test]
fn scene_fit_checks_joints() {
    let urdf = builtin::robot("hsr").unwrap().urdf;
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
        "M0428 0.7: joint `arm_lift_joint` is at 0.7, outside its limits of 0 to 0.69\n"
    );
    assert_eq!(
        fit(r#""arm_lift": 0.1, "head_pan_joint": 0.2"#),
        "M0427 0.1: the URDF has no joint that moves by itself called `arm_lift` (did you mean \
            `arm_lift_joint`?)\n"
    );
    // It follows the lift of the arm.
    assert_eq!(
        fit(r#""torso_lift_joint": 0.1"#),
        "M0427 0.1: the URDF has no joint that moves by itself called `torso_lift_joint` (did you mean \
            `arm_lift_joint`?)\n"
    );
    assert_eq!(fit(r#""arm_lift_joint": 0.69, "hand_motor_joint": 1.24"#), "");
    // No number of JSON is more than a joint can be put at.
    let text = r#"{"motet_scene": 1, "robot": {"joints": {"arm_lift_joint": 1e999}}}"#;
    assert!(said(text).starts_with("M01"), "{}", said(text));
}

#[test]
fn scene_reader_checks_ids() {
    assert_snapshot!(said(&room(r#"{"id": "a", "kind": "Object"}, {"id": "a", "kind": "Place"}"#)), @r#"
    M0433 "a": the id `a` is used twice
      give each entity an id of its own
          "a": it is first used here
    "#);
    assert_snapshot!(said(&room(r#"{"id": "", "kind": "Object"}, {"id": "a`b", "kind": "Object"}"#)), @r#"
    M0434 "": an id is empty
      an id has no back-quote, comma, semicolon or control character
    M0434 "a`b": `a`b` cannot be named in a policy
      an id has no back-quote, comma, semicolon or control character
    "#);
    assert_snapshot!(said(&room(r#"{"id": "robot", "kind": "Object"}, {"id": "any",
        "kind": "Object"}"#)), @r#"
    M0435 "robot": the id `robot` is reserved
      the robot stands under `"robot"`, not among the entities
    M0435 "any": the id `any` is reserved
      name it otherwise, such as `any_1`
    "#);
    assert_snapshot!(said(&room(r#"{"id": "a", "kind": ""}"#)), @r#"
    M0445 "": `kind` is empty
      write the name of a kind such as `Object`
    "#);
    assert_eq!(said(&room(r#"{"id": "7up", "kind": "Object"}, {"id": "my mug", "kind": "Object"}"#)), "");
}

#[test]
fn scene_reader_checks_numbers() {
    let shape = |shape: &str| said(&room(&format!(r#"{{"id": "a", "kind": "Object", "shape": {shape}}}"#)));
    assert_snapshot!(shape(r#"{"box": [1, 0, 1]}"#), @r#"
    M0441 [1, 0, 1]: a size is 0 m, but must be above zero
    "#);
    assert_snapshot!(shape(r#"{"cylinder": {"radius": -0.1, "height": 2000}}"#), @r#"
    M0441 -0.1: a size is -0.1 m, but must be above zero
    M0442 2000: a size is 2000 m, but at most 1000 m is allowed
      lengths are in metres: 72 cm is 0.72
    "#);
    assert_snapshot!(shape(r#"{"mesh": {"file": "a.stl", "scale": [1, 1, 0]}}"#), @r#"
    M0441 [1, 1, 0]: a scale is 0, but must be above zero
    "#);
    assert_snapshot!(shape(r#"{"cone": {"radius": 1}}"#), @r#"
    M0109 "cone": no key says what this object is
      it has one of the keys `box`, `cylinder`, `sphere`, `capsule` or `mesh`
    "#);
    assert_eq!(shape(r#"{"capsule": {"radius": 0.1, "height": 1}}"#), "");
    let more = |more: &str| said(&room(&format!(r#"{{"id": "a", "kind": "Object", {more}}}"#)));
    assert_snapshot!(more(r#""mass": -1, "width": 0"#), @r#"
    M0441 -1: the mass is -1 kg, but must be above zero
    M0441 0: a size is 0 m, but must be above zero
    "#);
    assert_snapshot!(more(r#""pose": {"xyz": [0, 0, 1500]}"#), @r#"
    M0442 [0, 0, 1500]: a coordinate is 1500 m, but at most 1000 m is allowed
      lengths are in metres: 72 cm is 0.72
    "#);
    assert_snapshot!(more(r#""pose": {"xyz": [0, 0, 0], "rpy": [0, 0, 1e17]}"#), @r#"
    M0442 [0, 0, 1e17]: an angle is 100000000000000000 rad, but at most 1000 rad is allowed
      angles are in radians, and a full turn, 6.28, leaves them as they are
    "#);
    let robot = |robot: &str| said(&format!(r#"{{"motet_scene": 1, "robot": {{{robot}}}}}"#));
    assert_snapshot!(robot(r#""base": [0, 0, -2e3]"#), @r#"
    M0442 [0, 0, -2e3]: an angle is -2000 rad, but at most 1000 rad is allowed
      angles are in radians, and a full turn, 6.28, leaves them as they are
    "#);
    assert_snapshot!(robot(r#""joints": {"lift": 1001}"#), @r#"
    M0442 1001: a joint value is 1001, but at most 1000 is allowed
      joints are in radians, or in metres where they slide
    "#);
    assert_eq!(robot(r#""base": [0, 0, 1000]"#), "");
    assert_snapshot!(more(r#""pose": {"xyz": [0, 0, 1e999]}"#), @r#"
    M0107 1e999: the number `1e999` is out of range
      numbers range from -1.8e308 to 1.8e308
    "#);
    assert_snapshot!(more(r#""fields": {"mass": 1, "fullness": 0.5}"#), @r#"
    M0440 1: the field `mass` has a key of its own
      write `"mass": …` beside `fields`, not in it
    "#);
    assert_eq!(more(r#""pose": {"xyz": [0, 0, 1000]}, "fields": {"fullness": 0}"#), "");
}

#[test]
fn scene_reader_checks_zones() {
    let zone = |zone: &str| said(&room(&format!(r#"{{"id": "stairs", "kind": "Zone", {zone}}}"#)));
    let pose = r#""pose": {"xyz": [2, 0, 0], "rpy": [0, 0, 1]}"#;
    assert_eq!(zone(&format!(r#"{pose}, "shape": {{"box": [1, 2, 0.1]}}"#)), "");
    assert_eq!(zone(&format!(r#"{pose}, "shape": {{"cylinder": {{"radius": 1, "height": 1}}}}"#)), "");
    assert_snapshot!(zone(pose), @r#"
    M0481 "stairs": the zone `stairs` has no `shape`; a zone is an area of the floor
      give its middle on the floor as `pose`, and its extent as a `box` or a `cylinder`
    "#);
    assert_snapshot!(zone(r#""shape": {"box": [1, 2, 0.1]}"#), @r#"
    M0481 "stairs": the zone `stairs` has no `pose`; a zone is an area of the floor
      give its middle on the floor as `pose`, and its extent as a `box` or a `cylinder`
    "#);
    assert_snapshot!(zone(&format!(r#"{pose}, "shape": {{"sphere": {{"radius": 1}}}}"#)), @r#"
    M0481 "stairs": the zone `stairs` has no `box` or `cylinder` as its shape; a zone is an area of the floor
      give its middle on the floor as `pose`, and its extent as a `box` or a `cylinder`
    "#);
    let tilted = r#""pose": {"xyz": [0, 0, 0], "rpy": [1, 0, 0]}"#;
    assert_snapshot!(zone(&format!(r#"{tilted}, "shape": {{"box": [1, 2, 1]}}"#)), @r#"
    M0481 "stairs": the zone `stairs` is tilted; a zone is an area of the floor
      give its middle on the floor as `pose`, and its extent as a `box` or a `cylinder`
    "#);
    assert_snapshot!(zone(&format!(r#"{pose}, "shape": {{"box": [1, 2, 1]}}, "mass": 1"#)), @r#"
    M0481 "stairs": the zone `stairs` has a `mass` or a `travel`; a zone is an area of the floor
      give its middle on the floor as `pose`, and its extent as a `box` or a `cylinder`
    "#);
    // A mistake in the shape is told once.
    let flat = format!(r#"{pose}, "shape": {{"box": [1, 0, 1]}}"#);
    assert_snapshot!(zone(&flat), @"M0441 [1, 0, 1]: a size is 0 m, but must be above zero");
}

#[test]
fn scene_reader_checks_doors_and_drawers() {
    let travel =
        |travel: &str| said(&room(&format!(r#"{{"id": "a", "kind": "Container", "travel": {travel}}}"#)));
    assert_snapshot!(travel(r#"{"slide": {"axis": [0, 0, 0], "distance": 0}}"#), @r#"
    M0443 [0, 0, 0]: the axis has length 0, so it has no direction
      write a direction such as `[0, 0, 1]`
    M0441 0: a size is 0 m, but must be above zero
    "#);
    assert_snapshot!(travel(r#"{"hinge": {"axis": [0, 0, 1], "at": [0, 0, 0], "angle": 90}}"#), @r#"
    M0444 90: the door opens by 90.00 rad, more than a full turn, 6.28 rad
      angles are in radians: 90 deg is 1.5708
    "#);
    assert_eq!(travel(r#"{"slide": {"axis": [0, 0, 1e-300], "distance": 0.3}}"#), "");
}

#[test]
fn scene_reader_checks_relations() {
    let two =
        r#"{"id": "table", "kind": "Surface"}, {"id": "mug", "kind": "Object", "on": "tabel", "in": "box"}"#;
    assert_snapshot!(said(&room(two)), @r#"
    M0437 "tabel": `on` names the entity `tabel`, which the scene does not have
      did you mean `table`?
    M0437 "box": `in` names the entity `box`, which the scene does not have
      add it to `entities`, or leave out `in`
    "#);
    let robot = |robot: &str| {
        said(&format!(
            r#"{{"motet_scene": 1, "robot": {robot}, "entities": [{{"id": "mug", "kind": "Object",
                "on": "table"}},
            {{"id": "table", "kind": "Surface"}}]}}"#
        ))
    };
    assert_snapshot!(robot(r#"{"holding": "mugg", "at": "door"}"#), @r#"
    M0437 "mugg": `holding` names the entity `mugg`, which the scene does not have
      did you mean `mug`?
    M0437 "door": `at` names the entity `door`, which the scene does not have
      add it to `entities`, or leave out `at`
    "#);
    assert_snapshot!(robot(r#"{"holding": "mug"}"#), @r#"
    M0439 "table": `mug` is held, but also on or in something
      remove `on` and `in` of the held object
          "mug": it is held here
    "#);
    assert_eq!(robot(r#"{"holding": null, "at": "table"}"#), "");
}

#[test]
fn scene_reader_reports_support_cycles() {
    assert_snapshot!(said(&room(r#"{"id": "a", "kind": "Object", "on": "a"}"#)), @r#"
    M0438 "a": `a` is on or in itself
      put at least one of them on something else, or on nothing
    "#);
    let ring = r#"{"id": "a", "kind": "Object", "on": "b"}, {"id": "b", "kind": "Object", "in": "c"},
        {"id": "c", "kind": "Container", "on": "a"}, {"id": "d", "kind": "Object", "on": "a"}"#;
    assert_snapshot!(said(&room(ring)), @r#"
    M0438 "a": supports form a cycle: `a`, `b`, `c`, `a`
      put at least one of them on something else, or on nothing
          "b": the support of `a` is here
          "c": the support of `b` is here
    "#);
    let diamond = r#"{"id": "a", "kind": "Object", "on": "b", "in": "c"}, {"id": "b", "kind": "Object",
        "on": "c"},
        {"id": "c", "kind": "Container"}"#;
    assert_eq!(said(&room(diamond)), "");
}

#[test]
fn scene_reader_limits_the_number_of_entities() {
    let entities = |count: usize| {
        let all: Vec<_> = (0..count).map(|n| format!(r#"{{"id": "e{n}", "kind": "Object"}}"#)).collect();
        room(&all.join(", "))
    };
    assert_eq!(said(&entities(scene::MAX_ENTITIES)), "");
    assert_snapshot!(said(&entities(scene::MAX_ENTITIES + 1)), @r#"
    M0436 "e20000": the scene has 20001 entities, more than the limit of 20000
      leave out entities that the robot does not need
    "#);
}

#[test]
fn scene_reader_reads_a_long_stack() {
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
fn scene_holding_distinguishes_null_from_missing() {
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
fn scene_axes_are_unit_vectors() {
    let scene = right(&room(
        r#"{"id": "a", "kind": "Container", "travel": {"slide": {"axis": [-3, 0, 4], "distance": 0.3}}}"#,
    ));
    let axis = [-0.6, 0.0, 0.8];
    assert_eq!(scene.entities["a"].travel, Some(scene::Travel::Slide { axis, distance: 0.3 }));
}

#[test]
fn scene_matches_descriptions_by_any_name() {
    let scene = right(&room(
        r#"{"id": "mug_1", "kind": "Object", "class": "mug", "names": ["Red Mug"],
            "categories": ["drinkware"]},
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
fn entity_width_follows_its_shape() {
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
fn builtin_scenes_have_no_diagnostics() {
    for scene in builtin::SCENES {
        right(scene.json);
    }
}

proptest! {
    #[test]
    fn scene_reader_never_panics(text in ".{0,200}") {
        said(&text);
    }

    #[test]
    fn scene_reader_never_panics_on_damaged_scenes(
        which in 0..3_usize, at in 0.0..1.0_f64, cut in 0..40_usize, put in ".{0,8}",
    ) {
        let text: Vec<char> = builtin::SCENES[which].json.chars().collect();
        let start = (at * text.len() as f64) as usize;
        let rest = text.iter().skip(start + cut);
        let damaged = text.iter().take(start).copied().chain(put.chars()).chain(rest.copied());
        let damaged: String = damaged.collect();
        said(&damaged);
    }

    #[test]
    fn scene_reader_ends_on_any_supports(
        supports in prop::collection::vec((0..12_usize, 0..12_usize), 1..12),
    ) {
        let things: Vec<_> = supports
            .iter()
            .enumerate()
            .map(|(n, (on, within))| format!(r#"{{"id": "e{n}", "kind": "Object", "on": "e{on}",
                "in": "e{within}"}}"#))
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
