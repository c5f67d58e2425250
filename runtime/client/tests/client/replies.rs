//! What becomes of what a server says and does.

use std::time::Duration;

use crate::kitchen::{brisk, session};
use crate::server::{Act, Server};
use motet_client::dialect::{Dialect, GrammarCarrier};
use motet_client::{Client, ClientSettings, EncodedImage, ImageError, ServerUrl};
use motet_decode::{Grammar, Subset};
use motet_planner::model::{Finish, Message, Model as _, ModelError, ReplyEvent, Role};

fn chat() -> Vec<Message> {
    let message = |role, text: &str| Message::new(role, text);
    vec![message(Role::System, "you plan"), message(Role::User, "bring me the coke")]
}

/// Asks, and gives the text, how often it was tried again, and the ending.
fn ask(settings: ClientSettings) -> (String, usize, Result<Finish, ModelError>) {
    let grammar = Grammar::new(&session().signatures(), Subset::default());
    let mut client = Client::new(settings).unwrap();
    let mut reply = match client.ask(&chat(), &grammar) {
        Ok(reply) => reply,
        Err(why) => return (String::new(), 0, Err(why)),
    };
    let (mut text, mut retries) = (String::new(), 0);
    loop {
        match reply.next(Duration::from_millis(20)) {
            ReplyEvent::Nothing => {}
            ReplyEvent::Piece(piece) => text.push_str(&piece),
            ReplyEvent::Used(_) => {}
            ReplyEvent::Retrying { .. } => retries += 1,
            ReplyEvent::End(finish) => return (text, retries, Ok(finish)),
            ReplyEvent::Failed(why) => return (text, retries, Err(why)),
        }
    }
}

fn check(script: Vec<Act>, expected: (&str, usize, Result<Finish, &str>)) {
    let server = Server::new(script.clone());
    let (text, retries, end) = ask(brisk(&server));
    let end = end.map_err(|why| why.to_string());
    let (wanted_text, wanted_retries, wanted) = expected;
    assert_eq!((text.as_str(), retries), (wanted_text, wanted_retries), "{script:?}: {end:?}");
    match (&end, wanted) {
        (Ok(finish), Ok(wanted)) => assert_eq!(*finish, wanted, "{script:?}"),
        (Err(why), Err(wanted)) => assert!(why.contains(wanted), "{script:?}: {why}"),
        _ => panic!("{script:?}: {end:?}, not {wanted:?}"),
    }
}

#[test]
fn client_reply_arrives_however_it_is_sent() {
    let text = "{\"motet\": 1} and a word: grüße".to_owned();
    check(vec![Act::says(text.clone())], (&text, 0, Ok(Finish::Stop)));
    check(vec![Act::AtOnce { text: text.clone() }], (&text, 0, Ok(Finish::Stop)));
    check(vec![Act::Lines { text: text.clone() }], (&text, 0, Ok(Finish::Stop)));
}

#[test]
fn client_server_that_is_busy_or_fails_is_asked_again_a_few_times() {
    let busy = Act::status("429 Too Many Requests", "Retry-After: 1\r\n");
    check(vec![busy.clone(), Act::says("now")], ("now", 1, Ok(Finish::Stop)));
    let fails = Act::status("500 Internal Server Error", "");
    check(vec![fails.clone(), Act::HangsUp, Act::says("now")], ("now", 2, Ok(Finish::Stop)));
    check(vec![fails], ("", 2, Err("500 Internal Server Error: {\"error\": {\"message\": \"not now\"}}")));
    check(vec![busy], ("", 2, Err("429")));
}

#[test]
fn client_what_lasts_is_not_tried_again() {
    check(vec![Act::status("401 Unauthorized", "")], ("", 0, Err("refuses the request")));
    check(
        vec![Act::status("307 Temporary Redirect", "Location: http://127.0.0.1:1/\r\n")],
        ("", 0, Err("307")),
    );
}

#[test]
fn client_bad_reply_ends_in_an_error_and_not_in_a_wait() {
    check(vec![Act::BreaksOff { text: "half".to_owned() }], ("half", 0, Err("broke off")));
    check(vec![Act::Nonsense], ("", 0, Err("no JSON")));
    check(vec![Act::Silent], ("", 0, Err("did not answer within 1 s")));
    let server = Server::new(vec![Act::Endless { text: "and ".repeat(20) }]);
    let settings = ClientSettings { max_bytes: 20_000, ..brisk(&server) };
    assert_eq!(ask(settings).2, Err(ModelError::TooLong { bytes: 20_000 }));
    let server =
        Server::new(vec![Act::Says { text: "slow ".repeat(100), each: 1, pause: Duration::from_millis(20) }]);
    let settings = ClientSettings { timeout: Duration::from_millis(400), ..brisk(&server) };
    assert!(matches!(ask(settings).2, Err(ModelError::TimedOut { .. })));
}

