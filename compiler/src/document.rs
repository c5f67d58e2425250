//! Checks of documents: the stages in order, for every policy of a document or for one.
//!
//! The only place that knows the order of the stages. Fed by `motet_syntax::read`; [`crate::fix`] applies
//! the fixes.

use std::sync::Arc;

use motet_graph::Graph;
use motet_syntax::ast::{Item, Policy};
use motet_syntax::effort::ErrorCount;
use motet_syntax::{Diagnostic, Parsed, Related, Severity, Span};
use smol_str::SmolStr;

use crate::declare::{Library, LibraryBuilder, MAX_DECLARATIONS};
use crate::environment::Environment;
use crate::facts::effort;
use crate::feasibility::{Geometry, MotionVerdict, MotionVerdicts};
use crate::ir::{Program, StepKind};
use crate::limits::diagnostics::NoPolicy;
use crate::lower::StepInspection;
use crate::prove::{GoalVerdict, Proof};
use crate::repair::{Finding, RepairFinder, RepairSearch};
use crate::session::Session;

/// Result of compiling one policy of a document.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The execution graph; `None` after an error.
    pub graph: Option<Graph>,
    /// Diagnostics in the order of the document.
    pub diagnostics: Vec<Diagnostic>,
    /// Number of motion checks skipped because of earlier errors; 0 when `graph` is `Some`.
    pub skipped_motions: usize,
}

/// Result of checking a document: diagnostics, and the outcome of each policy.
#[derive(Clone, Debug)]
pub struct DocumentCheck {
    /// Diagnostics of the document and of all its policies, in the order of the document.
    pub diagnostics: Vec<Diagnostic>,
    /// Outcomes of the policies without parameters, in the order of the document.
    pub policies: Vec<PolicyOutcome>,
    /// Notes on what policies without errors and parameters leave to the run, in the order of the document:
    /// needs that stay unknown, which the engine checks just before their steps.
    pub deferred_notes: Vec<Diagnostic>,
}

/// Outcome of one policy of a document.
#[derive(Clone, Debug)]
pub struct PolicyOutcome {
    /// Name of the policy.
    pub name: SmolStr,
    /// False if the policy, or the document around it, has errors: then it does not compile.
    pub passes: bool,
    /// Number of motions that are left to the run; 0 unless it passes.
    pub deferred_motions: usize,
    /// Number of motion checks skipped because of earlier errors; 0 if it passes.
    pub skipped_motions: usize,
}

impl Session {
    /// Checks a document and all its policies, each once, and returns the diagnostics in the order of the
    /// document.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::{FileId, Source, Sources};
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// let source = Source::new("greet.motet", "policy greet { sya(\"hello\") }");
    /// let diagnostics = session.check(&motet_syntax::read(&source, FileId(99)));
    /// assert_eq!(diagnostics[0].message, "there is no primitive or policy `sya`");
    /// assert_eq!(diagnostics[0].help.as_deref(), Some("did you mean `say`?"));
    /// ```
    #[must_use]
    pub fn check(&self, parsed: &Parsed) -> Vec<Diagnostic> {
        limited(self.findings(parsed, self.geometry.as_deref(), RepairSearch::Best))
    }

    /// Checks a document, and tells of each of its policies without parameters if it compiles. Each policy is
    /// analysed once.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::{FileId, Source, Sources};
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// let source = Source::new("two.motet", "policy one { say(\"1\") } policy two { sya(\"2\") }");
    /// let check = session.check_document(&motet_syntax::read(&source, FileId(99)));
    /// assert!(check.policies[0].passes);
    /// assert!(!check.policies[1].passes);
    /// ```
    #[must_use]
    pub fn check_document(&self, parsed: &Parsed) -> DocumentCheck {
        self.document(parsed, &mut |_, _, _| {})
    }

