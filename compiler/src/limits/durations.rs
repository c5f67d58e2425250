//! Least and greatest duration of steps. Every loop, wait, pause and retry is bounded, so every policy is.

use motet_syntax::Diagnostic;

use super::diagnostics::{EmptyBlock, TooLong};
use crate::declare::Library;
use crate::ir::{Block, Program, Reaction, StepKind};

type Bounds = (f64, f64);

/// Fills in the bounds of every step, and checks the whole policy against a limit in seconds.
pub(super) fn fill_in(
    program: &mut Program,
    library: &Library,
    limit: Option<f64>,
    diagnostics: &mut Vec<Diagnostic>,
) {
    fill_from(program, 0, library);
    program.steps.iter().rev().for_each(|step| empty(&step.kind, step.span, diagnostics));
    if program.body.is_empty() {
        diagnostics.push(EmptyBlock { span: program.span, what: "policy" }.into());
    }
    let (_, greatest) = of_block(&program.body, program);
    if let Some(limit) = limit.filter(|limit| greatest > *limit) {
        let (longest, limit) = (seconds(greatest), seconds(limit));
        diagnostics.push(TooLong { span: program.span, longest, limit }.into());
    }
}

/// Fills in the bounds of the steps from `first` on.
pub(crate) fn fill_from(program: &mut Program, first: usize, library: &Library) {
    // Children come after their parents, so backwards every block is known before the step that holds it.
    for index in (first..program.steps.len()).rev() {
        let Some(step) = program.steps.get(index) else { continue };
        let bounds = of_step(&step.kind, program, library);
        if let Some(step) = program.steps.get_mut(index) {
            step.bounds = bounds;
        }
    }
}

/// Bounds of a block, whose steps run one after the other.
pub(crate) fn of_block(block: &Block, program: &Program) -> Bounds {
    let mut sum = (0.0, 0.0);
    let mut ended = false;
    for step in block.iter().filter_map(|id| program.step(*id)) {
        if !ended {
            sum.0 += step.bounds.0;
        }
        sum.1 += step.bounds.1;
        // What may end early takes no longer, but may take less.
        ended |= matches!(step.kind, StepKind::End { .. });
    }
    finite(sum)
}

fn of_step(kind: &StepKind, program: &Program, library: &Library) -> Bounds {
    let observe = library.observe_within_secs;
    let block = |block: &Block| of_block(block, program);
    let bounds = match kind {
        StepKind::Call(call) => {
            let takes = library.primitive(call.primitive).map_or((0.0, 0.0), |def| def.takes);
            let deadline = call.deadline_secs(takes);
            // Guards are observed before each attempt.
            (takes.0.min(deadline), (deadline + observe) * f64::from(call.retries.saturating_add(1)))
        }
        StepKind::Sequence { body, .. } | StepKind::Inline { body, .. } => block(body),
        StepKind::If { then, otherwise, .. } => {
            let then = block(then);
            let otherwise = otherwise.as_ref().map_or((0.0, 0.0), block);
            (then.0.min(otherwise.0), then.1.max(otherwise.1) + observe)
        }
        // What it asks for is observed first.
        StepKind::Let { value, .. } => (0.0, if value.is_constant() { 0.0 } else { observe }),
        StepKind::Wait { within_secs, .. } => (0.0, *within_secs),
        StepKind::Delay { secs } => (*secs, *secs),
        StepKind::Finally { body, cleanup } => {
            let body = block(body);
            (body.0, body.1 + block(cleanup).1)
        }
        StepKind::Monitor { whens, body } => {
            if let Some(deadline) = kind.deadline() {
                // What the deadline interrupts is cleaned up behind it.
                let (least, greatest) = block(body);
                let last = deadline + cleanups(body, program);
                return finite((least.min(deadline), greatest.min(last)));
            }
            let body = block(body);
            let mut greatest = body.1;
            for when in whens {
                greatest += match &when.reaction {
                    Reaction::Pause { within_secs } => *within_secs,
                    Reaction::Restart { at_most } => f64::from(*at_most) * body.1,
                    Reaction::Resume { at_most, body } => f64::from(*at_most) * block(body).1,
                    Reaction::Timeout | Reaction::End { .. } => 0.0,
                };
            }
            (0.0, greatest)
        }
        StepKind::Try { body, catches } => {
            let handlers = catches.iter().map(|catch| block(&catch.body).1);
            (0.0, block(body).1 + handlers.fold(0.0, f64::max))
        }
        StepKind::Repeat { times, body, until } => {
            let (least, greatest) = block(body);
            let rounds = f64::from(*times);
            let test = if until.is_some() { observe } else { 0.0 };
            (if until.is_some() { least } else { least * rounds }, (greatest + test) * rounds)
        }
        StepKind::Each { at_most, body, .. } => (0.0, block(body).1 * f64::from(*at_most)),
        StepKind::Parallel { branches } => branches
            .iter()
            .map(block)
            .fold((0.0, 0.0), |longest: Bounds, branch| (longest.0.max(branch.0), longest.1.max(branch.1))),
        StepKind::End { .. } | StepKind::Unknown => (0.0, 0.0),
    };
    finite(bounds)
}

