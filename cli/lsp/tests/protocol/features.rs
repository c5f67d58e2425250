//! Questions of an editor about an open document.

use serde_json::{Value, json};

use crate::client::{Client, position};

const URI: &str = "file:///home/p.motet";
const TEXT: &str = "/// Fetches a mug.
policy fetch for hsr achieves at(mug_1, user) {
    say(\"\u{1f916}\") go(kitchen_table)
    let mug = detect(\"red mug\")
    sequence take {
        pick(mug)
    }
    go(user)
    handover(mug, user)
}
";

fn at(text: &str, of: &str) -> Value {
    json!({"textDocument": {"uri": URI}, "position": position(text, of)})
}

fn opened(text: &str) -> Client {
    let mut client = Client::new();
    client.open(URI, text);
    client.diagnostics(URI, 1);
    client
}

fn document() -> Value {
    json!({"textDocument": {"uri": URI}, "options": {"tabSize": 4, "insertSpaces": true}})
}

/// Text with edits of the protocol applied.
fn edited(text: &str, edits: &Value) -> String {
    let offset = |place: &Value| {
        let lines: Vec<&str> = text.split_inclusive('\n').collect();
        let line = usize::try_from(place["line"].as_u64().unwrap()).unwrap();
        let mut left = place["character"].as_u64().unwrap();
        let before: usize = lines.iter().take(line).map(|line| line.len()).sum();
        let inside = lines.get(line).map_or(0, |line| {
            let letters = line.chars().take_while(|letter| {
                let goes_on = left > 0;
                left = left.saturating_sub(letter.len_utf16() as u64);
                goes_on
            });
            letters.map(char::len_utf8).sum()
        });
        before + inside
    };
    let mut edits: Vec<_> = edits.as_array().unwrap().iter().collect();
    edits.sort_by_key(|edit| std::cmp::Reverse(offset(&edit["range"]["start"])));
    let mut text = text.to_owned();
    for edit in edits {
        let (start, end) = (offset(&edit["range"]["start"]), offset(&edit["range"]["end"]));
        text.replace_range(start..end, edit["newText"].as_str().unwrap());
    }
    text
}

#[test]
fn hover_shows_the_contract_and_the_facts() {
    let mut client = opened(TEXT);
    let found = client.request("textDocument/hover", at(TEXT, "handover"));
    let shown = found["contents"]["value"].as_str().unwrap();
    for part in ["action handover(", "**Known here**", "`holding(mug_1)` by `pick(mug)` in line 6"] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    assert_eq!(found["range"]["start"]["line"], 8);
    assert_eq!(client.request("textDocument/hover", at(TEXT, "\npolicy")), Value::Null);
    client.end();
}

#[test]
fn completion_offers_what_passes() {
    let text = "policy p for hsr {\n    say(\"\u{1f916}\")\n    go(kitchen_table)\n    pick()\n}\n";
    let mut client = opened(text);
    let found = client.request("textDocument/completion", at(text, ")\n}"));
    let labels: Vec<_> = found.as_array().unwrap().iter().map(|item| item["label"].clone()).collect();
    assert!(labels.contains(&json!("mug_1")) && !labels.contains(&json!("mug_2")), "{labels:?}");
    let edit = &found[0]["textEdit"];
    assert_eq!(edit["range"]["start"], position(text, ")\n}"));
    client.end();
}

#[test]
fn definitions_lead_to_the_document_and_the_library() {
    let mut client = opened(TEXT);
    let own = client.request("textDocument/definition", at(TEXT, "mug)\n    }"));
    assert_eq!((&own["uri"], &own["range"]["start"]), (&json!(URI), &position(TEXT, "mug = ")));
    for (name, file, text) in [
        ("pick", "stdlib/manipulation.motet", "pick"),
        ("mug_1", "kitchen.json", "mug_1"),
        ("hsr", "hsr/robot.toml", ""),
    ] {
        let found = client.request("textDocument/definition", at(TEXT, name));
        let uri = found["uri"].as_str().unwrap_or_else(|| panic!("{name}"));
        assert!(uri.ends_with(file), "{uri}");
        let line = usize::try_from(found["range"]["start"]["line"].as_u64().unwrap()).unwrap();
        let column = usize::try_from(found["range"]["start"]["character"].as_u64().unwrap()).unwrap();
        let content = std::fs::read_to_string(uri.strip_prefix("file://").unwrap()).unwrap();
        let line = content.lines().nth(line).unwrap();
        assert!(line.get(column..).unwrap().starts_with(text), "{line}");
    }
    client.end();
}

#[test]
fn references_and_highlights_are_the_same_names() {
    let mut client = opened(TEXT);
    client.open("file:///home/q.motet", "policy q for hsr { go(user) }");
    client.diagnostics("file:///home/q.motet", 1);
    let mut params = at(TEXT, "mug = ");
    params["context"] = json!({"includeDeclaration": true});
    assert_eq!(client.request("textDocument/references", params.clone()).as_array().unwrap().len(), 3);
    let mut params = at(TEXT, "user)\n    handover");
    params["context"] = json!({"includeDeclaration": false});
    let found = client.request("textDocument/references", params);
    let uris: Vec<_> = found.as_array().unwrap().iter().map(|place| place["uri"].clone()).collect();
    assert_eq!(uris.iter().filter(|uri| **uri == "file:///home/q.motet").count(), 1, "{uris:?}");
    assert_eq!(uris.iter().filter(|uri| **uri == URI).count(), 3, "{uris:?}");
    let found = client.request("textDocument/documentHighlight", at(TEXT, "mug)\n    }"));
    assert_eq!(found.as_array().unwrap().len(), 3);
    client.end();
}

#[test]
fn rename_changes_the_document() {
    let mut client = opened(TEXT);
    let prepared = client.request("textDocument/prepareRename", at(TEXT, "mug = "));
    assert_eq!(prepared["placeholder"], "mug");
    let mut params = at(TEXT, "mug = ");
    params["newName"] = json!("cup");
    let found = client.request("textDocument/rename", params.clone());
    let renamed = edited(TEXT, &found["changes"][URI]);
    assert_eq!(renamed.matches("cup").count(), 3, "{renamed}");
    params["newName"] = json!("user");
    assert_eq!(
        client.refused("textDocument/rename", params),
        (-32803, "there is a name `user` already".to_owned())
    );
    let refused = client.refused("textDocument/prepareRename", at(TEXT, "pick"));
    assert_eq!(refused.1, "`pick` is not declared in this document");
    client.end();
}

#[test]
fn formatting_changes_only_what_differs() {
    let text = "policy p {\n    say(\"\u{1f916}\")\n  go( sink )\n    say(\"x\")\n}\n";
    let mut client = opened(text);
    let edits = client.request("textDocument/formatting", document());
    assert_eq!(edited(text, &edits), "policy p {\n    say(\"\u{1f916}\")\n    go(sink)\n    say(\"x\")\n}\n");
    assert_eq!(edits[0]["range"]["start"]["line"], 2);
    assert_eq!(edits[0]["range"]["end"]["line"], 3);
    client.change(URI, 2, [4, 0, 4, 1], "");
    let refused = client.refused("textDocument/formatting", document());
    assert_eq!(refused.1, "a document with errors of syntax is not formatted");
    client.end();
}

#[test]
fn actions_fix_one_mistake_or_all() {
    let text = "policy p for hsr {\n    say(\"\u{1f916}\") sya(\"x\")\n    handover(mug_1, user)\n    \
        sya(\"y\")\n}\n";
    let mut client = opened(text);
    let place = position(text, "sya");
    let mut params = json!({
        "textDocument": {"uri": URI}, "range": {"start": place, "end": place}, "context": {"diagnostics": []},
    });
    let found = client.request("textDocument/codeAction", params.clone());
    let titles: Vec<_> = found.as_array().unwrap().iter().map(|action| action["title"].clone()).collect();
    assert_eq!(titles, ["Write `say`", "Fix all mistakes that have a safe fix"]);
    assert_eq!(
        (&found[0]["isPreferred"], &found[0]["diagnostics"][0]["code"]),
        (&json!(true), &json!("M0201"))
    );
    let fixed = edited(text, &found[0]["edit"]["changes"][URI]);
    assert_eq!(fixed.matches("sya").count(), 1, "{fixed}");
    params["context"]["only"] = json!(["source.fixAll"]);
    let all = client.request("textDocument/codeAction", params);
    assert_eq!(all.as_array().unwrap().len(), 1);
    let resolved = client.request("codeAction/resolve", all[0].clone());
    let fixed = edited(text, &resolved["edit"]["changes"][URI]);
    assert!(!fixed.contains("sya") && fixed.contains("pick(mug_1)"), "{fixed}");
    client.end();
}

#[test]
fn outline_folds_tokens_and_hints_have_their_places() {
    let mut client = opened(TEXT);
    let found = client.request("textDocument/documentSymbol", document());
    assert_eq!((&found[0]["name"], &found[0]["kind"]), (&json!("fetch"), &json!(12)));
    let children: Vec<_> =
        found[0]["children"].as_array().unwrap().iter().map(|child| child["name"].clone()).collect();
    assert_eq!(children, ["mug", "take"]);
    let folds = client.request("textDocument/foldingRange", document());
    assert_eq!((&folds[0]["startLine"], &folds[0]["endLine"]), (&json!(1), &json!(8)));
    let tokens = client.request("textDocument/semanticTokens/full", document());
    assert_eq!(tokens["data"].as_array().unwrap().len() % 5, 0);
    assert!(tokens["data"].as_array().unwrap().len() > 100);
    let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}});
    let hints =
        client.request("textDocument/inlayHint", json!({"textDocument": {"uri": URI}, "range": range}));
    let say = hints.as_array().unwrap().iter().find(|hint| hint["position"]["line"] == 2).unwrap();
    assert!(say["label"].as_str().unwrap().starts_with('\u{2713}'), "{say}");
    client.end();
}

