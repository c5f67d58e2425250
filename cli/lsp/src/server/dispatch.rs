//! Requests by their methods.

use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use lsp_server::{ErrorCode, Request, RequestId};
use serde_json::Value;

use super::answers::{self, Answers};
use super::client::{Client, RequestError, read, written};
use super::pending::guarded;
use super::{ClientFeatures, Lifecycle, Server};
use crate::checker::Snapshot;
use crate::commands::{self, CommandResult};
use crate::convert;
use crate::library::LibraryFolder;
use crate::protocol::{self as lsp, RequestKind as _};

type Answer = Result<Value, RequestError>;

impl Server {
    pub(super) fn request(&mut self, request: Request, is_cancelled: bool) {
        let Request { id, method, params } = request;
        if is_cancelled {
            return self.client.answer(id, Err(RequestError::cancelled()));
        }
        if let Some(refusal) = self.out_of_order(&method) {
            return self.client.answer(id, Err(refusal));
        }
        // These take longer than a moment.
        let started = match method.as_str() {
            lsp::ExecuteCommand::METHOD => Some(self.command(&id, params.clone())),
            lsp::CodeActionResolveRequest::METHOD => Some(self.resolve_action(&id, params.clone())),
            _ => None,
        };
        match started {
            Some(Ok(())) => {}
            Some(Err(error)) => self.client.answer(id, Err(error)),
            None => {
                let answer = guarded(|| self.dispatch(&method, params));
                self.client.answer(id, answer);
            }
        }
    }

    /// Refusal of a request that has no place at this stage of the session.
    fn out_of_order(&self, method: &str) -> Option<RequestError> {
        let (code, problem) = match (self.stage, method) {
            (Lifecycle::Uninitialized, lsp::Initialize::METHOD) => return None,
            (Lifecycle::Uninitialized, _) => {
                (ErrorCode::ServerNotInitialized, format!("`{method}` comes before `initialize`"))
            }
            (Lifecycle::Running | Lifecycle::ShutDown, lsp::Initialize::METHOD) => {
                (ErrorCode::InvalidRequest, "the server is initialized".to_owned())
            }
            (Lifecycle::Running, _) => return None,
            (Lifecycle::ShutDown, _) => {
                (ErrorCode::InvalidRequest, format!("`{method}` comes after `shutdown`"))
            }
        };
        Some(RequestError::new(code, problem))
    }

    fn initialize(&mut self, params: Value) -> Answer {
        let params: lsp::InitializeParams = read(params)?;
        let capabilities = params.capabilities;
        let (window, workspace) = (capabilities.window, capabilities.workspace);
        let shows = window.and_then(|window| window.show_document).map(|show| show.support);
        let files = workspace.as_ref().and_then(|workspace| workspace.did_change_watched_files);
        let hints = workspace.as_ref().and_then(|workspace| workspace.inlay_hint.as_ref());
        self.features = ClientFeatures {
            shows_documents: shows.unwrap_or(false),
            watches_files: files.and_then(|files| files.dynamic_registration).unwrap_or(false),
            refreshes_hints: hints.and_then(|hints| hints.refresh_support).unwrap_or(false),
        };
        self.stage = Lifecycle::Running;
        written(lsp::InitializeResult {
            capabilities: lsp::capabilities(),
            server_info: Some(lsp::ServerInfo {
                name: lsp::NAME.to_owned(),
                version: Some(env!("CARGO_PKG_VERSION").to_owned()),
            }),
        })
    }

