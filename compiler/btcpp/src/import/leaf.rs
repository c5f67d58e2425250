//! Registered actions, and the values of ports.

use motet_graph::Pose;
use motet_syntax::ast::{Arg, Call, Do, Expr, ExprKind, Manner, Name, POSE, Step, StepKind};
use motet_syntax::unit::Unit;
use motet_syntax::{Span, suggest};
use roxmltree::Node;

use super::{Context, Importer, id};
use crate::names::{ACCELERATION, FAILURE, SPEED};
use crate::vocabulary::{NodeSignature, PortType};

impl<'a, 't> Importer<'_, 'a, 't> {
    pub(super) fn call(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let name = id(node);
        let vocabulary = self.vocabulary;
        let Some(signature) = vocabulary.actions.get(name) else {
            let known = vocabulary.actions.keys().chain(vocabulary.fluents.keys()).map(|name| name.as_str());
            let near = suggest::closest(name, known).map(|near| format!("; did you mean `{near}`?"));
            self.refuse(node, format!("the robot has no such action or fact{}", near.unwrap_or_default()));
            return None;
        };
        let mut args = Vec::new();
        for (param, ty) in &signature.params {
            let Some((text, span)) = self.spans.attribute(node, param) else { continue };
            let value = self.value(text, span, ty);
            args.push(Arg { name: Some(Name { text: param.clone(), span }), value, span });
        }
        let bind = self.output(node, signature);
        let manner = self.manner(node);
        let call = Call {
            name: Name { text: name.into(), span: self.spans.tag(node) },
            args,
            span: self.span(node),
        };
        self.made(node, context, StepKind::Do(Do { call, bind, manner, within: None, retry: None }))
    }

    /// Name for the result: the entry of the port `result`, or of the one port that is no parameter.
    fn output(&mut self, node: Node<'a, 't>, signature: &NodeSignature) -> Option<Name> {
        let mut bind = None;
        for attribute in node.attributes().filter(|attribute| is_port(attribute.name())) {
            let key = attribute.name();
            if signature.params.iter().any(|(param, _)| param == key)
                || [SPEED, ACCELERATION, FAILURE].contains(&key)
            {
                continue;
            }
            let entry =
                entry(attribute.value(), key).filter(|_| signature.result.is_some() && bind.is_none());
            match entry {
                Some(text) => {
                    let span = self.spans.attribute(node, key).map_or_else(Span::default, |(_, span)| span);
                    bind = Some(Name { text: text.into(), span });
                }
                None => self.refuse(node, format!("`{key}` is neither a parameter nor the port of a result")),
            }
        }
        bind
    }

    /// Refuses ports of a condition that are no parameters.
    pub(super) fn surplus(&mut self, node: Node<'a, 't>, signature: &NodeSignature, added: &[&str]) {
        let is_known =
            |key: &str| signature.params.iter().any(|(param, _)| param == key) || added.contains(&key);
        let keys: Vec<_> = node.attributes().map(|attribute| attribute.name()).collect();
        for key in keys.into_iter().filter(|key| is_port(key) && !is_known(key)) {
            self.refuse(node, format!("`{key}` is not one of its parameters"));
        }
    }

    fn manner(&mut self, node: Node<'a, 't>) -> Option<Manner> {
        let (speed, span) = self.spans.attribute(node, SPEED)?;
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let acceleration = node.attribute(ACCELERATION).and_then(number);
        match number(speed).zip(acceleration) {
            Some((speed, acceleration)) if speed == acceleration => {
                let ratio = Expr { kind: ExprKind::Quantity(speed * 100.0, Unit::Percent), span };
                Some(Manner::At(ratio, span))
            }
            Some((0.3, 0.25)) => Some(Manner::Gently(span)),
            Some(_) | None => {
                self.refuse(node, "a manner has one part of speed and acceleration, such as 0.5 and 0.5");
                None
            }
        }
    }

    pub(super) fn assignment(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let (text, span) = self.spans.required(node, "value", &mut self.found)?;
        let (key, at) = self.spans.required(node, "output_key", &mut self.found)?;
        let name = Name { text: entry(key, key).unwrap_or(key).into(), span: at };
        let kind = match (entry(text, key), text.trim().parse::<f64>()) {
            (Some(name), _) => ExprKind::Binding(name.into()),
            (None, Ok(number)) if number.is_finite() => ExprKind::Number(number),
            (None, _) if self.vocabulary.entities.contains(text) => ExprKind::Name(text.into()),
            (None, _) => ExprKind::Text(text.into()),
        };
        self.made(node, context, StepKind::Let { name, value: Expr { kind, span } })
    }

    /// Value of a port of a type.
    pub(super) fn value(&mut self, text: &'a str, span: Span, ty: &PortType) -> Expr {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        let kind = match (entry(text, ""), ty) {
            (Some(name), _) if !name.is_empty() => ExprKind::Binding(name.into()),
            (_, PortType::Bool) => match text.trim() {
                "true" | "1" => ExprKind::Bool(true),
                "false" | "0" => ExprKind::Bool(false),
                _ => ExprKind::Plain(text.into()),
            },
            (_, PortType::Number) => {
                number(text).map_or_else(|| ExprKind::Plain(text.into()), ExprKind::Number)
            }
            (_, PortType::Pose) => {
                pose(text, span).map_or_else(|| ExprKind::Plain(text.into()), ExprKind::Call)
            }
            (_, PortType::Text) => ExprKind::Plain(text.into()),
            (_, PortType::List(inner)) => {
                let items = text.split(';').filter(|item| !item.is_empty());
                ExprKind::List(items.map(|item| self.value(item, span, inner)).collect())
            }
        };
        Expr { kind, span }
    }
}

/// Checks if an attribute is a port.
fn is_port(key: &str) -> bool {
    !key.starts_with('_') && !matches!(key, "name" | "ID")
}

/// Entry of the blackboard that a port names: `{mug}`, or `{=}` for the one of its own name.
fn entry<'a>(text: &'a str, key: &'a str) -> Option<&'a str> {
    let name = text.trim().strip_prefix('{')?.strip_suffix('}')?.trim();
    Some(if name == "=" { key } else { name })
}

/// A pose without a tilt: `x;y;z;qx;qy;qz;qw`.
fn pose(text: &str, span: Span) -> Option<Call> {
    let numbers: Option<Vec<f64>> = text.split(';').map(|part| part.trim().parse().ok()).collect();
    let [x, y, z, qx, qy, qz, qw] = <[f64; 7]>::try_from(numbers?).ok()?;
    if qx != 0.0 || qy != 0.0 {
        return None;
    }
    let pose = Pose { xyz: [x, y, z], quaternion: [qx, qy, qz, qw] };
    let yaw = pose.yaw();
    let arg = |number, unit| {
        let value = Expr { kind: ExprKind::Quantity(number, unit), span };
        Arg { name: None, value, span }
    };
    let args = [arg(x, Unit::Metre), arg(y, Unit::Metre), arg(z, Unit::Metre), arg(yaw, Unit::Radian)];
    Some(Call { name: Name { text: POSE.into(), span }, args: args.into(), span })
}
