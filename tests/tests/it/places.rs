//! Places and poses from the document to the simulated room: both syntaxes, the proofs, the motions and a
//! run.

use motet_compiler::Session;
use motet_compiler::fix::{FixLimits, fix};
use motet_runtime::{Engine, StartState, Time, run};
use motet_sim::{Sim, SimOptions};
use motet_syntax::ast::{File, Item};
use motet_syntax::{FileId, Severity, Source, Sources, Syntax, print, read};
use motet_tests::setup;

const TEXT: &str = "policy p {
    go_to_pose(pose(1.45 m, 0.35 m, 10 deg))
    inspect(mug_1)
    pick(mug_1)
    place(mug_1, kitchen_table, beside: apple)
    pick(mug_1)
    place_at(mug_1, kitchen_table, pose(1.95 m, 0.4 m, 0.77 m, 0 rad))
}
";

const JSON: &str = r#"{
  "motet": 1,
  "policy": "p",
  "steps": [
    {"do": "go_to_pose", "to": {"pose": [1.45, 0.35, "10 deg"]}},
    {"do": "inspect", "what": "mug_1"},
    {"do": "pick", "object": "mug_1"},
    {"do": "place", "object": "mug_1", "on": "kitchen_table", "beside": "apple"},
    {"do": "pick", "object": "mug_1"},
    {
      "do": "place_at",
      "object": "mug_1",
      "on": "kitchen_table",
      "at": {"pose": [1.95, 0.4, 0.77, 0]}
    }
  ]
}
"#;

fn session() -> Session {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0
}

fn said(session: &Session, document: &str) -> Vec<String> {
    let parsed = read(&Source::new("p", document), FileId(0));
    let said = session.check(&parsed).into_iter();
    said.map(|said| format!("{} {}: {}", said.code, said.message, said.help.unwrap_or_default())).collect()
}

#[test]
fn places_have_one_form_in_each_syntax() {
    let session = session();
    for document in [TEXT, JSON] {
        let parsed = read(&Source::new("p", document), FileId(0));
        let mut policy = parsed.file.policies().next().cloned().unwrap();
        motet_compiler::make_explicit(&mut policy, session.library(), Syntax::Json);
        assert_eq!(print::policy_json(&policy), JSON);
        motet_compiler::make_explicit(&mut policy, session.library(), Syntax::Text);
        let file = File { items: vec![Item::Policy(policy)] };
        assert_eq!(print::text(&file), TEXT);
    }
    // A list of numbers is a pose where one is asked for.
    let list = r#"{"motet": 1, "policy": "p", "steps": [{"do": "go_to_pose", "to": [1.2, 0.5, 0]}]}"#;
    let parsed = read(&Source::new("p", list), FileId(0));
    let mut policy = parsed.file.policies().next().cloned().unwrap();
    motet_compiler::make_explicit(&mut policy, session.library(), Syntax::Json);
    assert!(print::policy_json(&policy).contains(r#""to": {"pose": [1.2, 0.5, 0]}"#));
}

/// The pose decides what the robot serves: nothing is left to the run.
#[test]
fn places_are_proven_and_carried_out() {
    let session = session();
    let errors = said(&session, TEXT);
    assert!(errors.iter().all(|said| said.starts_with("M0505") && !said.contains("at(robot")), "{errors:#?}");
    let away = "policy p for hsr { go_to_pose(pose(0 m, 1.5 m, 0 deg)) open(drawer_1) }";
    let away = said(&session, away);
    assert!(
        away[0].starts_with("M0501 `open` needs `at(robot, drawer_1)`, which `go_to_pose` made"),
        "{away:?}"
    );
    let parsed = read(&Source::new("p", TEXT), FileId(0));
    let graph = session.compile(&parsed, None).graph.unwrap();
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let mut sim = Sim::new(&robot, &scene, SimOptions::default());
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let ending = run(&mut engine, &mut sim, &mut (), Time::ZERO);
    assert!(format!("{ending:?}").contains("Done"), "{ending:?}");
    let [x, y, _] = sim.position("mug_1").unwrap();
    assert!((x - 1.95).hypot(y - 0.4) < 1e-9, "{x} {y}");
}

/// What models write for a pose leads to the primitive that takes one.
#[test]
fn places_lead_to_the_primitive_that_takes_a_pose() {
    let session = session();
    for to in [r#"{"x": 1.2, "y": 0.5, "yaw": 0}"#, "[1.2, 0.5, 0]", r#"{"pose": [1.2, 0.5, 0]}"#] {
        let document = format!(r#"{{"motet": 1, "policy": "p", "steps": [{{"do": "go", "to": {to}}}]}}"#);
        let fixed = fix(&session, &Source::new("policy", document.as_str()), FileId(0), FixLimits::all(100));
        let said = said(&session, &document);
        assert!(said[0].starts_with("M0319") && said[0].contains("`go_to_pose` takes a pose"), "{said:?}");
        assert!(fixed.text.contains(r#"{"do": "go_to_pose", "to": "#), "{}", fixed.text);
        let errors = fixed.diagnostics.iter().filter(|said| said.severity == Severity::Error);
        assert_eq!(errors.count(), 0, "{}", fixed.text);
    }
}
