//! The wire types of conditions and terms to the AST. A string means something else in each place: the text
//! form of a condition, seconds with a unit, or a name whose meaning the compiler settles by the type of its
//! place.

use smol_str::{SmolStr, format_smolstr};

use super::Spanned;
use super::convert::Converter;
use super::term::{Args, Condition, Count, Duration, Form, Manner, Pair, Relation, Term};
use crate::ast::{self, Arg, ArithOp, Call, CompareOp, Expr, ExprKind, MAX_NESTING};
use crate::diagnostics::{BadValue, MissingKey, TooDeep, WrongType};
use crate::source::Span;
use crate::text::template::{self, ReadText};
use crate::text::{self, Origin};
use crate::unit::{Dimension, Unit, parse_quantity};
use crate::words::{is_bare_name, is_name};

impl Converter {
    /// A condition of a step in `depth` blocks.
    pub(super) fn condition(&mut self, condition: Condition, depth: usize) -> Expr {
        self.condition_at(condition, depth + 1)
    }

    /// A condition; `level` counts blocks and expressions.
    fn condition_at(&mut self, condition: Condition, level: usize) -> Expr {
        let Spanned { value, span } = condition.0;
        let Term::Text(text) = value else { return self.term(Spanned { value, span }, level) };
        let is_bound = |is_one: fn(&str) -> bool| text.strip_prefix('$').is_some_and(is_one);
        let (is_bare, is_lone) = (is_bound(is_bare_name), is_bound(is_name));
        if is_bare {
            return self.term(Spanned { value: Term::Text(text), span }, level);
        }
        // A string without escapes is as long as it looks.
        let is_plain = (span.end - span.start) as usize == text.len() + 2;
        let origin = if is_plain { Origin::At(self.file, span.start + 1) } else { Origin::Within(span) };
        let (expr, found) = text::parse_expr(&text, origin, level.saturating_sub(1));
        // What is no condition that begins with a name may be a name with blanks.
        let is_written =
            text.contains(['=', '<', '>', '(', ')', '[', ']', '\'', '"']) || text.contains(" is ");
        if is_lone && !is_written && !found.is_empty() {
            return self.term(Spanned { value: Term::Text(text), span }, level);
        }
        self.found.extend(found);
        expr.unwrap_or(Expr { kind: ExprKind::Wrong(text), span })
    }

    /// A duration: a bare number is seconds.
    pub(super) fn duration(&mut self, duration: Duration, depth: usize) -> Expr {
        let Spanned { value, span } = duration.0;
        let kind = match value {
            Term::Number(seconds) => ExprKind::Quantity(seconds, Unit::Second),
            Term::Text(text) if !text.starts_with('$') => {
                match parse_quantity(&text).filter(|(_, unit)| unit.dimension() == Dimension::DURATION) {
                    Some((value, unit)) => ExprKind::Quantity(value, unit),
                    None => {
                        let mistake = BadValue {
                            otherwise: Some(duration_help(&text)),
                            ..BadValue::new(span, format!("`{text}` is not a duration"))
                        };
                        self.found.push(mistake.into());
                        ExprKind::Wrong(text)
                    }
                }
            }
            other @ (Term::Text(_) | Term::Form(_)) => {
                return self.term(Spanned { value: other, span }, depth + 1);
            }
            Term::Bool(_) | Term::List(_) => return self.wrong(&value, span, "a number of seconds"),
        };
        Expr { kind, span }
    }

    /// A manner: a word or a ratio.
    pub(super) fn manner(&mut self, manner: Manner, depth: usize) -> Option<ast::Manner> {
        let Spanned { value, span } = manner.0;
        let kind = match value {
            Term::Number(ratio) => ExprKind::Number(ratio),
            Term::Form(_) => {
                let ratio = self.term(Spanned { value, span }, depth + 1);
                return Some(ast::Manner::At(ratio, span));
            }
            Term::Text(text) => {
                let word = text.trim();
                let part = word.strip_prefix("at ").unwrap_or(word);
                match (word, parse_quantity(part).filter(|(_, unit)| *unit == Unit::Percent)) {
                    ("slowly", _) => return Some(ast::Manner::Slowly(span)),
                    ("gently", _) => return Some(ast::Manner::Gently(span)),
                    (_, Some((value, unit))) => ExprKind::Quantity(value, unit),
                    (_, None) => {
                        let what = format!("`{text}` is not a manner");
                        self.bad_value(span, what, &["slowly", "gently", "30 %"]);
                        return None;
                    }
                }
            }
            other @ (Term::Bool(_) | Term::List(_)) => {
                self.wrong(&other, span, "`\"slowly\"`, `\"gently\"` or a part such as `\"30 %\"`");
                return None;
            }
        };
        Some(ast::Manner::At(Expr { kind, span }, span))
    }

