//! Policies without contracts and without time, in which everything that conditions speak of is known.

use motet_graph::arbitrary::vocabulary as v;
use motet_graph::arbitrary::{Call, React, Step, When, graph};
use motet_graph::{Condition, FactArg, Graph, NodeKind, Term, Value, Verdict};

const LONG: f64 = 1e6;

/// The same steps without contracts and without time.
fn plain(steps: &[Step]) -> Vec<Step> {
    steps
        .iter()
        .map(|step| match step {
            Step::Call(call) if [v::GO, v::PICK, v::PLACE, v::SAY].contains(&call.primitive) => {
                Step::Call(Call { deadline_secs: LONG, verdict: Verdict::Proven, ..call.clone() })
            }
            Step::Call(call) => Step::Call(Call::new(v::SAY, vec![v::text("seen")]).retry(call.retries)),
            Step::Sequence(steps) => Step::Sequence(plain(steps)),
            Step::Inline(steps) => Step::Inline(plain(steps)),
            Step::If(condition, then, other) => {
                Step::If(condition.clone(), plain(then), other.as_ref().map(|steps| plain(steps)))
            }
            Step::Wait(condition, _) => Step::Wait(condition.clone(), LONG),
            Step::Monitor(whens, body) => Step::Monitor(whens.iter().map(instant).collect(), plain(body)),
            Step::Try(body, handlers) => Step::Try(
                plain(body),
                handlers.iter().map(|(on, steps)| (on.clone(), plain(steps))).collect(),
            ),
            Step::Repeat(times, steps, until) => Step::Repeat(*times, plain(steps), until.clone()),
            Step::Each(_, most, steps) => Step::Repeat((*most).max(1), plain(steps), None),
            Step::Parallel(branches) => Step::Parallel(branches.iter().map(|steps| plain(steps)).collect()),
            Step::End(how) => Step::End(*how),
        })
        .collect()
}

fn instant(when: &When) -> When {
    let react = match &when.react {
        React::Pause(_) => React::Pause(LONG),
        React::Resume(at_most, steps) => React::Resume(*at_most, plain(steps)),
        react @ (React::Restart(_) | React::End(_)) => react.clone(),
    };
    When::new(when.condition.clone(), react)
}

/// A graph whose conditions speak of what is held, of which everything is known.
pub(super) fn known(steps: &[Step]) -> Graph {
    fn condition(of: &mut Condition) {
        let held = |object: &str| Condition::Fact(v::fact(v::HOLDING, vec![v::entity(object)]));
        match of {
            Condition::Literal(_) => {}
            Condition::Not(inner) => condition(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => parts.iter_mut().for_each(condition),
            Condition::Compare(..) => *of = held("bowl"),
            Condition::Fact(fact) => match fact.args.first() {
                Some(FactArg::Term(Term::Literal(Value::Entity(_)))) if fact.fluent == v::HOLDING => {}
                _ => *of = held("cup"),
            },
        }
    }
    let mut graph = graph(&plain(steps));
    for node in &mut graph.nodes {
        match &mut node.kind {
            NodeKind::Call(call) => {
                (call.needs, call.effects, call.unsettles) = (Vec::new(), Vec::new(), Vec::new());
                for arg in &mut call.args {
                    if let Term::Binding(_) = arg {
                        *arg = v::entity("mug");
                    }
                }
            }
            NodeKind::If { condition: of, .. }
            | NodeKind::Wait { condition: of, .. }
            | NodeKind::Repeat { until: Some(of), .. } => condition(of),
            NodeKind::Monitor { watches, .. } => {
                watches.iter_mut().for_each(|watch| condition(&mut watch.condition));
            }
            _ => {}
        }
    }
    graph
}
