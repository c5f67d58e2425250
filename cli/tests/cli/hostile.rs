//! Strings of others with characters that steer a terminal, in each kind of input and each format: none of
//! them reaches a stream as it is.

use sha2::{Digest as _, Sha256};

use crate::driver::{has_python, odd};
use crate::support::{Place, Ran};

/// The formats of findings.
const FORMATS: [&str; 5] = ["human", "json", "sarif", "github", "llm"];
const CARD: &str = include_str!("../../../robots/models/hsr/robot.toml");
const URDF: &str = "<robot name='§'><link name='§'/><link name='§'/><joint name='§' type='§'/></robot>";

/// Bytes of a text with the mark `§` as control characters and others that steer, as they are.
fn raw(text: &str) -> String {
    text.replace('§', "x\u{1b}[2J\u{9b}\u{7f}\u{202e}\u{0}y")
}

/// The same with those only that no format refuses by itself.
fn soft(text: &str) -> String {
    text.replace('§', "x\u{9b}2J\u{85}\u{202e}\u{2066}y")
}

/// The same as escapes of JSON and TOML.
fn json(text: &str) -> String {
    text.replace('§', r"x\u001b[2J\u009b\u007f\u202e\u2028\u0000\n# y")
}

/// A journal with other texts in it, whose checksums and hashes are right again: they are no signatures.
fn forged(of: &str, texts: &[(&str, &str)]) -> String {
    let hash = |line: &str| -> String {
        Sha256::digest(line.as_bytes()).iter().take(16).map(|byte| format!("{byte:02x}")).collect()
    };
    let (mut before, mut last, mut whole) = (hash(""), hash(""), String::new());
    for line in of.lines() {
        let (_, entry) = line.split_once(' ').unwrap();
        assert!(entry.contains(&before), "{entry}");
        let mut entry = entry.replace(&before, &last);
        texts.iter().for_each(|(from, to)| entry = entry.replace(from, to));
        let forged = format!("{:08x} {entry}", crc32fast::hash(entry.as_bytes()));
        (before, last) = (hash(line), hash(&forged));
        whole.push_str(&forged);
        whole.push('\n');
    }
    whole
}

