//! Requests that wait, and those that are answered from threads of their own, so that the loop goes on. Each
//! is answered once: with its result, or as cancelled.

use std::collections::{BTreeMap, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use lsp_server::{ErrorCode, Message, RequestId};
use serde_json::Value;

use super::client::{Client, RequestError};
use crate::protocol::{self, Notification as _};
use crate::transport::Incoming;

/// Messages in their order.
#[derive(Debug, Default)]
pub(crate) struct Inbox {
    messages: VecDeque<Incoming>,
}

impl Inbox {
    pub(crate) fn extend(&mut self, messages: impl IntoIterator<Item = Incoming>) {
        self.messages.extend(messages);
    }

    pub(crate) fn pop(&mut self) -> Option<Incoming> {
        self.messages.pop_front()
    }

    /// Returns whether a message that waits cancels a request.
    pub(crate) fn takes_back(&self, id: &RequestId) -> bool {
        self.messages.iter().any(|message| cancelled(message).as_ref() == Some(id))
    }
}

/// Request that a message cancels.
fn cancelled(message: &Incoming) -> Option<RequestId> {
    let Incoming::Message(Message::Notification(note)) = message else { return None };
    if note.method != protocol::Cancel::METHOD {
        return None;
    }
    let params: protocol::CancelParams = serde_json::from_value(note.params.clone()).ok()?;
    Some(request_id(params.id))
}

/// Number or name of a request.
pub(crate) fn request_id(id: protocol::NumberOrString) -> RequestId {
    match id {
        protocol::NumberOrString::Number(id) => id.into(),
        protocol::NumberOrString::String(id) => id.into(),
    }
}

/// Requests that are not answered yet, each with a flag that stops it.
type Unanswered = Arc<Mutex<BTreeMap<RequestId, Arc<AtomicBool>>>>;

/// Threads that answer requests.
pub(crate) struct Tasks {
    client: Client,
    unanswered: Unanswered,
}

impl Tasks {
    pub(crate) fn new(client: Client) -> Self {
        Self { client, unanswered: Arc::default() }
    }

    /// Answers a request from a thread. The work looks at the flag now and then.
    pub(crate) fn start(
        &self,
        id: RequestId,
        work: impl FnOnce(&AtomicBool) -> Result<Value, RequestError> + Send + 'static,
    ) {
        let is_stopped = Arc::new(AtomicBool::new(false));
        lock(&self.unanswered).insert(id.clone(), Arc::clone(&is_stopped));
        let (client, unanswered) = (self.client.clone(), Arc::clone(&self.unanswered));
        thread::spawn(move || {
            let answer = guarded(|| work(&is_stopped));
            if lock(&unanswered).remove(&id).is_some() {
                client.answer(id, answer);
            }
        });
    }

    /// Stops a request, and answers it.
    pub(crate) fn cancel(&self, id: &RequestId) {
        let stopped = lock(&self.unanswered).remove(id);
        if let Some(is_stopped) = stopped {
            is_stopped.store(true, Ordering::Relaxed);
            self.client.answer(id.clone(), Err(RequestError::cancelled()));
        }
    }

    /// Stops all requests without an answer.
    pub(crate) fn stop_all(&self) {
        std::mem::take(&mut *lock(&self.unanswered))
            .values()
            .for_each(|is_stopped| is_stopped.store(true, Ordering::Relaxed));
    }
}

/// Result of some work; a fault in it is an error, and the server goes on.
pub(crate) fn guarded(work: impl FnOnce() -> Result<Value, RequestError>) -> Result<Value, RequestError> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        Err(RequestError::new(ErrorCode::InternalError, "the server has a fault: the request is given up"))
    })
}

fn lock(unanswered: &Unanswered) -> MutexGuard<'_, BTreeMap<RequestId, Arc<AtomicBool>>> {
    unanswered.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use lsp_server::{Message, RequestId};
    use serde_json::json;

    use super::{Inbox, Incoming};

    #[test]
    fn takes_back_finds_what_is_cancelled_later() {
        let message = |value| Incoming::Message(serde_json::from_value::<Message>(value).unwrap());
        let mut inbox = Inbox::default();
        inbox.extend([
            message(json!({"id": 1, "method": "textDocument/hover"})),
            message(json!({"id": "a", "method": "textDocument/hover"})),
            message(json!({"method": "$/cancelRequest", "params": {"id": "a"}})),
        ]);
        assert!(inbox.takes_back(&RequestId::from("a".to_owned())));
        assert!(!inbox.takes_back(&RequestId::from(1)));
        for _ in 0..3 {
            assert!(inbox.pop().is_some());
        }
        assert!(!inbox.takes_back(&RequestId::from("a".to_owned())));
    }
}
