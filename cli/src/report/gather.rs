//! Diagnostics of many documents under one set of sources. Each document has sources of its own, in which it is the first
//! file; here their files are told apart by name.

use std::collections::HashMap;
use std::sync::Arc;

use motet_syntax::{Diagnostic, FileId, Sources, Span};

/// Diagnostics and the files that they are about.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    /// In the order in which they were said.
    pub(super) diagnostics: Vec<Diagnostic>,
    /// Every file with a finding.
    pub(super) sources: Sources,
    known: HashMap<Arc<str>, FileId>,
}

impl Gathered {
    /// Adds diagnostics whose spans are places in `sources`.
    pub(super) fn add(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        for said in diagnostics {
            let mut said = said.clone();
            self.rename(&mut said.span, sources);
            for related in &mut said.related {
                if let Some(span) = &mut related.span {
                    self.rename(span, sources);
                }
            }
            for edit in said.fix.iter_mut().flat_map(|fix| &mut fix.edits) {
                self.rename(&mut edit.span, sources);
            }
            self.diagnostics.push(said);
        }
    }

    fn rename(&mut self, span: &mut Span, sources: &Sources) {
        let Some(source) = sources.get(span.file) else { return };
        span.file = match self.known.get(&source.name) {
            Some(known) => *known,
            None => {
                let file = self.sources.add(source.clone());
                self.known.insert(Arc::clone(&source.name), file);
                file
            }
        };
    }
}