    /// Checks a document as [`Self::check_document`] does, and inspects the steps of its policies, in the
    /// order of the document.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::{FileId, Source, Sources};
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// let source = Source::new("greet.motet", "policy greet { say(\"hello\") }");
    /// let (_, steps) = session.inspect_document(&motet_syntax::read(&source, FileId(99)));
    /// assert_eq!(source.slice(steps[0].span), "say(\"hello\")");
    /// assert!(steps[0].call.as_ref().is_some_and(|call| call.guards.is_empty()));
    /// ```
    #[must_use]
    pub fn inspect_document(&self, parsed: &Parsed) -> (DocumentCheck, Vec<StepInspection>) {
        let mut steps = Vec::new();
        let checked = self.document(parsed, &mut |analysis, library, environment| {
            let Analysis { program, proof, motions, .. } = analysis;
            steps.extend(crate::lower::inspect(program, proof, motions, library, environment));
        });
        (checked, steps)
    }

    /// The session with the declarations of a document, for questions about its policies; without geometry.
    #[must_use]
    pub fn with_declarations(&self, parsed: &Parsed) -> Self {
        let mut session = self.clone();
        self.within(parsed, &mut Vec::new(), |library, environment, _| {
            if !std::ptr::eq(library, &*self.library) {
                session.library = Arc::new(library.clone());
                session.environment = Arc::new(environment.clone());
                session.signatures = Arc::default();
            }
        });
        session.without_geometry()
    }

    fn document(
        &self,
        parsed: &Parsed,
        each: &mut dyn FnMut(&Analysis, &Library, &Environment),
    ) -> DocumentCheck {
        let mut diagnostics = parsed.diagnostics.clone();
        let (mut findings, mut policies, mut left) = (Vec::new(), Vec::new(), Vec::new());
        self.within(parsed, &mut diagnostics, |library, environment, diagnostics| {
            let is_refused = diagnostics.iter().any(is_error);
            let mut errors = ErrorCount::default();
            for policy in parsed.file.policies().take(MAX_DECLARATIONS) {
                if is_too_many(&mut errors, &findings) {
                    break;
                }
                let (geometry, repairs) = (self.geometry.as_deref(), RepairSearch::Best);
                let mut analysis = self.analyse(policy, parsed, library, environment, geometry, repairs);
                each(&analysis, library, environment);
                findings.append(&mut analysis.findings);
                if policy.params.is_empty() {
                    left.extend(analysis.deferred_notes(policy, parsed, library, environment));
                    policies.push(analysis.outcome(policy, is_refused, library));
                }
            }
        });
        findings.extend(diagnostics.into_iter().map(Finding::from));
        let diagnostics = limited(in_order(findings));
        let left = in_order(left.into_iter().map(Finding::from).collect());
        let deferred_notes = left.into_iter().map(|found| found.diagnostic).collect();
        DocumentCheck { diagnostics, policies, deferred_notes }
    }

    /// Returns true if a policy of the document has a goal, can end as done, and reaches the goal at none of
    /// these ends. [`Self::check`] asks for more: it refuses a goal that is false at any of them.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::{FileId, Source, Sources};
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// let misses = |steps: &str| {
    ///     let lamp = "fluent lit(what: Entity) \
    ///         action light(what: Entity) makes lit(what) fails refused \
    ///         action dim(what: Entity) makes not lit(what)";
    ///     let text = format!("{lamp} policy light_up achieves lit(user) {{ {steps} }}");
    ///     session.misses_goal(&motet_syntax::read(&Source::new("light.motet", text), FileId(99)))
    /// };
    /// assert!(!misses("try { light(user) } catch refused { dim(user) }"));
    /// assert!(misses("light(user) dim(user)"));
    /// ```
    #[must_use]
    pub fn misses_goal(&self, parsed: &Parsed) -> bool {
        self.goals(parsed).iter().any(|goal| !goal.may_hold)
    }

    /// Returns true if every policy with a goal is proven to reach it at each end at which it is done.
    #[must_use]
    pub fn proves_goals(&self, parsed: &Parsed) -> bool {
        self.goals(parsed).iter().all(|goal| goal.is_proven)
    }

    /// Verdicts on the goals of the policies that have one and can end as done.
    fn goals(&self, parsed: &Parsed) -> Vec<GoalVerdict> {
        let mut goals = Vec::new();
        self.within(parsed, &mut Vec::new(), |library, environment, _| {
            let analyses = parsed
                .file
                .policies()
                .map(|policy| self.analyse(policy, parsed, library, environment, None, RepairSearch::Skip));
            goals.extend(analyses.filter_map(|analysis| analysis.proof.goal));
        });
        goals
    }

