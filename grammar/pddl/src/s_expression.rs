//! Brackets: PDDL text to a tree of words and lists. Letter case does not matter, so words are lower case
//! from here on.

use motet_syntax::ast::MAX_NESTING;
use motet_syntax::diagnostics::too_deep;
use motet_syntax::{Diagnostic, Span};
use smol_str::SmolStr;

use crate::PddlSource;
use crate::diagnostics::Malformed;

/// A word or a list.
#[derive(Clone, Debug)]
pub(crate) struct SExpr {
    pub(crate) kind: SExprKind,
    pub(crate) span: Span,
}

#[derive(Clone, Debug)]
pub(crate) enum SExprKind {
    /// A word in lower case: PDDL ignores case.
    Word(SmolStr),
    List(Vec<SExpr>),
}

impl SExpr {
    pub(crate) fn word(&self) -> Option<&SmolStr> {
        match &self.kind {
            SExprKind::Word(word) => Some(word),
            SExprKind::List(_) => None,
        }
    }

    pub(crate) fn list(&self) -> Option<&[SExpr]> {
        match &self.kind {
            SExprKind::Word(_) => None,
            SExprKind::List(items) => Some(items),
        }
    }

    /// The word that a list begins with, and what follows it.
    pub(crate) fn form(&self) -> Option<(&SmolStr, &[SExpr])> {
        let (head, rest) = self.list()?.split_first()?;
        Some((head.word()?, rest))
    }

    /// Text of the tree in a message.
    pub(crate) fn shown(&self) -> String {
        match &self.kind {
            SExprKind::Word(word) => format!("`{word}`"),
            SExprKind::List(items) => match items.first().and_then(SExpr::word) {
                Some(head) => format!("`({head} …)`"),
                None if items.is_empty() => "`()`".to_owned(),
                None => "a list".to_owned(),
            },
        }
    }

    /// Reports that another part of PDDL is expected here.
    pub(crate) fn not(&self, wanted: impl Into<String>) -> Malformed {
        Malformed { span: self.span, wanted: wanted.into(), found: self.shown() }
    }
}

/// The one tree of a file.
pub(crate) fn read(input: PddlSource<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<SExpr> {
    let mut trees = read_all(input, diagnostics)?.into_iter();
    let Some(first) = trees.next() else {
        let span = Span::new(input.file, 0, 0);
        diagnostics
            .push(Malformed { span, wanted: "`(define …)`".into(), found: "an empty file".into() }.into());
        return None;
    };
    if let Some(second) = trees.next() {
        diagnostics.push(second.not("the end of the file").into());
        return None;
    }
    Some(first)
}

/// All trees of a file; none after an error, which is diagnostics. O(bytes), without recursion.
pub(crate) fn read_all(input: PddlSource<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<SExpr>> {
    let text: &str = &input.source.text;
    let span = |start, end| Span::new(input.file, start, end);
    // The lists that are open: where each began, and what is in it.
    let mut open: Vec<(usize, Vec<SExpr>)> = Vec::new();
    let mut top = Vec::new();
    let mut chars = text.char_indices().peekable();
    while let Some((at, char)) = chars.next() {
        let done = match char {
            ';' => {
                while chars.next_if(|(_, char)| *char != '\n').is_some() {}
                continue;
            }
            _ if char.is_whitespace() => continue,
            '(' if open.len() >= MAX_NESTING => {
                diagnostics.push(too_deep(span(at, at + 1), MAX_NESTING));
                return None;
            }
            '(' => {
                open.push((at, Vec::new()));
                continue;
            }
            ')' => match open.pop() {
                Some((start, items)) => SExpr { kind: SExprKind::List(items), span: span(start, at + 1) },
                None => {
                    let (wanted, found) = ("the end of the file".into(), "`)`".into());
                    diagnostics.push(Malformed { span: span(at, at + 1), wanted, found }.into());
                    return None;
                }
            },
            _ if is_of_word(char) => {
                let mut end = at + char.len_utf8();
                while let Some((at, char)) = chars.next_if(|(_, char)| is_of_word(*char)) {
                    end = at + char.len_utf8();
                }
                let word = text.get(at..end).unwrap_or_default().to_lowercase();
                SExpr { kind: SExprKind::Word(word.into()), span: span(at, end) }
            }
            _ => {
                let (span, found) = (span(at, at + char.len_utf8()), format!("`{}`", char.escape_default()));
                diagnostics.push(Malformed { span, wanted: "a name or a bracket".into(), found }.into());
                return None;
            }
        };
        match open.last_mut() {
            Some((_, items)) => items.push(done),
            None => top.push(done),
        }
    }
    if let Some((start, _)) = open.pop() {
        let (wanted, found) = ("`)`".into(), "a list that is never closed".into());
        diagnostics.push(Malformed { span: span(start, start + 1), wanted, found }.into());
        return None;
    }
    Some(top)
}

/// Checks for a character of a name, a variable, a keyword or a number.
fn is_of_word(char: char) -> bool {
    char.is_alphanumeric()
        || matches!(char, '_' | '-' | '?' | ':' | '=' | '.' | '+' | '*' | '/' | '<' | '>' | '@' | '#' | '!')
}
