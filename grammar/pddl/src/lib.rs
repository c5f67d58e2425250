#![doc = include_str!("../README.md")]

mod diagnostics;
mod domain;
mod formula;
mod plan;
mod s_expression;
mod typed;
mod write;

pub use diagnostics::CODES;

use motet_syntax::ast::File;
use motet_syntax::{Diagnostic, FileId, Severity, Source, print};

/// The most parameters of a predicate: a fluent takes no more.
pub const MAX_ARITY: usize = 4;

/// A domain and a problem, as Motet says them.
#[derive(Clone, Debug)]
pub struct Translation {
    /// Kinds, fluents, actions, entities, `initially` and `closed world`.
    pub declarations: File,
    /// One policy without parameters that states the problem's goal: with the steps of the plan, where one is
    /// given.
    pub policy: File,
}

impl Translation {
    /// The declarations in the text syntax, with the goal in a comment above them.
    #[must_use]
    pub fn declarations_text(&self) -> String {
        let goal = self.policy.policies().find_map(|policy| policy.achieves.as_ref());
        let goal = goal.map(|goal| format!("policy plan achieves {} {{ … }}", print::expression(goal)));
        let goal = goal.unwrap_or_else(|| "policy plan { … }".to_owned());
        format!("// A plan for it is: {goal}\n\n{}", print::text(&self.declarations))
    }

    /// The policy in the text syntax.
    #[must_use]
    pub fn policy_text(&self) -> String {
        print::text(&self.policy)
    }
}

/// A source with its place among the files of a run.
#[derive(Clone, Copy, Debug)]
pub struct PddlSource<'s> {
    pub source: &'s Source,
    /// Its id in the diagnostics.
    pub file: FileId,
}

/// Imports a domain with a problem, and a plan where one is given. `None` where there is an error among the
/// diagnostics, which are in the order of the files. O(n log n) in the length of the files.
#[must_use]
pub fn import(
    domain: PddlSource<'_>,
    problem: PddlSource<'_>,
    plan: Option<PddlSource<'_>>,
) -> (Option<Translation>, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let domain =
        s_expression::read(domain, &mut diagnostics).and_then(|tree| domain::read(&tree, &mut diagnostics));
    let problem = s_expression::read(problem, &mut diagnostics).and_then(|tree| {
        domain.as_ref().and_then(|domain| domain::read_problem(&tree, domain, &mut diagnostics))
    });
    let plan = plan.map(|plan| plan::read(plan, domain.as_ref(), problem.as_ref(), &mut diagnostics));
    let is_refused = diagnostics.iter().any(|diagnostic: &Diagnostic| diagnostic.severity == Severity::Error);
    let imported = domain.zip(problem).filter(|_| !is_refused);
    (
        imported.map(|(domain, problem)| write::imported(&domain, &problem, plan.unwrap_or_default())),
        diagnostics,
    )
}
