//! `motet check --fix`: single repairs in both forms, and that a mended document never checks worse.

use motet_compiler::Session;
use motet_compiler::fix::{Applicability, FixLimits, FixedDocument, fix};
use motet_eval::mutations::{self, Mutant, MutantEnd};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources};
use motet_tests::generate::policy_of;
use motet_tests::setup;
use proptest::prelude::*;

fn session() -> Session {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let mut sources = Sources::default();
    sources.add(Source::new("policy", ""));
    setup::session(Some(&robot), Some(&scene), &mut sources).0
}

/// The document's own; those of the library come after it.
const FILE: FileId = FileId(0);

fn mend(session: &Session, text: &str) -> FixedDocument {
    fix(session, &Source::new("policy", text), FILE, FixLimits::all(100))
}

fn errors(said: &[Diagnostic]) -> usize {
    said.iter().filter(|said| said.severity == Severity::Error).count()
}

/// Both policies are bodies: of the text form, or the steps of the JSON form.
fn check(session: &Session, body: &str, expected: &str) {
    let whole = |body: &str| {
        if body.trim_start().starts_with('[') {
            format!("{{\"motet\": 1, \"policy\": \"p\", \"robot\": \"hsr\", \"steps\": {body}}}")
        } else {
            format!("policy p for hsr {{\n{body}}}\n")
        }
    };
    let fixed = mend(session, &whole(body));
    assert_eq!(fixed.text, whole(expected), "{:#?}", fixed.diagnostics);
    assert_eq!(errors(&fixed.diagnostics), 0);
}

