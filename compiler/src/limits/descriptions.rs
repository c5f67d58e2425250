//! Unused bindings, and descriptions that fit no entity or several entities of the scene.

use motet_syntax::Diagnostic;

use super::errors::{Ambiguous, Missing, Unused};
use crate::declare::Library;
use crate::declare::suggestion::{list, near};
use crate::environment::Environment;
use crate::ir::{Program, StepKind};

pub(super) fn check(
    program: &Program,
    library: &Library,
    environment: &Environment,
    diagnostics: &mut Vec<Diagnostic>,
) {
    for (index, binding) in program.bindings.iter().enumerate() {
        if binding.uses == 0 && binding.name != "_" && !binding.name.starts_with('_') {
            let of_each = program
                .steps
                .iter()
                .any(|step| matches!(&step.kind, StepKind::Each { item, .. } if item.index() == index));
            diagnostics.push(Unused { span: binding.span, name: binding.name.clone(), of_each }.into());
        }
    }
    if !environment.has_scene() {
        return;
    }
    for step in &program.steps {
        let StepKind::Call(call) = &step.kind else { continue };
        let Some(binding) = call.binds.and_then(|id| program.bindings.get(id.index())) else { continue };
        let (Some(text), Some(kind)) = (&binding.description, binding.ty.kind()) else { continue };
        let callee = library.primitive(call.primitive).map(|def| def.name.clone()).unwrap_or_default();
        match environment.described(library, text, kind).as_slice() {
            [_] => {}
            [] => {
                let fitting =
                    environment.entities().iter().filter(|(.., other)| library.is_kind(*other, kind));
                let near = near(text, fitting.map(|(_, name, _)| name.as_str()));
                diagnostics.push(Missing { span: step.span, callee, text: text.clone(), near }.into());
            }
            several => {
                let found = list(several.iter().take(5).map(|entity| environment.name(*entity)));
                diagnostics.push(Ambiguous { span: step.span, callee, text: text.clone(), found }.into());
            }
        }
    }
}
