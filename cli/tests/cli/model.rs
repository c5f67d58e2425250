//! `motet do` with a model on a server, there or not.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use crate::grammar::server;
use crate::support::Place;

const DO: &str = "do go_to_the_counter --robot hsr --scene kitchen --no-geometry --speed max --ask never";

#[test]
fn a_reply_is_carried_out_and_kept_and_the_key_is_not() {
    let place = Place::new("model_there").file("room.png", [0x89, b'P', b'N', b'G']);
    let reply = r#"{"choices": [{"message": {"content": "Here it is:\n```\npolicy go_there for hsr {\n    go(counter)\n}\n```\n"}}]}"#;
    let url = server("200 OK", reply);
    let line = format!("{DO} --planner {url} --model m --image room.png --key-from SOME_KEY --record kept");
    let ran = place.run_with(&line, b"", &[("SOME_KEY", "very-secret")]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stderr.contains("asking m at http://127.0.0.1"), "{}", ran.stderr);
    assert!(ran.stderr.contains("it passes the check"), "{}", ran.stderr);
    let kept = place.read("kept/talk.jsonl");
    let whats: Vec<String> = kept
        .lines()
        .map(|line| {
            serde_json::from_str::<serde_json::Value>(line).unwrap()["what"].as_str().unwrap().to_owned()
        })
        .collect();
    assert_eq!(whats, ["request", "asked", "taken", "policy", "ended", "outcome"]);
    assert!(!format!("{kept}{}{}", ran.stdout, ran.stderr).contains("very-secret"));
}

#[test]
fn a_server_that_is_not_there_is_said_and_the_builtin_planner_plans_only_if_asked() {
    let place = Place::new("model_gone");
    let line = format!("{DO} --planner http://127.0.0.1:9 --model m --timeout 60");
    let ran = place.run(&line);
    assert_eq!(ran.code, Some(3), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("m at http://127.0.0.1:9/v1/chat/completions: it cannot be reached"),
        "{}",
        ran.stderr
    );
    let ran = place.run(&format!("{line} --fallback"));
    assert!(ran.stderr.contains("planned without a model, since m at"), "{}", ran.stderr);
}

#[test]
fn what_cannot_be_used_is_said_before_anything_is_asked() {
    let place = Place::new("model_flags").file("room.txt", "no image");
    for (flags, words) in [
        ("--planner localhost", "address"),
        ("--planner http://localhost --image room.txt", "no PNG"),
        ("--planner http://localhost --key-from NO_SUCH_KEY", "NO_SUCH_KEY"),
    ] {
        let ran = place.run(&format!("{DO} {flags}"));
        assert_eq!((ran.code, ran.stderr.contains(words)), (Some(2), true), "{flags}: {}", ran.stderr);
    }
}
