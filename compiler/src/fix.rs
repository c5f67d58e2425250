//! Automatic fixes: each is tried in memory, and kept only if the document then checks better.
//!
//! Above the stages: it reads their findings, edits the document and checks it again. Guarded by
//! `tests/tests/it/fix.rs`.

use motet_syntax::{Code, Diagnostic, FileId, Fix, Parsed, Severity, Source};

pub use crate::repair::Applicability;
use crate::repair::{Finding, RepairSearch};
use crate::session::Session;

/// Maximal number of documents that are checked to fix one, and the least.
const MAX_TRIES: usize = 500;
const MIN_TRIES: usize = 8;
/// Maximal length of all documents that are checked to fix one, in bytes, beyond the least number.
const MAX_TRIED_BYTES: usize = 512 << 10;
/// Maximal number of fixes that are combined before the document checks better: a corrected name can uncover
/// an error behind it.
const MAX_DEPTH: usize = 3;

/// A document after its fixes.
#[derive(Clone, Debug)]
pub struct FixedDocument {
    pub text: String,
    /// Applied fixes, in order.
    pub applied: Vec<AppliedFix>,
    /// The same document, read.
    pub parsed: Parsed,
    /// Remaining diagnostics, without geometry.
    pub diagnostics: Vec<Diagnostic>,
}

/// A fix that was applied.
#[derive(Clone, PartialEq, Debug)]
pub struct AppliedFix {
    /// Code of its diagnostic.
    pub code: Code,
    /// Description of the change: "write `pick`".
    pub title: String,
    /// Degree to which it may be applied without asking.
    pub applicability: Applicability,
}

/// Limits of fixing a document.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FixLimits {
    /// Maximal number of fixes.
    pub most: usize,
    /// Least applicability of a fix. What is only shown is never applied.
    pub least: Applicability,
}

impl FixLimits {
    /// At most so many safe fixes.
    #[must_use]
    pub const fn safe(most: usize) -> Self {
        Self { most, least: Applicability::Safe }
    }

    /// At most so many fixes, safe and unsafe.
    #[must_use]
    pub const fn all(most: usize) -> Self {
        Self { most, least: Applicability::Unsafe }
    }
}

/// Writes the shapes of a document in the form of the language (M0122), and applies fixes within limits.
/// Each leaves it with fewer errors and no new kind of error, or with as many errors, fewer warnings and no
/// new code, and with every goal proven that was proven. At most 500 documents are checked on the way, and
/// fewer for a document of more than 1 kB, but at least 8.
///
/// ```
/// use motet_compiler::fix::{FixLimits, fix};
/// use motet_compiler::Session;
/// use motet_syntax::{FileId, Source, Sources};
///
/// let session = Session::builder().build(&mut Sources::default());
/// let source = Source::new("greet.motet", "policy greet { sya(\"hello\") }");
/// let fixed = fix(&session, &source, FileId(99), FixLimits::safe(10));
/// assert_eq!(fixed.text, "policy greet { say(\"hello\") }");
/// assert!(fixed.diagnostics.is_empty());
/// ```
#[must_use]
pub fn fix(session: &Session, source: &Source, file: FileId, limits: FixLimits) -> FixedDocument {
    fix_parsed(session, source, motet_syntax::read(source, file), file, limits)
}

/// As [`fix`], for a document that was already read.
#[must_use]
pub fn fix_parsed(
    session: &Session,
    source: &Source,
    parsed: Parsed,
    file: FileId,
    limits: FixLimits,
) -> FixedDocument {
    let tries = (MAX_TRIED_BYTES / source.text.len().max(1)).clamp(MIN_TRIES, MAX_TRIES);
    let mut search = Search { session, source, file, least: limits.least, tries };
    let mut at = Candidate::new(session, source.text.to_string(), parsed);
    let (mut applied, mut left) = (Vec::new(), limits.most);
    let findings = loop {
        // The shapes of the document, then the notations in what they are read as.
        for _ in 0..2 {
            let Some((next, done)) = at.in_plain_form(session, source, file) else { break };
            applied.extend(done);
            at = next;
        }
        let findings = search.with_repairs(&at);
        let Some(depth) = left.checked_sub(1).map(|left| MAX_DEPTH.min(left)) else { break findings };
        let Some((next, done)) = search.better(&at, (&at, &findings), depth) else { break findings };
        left = left.saturating_sub(done.len());
        applied.extend(done);
        at = next;
    };
    let diagnostics = findings.into_iter().map(|found| found.diagnostic).collect();
    FixedDocument { text: at.text, parsed: at.parsed, applied, diagnostics }
}

