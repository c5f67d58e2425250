//! Capabilities of the robot: its primitives, ranges and observations.

use motet_syntax::ast::{EndKind, MAX_MISTAKES, Policy, PrimitiveKind};
use motet_syntax::unit::{Dimension, Unit};
use motet_syntax::{Diagnostic, Span};
use rustc_hash::FxHashSet;
use smol_str::SmolStr;

use super::diagnostics::{
    Ambiguous, BeyondRange, EndsCleanup, Missing, NotObservable, NotProvided, OtherRobot, ResourceConflict,
    UnknownRobot, Unused,
};
use crate::declare::name::{list, near};
use crate::declare::{Library, ResourceSet};
use crate::environment::Environment;
use crate::ir::{
    Base, Block, BlockSlot, Call, Condition, Failure, Program, Reaction, Step, StepId, StepKind, Term, Ty,
};

pub(super) fn check(steps: &[Step], library: &Library, diagnostics: &mut Vec<Diagnostic>) {
    for step in steps {
        match &step.kind {
            StepKind::Call(call) => self::call(call, step.span, library, diagnostics),
            StepKind::Let { value, .. } => observed(value, step.span, library, diagnostics),
            StepKind::End { why, .. } => {
                why.iter().for_each(|why| observed(why, step.span, library, diagnostics));
            }
            StepKind::Wait { condition, .. } => observable(condition, step.span, library, diagnostics),
            StepKind::If { condition, span, .. } => observable(condition, *span, library, diagnostics),
            StepKind::Repeat { until: Some((condition, span)), .. } => {
                observable(condition, *span, library, diagnostics);
            }
            StepKind::Monitor { whens, .. } => {
                for when in whens {
                    observable(&when.condition, when.span, library, diagnostics);
                    if let Reaction::End { why: Some(why), .. } = &when.reaction {
                        observed(why, when.span, library, diagnostics);
                    }
                }
            }
            _ => {}
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
        observed(arg, *at, library, diagnostics);
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
    match condition {
        Condition::Fact(fact) => {
            if let Some(def) = library.fluent(fact.fluent).filter(|def| !def.observable) {
                let (what, robot) = (def.name.clone(), library.robot.clone());
                diagnostics.push(NotObservable { span, what, robot }.into());
            }
        }
        Condition::Compare(_, left, right) => {
            for term in [left, right] {
                observed(term, span, library, diagnostics);
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

/// Reports measures in a term that the robot cannot observe.
fn observed(term: &Term, span: Span, library: &Library, diagnostics: &mut Vec<Diagnostic>) {
    let mut measures = Vec::new();
    term.measures(&mut measures);
    for def in measures.into_iter().filter_map(|id| library.measure(id)).filter(|def| !def.observable) {
        let (what, robot) = (def.name.clone(), library.robot.clone());
        diagnostics.push(NotObservable { span, what, robot }.into());
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

/// Checks that no cleanup from step `first` on is left by an ending of its own.
pub(super) fn check_cleanups(program: &Program, first: usize, diagnostics: &mut Vec<Diagnostic>) {
    for (index, step) in program.steps.iter().enumerate().skip(first) {
        let Ok(id) = u32::try_from(index).map(StepId) else { return };
        for (kind, of) in step.kind.endings() {
            let (ending, of) = match kind {
                EndKind::Done => ("done", of),
                EndKind::Fail => ("fail", of),
                // These end the whole policy, wherever they stand.
                EndKind::Cannot => ("cannot", None),
                EndKind::Replan => ("replan", None),
            };
            if program.leaves_cleanup(id, of) {
                diagnostics.push(EndsCleanup { span: step.span, ending }.into());
            }
        }
    }
}

pub(super) fn check_descriptions(
    program: &Program,
    library: &Library,
    environment: &Environment,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let items: FxHashSet<usize> = program
        .steps
        .iter()
        .filter_map(
            |step| if let StepKind::Each { item, .. } = &step.kind { Some(item.index()) } else { None },
        )
        .collect();
    // So many of each are told.
    let mut told = 0;
    for (index, binding) in program.bindings.iter().enumerate() {
        if told == MAX_MISTAKES {
            break;
        }
        for span in binding.unused().filter(|_| !binding.name.starts_with('_')) {
            told += 1;
            let of_each = items.contains(&index);
            diagnostics.push(Unused { span, name: binding.name.clone(), of_each }.into());
        }
    }
    if !environment.has_scene() {
        return;
    }
    let first = diagnostics.len();
    for step in &program.steps {
        if diagnostics.len() - first == MAX_MISTAKES {
            break;
        }
        let StepKind::Call(call) = &step.kind else { continue };
        let def = library.primitive(call.primitive);
        let Some(def) = def.filter(|def| def.form == PrimitiveKind::Perception) else { continue };
        let (Some(text), Some(kind)) = (call.text(), def.result.and_then(Ty::kind)) else { continue };
        let callee = def.name.clone();
        let items = &library.lang_items;
        match environment.described(library, text, kind).as_slice() {
            [_] => {}
            [] if is_caught(program, step, items.not_found) => {}
            [_, _, ..] if is_caught(program, step, items.ambiguous) => {}
            [] => {
                let fitting =
                    environment.entities().iter().filter(|(.., other)| library.is_kind(*other, kind));
                let near = near(text, fitting.map(|(_, name, _)| name.as_str()));
                diagnostics.push(Missing { span: step.span, callee, text: text.clone(), near }.into());
            }
            several => {
                let found = list(several.iter().take(5).map(|entity| environment.name(*entity)));
                diagnostics.push(Ambiguous { span: step.span, callee, text: text.clone(), found }.into());
            }
        }
    }
}

/// Returns whether a handler around a step catches a failure by its name.
fn is_caught(program: &Program, step: &Step, failure: Option<Failure>) -> bool {
    let mut at = step.position;
    while let Some(around) = at.parent.and_then(|id| program.step(id)) {
        if let (BlockSlot::Try, StepKind::Try { catches, .. }) = (at.slot, &around.kind) {
            let mut named = catches.iter().flat_map(|catch| catch.on.iter().flatten());
            if named.any(|(kind, _)| Some(*kind) == failure) {
                return true;
            }
        }
        at = around.position;
    }
    false
}

/// First user of each set of resources in a block.
type Uses = Vec<(ResourceSet, SmolStr, Span)>;

/// Checks the steps from `first` on.
pub(super) fn check_resources(
    program: &Program,
    first: usize,
    library: &Library,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for step in program.steps.iter().skip(first) {
        let StepKind::Parallel { branches } = &step.kind else { continue };
        let mut earlier: Uses = Vec::new();
        for branch in branches {
            let mut uses = Uses::new();
            collect(branch, program, library, &mut uses);
            for (set, name, span) in &uses {
                let clash = earlier.iter().find(|(other, ..)| other & set != 0);
                if let Some((other, one, first)) = clash {
                    let shared = (other & set).trailing_zeros() as usize;
                    let resource =
                        library.resources.get(shared).map(|def| def.name.clone()).unwrap_or_default();
                    let (one, other) = (one.clone(), name.clone());
                    diagnostics
                        .push(ResourceConflict { span: *span, resource, one, other, first: *first }.into());
                    break;
                }
            }
            earlier.extend(uses);
        }
    }
}

/// Collects the resources of the steps of a block, each set once. The nesting of policies bounds the
/// recursion.
fn collect(block: &Block, program: &Program, library: &Library, uses: &mut Uses) {
    for step in block.iter().filter_map(|id| program.step(*id)) {
        match &step.kind {
            StepKind::Call(call) => {
                let Some(def) = library.primitive(call.primitive).filter(|def| def.uses != 0) else {
                    continue;
                };
                if !uses.iter().any(|(set, ..)| set & def.uses == def.uses) {
                    uses.push((def.uses, def.name.clone(), step.span));
                }
            }
            kind => kind.blocks().into_iter().for_each(|block| collect(block, program, library, uses)),
        }
    }
}
