//! The scenarios get the verdicts of their contract, and so do rows of our own, some of each kind.

use motet_eval::{Judged, repairs, scenarios, summary};
use serde_json::{Value, json};

/// Beside the checkout, where the reference data is kept.
const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/scenarios/scenarios.jsonl");

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn scenarios_verdicts_equal_the_contract() {
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().map(|line| scenarios::judge(line).unwrap()).collect();
    let wrong: Vec<_> = rows.iter().filter_map(Judged::disagreement).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    let summary = summary(&rows);
    assert!(summary.total >= 52 && summary.class_total >= 37 && summary.step_total >= 37, "{summary:?}");
    // Those of geometry count with the others, and once more by themselves.
    assert!(
        summary.groups.values().all(|group| group.total > 0 && group.agree == group.total),
        "{summary:?}"
    );
    assert!(!summary.groups.is_empty());
}

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn repairs_mend_half_of_the_faulty_plans() {
    let text = std::fs::read_to_string(DATA).unwrap();
    let rows: Vec<_> = text.lines().filter_map(|line| scenarios::repair(line).unwrap()).collect();
    let summary = repairs::summary(&rows);
    assert!(rows.iter().all(|row| row.done.len() <= repairs::ROUNDS));
    assert!(summary.total > 0 && summary.repaired * 2 >= summary.total, "{summary:?}");
}

/// A home with a thing of every sort; `extra` replaces parts of it.
fn scene(extra: Value) -> Value {
    let mut scene = json!({
        "robot_at": "hall", "places": ["table", "shelf", "sofa", "hall", "user_spot", "desk"],
        "surfaces": {"table": {"pose": {"z": 0.7, "d": 0.45}}, "shelf": {"pose": {"z": 1.0, "d": 0.5}}},
        "persons": {"user": {"at": "user_spot"}},
        "objects": {"cup": {"at": "table", "pose": {"z": 0.8, "d": 0.4}},
                    "pen": {"at": "drawer", "pose": {"z": 0.6, "d": 0.4}},
                    "toy": {"at": "sofa", "pose": {"z": 0.4, "d": 0.4}}},
        "containers": {"drawer": {"open": false, "stand": "desk", "handle": {"z": 0.6, "d": 0.4}},
                       "box": {"open": true, "pose": {"z": 0.3, "d": 0.4}, "handle": {"z": 0.3, "d": 0.4}}},
        "goal": []});
    for (key, value) in extra.as_object().unwrap() {
        scene[key] = value.clone();
    }
    scene
}

/// `"go table; pick cup; done"` as a plan; `=> $c` binds.
fn plan(text: &str) -> Vec<Value> {
    let steps = text.split(';').map(str::trim).filter(|step| !step.is_empty());
    let step = |step: &str| {
        let (call, binds) =
            step.split_once("=>").map_or((step, None), |(call, name)| (call, Some(name.trim())));
        let mut words = call.split_whitespace();
        let op = words.next().unwrap();
        let args: Vec<Value> =
            words.map(|word| word.parse::<f64>().map_or(json!(word), |number| json!(number))).collect();
        let mut step = json!({"op": op, "args": args});
        if let Some(name) = binds {
            step["as"] = json!(name);
        }
        step
    };
    steps.map(step).collect()
}

/// Judges a plan; `expected` is `ok`, or the class and the step.
fn check_in(robot: &str, profile: &str, extra: Value, plan: &[Value], expected: &str) {
    let (class, step) = expected.split_once(" @ ").unwrap_or((expected, ""));
    let verdict = if expected == "ok" { "ok" } else { "error" };
    let row = json!({"id": expected, "robot": robot, "profile": profile, "scene": scene(extra), "plan": plan,
        "verdict": verdict, "class": class, "error_step": step});
    let judged = scenarios::judge(&row.to_string()).unwrap();
    assert_eq!(judged.disagreement(), None, "{plan:?}: {:?}", judged.note);
}

fn hsr(text: &str, expected: &str) {
    check_in("hsr", "coarse", json!({}), &plan(text), expected);
}

fn fine(text: &str, expected: &str) {
    check_in("hsr", "fine", json!({}), &plan(text), expected);
}

fn anymal(text: &str, expected: &str) {
    check_in("anymal_z1", "coarse", json!({}), &plan(text), expected);
}

