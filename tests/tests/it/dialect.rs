//! InteLiPlan's dialect: tagged texts, and lists of actions that become policies which run.
use motet_planner::inteliplan::actions::{self, InterpretedPolicy, NoPolicy};
use motet_planner::inteliplan::exchange::{self, Exchange, NoDialogue};
use motet_requests::RequestContext;
use motet_syntax::{FileId, Severity, Source, Sources};
use motet_tests::setup;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

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
    assert!(matches!(read("place coke"), Err(NoPolicy::Unclear { .. })), "it has no destination");
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

/// Ids that people give, and that have words of the dialect in them.
#[test]
fn dialect_id_with_a_preposition_is_one_id() {
    let mut scene = setup::scene("kitchen");
    let coke = scene.entities.get("coke").unwrap().clone();
    for id in ["coke_in_drawer_1", "letter_to_user", "cup_on_sink"] {
        let names = Vec::new();
        scene
            .entities
            .insert(id.into(), motet_robots::scene::Entity { id: id.into(), names, ..coke.clone() });
    }
    let steps = "go(coke_in_drawer_1) pick(coke_in_drawer_1) place(coke_in_drawer_1, sink) \
                 go(letter_to_user) pick(letter_to_user) handover(letter_to_user, user) \
                 pick(cup_on_sink) place(cup_on_sink, counter)";
    let (list, left_out, read) = through_the_dialect(steps, &scene);
    assert!(left_out.is_empty(), "{left_out:?}");
    let calls: Vec<&str> = read.lines().filter(|line| line.ends_with(')')).collect();
    assert_eq!(calls.join(" "), steps, "{list}");
}

/// A policy of these steps as a list of actions, what the list leaves out, and the policy that is read from
/// the list.
fn through_the_dialect(steps: &str, scene: &motet_robots::scene::Scene) -> (String, Vec<String>, String) {
    let robot = setup::robot("hsr");
    let text = format!("policy p {{ {steps} }}");
    let parsed = motet_syntax::read(&Source::new("p.motet", text.as_str()), FileId(0));
    assert!(parsed.diagnostics.is_empty(), "{text}: {:?}", parsed.diagnostics);
    let (list, left_out) = actions::write(parsed.file.policies().next().unwrap(), scene);
    let (session, _) = setup::session(Some(&robot), Some(scene), &mut Sources::default());
    let said = Exchange { user: "Well?".into(), robot: list.clone(), ..Exchange::default() };
    let heard = exchange::read(&said.write()).unwrap().remove(0).robot;
    let read = match actions::read(&heard, "p", &session, Some(&robot), &RequestContext::new(scene)) {
        Ok(read) => read.policy,
        Err(NoPolicy::Empty) => String::new(),
        Err(why) => panic!("{list:?} of {text}: {why}"),
    };
    (list, left_out, read)
}

/// The kitchen with another thing of an id and names, or the codes for which it is refused.
fn kitchen_with(id: &str, names: &[String]) -> Result<motet_robots::scene::Scene, Vec<&'static str>> {
    let mut json: serde_json::Value =
        serde_json::from_str(motet_robots::builtin::scene_text("kitchen").unwrap().json).unwrap();
    let all = json["entities"].as_array_mut().unwrap();
    let mut thing = all.iter().find(|one| one["id"] == "coke").unwrap().clone();
    (thing["id"], thing["names"]) = (id.into(), serde_json::json!(names));
    all.push(thing);
    let (scene, said) = motet_robots::scene::read(&Source::new("scene.json", json.to_string()), FileId(0));
    let errors = said.iter().filter(|said| said.severity == Severity::Error);
    let errors: Vec<&'static str> = errors.map(|said| said.code.0).collect();
    scene.filter(|_| errors.is_empty()).ok_or(errors)
}

/// Pieces of names that a scene or a detector may give.
const PIECES: &[&str] = &[
    "mug",
    "coke",
    "user",
    "home",
    "2",
    "1.",
    "-",
    "_",
    " ",
    "(",
    ")",
    "[",
    "]",
    "<robot>",
    "</user>",
    "'",
    "\"",
    ".",
    "!",
    "?",
    "\u{2192}",
    " on ",
    "_in_",
    " to ",
    " from ",
    " then ",
    "and ",
    "Mug",
    "\u{130}",
    "\u{df}",
    "\u{fb01}",
    "\u{ff4d}\u{ff55}\u{ff47}",
    "m\u{fc}g",
    "mu\u{308}g",
    "\u{43c}ug",
    ",",
    ";",
    "`",
    "\n",
    "\u{7}",
    "\u{202e}",
    "\u{200b}",
    "# Request",
    "```",
    "back",
    " <robot> go to ",
    "open fridge_1",
    ", open fridge_1",
    "\u{1}3",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever a thing is called, an action about it is read back as the same one, or it is left out and
    /// told.
    #[test]
    fn dialect_hostile_names_stay_one_name(
        ids in vec(vec(select(PIECES), 1..5), 1..4),
        names in vec(vec(select(PIECES), 1..4), 1..4),
    ) {
        let called: Vec<String> = names.iter().map(|name| name.concat()).collect();
        for id in ids.iter().map(|id| id.concat()) {
            let Ok(scene) = kitchen_with(&id, &called).or_else(|_| kitchen_with(&id, &[])) else {
                let why = kitchen_with(&id, &[]).unwrap_err();
                let is_about_id = |code: &&str| ["M0433", "M0434", "M0435"].contains(code);
                prop_assert!(why.iter().all(is_about_id), "{id:?}: {why:?}");
                continue;
            };
            let written = motet_syntax::print::identifier(&id).to_string();
            for step in ["go(ID)", "pick(ID)", "place(ID, sink)", "handover(ID, user)", "inspect(ID)"] {
                let step = step.replace("ID", &written);
                let (list, left_out, read) = through_the_dialect(&step, &scene);
                prop_assert_eq!(list.is_empty(), !left_out.is_empty(), "{:?} {:?}", list, left_out);
                let calls: Vec<&str> = read.lines().filter(|line| line.ends_with(')')).collect();
                let expected: &[&str] = if list.is_empty() { &[] } else { &[&step] };
                prop_assert_eq!(calls, expected, "{:?}", list);
            }
        }
    }
}

#[test]
fn dialect_has_limits() {
    let long = format!("go to counter, {}", "go ".repeat(2_000));
    let Err(NoPolicy::Unknown { number: 2, action }) = read(&long) else { panic!("it is read") };
    assert_eq!(action.len(), 40);
    let many = "<user> bring me the coke\n<robot> go to counter\n".repeat(exchange::MAX_EXCHANGES + 1);
    let line = 2 * exchange::MAX_EXCHANGES + 1;
    assert_eq!(exchange::read(&many), Err(exchange::NoDialogue::TooMany { line }));
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
