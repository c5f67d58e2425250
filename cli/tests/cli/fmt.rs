//! `motet fmt` and `motet compile` from outside.

use crate::support::{BAD, GOOD, GOOD_JSON, Place};

const LOOSE: &str = "// A comment that stays.\npolicy   tidy for hsr {\n go( kitchen_table )\n}\n";
const TIGHT: &str = "// A comment that stays.\npolicy tidy for hsr {\n    go(kitchen_table)\n}\n";

#[test]
fn rewrites_only_what_differs() {
    let place =
        Place::new("fmt_rewrites").file("a.motet", LOOSE).file("b.motet", GOOD).file("c.motet", "policy {");
    place.run("fmt --check a.motet b.motet").check(1, &["out:would reformat a.motet", "err:1 file would be"]);
    assert_eq!(place.read("a.motet"), LOOSE, "a check writes nothing");
    place.run("fmt a.motet b.motet").check(0, &["err:1 file reformatted, 1 unchanged"]);
    assert_eq!(place.read("a.motet"), TIGHT);
    place.run("fmt --check a.motet b.motet").check(0, &[]);
    place.run("fmt .").check(1, &["out:c.motet", "err:1 with errors skipped"]);
    assert_eq!(place.read("c.motet"), "policy {");
    place.run("fmt absent.motet").check(2, &[]);
    place.run("fmt --check --to json a.motet").check(2, &["err:cannot be used with"]);
}

#[test]
fn formats_standard_input() {
    let place = Place::new("fmt_stdin");
    let ran = place.run_with("fmt -", LOOSE.as_bytes(), &[]);
    assert_eq!(ran.check(0, &[]).stdout, TIGHT);
    place.run_with("fmt -", b"policy {", &[]).check(1, &["out:-:1"]);
    place.run_with("fmt - --check", LOOSE.as_bytes(), &[]).check(1, &[]);
}

#[test]
fn goes_to_the_other_form_and_back() {
    let place = Place::new("fmt_forms").file("a.motet", GOOD).file("a.json", GOOD_JSON);
    let json = place.run("fmt --to json a.motet").check(0, &[]).stdout.clone();
    let text = place.run("fmt --to text a.json").check(0, &[]).stdout.clone();
    assert_eq!(text, GOOD);
    let value = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
    assert_eq!(value(&json), value(GOOD_JSON));
    let back = place.run_with("fmt --to text -", json.as_bytes(), &[]);
    assert_eq!(back.check(0, &[]).stdout, GOOD);
    let back = place.run_with("fmt --to json -", text.as_bytes(), &[]);
    assert_eq!(back.check(0, &[]).stdout, json);
}

#[test]
fn writes_a_batch_of_json_a_line_each() {
    let place = Place::new("fmt_batch").file("a.motet", GOOD).file("b.motet", GOOD.replace("tidy", "again"));
    let ran = place.run("fmt --to json a.motet b.motet");
    assert_eq!(ran.check(0, &[]).stdout.lines().count(), 2);
    let place = place.file("all.jsonl", &ran.stdout);
    let texts = place.run("fmt --to text all.jsonl");
    assert_eq!(texts.check(0, &[]).stdout, format!("{GOOD}\n{}", GOOD.replace("tidy", "again")));
    place.run("fmt all.jsonl").check(0, &["err:skipped the .jsonl files"]);
}

#[test]
fn says_what_json_cannot() {
    let place = Place::new("fmt_cannot").file("two.motet", format!("{GOOD}policy more {{ done }}\n"));
    place.run("fmt --to json two.motet").check(1, &["err:exactly one policy"]);
    place.run("compile two.motet --emit json --policy tidy --scene kitchen").check(0, &["out:\"tidy\""]);
}

