//! Environments from names and texts, for hosts in other languages.

use indexmap::IndexMap;
use motet_compiler::{InitialState, Session};
use motet_robots::builtin;
use motet_robots::card::{self, Robot};
use motet_robots::scene::{self, Scene, StateEntry};
use motet_syntax::ast::File;
use motet_syntax::json::{self, Spanned};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources, render, suggest};
use thiserror::Error;

/// The texts from which a session is opened. Everything is optional: without a robot all primitives of the
/// standard library are offered. Motions are deferred to the run.
///
/// ```
/// use motet_decode::Environment;
///
/// let texts = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() };
/// let session = texts.session()?;
/// assert_eq!(session.signatures().robot, "hsr");
/// # Ok::<(), motet_decode::EnvironmentError>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Environment<'t> {
    /// Name of a built-in robot, or text of a `robot.toml`.
    pub robot: Option<&'t str>,
    /// Text of the `primitives.motet` beside it.
    pub declarations: Option<&'t str>,
    /// Name of a built-in scene, or text of one in JSON.
    pub scene: Option<&'t str>,
    /// Facts at the start, in JSON: `{"holding(mug_1)": true}`.
    pub state: Option<&'t str>,
    /// Text of further declarations.
    pub domain: Option<&'t str>,
}

/// The reason why an environment was refused.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum EnvironmentError {
    /// No built-in robot or scene has the name.
    #[error("there is no {what} `{name}`; built in: {known}")]
    Unknown {
        /// `robot` or `scene`.
        what: &'static str,
        name: String,
        /// The names that are built in.
        known: String,
    },
    /// A text has errors.
    #[error("the {what} cannot be used: {diagnostics}")]
    Wrong {
        /// `robot`, `scene`, `state`, `domain`, or their combination.
        what: &'static str,
        /// The diagnostics as sentences.
        diagnostics: String,
    },
}

impl Environment<'_> {
    /// Reads the texts and opens a session.
    ///
    /// # Errors
    ///
    /// A name is unknown, or a text has an error.
    pub fn session(&self) -> Result<Session, EnvironmentError> {
        let mut sources = Sources::default();
        sources.add(Source::new("", ""));
        let robot = self.robot.map(|given| robot(given, self.declarations, &mut sources)).transpose()?;
        let scene = self.scene.map(|given| scene_of(given, &mut sources)).transpose()?;
        let domain = self.domain.map(|text| domain(text, &mut sources)).transpose()?;
        let state = self.state.map(|text| state(text, &mut sources)).transpose()?;
        let domains: Vec<File> = domain.into_iter().collect();
        let session = Session::builder()
            .robot(robot.as_ref())
            .domains(&domains)
            .scene(scene.as_ref())
            .state(state.as_ref())
            .build(&mut sources);
        let diagnostics = session.input_diagnostics().to_vec();
        right("robot, scene, state or domain", Some(session), &diagnostics, &sources)
    }
}

fn robot(given: &str, declarations: Option<&str>, sources: &mut Sources) -> Result<Robot, EnvironmentError> {
    let (name, toml, declarations) = match builtin::robot_texts(given) {
        Some(texts) => (format!("{given}/robot.toml"), texts.card, declarations.or(texts.declarations)),
        None if given.contains('=') => ("robot.toml".to_owned(), given, declarations),
        None => return Err(unknown("robot", given, builtin::ROBOTS.iter().map(|robot| robot.name))),
    };
    let (source, file) = add(&name, toml, sources);
    let (robot, diagnostics) = card::read(&source, file, declarations);
    right("robot", robot, &diagnostics, sources)
}

fn scene_of(given: &str, sources: &mut Sources) -> Result<Scene, EnvironmentError> {
    let (name, text) = match builtin::scene_text(given) {
        Some(texts) => (format!("{given}.json"), texts.json),
        None if given.trim_start().starts_with('{') => ("scene.json".to_owned(), given),
        None => return Err(unknown("scene", given, builtin::SCENES.iter().map(|scene| scene.name))),
    };
    let (source, file) = add(&name, text, sources);
    let (scene, diagnostics) = scene::read(&source, file);
    right("scene", scene, &diagnostics, sources)
}

fn domain(text: &str, sources: &mut Sources) -> Result<File, EnvironmentError> {
    let (source, file) = add("domain.motet", text, sources);
    let parsed = motet_syntax::read(&source, file);
    right("domain", Some(parsed.file), &parsed.diagnostics, sources)
}

fn state(text: &str, sources: &mut Sources) -> Result<InitialState, EnvironmentError> {
    let (source, file) = add("state.json", text, sources);
    let (facts, diagnostics) = json::read::<IndexMap<Spanned<String>, StateEntry>>(&source, file);
    Ok(right("state", facts, &diagnostics, sources)?.into_iter().collect())
}

fn add(name: &str, text: &str, sources: &mut Sources) -> (Source, FileId) {
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    let source = Source::new(name, text);
    sources.add(source.clone());
    (source, file)
}

/// The value read, unless a diagnostic is an error.
fn right<T>(
    what: &'static str,
    read: Option<T>,
    diagnostics: &[Diagnostic],
    sources: &Sources,
) -> Result<T, EnvironmentError> {
    let wrong = diagnostics.iter().any(|diagnostics| diagnostics.severity == Severity::Error);
    read.filter(|_| !wrong)
        .ok_or_else(|| EnvironmentError::Wrong { what, diagnostics: render::llm(diagnostics, sources) })
}

fn unknown(what: &'static str, name: &str, known: impl Iterator<Item = &'static str>) -> EnvironmentError {
    EnvironmentError::Unknown { what, name: name.to_owned(), known: suggest::one_of(known) }
}
