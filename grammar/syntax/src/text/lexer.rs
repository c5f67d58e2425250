//! Lexer for the tasks that pest does not do: counting brackets before parsing, naming the word at an error,
//! finding comments. It splits any text into tokens and knows nothing of how they fit together; the grammar
//! alone says that.
//!
//! Before parsing, [`check`] makes sure that brackets match and nest little enough to recurse over, texts
//! end, and tokens are within the limit. A missing bracket is best explained there, where the open one is
//! known.

use crate::ast::{MAX_NESTING, MAX_TOKENS};
use crate::diagnostic::Diagnostic;
use crate::diagnostics::{DocumentKind, Empty, TextSyntax, TooDeep, TooManyTokens};
use crate::render::is_steering;
use crate::source::{FileId, Span};
use crate::unit::number_length;

/// Kind of a token.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TokenKind {
    /// A word: `pick`, `let`.
    Word,
    /// A back-quoted name: `` `7up` ``.
    Quoted,
    /// A number without sign and unit.
    Number,
    /// A text: `"red mug"`.
    Text,
    /// `// …` and `//// …`
    Comment,
    /// A documentation comment: `/// …`.
    Doc,
    /// Any other mark: `{`, `==`, `->`, a stray character.
    Mark,
    /// A text or a back-quoted name that does not end on its line.
    Open,
}

/// One token of a text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Token<'s> {
    pub kind: TokenKind,
    pub text: &'s str,
    /// Offset of its first byte.
    pub start: usize,
}

impl Token<'_> {
    /// Offset one past its last byte.
    #[must_use]
    pub fn end(&self) -> usize {
        self.start + self.text.len()
    }

    /// Range of the token.
    #[must_use]
    pub fn span(&self, file: FileId) -> Span {
        Span::new(file, self.start, self.end())
    }
}

/// The tokens of a text from an offset on, white space left out. Linear, and total: every text has tokens.
#[must_use]
pub fn tokens(text: &str, from: usize) -> Tokens<'_> {
    Tokens { text, at: from }
}

/// Iterator that [`tokens`] returns.
#[derive(Clone, Debug)]
pub struct Tokens<'s> {
    text: &'s str,
    at: usize,
}

impl<'s> Iterator for Tokens<'s> {
    type Item = Token<'s>;

    fn next(&mut self) -> Option<Token<'s>> {
        let rest = self.text.get(self.at..)?;
        let trimmed = rest.trim_start_matches([' ', '\t', '\r', '\n']);
        let start = self.at + rest.len() - trimmed.len();
        let (kind, length) = measure(trimmed)?;
        let text = trimmed.get(..length)?;
        self.at = start + length;
        Some(Token { kind, text, start })
    }
}

/// Kind and length in bytes of the token that a text begins with.
fn measure(text: &str) -> Option<(TokenKind, usize)> {
    let first = text.chars().next()?;
    let while_ = |is: fn(char) -> bool| text.find(|c| !is(c)).unwrap_or(text.len());
    let line = || text.find('\n').unwrap_or(text.len());
    let measured = match first {
        'a'..='z' | 'A'..='Z' | '_' => (TokenKind::Word, while_(|c| c.is_ascii_alphanumeric() || c == '_')),
        '0'..='9' => (TokenKind::Number, number_length(text)),
        '"' => delimited(text, '"', TokenKind::Text),
        '`' => delimited(text, '`', TokenKind::Quoted),
        '/' if text.starts_with("////") => (TokenKind::Comment, line()),
        '/' if text.starts_with("///") => (TokenKind::Doc, line()),
        '/' if text.starts_with("//") => (TokenKind::Comment, line()),
        other => {
            let two =
                ["==", "!=", "<=", ">=", "->", "..", "&&", "||"].iter().any(|mark| text.starts_with(mark));
            (TokenKind::Mark, if two { 2 } else { other.len_utf8() })
        }
    };
    Some(measured)
}

/// A text or a quoted name; it is open where its line ends first.
fn delimited(text: &str, mark: char, kind: TokenKind) -> (TokenKind, usize) {
    let mut is_escaped = false;
    for (at, character) in text.char_indices().skip(1) {
        match character {
            '\n' | '\r' => return (TokenKind::Open, at),
            _ if is_escaped => is_escaped = false,
            '\\' if mark == '"' => is_escaped = true,
            c if c == mark => return (kind, at + c.len_utf8()),
            _ => {}
        }
    }
    (TokenKind::Open, text.len())
}

/// Mistake that makes parsing hopeless or dangerous.
pub(super) struct LexicalFault {
    pub(super) diagnostic: Box<Diagnostic>,
    /// Brackets at fault, if it is about brackets that do not match.
    pub(super) bracket: Option<BracketFault>,
}

/// Brackets that do not match, by their offsets.
#[derive(Clone, Copy)]
pub(super) enum BracketFault {
    /// A bracket that closes nothing inside of its block.
    Surplus { at: usize },
    /// A brace that closes nothing.
    ClosesNothing { at: usize },
    /// A bracket that is open where a brace begins or ends a block.
    Unclosed { opening: usize, before: usize },
    /// A bracket that is open where the text ends.
    Ended { opening: usize },
}

impl From<Diagnostic> for LexicalFault {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { diagnostic: Box::new(diagnostic), bracket: None }
    }
}

