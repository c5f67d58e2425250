//! The acceptor against the checker: what it lets a model write checks without an error, every walk ends,
//! and every canonical policy that checks is accepted, byte by byte.

use crate::common::tokens::{END, tokens};
use crate::common::walks::{Dice, Ended, KINDS, of_kind, steps, walk, written};
use crate::common::{SETTINGS, errors, session};
use motet_compiler::Session;
use motet_compiler::incremental::IncrementalChecker;
use motet_compiler::signature::Type;
use motet_decode::{AcceptorFactory, Decoder, Grammar, Modifiers, Subset, Vocabulary, canonical};
use motet_syntax::{FileId, Source, Syntax};

fn subset(modifiers: Modifiers) -> Subset {
    Subset { modifiers, ..Subset::default() }
}

/// The number of walks for each pair of robot and scene; `MOTET_WALKS` overrides it.
fn walks() -> usize {
    std::env::var("MOTET_WALKS").ok().and_then(|count| count.parse().ok()).unwrap_or(4)
}

#[test]
fn acceptor_walks_in_json_check() {
    write_at_random(Syntax::Json);
}

#[test]
fn acceptor_walks_in_text_check() {
    write_at_random(Syntax::Text);
}

fn write_at_random(syntax: Syntax) {
    let (mut lengths, mut done, mut all) = (Vec::new(), 0, 0);
    let mut kinds = [0usize; KINDS.len()];
    for (index, (robot, scene)) in SETTINGS.into_iter().enumerate() {
        let session = session(robot, scene);
        for (kind, modifiers) in [Modifiers::Default, Modifiers::Written].into_iter().enumerate() {
            let factory = AcceptorFactory::new(&session, Subset { syntax, ..subset(modifiers) });
            for round in 0..walks() {
                let seed = (index * 2 + kind) * 1_000_000 + round;
                let mut dice = Dice::new(u64::try_from(seed).unwrap());
                let budget = [600, 3000, 6000][dice.below(3)];
                let wanted = 10 + dice.below(30);
                let text = match walk(&factory, budget, wanted, &mut dice).unwrap() {
                    Ended::Whole(text) => text,
                    Ended::Stuck(text) => panic!("{robot} {scene} {seed}: stuck after {text}"),
                };
                assert!(text.len() <= budget, "{seed}: {} bytes of {budget}", text.len());
                let wrong = errors(&session, &text);
                assert!(wrong.is_empty(), "{robot} {scene} {seed}: {wrong:#?}\n{text}");
                push_all(&session, &text, syntax);
                all += 1;
                lengths.push(steps(&text));
                done += usize::from(!last_fails(&text));
                for (kind, count) in KINDS.iter().zip(&mut kinds) {
                    *count += usize::from(of_kind(&text, kind) > 0);
                }
            }
        }
    }
    lengths.sort_unstable();
    println!(
        "{all} walks, {} steps at the median, {done} end in done, {kinds:?}",
        lengths[lengths.len() / 2]
    );
}

/// A policy that checks is right step by step too.
fn push_all(session: &Session, text: &str, syntax: Syntax) {
    let parsed = motet_syntax::read(&Source::new("policy.json", text), FileId(7));
    let policy = parsed.file.policies().next().unwrap();
    let (mut checker, _) = IncrementalChecker::new(session, policy, syntax);
    for step in &policy.body.steps {
        assert!(checker.push(session, step), "step {} of {text}", checker.len());
    }
}

