//! Documents that are no graph are refused with a clear word.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use motet_graph::arbitrary::{StepSketch, graph};
use motet_graph::{decode, draw, encode, hash};

#[track_caller]
fn refuse(text: &str, expected: &str) {
    let error = decode(text).expect_err("it must be refused").to_string();
    assert!(error.starts_with(expected), "{error}");
}

fn document() -> String {
    encode(&graph(&[StepSketch::go("table")]))
}

#[test]
fn forms() {
    refuse("", "no graph: EOF while parsing a value at line 1 column 0");
    refuse("[]", "no graph: ");
    refuse("{}", "no graph: missing field `motet_graph`");
    refuse("{\"motet_graph\": 1}", "the graph has version 1; this program reads version 2");
    refuse("{\"motet_graph\": 2}", "no graph: missing field `hash`");
    refuse(&document().replacen("\"policy\"", "\"polcy\"", 1), "no graph: unknown field `polcy`");
    refuse(&document().replacen("\"retries\"", "\"x\":1,\"retries\"", 1), "no graph: unknown field `x`");
    refuse(
        &document().replacen("\"robot\"", "\"policy\":\"b\",\"robot\"", 1),
        "no graph: duplicate field `policy`",
    );
    refuse(&format!("{} {{}}", document()), "no graph: trailing characters");
    refuse(&"[".repeat(100_000), "no graph: ");
    refuse(
        &document().replace("table", "shelf"),
        "the graph was changed after it was written: its hash is sha256:",
    );
    refuse(
        &" ".repeat(64 * 1024 * 1024 + 1),
        "the graph has 67108865 bytes, more than the limit of 67108864",
    );
}

#[test]
fn the_hash_stands_in_the_document() {
    let graph = graph(&[StepSketch::go("table")]);
    assert!(encode(&graph).starts_with(&format!("{{\"motet_graph\":2,\"hash\":\"{}\",", hash(&graph))));
}

#[test]
fn the_deepest_graph_can_be_written_read_and_drawn() {
    let deep = (0..1_024).fold(StepSketch::say("a"), |inner, _| StepSketch::Sequence(vec![inner]));
    let graph = graph(&[deep]);
    assert_eq!(decode(&encode(&graph)).unwrap(), graph);
    assert!(draw::text(&graph).lines().count() > 1_000);
    assert!(draw::dot(&graph).lines().count() > 1_000);
    assert!(draw::mermaid(&graph).lines().count() > 1_000);
}
