//! Motion feasibility: verdicts and witnesses in the graph, refusals with their explanation, and motions that
//! are left to the run. Guards `src/feasibility/`.

use std::sync::LazyLock;

use motet_compiler::Session;
use motet_graph::{CallNode, Graph, NodeKind, Verdict};
use motet_robots::builtin;
use motet_robots::scene::{self, Placement, Scene};
use motet_syntax::{Diagnostic, Severity, Sources};

use crate::{in_scene, read};

fn kitchen() -> Scene {
    builtin::scene("kitchen").unwrap()
}

fn session(scene: &Scene) -> Session {
    in_scene(&builtin::robot("hsr").unwrap(), scene)
}

static KITCHEN: LazyLock<Session> = LazyLock::new(|| session(&kitchen()));

fn compile(session: &Session, policy: &str) -> (Option<Graph>, Vec<Diagnostic>) {
    let compiled = session.compile(&read(policy), None);
    (compiled.graph, compiled.diagnostics)
}

fn errors(said: &[Diagnostic]) -> Vec<String> {
    let errors = said.iter().filter(|said| said.severity == Severity::Error);
    errors.map(|said| format!("{} {}", said.code, said.message)).collect()
}

/// The motions of a policy that is right: each with its verdict, and why it is deferred.
fn motions(session: &Session, policy: &str) -> Vec<(String, Verdict, String)> {
    let (graph, said) = compile(session, policy);
    assert!(errors(&said).is_empty(), "{:?}", errors(&said));
    let graph = graph.unwrap();
    motet_graph::validate(&graph).unwrap();
    assert_eq!(motet_graph::decode(&motet_graph::encode(&graph)).unwrap(), graph);
    let calls = graph.nodes.iter().filter_map(|node| match &node.kind {
        NodeKind::Call(CallNode { motion: Some(motion), .. }) => Some(motion),
        _ => None,
    });
    calls
        .map(|motion| {
            let why = motion.why.clone().unwrap_or_default().to_string();
            (motion.query.to_string(), motion.verdict, why)
        })
        .collect()
}

/// The one error of a policy, and what it points at.
fn refusal(session: &Session, policy: &str) -> (String, Vec<String>) {
    let (graph, said) = compile(session, policy);
    assert!(graph.is_none());
    let errors: Vec<_> = said.iter().filter(|said| said.severity == Severity::Error).collect();
    let [only] = errors.as_slice() else { panic!("{errors:?}") };
    (format!("{} {}", only.code, only.message), only.related.iter().map(|it| it.message.clone()).collect())
}

#[test]
fn fetching_is_feasible_step_by_step() {
    let found = motions(
        &KITCHEN,
        "policy fetch for hsr { go(kitchen_table) pick(mug_1) go(user) handover(mug_1, user) }",
    );
    for (query, verdict, why) in &found {
        assert_eq!(*verdict, Verdict::Proven, "{query}: {why}");
    }
    assert_eq!(found.len(), 4);
}

#[test]
fn two_legs_that_are_feasible_alone_and_not_one_after_the_other_are_found() {
    // The mug is put where the robot was to put nothing else: on a stand that has room for one thing only.
    let mut scene = kitchen();
    let mut stand = scene.entities["shelf"].clone();
    stand.id = "stand".into();
    stand.pose = Some(Placement { xyz: [-0.9, 0.9, 0.35], rpy: [0.0; 3] });
    stand.shape = Some(scene::EntityShape::Box([0.1, 0.1, 0.7]));
    scene.entities.insert("stand".into(), stand);
    let session = session(&scene);
    let bring =
        |thing: &str| format!("go({thing}) inspect({thing}) pick({thing}) go(stand) place({thing}, stand)");
    for thing in ["mug_1", "glass_1"] {
        let found = motions(&session, &format!("policy bring for hsr {{ {} }}", bring(thing)));
        assert!(found.iter().all(|(_, verdict, _)| *verdict == Verdict::Proven), "{found:?}");
    }
    let both = format!("policy bring for hsr {{ {} {} }}", bring("mug_1"), bring("glass_1"));
    let (said, since) = refusal(&session, &both);
    assert!(said.starts_with("M0602 `place` cannot perform `put(glass_1, stand)`: "), "{said}");
    assert!(said.contains("most often with `mug_1`"), "{said}");
    assert!(said.contains("`mug_1` is as `place(mug_1, stand)` left it"), "{said}");
    assert_eq!(since.first().map(String::as_str), Some("changed here"), "{since:?}");
}

