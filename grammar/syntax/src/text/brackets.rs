//! Recovery from brackets that do not match, before parsing: a bracket too many is blanked out, and one that
//! is missing is written in place of white space, so that every offset stays right. Where the indentation
//! shows which block a brace belongs to, it decides.

use super::lexer::{self, BracketFault, Token, TokenKind, tokens};
use crate::diagnostic::Diagnostic;
use crate::diagnostics::TextSyntax;
use crate::source::{FileId, Span};

/// The longest text whose brackets are mended, in bytes.
const MAX_TEXT: usize = 64 * 1024;
/// The most brackets that are mended in one text.
const MAX_MENDED: usize = 16;

/// A text after mending.
pub(super) struct Balanced {
    pub(super) text: String,
    /// Mistakes that were mended, in the order found.
    pub(super) found: Vec<Diagnostic>,
    /// True if it is clear which blocks the braces belong to.
    pub(super) is_certain: bool,
}

/// Mends the brackets of a text, up to the first that cannot be mended. `None` if none is. O(faults × text).
pub(super) fn balance(text: &str, file: FileId) -> Option<Balanced> {
    let mut balanced = Balanced { text: text.to_owned(), found: Vec::new(), is_certain: true };
    if text.len() > MAX_TEXT {
        return None;
    }
    for _ in 0..MAX_MENDED {
        let Err(fault) = lexer::check(&balanced.text, file) else { break };
        let mut found = *fault.diagnostic;
        let Some(bracket) = fault.bracket else { break };
        let mended = match bracket {
            BracketFault::Surplus { at } => blanked(&balanced.text, at),
            BracketFault::Unclosed { opening, before } if text.get(before..)?.starts_with('{') => {
                let closing = lexer::closing(balanced.text.get(opening..=opening)?);
                written(&balanced.text, end_before(&balanced.text, before), closing)
            }
            // The rest of the line may be missing too: recovery leaves it out.
            BracketFault::Unclosed { .. } => break,
            BracketFault::Ended { opening } => match unclosed_block(&balanced.text) {
                Some((opening, before)) => {
                    found = missing_brace(opening, before, file);
                    written(&balanced.text, end_before(&balanced.text, before.start), "}")
                }
                None if balanced.text.get(opening..)?.starts_with('{') => {
                    balanced.is_certain = false;
                    Some(format!("{}}}", balanced.text.trim_end()))
                }
                None => break,
            },
            BracketFault::ClosesNothing { at } => match surplus_brace(&balanced.text) {
                Some(token) => {
                    found = TextSyntax {
                        fix: Some(String::new()),
                        ..TextSyntax::new(token.span(file), "there is one `}` too many".into(), "remove it")
                    }
                    .into();
                    blanked(&balanced.text, token.start)
                }
                None => blanked(&balanced.text, at),
            },
        };
        let Some(mended) = mended else { break };
        balanced.text = mended;
        balanced.found.push(found);
    }
    (!balanced.found.is_empty()).then_some(balanced)
}

fn missing_brace(opening: Token<'_>, before: Token<'_>, file: FileId) -> Diagnostic {
    TextSyntax {
        related: Some(("opened here", opening.span(file))),
        ..TextSyntax::new(
            before.span(file),
            "expected `}` before this line".into(),
            "close the `{` of the block above with `}`",
        )
    }
    .into()
}

/// A text without one character of one byte.
fn blanked(text: &str, at: usize) -> Option<String> {
    let mut text = text.to_owned();
    text.get(at..=at)?;
    text.replace_range(at..=at, " ");
    Some(text)
}

/// A text with a bracket in place of the white space at an offset.
fn written(text: &str, at: usize, bracket: &str) -> Option<String> {
    let rest = text.get(at..)?;
    let blanks = rest.len() - rest.trim_ascii_start().len();
    // A line break stays where there is another blank.
    let blank = rest.get(..blanks)?.find([' ', '\t', '\r']).or((blanks > 0).then_some(0))?;
    let mut text = text.to_owned();
    text.replace_range(at + blank..=at + blank, bracket);
    Some(text)
}

