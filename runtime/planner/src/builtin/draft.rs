//! The calls of a plan as a policy: a group for each aim, and monitors where a base that moves asks for them.

use motet_compiler::plan::{Persistence, Plan, PlannedStep};
use motet_requests::Aim;
use motet_robots::card::Robot;
use motet_syntax::ast::Expr;
use motet_syntax::{Syntax, print};

/// Distance in m below which a monitor pauses a moving base in front of a person. Smaller than the distance
/// of a handover, so that the robot can leave afterwards.
const CLEARANCE_M: f64 = 0.3;

/// The policy as text, not yet in its canonical layout.
pub(super) fn policy(name: &str, robot: Option<&Robot>, aims: &[Aim], plan: &Plan) -> String {
    let mut text = format!("policy {}", print::identifier(name));
    if let Some(robot) = robot {
        text.push_str(&format!(" for {}", print::identifier(&robot.name)));
    }
    let kept = aims
        .iter()
        .filter(|aim| aim.goal.persistence == Persistence::ToTheEnd)
        .map(|aim| &aim.goal.condition);
    let kept: Vec<String> = kept.map(part).collect();
    if !kept.is_empty() {
        text.push_str(&format!(" achieves {}", kept.join(" and ")));
    }
    text.push_str(" {\n");
    let is_grouped = aims.len() > 1 || aims.iter().any(|aim| aim.only_if.is_some());
    let mut open = None;
    for step in &plan.steps {
        if is_grouped && open != Some(step.goal) {
            text.push_str(close(open, aims));
            let name = aims.get(step.goal).map_or("put_right", |aim| aim.name.as_str());
            text.push_str(&format!("sequence {} {{\n", print::identifier(name)));
            if let Some(condition) = aims.get(step.goal).and_then(|aim| aim.only_if.as_ref()) {
                text.push_str(&format!("if {} {{\n", print::expression(condition)));
            }
            open = Some(step.goal);
        }
        text.push_str(&watched(step, robot));
        text.push('\n');
    }
    text.push_str(close(open, aims));
    text.push_str("}\n");
    text
}

/// Closing text of an aim's steps.
fn close(open: Option<usize>, aims: &[Aim]) -> &'static str {
    match open.map(|index| aims.get(index).is_some_and(|aim| aim.only_if.is_some())) {
        Some(true) => "}\n}\n",
        Some(false) => "}\n",
        None => "",
    }
}

/// A part of a conjunction, in parentheses where it needs them.
fn part(condition: &Expr) -> String {
    let text = print::expression(condition);
    if matches!(condition.kind, motet_syntax::ast::ExprKind::AnyOf(_)) { format!("({text})") } else { text }
}

/// A step, watched where the base moves to a person or with something in the hand, and the robot can
/// observe it.
fn watched(step: &PlannedStep, robot: Option<&Robot>) -> String {
    let call = print::call(&step.call, Syntax::Text);
    let observes = |name: &str| robot.is_some_and(|robot| robot.observes.iter().any(|known| known == name));
    let mut whens = Vec::new();
    if let Some(person) = step.approaches.as_ref().filter(|_| observes("distance")) {
        let person = print::identifier(person);
        whens.push(format!("when distance({person}) < {CLEARANCE_M} m for 200 ms then pause"));
    }
    if let Some(held) = step.carries.as_ref().filter(|_| observes("holding")) {
        let name = print::identifier(held);
        whens.push(format!("when not holding({name}) then replan \"lost {}\"", held.replace('"', "'")));
    }
    if whens.is_empty() {
        call
    } else {
        format!("monitor {{\n{}\n}} during {{\n{call}\n}}", whens.join("\n"))
    }
}
