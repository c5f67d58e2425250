//! `motet serve` over the loopback, in front of a scripted server.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};
use std::sync::{Arc, Mutex};

use serde_json::{Value, json};

use crate::grammar::scripted;
use crate::support::eventually;

/// A running `motet serve`. It ends when it is dropped.
struct Endpoint {
    child: Child,
    address: String,
}

/// An answer.
#[derive(Debug)]
struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// The text of an error.
    fn message(&self) -> String {
        self.json()["error"]["message"].as_str().unwrap_or_default().to_owned()
    }

    /// Events of a stream, without signs of life.
    fn events(&self) -> Vec<Value> {
        let body = unchunked(&self.body);
        let data = body.split("\n\n").filter_map(|event| event.strip_prefix("data: "));
        data.filter(|data| *data != "[DONE]").map(|data| serde_json::from_str(data).unwrap()).collect()
    }
}

/// Text of a body in chunks.
fn unchunked(body: &str) -> String {
    let (mut rest, mut text) = (body, String::new());
    while let Some((size, more)) = rest.split_once("\r\n") {
        let size = usize::from_str_radix(size.trim(), 16).unwrap_or(0);
        if size == 0 {
            break;
        }
        text.push_str(&more[..size]);
        rest = &more[size + 2..];
    }
    text
}

impl Endpoint {
    /// Starts it in front of a server.
    fn new(server: &str, flags: &str, variables: &[(&str, &str)]) -> Self {
        let line = format!(
            "serve --planner {server} --model m --robot hsr --scene kitchen --no-geometry \
             --listen 127.0.0.1:0 {flags}"
        );
        let mut child = Command::new(env!("CARGO_BIN_EXE_motet"))
            .args(line.split_whitespace())
            .envs(variables.iter().copied())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut first = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        let address = first.trim().strip_prefix("listening on http://").unwrap_or_default();
        let address = address.strip_suffix("/v1").unwrap_or_else(|| panic!("{first}")).to_owned();
        Self { child, address }
    }

    /// Sends a request with a head of these lines.
    fn send(&self, method: &str, path: &str, head: &str, body: &str) -> Answer {
        let host = if head.contains("Host:") { String::new() } else { format!("Host: {}\r\n", self.address) };
        let length = match head.contains("Content-Length:") {
            true => String::new(),
            false => format!("Content-Length: {}\r\n", body.len()),
        };
        let request =
            format!("{method} {path} HTTP/1.1\r\n{host}Connection: close\r\n{length}{head}\r\n{body}");
        let mut stream = TcpStream::connect(&self.address).unwrap();
        // One that refuses the head may not read the body.
        let _ = stream.write_all(request.as_bytes());
        let mut answer = String::new();
        let _ = stream.read_to_string(&mut answer);
        let (head, body) = answer.split_once("\r\n\r\n").unwrap_or_else(|| panic!("{answer:?}"));
        let status = head.split_whitespace().nth(1).and_then(|status| status.parse().ok()).unwrap();
        Answer { status, head: head.to_lowercase(), body: body.to_owned() }
    }

    /// Asks for a chat completion.
    fn chat(&self, body: &Value) -> Answer {
        self.send("POST", "/v1/chat/completions", JSON, &body.to_string())
    }

    /// Asks for a request in words.
    fn ask(&self, text: &str) -> Answer {
        self.chat(&json!({"model": "m", "messages": [{"role": "user", "content": text}]}))
    }
}

