//! Edits that mend findings, and the loop that makes them: each is tried in memory, and kept only where the document then
//! checks better.
//!
//! Beside the stages, not one of them: it reads what they found and checks again. Pure, like they are.

mod edit;

use motet_syntax::{Code, Diagnostic, FileId, Parsed, Severity, Source};

use crate::repair::Finding;
use crate::session::Session;

pub use edit::apply;

/// The most documents that are checked to mend one.
const MAX_TRIES: usize = 500;
/// How many edits may be needed together before the document checks better: a mended name can uncover what lies behind.
const MAX_DEPTH: usize = 3;

/// What came of mending a document.
#[derive(Clone, Debug)]
pub struct FixedDocument {
    /// The document.
    pub text: String,
    /// What was done to it, in order.
    pub applied: Vec<AppliedFix>,
    /// The same document, read.
    pub parsed: Parsed,
    /// What is left to say of it, without geometry.
    pub diagnostics: Vec<Diagnostic>,
}

/// One fix that was made.
#[derive(Clone, PartialEq, Debug)]
pub struct AppliedFix {
    /// Of which finding.
    pub code: Code,
    /// What it did: "write `pick`".
    pub title: String,
}

/// Mends a document by at most so many fixes. Each leaves it with fewer errors and no new kind of error, or with as many
/// errors, fewer warnings and no new code; at most 500 documents are checked on the way.
#[must_use]
pub fn fix(session: &Session, source: &Source, file: FileId, most: usize) -> FixedDocument {
    fix_parsed(session, source, motet_syntax::read(source, file), file, most)
}

/// As [`fix`], for a document that was read already.
#[must_use]
pub fn fix_parsed(
    session: &Session,
    source: &Source,
    parsed: Parsed,
    file: FileId,
    most: usize,
) -> FixedDocument {
    let mut tries = MAX_TRIES;
    let mut at = Candidate::new(session, source.text.to_string(), parsed);
    let mut applied = Vec::new();
    while applied.len() < most {
        let depth = MAX_DEPTH.min(most - applied.len() - 1);
        let Some((next, done)) = better(session, source, file, &at, &at, depth, &mut tries) else { break };
        applied.extend(done);
        at = next;
    }
    let diagnostics = at.findings.into_iter().map(|found| found.diagnostic).collect();
    FixedDocument { text: at.text, parsed: at.parsed, applied, diagnostics }
}

/// A document and what is found in it.
struct Candidate {
    text: String,
    parsed: Parsed,
    findings: Vec<Finding>,
}

impl Candidate {
    fn of(session: &Session, text: String, source: &Source, file: FileId) -> Self {
        let parsed = motet_syntax::read(&Source::new(source.name.clone(), text.as_str()), file);
        Self::new(session, text, parsed)
    }

    fn new(session: &Session, text: String, parsed: Parsed) -> Self {
        Self { findings: session.findings(&parsed, None), text, parsed }
    }

    fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|found| found.diagnostic.severity == severity).count()
    }

    /// Whether it checks better than another: fewer errors and no new code of an error, or as many errors, fewer
    /// warnings, and no new code. A step that repairs an error may be one that a lint has a word on.
    fn is_better_than(&self, other: &Self) -> bool {
        let counts = |state: &Self| (state.count(Severity::Error), state.count(Severity::Warning));
        let fewer_errors = counts(self).0 < counts(other).0;
        let may_be = |found: &Finding| {
            (fewer_errors && found.diagnostic.severity != Severity::Error)
                || other.findings.iter().any(|known| known.diagnostic.code == found.diagnostic.code)
        };
        counts(self) < counts(other) && self.findings.iter().all(may_be)
    }
}

/// The first document that is better than `base` by mending `at`, with what was done. Errors are tried before warnings.
fn better(
    session: &Session,
    source: &Source,
    file: FileId,
    base: &Candidate,
    at: &Candidate,
    depth: usize,
    tries: &mut usize,
) -> Option<(Candidate, Vec<AppliedFix>)> {
    let mut order: Vec<_> = at.findings.iter().collect();
    order.sort_by_key(|found| std::cmp::Reverse(found.diagnostic.severity));
    let mut promising = Vec::new();
    for found in order {
        let said = &found.diagnostic;
        for fix in said.fix.iter().chain(&found.alternatives) {
            *tries = tries.checked_sub(1)?;
            let Some(text) = apply(&at.text, file, fix) else { continue };
            let next = Candidate::of(session, text, source, file);
            let done = AppliedFix { code: said.code, title: fix.title.clone() };
            if next.is_better_than(base) {
                return Some((next, vec![done]));
            }
            // Behind a name or a type that is wrong nothing is proved: mending it can uncover more than it removes.
            let uncovers = ["M01", "M02", "M03"].iter().any(|stage| said.code.0.starts_with(stage));
            let is_no_worse = next.count(Severity::Error) <= base.count(Severity::Error);
            if said.severity == Severity::Error && (uncovers || is_no_worse) {
                promising.push((next, done));
            }
        }
    }
    if depth == 0 {
        return None;
    }
    promising.into_iter().find_map(|(next, done)| {
        let (last, more) = better(session, source, file, base, &next, depth - 1, tries)?;
        Some((last, std::iter::once(done).chain(more).collect()))
    })
}