/// Checks that no stream has what steers a terminal.
fn is_clean(line: &str, ran: &Ran) {
    assert_ne!(ran.code, Some(101), "{line:?}: {ran:#?}");
    for shown in [&ran.stdout, &ran.stderr] {
        let found = shown.find(|letter: char| {
            let turns = matches!(letter, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
            turns || (letter.is_control() && !matches!(letter, '\n' | '\t'))
        });
        assert!(found.is_none(), "{line:?}: {ran:#?}");
    }
}

/// Runs command lines with all spellings of the marks in a file, in all formats where `FORMAT` stands. One of
/// the lines has to show the string, escaped.
fn check(place: Place, file: &str, text: &str, lines: &[&str]) -> Place {
    let spellings: [fn(&str) -> String; 3] = [raw, soft, json];
    let (mut place, mut shown) = (place, 0);
    for spelled in spellings {
        place = place.file(file, spelled(text));
        for line in lines {
            let formats = if line.contains("FORMAT") { &FORMATS[..] } else { &[""] };
            for format in formats {
                let line = line.replace("FORMAT", &format!("--format {format}"));
                let ran = place.run(&line);
                is_clean(&format!("{line} < {file}"), &ran);
                let escapes = [r"\u{9b}", r"\u009b", r"\u{1b}", r"\u001b", r"\u{202e}", r"\u202e"];
                shown += usize::from(escapes.iter().any(|one| ran.stdout.contains(one)));
                shown += usize::from(escapes.iter().any(|one| ran.stderr.contains(one)));
            }
        }
    }
    assert!(shown > 0, "no line shows the strings of {file}");
    place
}

#[test]
fn policies_with_hostile_strings_are_shown_escaped() {
    let checked = |file: &str| {
        let of = |line: &str| line.replace("@", file);
        let lines =
            ["check @ --scene kitchen FORMAT", "check --fix --diff @ --scene kitchen", "fmt --check @"];
        let more = ["fmt --to text @", "fmt --to json @", "compile @ --emit graph", "compile @ --emit dot"];
        let most = ["compile @ --emit tree", "compile @ --emit mermaid", "compile @ --emit python"];
        let last = ["run @ --scene kitchen --speed max", "run @ --scene kitchen --speed max --format json"];
        let rest =
            ["compile @ --emit text", "compile @ --emit json", "export btcpp @", "decode @ --robot hsr"];
        [&lines[..], &more, &most, &last, &rest].concat().into_iter().map(of).collect::<Vec<_>>()
    };
    let files = [
        ("comment.motet", "// §\npolicy p for hsr { go(counter) }\n"),
        ("name.motet", "policy p for hsr { go(`§`) }\n"),
        ("text.motet", "policy p for hsr { say(\"§\") cannot \"§\" }\n"),
        ("stray.motet", "policy p for hsr { § }\n"),
        (
            "text.json",
            r#"{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{"do": "say", "text": "§"}]}"#,
        ),
        (
            "name.json",
            r#"{"motet": 1, "policy": "§", "robot": "§", "steps": [{"do": "§", "§": "§"}, {"if": "§(§)"}]}"#,
        ),
        ("reply.txt", "Here: §\n```json\n{\"motet\": 1, \"policy\": \"§\", \"steps\": [\"§\"]}\n```\n"),
    ];
    let mut place = Place::new("hostile_policies");
    for (file, text) in files {
        let lines = checked(file);
        place = check(place, file, text, &lines.iter().map(String::as_str).collect::<Vec<_>>());
    }
}

#[test]
fn rooms_and_robots_with_hostile_strings_are_shown_escaped() {
    let place = Place::new("hostile_rooms").file("p.motet", "policy p for hsr { go(user) }\n");
    let thing = r#"{"motet_scene": 1, "entities": [{"id": "a§", "kind": "§", "class": "§", "names": ["§"],
        "on": "§"}, {"id": "b", "kind": "Object", "class": "c", "names": ["§"], "categories": ["§"]}],
        "robot": {"at": "§", "joints": {"§": 1}, "holding": "§"}, "frame": "§", "§": "§"}"#;
    let lines = [
        "scenes show s.json",
        "scenes check s.json",
        "scenes draw s.json --robot hsr",
        "check p.motet --scene s.json FORMAT",
        "prompt go --robot hsr --scene s.json",
        "plan go --robot hsr --scene s.json",
        "dialog --write go --robot hsr --scene s.json",
        "feasible --robot hsr --scene s.json --all",
        "do go --robot hsr --scene s.json --ask never --speed max",
    ];
    let place = check(place, "s.json", thing, &lines);
    let card =
        CARD.replacen("title = \"", "title = \"§", 1).replacen("observes = [", "observes = [\"§\", ", 1);
    let lines = [
        "robots show rb",
        "robots check rb",
        "check p.motet --robot rb FORMAT",
        "prompt go --robot rb --scene kitchen",
    ];
    let place = check(place, "rb/robot.toml", &card, &lines);
    let wrong = "title = \"§\"\nurdf = \"§\"\n\"§\" = \"§\"\n";
    let place = check(place, "rb/robot.toml", wrong, &["robots check rb", "check p.motet --robot rb FORMAT"]);
    let place = check(place, "u/robot.urdf", URDF, &["robots add u/robot.urdf"]);
    check(
        place,
        "motet.toml",
        "robot = \"§\"\nscene = \"§\"\n\"§\" = 1\n",
        &["check p.motet", "scenes show"],
    );
}

