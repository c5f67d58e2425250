//! Spelling of planned calls as steps of a policy.

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Call, Do, Expr, ExprKind, Name};

use super::achievers::CandidateCall;
use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::Term;

/// Writes a call in text syntax, without defaults. `None` if an argument has no spelling in the language.
pub(super) fn call(proposed: &CandidateCall, library: &Library, environment: &Environment) -> Option<Do> {
    let def = library.primitive(proposed.primitive)?;
    let span = Span::default();
    let mut args = Vec::new();
    let mut is_plain = true;
    for (term, param) in proposed.args.iter().zip(&def.params) {
        if param.default.as_ref() == Some(term) {
            is_plain = false;
            continue;
        }
        let kind = spelled(term, library, environment)?;
        let name = (!is_plain).then(|| Name { text: param.name.clone(), span });
        args.push(Arg { name, value: Expr { kind, span }, span });
    }
    let call = Call { name: Name { text: def.name.clone(), span }, args, span };
    Some(Do { call, bind: None, within: None, retry: None })
}

/// Spelling of a value; `None` if it has none in the language, or one that depends on its place.
pub(crate) fn spelled(term: &Term, library: &Library, environment: &Environment) -> Option<ExprKind> {
    Some(match term {
        // A symbol has no name but that of a binding.
        Term::Entity(entity) => ExprKind::Name(environment.entities().name(*entity)?.clone()),
        Term::Case(of, case) => ExprKind::Name(library.case_name(*of, *case).into()),
        Term::Text(text) => ExprKind::Text(text.clone()),
        Term::Bool(value) => ExprKind::Bool(*value),
        // A number would need the unit that its parameter has; no primitive that makes a fact asks for one.
        Term::Int(_)
        | Term::Number(_)
        | Term::List(_)
        | Term::Binding(_)
        | Term::Param(_)
        | Term::Result
        | Term::Each
        | Term::Field(..)
        | Term::Measure(..)
        | Term::Arith(..)
        | Term::Unknown => return None,
    })
}
