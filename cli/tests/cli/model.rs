//! `motet do` with a model on a server, there or not.

use crate::grammar::{scripted, server};
use crate::support::Place;
use serde_json::{Value, json};
use std::io::{Read as _, Write as _};
use std::net::TcpListener;
use std::sync::{Arc, Mutex};

const DO: &str = "do go_to_the_counter --robot hsr --scene kitchen --no-geometry --speed max --ask never";

#[test]
fn reply_is_carried_out_and_kept_and_the_key_is_not() {
    let place = Place::new("model_there").file("room.png", [0x89, b'P', b'N', b'G']);
    let reply = concat!(
        r#"{"choices": [{"message": {"content": "Here it is:\n```\npolicy go_there for hsr {"#,
        r#"\n    go(counter)\n}\n```\n"}}]}"#
    );
    let url = server("200 OK", reply);
    let line = format!("{DO} --planner {url} --model m --image room.png --key-from SOME_KEY --record kept");
    let ran = place.run_with(&line, b"", &[("SOME_KEY", "very-secret")]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.stderr.contains("asking m at http://127.0.0.1"), "{}", ran.stderr);
    assert!(ran.stderr.contains("passes the check"), "{}", ran.stderr);
    let kept = place.read("kept/talk.jsonl");
    let whats: Vec<String> = kept
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap()["what"].as_str().unwrap().to_owned())
        .collect();
    assert_eq!(whats, ["request", "asked", "taken", "policy", "run", "ended", "outcome"]);
    assert!(!format!("{kept}{}{}", ran.stdout, ran.stderr).contains("very-secret"));
}

/// What `motet do` does with a policy that asks for a point, and a model's answer to that: its words, its
/// record, and the bodies of its requests.
fn pointed(name: &str, answer: &str) -> (Option<i32>, String, Vec<Value>, Vec<Value>) {
    let policy =
        "policy touch for hsr {\n    let handle = ground(mug_1, \"the handle\")\n    go(counter)\n}\n";
    let says = |text: &str| json!({"choices": [{"message": {"content": text}}]}).to_string();
    // A point that cannot be used is asked for once more.
    let (url, heard) = scripted("200 OK", vec![says(policy), says(answer), says(answer)]);
    let place = Place::new(name);
    let ran = place.run(&format!("{DO} --planner {url} --model m --camera --record kept"));
    let kept = place.read("kept/talk.jsonl");
    let kept = kept.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let heard = heard.lock().unwrap().clone();
    (ran.code, ran.stderr, kept, heard)
}

#[test]
fn choice_of_a_policy_is_the_operators() {
    let policy = "policy choose_one for hsr {\n    let drink = choose(\"Which one?\", [coke, bottle])\n    \
                  say(\"You chose {drink}.\")\n}\n";
    let reply = json!({"choices": [{"message": {"content": policy}}]}).to_string();
    for (answer, code, words) in [("the water bottle", 0, "You chose"), ("neither", 3, "refused")] {
        let (url, _) = scripted("200 OK", vec![reply.clone()]);
        let place = Place::new("model_choice").file("answers.txt", format!("{answer}\n"));
        let line = DO.replace("--ask never", "--ask script answers.txt");
        let ran = place.run(&format!("{line} --planner {url} --model m"));
        assert!(ran.stderr.contains("(coke, bottle)"), "{}", ran.stderr);
        assert_eq!(ran.code, Some(code), "{answer}: {}{}", ran.stdout, ran.stderr);
        assert!(format!("{}{}", ran.stdout, ran.stderr).contains(words), "{}{}", ran.stdout, ran.stderr);
    }
    let (url, _) = scripted("200 OK", vec![reply]);
    let ran = Place::new("model_no_choice").run(&format!("{DO} --planner {url} --model m"));
    assert_eq!(ran.code, Some(3), "nobody chose: {}{}", ran.stdout, ran.stderr);
}

#[test]
fn model_sees_what_the_camera_sees_and_points_at_it() {
    let (code, stderr, kept, heard) = pointed("model_points", "{\"point\": [320, 240]}");
    assert_eq!((code, heard.len()), (Some(0), 2), "{stderr}");
    let picture = |part: &Value| part["image_url"]["url"].as_str().unwrap_or_default().to_owned();
    let (room, mug) =
        (picture(&heard[0]["messages"][1]["content"][1]), picture(&heard[1]["messages"][0]["content"][1]));
    assert!(room.starts_with("data:image/png;base64,") && mug.starts_with("data:image/png;base64,"));
    assert_ne!(room, mug, "the camera turns to the mug");
    let point = kept.iter().find(|line| line["what"] == "pointed").unwrap();
    let at: Vec<f64> = point["xyz"].as_array().unwrap().iter().map(|part| part.as_f64().unwrap()).collect();
    // The mug stands at (1.98, 0.3), from 0.72 m to 0.82 m.
    assert!((at[0] - 1.98).hypot(at[1] - 0.3) < 0.05 && (0.71..0.83).contains(&at[2]), "{at:?}");
    assert!(stderr.contains("the handle of mug_1: at (1.9"), "{stderr}");
}

