//! Diagnostics of the front end for common mistakes, as a person reads them.

use motet_syntax::{Source, Sources, read, render};

/// Every diagnostic of a document.
fn report(document: &str) -> String {
    let mut sources = Sources::default();
    let source = Source::new("policy", document);
    let file = sources.add(source.clone());
    let parsed = read(&source, file);
    assert!(!parsed.diagnostics.is_empty(), "{document}");
    render::human(&parsed.diagnostics, &sources, render::ColorChoice::Off, 100)
}

macro_rules! reports {
    ($($name:ident: $document:expr;)*) => {$(
        #[test]
        fn $name() {
            insta::assert_snapshot!(report($document));
        }
    )*};
}

reports! {
    unknown_unit: r##"policy p {
    go(table)
    pick(mug) within 20 sec
}
"##;
    misspelt_keyword: r##"policy p {
    go(table)
    let x = 
    repat 3 { go(a) }
}
"##;
    foreign_operator: r##"policy p {
    if (a && b) { go(x) }
}
"##;
    call_without_parentheses: r##"policy p {
    home
    go(x)
}
"##;
    each_without_bound: r##"policy p {
    each cup in cups { go(cup) }
}
"##;
    try_without_catch: r##"policy p {
    try { go(x) }
    go(y);
}
"##;
    open_brace: r##"policy p {
    if a < b < c { go(x)
    }
    while true { go(y) }
"##;
    a_bracket_too_many: r##"policy p {
    go(user))
    home
    if x is None {
        hom
    }
    if near(user) && lit() { go(x) }
    let x =
}
"##;
    a_missing_brace: r##"policy p {
    go(user)
    if near(user) {
        home
    say("Hello.")
}
"##;
    a_missing_brace_before_the_outer_one: r##"policy p {
    go(user)
    if {
}
"##;
    a_brace_too_many: r##"policy p {
    if near(user) {
        go(x)
    }
    }
    home
}
"##;
    a_missing_parenthesis_before_a_brace: r##"policy p {
    if near(user {
        home
    }
    go(x
}
"##;
    steps_without_a_policy: r##"// The steps.
go(user)
inspect(mug_1)
"##;
    wrong_steps_without_a_policy: r##"go(user)
home
wait for 5 s
"##;
    prose_with_numbered_steps: r##"Sure! Here is the plan:

1. Go to the kitchen {now}.
2. Pick the mug.
"##;
    words_of_other_languages: r##"policy p {
    go(target=user)
    sleep 5 s
    go(user) fast
    keep distance(user) > 1 m { go(x) }
}
"##;
    expression_strings_in_json: r##"{"motet": 1, "policy": "p", "steps": [
    {"if": "$c3 == 'red'", "then": []}, {"if": "$xs is empty", "then": []},
    {"keep": [5], "steps": []}
]}"##;
    while_loop: r##"policy p {
    while true { go(y) }
}
"##;
    reserved_name: r##"policy p {
    let any = go(y)
    monitor when a then stop during { }
}
"##;
    when_without_then: r##"policy p {
    monitor when distance(user) < 0.5 m pause during { }
}
"##;
    single_quotes: r##"policy p {
    say('hello')
}
"##;
    steps_without_policy: r##"go(kitchen)
pick(mug)
"##;
    assignment: r##"policy p {
    go(x, )
    x = detect("mug")
}
"##;
    wait_without_until: r##"policy p {
    wait c within 3 s
}
"##;
    if_without_braces: r##"policy p {
    if holding(mug) go(x)
}
"##;
    parameter_without_type: r##"action pick(object Object)
"##;
    stray_else: r##"policy p {
    go(x) else { }
    monitor { when a then pause } 
    go(y)
}
"##;
    repeat_without_bound: r##"policy p {
    repeat { go(x) }
}
"##;
    colon_block: r##"policy p:
    go(x)
"##;
    foreign_clause: r##"policy p {
    pick(mug) retry 2 timeout 3 s
    say("hi" + )
}
"##;
    chained_comparison: r##"policy p {
    wait until 1 m < distance(user) < 2 m
}
"##;
    doc_in_a_block: r##"policy p {
    /// Goes.
    go(x)
}
"##;
    open_text: r##"policy p {
    say("hello)
}
"##;
    wrong_bracket: r##"policy p {
    go(x}
"##;
    semicolon: r##"policy p {
    go(x);
    go(y)
}
"##;
    empty: r##"
"##;
    prose: r##"I am sorry, I cannot do that.
"##;
    python: r##"def fetch():
    pick(mug)
"##;
    unknown_declaration: r##"polcy p {
    go(x)
}
"##;
    json_keys: r##"{"motet": 1, "policy": "p", "steps": [
  {"do": "pick", "object": "$mug", "within": "20 sec", "retries": 2},
  {"if": {"is": "holding", "object": "$mug"}, "then": [], "esle": []},
  {"if": "distance(user) < 0.5 m and", "then": []},
  {"loop": 3, "steps": []},
  {"do": "pick", "steps": []},
  {"monitor": [], "during": []},
  {"monitor": [{"when": true, "then": {"react": "resume"}}], "during": []},
  {"repeat": "three", "steps": []}
]}
"##;
    json_trailing_comma: r##"{"motet": 1, "policy": "p", "steps": [{"end": "done"},]}"##;
    json_truncated: r##"Here is the plan:
