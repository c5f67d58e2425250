//! Notations that models write in place of those of the language, where the declarations show what is meant.
//!
//! Each is read with a note (M0226), whose fix writes it as the language does. What the spelling alone shows
//! is read by the syntax stage (M0122).

use motet_syntax::ast::{Arg, Call, Expr, ExprKind, Name};
use motet_syntax::words::is_bare_name;
use motet_syntax::{Edit, Fix, Span, Syntax, print, text};
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::ReadNotation;
use super::elaborator::{Elaborator, Expected};
use super::list_term::{COUNT, FIRST};
use crate::ir::{Base, Condition, Term, Ty};

/// Keys of a list of arguments in the order of the parameters.
const ARGUMENTS: [&str; 5] = ["args", "arguments", "parameters", "params", "input"];

/// The arguments in the order of the parameters, if that is all that a call in JSON has: `"args": ["user"]`.
pub(crate) fn arguments_in_order(args: &[Arg], syntax: Syntax) -> Option<(&Arg, &[Expr])> {
    let [arg] = args else { return None };
    let name = arg.name.as_ref().filter(|name| ARGUMENTS.contains(&name.text.as_str()))?;
    match &arg.value.kind {
        ExprKind::List(items) if syntax == Syntax::Json && !name.text.is_empty() && !items.is_empty() => {
            Some((arg, items))
        }
        _ => None,
    }
}

impl Elaborator<'_> {
    /// Notes that a part of the document is read as if it were edited.
    fn read_as(&mut self, span: Span, written: String, read: String, edits: Vec<Edit>) {
        let fix = Fix { title: format!("write {read}"), edits };
        self.report(ReadNotation { span, written, read, fix });
    }

    /// Notes that arguments in the order of the parameters are read under their names.
    pub(crate) fn note_arguments(&mut self, (arg, items): (&Arg, &[Expr]), names: &[&str]) {
        let key = arg.name.as_ref().map_or("", |name| name.text.as_str());
        let mut edits = Vec::with_capacity(items.len() + 1);
        let (mut at, mut read) = (arg.span.start, Vec::with_capacity(items.len()));
        for (item, name) in items.iter().zip(names) {
            let comma = if read.is_empty() { "" } else { ", " };
            let span = Span { start: at, end: item.span.start, ..arg.span };
            edits.push(Edit { span, text: format!("{comma}\"{name}\": ") });
            read.push(format!("\"{name}\": …"));
            at = item.span.end;
        }
        edits.push(Edit { span: Span { start: at, ..arg.span }, text: String::new() });
        self.read_as(arg.span, format!("`\"{key}\": […]`"), format!("`{}`", read.join(", ")), edits);
    }

    /// Notes that an argument is read as that of another parameter.
    pub(crate) fn note_parameter(&mut self, name: &Name, read: &str) {
        let edits = vec![Edit { span: name.span, text: format!("\"{read}\"") }];
        self.read_as(name.span, format!("the key `{}`", name.text), format!("`{read}`"), edits);
    }

    /// The value of a list of one, where no list is expected.
    pub(super) fn only_value<'e>(&mut self, expr: &'e Expr, wanted: Ty) -> Option<&'e Expr> {
        let is_single = wanted.lists == 0 && !matches!(wanted.base, Base::Pose | Base::Unknown);
        let ExprKind::List(items) = &expr.kind else { return None };
        let [only] = items.as_slice() else { return None };
        if !is_single || matches!(only.kind, ExprKind::List(_)) {
            return None;
        }
        let open = Span { end: only.span.start, ..expr.span };
        let close = Span { start: only.span.end, ..expr.span };
        let edits = [open, close].map(|span| Edit { span, text: String::new() });
        self.read_as(expr.span, "a list of one".to_owned(), "its value".to_owned(), edits.into());
        Some(only)
    }

    /// The value that a string of the JSON syntax holds in the text syntax, where no text is expected: the
    /// length or the first element of a list, or a field.
    pub(super) fn value_in_string(
        &mut self,
        written: &SmolStr,
        span: Span,
        wanted: Option<Expected<'_>>,
    ) -> Option<(Term, Ty)> {
        let is_text = |ty: Ty| ty.lists == 0 && matches!(ty.base, Base::Text | Base::Unknown);
        if self.form != Syntax::Json
            || !written.contains(['(', '.', '['])
            || wanted.is_none_or(|wanted| is_text(wanted.ty))
            || self.entities.find(written).is_some()
        {
            return None;
        }
        let value = text::parse_value(written, span)?;
        let name = |expr: &Expr| match &expr.kind {
            ExprKind::Name(name) | ExprKind::Binding(name) if self.scope.find(name).is_some() => {
                Some(format_smolstr!("${name}"))
            }
            ExprKind::Name(name) => self.entities.find(name).map(|_| name.clone()),
            _ => None,
        };
        let read = match &value.kind {
            ExprKind::Call(Call { name: term, args, .. }) => {
                let [Arg { value: list, .. }] = args.as_slice() else { return None };
                let is_term = [COUNT, FIRST].contains(&term.text)
                    && !self.library.names.measures.contains_key(&term.text);
                format!("{{\"get\": \"{}\", \"of\": \"{}\"}}", term.text, is_term.then(|| name(list))??)
            }
            ExprKind::Field(of, field) => {
                format!("{{\"field\": \"{}\", \"of\": \"{}\"}}", field.text, name(of)?)
            }
            _ => return None,
        };
        let edits = vec![Edit { span, text: read.clone() }];
        self.read_as(span, format!("`\"{written}\"`"), format!("`{read}`"), edits);
        Some(self.term(&value, wanted))
    }

    /// The fact that is written as a field of its entity: `fridge_1.open`.
    pub(super) fn fact_as_field(&mut self, of: &Expr, name: &Name, span: Span) -> Option<Condition> {
        let fluent = self.library.names.fluents.get(&name.text).copied()?;
        let def = self.library.fluent(fluent)?;
        let is_field = self.library.kinds.iter().any(|kind| kind.fields.contains_key(&name.text));
        if def.params.len() != 1 || is_field {
            return None;
        }
        let (ExprKind::Name(entity) | ExprKind::Binding(entity) | ExprKind::Plain(entity)) = &of.kind else {
            return None;
        };
        let is_bound = self.scope.find(entity).is_some();
        let is_entity = self.entities.find(entity).is_some();
        if !is_bound && !is_entity || !is_bare_name(entity) {
            return None;
        }
        let read = format!("{}({entity})", print::identifier(&name.text));
        // In an object, or a string with escapes, the whole of it is what is replaced.
        let is_spelled = of.span.end < name.span.start && of.span.start == span.start;
        let text = if is_spelled { read.clone() } else { format!("\"{read}\"") };
        let edits = vec![Edit { span, text }];
        self.read_as(span, format!("`{entity}.{}`", name.text), format!("`{read}`"), edits);
        let arg = Arg { name: None, value: of.clone(), span: of.span };
        let call = Call { name: name.clone(), args: vec![arg], span };
        Some(self.fact(&call).map_or(Condition::Unknown, Condition::Fact))
    }
}
