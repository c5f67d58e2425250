//! What the compiler has proven or listed beside what a run finds: the place of the robot at the start, and
//! the guards of a graph.

use std::cell::Cell;
use std::collections::BTreeMap;

use motet_graph::{NodeKind, Value, Verdict};
use motet_robots::builtin;
use motet_runtime::{Engine, Event, PreparedSwap, Query, StartState, SwapRefusal, Time};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{FileId, Source, Sources};
use motet_tests::{examples, setup};

use crate::soundness::{DOMAIN, compiled, honest, requests, session_codes, verdicts};

#[test]
fn start_the_simulated_room_agrees_with_the_pose_of_the_base() {
    let mut counts = BTreeMap::<(String, bool), usize>::new();
    for (robot, room) in builtin::ROBOTS.iter().flat_map(|robot| {
        builtin::SCENES.iter().map(|scene| (setup::robot(robot.name), setup::scene(scene.name)))
    }) {
        let spots = room.entities.values().filter_map(|entity| entity.pose).map(|pose| pose.xyz);
        let around = spots.flat_map(|[x, y, _]| [[x - 0.6, y, 0.0], [x, y + 1.0, 0.0], [x + 2.0, y, 1.0]]);
        for base in std::iter::once(room.robot.base).chain(around) {
            let mut scene = room.clone();
            scene.robot.base = base;
            let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
            let sim = Sim::new(&robot, &scene, SimOptions::default());
            for fact in session.initial_facts() {
                let args: Option<Vec<_>> = fact
                    .args
                    .iter()
                    .map(|arg| match arg {
                        Some(Value::Entity(id)) => Some(id.as_str()),
                        _ => None,
                    })
                    .collect();
                let is_place = fact.fluent == "near" || (fact.fluent == "at" && fact.args.len() == 2);
                let Some(args) = args.filter(|args| is_place && (args.len() == 1 || args[0] == "robot"))
                else {
                    continue;
                };
                let holds = sim.holds(&fact.fluent, &args);
                assert_eq!(holds, Some(fact.holds), "{} {:?} {base:?}: {fact:?}", robot.name, args);
                *counts.entry((fact.fluent.to_string(), fact.holds)).or_default() += 1;
            }
        }
    }
    assert!(counts.len() == 4 && counts.values().all(|count| *count > 100), "{counts:?}");
}

/// The steps that a graph guards, with the number of guards of each.
fn guards(graph: &motet_graph::Graph) -> BTreeMap<String, usize> {
    let mut found = BTreeMap::new();
    for node in &graph.nodes {
        let NodeKind::Call(call) = &node.kind else { continue };
        let needs = call.needs.iter().filter(|need| need.verdict == Verdict::Deferred).count();
        // A step of a called policy is told of by the call.
        let path = node.path.split(':').next().unwrap_or_default();
        if needs > 0 {
            *found.entry(path.to_owned()).or_default() += 1;
        }
    }
    found
}

#[test]
fn left_to_run_are_facts_with_their_arguments() {
    let (session, _) = setup::session(None, None, &mut Sources::default());
    let text = "fluent wet(e: Entity)\nperception all(what: Text) -> List<Object>\n\
                action dry(o: Object)\n    needs wet(o)\n    makes not wet(o)\n\
                policy p { let xs = all(\"mug\") dry(first(xs)) }";
    let checked = session.check_document(&motet_syntax::read(&Source::new("p.motet", text), FileId(99)));
    let told: Vec<&str> = checked.deferred_notes.iter().map(|note| note.message.as_str()).collect();
    assert!(told.iter().any(|told| told.contains("`wet(first(xs))`")), "{told:?}");
}