#[test]
fn client_server_that_is_not_there_is_an_error() {
    let gone = Server::new(vec![Act::HangsUp]);
    let settings = brisk(&gone);
    drop(gone);
    let (_, retries, end) = ask(settings);
    assert_eq!(retries, 2);
    assert!(matches!(&end, Err(ModelError::Unreachable { why }) if why.contains("refused")), "{end:?}");
}

#[test]
fn client_lark_goes_where_llguidance_takes_it() {
    for (dialect, field) in [
        (Dialect::Vllm, Some("/structured_outputs/grammar")),
        (Dialect::LlamaCpp, Some("/grammar")),
        (Dialect::Sglang, Some("/ebnf")),
        (Dialect::OpenAi, None),
        (Dialect::Ollama, None),
    ] {
        let server = Server::new(vec![Act::says("{}")]);
        let address = ServerUrl::new(&server.url, Some(dialect)).unwrap();
        let settings = ClientSettings {
            dialect: Some(dialect),
            carrier: Some(GrammarCarrier::Lark),
            address,
            ..brisk(&server)
        };
        let (_, _, end) = ask(settings);
        let Some(field) = field else {
            assert!(matches!(&end, Err(ModelError::Refused { .. })), "{dialect:?}: {end:?}");
            continue;
        };
        assert_eq!(end, Ok(Finish::Stop));
        let body = &server.heard()[0].body;
        let lark = body.pointer(field).and_then(serde_json::Value::as_str).unwrap();
        assert!(lark.starts_with("%llguidance"), "{dialect:?}: {lark:.60}");
        assert_eq!(body.get("response_format"), None);
    }
}

#[test]
fn client_images_and_grammars_are_sent_in_the_dialect_of_the_server() {
    let png = [0x89, b'P', b'N', b'G', 1, 2, 3];
    let image = EncodedImage::new(&png).unwrap();
    assert_eq!(EncodedImage::new(b"a text"), Err(ImageError::Unknown));
    for (dialect, path, field) in [
        (None, "/v1/chat/completions", None),
        (Some(Dialect::Vllm), "/v1/chat/completions", Some("structured_outputs")),
        (Some(Dialect::LlamaCpp), "/v1/chat/completions", Some("response_format")),
        (Some(Dialect::Sglang), "/v1/chat/completions", Some("response_format")),
        (Some(Dialect::OpenAi), "/v1/chat/completions", Some("response_format")),
        (Some(Dialect::Ollama), "/api/chat", Some("format")),
    ] {
        let server = Server::new(vec![Act::says("{}")]);
        let address = ServerUrl::new(&server.url, dialect).unwrap();
        let (_, _, end) =
            ask(ClientSettings { dialect, images: vec![image.clone()], address, ..brisk(&server) });
        assert_eq!(end, Ok(Finish::Stop));
        let heard = server.heard();
        assert!(heard[0].head.starts_with(&format!("POST {path} ")), "{}", heard[0].head);
        let body = &heard[0].body;
        assert_eq!(body["stream"], true);
        assert_eq!(body["model"], "scripted");
        for name in ["structured_outputs", "response_format", "format"] {
            assert_eq!(body.get(name).is_some(), field == Some(name), "{dialect:?}: {name}");
        }
        let user = &body["messages"][1];
        if dialect == Some(Dialect::Ollama) {
            assert_eq!(
                (user["content"].as_str(), user["images"][0].as_str()),
                (Some("bring me the coke"), Some("iVBORwECAw=="))
            );
        } else {
            assert_eq!(user["content"][0]["text"], "bring me the coke");
            assert_eq!(user["content"][1]["image_url"]["url"], "data:image/png;base64,iVBORwECAw==");
        }
    }
}

#[test]
fn client_addresses_with_a_password_are_refused() {
    assert!(ServerUrl::new("http://me:secret@localhost", None).unwrap_err().contains("--key-from"));
    assert!(ServerUrl::new("localhost:8000", None).is_err());
    let address = |text| ServerUrl::new(text, None).unwrap().to_string();
    assert_eq!(address("http://localhost:8000/v1/"), "http://localhost:8000/v1/chat/completions");
    assert_eq!(address("https://host/api/v1"), "https://host/api/v1/chat/completions");
    assert_eq!(address("https://host/v1/chat/completions"), "https://host/v1/chat/completions");
}

#[test]
fn client_that_drops_a_reply_hangs_up() {
    let server = Server::new(vec![Act::Endless { text: "on and on ".to_owned() }]);
    let grammar = Grammar::new(&session().signatures(), Subset::default());
    let mut client = Client::new(ClientSettings { max_bytes: usize::MAX, ..brisk(&server) }).unwrap();
    let mut reply = client.ask(&chat(), &grammar).unwrap();
    while !matches!(reply.next(Duration::from_millis(20)), ReplyEvent::Piece(_)) {}
    drop(reply);
    // The server stops writing once nobody listens, so it hears the next request to its end.
    let sent = || server.sent.load(std::sync::atomic::Ordering::SeqCst);
    let mut before = sent();
    let quiet = (0..200).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        before == std::mem::replace(&mut before, sent())
    });
    assert!(quiet, "it still writes");
}
