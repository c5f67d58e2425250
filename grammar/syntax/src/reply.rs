//! A language model's reply as it comes: finds the one document in a Markdown fence or between prose. What is around it
//! is blanked out rather than cut off before it, so that every place stays right. Feeds [`crate::read()`].

use crate::text::token::{Token, TokenKind, tokens};

/// The document of a reply.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Found {
    /// Its bytes.
    pub(crate) start: usize,
    /// One past its bytes.
    pub(crate) end: usize,
    /// First lines of what is ignored around it, trimmed.
    pub(crate) ignored: Vec<(usize, usize)>,
}

/// What a text is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Reply {
    /// A document and nothing else, right or wrong.
    Whole,
    /// A document among other text.
    Part(Found),
    /// Prose.
    Prose,
}

/// Words with which a declaration begins.
const DECLARATIONS: &[&str] = &[
    "policy",
    "action",
    "perception",
    "kind",
    "fluent",
    "measure",
    "failure",
    "enum",
    "entity",
    "initially",
    "closed",
];

/// Finds the document of a text. O(bytes).
pub(crate) fn locate(text: &str) -> Reply {
    if text.trim_ascii_start().starts_with('{') {
        return after_object(text, text.len() - text.trim_ascii_start().len());
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
        return part(text, fence.start, fence.end, fence.outer_start, fence.outer_end);
    }
    if let Some((start, end)) = bare(text) {
        return part(text, start, end, start, end);
    }
    let is_word = |token: Token<'_>| token.kind == TokenKind::Word;
    let reads_on =
        is_word(first) && second.is_some_and(|token| is_word(token) || matches!(token.text, "," | "'" | "."));
    if reads_on && !text.contains('{') { Reply::Prose } else { Reply::Whole }
}

/// `policy fetch`: a word of a declaration and what must follow it.
fn is_declaration(first: Token<'_>, second: Option<Token<'_>>) -> bool {
    let named = second.is_some_and(|token| matches!(token.kind, TokenKind::Word | TokenKind::Quoted));
    // Facts may begin with anything.
    first.text == "initially" || DECLARATIONS.contains(&first.text) && (named || second.is_none())
}

/// A text that begins with an object: prose may follow.
fn after_object(text: &str, start: usize) -> Reply {
    if text.trim_ascii_end().ends_with('}') {
        return Reply::Whole;
    }
    let Some(end) = object_end(text, start) else { return Reply::Whole };
    let rest = text.get(end..).unwrap_or("").trim_start();
    let is_prose =
        rest.chars().next().is_some_and(|c| c.is_alphabetic() || matches!(c, '`' | '*' | '#' | '(' | '-'));
    if is_prose { part(text, start, end, start, end) } else { Reply::Whole }
}

/// A text that begins with a declaration: prose without braces may follow the last one.
fn after_policy(text: &str, start: usize) -> Reply {
    if text.trim_ascii_end().ends_with('}') {
        return Reply::Whole;
    }
    let closing =
        tokens(text, start).filter(|token| token.kind == TokenKind::Mark && token.text == "}").last();
    let Some(end) = closing.map(|token| token.end()) else { return Reply::Whole };
    let mut rest = tokens(text, end);
    let (first, second) = (rest.next(), rest.next());
    let Some(first) = first else { return Reply::Whole };
    let is_fence = text.get(first.start..).is_some_and(|rest| rest.starts_with("```"));
    let is_prose = first.kind == TokenKind::Word
        && !is_declaration(first, second)
        && !matches!(first.text, "during" | "catch" | "else" | "until")
        && second.is_some_and(|token| token.kind == TokenKind::Word || matches!(token.text, "," | "." | ":"));
    if is_fence || is_prose { part(text, start, end, start, end) } else { Reply::Whole }
}

