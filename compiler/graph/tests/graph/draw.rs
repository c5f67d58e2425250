//! Drawings of a graph with every kind of step.

use motet_arbitrary::graph::vocabulary as v;
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, graph};
use motet_graph::{Condition, Ending, Graph, draw};

fn example() -> Graph {
    graph(&[
        StepSketch::detect("the \"red\" mug\n<1>"),
        StepSketch::Monitor(
            vec![
                WatchSketch {
                    condition: v::nearer("user", 0.5),
                    hold_secs: 0.2,
                    react: ReactionSketch::Pause(60.0),
                },
                WatchSketch::new(
                    Condition::Not(Box::new(Condition::Literal(true))),
                    ReactionSketch::Resume(2, vec![StepSketch::say("oh")]),
                ),
            ],
            vec![StepSketch::Try(
                vec![StepSketch::Call(CallSketch::new(v::PICK, vec![CallSketch::NEAREST]).retry(2))],
                vec![
                    (Some(vec![v::UNREACHABLE]), vec![StepSketch::End(Ending::Replan)]),
                    (None, vec![StepSketch::go("table")]),
                ],
            )],
        ),
        StepSketch::Parallel(vec![vec![StepSketch::go("shelf")], vec![StepSketch::say("hello")]]),
        StepSketch::If(
            v::nearer("user", 1.0),
            vec![StepSketch::Inline(vec![StepSketch::End(Ending::Done)])],
            Some(vec![]),
        ),
        StepSketch::Repeat(3, vec![StepSketch::say("again")], Some(Condition::Literal(true))),
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
