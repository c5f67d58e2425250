//! Every construct of the canonical subset: policies written by hand keep their meaning in both spellings,
//! are accepted byte by byte and allowed by the exported grammars; and random walks write each construct.

use crate::common::peer::{Peer, environment};
use crate::common::tokens::{END, tokens};
use crate::common::walks::{Dice, Ended, walk};
use crate::common::{errors, session};
use motet_decode::{AcceptorFactory, Grammar, Modifiers, Subset, canonical};
use motet_syntax::{FileId, Source, Syntax};

const POLICIES: [&str; 18] = [
    r#"policy clean for hsr { go(kitchen_table) try { pick(mug_1, auto) } catch any { say("no") } finally {
        if holding(mug_1) { go(sink) place(mug_1, sink) } home() } }"#,
    "policy whole for hsr { go(sink) } finally { home() }",
    r#"policy kept for hsr keep out of stairs, distance(user) >= 0.5 m { go(sink) sequence g { go(trash) }
        finally { wait 2 s } } finally { wait until distance(user) > 1 m sequence g { home() } }"#,
    "policy rules for hsr { keep distance(user) >= 1 m, out of stairs { go(sink) } finally { home() } }",
    "policy timed for hsr { within 30 s { go(sink) } try { within 5 s { home() } } catch timeout { done } }",
    r#"policy split for hsr { let x = detect("mug") within 3 s { say("{x}") within 2 s within 1 s { home() } }
        go(sink) slowly within 9 s { home() } finally { wait 1 s }
        wait until distance(user) > 1 m within 5 s { home() } }"#,
    "policy delay for hsr { wait 5 s go(sink) wait 0.25 s }",
    r#"policy lists for hsr { go(kitchen_table) let cups = detect_all("cup") let n = count(cups)
        if count(cups) > 2 or is_empty(cups) { say("I see {n} or {count(cups)} cups") }
        if not is_empty(cups) { say("such as {first(cups)}") pick(first(cups), auto) } }"#,
    r#"policy names for hsr { let d = distance(user) let w = mug_1.mass say("{d}, {w}")
        go(kitchen_table) let cups = detect_all("cup") let cup = first(cups) pick(cup, auto) }"#,
    r#"policy values for hsr { let cups = detect_all("cup")
        if count(cups) == 0 { cannot "only {count(cups)}" }
        if not (count(cups) < 9) { replan "{first(cups)}" } fail "{cups}" }"#,
    "policy manners for hsr { go(sink) at 30 % go(trash) slowly within 40 s go(sink) at 2.5 % retry 1 }",
    r#"policy again for hsr { sequence a { let x = detect("mug") } finally { let y = detect("cup") }
        sequence b { let x = detect("cup") let y = detect("mug") } say("{x} {y}") }"#,
    r#"policy goal for hsr achieves on(mug_1, sink) { go(kitchen_table) pick(mug_1, auto) go(sink)
        sequence s { place(mug_1, sink) done } finally { if visible(user) { say("so") } home() } }"#,
    r#"policy caught for hsr { go(kitchen_table) try { pick(mug_1, auto) } catch slipped, timeout as e {
        if e.kind == slipped { say("{e.kind}: {e.text}") } let why = e.text say("{why} {e}") fail "{e.text}" }
        try { home() } catch any as e { if not (e.kind != timeout) { done } } }"#,
    r#"policy found -> Object for hsr { go(kitchen_table) let mug = detect("mug")
        if visible(user) { done mug } monitor { when visible(user) then done mug } during { home() }
        done mug }"#,
    r#"policy counted -> Int for hsr keep out of stairs { let cups = detect_all("cup")
        let n = count(cups) if visible(user) { done n } fail "{n}" }"#,
    r#"policy posed for hsr { go_to_pose(pose(1.2 m, 0.5 m, 0 m, 1.5708 rad))
        go_to_pose(pose(-1 m, 0 m, 90 deg)) }"#,
    r#"policy poses for hsr { go(kitchen_table) pick(mug_1, auto) go(sink)
        place_at(mug_1, sink, pose(0.1 m, 0.2 m, 0 rad)) }"#,
];

