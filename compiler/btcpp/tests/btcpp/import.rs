//! Import: nodes as steps, findings with their places, and hostile documents.

use motet_btcpp::{MAX_IMPORTED_STEPS, import};
use motet_syntax::{FileId, Source, print};

use super::round_trip::{compiled, session};

fn document(tree: &str) -> String {
    format!("<root BTCPP_format=\"4\">\n<BehaviorTree ID=\"main\">{tree}</BehaviorTree>\n</root>")
}

/// The findings of a document: code, text of the span, message.
fn findings(text: &str) -> Vec<(&'static str, String, String)> {
    let source = Source::new("tree.xml", text);
    let (file, found) = import(&source, FileId(0), &session().signatures().leaves());
    assert_eq!(file.is_none(), !found.is_empty());
    found.into_iter().map(|one| (one.code.0, source.slice(one.span).to_owned(), one.message)).collect()
}

/// The policy of a tree, as text. It compiles.
fn imported(tree: &str) -> String {
    let (session, text) = (session(), document(tree));
    let (file, found) =
        import(&Source::new("tree.xml", text.as_str()), FileId(0), &session.signatures().leaves());
    assert_eq!(found, []);
    compiled(&session, &text).unwrap();
    print::text(&file.unwrap())
}

#[test]
fn import_reads_a_tree_as_people_write_it() {
    let text = imported(
        "<Sequence><Action ID=\"detect\" what=\"mug\" as=\"{found}\"/>
         <Fallback><RetryUntilSuccessful num_attempts=\"3\"><pick object=\"{found}\"/></RetryUntilSuccessful>
         <say text=\"no\"/></Fallback>
         <IfThenElse><Inverter><Condition ID=\"is_holding\" object=\"mug\"/></Inverter>
         <Timeout msec=\"1500\"><go to=\"table\"/></Timeout><AlwaysSuccess/></IfThenElse></Sequence>",
    );
    let wanted = "policy main {\n    let found = detect(\"mug\")\n    try {\n        pick(found) retry 2\n\
                  \x20   } catch any {\n        say(\"no\")\n    }\n    if not holding(mug) {\n        \
                  go(table) within 1.5 s\n    }\n}\n";
    let plain = text.replace("what: ", "").replace("object: ", "").replace("text: ", "").replace("to: ", "");
    assert_eq!(plain.replace('$', ""), wanted);
}

#[test]
fn import_lets_a_condition_fail_so_that_a_fallback_catches_it() {
    let text = imported(
        "<Fallback><Sequence><Condition ID=\"is_holding\" object=\"mug\"/><go to=\"user\"/></Sequence>
         <say text=\"no\"/></Fallback>",
    );
    assert!(text.contains("node_failed()") && text.contains("policy node_failed"), "{text}");
}

#[test]
fn import_inlines_trees_with_their_ports() {
    let (session, text) = (
        session(),
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"main\">
         <BehaviorTree ID=\"main\"><Sequence><SubTree ID=\"find\" what=\"mug\" it=\"{thing}\"/>
         <pick object=\"{thing}\"/></Sequence></BehaviorTree>
         <BehaviorTree ID=\"find\"><Sequence><detect what=\"{what}\" as=\"{own}\"/><go to=\"{own}\"/>
         <detect what=\"{what}\" as=\"{it}\"/></Sequence></BehaviorTree></root>",
    );
    let (graph, _) = compiled(&session, text).unwrap();
    let drawn = motet_graph::draw::text(&graph);
    assert!(
        drawn.contains("find_1_own = detect(what: \"mug\")") && drawn.contains("pick(object: thing"),
        "{drawn}"
    );
}