/// End of the last token before an offset that is no comment.
fn end_before(text: &str, at: usize) -> usize {
    let is_before = |token: &Token<'_>| token.start < at;
    let last = tokens(text, 0).take_while(is_before).filter(is_code).last();
    last.map_or(0, |token| token.end())
}

fn is_code(token: &Token<'_>) -> bool {
    !matches!(token.kind, TokenKind::Comment | TokenKind::Doc)
}

/// Tokens that are no comments, each with the indentation of its line, and `true` if it begins the line.
fn placed(text: &str) -> impl Iterator<Item = (Token<'_>, usize, bool)> {
    let first = (0, 0);
    tokens(text, 0).filter(is_code).scan(first, |(end, indent), token| {
        let between = text.get(*end..token.start).unwrap_or_default();
        let line = between.rfind('\n').map(|at| *end + at + 1).or((*end == 0).then_some(0));
        if let Some(line) = line {
            *indent = token.start - line;
        }
        *end = token.end();
        Some((token, *indent, line.is_some()))
    })
}

/// A brace that is not closed where the indentation ends its block, and the token that begins the next line.
fn unclosed_block(text: &str) -> Option<(Token<'_>, Token<'_>)> {
    let mut open: Vec<(Token<'_>, usize)> = Vec::new();
    for (token, indent, begins_line) in placed(text) {
        let is_closing = token.kind == TokenKind::Mark && token.text == "}";
        if let Some((opening, outer)) = open.last().filter(|_| begins_line) {
            let is_of_outer = open.iter().any(|(_, outer)| *outer == indent);
            let ends_block = if is_closing { indent < *outer && is_of_outer } else { indent <= *outer };
            if ends_block {
                return Some((*opening, token));
            }
        }
        match token.text {
            "{" if token.kind == TokenKind::Mark => open.push((token, indent)),
            "}" if is_closing => {
                open.pop();
            }
            _ => {}
        }
    }
    None
}

/// A brace that begins its line elsewhere than the line of the brace that it closes.
fn surplus_brace(text: &str) -> Option<Token<'_>> {
    let mut open: Vec<usize> = Vec::new();
    for (token, indent, begins_line) in placed(text).filter(|row| row.0.kind == TokenKind::Mark) {
        match token.text {
            "{" => open.push(indent),
            "}" => {
                let outer = open.pop()?;
                if begins_line && outer != indent {
                    return Some(token);
                }
            }
            _ => {}
        }
    }
    None
}

/// Leaves out brackets too many on lines with another mistake, which explains them.
pub(super) fn without_followers(text: &str, found: &mut Vec<Diagnostic>, brackets: usize) {
    let line = |span: Span| text.get(..span.start as usize).map_or(0, |before| before.matches('\n').count());
    let others: Vec<usize> = found.iter().skip(brackets).map(|other| line(other.span)).collect();
    let mut index = 0;
    found.retain(|one| {
        index += 1;
        index > brackets || !one.message.ends_with("too many") || !others.contains(&line(one.span))
    });
}

/// A diagnostic of a text with brackets behind its end, as one of the text itself.
pub(super) fn within(text: &str, mut found: Diagnostic) -> Diagnostic {
    let end = u32::try_from(text.len()).unwrap_or(u32::MAX);
    let place = |span: Span| Span { start: span.start.min(end), end: span.end.min(end), ..span };
    let Span { start, end: last, .. } = found.span;
    found.span = Span { start: start.min(end), end: last.min(end), ..found.span };
    for related in &mut found.related {
        related.span = related.span.map(place);
    }
    if found.fix.as_ref().is_some_and(|fix| fix.edits.iter().any(|edit| edit.span.end > end)) {
        found.fix = None;
    }
    found
}