#[test]
fn infeasible_motion_whose_failure_is_caught_is_a_warning_and_left_to_the_run() {
    // A block stands around the mug.
    let mut scene = kitchen();
    let crate_around = scene::EntityShape::Box([0.3, 0.3, 0.4]);
    let mug = scene.entities["mug_1"].pose.unwrap();
    let mut block = scene.entities["shelf"].clone();
    block.id = "block".into();
    block.pose = Some(Placement { xyz: [mug.xyz[0], mug.xyz[1], mug.xyz[2] + 0.05], rpy: [0.0; 3] });
    block.shape = Some(crate_around);
    scene.entities.insert("block".into(), block);
    let session = session(&scene);
    let bare = "go(kitchen_table) pick(mug_1) go(user) handover(mug_1, user)";
    let caught = |kinds: &str| {
        format!("policy fetch for hsr {{ try {{ {bare} }} catch {kinds} {{ say(\"I cannot reach it\") }} }}")
    };
    let (said, _) = refusal(&session, &format!("policy fetch for hsr {{ {bare} }}"));
    assert!(said.starts_with("M0602 `pick` cannot perform `reach(mug_1)`"), "{said}");
    // Another failure is caught: still an error.
    refusal(&session, &caught("slipped"));
    for kinds in ["unreachable", "slipped, unreachable", "any"] {
        let policy = caught(kinds);
        let (graph, found) = compile(&session, &policy);
        assert!(graph.is_some(), "{kinds}: {:?}", errors(&found));
        let warning = found.iter().find(|said| said.code.to_string() == "M0602").expect("a warning");
        assert_eq!(warning.severity, Severity::Warning);
        assert!(warning.help.as_ref().is_some_and(|help| help.contains("`catch`")), "{warning:?}");
        let reach = motions(&session, &policy).into_iter().find(|(query, ..)| query == "reach").unwrap();
        assert_eq!(reach.1, Verdict::Deferred);
        assert!(reach.2.starts_with("it is infeasible, which a handler catches: "), "{reach:?}");
    }
}

#[test]
fn motions_to_unknown_things_are_left_to_the_run() {
    let found = motions(
        &KITCHEN,
        r#"policy tidy for hsr {
            go(kitchen_table)
            let cups = detect_all("cup")
            each cup in cups at most 2 { go(cup) }
        }"#,
    );
    assert_eq!(found[0].1, Verdict::Proven, "{found:?}");
    let (_, verdict, why) = found.last().unwrap();
    assert_eq!(*verdict, Verdict::Deferred);
    assert_eq!(why, "only the run determines which thing `cup` is");
}

#[test]
fn without_geometry_every_motion_is_deferred() {
    let robot = builtin::robot("hsr").unwrap().robot;
    let scene = kitchen();
    let session = Session::builder().robot(&robot).scene(&scene).build(&mut Sources::default());
    let found = motions(&session, "policy come for hsr { go(sink) }");
    assert_eq!(found, [("go_to".to_owned(), Verdict::Deferred, String::new())]);
}

