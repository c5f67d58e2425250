//! Texts of ports as values of a type.

use motet_syntax::Span;
use motet_syntax::ast::{Arg, Call, Expr, ExprKind, Name, POSE};
use motet_syntax::unit::{Unit, parse_quantity};
use smol_str::SmolStr;

use super::Reader;
use super::scope::{Entry, Scope, pointer};
use crate::leaves::PortType;

pub(super) fn expr(kind: ExprKind, span: Span) -> Expr {
    Expr { kind, span }
}

pub(super) fn number(value: f64, span: Span) -> Expr {
    expr(ExprKind::Number(value), span)
}

/// Seconds of a port in milliseconds.
pub(super) fn seconds(msec: f64, span: Span) -> Expr {
    expr(ExprKind::Quantity(msec / 1000.0, Unit::Second), span)
}

impl Reader<'_, '_, '_> {
    /// Value of a port: a binding, or a constant of the type.
    pub(super) fn value(
        &mut self,
        port: &str,
        (text, span): (&str, Span),
        ty: &PortType,
        scope: &Scope,
    ) -> Option<Expr> {
        let entry = pointer(port, text).map(|name| scope.entry(name));
        match entry {
            Some(Entry::Binding(name)) => Some(expr(ExprKind::Binding(name), span)),
            Some(Entry::Text(text)) => self.constant(port, &text, ty, span),
            None => self.constant(port, text, ty, span),
        }
    }

    fn constant(&mut self, port: &str, text: &str, ty: &PortType, span: Span) -> Option<Expr> {
        let kind = constant(text, ty, span);
        if kind.is_none() {
            let wanted = wanted(ty);
            self.wrong(
                span,
                format!("`{text}` is no value of the port `{port}`, which takes {wanted}"),
                None,
            );
        }
        kind.map(|kind| expr(kind, span))
    }
}

/// Value of a type; `None` where the text is none.
fn constant(text: &str, ty: &PortType, span: Span) -> Option<ExprKind> {
    let float = || text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    match ty {
        PortType::Bool => match text {
            "true" | "1" => Some(ExprKind::Bool(true)),
            "false" | "0" => Some(ExprKind::Bool(false)),
            _ => None,
        },
        PortType::Number => Some(ExprKind::Number(float()?)),
        PortType::Quantity(dimension) => match (float(), Unit::si(*dimension)) {
            (Some(number), Some(unit)) => Some(ExprKind::Quantity(number, unit)),
            (Some(number), None) => Some(ExprKind::Number(number)),
            (None, _) => parse_quantity(text).map(|(number, unit)| ExprKind::Quantity(number, unit)),
        },
        PortType::Text => Some(ExprKind::Text(text.into())),
        PortType::Name if text == "any" => Some(ExprKind::Any),
        PortType::Name => (!text.is_empty()).then(|| ExprKind::Name(text.into())),
        PortType::Pose => pose(text, span),
        PortType::List(_) if text.is_empty() => Some(ExprKind::List(Vec::new())),
        PortType::List(inner) => {
            let items = text.split(';').map(|item| Some(expr(constant(item, inner, span)?, span)));
            items.collect::<Option<_>>().map(ExprKind::List)
        }
    }
}

/// A pose by its position and quaternion, which turns about the vertical.
fn pose(text: &str, span: Span) -> Option<ExprKind> {
    let numbers: Option<Vec<f64>> = text.split(';').map(|number| number.trim().parse().ok()).collect();
    let numbers = numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()))?;
    let (&[x, y, z, qx, qy, qz, qw], Some(metre), Some(radian)) =
        (numbers.as_slice(), Unit::parse("m"), Unit::parse("rad"))
    else {
        return None;
    };
    if qx.abs() > 1e-9 || qy.abs() > 1e-9 {
        return None;
    }
    let yaw = 2.0 * qz.atan2(qw);
    let arg = |value, unit| Arg { name: None, value: expr(ExprKind::Quantity(value, unit), span), span };
    let args = vec![arg(x, metre), arg(y, metre), arg(z, metre), arg(yaw, radian)];
    Some(ExprKind::Call(Call { name: Name { text: SmolStr::new_static(POSE), span }, args, span }))
}

fn wanted(ty: &PortType) -> &'static str {
    match ty {
        PortType::Bool => "`true` or `false`",
        PortType::Number => "a number",
        PortType::Quantity(_) => "a number in SI units, or a number with its unit",
        PortType::Text => "a text",
        PortType::Name => "a name",
        PortType::Pose => "seven numbers, `x;y;z;qx;qy;qz;qw`, with a turn about the vertical alone",
        PortType::List(_) => "values with `;` between them",
    }
}
