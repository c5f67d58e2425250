//! Comparison of a model's policy with the goal of the request, as far as the request can be read without a
//! model.

use motet_compiler::Session;
use motet_compiler::plan::Lasts;
use motet_syntax::ast::{Expr, ExprKind, File, Item};
use motet_syntax::{Diagnostic, FileId, Source, Span, print};

use super::reply_verdict::errors;
use crate::builtin::Planned;
use motet_requests::RequestContext;

/// StaticPrompt goal of a request. `None` if the request cannot be read or depends on a condition.
pub(super) fn goal(request: &str, situation: &RequestContext<'_>) -> Option<Expr> {
    let understood = motet_requests::understand(request, situation).ok()?;
    if understood.aims.iter().any(|aim| aim.only_if.is_some()) {
        return None;
    }
    let lasting = understood.aims.into_iter().filter(|aim| aim.goal.lasts == Lasts::ToTheEnd);
    let mut parts: Vec<Expr> = lasting.map(|aim| aim.goal.condition).collect();
    if parts.len() < 2 {
        return parts.pop();
    }
    Some(Expr { kind: ExprKind::All(parts), span: Span::default() })
}

/// Errors of a policy that passes the check and cannot reach the goal of the request.
pub(super) fn missed(session: &Session, planned: &Planned, goal: &Expr) -> Vec<Diagnostic> {
    let mut file = File { items: planned.parsed.file.items.clone() };
    for item in &mut file.items {
        if let Item::Policy(policy) = item {
            policy.achieves = Some(goal.clone());
        }
    }
    let text = print::text(&file);
    let parsed = motet_syntax::read(&Source::new("plan.motet", text.as_str()), FileId(0));
    // Only what the goal adds is of interest: the policy alone has no error.
    errors(session.compile(&parsed, None).diagnostics)
}
