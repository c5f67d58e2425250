//! Context of a place where an author writes: what kind of word fits there, found from the tokens before it.
//! It reads any text, however broken.

use motet_syntax::text::lexer::{Token, TokenKind, tokens};
use motet_syntax::words::DECLARATIONS;
use smol_str::SmolStr;

/// Context of a place in a document of the text syntax.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct WritingContext {
    /// Range of the word that is being written; empty before one.
    pub(crate) word: (usize, usize),
    pub(crate) place: WritingPlace,
    /// Range of the step that is being written, where it stands alone on its line; else an empty one before
    /// the line. `None` outside of policies.
    pub(crate) step: Option<(usize, usize)>,
}

/// Kind of place.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum WritingPlace {
    /// A text, a comment or a number.
    Nothing,
    /// The beginning of a declaration, or of a part of the head of a policy.
    Declaration,
    Robot,
    Type,
    Failure,
    /// The beginning of a step.
    Step,
    /// The value of a `let`.
    Bound,
    /// A reaction of a monitor.
    Reaction,
    /// A condition or a value.
    Condition,
    Argument(ArgumentPlace),
}

/// Argument of a call that is being written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct ArgumentPlace {
    pub(crate) callee: SmolStr,
    /// Name of the parameter, if it is written.
    pub(crate) label: Option<SmolStr>,
    /// Number of the argument, from 0.
    pub(crate) index: usize,
    /// The other arguments as they are written, with their labels.
    pub(crate) others: Vec<(Option<SmolStr>, SmolStr)>,
}

/// Finds the context of an offset. O(bytes).
pub(crate) fn context(text: &str, offset: usize) -> WritingContext {
    let all: Vec<Token<'_>> = tokens(text, 0).collect();
    let is_word = |token: &Token<'_>| matches!(token.kind, TokenKind::Word | TokenKind::Quoted);
    let here = all.iter().find(|token| token.start < offset && offset <= token.end());
    let inside = here.filter(|token| {
        offset < token.end() || matches!(token.kind, TokenKind::Comment | TokenKind::Doc | TokenKind::Open)
    });
    let is_silent = |token: &&Token<'_>| {
        matches!(
            token.kind,
            TokenKind::Text | TokenKind::Comment | TokenKind::Doc | TokenKind::Number | TokenKind::Open
        )
    };
    let number = here.filter(|token| token.kind == TokenKind::Number);
    let word =
        here.filter(|token| is_word(token)).map_or((offset, offset), |token| (token.start, token.end()));
    if inside.filter(is_silent).or(number).is_some() {
        return WritingContext { word, place: WritingPlace::Nothing, step: None };
    }
    let is_code = |token: &&Token<'_>| !matches!(token.kind, TokenKind::Comment | TokenKind::Doc);
    let before: Vec<Token<'_>> =
        all.iter().filter(is_code).take_while(|token| token.end() <= word.0).copied().collect();
    let opened = brackets(&before);
    let item = item_start(&before);
    let head = before.get(item).map_or("", |token| token.text);
    let is_in_block = head == "policy" && opened.iter().any(|index| is(&before, *index, "{"));
    let place =
        if is_in_block { in_block(text, &before, &opened, word) } else { in_head(&before, &opened, item) };
    let step = is_in_block.then(|| step_range(text, &before, &opened, word));
    WritingContext { word, place, step }
}

