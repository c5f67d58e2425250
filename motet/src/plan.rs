//! Policies for requests and goals, by the built-in planner.

use motet_compiler::plan::{Goal, NoPlan, Persistence};
use motet_planner::builtin::{self, PlanError, Planned, PlannedRequest};
use motet_planner::dialogue::Knowledge;
use motet_project::ProjectSession;
use motet_requests::Aim;
use motet_robots::scene::Scene;

/// Plans a policy for a request in English. The same request gives the same policy.
///
/// # Errors
///
/// The request is not clear, or no plan reaches its goals.
pub fn for_request(opened: &ProjectSession, request: &str) -> Result<PlannedRequest, PlanError> {
    let empty = Scene::default();
    let known = Knowledge::of(opened.told_facts());
    let situation = known.situation(opened.scene.as_ref().unwrap_or(&empty));
    builtin::answer(&opened.session, opened.robot.as_ref(), request, &situation)
}

/// Plans a policy that reaches conditions one after the other.
///
/// # Errors
///
/// A condition is wrong, or no plan reaches it.
pub fn for_goals(opened: &ProjectSession, conditions: &[String]) -> Result<Planned, PlanError> {
    let aims = aims(conditions)?;
    builtin::plan(&opened.session, opened.robot.as_ref(), "plan", &aims)
}

/// Reads conditions as goals, one after the other.
///
/// # Errors
///
/// A condition is wrong.
pub fn aims(texts: &[String]) -> Result<Vec<Aim>, NoPlan> {
    let aim = |(index, text): (usize, &String)| {
        let goal = Goal::read(text, Persistence::ToTheEnd)?;
        Ok(Aim { goal, name: format!("goal_{}", index + 1), only_if: None, awaits: None, named_step: None })
    };
    texts.iter().enumerate().map(aim).collect()
}
