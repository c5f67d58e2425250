//! Runs in the words of the protocol: as tasks of its extension, and questions of policies as requests for
//! input.

use rmcp::model::{
    DetailedTask, InputRequest, InputRequests, InputRequiredResult, InputResponses, Task, TaskPayload,
    TaskStatus,
};
use serde_json::{Value, json};

use super::answer::{Refusal, ToolAnswer};
use super::run_table::{OpenQuestion, RunRecord, RunTable};
use super::text::{MAX_TEXT_BYTES, within};

/// Interval in ms at which a client should look after a task.
const POLL_MS: u64 = 500;

/// Run as a task.
pub(super) fn task(run: &RunRecord) -> DetailedTask {
    let mut task = Task::new(&run.id, TaskStatus::Working, &run.created, &run.updated);
    task.status_message = Some(run.message.clone());
    task.poll_interval_ms = Some(POLL_MS);
    let payload = match (&run.ending, &run.question) {
        (Some(ending), _) if ending.outcome == "interrupted" => TaskPayload::Cancelled,
        (Some(ending), _) => {
            let mut result = ToolAnswer::from(run.report()).into_result();
            result.is_error = Some(ending.outcome != "done");
            let result = serde_json::to_value(result).ok().and_then(|result| result.as_object().cloned());
            TaskPayload::Completed { result: result.unwrap_or_default() }
        }
        (None, Some(question)) => request(question)
            .map_or(TaskPayload::Working, |input_requests| TaskPayload::InputRequired { input_requests }),
        (None, None) => TaskPayload::Working,
    };
    DetailedTask::new(task, payload)
}

/// Open question of a run as the result of a call, whose state is the id of the run.
pub(super) fn input_required(run: &RunRecord) -> Option<InputRequiredResult> {
    let requests = request(run.question.as_ref().filter(|_| run.ending.is_none())?)?;
    Some(InputRequiredResult::new(Some(requests), Some(run.id.clone())))
}

/// Question as a form with one field.
fn request(question: &OpenQuestion) -> Option<InputRequests> {
    let answer = if question.options.is_empty() {
        json!({"type": "string", "title": "Answer", "maxLength": MAX_TEXT_BYTES})
    } else {
        json!({"type": "string", "title": "Answer", "enum": question.options})
    };
    let request = json!({
        "method": "elicitation/create",
        "params": {
            "mode": "form",
            "message": question.text,
            "requestedSchema": {
                "type": "object", "properties": {"answer": answer}, "required": ["answer"],
            },
        },
    });
    let request: InputRequest = serde_json::from_value(request).ok()?;
    Some([(question.key.clone(), request)].into_iter().collect())
}

/// Takes in responses to the questions of a run.
pub(super) fn answer_all(runs: &RunTable, run: &str, responses: &InputResponses) -> Result<(), Refusal> {
    responses.iter().try_for_each(|(key, response)| runs.answer(run, Some(key), given_answer(response)?))
}

/// Answer in a response: `None` if it is declined or cancelled.
fn given_answer(response: &Value) -> Result<Option<String>, Refusal> {
    let text = |pointer: &str| response.pointer(pointer).and_then(Value::as_str);
    match text("/action") {
        Some("accept") => {
            let missing = || Refusal::new("the response has no `answer`");
            let answer = text("/content/answer").ok_or_else(missing)?;
            within("answer", answer)?;
            Ok(Some(answer.to_owned()))
        }
        Some("decline" | "cancel") => Ok(None),
        _ => Err(Refusal::new("the `action` of a response is accept, decline or cancel")),
    }
}