impl Drop for Endpoint {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

const JSON: &str = "Content-Type: application/json\r\n";
const GOOD: &str = "policy go_there for hsr {\n    go(counter)\n}\n";
const BAD: &str = "policy put_it for hsr {\n    place(mug_1, shelf)\n}\n";

/// A reply of the scripted server.
fn says(text: &str) -> String {
    json!({
        "choices": [{"message": {"role": "assistant", "content": text}, "finish_reason": "stop"}],
        "usage": {"prompt_tokens": 100, "completion_tokens": 10, "total_tokens": 110},
    })
    .to_string()
}

/// An endpoint in front of a server that says these one after the other, and the bodies of its requests.
fn endpoint(replies: &[&str], flags: &str) -> (Endpoint, Arc<Mutex<Vec<Value>>>) {
    let (url, heard) = scripted("200 OK", replies.iter().map(|text| says(text)).collect());
    (Endpoint::new(&url, flags, &[]), heard)
}

#[test]
fn serve_replies_with_a_policy_that_checks() {
    let (endpoint, heard) = endpoint(&[GOOD], "--dialect vllm");
    let answer = endpoint.chat(&json!({"messages": [
        {"role": "system", "content": "Be brief, please."},
        {"role": "user", "content": "hello"},
        {"role": "assistant", "content": "Hi."},
        {"role": "user", "content": [{"type": "text", "text": "go to the counter"},
            {"type": "image_url", "image_url": {"url": "data:image/png;base64,iVBORwECAw=="}}]},
    ]}));
    assert_eq!(answer.status, 200, "{answer:?}");
    let all = answer.json();
    assert_eq!((&all["object"], &all["model"]), (&json!("chat.completion"), &json!("m")));
    let choice = &all["choices"][0];
    assert_eq!((&choice["finish_reason"], &choice["message"]["role"]), (&json!("stop"), &json!("assistant")));
    let policy: Value = serde_json::from_str(choice["message"]["content"].as_str().unwrap()).unwrap();
    assert_eq!((&policy["policy"], &policy["steps"][0]["do"]), (&json!("go_there"), &json!("go")));
    assert_eq!(all["usage"], json!({"prompt_tokens": 100, "completion_tokens": 10, "total_tokens": 110}));
    // The server gets our prompt and grammar around the messages of the client.
    let body = heard.lock().unwrap()[0].clone();
    assert!(body["structured_outputs"]["json"].is_object(), "{body}");
    let messages = body["messages"].as_array().unwrap();
    let roles: Vec<&str> = messages.iter().map(|message| message["role"].as_str().unwrap()).collect();
    assert_eq!(roles, ["system", "user", "assistant", "user"]);
    let prompt = messages[0]["content"].as_str().unwrap();
    assert!(prompt.contains("pick") && prompt.ends_with("Be brief, please.\n"), "{prompt}");
    let request = messages[3]["content"][0]["text"].as_str().unwrap();
    assert!(request.contains("go to the counter") && request.contains("counter"), "{request}");
    assert_eq!(messages[3]["content"][1]["image_url"]["url"], "data:image/png;base64,iVBORwECAw==");
}

#[test]
fn serve_repairs_and_gives_no_policy_that_does_not_check() {
    let (repaired, heard) = endpoint(&[BAD, GOOD], "--syntax text");
    let answer = repaired.ask("go to the counter");
    assert_eq!(answer.status, 200, "{answer:?}");
    let all = answer.json();
    assert_eq!(all["choices"][0]["message"]["content"], GOOD);
    assert_eq!(all["usage"]["total_tokens"], 220, "of both rounds");
    let again = heard.lock().unwrap()[1]["messages"].to_string();
    assert!(again.contains("`place` needs `holding(mug_1)`"), "{again}");
    let (stubborn, _) = endpoint(&[BAD, BAD], "");
    let answer = stubborn.ask("go to the counter");
    assert_eq!(answer.status, 422, "{answer:?}");
    let error = answer.json()["error"].clone();
    assert_eq!((&error["type"], &error["code"]), (&json!("invalid_policy_error"), &json!("M0501")));
    assert!(error["message"].as_str().unwrap().contains("holding(mug_1)"), "{error}");
    assert_eq!(error["findings"][0]["code"], "M0501");
    assert!(!answer.body.contains("\"choices\""));
    // Declarations of a reply, with which a model could change what its steps need, are dropped.
    let sly = format!("primitive place(object: Object, on: Surface) {{}}\n{BAD}");
    let (fooled, _) = endpoint(&[&sly, &sly], "");
    assert_eq!(fooled.ask("go to the counter").status, 422);
    // A question is no policy either.
    let (asking, _) = endpoint(&["Which mug do you mean?"], "");
    let message = asking.ask("bring me the mug").json()["choices"][0]["message"].clone();
    assert_eq!(message, json!({"role": "assistant", "content": null, "refusal": "Which mug do you mean?"}));
}

#[test]
fn serve_streams_what_checks_and_errors_as_events() {
    let ask = |usage: bool| {
        json!({"messages": [{"role": "user", "content": "go to the counter"}], "stream": true,
            "stream_options": {"include_usage": usage}})
    };
    let (endpoint_good, _) = endpoint(&[GOOD], "--syntax text");
    let answer = endpoint_good.chat(&ask(true));
    assert!(answer.status == 200 && answer.head.contains("text/event-stream"), "{answer:?}");
    let events = answer.events();
    let said: String =
        events.iter().filter_map(|event| event["choices"][0]["delta"]["content"].as_str()).collect();
    assert_eq!(said, GOOD);
    assert_eq!(events[events.len() - 2]["choices"][0]["finish_reason"], "stop");
    assert_eq!(events[events.len() - 1]["usage"]["total_tokens"], 110);
    assert!(unchunked(&answer.body).ends_with("data: [DONE]\n\n"), "{answer:?}");
    let (endpoint_bad, _) = endpoint(&[BAD, BAD], "");
    let events = endpoint_bad.chat(&ask(false)).events();
    assert_eq!(events.last().unwrap()["error"]["code"], "M0501", "{events:?}");
    assert!(events.iter().all(|event| event["choices"][0]["finish_reason"].is_null()), "{events:?}");
}

#[test]
fn serve_lists_its_model_and_refuses_what_it_does_not_serve() {
    let (endpoint, heard) = endpoint(&[], "--max-body 1");
    assert_eq!(endpoint.send("GET", "/v1/models", "", "").json()["data"][0]["id"], "m");
    assert_eq!(endpoint.send("GET", "/v1/models/m", "", "").json()["object"], "model");
    let large = format!("{JSON}Content-Length: 2000000\r\n");
    let chat = "/v1/chat/completions";
    for (method, path, head, body, status, words) in [
        ("GET", "/v1/models/other", "", "", 404, "there is only `m`"),
        ("GET", "/", "", "", 404, "/v1/chat/completions"),
        ("GET", chat, "", "", 405, "does not take GET"),
        ("POST", chat, "Content-Type: text/plain\r\n", "{}", 415, "application/json"),
        ("POST", chat, JSON, "{", 400, "no chat request"),
        ("POST", chat, large.as_str(), "", 413, "1048576"),
        ("POST", chat, JSON, r#"{"model": "x", "messages": []}"#, 404, "does not exist"),
        ("GET", "/v1/models", "Host: attacker.example\r\n", "", 403, "localhost"),
    ] {
        let answer = endpoint.send(method, path, head, body);
        assert_eq!(answer.status, status, "{path}: {answer:?}");
        assert!(answer.message().contains(words), "{path}: {answer:?}");
    }
    assert!(heard.lock().unwrap().is_empty(), "the model was asked");
}

/// A server that keeps the heads of requests and refuses them all, quoting their keys.
fn refusing() -> (String, Arc<Mutex<Vec<String>>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", listener.local_addr().unwrap());
    let heads = Arc::new(Mutex::new(Vec::new()));
    let kept = Arc::clone(&heads);
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let Ok(mut stream) = stream else { return };
            let mut reader = BufReader::new(stream.try_clone().unwrap());
            let (mut head, mut line) = (String::new(), String::new());
            while reader.read_line(&mut line).is_ok_and(|count| count > 2) {
                head.push_str(&line);
                line.clear();
            }
            let body = json!({"error": {"message": format!("no such key: {head}")}}).to_string();
            let length = body.len();
            kept.lock().unwrap().push(head.to_lowercase());
            let answer = format!(
                "HTTP/1.1 401 Unauthorized\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n{body}"
            );
            let _ = stream.write_all(answer.as_bytes());
        }
    });
    (url, heads)
}

