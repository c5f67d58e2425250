//! Shapes of JSON that models write in place of those of the language.

use motet_syntax::ast::{Item, Policy};
use motet_syntax::{FileId, Parsed, Severity, Source, read};
use proptest::prelude::*;

fn parse(document: &str) -> Parsed {
    read(&Source::new("test", document), FileId(0))
}

#[track_caller]
fn policy(parsed: &Parsed) -> Policy {
    match parsed.file.items.first() {
        Some(Item::Policy(policy)) => policy.clone(),
        other => panic!("{other:?}"),
    }
}

/// A document after the fixes of its notes.
fn fixed(document: &str, parsed: &Parsed) -> String {
    let notes = parsed.diagnostics.iter().filter(|said| said.code.0 == "M0122");
    let mut edits: Vec<_> = notes.flat_map(|note| note.fix.clone().unwrap().edits).collect();
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut text = document.to_owned();
    for edit in edits.iter().rev() {
        text.replace_range(edit.span.range(), &edit.text);
    }
    text
}

/// A shape is read as the form of the language, with notes and nothing else; its fix and the printer write
/// that form.
#[track_caller]
fn check(shape: &str, form: &str, notes: &[&str]) {
    let (read_shape, read_form) = (parse(shape), parse(form));
    assert_eq!(read_form.diagnostics, [], "{form}");
    let said: Vec<&str> = read_shape.diagnostics.iter().map(|said| said.message.as_str()).collect();
    assert_eq!(said, notes, "{shape}");
    assert!(read_shape.diagnostics.iter().all(|said| said.severity == Severity::Note));
    assert!(policy(&read_shape) == policy(&read_form), "{shape}\n{:#?}", policy(&read_shape));
    let fixed = fixed(shape, &read_shape);
    let after = parse(&fixed);
    assert_eq!(after.diagnostics, [], "{fixed}");
    assert!(policy(&after) == policy(&read_form), "{fixed}");
    let formatted = motet_syntax::format(&Source::new("test", shape)).unwrap();
    assert_eq!(parse(&formatted).diagnostics, [], "{formatted}");
}

/// A step in another shape.
#[track_caller]
fn step(shape: &str, form: &str, note: &str) {
    let whole = |step: &str| format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#);
    check(&whole(shape), &whole(form), &[note]);
}

