//! Planning for a request of a client: the model is asked, its reply checked and repaired.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use motet_client::{ApiKey, Client, ClientSettings};
use motet_planner::PlanRequest;
use motet_planner::builtin::PlanError;
use motet_planner::dialogue::Knowledge;
use motet_planner::model::{
    self, ChatContext, ModelError, ModelEvent, ModelObserver, ModelPlanner, ReadTo, TokenUsage,
};
use motet_project::ProjectSession;
use motet_robots::card::Robot;
use motet_runtime::Time;
use motet_runtime::memory::{Memory, MemoryLimits};
use motet_syntax::{Diagnostic, Source, Sources, Syntax, render};
use serde_json::Value;

use super::answer::{ApiError, ErrorKind, Reply, ReplyContent};
use super::request::ChatRequest;
use crate::interrupt::is_interrupted;

/// Limits of the endpoint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Number of requests that are worked on at a time.
    pub(super) parallel: usize,
    /// Number of bytes of a request.
    pub(super) body: usize,
}

/// Way to the model, with the settings that all requests share.
pub(super) struct Gateway {
    /// Server, with the operator's key if there is one.
    pub(super) settings: ClientSettings,
    /// Token that clients have to send.
    pub(super) token: Option<ApiKey>,
    /// Is `true` if keys of clients may go to the server.
    pub(super) may_pass_keys: bool,
    pub(super) robot: Robot,
    pub(super) opened: ProjectSession,
    /// Number of times that a reply goes back to the model.
    pub(super) repairs: u32,
    /// Syntax of the replies.
    pub(super) syntax: Syntax,
    pub(super) limits: Limits,
    /// Is `true` if only this machine reaches the endpoint.
    pub(super) is_local: bool,
}

impl Gateway {
    /// Name of the model.
    pub(super) fn model(&self) -> &str {
        &self.settings.model
    }

    /// Plans for a request. Blocks until the model has answered, or until `is_left` is set.
    pub(super) fn plan(
        &self,
        request: &ChatRequest,
        key: Option<ApiKey>,
        is_left: &Arc<AtomicBool>,
    ) -> Result<Reply, ApiError> {
        let key = match (self.settings.key.clone(), key) {
            (Some(own), _) => Some(own),
            (None, Some(_)) if !self.may_pass_keys => {
                let why = format!("your key would go to `{}` without encryption", self.settings.address);
                return Err(ApiError::new(ErrorKind::Forbidden, why));
            }
            (None, given) => given,
        };
        let failed = |error: &ModelError| ApiError::of_model(error, &self.settings);
        let client =
            Client::new(ClientSettings { key, ..self.settings.clone() }).map_err(|why| failed(&why))?;
        let mut log = RequestLog { is_left: Arc::clone(is_left), ..RequestLog::default() };
        let settings =
            model::Settings { repairs: self.repairs, read_to: ReadTo::Reply, ..model::Settings::default() };
        let scene = self.opened.scene.clone().unwrap_or_default();
        let known = Knowledge::of(self.opened.told_facts());
        let situation = known.situation(&scene);
        let mut memory = Memory::new(MemoryLimits::default());
        memory.instruct(Time::ZERO, &request.text);
        let ask = PlanRequest {
            session: &self.opened.session,
            robot: &self.robot,
            request: &request.text,
            situation: &situation,
            memory: &memory,
            bound: &[],
            image: None,
        };
        let exchange = ChatContext { earlier: &request.earlier, images: &request.images };
        let planned = ModelPlanner::new(client, &mut log, settings).plan_in(&ask, exchange);
        let usage = log.usage;
        let said = match planned {
            Ok(answered) => {
                let library = self.opened.session.library();
                let written = motet::document::write(&answered.planned.parsed, None, library, self.syntax);
                let wrong =
                    |why| ApiError::new(ErrorKind::NoPolicy, format!("the reply is no single policy: {why}"));
                ReplyContent::Policy(written.map_err(wrong)?)
            }
            Err(PlanError::Said { words }) => ReplyContent::Words(words),
            Err(PlanError::Refused { text, diagnostics }) => return Err(refused(&text, &diagnostics)),
            // It checks, but is not what was asked or what was written, and nobody is there to decide.
            Err(PlanError::Doubtful { planned, diagnostics }) => {
                return Err(refused(&planned.text, &diagnostics));
            }
            Err(
                why @ (PlanError::RequestError(_)
                | PlanError::NoPlan(_)
                | PlanError::NoModel { .. }
                | PlanError::Stopped),
            ) => {
                return Err(match &log.failed {
                    Some(error) => failed(error),
                    None => ApiError::new(ErrorKind::NoPolicy, why.to_string()),
                });
            }
        };
        Ok(Reply { said, usage })
    }
}

/// Error for a reply whose policy does not check, with its findings.
fn refused(text: &str, diagnostics: &[Diagnostic]) -> ApiError {
    let mut sources = Sources::default();
    sources.add(Source::new("reply", text));
    let message =
        format!("the policy of the model does not check: {}", render::llm(diagnostics, &sources).trim());
    let lines = render::json(diagnostics, &sources);
    let findings: Vec<Value> = lines.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let code = diagnostics.first().map(|found| found.code.0.to_owned());
    ApiError { code, findings, ..ApiError::new(ErrorKind::NoPolicy, message) }
}

/// Observer of a request while a model is asked.
#[derive(Debug, Default)]
struct RequestLog {
    usage: TokenUsage,
    /// Latest failure of the server.
    failed: Option<ModelError>,
    /// Is set once the client has left.
    is_left: Arc<AtomicBool>,
}

impl ModelObserver for &mut RequestLog {
    fn hear(&mut self, happening: &ModelEvent<'_>) {
        match happening {
            ModelEvent::Used(usage) => self.usage = self.usage.plus(*usage),
            ModelEvent::Failed { why, .. } => self.failed = Some((*why).clone()),
            _ => {}
        }
    }

    fn is_stopped(&self) -> bool {
        is_interrupted() || self.is_left.load(Ordering::Relaxed)
    }
}
