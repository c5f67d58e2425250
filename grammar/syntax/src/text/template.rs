//! Texts with values: `I see {count(cans)} cans`. Both front ends read them here. A brace itself is written
//! twice.

use pest::Parser as _;
use smol_str::SmolStr;

use super::builder::Builder;
use super::{MotetParser, Origin, Rule, lexer, syntax_error};
use crate::ast::{Expr, ExprKind, TextPart};
use crate::diagnostic::Diagnostic;
use crate::diagnostics::BadTextValue;
use crate::source::{FileId, Span};

/// The most values of one text.
pub const MAX_TEXT_VALUES: usize = 64;

/// A text as it was read.
pub(crate) struct ReadText {
    /// The text without values, a template, or a text that was reported.
    pub(crate) kind: ExprKind,
    /// Levels of its tree.
    pub(crate) height: usize,
    pub(crate) found: Vec<Diagnostic>,
}

/// Reads a text whose escapes are resolved. `origin` is the place of its first character, `span` that of the
/// whole text. Linear.
pub(crate) fn read(text: SmolStr, origin: Origin, span: Span) -> ReadText {
    let mut scanner =
        TextScanner { origin, span, parts: Vec::new(), literal: String::new(), height: 1, found: Vec::new() };
    if !text.contains(['{', '}']) {
        return ReadText { kind: ExprKind::Text(text), height: 1, found: scanner.found };
    }
    scanner.scan(&text);
    let TextScanner { parts, found, height, .. } = scanner;
    let kind = match parts.as_slice() {
        _ if !found.is_empty() => ExprKind::Wrong(text),
        [] => ExprKind::Text(SmolStr::default()),
        [TextPart::Literal(only)] => ExprKind::Text(only.clone()),
        _ => ExprKind::Template(parts),
    };
    ReadText { kind, height, found }
}

/// A scan over one text.
struct TextScanner {
    origin: Origin,
    span: Span,
    parts: Vec<TextPart>,
    /// Characters since the last value.
    literal: String,
    height: usize,
    found: Vec<Diagnostic>,
}

impl TextScanner {
    fn scan(&mut self, text: &str) {
        let (mut rest, mut at) = (text, 0);
        while let Some((before, from)) = rest.find(['{', '}']).and_then(|brace| rest.split_at_checked(brace))
        {
            self.literal.push_str(before);
            at += before.len();
            let taken = self.brace(from, at);
            at += taken;
            rest = from.get(taken..).unwrap_or("");
        }
        self.literal.push_str(rest);
        self.flush();
    }

    /// Reads what begins with a brace, and returns its length.
    fn brace(&mut self, from: &str, at: usize) -> usize {
        for (twice, once) in [("{{", '{'), ("}}", '}')] {
            if from.starts_with(twice) {
                self.literal.push(once);
                return twice.len();
            }
        }
        let Some(inner) = from.strip_prefix('{') else {
            self.refuse("}", at, "no `{` is open");
            return 1;
        };
        let Some((inner, _)) = length(inner).and_then(|length| inner.split_at_checked(length)) else {
            self.refuse("{", at, "no `}` closes it");
            return 1;
        };
        let whole = inner.len() + 2;
        let written = from.get(..whole).unwrap_or(from);
        if self.parts.iter().filter(|part| matches!(part, TextPart::Value(_))).count() >= MAX_TEXT_VALUES {
            if self.found.is_empty() {
                self.refuse(written, at, &format!("a text has at most {MAX_TEXT_VALUES} values"));
            }
            return whole;
        }
        match self.value(inner, at + 1) {
            Ok(value) => {
                self.flush();
                self.parts.push(TextPart::Value(value));
            }
            Err(reason) => self.refuse(written, at, &reason),
        }
        whole
    }

    /// Parses what stands in braces.
    fn value(&mut self, text: &str, at: usize) -> Result<Expr, String> {
        if text.trim().is_empty() {
            return Err("nothing stands in the braces".into());
        }
        let file = FileId::default();
        lexer::check(text, file).map_err(|fault| fault.diagnostic.message)?;
        let mut pairs = MotetParser::parse(Rule::lone_expr, text)
            .map_err(|error| syntax_error::refusal(text, &error, file).diagnostic.message)?;
        let mut builder = Builder::new(file);
        builder.origin = self.origin.moved_by(at);
        let inner = pairs.next().and_then(|pair| pair.into_inner().next());
        let (expr, height) =
            inner.map(|pair| builder.measured(pair)).ok_or("nothing stands in the braces")?;
        if let Some(mistake) = builder.found.into_iter().next() {
            return Err(mistake.message);
        }
        self.height = self.height.max(height + 1);
        match expr.kind {
            ExprKind::Name(_)
            | ExprKind::Binding(_)
            | ExprKind::Call(_)
            | ExprKind::Field(..)
            | ExprKind::Arith(..) => Ok(expr),
            ExprKind::Not(_) | ExprKind::All(_) | ExprKind::AnyOf(_) | ExprKind::Compare(..) => {
                Err("a condition has no value".into())
            }
            _ => Err("a literal needs no braces".into()),
        }
    }

    fn flush(&mut self) {
        if !self.literal.is_empty() {
            self.parts.push(TextPart::Literal(std::mem::take(&mut self.literal).into()));
        }
    }

    fn refuse(&mut self, written: &str, at: usize, reason: &str) {
        let span = self.origin.place(at, at + written.len());
        let fix = match self.origin {
            Origin::At(..) => Some(written.replace('{', "{{").replace('}', "}}")),
            Origin::Within(_) => None,
        };
        let (written, reason) = (SmolStr::new(written), reason.to_owned());
        let span = if fix.is_some() { span } else { self.span };
        self.found.push(BadTextValue { span, written, reason, fix }.into());
    }
}

/// Length of what stands between braces; `None` if another brace or a quote comes first. A name in
/// back-quotes may hold either.
fn length(inner: &str) -> Option<usize> {
    let mut is_quoted = false;
    for (at, character) in inner.char_indices() {
        match character {
            '`' => is_quoted = !is_quoted,
            '}' if !is_quoted => return Some(at),
            '{' | '"' if !is_quoted => return None,
            _ => {}
        }
    }
    None
}