#[test]
fn serve_passes_the_key_of_the_client_on_or_has_its_own_and_shows_neither() {
    let ask = json!({"messages": [{"role": "user", "content": "go to the counter"}]}).to_string();
    let chat = "/v1/chat/completions";
    let with = |key: &str| format!("{JSON}Authorization: Bearer {key}\r\n");
    let (url, heads) = refusing();
    let passing = Endpoint::new(&url, "", &[]);
    let answer = passing.send("POST", chat, &with("client-secret"), &ask);
    assert_eq!(answer.status, 502, "{answer:?}");
    assert!(heads.lock().unwrap()[0].contains("authorization: bearer client-secret"));
    assert!(answer.message().contains("[key]") && !answer.body.contains("client-secret"), "{answer:?}");
    let variables = [("OWN_KEY", "own-secret"), ("TOKEN", "token-secret")];
    let own = Endpoint::new(&url, "--key-from OWN_KEY --token-from TOKEN", &variables);
    for (head, status) in [(JSON.to_owned(), 401), (with("client-secret"), 401), (with("token-secret"), 502)]
    {
        let answer = own.send("POST", chat, &head, &ask);
        assert_eq!(answer.status, status, "{answer:?}");
        assert!(!answer.body.contains("secret"), "{answer:?}");
    }
    let last = heads.lock().unwrap().last().cloned().unwrap();
    assert!(last.contains("bearer own-secret") && !last.contains("token-secret"), "{last}");
}

