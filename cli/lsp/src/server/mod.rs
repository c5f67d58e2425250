//! The server: takes messages and the results of checks, and answers. Requests that may take long are
//! answered from threads of their own.

mod answers;
mod client;
mod dispatch;
mod pending;

use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};
use std::path::PathBuf;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, never, select, unbounded};
use lsp_server::{Message, Notification as Note};
use serde_json::Value;

pub(crate) use self::client::{Client, RequestError};
use self::pending::{Inbox, Tasks};
use crate::checker::{CheckedSnapshot, Checker, Snapshot};
use crate::convert;
use crate::documents::OpenDocuments;
use crate::library::{LibraryFolder, SourceLocations};
use crate::protocol::{self, Notification as _};
use crate::transport::{self, Incoming};
use crate::workspace::{OpenFolder, Workspace};

/// Time for which diagnostics without motions wait for those with them, so that an editor does not show the
/// one and then the other.
const PATIENCE: Duration = Duration::from_millis(40);

/// End of a session with a client.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ServerEnd {
    /// The client asked for it in order: `shutdown`, then `exit`.
    Ordered,
    /// The client left without a word, or with `exit` alone.
    Abrupt,
}

/// Serves one client on two streams until it leaves. `cache` is a folder for copies of the library's files,
/// to which definitions lead, and for drawings; it is made when it is needed.
///
/// # Errors
///
/// A stream fails, or the messages on it cannot be told apart.
pub fn serve(
    input: impl BufRead + Send + 'static,
    mut output: impl Write + Send + 'static,
    open: OpenFolder,
    cache: PathBuf,
) -> io::Result<ServerEnd> {
    let (incoming, messages) = unbounded();
    let (answers, outgoing) = unbounded::<Value>();
    let reader = thread::spawn(move || -> io::Result<()> {
        let mut input = input;
        loop {
            let Some(message) = transport::read(&mut input)? else { return Ok(()) };
            let is_last = matches!(&message, Incoming::Message(Message::Notification(note))
                if note.method == protocol::Exit::METHOD);
            if incoming.send(message).is_err() || is_last {
                return Ok(());
            }
        }
    });
    let writer = thread::spawn(move || {
        outgoing.iter().try_for_each(|message| transport::write(&mut output, &message))
    });
    let library = LibraryFolder::new(cache);
    let mut server = Server::new(Arc::new(Workspace::new(open)), Client::new(answers), library);
    let end = server.run(&messages);
    server.tasks.stop_all();
    drop(server);
    let read = reader.join().unwrap_or(Ok(()));
    let written = writer.join().unwrap_or(Ok(()));
    read.and(written).map(|()| end)
}

/// State of the server.
pub(crate) struct Server {
    client: Client,
    workspace: Arc<Workspace>,
    documents: OpenDocuments,
    checker: Checker,
    tasks: Tasks,
    library: LibraryFolder,
    /// Last check of each open document.
    checked: BTreeMap<String, Arc<CheckedSnapshot>>,
    /// Checks without motions that wait for those with them, each until a time.
    waiting: BTreeMap<String, (Instant, Arc<CheckedSnapshot>)>,
    stage: Lifecycle,
    features: ClientFeatures,
}

/// Lifecycle of the session with the client.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Lifecycle {
    Uninitialized,
    Running,
    ShutDown,
}

/// Parts of the protocol that the client has and the server uses.
#[derive(Clone, Copy, Debug, Default)]
struct ClientFeatures {
    /// The client shows files on request.
    shows_documents: bool,
    /// The client watches files for the server.
    watches_files: bool,
    /// The client asks for inlay hints again when it is told to.
    refreshes_hints: bool,
}

impl Server {
    fn new(workspace: Arc<Workspace>, client: Client, library: LibraryFolder) -> Self {
        Self {
            tasks: Tasks::new(client.clone()),
            client,
            checker: Checker::start(&workspace),
            workspace,
            documents: OpenDocuments::default(),
            library,
            checked: BTreeMap::new(),
            waiting: BTreeMap::new(),
            stage: Lifecycle::Uninitialized,
            features: ClientFeatures::default(),
        }
    }

    fn run(&mut self, messages: &Receiver<Incoming>) -> ServerEnd {
        let results = self.checker.results.clone();
        let mut inbox = Inbox::default();
        let mut is_open = true;
        loop {
            inbox.extend(messages.try_iter());
            if let Some(message) = inbox.pop() {
                match message {
                    Incoming::Message(Message::Request(request)) => {
                        let is_cancelled = inbox.takes_back(&request.id);
                        self.request(request, is_cancelled);
                    }
                    Incoming::Message(Message::Notification(note))
                        if note.method == protocol::Exit::METHOD =>
                    {
                        return match self.stage {
                            Lifecycle::ShutDown => ServerEnd::Ordered,
                            Lifecycle::Uninitialized | Lifecycle::Running => ServerEnd::Abrupt,
                        };
                    }
                    Incoming::Message(Message::Notification(note)) => self.notification(note),
                    // What the server asks of clients needs no answer.
                    Incoming::Message(Message::Response(_)) => {}
                    Incoming::Broken(answer) => self.client.send_value(answer),
                }
                continue;
            }
            if !is_open {
                return ServerEnd::Abrupt;
            }
            let due = self.waiting.values().map(|(until, _)| *until).min();
            let timer = due.map_or_else(never, crossbeam_channel::at);
            select! {
                recv(messages) -> message => match message {
                    Ok(message) => inbox.extend([message]),
                    Err(_) => is_open = false,
                },
                recv(results) -> checked => if let Ok(checked) = checked {
                    self.take(Arc::new(checked));
                },
                recv(timer) -> _ => self.publish_waiting(),
            }
        }
    }