/// The kitchen with walls around the sink, higher than the robot.
fn walled() -> Scene {
    let mut scene = kitchen();
    let walls = [(2.1, -0.9, 2.4, 0.1), (2.1, -3.3, 2.4, 0.1), (0.9, -2.1, 0.1, 2.5), (3.3, -2.1, 0.1, 2.5)];
    for ((x, y, along, across), at) in walls.into_iter().zip(0..) {
        let mut wall = scene.entities["shelf"].clone();
        wall.id = format!("wall_{at}").into();
        wall.pose = Some(Placement { xyz: [x, y, 1.0], rpy: [0.0; 3] });
        wall.shape = Some(scene::EntityShape::Box([along, across, 2.0]));
        scene.entities.insert(wall.id.clone(), wall);
    }
    scene
}

#[test]
fn way_that_is_blocked_is_refused_with_its_story() {
    let (said, since) = refusal(&session(&walled()), "policy wash for hsr { go(user) go(sink) }");
    assert!(said.starts_with("M060"), "{said}");
    assert!(said.contains("the robot stands where `go(user)` brought it"), "{said}");
    assert_eq!(since, ["the robot came here"]);
}

#[test]
fn infeasible_motion_that_is_never_reached_is_no_error() {
    let found =
        motions(&session(&walled()), "policy wash for hsr { go(user) if open(drawer_1) { go(sink) } }");
    assert_eq!(found[0].1, Verdict::Proven);
    // In the scene the drawer is closed.
    assert_eq!(found.len(), 1, "{found:?}");
}

#[test]
fn loop_comes_to_an_end() {
    let found = motions(&KITCHEN, "policy pace for hsr { repeat 3 { go(user) go(sink) } }");
    assert_eq!(found.len(), 2);
}

#[test]
fn after_a_failure_it_is_not_known_where_the_robot_stopped() {
    let found = motions(&KITCHEN, "policy come for hsr { try { go(sink) } catch any { go(user) } }");
    assert_eq!(found[0].1, Verdict::Proven);
    let (_, verdict, why) = &found[1];
    assert_eq!((*verdict, why.as_str()), (Verdict::Deferred, "the pose in which `go` stopped is unknown"));
}

#[test]
fn motions_behind_an_open_drawer_are_computed_with_it_open() {
    let found = motions(
        &KITCHEN,
        "policy look for hsr {
            go(drawer_1) open(drawer_1) go(kitchen_table) go(drawer_1) close(drawer_1) go(sink)
        }",
    );
    let told: Vec<_> =
        found.iter().map(|(query, verdict, why)| format!("{query}: {verdict:?} {why}")).collect();
    assert_eq!(found.len(), 6);
    assert!(found.iter().all(|(_, verdict, _)| *verdict == Verdict::Proven), "{told:#?}");
}

#[test]
fn refutation_names_an_obstacle_before_a_drawer() {
    let mut scene = kitchen();
    let mut chair = scene.entities["trash"].clone();
    chair.id = "chair".into();
    chair.pose = Some(Placement { xyz: [2.95, -1.7, 0.4], rpy: [0.0; 3] });
    chair.shape = Some(scene::EntityShape::Cylinder { radius: 0.1, height: 0.8 });
    scene.entities.insert(chair.id.clone(), chair);
    let (said, _) =
        refusal(&session(&scene), "policy look for hsr { go(drawer_1) open(drawer_1) close(drawer_1) }");
    assert!(
        said.starts_with("M0603 `open` cannot perform `pull(drawer_1)`: `chair` blocks the path"),
        "{said}"
    );
}

#[test]
fn search_without_a_result_warns_and_leaves_the_motion_to_the_run() {
    let mut scene = kitchen();
    let mut screen = scene.entities["shelf"].clone();
    screen.id = "screen".into();
    screen.pose = Some(Placement { xyz: [1.7, 0.3, 1.2], rpy: [0.0; 3] });
    screen.shape = Some(scene::EntityShape::Box([0.05, 1.4, 1.0]));
    scene.entities.insert(screen.id.clone(), screen);
    let (graph, said) = compile(&session(&scene), "policy see for hsr { go(kitchen_table) inspect(mug_1) }");
    assert!(graph.is_some(), "{:?}", errors(&said));
    let warned: Vec<_> = said.iter().filter(|it| it.code.to_string().starts_with("M06")).collect();
    for it in &warned {
        assert_eq!(it.severity, Severity::Warning);
        assert!(it.message.starts_with("no motion was found with which `"), "{it:?}");
        let left = "this is not proven, so the engine checks the motion again at run time";
        assert!(it.help.as_ref().is_some_and(|help| help.ends_with(left)), "{it:?}");
    }
}

