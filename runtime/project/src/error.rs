//! Errors of opening a project, and the receiver of diagnostics about its files.

use std::io;
use std::path::PathBuf;

use motet_syntax::ast::MAX_BYTES;
use motet_syntax::{Diagnostic, Severity, Sources};
use thiserror::Error;

/// Reason why a robot, a scene, a state or a domain cannot be used.
#[derive(Error, Debug)]
#[non_exhaustive]
pub enum ProjectError {
    /// The operating system refuses to read a file or folder.
    #[error("cannot read `{}`: {}", path.display(), reason(source))]
    Read { path: PathBuf, source: io::Error },
    /// The path of a file names a folder.
    #[error("`{}` is a folder; expected a file", path.display())]
    Folder { path: PathBuf },
    /// The path of a file names a named pipe, a device or a socket, which need not end.
    #[error("`{}` is no regular file; give the output of a pipe as `-` or `/dev/stdin`", path.display())]
    Irregular { path: PathBuf },
    /// A file exceeds the size limit of the readers.
    #[error("`{}` is larger than {} MiB", path.display(), MAX_BYTES >> 20)]
    TooLarge { path: PathBuf },
    /// A file of declarations is not UTF-8 text.
    #[error("`{}` is not UTF-8 text", path.display())]
    NotText { path: PathBuf },
    /// A `motet.toml` is not TOML of its form, or a number in it is out of range.
    #[error("`{}`: {problem}", path.display())]
    Config { path: PathBuf, problem: String },
    /// A card names a file that is neither in its folder nor in one of its packages.
    #[error("`{}` is not in the robot's folder", path.display())]
    Outside { path: PathBuf },
    /// A robot's folder has no `robot.toml`.
    #[error("the folder `{}` has no robot.toml", path.display())]
    NoCard { path: PathBuf },
    /// No robot or scene has this name.
    #[error("there is no {what} `{name}`")]
    Unknown { what: &'static str, name: String, help: String },
    /// A file has errors; `diagnostics` holds them, with spans in `sources`.
    #[error("the {subject} cannot be used: {}", first(diagnostics))]
    Invalid { subject: &'static str, diagnostics: Vec<Diagnostic>, sources: Box<Sources> },
    /// A file of faults names primitives, failures or entities that do not exist, one per line.
    #[error("{}", .0.join("\n"))]
    FaultNames(Vec<String>),
    /// A number in a file of faults is out of range.
    #[error("`{}`: {error}", path.display())]
    Faults { path: PathBuf, error: motet_sim::FaultsError },
    /// A profile is not TOML of its form, or a number in it is out of range.
    #[error("`{}`: {error}", path.display())]
    Profile { path: PathBuf, error: motet_sim::ProfileError },
    /// A card as JSON is no JSON object, or has values that TOML does not have.
    #[error("the card of the robot cannot be used: {0}")]
    Card(String),
    /// A state has a fact that the scene cannot show.
    #[error("{0}")]
    State(String),
    /// A journal does not describe its driver, or was written by another host.
    #[error("{0}")]
    Journal(String),
}

impl ProjectError {
    /// Advice on how to correct the error, where one is known.
    #[must_use]
    pub fn help(&self) -> Option<&str> {
        match self {
            Self::Unknown { help, .. } => Some(help),
            Self::NoCard { .. } => {
                Some("a robot's folder holds robot.toml, and primitives.motet if its signatures differ")
            }
            Self::Outside { .. } => Some("copy it there, or add its folder to `packages` of the card"),
            Self::State(_) => Some("say in the scene where things are, by their poses"),
            Self::TooLarge { .. } => Some("split it into several files"),
            Self::Config { .. } => Some(
                "its keys are robot, scene, state, domains, clearance, max_duration, geometry and effort",
            ),
            _ => None,
        }
    }

    /// Diagnostics of the file that cannot be used; empty for all errors but [`ProjectError::Invalid`].
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match self {
            Self::Invalid { diagnostics, .. } => diagnostics,
            _ => &[],
        }
    }
}

fn first(diagnostics: &[Diagnostic]) -> &str {
    diagnostics.first().map_or("it cannot be read", |error| error.message.as_str())
}

/// Describes an error of the operating system in the wording of the other messages.
#[must_use]
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}

/// Receiver of the diagnostics about the files of a project, warnings included.
///
/// A `Vec<Diagnostic>` collects them; [`Discard`] drops them.
pub trait DiagnosticSink {
    /// Takes diagnostics whose spans are places in `sources`.
    fn report(&mut self, diagnostics: &[Diagnostic], sources: &Sources);
}

impl DiagnosticSink for Vec<Diagnostic> {
    fn report(&mut self, diagnostics: &[Diagnostic], _sources: &Sources) {
        self.extend_from_slice(diagnostics);
    }
}

/// Sink that drops every diagnostic. Errors still end in [`ProjectError::Invalid`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Discard;

impl DiagnosticSink for Discard {
    fn report(&mut self, _diagnostics: &[Diagnostic], _sources: &Sources) {}
}

/// Reports the diagnostics of a file, and refuses it if one of them is an error.
///
/// # Errors
///
/// [`ProjectError::Invalid`] with the errors.
pub fn require(
    subject: &'static str,
    diagnostics: &[Diagnostic],
    sources: &Sources,
    sink: &mut dyn DiagnosticSink,
) -> Result<(), ProjectError> {
    sink.report(diagnostics, sources);
    let errors: Vec<_> =
        diagnostics.iter().filter(|found| found.severity == Severity::Error).cloned().collect();
    if errors.is_empty() { Ok(()) } else { Err(invalid(subject, errors, sources)) }
}

/// Refusal of a file with these errors, which have been reported.
pub(crate) fn invalid(
    subject: &'static str,
    diagnostics: Vec<Diagnostic>,
    sources: &Sources,
) -> ProjectError {
    ProjectError::Invalid { subject, diagnostics, sources: Box::new(sources.clone()) }
}
