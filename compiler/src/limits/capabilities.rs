//! Capabilities of the robot: its primitives, ranges and observations.

use motet_syntax::ast::Policy;
use motet_syntax::unit::{Dimension, Unit};
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use crate::declare::suggestion::{list, near};

use super::errors::{BeyondRange, NotObservable, NotProvided, OtherRobot, UnknownRobot};
use crate::declare::Library;
use crate::ir::{Base, Call, Condition, Step, StepKind, Term, Ty};

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
    let written = call.args.iter().zip(&call.spans).zip(&call.units);
    for (((arg, at), unit), param) in written.zip(&def.params) {
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
                    least: quantity(least, param.ty, *unit),
                    greatest: quantity(greatest, param.ty, *unit),
                    actual: quantity(value, param.ty, *unit),
                    degrees: degrees(value, (least, greatest), param.ty, *unit),
                }
                .into(),
            );
        }
    }
}

/// Formats a number in the unit in which it is written, or else in the SI unit of its type.
fn quantity(value: f64, ty: Ty, unit: Option<Unit>) -> String {
    let si = match ty.base {
        Base::Quantity(dimension) => Unit::si(dimension),
        _ => None,
    };
    unit.or(si).map_or_else(|| value.to_string(), |unit| unit.show(value))
}

/// Formats a bare number beyond a full turn as degrees, if the robot's range admits it.
fn degrees(value: f64, (least, greatest): (f64, f64), ty: Ty, unit: Option<Unit>) -> Option<String> {
    let is_bare = unit.is_none() && ty.base == Base::Quantity(Dimension::ANGLE);
    let meant = Unit::Degree.to_si(value);
    (is_bare && value.abs() > std::f64::consts::TAU && (least..=greatest).contains(&meant))
        .then(|| Unit::Degree.show(meant))
}

/// Reports fluents and measures that the robot cannot observe.
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

/// Checks that a policy is written for the robot of the library, or without one for a built-in robot.
pub(crate) fn check_robot_name(policy: &Policy, library: &Library) -> Option<Diagnostic> {
    let robot = policy.robot.as_ref()?;
    let (span, name) = (robot.span, robot.text.clone());
    if !library.robot.is_empty() {
        let given = library.robot.clone();
        return (name != given).then(|| OtherRobot { span, written: name, given }.into());
    }
    let known = || motet_robots::builtin::ROBOTS.iter().map(|robot| robot.name);
    let is_unknown = known().all(|known| name != known);
    is_unknown.then(|| {
        let (near, known) = (near(&name, known()), list(known().map(SmolStr::new_static)));
        UnknownRobot { span, name, near, known }.into()
    })
}