fn given(extra: Value, text: &str, expected: &str) {
    check_in("hsr", "coarse", extra, &plan(text), expected);
}

#[test]
fn scenarios_words() {
    hsr("go table; grasp cup; done", "unknown_primitive @ 2");
    hsr("go table; grab cup table; done", "unknown_primitive @ 2");
    hsr("go table; pick cup; go user_spot; hand_over user; done", "unknown_primitive @ 4");
    hsr("fetch cup; done", "unknown_primitive @ 1");
    hsr("wake_up; go table; done", "unknown_primitive @ 1");
    hsr("go table; say hello; done", "unknown_primitive @ 2");
    hsr("go; done", "arity @ 1");
    hsr("go table shelf; done", "arity @ 1");
    hsr("go table; pick cup table; done", "arity @ 2");
    hsr("go table; pick cup; home now; place table; done", "arity @ 3");
    hsr("go kitchen; done", "unknown_location @ 1");
    hsr("go table; pick cup; place rack; done", "unknown_location @ 3");
    hsr("go table; pick plate; done", "unknown_object @ 2");
    hsr("go cup; done", "arg_type @ 1");
    hsr("go user; done", "arg_type @ 1");
    hsr("pick table; done", "arg_type @ 1");
    hsr("go table; open table; done", "arg_type @ 2");
    hsr("turn north; done", "arg_type @ 1");
    hsr("go table; pick cup; lift high; place table; done", "arg_type @ 3");
    hsr("go table; pick cup; lift 0.9; place table; done", "out_of_range @ 3");
    hsr("go table; pick cup; lift 0.6; place table; done", "ok");
    anymal("go table; pick cup; lift 0.6; place table; done", "out_of_range @ 3");
}

#[test]
fn scenarios_hands_and_places() {
    hsr("go table; pick cup; place table; done", "ok");
    hsr("pick cup; done", "not_at_location @ 1");
    hsr("go table; pick cup; pick toy; done", "pick_while_holding @ 3");
    hsr("go table; pick cup; go desk; open drawer; done", "open_while_holding @ 4");
    hsr("go shelf; place shelf; done", "place_without_holding @ 2");
    hsr("go table; lift 0.1; done", "lift_without_holding @ 2");
    hsr("go table; pick cup; handover user; done", "not_at_location @ 3");
    hsr("go table; pick cup; place shelf; done", "not_at_location @ 3");
    hsr("search cup; pick cup; go user_spot; handover user; done", "ok");
    hsr("go table; pick cup; done", "ends_holding @ end");
    hsr("go table; pick cup; place table; done; go hall", "dead_code @ 5");
    given(json!({"goal": [["holding", "cup"]]}), "go table; pick cup; done", "ok");
    given(json!({"goal": [["at", "toy", "box"]]}), "go sofa; pick toy; go box; place box; done", "ok");
    given(
        json!({"goal": [["at", "toy", "box"]]}),
        "go sofa; pick toy; go shelf; place shelf; done",
        "goal_not_reached @ end",
    );
    given(json!({"goal": [["robot_at", "hall"]]}), "go table; done", "goal_not_reached @ end");
    given(json!({"holding": "cup"}), "pick toy; done", "pick_while_holding @ 1");
    given(
        json!({"holding": "cup", "goal": [["at", "cup", "user"], ["empty_hand"]]}),
        "go user_spot; handover user; done",
        "ok",
    );
    let lost = json!({"objects": {"cup": {}}});
    given(lost.clone(), "go table; pick cup; done", "not_at_location @ 2");
    given(lost, "search cup; pick cup; go shelf; place shelf; done", "ok");
    given(json!({"blocked": [["hall", "table"]]}), "go table; done", "blocked_path @ 1");
    given(json!({"blocked": [["hall", "table"]]}), "go sofa; go table; done", "ok");
    given(json!({"blocked": ["table"]}), "go sofa; go table; done", "blocked_path @ 2");
    let covered = json!({"cup": {"at": "table", "under": "plate"}, "plate": {"at": "table"}});
    given(
        json!({"objects": covered}),
        "go table; pick plate; place table; pick cup; place table; done",
        "ok",
    );
    given(json!({"objects": covered}), "go table; pick cup; place table; done", "blocked_object @ 2");
    given(
        json!({"surfaces": {"shelf": {"full": true}}}),
        "go table; pick cup; go shelf; place shelf; done",
        "target_occupied @ 4",
    );
}

