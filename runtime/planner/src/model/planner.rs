//! The model planner: sends a prompt, reads the reply, and returns errors to the model for a few rounds.

use std::sync::Arc;
use std::time::Duration;

use motet_compiler::{Session, Signatures};
use motet_decode::{AcceptorFactory, Grammar, Subset};
use motet_runtime::CameraImage;
use motet_syntax::{Diagnostic, Source, Sources, print, render};

use super::background::{PendingRest, REPLY_BYTES, RestProgress, first_step};
use super::chat::{Finish, Message, Model, ModelError, Reply, ReplyEvent, Role};
use super::chat::{ModelEvent, ModelObserver};
use super::prose;
use super::stream_reader::{StreamReader, StreamVerdict};
use crate::background_work::{BackgroundWork, CHECK_WITHIN, WorkProgress};
use crate::planned::{PlanError, Planned, PlannedRequest};
use crate::planner::{OwnedRequest, PlanRequest, Planner, RemainingSteps, Wait};
use crate::prompt::{self, Prompt, StaticPrompt};
use crate::reply_verdict::{ReplyVerdict, RequestGoal, judge};
use crate::runtime_check::CheckMode;
use motet_requests::{Certainty, Intent};

/// Waiting time for a piece of a reply between two looks at the stop request.
const SLICE: Duration = Duration::from_millis(50);
/// Maximum number of bytes of a policy for which the acceptor keeps room.
const POLICY_BYTES: usize = 16 << 10;
/// Number of times that a reply is asked for again because it did not arrive whole.
const MOST_FAILURES: u32 = 3;

/// Moment at which a policy starts to run.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Start {
    /// Once it is complete.
    #[default]
    Whole,
    /// As soon as its first step is complete and nothing later can refute it.
    FirstStep,
}

/// Settings of the exchange with a model.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Settings {
    /// Number of times that a wrong reply goes back to the model with the reason.
    pub repairs: u32,
    /// Maximum number of tokens of a prompt, estimated from bytes.
    pub tokens: usize,
    /// Canonical subset that constrains the model.
    pub surface: Subset,
    /// Moment at which a policy starts to run.
    pub start: Start,
    /// Position up to which a reply is read.
    pub read_to: ReadTo,
    /// Schedule of the checks of what is written while a robot moves.
    pub checks: CheckMode,
}

/// Position up to which a reply is read.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum ReadTo {
    /// The end of its policy: nothing is waited for that is of no use.
    #[default]
    Policy,
    /// The end of the reply, where the server counts its tokens.
    Reply,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            repairs: 3,
            tokens: prompt::TOKENS,
            surface: Subset::default(),
            start: Start::Whole,
            read_to: ReadTo::Policy,
            checks: CheckMode::AtOnce,
        }
    }
}

/// Planner that asks a model.
pub struct ModelPlanner<'m> {
    model: Box<dyn Model + 'm>,
    listener: Box<dyn ModelObserver + 'm>,
    settings: Settings,
    /// A policy that is being written during a run.
    later: Option<Later>,
    ready: Option<KeptParts>,
}

/// Parts that depend on robot and scene only, kept between requests.
#[derive(Clone)]
struct KeptParts {
    signatures: Arc<Signatures>,
    lasting: Arc<StaticPrompt>,
    grammar: Arc<Grammar>,
    acceptors: AcceptorFactory,
}

/// Policy that is being written during a run.
enum Later {
    /// The prompt is being written, for this session.
    Asking(Session, BackgroundWork<(KeptParts, Vec<Message>)>),
    /// The rest of a policy, or a policy, is being read.
    Reading(PendingRest),
}

impl KeptParts {
    /// Returns the kept parts for a request's session, and builds them anew if the robot or the objects have
    /// changed.
    fn renewed(kept: Option<Self>, ask: &PlanRequest<'_>, surface: Subset) -> Self {
        let signatures = ask.session.signatures();
        match kept.filter(|kept| Arc::ptr_eq(&kept.signatures, &signatures)) {
            Some(kept) => Self { acceptors: kept.acceptors.elsewhere(ask.session), ..kept },
            None => Self {
                lasting: Arc::new(StaticPrompt::new(ask.session, ask.robot, ask.situation.scene)),
                grammar: Arc::new(Grammar::new(&signatures, surface)),
                acceptors: AcceptorFactory::new(ask.session, surface),
                signatures,
            },
        }
    }
}

