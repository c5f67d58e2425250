//! What a step can call.

use motet_compiler::Session;
use motet_compiler::draft::{Draft, Template};
use motet_syntax::ast::{Clause, ExprKind};

use super::OpId;

/// A callable, and where its parameters are spelled.
#[derive(Clone, Debug)]
pub(crate) struct Callable {
    /// Its number among the library's primitives; a policy has none.
    pub(crate) primitive: Option<usize>,
    /// The operation of each argument that is a word; none of one that is anything else.
    pub(crate) words: Vec<Option<OpId>>,
    /// Of a list: what its elements are, where they are words.
    pub(crate) elements: Vec<Option<OpId>>,
    /// Of a policy: itself, resolved.
    pub(crate) template: Option<Template>,
    /// The resources that it uses, one a bit.
    pub(crate) uses: u64,
    /// The fluents that it speaks of, as bits; several may share one.
    pub(crate) fluents: u64,
    /// The parameter that its motion is about.
    pub(crate) target: Option<usize>,
}

impl Callable {
    /// A callable, but for how its arguments are spelled.
    pub(crate) fn new(session: &Session, signature: &motet_compiler::signature::Callable) -> Self {
        let name = &signature.name;
        let template = if signature.is_policy { Template::new(session, name) } else { None };
        Self {
            primitive: if signature.is_policy { None } else { Draft::primitive(session, name) },
            words: Vec::with_capacity(signature.params.len()),
            elements: Vec::with_capacity(signature.params.len()),
            uses: Draft::resources(session, name, template.as_ref()),
            fluents: Draft::fluents(session, name, template.as_ref()),
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
