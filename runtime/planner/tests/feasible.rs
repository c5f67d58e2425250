//! What a prompt says of whether the robot can get at a thing: by its numbers, and by motions where they
//! are looked for.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic, reason = "a test fails by panicking")]

mod common;

use common::{hsr, kitchen, session, walled};
use motet_compiler::Session;
use motet_planner::prompt::{self, Reachability};
use motet_robots::scene::{EntityShape, Scene};
use motet_syntax::Sources;
use std::time::Duration;

/// Long enough for any search within its budget.
const LONG: Duration = Duration::from_secs(600);

fn feasible(session: &Session, scene: &Scene, id: &str, time: Duration) -> Reachability {
    prompt::seen(session, &hsr(), scene, &[id.into()], time).remove(0).feasible
}

/// The kitchen with a change to its red mug.
fn with_mug(change: impl Fn(&mut motet_robots::scene::Entity)) -> Scene {
    let mut scene = kitchen();
    change(&mut scene.entities["mug_1"]);
    scene
}

#[test]
fn what_there_is_a_way_and_a_motion_to_is_feasible() {
    let scene = kitchen();
    let session = session(&scene);
    for id in ["mug_1", "coke", "kitchen_table", "drawer_1", "user"] {
        assert_eq!(feasible(&session, &scene, id, LONG), Reachability::Yes, "{id}");
    }
}

#[test]
fn what_is_walled_in_out_of_reach_or_cannot_be_held_is_not_and_the_reason_is_told() {
    let reason = |scene: &Scene| match feasible(&session(scene), scene, "mug_1", LONG) {
        Reachability::No(why) => why,
        other => panic!("{other:?}"),
    };
    assert!(reason(&walled()).contains("no path"), "{}", reason(&walled()));
    assert_eq!(reason(&with_mug(|mug| mug.mass_kg = Some(5.0))), "too heavy: 5 kg, payload is 1.2 kg");
    let wide = with_mug(|mug| mug.shape = Some(EntityShape::Cylinder { radius: 0.2, height: 0.1 }));
    assert_eq!(reason(&wide), "too wide: 0.4 m, opening is 0.13 m");
    let high = with_mug(|mug| mug.pose.as_mut().unwrap().xyz[2] = 2.6);
    assert!(reason(&high).contains("reach"), "{}", reason(&high));
}

#[test]
fn what_is_shut_in_is_not_known() {
    let scene = with_mug(|mug| (mug.on, mug.inside, mug.pose) = (None, Some("fridge_1".into()), None));
    let found = feasible(&session(&scene), &scene, "mug_1", LONG);
    assert!(matches!(&found, Reachability::Unknown(why) if why.contains("fridge_1")), "{found:?}");
}

#[test]
fn without_motions_or_time_for_them_only_the_numbers_tell() {
    let scene = walled();
    assert_eq!(feasible(&session(&scene), &scene, "mug_1", Duration::ZERO), Reachability::AsFarAsNumbersTell);
    let plain = Session::builder().robot(&hsr()).scene(&scene).build(&mut Sources::default());
    assert_eq!(feasible(&plain, &scene, "mug_1", LONG), Reachability::AsFarAsNumbersTell);
    let heavy = with_mug(|mug| mug.mass_kg = Some(5.0));
    assert!(matches!(feasible(&plain, &heavy, "mug_1", Duration::ZERO), Reachability::No(_)));
}
