//! Resource conflicts: parallel branches must not use the same resource.

use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use super::errors::ResourceConflict;
use crate::declare::{Library, ResourceSet};
use crate::ir::{Block, Program, StepKind};

/// First user of each set of resources in a block.
type Uses = Vec<(ResourceSet, SmolStr, Span)>;

/// Checks the steps from `first` on.
pub(super) fn check(program: &Program, first: usize, library: &Library, diagnostics: &mut Vec<Diagnostic>) {
    for step in program.steps.iter().skip(first) {
        let StepKind::Parallel { branches } = &step.kind else { continue };
        let mut earlier: Uses = Vec::new();
        for branch in branches {
            let mut uses = Uses::new();
            collect(branch, program, library, &mut uses);
            for (set, name, span) in &uses {
                let clash = earlier.iter().find(|(other, ..)| other & set != 0);
                if let Some((other, one, first)) = clash {
                    let shared = (other & set).trailing_zeros() as usize;
                    let resource =
                        library.resources.get(shared).map(|def| def.name.clone()).unwrap_or_default();
                    let (one, other) = (one.clone(), name.clone());
                    diagnostics
                        .push(ResourceConflict { span: *span, resource, one, other, first: *first }.into());
                    break;
                }
            }
            earlier.extend(uses);
        }
    }
}

/// Collects the resources of the steps of a block, each set once. The nesting of policies bounds the
/// recursion.
fn collect(block: &Block, program: &Program, library: &Library, uses: &mut Uses) {
    for step in block.iter().filter_map(|id| program.step(*id)) {
        match &step.kind {
            StepKind::Call(call) => {
                let Some(def) = library.primitive(call.primitive).filter(|def| def.uses != 0) else {
                    continue;
                };
                if !uses.iter().any(|(set, ..)| set & def.uses == def.uses) {
                    uses.push((def.uses, def.name.clone(), step.span));
                }
            }
            kind => super::durations::blocks(kind, |block| collect(block, program, library, uses)),
        }
    }
}
