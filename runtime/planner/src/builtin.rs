//! The built-in planner, which needs no model. The compiler checks every policy before the planner returns
//! it.

use motet_compiler::Session;
use motet_compiler::plan::{Goal, NoPlan, PLAN_BUDGET, Persistence, Plan, PlannedStep};
use motet_requests::{Aim, RequestContext, RequestError};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_stdlib::lang::{fluents, measures, primitives};
use motet_syntax::ast::{Expr, ExprKind};
use motet_syntax::{FileId, Source, Syntax, print};

use crate::named_step;
pub use crate::planned::{PlanError, Planned, PlannedRequest};
use crate::reply_verdict::{ReplyVerdict, judge};

/// Factor on the state budget of a second search, after the first one used up its budget.
const LAST_RESORT: usize = 6;

/// Plans for aims, one after the other, and checks the policy. The same session and aims give the same
/// policy.
///
/// # Errors
///
/// The reason why there is no policy.
pub fn plan(
    session: &Session,
    robot: Option<&Robot>,
    name: &str,
    aims: &[Aim],
) -> Result<Planned, PlanError> {
    let goals: Vec<Goal> = aims.iter().map(|aim| aim.goal.clone()).collect();
    // What is waited for will be so.
    let awaited = aims.iter().filter_map(|aim| aim.awaits.as_ref());
    let supposed = awaited.fold(session.clone(), |session, condition| session.supposing(condition));
    let plan = match supposed.plan(&goals, PLAN_BUDGET) {
        Err(NoPlan::Budget { .. }) => supposed.plan(&goals, PLAN_BUDGET * LAST_RESORT)?,
        found => found?,
    };
    if let Some(named) =
        aims.iter().filter_map(|aim| aim.named_step.as_ref()).find(|named| !named_step::has(named, session))
    {
        return Err(RequestError::Unfit { why: format!("I cannot {}", named_step::words(named)) }.into());
    }
    let text = policy(name, robot, aims, &plan, session.scene());
    let parsed = motet_syntax::read(&Source::new("plan.motet", text), FileId(0));
    let text = motet_syntax::print::text(&parsed.file);
    let parsed = motet_syntax::read(&Source::new("plan.motet", text.as_str()), FileId(0));
    let compiled = session.compile(&parsed, None);
    if compiled.graph.is_some() {
        return Ok(Planned { text, parsed, compiled, looked_at: plan.expanded_states }.with_time(session));
    }
    // A step that is asked for by its name has needs that no goal says.
    if aims.iter().any(|aim| aim.named_step.is_some() || aim.awaits.is_some())
        && let ReplyVerdict::Good { planned, .. } = judge(session, &text)
    {
        return Ok(*planned);
    }
    Err(PlanError::Refused { text, diagnostics: compiled.diagnostics })
}

/// Reads a request in English and plans for it.
///
/// # Errors
///
/// The part of the request that is not understood, or the reason why there is no plan.
pub fn answer(
    session: &Session,
    robot: Option<&Robot>,
    request: &str,
    situation: &RequestContext<'_>,
) -> Result<PlannedRequest, PlanError> {
    let understood = motet_requests::understand(request, situation)?;
    if understood.aims.is_empty() {
        let question = "I take note of that. What shall I do?".to_owned();
        return Err(RequestError::AmbiguousTask { question, options: Vec::new() }.into());
    }
    let name = understood.aims.first().map_or("plan", |aim| aim.name.as_str());
    let planned = plan(session, robot, name, &understood.aims)?;
    Ok(PlannedRequest { understood, planned })
}

/// Longest time in min for which the robot waits until something happens.
const PATIENCE_MIN: u32 = 30;
/// Distance in m below which a monitor pauses a moving base in front of a person. Smaller than the distance
/// of a handover, so that the robot can leave afterwards.
const CLEARANCE_M: f64 = 0.3;

/// The policy as text, not yet in its canonical layout.
pub(super) fn policy(
    name: &str,
    robot: Option<&Robot>,
    aims: &[Aim],
    plan: &Plan,
    scene: Option<&Scene>,
) -> String {
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
    let head = text.len();
    let is_grouped = aims.len() > 1 || aims.iter().any(|aim| aim.only_if.is_some());
    for index in 0..=aims.len() {
        let aim = aims.get(index);
        let steps: Vec<String> =
            plan.steps.iter().filter(|step| step.goal == index).map(|step| watched(step, robot)).collect();
        let named =
            aim.and_then(|aim| aim.named_step.as_ref()).map(|named| named_step::steps(named, robot, scene));
        let awaits = aim.and_then(|aim| aim.awaits.as_ref());
        if steps.is_empty() && named.is_none() && awaits.is_none() {
            continue;
        }
        if is_grouped {
            let head = match aim {
                Some(aim) => format!("sequence {}", print::identifier(&aim.name)),
                // What was opened for a look is closed after a look in vain, too.
                None if ends_with_look(aims, plan) => "finally".to_owned(),
                None => "sequence put_right".to_owned(),
            };
            text.push_str(&format!("{head} {{\n"));
        }
        let only_if = aim.and_then(|aim| aim.only_if.as_ref()).filter(|_| is_grouped);
        if let Some(condition) = only_if {
            text.push_str(&format!("if {} {{\n", print::expression(condition)));
        }
        if let Some(condition) = awaits {
            let condition = print::expression(condition);
            text.push_str(&format!("wait until {condition} within {PATIENCE_MIN} min\n"));
        }
        for step in steps.iter().chain(&named) {
            text.push_str(step);
            text.push('\n');
        }
        text.push_str(if only_if.is_some() { "}\n" } else { "" });
        text.push_str(if is_grouped { "}\n" } else { "" });
    }
    // All of it holds already.
    text.push_str(if text.len() == head { "done\n}\n" } else { "}\n" });
    text
}

/// True if the last aim of a plan ends with a look.
fn ends_with_look(aims: &[Aim], plan: &Plan) -> bool {
    let last = plan.steps.iter().rfind(|step| step.goal + 1 == aims.len());
    last.is_some_and(|step| step.call.call.name.text == primitives::INSPECT)
}

/// Part of a conjunction, in parentheses if necessary.
fn part(condition: &Expr) -> String {
    let text = print::expression(condition);
    if matches!(condition.kind, ExprKind::AnyOf(_)) { format!("({text})") } else { text }
}

/// A step, with a monitor around it if the base moves to a person or with an object in the hand, and the
/// robot can observe the condition.
fn watched(step: &PlannedStep, robot: Option<&Robot>) -> String {
    let call = print::call(&step.call, Syntax::Text);
    let observes = |name: &str| robot.is_some_and(|robot| robot.observes.iter().any(|known| known == name));
    let mut whens = Vec::new();
    if let Some(person) = step.approaches.as_ref().filter(|_| observes(measures::DISTANCE)) {
        let person = print::identifier(person);
        whens.push(format!("when distance({person}) < {CLEARANCE_M} m for 200 ms then pause"));
    }
    if let Some(held) = step.carries.as_ref().filter(|_| observes(fluents::HOLDING)) {
        let name = print::identifier(held);
        whens.push(format!("when not holding({name}) then replan \"lost {}\"", held.replace('"', "'")));
    }
    if whens.is_empty() {
        call
    } else {
        format!("monitor {{\n{}\n}} during {{\n{call}\n}}", whens.join("\n"))
    }
}
