//! The client of the server: messages to it, and refusals of what it asks.

use crossbeam_channel::Sender;
use lsp_server::{ErrorCode, Message, Notification as Note, Request, RequestId, Response};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::protocol;

/// Sender of messages to the client.
#[derive(Clone)]
pub(crate) struct Client {
    messages: Sender<Value>,
}

impl Client {
    pub(crate) fn new(messages: Sender<Value>) -> Self {
        Self { messages }
    }

    pub(crate) fn send_value(&self, message: Value) {
        // A client that is gone reads nothing.
        let _ = self.messages.send(message);
    }

    fn send(&self, message: Message) {
        let Ok(mut value) = serde_json::to_value(message) else { return };
        if let Value::Object(object) = &mut value {
            object.insert("jsonrpc".to_owned(), "2.0".into());
        }
        self.send_value(value);
    }

    pub(crate) fn answer(&self, id: RequestId, result: Result<Value, RequestError>) {
        self.send(match result {
            Ok(value) => Response::new_ok(id, value).into(),
            Err(error) => Response::new_err(id, error.code as i32, error.problem).into(),
        });
    }

    pub(crate) fn notify<N: protocol::Notification>(&self, params: N::Params) {
        self.send(Note::new(N::METHOD.to_owned(), params).into());
    }

    /// Sends a request whose answer does not matter.
    pub(crate) fn ask<R: protocol::RequestKind>(&self, params: Value) {
        let id = RequestId::from(format!("motet {}", R::METHOD));
        self.send(Request::new(id, R::METHOD.to_owned(), params).into());
    }

    /// Shows a sentence to the person.
    pub(crate) fn show(&self, message: String, is_success: bool) {
        let typ = if is_success { protocol::MessageType::INFO } else { protocol::MessageType::WARNING };
        self.notify::<protocol::ShowMessage>(protocol::ShowMessageParams { typ, message });
    }
}

/// Refusal of a request.
#[derive(Debug)]
pub(crate) struct RequestError {
    code: ErrorCode,
    problem: String,
}

impl RequestError {
    pub(crate) fn new(code: ErrorCode, problem: impl Into<String>) -> Self {
        Self { code, problem: problem.into() }
    }

    pub(crate) fn failed(problem: impl Into<String>) -> Self {
        Self::new(ErrorCode::RequestFailed, problem)
    }

    pub(crate) fn cancelled() -> Self {
        Self::new(ErrorCode::RequestCanceled, "the request was cancelled")
    }
}

/// Reads the parameters of a message.
pub(crate) fn read<P: DeserializeOwned>(params: Value) -> Result<P, RequestError> {
    serde_json::from_value(params)
        .map_err(|error| RequestError::new(ErrorCode::InvalidParams, format!("wrong parameters: {error}")))
}

/// Writes a result.
pub(crate) fn written(result: impl Serialize) -> Result<Value, RequestError> {
    serde_json::to_value(result).map_err(|error| RequestError::failed(error.to_string()))
}
