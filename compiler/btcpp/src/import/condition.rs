//! Nodes that are conditions: registered conditions, and what joins them.

use motet_syntax::ast::{Arg, Call, CompareOp, Expr, ExprKind, Name};
use roxmltree::Node;

use super::{Importer, elements, id};
use crate::names::{IS, THAN};
use crate::vocabulary::{IsMeasure, NodeSignature};

impl<'a, 't> Importer<'_, 'a, 't> {
    /// Checks if a node is a condition: a fluent or a measure that is no action too, or several of them
    /// joined.
    pub(super) fn is_condition(&self, node: Node<'_, '_>) -> bool {
        let mut children = elements(node);
        match id(node) {
            "Inverter" => children.next().is_some_and(|child| self.is_condition(child)),
            "Sequence" | "Fallback" => {
                node.attribute("name").is_none()
                    && children.next().is_some()
                    && elements(node).all(|child| self.is_condition(child))
            }
            name => self.vocabulary.condition_of(name).is_some(),
        }
    }

    /// Checks if a node is a guard that the compiler finds by the contract of an action.
    pub(super) fn is_need(&self, node: Node<'_, '_>) -> bool {
        let action = id(node).strip_prefix("can_");
        action.is_some_and(|action| self.vocabulary.actions.contains_key(action)) || self.is_condition(node)
    }

    pub(super) fn condition(&mut self, node: Node<'a, 't>) -> Option<Expr> {
        let span = self.span(node);
        let kind = match id(node) {
            "AlwaysSuccess" => ExprKind::Bool(true),
            "AlwaysFailure" => ExprKind::Bool(false),
            "Inverter" => {
                let child = self.only_child(node)?;
                ExprKind::Not(Box::new(self.condition(child)?))
            }
            tag @ ("Sequence" | "Fallback") => {
                let parts: Option<Vec<_>> = elements(node).map(|child| self.condition(child)).collect();
                let parts = parts?;
                match tag {
                    "Sequence" => ExprKind::All(parts),
                    _ => ExprKind::AnyOf(parts),
                }
            }
            name => return self.leaf_condition(node, name),
        };
        Some(Expr { kind, span })
    }

    fn leaf_condition(&mut self, node: Node<'a, 't>, name: &'a str) -> Option<Expr> {
        let span = self.span(node);
        let Some((name, signature, is_measure)) = self.vocabulary.condition_of(name) else {
            self.refuse(node, "the robot has no such fact or measure");
            return None;
        };
        let call = Expr { kind: ExprKind::Call(self.applied(node, name, signature)), span };
        let is = node.attribute(IS).map(str::trim);
        if is_measure == IsMeasure(false) {
            return match is {
                None | Some("true" | "1") => Some(call),
                Some("false" | "0") => Some(Expr { kind: ExprKind::Not(Box::new(call)), span }),
                Some(_) => {
                    self.refuse(node, "`is` has to be `true` or `false`");
                    None
                }
            };
        }
        let op = match is {
            Some("equal") => CompareOp::Equal,
            Some("unequal") => CompareOp::Unequal,
            Some("less") => CompareOp::Less,
            Some("at_most") => CompareOp::AtMost,
            Some("more") => CompareOp::More,
            Some("at_least") => CompareOp::AtLeast,
            None | Some(_) => {
                self.refuse(
                    node,
                    "`is` has to be a comparison: less, at_most, equal, unequal, at_least or more",
                );
                return None;
            }
        };
        let (text, than) = self.spans.required(node, THAN, &mut self.found)?;
        let number = signature.result.as_ref().map(|ty| self.value(text, than, ty));
        let right = number.unwrap_or(Expr { kind: ExprKind::Plain(text.into()), span: than });
        // The value has its own place: it is not written in one object with the measure.
        Some(Expr { kind: ExprKind::Compare(op, Box::new(call), Box::new(right)), span })
    }

    /// A fluent or a measure with its arguments.
    fn applied(&mut self, node: Node<'a, 't>, name: &str, signature: &NodeSignature) -> Call {
        let span = self.spans.tag(node);
        let mut args = Vec::new();
        for (param, ty) in &signature.params {
            let Some((text, at)) = self.spans.attribute(node, param) else { continue };
            let value = match text {
                "any" => Expr { kind: ExprKind::Any, span: at },
                _ => self.value(text, at, ty),
            };
            args.push(Arg { name: Some(Name { text: param.clone(), span: at }), value, span: at });
        }
        self.surplus(node, signature, &[IS, THAN]);
        Call { name: Name { text: name.into(), span }, args, span: self.span(node) }
    }
}

/// The condition that holds where this one is known not to.
pub(super) fn negated(condition: Expr) -> Expr {
    let span = condition.span;
    let each = |parts: Vec<Expr>| parts.into_iter().map(negated).collect();
    let kind = match condition.kind {
        ExprKind::Not(inner) => return *inner,
        ExprKind::All(parts) => ExprKind::AnyOf(each(parts)),
        ExprKind::AnyOf(parts) => ExprKind::All(each(parts)),
        ExprKind::Compare(op, left, right) => {
            let op = match op {
                CompareOp::Equal => CompareOp::Unequal,
                CompareOp::Unequal => CompareOp::Equal,
                CompareOp::Less => CompareOp::AtLeast,
                CompareOp::AtMost => CompareOp::More,
                CompareOp::More => CompareOp::AtMost,
                CompareOp::AtLeast => CompareOp::Less,
            };
            ExprKind::Compare(op, left, right)
        }
        kind => ExprKind::Not(Box::new(Expr { kind, span })),
    };
    Expr { kind, span }
}
