//! Plans: an `(action argument …)` a line, perhaps behind a time `0:` or `0.000:` and before a duration
//! `[1]`.

use motet_syntax::{Diagnostic, Source, Span};
use smol_str::SmolStr;

use crate::PddlSource;
use crate::diagnostics::{WrongName, unknown};
use crate::domain::{Domain, Problem};
use crate::s_expression::{self, SExpr};

/// A step of a plan.
#[derive(Clone, Debug)]
pub(crate) struct PlanStep {
    pub(crate) action: SmolStr,
    pub(crate) args: Vec<(SmolStr, Span)>,
    pub(crate) span: Span,
}

/// Reads a plan. Whether its steps can be done is the prover's affair; that they exist is diagnostics here.
pub(crate) fn read(
    input: PddlSource<'_>,
    domain: Option<&Domain>,
    problem: Option<&Problem>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<PlanStep> {
    let text = without_times(&input.source.text);
    let bare = Source::new(input.source.name.clone(), text);
    let trees =
        s_expression::read_all(PddlSource { source: &bare, ..input }, diagnostics).unwrap_or_default();
    let (Some(domain), Some(problem)) = (domain, problem) else { return Vec::new() };
    trees.iter().filter_map(|tree| step(tree, domain, problem, diagnostics)).collect()
}

/// Times and durations blanked out, so that offsets stay.
fn without_times(text: &str) -> String {
    let blank = |text: &str| " ".repeat(text.len());
    text.split_inclusive('\n')
        .map(|line| {
            let (code, comment) = line.split_at(line.find(';').unwrap_or(line.len()));
            let (start, end) = (code.find('('), code.rfind(')'));
            let (Some(start), Some(end)) = (start, end.map(|end| end + 1)) else { return line.to_owned() };
            let (Some(before), Some(step), Some(after)) =
                (code.get(..start), code.get(start..end), code.get(end..))
            else {
                return line.to_owned();
            };
            let is_time =
                before.trim().strip_suffix(':').is_some_and(|time| time.trim().parse::<f64>().is_ok());
            let is_duration = after.trim().starts_with('[') && after.trim().ends_with(']');
            let before = if is_time { blank(before) } else { before.to_owned() };
            let after = if is_duration { after.trim_end().len() } else { 0 };
            let tail = code.get(end + after..).unwrap_or_default();
            format!("{before}{step}{}{tail}{comment}", " ".repeat(after))
        })
        .collect()
}

fn step(
    tree: &SExpr,
    domain: &Domain,
    problem: &Problem,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<PlanStep> {
    let Some((name, parts)) = tree.form() else {
        diagnostics.push(tree.not("a step `(action argument …)`").into());
        return None;
    };
    let Some(action) = domain.actions.get(name) else {
        diagnostics
            .push(unknown(tree.span, "action", name, domain.actions.keys().map(SmolStr::as_str)).into());
        return None;
    };
    let mut args = Vec::with_capacity(parts.len());
    for part in parts {
        let Some(word) = part.word() else {
            diagnostics.push(part.not("an object").into());
            return None;
        };
        if !problem.objects.contains_key(word) {
            let known = problem.objects.keys().map(SmolStr::as_str);
            diagnostics.push(unknown(part.span, "object", word, known).into());
        }
        args.push((word.clone(), part.span));
    }
    if args.len() != action.params.len() {
        let what = format!("`{name}` takes {} arguments, and here are {}", action.params.len(), args.len());
        diagnostics.push(WrongName { span: tree.span, what, help: None }.into());
    }
    Some(PlanStep { action: name.clone(), args, span: tree.span })
}
