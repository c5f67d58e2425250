//! Early start: the first step of a policy runs while the model still writes the rest.
//!
//! A complete first step is a policy of its own if no later step can refute it: all its needs are proven,
//! and its motions have witnesses if motions are computed. The rest can still be wrong; then the request is
//! planned anew from the state after the first step.

use std::sync::mpsc::{self, Receiver, Sender};
use std::time::{Duration, Instant};

use motet_compiler::{Library, Session, make_explicit};
use motet_graph::{Graph, NodeKind, Value, Verdict as Proof};
use motet_syntax::{Syntax, print};
use serde_json::{Map, Value as Json};
use smol_str::SmolStr;

use super::chat::{Finish, ModelError, Reply, ReplyEvent};
use super::stream_reader::{StreamReader, StreamVerdict};
use crate::background_work::CHECK_WITHIN;
use crate::planned::Planned;
use crate::reply_verdict::{ReplyVerdict, errors, judge, read};
use crate::runtime_check::CheckMode;

/// Maximum number of bytes of a reply, thoughts included.
pub(super) const REPLY_BYTES: usize = 256 << 10;

/// The rest of a policy whose first step was returned, or a policy that is written during a run.
pub(super) struct PendingRest {
    reply: Box<dyn Reply>,
    /// Text of the reply so far.
    pub(super) text: String,
    reader: RestReader,
    pub(super) round: u32,
    /// End of the time for the check, once the reply has ended.
    until: Option<Instant>,
}

/// Progress of the remaining policy.
pub(super) enum RestProgress {
    /// A part of it.
    Some(String),
    Nothing,
    /// The whole policy.
    Whole(String),
    /// No usable rest of the policy.
    Wrong(Vec<motet_syntax::Diagnostic>),
    Failed(ModelError),
}

impl PendingRest {
    /// The rest of a reply of which a reader has read the first pieces.
    pub(super) fn new(
        reply: Box<dyn Reply>,
        reading: StreamReader<'static>,
        round: u32,
        mode: CheckMode,
    ) -> Self {
        let text = reading.reply().to_owned();
        Self { reply, text, reader: RestReader::new(reading, mode), round, until: None }
    }

    /// Reads on, waiting at most `wait`.
    pub(super) fn next(&mut self, wait: Duration) -> RestProgress {
        let is_over = self.until.is_some();
        if let Some(over) = self.reader.verdict(if is_over { wait } else { Duration::ZERO }) {
            return over;
        }
        if let Some(until) = self.until {
            if Instant::now() < until {
                return RestProgress::Nothing;
            }
            return RestProgress::Failed(ModelError::TooInvolved { secs: CHECK_WITHIN.as_secs() });
        }
        match self.reply.next(wait) {
            ReplyEvent::Nothing | ReplyEvent::Used(_) | ReplyEvent::Retrying { .. } => RestProgress::Nothing,
            ReplyEvent::Piece(piece) => {
                if self.text.len() + piece.len() > REPLY_BYTES {
                    return RestProgress::Failed(ModelError::TooLong { bytes: REPLY_BYTES });
                }
                self.text.push_str(&piece);
                self.reader.push(&piece);
                self.reader.verdict(Duration::ZERO).unwrap_or(RestProgress::Some(piece))
            }
            ReplyEvent::End(Finish::Stop) => {
                self.reader.end();
                self.until = Some(Instant::now() + CHECK_WITHIN);
                self.reader.verdict(Duration::ZERO).unwrap_or(RestProgress::Nothing)
            }
            ReplyEvent::End(Finish::Length) => RestProgress::Failed(ModelError::CutOff {
                why: "it had written as much as it may".to_owned(),
            }),
            ReplyEvent::Failed(why) => RestProgress::Failed(why),
        }
    }
}

