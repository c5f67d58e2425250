//! Verdict on a whole reply: its policy after known fixes, or its errors.

use motet_compiler::fix::AppliedFix;
use motet_compiler::plan::Persistence;
use motet_compiler::{Session, fix, make_explicit};
use motet_requests::RequestContext;
use motet_syntax::ast::{Expr, ExprKind, File, Item};
use motet_syntax::{Diagnostic, FileId, Parsed, Severity, Source, Span, Syntax, print};

use crate::builtin::Planned;

/// Maximum number of fixes to one reply.
const MOST_FIXES: usize = 8;

/// Verdict on a reply.
#[derive(Clone, Debug)]
pub enum ReplyVerdict {
    /// The reply holds a policy that passes the check.
    Good {
        /// The policy, with its graph.
        planned: Box<Planned>,
        /// The fixes that were made first.
        mended: Vec<String>,
        /// Diagnostics whose fixes changed the steps, not only their spelling.
        changed: Vec<Diagnostic>,
    },
    /// The reply holds no policy that passes the check.
    Bad {
        /// Errors of the reply.
        findings: Vec<Diagnostic>,
    },
}

/// Judges a reply. It may have prose, thoughts or a fence around the policy, and be in either syntax. Other
/// declarations are dropped, so that a reply cannot change the contracts of its steps.
#[must_use]
pub fn judge(session: &Session, reply: &str) -> ReplyVerdict {
    let document = without_thoughts(reply);
    let mut parsed = read(document);
    if parsed.file.items.iter().any(|item| !matches!(item, Item::Policy(_))) {
        let items = parsed.file.items.iter().filter(|item| matches!(item, Item::Policy(_)));
        parsed = read(&motet_syntax::print::text(&File { items: items.cloned().collect() }));
    }
    let findings = errors(session.compile(&parsed, None).diagnostics);
    let (mut mended, mut changed) = (Vec::new(), Vec::new());
    if !findings.is_empty() {
        let Some((text, fixes)) = mend(session, &parsed.text) else { return ReplyVerdict::Bad { findings } };
        if !fixes.iter().all(is_spelling) {
            changed = findings;
        }
        (parsed, mended) = (read(&text), fixes.into_iter().map(|fix| fix.title).collect());
    }
    let mut file = parsed.file.clone();
    for item in &mut file.items {
        if let Item::Policy(policy) = item {
            make_explicit(policy, session.library(), Syntax::Text);
        }
    }
    let text = motet_syntax::print::text(&file);
    let parsed = motet_syntax::read(&Source::new("plan.motet", text.as_str()), FileId(0));
    let compiled = session.compile(&parsed, None);
    if compiled.graph.is_none() {
        // Motions are looked at only where nothing else is wrong, and no fix is known for them.
        return ReplyVerdict::Bad { findings: errors(compiled.diagnostics) };
    }
    ReplyVerdict::Good {
        planned: Box::new(Planned { text, parsed, compiled, looked_at: 0 }),
        mended,
        changed,
    }
}

/// Returns `true` if a fix keeps the steps: fixes of syntax, names and types.
fn is_spelling(fix: &AppliedFix) -> bool {
    ["M01", "M02", "M03"].iter().any(|stage| fix.code.0.starts_with(stage))
}

/// A document after known fixes, with these fixes; `None` if errors remain.
pub(super) fn mend(session: &Session, document: &str) -> Option<(String, Vec<AppliedFix>)> {
    let source = Source::new(name(document), document);
    let fixed = fix::fix(session, &source, FileId(0), MOST_FIXES);
    if fixed.applied.is_empty() || !errors(fixed.diagnostics).is_empty() {
        return None;
    }
    Some((fixed.text, fixed.applied))
}

pub(super) fn read(document: &str) -> Parsed {
    motet_syntax::read(&Source::new(name(document), document), FileId(0))
}

pub(super) fn errors(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    diagnostics.into_iter().filter(|said| said.severity == Severity::Error).collect()
}

fn name(document: &str) -> &'static str {
    if document.trim_start().starts_with('{') { "reply.json" } else { "reply.motet" }
}

/// Strips the thoughts that some models write before the reply.
fn without_thoughts(reply: &str) -> &str {
    if !reply.trim_start().starts_with("<think>") {
        return reply;
    }
    reply.split_once("</think>").map_or("", |(_, rest)| rest)
}

/// Goal of a request that does not depend on a condition. `None` if the request cannot be read.
pub(super) fn goal(request: &str, situation: &RequestContext<'_>) -> Option<Expr> {
    let understood = motet_requests::understand(request, situation).ok()?;
    if understood.aims.iter().any(|aim| aim.only_if.is_some()) {
        return None;
    }
    let lasting = understood.aims.into_iter().filter(|aim| aim.goal.persistence == Persistence::ToTheEnd);
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