/// A condition in another shape.
#[track_caller]
fn condition(shape: &str, form: &str, note: &str) {
    let whole = |condition: &str| format!(r#"{{"wait": {condition}}}"#);
    step(&whole(shape), &whole(form), note);
}

#[test]
fn shapes_of_tool_calls_are_calls() {
    let pick = r#"{"do": "pick", "object": "mug", "within": 20}"#;
    for (shape, note) in [
        (r#"{"do":"pick","args":{"object":"mug","within":20}}"#, r#"`{"do": …, "args": {…}}`"#),
        (r#"{"do":"pick","within":20,"arguments":{"object":"mug"}}"#, r#"`{"do": …, "arguments": {…}}`"#),
        (r#"{"action":"pick","object":"mug","within":20}"#, r#"`{"action": …}`"#),
        (r#"{"tool":"pick","params":{"object":"mug"},"within":20}"#, r#"`{"tool": …, "params": {…}}`"#),
        (
            r#"{ "name" : "pick" , "arguments" : { "object" : "mug", "within" : 20 } }"#,
            r#"`{"name": …, "arguments": {…}}`"#,
        ),
        (
            r#"{"name":"pick","arguments":"{\"object\": \"mug\", \"within\": 20}"}"#,
            r#"`{"name": …, "arguments": …}`"#,
        ),
        (
            concat!(
                r#"{"type":"function","function":{"name":"pick","#,
                r#""arguments":"{\"object\":\"mug\",\"within\":20}"}}"#
            ),
            r#"`{"function": {…}}`"#,
        ),
        (
            r#"{"id":"call_1","type":"tool_use","name":"pick","input":{"object":"mug","within":20}}"#,
            r#"`{"name": …, "input": {…}}`"#,
        ),
        (r#"{"type":"pick","object":"mug","within":20}"#, r#"`{"type": …}`"#),
        (r#"{"action":{"name":"pick","object":"mug"},"within":20}"#, r#"`{"action": {…}}`"#),
        (r#"{"do":{"name":"pick","object":"mug"},"within":20}"#, r#"`{"do": {…}}`"#),
        (r#"{"pick":{"object":"mug","within":20}}"#, r#"`{"pick": {…}}`"#),
        (
            r#"{"arguments":{"object":"mug","within":20},"thought":"grasp it","name":"pick"}"#,
            r#"`{"arguments": {…}, "name": …}`"#,
        ),
    ] {
        step(shape, pick, &format!(r#"{note} is read as `{{"do": …}}`"#));
    }
    let home = r#"{"do": "home"}"#;
    for (shape, note) in [
        (r#"{"do":"home","args":{}}"#, r#"`{"do": …, "args": {…}}`"#),
        (r#"{"args":{},"action":"home"}"#, r#"`{"args": {…}, "action": …}`"#),
        (r#"{"name":"home","arguments":""}"#, r#"`{"name": …, "arguments": …}`"#),
        (r#"{"name":"home","parameters":null}"#, r#"`{"name": …, "parameters": …}`"#),
        (r#"{"home":{}}"#, r#"`{"home": {…}}`"#),
    ] {
        step(shape, home, &format!(r#"{note} is read as `{{"do": …}}`"#));
    }
}

#[test]
fn shapes_of_calls_with_one_argument_name_it_by_place() {
    let read = r#"is read as `{"do": …}`"#;
    step(r#"{"go":"fridge_1"}"#, r#"{"do": "go", "arg1": "fridge_1"}"#, &format!(r#"`{{"go": …}}` {read}"#));
    step(
        r#"{"detect":"red mug","as":"m","retry":2}"#,
        r#"{"do": "detect", "arg1": "red mug", "as": "m", "retry": 2}"#,
        &format!(r#"`{{"detect": …}}` {read}"#),
    );
    // Neither a word about a step nor a misspelt form is a callee.
    for shape in [r#"{"note":"red mug"}"#, r#"{"wiat":"near(user)"}"#, r#"{"go":"sink","by":"user"}"#] {
        let document = format!(r#"{{"motet": 1, "policy": "p", "steps": [{shape}]}}"#);
        let is_error = |said: &motet_syntax::Diagnostic| said.severity == Severity::Error;
        assert!(parse(&document).diagnostics.iter().any(is_error), "{shape}");
    }
}

#[test]
fn shapes_of_endings_have_a_reason_as_a_call() {
    step(
        r#"{"do":"cannot","why":"no mug"}"#,
        r#"{"end": "cannot", "why": "no mug"}"#,
        r#"`{"do": …, "why": …}` is read as `{"end": …}`"#,
    );
    step(
        r#"{"do":"abort","why":"no mug"}"#,
        r#"{"end": "fail", "why": "no mug"}"#,
        r#"`{"do": …, "why": …}` is read as `{"end": …}`"#,
    );
}

#[test]
fn shapes_of_objects_in_a_row_are_steps() {
    let form = r#"{"motet": 1, "policy": "plan", "steps": [{"do": "home"}, {"do": "go", "to": "sink"}]}"#;
    let note = "several objects is read as a policy with these steps";
    check("{\"do\":\"home\"}\n{\"do\":\"go\",\"to\":\"sink\"}\n", form, &[note]);
    check(r#"{"do":"home"}, {"do":"go","to":"sink"}"#, form, &[note]);
    check(
        "{\"home\":{}}\n\n{\"action\":\"go\",\"to\":\"sink\"}",
        form,
        &[note, r#"`{"home": {…}}` is read as `{"do": …}`"#, r#"`{"action": …}` is read as `{"do": …}`"#],
    );
    for text in [
        "{\"do\":\"home\"} x {\"do\":\"home\"}",
        "{\"do\":\"home\"}\n{\"do\":",
        "{\"motet\":1}\n{\"do\":\"home\"}",
    ] {
        let found = parse(text).diagnostics;
        assert!(found.iter().any(|said| said.severity == Severity::Error), "{text}: {found:?}");
    }
}

#[test]
fn shapes_of_endings_and_reactions_are_read_by_their_word() {
    step(r#""done""#, r#"{"end": "done"}"#, r#"`done` is read as `{"end": "done"}`"#);
    step(r#""finished""#, r#"{"end": "done"}"#, r#"`finished` is read as `{"end": "done"}`"#);
    step(r#"{"end":"success"}"#, r#"{"end": "done"}"#, "`success` is read as `\"done\"`");
    step(
        r#"{"replan":"no mug"}"#,
        r#"{"end": "replan", "why": "no mug"}"#,
        r#"`{"replan": …}` is read as `{"end": …}`"#,
    );
    step(r#"{"done":true}"#, r#"{"end": "done"}"#, r#"`{"done": …}` is read as `{"end": …}`"#);
    let monitor = |then: &str| {
        format!(r#"{{"monitor": [{{"when": "near(user)", "then": {then}}}], "during": [{{"do": "home"}}]}}"#)
    };
    for (shape, form, note) in [
        (r#""pause""#, r#"{"react": "pause"}"#, r#"`pause` is read as `{"react": "pause"}`"#),
        (r#""replan""#, r#"{"end": "replan"}"#, r#"`replan` is read as `{"end": "replan"}`"#),
        (
            r#"{"react":"fail","why":"x"}"#,
            r#"{"end": "fail", "why": "x"}"#,
            r#"`{"react": "fail"}` is read as `{"end": "fail"}`"#,
        ),
        (
            r#"{"action":"pause","within":5}"#,
            r#"{"react": "pause", "within": 5}"#,
            r#"`{"action": "pause"}` is read as `{"react": "pause"}`"#,
        ),
    ] {
        step(&monitor(shape), &monitor(form), note);
    }
    let notes =
        [r#"a list of one reaction is read as a reaction"#, r#"`pause` is read as `{"react": "pause"}`"#];
    let whole = |step: &str| format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#);
    check(&whole(&monitor(r#"["pause"]"#)), &whole(&monitor(r#"{"react": "pause"}"#)), &notes);
}

#[test]
fn shapes_of_facts_are_conditions() {
    condition(r#"{"open":"fridge_1"}"#, r#""open(fridge_1)""#, r#"`{"open": …}` is read as `"open(…)"`"#);
    condition(
        r#"{"not":{"holding":"$mug"}}"#,
        r#"{"not": "holding(mug)"}"#,
        r#"`{"holding": …}` is read as `"holding(…)"`"#,
    );
    condition(r#"{"on":["mug","any"]}"#, r#""on(mug, any)""#, r#"`{"on": […]}` is read as `"on(…)"`"#);
    condition(r#"{"in":["7up","a b"]}"#, r#""in(`7up`, `a b`)""#, r#"`{"in": […]}` is read as `"in(…)"`"#);
    condition(r#"{"lit":true}"#, r#""lit()""#, r#"`{"lit": …}` is read as `"lit(…)"`"#);
    condition(
        r#"{"on":{"object":"$mug","support":"any"}}"#,
        r#"{"is": "on", "object": "$mug", "support": "any"}"#,
        r#"`{"on": {…}}` is read as `{"is": "on", …}`"#,
    );
    condition(
        r#"{"is":"on","args":{"object":"$mug","support":"any"}}"#,
        r#"{"is": "on", "object": "$mug", "support": "any"}"#,
        r#"`{"is": …, "args": {…}}` is read as `{"is": …}`"#,
    );
    condition(
        r#"{"fluent":"open","container":"fridge_1"}"#,
        r#"{"is": "open", "container": "fridge_1"}"#,
        r#"`{"fluent": …, "container": …}` is read as `{"is": …}`"#,
    );
    condition(
        r#"{"and":["lit()",{"not":"lit()"}]}"#,
        r#"{"all": ["lit()", {"not": "lit()"}]}"#,
        "the key `and` is read as `all`",
    );
    condition(
        r#"{"<":[{"get":"battery"},0.2]}"#,
        r#"{"less": [{"get": "battery"}, 0.2]}"#,
        "the key `<` is read as `less`",
    );
}

#[test]
fn shapes_of_lists_and_names_are_those_of_their_place() {
    step(
        r#"{"try":[{"do":"home"}],"catch":[{"on":"slipped","steps":[]}]}"#,
        r#"{"try": [{"do": "home"}], "catch": [{"on": ["slipped"], "steps": []}]}"#,
        "a single value is read as a list of one",
    );
    step(
        r#"{"try":{"do":"home"},"catch":{"on":["slipped"],"steps":{"do":"home"}}}"#,
        r#"{"try": [{"do": "home"}], "catch": [{"on": ["slipped"], "steps": [{"do": "home"}]}]}"#,
        "a single value is read as a list of one, here and 2 more times",
    );
    step(
        r#"{"try":[{"do":"home"}],"catch":[{"on":["slipped"],"then":[]}]}"#,
        r#"{"try": [{"do": "home"}], "catch": [{"on": ["slipped"], "steps": []}]}"#,
        "the key `then` is read as `steps`",
    );
    step(
        r#"{"repeat":2,"do":[{"do":"home"}]}"#,
        r#"{"repeat": 2, "steps": [{"do": "home"}]}"#,
        "the key `do` is read as `steps`",
    );
    step(
        r#"{"do":"detect","what":"mug","as":"$mug"}"#,
        r#"{"do":"detect","what":"mug","as":"mug"}"#,
        "`$mug` is read as `\"mug\"`",
    );
}

#[test]
fn shapes_of_documents_are_policies() {
    let form = r#"{"motet": 1, "policy": "plan", "steps": [{"do": "home"}]}"#;
    let steps = "is read as a policy with these steps";
    check(r#"[{"do":"home"}]"#, form, &[&format!("a list of steps {steps}")]);
    check(r#"{"do":"home"}"#, form, &[&format!("a step alone {steps}")]);
    check(
        r#"[{"name":"home","arguments":{}}]"#,
        form,
        &[&format!("a list of steps {steps}"), r#"`{"name": …, "arguments": {…}}` is read as `{"do": …}`"#],
    );
    check(
        r#"{"steps":[{"do":"home"}]}"#,
        form,
        &[r#"the policy is read as one with `"motet": 1, "policy": "plan"`"#],
    );
    check(
        r#"{"name":"plan","plan":[{"do":"home"}]}"#,
        form,
        &[
            "the key `name` is read as `policy`",
            r#"the policy is read as one with `"motet": 1`"#,
            "the key `plan` is read as `steps`",
        ],
    );
    check(
        r#"{"thought":"Go home.","motet":1,"policy":"plan","steps":[{"do":"home"}],"summary":"x"}"#,
        form,
        &["`thought`, `summary` are read as prose, which is ignored"],
    );
}

#[test]
fn shapes_of_handlers_hold_a_step() {
    let handler =
        r#"{"try": [{"do": "home"}], "catch": [{"on": ["any"], "steps": [{"do": "say", "text": "x"}]}]}"#;
    let steps = "steps is read as a handler of any failure with these steps";
    step(r#"{"try":[{"do":"home"}],"catch":[{"do":"say","text":"x"}]}"#, handler, steps);
    step(r#"{"try":[{"do":"home"}],"catch":{"do":"say","text":"x"}}"#, handler, steps);
    let whole = |step: &str| format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#);
    check(
        &whole(r#"{"try":[{"do":"home"}],"except":[{"do":"say","text":"x"}]}"#),
        &whole(handler),
        &["the key `except` is read as `catch`", steps],
    );
    step(
        r#"{"try":[{"do":"home"}],"catch":[{"do":"say","on":"any","text":"x"}]}"#,
        handler,
        r#"`{"do": …, "on": …, "text": …}` is read as a handler with this step"#,
    );
    step(
        r#"{"try":[{"do":"home"}],"catch":[{"on":["any"],"do":"say","text":"x"}]}"#,
        handler,
        r#"`{"on": […], "do": …, "text": …}` is read as a handler with this step"#,
    );
}

#[test]
fn shapes_of_forms_are_known_by_their_word() {
    let home = r#"[{"do": "home"}]"#;
    let whole = |step: &str| format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#);
    let form = |shape: &str, form: &str, notes: &[&str]| check(&whole(shape), &whole(form), notes);
    let choice = format!(r#"{{"if": "open(fridge_1)", "then": {home}}}"#);
    let condition = "the key `condition` is read as `if`";
    let (by_do, by_type) =
        (r#"`{"do": "if"}` is read as `{"if": …}`"#, r#"`{"type": "if"}` is read as `{"if": …}`"#);
    let shape = format!(r#"{{"do":"if","condition":"open(fridge_1)","then":{home}}}"#);
    form(&shape, &choice, &[by_do, condition]);
    let shape = format!(r#"{{"type":"if","condition":"open(fridge_1)","then":{home}}}"#);
    form(&shape, &choice, &[by_type, condition]);
    let shape = format!(r#"{{"type":"if","if":"open(fridge_1)","then":{home}}}"#);
    form(&shape, &choice, &[by_type]);
    let shape = format!(r#"{{"do":"repeat","times":3,"steps":{home}}}"#);
    let repeat = format!(r#"{{"repeat": 3, "steps": {home}}}"#);
    form(
        &shape,
        &repeat,
        &[r#"`{"do": "repeat"}` is read as `{"repeat": …}`"#, "the key `times` is read as `repeat`"],
    );
    let shape = format!(r#"{{"for":"x","in":"$xs","at_most":2,"steps":{home}}}"#);
    let each = format!(r#"{{"each": "x", "in": "$xs", "at_most": 2, "steps": {home}}}"#);
    form(&shape, &each, &["the key `for` is read as `each`"]);
    let shape = format!(r#"{{"steps":{home},"finally":{home}}}"#);
    let group = format!(r#"{{"sequence": "steps", "steps": {home}, "finally": {home}}}"#);
    form(&shape, &group, &[r#"`{"steps": […], "finally": […]}` is read as `{"sequence": "steps", …}`"#]);
    let shape = format!(r#"{{"name":"tidy","steps":{home}}}"#);
    let group = format!(r#"{{"sequence": "tidy", "steps": {home}}}"#);
    form(&shape, &group, &["the key `name` is read as `sequence`"]);
}

#[test]
fn shapes_of_parts_are_those_of_the_language() {
    step(
        r#"{"end":"cannot","reason":"no mug"}"#,
        r#"{"end": "cannot", "why": "no mug"}"#,
        "the key `reason` is read as `why`",
    );
    step(
        r#"{"wait":"lit()","comment":"until it is light","step":2}"#,
        r#"{"wait": "lit()"}"#,
        "`comment`, `step` are read as prose, which is ignored",
    );
    let wait = r#"`{"seconds": …}` is read as its value"#;
    step(r#"{"wait":{"seconds":5}}"#, r#"{"wait": 5}"#, wait);
    step(r#"{"wait":{"until":"lit()"}}"#, r#"{"wait": "lit()"}"#, r#"`{"until": …}` is read as its value"#);
    let keep = r#"{"keep": [{"distance": "user", "at_least": "1 m"}], "steps": []}"#;
    let whole = |step: &str| format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#);
    let rule = r#"`distance(user) >= 1 m` is read as `{"distance": "user", "at_least": "1 m"}`"#;
    check(
        &whole(r#"{"keep":"distance(user) >= 1 m","steps":[]}"#),
        &whole(keep),
        &["a single value is read as a list of one", rule],
    );
    step(r#"{"keep":["distance(user) >= 1 m"],"steps":[]}"#, keep, rule);
    step(
        r#"{"keep":["out of stairs"],"steps":[]}"#,
        r#"{"keep": [{"out_of": "stairs"}], "steps": []}"#,
        r#"`out of stairs` is read as `{"out_of": "stairs"}`"#,
    );
    step(r#""home""#, r#"{"do": "home"}"#, r#"`home` is read as `{"do": "home"}`"#);
    step(
        r#""go(user) slowly""#,
        r#"{"do": "go", "arg1": "user", "manner": "slowly"}"#,
        r#"`go(user) slowly` is read as `{"do": "go", "arg1": "user", "manner": "slowly"}`"#,
    );
}

#[test]
fn shapes_of_documents_may_be_in_other_objects() {
    let form = r#"{"motet": 1, "policy": "plan", "steps": [{"do": "home"}]}"#;
    check(
        r#"{"policy":{"name":"plan","steps":[{"do":"home"}]}}"#,
        form,
        &[
            r#"the policy is read as one with `"motet": 1`"#,
            r#"`{"policy": {…}}` is read as the policy in it"#,
            "the key `name` is read as `policy`",
        ],
    );
    check(
        r#"{"thought":"x","plan":{"steps":[{"do":"home"}]}}"#,
        form,
        &[
            r#"the policy is read as one with `"motet": 1, "policy": "plan"`"#,
            r#"`{"thought": …, "plan": {…}}` is read as the policy in it"#,
        ],
    );
    let goal = r#"{"motet": 1, "policy": "plan", "achieves": "near(user)", "steps": []}"#;
    check(
        r#"{"motet":1,"policy":"plan","goal":"near(user)","steps":[]}"#,
        goal,
        &["the key `goal` is read as `achieves`"],
    );
    check(
        r#"{"motet":1,"policy":"plan","goal":"Go to the user.","steps":[{"do":"home"}]}"#,
        form,
        &["`goal` is read as prose, which is ignored"],
    );
    check(
        r#"["home"]"#,
        form,
        &["a list of steps is read as a policy with these steps", r#"`home` is read as `{"do": "home"}`"#],
    );
}

/// The errors of steps that have no one reading, each as `code pointer message`.
#[track_caller]
fn refused(step: &str, errors: &[&str]) {
    let document = format!(r#"{{"motet": 1, "policy": "p", "steps": [{step}]}}"#);
    let parsed = parse(&document);
    let found: Vec<String> = parsed
        .diagnostics
        .iter()
        .filter(|said| said.severity == Severity::Error)
        .map(|said| format!("{} {} {}", said.code, said.path, said.message))
        .collect();
    assert_eq!(found, errors, "{step}");
}

#[test]
fn shapes_with_several_readings_are_errors() {
    refused(r#"{"action":"pick","tool":"hand"}"#, &["M0109 /steps/0 no key says what this object is"]);
    refused(r#"{"name":"mug"}"#, &["M0109 /steps/0 no key says what this object is"]);
    refused(
        r#"{"do":"pick","object":"a","args":{"object":"b"}}"#,
        &["M0104 /steps/0/args/object the key `object` stands twice in one object"],
    );
    refused(r#"{"wait":{"open":"a","near":"b"}}"#, &["M0109 /steps/0/wait no key says what this object is"]);
    refused(r#"{"sequenc":{"a":1}}"#, &["M0109 /steps/0 unknown key `sequenc`"]);
    refused(r#"{"wait":{"nott":"lit()"}}"#, &["M0109 /steps/0/wait unknown key `nott`"]);
    refused(
        r#""pick it up""#,
        &["M0106 /steps/0 expected an object that is a step, found the string `pick it up`"],
    );
}

#[test]
fn shapes_leave_what_the_language_has_as_it_is() {
    for steps in [
        r#"{"do": "act", "action": "wave", "name": "x", "args": ["a"], "arguments": "{{}}"}"#,
        r#"{"do": "act", "args": {"get": "battery"}}"#,
        r#"{"do": "act", "function": "x", "type": "function"}"#,
    ] {
        let document = format!(r#"{{"motet": 1, "policy": "p", "steps": [{steps}, {{"end": "finish"}}]}}"#);
        let parsed = parse(&document);
        let codes: Vec<_> = parsed.diagnostics.iter().map(|said| said.message.as_str()).collect();
        assert_eq!(codes, ["`finish` is read as `\"done\"`"], "{steps}");
        let plain = document.replace("finish", "done");
        assert!(policy(&parsed) == policy(&parse(&plain)), "{steps}");
    }
}

#[test]
fn shapes_keep_the_places_of_the_document() {
    let document = r#"{"plan": [{"action": "pick", "args": {"object": {"get": "x", "y": null}}},
        {"type": "function", "function": {"name": "go", "arguments": {"to": [{"is": 1}]}}}]}"#;
    let parsed = parse(document);
    let errors: Vec<_> = parsed.diagnostics.iter().filter(|said| said.severity == Severity::Error).collect();
    let found: Vec<_> =
        errors.iter().map(|said| (said.path.as_str(), &document[said.span.range()])).collect();
    assert_eq!(found, [("/plan/0/args/object/y", "null"), ("/plan/1/function/arguments/to/0/is", "1"),]);
    assert!(parsed.written.is_some());
}

fn value() -> impl Strategy<Value = serde_json::Value> {
    let keys = [
        "do",
        "args",
        "name",
        "action",
        "arguments",
        "function",
        "type",
        "open",
        "not",
        "all",
        "if",
        "then",
        "steps",
        "plan",
        "motet",
        "policy",
        "catch",
        "try",
        "on",
        "as",
        "monitor",
        "when",
        "during",
        "end",
        "object",
        "is",
        "thought",
        "react",
        "parallel",
        "repeat",
        "goal",
        "reason",
        "finally",
        "keep",
        "wait",
        "seconds",
        "condition",
        "for",
        "in",
        "literal",
    ];
    let word = proptest::sample::select(vec![
        "pick",
        "$x",
        "done",
        "pause",
        "",
        "{\"a\": 1}",
        "a b",
        "é",
        "if",
        "go(x) home()",
        "out of x",
        "lit()",
    ]);
    let leaf = prop_oneof![
        word.prop_map(serde_json::Value::from),
        Just(serde_json::Value::Null),
        Just(serde_json::Value::from(true)),
        (0_u8..9).prop_map(serde_json::Value::from),
    ];
    leaf.prop_recursive(6, 60, 5, move |inner| {
        let key = proptest::sample::select(keys.to_vec());
        prop_oneof![
            proptest::collection::vec(inner.clone(), 0..4).prop_map(serde_json::Value::from),
            proptest::collection::vec((key, inner), 0..5).prop_map(|members| {
                let members = members.into_iter().map(|(key, value)| (key.to_owned(), value));
                serde_json::Value::Object(members.collect())
            }),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 3000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Whatever a document holds, its fix writes the document that was read.
    #[test]
    fn shapes_are_written_as_they_are_read(value in value(), is_pretty in any::<bool>()) {
        let document =
            if is_pretty { serde_json::to_string_pretty(&value).unwrap() } else { value.to_string() };
        let parsed = parse(&document);
        if parsed.diagnostics.iter().any(|said| said.code.0 == "M0122") {
            let fixed = fixed(&document, &parsed);
            let after = parse(&fixed);
            let (before, after_fix) = (&parsed.file.items, &after.file.items);
            prop_assert!(before == after_fix, "{document}\n{fixed}\n{before:#?}\n{after_fix:#?}");
            let errors = |parsed: &Parsed| {
                let errors = parsed.diagnostics.iter().filter(|said| said.severity == Severity::Error);
                errors.map(|said| said.code).collect::<Vec<_>>()
            };
            prop_assert_eq!(errors(&parsed), errors(&after), "{}\n{}", document, fixed);
        }
        for said in &parsed.diagnostics {
            prop_assert!(document.get(said.span.range()).is_some());
        }
    }
}
