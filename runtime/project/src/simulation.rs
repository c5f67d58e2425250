//! Inputs of a simulated run: seed, faults and answers from files, and the entities and facts of a compiled
//! policy. Each name in a file of faults is looked up before the run, because a fault with an unknown name
//! would silently never happen.

use std::path::Path;

use motet_compiler::signature::Signatures;
use motet_graph::{FactArg, Graph, Term, Value};
use motet_robots::card::CameraMount;
use motet_robots::scene::Scene;
use motet_sim::{Faults, PersonScript, Profile, SimOptions, WorldEvent};
use motet_syntax::ast::{File, Item};
use motet_syntax::located::{Located, LocatedValue, parse_json};
use motet_syntax::{FileId, Source, suggest};
use smol_str::SmolStr;

use crate::error::{DiagnosticSink, ProjectError};
use crate::files::{read_json, read_small};
use crate::project::looks_like_file;

/// Inputs of a simulated run, read before the policy is known.
#[derive(Clone, Debug, Default)]
pub struct SimulationInputs {
    faults: Faults,
    /// File of the faults, for the places of its names.
    source: Option<Source>,
    answers: Vec<Option<String>>,
    seed: u64,
    profile: Profile,
    world: Option<Scene>,
    eye: Option<CameraMount>,
}

/// Reads a profile: a built-in one by its name, or a TOML file.
///
/// ```
/// let profile = motet_project::read_profile("typical")?;
/// assert!(profile.hand.slip > 0.0);
/// assert!(motet_project::read_profile("tipical").is_err());
/// # Ok::<(), motet_project::ProjectError>(())
/// ```
///
/// # Errors
///
/// There is no such profile, the file cannot be read, or a number in it is out of range.
pub fn read_profile(name: &str) -> Result<Profile, ProjectError> {
    if let Some(profile) = Profile::builtin(name) {
        return Ok(profile);
    }
    let path = Path::new(name);
    if !looks_like_file(name) {
        let near = suggest::closest(name, Profile::names());
        let near = near.map_or_else(String::new, |near| format!("did you mean `{near}`? "));
        let names = suggest::one_of(Profile::names());
        let help = format!("{near}built-in profiles: {names}; your own profile is a TOML file");
        return Err(ProjectError::Unknown { what: "profile", name: name.to_owned(), help });
    }
    let bytes = read_small(path)?;
    let text = std::str::from_utf8(&bytes).map_err(|_| ProjectError::NotText { path: path.to_owned() })?;
    Profile::from_toml(text).map_err(|error| ProjectError::Profile { path: path.to_owned(), error })
}

impl SimulationInputs {
    /// Inputs without faults or answers.
    #[must_use]
    pub fn with_seed(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }

