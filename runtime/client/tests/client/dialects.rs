//! Dialects of servers by recorded exchanges. The recordings are written after the public references: of
//! OpenAI (`/v1/responses` with its streaming events, custom tools, and `/v1/chat/completions`), of Anthropic
//! (`/v1/messages`, streaming, structured outputs, stop reasons), of the Gemini API (`generateContent`,
//! finish reasons, `UsageMetadata`) and of mistral.rs (chunks, usage and errors of chat completions).

use std::io::Read as _;
use std::net::TcpListener;
use std::sync::Arc;
use std::time::Duration;

use crate::kitchen::{brisk, session};
use crate::server::{Act, Heard, Server};
use motet_client::dialect::{Dialect, GrammarCarrier};
use motet_client::{ApiKey, Client, ClientSettings, EncodedImage, ServerUrl, content};
use motet_decode::{Grammar, Subset};
use motet_planner::model::{Finish, Message, Model as _, ModelError, ReplyEvent, Role, TokenUsage};
use motet_syntax::Syntax;
use rustls::pki_types::pem::PemObject as _;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};
use serde_json::{Value, json};

/// Outcome of an exchange.
#[derive(Debug)]
struct Exchange {
    text: String,
    usage: TokenUsage,
    end: Result<Finish, ModelError>,
    heard: Vec<Heard>,
}

const KEY: &str = "sk-very-secret";

fn settings(server: &Server, dialect: Dialect) -> ClientSettings {
    ClientSettings {
        dialect: Some(dialect),
        address: ServerUrl::new(&server.url, Some(dialect)).unwrap(),
        key: ApiKey::new(KEY),
        retries: 0,
        ..brisk(server)
    }
}

/// Asks a server that plays one act.
fn exchange(act: Act, change: impl FnOnce(ClientSettings) -> ClientSettings, dialect: Dialect) -> Exchange {
    let server = Server::new(vec![act]);
    let grammar = Grammar::new(&session().signatures(), Subset::default());
    let mut client = Client::new(change(settings(&server, dialect))).unwrap();
    let chat = [
        Message::new(Role::System, "you plan"),
        Message::new(Role::User, "bring me the coke"),
        Message::new(Role::Assistant, ""),
        Message::new(Role::User, "again"),
    ];
    let (mut text, mut usage) = (String::new(), TokenUsage::default());
    let end = match client.ask(&chat, &grammar) {
        Err(why) => Err(why),
        Ok(mut reply) => loop {
            match reply.next(Duration::from_millis(20)) {
                ReplyEvent::Nothing | ReplyEvent::Retrying { .. } => {}
                ReplyEvent::Piece(piece) => text.push_str(&piece),
                ReplyEvent::Used(used) => usage = used,
                ReplyEvent::End(finish) => break Ok(finish),
                ReplyEvent::Failed(why) => break Err(why),
            }
        },
    };
    Exchange { text, usage, end, heard: server.heard() }
}

fn events(body: &str) -> Act {
    answer("200 OK", "Content-Type: text/event-stream\r\n", body)
}

fn answer(status: &'static str, headers: &'static str, body: &str) -> Act {
    Act::Status { status, headers, body: body.to_owned() }
}

/// Checks the text and the end of a recorded stream.
fn check(dialect: Dialect, recording: &str, text: &str, end: Result<Finish, &str>) -> TokenUsage {
    let got = exchange(events(recording), |settings| settings, dialect);
    assert_eq!(got.text, text, "{dialect:?}: {got:?}");
    match (&got.end, end) {
        (Ok(finish), Ok(wanted)) => assert_eq!(*finish, wanted, "{dialect:?}"),
        (Err(why), Err(wanted)) => assert!(why.to_string().contains(wanted), "{dialect:?}: {why}"),
        _ => panic!("{dialect:?}: {got:?}, not {end:?}"),
    }
    got.usage
}

const POLICY: &str = "{\"motet\":1}";