/// Reader of the pieces of a reply, which checks the steps as they come.
enum RestReader {
    AtOnce(Box<StreamReader<'static>>, Option<RestProgress>),
    /// Thread that reads the pieces and ends with the last sender.
    Background {
        pieces: Option<Sender<String>>,
        verdicts: Receiver<RestProgress>,
    },
}

impl RestReader {
    fn new(mut reading: StreamReader<'static>, mode: CheckMode) -> Self {
        match mode {
            CheckMode::AtOnce => Self::AtOnce(Box::new(reading), None),
            CheckMode::Background => {
                let (pieces, written) = mpsc::channel::<String>();
                let (told, verdicts) = mpsc::channel();
                std::thread::spawn(move || {
                    let over = written.into_iter().find_map(|piece| read_on(&mut reading, &piece));
                    // Nobody may wait for it any more.
                    let _ = told.send(over.unwrap_or_else(|| RestProgress::Whole(whole(&reading))));
                });
                Self::Background { pieces: Some(pieces), verdicts }
            }
        }
    }

    fn push(&mut self, piece: &str) {
        match self {
            Self::AtOnce(reading, over) => {
                let read = read_on(reading, piece);
                *over = over.take().or(read);
            }
            Self::Background { pieces, .. } => {
                // A thread that has read enough takes no more.
                let _ = pieces.as_ref().map(|pieces| pieces.send(piece.to_owned()));
            }
        }
    }

    /// Ends the reply.
    fn end(&mut self) {
        match self {
            Self::AtOnce(reading, over) => {
                over.get_or_insert_with(|| RestProgress::Whole(whole(reading)));
            }
            Self::Background { pieces, .. } => *pieces = None,
        }
    }

    /// Verdict on the whole policy, once there is one; waits for it at most `wait`.
    fn verdict(&mut self, wait: Duration) -> Option<RestProgress> {
        match self {
            Self::AtOnce(_, over) => over.take(),
            Self::Background { verdicts, .. } => verdicts.recv_timeout(wait).ok(),
        }
    }
}

/// Takes a piece. `None` while the policy goes on.
fn read_on(reading: &mut StreamReader<'static>, piece: &str) -> Option<RestProgress> {
    match reading.push(piece) {
        StreamVerdict::GoOn | StreamVerdict::Steps(_) => None,
        StreamVerdict::Whole => Some(RestProgress::Whole(reading.policy().to_owned())),
        StreamVerdict::Wrong(wrong) => Some(RestProgress::Wrong(wrong.findings)),
    }
}

/// The policy of a reply that has ended. A reply in the text form is no object that could be followed.
fn whole(reading: &StreamReader<'static>) -> String {
    let policy = reading.policy();
    if policy.is_empty() { reading.reply().to_owned() } else { policy.to_owned() }
}

/// The first step of an unfinished policy as a policy of its own, if it may start.
pub(super) fn first_step(session: &Session, policy: &str) -> Option<Box<Planned>> {
    let mut policy: Map<String, Json> = serde_json::from_str(policy).ok()?;
    // What the whole policy reaches, one step need not.
    policy.remove("achieves");
    match judge(session, &Json::Object(policy).to_string()) {
        ReplyVerdict::Good { planned, mended, .. } if mended.is_empty() => {
            let graph = planned.compiled.graph.as_ref()?;
            is_certain(graph).then_some(planned)
        }
        ReplyVerdict::Good { .. } | ReplyVerdict::Bad { .. } => None,
    }
}

/// True if the graph acts, and no guard or motion is deferred.
fn is_certain(graph: &Graph) -> bool {
    let mut calls = 0;
    let certain = graph.nodes.iter().all(|node| match &node.kind {
        NodeKind::Call(call) => {
            calls += 1;
            let is_deferred =
                |motion: &motet_graph::Motion| motion.verdict == Proof::Deferred && motion.why.is_some();
            call.needs.iter().all(|need| need.verdict == Proof::Proven)
                && !call.motion.as_ref().is_some_and(is_deferred)
        }
        NodeKind::End { .. } => false,
        _ => true,
    });
    certain && calls > 0
}

/// A policy without its first step, in which bindings of that step are replaced by their values; `None` if
/// nothing is left.
///
/// # Errors
///
/// The text is not a policy.
pub fn without_first_step(
    policy: &str,
    bound: &[(SmolStr, Value)],
    library: &Library,
) -> Result<Option<String>, serde_json::Error> {
    // A condition in the text syntax is one string, whatever names it has in it.
    let parsed = read(policy);
    let is_read = errors(parsed.diagnostics).is_empty();
    let spelled = parsed.file.policies().next().filter(|_| is_read).cloned().map(|mut policy| {
        make_explicit(&mut policy, library, Syntax::Json);
        print::policy_json(&policy)
    });
    let mut policy: Map<String, Json> = serde_json::from_str(spelled.as_deref().unwrap_or(policy))?;
    let Some(Json::Array(steps)) = policy.get_mut("steps") else { return Ok(None) };
    if steps.len() < 2 {
        return Ok(None);
    }
    steps.remove(0);
    // A name that a later step binds again had no value behind the first.
    let visible = bound.iter().filter(|(name, _)| !steps.iter().any(|step| binds(step, name)));
    let visible: Vec<_> = visible.cloned().collect();
    steps.iter_mut().for_each(|step| fill_in(step, &visible));
    Ok(Some(Json::Object(policy).to_string()))
}

/// True if a step, or a step in it, binds a name.
fn binds(json: &Json, name: &str) -> bool {
    match json {
        Json::Array(items) => items.iter().any(|item| binds(item, name)),
        Json::Object(keys) => {
            ["as", "each"].iter().any(|key| keys.get(*key).and_then(Json::as_str) == Some(name))
                || keys.values().any(|value| binds(value, name))
        }
        Json::String(_) | Json::Null | Json::Bool(_) | Json::Number(_) => false,
    }
}

fn fill_in(json: &mut Json, bound: &[(SmolStr, Value)]) {
    match json {
        Json::String(text) => {
            let value = text.strip_prefix('$').and_then(|name| bound.iter().find(|(known, _)| known == name));
            if let Some(value) = value.and_then(|(_, value)| written(value)) {
                *json = value;
            }
        }
        Json::Array(items) => items.iter_mut().for_each(|item| fill_in(item, bound)),
        Json::Object(keys) => keys.values_mut().for_each(|value| fill_in(value, bound)),
        Json::Null | Json::Bool(_) | Json::Number(_) => {}
    }
}

/// A value in policy syntax; `None` for a pose, which has no name.
fn written(value: &Value) -> Option<Json> {
    Some(match value {
        Value::Entity(name) | Value::Case(name) => Json::String(name.to_string()),
        Value::Text(text) => Json::String(text.to_string()),
        Value::List(items) => Json::Array(items.iter().map(written).collect::<Option<_>>()?),
        Value::Bool(value) => Json::Bool(*value),
        Value::Int(value) => Json::from(*value),
        Value::Number(value) => Json::from(*value),
        Value::Pose(_) => return None,
    })
}

#[cfg(test)]
mod tests {
    use motet_compiler::Session;
    use motet_graph::Value;
    use motet_syntax::Sources;
    use serde_json::{Value as Json, json};

