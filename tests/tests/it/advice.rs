//! Findings of the compiler on common mistakes: one each, with the words that help. Those of the front end
//! are in `grammar/syntax/tests/syntax/messages.rs`.

use motet_compiler::Session;
use motet_syntax::{Diagnostic, Severity, Source, Sources, render};
use motet_tests::setup;

/// The findings of a document for the HSR in the kitchen.
fn findings(document: &str) -> Vec<Diagnostic> {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let mut sources = Sources::default();
    let source = Source::new("p", document);
    let file = sources.add(source.clone());
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut sources);
    session.check(&motet_syntax::read(&source, file))
}

/// The errors of a document for the HSR in the kitchen, each as `code: message; help`.
fn errors(document: &str) -> Vec<String> {
    let said = findings(document);
    let errors = said.iter().filter(|said| said.severity == Severity::Error);
    errors
        .map(|said| format!("{}: {}; {}", said.code, said.message, said.help.as_deref().unwrap_or("")))
        .collect()
}

fn check(document: &str, expected: &[&str]) {
    let found = errors(document);
    let fits =
        found.len() == expected.len() && found.iter().zip(expected).all(|(found, words)| found == words);
    assert!(fits, "{document}\nexpected {expected:#?}\nfound {found:#?}");
}

/// A policy in text with this body.
fn text(body: &str, expected: &[&str]) {
    check(&format!("policy p for hsr {{\n    {body}\n}}\n"), expected);
}

/// A policy in JSON with these steps.
fn json(steps: &str, expected: &[&str]) {
    check(&format!(r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{steps}]}}"#), expected);
}

const DETECT: &str =
    r#"{"do": "go", "to": "kitchen_table"}, {"do": "detect", "what": "red mug", "as": "mug"}"#;