```json
{"motet": 1, "policy": "p",
 "steps": [{"do": "go", "to": "a"},
           {"do": "pick", "obj"##;
    json_comment: r##"{"motet": 1, // the version
 "policy": "p", "steps": []}"##;
    json_python_literal: r##"{"motet": 1, "policy": "p", "steps": [{"if": True, "then": []}]}"##;
    json_wrong_types: r##"{"motet": "1", "policy": ["p"], "steps": {}}"##;
    json_steps_of_wrong_types: r##"{"motet": 1, "policy": "p", "steps": [
  "go", {"do": 5}, {"do": "go", "within": true}, {"repeat": "3", "steps": []},
  {"end": "finished"}, {"parallel": [{"do": "go"}]}
]}"##;
    json_missing_keys: r##"{"motet": 1, "policy": "p", "steps": [
  {"if": "holding(a)"}, {"each": "x", "steps": []}, {"try": []}, {},
  {"monitor": [{"when": true}], "during": []}
]}"##;
    json_two_forms: r##"{"motet": 1, "policy": "p", "steps": [
  {"if": true, "repeat": 2, "then": [], "steps": []}, {"do": "go", "if": true}
]}"##;
    json_conditions: r##"{"motet": 1, "policy": "p", "steps": [
  {"wait": {"iz": "open"}}, {"wait": {"less": [1]}}, {"wait": {"not": true, "all": []}},
  {"wait": "not holding(mug"}, {"wait": "holding(\"mug\") &&"}
]}"##;
}

/// Compares the diagnostics of a document, each with its code and words of its message or help.
fn check(document: &str, expected: &[(&str, &str)]) {
    let parsed = read(&Source::new("policy", document), motet_syntax::FileId(0));
    let said = parsed.diagnostics.iter();
    let found: Vec<(&str, String)> =
        said.map(|d| (d.code.0, format!("{}; {}", d.message, d.help.as_deref().unwrap_or("")))).collect();
    let fits = |(found, expected): (&(&str, String), &(&str, &str))| {
        found.0 == expected.0 && found.1.contains(expected.1)
    };
    assert!(found.len() == expected.len() && found.iter().zip(expected).all(fits), "{document}\n{found:#?}");
}

#[test]
fn help_names_the_intended_word() {
    check("policy p {\n    pick mug\n}\n", &[("M0101", "`pick(mug)`")]);
    check(
        "policy p {\n    pick(mug) retry 3 within 20 s retry 2\n}\n",
        &[("M0101", "stand once behind a call")],
    );
    check(
        "policy p {\n    retry 3 { pick(mug) }\n}\n",
        &[("M0101", "`repeat 3 { … } until c` runs steps again")],
    );
    check("policy p {\n    pick(mug) slowly slowly\n}\n", &[("M0101", "stand once behind a call")]);
    check("policy p {\n    go(user) at speed\n}\n", &[("M0101", "at which part of the robot's speed")]);
    check("policy p {\n    let x = 3 m slowly\n}\n", &[("M0101", "only a call of a primitive takes time")]);
    let step = |manner: &str| {
        format!(r#"{{"motet": 1, "policy": "p", "steps": [{{"do": "go", "manner": {manner}}}]}}"#)
    };
    check(&step("\"fast\""), &[("M0108", "`fast` is not a manner")]);
    check(&step("\"3 cm\""), &[("M0108", "`3 cm` is not a manner")]);
    check(&step("[3]"), &[("M0106", "or a part such as")]);
    check("policy p {\n    say(\"an { open brace\")\n}\n", &[("M0123", "a brace itself is written twice")]);
}

#[test]
fn schema_check_compares_lengths_of_arrays() {
    let steps = r#"{"if": {"less": [1, 2, 3]}, "then": []}, {"wait": {"more": [{"add": [1]}, 2]}}"#;
    check(
        &format!(r#"{{"motet": 1, "policy": "p", "steps": [{steps}]}}"#),
        &[
            ("M0106", "expected an array of 2 elements, found 3"),
            ("M0106", "expected an array of 2 elements, found one"),
        ],
    );
}

#[test]
fn duration_has_a_unit_of_time() {
    for (written, help) in [
        ("20 m", "did you mean `\"20 min\"`?"),
        ("20", "did you mean `\"20 s\"`?"),
        ("20 kg", "write seconds"),
    ] {
        let step = format!(r#"{{"wait": true, "within": "{written}"}}"#);
        check(&format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#), &[("M0108", help)]);
    }
}

#[test]
fn too_deep_is_the_same_in_both_syntaxes() {
    let document = format!(r#"{{"motet": 1, "policy": "p", "steps": {}"#, "[".repeat(300));
    check(&document, &[("M0111", "more than 264 levels deep; brackets nest at most 264 deep")]);
}

/// All syntax errors of a text are told, and none that only follows from another.
#[test]
fn syntax_errors_are_told_together() {
    let document = "policy p {\n    go(fridge\n    open(fridge)\n    while x { go(y) }\n    pick(mug);\n    \
                    if holding(mug) && visible(mug) {\n        say(\"a)\n    }\n    foo\n    done\n}\n";
    check(
        document,
        &[
            ("M0101", "loops are bounded"),
            ("M0101", "remove `;`"),
            ("M0101", "write `and`"),
            ("M0101", "the text is not closed"),
            ("M0101", "a call needs its parentheses"),
            ("M0101", "close the `(` with `)` first"),
        ],
    );
}