/// Beside what runs at once many calls are asked in one proof: each is open exactly where it checks alone.
#[test]
fn acceptor_opens_concurrent_calls_that_check() {
    let session = session("hsr", "kitchen");
    let factory = AcceptorFactory::new(&session, subset(Modifiers::Default));
    let near = r#"{"get":"distance","to":"user","is":"less","than":0.5}"#;
    let restart = format!(
        r#"{{"monitor":[{{"when":{near},"for":null,"then":{{"react":"restart","at_most":3}}}}],"during":["#
    );
    let then = r#"{"react":"resume","at_most":3,"steps":[{"do":"go","to":"sink"}],"finally":null}"#;
    let resume = format!(r#"{{"monitor":[{{"when":{near},"for":null,"then":{then}}}],"during":["#);
    let branch = r#"{"parallel":[[{"do":"go","to":"fridge_1"}],["#.to_owned();
    let (mut open, mut closed) = (0, 0);
    for (begin, end) in [(restart, "]}"), (resume, "]}"), (branch, "]]}")] {
        let head =
            r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"steps":["#;
        let begin = format!(r#"{head}{{"do":"go","to":"fridge_1"}},{begin}"#);
        for callable in &session.signatures().callables {
            let [param] = callable.params.as_slice() else { continue };
            if callable.is_policy || callable.result.is_some() {
                continue;
            }
            for (entity, _) in &session.signatures().entities {
                let call = format!(r#"{{"do":"{}","{}":"{entity}"}}"#, callable.name, param.name);
                let text = format!(r#"{begin}{call},{{"end":"fail","why":"no"}}{end}],"finally":null}}"#);
                let wrong = errors(&session, &text);
                let mut acceptor = factory.acceptor(8000).unwrap();
                let is_open = acceptor.accept(text.as_bytes()) == text.len();
                let taken = String::from_utf8_lossy(acceptor.bytes()).into_owned();
                assert_eq!(is_open, wrong.is_empty(), "{wrong:#?}\n{text}\n{taken}");
                *if is_open { &mut open } else { &mut closed } += 1;
            }
        }
    }
    println!("{open} open, {closed} closed");
    assert!(open > 20 && closed > 20, "{open} open, {closed} closed");
}

/// A fact that a step has made certain lasts through the next steps: one that takes as long as a monitor asks
/// for is refused, also in a policy that is called. A `wait` may be shorter.
#[test]
fn acceptor_refuses_steps_that_outlast_a_condition() {
    let session = session("hsr", "living_room");
    let subset = Subset { syntax: Syntax::Text, ..subset(Modifiers::Default) };
    let factory = AcceptorFactory::new(&session, subset);
    let monitor = r#"policy p for hsr { monitor { when holding(any) for 0.7 s then cannot "no" } during {"#;
    let pick = "go(cup) inspect(cup) pick(cup, auto)";
    for (body, is_right) in [
        (format!("{pick} wait 0.699 s"), true),
        (format!("{pick} wait 0 s"), true),
        (format!("{pick} wait 0.7 s"), false),
        (format!("{pick} sequence s {{ wait 20 s }}"), false),
        (format!("wait 20 s {pick}"), true),
        (format!("{pick} go(sofa)"), false),
        (r#"fetch("cup", user, book)"#.to_owned(), false),
        (r#"clear_away("cup", vase, window)"#.to_owned(), false),
    ] {
        let text = format!("{monitor} {body} }} fail \"no\" }}");
        let wrong = errors(&session, &text);
        assert_eq!(wrong.is_empty(), is_right, "{text}: {wrong:#?}");
        let mut acceptor = factory.acceptor(6000).unwrap();
        let taken = acceptor.accept(text.as_bytes());
        assert_eq!(taken == text.len(), is_right, "{}", &text[..taken]);
    }
}

/// Of bytes that are taken together only the words that agree with them are judged: what may follow is the
/// same as where each is taken alone, also after some of them were taken back.
#[test]
fn acceptor_takes_bytes_together_as_alone() {
    let session = session("hsr", "kitchen");
    for syntax in [Syntax::Json, Syntax::Text] {
        let subset = Subset { syntax, ..subset(Modifiers::Written) };
        let mut dice = Dice::new(5);
        for policy in written(&session, subset, 2, |policy| policy.len() < 1500) {
            let factory = AcceptorFactory::new(&session, subset);
            let (mut alone, mut together) =
                (factory.acceptor(6000).unwrap(), factory.acceptor(6000).unwrap());
            let mut at = 0;
            while at < policy.len() {
                let end = (at + 1 + dice.below(9)).min(policy.len());
                let bytes = &policy.as_bytes()[at..end];
                assert_eq!(together.accept(bytes), bytes.len(), "{}", &policy[..end]);
                assert!(bytes.iter().all(|byte| alone.accept(&[*byte]) == 1));
                let back = if dice.chance(40) { dice.below(end - at) } else { 0 };
                together.forget(back);
                alone.forget(back);
                at = end - back;
                assert_eq!(together.next_bytes(), alone.next_bytes(), "{}", &policy[..at]);
                // A byte that may not follow changes nothing.
                assert_eq!(together.accept(b"\n\n"), 0);
            }
        }
    }
}

/// The needs of a policy are asked before its steps are proved, with a full hand and an empty one: a call is
/// open exactly where it checks.
#[test]
fn acceptor_opens_policies_that_check() {
    let session = session("hsr", "kitchen");
    let (factory, signatures) =
        (AcceptorFactory::new(&session, subset(Modifiers::Default)), session.signatures());
    let held = r#"{"do":"go","to":"mug_1"},{"do":"pick","object":"mug_1","from":"auto"},"#;
    let (mut open, mut closed) = (0, 0);
    for begin in ["", held] {
        let head =
            r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"steps":["#;
        for callable in signatures.callables.iter().filter(|callable| callable.is_policy) {
            for (one, _) in signatures.entities.iter().step_by(3) {
                for (other, _) in &signatures.entities {
                    let mut names = [one, other].into_iter();
                    let args = callable.params.iter().map(|param| match param.ty {
                        Type::Text => format!(r#","{}":"cups""#, param.name),
                        _ => format!(r#","{}":"{}""#, param.name, names.next().unwrap_or(other)),
                    });
                    let args: String = args.collect();
                    let call = format!(r#"{{"do":"{}"{args}}}"#, callable.name);
                    let end = r#",{"end":"fail","why":"no"}],"finally":null}"#;
                    let text = format!("{head}{begin}{call}{end}");
                    let wrong = errors(&session, &text);
                    let mut acceptor = factory.acceptor(8000).unwrap();
                    let is_open = acceptor.accept(text.as_bytes()) == text.len();
                    assert_eq!(is_open, wrong.is_empty(), "{wrong:#?}\n{text}");
                    *if is_open { &mut open } else { &mut closed } += 1;
                }
            }
        }
    }
    println!("{open} open, {closed} closed");
    assert!(open > 100 && closed > 100, "{open} open, {closed} closed");
}

fn last_fails(text: &str) -> bool {
    if !text.starts_with('{') {
        let last = [" fail ", " replan "].iter().filter_map(|word| text.rfind(word)).max();
        return last.is_some_and(|at| !text[at..text.len() - 2].contains(['(', '{', '}']));
    }
    let last = text.rfind("{\"end\":").map(|at| &text[at..]);
    last.is_some_and(|last| {
        (last.contains("\"fail\"") || last.contains("\"replan\"")) && last.ends_with("}]}")
    })
}

#[test]
fn acceptor_takes_examples_in_json() {
    accept_examples(Syntax::Json);
}

#[test]
fn acceptor_takes_examples_in_text() {
    accept_examples(Syntax::Text);
}

fn accept_examples(syntax: Syntax) {
    let subset = Subset { syntax, ..subset(Modifiers::Written) };
    let mut count = 0;
    for (robot, scene) in SETTINGS {
        let session = session(robot, scene);
        let factory = AcceptorFactory::new(&session, subset);
        let grammar = Grammar::new(&session.signatures(), subset);
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
        let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
        files.sort();
        for file in files.iter().filter(|file| file.extension().is_some_and(|kind| kind == "json")) {
            let text = std::fs::read_to_string(file).unwrap();
            if !errors(&session, &text).is_empty() {
                continue;
            }
            let parsed = motet_syntax::read(&Source::new("policy.json", text.as_str()), FileId(7));
            let policy = parsed.file.policies().next().unwrap();
            let spelled = match canonical(policy, &grammar) {
                Ok(spelled) => spelled,
                Err(outside) => {
                    println!("{}: {outside}", file.display());
                    continue;
                }
            };
            takes_whole(&factory, &spelled, &format!("{} in {scene}", file.display()));
            count += 1;
        }
    }
    assert!(count >= 10, "{count}");
}

/// Asserts that a policy is accepted byte by byte, to its end.
fn takes_whole(factory: &AcceptorFactory, spelled: &str, whose: &str) {
    let mut acceptor = factory.acceptor(100_000).unwrap();
    let taken = acceptor.accept(spelled.as_bytes());
    assert!(
        taken == spelled.len() && acceptor.is_accepting(),
        "{whose}: refused after {}, before {}",
        &spelled[..taken],
        &spelled[taken..]
    );
}

/// A policy of one subset is accepted in the other, in its spelling.
#[test]
fn acceptor_takes_walks_of_the_other_syntax() {
    let (mut count, mut outside) = (0, 0);
    for (robot, scene) in SETTINGS {
        let session = session(robot, scene);
        for (from, to) in [(Syntax::Json, Syntax::Text), (Syntax::Text, Syntax::Json)] {
            let [from, to] = [from, to].map(|syntax| Subset { syntax, ..subset(Modifiers::Written) });
            let factory = AcceptorFactory::new(&session, to);
            let grammar = Grammar::new(&session.signatures(), to);
            // The acceptor of the text syntax knows no fields.
            let fits = |text: &str| (600..3000).contains(&text.len()) && !text.contains("\"field\":");
            for text in written(&session, from, 3, fits) {
                let parsed = motet_syntax::read(&Source::new("policy", text.as_str()), FileId(7));
                let policy = parsed.file.policies().next().unwrap();
                let Ok(spelled) = canonical(policy, &grammar) else {
                    outside += 1;
                    continue;
                };
                takes_whole(&factory, &spelled, &format!("{robot} in {scene}, {to:?}"));
                count += 1;
            }
        }
    }
    println!("{count} policies, and {outside} that the other subset has no spelling for");
    assert!(count >= 15, "{count}");
}

#[test]
fn decoder_mask_in_json_equals_accepted_tokens() {
    compare_masks(Syntax::Json);
}

#[test]
fn decoder_mask_in_text_equals_accepted_tokens() {
    compare_masks(Syntax::Text);
}

fn compare_masks(syntax: Syntax) {
    let session = session("hsr", "kitchen");
    let factory = AcceptorFactory::new(&session, Subset { syntax, ..subset(Modifiers::Default) });
    let vocabulary = Vocabulary::new(&tokens(), END);
    for seed in 0..6 {
        let mut dice = Dice::new(seed);
        let mut decoder = factory.decoder(&vocabulary, 700).unwrap();
        for _ in 0..150 {
            let open = compare_mask(&mut decoder, &vocabulary);
            assert!(!open.is_empty(), "{seed}: nothing may follow");
            // Long tokens lead further.
            let long: Vec<u32> = open.iter().copied().filter(|token| *token >= 256).collect();
            let from = if long.is_empty() || dice.chance(30) { &open } else { &long };
            assert!(decoder.accept(from[dice.below(from.len())]));
            if !decoder.mask().iter().any(|word| *word != 0) {
                break;
            }
        }
    }
}

/// Most characters of a text.
const MAX_TEXT_CHARS: usize = 200;

/// Compares a mask with the tokens that are accepted, and gives them.
fn compare_mask(decoder: &mut Decoder, vocabulary: &Vocabulary) -> Vec<u32> {
    let count = u32::try_from(vocabulary.len()).unwrap();
    let mask = decoder.mask().to_vec();
    let is_set = |token: u32| mask[token as usize / 32] >> (token % 32) & 1 == 1;
    for token in 0..count {
        let accepted = decoder.accept(token);
        if accepted {
            decoder.rollback(1);
        }
        let after = String::from_utf8_lossy(decoder.acceptor().bytes()).into_owned();
        let text = String::from_utf8_lossy(vocabulary.bytes(token)).into_owned();
        assert_eq!(is_set(token), accepted, "`{text}` after {after}");
    }
    (0..count).filter(|token| is_set(*token)).collect()
}

#[test]
fn decoder_mask_of_a_long_text_equals_accepted_tokens() {
    let session = session("hsr", "kitchen");
    let factory =
        AcceptorFactory::new(&session, Subset { syntax: Syntax::Text, ..subset(Modifiers::Default) });
    let vocabulary = Vocabulary::new(&tokens(), END);
    // Beside a branch the entity that a text describes may matter.
    for before in ["policy p for hsr { say(\"", "policy p for hsr { parallel { { let a = detect(\""] {
        let mut decoder = factory.decoder(&vocabulary, 2000).unwrap();
        let taken = before.bytes().take_while(|byte| decoder.accept(u32::from(*byte))).count();
        assert_eq!(taken, before.len(), "{}", &before[taken..]);
        for length in 0..=MAX_TEXT_CHARS {
            if length < 4 || length + 40 > MAX_TEXT_CHARS {
                assert!(!compare_mask(&mut decoder, &vocabulary).is_empty());
            }
            let takes = decoder.accept(u32::from(if length == 1 { b'{' } else { b'e' }));
            assert_eq!(takes, length < MAX_TEXT_CHARS && length != 2, "{length}");
            if length == 2 {
                assert!(decoder.accept(u32::from(b'{')));
            }
        }
    }
}

#[test]
fn decoder_mask_within_an_effort_lacks_no_token_and_ends_nowhere() {
    let (mut wide, mut refused) = (0, 0);
    for (syntax, effort) in [Syntax::Json, Syntax::Text].into_iter().flat_map(|syntax| {
        // None at all, some, and nearly always enough.
        [0, 400, 20_000].map(|effort| (syntax, effort))
    }) {
        let session = session("hsr", "kitchen");
        let subset = Subset { syntax, ..subset(Modifiers::Written) };
        let [factory, other] = [(); 2].map(|()| AcceptorFactory::new(&session, subset));
        let vocabulary = Vocabulary::new(&tokens(), END);
        for seed in 0..8 {
            let mut dice = Dice::new(seed);
            let mut decoder = factory.decoder(&vocabulary, 500).unwrap();
            let mut exact = other.decoder(&vocabulary, 500).unwrap();
            let begin = match syntax {
                Syntax::Json => concat!(
                    r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
                    r#""steps":["#
                ),
                Syntax::Text => "policy p for hsr { ",
            };
            for byte in begin.bytes() {
                assert!(decoder.accept(u32::from(byte)) && exact.accept(u32::from(byte)), "{begin}");
            }
            for _ in 0..150 {
                let limited = decoder.mask_within(effort).to_vec();
                if limited.iter().all(|word| *word == 0) {
                    break;
                }
                let mask = exact.mask().to_vec();
                let is_set = |mask: &[u32], token: u32| mask[token as usize / 32] >> (token % 32) & 1 == 1;
                assert!(decoder.is_wide() || limited == mask, "{seed}: a mask that is not wide is wrong");
                assert!(limited.iter().zip(&mask).all(|(limited, exact)| exact & !limited == 0), "{seed}");
                wide += usize::from(limited != mask);
                let count = u32::try_from(vocabulary.len()).unwrap();
                let open: Vec<u32> = (0..count).filter(|token| is_set(&limited, *token)).collect();
                // Long tokens lead further.
                let long: Vec<u32> = open.iter().copied().filter(|token| *token >= 256).collect();
                let from = if long.is_empty() || dice.chance(30) { &open } else { &long };
                let mut token = from[dice.below(from.len())];
                while !decoder.accept(token) {
                    assert!(!is_set(&mask, token), "{seed}: {token} was refused");
                    refused += 1;
                    let limited = decoder.mask_within(effort);
                    assert!(!is_set(limited, token), "{seed}: a refused token is offered again");
                    let open: Vec<u32> = (0..count).filter(|token| is_set(limited, *token)).collect();
                    token = open[dice.below(open.len())];
                }
                assert!(exact.accept(token), "{seed}: {token} was accepted");
                if dice.chance(20) {
                    // What was left open is not remembered.
                    assert_eq!(decoder.mask(), exact.mask(), "{seed}");
                }
            }
        }
    }
    assert!(wide > 20 && refused > 5, "{wide} wide masks, {refused} refusals");
}

#[test]
fn acceptor_forces_text_and_explains_refusals() {
    let session = session("hsr", "kitchen");
    let factory = AcceptorFactory::new(&session, subset(Modifiers::Default));
    let mut acceptor = factory.acceptor(1000).unwrap();
    assert_eq!(acceptor.forced(), b"{\"motet\":1,\"policy\":\"");
    let start = concat!(
        r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
        r#""steps":[{"do":"go","to":"kitchen_table"},{"do":"pick","object":"mug_1","from":"auto"}"#,
    )
    .as_bytes();
    assert_eq!(acceptor.accept(start), start.len());
    // The hand is not free any more: no second object can be picked, and the checker says why.
    let again = br#",{"do":"pick","object":"mug_2","from":"auto"}"#;
    let why = acceptor.why_not(again);
    assert!(why.iter().any(|said| said.code.0 == "M0501"), "{why:?}");
    assert!(acceptor.accept(again) < again.len());
}

#[test]
fn acceptor_has_no_empty_blocks() {
    let session = session("hsr", "kitchen");
    let json = r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"steps":["#;
    let cases = [
        (Syntax::Json, json, "]"),
        (Syntax::Json, &format!(r#"{json}{{"sequence":"group","steps":["#), "]"),
        (Syntax::Json, &format!(r#"{json}{{"repeat":2,"steps":["#), "]"),
        (Syntax::Json, &format!(r#"{json}{{"try":["#), "]"),
        (Syntax::Json, &format!(r#"{json}{{"parallel":[["#), "]"),
        (Syntax::Json, &format!(r#"{json}{{"within":5,"steps":["#), "]"),
        (Syntax::Json, &format!(r#"{json}{{"if":{{"is":"visible","entity":"mug_1"}},"then":["#), "]"),
        (Syntax::Text, "policy p for hsr { sequence group { ", "}"),
        (Syntax::Text, "policy p for hsr { try { ", "}"),
        (Syntax::Text, "policy p for hsr { repeat 2 { ", "}"),
        (Syntax::Text, "policy p for hsr { if visible(mug_1) { ", "}"),
    ];
    for (syntax, start, end) in cases {
        let factory = AcceptorFactory::new(&session, Subset { syntax, ..subset(Modifiers::Default) });
        let mut acceptor = factory.acceptor(1000).unwrap();
        let taken = acceptor.accept(start.as_bytes());
        assert_eq!(&start[..taken], start, "{start}");
        assert_eq!(acceptor.accept(end.as_bytes()), 0, "{start}{end}");
    }
}

#[test]
fn acceptor_excludes_infeasible_arguments() {
    let session = session("hsr", "kitchen");
    let start = concat!(
        r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
        r#""steps":[{"do":"go","to":"kitchen_table"},{"do":"pick","object":"mug_1""#,
    )
    .as_bytes();
    let open =
        AcceptorFactory::new(&session, subset(Modifiers::Default)).acceptor(1000).unwrap().accept(start);
    assert_eq!(open, start.len());
    let verdicts = [("pick", "mug_1")];
    let factory = AcceptorFactory::with_verdicts(&session, subset(Modifiers::Default), &verdicts);
    assert!(factory.acceptor(1000).unwrap().accept(start) < start.len());
}
