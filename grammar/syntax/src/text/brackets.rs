//! Bracket check of a text before it is parsed: brackets match and nest little enough to recurse over, texts
//! end, and tokens are within the limit. A missing bracket is best explained here, where the open one is
//! known.

use super::lexer::{Token, TokenKind, tokens};
use crate::ast::{MAX_NESTING, MAX_TOKENS};
use crate::diagnostic::Diagnostic;
use crate::errors::{DocumentKind, Empty, TextSyntax, TooDeep, TooManyTokens};
use crate::source::{FileId, Span};

/// Finds the first mistake that makes parsing hopeless or dangerous.
pub(crate) fn check(text: &str, file: FileId) -> Result<(), Box<Diagnostic>> {
    let mut open: Vec<Token<'_>> = Vec::with_capacity(MAX_NESTING);
    let (mut count, mut previous) = (0, "");
    for token in tokens(text, 0) {
        count += usize::from(token.kind != TokenKind::Comment);
        if count > MAX_TOKENS {
            return Err(Box::new(TooManyTokens { span: token.span(file) }.into()));
        }
        match (token.kind, token.text) {
            (TokenKind::Open, _) => return Err(Box::new(unended(token, file))),
            (TokenKind::Mark, "{" | "(" | "[") => open.push(token),
            // `List<List<…>>`; elsewhere `<` compares.
            (TokenKind::Mark, "<") if previous == "List" => open.push(token),
            (TokenKind::Mark, ">") if open.last().is_some_and(|last| last.text == "<") => {
                open.pop();
            }
            (TokenKind::Mark, "}" | ")" | "]") => {
                open.retain(|opening| opening.text != "<");
                close(&mut open, token, file)?;
            }
            (_, _) => {}
        }
        if open.len() > MAX_NESTING {
            return Err(Box::new(TooDeep { span: token.span(file), limit: MAX_NESTING }.into()));
        }
        previous = token.text;
    }
    if count == 0 {
        let span = Span::new(file, 0, 0);
        return Err(Box::new(Empty { span, wanted: DocumentKind::Policy }.into()));
    }
    open.retain(|opening| opening.text != "<");
    match open.last() {
        None => Ok(()),
        Some(opening) => {
            let end = text.trim_end().len();
            let closing = closing(opening.text);
            let message = format!("the text ends before the `{closing}` for a `{}`", opening.text);
            Err(boxed(TextSyntax {
                related: Some(("opened here", opening.span(file))),
                ..TextSyntax::new(Span::new(file, end, end), message, format!("close it with `{closing}`"))
            }))
        }
    }
}

fn closing(opening: &str) -> &'static str {
    match opening {
        "{" => "}",
        "(" => ")",
        _ => "]",
    }
}

fn close(open: &mut Vec<Token<'_>>, token: Token<'_>, file: FileId) -> Result<(), Box<Diagnostic>> {
    let span = token.span(file);
    match open.pop() {
        Some(opening) if closing(opening.text) == token.text => Ok(()),
        Some(opening) => {
            let expected = closing(opening.text);
            let message = format!("expected `{expected}`, found `{}`", token.text);
            let help = format!("close the `{}` with `{expected}` first", opening.text);
            Err(boxed(TextSyntax {
                related: Some(("opened here", opening.span(file))),
                ..TextSyntax::new(span, message, help)
            }))
        }
        None => {
            let message = format!("nothing is open that this `{}` could close", token.text);
            let help = "remove it, or look for a bracket that closes too early above";
            Err(boxed(TextSyntax::new(span, message, help)))
        }
    }
}

fn boxed(mistake: TextSyntax) -> Box<Diagnostic> {
    Box::new(mistake.into())
}

fn unended(token: Token<'_>, file: FileId) -> Diagnostic {
    let (what, mark) = if token.text.starts_with('`') { ("name", "`") } else { ("text", "\"") };
    let help = match what {
        "text" => "close it with `\"` on the same line; a line break inside is written `\\n`".into(),
        _ => format!("close it with another {mark} on the same line"),
    };
    TextSyntax::new(token.span(file), format!("the {what} is not closed"), help).into()
}
