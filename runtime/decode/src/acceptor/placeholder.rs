//! Pieces of abstract syntax without places, and what stands in for those that were not written yet.

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Block, End, EndKind, Expr, ExprKind, Name, Step, StepKind};
use smol_str::SmolStr;

pub(super) fn argument(name: &SmolStr, value: Expr) -> Arg {
    Arg { name: Some(named(name.clone())), value, span: Span::default() }
}

pub(super) fn named(text: SmolStr) -> Name {
    Name { text, span: Span::default() }
}

pub(super) fn expr(kind: ExprKind) -> Expr {
    Expr { kind, span: Span::default() }
}

pub(super) fn end(kind: EndKind) -> End {
    let why = (kind != EndKind::Done).then(|| expr(ExprKind::Text(SmolStr::new_static("?"))));
    End { kind, why, span: Span::default() }
}

pub(super) fn fail() -> Step {
    Step { kind: StepKind::End(end(EndKind::Fail)), span: Span::default() }
}

/// A block that no way leads out of.
pub(super) fn closed(mut steps: Vec<Step>) -> Block {
    steps.push(fail());
    Block { steps, span: Span::default() }
}
