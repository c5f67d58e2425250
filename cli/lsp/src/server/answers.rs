//! Answers to requests about one document: the features of `editor` in the terms of the protocol.

use std::collections::HashMap;
use std::sync::Arc;

use motet_compiler::StepInspection;
use motet_compiler::fix::{Applicability, FixLimits, fix_parsed, offers};
use motet_project::DOCUMENT;
use motet_syntax::{Edit, Source, Span, Syntax};

use super::RequestError;
use crate::checker::Snapshot;
use crate::convert::{self, Locate as _};
use crate::editor::completion::{Completion, SuggestionKind};
use crate::editor::declarations::{DeclarationKind, Declarations};
use crate::editor::hover::{HoverSource, hover};
use crate::editor::names::{NameSpace, Occurrence, name_at, occurrences};
use crate::editor::symbols::{self, Symbol};
use crate::editor::tokens::{self, TokenClass};
use crate::editor::{completion, folding, hints, json_completion, rename};
use crate::library::{LibraryFolder, SourceLocations};
use crate::lines::LineIndex;
use crate::protocol as lsp;
use crate::workspace::OpenedSession;

/// Version of a document with the last check of the same text.
pub(crate) struct Answers<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) library: &'a LibraryFolder,
    pub(crate) steps: &'a [StepInspection],
}

type Answer<T> = Result<T, RequestError>;

