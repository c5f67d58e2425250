//! Early start: the first step of a policy runs while the model still writes the rest.
//!
//! A complete first step is a policy of its own if no later step can refute it: all its needs are proven,
//! and its motions have witnesses if motions are computed. The rest can still be wrong; then the request is
//! planned anew from the state after the first step.

use std::time::Duration;

use motet_compiler::{Library, Session, make_explicit};
use motet_graph::{Graph, NodeKind, Value, Verdict as Proof};
use motet_syntax::{Syntax, print};
use serde_json::{Map, Value as Json};
use smol_str::SmolStr;

use super::chat::{Finish, ModelError, News, Reply};
use super::stream_reader::{StreamReader, StreamVerdict};
use crate::planned::Planned;
use crate::reply_verdict::{ReplyVerdict, errors, judge, read};

/// The rest of a policy whose first step was returned.
pub(super) struct PendingRest {
    pub(super) reply: Box<dyn Reply>,
    pub(super) reading: StreamReader<'static>,
    pub(super) round: u32,
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
    /// Reads on, waiting at most `wait`.
    pub(super) fn next(&mut self, wait: Duration) -> RestProgress {
        match self.reply.next(wait) {
            News::Nothing | News::Used(_) | News::Retrying { .. } => RestProgress::Nothing,
            News::Piece(piece) => match self.reading.push(&piece) {
                StreamVerdict::GoOn | StreamVerdict::Steps(_) => RestProgress::Some(piece),
                StreamVerdict::Whole => RestProgress::Whole(self.reading.policy().to_owned()),
                StreamVerdict::Wrong(wrong) => RestProgress::Wrong(wrong.findings),
            },
            // A reply in the text form is no object that could be followed.
            News::End(Finish::Stop) if self.reading.policy().is_empty() => {
                RestProgress::Whole(self.reading.reply().to_owned())
            }
            News::End(Finish::Stop) => RestProgress::Whole(self.reading.policy().to_owned()),
            News::End(Finish::Length) => RestProgress::Failed(ModelError::CutOff {
                why: "it had written as much as it may".to_owned(),
            }),
            News::Failed(why) => RestProgress::Failed(why),
        }
    }
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