#[test]
fn dialect_streams_are_read_to_their_end_with_their_tokens() {
    let usage = TokenUsage { input: Some(2418), output: Some(71) };
    for (dialect, recording) in [
        (Dialect::OpenAiResponses, include_str!("recordings/responses.sse")),
        (Dialect::Anthropic, include_str!("recordings/messages.sse")),
        (Dialect::Anthropic, include_str!("recordings/messages_tool.sse")),
        (Dialect::Gemini, include_str!("recordings/gemini.sse")),
        (Dialect::MistralRs, include_str!("recordings/mistralrs.sse")),
        (Dialect::OpenAi, include_str!("recordings/chat.sse")),
    ] {
        assert_eq!(check(dialect, recording, POLICY, Ok(Finish::Stop)), usage, "{dialect:?}");
        // A stream that breaks off in its middle has no end.
        let cut = recording.find("motet\\\":").unwrap() + 40;
        let end = recording.get(..cut).unwrap().rfind("\n\n").map_or(0, |at| at + 2);
        let cut = recording.get(..end).unwrap();
        let got = exchange(events(cut), |settings| settings, dialect);
        assert!(matches!(got.end, Err(ModelError::CutOff { .. })), "{dialect:?}: {got:?}");
    }
    let tool = include_str!("recordings/responses_tool.sse");
    check(Dialect::OpenAiResponses, tool, "policy p { done }", Ok(Finish::Stop));
}

#[test]
fn dialect_limits_refusals_and_errors_are_told_apart() {
    let limit = Ok(Finish::Length);
    let sorry = Err("the model declines: I'm sorry, I can't help with that.");
    check(Dialect::OpenAiResponses, include_str!("recordings/responses_incomplete.sse"), "{\"mot", limit);
    check(Dialect::Anthropic, include_str!("recordings/messages_limit.sse"), "{\"mot", limit);
    check(Dialect::Gemini, include_str!("recordings/gemini_limit.sse"), "{\"mot", limit);
    check(Dialect::MistralRs, include_str!("recordings/mistralrs_limit.sse"), "{\"mot", limit);
    check(Dialect::OpenAiResponses, include_str!("recordings/responses_refusal.sse"), "", sorry);
    check(Dialect::OpenAi, include_str!("recordings/chat_refusal.sse"), "", sorry);
    let refusal = include_str!("recordings/messages_refusal.sse");
    check(Dialect::Anthropic, refusal, "", Err("the model declines: refusal"));
    let blocked = include_str!("recordings/gemini_blocked.sse");
    check(Dialect::Gemini, blocked, "", Err("the model declines: PROHIBITED_CONTENT"));
    check(Dialect::Gemini, include_str!("recordings/gemini_safety.sse"), "{", Err("declines: SAFETY"));
    let failed = include_str!("recordings/responses_failed.sse");
    check(Dialect::OpenAiResponses, failed, "", Err("failed to generate a response"));
    check(Dialect::Anthropic, include_str!("recordings/messages_error.sse"), "", Err("Overloaded"));
    let failed = include_str!("recordings/mistralrs_error.sse");
    check(Dialect::MistralRs, failed, "", Err("The model failed to process the request."));
    for (status, body, dialect, words) in [
        (
            "529 Site is overloaded",
            "{\"type\":\"error\",\"error\":{\"type\":\"overloaded_error\"}}",
            Dialect::Anthropic,
            "busy or fails: it answers 529",
        ),
        (
            "400 Bad Request",
            include_str!("recordings/gemini_error.json"),
            Dialect::Gemini,
            "API key not valid",
        ),
        (
            "401 Unauthorized",
            "{\"error\":{\"message\":\"Incorrect API key provided: sk-very-secret.\"}}",
            Dialect::OpenAiResponses,
            "Incorrect API key provided: [key].",
        ),
    ] {
        let end = exchange(answer(status, "", body), |settings| settings, dialect).end;
        assert!(end.as_ref().is_err_and(|why| why.to_string().contains(words)), "{end:?}");
    }
}

