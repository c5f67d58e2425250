//! Verdict on a whole reply: its policy after known fixes, or its errors.

use motet_compiler::fix::{AppliedFix, FixLimits};
use motet_compiler::plan::Persistence;
use motet_compiler::{Session, fix, make_explicit};
use motet_graph::NodeKind;
use motet_requests::{Aim, Certainty, RequestContext};
use motet_stdlib::lang::{entities, primitives};
use motet_syntax::ast::{Clause, Expr, ExprKind, File, Item};
use motet_syntax::{Code, Diagnostic, FileId, Parsed, Severity, Source, Span, Syntax, print};
use smol_str::SmolStr;

use crate::planned::Planned;

/// Maximum number of fixes to one reply.
const MOST_FIXES: usize = 8;

/// Maximum length of the policy of a reply, as Motet prints it, in bytes: about a thousand steps.
const MOST_BYTES: usize = 32 << 10;

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
    let length = print::text(&parsed.file).len();
    if length > MOST_BYTES {
        return ReplyVerdict::Bad { findings: vec![too_long(&parsed, length)] };
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
        planned: Box::new(Planned { text, parsed, compiled, looked_at: 0 }.with_time(session)),
        mended,
        changed,
    }
}

/// Error of a policy that is longer than a model may write.
fn too_long(parsed: &Parsed, length: usize) -> Diagnostic {
    let first = parsed.file.items.iter().find_map(|item| match item {
        Item::Policy(policy) => Some(policy.span),
        _ => None,
    });
    Diagnostic {
        code: Code("M0112"),
        severity: Severity::Error,
        message: format!("the policy has {length} bytes; that of a reply has at most {MOST_BYTES}"),
        help: Some("use `repeat` or `each` for similar steps".to_owned()),
        span: first.unwrap_or_default(),
        path: String::new(),
        related: Vec::new(),
        fix: None,
        about: None,
    }
}

/// True if a fix keeps the steps: fixes of syntax, names and types.
fn is_spelling(fix: &AppliedFix) -> bool {
    ["M01", "M02", "M03"].iter().any(|stage| fix.code.0.starts_with(stage))
}

/// A document after known fixes, with these fixes; `None` if errors remain.
pub(crate) fn mend(session: &Session, document: &str) -> Option<(String, Vec<AppliedFix>)> {
    let source = Source::new(name(document), document);
    let fixed = fix::fix(session, &source, FileId(0), FixLimits::safe(MOST_FIXES));
    if fixed.applied.is_empty() || !errors(fixed.diagnostics).is_empty() {
        return None;
    }
    Some((fixed.text, fixed.applied))
}

pub(crate) fn read(document: &str) -> Parsed {
    motet_syntax::read(&Source::new(name(document), document), FileId(0))
}

pub(crate) fn errors(diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    diagnostics.into_iter().filter(|said| said.severity == Severity::Error).collect()
}

fn name(document: &str) -> &'static str {
    if document.trim_start().starts_with('{') { "reply.json" } else { "reply.motet" }
}

/// Strips the thoughts that some models write before the reply.
pub(crate) fn without_thoughts(reply: &str) -> &str {
    if !reply.trim_start().starts_with("<think>") {
        return reply;
    }
    reply.split_once("</think>").map_or("", |(_, rest)| rest)
}

/// Goal of a request, as the built-in reader of requests reads it.
#[derive(Clone, Debug)]
pub(crate) struct RequestGoal {
    pub(crate) condition: Expr,
    pub(crate) certainty: Certainty,
}

impl RequestGoal {
    /// Goal of a request that does not depend on a condition. `None` if the request cannot be read.
    pub(crate) fn new(request: &str, situation: &RequestContext<'_>) -> Option<Self> {
        let understood = motet_requests::understand(request, situation).ok()?;
        let depends = |aim: &Aim| aim.only_if.is_some() || aim.awaits.is_some();
        if understood.aims.iter().any(depends) {
            return None;
        }
        let certainty = understood.certainty;
        let lasting = understood.aims.into_iter().filter(|aim| aim.goal.persistence == Persistence::ToTheEnd);
        let mut parts: Vec<Expr> = lasting.map(|aim| aim.goal.condition).collect();
        let condition = match parts.len() {
            0 | 1 => parts.pop()?,
            _ => Expr { kind: ExprKind::All(parts), span: Span::default() },
        };
        Some(Self { condition, certainty })
    }

