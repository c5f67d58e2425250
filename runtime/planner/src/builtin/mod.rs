//! The planner that needs no model. Every policy that it writes is checked by the compiler before it is given out.

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
    /// What the compiler made of it and says of it: a graph, and no error.
    pub compiled: Compiled,
    /// How many states the search looked at.
    pub looked_at: usize,
}

/// A request that was understood, and the policy for it.
#[derive(Clone, Debug)]
pub struct Answered {
    /// What it was taken to mean.
    pub understood: Intent,
    /// The policy.
    pub planned: Planned,
}

/// Why there is no policy.
#[derive(Error, Clone, Debug)]
pub enum Unplanned {
    /// What was asked for is not clear.
    #[error(transparent)]
    RequestError(#[from] RequestError),
    /// The search found nothing.
    #[error(transparent)]
    NoPlan(#[from] NoPlan),
    /// What it found does not pass the check: the contracts ask for more than a plan can give.
    #[error("the plan does not pass the check: {}", first(diagnostics))]
    Refused {
        /// The policy.
        text: String,
        /// What the compiler says.
        diagnostics: Vec<Diagnostic>,
    },
    /// The model that is asked gives no reply, and asking somebody else will not change that.
    #[error("{why}")]
    NoModel {
        /// Which model, and why.
        why: String,
    },
    /// A person stopped it.
    #[error("it was stopped")]
    Stopped,
}

/// How many times as many states are looked at where the first search came to the end of its budget.
const LAST_RESORT: usize = 6;

/// Plans for aims, one after the other, and has the policy checked. The same session and aims give the same policy.
///
/// # Errors
///
/// Why there is none.
pub fn plan(
    session: &Session,
    robot: Option<&Robot>,
    name: &str,
    aims: &[Aim],
) -> Result<Planned, Unplanned> {
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
        return Err(Unplanned::Refused { text, diagnostics: compiled.diagnostics });
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
) -> Result<Answered, Unplanned> {
    let understood = motet_requests::understand(request, situation)?;
    if understood.aims.is_empty() {
        let question = "I take note of that. What shall I do?".to_owned();
        return Err(RequestError::AmbiguousTask { question, options: Vec::new() }.into());
    }
    let name = understood.aims.first().map_or("plan", |aim| aim.name.as_str());
    let planned = plan(session, robot, name, &understood.aims)?;
    Ok(Answered { understood, planned })
}

fn first(diagnostics: &[Diagnostic]) -> &str {
    let mut errors = diagnostics.iter().filter(|said| said.severity == Severity::Error);
    errors.next().map_or("", |said| said.message.as_str())
}
