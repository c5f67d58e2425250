//! Entry point of the front end: bytes to text, and a document in either syntax to the tree. A language
//! model's reply is a document as well: the one in a Markdown fence or between prose. The prose around it is
//! blanked out rather than cut off, so that every offset stays right.

use std::sync::Arc;

use crate::ast::{File, MAX_BYTES};
use crate::diagnostic::Diagnostic;
use crate::diagnostics::{self, IgnoredPart, IgnoredProse, NoDocument, NotUtf8, TooLarge};
use crate::located::{Located, end_of_value};
use crate::source::{FileId, Source, Span, Syntax};
use crate::text::lexer::{Token, TokenKind, Tokens, tokens};
use crate::words::{DECLARATIONS, STEP_WORDS};
use crate::{foreign_json, json, text};

/// A document after reading, with its diagnostics.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// Declarations; of a JSON document one policy. After an error all that could be read.
    pub file: File,
    pub syntax: Syntax,
    /// Text that the spans refer to.
    pub text: Arc<str>,
    /// Errors and warnings in the order of the document.
    pub diagnostics: Vec<Diagnostic>,
    /// The JSON document as it is written, if shapes of it were read as others (M0122): pointers lead into it
    /// and not into the form of the language.
    pub written: Option<Arc<Located<'static>>>,
}

/// Reads a document. Its first character tells its syntax: JSON begins with `{` or `[`. A document in
/// a Markdown fence or between prose is found, and what is ignored is a warning. O(bytes), no recursion
/// deeper than [`crate::ast::MAX_NESTING`] allows, and no panic on any text.
#[must_use]
pub fn read(source: &Source, file: FileId) -> Parsed {
    let document: &str = &source.text;
    if document.len() > MAX_BYTES {
        let mistake = TooLarge { span: Span::new(file, 0, 0), bytes: document.len() };
        let (syntax, text) = (syntax_of(document), Arc::clone(&source.text));
        return Parsed {
            file: File::default(),
            syntax,
            text,
            diagnostics: vec![mistake.into()],
            written: None,
        };
    }
    let parsed = match document.strip_prefix(BOM) {
        Some(rest) => located(&format!("{BLANK_BOM}{rest}"), file),
        None => located(document, file),
    };
    Parsed { text: Arc::clone(&source.text), ..parsed }
}

/// Decodes a file to text. A byte order mark is blanked out, so that offsets stay those of the bytes.
///
/// # Errors
/// Bytes that are not UTF-8, with the offset of the first, and more than [`MAX_BYTES`] of them.
pub fn decode(bytes: &[u8], file: FileId) -> Result<String, Box<Diagnostic>> {
    if bytes.len() > MAX_BYTES {
        return Err(Box::new(TooLarge { span: Span::new(file, 0, 0), bytes: bytes.len() }.into()));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(match text.strip_prefix(BOM) {
            Some(rest) => format!("{BLANK_BOM}{rest}"),
            None => text.into(),
        }),
        Err(error) => {
            let at = error.valid_up_to();
            let byte = bytes.get(at).copied().unwrap_or(0);
            Err(Box::new(NotUtf8 { span: Span::new(file, at, at + 1), byte }.into()))
        }
    }
}

const BOM: char = '\u{feff}';
const BLANK_BOM: &str = "   ";

/// Reads a document that may be part of a reply.
fn located(document: &str, file: FileId) -> Parsed {
    match locate(document) {
        Reply::Whole => whole(document, file),
        Reply::Part(found) => {
            let mut parsed = whole(&blanked(document, &found), file);
            let prose = found.ignored.iter().map(|place| (place, IgnoredPart::Prose));
            let ignored = prose.chain(found.others.iter().map(|place| (place, IgnoredPart::Policy)));
            parsed.diagnostics.extend(ignored.map(|((start, end), part)| {
                Diagnostic::from(IgnoredProse { span: Span::new(file, *start, *end), part })
            }));
            parsed.diagnostics.sort_by_key(|diagnostic| diagnostic.span.start);
            parsed
        }
        Reply::Prose => {
            let start = document.len() - document.trim_start().len();
            let line = document.trim_start().lines().next().unwrap_or("").trim_end();
            let mistake = NoDocument { span: Span::new(file, start, start + line.len()) };
            let (syntax, diagnostics) = (Syntax::Text, vec![mistake.into()]);
            Parsed { file: File::default(), syntax, text: Arc::default(), diagnostics, written: None }
        }
    }
}