#[test]
fn left_to_run_are_the_guards_of_the_graph() {
    let mut seen = 0;
    for (path, robot, scene) in examples::examples() {
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
        let whole = Source::new("example.motet", examples::read(&path));
        let parsed = motet_syntax::read(&whole, FileId(99));
        let checked = session.check_document(&parsed);
        let graph = session.compile(&parsed, None).graph.unwrap();
        let mut listed = BTreeMap::<String, usize>::new();
        for note in &checked.deferred_notes {
            assert_eq!(note.code.0, "M0505");
            assert!(note.message.starts_with("left to the run: `"), "{}", note.message);
            *listed.entry(note.path.clone()).or_default() += 1;
        }
        assert_eq!(listed, guards(&graph), "{}", path.display());
        assert_eq!(checked.policies[0].deferred_motions, graph.deferred_motions(), "{}", path.display());
        seen += listed.len();
    }
    assert!(seen > 10, "{seen}");
}

#[test]
fn start_a_step_that_lacks_its_drive_is_refused_with_the_drive() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let parsed = motet_syntax::read(&Source::new("p.motet", "policy p for hsr { pick(mug_1) }"), FileId(99));
    let said = session.check(&parsed);
    let refused = said.iter().find(|said| said.code.0 == "M0501").unwrap();
    assert!(refused.message.contains("does not hold at the start"), "{}", refused.message);
    let fix = refused.fix.as_ref().unwrap();
    assert!(fix.edits[0].text.starts_with("go(mug_1)"), "{fix:?}");
}

/// A need of one of several facts holds where each path makes another one of them.
#[test]
fn proofs_of_one_of_several_facts_look_at_each_path() {
    let declared = "entity b: Object\nentity c: Object\naction use_any()\n    needs f(any)\n\
                    action use_one()\n    needs f(a) or f(b) or f(c)\ninitially not f(any)\n";
    let paths = [
        "if g(a) { make(a) } else { make(b) }",
        "if g(a) { make(a) } else if g(b) { make(b) } else { make(c) }",
        "if g(a) { make(a) } else if g(b) { make(b) } else if g(c) { make(c) } else { make(a) } wave()",
    ];
    let goals = ["f(any)", "f(a) or f(b) or f(c)", "not (not f(a) and not f(b) and not f(c))"];
    for (path, goal) in paths.iter().flat_map(|path| goals.map(|goal| (path, goal))) {
        let policy = |steps: &str| format!("{declared}policy p achieves {goal} {{ {path} {steps} }}");
        for callee in ["use_any", "use_one"] {
            assert_eq!(
                verdicts(callee, &policy(&format!("{callee}()"))),
                [Verdict::Proven],
                "{path}, {goal}"
            );
        }
        let codes = |steps: &str| session_codes(None, &format!("{DOMAIN}\n{}", policy(steps)));
        assert!(!codes("").contains(&"M0503"), "{path}, {goal}");
        // One of the paths loses what it made.
        assert!(codes("undo(b)").contains(&"M0503"), "{path}, {goal}");
        assert!(codes("undo(b) use_any()").contains(&"M0501"), "{path}, {goal}");
    }
    // Whether the path that makes nothing has it is for the run to see.
    let some = "initially not f(a)\npolicy p { if g(a) { make(a) } use_either() }";
    let either = "entity b: Object\naction use_either()\n    needs f(a) or f(b)\n";
    assert_eq!(verdicts("use_either", &format!("{either}{some}")), [Verdict::Deferred]);
}

