//! Random steps that a behaviour tree can say.

use motet_arbitrary::graph::vocabulary as v;
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, steps};
use motet_graph::{Comparison, Condition, Fact, FactArg, Term};
use proptest::collection::vec;
use proptest::prelude::*;

/// Use of the random steps.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// They are carried out by a peer, whose clock is not that of the engine: nothing waits for a time.
    Peer,
    /// They are read again: constants on the blackboard have no type there.
    RoundTrip,
}

/// Steps of several random policies, one after the other.
pub(crate) fn sayable(to: Use) -> impl Strategy<Value = Vec<StepSketch>> {
    vec(steps(), 1..4).prop_map(move |steps| group(&steps.concat(), to))
}

fn group(steps: &[StepSketch], to: Use) -> Vec<StepSketch> {
    steps.iter().map(|step| one(step, to)).collect()
}

fn one(step: &StepSketch, to: Use) -> StepSketch {
    let inside = |steps: &[StepSketch]| group(steps, to);
    match step {
        StepSketch::Call(sketch) => {
            let mut sketch = CallSketch { deadline_secs: 5000.0, manner: None, ..sketch.clone() };
            let is_template = sketch.args.iter().any(|arg| matches!(arg, Term::Template(_)));
            if is_template {
                sketch.args = vec![v::text("<\"tick\" & 'tock'>\n")];
            }
            StepSketch::Call(sketch)
        }
        StepSketch::Sequence(steps) => StepSketch::Sequence(inside(steps)),
        StepSketch::Inline(steps) if to == Use::Peer => StepSketch::Inline(inside(steps)),
        StepSketch::Inline(steps) => StepSketch::Sequence(inside(steps)),
        StepSketch::If(test, then, other) => {
            StepSketch::If(condition(test), inside(then), other.as_ref().map(|steps| inside(steps)))
        }
        StepSketch::Wait(test, _) if to == Use::RoundTrip => StepSketch::Wait(condition(test), 1.25),
        StepSketch::Delay(_) if to == Use::RoundTrip => StepSketch::Delay(0.75),
        StepSketch::Let(Term::Literal(_)) | StepSketch::Wait(..) | StepSketch::Delay(_) => say("so", to),
        StepSketch::Let(_) => say("let", to),
        StepSketch::Finally(body, cleanup) => StepSketch::Sequence([inside(body), inside(cleanup)].concat()),
        StepSketch::Monitor(watches, steps) => {
            let ends = watches.iter().find_map(|watch| match &watch.react {
                ReactionSketch::End(how) => Some((*how, watch)),
                _ => None,
            });
            let watch = match ends {
                // Known from the start, so that both fire at the same moment.
                Some((how, watch)) if !is_measured(&watch.condition) => {
                    WatchSketch::new(condition(&watch.condition), ReactionSketch::End(how))
                }
                _ => WatchSketch {
                    condition: Condition::Literal(true),
                    hold_secs: 500_000.0,
                    react: ReactionSketch::Pause(0.0),
                },
            };
            StepSketch::Monitor(vec![watch], inside(steps))
        }
        StepSketch::Try(body, handlers) => {
            let mut kept = Vec::new();
            for (on, steps) in handlers {
                let on = on.clone().filter(|on| !on.is_empty());
                let is_any = on.is_none();
                kept.push((on, inside(steps)));
                if is_any {
                    break;
                }
            }
            match kept.is_empty() {
                true => StepSketch::Sequence(inside(body)),
                false => StepSketch::Try(inside(body), kept),
            }
        }
        StepSketch::Repeat(times, steps, until) => {
            StepSketch::Repeat(*times, inside(steps), until.as_ref().map(condition))
        }
        StepSketch::Each(list, most, steps) => {
            let count = if let Term::List(items) = list { items.len() } else { 0 };
            let items = ["mug", "cup", "bowl"].iter().cycle().take(count).map(|id| v::entity(id)).collect();
            StepSketch::Each(Term::List(items), (*most).max(count as u32).max(1), inside(steps))
        }
        StepSketch::Parallel(branches) if branches.is_empty() => StepSketch::Sequence(Vec::new()),
        StepSketch::Parallel(branches) => {
            StepSketch::Parallel(branches.iter().map(|steps| inside(steps)).collect())
        }
        StepSketch::End(_) => step.clone(),
    }
}

/// A call with a deadline that does not pass.
fn say(text: &str, to: Use) -> StepSketch {
    one(&StepSketch::say(text), to)
}

/// The condition without what a tree does not know.
fn condition(test: &Condition) -> Condition {
    let all = |parts: &[Condition]| parts.iter().map(condition).collect();
    match test {
        Condition::Fact(Fact { fluent, args }) if *fluent == v::TRUSTED => {
            Condition::Fact(Fact { fluent: v::HOLDING, args: args.clone() })
        }
        // Between two constants the compiler decides it.
        Condition::Compare(Comparison::Equal, ..) => v::nearer("user", 0.5),
        Condition::Not(inner) => Condition::Not(Box::new(condition(inner))),
        Condition::All(parts) => Condition::All(all(parts)),
        Condition::AnyOf(parts) => Condition::AnyOf(all(parts)),
        Condition::Literal(_) | Condition::Fact(_) | Condition::Compare(..) => test.clone(),
    }
}

/// Checks if a condition has a measure or a field, or a binding, in it.
fn is_measured(test: &Condition) -> bool {
    let is_binding = |arg: &FactArg| matches!(arg, FactArg::Term(term) if *term == CallSketch::NEAREST);
    match test {
        Condition::Literal(_) => false,
        Condition::Fact(fact) => fact.args.iter().any(is_binding),
        Condition::Compare(..) => true,
        Condition::Not(inner) => is_measured(inner),
        Condition::All(parts) | Condition::AnyOf(parts) => parts.iter().any(is_measured),
    }
}
