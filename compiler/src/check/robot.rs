//! What this very robot can do and observe.

use motet_syntax::{Diagnostic, Span};

use super::errors::{BeyondRange, NotObservable, NotProvided};
use crate::ir::{Base, Call, Condition, Step, StepKind, Term, Ty};
use crate::library::Library;

pub(super) fn check(steps: &[Step], library: &Library, diagnostics: &mut Vec<Diagnostic>) {
    for step in steps {
        match &step.kind {
            StepKind::Call(call) => self::call(call, step.span, library, diagnostics),
            StepKind::Wait { condition, .. } => observable(condition, step.span, library, diagnostics),
            StepKind::If { condition, span, .. } => observable(condition, *span, library, diagnostics),
            StepKind::Repeat { until: Some((condition, span)), .. } => {
                observable(condition, *span, library, diagnostics);
            }
            StepKind::Monitor { whens, .. } => {
                for when in whens {
                    observable(&when.condition, when.span, library, diagnostics);
                }
            }
            StepKind::Sequence { .. }
            | StepKind::Inline { .. }
            | StepKind::Try { .. }
            | StepKind::Repeat { until: None, .. }
            | StepKind::Each { .. }
            | StepKind::Parallel { .. }
            | StepKind::End { .. }
            | StepKind::Unknown => {}
        }
    }
}

fn call(call: &Call, span: Span, library: &Library, diagnostics: &mut Vec<Diagnostic>) {
    let Some(def) = library.primitive(call.primitive) else { return };
    if !def.provided {
        let (primitive, robot) = (def.name.clone(), library.robot.clone());
        diagnostics.push(NotProvided { span, primitive, robot }.into());
    }
    for ((arg, at), param) in call.args.iter().zip(&call.spans).zip(&def.params) {
        let value = match arg {
            Term::Number(value) => *value,
            Term::Int(value) => *value as f64,
            _ => continue,
        };
        let Some((least, greatest)) = param.range else { continue };
        if !(least..=greatest).contains(&value) {
            diagnostics.push(
                BeyondRange {
                    span: *at,
                    param: param.name.clone(),
                    callee: def.name.clone(),
                    robot: library.robot.clone(),
                    least: quantity(least, param.ty),
                    greatest: quantity(greatest, param.ty),
                    actual: quantity(value, param.ty),
                }
                .into(),
            );
        }
    }
}

/// A number with the SI unit of its type.
fn quantity(value: f64, ty: Ty) -> String {
    match ty.base {
        Base::Quantity(dimension) if !dimension.si_symbol().is_empty() => {
            format!("{value} {}", dimension.si_symbol())
        }
        _ => value.to_string(),
    }
}

/// A fluent that only effects can tell is no trouble in an `if`; one that nothing can tell is.
fn observable(condition: &Condition, span: Span, library: &Library, diagnostics: &mut Vec<Diagnostic>) {
    let mut say = |what: &smol_str::SmolStr| {
        diagnostics.push(NotObservable { span, what: what.clone(), robot: library.robot.clone() }.into());
    };
    match condition {
        Condition::Fact(fact) => {
            if let Some(def) = library.fluent(fact.fluent).filter(|def| !def.observable) {
                say(&def.name);
            }
        }
        Condition::Compare(_, left, right) => {
            for term in [left, right] {
                if let Term::Measure(id, _) = term
                    && let Some(def) = library.measure(*id).filter(|def| !def.observable)
                {
                    say(&def.name);
                }
            }
        }
        Condition::Not(inner) => observable(inner, span, library, diagnostics),
        Condition::All(parts) | Condition::AnyOf(parts) => {
            for part in parts {
                observable(part, span, library, diagnostics);
            }
        }
        Condition::Literal(_)
        | Condition::MonitoredMeasure(_)
        | Condition::MonitoredFluent(_)
        | Condition::Unknown => {}
    }
}