fn whole(document: &str, file: FileId) -> Parsed {
    let syntax = syntax_of(document);
    let (file, diagnostics, written) = match syntax {
        Syntax::Text => {
            let (file, diagnostics) = text::parse(document, file);
            (file, diagnostics, None)
        }
        Syntax::Json => {
            let json::PolicyDocument { file, found, written } =
                json::read_policy(document, file, foreign_json::plain_form);
            (file, found, written.map(Arc::new))
        }
    };
    // It is refused, and what was read before the limit would take as long to check as a document within it.
    let file = if diagnostics::is_cut(&diagnostics) { File::default() } else { file };
    Parsed { file, syntax, text: Arc::default(), diagnostics, written }
}

/// Syntax of a document, by its first character.
fn syntax_of(document: &str) -> Syntax {
    match document.trim_start().bytes().next() {
        Some(b'{' | b'[') => Syntax::Json,
        Some(_) | None => Syntax::Text,
    }
}

/// The document of a reply.
#[derive(Clone, PartialEq, Eq, Debug)]
struct FoundDocument {
    pub(crate) start: usize,
    pub(crate) end: usize,
    /// First lines of what is ignored around it, trimmed.
    pub(crate) ignored: Vec<(usize, usize)>,
    /// First lines of other policies beside it, trimmed.
    pub(crate) others: Vec<(usize, usize)>,
}

/// Classification of a text.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Reply {
    /// A document and nothing else, right or wrong.
    Whole,
    /// A document among other text.
    Part(FoundDocument),
    /// Prose without a document.
    Prose,
}

/// Finds the document of a text. O(bytes).
fn locate(text: &str) -> Reply {
    if is_json(text) {
        return after_json(text, text.len() - text.trim_ascii_start().len());
    }
    let mut first_two =
        tokens(text, 0).filter(|token| !matches!(token.kind, TokenKind::Comment | TokenKind::Doc));
    let (Some(first), second) = (first_two.next(), first_two.next()) else { return Reply::Whole };
    if first.text == "[" || is_declaration(first, second) {
        return after_policy(text, first.start);
    }
    let fences = fences(text);
    let best = fences
        .iter()
        .find(|fence| fence.is_policy(text))
        .or_else(|| fences.iter().find(|fence| fence.is_marked));
    if let Some(fence) = best.or(fences.first()) {
        let mut reply = part(text, fence.start, fence.end, fence.outer_start, fence.outer_end);
        if let Reply::Part(found) = &mut reply {
            let others = fences.iter().filter(|other| other.start != fence.start && other.is_policy(text));
            found.others = others.filter_map(|other| first_line(text, other.start, other.end)).collect();
        }
        return reply;
    }
    if let Some((start, end)) = bare(text) {
        return part(text, start, end, start, end);
    }
    let is_word = |token: Token<'_>| token.kind == TokenKind::Word;
    let goes_on = |token: Token<'_>| is_word(token) || matches!(token.text, "," | "'" | "." | "!" | "?");
    let is_listed = matches!(first.text, "-" | "*" | "#") || first.kind == TokenKind::Number;
    let reads_on = (is_word(first) || is_listed) && second.is_some_and(goes_on);
    let opens_block = text.trim_start().lines().next().is_some_and(|line| line.contains('{'));
    if reads_on && !opens_block && !STEP_WORDS.contains(&first.text) { Reply::Prose } else { Reply::Whole }
}

/// `policy fetch`: a word of a declaration and what must follow it.
fn is_declaration(first: Token<'_>, second: Option<Token<'_>>) -> bool {
    let named = second.is_some_and(|token| matches!(token.kind, TokenKind::Word | TokenKind::Quoted));
    // Facts may begin with anything.
    first.text == "initially" || DECLARATIONS.contains(&first.text) && (named || second.is_none())
}

/// Checks if a text begins with an object, or with a list that may be one of steps.
fn is_json(text: &str) -> bool {
    let text = text.trim_ascii_start();
    text.starts_with('{')
        || text.strip_prefix('[').is_some_and(|rest| rest.trim_ascii_start().starts_with(['{', '"']))
}

