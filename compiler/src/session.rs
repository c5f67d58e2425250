//! What a host holds on to: a library and a world, made once, against which any number of documents is checked.

use std::sync::{Arc, OnceLock};

use motet_graph::{Graph, Value};
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::ast::{File, Item, Policy};
use motet_syntax::{Diagnostic, Parsed, Related, Severity, Sources, Span};
use smol_str::SmolStr;

use crate::check::errors::{NoPolicy, OtherRobot, UnknownRobot};
use crate::fix::Finding;
use crate::ir::{Program, StepKind, Term};
use crate::library::{Library, LibraryBuilder};
use crate::place::{Access, Course, Geometry, Placed};
use crate::prove::Proof;
use crate::resolve::near::{list, near};
use crate::signature::Signatures;
use crate::world::{State, World};

/// Settings of a check.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Options {
    /// The longest that a policy may take, in seconds.
    pub max_duration_secs: Option<f64>,
}

/// A library and a world. Cheap to copy: both are shared.
#[derive(Clone, Debug)]
pub struct Session {
    builder: Arc<LibraryBuilder>,
    library: Arc<Library>,
    world: Arc<World>,
    state: Option<Arc<State>>,
    options: Options,
    geometry: Option<Arc<Geometry>>,
    /// Made when they are first asked for.
    signatures: Arc<OnceLock<Arc<Signatures>>>,
}

/// A fact that is known at the start.
#[derive(Clone, PartialEq, Debug)]
pub struct Given {
    /// The fluent.
    pub fluent: SmolStr,
    /// Its arguments, entities or cases; none stands for any entity.
    pub args: Vec<Option<Value>>,
    /// Whether it holds.
    pub holds: bool,
}

/// What compiling a document gave.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The graph; none where there is an error.
    pub graph: Option<Graph>,
    /// What there is to say, in the order of the document.
    pub diagnostics: Vec<Diagnostic>,
    /// Motions that were not looked at because of errors before them; none where there is a graph, which has a verdict of each.
    pub unseen: usize,
}

impl Session {
    /// Prepares a robot's library with the domains on top, and the world of a scene and a state. The diagnostics are
    /// about these inputs; the files of the library are added to `sources`.
    #[must_use]
    pub fn new(
        robot: Option<&Robot>,
        domains: &[File],
        scene: Option<&Scene>,
        state: Option<&State>,
        options: Options,
        sources: &mut Sources,
    ) -> (Self, Vec<Diagnostic>) {
        let mut builder = Library::builder(robot, sources);
        if !domains.is_empty() {
            builder.layer(domains);
        }
        let (library, mut diagnostics) = builder.clone().build();
        let (world, said) = World::new(&library, scene, state);
        diagnostics.extend(said);
        let session = Self {
            builder: Arc::new(builder),
            library: Arc::new(library),
            world: Arc::new(world),
            state: state.cloned().map(Arc::new),
            options,
            geometry: None,
            signatures: Arc::default(),
        };
        (session, diagnostics)
    }

    /// The same library in another scene and state, without geometry: much cheaper than a new session, since nothing is
    /// read again. The diagnostics are about the scene and the state.
    #[must_use]
    pub fn elsewhere(&self, scene: Option<&Scene>, state: Option<&State>) -> (Self, Vec<Diagnostic>) {
        let (world, diagnostics) = World::new(&self.library, scene, state);
        // Facts say nothing of what a policy can be made of.
        let signatures =
            if world.speaks_as(&self.world) { Arc::clone(&self.signatures) } else { Arc::default() };
        let session = Self {
            world: Arc::new(world),
            state: state.cloned().map(Arc::new),
            geometry: None,
            signatures,
            ..self.clone()
        };
        (session, diagnostics)
    }

    /// The same session, which also answers motions. The geometry is that of the session's robot, scene and state; it may be
    /// shared, and keeps what it has answered. Without it every motion is deferred.
    #[must_use]
    pub fn with_geometry(mut self, geometry: Arc<Geometry>) -> Self {
        self.geometry = Some(geometry);
        self
    }