#[test]
fn compiles() {
    let place = Place::new("compile")
        .file("a.motet", GOOD)
        .file("bad.motet", BAD)
        .file("both.motet", "policy both for hsr {\n    parallel { { go(sink) } { say(\"Hello.\") } }\n}\n")
        .file("two.motet", format!("{GOOD}\npolicy other for hsr {{\n    done\n}}\n"));
    let graph = place.run("compile a.motet --scene kitchen").check(0, &[]).stdout.clone();
    assert!(serde_json::from_str::<serde_json::Value>(&graph).unwrap().is_object());
    assert_eq!(
        place.run("compile a.motet --scene kitchen").stdout,
        graph,
        "the same policy gives the same bytes"
    );
    place.run("compile a.motet --scene kitchen -o out.json").check(0, &[]);
    assert_eq!(place.read("out.json"), graph);
    for (line, code, texts) in [
        ("compile a.motet --scene kitchen --emit mermaid", 0, &["out:flowchart"][..]),
        ("compile a.motet --scene kitchen --emit dot", 0, &["out:digraph"]),
        ("compile a.motet --scene kitchen --emit python", 0, &["out:async def tidy(robot: Robot):"]),
        (
            "compile both.motet --scene kitchen --emit python",
            1,
            &["err:cannot say `parallel`", "err:/steps/0"],
        ),
        ("compile a.motet --scene kitchen --emit text", 0, &["out:policy tidy for hsr"]),
        ("compile a.motet --scene kitchen --emit json", 0, &["out:\"steps\""]),
        ("compile bad.motet", 1, &["out:M0201"]),
        ("compile two.motet --scene kitchen", 1, &["out:tidy"]),
        ("compile two.motet --scene kitchen --policy other", 0, &["out:other"]),
        ("compile two.motet --scene kitchen --policy none", 1, &["out:none"]),
        ("compile .", 2, &["err:folder"]),
        ("compile absent.motet", 2, &["err:no such file"]),
        ("compile a.motet --scene kitchen -o absent/out.json", 2, &["err:cannot write"]),
        ("compile a.motet --emit picture", 2, &["err:possible values"]),
    ] {
        println!("motet {line}");
        place.run(line).check(code, texts);
    }
}

#[test]
fn leaves_a_reply_with_text_beside_the_policy_alone() {
    let reply = format!("Here it is:\n\n```motet\n{}```\nGood luck!\n", GOOD.replace("    go", "  go"));
    let place = Place::new("fmt_reply").file("reply.motet", &reply);
    place.run("fmt reply.motet").check(1, &["out:M0116", "err:1 with prose skipped"]);
    place.run("fmt --check reply.motet").check(1, &["err:skipped"]);
    assert_eq!(place.run_with("fmt -", reply.as_bytes(), &[]).check(1, &["err:M0116"]).stdout, reply);
    assert_eq!(place.read("reply.motet"), reply);
    // What it prints elsewhere is the policy.
    place.run("fmt reply.motet --to text").check(0, &["out:policy tidy for hsr {\n    go", "err:M0116"]);
    let wrong = reply.replace("pick(mug)", "pik(mug)");
    let place = Place::new("fix_reply").file("reply.motet", &wrong);
    place
        .run("check --fix reply.motet --scene kitchen")
        .check(1, &["out:M0201", "err:--fix skipped replies", "err:applied 0 fixes"]);
    assert_eq!(place.read("reply.motet"), wrong);
}

#[cfg(unix)]
#[test]
fn file_is_replaced_as_a_whole() {
    let place = Place::new("fmt_replaces").file("loose.motet", "policy a { say(\"x\")   done }");
    place.shell("ln -s loose.motet link.motet && chmod 640 loose.motet").check(0, &[]);
    place.run("fmt link.motet").check(0, &[]);
    place.shell("test -L link.motet && stat -c %a loose.motet && ls").check(0, &["out:640"]);
    assert!(place.read("loose.motet").contains('\n'));
    let shown = place.shell("ls");
    assert!(!shown.stdout.contains("partial"), "{shown:#?}");
}
