//! Names that several ways bind: what the compiler says, what both syntaxes mean, and what a run does.

use motet_compiler::{Session, make_explicit};
use motet_graph::{Ending, NodeKind};
use motet_runtime::{Driver, Engine, RunEnd, StartState, Time, run};
use motet_sim::{Faults, Sim, SimOptions};
use motet_syntax::ast::{File, Item};
use motet_syntax::{Severity, Source, Sources, Syntax, print};
use motet_tests::setup;

fn session() -> Session {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0
}

/// The graph of a document that has no error.
fn graph(session: &Session, text: &str) -> motet_graph::Graph {
    let parsed = motet_syntax::read(&Source::new("p", text), Default::default());
    let compiled = session.compile(&parsed, None);
    compiled.graph.unwrap_or_else(|| panic!("{text}\n{:#?}", compiled.diagnostics))
}

/// The document in a syntax.
fn turned(session: &Session, text: &str, form: Syntax) -> String {
    let File { mut items } = motet_syntax::read(&Source::new("p", text), Default::default()).file;
    for item in &mut items {
        if let Item::Policy(policy) = item {
            make_explicit(policy, session.library(), form);
        }
    }
    let file = File { items };
    match form {
        Syntax::Text => print::text(&file),
        Syntax::Json => file.policies().map(print::policy_json).collect(),
    }
}

/// A run in the kitchen that has ended.
struct Ended {
    end: RunEnd,
    sim: Sim,
    /// The names that are bound, and their values.
    bound: Vec<(String, String)>,
}

fn runs(text: &str, faults: &str) -> Ended {
    let (robot, scene, session) = (setup::robot("hsr"), setup::scene("kitchen"), session());
    let faults = Faults::from_json(faults).unwrap();
    let mut sim = Sim::new(&robot, &scene, SimOptions { faults, ..SimOptions::default() });
    let engine = Engine::new(graph(&session, text), &StartState::default()).unwrap();
    let mut engine = engine.with_capabilities(sim.capabilities());
    let end = run(&mut engine, &mut sim, &mut (), Time::ZERO);
    let bound = engine.snapshot().bindings.into_iter();
    let bound = bound.map(|(name, value)| (name.to_string(), value.to_string())).collect();
    Ended { end, sim, bound }
}

/// A policy that finds a mug in the body of a `try` or in its handler, and takes it away.
const TAKES_A_MUG: &str = r#"policy takes_a_mug for hsr {
    go(kitchen_table)
    try {
        let mug = detect("red mug")
    } catch not_found {
        go(shelf)
        let mug = detect("blue mug")
    }
    pick(mug)
    go(sink)
    place(mug, sink)
}
"#;

/// The same, with conditions as strings.
const TAKES_A_MUG_IN_JSON: &str = r#"{"motet": 1, "policy": "takes_a_mug", "robot": "hsr", "steps": [
    {"do": "go", "to": "kitchen_table"},
    {"try": [{"do": "detect", "what": "red mug", "as": "mug"}],
     "catch": [{"on": ["not_found"], "steps": [
        {"do": "go", "to": "shelf"},
        {"do": "detect", "what": "blue mug", "as": "mug"}]}]},
    {"do": "pick", "object": "$mug"},
    {"monitor": [{"when": "not holding($mug)", "then": {"end": "replan", "why": "I lost it"}}],
     "during": [{"do": "go", "to": "sink"}]},
    {"if": "holding($mug) and not on($mug, sink)", "then": [
        {"do": "place", "object": "$mug", "on": "sink"}]}
]}"#;

/// The first `detect` of a run finds nothing.
const FINDS_NOTHING: &str =
    r#"{"calls": [{"primitive": "detect", "nth": 1, "then": {"fails": "not_found"}}]}"#;

#[test]
fn scope_name_is_what_the_way_of_the_run_found() {
    for text in [TAKES_A_MUG, TAKES_A_MUG_IN_JSON] {
        for (faults, expected) in [("{}", "mug_1"), (FINDS_NOTHING, "mug_2")] {
            let run = runs(text, faults);
            assert!(matches!(run.end, RunEnd::Done { .. }), "{:?}", run.end);
            assert_eq!(run.bound, [("mug".to_owned(), expected.to_owned())]);
            assert_eq!(run.sim.holds("on", &[expected, "sink"]), Some(true));
        }
    }
}

#[test]
fn scope_names_have_one_slot_in_the_graph() {
    let session = session();
    let graph = graph(&session, TAKES_A_MUG);
    let names: Vec<_> = graph.bindings.iter().map(|binding| binding.name.as_str()).collect();
    assert_eq!(names, ["mug"]);
    let json = turned(&session, TAKES_A_MUG, Syntax::Json);
    assert_eq!(motet_graph::encode(&self::graph(&session, &json)), motet_graph::encode(&graph));
    assert_eq!(turned(&session, &json, Syntax::Text), TAKES_A_MUG);
}

