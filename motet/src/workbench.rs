//! Workbench for policies: checks, fixes, plans, draws and simulates what a person writes on a page. The page
//! of `motet view` and the playground, which has no server, ask the same questions in JSON.

mod simulated;

use std::ops::ControlFlow;

use motet_compiler::fix::{FixLimits, fix};
use motet_graph::draw::Names;
use motet_graph::{Graph, NodeKind, Term};
use motet_project::{DOCUMENT, Discard, Project, ProjectError, ProjectSession};
use motet_robots::builtin;
use motet_sim::Profile;
use motet_syntax::{Diagnostic, Parsed, Severity, Source, Sources, render};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::document::{MAX_FIXES, is_broken, listed, write};
use crate::feasible::{Motions, decide_in, queries};
use crate::page::source::PolicyText;
use crate::page::world::PageWorld;

/// Maximum length of a policy, in bytes.
const MAX_TEXT: usize = 1024 * 1024;
/// Maximum length of a request in words, in bytes.
const MAX_REQUEST: usize = 4096;
/// Maximum number of motions that are decided for one drawing.
const MAX_MOTIONS: usize = 64;

/// Question to a workbench: a JSON object whose `ask` names it.
#[derive(Deserialize, Debug)]
#[serde(tag = "ask", rename_all = "snake_case", deny_unknown_fields)]
enum Question {
    /// Robots and scenes to choose from.
    Rooms,
    /// Opens a robot in a scene, in which all later questions are answered.
    Open { robot: String, scene: String },
    /// Checks a policy, in the text or the JSON syntax.
    Check { text: String, name: Option<String> },
    /// Applies the safe fixes to a policy.
    Fix { text: String },
    /// Writes a policy in the canonical form.
    Format { text: String },
    /// Plans a policy for a request in words.
    Plan { request: String },
    /// Decides the motions of a policy, and draws them.
    Feasible { text: String },
    /// Simulates a policy.
    Run {
        text: String,
        #[serde(default)]
        seed: u64,
        profile: Option<String>,
    },
}

/// Robot in a scene with the questions that a page can ask about policies for it.
///
/// ```
/// let mut workbench = motet::workbench::Workbench::new();
/// workbench.answer(r#"{"ask": "open", "robot": "hsr", "scene": "kitchen"}"#);
/// let answer = workbench.answer(r#"{"ask": "check", "text": "policy p { sya(\"hi\") }"}"#);
/// assert!(answer.contains("M0201") && answer.contains("write `say`"));
/// ```
#[derive(Debug, Default)]
pub struct Workbench {
    opened: Option<ProjectSession>,
    /// Robot and scene beside the built-in ones.
    own_robot: Option<String>,
    own_scene: Option<String>,
}

impl Workbench {
    /// Workbench for the built-in robots and scenes, none of which is open yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same with a robot and a scene of its own, by name or path.
    #[must_use]
    pub fn with_room(self, robot: Option<&str>, scene: Option<&str>) -> Self {
        Self { own_robot: robot.map(str::to_owned), own_scene: scene.map(str::to_owned), ..self }
    }

    /// Answers a question. The answer is a JSON object; one with `error` says why there is no other.
    #[must_use]
    pub fn answer(&mut self, question: &str) -> String {
        let answer = match serde_json::from_str(question) {
            Ok(question) => self.answered(question),
            Err(error) => Err(format!("this is no question: {error}")),
        };
        answer.unwrap_or_else(|error| json!({ "error": error })).to_string()
    }

    fn answered(&mut self, question: Question) -> Result<Value, String> {
        match question {
            Question::Rooms => Ok(json!({"robots": self.robots(), "scenes": self.scenes()})),
            Question::Open { robot, scene } => self.open(&robot, &scene),
            Question::Check { text, name } => {
                let opened = self.opened()?;
                let (source, parsed) = read(&text, name.as_deref())?;
                let found = listed(opened.session.check_document(&parsed), opened, false);
                let sources = opened.sources(source);
                Ok(json!({"lines": render::json(&found, &sources), "ok": !has_error(&found)}))
            }
            Question::Fix { text } => {
                let opened = self.opened()?;
                let (source, _) = read(&text, None)?;
                let fixed = fix(&opened.session, &source, DOCUMENT, FixLimits::safe(MAX_FIXES));
                let titles: Vec<&str> = fixed.applied.iter().map(|one| one.title.as_str()).collect();
                Ok(json!({"text": fixed.text, "applied": titles}))
            }
            Question::Format { text } => {
                let opened = self.opened()?;
                let (_, parsed) = read(&text, None)?;
                if is_broken(&parsed) {
                    return Err("the text has errors of syntax".to_owned());
                }
                let library = opened.session.library();
                Ok(json!({"text": write(&parsed, None, library, parsed.syntax)?}))
            }
            Question::Plan { request } => {
                if request.len() > MAX_REQUEST {
                    return Err(format!("a request has at most {MAX_REQUEST} bytes"));
                }
                let planned = crate::plan::for_request(self.opened()?, &request);
                let planned = planned.map_err(|why| why.to_string())?;
                Ok(json!({"text": planned.planned.text, "notes": planned.understood.notes}))
            }
            Question::Feasible { text } => feasible(self.opened()?, &text),
            Question::Run { text, seed, profile } => {
                let opened = self.opened()?;
                let (source, parsed) = read(&text, None)?;
                let compiled = opened.session.compile(&parsed, None);
                let sources = opened.sources(source.clone());
                let lines = render::json(&compiled.diagnostics, &sources);
                let Some(graph) = compiled.graph else { return Ok(json!({"lines": lines, "ok": false})) };
                let profile = built_in_profile(profile.as_deref())?;
                let text = PolicyText::of(&source, &parsed.file, &graph.policy);
                let text = text.with_findings(&compiled.diagnostics, &sources);
                let items = simulated::items(opened, (graph, &parsed.file), text, (seed, profile))?;
                Ok(json!({"lines": lines, "ok": true, "items": items}))
            }
        }
    }