    fn notification(&mut self, note: Note) {
        let Note { method, params } = note;
        // Before `initialize` none counts but `exit`, as the protocol says.
        if self.stage == Lifecycle::Uninitialized {
            return;
        }
        match method.as_str() {
            protocol::Initialized::METHOD => self.watch_files(),
            protocol::DidOpenTextDocument::METHOD => {
                if let Ok(protocol::DidOpenTextDocumentParams { text_document: opened }) =
                    client::read(params)
                {
                    self.documents.open(opened.uri.as_str(), opened.version, opened.text);
                    self.check(opened.uri.as_str());
                }
            }
            protocol::DidChangeTextDocument::METHOD => {
                if let Ok(protocol::DidChangeTextDocumentParams { text_document, content_changes }) =
                    client::read(params)
                {
                    let uri = text_document.uri.as_str();
                    if self.documents.change(uri, text_document.version, &content_changes) {
                        self.check(uri);
                    }
                }
            }
            protocol::DidCloseTextDocument::METHOD => {
                if let Ok(protocol::DidCloseTextDocumentParams { text_document }) = client::read(params) {
                    self.close(&text_document.uri);
                }
            }
            protocol::DidSaveTextDocument::METHOD | protocol::DidChangeWatchedFiles::METHOD => {
                self.documents.iter().for_each(|document| self.checker.check(document));
            }
            protocol::Cancel::METHOD => {
                if let Ok(protocol::CancelParams { id }) = client::read(params) {
                    self.tasks.cancel(&pending::request_id(id));
                }
            }
            _ => {}
        }
    }

    /// Asks the client to watch the files that projects are read from.
    fn watch_files(&self) {
        if self.features.watches_files {
            let watchers = ["**/motet.toml", "**/robot.toml", "**/*.json", "**/*.motet", "**/*.urdf"]
                .map(|pattern| serde_json::json!({"globPattern": pattern}));
            let options = serde_json::json!({"watchers": watchers});
            let method = protocol::DidChangeWatchedFiles::METHOD;
            let registration =
                serde_json::json!({"id": "motet-files", "method": method, "registerOptions": options});
            self.client
                .ask::<protocol::RegisterCapability>(serde_json::json!({"registrations": [registration]}));
        }
    }

    fn check(&self, uri: &str) {
        if let Some(document) = self.documents.get(uri) {
            self.checker.check(document);
        }
    }

    fn close(&mut self, uri: &protocol::Uri) {
        if self.documents.close(uri.as_str()) {
            self.checker.forget(uri.as_str());
            self.checked.remove(uri.as_str());
            self.waiting.remove(uri.as_str());
            self.client.notify::<protocol::PublishDiagnostics>(protocol::PublishDiagnosticsParams {
                uri: uri.clone(),
                diagnostics: Vec::new(),
                version: None,
            });
        }
    }

    /// Takes the result of a check, unless the document has changed since.
    fn take(&mut self, checked: Arc<CheckedSnapshot>) {
        let uri = checked.snapshot.uri.clone();
        let is_newest =
            self.documents.get(&uri).is_some_and(|open| open.generation == checked.snapshot.generation);
        if !is_newest {
            return;
        }
        self.checked.insert(uri.clone(), Arc::clone(&checked));
        if checked.is_final {
            self.waiting.remove(&uri);
            self.publish(&checked);
        } else {
            self.waiting.insert(uri, (Instant::now() + PATIENCE, checked));
        }
    }

    fn publish_waiting(&mut self) {
        let now = Instant::now();
        let due: Vec<_> =
            self.waiting.iter().filter(|(_, (until, _))| *until <= now).map(|(uri, _)| uri.clone()).collect();
        for uri in due {
            if let Some((_, checked)) = self.waiting.remove(&uri) {
                self.publish(&checked);
            }
        }
    }

    fn publish(&self, checked: &CheckedSnapshot) {
        let CheckedSnapshot { snapshot, diagnostics, .. } = checked;
        let Ok(uri) = snapshot.uri.parse() else { return };
        let locate = SourceLocations { snapshot, library: &self.library };
        let mut shown: Vec<_> =
            diagnostics.iter().map(|found| convert::diagnostic(found, &snapshot.lines, &locate)).collect();
        if let Err(problem) = &snapshot.session {
            shown.insert(0, convert::problem(problem, &snapshot.lines));
        }
        self.client.notify::<protocol::PublishDiagnostics>(protocol::PublishDiagnosticsParams {
            uri,
            diagnostics: shown,
            version: Some(snapshot.version),
        });
        if self.features.refreshes_hints {
            self.client.ask::<protocol::InlayHintRefreshRequest>(Value::Null);
        }
    }

    /// Version of an open document that is read, from the last check if that is of the same text.
    fn snapshot(&self, uri: &str) -> Result<Arc<Snapshot>, RequestError> {
        let document = self
            .documents
            .get(uri)
            .ok_or_else(|| RequestError::failed(format!("the document {uri} is not open")))?;
        match self.checked.get(uri) {
            Some(checked) if checked.snapshot.generation == document.generation => {
                Ok(Arc::clone(&checked.snapshot))
            }
            Some(_) | None => Ok(Arc::new(Snapshot::new(document, &self.workspace))),
        }
    }
}
