//! Environments in which the tools check, plan and simulate: the robot and the scene of the command line, as
//! a run has left them, and the built-in robots and scenes.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError, RwLock};

use motet_compiler::Session;
use motet_planner::dialogue::Knowledge;
use motet_project::{DiagnosticSink, Project, ProjectBuilder, ProjectSession, named_robot, robot_names};
use motet_robots::builtin::SCENES;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_syntax::{Diagnostic, Sources, render, suggest};

use super::answer::Refusal;
use super::text::read;
use crate::error::CliError;
use crate::output::note;

/// A robot in a scene at one time.
#[derive(Debug)]
pub(crate) struct AgentEnvironment {
    pub(crate) project: Arc<ProjectSession>,
    /// Session in the present state.
    pub(super) session: Session,
    /// Scene with the things where they are now, as far as that is known.
    pub(super) scene: Scene,
    pub(super) known: Knowledge,
}

impl AgentEnvironment {
    fn open(inputs: ProjectBuilder) -> Result<Self, CliError> {
        let opened = inputs.open_with(&mut StderrSink)?.into_session(&mut StderrSink)?;
        let (session, known) = (opened.session.clone(), Knowledge::of(opened.told_facts()));
        let scene = opened.scene.clone().unwrap_or_default();
        Ok(Self { project: Arc::new(opened), session, scene, known })
    }

    /// Robot of the situation.
    pub(super) fn robot(&self) -> Result<&Robot, Refusal> {
        let missing = || {
            let names = suggest::one_of(robot_names());
            Refusal::new("no robot is given").with_help(format!("give `robot`: {names}"))
        };
        self.project.robot.as_ref().ok_or_else(missing)
    }

    /// Name of the robot; empty without one.
    pub(super) fn robot_name(&self) -> &str {
        self.project.robot.as_ref().map_or("", |robot| robot.name.as_str())
    }
}

/// Sink that prints diagnostics to stderr: stdout belongs to the protocol.
pub(crate) struct StderrSink;

impl DiagnosticSink for StderrSink {
    fn report(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        if !diagnostics.is_empty() {
            note(render::human(diagnostics, sources, render::ColorChoice::Off, 100).trim_end());
        }
    }
}

/// Environments that calls may name.
pub(crate) struct AgentEnvironments {
    /// Name of the scene of the command line.
    scene: Option<String>,
    /// The one of the command line.
    own: RwLock<Arc<AgentEnvironment>>,
    /// Built-in robots in built-in scenes, by their names; empty for none.
    built_in: Mutex<BTreeMap<(String, String), Arc<AgentEnvironment>>>,
}

impl AgentEnvironments {
    /// Opens the situation of the command line.
    pub(crate) fn open(inputs: ProjectBuilder, scene: Option<String>) -> Result<Self, CliError> {
        let own = RwLock::new(Arc::new(AgentEnvironment::open(inputs)?));
        Ok(Self { scene, own, built_in: Mutex::default() })
    }

    /// The robot of the command line, at present.
    pub(crate) fn own(&self) -> Arc<AgentEnvironment> {
        Arc::clone(&self.own.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Replaces the situation of the command line by a later one.
    pub(super) fn publish(&self, now: AgentEnvironment) {
        *self.own.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(now);
    }

    /// Environment for a policy: as [`AgentEnvironments::find`] has it, but with the robot that the policy
    /// names where neither the call nor the command line gives one.
    pub(super) fn find_for(
        &self,
        policy: &str,
        robot: Option<&str>,
        scene: Option<&str>,
    ) -> Result<Arc<AgentEnvironment>, Refusal> {
        let named = match robot {
            None if self.own().project.robot.is_none() => named_robot(&read(policy)?.1.file),
            _ => None,
        };
        self.find(robot.or(named.as_deref()), scene)
    }

    /// Environment that a call names: built-in names, or by default those of the command line. No call opens
    /// a file.
    pub(super) fn find(
        &self,
        robot: Option<&str>,
        scene: Option<&str>,
    ) -> Result<Arc<AgentEnvironment>, Refusal> {
        let own = self.own();
        let is_own_robot = robot.is_none_or(|name| name == own.robot_name());
        let is_own_scene = scene.is_none_or(|name| Some(name) == self.scene.as_deref());
        if is_own_robot && is_own_scene {
            return Ok(own);
        }
        let robot = robot.unwrap_or(own.robot_name());
        let scene = scene.or(self.scene.as_deref()).unwrap_or_default();
        let known = |what: &str, name: &str, mut names: Box<dyn Iterator<Item = &'static str>>| {
            if name.is_empty() || names.any(|known| known == name) { Ok(()) } else { unknown(what, name) }
        };
        known("robot", robot, Box::new(robot_names()))?;
        known("scene", scene, Box::new(scene_names()))?;
        let mut built_in = self.built_in.lock().unwrap_or_else(PoisonError::into_inner);
        let name = (robot.to_owned(), scene.to_owned());
        if let Some(found) = built_in.get(&name) {
            return Ok(Arc::clone(found));
        }
        let mut inputs = Project::builder();
        if !robot.is_empty() {
            inputs = inputs.robot(robot);
        }
        if !scene.is_empty() {
            inputs = inputs.scene(scene);
        }
        let opened = Arc::new(AgentEnvironment::open(inputs)?);
        built_in.insert(name, Arc::clone(&opened));
        Ok(opened)
    }
}

/// Names of the built-in scenes.
pub(super) fn scene_names() -> impl Iterator<Item = &'static str> {
    SCENES.iter().map(|scene| scene.name)
}

fn unknown(what: &str, name: &str) -> Result<(), Refusal> {
    let names: Vec<&str> = if what == "robot" { robot_names().collect() } else { scene_names().collect() };
    let known = suggest::one_of(names);
    let help = format!("known: {known}; files are opened only by the command line of `motet mcp`");
    Err(Refusal::unknown(what, name, help))
}
