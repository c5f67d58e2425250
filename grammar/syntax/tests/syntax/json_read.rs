//! Reading typed JSON documents: what comes out, and what is said of mistakes.

use std::collections::BTreeMap;

use motet_syntax::json::{self, Fallible, Spanned};
use motet_syntax::{FileId, Source, read};
use schemars::JsonSchema;
use serde::Deserialize;

#[derive(Deserialize, JsonSchema, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
struct Scene {
    version: u32,
    #[serde(default)]
    name: Option<Spanned<String>>,
    #[serde(default)]
    things: Vec<Fallible<Thing>>,
    #[serde(default)]
    joints: BTreeMap<String, f64>,
}

#[derive(Deserialize, JsonSchema, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
struct Thing {
    id: String,
    #[serde(default)]
    shape: Option<Shape>,
    #[serde(default)]
    step: Option<Step>,
}

#[derive(Deserialize, JsonSchema, Debug, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Shape {
    Box([f64; 3]),
    Cylinder { radius: f64, height: f64 },
    Point,
}

#[derive(Deserialize, JsonSchema, Debug, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Step {
    Repeat(Repeat),
    If(If),
}

#[derive(Deserialize, JsonSchema, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
struct Repeat {
    repeat: u32,
    steps: Vec<String>,
}

#[derive(Deserialize, JsonSchema, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
struct If {
    r#if: bool,
}

/// Every diagnostic as `code path "text under the span": message (help)`.
fn findings(text: &str) -> Vec<String> {
    let source = Source::new("test.json", text);
    let (value, diagnostics) = json::read::<Scene>(&source, FileId(0));
    assert!(value.is_some() || !diagnostics.is_empty(), "nothing without an error");
    let line = |d: &motet_syntax::Diagnostic| {
        let help = d.help.as_deref().unwrap_or("-");
        format!("{} {} `{}`: {} ({help})", d.code, d.path, source.slice(d.span), d.message)
    };
    diagnostics.iter().map(line).collect()
}

fn check(text: &str, expected: &[&str]) {
    assert_eq!(findings(text), expected, "{text}");
}

#[test]
fn json_read_reads_a_whole_document() {
    let text = r#"{"version": 1, "name": "lab\n", "things": [
        {"id": "a", "shape": {"box": [1, 2.5, -3e0]}, "step": {"steps": ["x"], "repeat": 3.0}},
        {"id": "b", "shape": {"cylinder": {"radius": 1, "height": 2}}},
        {"id": "\ud83e\udd16", "shape": "point", "step": null}], "joints": {"a/b": 1}}"#;
    let source = Source::new("test.json", text);
    let (scene, diagnostics) = json::read::<Scene>(&source, FileId(3));
    assert_eq!(diagnostics, []);
    let scene = scene.unwrap();
    let name = scene.name.unwrap();
    assert_eq!(
        (name.value.as_str(), source.slice(name.span), name.span.file),
        ("lab\n", r#""lab\n""#, FileId(3))
    );
    let ids: Vec<_> = scene.things.iter().map(|thing| thing.0.as_ref().unwrap().id.as_str()).collect();
    assert_eq!(ids, ["a", "b", "🤖"]);
    let first = scene.things[0].0.as_ref().unwrap();
    assert_eq!(first.shape, Some(Shape::Box([1.0, 2.5, -3.0])));
    assert_eq!(first.step, Some(Step::Repeat(Repeat { repeat: 3, steps: vec!["x".into()] })));
    assert_eq!(scene.joints["a/b"], 1.0);
}

#[test]
fn lenient_element_does_not_hide_its_neighbours() {
    check(
        r#"{"version": 1, "things": [{"id": 5}, {"shape": "point"}, {"id": "x", "shap": 1},
            {"id": "y", "shape": {"bax": [1]}}]}"#,
        &[
            "M0106 /things/0/id `5`: expected a string, found the number `5` (write a string here)",
            "M0105 /things/1 `\"shape\"`: the key `id` is missing here (add `\"id\": …` to this object)",
            "M0103 /things/2/shap `\"shap\"`: unknown key `shap` (did you mean `shape`?)",
            "M0109 /things/3/shape `\"bax\"`: unknown key `bax` (did you mean `box`?)",
        ],
    );
}

