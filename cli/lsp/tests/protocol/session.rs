//! The session with a client: its order, its errors, and its end.

use std::fmt::Write as _;

use motet_lsp::ServerEnd;
use serde_json::{Value, json};

use crate::client::{Client, short};

const URI: &str = "file:///home/p.motet";

#[test]
fn requests_out_of_order_are_refused() {
    let mut client = Client::raw();
    assert_eq!(client.refused("textDocument/hover", json!({})).0, -32002);
    client.notify("textDocument/didOpen", json!({"nonsense": true}));
    let initialize = json!({"processId": null, "rootUri": null, "capabilities": {}});
    client.request("initialize", initialize.clone());
    assert_eq!(client.refused("initialize", initialize).0, -32600);
    assert_eq!(client.refused("initialize", json!(3)).0, -32600);
    assert_eq!(
        client.refused("motet/nonsense", json!({})),
        (-32601, "there is no request `motet/nonsense`".into())
    );
    assert_eq!(client.request("shutdown", Value::Null), Value::Null);
    assert_eq!(client.refused("textDocument/hover", json!({})).0, -32600);
}

#[test]
fn broken_messages_are_answered() {
    let mut client = Client::new();
    client.send_bytes(b"Content-Length: 5\r\n\r\n{\"id\"");
    let answer = client.await_message(|message| message.get("error").is_some());
    assert_eq!((&answer["id"], &answer["error"]["code"]), (&Value::Null, &json!(-32700)));
    client.send(&json!({"jsonrpc": "2.0", "id": "x"}));
    let answer = client.await_message(|message| message["id"] == "x");
    assert_eq!(answer["error"]["code"], -32600);
    client.send(&json!([1, 2]));
    let answer = client.await_message(|message| message.get("error").is_some());
    assert_eq!(answer["error"]["code"], -32600);
    client.open(URI, "policy p { sya(\"x\") }");
    assert_eq!(client.diagnostics(URI, 1).len(), 1, "the server goes on");
    client.end();
}

#[test]
fn lost_framing_ends_the_server_with_a_reason() {
    let mut client = Client::new();
    client.send_bytes(b"hello\r\n\r\n");
    let error = client.leave().unwrap_err();
    assert!(error.to_string().contains("cannot be told apart"), "{error}");
}

#[test]
fn client_that_leaves_ends_the_server() {
    assert_eq!(Client::new().leave().unwrap(), ServerEnd::Abrupt);
    let mut client = Client::raw();
    client.notify("exit", Value::Null);
    assert_eq!(client.leave().unwrap(), ServerEnd::Abrupt);
}

#[test]
fn server_ignores_unknown_messages() {
    let mut client = Client::new();
    client.notify("$/cancelRequest", json!({"id": "unknown"}));
    client.notify("$/setTrace", json!({"value": "off"}));
    client.notify("textDocument/didChange", json!({"textDocument": 3}));
    client.notify("textDocument/didClose", json!({"textDocument": {"uri": URI}}));
    client.change(URI, 2, [0, 0, 0, 0], "a document that is not open");
    client.send(&json!({"jsonrpc": "2.0", "id": 7, "result": null}));
    client.end();
}

#[test]
fn huge_document_is_refused_with_a_diagnostic() {
    let mut client = Client::new();
    let mut text = String::from("policy p {\n");
    while text.len() <= 16 * 1024 * 1024 {
        writeln!(text, "    say(\"{}\")", "x".repeat(100_000)).unwrap();
    }
    client.open(URI, &text);
    let found = client.diagnostics(URI, 1);
    assert_eq!(short(&found)[0].split(' ').next(), Some("M0112"), "{found:?}");
    client.end();
}