    /// Checks names, types, durations and the robot's limits in a document of one policy, without following
    /// its state. Cheaper than [`Self::check`], of whose diagnostics it returns a part.
    #[must_use]
    pub fn check_names(&self, parsed: &Parsed) -> Vec<Diagnostic> {
        let mut diagnostics = parsed.diagnostics.clone();
        for policy in parsed.file.policies() {
            let (program, more) =
                crate::resolve::resolve(policy, parsed.syntax, &self.library, &self.environment);
            diagnostics.extend(more);
            let limit = self.options.max_duration_secs;
            let (_, more) = crate::limits::check(program, &self.library, &self.environment, limit);
            diagnostics.extend(more);
        }
        diagnostics
    }

    /// As [`Self::check`], each diagnostic with these repairs, and with geometry only where it is given.
    pub(crate) fn findings(
        &self,
        parsed: &Parsed,
        geometry: Option<&Geometry>,
        repairs: RepairSearch,
    ) -> Vec<Finding> {
        let mut diagnostics = parsed.diagnostics.clone();
        let mut findings = Vec::new();
        self.within(parsed, &mut diagnostics, |library, environment, _| {
            let mut errors = ErrorCount::default();
            for policy in parsed.file.policies().take(MAX_DECLARATIONS) {
                if is_too_many(&mut errors, &findings) {
                    break;
                }
                let analysis = self.analyse(policy, parsed, library, environment, geometry, repairs);
                findings.extend(analysis.findings);
            }
        });
        findings.extend(diagnostics.into_iter().map(Finding::from));
        in_order(findings)
    }

    /// Compiles the policy with a name, or the one policy without parameters.
    ///
    /// ```
    /// use motet_compiler::Session;
    /// use motet_syntax::{FileId, Source, Sources};
    ///
    /// let session = Session::builder().build(&mut Sources::default());
    /// let source = Source::new("greet.motet", "policy greet { say(\"hello\") }");
    /// let compiled = session.compile(&motet_syntax::read(&source, FileId(99)), None);
    /// let graph = compiled.graph.expect("the policy has no errors");
    /// assert_eq!(graph.nodes.len(), 1);
    /// ```
    #[must_use]
    pub fn compile(&self, parsed: &Parsed, name: Option<&str>) -> Compiled {
        let mut diagnostics = parsed.diagnostics.clone();
        let mut findings = Vec::new();
        let (mut graph, mut skipped_motions) = (None, 0);
        self.within(parsed, &mut diagnostics, |library, environment, diagnostics| {
            let runnable = || parsed.file.runnable();
            let chosen = match name {
                Some(name) => runnable().find(|policy| policy.name.text == name),
                None => runnable().next().filter(|_| runnable().count() == 1),
            };
            let Some(policy) = chosen else {
                let span = parsed.file.items.first().map_or_else(Span::default, Item::span);
                let known = runnable().map(|policy| policy.name.text.clone()).collect();
                if !diagnostics.iter().any(is_error) {
                    diagnostics.push(NoPolicy { span, wanted: name.map(Into::into), known }.into());
                }
                return;
            };
            let is_refused = diagnostics.iter().any(is_error);
            let (geometry, repairs) = (self.geometry.as_deref(), RepairSearch::Best);
            let mut analysis = self.analyse(policy, parsed, library, environment, geometry, repairs);
            findings.append(&mut analysis.findings);
            (graph, skipped_motions) = analysis.lower(is_refused, library, environment);
        });
        findings.extend(diagnostics.into_iter().map(Finding::from));
        let diagnostics = limited(in_order(findings));
        Compiled { graph, diagnostics, skipped_motions }
    }

