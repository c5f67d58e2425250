//! Replies of a general language model that were recorded: those whose only fault was that a result bound in
//! a `try` is used behind it, or that a condition's text writes `$x`, pass.

use std::collections::BTreeMap;

use motet_compiler::Session;
use motet_planner::model::{ReplyVerdict, judge};
use motet_syntax::Sources;
use motet_tests::setup;
use serde_json::Value;

const REPLIES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/data/replies/kitchen.jsonl");

/// Codes of names that are not bound where they are used, and of conditions that cannot be read.
const SCOPES: [&str; 4] = ["M0203", "M0216", "M0101", "M0104"];

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn replies_names_that_every_way_binds_pass() {
    let text = std::fs::read_to_string(REPLIES).unwrap();
    let mut sessions: BTreeMap<String, Session> = BTreeMap::new();
    let (mut count, mut passed, mut wrong) = (0, 0, Vec::new());
    for line in text.lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        let of = |key: &str| row[key].as_str().unwrap();
        let session = sessions.entry(format!("{} {}", of("robot"), of("scene"))).or_insert_with(|| {
            let (robot, scene) = (setup::robot(of("robot")), setup::scene(of("scene")));
            setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0
        });
        count += 1;
        match judge(session, of("reply")) {
            ReplyVerdict::Good { .. } => passed += 1,
            ReplyVerdict::Bad { findings } => {
                for said in &findings {
                    println!("{}: {} {} at {}", of("request"), said.code, said.message, said.path);
                }
                let about = |code: &str| SCOPES.contains(&code);
                let scopes = findings.iter().filter(|said| about(said.code.0));
                wrong.extend(scopes.map(|said| format!("{} {}", said.code, said.message)));
            }
        }
    }
    println!("{passed} of {count} replies pass");
    assert!(count > 0);
    assert!(wrong.is_empty(), "{wrong:#?}");
}
