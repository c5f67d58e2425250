//! Policies without contracts, in which everything that conditions speak of is known, and no two times are the same.

use motet_graph::arbitrary::vocabulary as v;
use motet_graph::arbitrary::{Call, React, Step, When, graph};
use motet_graph::{Condition, FactArg, Graph, NodeKind, Reaction, Term, Value, Verdict};

/// The same steps without contracts.
fn plain(steps: &[Step]) -> Vec<Step> {
    steps
        .iter()
        .map(|step| match step {
            Step::Call(call) if [v::GO, v::PICK, v::PLACE, v::SAY].contains(&call.primitive) => {
                Step::Call(Call { verdict: Verdict::Proven, ..call.clone() })
            }
            Step::Call(call) => Step::Call(Call::new(v::SAY, vec![v::text("seen")]).retry(call.retries)),
            Step::Sequence(steps) => Step::Sequence(plain(steps)),
            Step::Inline(steps) => Step::Inline(plain(steps)),
            Step::If(condition, then, other) => {
                Step::If(condition.clone(), plain(then), other.as_ref().map(|steps| plain(steps)))
            }
            Step::Wait(condition, within) => Step::Wait(condition.clone(), *within),
            Step::Monitor(whens, body) => Step::Monitor(whens.iter().map(reacting).collect(), plain(body)),
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

fn reacting(when: &When) -> When {
    let react = match &when.react {
        React::Resume(at_most, steps) => React::Resume(*at_most, plain(steps)),
        react @ (React::Pause(_) | React::Restart(_) | React::End(_)) => react.clone(),
    };
    When::new(when.condition.clone(), react)
}

/// Times of seconds, each another one: what is due at the same instant by chance would have no order in the document.
struct Times(u32);

impl Times {
    fn next(&mut self) -> f64 {
        self.0 += 1;
        f64::from(self.0 % 5) * 1.9 + 0.3 + f64::from(self.0) * 1e-6
    }
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
    let mut times = Times(0);
    for node in &mut graph.nodes {
        match &mut node.kind {
            NodeKind::Call(call) => {
                (call.needs, call.effects, call.unsettles) = (Vec::new(), Vec::new(), Vec::new());
                call.deadline_secs = times.next();
                for arg in &mut call.args {
                    if let Term::Binding(_) = arg {
                        *arg = v::entity("mug");
                    }
                }
            }
            NodeKind::Wait { condition: of, within_secs } => {
                condition(of);
                *within_secs = times.next();
            }
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
pub(super) fn elsewhere(step: &Step) -> Step {
    let all = |steps: &[Step]| steps.iter().map(elsewhere).collect::<Vec<_>>();
    match step {
        Step::Call(call) if call.primitive == v::GO => {
            Step::Call(Call { args: vec![v::entity("door")], ..call.clone() })
        }
        Step::Sequence(steps) => Step::Sequence(all(steps)),
        Step::Inline(steps) => Step::Inline(all(steps)),
        Step::If(condition, then, other) => {
            Step::If(condition.clone(), all(then), other.as_ref().map(|steps| all(steps)))
        }
        Step::Monitor(whens, body) => Step::Monitor(whens.clone(), all(body)),
        Step::Try(body, handlers) => Step::Try(all(body), handlers.clone()),
        Step::Repeat(times, steps, until) => Step::Repeat(*times, all(steps), until.clone()),
        Step::Each(list, most, steps) => Step::Each(list.clone(), *most, all(steps)),
        Step::Parallel(branches) => Step::Parallel(branches.iter().map(|steps| all(steps)).collect()),
        Step::Call(_) | Step::Wait(..) | Step::End(_) => step.clone(),
    }
}
