//! Steps to write in place of a call of an unknown name, for words that models use.

use motet_syntax::ast::{Arg, Do, Expr, ExprKind};
use motet_syntax::unit::{Dimension, Unit, parse_quantity};
use motet_syntax::{Edit, Fix, Syntax, print};

use super::diagnostics::StepSuggestion;
use crate::declare::Library;
use crate::declare::words::{self, Meaning};

/// The step that a call of an unknown name probably means.
pub(super) fn suggested_step(call: &Do, library: &Library, syntax: Syntax) -> Option<StepSuggestion> {
    match words::meaning(&call.call.name.text)? {
        Meaning::Calls(calls) => {
            let known = calls.iter().filter_map(|meant| Some((meant, params(meant.callee, library)?)));
            let known: Vec<_> = known.collect();
            let steps: Vec<String> =
                known.iter().map(|(meant, params)| pattern(meant.callee, params, syntax)).collect();
            let mut fitting = known.iter().zip(&steps).filter_map(|((meant, params), step)| {
                Some((*meant, step, renamed(&call.call.args, params)?))
            });
            let fix = match (fitting.next(), fitting.next()) {
                (Some((meant, step, mut edits)), None) if !meant.is_unsure => {
                    edits.insert(0, Edit { span: call.call.name.span, text: meant.callee.to_owned() });
                    Some(Fix { title: format!("write {step}"), edits })
                }
                _ => None,
            };
            (!steps.is_empty()).then(|| StepSuggestion { help: format!("write {}", steps.join(" or ")), fix })
        }
        Meaning::End(kind) => {
            let why = match call.call.args.as_slice() {
                // In JSON a reason stands under a key that no call has.
                [] if syntax == Syntax::Json && kind != "done" => None,
                [] => Some(None),
                [arg] if kind != "done" => reason(arg, syntax).map(Some),
                _ => None,
            };
            let step = |why: Option<&str>| match (syntax, why) {
                (Syntax::Text, None) => kind.to_owned(),
                (Syntax::Text, Some(why)) => format!("{kind} {why}"),
                (Syntax::Json, None) => format!("{{\"end\": \"{kind}\"}}"),
                (Syntax::Json, Some(why)) => format!("{{\"end\": \"{kind}\", \"why\": {why}}}"),
            };
            let help = match (syntax, kind) {
                (Syntax::Json, "fail" | "cannot" | "replan") => format!("write `{}`", step(Some("…"))),
                _ => format!("write `{}`", step(None)),
            };
            let fix = why.filter(|_| is_plain(call)).map(|why| {
                let edits = vec![Edit { span: call.call.span, text: step(why.as_deref()) }];
                Fix { title: help.clone(), edits }
            });
            Some(StepSuggestion { help, fix })
        }
        Meaning::Wait => {
            let (time, until) = match syntax {
                Syntax::Text => ("wait 5 s", "`wait until …`"),
                Syntax::Json => ("{\"wait\": 5}", "`{\"wait\": …}`"),
            };
            let help = format!("write `{time}`, or {until} with a condition");
            let written = match call.call.args.as_slice() {
                [arg] => seconds(&arg.value, syntax),
                _ => None,
            };
            let fix = written.filter(|_| is_plain(call)).map(|step| Fix {
                title: format!("write `{step}`"),
                edits: vec![Edit { span: call.call.span, text: step }],
            });
            Some(StepSuggestion { help, fix })
        }
        Meaning::Help(text, json) => {
            let help = if syntax == Syntax::Text { text } else { json };
            Some(StepSuggestion { help: format!("write {help}"), fix: None })
        }
    }
}

/// Checks if a call has nothing but arguments.
fn is_plain(call: &Do) -> bool {
    call.bind.is_none() && call.manner.is_none() && call.within.is_none() && call.retry.is_none()
}

