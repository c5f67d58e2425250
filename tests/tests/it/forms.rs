//! Both forms of every example say the same: they give the same graph, and each can be turned into the
//! other and back.

use motet_compiler::{Session, make_explicit};
use motet_syntax::ast::{File, Item};
use motet_syntax::{Source, Sources, Syntax, print};
use motet_tests::examples::{examples, read};
use motet_tests::setup;
use proptest::prelude::*;

/// Session of the property below, which is built once.
static SESSION: std::sync::OnceLock<Session> = std::sync::OnceLock::new();

/// The graph of a document, as text.
fn graph(session: &Session, text: &str) -> String {
    let mut sources = Sources::default();
    let source = Source::new("example", text);
    let id = sources.add(source.clone());
    let compiled = session.compile(&motet_syntax::read(&source, id), None);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{text}\n{:#?}", compiled.diagnostics));
    motet_graph::encode(&graph)
}

/// The document in the other form, settled for it.
fn turned(session: &Session, text: &str, form: Syntax) -> String {
    let mut sources = Sources::default();
    let source = Source::new("example", text);
    let id = sources.add(source.clone());
    let File { mut items } = motet_syntax::read(&source, id).file;
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

#[test]
fn syntax_both_forms_of_an_example_are_one_policy() {
    for (path, robot, scene) in examples() {
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let mut sources = Sources::default();
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut sources);
        let (text, json) = (read(&path), read(&path.with_extension("json")));
        let expected = graph(&session, &text);
        assert_eq!(graph(&session, &json), expected, "{}", path.display());
        let as_json = turned(&session, &text, Syntax::Json);
        assert_eq!(as_json, json, "{}: the JSON form is that of the text", path.display());
        let back = turned(&session, &as_json, Syntax::Text);
        assert_eq!(graph(&session, &back), expected, "{}: there and back", path.display());
        assert_eq!(turned(&session, &back, Syntax::Json), json, "{}: there, back, and there", path.display());
    }
}

/// A document and its forms in both syntaxes are one policy, in whichever order they are written.
#[track_caller]
fn one_policy(session: &Session, document: &str) {
    let expected = graph(session, document);
    let json = turned(session, document, Syntax::Json);
    assert_eq!(graph(session, &json), expected, "{document}\n{json}");
    let text = turned(session, &json, Syntax::Text);
    assert_eq!(graph(session, &text), expected, "{document}\n{json}\n{text}");
    assert_eq!(turned(session, &text, Syntax::Json), json, "{text}");
    let settled = turned(session, document, Syntax::Text);
    assert_eq!(graph(session, &settled), expected, "{document}\n{settled}");
}

fn kitchen() -> Session {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0
}

#[test]
fn syntax_values_without_a_type_keep_their_meaning() {
    let session = kitchen();
    for steps in [
        "let x = 5 m  if distance(user) < x { home() }",
        "let x = 20 %  if battery() < x { home() }",
        "let x = 90 deg  turn(x)",
        "let x = distance(user)  if x > 1 m { home() }",
        "let x = distance(user)  let y = x  if y > 1 m { home() }",
        "let t = \"hello\"  say(t)",
        "let t = \"mug_1\"  say(t)",
        "let t = \"5 m\"  say(t)",
        "let t = \"$x\"  say(t)",
        "let t = \"I see {battery()} {{\"  say(t)",
        "let a = ask(\"Shall I?\")  if a == \"yes\" { home() }",
        "let a = ask(\"Shall I?\")  if \"yes\" == a { home() }",
        "if \"yes\" == \"mug_1\" { home() }",
        "let p = kitchen_table  go(p)",
        "let n = 3  say(\"{n}\")",
        "let ps = [kitchen_table, counter]  go(first(ps))",
        "let ts = [\"a\", \"mug_1\"]  say(first(ts))",
        "say(\"{distance(user) * 2} {battery() * 100}\")",
        "if distance(user) * 2 > 3 m { home() }",
        "if distance(user) / 2 + 0.5 m > 20 cm { home() }",
        "if battery() < 7 % { home() }",
        "let cans = detect_all(\"mug\")  if count(cans) * 2 > 3 { home() }",
        "let far = distance(user) - 1 m  if far > 50 cm { home() }",
    ] {
        one_policy(&session, &format!("policy p {{\n{steps}\n}}\n"));
    }
    let json = |steps: &str| format!(r#"{{"motet": 1, "policy": "p", "steps": [{steps}]}}"#);
    for steps in [
        r#"{"do": "ask", "question": "Shall I?", "as": "a"},
           {"if": {"equal": ["$a", "yes"]}, "then": [{"do": "home"}]}"#,
        r#"{"if": {"more": [{"multiply": [{"get": "distance", "to": "user"}, 2]}, 3]},
            "then": [{"do": "home"}]}"#,
        r#"{"let": "x", "be": {"get": "distance", "to": "user"}},
           {"if": {"more": ["$x", 1]}, "then": [{"do": "home"}]}"#,
        r#"{"let": "t", "be": {"literal": "hello"}}, {"do": "say", "text": "$t"}"#,
        r#"{"let": "t", "be": "hello there"}, {"do": "say", "text": "$t"}"#,
        r#"{"do": "say", "text": {"literal": "$5 {battery()}"}}"#,
        r#"{"let": "x", "be": "5 m"}, {"if": "distance(user) < x", "then": [{"do": "home"}]}"#,
    ] {
        one_policy(&session, &json(steps));
    }
}

/// A word that names nothing is a text only where the place says so.
#[test]
fn syntax_a_plain_word_without_a_type_is_a_name() {
    let session = kitchen();
    let json = r#"{"motet": 1, "policy": "p", "steps": [
        {"let": "t", "be": "hello"}, {"do": "say", "text": "$t"}]}"#;
    let parsed = motet_syntax::read(&Source::new("p.json", json), motet_syntax::FileId(0));
    let found = session.compile(&parsed, None).diagnostics;
    let said = &found[0];
    assert_eq!((said.code.0, said.message.as_str()), ("M0202", "unknown name `hello`"));
    assert_eq!(said.help.as_deref(), Some("write `{\"literal\": \"hello\"}` for a text"));
    let edit = &said.fix.as_ref().unwrap().edits[0];
    let mut mended = json.to_owned();
    mended.replace_range(edit.span.range(), &edit.text);
    one_policy(&session, &mended);
}

