//! One goal of a request, named for the steps that reach it. The reader of requests yields aims; the planner
//! reaches them.

use motet_compiler::plan::Goal;
use motet_syntax::ast::Expr;

/// A goal with a name for the steps that reach it.
#[derive(Clone, Debug)]
pub struct Aim {
    pub goal: Goal,
    /// Name of the group of steps, such as `fetch_coke`.
    pub name: String,
    /// Condition that must hold when the aim's turn comes; otherwise its steps are skipped.
    pub only_if: Option<Expr>,
}
