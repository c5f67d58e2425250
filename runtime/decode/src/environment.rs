//! What a policy is written for, given by names and texts: how hosts of another language open a session.

use indexmap::IndexMap;
use motet_compiler::{Options, Session, State};
use motet_robots::card::{self, Robot};
use motet_robots::scene::{self, Scene};
use motet_syntax::ast::File;
use motet_syntax::json::{self, Spanned};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources, render, suggest};
use thiserror::Error;

/// A robot, a room and what else is known. What is not given is not there: without a robot all primitives of the standard
/// library are offered. Motions are left to the run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Environment<'t> {
    /// The name of a robot that is built in, or the text of a `robot.toml`.
    pub robot: Option<&'t str>,
    /// The text of the `primitives.motet` beside it.
    pub declarations: Option<&'t str>,
    /// The name of a scene that is built in, or the text of one in JSON.
    pub scene: Option<&'t str>,
    /// What is known at the start, as in `{"holding(mug_1)": true}`.
    pub state: Option<&'t str>,
    /// Further declarations.
    pub domain: Option<&'t str>,
}

/// Why a world cannot be used.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum EnvironmentError {
    /// A name that nothing has.
    #[error("there is no {what} `{name}`; built in: {known}")]
    Unknown {
        /// `robot` or `scene`.
        what: &'static str,
        /// As given.
        name: String,
        /// What there is.
        known: String,
    },
    /// A text with mistakes.
    #[error("the {what} cannot be used: {diagnostics}")]
    Wrong {
        /// `robot`, `scene`, `state`, `domain`, or how they fit.
        what: &'static str,
        /// The diagnostics, in sentences.
        diagnostics: String,
    },
}

impl Environment<'_> {
    /// Opens a session.
    ///
    /// # Errors
    ///
    /// A name is not known, or a text has a mistake.
    pub fn session(&self) -> Result<Session, EnvironmentError> {
        let mut sources = Sources::default();
        sources.add(Source::new("", ""));
        let robot = self.robot.map(|given| robot(given, self.declarations, &mut sources)).transpose()?;
        let scene = self.scene.map(|given| scene_of(given, &mut sources)).transpose()?;
        let domain = self.domain.map(|text| domain(text, &mut sources)).transpose()?;
        let state = self.state.map(|text| state(text, &mut sources)).transpose()?;
        let domains: Vec<File> = domain.into_iter().collect();
        let (session, diagnostics) = Session::new(
            robot.as_ref(),
            &domains,
            scene.as_ref(),
            state.as_ref(),
            Options::default(),
            &mut sources,
        );
        right("robot, scene, state or domain", Some(session), &diagnostics, &sources)
    }
}

fn robot(given: &str, declarations: Option<&str>, sources: &mut Sources) -> Result<Robot, EnvironmentError> {
    let cards = card::embedded();
    let (name, toml, declarations) = match cards.iter().find(|(known, _, _)| *known == given) {
        Some((name, toml, built_in)) => (format!("{name}/robot.toml"), *toml, declarations.or(*built_in)),
        None if given.contains('=') => ("robot.toml".to_owned(), given, declarations),
        None => return Err(unknown("robot", given, cards.iter().map(|(name, _, _)| *name))),
    };
    let (source, file) = add(&name, toml, sources);
    let (robot, diagnostics) = card::read(&source, file, declarations);
    right("robot", robot, &diagnostics, sources)
}

fn scene_of(given: &str, sources: &mut Sources) -> Result<Scene, EnvironmentError> {
    let scenes = scene::embedded();
    let (name, text) = match scenes.iter().find(|(known, _)| *known == given) {
        Some((name, text)) => (format!("{name}.json"), *text),
        None if given.trim_start().starts_with('{') => ("scene.json".to_owned(), given),
        None => return Err(unknown("scene", given, scenes.iter().map(|(name, _)| *name))),
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

fn state(text: &str, sources: &mut Sources) -> Result<State, EnvironmentError> {
    let (source, file) = add("state.json", text, sources);
    let (facts, diagnostics) = json::read::<IndexMap<Spanned<String>, Option<bool>>>(&source, file);
    let facts = right("state", facts, &diagnostics, sources)?;
    Ok(State { facts: facts.into_iter().map(|(fact, holds)| (fact.value, (holds, fact.span))).collect() })
}

fn add(name: &str, text: &str, sources: &mut Sources) -> (Source, FileId) {
    let file = FileId(u16::try_from(sources.len()).unwrap_or(u16::MAX));
    let source = Source::new(name, text);
    sources.add(source.clone());
    (source, file)
}

/// What was read, where nothing is wrong with it.
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
