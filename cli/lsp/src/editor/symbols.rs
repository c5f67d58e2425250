//! Outline of a document: its declarations, and the named parts of policies.

use motet_syntax::ast::{Block, Item, Name, Policy, Step, StepKind};
use motet_syntax::{Parsed, Span};

use super::declarations::DeclarationKind;
use super::names::blocks;

/// Kind of an entry of the outline.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum SymbolKind {
    Declaration(DeclarationKind),
    /// A named sequence.
    Group,
    Binding,
    Field,
}

/// Entry of the outline.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Symbol {
    pub(crate) name: String,
    pub(crate) kind: SymbolKind,
    pub(crate) detail: Option<String>,
    pub(crate) whole: Span,
    pub(crate) span: Span,
    pub(crate) children: Vec<Symbol>,
}

/// Outline of a document, in its order.
pub(crate) fn symbols(parsed: &Parsed) -> Vec<Symbol> {
    parsed.file.items.iter().flat_map(of_item).collect()
}

fn of_item(item: &Item) -> Vec<Symbol> {
    let whole = item.span();
    let declared = |kind, name: &Name, children| Symbol {
        name: name.text.to_string(),
        kind: SymbolKind::Declaration(kind),
        detail: None,
        whole: whole.to(name.span),
        span: name.span,
        children,
    };
    let child = |kind, name: &Name| leaf(kind, name, name.span);
    match item {
        Item::Kind(decl) => {
            let fields = decl.fields.iter().map(|field| child(SymbolKind::Field, &field.name)).collect();
            vec![declared(DeclarationKind::Kind, &decl.name, fields)]
        }
        Item::Fluent(decl) => vec![declared(DeclarationKind::Fluent, &decl.name, Vec::new())],
        Item::Measure(decl) => vec![declared(DeclarationKind::Measure, &decl.name, Vec::new())],
        Item::Failure(decl) => vec![declared(DeclarationKind::Failure, &decl.name, Vec::new())],
        Item::Enum(decl) => {
            let case = SymbolKind::Declaration(DeclarationKind::Case);
            let cases = decl.cases.iter().map(|name| child(case, name)).collect();
            vec![declared(DeclarationKind::Enum, &decl.name, cases)]
        }
        Item::Primitive(decl) => {
            let kind = match decl.kind {
                motet_syntax::ast::PrimitiveKind::Action => DeclarationKind::Action,
                motet_syntax::ast::PrimitiveKind::Perception => DeclarationKind::Perception,
            };
            vec![declared(kind, &decl.name, Vec::new())]
        }
        Item::Policy(policy) => {
            let robot = policy.robot.as_ref().map(|robot| format!("for {}", robot.text));
            let symbol = declared(DeclarationKind::Policy, &policy.name, of_policy(policy));
            vec![Symbol { detail: robot, ..symbol }]
        }
        Item::Entities(decl) => {
            let names = decl.names.iter();
            names
                .map(|name| leaf(SymbolKind::Declaration(DeclarationKind::Entity), name, name.span))
                .collect()
        }
        Item::Initially(_) | Item::ClosedWorld(_) => Vec::new(),
    }
}

fn of_policy(policy: &Policy) -> Vec<Symbol> {
    let mut found = of_block(&policy.body);
    found.extend(policy.cleanup.iter().flat_map(of_block));
    found
}

fn of_block(block: &Block) -> Vec<Symbol> {
    block.steps.iter().flat_map(of_step).collect()
}

fn of_step(step: &Step) -> Vec<Symbol> {
    if let StepKind::Finally { step, cleanup } = &step.kind {
        return of_step(step).into_iter().chain(of_block(cleanup)).collect();
    }
    let mut inner: Vec<Symbol> = blocks(step).into_iter().flat_map(of_block).collect();
    let mut found = Vec::new();
    match &step.kind {
        StepKind::Sequence { name, .. } => {
            let children = std::mem::take(&mut inner);
            found.push(Symbol { children, ..leaf(SymbolKind::Group, name, step.span) });
        }
        StepKind::Do(step) => {
            found.extend(step.bind.iter().map(|name| leaf(SymbolKind::Binding, name, name.span)));
        }
        StepKind::Let { name, .. } => found.push(leaf(SymbolKind::Binding, name, step.span)),
        _ => {}
    }
    found.append(&mut inner);
    found
}

fn leaf(kind: SymbolKind, name: &Name, whole: Span) -> Symbol {
    Symbol {
        name: name.text.to_string(),
        kind,
        detail: None,
        whole: whole.to(name.span),
        span: name.span,
        children: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use motet_syntax::{FileId, Source};

    use super::{Symbol, symbols};

    fn shown(symbols: &[Symbol]) -> String {
        let parts = symbols.iter().map(|symbol| match symbol.children.is_empty() {
            true => symbol.name.clone(),
            false => format!("{}({})", symbol.name, shown(&symbol.children)),
        });
        parts.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn symbols_are_nested() {
        let text = "enum Way { left, right } kind Cup: Object { width: Length } entity a, b: Object \
            policy p { let x = detect(\"mug\") sequence tidy { let y = 3 go(a) } finally { let z = 1 } }";
        let parsed = motet_syntax::read(&Source::new("", text), FileId(0));
        assert_eq!(shown(&symbols(&parsed)), "Way(left right) Cup(width) a b p(x tidy(y) z)");
        for symbol in symbols(&parsed) {
            assert!(symbol.whole.contains(symbol.span), "{}", symbol.name);
        }
    }
}