    fn opened(&self) -> Result<&ProjectSession, String> {
        self.opened.as_ref().ok_or_else(|| "no robot is open".to_owned())
    }

    fn robots(&self) -> Vec<&str> {
        offered(self.own_robot.as_deref(), builtin::ROBOTS.iter().map(|robot| robot.name))
    }

    fn scenes(&self) -> Vec<&str> {
        offered(self.own_scene.as_deref(), builtin::SCENES.iter().map(|scene| scene.name))
    }

    fn open(&mut self, robot: &str, scene: &str) -> Result<Value, String> {
        // A page may name what it was offered, and no file.
        for (names, name) in [(self.robots(), robot), (self.scenes(), scene)] {
            if !names.contains(&name) {
                return Err(format!("there is no robot or scene `{name}` to choose"));
            }
        }
        let opened = Project::builder()
            .robot(robot)
            .scene(scene)
            .open_with(&mut Discard)
            .and_then(|project| project.into_session(&mut Discard));
        let opened = opened.map_err(|error| said(&error))?;
        let world = PageWorld::of(&opened).map(|mut world| world.item());
        self.opened = Some(opened);
        Ok(json!({ "world": world }))
    }
}

/// Names to choose from: the one of its own first.
fn offered<'n>(own: Option<&'n str>, built_in: impl Iterator<Item = &'n str>) -> Vec<&'n str> {
    own.into_iter().chain(built_in.filter(|name| Some(*name) != own)).collect()
}

/// Reads a policy of a page.
fn read(text: &str, name: Option<&str>) -> Result<(Source, Parsed), String> {
    if text.len() > MAX_TEXT {
        return Err(format!("a policy has at most {MAX_TEXT} bytes"));
    }
    let looks_like_json = text.trim_start().starts_with('{');
    let name = name.unwrap_or(if looks_like_json { "policy.json" } else { "policy.motet" });
    let source = Source::new(name, text);
    let parsed = motet_syntax::read(&source, DOCUMENT);
    Ok((source, parsed))
}

/// Built-in profile. A page names no file.
fn built_in_profile(name: Option<&str>) -> Result<Profile, String> {
    let name = name.unwrap_or("typical");
    let names = || Profile::names().collect::<Vec<_>>().join(", ");
    Profile::builtin(name).ok_or_else(|| format!("there is no profile `{name}`; there are {}", names()))
}

/// Decides the motions of a policy with known arguments, each from the start of the scene; without a policy
/// that passes the check, motions of the scene.
fn feasible(opened: &ProjectSession, text: &str) -> Result<Value, String> {
    let (Some(geometry), Some(scene)) = (&opened.geometry, &opened.scene) else {
        return Err("motions need a robot with a body, and a scene".to_owned());
    };
    let (_, parsed) = read(text, None)?;
    let graph = opened.session.compile(&parsed, None).graph;
    let named: Vec<String> = graph.iter().flat_map(known_motions).collect();
    let wanted = if named.is_empty() { Motions::All } else { Motions::These(&named) };
    let room = (geometry.machine(), scene);
    let queries = queries(wanted, room, &opened.session, &mut Sources::default(), &mut Discard);
    let mut queries = queries.map_err(|error| error.to_string())?;
    let left_out = queries.len().saturating_sub(MAX_MOTIONS);
    queries.truncate(MAX_MOTIONS);
    let mut says = Vec::new();
    let picture = decide_in(room, queries, 1, &mut |verdict| {
        says.push(verdict.text.trim_end().to_owned());
        ControlFlow::Continue(())
    });
    Ok(json!({"says": says, "picture": picture, "left_out": left_out}))
}

/// Motions of a graph whose arguments are written in the policy, each once.
fn known_motions(graph: &Graph) -> Vec<String> {
    let mut found = Vec::new();
    for node in &graph.nodes {
        if let NodeKind::Call(call) = &node.kind
            && let Some(motion) = &call.motion
            && motion.args.iter().all(|arg| matches!(arg, Term::Literal(_)))
        {
            let text = Names(graph).motion(motion);
            if !found.contains(&text) {
                found.push(text);
            }
        }
    }
    found
}

fn has_error(found: &[Diagnostic]) -> bool {
    found.iter().any(|found| found.severity == Severity::Error)
}

fn said(error: &ProjectError) -> String {
    match error.help() {
        Some(help) => format!("{error}; {help}"),
        None => error.to_string(),
    }
}