#[test]
fn fix_names_and_units_are_mended() {
    let session = session();
    check(&session, "    goo(user)\n", "    go(user)\n");
    check(&session, "    go(usr)\n", "    go(user)\n");
    check(&session, "    go(too: user)\n", "    go(to: user)\n");
    check(&session, "    wait until near(user) within 3\n", "    wait until near(user) within 3 s\n");
    check(&session, r#"[{"do": "goo", "to": "user"}]"#, r#"[{"do": "go", "to": "user"}]"#);
    check(&session, r#"[{"do": "go", "too": "user"}]"#, r#"[{"do": "go", "to": "user"}]"#);
    check(&session, r#"[{"do": "go", "to": "usr"}]"#, r#"[{"do": "go", "to": "user"}]"#);
}

#[test]
fn fix_missing_steps_are_inserted() {
    let session = session();
    check(
        &session,
        "    go(drawer_1)\n    let mug = detect(\"red mug\")\n    pick(mug)\n",
        // It is left in the hand: nobody named a place for it.
        "    go(drawer_1)\n    let mug = detect(\"red mug\")\n    go(mug)\n    pick(mug)\n",
    );
    check(
        &session,
        "[\n  {\"do\": \"go\", \"to\": \"user\"},\n  {\"do\": \"open\", \"what\": \"drawer_1\"}\n]",
        "[\n  {\"do\": \"go\", \"to\": \"user\"},\n  {\"do\": \"go\", \"to\": \"drawer_1\"},\n  {\"do\": \
         \"open\", \"what\": \"drawer_1\"},\n  {\"do\": \"close\", \"what\": \"drawer_1\"}\n]",
    );
    // A full hand cannot open the drawer: it is opened before.
    let fixed = mend(
        &session,
        "policy p for hsr {\n    go(kitchen_table)\n    pick(mug_1)\n    go(drawer_1)\n    place(mug_1, \
         drawer_1)\n}\n",
    );
    assert_eq!(errors(&fixed.diagnostics), 0, "{}\n{:#?}", fixed.text, fixed.diagnostics);
}

#[test]
fn fix_what_is_stale_is_perceived_again_and_what_is_dead_left_out() {
    let session = session();
    check(
        &session,
        "    go(kitchen_table)\n    let mug = detect(\"red mug\")\n    let pose = locate(mug)\n    \
         go(counter)\n    go(kitchen_table)\n    grasp(mug, pose)\n",
        "    go(kitchen_table)\n    let mug = detect(\"red mug\")\n    go(counter)\n    go(kitchen_table)\n\
         \x20   let pose = locate(mug)\n    grasp(mug, pose)\n    place(mug, kitchen_table)\n",
    );
    // Where it is used elsewhere too, it is perceived twice.
    let first = "    go(kitchen_table)\n    let pose = locate(mug_1)\n    grasp(mug_1, pose)\n    \
        place(mug_1, kitchen_table)\n    go(counter)\n    go(kitchen_table)\n";
    check(
        &session,
        &format!("{first}    grasp(mug_1, pose)\n"),
        &format!(
            "{first}    let pose_2 = locate(mug_1)\n    grasp(mug_1, pose_2)\n    place(mug_1, \
             kitchen_table)\n"
        ),
    );
    check(&session, "    go(user)\n    done\n    say(\"x\")\n    go(user)\n", "    go(user)\n    done\n");
    check(
        &session,
        r#"[{"do": "go", "to": "user"}, {"end": "done"}, {"do": "say", "text": "x"}]"#,
        r#"[{"do": "go", "to": "user"}, {"end": "done"}]"#,
    );
    check(
        &session,
        "    go(kitchen_table)\n    pick(mug_1)\n    pick(mug_1)\n",
        "    go(kitchen_table)\n    pick(mug_1)\n    place(mug_1, kitchen_table)\n",
    );
}

/// Safe fixes leave a body as it is; all fixes make of it the other one.
fn check_unsafe(session: &Session, body: &str, expected: &str) {
    let whole = |body: &str| format!("policy p for hsr {{\n{body}}}\n");
    let source = Source::new("policy", whole(body));
    let safe = fix(session, &source, FILE, FixLimits::safe(100));
    assert_eq!(safe.text, whole(body), "{:#?}", safe.applied);
    assert_eq!(mend(session, &whole(body)).text, whole(expected));
}

#[test]
fn fix_steps_are_taken_away_on_request_and_only_if_they_are_right() {
    let session = session();
    let dead = "    go(user)\n    done\n    say(\"x\")\n";
    check_unsafe(&session, dead, "    go(user)\n    done\n");
    // What cannot be read has no place of its own, and an error is not mended by its removal.
    let unread = "    done\n    fast\n";
    check_unsafe(&session, unread, unread);
    let wrong = "    done\n    say(\"{foo}\")\n    say(\"b\")\n";
    check_unsafe(&session, wrong, wrong);
}

#[test]
fn fix_cleanup_tests_what_holds_on_some_ways_only() {
    let session = session();
    let body = |put: &str| {
        format!(
            "    sequence a {{\n        go(kitchen_table)\n        inspect(mug_1)\n \
                    pick(mug_1)\n        \
             cannot \"no\"\n    }} finally {{\n        {put}\n    }}\n"
        )
    };
    let put = "place(mug_1, kitchen_table)";
    let fixed = mend(&session, &format!("policy p for hsr {{\n{}}}\n", body(put)));
    let titles: Vec<_> = fixed.applied.iter().map(|fix| fix.title.as_str()).collect();
    assert_eq!(errors(&fixed.diagnostics), 0, "{}\n{:#?}", fixed.text, fixed.diagnostics);
    assert!(titles[0].starts_with("test it first: `if holding(mug_1)"), "{titles:?}");
    assert!(fixed.text.contains("if holding(mug_1)"), "{}", fixed.text);
}

/// What comes of a body has no errors, and these words in it.
fn check_has(session: &Session, body: &str, words: &str) {
    let policy = if body.starts_with('[') {
        format!("{{\"motet\": 1, \"policy\": \"p\", \"robot\": \"hsr\", \"steps\": {body}}}")
    } else {
        format!("policy p for hsr {{\n{body}}}\n")
    };
    let fixed = mend(session, &policy);
    assert!(fixed.text.contains(words), "{words} in {}\n{:#?}", fixed.text, fixed.diagnostics);
    assert_eq!(errors(&fixed.diagnostics), 0, "{:#?}", fixed.diagnostics);
}

#[test]
fn fix_what_is_named_otherwise_is_written_as_it_is_called() {
    let session = session();
    let steps = r#"[{"do": "go", "to": "kitchen_table"}, {"do": "pick", "object": "$mug_1"}]"#;
    check_has(&session, steps, r#""object": "mug_1""#);
    let steps = r#"[{"do": "go", "to": "user"}, {"do": "go", "where": "counter"}]"#;
    check_has(&session, steps, r#"{"do": "go", "to": "counter"}"#);
}

#[test]
fn fix_what_the_end_lacks_is_done_before_it() {
    let session = session();
    let held = "    go(kitchen_table)\n    pick(mug_1)\n    done\n";
    check_has(&session, held, "    place(mug_1, kitchen_table)\n    done\n");
    let left = "    go(drawer_1)\n    open(drawer_1)\n    done\n";
    check_has(&session, left, "    close(drawer_1)\n    done\n");
}

#[test]
fn fix_what_is_right_stays_as_it_is() {
    let session = session();
    let text = policy_of(40);
    let fixed = mend(&session, &text);
    assert_eq!((fixed.text, fixed.applied), (text, Vec::new()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Steps left out, doubled, swapped, or with a letter too many in a name.
    #[test]
    fn fix_mended_document_never_checks_worse(
        steps in 4_usize..24,
        changes in proptest::collection::vec((0_usize..30, 0_u8..4), 1..4),
    ) {
        let session = session();
        let mut policy: serde_json::Value = serde_json::from_str(&policy_of(steps)).unwrap();
        let body = policy["steps"].as_array_mut().unwrap();
        for (at, how) in changes {
            let at = at % body.len();
            match how {
                0 if body.len() > 1 => { body.remove(at); }
                1 => { let copy = body[at].clone(); body.insert(at, copy); }
                2 => { let other = (at + 1) % body.len(); body.swap(at, other); }
                _ => if let Some(name) = body[at].get_mut("do") {
                    *name = format!("{}x", name.as_str().unwrap()).into();
                },
            }
        }
        let text = serde_json::to_string_pretty(&policy).unwrap();
        let before = session.check(&motet_syntax::read(&Source::new("policy", text.as_str()), FILE));
        let fixed = mend(&session, &text);
        let after = session.check(&motet_syntax::read(&Source::new("policy", fixed.text.as_str()), FILE));
        prop_assert_eq!(&after, &fixed.diagnostics);
        prop_assert!(errors(&after) <= errors(&before));
        let is_shorter = after.len() < before.len() || errors(&after) < errors(&before);
        prop_assert!(fixed.applied.is_empty() || is_shorter);
        for said in &after {
            // A lint may have a word on a step that mends an error.
            let is_lint = said.severity != Severity::Error && errors(&after) < errors(&before);
            let is_known = is_lint || before.iter().any(|known| known.code == said.code);
            prop_assert!(is_known, "{said:?}\n{}", fixed.text);
        }
        prop_assert!(serde_json::from_str::<serde_json::Value>(&fixed.text).is_ok(), "{}", fixed.text);
    }
}

#[test]
fn fix_what_nobody_named_is_not_written() {
    let session = session();
    for body in ["handover(mug_1)", "handover(mug_1, counter)"] {
        let text = format!(
            "policy p for hsr {{\n    go(kitchen_table)\n    pick(mug_1)\n    go(counter)\n    {body}\n}}\n"
        );
        let fixed = mend(&session, &text);
        assert!(!fixed.text.contains("user"), "{}", fixed.text);
        assert!(errors(&fixed.diagnostics) > 0, "{}", fixed.text);
    }
}

#[test]
fn fix_safe_fixes_take_nothing_away_and_undo_nothing() {
    let session = session();
    let safe = |body: &str| {
        let text = format!("policy p for hsr {{\n{body}}}\n");
        let fixed = fix(&session, &Source::new("policy", text.as_str()), FILE, FixLimits::safe(100));
        (fixed.text == text, fixed.applied)
    };
    for body in [
        "    go(kitchen_table)\n    pick(mug_1)\n    done\n",
        "    go(drawer_1)\n    open(drawer_1)\n    done\n",
        "    go(kitchen_table)\n    pick(mug_1)\n    go(user)\n    handover(mug_1)\n",
    ] {
        assert_eq!(safe(body), (true, Vec::new()), "{body}");
    }
    let (_, applied) = safe("    pick(mug_1)\n");
    assert!(applied.iter().all(|fix| fix.applicability == Applicability::Safe), "{applied:?}");
    assert_eq!(applied.len(), 1, "{applied:?}");
}

#[test]
fn fix_proven_goal_stays_proven() {
    let mut sources = Sources::default();
    sources.add(Source::new("policy", ""));
    let session = Session::builder().build(&mut sources);
    let text = |light: &str| {
        format!(
            "fluent lit(what: Entity)\nfluent warm(what: Entity)\ninitially not lit(user)\n\
             action heat(what: Entity) makes warm(what)\naction read(what: Entity) needs lit(what)\n\
             action light(what: Entity) makes lit(what){light}\n\
             policy p achieves warm(user) {{\n    heat(user)\n    read(user)\n}}\n"
        )
    };
    let mended = mend(&session, &text(""));
    assert!(mended.text.contains("heat(user)\n    light(user)\n    read(user)"), "{}", mended.text);
    // This light may cool the user, so it is lit before.
    let mended = mend(&session, &text(" unsettles warm(what)"));
    assert!(mended.text.contains("light(user)\n    heat(user)\n    read(user)"), "{}", mended.text);
}

#[test]
fn fix_what_safe_fixes_write_runs() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let mut mended = Vec::new();
    for mutant in mutations::mutants(&folder).unwrap() {
        let (robot, scene) = (setup::robot(&mutant.robot), setup::scene(&mutant.scene));
        let mut sources = Sources::default();
        sources.add(Source::new("policy", ""));
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut sources);
        let source = Source::new("policy", mutant.text.as_str());
        let fixed = fix(&session, &source, FILE, FixLimits::safe(20));
        if !fixed.applied.is_empty() && errors(&fixed.diagnostics) == 0 {
            let titles: Vec<_> = fixed.applied.iter().map(|fix| fix.title.as_str()).collect();
            let name = format!("{} ({})", mutant.name, titles.join("; "));
            mended.push(Mutant { name, text: fixed.text, ..mutant });
        }
    }
    assert!(mended.len() > 20, "{}", mended.len());
    let ends = mutations::judge(motet_eval::Workers::default(), mended, 0).unwrap();
    let failed: Vec<_> = ends
        .iter()
        .filter(|(_, end)| matches!(end, MutantEnd::Unlisted(_)))
        .map(|(mutant, end)| (&mutant.name, end))
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
}
