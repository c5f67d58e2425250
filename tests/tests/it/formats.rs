//! Formats of diagnostics for machines, over documents that are wrong in many ways: `sarif` has the shape
//! that SARIF 2.1.0 asks for, `llm` is short and in a useful order, `github` escapes what the workflow
//! commands ask for.

use motet_compiler::Session;
use motet_syntax::{Diagnostic, Source, Sources, render};
use motet_tests::setup;
use serde_json::{Value, json};

const DOCUMENTS: [&str; 6] = [
    "policy p for hsr {\n    goo(kitchen_table)\n    wait until near(user) within 3\n    pick(mug_11)\n}\n",
    "policy p for hsr achieves on(mug_1, counter) {\n    go(user)\n    pick(mug_1)\n    handover(mug_1, \
     user)\n}\n",
    "policy p for hsr {\n    go(kitchen_table)\n    let pose = locate(mug_1)\n    go(kitchen_table)\n    \
     grasp(mug_1, pose)\n    done\n    say(\"x\")\n}\n",
    "policy p for hsr {\n    if near(user) {\n        go(user)\n        place(mug_1, counter)\n    } else \
     {\n        say(1)\n    }\n}\n",
    concat!(
        r#"{"motet": 1, "policy": "p", "robot": "hsr", "#,
        r#""steps": [{"do": "go", "too": "usr"}, {"do": "pick", "object": "$mug"}]}"#
    ),
    "{\"motet\": 1,",
];

/// What is said of each document, in a session of its own sources.
fn said(name: &str) -> Vec<(Vec<Diagnostic>, Sources)> {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let check = |text: &&str| {
        let mut sources = Sources::default();
        let source = Source::new(name, *text);
        let file = sources.add(source.clone());
        let (session, _): (Session, _) = setup::session(Some(&robot), Some(&scene), &mut sources);
        (session.check(&motet_syntax::read(&source, file)), sources)
    };
    DOCUMENTS.iter().map(check).collect()
}

/// The part of SARIF 2.1.0 (OASIS Standard, sections 3.13 to 3.57) that is written: each object with the
/// properties that the standard gives it and no other, and what it requires.
fn shape() -> Value {
    let object = |required: &[&str], properties: Value| {
        json!({"type": "object", "required": required,
        "properties": properties, "additionalProperties": false})
    };
    let message = object(&[], json!({"text": {"type": "string"}, "markdown": {"type": "string"}}));
    let number = |least: u32| json!({"type": "integer", "minimum": least});
    let region = object(
        &[],
        json!({
            "startLine": number(1), "startColumn": number(1), "endLine": number(1), "endColumn": number(1),
            "byteOffset": number(0), "byteLength": number(0),
        }),
    );
    let artifact = object(&["uri"], json!({"uri": {"type": "string", "pattern": "^[A-Za-z0-9/._~%-]*$"}}));
    let location = object(
        &["physicalLocation"],
        json!({
            "physicalLocation": object(&["artifactLocation"], json!({"artifactLocation": artifact,
                "region": region})),
            "logicalLocations": {"type": "array", "items": object(&[],
                json!({"fullyQualifiedName": {"type": "string"}, "kind": {"type": "string"}}))},
            "message": message,
        }),
    );
    let replacement = object(
        &["deletedRegion"],
        json!({"deletedRegion": region, "insertedContent": object(&[], json!({"text": {"type": "string"}}))}),
    );
    let change = object(
        &["artifactLocation", "replacements"],
        json!({"artifactLocation": artifact, "replacements": {"type": "array", "minItems": 1,
            "items": replacement}}),
    );
    let fix = object(
        &["artifactChanges"],
        json!({"description": message, "artifactChanges": {"type": "array", "minItems": 1, "items": change}}),
    );
    let result = object(
        &["message"],
        json!({
            "ruleId": {"type": "string"}, "ruleIndex": number(0), "level": {"enum": ["none", "note",
                "warning", "error"]},
            "message": {"type": "object", "required": ["text"]},
            "locations": {"type": "array", "items": location}, "relatedLocations": {"type": "array",
                "items": location},
            "fixes": {"type": "array", "uniqueItems": true, "items": fix},
        }),
    );
    let rule = object(
        &["id"],
        json!({"id": {"type": "string"}, "shortDescription": message, "help": {"type": "object",
            "required": ["text"]}}),
    );
    let driver = object(
        &["name"],
        json!({"name": {"type": "string"}, "version": {"type": "string"}, "rules": {"type": "array",
            "uniqueItems": true, "items": rule}}),
    );
    let run = object(
        &["tool"],
        json!({
            "tool": object(&["driver"], json!({"driver": driver})),
            "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
            "results": {"type": "array", "items": result},
        }),
    );
    object(
        &["version", "runs"],
        json!({"$schema": {"type": "string", "format": "uri"}, "version": {"const": "2.1.0"},
            "runs": {"type": "array", "items": run}}),
    )
}