    /// Whether motions are answered.
    #[must_use]
    pub fn has_geometry(&self) -> bool {
        self.geometry.is_some()
    }

    /// Whether the robot can get at a thing from where it is, see [`Geometry::access`]; none without geometry.
    #[must_use]
    pub fn access(&self, id: &str) -> Option<Access> {
        Some(self.geometry.as_ref()?.access(id))
    }

    /// The world of a run that begins in this session's, for motions that are left to it. None without geometry.
    #[must_use]
    pub fn course(&self) -> Option<Course> {
        Some(Course::new(Arc::clone(&self.library), Arc::clone(self.geometry.as_ref()?)))
    }

    /// The declarations in force.
    #[must_use]
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Whether a text is a description of anything in the scene.
    #[must_use]
    pub fn describes(&self, text: &str) -> bool {
        self.world.is_description(text)
    }

    /// What a policy for this robot and scene can be made of. Made once for all sessions that come from one another with the
    /// same entities: those have the same [`Arc`].
    #[must_use]
    pub fn signatures(&self) -> Arc<Signatures> {
        let made = || Arc::new(Signatures::new(&self.library, &self.world));
        Arc::clone(self.signatures.get_or_init(made))
    }

    /// What is known at the start, facts with their values, in order: a later one wins, and one with an argument that is
    /// none is meant of every entity.
    pub fn given(&self) -> impl Iterator<Item = Given> {
        self.world.given.iter().filter_map(|(fact, holds)| {
            let def = self.library.fluent(fact.fluent)?;
            let args = fact.args.iter().map(|arg| match arg {
                None => Some(None),
                Some(Term::Entity(entity)) => Some(Some(Value::Entity(self.world.name(*entity)))),
                Some(Term::Case(of, case)) => {
                    let cases = &self.library.enums.get(of.index())?.cases;
                    Some(Some(Value::Case(cases.get(usize::from(*case))?.clone())))
                }
                Some(_) => None,
            });
            Some(Given { fluent: def.name.clone(), args: args.collect::<Option<_>>()?, holds: *holds })
        })
    }

    /// The library and the world.
    pub(crate) fn parts(&self) -> (&Library, &World) {
        (&self.library, &self.world)
    }

    /// The world at the start.
    pub(crate) fn world(&self) -> &World {
        &self.world
    }

    /// What is wrong with the things that a motion names which is asked for without a policy, each with its place, as a call of a
    /// primitive with this motion would be told; nothing for a motion that the robot has no primitive with.
    #[must_use]
    pub fn check_motion(&self, name: &str, args: &[(SmolStr, Span)]) -> Vec<Diagnostic> {
        crate::resolve::motion::check_motion(name, args, &self.library, &self.world)
    }

    /// Everything there is to say about a document: its front end's findings and those of every policy in it.
    #[must_use]
    pub fn check(&self, parsed: &Parsed) -> Vec<Diagnostic> {
        let findings = self.findings(parsed, self.geometry.as_deref());
        findings.into_iter().map(|finding| finding.diagnostic).collect()
    }

    /// What is wrong with the names, the types and the bounds of a document of one policy, and with what it asks of the
    /// robot: what can be said without following its state. Cheaper than [`Self::check`], of which it is a part.
    #[must_use]
    pub fn check_names(&self, parsed: &Parsed) -> Vec<Diagnostic> {
        let mut diagnostics = parsed.diagnostics.clone();
        for policy in parsed.file.policies() {
            let (mut program, said) =
                crate::resolve::resolve(policy, parsed.syntax, &self.library, &self.world);
            diagnostics.extend(said);
            let limit = self.options.max_duration_secs;
            diagnostics.extend(crate::check::check(&mut program, &self.library, &self.world, limit));
        }
        diagnostics
    }

