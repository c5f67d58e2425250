//! Planners of trials: the built-in one, baselines, and a model on a server.

use std::time::{Duration, Instant};

use motet_client::{Client, ClientSettings, ServerUrl};
use motet_planner::builtin::{PlanError, PlannedRequest};
use motet_planner::model::{ModelPlanner, Settings};
use motet_planner::{Builtin, PlanRequest, Planner, RemainingSteps, Wait};
use motet_requests::RequestContext;
use motet_robots::scene::Scene;

use crate::few_shot::{FewShot, FileModel};

/// Settings of a model that is asked once.
fn once() -> Settings {
    Settings { repairs: 0, ..Settings::default() }
}

/// Planner of trials.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum PlannerKind {
    /// The planner that needs no model.
    #[default]
    Builtin,
    /// A fixed tree: the first plan, which is run again after a failure, whatever is known by then.
    Tree,
    /// One plan for the first request, and none after a failure.
    OneShot,
    /// A new plan after each failure, from the scene as it was told at the start.
    Forgetful,
    /// A model, with the prompt and the repairs of `motet do`.
    Asked(ModelSource),
    /// A model that is shown examples and asked once ([`crate::few_shot`]).
    FewShot(ModelSource),
}

/// Place of a model.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum ModelSource {
    /// A server, with the name of the model.
    Server(String, String),
    /// A file with replies, one request and its policy on a line.
    File(String),
}

impl ModelSource {
    fn read(text: &str, model: Option<&str>) -> Result<Self, String> {
        match text.strip_prefix("file:") {
            Some(_) if model.is_some() => Err("`--model` is for a planner on a server".to_owned()),
            Some(file) => Ok(Self::File(file.to_owned())),
            None if text.starts_with("http://") || text.starts_with("https://") => {
                Ok(Self::Server(text.to_owned(), model.unwrap_or("default").to_owned()))
            }
            None => Err(format!("there is no planner `{text}`: write {KNOWN}")),
        }
    }

    fn client(url: &str, model: &str) -> Result<Client, String> {
        let address = ServerUrl::new(url, None)?;
        Client::new(ClientSettings::new(address, model)).map_err(|why| format!("cannot ask `{url}`: {why}"))
    }
}

/// Planners as the command line names them.
const KNOWN: &str = "`builtin`, `tree`, `one-shot`, `forgetful`, http://… or file:REPLIES; before the last \
                     two also `few-shot:`";

impl PlannerKind {
    /// Planner by the words of the command line: `builtin`, `tree`, `one-shot`, `forgetful`, the address of a
    /// server, or `file:` with a file of replies; before the last two also `few-shot:`.
    ///
    /// # Errors
    ///
    /// It is none of these.
    pub fn read(text: &str, model: Option<&str>) -> Result<Self, String> {
        let kind = match text {
            "builtin" => Self::Builtin,
            "tree" => Self::Tree,
            "one-shot" => Self::OneShot,
            "forgetful" => Self::Forgetful,
            other => {
                return match other.strip_prefix("few-shot:") {
                    Some(source) => ModelSource::read(source, model).map(Self::FewShot),
                    None => ModelSource::read(other, model).map(Self::Asked),
                };
            }
        };
        if model.is_some() {
            return Err("`--model` is for a planner on a server".to_owned());
        }
        Ok(kind)
    }

    /// A planner for a trial.
    ///
    /// # Errors
    ///
    /// The server's address is none.
    pub fn make(&self) -> Result<Box<dyn Planner>, String> {
        Ok(match self {
            Self::Builtin => Box::new(Builtin),
            Self::Tree => Box::new(FixedTree(None)),
            Self::OneShot => Box::new(OneShot(false)),
            Self::Forgetful => Box::new(Forgetful(None)),
            Self::Asked(ModelSource::Server(url, model)) => {
                Box::new(ModelPlanner::new(ModelSource::client(url, model)?, (), Settings::default()))
            }
            Self::Asked(ModelSource::File(file)) => {
                Box::new(ModelPlanner::new(FileModel::open(file)?, (), Settings::default()))
            }
            Self::FewShot(ModelSource::Server(url, model)) => {
                Box::new(ModelPlanner::new(FewShot::new(ModelSource::client(url, model)?)?, (), once()))
            }
            Self::FewShot(ModelSource::File(file)) => {
                Box::new(ModelPlanner::new(FewShot::new(FileModel::open(file)?)?, (), once()))
            }
        })
    }
}

struct FixedTree(Option<PlannedRequest>);

impl Planner for FixedTree {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        match &self.0 {
            Some(first) => Ok(first.clone()),
            None => Ok(self.0.insert(Builtin.plan(ask)?).clone()),
        }
    }
}

struct OneShot(bool);

impl Planner for OneShot {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        if std::mem::replace(&mut self.0, true) {
            return Err(PlanError::NoModel { why: "it plans once".to_owned() });
        }
        Builtin.plan(ask)
    }
}

struct Forgetful(Option<Scene>);

impl Planner for Forgetful {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        let scene = self.0.get_or_insert_with(|| ask.situation.scene.clone());
        let session = ask.session.with_scene(Some(scene), None);
        let situation = RequestContext::new(scene);
        Builtin.plan(&PlanRequest { session: &session, situation: &situation, ..*ask })
    }
}

/// Planner with a watch.
pub struct Timed {
    planner: Box<dyn Planner>,
    /// Time for the words: which things are meant.
    pub words: Duration,
    /// Time for the checks of what is feasible.
    pub check: Duration,
    /// Time for the plans.
    pub plan: Duration,
    /// True if the first request had a policy that passed the check.
    pub is_planned: Option<bool>,
}

impl Timed {
    /// A planner with a watch at 0.
    #[must_use]
    pub fn new(planner: Box<dyn Planner>) -> Self {
        let [words, check, plan] = [Duration::ZERO; 3];
        Self { planner, words, check, plan, is_planned: None }
    }
}

impl Planner for Timed {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        let begin = Instant::now();
        let _ = motet_requests::understand(ask.request, ask.situation);
        self.words += begin.elapsed();
        let begin = Instant::now();
        let answered = self.planner.plan(ask);
        let took = begin.elapsed();
        self.is_planned.get_or_insert(answered.is_ok());
        // What the plan took, without the words and the check that come with it.
        let begin = Instant::now();
        if let Ok(answered) = &answered {
            let _ = ask.session.compile(&answered.planned.parsed, None);
        }
        let check = begin.elapsed();
        self.check += check;
        self.plan += took.saturating_sub(check);
        answered
    }

    fn reads_answers(&self) -> bool {
        self.planner.reads_answers()
    }

    fn begin(&mut self, ask: &PlanRequest<'_>) -> bool {
        self.planner.begin(ask)
    }

    fn rest(&mut self, wait: Wait) -> RemainingSteps {
        self.planner.rest(wait)
    }
}