    /// The finding about a policy that passes the check, acts, and reaches the goal on none of its ways.
    /// `None` for a policy that asks, says something or declines: the goal does not bind it.
    pub(crate) fn missed(&self, session: &Session, planned: &Planned) -> Option<Diagnostic> {
        if !self.is_acted_on(session, planned) {
            return None;
        }
        let mut file = File { items: planned.parsed.file.items.clone() };
        for item in &mut file.items {
            if let Item::Policy(policy) = item {
                policy.achieves = Some(self.condition.clone());
            }
        }
        let text = print::text(&file);
        let parsed = motet_syntax::read(&Source::new("plan.motet", text.as_str()), FileId(0));
        if !session.misses_goal(&parsed) {
            return None;
        }
        // Only what the goal adds is of interest: the policy alone has no error.
        let missed = errors(session.compile(&parsed, None).diagnostics).into_iter().next()?;
        // The request may want something else, so no steps are proposed.
        let help = "if that is what the request wants, plan it; if it cannot be done, end with \
                    `cannot`"
            .to_owned();
        let goal = print::expression(&self.condition);
        let message = format!("the request reads as `{goal}`, which the policy does not bring about");
        Some(Diagnostic { message, fix: None, help: Some(help), path: String::new(), ..missed })
    }

    /// True if a policy changes something that the goal is about, or else says nothing at all.
    fn is_acted_on(&self, session: &Session, planned: &Planned) -> bool {
        let mut speaks = false;
        let graph = planned.compiled.graph.as_ref();
        let called = graph.into_iter().flat_map(|graph| {
            graph.nodes.iter().filter_map(|node| match &node.kind {
                NodeKind::Call(call) => graph.primitives.get(call.primitive.index()),
                _ => None,
            })
        });
        for primitive in called {
            speaks |= SPEAKING.contains(&primitive.name.as_str());
            let mut decls = session.library().signatures();
            let Some(decl) = decls.find(|decl| decl.name.text == primitive.name) else { continue };
            let effects = decl.clauses.iter().flat_map(|clause| match clause {
                Clause::Makes(effects) => effects.as_slice(),
                _ => &[],
            });
            if effects.flat_map(|effect| facts(&effect.expr)).any(|fact| self.is_about(&fact)) {
                return true;
            }
        }
        !speaks
    }

    /// True if a goal has this fluent, and both or neither are about the robot.
    fn is_about(&self, (fluent, subject): &Fact) -> bool {
        facts(&self.condition).iter().any(|(wanted, of)| {
            wanted == fluent && (of.as_deref() == Some(ROBOT)) == (subject.as_deref() == Some(ROBOT))
        })
    }
}

/// Primitives that speak with people.
const SPEAKING: &[&str] = &[primitives::SAY, primitives::ASK, primitives::CHOOSE];
/// Name of the robot in conditions.
const ROBOT: &str = entities::ROBOT;

/// A fluent, with its first argument if that is a name.
type Fact = (SmolStr, Option<SmolStr>);

/// Fluents of a condition.
fn facts(condition: &Expr) -> Vec<Fact> {
    match &condition.kind {
        ExprKind::Call(call) => {
            let subject = call.args.first().and_then(|arg| match &arg.value.kind {
                ExprKind::Name(name) => Some(name.clone()),
                _ => None,
            });
            vec![(call.name.text.clone(), subject)]
        }
        ExprKind::Not(inner) => facts(inner),
        ExprKind::All(parts) | ExprKind::AnyOf(parts) => parts.iter().flat_map(facts).collect(),
        _ => Vec::new(),
    }
}