    /// Runs with the library and the environment of a document: the session's own, unless the document
    /// declares something.
    fn within(
        &self,
        parsed: &Parsed,
        diagnostics: &mut Vec<Diagnostic>,
        run: impl FnOnce(&Library, &Environment, &mut Vec<Diagnostic>),
    ) {
        let run = |library: &Library, environment: &Environment, found: &mut Vec<Diagnostic>| {
            effort::bounded(parsed.text.len(), || run(library, environment, found));
        };
        if matches!(parsed.file.items.as_slice(), [Item::Policy(policy)] if policy.params.is_empty()) {
            return run(&self.library, &self.environment, diagnostics);
        }
        let mut builder = LibraryBuilder::clone(&self.builder);
        builder.layer(std::slice::from_ref(&parsed.file));
        let (library, more) = builder.build();
        let file = parsed.file.items.first().map(|item| item.span().file);
        // Diagnostics about the layers below were reported when those were read.
        diagnostics.extend(more.into_iter().filter(|found| Some(found.span.file) == file));
        let (environment, _) = Environment::new(&library, self.environment.scene(), self.state.as_deref());
        run(&library, &environment, diagnostics);
    }

    fn analyse(
        &self,
        policy: &Policy,
        parsed: &Parsed,
        library: &Library,
        environment: &Environment,
        geometry: Option<&Geometry>,
        repairs: RepairSearch,
    ) -> Analysis {
        let (program, mut diagnostics) = crate::resolve::resolve(policy, parsed.syntax, library, environment);
        diagnostics.extend(crate::limits::check_robot_name(policy, library));
        let limit = self.options.max_duration_secs;
        let (program, more) = crate::limits::check(program, library, environment, limit);
        diagnostics.extend(more);
        let mut repairs = RepairFinder::new(repairs);
        let (proof, more) = crate::prove::prove(&program, library, environment, &mut repairs);
        diagnostics.extend(more);
        let mut findings = repairs.findings(diagnostics, parsed, &program, library, environment);
        let mut motions = MotionVerdicts::new();
        // Behind an error the worlds are not those that were meant, so their motions are not checked.
        let geometry = geometry.filter(|_| !has_errors(&findings));
        if let Some(geometry) = geometry {
            let (verdicts, more) =
                crate::feasibility::check(&program, &proof, library, environment, geometry);
            motions = verdicts;
            findings.extend(more.into_iter().map(Finding::from));
        }
        findings.retain(|found| !is_in_broken_text(&found.diagnostic, parsed));
        for finding in &mut findings {
            locate(&mut finding.diagnostic, policy, parsed, &program, library);
        }
        let has_errors = has_errors(&findings);
        Analysis { program, proof, motions, findings, has_errors, are_motions_checked: geometry.is_some() }
    }
}

/// Results of the stages for one policy.
struct Analysis {
    program: Program,
    proof: Proof,
    motions: MotionVerdicts,
    findings: Vec<Finding>,
    has_errors: bool,
    are_motions_checked: bool,
}

impl Analysis {
    /// Notes on what the policy leaves to the run; none after an error.
    fn deferred_notes(
        &self,
        policy: &Policy,
        parsed: &Parsed,
        library: &Library,
        environment: &Environment,
    ) -> Vec<Diagnostic> {
        if self.has_errors {
            return Vec::new();
        }
        let Self { program, proof, motions, .. } = self;
        let mut notes = crate::lower::deferred_notes(program, proof, motions, library, environment);
        for note in &mut notes {
            locate(note, policy, parsed, program, library);
        }
        notes
    }

    /// Outcome of the policy, of which `is_refused` says that the document around it has an error.
    fn outcome(&self, policy: &Policy, is_refused: bool, library: &Library) -> PolicyOutcome {
        let name = policy.name.text.clone();
        if is_refused || self.has_errors {
            let skipped_motions = self.skipped_motions(library);
            return PolicyOutcome { name, passes: false, deferred_motions: 0, skipped_motions };
        }
        let is_open = |index: &usize| {
            !matches!(self.motions.get(*index).and_then(Option::as_ref), Some(MotionVerdict::Feasible(..)))
        };
        let deferred_motions = calls_with_motions(&self.program, library).filter(is_open).count();
        PolicyOutcome { name, passes: true, deferred_motions, skipped_motions: 0 }
    }

    /// Number of motions that were not checked behind an error.
    fn skipped_motions(&self, library: &Library) -> usize {
        if self.are_motions_checked { 0 } else { calls_with_motions(&self.program, library).count() }
    }

