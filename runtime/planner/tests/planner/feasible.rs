//! Reachability in prompts: by numbers alone, and by motion searches.

use super::common::{hsr, kitchen, session, walled};
use motet_compiler::Session;
use motet_planner::builtin;
use motet_planner::prompt::{self, Reachability};
use motet_requests::RequestContext;
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
fn reachability_is_yes_with_a_path_and_a_motion() {
    let scene = kitchen();
    let session = session(&scene);
    for id in ["mug_1", "coke", "kitchen_table", "drawer_1", "user"] {
        assert_eq!(feasible(&session, &scene, id, LONG), Reachability::Yes, "{id}");
    }
}

#[test]
fn reachability_is_no_with_the_reason() {
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
fn reachability_in_a_closed_container_is_unknown() {
    let scene = with_mug(|mug| (mug.on, mug.inside, mug.pose) = (None, Some("fridge_1".into()), None));
    let found = feasible(&session(&scene), &scene, "mug_1", LONG);
    assert!(matches!(&found, Reachability::Unknown(why) if why.contains("fridge_1")), "{found:?}");
}

#[test]
fn reachability_without_motions_or_time_rests_on_numbers() {
    let scene = walled();
    assert_eq!(feasible(&session(&scene), &scene, "mug_1", Duration::ZERO), Reachability::AsFarAsNumbersTell);
    let plain = Session::builder().robot(&hsr()).scene(&scene).build(&mut Sources::default());
    assert_eq!(feasible(&plain, &scene, "mug_1", LONG), Reachability::AsFarAsNumbersTell);
    let heavy = with_mug(|mug| mug.mass_kg = Some(5.0));
    assert!(matches!(feasible(&plain, &heavy, "mug_1", Duration::ZERO), Reachability::No(_)));
}

/// Around the open drawer the path to it takes longer than `place` may.
#[test]
fn plan_gives_a_step_the_time_of_its_path() {
    let scene = kitchen();
    let session = session(&scene);
    let situation = RequestContext::new(&scene);
    let planned = builtin::answer(&session, Some(&hsr()), "put the coke in the drawer", &situation).unwrap();
    let said = &planned.planned.compiled.diagnostics;
    assert!(said.iter().all(|said| said.code.0 != "M0611"), "{said:?}");
    assert!(planned.planned.text.contains("place(coke, drawer_1) within "), "{}", planned.planned.text);
}
