//! Results of planning: a policy that passed the check, or the reason why there is none.

use motet_compiler::plan::NoPlan;
use motet_compiler::{Compiled, Session};
use motet_graph::NodeKind;
use motet_requests::{Intent, RequestError};
use motet_syntax::ast::{Expr, ExprKind};
use motet_syntax::{Diagnostic, FileId, Parsed, Severity, Source, Span, print};
use thiserror::Error;

/// A policy that reaches the requested goals.
#[derive(Clone, Debug)]
pub struct Planned {
    /// The policy in the canonical text syntax.
    pub text: String,
    /// The same policy, parsed.
    pub parsed: Parsed,
    /// Result of compiling the policy: a graph, and no error.
    pub compiled: Compiled,
    /// Number of states that the search expanded.
    pub looked_at: usize,
}

/// Code of the warning that a path takes longer than its step may.
const TOO_SLOW: &str = "M0611";
/// Time of a step as a multiple of the time of its path: a driver also thinks, and grips.
const SLACK: f64 = 1.5;

impl Planned {
    /// The policy with a deadline for each of its own steps whose path takes longer than the step may.
    pub(crate) fn with_time(self, session: &Session) -> Self {
        let takes = |step: &str| {
            let node = self.compiled.graph.as_ref()?.nodes.iter().find(|node| node.path == step)?;
            let NodeKind::Call(call) = &node.kind else { return None };
            Some(call.motion.as_ref()?.witness.as_ref()?.path.last()?.at)
        };
        let slow = self.compiled.diagnostics.iter().filter(|said| said.code.0 == TOO_SLOW);
        let mut deadlines: Vec<(usize, f64)> = slow
            .filter_map(|said| {
                let step = self.text.get(said.span.range())?;
                // Behind the call stand its manner, its deadline and its retries.
                let (call, rest) = step.split_at_checked(step.rfind(')')? + 1)?;
                let retries = rest.find(" retry ").unwrap_or(rest.len());
                let at = said.span.start as usize + call.len() + retries;
                (!rest.contains(" within ")).then_some((at, takes(&said.path)?))
            })
            .collect();
        if deadlines.is_empty() {
            return self;
        }
        deadlines.sort_unstable_by_key(|(at, _)| std::cmp::Reverse(*at));
        let mut text = self.text.clone();
        for (at, takes) in deadlines {
            text.insert_str(at, &format!(" within {} s", (takes * SLACK).ceil()));
        }
        let parsed = motet_syntax::read(&Source::new("plan.motet", text.as_str()), FileId(0));
        let compiled = session.compile(&parsed, None);
        if compiled.graph.is_some() { Self { text, parsed, compiled, ..self } } else { self }
    }
}

/// A request that was understood, with its policy.
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
    /// The model keeps to a policy that passes the check, but that does not do what was asked, or that is not
    /// as the model wrote it. A person decides.
    #[error("the plan is in doubt: {}", first(diagnostics))]
    Doubtful {
        planned: Box<Planned>,
        /// Diagnostics that the model did not heed.
        diagnostics: Vec<Diagnostic>,
    },
    /// The model answered in words: a question, or a refusal.
    #[error("{words}")]
    Said { words: String },
    /// The model gave no reply, and another attempt cannot succeed.
    #[error("{why}")]
    NoModel {
        /// Name of the model, and the reason.
        why: String,
    },
    /// A person stopped the planning.
    #[error("it was stopped")]
    Stopped,
}

/// A text as it is written in a policy.
pub(crate) fn quoted(text: &str) -> String {
    print::expression(&Expr { kind: ExprKind::Text(text.into()), span: Span::default() })
}

fn first(diagnostics: &[Diagnostic]) -> &str {
    let mut errors = diagnostics.iter().filter(|said| said.severity == Severity::Error);
    errors.next().map_or("", |said| said.message.as_str())
}
