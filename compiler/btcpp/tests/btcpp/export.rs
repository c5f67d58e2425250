//! Export: what a tree says, and what it refuses.

use motet_arbitrary::graph::vocabulary as v;
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, graph};
use motet_btcpp::{Leaves, export};
use motet_graph::{Condition, Ending, Fact, FactArg, FluentId};

fn holding(object: &str) -> Condition {
    Condition::Fact(v::fact(v::HOLDING, vec![v::entity(object)]))
}

#[test]
fn export_refuses_each_part_with_its_place() {
    let go = || vec![StepSketch::go("table")];
    let watch = |react| WatchSketch::new(holding("mug"), react);
    let trusted = Condition::Fact(Fact { fluent: FluentId(2), args: vec![FactArg::Any] });
    let cases: Vec<(StepSketch, &str, &str)> = vec![
        (StepSketch::Finally(go(), go()), "/steps/0", "`finally`"),
        (StepSketch::Monitor(vec![watch(ReactionSketch::Pause(3.0))], go()), "/steps/0", "no node holds"),
        (StepSketch::Monitor(vec![watch(ReactionSketch::Restart(3))], go()), "/steps/0", "retries"),
        (StepSketch::Monitor(vec![watch(ReactionSketch::Resume(3, go()))], go()), "/steps/0", "goes on"),
        (StepSketch::If(trusted, go(), None), "/steps/0", "known from effects alone"),
        (
            StepSketch::Try(vec![StepSketch::End(Ending::Fail)], vec![(None, go())]),
            "/steps/0/try/0",
            "a fallback would go on",
        ),
        (
            StepSketch::Repeat(2, vec![StepSketch::End(Ending::Done)], None),
            "/steps/0/steps/0",
            "`done` before the last step",
        ),
        (
            StepSketch::Call(CallSketch::new(v::SAY, vec![v::text("{mug}")])),
            "/steps/0",
            "the name of an entry",
        ),
        (StepSketch::Call(CallSketch::new(v::SAY, vec![v::text("\u{7}")])), "/steps/0", "control character"),
    ];
    for (step, path, words) in cases {
        let refused = export(&graph(&[step]), &Leaves::default()).unwrap_err();
        assert_eq!(refused.len(), 1, "{refused:?}");
        assert_eq!((refused[0].path.as_str(), refused[0].what.contains(words)), (path, true), "{refused:?}");
    }
}

#[test]
fn export_reports_all_that_is_refused() {
    let go = || vec![StepSketch::go("table")];
    let steps = [StepSketch::Finally(go(), go()), StepSketch::Finally(go(), go())];
    let refused = export(&graph(&steps), &Leaves::default()).unwrap_err();
    assert_eq!(refused.iter().map(|part| part.path.as_str()).collect::<Vec<_>>(), ["/steps/0", "/steps/1"]);
}

#[test]
fn export_inverts_conditions_at_the_leaves() {
    let both = Condition::All(vec![holding("mug"), v::nearer("user", 0.5)]);
    let steps = [StepSketch::If(Condition::Not(Box::new(both)), vec![StepSketch::go("table")], None)];
    let tree = export(&graph(&steps), &Leaves::default()).unwrap();
    assert!(!tree.contains("<Inverter>"), "{tree}");
    for leaf in [
        "<is_holding arg_1=\"mug\" is=\"false\"/>",
        "<compare_distance arg_1=\"user\" is=\"at_least\" than=\"0.5\"/>",
    ] {
        assert!(tree.contains(leaf), "{tree}");
    }
}

#[test]
fn export_escapes_texts() {
    let say = StepSketch::Call(CallSketch::new(v::SAY, vec![v::text("a <\"b\"> & 'c'\nd")]));
    let tree = export(&graph(&[say]), &Leaves::default()).unwrap();
    assert!(tree.contains("text=\"a &lt;&quot;b&quot;&gt; &amp; 'c'&#10;d\""), "{tree}");
}