impl Answers<'_> {
    fn session(&self) -> Answer<&Arc<OpenedSession>> {
        let session = self.snapshot.session.as_ref();
        session.map_err(|problem| RequestError::failed(problem.clone()))
    }

    fn lines(&self) -> &LineIndex {
        &self.snapshot.lines
    }

    fn offset(&self, position: lsp::Position) -> usize {
        self.lines().offset(convert::line_position(position))
    }

    fn range(&self, span: Span) -> lsp::Range {
        convert::range(self.lines(), span)
    }

    fn locations(&self) -> SourceLocations<'_> {
        SourceLocations { snapshot: self.snapshot, library: self.library }
    }

    fn own(&self) -> Declarations {
        Declarations::of_file(&self.snapshot.parsed.file)
    }

    pub(crate) fn hover(&self, position: lsp::Position) -> Answer<Option<lsp::Hover>> {
        let session = self.session()?;
        let sources = session.sources(Source::new("", Arc::clone(&self.snapshot.source.text)));
        let project = self.snapshot.declarations();
        let given = HoverSource {
            session: &session.session,
            parsed: &self.snapshot.parsed,
            declarations: [project, &self.own()],
            source: &|span: Span| sources.get(span.file).cloned(),
            steps: self.steps,
        };
        Ok(hover(&given, self.offset(position)).map(|found| lsp::Hover {
            contents: lsp::HoverContents::Markup(lsp::MarkupContent {
                kind: lsp::MarkupKind::Markdown,
                value: found.markdown,
            }),
            range: Some(self.range(found.span)),
        }))
    }

    pub(crate) fn completion(&self, position: lsp::Position) -> Answer<Vec<lsp::CompletionItem>> {
        let session = &self.session()?.session;
        let offset = self.offset(position);
        let parsed = &self.snapshot.parsed;
        let Completion { word, suggestions } = match parsed.syntax {
            Syntax::Text => completion::complete(session, &self.snapshot.source, offset),
            Syntax::Json => json_completion::complete(session, parsed, offset),
        };
        let range = self.range(Span::new(DOCUMENT, word.0, word.1));
        let items = suggestions.into_iter().enumerate().map(|(index, one)| {
            let format = match one.is_snippet {
                true => lsp::InsertTextFormat::SNIPPET,
                false => lsp::InsertTextFormat::PLAIN_TEXT,
            };
            // In JSON the word that is written has a `$` before a binding.
            let filter = (parsed.syntax == Syntax::Json).then(|| one.insert.clone());
            lsp::CompletionItem {
                filter_text: filter,
                label: one.label,
                kind: Some(completion_kind(one.kind)),
                detail: Some(one.detail).filter(|detail| !detail.is_empty()),
                sort_text: Some(format!("{index:05}")),
                text_edit: Some(lsp::CompletionTextEdit::Edit(lsp::TextEdit { range, new_text: one.insert })),
                insert_text_format: Some(format),
                ..lsp::CompletionItem::default()
            }
        });
        Ok(items.collect())
    }

    pub(crate) fn definition(&self, position: lsp::Position) -> Answer<Option<lsp::Location>> {
        let all = occurrences(&self.snapshot.parsed);
        let Some(named) = name_at(&all, self.offset(position)) else { return Ok(None) };
        if let Some(declared) = self.declared_here(&all, named) {
            return Ok(self.locations().location(declared));
        }
        let found = self.snapshot.declarations().get(named.space, &named.name).map(|found| found.span);
        Ok(found.and_then(|span| self.locations().location(span)))
    }

    /// Place in the document where a name is declared: of a binding, the nearest before it.
    fn declared_here(&self, all: &[Occurrence], named: &Occurrence) -> Option<Span> {
        let declared = || all.iter().filter(move |place| place.is_same(named) && place.is_declaration);
        let before = declared().rfind(|place| place.span <= named.span);
        before.or_else(|| declared().next()).map(|place| place.span)
    }

    /// Places of the name at a position in this document.
    pub(crate) fn occurrences(&self, position: lsp::Position) -> Vec<Occurrence> {
        let all = occurrences(&self.snapshot.parsed);
        let Some(named) = name_at(&all, self.offset(position)) else { return Vec::new() };
        all.iter().filter(|place| place.is_same(named)).cloned().collect()
    }

    /// Places of a name that another document uses too.
    pub(crate) fn places_of(&self, named: &Occurrence) -> Vec<lsp::Location> {
        let all = occurrences(&self.snapshot.parsed);
        let same = all.iter().filter(|place| place.is_same(named));
        same.filter_map(|place| self.locations().location(place.span)).collect()
    }

    /// Declaration of a name outside of the document.
    pub(crate) fn library_place(&self, named: &Occurrence) -> Option<lsp::Location> {
        let span = self.snapshot.declarations().get(named.space, &named.name)?.span;
        self.locations().location(span)
    }

    pub(crate) fn highlights(&self, position: lsp::Position) -> Vec<lsp::DocumentHighlight> {
        let places = self.occurrences(position).into_iter();
        let highlights = places.map(|place| lsp::DocumentHighlight {
            range: self.range(place.span),
            kind: Some(match place.is_declaration {
                true => lsp::DocumentHighlightKind::WRITE,
                false => lsp::DocumentHighlightKind::READ,
            }),
        });
        highlights.collect()
    }

    pub(crate) fn prepare_rename(&self, position: lsp::Position) -> Answer<lsp::PrepareRenameResponse> {
        let all = occurrences(&self.snapshot.parsed);
        let named = rename::renamable(&all, self.offset(position)).map_err(RequestError::failed)?;
        let (range, placeholder) = (self.range(named.span), named.name.to_string());
        Ok(lsp::PrepareRenameResponse::RangeWithPlaceholder { range, placeholder })
    }

    pub(crate) fn rename(&self, position: lsp::Position, new: &str) -> Answer<lsp::WorkspaceEdit> {
        let edits = rename::rename(&self.snapshot.parsed, self.offset(position), new);
        self.workspace_edit(&edits.map_err(RequestError::failed)?)
    }

    /// Edits of the document; those of other files are left out.
    #[allow(clippy::mutable_key_type, reason = "the protocol's map of edits has URIs as keys")]
    fn workspace_edit(&self, edits: &[Edit]) -> Answer<lsp::WorkspaceEdit> {
        let uri = self.snapshot.uri.parse().map_err(|_| RequestError::failed("the URI cannot be read"))?;
        let edits = edits.iter().filter(|edit| edit.span.file == DOCUMENT);
        let edits =
            edits.map(|edit| lsp::TextEdit { range: self.range(edit.span), new_text: edit.text.clone() });
        let changes = HashMap::from([(uri, edits.collect())]);
        Ok(lsp::WorkspaceEdit { changes: Some(changes), ..lsp::WorkspaceEdit::default() })
    }

    pub(crate) fn formatting(&self) -> Answer<Vec<lsp::TextEdit>> {
        match motet_syntax::format(&self.snapshot.source) {
            Ok(text) => Ok(self.replacement(&text).into_iter().collect()),
            Err(_) => Err(RequestError::failed("a document with errors of syntax is not formatted")),
        }
    }

    /// Edit of the lines in which another version of the document differs.
    fn replacement(&self, text: &str) -> Option<lsp::TextEdit> {
        let old = &*self.snapshot.source.text;
        if old == text {
            return None;
        }
        let line_end =
            |common: usize| old.get(..common).and_then(|same| same.rfind('\n')).map_or(0, |at| at + 1);
        let same = old.bytes().zip(text.bytes()).take_while(|(one, other)| one == other).count();
        let start = line_end(same);
        let left = old.len().min(text.len()) - start;
        let same = old.bytes().rev().zip(text.bytes().rev()).take(left);
        let mut same = same.take_while(|(one, other)| one == other).count();
        // The rest begins with a whole line.
        let rest = old.get(old.len() - same..);
        same = rest.and_then(|rest| rest.find('\n').map(|at| rest.len() - at - 1)).unwrap_or(0);
        let range = self.range(Span::new(DOCUMENT, start, old.len() - same));
        let new_text = text.get(start..text.len() - same)?.to_owned();
        Some(lsp::TextEdit { range, new_text })
    }

    pub(crate) fn actions(&self, params: &lsp::CodeActionParams) -> Answer<Vec<lsp::CodeActionOrCommand>> {
        let session = &self.session()?.session;
        let wants = |kind: &lsp::CodeActionKind| {
            let only = params.context.only.as_ref();
            only.is_none_or(|only| only.iter().any(|wanted| is_kind(kind, wanted)))
        };
        let mut actions = Vec::new();
        let offered = offers(session, &self.snapshot.parsed);
        if wants(&lsp::CodeActionKind::QUICKFIX) {
            for offer in &offered {
                let range = self.range(offer.diagnostic.span);
                if range.end < params.range.start || params.range.end < range.start {
                    continue;
                }
                let shown = convert::diagnostic(&offer.diagnostic, self.lines(), &self.locations());
                let mut is_first = true;
                for (fix, applicability) in &offer.fixes {
                    let remark = match applicability {
                        Applicability::Safe => "",
                        Applicability::Unsafe => " (changes what the policy does)",
                        Applicability::Shown => " (names another thing)",
                    };
                    let is_safe = *applicability == Applicability::Safe;
                    actions.push(lsp::CodeAction {
                        title: format!("{}{remark}", capital(&fix.title)),
                        kind: Some(lsp::CodeActionKind::QUICKFIX),
                        diagnostics: Some(vec![shown.clone()]),
                        edit: Some(self.workspace_edit(&fix.edits)?),
                        is_preferred: Some(is_safe && std::mem::take(&mut is_first)),
                        ..lsp::CodeAction::default()
                    });
                }
            }
        }
        let is_fixable =
            offered.iter().any(|offer| offer.fixes.iter().any(|(_, degree)| *degree == Applicability::Safe));
        if is_fixable && wants(&lsp::FIX_ALL) {
            actions.push(lsp::CodeAction {
                title: "Fix all mistakes that have a safe fix".to_owned(),
                kind: Some(lsp::FIX_ALL),
                // The edits are searched when the action is chosen.
                data: Some(serde_json::json!({"uri": self.snapshot.uri})),
                ..lsp::CodeAction::default()
            });
        }
        Ok(actions.into_iter().map(lsp::CodeActionOrCommand::CodeAction).collect())
    }

    /// Edit that applies all safe fixes.
    pub(crate) fn fix_all(&self) -> Answer<lsp::WorkspaceEdit> {
        let session = &self.session()?.session;
        let Snapshot { source, parsed, .. } = self.snapshot;
        let limits = FixLimits::safe(motet::document::MAX_FIXES);
        let fixed = fix_parsed(session, source, parsed.clone(), DOCUMENT, limits);
        let whole = Span::new(DOCUMENT, 0, source.text.len());
        let edits = match fixed.applied.is_empty() {
            true => Vec::new(),
            false => vec![Edit { span: whole, text: fixed.text }],
        };
        self.workspace_edit(&edits)
    }

    pub(crate) fn symbols(&self) -> Vec<lsp::DocumentSymbol> {
        symbols::symbols(&self.snapshot.parsed).into_iter().map(|symbol| self.symbol(symbol)).collect()
    }

    #[expect(deprecated, reason = "the protocol's type has a field that is deprecated")]
    fn symbol(&self, symbol: Symbol) -> lsp::DocumentSymbol {
        let children: Vec<_> = symbol.children.into_iter().map(|child| self.symbol(child)).collect();
        lsp::DocumentSymbol {
            name: symbol.name,
            detail: symbol.detail,
            kind: symbol_kind(symbol.kind),
            tags: None,
            deprecated: None,
            range: self.range(symbol.whole),
            selection_range: self.range(symbol.span),
            children: (!children.is_empty()).then_some(children),
        }
    }

    pub(crate) fn folds(&self) -> Vec<lsp::FoldingRange> {
        let folds = folding::folds(self.lines()).into_iter();
        let ranges = folds.map(|fold| lsp::FoldingRange {
            start_line: fold.first,
            end_line: fold.last,
            kind: fold.is_comment.then_some(lsp::FoldingRangeKind::Comment),
            ..lsp::FoldingRange::default()
        });
        ranges.collect()
    }

    pub(crate) fn tokens(&self) -> Vec<lsp::SemanticToken> {
        let mut data = Vec::new();
        let mut before = lsp::Position::default();
        for token in tokens::tokens(&self.snapshot.parsed, self.snapshot.declarations()) {
            let range = self.range(Span::new(DOCUMENT, token.start, token.end));
            if range.start.line != range.end.line {
                continue;
            }
            let is_new_line = range.start.line != before.line;
            let from = if is_new_line { 0 } else { before.character };
            let is_readonly = matches!(token.class, TokenClass::Entity | TokenClass::Case);
            data.push(lsp::SemanticToken {
                delta_line: range.start.line - before.line,
                delta_start: range.start.character.saturating_sub(from),
                length: range.end.character.saturating_sub(range.start.character),
                token_type: token.class as u32,
                token_modifiers_bitset: u32::from(token.is_declaration)
                    | u32::from(token.is_library) << 1
                    | u32::from(is_readonly) << 2,
            });
            before = range.start;
        }
        data
    }

    pub(crate) fn hints(&self, range: lsp::Range) -> Vec<lsp::InlayHint> {
        let hints = hints::hints(&self.snapshot.parsed, self.lines(), self.steps).into_iter();
        let hints = hints.map(|hint| (convert::position(self.lines().position(hint.offset)), hint));
        let hints = hints.filter(|(position, _)| range.start <= *position && *position <= range.end);
        let hints = hints.map(|(position, hint)| lsp::InlayHint {
            position,
            label: lsp::InlayHintLabel::String(hint.label),
            kind: None,
            text_edits: None,
            tooltip: Some(lsp::InlayHintTooltip::String(hint.tooltip)),
            padding_left: Some(true),
            padding_right: None,
            data: None,
        });
        hints.collect()
    }

    /// Lenses over the policies that can be run.
    pub(crate) fn lenses(&self) -> Answer<Vec<lsp::CodeLens>> {
        let session = self.session()?;
        let mut commands = Vec::new();
        if session.robot.is_some() {
            commands.push(("▶ Run in simulation", lsp::RUN));
            if session.scene.is_some() {
                commands.push(("Show feasibility", lsp::FEASIBLE));
            }
        }
        let mut lenses = Vec::new();
        for policy in self.snapshot.parsed.file.runnable() {
            for (title, command) in &commands {
                lenses.push(lsp::CodeLens {
                    range: self.range(policy.name.span),
                    command: Some(lsp::Command {
                        title: (*title).to_owned(),
                        command: (*command).to_owned(),
                        arguments: Some(vec![
                            self.snapshot.uri.clone().into(),
                            policy.name.text.to_string().into(),
                        ]),
                    }),
                    data: None,
                });
            }
        }
        Ok(lenses)
    }
}