fn read(text: &str) -> motet_syntax::ast::Policy {
    let parsed = motet_syntax::read(&Source::new("policy", text), FileId(7));
    assert!(parsed.diagnostics.is_empty(), "{text}\n{:?}", parsed.diagnostics);
    parsed.file.policies().next().unwrap().clone()
}

/// The acceptor of the text syntax knows no field.
fn is_decoded(spelled: &str) -> bool {
    spelled.starts_with('{') || !spelled.contains("mug_1.mass")
}

#[test]
fn every_construct_is_spelled_accepted_and_exported() {
    let session = session("hsr", "kitchen");
    let environment = environment(&tokens(), END);
    for syntax in [Syntax::Json, Syntax::Text] {
        let subset = Subset { syntax, modifiers: Modifiers::Written, ..Subset::default() };
        let grammar = Grammar::new(&session.signatures(), subset);
        let factory = AcceptorFactory::new(&session, subset);
        let mut peers = vec![Peer::new(&environment, &session, subset)];
        peers.extend(Peer::of_schema(&environment, &session, subset));
        for policy in POLICIES {
            let wrong = errors(&session, policy);
            assert!(wrong.is_empty(), "{policy}\n{wrong:#?}");
            let spelled = canonical(&read(policy), &grammar).unwrap_or_else(|why| panic!("{why}\n{policy}"));
            assert_eq!(canonical(&read(&spelled), &grammar).unwrap(), spelled);
            assert!(errors(&session, &spelled).is_empty(), "{spelled}");
            for peer in &peers {
                let mut matcher = peer.start();
                for (at, byte) in spelled.bytes().enumerate() {
                    let is_taken = matcher.consume_token(u32::from(byte)).is_ok();
                    assert!(is_taken, "{} ⟂ {}", &spelled[..at], &spelled[at..]);
                }
                assert!(matcher.is_accepting().unwrap(), "{spelled}");
            }
            if is_decoded(&spelled) {
                let mut acceptor = factory.acceptor(20_000).unwrap();
                let taken = acceptor.accept(spelled.as_bytes());
                assert_eq!(&spelled[..taken], spelled, "refused: {}", &spelled[taken..]);
                assert!(acceptor.is_accepting(), "{spelled}");
            }
        }
    }
}

/// A step in the body of a monitor may not make it fire (M0506).
#[test]
fn acceptor_lets_no_monitor_fire_by_itself() {
    let session = session("hsr", "kitchen");
    let factory = AcceptorFactory::new(&session, Subset { syntax: Syntax::Text, ..Subset::default() });
    let begun =
        "policy p for hsr { go(kitchen_table) monitor { when holding(mug_1) then fail \"no\" } during { ";
    for (call, is_open) in [("pick(mug_1, auto)", false), ("say(\"so\")", true), ("go(sink)", true)] {
        let text = format!("{begun}{call} }} }}");
        let wrong = errors(&session, &text);
        assert_eq!(wrong.is_empty(), is_open, "{text}\n{wrong:?}");
        let mut acceptor = factory.acceptor(2000).unwrap();
        assert_eq!(acceptor.accept(text.as_bytes()) == text.len(), is_open, "{text}");
    }
}

