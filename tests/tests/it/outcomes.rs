//! Outcomes of policies, from the document to the end of a run: failures that a handler names, results, and
//! goals that are observed.

use motet_compiler::{Session, make_explicit};
use motet_graph::Value;
use motet_runtime::{Engine, RunEnd, StartState, Time, run};
use motet_sim::{Faults, Sim, SimOptions};
use motet_syntax::{FileId, Source, Sources, Syntax, print, read};
use motet_tests::setup;

use crate::values::Transcript;

fn session() -> Session {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0
}

/// The end of the last policy of a document in the kitchen, and what the robot says on the way.
fn play(document: &str, faults: &str) -> (RunEnd, Vec<String>) {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let parsed = read(&Source::new("p", document), FileId(0));
    let name = parsed.file.policies().last().map(|policy| policy.name.text.clone());
    let compiled = session().compile(&parsed, name.as_deref());
    let graph = compiled.graph.unwrap_or_else(|| panic!("{document}: {:#?}", compiled.diagnostics));
    let graph = motet_graph::decode(&motet_graph::encode(&graph)).unwrap();
    let faults = Faults::from_json(faults).unwrap();
    let mut sim = Sim::new(&robot, &scene, SimOptions { faults, ..SimOptions::default() });
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut said = Transcript::default();
    let end = run(&mut engine, &mut sim, &mut said, Time::ZERO);
    (end, said.0)
}

fn done(result: Option<Value>) -> RunEnd {
    RunEnd::Done { why: None, result }
}

const FAILURE_TEXT: &str = r#"policy p -> Text {
    try {
        go(counter)
    } catch blocked, unreachable as e {
        if e.kind == blocked {
            say("Blocked: {e}.")
        } else {
            say("{e.kind}: {e.text}.")
        }
        done e.text
    }
    done "none"
}
"#;

const FAILURE_JSON: &str = r#"{
  "motet": 1,
  "policy": "p",
  "result": "Text",
  "steps": [
    {
      "try": [{"do": "go", "to": "counter"}],
      "catch": [
        {
          "on": ["blocked", "unreachable"],
          "as": "e",
          "steps": [
            {
              "if": {"equal": [{"field": "kind", "of": "$e"}, "blocked"]},
              "then": [{"do": "say", "text": "Blocked: {e}."}],
              "else": [{"do": "say", "text": "{e.kind}: {e.text}."}]
            },
            {"end": "done", "result": {"field": "text", "of": "$e"}}
          ]
        }
      ]
    },
    {"end": "done", "result": "none"}
  ]
}
"#;

#[test]
fn outcomes_have_one_form_in_each_syntax() {
    let session = session();
    for document in [FAILURE_TEXT, FAILURE_JSON] {
        let mut policy =
            read(&Source::new("p", document), FileId(0)).file.policies().next().cloned().unwrap();
        make_explicit(&mut policy, session.library(), Syntax::Json);
        assert_eq!(print::policy_json(&policy), FAILURE_JSON);
        make_explicit(&mut policy, session.library(), Syntax::Text);
        let file = motet_syntax::ast::File { items: vec![motet_syntax::ast::Item::Policy(policy)] };
        assert_eq!(print::text(&file), FAILURE_TEXT);
    }
}

