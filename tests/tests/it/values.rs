//! Texts with values, terms on lists and names for values, from the document to what the robot says.

use motet_runtime::{Effect, Engine, Observer, StartState, Time, run};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{FileId, Source, Sources, Syntax, print, read};
use motet_tests::setup;

const TEXT: &str = "policy p {
    let cans = detect_all(\"mug\")
    let n = count(cans)
    let goal = kitchen_table
    let best = first(cans)
    say(\"I see {n} at {goal}: {cans}; {{{best}}} at {best.mass}\")
}
";

const JSON: &str = r#"{
  "motet": 1,
  "policy": "p",
  "steps": [
    {"do": "detect_all", "what": "mug", "as": "cans"},
    {"let": "n", "be": {"get": "count", "of": "$cans"}},
    {"let": "goal", "be": "kitchen_table"},
    {"let": "best", "be": {"get": "first", "of": "$cans"}},
    {"do": "say", "text": "I see {n} at {goal}: {cans}; {{{best}}} at {best.mass}"}
  ]
}
"#;

/// Listener to a run: the words that the robot says, in order.
#[derive(Default)]
pub(crate) struct Transcript(pub(crate) Vec<String>);

impl Observer for Transcript {
    fn effect(&mut self, _now: Time, effect: &Effect) {
        if let Effect::Start { command, .. } = effect
            && let ("say", Some(motet_graph::Value::Text(text))) = (&*command.primitive, command.arg("text"))
        {
            self.0.push(text.to_string());
        }
    }
}

#[test]
fn values_have_one_form_in_each_syntax() {
    let session =
        setup::session(Some(&setup::robot("hsr")), Some(&setup::scene("kitchen")), &mut Sources::default());
    for document in [TEXT, JSON] {
        let mut policy =
            read(&Source::new("p", document), FileId(0)).file.policies().next().cloned().unwrap();
        motet_compiler::make_explicit(&mut policy, session.0.library(), Syntax::Json);
        assert_eq!(print::policy_json(&policy), JSON);
        motet_compiler::make_explicit(&mut policy, session.0.library(), Syntax::Text);
        let read = read(&Source::new("p.json", print::policy_json(&policy)), FileId(0));
        assert!(read.diagnostics.is_empty(), "{:?}", read.diagnostics);
    }
}

#[test]
fn values_are_said_as_people_do() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let compiled = session.compile(&read(&Source::new("p.json", JSON), FileId(0)), None);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let graph = motet_graph::decode(&motet_graph::encode(&graph)).unwrap();
    let mut sim = Sim::new(&robot, &scene, SimOptions::default());
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut said = Transcript::default();
    run(&mut engine, &mut sim, &mut said, Time::ZERO);
    insta::assert_snapshot!(said.0.join("\n"));
}

#[test]
fn values_that_double_in_the_run_end_the_policy() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let play = |levels: usize| {
        let lets = (1..levels).map(|at| format!("let x{at} = \"{{x{}}}{{x{}}}\"", at - 1, at - 1));
        let lets = lets.collect::<Vec<_>>().join(" ");
        let policy = format!("policy p {{ let x0 = ask(\"Why?\") {lets} say(\"done\") }}");
        let compiled = session.compile(&read(&Source::new("p", policy), FileId(0)), None);
        let graph = compiled.graph.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
        let mut sim = Sim::new(&robot, &scene, SimOptions::default());
        let mut engine = Engine::new(graph, &StartState::default()).unwrap();
        let mut said = Transcript::default();
        run(&mut engine, &mut sim, &mut said, Time::ZERO);
        said.0
    };
    assert_eq!(play(8), ["done"]);
    assert_eq!(play(60), Vec::<String>::new());
}

#[test]
fn values_that_are_none_have_a_place() {
    let json = r#"{"motet": 1, "policy": "p", "steps": [{"do": "say", "text": "an {open brace"}]}"#;
    let parsed = read(&Source::new("p.json", json), FileId(0));
    let [found] = parsed.diagnostics.as_slice() else { panic!("{:?}", parsed.diagnostics) };
    assert_eq!((found.code.0, found.path.as_str()), ("M0123", "/steps/0/text"));
    assert_eq!(&json[found.span.start as usize..found.span.end as usize], "{");
    assert_eq!(found.fix.as_ref().unwrap().edits[0].text, "{{");
}

/// One place stands for a list of it; the motion of a search is that to its first place.
#[test]
fn values_one_value_stands_for_a_list() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let graph = |document: &str| {
        let parsed = read(&Source::new("p", document), FileId(0));
        let compiled = session.compile(&parsed, None);
        compiled.graph.unwrap_or_else(|| panic!("{document}: {:#?}", compiled.diagnostics))
    };
    let json = |around: &str| {
        let step = format!(r#"{{"do": "search", "what": "bottle", "around": {around}, "as": "it"}}"#);
        let pick = r#"{"do": "inspect", "what": "$it"}"#;
        graph(&format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}, {pick}]}}"#))
    };
    let text =
        |around: &str| graph(&format!("policy p {{ let it = search(\"bottle\", {around}) inspect(it) }}"));
    let entity = |id: &str| motet_graph::Term::Literal(motet_graph::Value::Entity(id.into()));
    let one = json(r#""counter""#);
    for other in [json(r#"["counter"]"#), text("counter"), text("[counter]")] {
        assert_eq!(one, other);
    }
    let two = json(r#"["counter", "shelf"]"#);
    assert_eq!(two, text("[counter, shelf]"));
    assert_ne!(one, two);
    for graph in [one, two] {
        let motet_graph::NodeKind::Call(call) = &graph.nodes[0].kind else { panic!("{graph:?}") };
        assert_eq!(call.motion.as_ref().unwrap().args, [entity("counter")]);
    }
}
