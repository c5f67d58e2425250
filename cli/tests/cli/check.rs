//! `motet check` from outside: inputs, formats, exit codes.

use crate::support::{BAD, GOOD, GOOD_JSON, Place};
use serde_json::Value;

fn place(name: &str) -> Place {
    Place::new(name)
        .file("good.motet", GOOD)
        .file("good.json", GOOD_JSON)
        .file("bad.motet", BAD)
        .file("deep/er/also.json", GOOD_JSON)
        .file("deep/room.json", r#"{"motet_scene": 1, "entities": []}"#)
        .file("deep/readme.md", "nothing")
        .file("broken.json", "{\"motet\": 1,")
        .file("latin.motet", b"policy caf\xe9 {}")
        .file("state.json", r#"{"holding(mug_1)": true, "free(hand)": false}"#)
        .file("open.json", r#"{"open(drawer_1)": true}"#)
        .file("odd_grip.json", r#"{"holding(mug_1)": {"xyz": [0, 0, 0]}}"#)
        .file("true_grip.json", r#"{"grip(mug_1)": true}"#)
        .file("far_grip.json", r#"{"holding(mug_1)": true, "grip(mug_1)": {"xyz": [0, 0, 9]}}"#)
        .file("odd_state.json", r#"{"holding(": true}"#)
        .file("full_hand.json", r#"{"holding(mug_1)": true, "free(hand)": true}"#)
        .file("two_held.json", r#"{"holding(mug_1)": true, "holding(coke)": true}"#)
        .file("all_held.json", r#"{"holding(any)": true}"#)
        .file(
            "odd_kind.json",
            "{\"motet_scene\": 1, \"entities\": [\n  {\"id\": \"mug_1\", \"kind\": \"Surfase\"}]}",
        )
        .file("plain.json", "{\"motet_scene\": 1, \"entities\": [\n  {\"id\": \"b\", \"kind\": \"Object\"}]}")
        .file("b.motet", "entity b: Object\n")
        .file("domain.motet", "kind Block: Object\nfluent stacked(a: Block)\n")
        .file("odd_domain.motet", "fluent (")
        .file("named.motet", "policy p for hsr {\n    go(ledge)\n    pick(cup)\n    say(\"done\")\n}\n")
        .file("empty.json", "\n")
        .file("robot/readme.md", "no card")
        .file("odd_robot/robot.toml", "name = ")
        .file("lines.jsonl", {
            let line = GOOD_JSON.replace('\n', " ");
            format!("{line}\n\n{}\n", line.replace("\"pick\"", "\"pik\""))
        })
}

#[test]
#[cfg(unix)]
fn pipes_and_devices_are_read_only_where_they_are_open() {
    let place = place("check_pipes");
    place.shell("mkfifo pipe.motet pipe.jsonl").check(0, &[]);
    let refused = &["err:is no regular file; give the output of a pipe as `-` or `/dev/stdin`"];
    for line in [
        "check pipe.motet",
        "check pipe.jsonl",
        "check /dev/zero",
        "check good.motet --robot hsr --scene pipe.motet",
        "check good.motet --scene kitchen --state /dev/zero",
        "check good.motet --scene kitchen --domain pipe.motet",
        "dataset lint pipe.motet",
        "dataset lint /dev/zero",
    ] {
        place.run(line).check(2, refused);
    }
    place.run_with("check /dev/stdin --scene kitchen --no-geometry", GOOD.as_bytes(), &[]).check(0, &[]);
    let motet = env!("CARGO_BIN_EXE_motet");
    let piped = |from: &str, line: &str| place.shell(&format!("cat {from} | {motet} {line}"));
    piped("good.motet", "check /dev/fd/0 --scene kitchen --no-geometry").check(0, &[]);
    piped("/dev/zero", "check /dev/fd/0").check(1, &["out:M0112"]);
    piped("/dev/zero", "dataset lint /dev/fd/0").check(2, &["err:a line of it has more than 64 MiB"]);
}

#[test]
fn ends_with_the_right_code() {
    let place = place("check_codes");
    let scene = "--scene kitchen";
    for (line, code, texts) in [
        (
            format!("check good.motet {scene} --no-geometry"),
            0,
            &["err:checked 1 document: no errors", "err:not checked"][..],
        ),
        (
            "check named.motet --robot hsr".to_owned(),
            1,
            &["err:2 motions were not checked, because no scene was given"],
        ),
        (
            format!("check named.motet good.motet {scene}"),
            1,
            &["err:2 motions were not checked because of earlier errors"],
        ),
        ("check good.motet --scene empty.json".to_owned(), 2, &["out:a scene is `{\"motet_scene\": 1"]),
        (format!("check good.motet {scene}"), 0, &["err:checked 1 document: no errors"]),
        (format!("check good.json {scene}"), 0, &["err:checked 1 document"]),
        (format!("check good.motet good.json {scene}"), 0, &["err:checked 2 documents"]),
        (format!("check good.motet good.motet {scene}"), 0, &["err:checked 1 document"]),
        (format!("check bad.motet {scene}"), 1, &["out:M0201", "out:goo", "err:1 error"]),
        (format!("check deep {scene}"), 0, &["err:checked 1 document", "err:skipped 1 JSON file"]),
        (format!("check lines.jsonl {scene}"), 1, &["out:lines.jsonl:3", "err:checked 2 documents: 1 error"]),
        (format!("check good.motet {scene} --state open.json"), 0, &[]),
        (format!("check good.motet {scene} --state state.json"), 1, &["out:M0501", "out:free(hand)"]),
        (format!("check good.motet {scene} --domain domain.motet"), 0, &[]),
        (format!("check good.motet {scene} --max-duration 1s"), 1, &["out:M08"]),
        ("check broken.json".to_owned(), 1, &["out:broken.json"]),
        ("check latin.motet".to_owned(), 1, &["out:latin.motet"]),
        (
            "check good.motet --scene kitchn".to_owned(),
            2,
            &["err:no scene `kitchn`", "err:did you mean `kitchen`?"],
        ),
        ("check good.motet --robot hsrr".to_owned(), 2, &["err:no robot `hsrr`", "err:did you mean `hsr`?"]),
        ("check good.motet --robot robot".to_owned(), 2, &["err:no robot.toml"]),
        ("check good.motet --robot odd_robot".to_owned(), 2, &["out:odd_robot/robot.toml"]),
        ("check good.motet --scene broken.json".to_owned(), 2, &["out:broken.json"]),
        ("check good.motet --scene absent.json".to_owned(), 2, &["err:cannot read `absent.json`"]),
        ("check good.motet --state absent.json".to_owned(), 2, &["err:cannot read `absent.json`"]),
        (format!("check good.motet {scene} --state odd_state.json"), 2, &["out:M0224"]),
        (
            format!("check good.motet {scene} --state odd_grip.json"),
            2,
            &["out:M0224", "out:holding(mug_1): pose"],
        ),
        (format!("check good.motet {scene} --state true_grip.json"), 2, &["out:grip"]),
        (format!("check good.motet {scene} --state far_grip.json"), 2, &["out:grip(mug_1): pose"]),
        (format!("check good.motet {scene} --state full_hand.json"), 2, &["out:M0225", "out:cannot be free"]),
        (format!("check good.motet {scene} --state two_held.json"), 2, &["out:M0225", "out:has one hand"]),
        (format!("check good.motet {scene} --state all_held.json"), 2, &["out:M0225", "out:name the thing"]),
        (
            "check good.motet --scene odd_kind.json".to_owned(),
            2,
            &["out:M0221", "out:odd_kind.json:2:", "out:did you mean `Surface`?"],
        ),
        (
            "check good.motet --scene plain.json --domain b.motet".to_owned(),
            2,
            &["out:M0222", "out:plain.json:2:"],
        ),
        (format!("check good.motet {scene} --domain odd_domain.motet"), 2, &["out:odd_domain.motet"]),
        ("check absent.motet".to_owned(), 2, &["err:cannot read `absent.motet`: no such file"]),
        ("check".to_owned(), 2, &["err:Usage"]),
        ("check good.motet --colour".to_owned(), 2, &["err:--color"]),
        ("check good.motet --max-duration 10".to_owned(), 2, &["err:write a number with ms, s, min or h"]),
        ("chek good.motet".to_owned(), 2, &["err:check"]),
        ("--help".to_owned(), 0, &["out:Exit codes"]),
        ("check --help".to_owned(), 0, &["out:Examples"]),
        ("--version".to_owned(), 0, &["out:motet 0"]),
    ] {
        println!("motet {line}");
        place.run(&line).check(code, texts);
    }
}

#[test]
fn reads_standard_input() {
    let place = place("check_stdin");
    let scene = "check - --scene kitchen";
    for (input, code, text) in [
        (GOOD.as_bytes(), 0, "err:no errors"),
        (GOOD_JSON.as_bytes(), 0, "err:no errors"),
        (BAD.as_bytes(), 1, "out:-:2:5"),
        (b"", 1, "out:the document is empty"),
        (b"\xff\xfe", 1, "out:UTF-8"),
        (b"Sure! Here it is:\n```json\n{}\n```\n", 1, "out:```"),
    ] {
        println!("{}", String::from_utf8_lossy(input));
        place.run_with(scene, input, &[]).check(code, &[text]);
    }
}

#[test]
fn shows_people_as_many_findings_as_they_ask_for() {
    let steps: String = (0..150).map(|at| format!("    fly{at}()\n")).collect();
    let place = Place::new("check_many").file("many.motet", format!("policy p for hsr {{\n{steps}}}\n"));
    let many = "check many.motet --robot hsr";
    place.run(many).check(1, &["out:`fly99`", "out:… 50 more findings", "err:150 errors"]);
    place.run(&format!("{many} --findings 3")).check(1, &["out:`fly2`", "out:… 147 more findings"]);
    place.run(&format!("{many} --format json")).check(1, &["out:`fly149`"]);
}

#[test]
fn refuses_what_is_too_large() {
    let large = vec![b' '; 16 * 1024 * 1024 + 1];
    let place = Place::new("check_large").file("large.motet", &large).file("lines.jsonl", &large);
    for line in ["check large.motet", "check lines.jsonl"] {
        place.run(line).check(1, &["out:M0112", "out:at most 16 MiB"]);
    }
    place.run("check --scene large.motet large.motet").check(2, &["err:larger than 16 MiB"]);
}

#[test]
fn prints_every_format() {
    let place = place("check_formats");
    let run = |format: &str| place.run(&format!("check bad.motet --scene kitchen --format {format}"));

    let json = run("json");
    let first: Value = serde_json::from_str(json.check(1, &[]).stdout.lines().next().unwrap()).unwrap();
    for key in ["code", "severity", "message", "file", "path", "span"] {
        assert!(!first[key].is_null(), "{key} in {first}");
    }
    assert_eq!(first["span"]["line"], 2);

    let sarif: Value = serde_json::from_str(&run("sarif").check(1, &[]).stdout).unwrap();
    assert_eq!(sarif["version"], "2.1.0");
    let run_of = &sarif["runs"][0];
    assert_eq!(run_of["tool"]["driver"]["name"], "motet");
    let result = &run_of["results"][0];
    assert!(result["message"]["text"].is_string());
    assert_eq!(result["ruleId"], first["code"]);
    let location = &result["locations"][0]["physicalLocation"];
    assert_eq!(location["artifactLocation"]["uri"], "bad.motet");
    assert_eq!(location["region"]["startLine"], 2);

    run("github").check(1, &["out:::error file=bad.motet,line=2"]);
    run("human").check(1, &["out:bad.motet:2:5"]);

    let clean = |format: &str| place.run(&format!("check good.motet --scene kitchen --format {format}"));
    assert_eq!(clean("json").check(0, &[]).stdout, "");
    let sarif: Value = serde_json::from_str(&clean("sarif").check(0, &[]).stdout).unwrap();
    assert_eq!(sarif["runs"][0]["results"], Value::Array(Vec::new()));
}

#[test]
fn merges_the_sources_of_a_batch() {
    let place = place("check_merge")
        .file("worse.motet", "// one\n\npolicy other for anymal_z1 {\n    goo(user)\n}\n");
    let ran = place.run("check bad.motet worse.motet lines.jsonl --scene kitchen --format sarif");
    let sarif: Value = serde_json::from_str(&ran.check(1, &[]).stdout).unwrap();
    let results = sarif["runs"][0]["results"].as_array().unwrap();
    let place_of = |name: &str| {
        let location = |result: &Value| result["locations"][0]["physicalLocation"].clone();
        results.iter().map(location).find(|found| found["artifactLocation"]["uri"] == name).unwrap()
    };
    assert_eq!(place_of("bad.motet")["region"]["startLine"], 2);
    assert_eq!(place_of("worse.motet")["region"]["startLine"], 4);
    // Tools open the file, not a line of it.
    let line = &place_of("lines.jsonl")["region"];
    assert_eq!(line["startLine"], 3);
    assert!(line["byteOffset"].is_null());
    let ran = place.run("check lines.jsonl --scene kitchen --format github");
    ran.check(1, &["out:::error file=lines.jsonl,line=3,endLine=3,col="]);
}

#[test]
fn colours_only_when_asked() {
    let place = place("check_colors");
    let is_colored = |line: &str, variables: &[(&str, &str)]| {
        place.run_with(&format!("check bad.motet {line}"), b"", variables).stdout.contains('\u{1b}')
    };
    assert!(!is_colored("", &[]), "a pipe is no terminal");
    assert!(is_colored("--color always", &[]));
    assert!(!is_colored("--color never", &[]));
    assert!(!is_colored("--color auto", &[("NO_COLOR", "1")]));
    assert!(is_colored("--color always", &[("NO_COLOR", "1")]), "the flag is nearer than the variable");
}

#[test]
fn outlives_a_reader_that_goes_away() {
    use std::process::{Command, Stdio};
    let mut line = String::new();
    for _ in 0..2000 {
        line.push_str(&GOOD_JSON.replace('\n', " ").replace("\"pick\"", "\"pik\""));
        line.push('\n');
    }
    std::fs::write(std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("many.jsonl"), line).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_motet"))
        .args(["check", "many.jsonl"])
        .current_dir(env!("CARGO_TARGET_TMPDIR"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"));
}

#[test]
fn mends_what_it_can() {
    let place = place("check_fix").file("worse.json", GOOD_JSON.replace("\"go\"", "\"goo\""));
    let place = place.file("lost.motet", "policy p for hsr { go(nowhere_at_all) }");
    let ran = place.run("check bad.motet worse.json --scene kitchen --fix");
    ran.check(0, &["err:applied 3 fixes", "err:checked 2 documents: no errors"]);
    assert_eq!(place.read("bad.motet"), BAD.replace("goo", "go"));
    assert_eq!(place.read("worse.json"), GOOD_JSON);
    place.run("check good.motet --scene kitchen --fix").check(0, &["err:applied 0 fixes"]);
    place.run("check lost.motet --scene kitchen --diff").check(1, &["err:1 error would be left"]);
    place.run("check good.motet --scene kitchen --diff").check(0, &["err:0 fixes would be applied"]);
    let ran = place.run_with("check - --scene kitchen --fix", BAD.as_bytes(), &[]);
    ran.check(0, &["err:applied 1 fix"]);
    assert_eq!(ran.stdout, BAD.replace("goo", "go"));
    place.run("check lines.jsonl --scene kitchen --fix").check(1, &["err:--fix skipped the .jsonl files"]);
    place.run("check latin.motet --fix").check(1, &["out:latin.motet"]);
}

#[test]
fn tells_a_model_what_to_write() {
    let ran = place("check_llm").run("check bad.motet --scene kitchen --format llm");
    ran.check(1, &[]);
    assert_eq!(ran.stdout, "Step 1: there is no primitive or policy `goo`. Write `go`.\n");
}

#[test]
fn says_what_of_a_folder_it_did_not_check() {
    let place = Place::new("check_folders")
        .file("empty/readme.md", "nothing")
        .file("near/steps.json", r#"[{"do": "go", "to": "user"}]"#)
        .file("near/step.json", r#"{"do": "go", "to": "user"}"#)
        .file("near/room.json", r#"{"motet_scene": 1, "entities": []}"#);
    place.run("check empty").check(0, &["err:warning: nothing to check", "err:checked 0 documents"]);
    // Steps without a policy around them are read as one.
    place.run("check near").check(
        0,
        &[
            "out:near/steps.json",
            "out:near/step.json",
            "err:checked 2 documents",
            "err:not a policy: `near/room.json`",
        ],
    );
}

#[test]
fn check_takes_robot_and_scene_from_the_folder_of_each_policy() {
    let place = Place::new("check_config")
        .file("motet.toml", "robot = \"hsr\"\nscene = \"kitchen\"\nmax_duration = \"10 min\"\n")
        .file("a.motet", "policy a { go(counter) }\n")
        .file(
            "inner/motet.toml",
            "robot = \"hsr\"\nscene = \"rooms/one.json\"\n[clearance]\nbase = \"2 cm\"\n",
        )
        .file(
            "inner/rooms/one.json",
            "{\"motet_scene\": 1, \"entities\": [{\"id\": \"shelf\", \"kind\": \"Surface\"}]}",
        )
        .file("inner/deep/b.motet", "policy b { go(shelf) }\n")
        .file("inner/c.motet", "policy c { go(counter) }\n");
    place.run("check a.motet inner/deep/b.motet").check(0, &["err:checked 2 documents: no errors"]);
    // Of the room of its own folder, and no other.
    place.run("check .").check(1, &["out:M0202", "out:counter", "out:inner/c.motet:1:"]);
    // A flag goes before the file.
    place.run("check inner/c.motet --scene kitchen").check(0, &[]);
    for (text, said) in [
        ("robto = \"hsr\"\n", "line 1: unknown field `robto`"),
        ("[clearance]\nbase = 3\n", "`clearance.base` has to be from 0 to 0.5"),
        ("max_duration = \"3 cm\"\n", "`max_duration` has to be"),
        ("robot = \"nobody\"\n", "there is no robot"),
    ] {
        let place =
            Place::new("check_config_wrong").file("motet.toml", text).file("a.motet", "policy a { done }\n");
        place.run("check a.motet").check(2, &[&format!("err:{said}")]);
    }
}

#[test]
fn other_commands_take_robot_and_scene_from_the_folder() {
    let place = Place::new("commands_config")
        .file("motet.toml", "robot = \"hsr\"\nscene = \"kitchen\"\n")
        .file("a.motet", "policy a { go(counter) }\n")
        .file(
            "many.jsonl",
            "{\"motet\": 1, \"policy\": \"a\", \"steps\": [{\"do\": \"go\", \"to\": \"counter\"}]}\n",
        )
        .file("other/motet.toml", "robot = \"panda\"\nscene = \"lab\"\n")
        .file("other/b.motet", "policy b { say(\"hello\") }\n")
        .file("wrong/motet.toml", "robot = 3\n")
        .file("wrong/c.motet", "policy c { done }\n");
    place.run("run a.motet --speed max").check(0, &[]);
    place.run("run many.jsonl --profile ideal").check(0, &["err:1 done"]);
    place.run("compile a.motet").check(0, &["out:\"robot\":\"hsr\""]);
    place.run("compile other/b.motet").check(0, &["out:\"robot\":\"panda\""]);
    place.run("compile other/b.motet --robot hsr --scene kitchen").check(0, &["out:\"robot\":\"hsr\""]);
    place.run_args(&["plan", "go to the counter"].map(str::to_owned)).check(0, &["out:go(counter)"]);
    place
        .run_args(&["feasible", "--for", "go_to(counter)"].map(str::to_owned))
        .check(0, &["out:go_to(counter): feasible"]);
    let request = ["do", "go to the counter", "--speed", "max", "--ask", "never"].map(str::to_owned);
    place.run_args(&request).check(0, &[]);
    Place::new("commands_short")
        .file("motet.toml", "robot = \"hsr\"\nscene = \"kitchen\"\nmax_duration = \"1 s\"\n")
        .run_args(&request)
        .check(3, &["err:at most 1 s is allowed"]);
    place.run("compile wrong/c.motet").check(2, &["err:line 1"]);
    let nowhere = Place::new("commands_no_config");
    nowhere.run("feasible --all").check(2, &["err:no robot is named", "err:motet.toml"]);
}