#[test]
fn outcomes_failure_says_what_the_driver_said_or_else_what_it_means() {
    for (fails, said) in [
        (r#""blocked""#, "Blocked: something is in the way."),
        (r#"{"kind": "blocked", "text": "a chair stands there"}"#, "Blocked: a chair stands there."),
        (r#""unreachable""#, "unreachable: no motion leads there."),
    ] {
        let text = said.split_once(": ").unwrap().1.trim_end_matches('.');
        let result = Some(Value::Text(text.into()));
        for how in ["fails", "refuses"] {
            let faults =
                format!(r#"{{"calls": [{{"primitive": "go", "nth": 1, "then": {{"{how}": {fails}}}}}]}}"#);
            for document in [FAILURE_TEXT, FAILURE_JSON] {
                let expected = (done(result.clone()), vec![said.to_owned()]);
                assert_eq!(play(document, &faults), expected, "{faults}");
            }
        }
    }
    assert_eq!(play(FAILURE_TEXT, "{}"), (done(Some(Value::Text("none".into()))), Vec::new()));
    let string = FAILURE_JSON
        .replace(r#"{"equal": [{"field": "kind", "of": "$e"}, "blocked"]}"#, r#""e.kind == blocked""#);
    let object = FAILURE_JSON.replace(
        r#"{"equal": [{"field": "kind", "of": "$e"}, "blocked"]}"#,
        r#"{"field": "kind", "of": "$e", "is": "equal", "than": "blocked"}"#,
    );
    let faults = r#"{"calls": [{"primitive": "go", "nth": 1, "then": {"fails": "blocked"}}]}"#;
    for document in [string, object] {
        assert_eq!(play(&document, faults).1, ["Blocked: something is in the way."], "{document}");
    }
}

#[test]
fn outcomes_failure_of_a_policy_and_of_a_deadline_have_texts_too() {
    let document = r#"
policy gives_up {
    fail "the drawer is stuck"
}
policy p {
    try {
        gives_up()
    } catch failed as e {
        say("It failed: {e}.")
    }
    try {
        within 1 s {
            wait 5 s
        }
    } catch timeout as e {
        say("{e.kind}: {e}.")
    }
    try {
        repeat 2 {
            say("?")
        } until holding(any)
    } catch any as e {
        say("{e.kind}: {e}.")
    }
}
"#;
    let (end, said) = play(document, "{}");
    let expected = [
        "It failed: the drawer is stuck.",
        "timeout: it took too long.",
        "?",
        "?",
        "exhausted: a bounded loop ran out.",
    ];
    assert_eq!((end, said), (done(None), expected.map(str::to_owned).to_vec()));
}

#[test]
fn outcomes_result_is_what_the_way_of_the_run_gave() {
    let document = r#"
policy find(first: Text, second: Text) -> Object {
    go(kitchen_table)
    try {
        let it = detect(first)
        done it
    } catch not_found, ambiguous, timeout {
        let it = detect(second)
        done it
    }
}
policy p -> Object {
    let one = find("red mug", "apple")
    let other = find("unicorn", "apple")
    say("{one} and {other}")
    if one == other {
        fail "they are the same"
    }
    done other
}
"#;
    let faults = r#"{"calls": [{"primitive": "detect", "nth": 2, "then": {"fails": "not_found"}}]}"#;
    let (end, said) = play(document, faults);
    assert_eq!(end, done(Some(Value::Entity("apple".into()))), "{said:?}");
    assert_eq!(said, ["red mug and green apple"]);
}

#[test]
fn outcomes_standard_policy_gives_what_it_brought() {
    let document =
        "policy p {\n    let mug = fetch(\"red mug\", user, kitchen_table)\n    say(\"{mug}\")\n}\n";
    assert_eq!(play(document, "{}"), (done(None), vec!["red mug".to_owned()]));
}

#[test]
fn outcomes_goal_that_is_seen_to_be_false_fails_the_run() {
    let document = "policy p achieves at(mug_1, counter) {
    go(kitchen_table)
    inspect(mug_1)
    pick(mug_1)
    go(counter)
    place(mug_1, counter)
    wait 5 s
}
";
    assert_eq!(play(document, "{}").0, done(None));
    let faults = |at: f64| {
        let what = r#"{"moves": {"object": "mug_1", "to": {"surface": "shelf"}}}"#;
        format!(r#"{{"world": [{{"at": {at}, "what": {what}}}]}}"#)
    };
    // Somebody takes the mug away just before the end.
    let ends = (40..80).map(|half| play(document, &faults(f64::from(half) / 2.0)).0);
    let failed = ends.filter(|end| match end {
        RunEnd::Failed { kind, why: Some(why), .. } => {
            let seen = "the goal does not hold: `at(mug_1, counter)` was observed to be false";
            kind == "failed" && why == seen
        }
        _ => false,
    });
    assert!(failed.count() > 3);
}

#[test]
fn tests_of_what_cannot_change_agree_however_they_are_written() {
    let declared = "enum Mode { slow, fast, off }\nfluent ready()\n\
                    perception all(what: Text) -> List<Object>\nperception which() -> Mode\n\
                    action prepare()\n    makes ready()\naction start_it()\n    \
                    needs ready()\ninitially not ready()\n";
    for (body, is_right) in [
        ("if n >= 2 { prepare() } if count(xs) >= 2 { start_it() }", true),
        ("if count(xs) <= 3 { prepare() } if n < 4 { start_it() }", true),
        ("if n == 0 { prepare() } if is_empty(xs) { start_it() }", true),
        ("if n == 2 { prepare() } if count(xs) > 1 { if n < 3 { start_it() } }", true),
        ("if n == 2 { prepare() } if count(xs) > 1 { if n < 4 { start_it() } }", false),
        ("if n >= 2 { prepare() } if count(xs) >= 1 { start_it() }", false),
        ("if m == slow { prepare() } else if m == fast { prepare() } if m != off { start_it() }", true),
        ("if m == slow or m == fast { prepare() } if m != off { start_it() }", true),
        ("if m == slow { prepare() } if m != off { start_it() }", false),
        ("if m == slow { prepare() } else if m == fast { prepare() } if m == off { start_it() }", false),
    ] {
        let bound = "let xs = all(\"mug\") let n = count(xs) let m = which()";
        let text = format!("{declared}policy p {{ {bound} {body} }}");
        let (session, _) = setup::session(None, None, &mut Sources::default());
        let compiled = session.compile(&read(&Source::new("p", text), FileId(0)), None);
        assert_eq!(compiled.graph.is_some(), is_right, "{body}: {:#?}", compiled.diagnostics);
    }
}