fn constant() -> impl Strategy<Value = (String, &'static str)> {
    let number = (0_i32..2000).prop_map(|value| f64::from(value) / 8.0);
    let text = prop::sample::select(vec!["hello", "mug_1", "5 m", "", "yes", "20 %", "{{", "robot", "any"]);
    prop_oneof![
        (number.clone(), prop::sample::select(vec!["m", "cm", "mm", "km"]))
            .prop_map(|(value, unit)| (format!("{value} {unit}"), "distance(user)")),
        number.prop_map(|value| (format!("{} %", value / 10.0), "battery()")),
        text.prop_map(|text| (format!("\"{text}\""), "heard")),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// Constants with names, comparisons and products with them are the same in both syntaxes.
    #[test]
    fn syntax_constants_and_products_round_trip(
        (value, other) in constant(),
        factor in 1_u8..20,
        op in prop::sample::select(vec!["*", "/"]),
        is_left in any::<bool>(),
    ) {
        let session = SESSION.get_or_init(kitchen);
        let heard = "let heard = ask(\"What?\")";
        let steps = if other == "heard" {
            let (left, right) = if is_left { (other, value.as_str()) } else { (value.as_str(), other) };
            format!("let c = {value} if heard == c {{ home() }} if {left} == {right} {{ home() }} say(c)")
        } else {
            format!(
                "let c = {value} let d = c {op} {factor} if {other} {op} {factor} > d {{ home() }}
                 if {other} < c {{ home() }} if {value} < {other} {{ home() }}
                 say(\"{{{other} {op} {factor}}} {{c}}\")"
            )
        };
        one_policy(session, &format!("policy p {{ {heard} {steps} }}"));
    }
}
