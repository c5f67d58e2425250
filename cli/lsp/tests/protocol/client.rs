//! Client of the server over pipes in memory: it frames messages by itself, and knows no type of the server.

use std::io::{BufRead, BufReader, PipeReader, PipeWriter, Read, Write, pipe};
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};

use motet_lsp::{ServerEnd, serve};
use motet_project::{Project, find_config, read_config};
use serde_json::{Value, json};

pub(crate) struct Client {
    to: Option<PipeWriter>,
    from: BufReader<PipeReader>,
    server: Option<JoinHandle<std::io::Result<ServerEnd>>>,
    requests: i64,
    /// Messages that came while another was awaited.
    early: Vec<Value>,
}

impl Client {
    /// Client of a server that is initialized, with these robot and scene unless a `motet.toml` says others.
    pub(crate) fn new() -> Self {
        Self::with_motions(false)
    }

    /// The same with motions, or without.
    pub(crate) fn with_motions(with_motions: bool) -> Self {
        let mut client = Self::opened(with_motions);
        let answer =
            client.request("initialize", json!({"processId": null, "rootUri": null, "capabilities": {}}));
        assert_eq!(answer["serverInfo"]["name"], "motet", "{answer}");
        client.notify("initialized", json!({}));
        client
    }

    /// Client of a server that waits for `initialize`.
    pub(crate) fn raw() -> Self {
        Self::opened(false)
    }

    fn opened(with_motions: bool) -> Self {
        let (server_in, to) = pipe().unwrap();
        let (from, server_out) = pipe().unwrap();
        let open = move |folder: &Path| match find_config(folder) {
            Some(config) => read_config(&config).map_err(|error| error.to_string()),
            None => {
                let project = Project::builder().robot("hsr").scene("kitchen");
                Ok(if with_motions { project } else { project.without_motions() })
            }
        };
        let cache = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lsp").join("cache");
        let server =
            thread::spawn(move || serve(BufReader::new(server_in), server_out, Box::new(open), cache));
        Self {
            to: Some(to),
            from: BufReader::new(from),
            server: Some(server),
            requests: 0,
            early: Vec::new(),
        }
    }

    pub(crate) fn send_bytes(&mut self, bytes: &[u8]) {
        self.to.as_mut().unwrap().write_all(bytes).unwrap();
    }

    pub(crate) fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.send_bytes(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    pub(crate) fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    /// Sends a request, and returns its number.
    pub(crate) fn ask(&mut self, method: &str, params: Value) -> i64 {
        self.requests += 1;
        let id = self.requests;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}));
        id
    }

    /// Sends a request, and returns its result.
    pub(crate) fn request(&mut self, method: &str, params: Value) -> Value {
        let answer = self.call(method, params);
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    /// Sends a request, and returns the error with which it is refused.
    pub(crate) fn refused(&mut self, method: &str, params: Value) -> (i64, String) {
        let answer = self.call(method, params);
        let error = &answer["error"];
        (error["code"].as_i64().unwrap(), error["message"].as_str().unwrap().to_owned())
    }

    fn call(&mut self, method: &str, params: Value) -> Value {
        let id = self.ask(method, params);
        self.await_answer(id)
    }

    pub(crate) fn await_answer(&mut self, id: i64) -> Value {
        self.await_message(|message| message["id"] == id && message.get("method").is_none())
    }

    /// Next message of this kind; others are kept for later.
    pub(crate) fn await_message(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        if let Some(index) = self.early.iter().position(&is_it) {
            return self.early.remove(index);
        }
        loop {
            let message = self.read().expect("the server is there");
            if is_it(&message) {
                return message;
            }
            self.early.push(message);
        }
    }

    fn read(&mut self) -> Option<Value> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            if self.from.read_line(&mut line).unwrap() == 0 {
                return None;
            }
            match line.trim_end().split_once(": ") {
                Some(("Content-Length", value)) => length = value.parse().unwrap(),
                Some(_) => {}
                None => break,
            }
        }
        let mut body = vec![0; length];
        self.from.read_exact(&mut body).unwrap();
        Some(serde_json::from_slice(&body).unwrap())
    }

    pub(crate) fn open(&mut self, uri: &str, text: &str) {
        let document = json!({"uri": uri, "languageId": "motet", "version": 1, "text": text});
        self.notify("textDocument/didOpen", json!({"textDocument": document}));
    }

    /// Replaces a range, given as `[line, column, line, column]`.
    pub(crate) fn change(&mut self, uri: &str, version: i32, [a, b, c, d]: [u32; 4], text: &str) {
        let range = json!({"start": {"line": a, "character": b}, "end": {"line": c, "character": d}});
        self.notify(
            "textDocument/didChange",
            json!({
                "textDocument": {"uri": uri, "version": version},
                "contentChanges": [{"range": range, "text": text}],
            }),
        );
    }

    /// Diagnostics of a version of a document.
    pub(crate) fn diagnostics(&mut self, uri: &str, version: i32) -> Vec<Value> {
        let published = self.await_message(|message| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
                && message["params"]["version"] == version
        });
        published["params"]["diagnostics"].as_array().unwrap().clone()
    }

    /// Ends the session in order.
    pub(crate) fn end(mut self) {
        assert_eq!(self.request("shutdown", Value::Null), Value::Null);
        self.notify("exit", Value::Null);
        assert_eq!(self.server.take().unwrap().join().unwrap().unwrap(), ServerEnd::Ordered);
    }

    /// Closes the stream, and returns how the server ends.
    pub(crate) fn leave(mut self) -> std::io::Result<ServerEnd> {
        self.to = None;
        self.server.take().unwrap().join().unwrap()
    }
}

/// Short form of diagnostics: code and range.
pub(crate) fn short(diagnostics: &[Value]) -> Vec<String> {
    let place = |place: &Value| format!("{}:{}", place["line"], place["character"]);
    let shown = diagnostics.iter().map(|found| {
        let range = &found["range"];
        format!(
            "{} {}-{}",
            found["code"].as_str().unwrap_or("-"),
            place(&range["start"]),
            place(&range["end"])
        )
    });
    shown.collect()
}

/// Position of a text in a document, at its first byte, as editors count.
pub(crate) fn position(text: &str, of: &str) -> Value {
    let before = text.get(..text.find(of).unwrap_or_else(|| panic!("{of}"))).unwrap();
    let line = before.matches('\n').count();
    let column = before.rsplit('\n').next().unwrap().encode_utf16().count();
    json!({"line": line, "character": column})
}

/// Empty folder of a test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("lsp").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}
