//! Hints between the words of a document: which needs and motions are proven, and how long each step takes.

use std::collections::BTreeSet;

use motet_compiler::{MotionInspection, StepInspection};
use motet_syntax::{Parsed, Span};

use super::hover::time;
use crate::lines::LineIndex;

/// Hint behind a step.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Hint {
    /// Byte offset behind which it stands.
    pub(crate) offset: usize,
    pub(crate) label: String,
    pub(crate) tooltip: String,
}

/// Hints of a checked document, in the order of the steps.
pub(crate) fn hints(parsed: &Parsed, lines: &LineIndex, steps: &[StepInspection]) -> Vec<Hint> {
    let mut hints: Vec<Hint> = Vec::new();
    for policy in parsed.file.policies() {
        let body: BTreeSet<Span> = policy.body.steps.iter().map(|step| step.span).collect();
        let own = steps.iter().filter(|step| body.contains(&step.span));
        let total = own.fold((0.0, 0.0), |(least, greatest), step| {
            (least + step.least_secs, greatest + step.greatest_secs)
        });
        if total.1 > 0.0 {
            hints.push(Hint {
                offset: policy.name.span.end as usize,
                label: time(0.0, total.1).replace("0 s to ", "≤ "),
                tooltip: format!("The policy takes at most {}.", time(total.1, total.1)),
            });
        }
    }
    hints.extend(steps.iter().filter_map(|step| of_step(step, lines)));
    hints.sort_by_key(|hint| hint.offset);
    hints.dedup_by_key(|hint| hint.offset);
    hints
}

fn of_step(step: &StepInspection, lines: &LineIndex) -> Option<Hint> {
    let span = step.span.range();
    let duration = time(step.least_secs, step.greatest_secs);
    let takes = format!("Takes {duration}.");
    let Some(call) = &step.call else {
        // A step with blocks: at the end of its first line.
        let text = lines.text().get(span.clone())?;
        let (first, _) = text.split_once('\n')?;
        let offset = span.start + first.trim_end().len();
        return Some(Hint { offset, label: duration, tooltip: takes });
    };
    let mut remarks = Vec::new();
    let mark = match &call.motion {
        MotionInspection::Caught(why) => {
            remarks.push(format!("The motion is infeasible, and a handler catches that: {why}."));
            "✗ caught"
        }
        MotionInspection::Deferred(why) => {
            let why = why.as_ref().map_or_else(String::new, |why| format!(": {why}"));
            remarks.push(format!("The motion is left to the run{why}."));
            if call.guards.is_empty() { "? motion" } else { "? guard, motion" }
        }
        MotionInspection::Absent | MotionInspection::Feasible if !call.guards.is_empty() => "? guard",
        MotionInspection::Feasible => {
            remarks.push("The motion is feasible, with a path as witness.".to_owned());
            "✓"
        }
        MotionInspection::Absent => "✓",
    };
    if !call.guards.is_empty() {
        remarks.push(format!("Checked just before the step: {}.", call.guards.join(", ")));
    } else if call.needs > 0 {
        remarks.push(format!("All {} needs are proven.", call.needs));
    }
    remarks.push(takes);
    Some(Hint { offset: span.end, label: format!("{mark} {duration}"), tooltip: remarks.join("\n") })
}

#[cfg(test)]
mod tests {
    use motet_project::{DOCUMENT, Discard, Project};
    use motet_syntax::Source;

    use crate::lines::LineIndex;

    #[test]
    fn hints_say_what_is_proven_and_what_is_left() {
        let text = "policy p for hsr {
    go(kitchen_table)
    sequence s {
        pick(mug_1)
    }
    go(user)
}";
        let project = Project::builder().robot("hsr").scene("kitchen").without_motions();
        let project = project.open().unwrap().into_session(&mut Discard).unwrap();
        let parsed = motet_syntax::read(&Source::new("", text), DOCUMENT);
        let (_, steps) = project.session.inspect_document(&parsed);
        let hints = super::hints(&parsed, &LineIndex::new(text), &steps);
        let shown: Vec<_> = hints
            .iter()
            .map(|hint| {
                let before = text.get(..hint.offset).unwrap();
                format!("{}|{}", before.lines().last().unwrap().trim(), hint.label)
            })
            .collect();
        assert!(shown[0].starts_with("policy p|≤ "), "{shown:?}");
        assert!(shown.iter().any(|hint| hint.starts_with("go(kitchen_table)|? motion ")), "{shown:?}");
        assert!(shown.iter().any(|hint| hint.starts_with("sequence s {|")), "{shown:?}");
        assert!(shown.iter().any(|hint| hint.starts_with("pick(mug_1)|? guard, motion ")), "{shown:?}");
    }
}
