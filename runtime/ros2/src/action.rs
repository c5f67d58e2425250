//! Goals of an action server. The end of every goal is known, or it is said to be lost.
//!
//! The client chooses the id of a goal. So it can cancel a goal whose acceptance it never heard of: a server
//! may carry out a goal although its response was lost.

use crate::cdr::{Message, decode};
use crate::dds::{Dds, OwnEndpoint, Quality, Received, Source, dds_topic, dds_type};
use crate::layout::Layouts;
use crate::service::{Client, Interface, Middleware, Ticket};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Id of a goal.
pub(crate) type Uuid = [u8; 16];

/// Number of sources of one action: responses to goals, cancels and results, feedback, and states.
pub(crate) const SOURCES: Source = 5;

/// Time limit for a response to a goal.
const ACCEPTS: Duration = Duration::from_secs(2);
/// Time after which a result is asked for again, once the goal has ended or its server may have changed.
const ASKS_AGAIN: Duration = Duration::from_secs(2);
/// Time after which a cancel without a response is sent again.
const CANCELS_AGAIN: Duration = Duration::from_millis(500);
/// Number of times that a cancel is sent.
const CANCELS: u32 = 6;
/// Greatest number of goals that were given up and are still remembered.
const MAX_LOST: usize = 1_000;
/// Code of a cancel that a server refuses, in `action_msgs/CancelGoal`.
const REJECTED: f64 = 1.0;

/// Codes of the state of a goal in `action_msgs/GoalStatus`.
mod status {
    pub(crate) const UNKNOWN: i64 = 0;
    pub(crate) const ACCEPTED: i64 = 1;
    pub(crate) const EXECUTING: i64 = 2;
    pub(crate) const CANCELING: i64 = 3;
    pub(crate) const SUCCEEDED: i64 = 4;
    pub(crate) const CANCELED: i64 = 5;
    pub(crate) const ABORTED: i64 = 6;
}

/// End of a goal.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum End {
    /// The server refused it: nothing has moved.
    Rejected,
    Succeeded(Message),
    Aborted(Message),
    Canceled,
    /// Nobody knows what became of it, for a reason in words.
    Lost(String),
}

/// News of a goal.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum GoalEvent {
    Accepted(Uuid),
    Feedback(Uuid, Message),
    Ended(Uuid, End),
}

#[derive(Debug)]
struct Goal {
    id: Uuid,
    sent: Instant,
    ticket: Option<Ticket>,
    is_accepted: bool,
    /// Call for the result, with its time.
    asked: Option<(Ticket, Instant)>,
    /// Cancels: number, and time of the last.
    cancels: u32,
    canceled: Option<Instant>,
    is_cancel_heard: bool,
    /// Endpoints that it began with have been missing since.
    missing: Option<Instant>,
}

/// A goal that was given up. Its server may still carry it out, so it is canceled until the server says that
/// it does not.
#[derive(Debug)]
struct LostGoal {
    id: Uuid,
    cancels: u32,
    canceled: Instant,
    ticket: Option<Ticket>,
    /// The server says that the goal is over, is being canceled, or was never there.
    is_settled: bool,
}

/// Client of an action server.
pub(crate) struct ActionClient {
    /// Name of the action, such as `/arm_controller/follow_joint_trajectory`.
    pub(crate) name: String,
    type_name: String,
    send: Client,
    cancel: Client,
    result: Client,
    first: Source,
    goals: Vec<Goal>,
    /// Goals that were given up, the oldest first. A late acceptance of one is canceled.
    lost: Vec<LostGoal>,
    /// Cancel of all goals that the server has not answered, with its time.
    all: Option<(Option<Ticket>, Instant)>,
    /// True if the server told last that some goal is not over.
    is_busy: bool,
}

