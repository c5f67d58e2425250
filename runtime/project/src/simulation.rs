//! SimOptions of a simulated run: seed, faults and answers from files, and the entities and facts of a
//! compiled policy.

use std::path::Path;

use motet_compiler::signature::Signatures;
use motet_graph::{FactArg, Graph, Term, Value};
use motet_sim::{Faults, PersonScript, SimOptions};
use motet_syntax::Source;
use motet_syntax::ast::{File, Item};
use smol_str::SmolStr;

use crate::error::{DiagnosticSink, ProjectError};
use crate::fault_names;
use crate::files::read_json;

/// Inputs of a simulated run, read before the policy is known.
#[derive(Debug, Default)]
pub struct SimulationInputs {
    faults: Faults,
    /// File of the faults, for the places of its names.
    source: Option<Source>,
    answers: Vec<Option<String>>,
    seed: u64,
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
        Ok(Self { faults, source, answers, seed })
    }

    /// Checks that the primitives, failures and entities in the file of faults exist.
    ///
    /// # Errors
    ///
    /// [`ProjectError::FaultNames`] with a line for each unknown name.
    pub fn check_names(&self, known: &Signatures) -> Result<(), ProjectError> {
        let unknown = self.source.as_ref().map(|source| fault_names::unknown(source, known));
        match unknown {
            Some(unknown) if !unknown.is_empty() => Err(ProjectError::FaultNames(unknown)),
            Some(_) | None => Ok(()),
        }
    }

    /// SimOptions without a policy. `eye` is the camera's position in the base's frame, in m.
    #[must_use]
    pub fn without_policy(self, eye: Option<[f64; 3]>) -> SimOptions {
        SimOptions {
            seed: self.seed,
            faults: self.faults,
            script: PersonScript { answers: self.answers },
            eye,
            ..SimOptions::default()
        }
    }

    /// SimOptions for a compiled policy. The entities of `files`, the document and its domains, get a place
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
            ..self.without_policy(None)
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