/// A test looks at what a hand holds: both its branches may be taken, and a guard behind it asks again.
#[test]
fn proofs_a_test_of_the_hand_may_find_that_something_dropped() {
    for test in ["not holding(mug_1)", "free(hand)", "free(hand) and not near(user)"] {
        let recovers = format!(
            "policy p {{ go(mug_1) pick(mug_1) go(counter) if {test} {{ go(mug_1) pick(mug_1) go(counter) }} \
             place(mug_1, counter) }}"
        );
        let found = session_codes(Some("kitchen"), &recovers);
        assert!(!found.contains(&"M0501") && !found.contains(&"M0902"), "{test}: {found:?}");
    }
    // What was put down is not taken up by itself, and nobody moves what is on a table.
    let steps = "go(mug_1) pick(mug_1) go(counter) place(mug_1, counter)";
    for test in ["holding(mug_1)", "not free(hand)", "not on(mug_1, counter)"] {
        let dead = format!("policy p {{ {steps} if {test} {{ say(\"x\") }} }}");
        assert!(session_codes(Some("kitchen"), &dead).contains(&"M0902"), "{test}");
    }
    let take = "action take(o: Object)\n    needs not holding(o), not g(o)\n    makes holding(o), g(o)\n";
    let policy =
        |steps: &str| format!("{take}initially not holding(a), not g(a)\npolicy p {{ take(a) {steps} }}");
    let tests = policy("if not holding(a) { take(a) }");
    assert_eq!(verdicts("take", &tests), [Verdict::Proven, Verdict::Deferred]);
    let starts = |policy: &str, see: &dyn Fn(&str) -> Option<bool>| {
        let found = requests(policy, &mut |effect| honest(effect, |query| see(&query.to_string())));
        found.iter().filter(|request| request.starts_with("start")).count()
    };
    assert_eq!(starts(&tests, &|_| Some(false)), 2);
    // It was not dropped, nobody can tell, or what the first step made besides still holds.
    assert_eq!(starts(&tests, &|_| Some(true)), 1);
    assert_eq!(starts(&tests, &|_| None), 1);
    assert_eq!(starts(&tests, &|query| Some(query == "g(a)")), 1);
    // What the robot sees it has dropped it does not put away.
    let puts = policy("if holding(a) { pass() }");
    assert_eq!(starts(&puts, &|_| Some(false)), 1);
    assert_eq!(starts(&puts, &|_| None), 2);
    // A step of which it is not known whether it has filled the hand may have done so.
    let may_take = "action look_at(o: Object)\n    needs not g(o)\naction may_take(o: Object)\n    \
                    makes holding(o) when f(o), not g(o)\n";
    let again = "repeat 2 { if holding(a) { pass() } else { look_at(a) may_take(a) } }";
    let seen = Cell::new(false);
    let see = |query: &str| match query {
        "f(a)" => None,
        "g(a)" => Some(seen.replace(true)),
        _ => Some(false),
    };
    assert_eq!(starts(&format!("{may_take}policy p {{ {again} }}"), &see), 2);
}

/// A thing drops while a test asks for it, and another part of the condition decides the test first.
#[test]
fn proofs_a_test_waits_for_the_hand_that_it_asks_for() {
    let take = "action take(o: Object)\n    needs not g(o)\n    makes holding(o), g(o)\n\
                action use_g(o: Object)\n    needs g(o)\n";
    let policy = format!(
        "{take}initially not g(a)\npolicy p {{ take(a) if f(a) and holding(a) {{ pass() }} use_g(a) }}"
    );
    assert_eq!(verdicts("use_g", &policy), [Verdict::Deferred]);
    let starts = |is_held: Option<bool>| {
        let see = |query: &Query| match query.to_string().as_str() {
            "holding(a)" => is_held,
            _ => Some(false),
        };
        let found = requests(&policy, &mut |effect| honest(effect, see));
        found.iter().filter(|request| request.starts_with("start")).count()
    };
    // It was dropped, and what the step made besides is gone; it was not; nobody can tell.
    assert_eq!(starts(Some(false)), 1);
    assert_eq!(starts(Some(true)), 2);
    assert_eq!(starts(None), 2);
}

/// Behind a `wait` for what the steps before it rule out, a guard asks for what they made.
#[test]
fn proofs_a_wait_lets_the_world_undo_what_steps_made() {
    let policy = "initially not f(a), g(a)\npolicy p { make(a) wait until g(a) within 5 s use(a) }";
    assert_eq!(verdicts("use", policy), [Verdict::Deferred]);
    let starts = |is_made: Option<bool>| {
        let see = |query: &Query| match query.to_string().as_str() {
            "g(a)" => Some(true),
            _ => is_made,
        };
        let found = requests(policy, &mut |effect| honest(effect, see));
        found.iter().filter(|request| request.starts_with("start")).count()
    };
    assert_eq!(starts(Some(false)), 1);
    assert_eq!(starts(Some(true)), 2);
    // Where nobody can tell, what was believed stands.
    assert_eq!(starts(None), 2);
}