#[test]
fn other_inputs_with_hostile_strings_are_shown_escaped() {
    let place =
        Place::new("hostile_others").file("p.motet", "policy p for hsr { let a = ask(\"Which?\") fail a }\n");
    let domain = "(define (domain §) (:requirements :§) (:predicates (§ ?§ - §)) (:action § :effect (§ ?x)))";
    let place = check(place, "d.pddl", domain, &["import pddl d.pddl d.pddl FORMAT"]);
    let place = check(place, "m.yaml", "image: §\nresolution: §\n§: §\n", &["import map m.yaml FORMAT"]);
    let sdf =
        "<sdf version='1.9'><world name='§'><model name='§'><static>§</static><§/></model></world></sdf>";
    let place = check(place, "w.sdf", sdf, &["import sdf w.sdf FORMAT"]);
    let tree = "<root BTCPP_format='4'><BehaviorTree ID='§'><§ name='§' x='§'/></BehaviorTree></root>";
    let place = check(place, "t.xml", tree, &["import btcpp t.xml FORMAT"]);
    let calls = r#"{"calls": [{"primitive": "§", "then": {"fails": "§"}}], "§": 1}"#;
    let run = "run p.motet --scene kitchen --speed max";
    let place = check(place, "f.json", calls, &[&format!("{run} --faults f.json")]);
    let place = check(place, "a.json", r#"["§"]"#, &[&format!("{run} --answers a.json")]);
    let place = check(place, "s.json", r#"{"on(§, §)": true, "§": 1}"#, &[&format!("{run} --state s.json")]);
    let place = check(place, "l.json", r#"{"§": "§"}"#, &[&format!("{run} --profile l.json")]);
    let place = check(place, "k.json", r#"{"§": ["§"]}"#, &[&format!("{run} --world k.json")]);
    let domain = "action `§`(a: §)\nentity `§`: §\n";
    let place = check(place, "d.motet", domain, &["check p.motet --domain d.motet FORMAT"]);
    let exchange = "§ <user> § <robot> go to §, fly §, say §\n<vision> §\n<user> § <user>";
    let lines =
        ["dialog x.txt --robot hsr --scene kitchen", "dialog x.txt --robot hsr --scene kitchen --to json"];
    let place = check(place, "x.txt", exchange, &lines);
    let row =
        r#"{"messages": [{"role": "§", "content": "§"}], "motet": {"robot": "§", "scene": "§", "§": "§"}}"#;
    let lines = ["dataset lint r.jsonl", "dataset lint r.jsonl --format json --shares"];
    let place = check(place, "r.jsonl", row, &lines);
    let place = check(place, "scenes.jsonl", r#"{"name": "§", "scene": {"§": 1}}"#, &lines);
    for command in ["plan --goal", "feasible --for", "dialog --write", "prompt", "plan"] {
        let words = command.split(' ').map(str::to_owned);
        let text = soft("on(§, \u{1b}[2J§)");
        let world = ["--robot", "hsr", "--scene", "kitchen"].map(str::to_owned);
        is_clean(command, &place.run_args(&words.chain([text]).chain(world).collect::<Vec<_>>()));
    }
}

#[test]
fn journals_with_hostile_strings_are_shown_escaped() {
    let place =
        Place::new("hostile_journals").file("p.motet", "policy KEY for hsr { say(\"KEY\") fail \"KEY\" }\n");
    place.run("run p.motet --scene kitchen --speed max --record rec").check(3, &[]);
    let journal = place.read("rec/000000000000.journal");
    let short: String = journal.split_inclusive('\n').take(6).collect();
    let (mut place, mut shown) = (place, 0);
    let name = json("§");
    // The hash of the graph is told where it is wrong.
    place = place.file("wrong/000000000000.journal", forged(&journal, &[("KEY", &name)]));
    let told = place.run("replay wrong").stderr;
    let hashes: Vec<&str> = told.split("sha256:").skip(1).filter_map(|rest| rest.get(..64)).collect();
    let texts = [("KEY", name.as_str()), (hashes[1], hashes[0])];
    for (folder, text) in [("whole", &journal), ("short", &short)] {
        place = place.file(&format!("{folder}/000000000000.journal"), forged(text, &texts));
        for line in
            ["replay F", "replay F --at 3", "replay F --json --at 3", "view F -o page.html", "export mcap F"]
                .into_iter()
                .chain(["run --resume F --speed max", "run --resume F --format json"])
        {
            let line = line.replace('F', folder);
            let ran = place.run(&line);
            is_clean(&line, &ran);
            shown += usize::from(format!("{ran:?}").contains("202e"));
        }
    }
    assert!(shown > 2, "{shown}");
    assert!(!place.read("page.html").contains(['\u{1b}', '\u{9b}', '\u{202e}']));
}

#[test]
fn drivers_with_hostile_strings_are_shown_escaped() {
    if !has_python() {
        return;
    }
    let then = "\
        \x20   if m['method'] == 'start':\n\
        \x20       say({'id': m['id'], 'result': {}})\n\
        \x20       say({'method': 'feedback', 'params': {'goal': m['params']['goal'], 'text': X}})\n\
        \x20       say({'method': 'ended', 'params': {'goal': m['params']['goal'],\n\
        \x20           'outcome': {'failure': {'kind': X, 'text': X}}}})\n\
        \x20   elif 'id' in m:\n\
        \x20       say({'id': m['id'], 'error': {'code': 1, 'message': X}})\n\
        \x20       say({'method': X, 'params': {X: X}})\n";
    let script = odd(then).replace("'odd'", "X").replace("'x'", "X");
    let script = format!("X = {:?}\n{script}", "MARK");
    let script = script.replace("\"MARK\"", r"'x\x1b[2J\x9b\u202e\x00\ny'");
    let place = Place::new("hostile_drivers")
        .file("d.py", script)
        .file("p.motet", "policy p for hsr { go(counter) }\n");
    let mut shown = 0;
    for format in ["human", "json"] {
        for line in ["run p.motet --scene kitchen", "run --check --patience 1"] {
            let line = format!("{line} --format {format}");
            let args = line.split(' ').chain(["--driver", "python3 -u d.py"]).map(str::to_owned);
            let ran = place.run_args(&args.collect::<Vec<_>>());
            is_clean(&line, &ran);
            shown += usize::from(format!("{ran:?}").contains("202e"));
        }
    }
    assert!(shown > 2, "{shown}");
}
