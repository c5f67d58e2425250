//! A model server that answers with the bytes of a case, and a client that asks it in each dialect.

use motet_client::dialect::Dialect;
use motet_client::{Client, ClientSettings, ServerUrl};
use motet_compiler::Session;
use motet_decode::{Grammar, Subset};
use motet_planner::model::{Message, Model as _, ReplyEvent, Role};
use std::io::{Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::Duration;

/// Bytes of the present answer.
static ANSWER: Mutex<Vec<u8>> = Mutex::new(Vec::new());

/// Kinds of bodies; the last is the whole response, with its head.
const KINDS: [&str; 4] = ["text/event-stream", "application/json", "application/x-ndjson", ""];

static CLIENTS: LazyLock<Mutex<(Vec<Client>, Grammar)>> = LazyLock::new(|| {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port is free");
    let address = format!("http://{}", listener.local_addr().expect("it is bound"));
    std::thread::spawn(move || listener.incoming().flatten().for_each(serve));
    let dialects = [
        None,
        Some(Dialect::Ollama),
        Some(Dialect::OpenAiResponses),
        Some(Dialect::Anthropic),
        Some(Dialect::Gemini),
    ];
    let client = |dialect| {
        let url = ServerUrl::new(&address, dialect).expect("it is an address");
        let timeout = Duration::from_secs(2);
        let settings =
            ClientSettings { dialect, carrier: None, retries: 0, timeout, ..ClientSettings::new(url, "m") };
        Client::new(settings).expect("there are threads")
    };
    let session = Session::builder().build(&mut motet_syntax::Sources::default());
    let grammar = Grammar::new(&session.signatures(), Subset::default());
    Mutex::new((dialects.map(client).into(), grammar))
});

fn serve(mut stream: TcpStream) {
    let mut asked: Vec<u8> = Vec::new();
    let mut piece = [0; 4096];
    // The body is short and comes with the head, or the answer comes early.
    while !asked.windows(4).any(|end| end == b"\r\n\r\n") {
        match stream.read(&mut piece) {
            Ok(0) | Err(_) => return,
            Ok(count) => asked.extend(piece.iter().take(count)),
        }
    }
    let answer = ANSWER.lock().unwrap_or_else(PoisonError::into_inner).clone();
    let Some((first, body)) = answer.split_first() else { return };
    let kind = KINDS[usize::from(*first) % KINDS.len()];
    if !kind.is_empty() {
        let head = format!("HTTP/1.1 200 OK\r\nContent-Type: {kind}\r\nConnection: close\r\n\r\n");
        let _ = stream.write_all(head.as_bytes());
    }
    let _ = stream.write_all(body);
}

/// Asks a server that answers so: its first byte chooses the kind of the body and the dialect.
pub(crate) fn answer(bytes: &[u8]) {
    let Some(first) = bytes.first() else { return };
    bytes.clone_into(&mut ANSWER.lock().unwrap_or_else(PoisonError::into_inner));
    let mut clients = CLIENTS.lock().unwrap_or_else(PoisonError::into_inner);
    let (clients, grammar) = &mut *clients;
    let number = usize::from(*first) / KINDS.len() % clients.len();
    let Some(client) = clients.get_mut(number) else { return };
    let Ok(mut reply) = client.ask(&[Message::new(Role::User, "go")], grammar) else { return };
    loop {
        match reply.next(Duration::from_secs(5)) {
            ReplyEvent::End(_) | ReplyEvent::Failed(_) => return,
            ReplyEvent::Nothing => panic!("it neither answers nor fails in 5 s"),
            _ => {}
        }
    }
}
