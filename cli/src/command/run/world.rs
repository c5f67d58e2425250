//! The world that a run moves in: the simulator, with what the flags say of it.

use std::path::Path;

use motet_compiler::signature::Signatures;
use motet_graph::{FactArg, Graph, Term, Value};
use motet_sim::{Faults, PersonScript, SimOptions};
use motet_syntax::ast::{File, Item};
use motet_syntax::json;
use motet_syntax::{FileId, Source, Sources};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use smol_str::SmolStr;

use crate::args::RunArgs;
use crate::document;
use crate::exit::Trouble;
use crate::input::read_small;
use crate::report::Report;

/// What the flags say of the world.
#[derive(Debug)]
pub(super) struct Choices {
    faults: Faults,
    /// The file of faults, where there is one.
    source: Option<Source>,
    answers: Vec<Option<String>>,
    seed: u64,
}

impl Choices {
    /// Reads the files that the flags name.
    ///
    /// # Errors
    ///
    /// One of them cannot be read or has a mistake.
    pub(super) fn read(args: &RunArgs, report: &mut Report) -> Result<Self, Trouble> {
        let (faults, source) = match &args.simulated.faults {
            Some(path) => {
                let (faults, source) = faults(path, report)?;
                (faults, Some(source))
            }
            None => (Faults::default(), None),
        };
        let answers = match &args.answers {
            Some(path) => read(path, "file of answers", report)?.0,
            None => Vec::new(),
        };
        Ok(Self { faults, source, answers, seed: args.simulated.seed })
    }

    /// Whether what the faults name is there.
    ///
    /// # Errors
    ///
    /// What is not, with its places.
    pub(super) fn fit(&self, known: &Signatures) -> Result<(), Trouble> {
        self.source.as_ref().map_or(Ok(()), |source| fit(source, known))
    }

    /// The choices about the simulated world. `files` are the document and the domains, whose entities have a place in it
    /// too.
    pub(super) fn options(self, graph: &Graph, files: &[&File]) -> SimOptions {
        let parent = |kind: &motet_graph::Kind| {
            let parent = graph.kinds.get(kind.parent?.index())?;
            Some((kind.name.clone(), parent.name.clone()))
        };
        SimOptions {
            seed: self.seed,
            faults: self.faults,
            script: PersonScript { answers: self.answers },
            kinds: graph.kinds.iter().filter_map(parent).collect(),
            entities: files.iter().flat_map(|file| entities(file)).collect(),
            initial_facts: graph
                .initial
                .iter()
                .filter_map(|initial| Some((told(graph, &initial.fact)?, initial.value)))
                .collect(),
            // Nobody looks at pictures of it.
            eye: None,
        }
    }
}

/// Reads faults.
fn faults(path: &Path, report: &mut Report) -> Result<(Faults, Source), Trouble> {
    let (_, source) = read::<Faults>(path, "file of faults", report)?;
    // The shape is right; what is left is whether numbers are in range.
    let faults = Faults::from_json(&source.text);
    let faults = faults.map_err(|error| Trouble::Other(format!("`{}`: {error}", path.display())))?;
    Ok((faults, source))
}

/// Reads faults that name only what is there.
pub(super) fn fitting_faults(
    path: &Path,
    known: &Signatures,
    report: &mut Report,
) -> Result<Faults, Trouble> {
    let (faults, source) = faults(path, report)?;
    fit(&source, known)?;
    Ok(faults)
}

/// Whether what a file of faults names is there.
fn fit(source: &Source, known: &Signatures) -> Result<(), Trouble> {
    let wrong = super::faults::wrong(source, known);
    if wrong.is_empty() { Ok(()) } else { Err(Trouble::Other(wrong.join("\n"))) }
}

/// Reads a JSON file that is not about a policy; its diagnostics go to the report.
fn read<T: DeserializeOwned + JsonSchema>(
    path: &Path,
    what: &'static str,
    report: &mut Report,
) -> Result<(T, Source), Trouble> {
    let mut sources = Sources::default();
    let (source, mut said) = document::decode(&path.display().to_string(), &read_small(path)?, FileId(0));
    sources.add(source.clone());
    let (value, more) = json::read::<T>(&source, FileId(0));
    said.extend(more);
    report.usable(what, &said, &sources)?;
    let value = value.ok_or(Trouble::Diagnosed(what))?;
    Ok((value, source))
}

/// The entities that a file declares, with their kind.
fn entities(file: &File) -> Vec<(SmolStr, SmolStr)> {
    let mut found = Vec::new();
    for item in &file.items {
        if let Item::Entities(decl) = item {
            found.extend(decl.names.iter().map(|name| (name.text.clone(), decl.kind.text.clone())));
        }
    }
    found
}

/// A fact that the compiler was told of, as the simulator wants it.
fn told(graph: &Graph, fact: &motet_graph::Fact) -> Option<(SmolStr, Vec<SmolStr>)> {
    let name = graph.fluents.get(fact.fluent.index())?.name.clone();
    let args = fact.args.iter().map(|arg| match arg {
        FactArg::Term(Term::Literal(Value::Entity(id) | Value::Case(id))) => Some(id.clone()),
        FactArg::Term(_) | FactArg::Any => None,
    });
    Some((name, args.collect::<Option<Vec<_>>>()?))
}