/// Facts about every entity at the start are told to a run, and to a policy that takes over.
#[test]
fn proofs_from_what_is_said_of_all_are_told_to_the_run() {
    for test in ["initially not f(any)\npolicy p { if not f(a)", "policy p { if not holding(a)"] {
        let policy = format!("{test} {{ make(a) }} use(a) }}");
        let found = requests(&policy, &mut |effect| honest(effect, |_| None));
        let starts = found.iter().filter(|request| request.starts_with("start"));
        assert_eq!(starts.count(), 2, "{policy}: {found:?}");
    }
    let (mut out, start) = (Vec::new(), StartState::default());
    let mut engine = Engine::new(compiled("policy p { make(a) wave() }"), &start).unwrap();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let made = out.iter().flat_map(|effect| honest(effect, |_| None)).map(Event::Driver).collect::<Vec<_>>();
    made.into_iter().for_each(|event| engine.handle(Time::ZERO, event, &mut out));
    let later = compiled("initially not f(any)\npolicy p { avoid(a) }");
    let later = PreparedSwap::new(later, &engine.running()).unwrap();
    let refused = engine.swap(Time::ZERO, later, &mut out).err();
    assert!(matches!(refused, Some(SwapRefusal::Start { .. })), "{refused:?}");
}

/// A need of some fact of a pattern looks below each narrower pattern, which may have nothing left either.
#[test]
fn proofs_that_some_pair_has_it_look_below_each_pattern() {
    let rope = "entity b: Object\nfluent tied(o: Object, p: Object)\n\
                action tie(o: Object)\n    makes tied(o, any)\naction tie_all()\n    makes tied(any, any)\n\
                action untie(o: Object)\n    makes not tied(o, any)\n\
                perception loosen(what: Text) -> Object\n    makes not tied(a, result)\n\
                action pull()\n    needs tied(any, any)\n";
    let policy = |steps: &str| format!("{rope}policy p {{ {steps} pull() }}");
    for steps in ["tie(a)", "tie_all() untie(a)"] {
        assert_eq!(verdicts("pull", &policy(steps)), [Verdict::Proven], "{steps}");
    }
    let loosened = "tie(a) loosen(\"knot\") loosen(\"knot\")";
    assert_eq!(verdicts("pull", &policy(loosened)), [Verdict::Deferred]);
    let untied = format!("{DOMAIN}\n{}", policy("tie_all() untie(a) untie(b)"));
    assert_eq!(session_codes(None, &untied), ["M0501"]);
}

/// A `restart` may break off the block of a `resume` of the same monitor, and then that block begins again.
#[test]
fn proofs_of_a_reaction_hold_where_another_one_has_broken_it_off() {
    let prop = "fluent h(o: Object)\naction prop_up(o: Object)\n    needs f(o)\n    makes f(o)\n";
    let policy = |whens: &str| {
        format!(
            "{prop}initially f(a), not g(a), not h(a)\n\
             policy p {{ monitor {{ when g(a) then resume at most 2 {{ prop_up(a) }} {whens} }} \
             during {{ wave() }} }}"
        )
    };
    assert_eq!(verdicts("prop_up", &policy("")), [Verdict::Proven]);
    let restarts = policy("when h(a) then restart at most 2");
    assert_eq!(verdicts("prop_up", &restarts), [Verdict::Deferred]);
}

