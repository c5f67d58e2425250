//! Leaves and nodes that are ticked in one instant, as conditions.

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Call, CompareOp, Expr, ExprKind, Name};
use roxmltree::Node;

use super::document::{elements, kind};
use super::value::expr;
use super::{Context, MAX_DEPTH, Reader};
use crate::leaves::{PortType, Ports};
use crate::names::{COUNT, FIELD, FLUENT, IS, MEASURE, NUMBER, OF, THAN, VALUE};

impl<'a, 't> Reader<'_, 'a, 't> {
    /// Checks if a node is a condition or made of conditions, with at least one leaf of the library.
    pub(super) fn is_condition(&self, node: Node<'a, 't>) -> bool {
        let leaves = node.descendants().filter(Node::is_element);
        self.is_test(node) && leaves.into_iter().any(|leaf| self.is_leaf(leaf))
    }

    /// Checks if a node is ticked in one instant and calls nothing: the same, or a constant.
    pub(super) fn is_test(&self, node: Node<'a, 't>) -> bool {
        let children = elements(node);
        match kind(node) {
            "AlwaysSuccess" | "AlwaysFailure" => true,
            "Sequence" | "Fallback" | "AsyncSequence" | "AsyncFallback" => {
                let is_named = node.attribute("name").is_some();
                !is_named && !children.is_empty() && children.into_iter().all(|child| self.is_test(child))
            }
            "Inverter" => matches!(children.as_slice(), [only] if self.is_test(*only)),
            _ => self.is_leaf(node),
        }
    }

    /// Checks if a node is a condition of the library.
    fn is_leaf(&self, node: Node<'a, 't>) -> bool {
        let id = kind(node);
        let fluent = id.strip_prefix(FLUENT).is_some_and(|name| self.leaves.fluent(name).is_some());
        let measure = id.strip_prefix(MEASURE).is_some_and(|name| self.leaves.measure(name).is_some());
        ([FIELD, COUNT, VALUE, NUMBER].contains(&id) || fluent || measure) && self.leaves.action(id).is_none()
    }

    /// The condition that a node tests. What is unknown is neither it nor its negation.
    pub(super) fn condition(&mut self, node: Node<'a, 't>, context: &Context) -> Option<Expr> {
        let span = self.places.tag(node);
        if context.depth > MAX_DEPTH {
            self.refuse(span, format!("nodes are nested more than {MAX_DEPTH} deep"), None);
            return None;
        }
        let inner = context.inner();
        match kind(node) {
            "AlwaysSuccess" => Some(expr(ExprKind::Bool(true), span)),
            "AlwaysFailure" => Some(expr(ExprKind::Bool(false), span)),
            "Inverter" => {
                self.ports(node, &[]);
                let only = self.only(node)?;
                Some(negated(self.condition(only, &inner)?))
            }
            tag @ ("Sequence" | "Fallback" | "AsyncSequence" | "AsyncFallback") => {
                self.ports(node, &[]);
                let parts = elements(node).into_iter().map(|part| self.condition(part, &inner));
                let parts: Vec<Expr> = parts.collect::<Option<_>>()?;
                let kind = if tag.ends_with("Sequence") { ExprKind::All } else { ExprKind::AnyOf };
                Some(expr(kind(parts), span))
            }
            id => self.leaf_condition(id, node, span, context),
        }
    }

    fn leaf_condition(
        &mut self,
        id: &str,
        node: Node<'a, 't>,
        span: Span,
        context: &Context,
    ) -> Option<Expr> {
        let leaves = self.leaves;
        if let Some((name, ports)) =
            id.strip_prefix(FLUENT).and_then(|name| Some((name, leaves.fluent(name)?)))
        {
            let call = self.test(name, node, ports, &[IS], context)?;
            let is = self.places.attribute(node, IS);
            return match is {
                None | Some(("true", _)) => Some(call),
                Some(("false", _)) => Some(negated(call)),
                Some((other, at)) => {
                    self.wrong(at, format!("`{other}` is neither `true` nor `false`"), None);
                    None
                }
            };
        }
        let (left, ty) = match id {
            FIELD => {
                self.ports(node, &["field", OF, IS, THAN]);
                let (field, at) = self.required(node, "field")?;
                let of = self.given(node, OF, &PortType::Name, context)?;
                let Some(ty) = leaves.field(field) else {
                    self.wrong(at, format!("there is no field `{field}`"), None);
                    return None;
                };
                let name = Name { text: field.into(), span: at };
                (expr(ExprKind::Field(Box::new(of), name), span), ty.clone())
            }
            COUNT => {
                self.ports(node, &[OF, IS, THAN]);
                let of = self.given(node, OF, &PortType::List(Box::new(PortType::Name)), context)?;
                (call("count", vec![of], span), PortType::Number)
            }
            VALUE | NUMBER => {
                self.ports(node, &[OF, IS, THAN]);
                let ty = if id == VALUE { PortType::Name } else { PortType::Number };
                (self.given(node, OF, &ty, context)?, ty)
            }
            _ => {
                let name = id.strip_prefix(MEASURE).unwrap_or(id);
                let (ports, ty) = leaves.measure(name)?;
                (self.test(name, node, ports, &[IS, THAN], context)?, ty.clone())
            }
        };
        let (is, at) = self.required(node, IS)?;
        let Some(op) = comparison(is) else {
            let help = "the comparisons are `equal`, `unequal`, `less`, `at_most`, `more` and `at_least`";
            self.wrong(at, format!("`{is}` is no comparison"), Some(help.to_owned()));
            return None;
        };
        let right = self.given(node, THAN, &ty, context)?;
        Some(expr(ExprKind::Compare(op, Box::new(left), Box::new(right)), span))
    }

    /// A fluent or a measure with the arguments of its ports.
    fn test(
        &mut self,
        name: &str,
        node: Node<'a, 't>,
        ports: &Ports,
        more: &[&str],
        context: &Context,
    ) -> Option<Expr> {
        let known: Vec<&str> =
            ports.iter().map(|(port, _)| port.as_str()).chain(more.iter().copied()).collect();
        self.ports(node, &known);
        let args = ports.iter().map(|(port, ty)| self.given(node, port, ty, context));
        let args: Vec<Option<Expr>> = args.collect();
        let args = args.into_iter().collect::<Option<Vec<Expr>>>()?;
        Some(call(name, args, self.places.tag(node)))
    }

    /// Value of a port that has to be there.
    pub(super) fn given(
        &mut self,
        node: Node<'a, 't>,
        port: &str,
        ty: &PortType,
        context: &Context,
    ) -> Option<Expr> {
        let given = self.required(node, port)?;
        self.value(port, given, ty, &context.scope)
    }

    pub(super) fn required(&mut self, node: Node<'a, 't>, port: &str) -> Option<(&'a str, Span)> {
        let given = self.places.attribute(node, port);
        if given.is_none() {
            let what = format!("`{}` has no value for its port `{port}`", kind(node));
            self.wrong(self.places.tag(node), what, None);
        }
        given
    }
}