    /// Reads the files of faults and of answers.
    ///
    /// # Errors
    ///
    /// A file cannot be read, has another shape, or a number is out of range.
    pub fn read(
        seed: u64,
        faults: Option<&Path>,
        answers: Option<&Path>,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<Self, ProjectError> {
        let (faults, source) = match faults {
            Some(path) => {
                // The shape is checked with diagnostics first; the ranges of numbers remain.
                let (_, source) = read_json::<Faults>(path, "file of faults", sink)?;
                let faults = Faults::from_json(&source.text)
                    .map_err(|error| ProjectError::Faults { path: path.to_owned(), error })?;
                (faults, Some(source))
            }
            None => (Faults::default(), None),
        };
        let answers = match answers {
            Some(path) => read_json(path, "file of answers", sink)?.0,
            None => Vec::new(),
        };
        Ok(Self { faults, source, answers, seed, ..Self::default() })
    }

    /// The same inputs with a profile.
    #[must_use]
    pub fn with_profile(self, profile: Profile) -> Self {
        Self { profile, ..self }
    }

    /// The same inputs with the room as it is, where it differs from the scene that the robot knows.
    #[must_use]
    pub fn with_world(self, world: Option<Scene>) -> Self {
        Self { world, ..self }
    }

    /// The same inputs with the camera of the robot as its joints bear it.
    #[must_use]
    pub fn with_eye(self, eye: Option<CameraMount>) -> Self {
        Self { eye, ..self }
    }

    /// Checks that the primitives, failures and entities in the file of faults exist, and that the entities
    /// are of the right kinds.
    ///
    /// # Errors
    ///
    /// [`ProjectError::FaultNames`] with a line for each name that is unknown or of a wrong kind.
    pub fn check_names(&self, known: &Signatures) -> Result<(), ProjectError> {
        let unknown = self.source.as_ref().map(|source| unknown_names(source, known));
        match unknown {
            Some(unknown) if !unknown.is_empty() => Err(ProjectError::FaultNames(unknown)),
            Some(_) | None => Ok(()),
        }
    }

    /// Options without a policy.
    #[must_use]
    pub fn without_policy(self) -> SimOptions {
        SimOptions {
            seed: self.seed,
            faults: self.faults,
            script: PersonScript { answers: self.answers },
            eye: self.eye,
            profile: self.profile,
            world: self.world,
            ..SimOptions::default()
        }
    }

    /// Options for a compiled policy. The entities of `files`, the document and its domains, get a place
    /// in the simulated scene too.
    #[must_use]
    pub fn for_policy(self, graph: &Graph, files: &[&File]) -> SimOptions {
        let parent = |kind: &motet_graph::Kind| {
            let parent = graph.kinds.get(kind.parent?.index())?;
            Some((kind.name.clone(), parent.name.clone()))
        };
        SimOptions {
            kinds: graph.kinds.iter().filter_map(parent).collect(),
            entities: files.iter().flat_map(|file| entities(file)).collect(),
            initial_facts: graph
                .initial
                .iter()
                .filter_map(|initial| Some((initial_fact(graph, &initial.fact)?, initial.value)))
                .collect(),
            ..self.without_policy()
        }
    }
}

/// Entities that a file declares, with their kinds.
fn entities(file: &File) -> Vec<(SmolStr, SmolStr)> {
    let mut found = Vec::new();
    for item in &file.items {
        if let Item::Entities(decl) = item {
            found.extend(decl.names.iter().map(|name| (name.text.clone(), decl.kind.text.clone())));
        }
    }
    found
}

/// Name and arguments of an initial fact; `None` if an argument is not an entity or an enum case.
fn initial_fact(graph: &Graph, fact: &motet_graph::Fact) -> Option<(SmolStr, Vec<SmolStr>)> {
    let name = graph.fluents.get(fact.fluent.index())?.name.clone();
    let args = fact.args.iter().map(|arg| match arg {
        FactArg::Term(Term::Literal(Value::Entity(id) | Value::Case(id))) => Some(id.clone()),
        FactArg::Term(_) | FactArg::Any => None,
    });
    Some((name, args.collect::<Option<Vec<_>>>()?))
}

/// Category of a name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum NameKind {
    Primitive,
    Failure,
    /// Entity of a kind with this name.
    Entity(&'static str),
}

/// Describes each name of a file of faults that is unknown or of a wrong kind, in a line with its place.
fn unknown_names(source: &Source, known: &Signatures) -> Vec<String> {
    let (tree, _) = parse_json(&source.text, FileId(0));
    let mut names = Vec::new();
    if let Some(tree) = &tree {
        collect_names(tree, &mut names);
    }
    names.into_iter().filter_map(|(kind, name)| describe_unknown(source, kind, name, known)).collect()
}

/// Collects the values of the keys that hold a name. The shape of the file has been checked before.
fn collect_names<'t>(tree: &'t Located<'_>, names: &mut Vec<(NameKind, &'t Located<'t>)>) {
    if let LocatedValue::Array(items) = &tree.value {
        items.iter().for_each(|item| collect_names(item, names));
    }
    for (key, value) in tree.members() {
        let kind = match key.text() {
            Some("primitive") => Some(NameKind::Primitive),
            Some("fails" | "refuses") => Some(NameKind::Failure),
            Some(key) => WorldEvent::kind_at(key).map(NameKind::Entity),
            None => None,
        };
        match kind {
            Some(NameKind::Failure) if value.text().is_none() => {
                let kinds = value.members().iter().filter(|(key, _)| key.text() == Some("kind"));
                names.extend(kinds.map(|(_, kind)| (NameKind::Failure, kind)));
            }
            Some(kind) => names.push((kind, value)),
            None => collect_names(value, names),
        }
    }
}

fn describe_unknown(
    source: &Source,
    kind: NameKind,
    name: &Located<'_>,
    known: &Signatures,
) -> Option<String> {
    let text = name.text()?;
    let primitives = known.callables.iter().filter(|callable| !callable.is_policy);
    let (what, all): (_, Vec<&str>) = match kind {
        NameKind::Primitive => ("primitive", primitives.map(|callable| callable.name.as_str()).collect()),
        NameKind::Failure => ("failure", known.failures.iter().map(SmolStr::as_str).collect()),
        NameKind::Entity(_) => ("entity", known.entities.iter().map(|(name, _)| name.as_str()).collect()),
    };
    // Counting lines takes the whole text: only for what is told.
    let place = || {
        let (line, column) = source.line_column(name.span.start);
        format!("{}:{line}:{column}", source.name)
    };
    if all.contains(&text) {
        let NameKind::Entity(wanted) = kind else { return None };
        let number = known.kinds.iter().position(|kind| kind.name == wanted)?;
        let (_, of) = known.entities.iter().find(|(name, _)| name == text)?;
        let found = &known.kinds.get(*of).filter(|_| !known.is_kind(*of, number))?.name;
        return Some(format!("{}: `{text}` is of the kind {found}; the kind must be {wanted}", place()));
    }
    let near =
        suggest::closest(text, all).map_or_else(String::new, |near| format!(": did you mean `{near}`?"));
    Some(format!("{}: there is no {what} `{text}`{near}", place()))
}
