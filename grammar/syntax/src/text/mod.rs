//! The text front end: `motet.pest` parses, the builders in this folder make the AST with exact spans, and
//! [`syntax_error`] puts what the grammar refuses into words.

mod brackets;
mod builder;
mod expr;
pub mod lexer;
mod recover;
mod step;
mod syntax_error;
pub(crate) mod template;

pub use self::template::MAX_TEXT_VALUES;

use pest::Parser as _;

use crate::ast;
use crate::diagnostic::{Diagnostic, Edit, Fix};
use crate::diagnostics::ReadShape;
use crate::source::{FileId, Span};
use crate::words;

/// Parser that pest generates from the grammar.
mod grammar {
    #![allow(missing_docs, unreachable_pub, reason = "generated, and private to the front end")]

    /// The parser of the grammar file.
    #[derive(pest_derive::Parser)]
    #[grammar = "motet.pest"]
    pub(super) struct MotetParser;
}

use grammar::{MotetParser, Rule};
use recover::Refusal;

type Pair<'s> = pest::iterators::Pair<'s, Rule>;

/// Parses a text of declarations and policies, with all of its syntax errors. The tree then holds what could
/// be read; it is empty where it is not clear which block a brace belongs to. O(bytes) without a mistake.
pub(crate) fn parse(text: &str, file: FileId) -> (ast::File, Vec<Diagnostic>) {
    let parser = WholeParser { file, is_bare: begins_with_step(text) };
    let first = match parser.parse(text, Vec::new()) {
        Ok(parsed) => return parsed,
        Err(refusal) => refusal,
    };
    let Some(balanced) = brackets::balance(text, file) else { return parser.rest_of(text, first) };
    let brackets::Balanced { text: mended, mut found, is_certain } = balanced;
    let count = found.len();
    let (tree, more) = match parser.parse(&mended, Vec::new()) {
        Ok(parsed) => parsed,
        Err(refusal) => parser.rest_of(&mended, refusal),
    };
    found.extend(more);
    let mut found: Vec<Diagnostic> = found.into_iter().map(|found| brackets::within(text, found)).collect();
    brackets::without_followers(text, &mut found, count);
    found.sort_by_key(|diagnostic| diagnostic.span.start);
    (if is_certain { tree } else { ast::File::default() }, found)
}

/// Checks if a text begins with a step where a declaration should be.
fn begins_with_step(text: &str) -> bool {
    let mut code = lexer::tokens(text, 0).filter(|token| token.kind != lexer::TokenKind::Comment);
    let (Some(first), second) = (code.next(), code.next()) else { return false };
    let is_call = second.is_some_and(|second| second.text == "(" && second.start == first.end());
    first.kind == lexer::TokenKind::Word
        && !words::DECLARATIONS.contains(&first.text)
        && (is_call || words::STEP_WORDS.contains(&first.text))
}

/// Parser of whole texts: of declarations, or of steps alone.
#[derive(Clone, Copy)]
struct WholeParser {
    file: FileId,
    /// True for steps without a policy around them.
    is_bare: bool,
}

impl WholeParser {
    /// Parses what is left of a text around its errors.
    fn rest_of(self, text: &str, first: Refusal) -> (ast::File, Vec<Diagnostic>) {
        let recover::Recovered { rest, gaps, found } =
            recover::recover(text, first, self.is_bare, |rest| self.parse(rest, Vec::new()).err());
        let tree = rest.and_then(|rest| self.parse(&rest, gaps).ok());
        let (tree, more) = tree.unwrap_or_default();
        let mut found: Vec<Diagnostic> = found.into_iter().chain(more).collect();
        found.sort_by_key(|diagnostic| diagnostic.span.start);
        (tree, found)
    }

    /// Parses a text that lacks what stood at `gaps`, and stops at the first syntax error.
    fn parse(self, text: &str, gaps: Vec<usize>) -> Result<(ast::File, Vec<Diagnostic>), Refusal> {
        let file = self.file;
        // What the lexer refuses may stand anywhere.
        lexer::check(text, file)
            .map_err(|fault| Refusal { diagnostic: fault.diagnostic, is_between: true })?;
        let rule = if self.is_bare { Rule::steps } else { Rule::file };
        let mut pairs =
            MotetParser::parse(rule, text).map_err(|error| syntax_error::refusal(text, &error, file))?;
        let mut builder = builder::Builder::new(file);
        builder.gaps = gaps;
        let mut tree = ast::File::default();
        match pairs.next() {
            Some(pair) if self.is_bare => {
                let policy = builder.bare_steps(pair);
                builder.found.insert(0, bare(text, file));
                tree.items.push(ast::Item::Policy(policy));
            }
            Some(pair) => tree = builder.items(pair),
            None => {}
        }
        Ok((tree, builder.found))
    }
}

/// Name of the policy around steps that have none.
const UNNAMED: &str = "plan";

