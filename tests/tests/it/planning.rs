//! Plans by search: what is asked for is reached in simulation, on either robot, and what cannot be is said.
use motet_compiler::plan::{Goal, NoPlan, Persistence};
use motet_planner::builtin::{self, PlanError, Planned};
use motet_requests::Aim;
use motet_robots::scene::Scene;
use motet_runtime::{Engine, RunEnd, StartState, Time};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{Severity, Sources};
use motet_tests::setup;

fn plan(robot: &str, scene: &str, goals: &[&str]) -> Result<Planned, PlanError> {
    plan_in(robot, &setup::scene(scene), goals)
}

fn plan_in(robot: &str, scene: &Scene, goals: &[&str]) -> Result<Planned, PlanError> {
    let robot = setup::robot(robot);
    let (session, _) = setup::session(Some(&robot), Some(scene), &mut Sources::default());
    let aims: Vec<Aim> = goals
        .iter()
        .enumerate()
        .map(|(index, goal)| Aim {
            goal: Goal::read(goal, Persistence::ToTheEnd).unwrap(),
            name: format!("goal_{index}"),
            only_if: None,
            awaits: None,
            named_step: None,
        })
        .collect();
    builtin::plan(&session, Some(&robot), "plan", &aims)
}

/// Plans, runs, and looks whether the facts hold.
#[track_caller]
fn reaches(scene: &str, goals: &[&str], facts: &[(&str, &[&str])]) {
    for robot in ["hsr", "anymal_z1"] {
        let planned = plan(robot, scene, goals).unwrap_or_else(|why| panic!("{robot}: {why}"));
        let worse: Vec<_> =
            planned.compiled.diagnostics.iter().filter(|said| said.severity > Severity::Note).collect();
        assert!(worse.is_empty(), "{robot}: {}\n{worse:?}", planned.text);
        assert_eq!(planned.text, plan(robot, scene, goals).unwrap().text, "the same again");
        let (card, room) = (setup::robot(robot), setup::scene(scene));
        let entities =
            room.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone())).collect();
        let start = StartState { entities, ..StartState::default() };
        let mut engine = Engine::new(planned.compiled.graph.unwrap(), &start).unwrap();
        let mut sim = Sim::new(&card, &room, SimOptions::default());
        let end = motet_runtime::run(&mut engine, &mut sim, &mut (), Time::ZERO);
        assert!(matches!(end, RunEnd::Done { .. }), "{robot}: {end}\n{}", planned.text);
        for (fluent, args) in facts {
            assert_eq!(sim.holds(fluent, args), Some(true), "{robot}: {fluent}{args:?}\n{}", planned.text);
        }
    }
}

#[test]
fn planner_goals_are_reached() {
    reaches("kitchen", &["at(coke, user)"], &[("at", &["coke", "user"])]);
    reaches("kitchen", &["on(mug_1, shelf)"], &[("on", &["mug_1", "shelf"])]);
    reaches("kitchen", &["in(sponge, drawer_1)"], &[("in", &["sponge", "drawer_1"])]);
}

#[test]
fn planner_goal_that_holds_already_is_a_policy_that_is_done() {
    reaches("kitchen", &["on(mug_1, kitchen_table)"], &[("on", &["mug_1", "kitchen_table"])]);
    let planned = plan("hsr", "kitchen", &["on(mug_1, kitchen_table)"]).unwrap();
    assert!(planned.text.contains("{\n    done\n}"), "{}", planned.text);
}

#[test]
fn planner_thing_whose_name_others_have_too_is_looked_for_by_another() {
    reaches("living_room", &["in(toy, drawer_1)"], &[("in", &["toy", "drawer_1"])]);
    let planned = plan("anymal_z1", "living_room", &["in(toy, drawer_1)"]).unwrap();
    assert!(planned.text.contains("\"toy car\""), "{}", planned.text);
}

#[test]
fn planner_goals_are_reached_one_after_the_other() {
    reaches(
        "kitchen",
        &["at(apple, user)", "in(bottle, trash)"],
        &[("at", &["apple", "user"]), ("in", &["bottle", "trash"])],
    );
}

#[test]
fn planner_what_a_plan_opens_it_closes() {
    let text = plan("hsr", "kitchen", &["in(sponge, drawer_1)"]).unwrap().text;
    let (opened, closed) = (text.find("open(drawer_1)").unwrap(), text.find("close(drawer_1)").unwrap());
    assert!(opened < closed, "{text}");
}

#[test]
fn planner_keeps_in_the_hand_what_was_in_a_drawer() {
    for robot in ["hsr", "anymal_z1"] {
        let mut room = setup::scene("living_room");
        let remote = room.entities.get_mut("remote_1").unwrap();
        (remote.on, remote.pose, remote.inside) = (None, None, Some("drawer_1".into()));
        remote.visible = Some(false);
        let text = plan_in(robot, &room, &["holding(remote_1)"]).unwrap().text;
        assert!(text.contains("open(drawer_1)") && text.trim_end().ends_with("pick(remote_1)\n}"), "{text}");
        assert!(!text.contains("place("), "{text}");
    }
}

#[test]
fn planner_what_cannot_be_reached_is_said_with_the_reason() {
    let why = |goal| match plan("hsr", "lab", &[goal]) {
        Err(PlanError::NoPlan(NoPlan::Unreachable { blocker, .. })) => blocker.unwrap_or_default(),
        other => panic!("{other:?}"),
    };
    assert!(why("on(vise, desk)").contains("mass"), "{}", why("on(vise, desk)"));
    // Who is brought something is no reason.
    assert!(why("at(vise, user)").contains("mass"), "{}", why("at(vise, user)"));
    assert!(why("in(pen, drawer_2)").contains("locked"), "{}", why("in(pen, drawer_2)"));
}

#[test]
fn planner_wrong_goals_are_told_apart() {
    assert!(matches!(Goal::read("on(", Persistence::ToTheEnd), Err(NoPlan::NoCondition { .. })));
    let wrong = plan("hsr", "kitchen", &["on(mug_9, shelf)"]);
    assert!(matches!(wrong, Err(PlanError::NoPlan(NoPlan::Wrong { .. }))));
}
