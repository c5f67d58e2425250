//! `motet export btcpp` and `motet import btcpp` from outside.

use crate::support::Place;

const TIDY: &str = "policy tidy for hsr { go(kitchen_table) pick(mug_1) \
                    try { go(counter) place(mug_1, counter) } catch unreachable { say(\"I cannot\") } }\n";

#[test]
fn policy_comes_back_from_its_tree() {
    let place = Place::new("trees").file("tidy.motet", TIDY);
    let room = "--robot hsr --scene kitchen";
    place.run(&format!("export btcpp tidy.motet {room} -o tidy.xml")).check(0, &[]);
    let tree = place.read("tidy.xml");
    assert!(tree.contains("<TreeNodesModel>") && tree.contains("BTCPP_format=\"4\""), "{tree}");
    place.run(&format!("import btcpp tidy.xml {room} -o back.motet")).check(0, &[]);
    place.run(&format!("check back.motet {room}")).check(0, &[]);
    // The tree of the imported policy makes the same calls.
    place.run(&format!("export btcpp back.motet {room} -o again.xml")).check(0, &[]);
    let calls = |tree: &str| tree.matches("<pick ").count() + tree.matches("<place ").count();
    assert_eq!(calls(&tree), calls(&place.read("again.xml")));
}

#[test]
fn export_btcpp_refuses_constructs_without_a_node() {
    let place = Place::new("trees_refused")
        .file(
            "pauses.motet",
            "policy p for hsr {\n    monitor when distance(user) < 1 m then pause during { \
             say(\"hi\") }\n}\n",
        )
        .file("wrong.motet", "policy p for hsr { pick(mug_1) }\n")
        .file("crowded.xml", format!("<root {}/>", (0..300).map(|n| format!("a{n}='' ")).collect::<String>()))
        .file("torn.xml", "<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\"><Sequence>")
        .file(
            "unknown.xml",
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"a\"><frobnicate/></BehaviorTree></root>",
        );
    let room = "--robot hsr --scene kitchen";
    let refused = place.run(&format!("export btcpp pauses.motet {room} -o pauses.xml"));
    refused.check(1, &["err:pauses.motet", "err:then pause", "err:`/steps/0`"]);
    assert!(!place.path("pauses.xml").exists());
    place.run(&format!("export btcpp wrong.motet {room}")).check(1, &["out:M0501"]);
    place.run(&format!("import btcpp torn.xml {room}")).check(1, &["out:M0141", "out:torn.xml:1:"]);
    place.run(&format!("import btcpp crowded.xml {room}")).check(1, &["out:M0141", "out:more than 256"]);
    place.run(&format!("import btcpp unknown.xml {room}")).check(1, &["out:M0143", "out:frobnicate"]);
    place.run(&format!("import btcpp absent.xml {room}")).check(2, &["err:cannot read `absent.xml`"]);
}
