//! Nodes of syntax trees without spans, as the builder of steps makes them.

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Call, End, EndKind, Expr, ExprKind, Name, POSE, Step, StepKind};
use smol_str::SmolStr;

/// A text as it stands between quotes; what it cannot mean is never written.
pub(super) fn written(text: SmolStr) -> ExprKind {
    match motet_syntax::text::parse_text(&text).map(|read| read.kind) {
        Ok(ExprKind::Text(text)) => ExprKind::Plain(text),
        Ok(template) => template,
        Err(_) => ExprKind::Plain(text),
    }
}

pub(super) fn argument(name: &SmolStr, value: Expr) -> Arg {
    Arg { name: Some(named(name.clone())), value, span: Span::default() }
}

pub(super) fn named(text: SmolStr) -> Name {
    Name { text, span: Span::default() }
}

pub(super) fn step(kind: StepKind) -> Step {
    Step { kind, span: Span::default() }
}

pub(super) fn number(value: f64) -> Expr {
    expr(ExprKind::Number(value))
}

/// A term of the language on a list.
pub(super) fn of_list(term: &'static str, list: Expr) -> Call {
    let name = named(SmolStr::new_static(term));
    Call { name, args: vec![argument(&SmolStr::new_static("of"), list)], span: Span::default() }
}

/// A pose by its numbers.
pub(super) fn pose(numbers: [Expr; 4]) -> Call {
    let args = numbers.map(|value| Arg { name: None, value, span: Span::default() });
    Call { name: named(SmolStr::new_static(POSE)), args: args.into(), span: Span::default() }
}

pub(super) fn expr(kind: ExprKind) -> Expr {
    Expr { kind, span: Span::default() }
}

pub(super) fn end(kind: EndKind) -> End {
    let why = (kind != EndKind::Done).then(|| expr(ExprKind::Text(SmolStr::new_static("?"))));
    End { kind, result: None, why, span: Span::default() }
}

pub(super) fn fail() -> Step {
    Step { kind: StepKind::End(end(EndKind::Fail)), span: Span::default() }
}