/// Finds the first mistake that makes parsing hopeless or dangerous.
pub(super) fn check(text: &str, file: FileId) -> Result<(), LexicalFault> {
    let mut open: Vec<Token<'_>> = Vec::with_capacity(MAX_NESTING);
    let (mut count, mut previous) = (0, "");
    // First token of the line, and the end of the last one.
    let (mut line, mut end) = (0, 0);
    for token in tokens(text, 0) {
        count += usize::from(token.kind != TokenKind::Comment);
        if text.get(end..token.start).is_some_and(|between| between.contains('\n')) {
            line = token.start;
        }
        end = token.end();
        if count > MAX_TOKENS {
            return Err(Diagnostic::from(TooManyTokens { span: token.span(file) }).into());
        }
        match (token.kind, token.text) {
            (TokenKind::Open, _) => return Err(unended(token, file).into()),
            (TokenKind::Comment | TokenKind::Doc | TokenKind::Quoted, _) => unsteered(token, file)?,
            (TokenKind::Mark, "{")
                if open.last().is_some_and(|last| matches!(last.text, "(" | "[") && last.start >= line) =>
            {
                return Err(unclosed(open.last().copied().unwrap_or(token), token, file));
            }
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
            return Err(Diagnostic::from(TooDeep { span: token.span(file), limit: MAX_NESTING }).into());
        }
        previous = token.text;
    }
    if count == 0 {
        let span = Span::new(file, 0, 0);
        return Err(Diagnostic::from(Empty { span, wanted: DocumentKind::Policy }).into());
    }
    open.retain(|opening| opening.text != "<");
    match open.last() {
        None => Ok(()),
        Some(opening) => {
            let end = text.trim_end().len();
            let closing = closing(opening.text);
            let message = format!("the text ends before the `{closing}` for a `{}`", opening.text);
            let mistake = TextSyntax {
                related: Some(("opened here", opening.span(file))),
                ..TextSyntax::new(Span::new(file, end, end), message, format!("close it with `{closing}`"))
            };
            Err(fault(mistake, BracketFault::Ended { opening: opening.start }))
        }
    }
}

/// Refuses a comment or a name with what steers a terminal: neither has escapes.
fn unsteered(token: Token<'_>, file: FileId) -> Result<(), LexicalFault> {
    let text = token.text.trim_end_matches('\r');
    let mut letters = text.char_indices().filter(|(_, letter)| *letter != '\t' && is_steering(*letter));
    let Some((at, letter)) = letters.next() else { return Ok(()) };
    let (start, kind) = (token.start + at, if token.kind == TokenKind::Quoted { "name" } else { "comment" });
    let span = Span::new(file, start, start + letter.len_utf8());
    let message = format!("the {kind} has the control character `{}`", letter.escape_default());
    Err(Diagnostic::from(TextSyntax::new(span, message, "remove it")).into())
}

pub(super) fn closing(opening: &str) -> &'static str {
    match opening {
        "{" => "}",
        "(" => ")",
        _ => "]",
    }
}

fn close(open: &mut Vec<Token<'_>>, token: Token<'_>, file: FileId) -> Result<(), LexicalFault> {
    let at = token.start;
    match open.pop() {
        Some(opening) if closing(opening.text) == token.text => Ok(()),
        Some(opening) if opening.text == "{" => {
            let message = format!("there is one `{}` too many", token.text);
            let mistake = TextSyntax {
                fix: Some(String::new()),
                ..TextSyntax::new(token.span(file), message, "remove it")
            };
            Err(fault(mistake, BracketFault::Surplus { at }))
        }
        Some(opening) => Err(unclosed(opening, token, file)),
        None => {
            let message = format!("nothing is open that this `{}` could close", token.text);
            let help = "remove it, or look for a bracket that closes too early above";
            let mistake = TextSyntax::new(token.span(file), message, help);
            let is_brace = token.text == "}";
            let bracket =
                if is_brace { BracketFault::ClosesNothing { at } } else { BracketFault::Surplus { at } };
            Err(fault(mistake, bracket))
        }
    }
}

/// A bracket that another one may not follow.
fn unclosed(opening: Token<'_>, token: Token<'_>, file: FileId) -> LexicalFault {
    let expected = closing(opening.text);
    let message = format!("expected `{expected}`, found `{}`", token.text);
    let help = format!("close the `{}` with `{expected}` first", opening.text);
    let mistake = TextSyntax {
        related: Some(("opened here", opening.span(file))),
        ..TextSyntax::new(token.span(file), message, help)
    };
    let bracket = BracketFault::Unclosed { opening: opening.start, before: token.start };
    LexicalFault {
        bracket: matches!(token.text, "{" | "}").then_some(bracket),
        ..Diagnostic::from(mistake).into()
    }
}

fn fault(mistake: TextSyntax, bracket: BracketFault) -> LexicalFault {
    LexicalFault { bracket: Some(bracket), ..Diagnostic::from(mistake).into() }
}

fn unended(token: Token<'_>, file: FileId) -> Diagnostic {
    let (what, mark) = if token.text.starts_with('`') { ("name", "`") } else { ("text", "\"") };
    let help = match what {
        "text" => "close it with `\"` on the same line; a line break inside is written `\\n`".into(),
        _ => format!("close it with another {mark} on the same line"),
    };
    TextSyntax::new(token.span(file), format!("the {what} is not closed"), help).into()
}

#[cfg(test)]
mod tests {
    use super::{TokenKind, tokens};

    #[test]
    fn tokens_cover_any_text() {
        let text = "let m = a(\"x\\\"y\") // c\n  `7up` 1.5e3 cm 1..2 /// d\n é \"open\n";
        let found: Vec<_> = tokens(text, 0).map(|token| token.text).collect();
        let expected = [
            "let",
            "m",
            "=",
            "a",
            "(",
            "\"x\\\"y\"",
            ")",
            "// c",
            "`7up`",
            "1.5e3",
            "cm",
            "1",
            "..",
            "2",
            "/// d",
            "é",
            "\"open",
        ];
        assert_eq!(found, expected);
        assert_eq!(tokens(text, 0).last().map(|token| token.kind), Some(TokenKind::Open));
    }
}