/// A diagnostic with all fixes that are known for it.
#[derive(Clone, Debug)]
pub struct FixOffer {
    pub diagnostic: Diagnostic,
    /// Fixes with their applicability, the best first.
    pub fixes: Vec<(Fix, Applicability)>,
}

/// Finds the fixes for each diagnostic of a document, without applying any. Diagnostics without a fix are
/// left out, and so are those about motions.
///
/// ```
/// use motet_compiler::Session;
/// use motet_compiler::fix::offers;
/// use motet_syntax::{FileId, Source, Sources};
///
/// let session = Session::builder().build(&mut Sources::default());
/// let source = Source::new("greet.motet", "policy greet { sya(\"hello\") }");
/// let offers = offers(&session, &motet_syntax::read(&source, FileId(99)));
/// assert_eq!(offers[0].fixes[0].0.title, "write `say`");
/// ```
#[must_use]
pub fn offers(session: &Session, parsed: &Parsed) -> Vec<FixOffer> {
    let findings = session.findings(parsed, None, RepairSearch::All).into_iter();
    let offers = findings.map(|found| {
        let fixes = found.fixes().map(|(fix, applicability)| (fix.clone(), applicability)).collect();
        FixOffer { diagnostic: found.diagnostic, fixes }
    });
    offers.filter(|offer| !offer.fixes.is_empty()).collect()
}

/// A version of the document with its findings, without repairs.
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
        Self { findings: session.findings(&parsed, None, RepairSearch::Skip), text, parsed }
    }

    /// The same document with its shapes in the form of the language, which changes nothing of its meaning.
    fn in_plain_form(
        &self,
        session: &Session,
        source: &Source,
        file: FileId,
    ) -> Option<(Self, Vec<AppliedFix>)> {
        let is_shape = |said: &Diagnostic| said.code.0 == "M0122";
        let has_shapes = self.parsed.written.is_some();
        let notes = self.findings.iter().map(|found| &found.diagnostic);
        let notes = notes.filter(|said| said.severity == Severity::Note && said.fix.is_some());
        let notes = notes.filter(|said| is_shape(said) == has_shapes);
        let (mut edits, mut done) = (Vec::new(), Vec::new());
        for note in notes {
            let fix = note.fix.as_ref()?;
            edits.extend(fix.edits.iter().cloned());
            done.push(record(note.code, fix, Applicability::Safe));
        }
        let is_changed = !edits.is_empty();
        let text = apply(&self.text, file, &Fix { title: String::new(), edits }).filter(|_| is_changed)?;
        Some((Self::of(session, text, source, file), done))
    }

    /// Returns true if a declaration of another version is gone or, unless the fix may take steps away, a
    /// step: then it was not mended but deleted, or the text can no longer be read.
    fn has_lost(&self, other: &Self, applicability: Applicability) -> bool {
        let steps = |state: &Self| {
            let policies = state.parsed.file.policies();
            policies.map(|policy| policy.body.steps.len()).sum::<usize>()
        };
        let items = |state: &Self| state.parsed.file.items.len();
        items(self) < items(other) || applicability == Applicability::Safe && steps(self) < steps(other)
    }

    fn count(&self, severity: Severity) -> usize {
        self.findings.iter().filter(|found| found.diagnostic.severity == severity).count()
    }

    /// Returns whether this version checks better than another: fewer errors and no new code of an error, or
    /// as many errors, fewer warnings, and no new code. A step that repairs an error may raise a lint.
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

fn record(code: Code, fix: &Fix, applicability: Applicability) -> AppliedFix {
    AppliedFix { code, title: fix.title.clone(), applicability }
}

