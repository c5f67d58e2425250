//! What drawings look like.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use motet_graph::arbitrary::vocabulary as v;
use motet_graph::arbitrary::{Call, React, Step, When, graph};
use motet_graph::{Condition, Ending, Graph, draw};

fn example() -> Graph {
    graph(&[
        Step::detect("the \"red\" mug\n<1>"),
        Step::Monitor(
            vec![
                When { condition: v::nearer("user", 0.5), hold_secs: 0.2, react: React::Pause(60.0) },
                When::new(
                    Condition::Not(Box::new(Condition::Literal(true))),
                    React::Resume(2, vec![Step::say("oh")]),
                ),
            ],
            vec![Step::Try(
                vec![Step::Call(Call::new(v::PICK, vec![Call::NEAREST]).retry(2))],
                vec![
                    (Some(vec![v::UNREACHABLE]), vec![Step::End(Ending::Replan)]),
                    (None, vec![Step::go("table")]),
                ],
            )],
        ),
        Step::Parallel(vec![vec![Step::go("shelf")], vec![Step::say("hello")]]),
        Step::If(v::nearer("user", 1.0), vec![Step::Inline(vec![Step::End(Ending::Done)])], Some(vec![])),
        Step::Repeat(3, vec![Step::say("again")], Some(Condition::Literal(true))),
    ])
}

#[test]
fn as_text() {
    insta::assert_snapshot!(draw::text(&example()));
}

#[test]
fn as_mermaid() {
    insta::assert_snapshot!(draw::mermaid(&example()));
}

#[test]
fn as_dot() {
    insta::assert_snapshot!(draw::dot(&example()));
}