#[test]
fn schema_check_names_wrong_types() {
    check(
        r#"{"version": -1}"#,
        &["M0107 /version `-1`: the number `-1` is out of range, expected a whole number from 0 \
             (write a whole number from 0)"],
    );
    check(
        r#"{"version": 1.5}"#,
        &["M0106 /version `1.5`: expected a whole number from 0, found the number `1.5` (write a \
             whole number from 0 here)"],
    );
    check(r#"[1]"#, &["M0106  `[1]`: expected an object, found an array (write an object here)"]);
    check(
        r#"{"version": 1, "things": [{"id": "a", "shape": {"box": [1, 2]}}]}"#,
        &["M0106 /things/0/shape/box `[1, 2]`: expected an array of 3 elements, found 2 (write an \
             array of 3 elements here)"],
    );
    check(
        r#"{"version": 1, "things": [{"id": "a", "shape": "pint"}]}"#,
        &["M0108 /things/0/shape `\"pint\"`: `pint` is not known here (did you mean `point`?)"],
    );
    check(
        r#"{"version": 1, "joints": {"a/~": "x"}}"#,
        &["M0106 /joints/a~1~0 `\"x\"`: expected a number, found the string `x` (write a number here)"],
    );
}

#[test]
fn schema_check_refuses_two_forms() {
    check(
        r#"{"version": 1, "things": [{"id": "a", "step": {"repeat": 1, "steps": [], "if": true}}]}"#,
        &["M0110 /things/0/step/if `\"if\"`: one object cannot be both `repeat` and `if` (write two \
             objects, one after the other or one in the other)"],
    );
}

#[test]
fn parser_reports_duplicate_keys_and_keeps_the_first() {
    check(
        r#"{"version": 1, "version": {"deep": [1]}}"#,
        &["M0104 /version `\"version\"`: the key `version` stands twice in one object (keep one of the two)"],
    );
    let many: Vec<String> = (0..40).map(|n| format!("\"j{n}\": {n}")).collect();
    check(
        &format!(r#"{{"version": 1, "joints": {{{}, "j3": 1, "\u006a39": 2, "last": 1}}}}"#, many.join(", ")),
        &[
            "M0104 /joints/j3 `\"j3\"`: the key `j3` stands twice in one object (keep one of the \
             two)",
            "M0104 /joints/j39 `\"\\u006a39\"`: the key `j39` stands twice in one object (keep one of \
             the two)",
        ],
    );
}

#[test]
fn parser_ends_strings_as_serde_json_does() {
    for before in 0..20 {
        for after in [0, 1, 7, 8, 9] {
            for mark in ["", "\\n", "\\\"", "é", "!", "#", "[", "]", "\u{7f}", "\u{1f}", "\n", " "] {
                let text = format!("\"{}{mark}{}\" ", "ab".repeat(before), "\u{80}".repeat(after));
                let source = Source::new("a.json", text.as_str());
                let (value, _) = json::read::<String>(&source, FileId(0));
                assert_eq!(value, serde_json::from_str(&text).ok(), "{text:?}");
            }
        }
    }
}

#[test]
fn parser_explains_broken_syntax() {
    let message = |text: &str| findings(text).join("\n");
    for (text, expected) in [
        ("", "M0115"),
        (" \n", "M0115"),
        ("\u{feff}{}", "expected a JSON value"),
        ("{\"version\": 1e999}", "M0107  `1e999`: the number `1e999` is out of range"),
        ("{\"version\": 1,}", "a comma stands before the closing bracket"),
        ("{\"version\": 1] ", "an object is closed by `]`"),
        ("{\"version\": 1", "the document ends inside an object (close it with `}`)"),
        ("{\"version\"", "the document ends inside an object"),
        ("{\"version\": [", "the document ends inside an array"),
        ("{'version': 1}", "expected a key in double quotes"),
        ("{version: 1}", "expected a key in double quotes"),
        ("{\"version\" 1}", "expected `:` after a key"),
        ("{\"version\": 1 \"x\": 2}", "expected `,` or `}` after a value"),
        ("{\"version\": None}", "`None` is not a JSON value (write `null`)"),
        ("{\"version\": 01}", "`01`: this is not a JSON number"),
        ("{\"version\": .5}", "expected a JSON value"),
        ("{\"version\": -}", "this is not a JSON number"),
        ("{\"version\": 1} x", "text follows the end"),
        ("{\"version\": \"a", "the string is not closed"),
        ("{\"version\": \"a\nb\"}", "the string is not closed"),
        ("{\"version\": \"a\u{0}b\"}", "control character U+0000"),
        ("\u{0}", "expected a JSON value"),
        ("{\"version\": \"\\x\"}", "`\\x`: unknown escape"),
        ("{\"version\": \"\\u12\"}", "unknown escape"),
        ("{\"version\": \"\\ud800\"}", "`\\ud800`: half of a surrogate pair"),
        ("{\"version\": \"\\ud800\\ud800\"}", "half of a surrogate pair"),
        ("{\"version\": \"\\", "unknown escape"),
    ] {
        assert!(message(text).contains(expected), "{text}: {}", message(text));
    }
}

#[test]
fn parser_limits_depth() {
    for text in ["[".repeat(100_000), "{\"a\":".repeat(100_000)] {
        assert!(findings(&text)[0].starts_with("M0111"), "{}", findings(&text)[0]);
    }
}

#[test]
fn conversion_accepts_a_comparison_in_one_object() {
    let flat = r#"{"motet": 1, "policy": "p", "steps": [
        {"wait": {"get": "distance", "to": "user", "is": "less", "than": 0.5}},
        {"wait": {"field": "mass", "of": "mug", "is": "at_least", "than": "1 kg"}}]}"#;
    let paired = r#"{"motet": 1, "policy": "p", "steps": [
        {"wait": {"less": [{"get": "distance", "to": "user"}, 0.5]}},
        {"wait": {"at_least": [{"field": "mass", "of": "mug"}, "1 kg"]}}]}"#;
    let [flat, paired] = [flat, paired].map(|text| read(&Source::new("test", text), FileId(0)));
    assert!(flat.diagnostics.is_empty(), "{:?}", flat.diagnostics);
    assert_eq!(flat.file, paired.file);
    let half =
        r#"{"motet": 1, "policy": "p", "steps": [{"wait": {"field": "mass", "of": "mug", "is": "less"}}]}"#;
    let half = read(&Source::new("test", half), FileId(0));
    assert_eq!(half.diagnostics[0].message, "the key `than` is missing here");
}