#[test]
fn serve_works_on_no_more_requests_than_it_may() {
    // A server that takes requests and does not answer them.
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", listener.local_addr().unwrap());
    let endpoint = Endpoint::new(&url, "--parallel 1", &[]);
    let ask = json!({"messages": [{"role": "user", "content": "go to the counter"}]}).to_string();
    let length = ask.len();
    let first = format!(
        "POST /v1/chat/completions HTTP/1.1\r\nHost: localhost\r\n{JSON}Content-Length: {length}\r\n\r\n{ask}"
    );
    let mut waiting = TcpStream::connect(&endpoint.address).unwrap();
    waiting.write_all(first.as_bytes()).unwrap();
    let (asked, _) = listener.accept().unwrap();
    let answer = endpoint.ask("go to the counter");
    assert_eq!((answer.status, answer.head.contains("retry-after: 1")), (429, true), "{answer:?}");
    // One that leaves makes room: its request is given up.
    drop(waiting);
    drop(asked);
    drop(listener);
    assert!(eventually(|| endpoint.ask("go to the counter").status != 429));
}

#[test]
fn serve_says_before_it_listens_what_cannot_be() {
    use crate::support::Place;
    let place = Place::new("serve_flags");
    let run = |flags: &str, variables: &[(&str, &str)]| {
        let ran = place.run_with(&format!("serve --planner http://localhost:9 {flags}"), b"", variables);
        assert_eq!(ran.code, Some(2), "{flags}: {}{}", ran.stdout, ran.stderr);
        ran.stderr
    };
    let key = [("OWN_KEY", "own-secret")];
    assert!(run("", &[]).contains("--robot"));
    assert!(run("--robot hsr --key-from OWN_KEY --listen 0.0.0.0:0", &key).contains("--token-from"));
    assert!(run("--robot hsr --listen 203.0.113.1:80", &[]).contains("cannot listen on 203.0.113.1:80"));
    assert!(run("--robot hsr --dialect gemini --carrier lark", &[]).contains("--carrier lark"));
}