#[test]
fn scenarios_containers() {
    hsr("go desk; open drawer; pick pen; place desk; close drawer; done", "ok");
    hsr("go desk; pick pen; done", "closed_container @ 2");
    hsr("go desk; search pen; done", "closed_container @ 2");
    hsr("go desk; close drawer; done", "redundant_state @ 2");
    hsr("go desk; open drawer; open drawer; done", "redundant_state @ 3");
    hsr("open drawer; done", "not_at_location @ 1");
    hsr("go desk; open drawer; pick pen; close drawer; done", "close_while_holding @ 4");
    given(json!({"goal": [["closed", "drawer"]]}), "go desk; open drawer; done", "missing_close @ end");
    let locked = json!({"drawer": {"open": false, "locked": true, "handle": {"z": 0.5, "d": 0.4}}});
    given(json!({"containers": locked, "objects": {}}), "go drawer; open drawer; done", "locked @ 2");
    let unknown = json!({"drawer": {"open": false, "unknown": true, "handle": {"z": 0.5, "d": 0.4}}});
    given(json!({"containers": unknown, "objects": {}}), "go drawer; open drawer; done", "ok");
}

#[test]
fn scenarios_perception() {
    fine("go table; detect cup => $c; pick $c; place table; done", "ok");
    fine("go table; detect cup => $c; pick cup; place table; done", "ok");
    fine("go table; detect cup => $c; turn right; pick $c; done", "stale_perception @ 4");
    fine("go table; detect cup => $c; turn right; detect cup => $c; pick $c; place table; done", "ok");
    fine("go table; pick cup; done", "no_perception @ 2");
    fine("go sofa; detect cup => $c; done", "not_at_location @ 2");
    fine("go table; ground $c pick => $p; done", "unbound_ref @ 2");
    fine("go table; detect cup => $c; ground $c pick => $p; pick $p; place table; done", "ok");
    fine("go table; detect cup => $c; ground $c place => $p; pick $p; done", "arg_type @ 4");
    fine("go desk; detect drawer => $d; ground $d open => $h; open $h; done", "ok");
    fine("go desk; detect drawer => $d; go hall; ground $d open => $h; done", "stale_perception @ 4");
    fine("go table; detect cup => $c; pick $c; place table; pick $c; done", "stale_perception @ 5");
    fine("go user_spot; detect user => $u; done", "ok");
    given(json!({"vision": "none", "robot_at": "table"}), "pick cup; done", "no_perception @ 1");
    given(json!({"vision": "none", "robot_at": "table"}), "search cup; pick cup; place table; done", "ok");
    let mugs = json!({"mug_1": {"at": "table", "kind": "mug"}, "mug_2": {"at": "table", "kind": "mug"}});
    given(json!({"objects": mugs}), "go table; pick mug; place table; done", "ambiguous_ref @ 2");
    given(json!({"objects": mugs}), "go table; pick mug_2; place table; done", "ok");
    given(json!({"objects": mugs}), "search mug => $m; pick $m; place table; done", "ok");
    given(
        json!({"objects": {"mug_1": {"at": "table", "kind": "mug"}}}),
        "go table; pick mug; place table; done",
        "ok",
    );
}

#[test]
fn scenarios_embodiment() {
    anymal("go table; pick cup; go user_spot; done", "posture @ 3");
    anymal("go table; pick cup; home; go user_spot; handover user; done", "ok");
    anymal("go table; pick cup; lift 0.1; go user_spot; handover user; home; done", "ok");
    anymal("go table; detect cup; done", "posture @ 2");
    anymal("go table; start_pose; detect cup; home; go hall; done", "ok");
    anymal("start_pose; go table; done", "posture @ 2");
    anymal("search cup; done", "posture @ 1");
    let with = |extra: Value, text: &str, expected: &str| {
        check_in("anymal_z1", "coarse", extra, &plan(text), expected)
    };
    with(json!({"awake": false}), "home; done", "not_ready @ 1");
    with(json!({"awake": false}), "wake_up; go table; done", "ok");
    with(json!({"posture": "extended"}), "home; go table; done", "ok");
    with(json!({"posture": "extended"}), "turn left; done", "posture @ 1");
    let heavy = json!({"objects": {"cup": {"at": "table", "mass": 2.0}}});
    with(heavy.clone(), "go table; pick cup; place table; done", "ok");
    given(heavy, "go table; pick cup; place table; done", "payload @ 2");
    let wide = json!({"objects": {"cup": {"at": "table", "width": 0.1}}});
    with(wide.clone(), "go table; pick cup; place table; done", "not_graspable @ 2");
    given(wide, "go table; pick cup; place table; done", "ok");
    let high = json!({"objects": {"cup": {"at": "table", "pose": {"z": 1.25, "d": 0.4}}}});
    with(high.clone(), "go table; pick cup; place table; done", "unreachable @ 2");
    given(high, "go table; pick cup; place table; done", "ok");
}

