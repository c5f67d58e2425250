//! A server that plays a script: one act for each request, the last one again and again.

use std::io::{Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::Duration;

use serde_json::{Value, json};

/// What the server does with a request.
#[derive(Clone, Debug)]
pub(crate) enum Act {
    /// Says this as server-sent events, so many characters each, with a pause before each.
    Says { text: String, each: usize, pause: Duration },
    /// Says this and nothing behind it: the connection is closed in the middle.
    BreaksOff { text: String },
    /// Says this all at once, as a server that does not stream.
    AtOnce { text: String },
    /// Says this as Ollama does, a JSON object a line.
    Lines { text: String },
    /// Answers with a status, headers and a body.
    Status { status: &'static str, headers: &'static str, body: String },
    /// Sends events that are no JSON.
    Nonsense,
    /// Says this again and again until nobody listens.
    Endless { text: String },
    /// Says nothing until nobody listens.
    Silent,
    /// Hangs up at once.
    HangsUp,
}

impl Act {
    pub(crate) fn says(text: impl Into<String>) -> Self {
        Self::Says { text: text.into(), each: 7, pause: Duration::ZERO }
    }

    pub(crate) fn status(status: &'static str, headers: &'static str) -> Self {
        Self::Status { status, headers, body: r#"{"error": {"message": "not now"}}"#.to_owned() }
    }
}

/// A request as it arrived.
#[derive(Clone, Debug)]
pub(crate) struct Heard {
    pub(crate) head: String,
    pub(crate) body: Value,
}

/// The server. It ends when it is dropped.
pub(crate) struct Server {
    pub(crate) url: String,
    heard: Arc<Mutex<Vec<Heard>>>,
    /// Characters of replies that were sent.
    pub(crate) sent: Arc<AtomicUsize>,
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Server {
    pub(crate) fn new(script: Vec<Act>) -> Self {
        let at = AtomicUsize::new(0);
        Self::with(move || {
            let index = at.fetch_add(1, Ordering::SeqCst).min(script.len() - 1);
            script[index].clone()
        })
    }

    /// A server that asks for each act.
    pub(crate) fn with(next: impl Fn() -> Act + Send + 'static) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let url = format!("http://{}", listener.local_addr().unwrap());
        let heard = Arc::new(Mutex::new(Vec::new()));
        let (sent, is_over) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicBool::new(false)));
        let (all, count, over) = (Arc::clone(&heard), Arc::clone(&sent), Arc::clone(&is_over));
        let thread = std::thread::spawn(move || {
            for stream in listener.incoming() {
                if over.load(Ordering::SeqCst) {
                    return;
                }
                let (Ok(mut stream), act) = (stream, next()) else { return };
                let (all, count) = (Arc::clone(&all), Arc::clone(&count));
                std::thread::spawn(move || {
                    let Some(request) = read(&mut stream) else { return };
                    all.lock().unwrap().push(request);
                    // A client that hangs up is no mistake.
                    let _ = play(&mut stream, &act, &count);
                });
            }
        });
        Self { url, heard, sent, is_over, thread: Some(thread) }
    }

    pub(crate) fn heard(&self) -> Vec<Heard> {
        self.heard.lock().unwrap().clone()
    }

    pub(crate) fn forget(&self) {
        self.heard.lock().unwrap().clear();
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::SeqCst);
        // Wakes it up.
        let _ = TcpStream::connect(self.url.trim_start_matches("http://"));
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn read(stream: &mut TcpStream) -> Option<Heard> {
    let (mut request, mut buffer) = (Vec::new(), [0; 16384]);
    loop {
        let count = stream.read(&mut buffer).ok()?;
        request.extend_from_slice(&buffer[..count]);
        let text = String::from_utf8_lossy(&request);
        if let Some((head, body)) = text.split_once("\r\n\r\n") {
            let length = head
                .lines()
                .find_map(|line| line.to_lowercase().strip_prefix("content-length: ").map(str::to_owned))?;
            if body.len() >= length.trim().parse().ok()? {
                let body = serde_json::from_str(body).ok()?;
                return Some(Heard { head: head.to_owned(), body });
            }
        }
        if count == 0 {
            return None;
        }
    }
}

fn play(stream: &mut TcpStream, act: &Act, sent: &AtomicUsize) -> std::io::Result<()> {
    const EVENTS: &str = "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n\r\n";
    let event = |text: &str| format!("data: {}\n\n", json!({"choices": [{"delta": {"content": text}}]}));
    let put = |stream: &mut TcpStream, text: &str| {
        sent.fetch_add(text.len(), Ordering::SeqCst);
        stream.write_all(text.as_bytes())
    };
    match act {
        Act::Says { text, each, pause } => {
            put(stream, EVENTS)?;
            put(stream, ": keep-alive\n\ndata: {\"choices\": [{\"delta\": {\"role\": \"assistant\"}}]}\n\n")?;
            let letters: Vec<char> = text.chars().collect();
            for piece in letters.chunks(*each) {
                std::thread::sleep(*pause);
                put(stream, &event(&piece.iter().collect::<String>()))?;
            }
            put(
                stream,
                "data: {\"choices\": [{\"delta\": {}, \"finish_reason\": \"stop\"}]}\n\ndata: [DONE]\n\n",
            )
        }
        Act::BreaksOff { text } => {
            put(stream, EVENTS)?;
            put(stream, &event(text))?;
            put(stream, "data: {\"choices\": [{\"delta\"")
        }
        Act::AtOnce { text } => {
            let body = json!({"choices": [{"message": {"role": "assistant", "content": text}}]}).to_string();
            put(stream, &whole("200 OK", "Content-Type: application/json\r\n", &body))
        }
        Act::Lines { text } => {
            put(
                stream,
                "HTTP/1.1 200 OK\r\nContent-Type: application/x-ndjson\r\nConnection: close\r\n\r\n",
            )?;
            for piece in text.chars().collect::<Vec<_>>().chunks(7) {
                let piece: String = piece.iter().collect();
                put(stream, &format!("{}\n", json!({"message": {"content": piece}, "done": false})))?;
            }
            put(stream, "{\"message\": {\"content\": \"\"}, \"done\": true, \"done_reason\": \"stop\"}\n")
        }
        Act::Status { status, headers, body } => put(stream, &whole(status, headers, body)),
        Act::Nonsense => {
            put(stream, EVENTS)?;
            put(stream, "data: {\"choices\": [}\n\n")
        }
        Act::Endless { text } => {
            put(stream, EVENTS)?;
            loop {
                put(stream, &event(text))?;
            }
        }
        Act::Silent => {
            let mut byte = [0; 1];
            let _ = stream.read(&mut byte)?;
            Ok(())
        }
        Act::HangsUp => Ok(()),
    }
}

fn whole(status: &str, headers: &str, body: &str) -> String {
    format!("HTTP/1.1 {status}\r\n{headers}Content-Length: {}\r\nConnection: close\r\n\r\n{body}", body.len())
}