#[test]
fn dialect_whole_answers_have_their_text() {
    for (dialect, answer) in [
        (Dialect::OpenAiResponses, include_str!("recordings/responses.json")),
        (Dialect::Anthropic, include_str!("recordings/messages.json")),
        (Dialect::Anthropic, include_str!("recordings/messages_tool.json")),
        (Dialect::Gemini, include_str!("recordings/gemini.json")),
        (Dialect::MistralRs, include_str!("recordings/mistralrs.json")),
    ] {
        let whole: Value = serde_json::from_str(answer).unwrap();
        assert_eq!(content(Some(dialect), &whole).as_deref(), Some(POLICY), "{dialect:?}");
        // A server that does not stream is read all the same.
        let got = exchange(
            Act::Status {
                status: "200 OK",
                headers: "Content-Type: application/json\r\n",
                body: answer.to_owned(),
            },
            |settings| settings,
            dialect,
        );
        assert_eq!((got.text.as_str(), got.end), (POLICY, Ok(Finish::Stop)), "{dialect:?}");
    }
}

/// A request in the dialect, with an image and the carrier.
fn request(dialect: Dialect, carrier: Option<GrammarCarrier>) -> Heard {
    let image = EncodedImage::new(&[0x89, b'P', b'N', b'G', 1, 2, 3]).unwrap();
    let change = |settings| ClientSettings { carrier, images: vec![image], ..settings };
    let mut got = exchange(events(""), change, dialect);
    got.heard.remove(0)
}

/// Checks the first line, the headers and some places of a request.
fn check_request(heard: &Heard, head: &[&str], places: &[(&str, Value)]) {
    for part in head {
        assert!(heard.head.to_lowercase().contains(part), "{part}: {}", heard.head);
    }
    for (path, value) in places {
        assert_eq!(heard.body.pointer(path), Some(value), "{path}: {:.1500}", heard.body.to_string());
    }
}

#[test]
fn dialect_requests_are_those_of_the_reference() {
    let url = json!("data:image/png;base64,iVBORwECAw==");
    let heard = request(Dialect::OpenAiResponses, Some(GrammarCarrier::Usual));
    check_request(
        &heard,
        &["post /v1/responses ", "authorization: bearer sk-very-secret"],
        &[
            ("/model", json!("scripted")),
            ("/instructions", json!("you plan")),
            ("/input/0/role", json!("user")),
            ("/input/0/content/0", json!({"type": "input_text", "text": "bring me the coke"})),
            ("/input/0/content/1", json!({"type": "input_image", "image_url": url})),
            ("/input/1/content/0", json!({"type": "output_text", "text": ""})),
            ("/store", json!(false)),
            ("/stream", json!(true)),
            ("/text/format/type", json!("json_schema")),
            ("/text/format/strict", json!(true)),
            ("/text/format/schema/type", json!("object")),
        ],
    );
    let heard = request(Dialect::OpenAiResponses, Some(GrammarCarrier::Lark));
    check_request(
        &heard,
        &[],
        &[
            ("/tools/0/type", json!("custom")),
            ("/tools/0/format/syntax", json!("lark")),
            ("/tool_choice", json!({"type": "custom", "name": "motet_policy"})),
        ],
    );
    let lark = heard.body.pointer("/tools/0/format/definition").and_then(Value::as_str).unwrap();
    assert!(lark.starts_with("start: "), "{lark:.80}");
    let head = ["post /v1/messages ", "x-api-key: sk-very-secret", "anthropic-version: 2023-06-01"];
    let heard = request(Dialect::Anthropic, Some(GrammarCarrier::Usual));
    check_request(
        &heard,
        &head,
        &[
            ("/system", json!("you plan")),
            ("/messages/0/content/0", json!({"type": "text", "text": "bring me the coke"})),
            ("/messages/0/content/1/source/media_type", json!("image/png")),
            ("/messages/0/content/1/source/data", json!("iVBORwECAw==")),
            // It refuses an empty text.
            ("/messages/1/content/0/text", json!("(empty)")),
            ("/output_config/format/type", json!("json_schema")),
            ("/output_config/format/schema/additionalProperties", json!(false)),
        ],
    );
    assert!(heard.body["max_tokens"].as_u64().is_some_and(|most| most >= 4096));
    let text = heard.body.to_string();
    for keyword in ["\"minimum\":", "\"maximum\":", "\"maxItems\":"] {
        assert!(!text.contains(keyword), "{keyword}");
    }
    let heard = request(Dialect::Anthropic, Some(GrammarCarrier::Tool));
    check_request(
        &heard,
        &head,
        &[
            ("/tools/0/strict", json!(true)),
            ("/tools/0/input_schema/type", json!("object")),
            ("/tool_choice/name", json!("motet_policy")),
        ],
    );
    assert_eq!(heard.body.get("output_config"), None);
    let heard = request(Dialect::Gemini, Some(GrammarCarrier::Usual));
    let head =
        ["post /v1beta/models/scripted:streamgeneratecontent?alt=sse ", "x-goog-api-key: sk-very-secret"];
    check_request(
        &heard,
        &head,
        &[
            ("/systemInstruction/parts/0/text", json!("you plan")),
            ("/contents/0/parts/1/inlineData", json!({"mimeType": "image/png", "data": "iVBORwECAw=="})),
            ("/contents/1/role", json!("model")),
            ("/generationConfig/responseMimeType", json!("application/json")),
            ("/generationConfig/responseJsonSchema/type", json!("object")),
        ],
    );
    let text = heard.body.to_string();
    assert!(!text.contains("\"pattern\":") && !text.contains("\"const\":"));
    assert_eq!((heard.body.get("model"), heard.body.get("stream")), (None, None));
    let heard = request(Dialect::MistralRs, Some(GrammarCarrier::Usual));
    check_request(
        &heard,
        &["post /v1/chat/completions "],
        &[
            ("/messages/1/content/1", json!({"type": "image_url", "image_url": {"url": url}})),
            ("/grammar/type", json!("json_schema")),
            ("/grammar/value/type", json!("object")),
            ("/stream_options/include_usage", json!(true)),
        ],
    );
    let heard = request(Dialect::MistralRs, Some(GrammarCarrier::Lark));
    let lark = heard.body.pointer("/grammar/value").and_then(Value::as_str).unwrap();
    assert!(lark.starts_with("%llguidance"), "{lark:.80}");
    // A dialect without a grammar.
    let bare = request(Dialect::Anthropic, None).body;
    assert!(bare.get("output_config").is_none() && bare.get("tools").is_none(), "{bare}");
}