#[test]
fn lenses_run_a_policy_and_show_its_motions() {
    let mut client = opened(TEXT);
    let lenses = client.request("textDocument/codeLens", document());
    let command = |index: usize| {
        let command = &lenses[index]["command"];
        json!({"command": command["command"], "arguments": command["arguments"]})
    };
    let run = client.request("workspace/executeCommand", command(0));
    let summary = run["summary"].as_str().unwrap();
    assert!(summary.starts_with("`fetch` in simulation: done after "), "{summary}");
    let shown = client.await_message(|message| message["method"] == "window/showMessage");
    assert_eq!(shown["params"]["message"], *summary);
    let feasible = client.request("workspace/executeCommand", command(1));
    let svg = std::fs::read_to_string(feasible["drawing"].as_str().unwrap()).unwrap();
    assert!(svg.starts_with("<svg"));
    assert!(feasible["from_start"][0].as_str().unwrap().contains("feasible"), "{feasible}");
    let unknown = json!({"command": "motet.fly", "arguments": []});
    assert_eq!(client.refused("workspace/executeCommand", unknown).1, "there is no command `motet.fly`");
    let missing = json!({"command": "motet.run", "arguments": [URI, "other"]});
    assert!(client.refused("workspace/executeCommand", missing).1.contains("there is no policy `other`"));
    client.end();
}

#[test]
fn command_that_is_cancelled_is_answered_once() {
    let mut client = opened(TEXT);
    let id = client
        .ask("workspace/executeCommand", json!({"command": "motet.feasible", "arguments": [URI, "fetch"]}));
    client.notify("$/cancelRequest", json!({"id": id}));
    let answer = client.await_answer(id);
    // It may have been done already.
    assert!(answer["error"]["code"] == -32800 || answer.get("result").is_some(), "{answer}");
    client.end();
}

#[test]
fn requests_about_unknown_documents_are_refused() {
    let mut client = Client::new();
    for method in
        ["textDocument/hover", "textDocument/formatting", "textDocument/rename", "textDocument/codeLens"]
    {
        let mut params = at(TEXT, "pick");
        params["newName"] = json!("x");
        params["options"] = json!({"tabSize": 4, "insertSpaces": true});
        assert_eq!(client.refused(method, params).1, format!("the document {URI} is not open"), "{method}");
    }
    assert_eq!(client.refused("textDocument/hover", json!({"position": 3})).0, -32602);
    client.end();
}