/// Position in a reply up to which it is read.
enum ReadEnd {
    /// To the end of the reply or of its policy.
    Whole,
    /// To the end of the first step, if that may start.
    First(Box<Planned>),
}

/// Result of one round.
enum RoundResult {
    Good(Box<Planned>),
    /// A question or a refusal, in words.
    Said(String),
    /// A reply that goes back to the model.
    Bad {
        reply: String,
        findings: Vec<Diagnostic>,
        /// Policy that could run if a person wants it.
        otherwise: Option<Box<Planned>>,
    },
    /// The reply is incomplete.
    Failed(ModelError),
}

impl<'m> ModelPlanner<'m> {
    /// A planner that asks a model.
    #[must_use]
    pub fn new(model: impl Model + 'm, listener: impl ModelObserver + 'm, settings: Settings) -> Self {
        Self { model: Box::new(model), listener: Box::new(listener), settings, later: None, ready: None }
    }

    fn ready(&mut self, ask: &PlanRequest<'_>) -> KeptParts {
        let ready = KeptParts::renewed(self.ready.take(), ask, self.settings.surface);
        self.ready = Some(ready.clone());
        ready
    }

    /// Asks until a reply is a policy that passes the check, or words for the person.
    fn rounds(
        &mut self,
        session: &Session,
        ready: &KeptParts,
        first: &[Message],
        goal: Option<&RequestGoal>,
    ) -> Result<Planned, PlanError> {
        let mut chat = first.to_vec();
        let mut refused: Vec<String> = Vec::new();
        let (mut round, mut failures) = (0, 0);
        loop {
            let name = self.model.name();
            self.listener.hear(&ModelEvent::Asked { round, model: &name, chat: &chat });
            match self.round(session, ready, (&chat, goal), round) {
                RoundResult::Good(planned) => return Ok(*planned),
                RoundResult::Said(words) => return Err(PlanError::Said { words }),
                RoundResult::Bad { reply, findings, otherwise } => {
                    let words = render::llm(&findings, &sources_of(&reply));
                    self.listener.hear(&ModelEvent::Refused { round, reply: &reply, findings: &words });
                    let written: String = reply.split_whitespace().collect();
                    let insists = refused.contains(&written);
                    if insists || round == self.settings.repairs {
                        return Err(match otherwise {
                            Some(planned) => PlanError::Doubtful { planned, diagnostics: findings },
                            None => PlanError::Refused { text: reply, diagnostics: findings },
                        });
                    }
                    refused.push(written);
                    chat.push(Message::new(Role::Assistant, reply));
                    chat.push(Message::new(Role::User, again(&words)));
                    round += 1;
                }
                RoundResult::Failed(ModelError::Cancelled) => return Err(PlanError::Stopped),
                // A reply that did not arrive is no reply to repair.
                RoundResult::Failed(why) if why.is_lasting() || failures == MOST_FAILURES => {
                    return Err(PlanError::NoModel { why: format!("{name}: {why}") });
                }
                RoundResult::Failed(_) => failures += 1,
            }
        }
    }

    fn round(
        &mut self,
        session: &Session,
        ready: &KeptParts,
        (chat, goal): (&[Message], Option<&RequestGoal>),
        round: u32,
    ) -> RoundResult {
        let mut reading = match self.settings.start {
            Start::Whole => StreamReader::unchecked(session),
            Start::FirstStep => StreamReader::new(session, ready.acceptors.acceptor(POLICY_BYTES)),
        };
        let mut reply = match self.model.ask(chat, &ready.grammar) {
            Ok(reply) => reply,
            Err(why) => return self.failed(round, "", why),
        };
        match self.read(&mut reading, &mut *reply, session) {
            Ok(ReadEnd::First(planned)) => {
                self.listener.hear(&ModelEvent::Begun { reply: reading.reply() });
                let rest = PendingRest::new(reply, reading.into_owned(), round, self.settings.checks);
                self.later = Some(Later::Reading(rest));
                RoundResult::Good(planned)
            }
            Ok(ReadEnd::Whole) => self.judged(session, reading.reply(), goal, round),
            Err(why) => self.failed(round, reading.reply(), why),
        }
    }