#[test]
fn dialect_text_syntax_goes_where_a_grammar_for_it_is_taken() {
    let subset = Subset { syntax: Syntax::Text, ..Subset::default() };
    let grammar = Grammar::new(&session().signatures(), subset);
    for (dialect, is_taken) in [
        (Dialect::OpenAiResponses, true),
        (Dialect::MistralRs, true),
        (Dialect::Anthropic, false),
        (Dialect::Gemini, false),
    ] {
        let server = Server::new(vec![events("")]);
        let asked = Client::new(settings(&server, dialect)).unwrap().ask(&[], &grammar);
        assert_eq!(asked.is_ok(), is_taken, "{dialect:?}");
    }
}

#[test]
fn client_key_that_a_server_sends_back_is_cut_out() {
    let piece = |text: &str| format!("data: {}\n\n", json!({"choices": [{"delta": {"content": text}}]}));
    let end = "data: {\"choices\": [{\"delta\": {}, \"finish_reason\": \"stop\"}]}\n\ndata: [DONE]\n\n";
    for pieces in [
        vec!["a sk-very-secret b"],
        vec!["a sk-", "very", "-secret b"],
        vec!["a s", "k", "-", "v", "e", "r", "y", "-", "s", "e", "c", "r", "e", "t b"],
        // As JSON within the text may spell it.
        vec!["a \\u0073k-very-s\\u0065cret b"],
        vec!["a \\u00", "73\\u006", "B-very-secre\\u007", "4 b"],
        // As Motet prints it.
        vec!["a \\u{73}k-very-s\\u{000065}cret b"],
        vec!["a \\u", "{7", "3}k-very-secre\\u{74", "} b"],
    ] {
        let body: String = pieces.iter().map(|text| piece(text)).collect();
        let got = exchange(events(&(body + end)), |settings| settings, Dialect::Vllm);
        assert_eq!(got.text, "a [key] b", "{pieces:?}");
    }
    let got = exchange(events(&(piece("\\u{73}k-very-s\\u{7a}") + end)), |settings| settings, Dialect::Vllm);
    assert_eq!(got.text, "\\u{73}k-very-s\\u{7a}");
    // The beginning of a key that does not go on is text, also at the end.
    let got =
        exchange(events(&(piece("a sk-ve") + &piece("ll sk-") + end)), |settings| settings, Dialect::Vllm);
    assert_eq!(got.text, "a sk-vell sk-");
    let broken = "data: {\"error\": {\"message\": \"bad key sk-very-secret\"}}\n\n";
    let got = exchange(events(broken), |settings| settings, Dialect::Vllm);
    assert!(got.end.unwrap_err().to_string().contains("bad key [key]"));
    // Also where JSON has to escape it, and in an answer that is read whole.
    let server = Server::new(vec![answer("401 Unauthorized", "", r#"{"error": "no such key: a\"b"}"#)]);
    let key = ApiKey::new("a\"b");
    let client = Client::new(ClientSettings { key, ..settings(&server, Dialect::OpenAi) }).unwrap();
    let why = client.once(&json!({})).unwrap_err().to_string();
    assert!(why.contains("no such key: [key]"), "{why}");
    let server = Server::new(vec![Act::AtOnce { text: format!("it is {KEY}") }]);
    let whole = Client::new(settings(&server, Dialect::OpenAi)).unwrap().once(&json!({})).unwrap();
    assert_eq!(content(None, &whole).as_deref(), Some("it is [key]"));
    // Also where the parts of an answer, or its words in one line, have it only together.
    let part = |text: &str| json!({"type": "text", "text": text});
    let parts = json!({"type": "message", "content": [part("sk-very"), part("-secret")]}).to_string();
    let server = Server::new(vec![answer("200 OK", "", &parts)]);
    let why = Client::new(settings(&server, Dialect::Anthropic)).unwrap().once(&json!({})).unwrap_err();
    assert!(why.to_string().contains("the key in it, in parts"), "{why}");
    let server = Server::new(vec![answer("401 Unauthorized", "", "no such key: a\n b")]);
    let key = ApiKey::new("a b");
    let client = Client::new(ClientSettings { key, ..settings(&server, Dialect::OpenAi) }).unwrap();
    let why = client.once(&json!({})).unwrap_err().to_string();
    assert!(why.contains("no such key: [key]"), "{why}");
}

#[test]
fn client_key_follows_no_redirect() {
    let other = Server::new(vec![Act::says("hello")]);
    for status in ["302 Found", "307 Temporary Redirect", "308 Permanent Redirect"] {
        let place = other.url.replace("127.0.0.1", "localhost");
        let headers = format!("Location: {place}/v1/chat/completions\r\n").leak();
        let got = exchange(answer(status, headers, ""), |settings| settings, Dialect::Vllm);
        assert!(got.heard[0].head.contains(KEY), "the server that is asked gets it");
        let why = got.end.unwrap_err().to_string();
        assert!(why.contains(status.split(' ').next().unwrap()), "{why}");
    }
    assert!(other.heard().is_empty(), "{:?}", other.heard());
}

#[test]
fn client_says_nothing_to_a_server_whose_certificate_nobody_vouches_for() {
    let pem = include_bytes!("recordings/untrusted.pem");
    let chain = CertificateDer::pem_slice_iter(pem).map(Result::unwrap).collect();
    let _ = rustls::crypto::ring::default_provider().install_default();
    let config = rustls::ServerConfig::builder().with_no_client_auth();
    let config = config.with_single_cert(chain, PrivateKeyDer::from_pem_slice(pem).unwrap()).unwrap();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("https://localhost:{}", listener.local_addr().unwrap().port());
    let served = std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let mut session = rustls::ServerConnection::new(Arc::new(config)).unwrap();
        // It ends where the client refuses the certificate, and would read what a client that does not says.
        let mut said = [0; 64];
        let heard = rustls::Stream::new(&mut session, &mut stream).read(&mut said);
        heard.map_err(|why| why.to_string())
    });
    let address = ServerUrl::new(&url, None).unwrap();
    let settings = ClientSettings { key: ApiKey::new(KEY), retries: 0, ..ClientSettings::new(address, "m") };
    let why = Client::new(settings).unwrap().once(&json!({})).unwrap_err().to_string();
    assert!(why.to_lowercase().contains("certificate"), "{why}");
    assert!(served.join().unwrap().is_err(), "it was spoken to");
}