#[test]
fn scope_names_behind_other_blocks_run() {
    let text = r#"policy tidy for hsr {
    go(kitchen_table)
    sequence look {
        let red = detect("red mug")
    }
    repeat 2 {
        let fruit = detect("green apple")
    } until visible(fruit)
    parallel {
        {
            let glass = locate(red)
        }
        {
            say("I look around.")
        }
    }
    monitor when distance(user) < 0.1 m then pause during {
        let dish = detect("dinner plate")
    }
    grasp(red, at: glass)
    say("I have it.")
    inspect(fruit)
    inspect(dish)
}
"#;
    let run = runs(text, "{}");
    assert!(matches!(run.end, RunEnd::Done { .. }), "{:?}", run.end);
    let bound: Vec<_> = run.bound.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(bound, ["red", "fruit", "glass", "dish"]);
}

/// A branch that is proven never to be taken is not lowered: a run that takes it all the same must not go on
/// without the name.
#[test]
fn scope_branch_that_is_never_taken_ends_the_run() {
    let text = r#"policy sure for hsr {
    go(kitchen_table)
    if at(robot, kitchen_table) {
        let mug = detect("red mug")
    } else {
        let mug = detect("blue mug")
    }
    inspect(mug)
}
"#;
    let session = session();
    let graph = graph(&session, text);
    let refusal =
        graph.nodes.iter().find(|node| node.path == "/steps/1/else/0").expect("a node in its place");
    assert!(matches!(&refusal.kind, NodeKind::End { how: Ending::Fail, why: Some(_), .. }), "{refusal:?}");
    let run = runs(text, "{}");
    assert!(matches!(run.end, RunEnd::Done { .. }), "{:?}", run.end);
}

fn errors(text: &str) -> Vec<String> {
    let said = session().check(&motet_syntax::read(&Source::new("p", text), Default::default()));
    let errors = said.iter().filter(|said| said.severity == Severity::Error);
    errors
        .map(|said| {
            let related = said.related.iter().filter_map(|other| other.span);
            let related: Vec<_> = related.map(|span| &text[span.range()]).collect();
            let help = said.help.as_deref().unwrap_or("");
            format!("{} `{}`: {}; {help} {related:?}", said.code, &text[said.span.range()], said.message)
        })
        .collect()
}

#[test]
fn diagnostics_unbound_name_tells_the_path_and_what_to_write() {
    let text = r#"policy p for hsr {
    go(kitchen_table)
    try {
        let mug = detect("red mug")
    } catch not_found, ambiguous {
        say("I see none.")
    } catch any {
        replan "I saw nothing"
    }
    pick(mug)
    place(mug, kitchen_table)
}
"#;
    let expected = "M0216 `mug`: `mug` is not bound on the path through `catch not_found, ambiguous`; \
                    bind `mug` there too, or end that path with `done`, `replan`, `cannot` or `fail` \
                    [\"mug\", \"say(\\\"I see none.\\\")\"]";
    assert_eq!(errors(text), [expected]);
    let json = turned(&session(), text, Syntax::Json);
    let found = errors(&json);
    assert!(found.len() == 1 && found[0].starts_with("M0216 `\"$mug\"`: `mug` is not bound"), "{found:?}");
}

#[test]
fn scope_failure_hides_a_name_only_in_its_handler() {
    let text = "policy p for hsr {\n    go(kitchen_table)\n    within 10 s { let mug = detect(\"red mug\") \
                }\n    try { say(\"ready\") } catch any as mug { say(mug.text) }\n    pick(mug)\n}\n";
    assert_eq!(errors(text), [""; 0]);
}

#[test]
fn conditions_read_bindings_with_and_without_their_sign() {
    let session = session();
    let text = |condition: &str| {
        format!(
            "policy p for hsr {{\n    go(kitchen_table)\n    let mug = detect(\"red mug\")\n    \
             if {condition} {{\n        pick(mug)\n    }}\n}}\n"
        )
    };
    let json = |condition: &str| {
        format!(
            r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{{"do": "go", "to": "kitchen_table"}},
            {{"do": "detect", "what": "red mug", "as": "mug"}},
            {{"if": "{condition}", "then": [{{"do": "pick", "object": "$mug"}}]}}]}}"#
        )
    };
    for (plain, signed) in [
        ("not holding(mug)", "not holding($mug)"),
        ("holding(mug) or mug.mass < 1 kg", "holding($mug) or $mug.mass < 1 kg"),
        ("visible(mug)", "visible($`mug`)"),
        ("mug == apple", "$mug == apple"),
    ] {
        let expected = motet_graph::encode(&graph(&session, &text(plain)));
        for document in [text(signed), json(plain), json(signed)] {
            assert_eq!(motet_graph::encode(&graph(&session, &document)), expected, "{document}");
        }
        // One spelling is written in each syntax.
        assert_eq!(motet_syntax::format(&Source::new("p", text(signed))).unwrap(), text(plain));
        assert_eq!(turned(&session, &json(signed), Syntax::Text), text(plain));
        assert_eq!(
            turned(&session, &text(signed), Syntax::Json),
            turned(&session, &json(plain), Syntax::Json)
        );
    }
    let unknown = "M0203 `$cup`: nothing is bound to `cup` here; ";
    for document in [text("holding($cup)"), json("holding($cup)")] {
        let found = errors(&document);
        assert!(found.len() == 1 && found[0].starts_with(unknown), "{document}\n{found:?}");
    }
    // An entity is no binding.
    let found = errors(&json("visible($apple)"));
    assert!(found.len() == 1 && found[0].starts_with("M0203 `$apple`: "), "{found:?}");
}