    /// As [`Self::check`], each finding with all the ways that are known to mend it, with geometry where it is given.
    pub(crate) fn findings(&self, parsed: &Parsed, geometry: Option<&Geometry>) -> Vec<Finding> {
        let mut diagnostics = parsed.diagnostics.clone();
        let mut findings = Vec::new();
        self.within(parsed, &mut diagnostics, |library, world, _| {
            for policy in parsed.file.policies() {
                findings.extend(self.analyse(policy, parsed, library, world, geometry).findings);
            }
        });
        findings.extend(diagnostics.into_iter().map(Finding::from));
        finish(findings)
    }

    /// Compiles the policy with a name, or the one policy without parameters.
    #[must_use]
    pub fn compile(&self, parsed: &Parsed, name: Option<&str>) -> Compiled {
        let mut diagnostics = parsed.diagnostics.clone();
        let mut findings = Vec::new();
        let (mut graph, mut unseen) = (None, 0);
        self.within(parsed, &mut diagnostics, |library, world, diagnostics| {
            let runnable = || parsed.file.runnable();
            let chosen = match name {
                Some(name) => runnable().find(|policy| policy.name.text == name),
                None => runnable().next().filter(|_| runnable().count() == 1),
            };
            let Some(policy) = chosen else {
                let span = parsed.file.items.first().map_or_else(Span::default, Item::span);
                let known = runnable().map(|policy| policy.name.text.clone()).collect();
                if !diagnostics.iter().any(|said| said.severity == Severity::Error) {
                    diagnostics.push(NoPolicy { span, wanted: name.map(Into::into), known }.into());
                }
                return;
            };
            let analysed = self.analyse(policy, parsed, library, world, self.geometry.as_deref());
            let Analysed { program, proof, placed, findings: said, is_placed } = analysed;
            let is_refused = diagnostics.iter().any(is_error) || has_errors(&said);
            findings = said;
            if is_refused && !is_placed {
                unseen = motions(&program, library);
            }
            if !is_refused {
                graph = Some(crate::lower::lower(&program, &proof, placed, library, world));
            }
        });
        findings.extend(diagnostics.into_iter().map(Finding::from));
        let diagnostics = finish(findings).into_iter().map(|finding| finding.diagnostic).collect();
        Compiled { graph, diagnostics, unseen }
    }

    /// Runs with the library and the world of a document: the session's own, unless it declares something itself.
    fn within(
        &self,
        parsed: &Parsed,
        diagnostics: &mut Vec<Diagnostic>,
        run: impl FnOnce(&Library, &World, &mut Vec<Diagnostic>),
    ) {
        if matches!(parsed.file.items.as_slice(), [Item::Policy(policy)] if policy.params.is_empty()) {
            return run(&self.library, &self.world, diagnostics);
        }
        let mut builder = LibraryBuilder::clone(&self.builder);
        builder.layer(std::slice::from_ref(&parsed.file));
        let (library, said) = builder.build();
        let file = parsed.file.items.first().map(|item| item.span().file);
        // What is wrong with the layers below was said when they were read.
        diagnostics.extend(said.into_iter().filter(|said| Some(said.span.file) == file));
        let (world, _) = World::new(&library, self.world.scene(), self.state.as_deref());
        run(&library, &world, diagnostics);
    }

