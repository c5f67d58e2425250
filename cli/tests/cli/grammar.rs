//! `motet grammar` and `motet grammar probe`, against a server on the loopback that obeys, and one that does
//! not.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Mutex};

use serde_json::Value;

use crate::support::Place;

#[test]
fn grammar_is_printed_in_each_notation() {
    let place = Place::new("grammar_formats");
    for (flags, begins) in [
        ("", "{\n  \"type\": \"object\""),
        ("--format gbnf", "root ::= "),
        ("--format gbnf --syntax text", "root ::= \"policy\""),
        ("--syntax text", "root ::= \"policy\""),
        ("--format lark", "start: "),
        ("--format lark --llguidance", "%llguidance {}"),
        ("--format regex-free-ebnf --modifiers --depth 1", "root = "),
        ("--request vllm --model m --ask hello", "{\"model\":\"m\",\"messages\":"),
        ("--request llamacpp --syntax text", "{\"model\":\"MODEL\",\"messages\":"),
    ] {
        let ran = place.run(&format!("grammar --robot hsr --scene kitchen {flags}"));
        assert_eq!(ran.code, Some(0), "{flags}: {}", ran.stderr);
        assert!(ran.stdout.starts_with(begins), "{flags}: {:.200}", ran.stdout);
        assert_eq!(ran.stderr, "", "{flags}");
    }
}

#[test]
fn grammar_reports_limits_of_servers() {
    let place = Place::new("grammar_limits");
    for flags in [
        "--format json-schema --syntax text",
        "--request ollama --syntax text",
        "--request openai --syntax text",
    ] {
        let ran = place.run(&format!("grammar --robot hsr {flags}"));
        assert_eq!(ran.code, Some(2), "{flags}");
        assert!(ran.stderr.contains("JSON Schema"), "{flags}: {}", ran.stderr);
    }
    let entities: Vec<String> = (0..1_100).map(|index| format!("thing_{index}")).collect();
    let place = place.file("many.motet", format!("entity {}: Object\n", entities.join(", ")));
    let ran = place.run("grammar --robot hsr --domain many.motet");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stderr.contains("values of enumerations; OpenAI takes 1000"), "{}", ran.stderr);
    assert!(ran.stderr.contains("Ollama"), "{}", ran.stderr);
    // Of the limits of others nothing is said to who asks one server.
    let ran = place.run("grammar --robot hsr --domain many.motet --request vllm");
    assert!(ran.code == Some(0) && !ran.stderr.contains("OpenAI takes"), "{}", ran.stderr);
    place.run("grammar --robot hsr --llguidance").check(2, &["err:needs `--format lark`"]);
}

/// A server that answers one request with a chat message; its address.
pub(crate) fn server(status: &'static str, message: &'static str) -> String {
    scripted(status, vec![message.to_owned()]).0
}

/// A server that answers one request after the other, each with a message; its address, and the bodies of
/// the requests.
pub(crate) fn scripted(status: &'static str, messages: Vec<String>) -> (String, Arc<Mutex<Vec<Value>>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}", listener.local_addr().unwrap());
    let heard = Arc::new(Mutex::new(Vec::new()));
    let bodies = Arc::clone(&heard);
    std::thread::spawn(move || {
        for message in messages {
            let (mut stream, _) = listener.accept().unwrap();
            bodies.lock().unwrap().push(request(&mut stream));
            let head = format!(
                "HTTP/1.1 {status}\r\nContent-Type: application/json\r\nContent-Length: {}\r\nConnection: \
                    close\r\n\r\n",
                message.len()
            );
            stream.write_all(head.as_bytes()).unwrap();
            stream.write_all(message.as_bytes()).unwrap();
        }
    });
    (address, heard)
}

/// The body of a request.
fn request(stream: &mut TcpStream) -> Value {
    let (mut request, mut buffer) = (Vec::new(), [0; 4096]);
    loop {
        let count = stream.read(&mut buffer).unwrap();
        request.extend_from_slice(&buffer[..count]);
        let text = String::from_utf8_lossy(&request);
        let Some((head, body)) = text.split_once("\r\n\r\n") else { continue };
        let length = head
            .lines()
            .find_map(|line| line.to_lowercase().strip_prefix("content-length: ").map(str::to_owned));
        if count == 0 || length.is_none_or(|length| body.len() >= length.trim().parse().unwrap()) {
            return serde_json::from_str(body).unwrap_or_default();
        }
    }
}

#[test]
fn probe_tells_a_server_that_obeys_from_one_that_does_not() {
    let place = Place::new("grammar_probe");
    let held = r#"{"choices": [{"message": {"role": "assistant", "content": "{\"probe\": \"held\"}"}}]}"#;
    let ran = place.run(&format!("grammar probe {} --dialect vllm", server("200 OK", held)));
    assert_eq!((ran.code, ran.stdout.contains("enforces the grammar")), (Some(0), true), "{}", ran.stderr);
    for (dialect, of_text) in [
        ("openai", r#"{"choices": [{"message": {"role": "assistant", "content": TEXT}}]}"#),
        ("mistralrs", r#"{"choices": [{"message": {"role": "assistant", "content": TEXT}}]}"#),
        (
            "openai-responses",
            r#"{"status": "completed", "output": [{"content": [{"type": "output_text", "text": TEXT}]}]}"#,
        ),
        ("anthropic", r#"{"type": "message", "content": [{"type": "text", "text": TEXT}]}"#),
        ("gemini", r#"{"candidates": [{"content": {"parts": [{"text": TEXT}]}, "finishReason": "STOP"}]}"#),
    ] {
        for (text, code, says) in
            [(r#""{\"probe\": \"held\"}""#, 0, "enforces the grammar"), (r#""free""#, 1, "answered `free`")]
        {
            let (address, _) = scripted("200 OK", vec![of_text.replace("TEXT", text)]);
            let ran = place.run(&format!("grammar probe {address} --dialect {dialect}"));
            assert!(
                ran.code == Some(code) && ran.stdout.contains(says),
                "{dialect}: {}{}",
                ran.stdout,
                ran.stderr
            );
        }
    }
    let free = r#"{"message": {"role": "assistant", "content": "free"}}"#;
    let ran = place.run(&format!("grammar probe {} --dialect ollama", server("200 OK", free)));
    assert_eq!(
        (ran.code, ran.stdout.contains("answered `free`")),
        (Some(1), true),
        "{}{}",
        ran.stdout,
        ran.stderr
    );
    // What may still become the answer tells nothing.
    let cut = r#"{"choices": [{"finish_reason": "length", "message": {"content": "{ \"prob"}}]}"#;
    place
        .run(&format!("grammar probe {} --dialect vllm", server("200 OK", cut)))
        .check(2, &["err:cut its answer off at `{ \"prob`"]);
    let ran = place
        .run(&format!("grammar probe {}/v1", server("400 Bad Request", r#"{"error": "no such field"}"#)));
    assert_eq!((ran.code, ran.stderr.contains("no such field")), (Some(2), true), "{}", ran.stderr);
}