/// A text that begins with an object or a list: prose may follow.
fn after_json(text: &str, start: usize) -> Reply {
    let closing = if text.get(start..).is_some_and(|rest| rest.starts_with('[')) { ']' } else { '}' };
    if text.trim_ascii_end().ends_with(closing) {
        return Reply::Whole;
    }
    let Some(end) = end_of_value(text, start) else { return Reply::Whole };
    let rest = text.get(end..).unwrap_or("").trim_start();
    let is_prose =
        rest.chars().next().is_some_and(|c| c.is_alphabetic() || matches!(c, '`' | '*' | '#' | '(' | '-'));
    if is_prose { part(text, start, end, start, end) } else { Reply::Whole }
}

/// A text that begins with a declaration: prose may follow the last one.
fn after_policy(text: &str, start: usize) -> Reply {
    match declarations_end(text, start) {
        Some((end, true)) => part(text, start, end, start, end),
        Some((_, false)) | None => Reply::Whole,
    }
}

/// One past the brace that closes the last of the declarations that begin at `start`, and whether prose
/// follows it; `None` where no brace closes any.
fn declarations_end(text: &str, start: usize) -> Option<(usize, bool)> {
    let mut rest = tokens(text, start);
    let (mut depth, mut end) = (0_usize, None);
    while let Some(token) = rest.next() {
        match (token.kind, token.text) {
            (TokenKind::Mark, "{") => depth += 1,
            (TokenKind::Mark, "}") => {
                // One that closes nothing is not of the declarations.
                let Some(left) = depth.checked_sub(1) else { break };
                depth = left;
                if depth == 0 {
                    end = Some(token.end());
                    if is_prose(text, rest.clone()) {
                        return Some((token.end(), true));
                    }
                }
            }
            (_, _) => {}
        }
    }
    end.map(|end| (end, false))
}

/// Checks if prose or the end of a fence follows a declaration, and not a misspelt declaration.
fn is_prose(text: &str, mut rest: Tokens<'_>) -> bool {
    let (first, second, third) = (rest.next(), rest.next(), rest.next());
    let Some(first) = first else { return false };
    if text.get(first.start..).is_some_and(|rest| rest.starts_with("```")) {
        return true;
    }
    let reads_on = |token: Token<'_>| match token.kind {
        TokenKind::Word => third.is_none_or(|third| match third.text {
            "{" | ":" | "=" | "<" => false,
            "(" => third.start > token.end(),
            _ => true,
        }),
        _ => matches!(token.text, "," | "." | ":" | "!" | "'"),
    };
    first.kind == TokenKind::Word
        && !is_declaration(first, second)
        && !matches!(first.text, "during" | "catch" | "finally" | "else" | "until")
        && second.is_some_and(reads_on)
}

/// The document `start..end`; what lies outside of `outer_start..outer_end` and is not blank is ignored.
fn part(text: &str, start: usize, end: usize, outer_start: usize, outer_end: usize) -> Reply {
    let mut ignored = Vec::new();
    for (from, to) in [(0, outer_start), (outer_end, text.len())] {
        ignored.extend(first_line(text, from, to));
    }
    Reply::Part(FoundDocument { start, end, ignored, others: Vec::new() })
}

/// The first line of a part of a text that says anything, trimmed.
fn first_line(text: &str, from: usize, to: usize) -> Option<(usize, usize)> {
    let region = text.get(from..to).unwrap_or("");
    let mut lines = region.split_inclusive('\n').scan(from, |at, line| {
        let start = *at;
        *at += line.len();
        Some((start, line))
    });
    // The marks of a fence are nothing that anyone would miss.
    let is_mark = |line: &str| line.starts_with("```") || line.starts_with("~~~");
    let (at, line) = lines.find(|(_, line)| !line.trim().is_empty() && !is_mark(line.trim()))?;
    let begin = at + line.len() - line.trim_start().len();
    Some((begin, begin + line.trim().len()))
}

/// A fenced block of Markdown.
struct Fence {
    start: usize,
    end: usize,
    /// With the lines of the fence.
    outer_start: usize,
    outer_end: usize,
    /// True if its language is `json` or `motet`.
    is_marked: bool,
}