/// Returns whether a kind of action is another one or a part of it.
fn is_kind(kind: &lsp::CodeActionKind, wanted: &lsp::CodeActionKind) -> bool {
    let rest = kind.as_str().strip_prefix(wanted.as_str());
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.') || wanted.as_str().is_empty())
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

fn completion_kind(kind: SuggestionKind) -> lsp::CompletionItemKind {
    match kind {
        SuggestionKind::Binding => lsp::CompletionItemKind::VARIABLE,
        SuggestionKind::Entity => lsp::CompletionItemKind::CONSTANT,
        SuggestionKind::Case => lsp::CompletionItemKind::ENUM_MEMBER,
        SuggestionKind::Callable => lsp::CompletionItemKind::FUNCTION,
        SuggestionKind::Relation => lsp::CompletionItemKind::METHOD,
        SuggestionKind::Label => lsp::CompletionItemKind::PROPERTY,
        SuggestionKind::Type => lsp::CompletionItemKind::CLASS,
        SuggestionKind::Failure => lsp::CompletionItemKind::EVENT,
        SuggestionKind::Robot => lsp::CompletionItemKind::MODULE,
        SuggestionKind::Keyword => lsp::CompletionItemKind::KEYWORD,
    }
}

fn symbol_kind(kind: symbols::SymbolKind) -> lsp::SymbolKind {
    match kind {
        symbols::SymbolKind::Group => lsp::SymbolKind::NAMESPACE,
        symbols::SymbolKind::Binding => lsp::SymbolKind::VARIABLE,
        symbols::SymbolKind::Field => lsp::SymbolKind::FIELD,
        symbols::SymbolKind::Declaration(kind) => match kind {
            DeclarationKind::Policy => lsp::SymbolKind::FUNCTION,
            DeclarationKind::Action | DeclarationKind::Perception => lsp::SymbolKind::METHOD,
            DeclarationKind::Fluent | DeclarationKind::Measure => lsp::SymbolKind::PROPERTY,
            DeclarationKind::Kind => lsp::SymbolKind::CLASS,
            DeclarationKind::Enum => lsp::SymbolKind::ENUM,
            DeclarationKind::Case => lsp::SymbolKind::ENUM_MEMBER,
            DeclarationKind::Failure => lsp::SymbolKind::EVENT,
            DeclarationKind::Entity => lsp::SymbolKind::CONSTANT,
            DeclarationKind::Robot => lsp::SymbolKind::MODULE,
        },
    }
}

/// Returns whether other documents may speak of the same thing by a name.
pub(crate) fn is_shared(named: &Occurrence) -> bool {
    match named.space {
        NameSpace::Callable | NameSpace::Relation | NameSpace::Type | NameSpace::Value | NameSpace::Robot => {
            true
        }
        NameSpace::Local | NameSpace::Label | NameSpace::Resource | NameSpace::Motion | NameSpace::Group => {
            false
        }
    }
}