/// A fact that was only seen ends with its lifetime, also where paths, rounds or branches meet.
#[test]
fn proofs_of_what_was_seen_end_with_its_lifetime() {
    let policy = |steps: &str| {
        let seen =
            "perception see_a(what: Text) -> Object\n    makes f(a)\n    lasts until base\n    uses camera\n";
        let heard = seen.replace("see_a", "hear_a").replace("base", "voice");
        let all = seen.replace("see_a", "see_all").replace("f(a)", "f(any)");
        let moved = "perception touch(o: Object)\n    makes f(o)\n    lasts until o\n    uses camera\n\
                     perception find(what: Text) -> Object\n    uses camera\n\
                     action lift(o: Object)\n    makes g(o)\n    uses voice\n";
        format!("{seen}{heard}{all}{moved}policy p {{ {steps} }}")
    };
    for steps in [
        "if g(a) { make(a) } else { see_a(\"a\") } wave() use(a)",
        "if g(a) { see_a(\"a\") } else { make(a) } wave() use(a)",
        "see_a(\"a\") if g(a) { make(a) } wave() use(a)",
        "if g(a) { see_a(\"a\") } else { hear_a(\"a\") } wave() use(a)",
        "if g(a) { see_a(\"a\") } else { hear_a(\"a\") } pass() use(a)",
        "if g(a) { hear_a(\"a\") } else { see_a(\"a\") } wave() use(a)",
        "make(a) repeat 3 { wave() use(a) see_a(\"a\") }",
        "parallel { { see_a(\"a\") } { pass() wave() } } use(a)",
        "see_all(\"a\") wave() use(a)",
        "touch(a) let x = find(\"a\") lift(x) use(a)",
        "parallel { { see_a(\"a\") use(a) } { pass() wave() } }",
        "parallel { { wave() } { if g(a) { see_a(\"a\") use(a) } } }",
    ] {
        assert_eq!(verdicts("use", &policy(steps)), [Verdict::Deferred], "{steps}");
    }
    let missing = "closed world\nentity b: Object\nperception miss(what: Text) -> Object\n    \
                   makes not f(result)\n    lasts until base\n    uses base\n\
                   policy p { repeat 2 { miss(\"thing\") avoid(a) } }";
    assert_eq!(verdicts("avoid", missing), [Verdict::Deferred]);
    // A guard may believe what was seen of another name.
    let found = "perception find(what: Text) -> Object\n    makes f(result)\n    lasts until base\n    \
                 uses base\nentity b: Object\npolicy p { let m = find(\"thing\") use(a) wave() use(a) }";
    assert_eq!(verdicts("use", found), [Verdict::Deferred]);
    let waits = found.replace("use(a) wave()", "wait until f(a) within 5 s wave()");
    assert_eq!(verdicts("use", &waits), [Verdict::Deferred]);
    // So may it be answered by what was perhaps seen.
    let perhaps = "perception see_some(what: Text)\n    makes f(o) for each o: Object when g(o)\n    \
                   lasts until base\n    uses camera\n\
                   policy p { see_some(\"x\") use(a) wave() use(a) }";
    assert_eq!(verdicts("use", perhaps), [Verdict::Deferred]);
    for steps in [
        "see_all(\"a\") pass() use(a)",
        "see_all(\"a\") make(a) wave() use(a)",
        "if g(a) { make(a) } else { see_a(\"a\") } use(a)",
        "see_a(\"a\") make(a) wave() use(a)",
        "make(a) repeat 3 { pass() use(a) see_a(\"a\") }",
        "parallel { { see_a(\"a\") use(a) } { pass() pass() } }",
    ] {
        assert_eq!(verdicts("use", &policy(steps)), [Verdict::Proven], "{steps}");
    }
}

/// Facts of a name are forgotten where the name is bound anew, also in an inner loop of a closed world.
#[test]
fn proofs_forget_what_was_known_of_a_name_that_is_bound_anew() {
    let policy = "closed world\nentity c: Object\naction stir()\n    unsettles f(c)\n\
                  policy p { stir() \
                  repeat 2 { repeat 1 { let m = choose(\"which?\", [a, c]) } } until f(m) \
                  use(c) }";
    assert_eq!(verdicts("use", policy), [Verdict::Deferred]);
}
