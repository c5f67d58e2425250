//! Policies without contracts, in which everything that conditions speak of is known, and no two times are
//! the same.

use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, graph, vocabulary as v};
use motet_graph::{Condition, FactArg, Graph, NodeKind, Reaction, Term, Value, Verdict};

/// The same steps without contracts.
fn plain(steps: &[StepSketch]) -> Vec<StepSketch> {
    steps
        .iter()
        .map(|step| match step {
            StepSketch::Call(call) if [v::GO, v::PICK, v::PLACE, v::SAY].contains(&call.primitive) => {
                StepSketch::Call(CallSketch { verdict: Verdict::Proven, ..call.clone() })
            }
            StepSketch::Call(call) => {
                StepSketch::Call(CallSketch::new(v::SAY, vec![v::text("seen")]).retry(call.retries))
            }
            StepSketch::Sequence(steps) => StepSketch::Sequence(plain(steps)),
            StepSketch::Inline(steps) => StepSketch::Inline(plain(steps)),
            StepSketch::If(condition, then, other) => {
                StepSketch::If(condition.clone(), plain(then), other.as_ref().map(|steps| plain(steps)))
            }
            StepSketch::Wait(condition, within) => StepSketch::Wait(condition.clone(), *within),
            StepSketch::Delay(secs) => StepSketch::Delay(*secs),
            StepSketch::Finally(body, cleanup) => StepSketch::Finally(plain(body), plain(cleanup)),
            StepSketch::Monitor(whens, body) => {
                StepSketch::Monitor(whens.iter().map(reacting).collect(), plain(body))
            }
            StepSketch::Try(body, handlers) => StepSketch::Try(
                plain(body),
                handlers.iter().map(|(on, steps)| (on.clone(), plain(steps))).collect(),
            ),
            StepSketch::Repeat(times, steps, until) => {
                StepSketch::Repeat(*times, plain(steps), until.clone())
            }
            StepSketch::Each(_, most, steps) => StepSketch::Repeat((*most).max(1), plain(steps), None),
            StepSketch::Parallel(branches) => {
                StepSketch::Parallel(branches.iter().map(|steps| plain(steps)).collect())
            }
            StepSketch::Let(_) => StepSketch::Sequence(Vec::new()),
            StepSketch::End(how) => StepSketch::End(*how),
        })
        .collect()
}

fn reacting(when: &WatchSketch) -> WatchSketch {
    let react = match &when.react {
        ReactionSketch::Resume(at_most, steps) => ReactionSketch::Resume(*at_most, plain(steps)),
        react @ (ReactionSketch::Pause(_) | ReactionSketch::Restart(_) | ReactionSketch::End(_)) => {
            react.clone()
        }
    };
    WatchSketch::new(when.condition.clone(), react)
}

/// Times of seconds, each another one: what is due at the same instant by chance would have no order in the
/// document.
struct Times(u32);

impl Times {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        f64::from(self.0 % 5) * 1.9 + 0.3 + f64::from(self.0) * 1e-6
    }
}

/// A graph whose conditions speak of what is held, of which everything is known.
pub(super) fn known(steps: &[StepSketch]) -> Graph {
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
    let mut times = Times(0);
    for node in &mut graph.nodes {
        match &mut node.kind {
            NodeKind::Call(call) => {
                (call.needs, call.effects, call.unsettles) = (Vec::new(), Vec::new(), Vec::new());
                call.deadline_secs = times.next();
                for arg in &mut call.args {
                    match arg {
                        Term::Binding(_) => *arg = v::entity("mug"),
                        Term::Template(_) => *arg = v::text("mug"),
                        _ => {}
                    }
                }
            }
            NodeKind::Wait { condition: of, within_secs } => {
                condition(of);
                *within_secs = times.next();
            }
            NodeKind::Delay { secs } => *secs = times.next(),
            NodeKind::If { condition: of, .. } | NodeKind::Repeat { until: Some(of), .. } => condition(of),
            NodeKind::Monitor { watches, .. } => {
                for watch in watches {
                    condition(&mut watch.condition);
                    // Half of them fire at once.
                    let hold = times.next();
                    watch.hold_secs = if times.0.is_multiple_of(2) { 0.0 } else { hold };
                    if let Reaction::Pause { within_secs } = &mut watch.reaction {
                        *within_secs = times.next();
                    }
                }
            }
            _ => {}
        }
    }
    graph
}

/// The same step with another place wherever the robot goes.
pub(super) fn elsewhere(step: &StepSketch) -> StepSketch {
    let all = |steps: &[StepSketch]| steps.iter().map(elsewhere).collect::<Vec<_>>();
    match step {
        StepSketch::Call(call) if call.primitive == v::GO => {
            StepSketch::Call(CallSketch { args: vec![v::entity("door")], ..call.clone() })
        }
        StepSketch::Sequence(steps) => StepSketch::Sequence(all(steps)),
        StepSketch::Inline(steps) => StepSketch::Inline(all(steps)),
        StepSketch::If(condition, then, other) => {
            StepSketch::If(condition.clone(), all(then), other.as_ref().map(|steps| all(steps)))
        }
        StepSketch::Monitor(whens, body) => StepSketch::Monitor(whens.clone(), all(body)),
        StepSketch::Finally(body, cleanup) => StepSketch::Finally(all(body), all(cleanup)),
        StepSketch::Try(body, handlers) => StepSketch::Try(all(body), handlers.clone()),
        StepSketch::Repeat(times, steps, until) => StepSketch::Repeat(*times, all(steps), until.clone()),
        StepSketch::Each(list, most, steps) => StepSketch::Each(list.clone(), *most, all(steps)),
        StepSketch::Parallel(branches) => {
            StepSketch::Parallel(branches.iter().map(|steps| all(steps)).collect())
        }
        StepSketch::Call(_)
        | StepSketch::Let(_)
        | StepSketch::Wait(..)
        | StepSketch::Delay(_)
        | StepSketch::End(_) => step.clone(),
    }
}
