//! A policy in its one spelling of the model subset.
//!
//! What the language leaves open is filled in: the robot, arguments with defaults, names of results that nothing uses
//! (`_1`, `_2`, …), an empty `else`. Units become SI, numbers get the decimals of the subset, comparisons their measure on
//! the left. So the canonical text means what the policy means, and it is a fixed point.

mod complete;
mod json;
mod text;
mod value;

pub use complete::complete;

use motet_compiler::Signatures;
use motet_syntax::ast::Policy;
use motet_syntax::{Span, Syntax};

use crate::subset::Subset;

/// Why a policy has no spelling on the model subset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Outside {
    /// What is outside of it.
    pub span: Span,
    /// Why, in a clause.
    pub why: String,
}

impl std::fmt::Display for Outside {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.why)
    }
}

impl std::error::Error for Outside {}

/// A policy as a language model writes it: one line without a line break at its end. Reading it gives the same policy
/// but for what is filled in, and printing that gives the same line. O(policy × declarations).
///
/// # Errors
///
/// The first thing in the policy that the subset cannot say.
pub fn canonical(policy: &Policy, signatures: &Signatures, subset: Subset) -> Result<String, Outside> {
    let document = complete(policy, signatures, subset)?;
    Ok(match subset.syntax {
        Syntax::Json => json::print(&document, subset),
        Syntax::Text => text::print(&document),
    })
}