    /// A whole number; whether it is one is for the compiler to check.
    pub(super) fn count(&mut self, count: Count, depth: usize) -> Expr {
        match &count.0.value {
            Term::Number(_) | Term::Form(_) => self.term(count.0, depth + 1),
            Term::Text(text) if text.starts_with('$') => self.term(count.0, depth + 1),
            Term::Text(_) | Term::Bool(_) | Term::List(_) => {
                self.wrong(&count.0.value, count.0.span, "a whole number")
            }
        }
    }

    fn wrong(&mut self, found: &Term, span: Span, expected: &str) -> Expr {
        let found = match found {
            Term::Bool(value) => format_smolstr!("`{value}`"),
            Term::Number(value) => format_smolstr!("the number `{value}`"),
            Term::Text(text) => format_smolstr!("the string `{text}`"),
            Term::List(_) => "an array".into(),
            Term::Form(_) => "an object".into(),
        };
        self.found.push(WrongType { span, expected: expected.into(), found }.into());
        Expr { kind: ExprKind::Wrong(SmolStr::default()), span }
    }

    /// A term; `level` counts blocks and expressions.
    pub(super) fn term(&mut self, term: Spanned<Term>, level: usize) -> Expr {
        let Spanned { value, span } = term;
        if level > MAX_NESTING {
            self.found.push(TooDeep { span, limit: MAX_NESTING }.into());
            return Expr { kind: ExprKind::Wrong(SmolStr::default()), span };
        }
        let kind = match value {
            Term::Bool(value) => ExprKind::Bool(value),
            Term::Number(value) => ExprKind::Number(value),
            Term::Text(text) => self.string(text, span, level),
            Term::List(members) => {
                ExprKind::List(members.into_iter().map(|member| self.term(member, level + 1)).collect())
            }
            Term::Form(form) => self.form(*form, span, level),
        };
        Expr { kind, span }
    }

    /// A string that is no condition: `$x` is a binding, `$$` a dollar sign, braces hold a value, anything
    /// else is settled later.
    fn string(&mut self, text: SmolStr, span: Span, level: usize) -> ExprKind {
        match text.strip_prefix('$') {
            None => match self.template(text, span, 0, level) {
                ExprKind::Text(text) => ExprKind::Plain(text),
                other => other,
            },
            Some(rest) if rest.starts_with('$') => self.template(rest.into(), span, 1, level),
            Some(rest) => match self.of_binding(&text, span, level) {
                Some(kind) => kind,
                None => ExprKind::Binding(self.name(Spanned { value: SmolStr::new(rest), span }).text),
            },
        }
    }

    /// A term in the text syntax that begins with a binding: `"$xs[0]"`, `"$mug.mass"`, `"$first(xs)"`.
    fn of_binding(&mut self, text: &str, span: Span, level: usize) -> Option<ExprKind> {
        if !text.contains(['[', '(', '.']) {
            return None;
        }
        let call = text.strip_prefix('$').filter(|rest| rest.contains('('));
        let (expr, found) =
            text::parse_expr(call.unwrap_or(text), Origin::Within(span), level.saturating_sub(1));
        let kind = expr.filter(|_| found.is_empty())?.kind;
        matches!(kind, ExprKind::Call(_) | ExprKind::Field(..)).then_some(kind)
    }

    /// A text behind so many bytes of its string.
    fn template(&mut self, text: SmolStr, span: Span, behind: u32, level: usize) -> ExprKind {
        let is_plain = (span.end - span.start) as usize == text.len() + behind as usize + 2;
        let start = span.start + 1 + behind;
        let origin = if is_plain { Origin::At(self.file, start) } else { Origin::Within(span) };
        let ReadText { kind, height, found } = template::read(text, origin, span);
        self.found.extend(found);
        if level + height > MAX_NESTING + 1 {
            self.found.push(TooDeep { span, limit: MAX_NESTING }.into());
            return ExprKind::Wrong(SmolStr::default());
        }
        kind
    }

