//! Whatever a document says, every stage ends, and says what is wrong.

use motet_syntax::{FileId, Severity, Source, Sources};
use motet_tests::setup;

/// The errors that checking a document gives: their codes, and the texts that they are about.
fn errors(text: &str) -> Vec<(String, String)> {
    let mut sources = Sources::default();
    let (session, _) = setup::session(None, None, &mut sources);
    let source = Source::new("hostile", text);
    let said = session.check(&motet_syntax::read(&source, FileId(u16::MAX)));
    let errors = said.iter().filter(|said| said.severity == Severity::Error);
    errors.map(|said| (said.code.to_string(), source.slice(said.span).to_owned())).collect()
}

/// The codes that checking a document gives, each once.
fn codes(text: &str) -> Vec<String> {
    let mut codes: Vec<_> = errors(text).into_iter().map(|(code, _)| code).collect();
    codes.sort();
    codes.dedup();
    codes
}

fn json(steps: &str) -> String {
    format!(r#"{{"motet": 1, "policy": "p", "steps": [{steps}]}}"#)
}

#[test]
fn session_policy_of_as_many_steps_as_are_allowed_is_checked() {
    let steps = vec![r#"{"do": "say", "text": "x"}"#; 20_000].join(",");
    assert_eq!(codes(&json(&steps)), Vec::<String>::new());
}

#[test]
fn session_one_step_more_is_refused_by_name() {
    let steps = vec![r#"{"do": "say", "text": "x"}"#; 20_001].join(",");
    assert_eq!(codes(&json(&steps)).len(), 1);
}

#[test]
fn session_sub_policies_that_grow_beyond_the_limit_are_refused() {
    let mut text = String::from("policy p0(n: Text) { say(n) say(n) say(n) say(n) }\n");
    for level in 1..12 {
        let below = level - 1;
        text.push_str(&format!(
            "policy p{level}(n: Text) {{ p{below}(n) p{below}(n) p{below}(n) p{below}(n) }}\n"
        ));
    }
    text.push_str("policy top { p11(\"x\") }\n");
    assert!(codes(&text).contains(&"M0212".to_owned()));
}

#[test]
fn session_more_parallel_branches_than_allowed_are_refused() {
    let parallel = |count: usize| format!("policy p {{ parallel {{ {} }} }}", "{ wait 1 s } ".repeat(count));
    assert_eq!(codes(&parallel(256)), Vec::<String>::new());
    assert_eq!(codes(&parallel(257)), ["M0212"]);
    assert_eq!(codes(&parallel(15_000)), ["M0212"]);
}

#[test]
fn session_loops_nested_too_deep_are_refused() {
    let nested = |depth: usize| {
        let open = "repeat 2 { ".repeat(depth);
        format!("policy p {{ {open} say(\"x\") {} }}", "}".repeat(depth))
    };
    assert_eq!(codes(&nested(8)), Vec::<String>::new());
    assert_eq!(codes(&nested(9)), ["M0804"]);
    assert!(!codes(&nested(5_000)).is_empty());
}

#[test]
fn session_a_proof_of_nested_reactions_is_given_up() {
    let nested = |depth: usize| {
        let open = "monitor { when not visible(mug_1) then resume at most 5 { go(user) ".repeat(depth);
        format!("policy p {{ {open} say(\"x\") {} }}", "} } during { go(counter) }".repeat(depth))
    };
    assert!(!codes(&nested(3)).contains(&"M0804".to_owned()));
    assert!(codes(&nested(8)).contains(&"M0804".to_owned()));
}

#[test]
fn session_twenty_nested_branches_do_not_explode() {
    let depth = 20;
    let open = "if near(user) { go(user) ".repeat(depth);
    let close = "} else { say(\"x\") } ".repeat(depth);
    assert_eq!(codes(&format!("policy p {{ {open} {close} }}")), Vec::<String>::new());
}

#[test]
fn session_mistakes_beyond_a_thousand_are_one_finding_at_the_first_of_them() {
    let many = |part: &str| part.repeat(3_000);
    let named: String = (0..3_000).map(|index| format!("policy p{index} {{ fly{index}x() }} ")).collect();
    let keys: String = (0..3_000).map(|index| format!(r#""k{index}": 1, "#)).collect();
    for text in [
        json(&format!("{}1", many("1, "))),
        json(&format!("{}{{}}", many("{}, "))),
        json(&format!("{}[[1]]", many("[[1]], "))),
        format!("policy p {{ {} }}", many("fly() ")),
        format!("policy p {{ {} }}", many("pick(moon) ")),
        format!("policy p {{ {} }}", many("pick(mug_1) ")),
        format!("policy p {{ {} }}", many("if moon { fly() } ")),
        named,
        format!("{{{keys}{}", json("1").split_off(1)),
        format!("{{{}{}", many(r#""steps": [], "#), json("1").split_off(1)),
    ] {
        let errors = errors(&text);
        assert_eq!(errors.len(), 1001, "{:?}", text.get(..90));
        let codes: Vec<&str> = errors.iter().map(|(code, _)| code.as_str()).collect();
        assert_eq!(codes.iter().position(|code| *code == "M0124"), Some(1000), "{:?}", text.get(..90));
    }
}

#[test]
fn session_a_proof_of_very_many_facts_is_given_up_at_its_step() {
    let steps: String = (0..20_000).map(|index| format!("let x{index} = detect(\"mug\") ")).collect();
    let errors = errors(&format!("policy p {{ {steps} }}"));
    let given_up = errors.iter().find(|(code, _)| code == "M0804").map(|(_, step)| step.as_str());
    assert!(given_up.is_some_and(|step| step.starts_with("let x")), "{given_up:?}");
}

#[test]
fn session_a_call_of_more_arguments_than_allowed_is_refused_at_the_first_of_them() {
    let call = |count: usize| {
        let keys: String = (0..count).map(|index| format!(r#", "k{index}": {index}"#)).collect();
        errors(&json(&format!(r#"{{"do": "wave"{keys}}}"#)))
    };
    assert!(call(256).iter().all(|(code, _)| code != "M0304"));
    assert_eq!(call(257), [("M0304".to_owned(), "\"k256\": 256".to_owned())]);
}

#[test]
fn session_brackets_without_end_are_refused() {
    for bracket in ["[", "{\"if\":", "{\"not\":", "(", "not "] {
        let deep = bracket.repeat(100_000);
        assert!(!codes(&deep).is_empty(), "{bracket}");
        assert!(!codes(&json(&deep)).is_empty(), "{bracket}");
        assert!(!codes(&format!("policy p {{ if {deep}")).is_empty(), "{bracket}");
    }
}

#[test]
fn session_values_that_double_are_refused_at_the_first_that_is_too_large() {
    let doubled = |first: &str, next: &str| {
        let lets = (1..40).map(|at| format!("let x{at} = {}", next.replace('#', &(at - 1).to_string())));
        format!("policy p {{ let x0 = {first} {} say(\"done\") }}", lets.collect::<Vec<_>>().join(" "))
    };
    for (first, next) in [("\"aa\"", "\"{x#}{x#}\""), ("[\"a\"]", "[x#, x#]")] {
        let said = errors(&doubled(first, next));
        assert_eq!(said.first().map(|(code, _)| code.as_str()), Some("M0314"), "{said:?}");
    }
    let chain = (1..40).map(|at| format!("policy p{at}(t: Number) {{ p{}(t + t) }}", at - 1));
    let chain = format!("policy p0(t: Number) {{ say(\"{{t}}\") }} {}", chain.collect::<Vec<_>>().join(" "));
    assert!(codes(&chain).contains(&"M0314".to_owned()), "{:?}", errors(&chain));
}
