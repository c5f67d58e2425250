//! Type checks of stand-alone motion queries.

use motet_syntax::ast::{Expr, ExprKind};
use motet_syntax::{Diagnostic, Span, Syntax};
use smol_str::SmolStr;

use crate::declare::elaborator::{Elaborator, Expected, ValueRole};
use crate::declare::{Library, PrimitiveDef};
use crate::environment::Environment;
use crate::ir::{MotionKind, Term};

/// Type-checks the arguments of a motion query as a call of a primitive with this motion would; empty if one
/// of the robot's primitives accepts them. Checks only parameters of the primitive.
pub(crate) fn check_motion(
    name: &str,
    args: &[(SmolStr, Span)],
    library: &Library,
    environment: &Environment,
) -> Vec<Diagnostic> {
    let kind = MotionKind::from_name(name);
    let mut least: Option<Vec<Diagnostic>> = None;
    for def in library.primitives.iter().filter(|def| def.provided) {
        let Some((_, terms)) =
            def.motion.as_ref().filter(|(own, terms)| Some(*own) == kind && terms.len() == args.len())
        else {
            continue;
        };
        let said = taken(def, terms, args, library, environment);
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
    environment: &Environment,
) -> Vec<Diagnostic> {
    let mut elaborator =
        Elaborator::new(library, environment.entities(), environment.has_scene(), Syntax::Text);
    for (term, (name, span)) in terms.iter().zip(args) {
        let Term::Param(index) = term else { continue };
        let Some(param) = def.params.get(usize::from(*index)) else { continue };
        let expr = Expr { kind: ExprKind::Name(name.clone()), span: *span };
        elaborator.term_of(&expr, Expected { ty: param.ty, place: ValueRole::Param(&param.name, &def.name) });
    }
    elaborator.diagnostics
}