#[test]
fn diagnostics_binding_in_json_has_its_sign() {
    json(
        &format!(r#"{DETECT}, {{"do": "pick", "object": "mug"}}"#),
        &["M0202: there is no `Object` `mug`; `mug` is a binding: write `$mug`"],
    );
    json(
        &format!(r#"{DETECT}, {{"do": "pick", "object": "$mgu"}}"#),
        &["M0203: nothing is bound to `mgu` here; did you mean `$mug`?"],
    );
    json(
        r#"{"do": "say", "text": "$5"}"#,
        &["M0203: nothing is bound to `5` here; to start a text with `$`, write two: `$$5`"],
    );
}

#[test]
fn diagnostics_forgotten_sign_is_mended() {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let steps = format!(r#"{DETECT}, {{"do": "pick", "object": "mug"}}"#);
    let document = format!(r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{steps}]}}"#);
    let limits = motet_compiler::fix::FixLimits::safe(10);
    let fixed = motet_compiler::fix::fix(&session, &Source::new("p", document), Default::default(), limits);
    assert!(fixed.text.contains(r#""object": "$mug""#), "{}", fixed.text);
}

#[test]
fn diagnostics_ratios_lie_between_nothing_and_all() {
    text(
        "if battery() < 20 { say(\"x\") }",
        &["M0302: `20` needs a unit: a `Ratio` is expected; write `20 %`; the units are `%`"],
    );
    text(
        "if battery() < 0.2 { say(\"x\") }",
        &["M0302: `0.2` needs a unit: a `Ratio` is expected; write `20 %`; the units are `%`"],
    );
    let meant = "M0310: a ratio is 20, but must be from 0 to 1; did you mean `20 %`? write `0.2`";
    json(r#"{"if": {"less": [{"get": "battery"}, 20]}, "then": [{"do": "say", "text": "x"}]}"#, &[meant]);
    json(r#"{"if": "battery() < 20", "then": [{"do": "say", "text": "x"}]}"#, &[meant]);
    json(r#"{"if": {"less": [{"get": "battery"}, 0.2]}, "then": [{"do": "say", "text": "x"}]}"#, &[]);
    text(
        "if battery() < 2000 % { say(\"x\") }",
        &["M0310: a ratio is 2000 %, but must be from 0 % to 100 %; write a number from 0 % to 100 %"],
    );
    text("if distance(user) / distance(counter) > 1.5 { say(\"x\") }", &[]);
}

#[test]
fn diagnostics_binding_hides_no_entity() {
    let said = "M0206: `kitchen_table` is an entity, which a binding must not hide; choose another name than \
                `kitchen_table`";
    json(
        r#"{"do": "detect", "what": "red mug", "as": "kitchen_table"}, {"do": "go", "to": "kitchen_table"}"#,
        &[said],
    );
    text("let kitchen_table = detect(\"red mug\") go(kitchen_table)", &[said]);
    text(
        "let user = detect(\"red mug\") go(user)",
        &["M0206: `user` is an entity, which a binding must not hide; choose another name than `user`"],
    );
}

#[test]
fn diagnostics_unknown_robot_is_an_error() {
    let session = Session::builder().build(&mut Sources::default());
    let said = |text: &str| {
        let parsed = motet_syntax::read(&Source::new("p", text), Default::default());
        let said = session.check(&parsed);
        said.iter()
            .map(|said| format!("{} {}", said.code, said.help.clone().unwrap_or_default()))
            .collect::<Vec<_>>()
    };
    assert_eq!(said("policy p for hsrr { say(\"x\") }"), ["M0447 did you mean `hsr`?"]);
    assert_eq!(said("policy p for hsr { say(\"x\") }"), [""; 0]);
}

#[test]
fn diagnostics_domain_is_checked_beside_a_robot() {
    let mut sources = Sources::default();
    let domain = "action wave() uses elbow\naction nod()\n";
    let source = Source::new("domain.motet", domain);
    let file = sources.add(source.clone());
    let parsed = motet_syntax::read(&source, file);
    let robot = setup::robot("hsr");
    let session = Session::builder().robot(&robot).domains(&[parsed.file]).build(&mut sources);
    let said = session.input_diagnostics().to_vec();
    let codes = |said: &[motet_syntax::Diagnostic]| said.iter().map(|said| said.code.0).collect::<Vec<_>>();
    assert_eq!(codes(&said), ["M0215"]);
    let policy =
        motet_syntax::read(&Source::new("p", "policy p for hsr { nod() wave() }"), Default::default());
    assert_eq!(codes(&session.check(&policy)), ["M0402", "M0402"]);
}

#[test]
fn diagnostics_quantities_are_told_in_their_own_units() {
    text(
        "turn(720 deg)",
        &["M0404: `by` of `turn` is 720 deg, but `hsr` allows -360 deg to 360 deg; write a value from \
             -360 deg to 360 deg"],
    );
    json(
        r#"{"do": "turn", "by": 90}"#,
        &["M0404: `by` of `turn` is 90 rad, but `hsr` allows -6.28318531 rad to 6.28318531 rad; a number \
             without a unit is in radians: \
           did you mean `\"90 deg\"`?"],
    );
    text(
        "go(user) within 1000 h",
        &["M0310: a deadline is 1000 h, but must be from 0 h to 168 h; write a number from 0 h to 168 h"],
    );
    text(
        "repeat 99999999999999999999 { say(\"x\") }",
        &["M0310: the count of a `repeat` is 100000000000000000000, but must be from 1 to 1000000; write \
             a number from 1 to \
           1000000"],
    );
}

#[test]
fn diagnostics_one_mistake_is_told_once() {
    json(
        r#"{"do": "go", "to": "user", "retry": "two"}"#,
        &["M0106: expected a whole number, found the string `two`; write a whole number here"],
    );
    json(
        r#"{"do": "go", "to": "user", "within": "20"}"#,
        &["M0108: `20` is not a duration; did you mean `\"20 s\"`?"],
    );
    let found = errors(
        r#"{"motet": 1, "policy": "p", "steps": [{"if": "holding($mug)", "then": [{"do": "say",
            "text": "x"}]}]}"#,
    );
    assert!(found.len() == 1 && found[0].starts_with("M0203"), "{found:?}");
    let found = errors(
        "policy p for hsr { go(kitchen_table) inspect(mug_1) pick(mgu_1) go(counter) place(mug_1, counter) }",
    );
    assert!(found.len() == 1 && found[0].starts_with("M0202"), "{found:?}");
}

#[test]
fn diagnostics_help_says_what_to_write() {
    text(
        "go(\"kitchen_table\")",
        &["M0301: `to` of `go` takes an `Entity`, not the text \"kitchen_table\"; write `kitchen_table` \
             without quotes"],
    );
    text(
        "handover(mug_1, kitchen_table)",
        &[
            "M0501: `handover` needs `holding(mug_1)`, which does not hold at the start; call `pick` or \
             `grasp` first",
            "M0301: `to` of `handover` takes a `Person`, not `kitchen_table`, which is a `Surface`; write \
             `user`",
        ],
    );
    text("if holding { say(\"x\") }", &["M0202: unknown name `holding`; write `holding(object)`"]);
    text("if battery < 20 % { say(\"x\") }", &["M0202: unknown name `battery`; write `battery()`"]);
    text(
        "if mug_1.colour < 1 m { say(\"x\") }",
        &["M0211: `Object` has no field `colour`; its fields are `width` and `mass`"],
    );
    text(
        "if counter.mass < 1 kg { say(\"x\") }",
        &["M0211: `Surface` has no field `mass`; `Object` has it; `Surface` has none"],
    );
    let found = errors(
        r#"{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{"do": "turn", "by": "90 degrees"}]}"#,
    );
    assert!(found.len() == 1 && found[0].ends_with(r#"; write `"90 deg"`"#), "{found:?}");
    let found = errors("policy p for hsr { let m = choose(\"x\", mug_1) go(m) }");
    assert_eq!(found, [""; 0], "one value stands for a list of it");
}

#[test]
fn diagnostics_what_cannot_be_given_is_told_alone() {
    text(
        "go(kitchen_table) inspect(mug_1) pick(mug_1) place(mug_1, robot)",
        &["M0501: `place` needs something other than `robot`, but it is given exactly that; name another \
              entity, or remove this step"],
    );
}

/// A label within the place of the finding stands under what it is about.
#[test]
fn diagnostics_labels_stand_under_their_places() {
    let mut sources = Sources::default();
    let source = Source::new("p", "policy p { parallel { { open(drawer_1) } { close(drawer_1) } } }");
    let file = sources.add(source.clone());
    let scene = setup::scene("kitchen");
    let (session, _) = setup::session(None, Some(&scene), &mut sources);
    let mut said = session.check(&motet_syntax::read(&source, file));
    said.retain(|said| said.code.0 == "M0702");
    assert!(!said.is_empty());
    let shown = render::human(&said[..1], &sources, render::ColorChoice::Off, 120);
    let lines: Vec<&str> = shown.lines().collect();
    let document = lines.iter().find(|line| line.contains("policy p")).unwrap();
    let marks = lines.iter().find(|line| line.contains('┬')).unwrap();
    let column = |line: &str, of: &str| line.split(of).next().unwrap().chars().count();
    let at = |place: &str| marks.chars().nth(column(document, place)).unwrap();
    assert!(["parallel", "open(", "close("].iter().all(|place| "─┬".contains(at(place))), "{shown}");
    assert_eq!(at(" { open"), ' ', "{shown}");
}

/// The document after the safe fixes.
fn mended(document: &str) -> String {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let limits = motet_compiler::fix::FixLimits::safe(10);
    motet_compiler::fix::fix(&session, &Source::new("p", document), Default::default(), limits)
        .text
        .to_string()
}

#[test]
fn diagnostics_words_lead_to_what_exists() {
    let unknown =
        |name: &str, help: &str| [format!("M0201: there is no primitive or policy `{name}`; write {help}")];
    let call = |call: &str, help: &str| {
        let name = call.split('(').next().unwrap();
        let expected = unknown(name, help);
        text(call, &expected.each_ref().map(String::as_str));
    };
    call("sleep(5)", "`wait 5 s`, or `wait until …` with a condition");
    call("juggle()", "a primitive of the robot, or end with `cannot \"why\"`");
    call("turn_on(counter)", "`cannot \"…\"`, since the robot has no such step");
    call("go_home()", "`go(start)` to drive back, or `home()` for the arm");
    call("insert(mug_1, fridge_1)", "`place(object: …, on: …)`");
    let expected =
        unknown("juggle", r#"a primitive of the robot, or end with `{"end": "cannot", "why": …}`"#);
    json(r#"{"do": "juggle"}"#, &expected.each_ref().map(String::as_str));
    text("if closed(fridge_1) { home() }", &["M0208: there is no fluent `closed`; write `not open(…)`"]);
    let said = "M0306: `+` does not apply to Text and Text; write values in the braces of one text: \
                `\"I see {count(cans)} cans\"`";
    text("say(\"a\" + \"b\")", &[said]);
    json(r#"{"do": "say", "text": "x", "comment": "be polite", "step": 1}"#, &[]);
    let all = r#"{"do": "detect_all", "what": "mug", "as": "xs"}"#;
    json(&format!(r#"{DETECT}, {all}, {{"do": "inspect", "what": "$xs[0]"}}"#), &[]);
}

#[test]
fn diagnostics_waits_and_endings_written_as_calls_are_mended() {
    for (step, written) in [
        ("sleep(5)", "wait 5 s"),
        ("sleep(200 ms)", "wait 200 ms"),
        ("cannot_do()", "cannot_do()"),
        ("refuse(\"I have no arm.\")", "cannot \"I have no arm.\""),
    ] {
        let text = mended(&format!("policy p for hsr {{\n    {step}\n}}\n"));
        assert!(text.contains(written), "{step}: {text}");
    }
    for (step, written) in [
        (r#"{"do": "sleep", "seconds": 3}"#, r#"{"wait": 3}"#),
        (r#"{"do": "wait", "time": "200 ms"}"#, r#"{"wait": "200 ms"}"#),
        (r#"{"do": "cannot", "why": "a"}"#, r#"{"end": "cannot", "why": "a"}"#),
    ] {
        let text = mended(&format!(r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{step}]}}"#));
        assert!(text.contains(written), "{step}: {text}");
    }
}

/// The warnings and notes for the HSR in the kitchen are not about a code.
fn is_silent(document: &str, code: &str) {
    let said = findings(document);
    assert!(said.iter().all(|said| said.code.0 != code), "{said:#?}");
}

#[test]
fn diagnostics_names_in_a_text_that_cannot_be_read_are_not_unused() {
    let body = "let n = battery() let f = distance(user) say(\"{n} and {f\")";
    is_silent(&format!("policy p for hsr {{\n    {body}\n}}\n"), "M0901");
}

#[test]
fn diagnostics_repair_puts_down_what_the_hand_may_hold() {
    let held = "go(kitchen_table)\n    inspect(plate)\n    \
                try { pick(plate) } catch unreachable { say(\"x\") }\n    \
                go(fridge_1)\n    open(fridge_1)";
    let found = errors(&format!("policy p for hsr {{\n    {held}\n}}\n"));
    assert!(found[0].starts_with("M0501: `open` needs `free(hand)`"), "{found:#?}");
    assert!(found.iter().all(|said| !said.contains("mug_1")), "{found:#?}");
    let first = r#"{"do": "go", "to": "kitchen_table"}, {"do": "detect_all", "what": "mug", "as": "xs"},
        {"do": "inspect", "what": {"get": "first", "of": "$xs"}},
        {"do": "pick", "object": {"get": "first", "of": "$xs"}}, {"do": "pick", "object": "$ys"}"#;
    let found = errors(&format!(r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{first}]}}"#));
    assert!(found.iter().any(|said| said.contains("`pick(first(xs))` made false")), "{found:#?}");
    assert!(found.iter().all(|said| !said.contains("nsert") && !said.contains("`pick()`")), "{found:#?}");
}

#[test]
fn diagnostics_need_of_a_cleanup_names_the_way_that_breaks_it() {
    let body = "sequence a {\n        go(kitchen_table)\n        inspect(mug_1)\n \
                       pick(mug_1)\n    } finally \
                {\n        place(mug_1, kitchen_table)\n    }";
    let found = errors(&format!("policy p for hsr {{\n    {body}\n}}\n"));
    let way = "`place` needs `holding(mug_1)`, which does not hold where `go(kitchen_table)` fails";
    assert!(found.iter().any(|said| said.contains(way)), "{found:#?}");
    let test = "test it first: `if holding(mug_1) { … }`";
    assert!(found.iter().any(|said| said.contains(test)), "{found:#?}");
}

#[test]
fn diagnostics_container_that_a_refused_step_would_close_is_not_told_as_left_open() {
    let steps = r#"{"do": "go", "to": "fridge_1"}, {"do": "open", "what": "fridge_1"},
        {"do": "go", "to": "user"}], "finally": [{"do": "close", "what": "fridge_1"}"#;
    is_silent(&format!(r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{steps}]}}"#), "M0907");
}