/// The document `start..end`; what lies outside of `outer_start..outer_end` and is not blank is ignored.
fn part(text: &str, start: usize, end: usize, outer_start: usize, outer_end: usize) -> Reply {
    let mut ignored = Vec::new();
    for (from, to) in [(0, outer_start), (outer_end, text.len())] {
        let region = text.get(from..to).unwrap_or("");
        let lines = region.split_inclusive('\n').scan(from, |at, line| {
            let start = *at;
            *at += line.len();
            Some((start, line))
        });
        // Comments and the marks of an empty fence are nothing that anyone would miss.
        let told = lines.into_iter().find(|(_, line)| !matches!(line.trim(), "" | "```" | "~~~"));
        if let Some((at, line)) = told {
            let begin = at + line.len() - line.trim_start().len();
            ignored.push((begin, begin + line.trim().len()));
        }
    }
    Reply::Part(Found { start, end, ignored })
}

/// A fenced block of Markdown.
struct Fence {
    /// Its content.
    start: usize,
    end: usize,
    /// With the lines of the fence.
    outer_start: usize,
    outer_end: usize,
    /// Whether its language is `json` or `motet`.
    is_marked: bool,
}

impl Fence {
    /// Whether it looks like a policy and not, say, like a piece of a scene.
    fn is_policy(&self, text: &str) -> bool {
        looks_like_policy(text.get(self.start..self.end).unwrap_or(""))
    }
}

fn looks_like_policy(document: &str) -> bool {
    if document.trim_start().starts_with('{') {
        return ["\"steps\"", "\"policy\"", "\"motet\""].iter().any(|key| document.contains(key));
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
        let (start, trimmed) = (at, line.trim());
        at += line.len();
        let mark = ["```", "~~~"].into_iter().find(|mark| trimmed.starts_with(mark));
        match (open.take(), mark) {
            (None, Some(mark)) => {
                let language = trimmed.trim_start_matches(['`', '~']).trim().to_ascii_lowercase();
                let is_marked = ["json", "jsonc", "json5", "motet"].contains(&language.as_str());
                let fence = Fence {
                    start: at,
                    end: text.len(),
                    outer_start: start,
                    outer_end: text.len(),
                    is_marked,
                };
                open = Some((mark, fence));
            }
            (Some((mark, fence)), Some(closing))
                if mark == closing && trimmed.trim_start_matches(['`', '~']).is_empty() =>
            {
                fences.push(Fence { end: start, outer_end: at, ..fence });
            }
            (still_open, _) => open = still_open,
        }
    }
    fences.extend(open.map(|(_, fence)| fence));
    fences
}

/// A document in prose without a fence: the first object or declaration that looks like a policy.
fn bare(text: &str) -> Option<(usize, usize)> {
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        if line.trim_start().starts_with("policy ") && text.get(at..).is_some_and(|rest| rest.contains('{')) {
            let end = text.rfind('}').map_or(text.len(), |brace| brace + 1);
            return Some((at, end.max(at)));
        }
        at += line.len();
    }
    let mut from = 0;
    while let Some(start) = text.get(from..)?.find('{').map(|offset| from + offset) {
        let end = object_end(text, start).unwrap_or(text.len());
        let document = text.get(start..end)?;
        let inside = document.get(1..).unwrap_or("").trim_start();
        if inside.starts_with('"') && looks_like_policy(document) {
            return Some((start, end));
        }
        from = end;
    }
    None
}

/// One past the brace that closes the object at `start`; `None` where it is not closed.
fn object_end(text: &str, start: usize) -> Option<usize> {
    let (mut depth, mut in_text, mut is_escaped) = (0_usize, false, false);
    for (offset, byte) in text.get(start..)?.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if in_text => is_escaped = true,
            b'"' => in_text = !in_text,
            b'{' | b'[' if !in_text => depth += 1,
            b'}' | b']' if !in_text => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return Some(start + offset + 1);
                }
            }
            _ => {}
        }
    }
    None
}

/// The text up to `found.end`, with everything before `found.start` blank.
pub(crate) fn blanked(text: &str, found: &Found) -> String {
    let mut blank = String::with_capacity(found.end);
    let before = text.bytes().take(found.start);
    blank.extend(before.map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
    blank.push_str(text.get(found.start..found.end).unwrap_or(""));
    blank
}
