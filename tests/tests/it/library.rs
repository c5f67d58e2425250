//! The standard library, the robots' own declarations and the embedded scenes fit together without a word.

use motet_graph::Value;
use motet_syntax::{Diagnostic, Sources};
use motet_tests::setup;

fn check(robot: Option<&str>, scene: Option<&str>) {
    let mut sources = Sources::default();
    let robot = robot.map(setup::robot);
    let scene = scene.map(setup::scene);
    let (_, said) = setup::session(robot.as_ref(), scene.as_ref(), &mut sources);
    let show = |said: &Diagnostic| {
        let place = sources
            .get(said.span.file)
            .map(|source| (source.name.clone(), source.line_column(said.span.start)));
        format!("{} {} at {place:?}", said.code, said.message)
    };
    assert!(said.is_empty(), "{:#?}", said.iter().map(show).collect::<Vec<_>>());
}

#[test]
fn session_standard_library_alone() {
    check(None, None);
}

#[test]
fn session_every_robot_in_every_scene() {
    for robot in ["hsr", "anymal_z1", "panda"] {
        for scene in [None, Some("kitchen"), Some("living_room"), Some("lab")] {
            check(Some(robot), scene);
        }
    }
}

#[test]
fn session_every_standard_policy_can_be_called_on_the_robots_that_walk_and_drive() {
    let calls = [
        ("wake_up() start_pose()", "fetch(\"red mug\")"),
        ("wake_up()", "put_away(mug_1, counter)"),
        ("wake_up()", "put_in_drawer(mug_1, drawer_1)"),
        ("wake_up()", "clear_away(\"mug\", kitchen_table, counter)"),
        ("wake_up() start_pose() let m = search(\"red mug\", kitchen_table) pick(m) lift()", "hand_over(m)"),
    ];
    let scene = setup::scene("kitchen");
    for name in ["hsr", "anymal_z1"] {
        let (session, _) = setup::session(Some(&setup::robot(name)), Some(&scene), &mut Sources::default());
        for (before, call) in calls {
            let before = if name == "hsr" { before.replace("wake_up()", "") } else { before.to_owned() };
            let text = format!("policy p for {name} {{ {before} {call} }}");
            let parsed =
                motet_syntax::read(&motet_syntax::Source::new("p", text.as_str()), Default::default());
            let said = session.check(&parsed);
            let errors: Vec<_> =
                said.iter().filter(|said| said.severity == motet_syntax::Severity::Error).collect();
            assert!(errors.is_empty(), "{text}: {errors:#?}");
        }
    }
}

#[test]
fn session_elsewhere_is_a_new_one() {
    let (robot, kitchen, lab) = (setup::robot("hsr"), setup::scene("kitchen"), setup::scene("lab"));
    let (base, _) = setup::session(Some(&robot), Some(&kitchen), &mut Sources::default());
    for scene in [&kitchen, &lab] {
        let elsewhere = base.with_scene(Some(scene), None);
        let (new, _) = setup::session(Some(&robot), Some(scene), &mut Sources::default());
        assert_eq!(format!("{:?}", elsewhere.signatures()), format!("{:?}", new.signatures()));
        assert!(elsewhere.initial_facts().eq(new.initial_facts()));
        let same = std::sync::Arc::ptr_eq(&elsewhere.signatures(), &base.signatures());
        assert_eq!(same, std::ptr::eq(scene, &kitchen), "made once for the same things");
    }
    let mug = |given: &motet_compiler::InitialFact| {
        given.fluent == "on" && given.args == [Some(Value::Entity("mug_1".into())), None]
    };
    assert!(base.initial_facts().any(|given| mug(&given) && !given.holds), "it is on nothing else");
}
