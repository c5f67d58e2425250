//! Policies that are to take over from the one that runs: each is checked in the state in the middle of the
//! run, on a thread of its own, and the engine swaps it in.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::thread;
use std::time::Instant;

use motet_compiler::Session;
use motet_graph::Graph;
use motet_planner::dialogue::{Conversation, DialogueSetup};
use motet_project::{DOCUMENT, ProjectSession};
use motet_runtime::{Engine, PreparedSwap, RetiredGraph, SwapRefusal, Time};
use motet_syntax::{Source, render};
use serde_json::{Value, json};

/// Spans between two looks at the desk: while nobody waits, and while a check goes on.
const IDLE: Time = Time::from_nanos(8_000_000);
const BUSY: Time = Time::from_nanos(2_000_000);

/// A policy that was offered, with whom to tell what became of it.
#[derive(Debug)]
pub(crate) struct Offer {
    pub(crate) policy: String,
    pub(crate) reply: Sender<SwapResult>,
    /// Time until which it may take over. Who offered it waits no longer.
    pub(crate) until: Instant,
}

/// Result of an offer: the policy that has taken over, or the refusal.
pub(crate) type SwapResult = Result<Value, Value>;

/// Graph of a policy that checks, or the refusal: a problem, and the findings.
type Checked = Result<Graph, Value>;

/// Desk at which policies are offered to a run.
pub(crate) struct SwapChecker {
    opened: Arc<ProjectSession>,
    setup: DialogueSetup,
    offers: Receiver<Offer>,
    /// Check that goes on, with who waits, and until when.
    checking: Option<(Receiver<Checked>, Sender<SwapResult>, Instant)>,
    swapping: Option<Sender<SwapResult>>,
}

impl SwapChecker {
    /// A desk for a project, and where to put offers. `None` without a robot.
    pub(crate) fn new(opened: Arc<ProjectSession>) -> Option<(Self, Sender<Offer>)> {
        let setup = dialogue_setup(&opened)?;
        let (sender, offers) = channel();
        Some((Self { opened, setup, offers, checking: None, swapping: None }, sender))
    }

    /// The policy that takes over now, if one has passed its check.
    pub(crate) fn swap(&mut self, engine: &Engine) -> Option<PreparedSwap> {
        if self.checking.is_none() {
            self.begin(engine);
        }
        let checked = match self.checking.as_ref()?.0.try_recv() {
            Ok(checked) => checked,
            Err(TryRecvError::Empty) => return None,
            Err(TryRecvError::Disconnected) => Err(refusal("the check failed inside", Vec::new())),
        };
        let (_, reply, until) = self.checking.take()?;
        let prepared = match checked {
            _ if Instant::now() > until => Err(refusal("the check took too long", Vec::new())),
            _ if engine.is_over() => Err(refusal("the run is over", Vec::new())),
            // The engine refuses a policy that was proved from facts that have changed since.
            Ok(graph) => PreparedSwap::new(graph, &engine.running()).map_err(|wrong| untaken(&wrong)),
            Err(refused) => Err(refused),
        };
        match prepared {
            Ok(prepared) => {
                self.swapping = Some(reply);
                Some(prepared)
            }
            Err(refused) => {
                // Who offered it may be gone.
                let _ = reply.send(Err(refused));
                None
            }
        }
    }

    fn begin(&mut self, engine: &Engine) {
        // While the run did not look, some may have waited in vain.
        let offer = self.offers.try_iter().find(|offer| Instant::now() <= offer.until);
        let Some(Offer { policy, reply, until }) = offer else { return };
        let mut talk = Conversation::new(&self.setup);
        talk.tell(self.opened.told_facts());
        let (session, opened) = (talk.midway(engine), Arc::clone(&self.opened));
        let (sender, checked) = channel();
        thread::spawn(move || {
            // The run may be over before its check.
            let _ = sender.send(check(&session, &opened, policy));
        });
        self.checking = Some((checked, reply, until));
    }

    /// Tells who offered a policy if the engine has taken it.
    pub(crate) fn swapped(&mut self, graph: &Arc<Graph>, result: &Result<RetiredGraph, SwapRefusal>) {
        let Some(reply) = self.swapping.take() else { return };
        let answer = match result {
            Ok(_) => Ok(json!({"policy": graph.policy.as_str()})),
            Err(wrong) => Err(untaken(wrong)),
        };
        let _ = reply.send(answer);
    }

    /// Longest span of the wall clock without a look at the desk.
    pub(crate) const fn glance_every(&self) -> Time {
        if self.checking.is_some() { BUSY } else { IDLE }
    }
}

/// Environment in which requests are carried out; `None` without a robot.
pub(crate) fn dialogue_setup(opened: &ProjectSession) -> Option<DialogueSetup> {
    Some(DialogueSetup {
        robot: opened.robot.clone()?,
        scene: opened.scene.clone().unwrap_or_default(),
        domains: opened.domains.clone(),
        geometry: opened.geometry.clone(),
        options: opened.inputs().check_options(),
    })
}

fn check(session: &Session, opened: &ProjectSession, policy: String) -> Checked {
    let source = Source::new("policy", policy);
    let parsed = motet_syntax::read(&source, DOCUMENT);
    let compiled = session.compile(&parsed, None);
    let sources = opened.sources(source);
    let findings = compiled.diagnostics.iter().map(|found| json!(render::record(found, &sources))).collect();
    compiled.graph.ok_or_else(|| refusal("the check refuses the policy", findings))
}

fn untaken(wrong: &SwapRefusal) -> Value {
    refusal(&format!("the policy cannot take over: {wrong}; the one before goes on"), Vec::new())
}

fn refusal(problem: &str, findings: Vec<Value>) -> Value {
    json!({"problem": problem, "findings": findings})
}
