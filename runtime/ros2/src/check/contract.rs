//! Steps of a binding against the declaration of their primitive: failures, names in messages, motions.

use crate::bind::{Binding, Step, StepKind};
use crate::template::{ValueName, names};
use motet_robots::card::Robot;
use motet_syntax::ast::{Clause, Param, PrimitiveDecl, TypeExpr};
use motet_syntax::suggest::{closest, one_of};
use motet_syntax::unit::{Dimension, Unit};

/// Failure in which every primitive may end.
const TIMEOUT: &str = "timeout";

/// Findings about the steps of a primitive, each with its place. `kinds` are those of entities.
pub(super) fn findings(
    binding: &Binding,
    declared: &PrimitiveDecl,
    card: &Robot,
    kinds: &[&str],
) -> Vec<String> {
    let name = declared.name.text.as_str();
    let lines = binding.lines.get(name).map_or(&[][..], Vec::as_slice);
    let steps = binding.steps(name).unwrap_or_default();
    let place = |at: usize| match lines.get(at) {
        Some(line) => format!("step {} in line {line}", at + 1),
        None => format!("step {}", at + 1),
    };
    let of_step = |(at, step): (usize, &Step)| -> Vec<String> {
        let found =
            of_failure(step, declared).into_iter().chain(of_step_kind(&step.kind, declared, card, kinds));
        found.map(|text| format!("{}: {text}", place(at))).collect()
    };
    steps.iter().enumerate().flat_map(of_step).collect()
}

/// Finding about the goals of the hand.
pub(super) fn of_gripper(binding: &Binding) -> Option<String> {
    let gripper = binding.gripper.as_ref()?;
    let goals = [Some(&gripper.open), Some(&gripper.close), gripper.width.as_ref()];
    let used: Vec<String> = goals.into_iter().flatten().flat_map(names).collect();
    used.iter().find_map(|text| {
        let ValueName { name, field, within } = ValueName::of(text);
        if name != "width" || field.is_some() {
            return Some(format!("`{{{text}}}` is no value of the hand: it has `{{width}}`"));
        }
        within.and_then(|unit| wrong_unit(unit, "Length"))
    })
}

fn of_failure(step: &Step, declared: &PrimitiveDecl) -> Option<String> {
    let kind = step.fails.as_deref().filter(|kind| *kind != TIMEOUT)?;
    let clauses = declared.clauses.iter().filter_map(|clause| match clause {
        Clause::Fails(kinds) => Some(kinds.iter().map(|kind| kind.text.as_str())),
        _ => None,
    });
    let known: Vec<&str> = clauses.flatten().collect();
    if known.contains(&kind) {
        return None;
    }
    let primitive = &declared.name.text;
    Some(match known.as_slice() {
        [] => format!("`fails = \"{kind}\"`, and `{primitive}` declares no failure"),
        known => format!("`fails = \"{kind}\"` is no failure of `{primitive}`: {}", meant(kind, known)),
    })
}

fn of_step_kind(kind: &StepKind, declared: &PrimitiveDecl, card: &Robot, kinds: &[&str]) -> Vec<String> {
    let primitive = &declared.name.text;
    let has_motion = declared.clauses.iter().any(|clause| matches!(clause, Clause::Motion(_)));
    let lacks = |param: &str| declared.params.iter().all(|own| own.name.text != param);
    match kind {
        StepKind::Motion(_) if !has_motion => vec![format!("`{primitive}` declares no motion")],
        StepKind::Posture(name) if card.postures.get(name.as_str()).is_none() => {
            let known: Vec<&str> = card.postures.keys().map(smol_str::SmolStr::as_str).collect();
            vec![format!("the robot has no posture `{name}`: {}", meant(name, &known))]
        }
        StepKind::Look | StepKind::Detect | StepKind::Search if declared.params.is_empty() => {
            vec![format!("`{primitive}` has no argument that says what to look for")]
        }
        StepKind::Search if lacks("around") => vec![format!("`{primitive}` has no argument `around`")],
        StepKind::Call(call) => {
            let used = names(&call.message);
            used.iter().filter_map(|text| of_value(text, declared, kinds)).collect()
        }
        StepKind::Motion(_)
        | StepKind::Posture(_)
        | StepKind::Go(_)
        | StepKind::Gripper(_)
        | StepKind::Wait(_) => Vec::new(),
        StepKind::Look
        | StepKind::Detect
        | StepKind::Search
        | StepKind::Require(_)
        | StepKind::Answer { .. } => Vec::new(),
    }
}

fn of_value(text: &str, declared: &PrimitiveDecl, kinds: &[&str]) -> Option<String> {
    let ValueName { name, field, within } = ValueName::of(text);
    let primitive = &declared.name.text;
    if name == "goal" && declared.params.iter().all(|param| param.name.text != "goal") {
        let has_motion = declared.clauses.iter().any(|clause| matches!(clause, Clause::Motion(_)));
        return (!has_motion).then(|| format!("`{{{text}}}`, and `{primitive}` declares no motion"));
    }
    let Some(param) = declared.params.iter().find(|param| param.name.text == name) else {
        let known: Vec<&str> = declared.params.iter().map(|param| param.name.text.as_str()).collect();
        return Some(match known.as_slice() {
            [] => format!("`{{{text}}}`, and `{primitive}` has no arguments"),
            known => format!("`{{{text}}}` is no argument of `{primitive}`: {}", meant(name, known)),
        });
    };
    of_param(text, param, (field, within), kinds)
}

fn of_param(
    text: &str,
    param: &Param,
    (field, within): (Option<&str>, Option<&str>),
    kinds: &[&str],
) -> Option<String> {
    let ty = match &param.ty {
        TypeExpr::Named(name) => name.text.as_str(),
        TypeExpr::List(..) => "List",
    };
    let is_pose = match field {
        None => ty == "Pose",
        Some("pose") if kinds.contains(&ty) => true,
        Some(field) => return Some(format!("`{{{text}}}`: `{}` has no `{field}`", param.name.text)),
    };
    let within = within.filter(|_| !is_pose)?;
    if Dimension::of_type(ty).is_some() || ty == "Number" {
        return wrong_unit(within, ty);
    }
    Some(format!("`{{{text}}}`: `{}` has neither a frame nor a unit", param.name.text))
}

/// Finding about a unit of a type.
fn wrong_unit(unit: &str, ty: &str) -> Option<String> {
    let dimension = Dimension::of_type(ty);
    let fits = |unit: Unit| dimension.is_none_or(|wanted| wanted == unit.dimension());
    if Unit::parse(unit).is_some_and(fits) {
        return None;
    }
    let known: Vec<&str> = Unit::ALL.iter().filter(|unit| fits(**unit)).map(|unit| unit.symbol()).collect();
    Some(format!("`{unit}` is no unit of {ty}: {}", one_of(known)))
}

fn meant(name: &str, known: &[&str]) -> String {
    match closest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => one_of(known.iter().copied()),
    }
}