    /// Judges a whole reply.
    fn judged(
        &mut self,
        session: &Session,
        reply: &str,
        goal: Option<&RequestGoal>,
        round: u32,
    ) -> RoundResult {
        if let Some(words) = prose::for_person(reply) {
            self.listener.hear(&ModelEvent::Said { round, words: &words });
            return RoundResult::Said(words);
        }
        let bad = |findings, otherwise| RoundResult::Bad { reply: reply.to_owned(), findings, otherwise };
        // A person can stop the planner while it checks.
        let (own, text, wanted) = (session.clone(), reply.to_owned(), goal.cloned());
        let check = move || {
            let verdict = judge(&own, &text);
            let missed = match &verdict {
                ReplyVerdict::Good { planned, .. } => wanted.and_then(|goal| goal.missed(&own, planned)),
                ReplyVerdict::Bad { .. } => None,
            };
            (verdict, missed)
        };
        let check = BackgroundWork::start(CheckMode::Background, CHECK_WITHIN, check);
        let (verdict, missed) = match check.wait(|| self.listener.is_stopped()) {
            WorkProgress::Done(checked) => checked,
            WorkProgress::Coming => return self.failed(round, reply, ModelError::Cancelled),
            WorkProgress::Late => {
                let why = ModelError::TooInvolved { secs: CHECK_WITHIN.as_secs() };
                return self.failed(round, reply, why);
            }
        };
        match verdict {
            ReplyVerdict::Good { planned, mended, changed } => {
                // Other steps than were written are the model's to write, as long as it may.
                if !changed.is_empty() && round < self.settings.repairs {
                    return bad(changed, Some(planned));
                }
                if let Some((goal, missed)) = goal.zip(missed) {
                    if goal.certainty == Certainty::Certain {
                        return bad(vec![missed], Some(planned));
                    }
                    self.listener.hear(&ModelEvent::Unmet { goal: &print::expression(&goal.condition) });
                }
                if !mended.is_empty() {
                    self.listener.hear(&ModelEvent::Mended { titles: &mended });
                }
                self.listener.hear(&ModelEvent::Taken { round, reply });
                RoundResult::Good(planned)
            }
            ReplyVerdict::Bad { findings } => bad(findings, None),
        }
    }

    fn failed(&mut self, round: u32, reply: &str, why: ModelError) -> RoundResult {
        self.listener.hear(&ModelEvent::Failed { round, reply, why: &why });
        RoundResult::Failed(why)
    }

    /// Reads until the reply ends, or its policy does. Returning closes the connection.
    fn read(
        &mut self,
        reading: &mut StreamReader<'_>,
        reply: &mut dyn Reply,
        session: &Session,
    ) -> Result<ReadEnd, ModelError> {
        let mut begins = self.settings.start == Start::FirstStep;
        loop {
            if self.listener.is_stopped() {
                return Err(ModelError::Cancelled);
            }
            match reply.next(SLICE) {
                ReplyEvent::Nothing => {}
                ReplyEvent::Used(usage) => self.listener.hear(&ModelEvent::Used(usage)),
                ReplyEvent::Retrying { why, after } => {
                    self.listener.hear(&ModelEvent::Retrying { why: &why, after });
                }
                ReplyEvent::Piece(piece) => {
                    self.listener.hear(&ModelEvent::Wrote(&piece));
                    if reading.reply().len() + piece.len() > REPLY_BYTES {
                        return Err(ModelError::TooLong { bytes: REPLY_BYTES });
                    }
                    match reading.push(&piece) {
                        StreamVerdict::Steps(_) if std::mem::take(&mut begins) => {
                            let first = reading.first().and_then(|first| first_step(session, &first));
                            if let Some(planned) = first {
                                return Ok(ReadEnd::First(planned));
                            }
                        }
                        // The model learns of every error at once, so the reply is read to its end.
                        StreamVerdict::Wrong(_) => begins = false,
                        StreamVerdict::GoOn | StreamVerdict::Steps(_) | StreamVerdict::Whole => {}
                    }
                    if reading.is_whole() && self.settings.read_to == ReadTo::Policy {
                        return Ok(ReadEnd::Whole);
                    }
                }
                ReplyEvent::End(Finish::Stop) => return Ok(ReadEnd::Whole),
                ReplyEvent::End(Finish::Length) => {
                    let why = "it had written as much as it may".to_owned();
                    return Err(ModelError::CutOff { why });
                }
                ReplyEvent::Failed(why) => return Err(why),
            }
        }
    }
}