    fn form(&mut self, form: Form, span: Span, level: usize) -> ExprKind {
        use {ArithOp as A, CompareOp as C};
        match form {
            Form::Is(form) => ExprKind::Call(self.call(form.is, form.args, span, level, true)),
            Form::Get(form) => {
                let call = ExprKind::Call(self.call(form.get, form.args, span, level, true));
                self.related(call, form.is, form.than, span, level)
            }
            Form::Field(form) => {
                let of = self.term(form.of, level + 1);
                let field = ExprKind::Field(Box::new(of), self.name(form.field));
                self.related(field, form.is, form.than, span, level)
            }
            Form::Not(inner) => ExprKind::Not(Box::new(self.condition_at(inner, level + 1))),
            Form::All(members) => ExprKind::All(self.conditions(members, level + 1)),
            Form::Any(members) => ExprKind::AnyOf(self.conditions(members, level + 1)),
            Form::Less(pair) => self.compare(C::Less, pair, level),
            Form::AtMost(pair) => self.compare(C::AtMost, pair, level),
            Form::Equal(pair) => self.compare(C::Equal, pair, level),
            Form::More(pair) => self.compare(C::More, pair, level),
            Form::AtLeast(pair) => self.compare(C::AtLeast, pair, level),
            Form::Unequal(pair) => self.compare(C::Unequal, pair, level),
            Form::Add(pair) => self.arithmetic(A::Add, pair, level),
            Form::Subtract(pair) => self.arithmetic(A::Subtract, pair, level),
            Form::Multiply(pair) => self.arithmetic(A::Multiply, pair, level),
            Form::Divide(pair) => self.arithmetic(A::Divide, pair, level),
            Form::Pose(numbers) => {
                let values = numbers.into_iter().map(|number| self.term(number, level + 1));
                let args = values.map(|value| Arg { name: None, span: value.span, value }).collect();
                ExprKind::Call(Call { name: ast::Name { text: ast::POSE.into(), span }, args, span })
            }
            Form::Literal(text) => self.template(text.value, text.span, 0, level),
        }
    }

    /// A value, compared where its object says so. Both the value and the comparison have the object's place.
    fn related(
        &mut self,
        value: ExprKind,
        is: Option<Box<Spanned<Relation>>>,
        than: Option<Box<Spanned<Term>>>,
        span: Span,
        level: usize,
    ) -> ExprKind {
        let (relation, than) = match (is, than) {
            (Some(relation), Some(than)) => (relation, than),
            (None, None) => return value,
            (Some(_), None) => {
                self.found.push(MissingKey { key: "than".into(), span }.into());
                return value;
            }
            (None, Some(_)) => {
                self.found.push(MissingKey { key: "is".into(), span }.into());
                return value;
            }
        };
        let op = match relation.value {
            Relation::Less => CompareOp::Less,
            Relation::AtMost => CompareOp::AtMost,
            Relation::Equal => CompareOp::Equal,
            Relation::More => CompareOp::More,
            Relation::AtLeast => CompareOp::AtLeast,
            Relation::Unequal => CompareOp::Unequal,
        };
        let value = Expr { kind: value, span };
        ExprKind::Compare(op, Box::new(value), Box::new(self.term(*than, level + 1)))
    }

    fn conditions(&mut self, members: Vec<Condition>, level: usize) -> Vec<Expr> {
        members.into_iter().map(|member| self.condition_at(member, level)).collect()
    }

    fn compare(&mut self, op: CompareOp, [left, right]: Pair, level: usize) -> ExprKind {
        ExprKind::Compare(op, Box::new(self.term(left, level + 1)), Box::new(self.term(right, level + 1)))
    }

    fn arithmetic(&mut self, op: ArithOp, [left, right]: Pair, level: usize) -> ExprKind {
        ExprKind::Arith(op, Box::new(self.term(left, level + 1)), Box::new(self.term(right, level + 1)))
    }

    /// A call; among the arguments of a fluent or a measure, the string `any` stands for every entity.
    pub(super) fn call(
        &mut self,
        name: Spanned<SmolStr>,
        args: Args,
        span: Span,
        level: usize,
        takes_any: bool,
    ) -> Call {
        let mut converted = Vec::with_capacity(args.0.len());
        for (key, value) in args.0 {
            let span = key.span.to(value.span);
            let is_any = takes_any && matches!(&value.value, Term::Text(text) if text == "any");
            let value = if is_any {
                Expr { kind: ExprKind::Any, span: value.span }
            } else {
                self.term(value, level + 1)
            };
            // A place in the order of the parameters, as the printer writes it.
            let is_place = key.value.strip_prefix("arg").and_then(|place| place.parse().ok())
                == Some(converted.len() + 1);
            let name = (!is_place).then(|| self.name(key));
            converted.push(Arg { name, value, span });
        }
        Call { name: self.name(name), args: converted, span }
    }
}

/// Help for a string that is not a duration.
fn duration_help(text: &str) -> String {
    let unit = text.trim().trim_start_matches(|c: char| matches!(c, '0'..='9' | '.' | '-' | ' '));
    let number = text.trim().strip_suffix(unit).unwrap_or("").trim_end();
    let meant = match unit {
        "" => Some(Unit::Second),
        // Of time, what begins so are minutes.
        "m" | "M" => Some(Unit::Minute),
        unit => Unit::from_spelling(unit).filter(|meant| meant.dimension() == Dimension::DURATION),
    };
    match meant {
        Some(meant) if !number.is_empty() => format!("did you mean `\"{number} {}\"`?", meant.symbol()),
        Some(_) | None => "write seconds, or a number and a unit such as `\"200 ms\"`".into(),
    }
}