#[test]
fn reach_motion_proves_reachable() {
    let (graph, said) =
        compile(&KITCHEN, "policy take for hsr achieves holding(mug_1) { go(kitchen_table) pick(mug_1) }");
    assert!(errors(&said).is_empty(), "{:?}", errors(&said));
    let graph = graph.unwrap();
    let pick = graph.nodes.iter().find_map(|node| match &node.kind {
        NodeKind::Call(call) if call.needs.len() > 4 => Some(call),
        _ => None,
    });
    let fluent = graph.fluents.iter().position(|fluent| fluent.name == "reachable").unwrap();
    let is_it = |need: &&motet_graph::Need| match &need.condition {
        motet_graph::Condition::Fact(fact) => fact.fluent.index() == fluent,
        _ => false,
    };
    let need = pick.unwrap().needs.iter().find(is_it).unwrap();
    assert_eq!(need.verdict, Verdict::Proven);
}

/// The kitchen with a zone of this extent.
fn with_zone(at: [f64; 2], size: [f64; 2]) -> Scene {
    let mut scene = kitchen();
    let pose = Placement { xyz: [at[0], at[1], 0.0], rpy: [0.0; 3] };
    let mut zone = scene::Entity::place("stairs".into(), pose);
    zone.kind = "Zone".into();
    zone.shape = Some(scene::EntityShape::Box([size[0], size[1], 0.1]));
    scene.entities.insert("stairs".into(), zone);
    scene
}

#[test]
fn way_into_a_zone_that_is_kept_out_of_is_refused() {
    let session = session(&with_zone([2.1, -2.1], [2.4, 2.4]));
    let found = motions(&session, "policy wash for hsr { go(sink) }");
    assert_eq!(found[0].1, Verdict::Proven);
    let said = refusal(&session, "policy wash for hsr keep out of stairs { go(sink) }").0;
    assert!(said.contains("the region that `keep out of stairs` forbids"), "{said}");
    let said = refusal(&session, "policy wash for hsr { keep out of stairs { go(sink) } }").0;
    assert!(said.contains("the region that `keep out of stairs` forbids"), "{said}");
    // The rule ends with its block.
    let after = motions(&session, "policy wash for hsr { keep out of stairs { go(user) } go(sink) }");
    assert!(after.iter().all(|(_, verdict, _)| *verdict == Verdict::Proven), "{after:?}");
}

#[test]
fn distance_is_kept_by_the_whole_motion() {
    let said = refusal(&KITCHEN, "policy come for hsr keep distance(user) >= 1.5 m { go(user) }").0;
    assert!(said.contains("the region that `keep distance(user) >= 1.5 m` forbids"), "{said}");
    let found = motions(&KITCHEN, "policy wash for hsr keep distance(user) >= 30 cm { go(sink) }");
    assert_eq!(found[0].1, Verdict::Proven);
}

#[test]
fn distance_to_something_without_a_pose_is_left_to_the_run() {
    let mut scene = kitchen();
    scene.entities["user"].pose = None;
    let found = motions(&session(&scene), "policy wash for hsr keep distance(user) >= 1 m { go(sink) }");
    let (_, verdict, why) = &found[0];
    assert_eq!(*verdict, Verdict::Deferred);
    assert_eq!(why, "it is not known where to keep away from `user`");
}