#[test]
fn sarif_has_the_shape_of_the_standard() {
    let validator = jsonschema::validator_for(&shape()).unwrap();
    let help = |_: &str| Some(render::CodePage { title: "a title", markdown: "# A page" });
    let mut fixes = 0;
    for (diagnostics, sources) in said("a b/é.motet") {
        assert!(!diagnostics.is_empty());
        let log: Value = serde_json::from_str(&render::sarif(&diagnostics, &sources, &help)).unwrap();
        let errors: Vec<String> = validator.iter_errors(&log).map(|error| error.to_string()).collect();
        assert!(errors.is_empty(), "{errors:#?}\n{log:#}");
        let run = &log["runs"][0];
        for result in run["results"].as_array().unwrap() {
            let index = usize::try_from(result["ruleIndex"].as_u64().unwrap()).unwrap();
            assert_eq!(run["tool"]["driver"]["rules"][index]["id"], result["ruleId"]);
            fixes += usize::from(result.get("fixes").is_some());
        }
    }
    assert!(fixes >= 6, "{fixes}");
}

#[test]
fn sentences_for_a_model_are_short_and_in_order() {
    let texts: Vec<_> = said("p").iter().map(|(said, sources)| render::llm(said, sources)).collect();
    for line in texts.iter().flat_map(|text| text.lines()) {
        assert!(line.chars().count() <= render::MAX_CHARS, "{line}");
    }
    let expected = [
        "Step 1: there is no primitive or policy `goo`. Write `go`.\n\
         Step 2: `3` needs a unit: a `Duration` is expected. Write `3 s`.\n\
         Step 3: there is no `Object` `mug_11`. Write `mug_1`.\n",
        "Step 2: `pick` needs `at(robot, mug_1) or at(robot, kitchen_table)`, which `go(user)` made false. \
         Insert `go(mug_1)` before this step.\n\
         The policy ends without `on(mug_1, counter)`, which `handover(mug_1, user)` made false. \
         Add `pick(mug_1)`, `go(counter)`, `place(mug_1, counter)` at the end.\n\
         Warning: Step 1: `go` moves to `user` while no monitor watches the distance. \
         Put `monitor when distance(user) < 0.5 m for 200 ms then pause during { … }` around it.\n",
    ];
    assert_eq!(texts.get(..2).unwrap(), expected);
}

#[test]
fn workflow_commands_are_escaped() {
    for (diagnostics, sources) in said("a,b:c%\n.motet") {
        let text = render::github(&diagnostics, &sources);
        assert_eq!(text.lines().count(), diagnostics.len(), "{text}");
        for line in text.lines() {
            let (properties, message) = line.strip_prefix("::").unwrap().split_once("::").unwrap();
            assert!(properties.contains("file=a%2Cb%3Ac%25%0A.motet,"), "{properties}");
            assert!(
                !message.contains('%') || message.contains("%25") || message.contains("%0A"),
                "{message}"
            );
        }
    }
}