#[test]
fn point_that_is_none_is_said_with_the_reason() {
    for (name, answer, words) in [
        ("outside", "{\"point\": [700, 20]}", "outside of the image of 640 x 480 pixels"),
        ("sky", "{\"point\": [5, 5]}", "there is no depth within 3 pixels of (5.0, 5.0)"),
        ("nan", "{\"point\": [NaN, 20]}", "the answer is no point"),
        ("words", "I see no handle.", "the answer is no point"),
    ] {
        let (code, stderr, kept, _) = pointed(&format!("model_points_{name}"), answer);
        let why = kept.iter().find(|line| line["what"] == "pointed").map(|line| line["why"].to_string());
        assert!(why.as_ref().is_some_and(|why| why.contains(words)), "{name}: {why:?}");
        assert!(stderr.contains(words), "{name}: {stderr}");
        assert_eq!(code, Some(3), "{name}: {stderr}");
    }
}

#[test]
fn server_that_is_not_there_is_said_and_the_builtin_planner_plans_only_if_asked() {
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
    assert!(ran.stderr.contains("planned without the model: m at"), "{}", ran.stderr);
}

#[test]
fn do_reports_unusable_flags_before_it_asks() {
    let place = Place::new("model_flags").file("room.txt", "no image").file("empty.txt", "\n");
    for (flags, words) in [
        ("--planner localhost", "address"),
        ("--planner http://localhost --image room.txt", "no PNG"),
        ("--planner http://localhost --key-from NO_SUCH_KEY", "NO_SUCH_KEY"),
        ("--planner http://localhost --key-from sk-0123", "no name of an environment variable"),
        ("--planner http://models.example --key-from PATH", "without encryption"),
        ("--planner http://models.example --key-file room.txt", "without encryption"),
        ("--planner http://localhost --key-file empty.txt", "holds no key"),
        ("--planner http://localhost --key-file gone.txt", "gone.txt"),
        ("--planner http://localhost --dialect openai --carrier tool", "--dialect anthropic"),
        ("--planner http://0.0.0.0 --key-from NO_SUCH_KEY", "NO_SUCH_KEY"),
        ("--camera", "--planner URL"),
        ("--planner http://localhost --dialect ollama --carrier lark", "--dialect vllm"),
    ] {
        let ran = place.run(&format!("{DO} {flags}"));
        assert_eq!((ran.code, ran.stderr.contains(words)), (Some(2), true), "{flags}: {}", ran.stderr);
        assert!(!ran.stderr.contains("sk-0123"), "{}", ran.stderr);
    }
}

/// A proxy that grants each connection and then hangs up: its address, and all that it is told.
fn proxy() -> (String, Arc<Mutex<Vec<u8>>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let told = Arc::new(Mutex::new(Vec::new()));
    let heard = Arc::clone(&told);
    std::thread::spawn(move || {
        for mut stream in listener.incoming().map_while(Result::ok) {
            let mut piece = [0; 4096];
            for answer in [&b"HTTP/1.1 200 OK\r\n\r\n"[..], b""] {
                let read = stream.read(&mut piece).unwrap_or(0);
                heard.lock().unwrap().extend_from_slice(&piece[..read]);
                let _ = stream.write_all(answer);
            }
        }
    });
    (address, told)
}

#[test]
fn proxy_is_said_without_its_password_and_sees_no_key() {
    let place = Place::new("model_proxy");
    let ask = |server: &str, flags: &str, variables: &[(&str, &str)]| {
        let (address, told) = proxy();
        let through = format!("http://me:pass-word@{address}");
        let mut all = vec![("SOME_KEY", "very-secret"), ("NO_PROXY", ""), ("no_proxy", "")];
        for name in ["HTTP_PROXY", "http_proxy", "HTTPS_PROXY", "https_proxy", "ALL_PROXY", "all_proxy"] {
            all.push((name, through.as_str()));
        }
        all.extend(variables);
        let line = format!("{DO} --planner {server} --model m --key-from SOME_KEY --timeout 3 {flags}");
        let ran = place.run_with(&line, b"", &all);
        assert!(!ran.stderr.contains("pass-word") && !ran.stderr.contains("very-secret"), "{ran:#?}");
        let said = ran.stderr.contains(&format!("go through the proxy http://{address}\n"));
        let told = String::from_utf8_lossy(&told.lock().unwrap()).into_owned();
        (ran.code, said, told)
    };
    // With encryption the proxy sees where it goes, and neither the key nor the request.
    let (code, is_said, told) = ask("https://models.example", "", &[]);
    assert_eq!((code, is_said), (Some(3), true), "{told}");
    assert!(told.starts_with("CONNECT models.example:443 ") && told.contains("Basic "), "{told}");
    assert!(!told.contains("very-secret") && !told.contains("go_to_the_counter"), "{told}");
    // Without, nothing is sent but by permission.
    let (code, is_said, told) = ask("http://models.example", "", &[]);
    assert_eq!((code, is_said, told.as_str()), (Some(2), false, ""));
    let (code, is_said, told) = ask("http://models.example", "--key-in-clear", &[]);
    assert_eq!((code, is_said), (Some(3), true), "{told}");
    assert!(told.contains("very-secret"), "{told}");
    // Nothing stands between this machine and itself, or before what is excepted.
    for (server, variables) in [
        ("http://127.0.0.1:9", &[][..]),
        ("https://models.invalid", &[("NO_PROXY", "invalid"), ("no_proxy", "invalid")]),
    ] {
        let (code, is_said, told) = ask(server, "", variables);
        assert_eq!((code, is_said, told.as_str()), (Some(3), false, ""), "{server}");
    }
}