#[test]
fn places_by_rules_and_poses_are_feasible_one_after_the_other() {
    let found = motions(
        &KITCHEN,
        "policy set for hsr {
            go_to_pose(pose(1.3 m, 0.35 m, 0 deg))
            pick(mug_1)
            place(mug_1, kitchen_table, beside: apple)
            pick(mug_1)
            place(mug_1, kitchen_table, near: plate)
            pick(mug_1)
            place_at(mug_1, kitchen_table, pose(1.95 m, 0.4 m, 0.77 m, 0 deg))
        }",
    );
    for (query, verdict, why) in &found {
        assert_eq!(*verdict, Verdict::Proven, "{query}: {why}");
    }
    let queries: Vec<&str> = found.iter().map(|(query, ..)| query.as_str()).collect();
    assert_eq!(queries, ["stand_at", "reach", "put", "reach", "put", "reach", "put_at"]);
}

/// Policy that grasps the mug of the kitchen at a pose.
fn grasped(at: &str) -> String {
    format!("policy p for hsr {{ go(kitchen_table) inspect(mug_1) {at} go(counter) }}")
}

#[test]
fn grasps_close_at_a_point_of_the_thing() {
    let found = motions(&KITCHEN, &grasped("grasp(mug_1, pose(1.98 m, 0.33 m, 0.79 m, 0 deg))"));
    let [_, _, (grasp, verdict, why), (_, then, _)] = &found[..] else { panic!("{found:?}") };
    assert_eq!((grasp.as_str(), verdict, then), ("reach_at", &Verdict::Proven, &Verdict::Proven), "{why}");
    let found = motions(&KITCHEN, &grasped("let at = locate(mug_1) grasp(mug_1, at)"));
    let (grasp, verdict, why) = found.iter().find(|(query, ..)| query == "reach_at").unwrap();
    assert_eq!((grasp.as_str(), verdict), ("reach_at", &Verdict::Deferred));
    assert_eq!(why, "only the run determines the point");
}

#[test]
fn grasps_beside_the_thing_are_refused() {
    let beside = "grasp(mug_1, pose(-0.5 m, 0.3 m, 0 deg))";
    let said = refusal(&KITCHEN, &grasped(beside)).0;
    assert!(said.starts_with("M0610 `grasp` cannot perform `reach_at(mug_1, pose(-0.5 m, 0.3 m, 0 deg))`"));
    assert!(said.contains("the point is 2.54 m beside it, a hand closes within 0.05 m of it"), "{said}");
    let tried = format!("try {{ {beside} }} catch not_found {{ say(\"Where is it?\") done }}");
    let (graph, said) = compile(&KITCHEN, &grasped(&tried));
    assert!(graph.is_some(), "{said:?}");
    assert!(said.iter().any(|said| said.code.to_string() == "M0610"), "{said:?}");
}

/// Errors of a policy that picks the mug and puts it on the table by some rules.
fn placed(rules: &str) -> Vec<String> {
    let policy = format!("policy p for hsr {{ go(mug_1) pick(mug_1) place(mug_1, kitchen_table, {rules}) }}");
    errors(&compile(&KITCHEN, &policy).1)
}

#[test]
fn places_that_do_not_exist_are_refused() {
    assert_eq!(placed("near: plate"), [""; 0]);
    assert_eq!(
        placed("near: bottle"),
        ["M0607 `place` cannot perform `put(mug_1, kitchen_table, near: bottle)`: nothing of \
             `kitchen_table` within 0.30 m of `bottle` is free; the robot stands where `go(mug_1)` brought \
             it, the hand holds `mug_1`"]
    );
    assert!(placed("away_from_edge: 60 cm")[0].contains("needs 0.60 m to the rim of `kitchen_table`"));
    assert!(placed("beside: coke")[0].contains("`coke` is not on `kitchen_table`"));
    assert!(placed("away_from_edge: -1 cm")[0].starts_with("M04"), "{:?}", placed("away_from_edge: -1 cm"));
}