/// The constructs with what each of them is found by, in JSON and in text; nothing where the acceptor does
/// not write it. A `#` is a digit.
const FOUND_BY: [(&str, &str, &str); 26] = [
    ("cleanup", "],\"finally\":[{", "} finally {"),
    ("keep", "{\"keep\":[", " keep "),
    ("keep of the policy", ",\"keep\":[", "policy % keep "),
    ("out of a zone", "{\"out_of\":", "out of stairs"),
    ("distance", "{\"distance\":", "distance(%) >="),
    ("deadline of a block", "{\"within\":", " within # s {"),
    ("wait for a time", "{\"wait\":#", " wait #"),
    ("let of a length", "\"be\":{\"get\":\"count\"", " = count("),
    ("let of an element", "\"be\":{\"get\":\"first\"", " = first("),
    ("let of a measure", "\"be\":{\"get\":\"distance\"", " = distance("),
    ("let of a field", "\"be\":{\"field\"", ""),
    ("comparison of a length", "\"get\":\"count\",\"of\":\"$%\",\"is\"", "count(%) "),
    (
        "first element as an argument",
        "to\":{\"get\":\"first\"|object\":{\"get\":\"first\"|what\":{\"get\":\"first\"",
        "(first(",
    ),
    ("empty list", "{\"is\":\"is_empty\"", " is_empty("),
    ("length in a text", "{count($", "{count("),
    ("element in a text", "{first($", "{first("),
    ("part as a manner", "\"manner\":#", " at # %"),
    ("cannot", "{\"end\":\"cannot\"", " cannot \""),
    ("call", "{\"do\":", "("),
    ("name of a failure", "],\"as\":\"", " as % {"),
    ("kind of a failure", "{\"field\":\"kind\"", ".kind ==|.kind !="),
    ("let of the text of a failure", "{\"field\":\"text\"", " = %.text "),
    ("failure in a text", ".kind}|.text}", ".kind}|.text}"),
    ("type of a result", "\"result\":\"%\",\"robot\"", " -> "),
    ("result", "\"done\",\"result\":\"$", " done % }"),
    ("pose", "{\"pose\":[", "(pose("),
];

#[test]
fn walks_write_every_construct_in_json() {
    write_all(Syntax::Json);
}

#[test]
fn walks_write_every_construct_in_text() {
    write_all(Syntax::Text);
}

fn write_all(syntax: Syntax) {
    let session = session("hsr", "kitchen");
    let subset = Subset { syntax, modifiers: Modifiers::Written, ..Subset::default() };
    let factory = AcceptorFactory::new(&session, subset);
    let mut counts = [0usize; FOUND_BY.len()];
    for seed in 0..WALKS {
        let mut dice = Dice::new(seed);
        let text = match walk(&factory, 3000, 24, &mut dice).unwrap() {
            Ended::Whole(text) => text,
            Ended::Stuck(text) => panic!("{seed}: stuck after {text}"),
        };
        let wrong = errors(&session, &text);
        assert!(wrong.is_empty(), "{seed}: {wrong:#?}\n{text}");
        for ((_, json, plain), count) in FOUND_BY.iter().zip(&mut counts) {
            *count += usize::from(has(&text, if syntax == Syntax::Json { json } else { plain }));
        }
    }
    for ((name, ..), count) in FOUND_BY.iter().zip(&counts) {
        println!("{count} of {WALKS} walks: {name}");
    }
    let is_missing = |((_, json, plain), count): &(&(&str, &str, &str), &usize)| {
        **count == 0 && !(if syntax == Syntax::Json { json } else { plain }).is_empty()
    };
    let missing: Vec<_> = FOUND_BY.iter().zip(&counts).filter(is_missing).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// The number of walks in which each construct occurs.
const WALKS: u64 = 60;

/// One of the patterns occurs: `#` is a number, and `%` is anything without a quote or a bracket.
fn has(text: &str, pattern: &str) -> bool {
    let occurs = |pattern: &str| (0..text.len()).any(|at| begins(&text[at..], pattern));
    !pattern.is_empty() && pattern.split('|').any(occurs)
}

fn begins(text: &str, pattern: &str) -> bool {
    let Some(next) = pattern.chars().next() else { return true };
    let rest = &pattern[next.len_utf8()..];
    let run = |is_in: &dyn Fn(u8) -> bool| text.bytes().take_while(|byte| is_in(*byte)).count();
    match next {
        '#' => {
            let digits = run(&|byte| byte.is_ascii_digit() || byte == b'.');
            digits > 0 && begins(&text[digits..], rest)
        }
        '%' => {
            let most = run(&|byte| !b"\"[]{}".contains(&byte));
            (0..=most).any(|count| begins(&text[count..], rest))
        }
        next => text.starts_with(next) && begins(&text[next.len_utf8()..], rest),
    }
}
