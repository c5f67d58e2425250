//! A motion that is asked for by itself, without a policy: whether the things it names are of kinds that it may be about.

use motet_syntax::ast::{Expr, ExprKind};
use motet_syntax::{Diagnostic, Span, Syntax};
use smol_str::SmolStr;

use super::expr::{Place, Resolver, Wanted};
use crate::ir::Term;
use crate::library::{Library, PrimitiveDef};
use crate::world::World;

/// What is wrong with the things that a motion names, as a call of a primitive with this motion would be told; nothing where one of
/// the primitives that the robot has takes them all. Things other than parameters of a primitive are not looked at.
pub(crate) fn check_motion(
    name: &str,
    args: &[(SmolStr, Span)],
    library: &Library,
    world: &World,
) -> Vec<Diagnostic> {
    let mut least: Option<Vec<Diagnostic>> = None;
    for def in library.primitives.iter().filter(|def| def.provided) {
        let Some((_, terms)) =
            def.motion.as_ref().filter(|(own, terms)| own == name && terms.len() == args.len())
        else {
            continue;
        };
        let said = taken(def, terms, args, library, world);
        if least.as_ref().is_none_or(|least| said.len() < least.len()) {
            least = Some(said);
        }
    }
    least.unwrap_or_default()
}

fn taken(
    def: &PrimitiveDef,
    terms: &[Term],
    args: &[(SmolStr, Span)],
    library: &Library,
    world: &World,
) -> Vec<Diagnostic> {
    let mut resolver = Resolver::new(library, world.entities(), world.has_scene(), Syntax::Text);
    for (term, (name, span)) in terms.iter().zip(args) {
        let Term::Param(index) = term else { continue };
        let Some(param) = def.params.get(usize::from(*index)) else { continue };
        let expr = Expr { kind: ExprKind::Name(name.clone()), span: *span };
        resolver.term_of(&expr, Wanted { ty: param.ty, place: Place::Param(&param.name, &def.name) });
    }
    resolver.diagnostics
}
