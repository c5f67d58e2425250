//! InteLiPlan's dialect: tagged texts, and lists of actions that become policies which run.
use motet_planner::inteliplan::actions::{self, InterpretedPolicy, NoPolicy};
use motet_planner::inteliplan::exchange::{self, Exchange, NoDialogue};
use motet_requests::RequestContext;
use motet_syntax::{FileId, Severity, Source, Sources};
use motet_tests::setup;

fn read(list: &str) -> Result<InterpretedPolicy, NoPolicy> {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    actions::read(list, "plan", &session, Some(&robot), &RequestContext::new(&scene))
}

/// The calls of the policy, and that it has no error.
#[track_caller]
fn becomes(list: &str, calls: &[&str]) {
    let loose = read(list).unwrap_or_else(|why| panic!("{list}: {why}"));
    let found: Vec<&str> = loose.policy.lines().filter(|line| line.ends_with(')')).collect();
    assert_eq!(found, calls, "{list}");
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let parsed = motet_syntax::read(&Source::new("plan.motet", loose.policy.as_str()), FileId(0));
    let said = session.check(&parsed);
    let errors: Vec<_> = said.iter().filter(|said| said.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{list}: {errors:?}");
}

#[test]
fn dialect_lists_of_actions_become_policies() {
    let fetch = ["go(counter)", "pick(coke)", "go(user)", "handover(coke, user)"];
    becomes("go to counter, pick coke, go to user, hand over coke to user", &fetch);
    becomes(
        "1. Go to the kitchen counter\n2. Pick up the coke can\n3. go to user\n4. give it to the user",
        &fetch,
    );
    becomes("go to(counter), pick(coke), go to(user), handover(coke, user)", &fetch);
    becomes(
        "go to table, pick the red mug, go to sink, place on sink",
        &["go(kitchen_table)", "pick(mug_1)", "go(sink)", "place(mug_1, sink)"],
    );
    becomes(
        "go to fridge, open fridge, close fridge",
        &["go(fridge_1)", "open(fridge_1)", "close(fridge_1)"],
    );
}

/// The calls of a list, which need not pass the check.
#[track_caller]
fn reads(list: &str, calls: &[&str]) {
    let loose = read(list).unwrap_or_else(|why| panic!("{list}: {why}"));
    let found: Vec<&str> = loose.policy.lines().filter(|line| line.ends_with(')')).collect();
    assert_eq!(found, calls, "{list}");
}

#[test]
fn dialect_all_seven_actions_in_their_forms() {
    reads("search coke", &["search(\"coke can\", [counter])"]);
    reads("search for the coke on the table", &["search(\"coke can\", [kitchen_table])"]);
    reads("turn left, turn right", &["turn(90 deg)", "turn(-90 deg)"]);
    reads("turn 45 degrees, turn around", &["turn(45 deg)", "turn(180 deg)"]);
    reads("pick coke, go back, place coke", &["pick(coke)", "go(user)", "handover(coke, user)"]);
    reads("Pick coke. Go to sink. Place coke.", &["pick(coke)", "go(sink)", "place(coke, sink)"]);
    reads("pick coke from the counter", &["go(counter)", "pick(coke)"]);
    reads(
        "Open drawer, Pick sponge, Place in drawer, Close drawer",
        &["open(drawer_1)", "pick(sponge)", "place(sponge, drawer_1)", "close(drawer_1)"],
    );
}

#[test]
fn dialect_nothing_is_dropped() {
    for (list, number) in
        [("go to counter. juggle coke", 2), ("pick coke. whatever", 2), ("turn somewhere", 1)]
    {
        let why = read(list).unwrap_err();
        let at = match &why {
            NoPolicy::Unknown { number, .. } | NoPolicy::Lacking { number, .. } => *number,
            NoPolicy::Unclear { number, .. } => *number,
            NoPolicy::Empty => 0,
        };
        assert_eq!(at, number, "{list}: {why}");
    }
    assert!(matches!(read("place coke"), Err(NoPolicy::Unclear { .. })), "where to is not said");
}

#[test]
fn dialect_name_with_a_comma_is_one_name() {
    let robot = setup::robot("hsr");
    let mut scene = setup::scene("kitchen");
    scene.entities.get_mut("coke").unwrap().names.push("can, red".into());
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let loose =
        actions::read("pick can, red", "plan", &session, Some(&robot), &RequestContext::new(&scene)).unwrap();
    assert!(loose.policy.contains("pick(coke)"), "{}", loose.policy);
}

#[test]
fn dialect_what_is_read_otherwise_is_said() {
    let warnings = read("go to table, pick up coke").unwrap().warnings.join("\n");
    assert!(warnings.contains("read `pick up` as `pick`"), "{warnings}");
    assert!(warnings.contains("took `table` to be `kitchen_table`"), "{warnings}");
}

#[test]
fn dialect_what_is_no_action_is_refused() {
    assert_eq!(read(" ,\n"), Err(NoPolicy::Empty));
    assert!(matches!(read("I cannot see the coke."), Err(NoPolicy::Unknown { number: 1, .. })));
    assert!(matches!(read("go to table, juggle coke"), Err(NoPolicy::Unknown { number: 2, .. })));
    assert!(matches!(read("pick mug"), Err(NoPolicy::Unclear { number: 1, .. })), "there are two mugs");
    assert!(matches!(read("pick teddy"), Err(NoPolicy::Unclear { .. })));
    assert!(matches!(read("place on table"), Err(NoPolicy::Unclear { .. })), "the hand is empty");
    for hostile in ["((((", "1.2.3.", "pick \"", "place , on", "say \\\"", "\u{0}", "<robot>"] {
        let _ = read(hostile);
    }
}

#[test]
fn dialect_dialogues_are_read_and_written() {
    let text = "<history> None </history>\n<user> Bring me the coke.\n<vision> coke: seen\n<feasibility> \
        coke: feasible\n\
                <robot> go to counter, pick coke\n<user> The other one.\n<robot> Which one?\n";
    let exchanges = exchange::read(text).unwrap();
    assert_eq!(exchanges.len(), 2);
    assert_eq!(exchanges[0].vision, "coke: seen");
    assert_eq!(
        exchanges[1],
        Exchange { user: "The other one.".into(), robot: "Which one?".into(), ..Exchange::default() }
    );
    for one in &exchanges {
        assert_eq!(exchange::read(&one.write()).unwrap(), std::slice::from_ref(one));
    }
}

#[test]
fn dialect_what_is_no_dialogue_is_refused() {
    assert_eq!(exchange::read(""), Err(NoDialogue::Empty));
    assert!(matches!(exchange::read("hello <user> hi"), Err(NoDialogue::BeforeTag { line: 1, .. })));
    assert!(matches!(
        exchange::read("<user> hi <vision> a\n<vision> b"),
        Err(NoDialogue::Twice { line: 2, .. })
    ));
    assert_eq!(exchange::read("<user> 3 < 4 <b> x").unwrap()[0].user, "3 < 4 <b> x");
}

#[test]
fn dialect_policy_is_written_as_a_list() {
    let text = "policy p for hsr { go(counter) monitor when distance(user) < 0.5 m then pause during { \
        go(user) } handover(coke, user) place(coke, fridge_1) }";
    let parsed = motet_syntax::read(&Source::new("p.motet", text), FileId(0));
    let policy = parsed.file.policies().next().unwrap();
    let (list, left_out) = actions::write(policy, &setup::scene("kitchen"));
    assert_eq!(list, "go to counter, go to user, hand over coke to user, place coke in fridge 1");
    assert_eq!(left_out, ["a monitor"]);
}