    fn analyse(
        &self,
        policy: &Policy,
        parsed: &Parsed,
        library: &Library,
        world: &World,
        geometry: Option<&Geometry>,
    ) -> Analysed {
        let (mut program, mut diagnostics) = crate::resolve::resolve(policy, parsed.syntax, library, world);
        diagnostics.extend(other_robot(policy, library));
        diagnostics.extend(crate::check::check(&mut program, library, world, self.options.max_duration_secs));
        let (proof, said, offers) = crate::prove::prove(&program, library, world);
        diagnostics.extend(said);
        let mut findings = crate::fix::findings(diagnostics, &offers, parsed, &program, library, world);
        let mut placed = Placed::new();
        // What goes before an error was not what was meant, so nothing is said of how it ends.
        let geometry = geometry.filter(|_| !has_errors(&findings));
        if let Some(geometry) = geometry {
            let (found, said) = crate::place::place(&program, &proof, library, world, geometry);
            placed = found;
            findings.extend(said.into_iter().map(Finding::from));
        }
        for finding in &mut findings {
            locate(&mut finding.diagnostic, policy, &program, library);
        }
        Analysed { program, proof, placed, findings, is_placed: geometry.is_some() }
    }
}

/// What the stages made of a policy.
struct Analysed {
    program: Program,
    proof: Proof,
    placed: Placed,
    findings: Vec<Finding>,
    /// Whether motions were looked at.
    is_placed: bool,
}

/// How many calls of a program ask for a motion.
fn motions(program: &Program, library: &Library) -> usize {
    let calls = program.steps.iter().filter_map(|step| {
        let StepKind::Call(call) = &step.kind else { return None };
        library.primitive(call.primitive)
    });
    calls.filter(|def| def.motion.is_some()).count()
}

fn is_error(said: &Diagnostic) -> bool {
    said.severity == Severity::Error
}

fn has_errors(findings: &[Finding]) -> bool {
    findings.iter().any(|found| is_error(&found.diagnostic))
}

/// What is wrong where a policy is written for another robot than the library's, or for one that is neither given nor built
/// in.
pub(crate) fn other_robot(policy: &Policy, library: &Library) -> Option<Diagnostic> {
    let robot = policy.robot.as_ref()?;
    let (span, name) = (robot.span, robot.text.clone());
    if !library.robot.is_empty() {
        let given = library.robot.clone();
        return (name != given).then(|| OtherRobot { span, written: name, given }.into());
    }
    let known = || motet_robots::card::embedded().iter().map(|(known, ..)| *known);
    let is_unknown = known().all(|known| name != known);
    is_unknown.then(|| {
        let (near, known) = (near(&name, known()), list(known().map(SmolStr::new_static)));
        UnknownRobot { span, name, near, known }.into()
    })
}

/// Gives a finding its path, and moves one inside an inlined policy of another file to the call.
fn locate(diagnostic: &mut Diagnostic, policy: &Policy, program: &Program, library: &Library) {
    if diagnostic.span.file != policy.span.file
        && let Some(call) = call_site(diagnostic.span, policy, program)
    {
        diagnostic.related.insert(0, Related::new("in this step of the policy", diagnostic.span));
        diagnostic.span = call;
        diagnostic.fix = None;
    }
    let parameter = |callee: &str, position: usize| library.parameter(callee, position);
    let pointer = |span| motet_syntax::pointer::pointer_to(policy, span, &parameter);
    diagnostic.path = pointer(diagnostic.span);
    for related in &mut diagnostic.related {
        if let Some(span) = related.span.filter(|span| span.file == policy.span.file) {
            related.path = pointer(span);
        }
    }
}

/// The call in the document by which a step of another file got here.
fn call_site(span: Span, policy: &Policy, program: &Program) -> Option<Span> {
    let mut step = program.steps.iter().find(|step| step.span.contains(span))?;
    while step.span.file != policy.span.file {
        step = program.step(step.place.parent?)?;
    }
    matches!(step.kind, StepKind::Inline { .. }).then_some(step.span)
}

/// In the order of the document, each finding once.
fn finish(mut findings: Vec<Finding>) -> Vec<Finding> {
    findings.sort_by_key(|found| {
        let said = &found.diagnostic;
        (said.span, std::cmp::Reverse(said.severity), said.code)
    });
    findings.dedup_by(|a, b| {
        let (a, b) = (&a.diagnostic, &b.diagnostic);
        a.code == b.code && a.span == b.span && a.message == b.message
    });
    findings
}
