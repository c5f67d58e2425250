//! Actions of a library as calls, and trees that are called.

use std::collections::BTreeMap;

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Call, CatchOn, Do, End, EndKind, Expr, ExprKind, Manner, Name, Step, StepKind};
use motet_syntax::suggest::closest;
use motet_syntax::unit::Unit;
use roxmltree::Node;
use smol_str::SmolStr;

use super::document::kind;
use super::scope::{Entry, pointer};
use super::step::{end, step};
use super::value::{expr, seconds};
use super::{Around, Context, NODE_FAILED, Reader};
use crate::leaves::PortType;
use crate::names::{AS, ENDINGS, FAILURE, MANNER};

impl<'a, 't> Reader<'_, 'a, 't> {
    /// Checks that a node has no attributes but these ports and its names.
    pub(super) fn ports(&mut self, node: Node<'a, 't>, known: &[&str]) {
        for attribute in node.attributes() {
            let name = attribute.name();
            let span = self.places.attribute(node, name).map_or_else(|| self.places.tag(node), |(_, at)| at);
            if name.starts_with('_') && !(name == "_autoremap" && known.contains(&name)) {
                let what = format!("`{name}` is a script, which no step has");
                self.refuse(span, what, Some("write it as nodes".to_owned()));
            } else if !known.contains(&name) && !["ID", "name"].contains(&name) {
                let near = closest(name, known.iter().copied());
                let help = near.map(|near| format!("did you mean `{near}`?"));
                self.wrong(span, format!("`{}` has no port `{name}`", kind(node)), help);
            }
        }
    }

    /// Checks if a node is an action of the library.
    pub(super) fn is_action(&self, node: Node<'a, 't>) -> bool {
        self.leaves.action(kind(node)).is_some()
    }

    /// The call of an action.
    pub(super) fn call(&mut self, node: Node<'a, 't>, context: &Context, around: Around) -> Vec<Step> {
        let (leaves, id, span) = (self.leaves, kind(node), self.places.tag(node));
        let Some(action) = leaves.action(id) else { return Vec::new() };
        let mut known: Vec<&str> = action.ports.iter().map(|(port, _)| port.as_str()).collect();
        known.extend([MANNER, FAILURE]);
        known.extend(action.has_result.then_some(AS));
        self.ports(node, &known);
        let mut args = Vec::new();
        for (port, ty) in &action.ports {
            let Some((text, at)) = self.places.attribute(node, port) else { continue };
            if let Some(value) = self.value(port, (text, at), ty, &context.scope) {
                args.push(Arg { name: Some(Name { text: port.clone(), span: at }), value, span: at });
            }
        }
        let bind = self.places.attribute(node, AS).and_then(|result| self.output(AS, result, context));
        let manner = self.places.attribute(node, MANNER).and_then(|given| self.manner(given));
        let call = Call { name: Name { text: id.into(), span }, args, span };
        let Around { within, retry } = around;
        vec![step(StepKind::Do(Do { call, bind, manner, within, retry }), span)]
    }

    /// Name of the binding that a port writes.
    pub(super) fn output(
        &mut self,
        port: &str,
        (text, span): (&'a str, Span),
        context: &Context,
    ) -> Option<Name> {
        match pointer(port, text).map(|name| context.scope.entry(name)) {
            Some(Entry::Binding(text)) => Some(Name { text, span }),
            Some(Entry::Text(_)) | None => {
                self.wrong(span, format!("the port `{port}` writes an entry, and `{text}` is none"), None);
                None
            }
        }
    }

    fn manner(&mut self, (text, span): (&str, Span)) -> Option<Manner> {
        let parts: Vec<f64> = text.split(';').filter_map(|part| part.trim().parse().ok()).collect();
        match parts.as_slice() {
            [speed, acceleration] if speed == acceleration => {
                let percent = expr(ExprKind::Quantity((speed * 1e6).round() / 1e4, Unit::Percent), span);
                Some(Manner::At(percent, span))
            }
            [0.3, 0.25] => Some(Manner::Gently(span)),
            _ => {
                let what = format!(
                    "`{text}` is no manner: the same part of speed and of acceleration, or `0.3;0.25`"
                );
                self.wrong(span, what, None);
                None
            }
        }
    }

    /// An ending, or a step that fails where the failure leads to a fallback.
    pub(super) fn ending(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let (id, span) = (kind(node), self.places.tag(node));
        self.ports(node, &["why"]);
        let why = self.places.attribute(node, "why").filter(|(why, _)| !why.is_empty());
        let why = why.and_then(|why| self.value("why", why, &PortType::Text, &context.scope));
        if context.is_caught {
            let what = format!("`{id}` in a fallback ends the policy, and the fallback goes on");
            self.refuse(span, what, Some("use `AlwaysFailure`".to_owned()));
            return Vec::new();
        }
        let kinds = [EndKind::Fail, EndKind::Cannot, EndKind::Replan];
        let kind =
            ENDINGS.iter().zip(kinds).find(|(name, _)| **name == id).map_or(EndKind::Fail, |(_, kind)| kind);
        vec![end(End { kind, result: None, why, span })]
    }

    /// A step that fails.
    pub(super) fn failing(&mut self, span: Span) -> Vec<Step> {
        self.helps = true;
        let call =
            Call { name: Name { text: SmolStr::new_static(NODE_FAILED), span }, args: Vec::new(), span };
        vec![step(StepKind::Do(Do { call, bind: None, manner: None, within: None, retry: None }), span)]
    }

    /// A tree that is called, as a group of its steps.
    pub(super) fn subtree(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        let id = node.attribute("ID").unwrap_or_default();
        let Some(tree) = self.trees.get(id).copied() else {
            let near = closest(id, self.trees.keys().copied());
            let help = near.map(|near| format!("did you mean `{near}`?"));
            self.wrong(span, format!("there is no tree `{id}`"), help);
            return Vec::new();
        };
        if context.open.iter().any(|open| open == id) {
            self.refuse(span, format!("the tree `{id}` calls itself"), None);
            return Vec::new();
        }
        let mut ports = BTreeMap::new();
        for attribute in node.attributes() {
            let name = attribute.name();
            if ["ID", "name", "_autoremap"].contains(&name) {
                continue;
            }
            if name.starts_with('_') {
                self.ports(node, &[]);
                return Vec::new();
            }
            let entry = match pointer(name, attribute.value()) {
                Some(outer) => context.scope.entry(outer),
                None => Entry::Text(attribute.value().into()),
            };
            ports.insert(SmolStr::new(name), entry);
        }
        let shares = matches!(node.attribute("_autoremap"), Some("true" | "1"));
        let mut inner = context.inner();
        self.calls += 1;
        inner.scope = context.scope.called(id, ports, shares, self.calls);
        inner.open.push(id.into());
        let Some(root) = self.only(tree) else { return Vec::new() };
        let steps = self.node(root, &inner);
        vec![step(
            StepKind::Sequence {
                name: Name { text: id.into(), span },
                body: super::step::block(steps, span),
            },
            span,
        )]
    }

    /// Deadline of a decorator in milliseconds.
    pub(super) fn milliseconds(&mut self, node: Node<'a, 't>, port: &str) -> Option<Expr> {
        let (text, span) = self.required(node, port)?;
        let msec = text.trim().parse::<u32>().ok().filter(|msec| *msec > 0);
        if msec.is_none() {
            self.wrong(span, format!("`{text}` is no number of milliseconds above 0"), None);
        }
        msec.map(|msec| seconds(f64::from(msec), span))
    }

    /// Failures that a test of a failure names.
    pub(super) fn kinds(&mut self, test: Node<'a, 't>) -> Option<CatchOn> {
        self.ports(test, &["of", "kinds"]);
        let (text, span) = self.required(test, "kinds")?;
        let kinds = text.split(';').filter(|kind| !kind.is_empty());
        let kinds: Vec<Name> = kinds.map(|kind| Name { text: kind.into(), span }).collect();
        (!kinds.is_empty()).then_some(CatchOn::Kinds(kinds))
    }
}
