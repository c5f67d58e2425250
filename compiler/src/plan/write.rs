//! Calls of a plan as steps of a policy.

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Call, Do, Expr, Name};

use crate::library::Library;
use crate::prove::mend::Proposed;
use crate::world::World;

/// A call as the text form writes it. Defaults are left unsaid. None where an argument has no word in the language.
pub(super) fn call(proposed: &Proposed, library: &Library, world: &World) -> Option<Do> {
    let def = library.primitive(proposed.primitive)?;
    let span = Span::default();
    let mut args = Vec::new();
    let mut is_plain = true;
    for (term, param) in proposed.args.iter().zip(&def.params) {
        if param.default.as_ref() == Some(term) {
            is_plain = false;
            continue;
        }
        let kind = crate::fix::spelled(term, library, world)?;
        let name = (!is_plain).then(|| Name { text: param.name.clone(), span });
        args.push(Arg { name, value: Expr { kind, span }, span });
    }
    let call = Call { name: Name { text: def.name.clone(), span }, args, span };
    Some(Do { call, bind: None, within: None, retry: None })
}
