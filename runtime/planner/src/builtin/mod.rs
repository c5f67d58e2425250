//! The planner that needs no model. Every policy that it writes is checked by the compiler before it is
//! given out.

mod draft;

use motet_compiler::plan::{Goal, NoPlan, PLAN_BUDGET};
use motet_compiler::{Compiled, Session};
use motet_robots::card::Robot;
use motet_syntax::{Diagnostic, FileId, Parsed, Severity, Source};
use thiserror::Error;

use motet_requests::{Aim, Intent, RequestContext, RequestError};

/// A policy that reaches what was asked for.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The policy in the canonical text form.
    pub text: String,
    /// The same, read.
    pub parsed: Parsed,
    /// Result of compiling the policy: a graph, and no error.
    pub compiled: Compiled,
    /// Number of states that the search expanded.
    pub looked_at: usize,
}

/// A request that was understood, and the policy for it.
#[derive(Clone, Debug)]
pub struct PlannedRequest {
    /// Intent that the request was read as.
    pub understood: Intent,
    pub planned: Planned,
}

/// Reasons for which a request gets no policy.
#[derive(Error, Clone, Debug)]
pub enum PlanError {
    /// The request is unclear.
    #[error(transparent)]
    RequestError(#[from] RequestError),
    /// The search found nothing.
    #[error(transparent)]
    NoPlan(#[from] NoPlan),
    /// The plan does not pass the check: a contract needs more than the planner can establish.
    #[error("the plan does not pass the check: {}", first(diagnostics))]
    Refused {
        text: String,
        /// Diagnostics of the compiler.
        diagnostics: Vec<Diagnostic>,
    },
    /// The model that is asked gives no reply, and asking somebody else will not change that.
    #[error("{why}")]
    NoModel {
        /// Name of the model, and the reason.
        why: String,
    },
    /// A person stopped it.
    #[error("it was stopped")]
    Stopped,
}

/// Factor on the state budget of a second search, after the first one used up its budget.
const LAST_RESORT: usize = 6;

/// Plans for aims, one after the other, and has the policy checked. The same session and aims give the same
/// policy.
///
/// # Errors
///
/// Why there is none.
pub fn plan(
    session: &Session,
    robot: Option<&Robot>,
    name: &str,
    aims: &[Aim],
) -> Result<Planned, PlanError> {
    let goals: Vec<Goal> = aims.iter().map(|aim| aim.goal.clone()).collect();
    let plan = match session.plan(&goals, PLAN_BUDGET) {
        Err(NoPlan::Budget { .. }) => session.plan(&goals, PLAN_BUDGET * LAST_RESORT)?,
        found => found?,
    };
    let text = draft::policy(name, robot, aims, &plan);
    let parsed = motet_syntax::read(&Source::new("plan.motet", text), FileId(0));
    let text = motet_syntax::print::text(&parsed.file);
    let parsed = motet_syntax::read(&Source::new("plan.motet", text.as_str()), FileId(0));
    let compiled = session.compile(&parsed, None);
    if compiled.graph.is_none() {
        return Err(PlanError::Refused { text, diagnostics: compiled.diagnostics });
    }
    Ok(Planned { text, parsed, compiled, looked_at: plan.expanded_states })
}

/// Understands a request and plans for it.
///
/// # Errors
///
/// What is not understood, or why there is no plan.
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

fn first(diagnostics: &[Diagnostic]) -> &str {
    let mut errors = diagnostics.iter().filter(|said| said.severity == Severity::Error);
    errors.next().map_or("", |said| said.message.as_str())
}
