//! Requests that are answered from threads of their own, so that the loop goes on. Each is answered once:
//! with its result, or as cancelled.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;

use lsp_server::{ErrorCode, RequestId};
use serde_json::Value;

use super::client::{Client, RequestError};

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