fn call(name: &str, args: Vec<Expr>, span: Span) -> Expr {
    let args = args.into_iter().map(|value| Arg { name: None, span: value.span, value }).collect();
    expr(ExprKind::Call(Call { name: Name { text: name.into(), span }, args, span }), span)
}

/// Conjunction of conditions; none of none.
pub(super) fn all(mut parts: Vec<Expr>, span: Span) -> Option<Expr> {
    match parts.len() {
        0 => None,
        1 => parts.pop(),
        _ => Some(expr(ExprKind::All(parts), span)),
    }
}

/// Negation with the `not` at the leaves.
pub(super) fn negated(condition: Expr) -> Expr {
    let span = condition.span;
    let all = |parts: Vec<Expr>| parts.into_iter().map(negated).collect();
    match condition.kind {
        ExprKind::Not(inner) => *inner,
        ExprKind::Bool(value) => expr(ExprKind::Bool(!value), span),
        ExprKind::All(parts) => expr(ExprKind::AnyOf(all(parts)), span),
        ExprKind::AnyOf(parts) => expr(ExprKind::All(all(parts)), span),
        ExprKind::Compare(op, left, right) => expr(ExprKind::Compare(inverse(op), left, right), span),
        kind => expr(ExprKind::Not(Box::new(expr(kind, span))), span),
    }
}

fn inverse(op: CompareOp) -> CompareOp {
    match op {
        CompareOp::Equal => CompareOp::Unequal,
        CompareOp::Unequal => CompareOp::Equal,
        CompareOp::Less => CompareOp::AtLeast,
        CompareOp::AtMost => CompareOp::More,
        CompareOp::More => CompareOp::AtMost,
        CompareOp::AtLeast => CompareOp::Less,
    }
}

fn comparison(word: &str) -> Option<CompareOp> {
    let all = [
        CompareOp::Equal,
        CompareOp::Unequal,
        CompareOp::Less,
        CompareOp::AtMost,
        CompareOp::More,
        CompareOp::AtLeast,
    ];
    all.into_iter().find(|op| op.key() == word)
}