impl ActionClient {
    /// A client whose messages come with the numbers `first` to `first + SOURCES - 1`.
    ///
    /// # Errors
    ///
    /// Why DDS refuses its topics.
    pub(crate) fn new(
        dds: &Dds,
        middleware: Middleware,
        name: &str,
        type_name: &str,
        first: Source,
    ) -> Result<Self, String> {
        let client = |service: &str, interface: Interface<'_>, at: Source| {
            Client::new(dds, middleware, &format!("{name}/_action/{service}"), interface, first + at)
        };
        let own = |end| Interface { name: type_name, kind: "action", end };
        let send = client("send_goal", own("_SendGoal"), 0)?;
        let result = client("get_result", own("_GetResult"), 1)?;
        let cancel = Interface { name: "action_msgs/CancelGoal", kind: "srv", end: "" };
        let cancel = client("cancel_goal", cancel, 2)?;
        let feedback = dds_topic("rt", name, "/_action/feedback");
        dds.subscribe(
            &feedback,
            &dds_type(type_name, "action", "_FeedbackMessage"),
            Quality::Reliable,
            first + 3,
        )?;
        let states = dds_topic("rt", name, "/_action/status");
        dds.subscribe(
            &states,
            &dds_type("action_msgs/GoalStatusArray", "msg", ""),
            Quality::Latched,
            first + 4,
        )?;
        let (name, type_name) = (name.to_owned(), type_name.to_owned());
        let (goals, lost) = (Vec::new(), Vec::new());
        Ok(Self { name, type_name, send, cancel, result, first, goals, lost, all: None, is_busy: false })
    }

    /// Takes over the goals of a client whose participant was given up, and asks for their results again. The
    /// state that the server tells says if it has taken a goal whose answer was lost.
    pub(crate) fn adopt(&mut self, before: &mut Self) {
        self.lost = std::mem::take(&mut before.lost);
        self.lost.iter_mut().for_each(|lost| lost.ticket = None);
        self.goals = std::mem::take(&mut before.goals);
        self.all = before.all.map(|(_, sent)| (None, sent));
        self.is_busy = before.is_busy;
        for goal in &mut self.goals {
            (goal.ticket, goal.asked) = (None, None);
        }
    }

    /// Endpoints of the client: of its three services, and of the topics of feedback and states.
    pub(crate) fn endpoints(&self) -> Vec<OwnEndpoint> {
        let services = [&self.send, &self.cancel, &self.result].into_iter().flat_map(Client::endpoints);
        let feedback = dds_topic("rt", &self.name, "/_action/feedback");
        let feedback_type = dds_type(&self.type_name, "action", "_FeedbackMessage");
        let state_type = dds_type("action_msgs/GoalStatusArray", "msg", "");
        let topics = [
            OwnEndpoint::new(&feedback, &feedback_type, Quality::Reliable, false),
            OwnEndpoint::new(&self.status_topic(), &state_type, Quality::Latched, false),
        ];
        services.chain(topics).collect()
    }

    /// Topic on which the server tells the states of its goals.
    pub(crate) fn status_topic(&self) -> String {
        dds_topic("rt", &self.name, "/_action/status")
    }

    /// Endpoints of the server that DDS has not discovered, of all five. A goal that is sent before all are
    /// there could run without a way to hear of it.
    #[must_use]
    pub(crate) fn missing(&self, dds: &Dds) -> Vec<String> {
        let (readers, writers) = (dds.readers(), dds.writers());
        let mut missing = Vec::new();
        for client in [&self.send, &self.cancel, &self.result] {
            let [request, reply] = &client.topics;
            if readers.iter().all(|one| one.topic != *request)
                || writers.iter().all(|one| one.topic != *reply)
            {
                missing.push(request.trim_start_matches("rq/").trim_end_matches("Request").to_owned());
            }
        }
        for end in ["feedback", "status"] {
            let topic = dds_topic("rt", &self.name, &format!("/_action/{end}"));
            if writers.iter().all(|one| one.topic != topic) {
                missing.push(topic.trim_start_matches("rt/").to_owned());
            }
        }
        missing
    }

    /// Sends a goal; its id.
    ///
    /// # Errors
    ///
    /// The field that the layout lacks, or why DDS did not take it.
    pub(crate) fn start(&mut self, layouts: &Layouts, goal: &Value) -> Result<Uuid, String> {
        let mut id: Uuid = [0; 16];
        getrandom::fill(&mut id).map_err(|error| format!("no random number: {error}"))?;
        let ticket = self.send.call(layouts, &json!({"goal_id": {"uuid": id}, "goal": goal}))?;
        self.goals.push(Goal {
            id,
            sent: Instant::now(),
            ticket: Some(ticket),
            is_accepted: false,
            asked: None,
            cancels: 0,
            canceled: None,
            is_cancel_heard: false,
            missing: None,
        });
        Ok(id)
    }

    /// Cancels a goal, whether or not its server has accepted it. `tick` sends the cancel again until it is
    /// answered.
    pub(crate) fn cancel(&mut self, layouts: &Layouts, id: Uuid) {
        if let Some(goal) = self.goals.iter_mut().find(|goal| goal.id == id) {
            goal.cancels += 1;
            goal.canceled = Some(Instant::now());
        }
        // A cancel that DDS does not take is sent again.
        let ticket = self.cancel.call(layouts, &json!({"goal_info": {"goal_id": {"uuid": id}}})).ok();
        if let Some(lost) = self.lost.iter_mut().find(|lost| lost.id == id) {
            lost.ticket.take().into_iter().for_each(|ticket| self.cancel.forget(ticket));
            (lost.cancels, lost.canceled, lost.ticket) = (lost.cancels + 1, Instant::now(), ticket);
        }
    }

    /// Cancels all goals of the server, whoever sent them, and goals that were given up once more.
    pub(crate) fn cancel_all(&mut self, layouts: &Layouts) {
        self.all.and_then(|(ticket, _)| ticket).into_iter().for_each(|ticket| self.cancel.forget(ticket));
        // An id of zeros and no time stand for all goals.
        let ticket = self.cancel.call(layouts, &json!({})).ok();
        self.all = Some((ticket, Instant::now()));
        self.lost.iter_mut().filter(|lost| !lost.is_settled).for_each(|lost| lost.cancels = 0);
    }

    /// True if a goal that was given up runs no more, as far as its server says.
    #[must_use]
    pub(crate) fn is_settled(&self, id: Uuid) -> bool {
        self.lost.iter().all(|lost| lost.id != id || lost.is_settled)
    }

    /// True if the server says that no goal runs, and has answered the cancel of all goals.
    #[must_use]
    pub(crate) fn is_idle(&self) -> bool {
        self.all.is_none() && !self.is_busy && self.lost.iter().all(|lost| lost.is_settled)
    }

    /// Takes in a message of this action.
    ///
    /// # Errors
    ///
    /// Why it is none of its layout.
    pub(crate) fn hear(&mut self, layouts: &Layouts, received: &Received) -> Result<Vec<GoalEvent>, String> {
        let bytes = &received.bytes;
        match received.source - self.first {
            0 => Ok(self.send.hear(layouts, received)?.map_or_else(Vec::new, |(ticket, response)| {
                self.answered(layouts, ticket, response.is_true("accepted"))
            })),
            1 => Ok(self
                .result
                .hear(layouts, received)?
                .map_or_else(Vec::new, |(ticket, response)| self.ended(layouts, ticket, response))),
            2 => {
                if let Some((ticket, response)) = self.cancel.hear(layouts, received)? {
                    let listed =
                        response.list("goals_canceling").iter().filter_map(|info| uuid(info, "goal_id"));
                    let listed: Vec<Uuid> = listed.collect();
                    self.goals.iter_mut().for_each(|goal| goal.is_cancel_heard |= listed.contains(&goal.id));
                    let is_rejected = response.number("return_code") == REJECTED;
                    if self.all.is_some_and(|(asked, _)| asked == Some(ticket)) {
                        self.all = None;
                        self.is_busy &= is_rejected || !listed.is_empty();
                    }
                    // A server that lists the goal heeds; one that does not know it, or says that it is over,
                    // does not carry it out.
                    for lost in self.lost.iter_mut().filter(|lost| lost.ticket == Some(ticket)) {
                        lost.is_settled |= !is_rejected;
                    }
                }
                Ok(Vec::new())
            }
            3 => {
                let message = decode(layouts, &format!("{}_FeedbackMessage", self.type_name), bytes)?;
                let id = uuid(&message, "goal_id").filter(|id| self.goals.iter().any(|goal| goal.id == *id));
                let feedback = message.get("feedback").cloned();
                Ok(id
                    .zip(feedback)
                    .map(|(id, feedback)| GoalEvent::Feedback(id, feedback))
                    .into_iter()
                    .collect())
            }
            _ => {
                let message = decode(layouts, "action_msgs/GoalStatusArray", bytes)?;
                Ok(self.states(layouts, &message))
            }
        }
    }

    /// Takes in the response to a goal.
    fn answered(&mut self, layouts: &Layouts, ticket: Ticket, is_accepted: bool) -> Vec<GoalEvent> {
        let Some(at) = self.goals.iter().position(|goal| goal.ticket == Some(ticket)) else {
            return Vec::new();
        };
        self.goals[at].ticket = None;
        if is_accepted {
            return self.accepted(layouts, at).into_iter().collect();
        }
        if self.goals[at].is_accepted {
            return Vec::new();
        }
        let goal = self.goals.swap_remove(at);
        vec![GoalEvent::Ended(goal.id, End::Rejected)]
    }

    /// Notes that the server carries a goal out, and asks for its result.
    fn accepted(&mut self, layouts: &Layouts, at: usize) -> Option<GoalEvent> {
        let id = self.goals[at].id;
        if self.goals[at].is_accepted {
            return None;
        }
        self.goals[at].is_accepted = true;
        self.ask(layouts, at);
        Some(GoalEvent::Accepted(id))
    }

    fn ask(&mut self, layouts: &Layouts, at: usize) {
        let id = self.goals[at].id;
        if let Some((ticket, _)) = self.goals[at].asked.take() {
            self.result.forget(ticket);
        }
        let ticket = self.result.call(layouts, &json!({"goal_id": {"uuid": id}}));
        self.goals[at].asked = ticket.ok().map(|ticket| (ticket, Instant::now()));
    }

    /// Takes in the result of a goal.
    fn ended(&mut self, layouts: &Layouts, ticket: Ticket, response: Message) -> Vec<GoalEvent> {
        let is_asked = |goal: &Goal| goal.asked.is_some_and(|(asked, _)| asked == ticket);
        let Some(at) = self.goals.iter().position(is_asked) else { return Vec::new() };
        let result = response.get("result").cloned().unwrap_or(Message::Bool(false));
        #[allow(clippy::cast_possible_truncation, reason = "a status is small")]
        let end = match response.number("status") as i64 {
            status::SUCCEEDED => End::Succeeded(result),
            status::ABORTED => End::Aborted(result),
            status::CANCELED => End::Canceled,
            // The server does not know the goal, such as one that was started anew. It may know it later.
            status::UNKNOWN => return self.lose(layouts, at, "the action server does not know the goal"),
            other => {
                return self.lose(layouts, at, &format!("the action server answers with the status {other}"));
            }
        };
        vec![GoalEvent::Ended(self.goals.swap_remove(at).id, end)]
    }

    /// Gives a goal up. A server may still carry it out, so it is canceled by its id.
    fn lose(&mut self, layouts: &Layouts, at: usize, why: &str) -> Vec<GoalEvent> {
        let goal = self.goals.swap_remove(at);
        goal.ticket.into_iter().for_each(|ticket| self.send.forget(ticket));
        goal.asked.into_iter().for_each(|(ticket, _)| self.result.forget(ticket));
        let (id, canceled) = (goal.id, Instant::now());
        self.lost.push(LostGoal { id, cancels: 0, canceled, ticket: None, is_settled: false });
        if self.lost.len() > MAX_LOST {
            self.lost.remove(0);
        }
        self.cancel(layouts, id);
        vec![GoalEvent::Ended(goal.id, End::Lost(format!("{why} ({})", self.name)))]
    }

    /// Gives up a goal of which nobody waits for the end any more.
    pub(crate) fn give_up(&mut self, layouts: &Layouts, id: Uuid) {
        if let Some(at) = self.goals.iter().position(|goal| goal.id == id) {
            self.lose(layouts, at, "nobody waits for its end");
        }
    }

    /// Takes in the states of all goals of the server.
    fn states(&mut self, layouts: &Layouts, message: &Message) -> Vec<GoalEvent> {
        let mut news = Vec::new();
        self.is_busy = false;
        for state in message.list("status_list") {
            let Some(id) = uuid(state, "goal_info.goal_id") else { continue };
            #[allow(clippy::cast_possible_truncation, reason = "a status is small")]
            let status = state.number("status") as i64;
            self.is_busy |= (status::ACCEPTED..=status::CANCELING).contains(&status);
            if let Some(lost) = self.lost.iter_mut().find(|lost| lost.id == id) {
                lost.is_settled = status > status::EXECUTING;
                if !lost.is_settled && lost.canceled.elapsed() > CANCELS_AGAIN {
                    self.cancel(layouts, id);
                }
            }
            let Some(at) = self.goals.iter().position(|goal| goal.id == id) else { continue };
            if (status::EXECUTING..=status::ABORTED).contains(&status) {
                // The response to the goal may be lost: its state says that it was accepted.
                news.extend(self.accepted(layouts, at));
            }
            self.goals[at].is_cancel_heard |= status == status::CANCELING;
            let is_over = status > status::CANCELING;
            if is_over && self.goals[at].asked.is_none_or(|(_, asked)| asked.elapsed() > ASKS_AGAIN) {
                self.ask(layouts, at);
            }
        }
        news
    }

    /// Lets time pass: repeats what was not answered, and gives up goals that nobody answers for.
    /// `is_there` says if DDS knows the endpoints of the server.
    pub(crate) fn tick(&mut self, layouts: &Layouts, is_there: bool) -> Vec<GoalEvent> {
        let mut news = Vec::new();
        self.repeat_cancels(layouts);
        self.is_busy &= is_there;
        let mut at = 0;
        while at < self.goals.len() {
            let goal = &mut self.goals[at];
            goal.missing = if is_there { None } else { goal.missing.or(Some(Instant::now())) };
            let is_unheard = goal.cancels > 0 && goal.cancels < CANCELS && !goal.is_cancel_heard;
            if is_unheard && goal.canceled.is_some_and(|sent| sent.elapsed() > CANCELS_AGAIN) {
                let id = goal.id;
                self.cancel(layouts, id);
            }
            let goal = &self.goals[at];
            if !goal.is_accepted && goal.sent.elapsed() > ACCEPTS {
                news.extend(self.lose(layouts, at, "the action server did not answer the goal within 2 s"));
            } else if goal.missing.is_some_and(|since| since.elapsed() > ASKS_AGAIN) {
                news.extend(self.lose(layouts, at, "the action server has left"));
            } else {
                // A server that was started anew does not know the goal, and says so.
                if goal.is_accepted && goal.asked.is_none_or(|(_, asked)| asked.elapsed() > 5 * ASKS_AGAIN) {
                    self.ask(layouts, at);
                }
                at += 1;
            }
        }
        news
    }

    /// Sends again what cancels goals that were given up, and all goals, until it is answered.
    fn repeat_cancels(&mut self, layouts: &Layouts) {
        let is_due = |lost: &&LostGoal| {
            !lost.is_settled && lost.cancels < CANCELS && lost.canceled.elapsed() > CANCELS_AGAIN
        };
        let due: Vec<Uuid> = self.lost.iter().filter(is_due).map(|lost| lost.id).collect();
        due.into_iter().for_each(|id| self.cancel(layouts, id));
        if self.all.is_some_and(|(_, sent)| sent.elapsed() > CANCELS_AGAIN) {
            self.cancel_all(layouts);
        }
    }
}

/// Id of a goal at a path.
#[must_use]
pub(crate) fn uuid(message: &Message, path: &str) -> Option<Uuid> {
    match message.get(&format!("{path}.uuid"))? {
        Message::Bytes(bytes) => bytes.as_slice().try_into().ok(),
        _ => None,
    }
}