/// Messages around a request.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChatContext<'a> {
    /// Earlier messages. Those of the system follow the system's prompt; the others stand before the request.
    pub earlier: &'a [Message],
    /// Images that are shown with the request.
    pub images: &'a [Arc<CameraImage>],
}

impl ModelPlanner<'_> {
    /// Plans a policy for a request in an exchange of messages.
    ///
    /// # Errors
    ///
    /// Those of [`Planner::plan`].
    pub fn plan_in(
        &mut self,
        ask: &PlanRequest<'_>,
        exchange: ChatContext<'_>,
    ) -> Result<PlannedRequest, PlanError> {
        self.later = None;
        let ready = self.ready(ask);
        let mut chat = written(ask, &ready.lasting, (self.settings.tokens, prompt::TIME));
        let (system, said): (Vec<_>, Vec<_>) =
            exchange.earlier.iter().cloned().partition(|message| message.role == Role::System);
        if let Some(prompt) = chat.first_mut() {
            system.iter().for_each(|more| prompt.text.push_str(&format!("\n{}\n", more.text.trim())));
        }
        if let Some(request) = chat.last_mut() {
            request.images.extend(exchange.images.iter().cloned());
        }
        let behind_prompt = 1.min(chat.len());
        chat.splice(behind_prompt..behind_prompt, said);
        let goal = RequestGoal::new(ask.request, ask.situation);
        let planned = self.rounds(ask.session, &ready, &chat, goal.as_ref())?;
        let mut spoken_of = ask.situation.spoken_of.clone();
        spoken_of.extend(motet_requests::named(ask.request, ask.situation));
        Ok(PlannedRequest { understood: Intent { spoken_of, ..Intent::default() }, planned })
    }
}

impl Planner for ModelPlanner<'_> {
    fn plan(&mut self, ask: &PlanRequest<'_>) -> Result<PlannedRequest, PlanError> {
        motet_requests::check_length(ask.request)?;
        self.plan_in(ask, ChatContext::default())
    }

    fn reads_answers(&self) -> bool {
        true
    }

    fn begin(&mut self, ask: &PlanRequest<'_>) -> bool {
        if motet_requests::check_length(ask.request).is_err() {
            return false;
        }
        let (owned, kept) = (OwnedRequest::of(ask), self.ready.clone());
        let (tokens, surface, checks) = (self.settings.tokens, self.settings.surface, self.settings.checks);
        let write = move || {
            owned.with(|ask| {
                let ready = KeptParts::renewed(kept, ask, surface);
                let chat = written(ask, &ready.lasting, (tokens, prompt::TIME));
                (ready, chat)
            })
        };
        let written = BackgroundWork::start(checks, CHECK_WITHIN, write);
        self.later = Some(Later::Asking(ask.session.clone(), written));
        self.asks_on()
    }

    fn rest(&mut self, wait: Wait) -> RemainingSteps {
        loop {
            if self.later.is_none() {
                return RemainingSteps::Nothing;
            }
            if self.listener.is_stopped() {
                self.later = None;
                return RemainingSteps::Stopped;
            }
            if !self.asks_on() {
                return RemainingSteps::Broken;
            }
            let time = if wait == Wait::ToTheEnd { SLICE } else { Duration::ZERO };
            let (later, came) = match &mut self.later {
                Some(Later::Reading(later)) => {
                    let came = later.next(time);
                    (later, came)
                }
                Some(Later::Asking(..)) if wait == Wait::ToTheEnd => {
                    std::thread::sleep(SLICE);
                    continue;
                }
                Some(Later::Asking(..)) | None => return RemainingSteps::Coming,
            };
            let (round, reply) = (later.round, later.text.as_str());
            match came {
                RestProgress::Some(piece) => self.listener.hear(&ModelEvent::Wrote(&piece)),
                RestProgress::Nothing if wait == Wait::ToTheEnd => {}
                RestProgress::Nothing => return RemainingSteps::Coming,
                RestProgress::Whole(policy) => {
                    self.listener.hear(&ModelEvent::Taken { round, reply });
                    self.later = None;
                    return RemainingSteps::Whole(policy);
                }
                RestProgress::Wrong(findings) => {
                    let findings = render::llm(&findings, &sources_of(reply));
                    self.listener.hear(&ModelEvent::Refused { round, reply, findings: &findings });
                    self.later = None;
                    return RemainingSteps::Broken;
                }
                RestProgress::Failed(why) => {
                    self.listener.hear(&ModelEvent::Failed { round, reply, why: &why });
                    self.later = None;
                    return RemainingSteps::Broken;
                }
            }
        }
    }
}

