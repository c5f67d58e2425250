//! `motet run` from outside: outcomes, exit codes, the shapes of what is shown.

use crate::support::{BAD, GOOD, Place};
use serde_json::Value;

/// The built-in scene.
const KITCHEN: &str = include_str!("../../../robots/scenes/kitchen.json");

fn place(name: &str) -> Place {
    Place::new(name)
        .file("good.motet", GOOD)
        .file("bad.motet", BAD)
        .file("gives_up.motet", "policy gives_up for hsr {\n    go(kitchen_table)\n    fail \"no mug\"\n}\n")
        .file("gives.motet", "policy gives -> Surface {\n    go(counter)\n    done counter\n}\n")
        .file("replans.motet", "policy replans for hsr {\n    replan \"too hard\"\n}\n")
        .file("no_robot.motet", "policy anyone {\n    go(user)\n}\n")
        .file("stranger.motet", "policy anyone for nobody {\n    go(user)\n}\n")
        .file("long.motet", "policy waits for hsr {\n    wait until not free(hand) within 1000 s\n}\n")
        .file(
            "asks.motet",
            "policy asks for hsr {\n    let answer = ask(\"Which one?\")\n    fail answer\n}\n",
        )
        .file(
            "words.motet",
            "policy words for hsr {\n    let n = distance(user)\n    say(\"It is {n} to go.\")\n    cannot \
             \"{mug_1.mass} is much\"\n}\n",
        )
        .file("answers.json", r#"["the red one"]"#)
        .file("faults.json", r#"{"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": "slipped"}}]}"#)
        .file(
            "far_faults.json",
            "{\"calls\": [\n  {\"primitive\": \"pik\", \"then\": \"hangs\"},\n  \
             {\"primitive\": \"pick\", \"nth\": 1, \"then\": {\"fails\": \"sliped\"}}],\n \
             \"world\": [{\"at\": 1, \"what\": {\"slips\": \"mug_9\"}},\n \
             {\"at\": 2, \"what\": {\"opens\": \"mug_1\"}}]}",
        )
        .file(
            "watch.motet",
            "policy watch for hsr {\n    monitor when distance(user) < 0.1 m for 200 ms then pause \
             during { say(\"x\") }\n}\n",
        )
        .file("retries.motet", GOOD.replace("pick(mug)", "pick(mug) retry 1"))
        .file("odd_faults.json", r#"{"calls": [{"primitve": "pick"}]}"#)
        .file("odd_answers.json", r#"{"answers": 3}"#)
}

#[test]
fn ends_with_the_right_code() {
    let place = place("run_codes");
    let max = "--scene kitchen --speed max";
    for (line, code, texts) in [
        (
            format!("run good.motet {max}"),
            0,
            &["out:✓ tidy: done", "out:5 steps done, 0 failed", "out:▶ pick(mug"][..],
        ),
        (format!("run good.motet {max} --seed 7"), 0, &["out:✓ place(mug, counter)"]),
        (format!("run gives.motet --robot hsr {max}"), 0, &["out:✓ gives: done, gave counter"]),
        (
            format!("run gives.motet --robot hsr {max} --format json"),
            0,
            &["out:\"outcome\":\"done\"", "out:\"result\":\"counter\""],
        ),
        (format!("run bad.motet {max}"), 1, &["out:M0201", "err:refused: 1 error"]),
        (
            format!("run gives_up.motet {max}"),
            3,
            &["out:✗ gives_up: failed with `failed`", "out:why: no mug"],
        ),
        (format!("run replans.motet {max}"), 3, &["out:asks for a new plan", "out:why: too hard"]),
        (
            format!("run good.motet {max} --faults faults.json"),
            3,
            &["out:failed with `slipped`", "out:pick(mug"],
        ),
        (
            format!("run good.motet {max} --faults far_faults.json"),
            2,
            &[
                "err:far_faults.json:2:17: there is no primitive `pik`: did you mean `pick`?",
                "err:there is no failure `sliped`: did you mean `slipped`?",
                "err:far_faults.json:4:",
                "err:there is no entity `mug_9`",
                "err:`mug_1` is of the kind Object; the kind must be Container",
            ],
        ),
        (
            format!("do go_to_the_counter --robot hsr {max} --ask never --faults far_faults.json"),
            2,
            &["err:far_faults.json:2:17: there is no primitive `pik`: did you mean `pick`?"],
        ),
        (
            format!("run retries.motet {max} --faults faults.json"),
            0,
            &["out:retry 1  slipped\n", "out:attempt 2 of 2", "out:of simulated time"],
        ),
        (format!("run watch.motet {max}"), 0, &["out:monitor distance(user) < 0.1 m for 0.2 s"]),
        (format!("run asks.motet {max} --answers answers.json"), 3, &["out:why: the red one"]),
        (
            format!("run words.motet {max}"),
            3,
            &["out:✓ say(\"It is 1.9", "out: m to go.\")", "out:why: 0.3 kg is much"],
        ),
        (format!("run no_robot.motet {max}"), 2, &["err:--robot NAME"]),
        (format!("run no_robot.motet {max} --robot hsr"), 0, &[]),
        (format!("run stranger.motet {max}"), 1, &["out:M0447", "out:there is no robot `nobody`"]),
        (format!("run good.motet {max} --faults absent.json"), 2, &["err:no such file"]),
        (
            format!("run good.motet {max} --faults odd_faults.json"),
            2,
            &["out:odd_faults.json", "out:primitve"],
        ),
        (format!("run good.motet {max} --answers odd_answers.json"), 2, &["out:odd_answers.json"]),
        ("run good.motet --speed fast".to_owned(), 2, &["err:write `max`, or a factor"]),
        ("run good.motet --speed -1".to_owned(), 2, &["err:write `max`, or a factor"]),
        ("run good.motet --seed x".to_owned(), 2, &["err:write a whole number from 0"]),
        ("run good.motet --speed 0".to_owned(), 2, &["err:write `max`, or a factor"]),
        ("run absent.motet".to_owned(), 2, &["err:no such file"]),
        ("run .".to_owned(), 2, &["err:folder"]),
    ] {
        println!("motet {line}");
        place.run(&line).check(code, texts);
    }
}

#[test]
fn prints_events_a_line() {
    let place = place("run_events");
    let line = "run good.motet --scene kitchen --speed max --format json";
    let ran = place.run(line);
    let events: Vec<Value> =
        ran.check(0, &[]).stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(events.iter().filter(|event| event["event"].is_string()).count() > 10);
    let last = events.last().unwrap();
    assert_eq!((&last["event"], &last["outcome"]), (&Value::from("finished"), &Value::from("done")));
    place
        .run("run bad.motet --scene kitchen --format json")
        .check(1, &["out:{\"event\":\"diagnostic\",\"code\":\"M0201\""]);
    let times: Vec<f64> = events.iter().filter_map(|event| event["at"].as_f64()).collect();
    assert!(times.is_sorted(), "time never runs backwards");
    assert!(events.iter().any(|event| event["event"] == "command" && event["args"]["object"] == "mug_1"));
    assert_eq!(place.run(line).stdout, ran.stdout, "the same seed gives the same run");
}

#[cfg(unix)]
#[test]
fn stops_where_nobody_reads() {
    let place = place("run_closed");
    let line = "run good.motet --scene kitchen --speed 50";
    // `head` takes the first line and goes, and its status is that of the pipe.
    let shell = format!("({} {line}; echo status $? >&2) | head -n 1", env!("CARGO_BIN_EXE_motet"));
    let ran = place.shell(&shell);
    ran.check(0, &["out:go(kitchen_table)", "err:status 130"]);
    assert!(!ran.stderr.contains("panicked"), "{ran:#?}");
}

#[cfg(unix)]
#[test]
fn stops_on_interrupt() {
    use std::io::{BufRead, BufReader};
    use std::process::{Command, Stdio};
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("run_codes_interrupt");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("long.motet"), "policy waits for hsr {\n    go(kitchen_table)\n}\n").unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_motet"))
        .args(["run", "long.motet", "--scene", "kitchen", "--speed", "0.01"])
        .current_dir(&folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    let mut stdout = BufReader::new(child.stdout.take().unwrap());
    stdout.read_line(&mut first).unwrap();
    assert!(first.contains("go(kitchen_table)"), "{first}");
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let rest: Vec<_> = stdout.lines().map_while(Result::ok).collect();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(rest.join("\n").contains("interrupted"), "{rest:?}");
}

/// The robot knows the kitchen as it was told, and the real one differs.
#[test]
fn world_differs_from_the_scene_that_the_robot_knows() {
    let told: Value = serde_json::from_str(KITCHEN).unwrap();
    let real = |id: &str, key: &str, value: Value| {
        let mut scene = told.clone();
        let entities = scene["entities"].as_array_mut().unwrap();
        let entity = entities.iter_mut().find(|entity| entity["id"] == id).unwrap();
        if key == "on" {
            entity.as_object_mut().unwrap().remove("pose");
        }
        entity[key] = value;
        scene.to_string()
    };
    let policy = |achieves: &str, then: &str| {
        format!("policy p for hsr {achieves} {{\n    go(fridge_1)\n    {then}\n}}\n")
    };
    let place = Place::new("run_world")
        .file("shelf.json", real("coke", "on", "shelf".into()))
        .file("locked.json", real("fridge_1", "locked", true.into()))
        .file("state.json", r#"{"open(fridge_1)": true}"#)
        .file("is_open.motet", policy("", "if open(fridge_1) { say(\"yes\") }"))
        .file("find.motet", policy("achieves holding(coke)", "search(\"coke\", counter)\n    pick(coke)"))
        .file("open.motet", policy("achieves open(fridge_1)", "open(fridge_1)"));
    let flags = "--scene kitchen --profile ideal --speed max";
    place.run(&format!("run find.motet {flags}")).check(0, &["out:✓ p: done"]);
    let (failed, refused) = ("out:failed with `not_found`", "out:the refrigerator is locked");
    place.run(&format!("run find.motet {flags} --world shelf.json")).check(3, &[failed]);
    place.run(&format!("run open.motet {flags} --world locked.json")).check(3, &[refused]);
    // The state holds in both.
    let said = "out:▶ say(\"yes\")";
    place.run(&format!("run is_open.motet {flags} --world shelf.json --state state.json")).check(0, &[said]);
}