/// Longest time that the cleanups in a block take if it is interrupted. The nesting of policies bounds the
/// recursion.
fn cleanups(block: &Block, program: &Program) -> f64 {
    let of_step = |kind: &StepKind| {
        let inner = kind.blocks();
        let inner = inner.iter().map(|block| cleanups(block, program));
        match kind {
            StepKind::Finally { body, cleanup } => cleanups(body, program) + of_block(cleanup, program).1,
            // The body waits while a reaction runs.
            StepKind::Monitor { .. } => inner.sum(),
            _ => inner.fold(0.0, f64::max),
        }
    };
    block.iter().filter_map(|id| program.step(*id)).map(|step| of_step(&step.kind)).fold(0.0, f64::max)
}

/// Replaces infinite bounds by the largest number: nested loops can exceed any.
fn finite((least, greatest): Bounds) -> Bounds {
    (least.min(f64::MAX), greatest.min(f64::MAX))
}

/// Reports the blocks of a step that have no steps of their own. An empty handler ignores a failure, and an
/// empty `else` is none.
fn empty(kind: &StepKind, span: motet_syntax::Span, diagnostics: &mut Vec<Diagnostic>) {
    let (what, body) = match kind {
        StepKind::Sequence { body, .. } => ("`sequence`", body),
        StepKind::If { then, .. } => ("`if`", then),
        StepKind::Repeat { body, .. } => ("`repeat`", body),
        StepKind::Each { body, .. } => ("`each`", body),
        StepKind::Monitor { body, .. } if kind.deadline().is_some() => ("`within`", body),
        StepKind::Monitor { body, whens } => {
            for when in whens {
                if matches!(&when.reaction, Reaction::Resume { body, .. } if body.is_empty()) {
                    diagnostics.push(EmptyBlock { span: when.span, what: "`resume`" }.into());
                }
            }
            ("`monitor`", body)
        }
        StepKind::Try { body, .. } => ("`try`", body),
        StepKind::Finally { body, .. } if body.is_empty() => ("block before a `finally`", body),
        StepKind::Finally { cleanup, .. } => ("`finally`", cleanup),
        StepKind::Parallel { branches } => {
            let what = if branches.is_empty() { "`parallel`" } else { "branch of a `parallel`" };
            if branches.is_empty() || branches.iter().any(Vec::is_empty) {
                diagnostics.push(EmptyBlock { span, what }.into());
            }
            return;
        }
        StepKind::Call(_)
        | StepKind::Let { .. }
        | StepKind::Inline { .. }
        | StepKind::Wait { .. }
        | StepKind::Delay { .. }
        | StepKind::End { .. }
        | StepKind::Unknown => return,
    };
    if body.is_empty() {
        diagnostics.push(EmptyBlock { span, what }.into());
    }
}

fn seconds(value: f64) -> String {
    if value >= 120.0 { format!("{:.1} min", value / 60.0) } else { format!("{value} s") }
}