/// Search of fixes for one document.
struct Search<'a> {
    session: &'a Session,
    source: &'a Source,
    file: FileId,
    least: Applicability,
    /// Number of documents that may still be checked.
    tries: usize,
}

impl Search<'_> {
    /// Findings of a version with all repairs.
    fn with_repairs(&self, at: &Candidate) -> Vec<Finding> {
        if at.findings.is_empty() {
            return Vec::new();
        }
        self.session.findings(&at.parsed, None, RepairSearch::All)
    }

    /// Finds the first version that is better than `base`, starting from `at`, with the fixes that lead to
    /// it. Tries errors before warnings.
    fn better(
        &mut self,
        base: &Candidate,
        (at, findings): (&Candidate, &[Finding]),
        depth: usize,
    ) -> Option<(Candidate, Vec<AppliedFix>)> {
        let mut order: Vec<_> = findings.iter().collect();
        order.sort_by_key(|found| std::cmp::Reverse(found.diagnostic.severity));
        let mut promising = Vec::new();
        for found in order {
            let said = &found.diagnostic;
            for (fix, applicability) in found.fixes().filter(|(_, found)| *found >= self.least) {
                self.tries = self.tries.checked_sub(1)?;
                let Some(text) = apply(&at.text, self.file, fix) else { continue };
                let next = Candidate::of(self.session, text, self.source, self.file);
                if next.has_lost(at, applicability) {
                    continue;
                }
                let done = record(said.code, fix, applicability);
                if next.is_better_than(base) && self.keeps_goals(base, &next) {
                    return Some((next, vec![done]));
                }
                // Behind a name or a type that is wrong nothing is proved: mending it can uncover more than
                // it removes.
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
            if self.tries == 0 {
                return None;
            }
            let findings = self.with_repairs(&next);
            let (last, more) = self.better(base, (&next, &findings), depth - 1)?;
            Some((last, std::iter::once(done).chain(more).collect()))
        })
    }

    /// Returns true unless a goal that `base` reaches by proof is no longer proven.
    fn keeps_goals(&self, base: &Candidate, next: &Candidate) -> bool {
        !self.session.proves_goals(&base.parsed) || self.session.proves_goals(&next.parsed)
    }
}

/// Applies all edits of a fix. `None` if an edit is about another file, lies outside the text or within a
/// character, or overlaps another. O(text + edits).
#[must_use]
pub fn apply(text: &str, file: FileId, fix: &Fix) -> Option<String> {
    let mut edits: Vec<_> = fix.edits.iter().collect();
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut done = String::with_capacity(text.len());
    let mut at = 0;
    for edit in edits {
        if edit.span.file != file {
            return None;
        }
        let range = edit.span.range();
        // An overlap is a range that ends before it begins, of which there is no text.
        done.push_str(text.get(at..range.start)?);
        text.get(range.clone())?;
        done.push_str(&edit.text);
        at = range.end;
    }
    done.push_str(text.get(at..)?);
    Some(done)
}

#[cfg(test)]
mod tests {
    use motet_syntax::{Edit, FileId, Fix, Span};

    fn check(edits: &[(usize, usize, &str)], expected: Option<&str>) {
        let edit = |(start, end, text): &(usize, usize, &str)| Edit {
            span: Span::new(FileId(0), *start, *end),
            text: (*text).to_owned(),
        };
        let fix = Fix { title: String::new(), edits: edits.iter().map(edit).collect() };
        assert_eq!(super::apply("añb", FileId(0), &fix).as_deref(), expected);
    }

    #[test]
    fn edits_are_made_together_or_not_at_all() {
        check(&[(3, 4, "c"), (0, 0, "x")], Some("xañc"));
        check(&[(0, 3, ""), (3, 3, "y")], Some("yb"));
        check(&[(0, 3, ""), (1, 4, "")], None);
        check(&[(0, 2, "")], None);
        check(&[(0, 9, "")], None);
        assert!(super::apply("ab", FileId(1), &Fix { title: String::new(), edits: Vec::new() }).is_some());
    }
}
