//! `motet decode`: continuations of a policy prefix.

use crate::support::Place;

const WORLD: &str = "decode - --robot hsr --scene kitchen";
const HEAD: &str =
    r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"steps":["#;

/// A drive to the table of the mugs.
const GO: &str = r#"{"do":"go","to":"kitchen_table"}"#;

fn decode(name: &str, flags: &str, begun: &str) -> crate::support::Ran {
    Place::new(name).run_with(&format!("{WORLD} {flags}"), begun.as_bytes(), &[])
}

#[test]
fn decode_prints_bytes_that_must_and_may_follow() {
    let ran = decode("decode_bytes", "", "{\"mo\n");
    ran.check(
        0,
        &["out:accepted: 4 bytes\nmust follow: \"tet\\\":1,\\\"policy\\\":\\\"\"\nmay follow: \"ABC"],
    );
    // Only the end of a line is left out: a space belongs to what was begun.
    decode("decode_space", "--syntax text", "policy p ").check(0, &["out:accepted: 9 bytes"]);
    decode("decode_break", "--syntax text", "policy p \r\n").check(0, &["out:accepted: 9 bytes"]);
    decode("decode_white", "", "{\"motet\":1, ").check(1, &["out:refused: \" \" at byte 11"]);
    let whole = format!("{HEAD}{{\"end\":\"done\"}}],\"finally\":null}}");
    decode("decode_whole", "", &whole).check(0, &["out:the policy is complete: only the end may follow\n"]);
    Place::new("decode_file")
        .file("begun.json", "{")
        .run("decode begun.json --robot hsr --scene kitchen")
        .check(0, &["out:must follow: \"\\\"motet\\\":1,\\\"policy\\\":\\\"\""]);
}

#[test]
fn encoding_has_an_end_of_its_own() {
    decode("decode_end", "--tokenizer cl100k --end x", "{").check(2, &["err:`--end` is only for files"]);
}

#[test]
fn words_are_explained() {
    let held = format!("{HEAD}{GO},{{\"do\":\"pick\",\"object\":\"mug_1\",\"from\":\"auto\"}},{{\"do\":\"");
    let ran = decode("decode_calls", "--explain", &held);
    ran.check(0, &["out:may follow:\n", "out:calls place(object: Object, ", "out:may not:\n", "out:M0501"]);
    let step = decode("decode_steps", "--explain", HEAD);
    step.check(
        0,
        &["out:must follow: \"{\\\"\"", "out:a call\n", "out:an ending: done, fail, cannot or replan\n"],
    );
    let object =
        decode("decode_entities", "--explain", &format!("{HEAD}{GO},{{\"do\":\"pick\",\"object\":\""));
    object.check(0, &["out:Object of the scene"]);
    decode("decode_names", "--explain", "{\"motet\":1,\"policy\":\"").check(0, &["out:a name\n"]);
    let number = format!("{HEAD}{{\"repeat\":");
    decode("decode_numbers", "--explain", &number).check(0, &["out:a number\n"]);
}

#[test]
fn refusal_has_a_place_and_a_reason() {
    let twice = format!(
        "{HEAD}{GO},{{\"do\":\"pick\",\"object\":\"mug_1\",\"from\":\"auto\"}},{{\"do\":\"pick\",\
            \"object\":\"mug_2\",\"from\":\"auto\"}}"
    );
    let ran = decode("decode_refused", "", &twice);
    ran.check(
        1,
        &["out:refused: \"i\" at byte 175 (line 1, column 176), after …", "out:why: ", "out:may follow:\n"],
    );
    assert!(ran.stdout.contains("`pick` needs"), "{}", ran.stdout);
    decode(
        "decode_spelling",
        "",
        r#"{ "motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"steps":[{"end":"done"}]}"#,
    )
    .check(1, &["out:refused: \" \" at byte 1", "out:why: only the spelling"]);
}

#[test]
fn tokens_are_shown() {
    let place = Place::new("decode_tokens").file("tokens.json", r#"["{", "{\"", "x", null]"#);
    let line = "decode - --robot hsr --tokenizer tokens.json --end";
    place
        .run_with(&format!("{line} 3"), b"", &[])
        .check(0, &["out:tokens: 2 of 4\n  0 \"{\"\n  1 \"{\\\"\"\n"]);
    let whole = format!(r#"{HEAD}{{"end":"done"}}],"finally":null}}"#);
    place
        .run_with(&format!("{line} 3"), whole.as_bytes(), &[])
        .check(0, &["out:tokens: 1 of 4\n  3 the end\n"]);
    place
        .run_with(&format!("{line} 4"), b"", &[])
        .check(2, &["err:`tokens.json`: the vocabulary has no token 4 to end"]);
    place
        .run_with("decode - --robot hsr --tokenizer none.json", b"", &[])
        .check(2, &["err:cannot read `none.json`: no such file"]);
    let encoding = place.run_with("decode - --robot hsr --tokenizer cl100k", b"{\"mo", &[]);
    if cfg!(feature = "tiktoken") {
        encoding.check(0, &["out: of 100277\n"]);
    } else {
        encoding.check(2, &["err:does not contain `cl100k`; give a tokenizer file"]);
    }
}