#[test]
fn poses_of_the_base_that_are_taken_are_refused() {
    let ask = |policy: &str| refusal(&KITCHEN, policy).0;
    let inside = ask("policy p for hsr { go_to_pose(pose(2.2 m, 0.5 m, 0 deg)) }");
    assert!(inside.starts_with("M0602 `go_to_pose` cannot perform `stand_at(pose(2.2 m, 0.5 m, 0 deg))`"));
    let kept =
        "policy p for hsr keep distance(kitchen_table) >= 1 m { go_to_pose(pose(1.4 m, 0.5 m, 0 deg)) }";
    assert!(
        ask(kept).contains("the region that `keep distance(kitchen_table) >= 1 m` forbids"),
        "{}",
        ask(kept)
    );
}

#[test]
fn block_of_a_keep_that_begins_where_its_rule_is_broken_is_refused() {
    let home = "policy come for hsr { go(user) keep distance(user) >= 1 m { home() say(\"a\") } }";
    let (said, since) = refusal(&KITCHEN, home);
    assert!(said.starts_with("M0609 `keep distance(user) >= 1 m` is broken"), "{said}");
    assert!(said.contains(" m from `user`, where `go(user)` brought it"), "{said}");
    assert_eq!(since, ["the robot came here"]);
    // A step before the block leaves the place.
    let away = "policy come for hsr { go(user) go(start) keep distance(user) >= 1 m { home() } }";
    assert!(compile(&KITCHEN, away).0.is_some());
    // The user may have gone away by then.
    let waits = "policy come for hsr { go(user) wait until distance(user) > 1 m \
        keep distance(user) >= 1 m { home() } }";
    assert!(compile(&KITCHEN, waits).0.is_some());
    let in_zone = session(&with_zone([0.0, 0.0], [1.0, 1.0]));
    let said = refusal(&in_zone, "policy p for hsr keep out of stairs { go(user) }").0;
    assert!(said.contains("the robot is in `stairs` at the start"), "{said}");
}

#[test]
fn motion_that_only_a_rule_makes_infeasible_names_the_rule() {
    let near = "policy p for hsr { go(kitchen_table) inspect(mug_1) pick(mug_1) }";
    assert!(compile(&KITCHEN, near).0.is_some());
    let kept = "policy p for hsr { keep distance(mug_1) >= 1 m \
        { go(kitchen_table) inspect(mug_1) pick(mug_1) } }";
    let said = refusal(&KITCHEN, kept).0;
    assert!(said.contains("`keep distance(mug_1) >= 1 m` leaves no way"), "{said}");
    assert!(said.contains("without it there is a motion"), "{said}");
    let said = refusal(&KITCHEN, "policy p for hsr keep distance(user) >= 1.5 m { go(user) }").0;
    assert!(said.contains("`keep distance(user) >= 1.5 m` leaves no way"), "{said}");
}

#[test]
fn need_that_no_step_can_change_is_a_warning_where_its_failure_is_caught() {
    let lab = in_scene(&builtin::robot("hsr").unwrap(), &builtin::scene("lab").unwrap());
    let lift = "go(workbench) inspect(vise)";
    let bare = compile(&lab, &format!("policy p for hsr {{ {lift} pick(vise) }}"));
    assert_eq!(errors(&bare.1).len(), 2, "{:?}", bare.1);
    let (graph, said) = compile(
        &lab,
        &format!(
            "policy p for hsr {{ {lift} try {{ pick(vise) }} catch too_heavy, unreachable \
             {{ cannot \"no\" }} }}"
        ),
    );
    assert!(graph.is_some(), "{said:#?}");
    let warned = said.iter().filter(|said| said.code.0 == "M0501");
    let help: Vec<_> = warned.filter_map(|said| said.help.as_deref()).collect();
    assert_eq!(help, ["the step fails, and the `catch` around it runs"; 2]);
    let half =
        format!("policy p for hsr {{ {lift} try {{ pick(vise) }} catch slipped {{ cannot \"no\" }} }}");
    assert!(compile(&lab, &half).0.is_none());
}