/// The note that steps are read as a policy.
fn bare(text: &str, file: FileId) -> Diagnostic {
    let start = text.len() - text.trim_start().len();
    let end = text.trim_end().len();
    let mut code = lexer::tokens(text, 0).filter(|token| token.kind != lexer::TokenKind::Comment);
    let first = code.next().map_or(Span::new(file, start, start), |token| token.span(file));
    let edit = |at: usize, text: String| Edit { span: Span::new(file, at, at), text };
    let edits = vec![edit(start, format!("policy {UNNAMED} {{\n")), edit(end, "\n}".into())];
    let read = "a policy with these steps".to_owned();
    let fix = Fix { title: format!("write {read}"), edits };
    ReadShape { span: first, written: "a list of steps".into(), read, more: 0, fix }.into()
}

/// Parses one condition or term that stands at `origin` in another document, in `depth` blocks of it.
pub(crate) fn parse_expr(text: &str, origin: Origin, depth: usize) -> (Option<ast::Expr>, Vec<Diagnostic>) {
    let file = FileId::default();
    let moved = |diagnostic| (None, vec![origin.moved(diagnostic)]);
    if let Err(fault) = lexer::check(text, file) {
        return moved(*fault.diagnostic);
    }
    match MotetParser::parse(Rule::lone_expr, text) {
        Ok(mut pairs) => {
            let mut builder = builder::Builder::new(file);
            builder.origin = origin;
            let inner = pairs.next().and_then(|pair| pair.into_inner().next());
            let expr = inner.map(|pair| builder.expr(pair, depth));
            (expr, builder.found)
        }
        Err(error) => moved(*syntax_error::refusal(text, &error, file).diagnostic),
    }
}

/// Parses one condition without a policy around it, such as a fact of a state: `on(cup, table)`.
///
/// ```
/// use motet_syntax::{print, text};
///
/// let fact = text::parse_condition("on( cup,table )").unwrap();
/// assert_eq!(print::expression(&fact), "on(cup, table)");
/// assert!(text::parse_condition("on(cup").is_err());
/// ```
///
/// # Errors
///
/// The reason, in words, if the text is no condition.
pub fn parse_condition(text: &str) -> Result<ast::Expr, String> {
    let (expr, found) = parse_expr(text, Origin::At(FileId::default(), 0), 0);
    match (expr, found.into_iter().next()) {
        (Some(expr), None) => Ok(expr),
        (_, Some(mistake)) => Err(mistake.message),
        (None, None) => Err("nothing is written here".to_owned()),
    }
}

/// Parses one value that a string of another document holds, at a place of that document; `None` if it is
/// none. Every part of it has that place.
#[must_use]
pub fn parse_value(text: &str, place: Span) -> Option<ast::Expr> {
    let (expr, found) = parse_expr(text, Origin::Within(place), 0);
    expr.filter(|_| found.is_empty())
}

/// Reads a text with values as it stands between quotes: `I see {count(cans)} cans`. Without values it is an
/// [`ast::ExprKind::Text`], with single braces.
///
/// ```
/// use motet_syntax::{print, text};
///
/// let read = text::parse_text("I see { x } in {{ }}").unwrap();
/// assert_eq!(print::expression(&read), "\"I see {x} in {{ }}\"");
/// assert!(text::parse_text("I see {x").is_err());
/// ```
///
/// # Errors
///
/// The reason, in words, if a value in braces cannot be read.
pub fn parse_text(text: &str) -> Result<ast::Expr, String> {
    let file = FileId::default();
    let span = Span::new(file, 0, text.len());
    let read = template::read(text.into(), Origin::At(file, 0), span);
    match read.found.into_iter().next() {
        Some(mistake) => Err(mistake.message),
        None => Ok(ast::Expr { kind: read.kind, span }),
    }
}

/// Position of a text in its document.
#[derive(Clone, Copy)]
pub(crate) enum Origin {
    /// As it is, from this offset of this file on.
    At(FileId, u32),
    /// Otherwise written, somewhere in this span.
    Within(Span),
}

impl Origin {
    fn place(self, start: usize, end: usize) -> Span {
        match self {
            Self::At(file, offset) => Span::new(file, start + offset as usize, end + offset as usize),
            Self::Within(span) => span,
        }
    }

    /// Position of what begins so many bytes later.
    fn moved_by(self, bytes: usize) -> Self {
        let bytes = u32::try_from(bytes).unwrap_or(u32::MAX);
        match self {
            Self::At(file, offset) => Self::At(file, offset.saturating_add(bytes)),
            Self::Within(_) => self,
        }
    }

    /// A diagnostic of the text as one of its document.
    fn moved(self, mut diagnostic: Diagnostic) -> Diagnostic {
        let place = |span: Span| self.place(span.start as usize, span.end as usize);
        diagnostic.span = place(diagnostic.span);
        for related in &mut diagnostic.related {
            related.span = related.span.map(place);
        }
        if let (Some(fix), Self::At(..)) = (&mut diagnostic.fix, self) {
            fix.edits.iter_mut().for_each(|edit| edit.span = place(edit.span));
        } else {
            diagnostic.fix = None;
        }
        diagnostic
    }
}