impl Fence {
    /// Checks if the block looks like a policy and not, say, like a part of a scene.
    fn is_policy(&self, text: &str) -> bool {
        looks_like_policy(text.get(self.start..self.end).unwrap_or(""))
    }
}

/// Keys of a policy.
const KEYS: &[&str] = &["\"steps\"", "\"policy\"", "\"motet\""];
/// Keys of steps that stand alone, and of calls in the manner of tools.
const STEP_KEYS: &[&str] = &["\"do\"", "\"plan\"", "\"actions\"", "\"action\"", "\"arguments\""];

fn looks_like_policy(document: &str) -> bool {
    if is_json(document) {
        return KEYS.iter().any(|key| document.contains(key));
    }
    let starts = |line: &str| {
        line.trim_start().strip_prefix("policy").is_some_and(|rest| rest.starts_with([' ', '\t']))
    };
    document.lines().any(starts)
}

/// All fenced blocks; one that is not closed ends with the text.
fn fences(text: &str) -> Vec<Fence> {
    let mut fences: Vec<Fence> = Vec::new();
    let mut open: Option<(&str, Fence)> = None;
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let (start, content) = (at, line.trim_end());
        at += line.len();
        match open.take() {
            None => {
                open = opening(content).map(|(offset, mark, is_marked)| {
                    let (outer_start, end) = (start + offset, text.len());
                    (mark, Fence { start: at, end, outer_start, outer_end: end, is_marked })
                });
            }
            // It may close behind the last line of what it holds.
            Some((mark, fence)) => match content.strip_suffix(mark).filter(|held| !held.contains(mark)) {
                Some(held) => {
                    let end = start + held.trim_end_matches(['`', '~', ' ', '\t']).len();
                    fences.push(Fence { end, outer_end: at, ..fence });
                }
                None => open = Some((mark, fence)),
            },
        }
    }
    fences.extend(open.map(|(_, fence)| fence));
    fences
}

/// Finds the opening of a fence on a line: its offset, its mark, and true for a language of ours. It may
/// stand after prose.
fn opening(line: &str) -> Option<(usize, &'static str, bool)> {
    let (offset, mark) =
        ["```", "~~~"].into_iter().filter_map(|mark| Some((line.find(mark)?, mark))).min()?;
    let language = line.get(offset..)?.trim_start_matches(['`', '~']).trim().to_ascii_lowercase();
    let is_marked = ["json", "jsonc", "json5", "motet"].contains(&language.as_str());
    let begins_line = line.get(..offset)?.trim().is_empty();
    (begins_line || is_marked || language.is_empty()).then_some((offset, mark, is_marked))
}

/// A document in prose without a fence: the first object or declaration that looks like a policy.
fn bare(text: &str) -> Option<(usize, usize)> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with("policy ") && text.get(at..).is_some_and(|rest| rest.contains('{')) {
            let end = declarations_end(text, at).map_or(text.len(), |(end, _)| end);
            return Some((at, end));
        }
        at += line.len();
    }
    bare_json(text, KEYS).or_else(|| bare_json(text, STEP_KEYS))
}

/// The first object, or list of objects, in prose that has one of these keys.
fn bare_json(text: &str, keys: &[&str]) -> Option<(usize, usize)> {
    let mut from = 0;
    while let Some(start) = text.get(from..)?.find(['{', '[']).map(|offset| from + offset) {
        let inside = text.get(start + 1..).unwrap_or("").trim_ascii_start();
        let is_list = text.get(start..).is_some_and(|rest| rest.starts_with('['));
        if is_list && !inside.starts_with('{') {
            from = start + 1;
            continue;
        }
        let end = end_of_value(text, start).unwrap_or(text.len());
        let document = text.get(start..end)?;
        if (is_list || inside.starts_with('"')) && keys.iter().any(|key| document.contains(key)) {
            return Some((start, end));
        }
        from = end;
    }
    None
}

/// The text up to `found.end`, with everything before `found.start` blank.
fn blanked(text: &str, found: &FoundDocument) -> String {
    let mut blank = String::with_capacity(found.end);
    let before = text.bytes().take(found.start);
    blank.extend(before.map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
    blank.push_str(text.get(found.start..found.end).unwrap_or(""));
    blank
}