    fn dispatch(&mut self, method: &str, params: Value) -> Answer {
        match method {
            lsp::Initialize::METHOD => self.initialize(params),
            lsp::Shutdown::METHOD => {
                self.stage = Lifecycle::ShutDown;
                Ok(Value::Null)
            }
            lsp::HoverRequest::METHOD => {
                let lsp::HoverParams { text_document_position_params: at, .. } = read(params)?;
                self.with(&at.text_document.uri, |answers| written(answers.hover(at.position)?))
            }
            lsp::Completion::METHOD => {
                let lsp::CompletionParams { text_document_position: at, .. } = read(params)?;
                self.with(&at.text_document.uri, |answers| written(answers.completion(at.position)?))
            }
            lsp::GotoDefinition::METHOD => {
                let lsp::GotoDefinitionParams { text_document_position_params: at, .. } = read(params)?;
                self.with(&at.text_document.uri, |answers| {
                    let found = answers.definition(at.position)?;
                    written(found.map(lsp::GotoDefinitionResponse::Scalar))
                })
            }
            lsp::References::METHOD => self.references(read(params)?),
            lsp::DocumentHighlightRequest::METHOD => {
                let lsp::DocumentHighlightParams { text_document_position_params: at, .. } = read(params)?;
                self.with(&at.text_document.uri, |answers| written(answers.highlights(at.position)))
            }
            lsp::PrepareRenameRequest::METHOD => {
                let at: lsp::TextDocumentPositionParams = read(params)?;
                self.with(&at.text_document.uri, |answers| written(answers.prepare_rename(at.position)?))
            }
            lsp::Rename::METHOD => {
                let lsp::RenameParams { text_document_position: at, new_name, .. } = read(params)?;
                self.with(&at.text_document.uri, |answers| written(answers.rename(at.position, &new_name)?))
            }
            lsp::Formatting::METHOD => {
                let lsp::DocumentFormattingParams { text_document, .. } = read(params)?;
                self.with(&text_document.uri, |answers| written(answers.formatting()?))
            }
            lsp::CodeActionRequest::METHOD => {
                let params: lsp::CodeActionParams = read(params)?;
                self.with(&params.text_document.uri, |answers| written(answers.actions(&params)?))
            }
            lsp::DocumentSymbolRequest::METHOD => {
                let lsp::DocumentSymbolParams { text_document, .. } = read(params)?;
                self.with(&text_document.uri, |answers| written(answers.symbols()))
            }
            lsp::FoldingRangeRequest::METHOD => {
                let lsp::FoldingRangeParams { text_document, .. } = read(params)?;
                self.with(&text_document.uri, |answers| written(answers.folds()))
            }
            lsp::SemanticTokensFullRequest::METHOD => {
                let lsp::SemanticTokensParams { text_document, .. } = read(params)?;
                self.with(&text_document.uri, |answers| {
                    written(lsp::SemanticTokens { result_id: None, data: answers.tokens() })
                })
            }
            lsp::InlayHintRequest::METHOD => {
                let lsp::InlayHintParams { text_document, range, .. } = read(params)?;
                self.with(&text_document.uri, |answers| written(answers.hints(range)))
            }
            lsp::CodeLensRequest::METHOD => {
                let lsp::CodeLensParams { text_document, .. } = read(params)?;
                self.with(&text_document.uri, |answers| written(answers.lenses()?))
            }
            _ => Err(RequestError::new(ErrorCode::MethodNotFound, format!("there is no request `{method}`"))),
        }
    }

