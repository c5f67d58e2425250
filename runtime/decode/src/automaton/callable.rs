//! Callables as the automaton and the oracle need them.

use motet_compiler::Session;
use motet_compiler::incremental::{IncrementalChecker, PolicyTemplate};
use motet_syntax::ast::{Clause, ExprKind};

use super::OpId;

/// A callable with the operations of its arguments.
#[derive(Clone, Debug)]
pub(crate) struct Callable {
    /// The number among the library's primitives; `None` for a policy.
    pub(crate) primitive: Option<usize>,
    /// The operation of each argument that is a word.
    pub(crate) words: Vec<Option<OpId>>,
    /// The operation of the elements of each list argument, if they are words.
    pub(crate) elements: Vec<Option<OpId>>,
    /// The resolved body of a policy.
    pub(crate) template: Option<PolicyTemplate>,
    /// The resources that it uses, as bits.
    pub(crate) uses: u64,
    /// The fluents that it mentions, as bits; several may share one.
    pub(crate) fluents: u64,
    /// The parameter that its motion is about.
    pub(crate) target: Option<usize>,
}

impl Callable {
    /// A callable without the operations of its arguments, which lowering adds.
    pub(crate) fn new(session: &Session, signature: &motet_compiler::signature::Callable) -> Self {
        let name = &signature.name;
        let template = if signature.is_policy { PolicyTemplate::new(session, name) } else { None };
        Self {
            primitive: if signature.is_policy { None } else { IncrementalChecker::primitive(session, name) },
            words: Vec::with_capacity(signature.params.len()),
            elements: Vec::with_capacity(signature.params.len()),
            uses: IncrementalChecker::resources(session, name, template.as_ref()),
            fluents: IncrementalChecker::fluents(session, name, template.as_ref()),
            template,
            target: target(session, name),
        }
    }
}

/// The parameter that the motion of a primitive is about.
fn target(session: &Session, name: &str) -> Option<usize> {
    let decl = session.library().signatures().find(|decl| decl.name.text == name)?;
    let motion = decl.clauses.iter().find_map(|clause| match clause {
        Clause::Motion(call) => call.args.first(),
        _ => None,
    })?;
    let ExprKind::Name(of) = &motion.value.kind else { return None };
    decl.params.iter().position(|param| param.name.text == *of)
}
