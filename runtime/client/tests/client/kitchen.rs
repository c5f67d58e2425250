//! The kitchen, a robot in it, and clients of a scripted server.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use motet_client::{Client, ClientSettings, ServerUrl};
use motet_compiler::{CheckOptions, Geometry, Session};
use motet_decode::{Grammar, Subset, canonical};
use motet_planner::dialogue::{Conversation, DialogueSetup, NoOperator, Outcome, Person};
use motet_planner::model::{self, ModelEvent, ModelObserver, ModelPlanner};
use motet_planner::{Planner, builtin};
use motet_project::{Discard, Project, ProjectBuilder, ProjectSession};
use motet_requests::RequestContext;
use motet_runtime::Time;
use motet_sim::{Sim, SimOptions};

use crate::server::Server;

/// The HSR in the kitchen.
fn opened(project: ProjectBuilder) -> ProjectSession {
    let project = project.robot("hsr").scene("kitchen").open().unwrap();
    project.into_session(&mut Discard).unwrap()
}

pub(crate) fn setting() -> DialogueSetup {
    let opened = opened(Project::builder().without_motions());
    let (robot, scene) = (opened.robot.unwrap(), opened.scene.unwrap());
    DialogueSetup { robot, scene, domains: Vec::new(), geometry: None, options: CheckOptions::default() }
}

pub(crate) fn session() -> Session {
    opened(Project::builder().without_motions()).session
}

/// The robot's body in the kitchen.
#[allow(dead_code, reason = "the benchmark uses it")]
pub(crate) fn geometry() -> Arc<Geometry> {
    opened(Project::builder()).geometry.unwrap()
}

/// What a model that knows the right policy would write for a request.
pub(crate) fn right(setting: &DialogueSetup, request: &str) -> String {
    let session = session();
    let situation = RequestContext::new(&setting.scene);
    let answered = builtin::answer(&session, Some(&setting.robot), request, &situation).unwrap();
    let policy = answered.planned.parsed.file.policies().next().unwrap();
    canonical(policy, &Grammar::new(&session.signatures(), Subset::default())).unwrap()
}

/// Settings with short times.
pub(crate) fn brisk(server: &Server) -> ClientSettings {
    ClientSettings {
        connect_timeout: Duration::from_secs(2),
        // Longer than a loaded machine lets a thread of the server wait.
        idle_timeout: Duration::from_secs(1),
        timeout: Duration::from_secs(20),
        retries: 2,
        back_off: Duration::from_millis(1),
        longest_back_off: Duration::from_millis(20),
        max_bytes: 1 << 20,
        ..ClientSettings::new(ServerUrl::new(&server.url, None).unwrap(), "scripted")
    }
}

/// Keeps what happens, in short.
#[derive(Clone, Default)]
pub(crate) struct Heard(pub(crate) Rc<RefCell<Vec<String>>>);

impl ModelObserver for Heard {
    fn hear(&mut self, happening: &ModelEvent<'_>) {
        let line = match happening {
            ModelEvent::Asked { round, .. } => format!("asked {round}"),
            ModelEvent::Retrying { .. } => "retrying".to_owned(),
            ModelEvent::Wrote(_) | ModelEvent::Used(_) => return,
            ModelEvent::Said { words, .. } => format!("said {words}"),
            ModelEvent::Unmet { goal } => format!("unmet {goal}"),
            ModelEvent::Mended { titles } => format!("mended {}", titles.join("; ")),
            ModelEvent::Refused { findings, .. } => format!("refused {}", findings.trim()),
            ModelEvent::Failed { why, .. } => format!("failed {why}"),
            ModelEvent::Taken { .. } => "taken".to_owned(),
            ModelEvent::Begun { .. } => "begun".to_owned(),
        };
        self.0.borrow_mut().push(line);
    }
}

/// A planner that asks a server.
pub(crate) fn planner(settings: ClientSettings, heard: &Heard) -> ModelPlanner<'static> {
    ModelPlanner::new(Client::new(settings).unwrap(), heard.clone(), model::Settings::default())
}

/// Carries a request out with nobody to ask.
pub(crate) fn carry_out(setting: &DialogueSetup, planner: &mut dyn Planner, request: &str) -> (Outcome, Sim) {
    carry_out_with(setting, planner, &mut NoOperator, request)
}

/// Carries a request out.
pub(crate) fn carry_out_with(
    setting: &DialogueSetup,
    planner: &mut dyn Planner,
    person: &mut dyn Person,
    request: &str,
) -> (Outcome, Sim) {
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let mut talk = Conversation::new(setting);
    let (outcome, _) = talk.carry_out(request, planner, &mut sim, person, &mut (), Time::ZERO);
    (outcome, sim)
}