/// The reason of an ending that is written as a call: a text.
fn reason(arg: &Arg, syntax: Syntax) -> Option<String> {
    let is_reason = arg.name.as_ref().is_none_or(|name| REASONS.contains(&name.text.as_str()));
    match (&arg.value.kind, syntax) {
        _ if !is_reason => None,
        (ExprKind::Text(_) | ExprKind::Template(_), Syntax::Text) => Some(print::expression(&arg.value)),
        (ExprKind::Plain(text), Syntax::Json) => {
            Some(format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"")))
        }
        _ => None,
    }
}

/// Names of the reason of an ending.
const REASONS: [&str; 5] = ["why", "reason", "because", "message", "text"];

/// The step that waits for a time that is written as the argument of a call.
fn seconds(time: &Expr, syntax: Syntax) -> Option<String> {
    let (value, unit) = match &time.kind {
        ExprKind::Number(value) => (*value, Unit::Second),
        ExprKind::Quantity(value, unit) => (*value, *unit),
        ExprKind::Plain(text) => parse_quantity(text)?,
        _ => return None,
    };
    if unit.dimension() != Dimension::DURATION {
        return None;
    }
    Some(match syntax {
        Syntax::Text => format!("wait {value} {}", unit.symbol()),
        Syntax::Json if unit == Unit::Second => format!("{{\"wait\": {value}}}"),
        Syntax::Json => format!("{{\"wait\": \"{value} {}\"}}", unit.symbol()),
    })
}

/// Parameter of a callee.
struct Param<'l> {
    name: &'l str,
    is_required: bool,
}

/// Parameters of a callee that the robot has.
fn params<'l>(callee: &str, library: &'l Library) -> Option<Vec<Param<'l>>> {
    let names = &library.names;
    if let Some(def) = names.primitives.get(callee).and_then(|id| library.primitive(*id)) {
        let params = def.params.iter();
        let params = params.map(|param| Param { name: &param.name, is_required: param.default.is_none() });
        return def.provided.then(|| params.collect());
    }
    let policy = names.policies.get(callee).and_then(|index| library.policies.get(*index))?;
    let params = policy.params.iter();
    Some(params.map(|param| Param { name: &param.name.text, is_required: param.default.is_none() }).collect())
}

/// A call with the required parameters of its callee.
fn pattern(callee: &str, params: &[Param<'_>], syntax: Syntax) -> String {
    let required = params.iter().filter(|param| param.is_required).map(|param| param.name);
    match syntax {
        Syntax::Text => {
            let args: Vec<String> = required.map(|name| format!("{}: …", print::identifier(name))).collect();
            format!("`{}({})`", print::identifier(callee), args.join(", "))
        }
        Syntax::Json => {
            let args: String = required.map(|name| format!(", \"{name}\": …")).collect();
            format!("`{{\"do\": \"{callee}\"{args}}}`")
        }
    }
}

/// Edits that give arguments the names of these parameters; `None` if they do not fit one to one.
fn renamed(args: &[Arg], params: &[Param<'_>]) -> Option<Vec<Edit>> {
    let position = |name: &str| params.iter().position(|param| param.name == name);
    let mut given: Vec<bool> = params
        .iter()
        .map(|param| args.iter().any(|arg| arg.name.as_ref().is_some_and(|name| name.text == param.name)))
        .collect();
    let mut edits = Vec::new();
    for (index, arg) in args.iter().enumerate() {
        let Some(name) = &arg.name else {
            let slot = given.get_mut(index).filter(|is_given| !**is_given)?;
            *slot = true;
            continue;
        };
        if position(&name.text).is_some() {
            continue;
        }
        let free = params.iter().zip(&given).filter(|(_, is_given)| !**is_given);
        let meant = words::parameter(&name.text, free.map(|(param, _)| param.name))?;
        *given.get_mut(position(meant)?)? = true;
        edits.push(Edit { span: name.span, text: meant.to_owned() });
    }
    let is_complete = params.iter().zip(&given).all(|(param, is_given)| *is_given || !param.is_required);
    is_complete.then_some(edits)
}