    /// The steps that are left behind a first step that bound `mug`.
    fn check(steps: Json, expected: Json) {
        let policy = json!({"motet": 1, "policy": "p", "steps": steps}).to_string();
        let bound = [("mug".into(), Value::Entity("mug_1".into()))];
        let session = Session::builder().build(&mut Sources::default());
        let rest = super::without_first_step(&policy, &bound, session.library()).unwrap().unwrap();
        let rest: Json = serde_json::from_str(&rest).unwrap();
        assert_eq!(rest["steps"], expected);
    }

    #[test]
    fn without_first_step_replaces_names_by_values() {
        let search = json!({"try": [{"do": "detect", "what": "mug", "as": "mug"}],
            "catch": [{"on": ["any"], "steps": [{"end": "done"}]}]});
        check(
            json!([search, {"do": "pick", "object": "$mug"},
                {"if": "holding($mug) or visible(mug)", "then": [{"do": "say", "text": "mug"}]}]),
            json!([{"do": "pick", "object": "mug_1"},
                {"if": {"any": [{"is": "holding", "object": "mug_1"}, {"is": "visible", "entity": "mug_1"}]},
                    "then": [{"do": "say", "text": "mug"}]}]),
        );
        // A name that is bound again had no value behind the first step.
        check(
            json!([{"if": "visible(user)", "then": [search]}, search, {"do": "pick", "object": "$mug"}]),
            json!([search, {"do": "pick", "object": "$mug"}]),
        );
    }
}