fn is(tokens: &[Token<'_>], index: usize, text: &str) -> bool {
    tokens.get(index).is_some_and(|token| token.text == text)
}

/// Indices of the brackets that are open behind the tokens.
fn brackets(tokens: &[Token<'_>]) -> Vec<usize> {
    let mut opened: Vec<usize> = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        match token.text {
            "{" | "(" | "[" => opened.push(index),
            "}" | ")" | "]" => {
                let wanted = match token.text {
                    "}" => "{",
                    ")" => "(",
                    _ => "[",
                };
                // A parenthesis that is open yet ends with its block.
                if let Some(at) = opened.iter().rposition(|open| is(tokens, *open, wanted)) {
                    opened.truncate(at);
                }
            }
            _ => {}
        }
    }
    opened
}

/// Index of the first token of the last declaration.
fn item_start(tokens: &[Token<'_>]) -> usize {
    let (mut depth, mut start) = (0_usize, 0);
    for (index, token) in tokens.iter().enumerate() {
        match token.text {
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth = depth.saturating_sub(1),
            text if depth == 0 && DECLARATIONS.contains(&text) => start = index,
            _ => {}
        }
    }
    start
}

fn in_head(before: &[Token<'_>], opened: &[usize], item: usize) -> WritingPlace {
    let Some(last) = before.last() else { return WritingPlace::Declaration };
    let head = before.get(item).map_or("", |token| token.text);
    let is_closed = opened.is_empty();
    match last.text {
        ":" | "->" | "<" => WritingPlace::Type,
        "for" if head == "policy" => WritingPlace::Robot,
        "achieves" | "and" | "or" | "not" | "needs" | "makes" | "unsettles" | "when" | "initially" | ">=" => {
            WritingPlace::Condition
        }
        "of" if head == "policy" => WritingPlace::Condition,
        "fails" => WritingPlace::Failure,
        "(" | "," if !is_closed => {
            let callee = opened.last().and_then(|open| open.checked_sub(1)).and_then(|at| before.get(at));
            let is_params = opened.last().is_some_and(|open| *open == item + 2);
            match callee {
                Some(callee) if !is_params && callee.kind == TokenKind::Word => {
                    argument(before, opened).unwrap_or(WritingPlace::Condition)
                }
                _ => WritingPlace::Nothing,
            }
        }
        _ if is_closed && before.len() > item + 1 => WritingPlace::Declaration,
        _ => WritingPlace::Nothing,
    }
}

fn in_block(text: &str, before: &[Token<'_>], opened: &[usize], word: (usize, usize)) -> WritingPlace {
    let innermost = opened.last().copied();
    if innermost.is_some_and(|open| !is(before, open, "{")) {
        return match argument_with_rest(text, before, opened, word) {
            Some(place) => place,
            None => WritingPlace::Condition,
        };
    }
    let last = before.last();
    let before_last = before.len().checked_sub(2).and_then(|at| before.get(at));
    match last.map_or("", |token| token.text) {
        "catch" => WritingPlace::Failure,
        "," => {
            let mut back = before.iter().rev().skip(1);
            let start =
                back.find(|token| token.text != "," && matches!(token.text, "catch" | "{" | "}" | "keep"));
            match start.map(|token| token.text) {
                Some("catch") => WritingPlace::Failure,
                _ => WritingPlace::Condition,
            }
        }
        "if" | "until" | "when" | "not" | "and" | "or" | "==" | "!=" | "<" | "<=" | ">" | ">=" | "+"
        | "-" | "*" | "/" | "of" | "in" | "replan" | "fail" | "cannot" => WritingPlace::Condition,
        "=" => WritingPlace::Bound,
        "then" => WritingPlace::Reaction,
        // A name of their own, a number or a duration follows.
        "let" | "sequence" | "each" | "as" | "within" | "retry" | "at" | "most" | "repeat" | "." | "for" => {
            WritingPlace::Nothing
        }
        "monitor" | "wait" => WritingPlace::Step,
        _ if before_last.is_some_and(|token| token.text == "each") => WritingPlace::Nothing,
        _ => WritingPlace::Step,
    }
}

/// Argument of the innermost call that is open.
fn argument(before: &[Token<'_>], opened: &[usize]) -> Option<WritingPlace> {
    argument_with_rest("", before, opened, (usize::MAX, usize::MAX))
}

fn argument_with_rest(
    text: &str,
    before: &[Token<'_>],
    opened: &[usize],
    word: (usize, usize),
) -> Option<WritingPlace> {
    let open = opened.iter().rev().copied().find(|open| is(before, *open, "("))?;
    let callee = before.get(open.checked_sub(1)?).filter(|token| token.kind == TokenKind::Word)?;
    let inside = before.get(open + 1..)?;
    let mut parts = split(inside);
    let current = parts.pop().unwrap_or_default();
    let index = parts.len();
    let label = match current.as_slice() {
        [label, colon, ..] if colon.text == ":" => Some(SmolStr::from(label.text)),
        _ => None,
    };
    // Those behind the cursor, up to the bracket that closes the call.
    let rest: Vec<Token<'_>> = text.get(word.1..).map(|_| tokens(text, word.1).collect()).unwrap_or_default();
    let mut depth = 0_i32;
    let rest: Vec<Token<'_>> = rest
        .into_iter()
        .take_while(|token| {
            match token.text {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                _ => {}
            }
            depth >= 0 && !matches!(token.text, "{" | "}")
        })
        .collect();
    let later = split(&rest).into_iter().skip(1);
    let others = parts.into_iter().chain(later).filter(|part| !part.is_empty()).map(|part| {
        let (label, value) = match part.as_slice() {
            [label, colon, value @ ..] if colon.text == ":" => (Some(SmolStr::from(label.text)), value),
            value => (None, value),
        };
        let value: String = value.iter().map(|token| token.text).collect();
        (label, SmolStr::from(value))
    });
    Some(WritingPlace::Argument(ArgumentPlace {
        callee: callee.text.into(),
        label,
        index,
        others: others.collect(),
    }))
}

/// Parts between the commas of one level.
fn split<'t>(tokens: &[Token<'t>]) -> Vec<Vec<Token<'t>>> {
    let mut parts = vec![Vec::new()];
    let mut depth = 0_usize;
    for token in tokens {
        match token.text {
            "(" | "[" => depth += 1,
            ")" | "]" => depth = depth.saturating_sub(1),
            "," if depth == 0 => {
                parts.push(Vec::new());
                continue;
            }
            _ => {}
        }
        if let Some(part) = parts.last_mut() {
            part.push(*token);
        }
    }
    parts
}

/// Range of the step on the line of a word.
fn step_range(text: &str, before: &[Token<'_>], opened: &[usize], word: (usize, usize)) -> (usize, usize) {
    // A call may go over several lines.
    let first_open = opened.iter().rev().take_while(|open| !is(before, **open, "{")).last();
    let anchor = first_open.and_then(|open| before.get(*open)).map_or(word.0, |token| token.start);
    let line = text.get(..anchor).and_then(|before| before.rfind('\n')).map_or(0, |end| end + 1);
    let on_line = before.iter().filter(|token| token.start >= line && token.start < anchor);
    let start =
        on_line.clone().rfind(|token| matches!(token.text, "{" | "}")).map_or(line, |token| token.end());
    let first =
        before.iter().find(|token| token.start >= start).map_or(word.0, |token| token.start.min(word.0));
    let end = text.get(word.1..).and_then(|rest| rest.find('\n')).map_or(text.len(), |at| word.1 + at);
    let rest = text.get(first..end).unwrap_or("");
    let is_alone = !rest.contains(['{', '}']);
    if is_alone { (first, end) } else { (first, first) }
}

#[cfg(test)]
mod tests {
    use super::{WritingPlace, context};

    fn check(text: &str, expected: &str) {
        let offset = text.find('|').unwrap();
        let text = text.replacen('|', "", 1);
        let found = context(&text, offset);
        let place = match &found.place {
            WritingPlace::Argument(argument) => {
                let others = argument.others.iter().map(|(label, value)| match label {
                    Some(label) => format!("{label}: {value}"),
                    None => value.to_string(),
                });
                let others = others.collect::<Vec<_>>().join("; ");
                let label = argument.label.as_deref().unwrap_or("-");
                format!("Argument {} {label} {} [{others}]", argument.callee, argument.index)
            }
            other => format!("{other:?}"),
        };
        let word = text.get(found.word.0..found.word.1).unwrap();
        let step = found.step.map(|(start, end)| text.get(start..end).unwrap());
        let shown = format!("{place} <{word}> {}", step.map_or("-".to_owned(), |step| format!("<{step}>")));
        assert_eq!(shown, expected, "{text}");
    }

    #[test]
    fn context_of_heads() {
        check("|", "Declaration <> -");
        check("pol|", "Declaration <pol> -");
        check("policy p for h|", "Robot <h> -");
        check("policy p for hsr ach| {}", "Declaration <ach> -");
        check("policy p(x: O|) {}", "Type <O> -");
        check("policy p for hsr achieves at(mug_1, u|", "Argument at - 1 [mug_1] <u> -");
        check("entity a: |", "Type <> -");
        check("action a() fails r|", "Failure <r> -");
        check("policy p {} p|", "Declaration <p> -");
    }

    #[test]
    fn context_of_steps() {
        check("policy p {\n  g|\n}", "Step <g> <g>");
        check("policy p {\n  go(a)\n  |\n}", "Step <> <>");
        check("policy p { go(a) | }", "Step <> <>");
        check("policy p {\n  go(k|)\n}", "Argument go - 0 [] <k> <go(k)>");
        check(
            "policy p {\n  let x = pick(a, approach: t|, b) within 3 s\n}",
            "Argument pick approach 1 [a; b] <t> <let x = pick(a, approach: t, b) within 3 s>",
        );
        check("policy p {\n  if holding(|) {\n  }\n}", "Argument holding - 0 [] <> <>");
        check("policy p {\n  if not h| {\n  }\n}", "Condition <h> <>");
        check("policy p {\n  try {\n  } catch a, b| {\n  }\n}", "Failure <b> <>");
        check("policy p {\n  let x = d|\n}", "Bound <d> <let x = d>");
        check("policy p {\n  let x|\n}", "Nothing <x> <let x>");
        check("policy p {\n  say(\"a|\")\n}", "Nothing <> -");
        check("policy p {\n  // a|\n}", "Nothing <> -");
        check("policy p {\n  monitor when a then p|\n}", "Reaction <p> <monitor when a then p>");
        check("policy p {\n  go(a) within 3|\n}", "Nothing <> -");
        check("policy p {\n  go(\n    a|\n  )\n}", "Argument go - 0 [] <a> <go(\n    a>");
    }
}