#[test]
fn scenarios_rules_and_swaps() {
    let never =
        |verb: &str, key: &str, thing: Value| json!({"rules": [{"rule": format!("no_{verb}"), key: thing}]});
    given(
        never("pick", "objects", json!(["cup"])),
        "go table; pick cup; place table; done",
        "safety_rule @ 2",
    );
    given(never("open", "container", json!("drawer")), "go desk; open drawer; done", "safety_rule @ 2");
    given(never("go", "places", json!(["sofa"])), "go table; go sofa; done", "safety_rule @ 2");
    given(
        never("handover", "objects", json!(["toy"])),
        "go table; pick cup; go user_spot; handover user; done",
        "ok",
    );
    let pair = json!({"rules": [{"rule": "no_place", "objects": ["cup"], "place": "sofa"}]});
    given(pair.clone(), "go table; pick cup; go sofa; place sofa; done", "safety_rule @ 4");
    given(pair, "go table; pick cup; go shelf; place shelf; go sofa; pick toy; place sofa; done", "ok");
    given(json!({"swap_point": "between_steps"}), "go table; done", "ok");
    given(json!({"swap_point": "mid_pick"}), "go table; done", "unsafe_swap_point @ start");
    let guarded = json!({"rules": [{"rule": "monitor_required", "op": "close", "cond": "hand_present"}]});
    let body = json!({"monitor": "hand_present", "on": "stop", "body": plan("close box")});
    let steps = [plan("go box").remove(0), body, plan("done").remove(0)];
    check_in("hsr", "coarse", guarded.clone(), &steps, "ok");
    let body = json!({"monitor": "battery_low", "on": "ask", "body": plan("close box")});
    let steps = [plan("go box").remove(0), body, plan("done").remove(0)];
    check_in("hsr", "coarse", guarded, &steps, "missing_monitor @ 2.body.1");
}

/// Steps around one control step.
fn around(before: &str, control: Value, after: &str) -> Vec<Value> {
    [plan(before), vec![control], plan(after)].concat()
}