impl ModelPlanner<'_> {
    /// Asks the model once the prompt is written. False if it cannot be asked.
    fn asks_on(&mut self) -> bool {
        let Some(Later::Asking(session, written)) = &self.later else { return true };
        let (ready, chat) = match written.progress() {
            WorkProgress::Coming => return true,
            WorkProgress::Done(written) => written,
            WorkProgress::Late => {
                self.later = None;
                return false;
            }
        };
        let name = self.model.name();
        self.listener.hear(&ModelEvent::Asked { round: 0, model: &name, chat: &chat });
        let acceptor = ready.acceptors.acceptor(POLICY_BYTES);
        let reading = StreamReader::new(session, acceptor).into_owned();
        self.later = match self.model.ask(&chat, &ready.grammar) {
            Ok(reply) => Some(Later::Reading(PendingRest::new(reply, reading, 0, self.settings.checks))),
            Err(_) => None,
        };
        self.ready = Some(ready);
        self.later.is_some()
    }
}

/// A reply as the file of its findings.
fn sources_of(reply: &str) -> Sources {
    let mut sources = Sources::default();
    sources.add(Source::new("reply", reply));
    sources
}

/// First messages to a model, within `tokens` as estimated from bytes. No motion is searched, so that the
/// same question gives the same chat.
#[must_use]
pub fn chat(ask: &PlanRequest<'_>, tokens: usize) -> Vec<Message> {
    chat_with(ask, &StaticPrompt::new(ask.session, ask.robot, ask.situation.scene), tokens)
}

/// The same with the parts that depend on robot and scene only, which may be kept between requests.
#[must_use]
pub fn chat_with(ask: &PlanRequest<'_>, lasting: &StaticPrompt, tokens: usize) -> Vec<Message> {
    written(ask, lasting, (tokens, Duration::ZERO))
}

/// Messages with the kept parts, and with the present sightings.
fn written(ask: &PlanRequest<'_>, lasting: &StaticPrompt, (tokens, time): (usize, Duration)) -> Vec<Message> {
    let prompt = Prompt {
        session: ask.session,
        robot: ask.robot,
        scene: ask.situation.scene,
        situation: ask.situation,
        memory: ask.memory,
        bound: ask.bound,
        lasting,
        tokens,
        time,
    };
    let written = prompt.write(&asked(ask));
    let images = ask.image.cloned().into_iter().map(Arc::new).collect();
    let asked = Message { images, ..Message::new(Role::User, written.user) };
    vec![Message::new(Role::System, written.system), asked]
}

/// The request, with the resolved meanings of its words.
fn asked(ask: &PlanRequest<'_>) -> String {
    let mut request = ask.request.to_owned();
    for (said, id) in &ask.situation.meant {
        request.push_str(&format!("\n(\"{said}\" is {id}.)"));
    }
    request
}

/// Message to the model about a wrong reply.
fn again(findings: &str) -> String {
    format!(
        "That policy cannot be carried out:\n{findings}\nAnswer the request again with one whole policy \
            that mends \
         this, and nothing else."
    )
}
