//! Diagnostics of open documents.

use crate::client::{Client, folder, short};

const URI: &str = "file:///home/p.motet";

#[test]
fn diagnostics_follow_the_edits() {
    let mut client = Client::new();
    client.open(URI, "policy p for hsr {\n    sya(\"hello\")\n    say(\"you\")\n}\n");
    let found = client.diagnostics(URI, 1);
    assert_eq!(short(&found), ["M0201 1:4-1:7"]);
    assert_eq!(found[0]["severity"], 1);
    assert_eq!(found[0]["source"], "motet");
    assert_eq!(found[0]["message"], "there is no primitive or policy `sya`\nhelp: did you mean `say`?");
    client.change(URI, 2, [1, 4, 1, 7], "say");
    assert_eq!(short(&client.diagnostics(URI, 2)), [""; 0]);
    client.change(URI, 3, [2, 0, 2, 0], "    handover(mug_1, user)\n");
    let found = client.diagnostics(URI, 3);
    assert_eq!(short(&found), ["M0501 2:4-2:25", "M0501 2:4-2:25"], "in no hand, and not at the user");
    client.end();
}

#[test]
fn diagnostics_have_utf16_columns_and_related_places() {
    let mut client = Client::new();
    let text = "policy p for hsr {\n    say(\"\u{1f916}\u{10ffff}\") sya(\"x\")\n    go(kitchen_table)\n    \
        pick(mug_1)\n    place(mug_1, kitchen_table)\n    handover(mug_1, user)\n}\n";
    client.open(URI, text);
    let found = client.diagnostics(URI, 1);
    let unknown = found.iter().find(|found| found["code"] == "M0201").unwrap();
    assert_eq!(short(std::slice::from_ref(unknown)), ["M0201 1:16-1:19"], "two units for each");
    client.change(URI, 2, [1, 16, 1, 19], "say");
    let found = client.diagnostics(URI, 2);
    let related = &found[0]["relatedInformation"][0];
    assert_eq!(found[0]["code"], "M0501", "{found:?}");
    assert_eq!(related["location"]["uri"], URI);
    assert_eq!(related["location"]["range"]["start"]["line"], 4, "{related}");
    client.end();
}

#[test]
fn diagnostics_of_json_have_their_places() {
    let mut client = Client::new();
    let uri = "file:///home/p.json";
    client.open(
        uri,
        "{\"motet\": 1, \"policy\": \"p\",\n \"steps\": [{\"do\": \"sya\", \"text\": \"\u{1f916}\"}]}\n",
    );
    assert_eq!(short(&client.diagnostics(uri, 1)), ["M0201 1:18-1:23"]);
    client.end();
}

#[test]
fn settings_of_the_folder_are_read_again() {
    let folder = folder("settings");
    let uri = format!("file://{}/p.motet", folder.display());
    let text = "policy p {\n    go(mug_1)\n}\n";
    let mut client = Client::new();
    std::fs::write(folder.join("motet.toml"), "robot = \"hsr\"\nscene = \"lab\"\ngeometry = false\n")
        .unwrap();
    client.open(&uri, text);
    assert_eq!(short(&client.diagnostics(&uri, 1)), ["M0202 1:7-1:12"], "the lab has no mug");
    std::fs::write(folder.join("motet.toml"), "robot = \"hsr\"\nscene = \"kitchen\"\ngeometry = false\n")
        .unwrap();
    client.notify("workspace/didChangeWatchedFiles", serde_json::json!({"changes": []}));
    assert_eq!(short(&client.diagnostics(&uri, 1)), [""; 0]);
    std::fs::write(folder.join("motet.toml"), "robot = \"hsr\"\nscene = 3\n").unwrap();
    client.notify("workspace/didChangeWatchedFiles", serde_json::json!({"changes": []}));
    let found = client.diagnostics(&uri, 1);
    let message = found[0]["message"].as_str().unwrap();
    assert!(message.contains("motet.toml") && message.contains("line 2"), "{message}");
    client.end();
}

#[test]
fn closed_document_has_no_diagnostics() {
    let mut client = Client::new();
    client.open(URI, "policy p { sya(\"x\") }");
    assert_eq!(client.diagnostics(URI, 1).len(), 1);
    client.notify("textDocument/didClose", serde_json::json!({"textDocument": {"uri": URI}}));
    let published = client.await_message(|message| message["method"] == "textDocument/publishDiagnostics");
    assert_eq!(published["params"]["diagnostics"].as_array().unwrap().len(), 0);
    client.end();
}

#[test]
fn only_the_newest_version_counts() {
    let mut client = Client::new();
    client.open(URI, "policy p {\n}\n");
    for version in 2..200 {
        client.change(URI, version, [1, 0, 1, 0], "    say(\"x\")\n");
    }
    client.change(URI, 200, [1, 0, 1, 0], "    sya(\"x\")\n");
    let found = client.diagnostics(URI, 200);
    assert_eq!(short(&found), ["M0201 1:4-1:7"]);
    client.end();
}

#[test]
fn domain_is_checked_beside_the_other_domains() {
    let folder = folder("domain");
    let settings = "robot = \"hsr\"\nscene = \"kitchen\"\ngeometry = false\ndomains = [\"lamp.motet\"]\n";
    std::fs::write(folder.join("motet.toml"), settings).unwrap();
    let domain = "entity lamp: Object\n";
    std::fs::write(folder.join("lamp.motet"), domain).unwrap();
    let mut client = Client::new();
    let uri = |name: &str| format!("file://{}/{name}", folder.display());
    client.open(&uri("lamp.motet"), domain);
    assert_eq!(short(&client.diagnostics(&uri("lamp.motet"), 1)), [""; 0], "it declares no name twice");
    client.open(&uri("p.motet"), "policy p {\n    go(lamp)\n    go(lampe)\n}\n");
    let found = client.diagnostics(&uri("p.motet"), 1);
    assert_eq!(short(&found), ["M0202 2:7-2:12"]);
    client.end();
}
