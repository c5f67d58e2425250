//! Messages that wait, with the requests among them that the client has taken back.

use std::collections::VecDeque;

use lsp_server::{Message, RequestId};

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