    /// Lowers the program if neither it nor the document has an error; else counts the motions that were
    /// not checked.
    fn lower(self, is_refused: bool, library: &Library, environment: &Environment) -> (Option<Graph>, usize) {
        if is_refused || self.has_errors {
            return (None, self.skipped_motions(library));
        }
        let Self { program, proof, motions, .. } = self;
        (Some(crate::lower::lower(&program, &proof, motions, library, environment)), 0)
    }
}

/// Steps of a program that call a primitive with a motion.
fn calls_with_motions<'a>(program: &'a Program, library: &'a Library) -> impl Iterator<Item = usize> + 'a {
    program.steps.iter().enumerate().filter_map(|(index, step)| {
        let StepKind::Call(call) = &step.kind else { return None };
        library.primitive(call.primitive)?.motion.as_ref().map(|_| index)
    })
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    diagnostic.severity == Severity::Error
}

fn has_errors(findings: &[Finding]) -> bool {
    findings.iter().any(|found| is_error(&found.diagnostic))
}

/// Gives a diagnostic its path in the document, and moves one inside an inlined policy of another file to
/// the call.
fn locate(
    diagnostic: &mut Diagnostic,
    policy: &Policy,
    parsed: &Parsed,
    program: &Program,
    library: &Library,
) {
    if diagnostic.span.file != policy.span.file
        && let Some(call) = call_site(diagnostic.span, policy, program)
    {
        diagnostic.related.insert(0, Related::new("in this step of the policy", diagnostic.span));
        diagnostic.span = call;
        diagnostic.fix = None;
    }
    let parameter = |callee: &str, position: usize| library.parameter(callee, position);
    let pointer = |span| match &parsed.written {
        Some(written) => written.pointer_at(span),
        None => motet_syntax::pointer::pointer_to(policy, span, &parameter),
    };
    diagnostic.path = pointer(diagnostic.span);
    for related in &mut diagnostic.related {
        if let Some(span) = related.span.filter(|span| span.file == policy.span.file) {
            related.path = pointer(span);
        }
    }
}

/// Returns true if a name is called unused (M0901) although a text that could not be read speaks of it.
fn is_in_broken_text(diagnostic: &Diagnostic, parsed: &Parsed) -> bool {
    let name = (diagnostic.code.0 == "M0901").then(|| parsed.text.get(diagnostic.span.range())).flatten();
    let Some(name) = name.map(|name| name.trim_matches(['"', '$', '`'])) else { return false };
    let mut broken = parsed.diagnostics.iter().filter(|said| said.code.0 == "M0123");
    broken.any(|said| {
        let (before, after) = parsed.text.split_at_checked(said.span.start as usize).unwrap_or_default();
        let line = [before.rsplit('\n').next(), after.lines().next()].into_iter().flatten();
        let mut words =
            line.flat_map(|text| text.split(|letter: char| !letter.is_alphanumeric() && letter != '_'));
        words.any(|word| word == name)
    })
}

/// The call in the document through which a step of another file was inlined.
fn call_site(span: Span, policy: &Policy, program: &Program) -> Option<Span> {
    let mut step = program.steps.iter().find(|step| step.span.contains(span))?;
    while step.span.file != policy.span.file {
        step = program.step(step.position.parent?)?;
    }
    matches!(step.kind, StepKind::Inline { .. }).then_some(step.span)
}

/// Returns whether findings have more errors than are told.
fn is_too_many(errors: &mut ErrorCount, findings: &[Finding]) -> bool {
    errors.is_too_many(findings.iter().map(|found| &found.diagnostic))
}

/// The diagnostics of findings, without the errors that are too many.
fn limited(findings: Vec<Finding>) -> Vec<Diagnostic> {
    let mut diagnostics = findings.into_iter().map(|found| found.diagnostic).collect();
    motet_syntax::diagnostics::limit(&mut diagnostics);
    diagnostics
}

/// Findings in the order of the document, without duplicates.
fn in_order(mut findings: Vec<Finding>) -> Vec<Finding> {
    findings.sort_by_key(|found| {
        let diagnostic = &found.diagnostic;
        (diagnostic.span, std::cmp::Reverse(diagnostic.severity), diagnostic.code)
    });
    findings.dedup_by(|a, b| {
        let (a, b) = (&a.diagnostic, &b.diagnostic);
        a.code == b.code && a.span == b.span && a.message == b.message
    });
    findings
}
