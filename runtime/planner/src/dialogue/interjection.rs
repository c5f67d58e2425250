//! Lines that a person types while the robot moves, and replies of a model to them, read and checked beside
//! the run: the loop of the run only starts the work and takes its result.

use std::sync::Arc;

use motet_compiler::{Geometry, Session};
use motet_requests::{
    Intent, PendingQuestion, ReportedLocation, RequestContext, RoomQuestion, added, withdrawn,
};
use motet_robots::scene::Scene;
use smol_str::SmolStr;

use super::{Conversation, Knowledge};
use crate::background_work::{BackgroundWork, CHECK_WITHIN, READ_WITHIN};
use crate::builtin::PlannedRequest;
use crate::model::{ReplyVerdict, judge};
use crate::runtime_check::CheckMode;

/// A line that is being read.
pub(super) struct LineReading {
    /// Line as it was typed.
    pub(super) said: String,
    pub(super) read: BackgroundWork<LineMeaning>,
}

/// Meaning of a line in a run.
pub(super) enum LineMeaning {
    Question(RoomQuestion),
    /// Locations that are not as they were believed.
    Statement(Vec<ReportedLocation>),
    /// A request, with the world in which it is to be planned.
    Request(Box<LineRequest>),
}

/// A request of a line, and the world in which a policy for it begins.
pub(super) struct LineRequest {
    /// Words of the request, after what they add to the one before.
    pub(super) request: String,
    pub(super) known: Knowledge,
    pub(super) scene: Scene,
    pub(super) session: Session,
}

/// A finished policy that is being checked against the beliefs of a run.
pub(super) struct PolicyCheck {
    /// Request that it is for; none of the rest of an early start.
    pub(super) request: Option<String>,
    pub(super) check: BackgroundWork<Option<Box<PlannedRequest>>>,
}

/// World of a conversation with some knowledge, without borrows.
struct OwnedWorld {
    base: Session,
    scene: Scene,
    geometry: Option<Arc<Geometry>>,
    known: Knowledge,
}

impl OwnedWorld {
    fn new(talk: &Conversation<'_>, known: Knowledge) -> Self {
        let (scene, geometry) = (talk.setting.scene.clone(), talk.setting.geometry.clone());
        Self { base: talk.base().clone(), scene, geometry, known }
    }

    /// The scene as it is known, with a session in it. Where the base is while it moves nobody knows
    /// beforehand.
    fn session(&self) -> (Scene, Session) {
        let scene = self.known.scene(&self.scene);
        let session = self.base.with_scene(Some(&scene), Some(&self.known.state()));
        let session = match &self.geometry {
            Some(geometry) if self.known.is_empty() => session.with_geometry(Arc::clone(geometry)),
            Some(_) | None => session,
        };
        (scene, session)
    }
}

impl LineReading {
    /// Starts to read a line, which may change the request `task`. `known` has the beliefs of the run now,
    /// and `midway` those with which another policy begins.
    pub(super) fn start(
        talk: &Conversation<'_>,
        (said, task): (String, String),
        (known, midway): (Knowledge, Knowledge),
        tells: bool,
        mode: CheckMode,
    ) -> Self {
        let (line, world) = (said.clone(), OwnedWorld::new(talk, midway));
        let read = move || {
            let scene = known.scene(&world.scene);
            if let Some(question) = motet_requests::question(&line, &known.situation(&scene)) {
                return LineMeaning::Question(question);
            }
            let request = changed(line, &task, &world.scene);
            let (scene, session) = world.session();
            let told = tells.then(|| statement(&request, &world.known.situation(&scene))).flatten();
            match told {
                Some(told) => LineMeaning::Statement(told),
                None => LineMeaning::Request(Box::new(LineRequest {
                    request,
                    known: world.known,
                    scene,
                    session,
                })),
            }
        };
        Self { said, read: BackgroundWork::start(mode, READ_WITHIN, read) }
    }
}

impl PolicyCheck {
    /// Starts to check a finished policy with which a run goes on from these beliefs.
    pub(super) fn start(
        talk: &Conversation<'_>,
        (policy, request): (String, Option<String>),
        understood: Intent,
        known: Knowledge,
        mode: CheckMode,
    ) -> Self {
        let world = OwnedWorld::new(talk, known);
        let check = move || match judge(&world.session().1, &policy) {
            // Other steps than were written are not slipped in: the request is planned anew.
            ReplyVerdict::Good { planned, changed, .. } if changed.is_empty() => {
                Some(Box::new(PlannedRequest { understood, planned: *planned }))
            }
            ReplyVerdict::Good { .. } | ReplyVerdict::Bad { .. } => None,
        };
        Self { request, check: BackgroundWork::start(mode, CHECK_WITHIN, check) }
    }
}

/// Starts to read the locations that an answer to a question tells.
pub(super) fn answer(
    talk: &Conversation<'_>,
    (question, said): (String, String),
    mode: CheckMode,
) -> BackgroundWork<Vec<ReportedLocation>> {
    let (known, scene) = (talk.known.clone(), talk.setting.scene.clone());
    BackgroundWork::start(mode, READ_WITHIN, move || {
        let scene = known.scene(&scene);
        let situation = known.situation(&scene);
        let spoken_of: Vec<SmolStr> = motet_requests::named(&question, &situation);
        motet_requests::told(&said, PendingQuestion::Where, &RequestContext { spoken_of, ..situation })
    })
}

/// The request after an addition, `also bring the apple`, or a withdrawal, `without the apple`.
fn changed(said: String, task: &str, scene: &Scene) -> String {
    let task = task.trim_end_matches(['.', '!', ' ']);
    let names = |words: &str| !motet_requests::named(words, &RequestContext::new(scene)).is_empty();
    if let Some(more) = added(&said) {
        return format!("{task} and {more}");
    }
    match withdrawn(&said).filter(|rest| names(rest)) {
        Some(rest) => format!("{task}, but without {rest}"),
        None => said,
    }
}

/// Reads locations from a line that states them and requests nothing.
fn statement(said: &str, situation: &RequestContext<'_>) -> Option<Vec<ReportedLocation>> {
    let understood = motet_requests::understand(said, situation).ok()?;
    (understood.aims.is_empty() && !understood.located.is_empty()).then_some(understood.located)
}
