//! The canonical spelling of a policy.
//!
//! Everything that the language leaves open is filled in: the robot, default arguments, names of results
//! that nothing uses (`_1`, `_2`, …), an empty `else`. Units become SI, numbers get the decimals of the
//! subset, and comparisons have their measure on the left. So the canonical text means the same as the
//! policy, and is a fixed point.

mod complete;
mod print;
mod value;

use motet_syntax::Span;
use motet_syntax::ast::Policy;

use crate::Grammar;

/// The reason why a policy is outside of the canonical subset.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct OutsideSubset {
    /// The part that is outside.
    pub span: Span,
    /// The reason, a clause in lower case.
    pub why: String,
}

impl std::fmt::Display for OutsideSubset {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.why)
    }
}

impl std::error::Error for OutsideSubset {}

/// Prints a policy in the canonical subset: one line without a line break at its end. Reading it gives the
/// same policy with the defaults filled in, and printing that gives the same line. O(policy × productions).
///
/// ```
/// use motet_decode::{Environment, Grammar, Subset, canonical};
/// use motet_syntax::{FileId, Source};
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let grammar = Grammar::new(&texts.session()?.signatures(), Subset::default());
/// let source = Source::new("p.motet", "policy p { go(sink) }");
/// let file = motet_syntax::read(&source, FileId(0)).file;
/// let policy = file.policies().next().expect("the document has a policy");
/// assert_eq!(
///     canonical(policy, &grammar).as_deref(),
///     Ok(concat!(
///         r#"{"motet":1,"policy":"p","result":null,"robot":"hsr","achieves":null,"keep":null,"#,
///         r#""steps":[{"do":"go","to":"sink"}],"finally":null}"#,
///     )),
/// );
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
///
/// # Errors
///
/// The first part of the policy that is outside of the subset.
pub fn canonical(policy: &Policy, grammar: &Grammar) -> Result<String, OutsideSubset> {
    print::print(&complete::complete(policy, grammar)?, grammar)
}