#[test]
fn import_refuses_with_the_place() {
    for (tree, code, place, words) in [
        ("<go to=\"user\" _skipIf=\"x\"/>", "M0142", "x", "script"),
        ("<go to=\"user\" _onSuccess=\"a:=1\"/>", "M0142", "a:=1", "script"),
        ("<Sequence><Script code=\"a:=1\"/></Sequence>", "M0142", "<Script", "script"),
        ("<Inverter><go to=\"user\"/></Inverter>", "M0142", "<Inverter", "inverts an action"),
        ("<Repeat num_cycles=\"-1\"><go to=\"user\"/></Repeat>", "M0142", "-1", "no bound"),
        (
            "<KeepRunningUntilFailure><go to=\"user\"/></KeepRunningUntilFailure>",
            "M0142",
            "<KeepRunningUntilFailure",
            "bound",
        ),
        ("<fly to=\"user\"/>", "M0143", "<fly", "no leaf `fly`"),
        ("<go where=\"user\"/>", "M0143", "user", "no port `where`"),
        ("<Timeout msec=\"soon\"><go to=\"user\"/></Timeout>", "M0143", "soon", "milliseconds"),
        (
            "<Sequence><can_pick object=\"mug\"/><pick object=\"cup\"/></Sequence>",
            "M0142",
            "<can_pick",
            "same ports",
        ),
        (
            "<LoopString queue=\"{all}\" value=\"{it}\"><pick object=\"{it}\"/></LoopString>",
            "M0142",
            "<LoopString",
            "no bound",
        ),
        ("<SetBlackboard value=\"1\" output_key=\"a\"/>", "M0142", "1", "no type"),
        ("<SubTree ID=\"main\"/>", "M0142", "<SubTree", "calls itself"),
        ("<SubTree ID=\"other\"/>", "M0143", "<SubTree", "no tree"),
        ("<Fallback><fail why=\"x\"/><go to=\"user\"/></Fallback>", "M0142", "<fail", "the fallback goes on"),
        (
            "<Parallel success_count=\"1\"><go to=\"user\"/><say text=\"a\"/></Parallel>",
            "M0142",
            "<Parallel",
            "all its children",
        ),
        ("<ReactiveFallback><is_holding object=\"mug\"/><go to=\"user\"/></ReactiveFallback>", "", "", ""),
    ] {
        let found = findings(&document(tree));
        if code.is_empty() {
            assert_eq!(found, [], "{tree}");
            continue;
        }
        let is_there = found.iter().any(|one| one.0 == code && one.1 == place && one.2.contains(words));
        assert!(is_there, "{tree}: {found:?}");
    }
}

#[test]
fn import_refuses_what_is_no_tree() {
    for (text, words) in [
        ("", "root"),
        ("<root/>", "BTCPP_format"),
        ("<root BTCPP_format=\"3\"><BehaviorTree ID=\"a\"/></root>", "BTCPP_format"),
        ("<root BTCPP_format=\"4\"></root>", "main_tree_to_execute"),
        ("<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\"/></root>", "0 children"),
        ("<root BTCPP_format=\"4\"><include path=\"x.xml\"/></root>", "not followed"),
        ("<!DOCTYPE a [<!ENTITY b \"c\">]><root BTCPP_format=\"4\">&b;</root>", "document type"),
        ("<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\">", "root"),
    ] {
        let found = findings(text);
        assert!(found.iter().any(|one| one.2.contains(words)), "{text}: {found:?}");
    }
}

#[test]
fn import_bounds_depth_and_copies() {
    let deep =
        format!("{}<go to=\"user\"/>{}", "<ForceSuccess>".repeat(5000), "</ForceSuccess>".repeat(5000));
    let found = findings(&document(&deep));
    assert!(found.iter().any(|one| one.2.contains("nested more than")), "{found:?}");
    // Each tree calls the next one ten times.
    let mut text = "<root BTCPP_format=\"4\" main_tree_to_execute=\"t0\">".to_owned();
    for level in 0..8 {
        let call = format!("<SubTree ID=\"t{}\"/>", level + 1).repeat(10);
        text.push_str(&format!("<BehaviorTree ID=\"t{level}\"><Sequence>{call}</Sequence></BehaviorTree>"));
    }
    text.push_str("<BehaviorTree ID=\"t8\"><say text=\"a\"/></BehaviorTree></root>");
    let found = findings(&text);
    assert!(found.iter().any(|one| one.2.contains(&MAX_IMPORTED_STEPS.to_string())), "{found:?}");
    let attempts = |inner: &str| {
        format!(
            "<RetryUntilSuccessful num_attempts=\"9\"><Sequence>{inner}{inner}</Sequence>\
             </RetryUntilSuccessful>"
        )
    };
    let nested = (0..5).fold("<say text=\"a\"/>".to_owned(), |inner, _| attempts(&inner));
    let found = findings(&document(&nested));
    assert!(!found.is_empty() && found.len() < 10, "{} findings", found.len());
}