#[test]
fn scenarios_branches_and_loops() {
    let either = |then: &str, otherwise: &str| -> Value {
        json!({"if": "person_near(user)", "then": plan(then), "else": plan(otherwise)})
    };
    let check = |profile: &str, before: &str, control: Value, after: &str, expected: &str| {
        check_in("hsr", profile, json!({}), &around(before, control, after), expected);
    };
    check(
        "coarse",
        "go table",
        either("pick cup", "wait 1"),
        "place table; done",
        "place_without_holding @ 3",
    );
    check("coarse", "go table; pick cup", either("place table", "wait 1; place table"), "done", "ok");
    check("coarse", "go table", either("pick cup; pick toy", ""), "done", "pick_while_holding @ 2.then.2");
    check(
        "coarse",
        "go table",
        either("wait 1", "pick toy; place table"),
        "done",
        "not_at_location @ 2.else.1",
    );
    check("coarse", "go table", either("done", "wait 1"), "pick cup; place table; done", "ok");
    check("coarse", "go table", either("done; go hall", "wait 1"), "done", "dead_code @ 2.then.2");
    check(
        "fine",
        "go table",
        either("detect cup => $c", "wait 1"),
        "pick $c; place table; done",
        "unbound_ref @ 3",
    );
    check(
        "fine",
        "go table",
        either("detect cup => $c", "detect cup => $c; turn left"),
        "pick $c; done",
        "stale_perception @ 3",
    );
    check(
        "fine",
        "go table",
        either("detect cup => $c", "detect cup => $c"),
        "pick $c; place table; done",
        "ok",
    );
    let retry = |times: Value, body: &str, fail: &str| -> Value {
        json!({"retry": times, "body": plan(body), "on_fail": plan(fail)})
    };
    check(
        "fine",
        "go table",
        retry(json!(3), "detect cup => $c; pick $c", "ask help; done"),
        "place table; done",
        "ok",
    );
    check(
        "fine",
        "go table",
        retry(json!(3), "detect cup => $c", "ask help; done"),
        "pick $c; place table; done",
        "ok",
    );
    check(
        "fine",
        "go table",
        retry(json!(2), "pick cup", ""),
        "place table; done",
        "no_perception @ 2.body.1",
    );
    check(
        "coarse",
        "go table",
        retry(json!(2), "pick cup", "go hall; pick toy; done"),
        "place table; done",
        "not_at_location @ 2.on_fail.2",
    );
    check(
        "coarse",
        "go table",
        retry(json!("forever"), "pick cup", ""),
        "place table; done",
        "infinite_retry @ 2",
    );
    check(
        "coarse",
        "go table",
        retry(Value::Null, "pick cup", ""),
        "place table; done",
        "infinite_retry @ 2",
    );
    let again = |max: Value, body: &str| json!({"while": "toys_left", "max": max, "body": plan(body)});
    check("coarse", "", again(json!(3), "go table; pick cup; place table"), "done", "ok");
    check(
        "coarse",
        "go table",
        again(json!(3), "pick cup"),
        "place table; done",
        "pick_while_holding @ 2.body.1",
    );
    check("coarse", "go table", again(Value::Null, "wait 1"), "done", "infinite_retry @ 2");
    let watched = |body: &str| json!({"monitor": "person_near(user)", "on": "pause", "body": plan(body)});
    check("fine", "go table", watched("detect cup => $c"), "pick $c; place table; done", "ok");
    check(
        "coarse",
        "go table",
        watched("pick cup; pick cup"),
        "place table; done",
        "pick_while_holding @ 2.body.2",
    );
}

#[test]
fn scenarios_at_once() {
    let both = |one: &str, two: &str| json!({"parallel": [plan(one), plan(two)]});
    let objects = json!({"cup": {"at": "table"}, "plate": {"at": "table"}});
    let check = |robot: &str, control: Value, after: &str, expected: &str| {
        check_in(
            robot,
            "coarse",
            json!({"robot_at": "table", "objects": objects}),
            &around("", control, after),
            expected,
        );
    };
    check("hsr", both("go table", "turn left"), "done", "resource_conflict @ 1");
    check("hsr", both("pick cup", "go hall"), "done", "resource_conflict @ 1");
    check("hsr", both("ask one", "ask two"), "done", "resource_conflict @ 1");
    check("hsr", both("ask one", "go hall"), "done", "ok");
    check("hsr", both("pick cup", "detect plate"), "place table; done", "ok");
    check("anymal_z1", both("pick cup", "detect plate"), "place table; done", "resource_conflict @ 1");
}

#[test]
fn scenarios_people_choose() {
    let ask = |answers: Value| json!({"op": "ask", "args": ["Which?"], "as": "$x", "answers": answers});
    let check = |answers: Value, after: &str, goal: Value, expected: &str| {
        check_in(
            "hsr",
            "coarse",
            json!({"robot_at": "table", "goal": goal}),
            &around("", ask(answers), after),
            expected,
        );
    };
    check(json!(["cup", "toy"]), "pick $x; place table; done", json!([]), "ok");
    check(json!(["shelf", "table"]), "pick cup; go $x; place $x; done", json!([]), "ok");
    check(json!(["yes", "no"]), "pick cup; place table; done", json!([["at", "cup", "table"]]), "ok");
}

#[test]
fn scenarios_row_that_is_none_is_told_apart() {
    let wrong = |row: Value| scenarios::judge(&row.to_string()).unwrap_err();
    assert!(wrong(json!({"id": "x"})).contains("missing field"));
    let row =
        |plan: Value| json!({"id": "x", "robot": "hsr", "profile": "coarse", "verdict": "ok", "plan": plan});
    assert!(wrong(row(json!([{"jump": 3}]))).starts_with("step 1 "));
    assert!(wrong(row(json!([3]))).starts_with("step 1 "));
    let robot = json!({"id": "x", "robot": "r2", "profile": "coarse", "verdict": "ok", "plan": []});
    assert!(wrong(robot).contains("`r2`"));
    assert!(scenarios::judge(&row(json!([{"op": "done", "extra": 1}])).to_string()).is_ok());
}