    /// Answers from the newest text of a document.
    fn with<T>(
        &self,
        uri: &lsp::Uri,
        answer: impl FnOnce(&Answers<'_>) -> Result<T, RequestError>,
    ) -> Result<T, RequestError> {
        let snapshot = self.snapshot(uri.as_str())?;
        let checked = self.checked.get(uri.as_str());
        let checked = checked.filter(|checked| checked.snapshot.generation == snapshot.generation);
        let steps = checked.map_or(&[][..], |checked| checked.steps.as_slice());
        answer(&Answers { snapshot: &snapshot, library: &self.library, steps })
    }

    /// Places of a name in this document, and in the other open ones if the name is not its own.
    fn references(&self, params: lsp::ReferenceParams) -> Answer {
        let at = params.text_document_position;
        let uri = &at.text_document.uri;
        let snapshot = self.snapshot(uri.as_str())?;
        let here = Answers { snapshot: &snapshot, library: &self.library, steps: &[] };
        let places = here.occurrences(at.position);
        let Some(named) = places.first() else { return written(Vec::<lsp::Location>::new()) };
        let wants_declaration = params.context.include_declaration;
        let own = places.iter().filter(|place| wants_declaration || !place.is_declaration);
        let own = own.map(|place| place.span);
        let own = own.filter_map(|span| {
            let uri = snapshot.uri.parse().ok()?;
            Some(lsp::Location { uri, range: convert::range(&snapshot.lines, span) })
        });
        let mut found: Vec<lsp::Location> = own.collect();
        let is_own = places.iter().any(|place| place.is_declaration);
        if !is_own && answers::is_shared(named) {
            for document in self.documents.iter().filter(|document| document.uri != uri.as_str()) {
                let Ok(other) = self.snapshot(&document.uri) else { continue };
                let other = Answers { snapshot: &other, library: &self.library, steps: &[] };
                found.extend(other.places_of(named));
            }
            if wants_declaration {
                found.extend(here.library_place(named));
            }
        }
        written(found)
    }

    /// Starts the search of all safe fixes for an action that was chosen.
    fn resolve_action(&self, id: &RequestId, params: Value) -> Result<(), RequestError> {
        let mut action: lsp::CodeAction = read(params)?;
        let uri = action.data.as_ref().and_then(|data| data.get("uri")).and_then(Value::as_str);
        let uri = uri.ok_or_else(|| RequestError::failed("the action has nothing to resolve"))?;
        let (snapshot, library) = (self.snapshot(uri)?, self.library.clone());
        self.tasks.start(id.clone(), move |_| {
            let answers = Answers { snapshot: &snapshot, library: &library, steps: &[] };
            action.edit = Some(answers.fix_all()?);
            written(action)
        });
        Ok(())
    }

    /// Starts a command of a code lens.
    fn command(&self, id: &RequestId, params: Value) -> Result<(), RequestError> {
        let lsp::ExecuteCommandParams { command, arguments, .. } = read(params)?;
        type Work = fn(&Snapshot, &str, &AtomicBool) -> Result<CommandResult, String>;
        let work: Work = match command.as_str() {
            lsp::RUN => commands::run,
            lsp::FEASIBLE => commands::feasible,
            _ => return Err(RequestError::failed(format!("there is no command `{command}`"))),
        };
        let text = |index: usize| arguments.get(index).and_then(Value::as_str).map(str::to_owned);
        let (Some(uri), Some(policy)) = (text(0), text(1)) else {
            let problem = format!("`{command}` takes the URI of a document and the name of a policy");
            return Err(RequestError::failed(problem));
        };
        let (snapshot, library) = (self.snapshot(&uri)?, self.library.clone());
        let (client, shows) = (self.client.clone(), self.features.shows_documents);
        self.tasks.start(id.clone(), move |is_stopped| {
            let result = work(&snapshot, &policy, is_stopped).map_err(|problem| {
                client.show(problem.clone(), false);
                RequestError::failed(problem)
            })?;
            Ok(shown(&client, &library, shows, &policy, result))
        });
        Ok(())
    }
}

/// Shows the result of a command, with its drawing in a file.
fn shown(
    client: &Client,
    library: &LibraryFolder,
    shows_documents: bool,
    policy: &str,
    result: CommandResult,
) -> Value {
    let CommandResult { mut summary, is_success, drawing, mut value } = result;
    let name: String =
        policy.chars().map(|letter| if letter.is_alphanumeric() { letter } else { '_' }).collect();
    let file = drawing.and_then(|svg| library.write(&PathBuf::from(format!("feasible-{name}.svg")), &svg));
    if let Some(file) = &file {
        add(&mut value, "drawing", file.display().to_string());
        let uri = convert::uri(file).filter(|_| shows_documents);
        match uri.and_then(|uri| {
            let params =
                lsp::ShowDocumentParams { uri, external: Some(false), take_focus: None, selection: None };
            serde_json::to_value(params).ok()
        }) {
            Some(params) => client.ask::<lsp::ShowDocument>(params),
            None => summary.push_str(&format!(", drawn in {}", file.display())),
        }
    }
    add(&mut value, "summary", summary.clone());
    client.show(summary, is_success);
    value
}

/// Adds a member to an object.
fn add(object: &mut Value, key: &str, text: String) {
    if let Value::Object(members) = object {
        members.insert(key.to_owned(), text.into());
    }
}
