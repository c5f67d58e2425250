//! Pairs to expressions: the grammar gives a flat list of operands and operators, which is put together by
//! precedence here. Recursion follows brackets, which [`super::lexer`] has bounded; chains without
//! brackets are built in loops and bounded by their height.

use smol_str::SmolStr;

use super::builder::{Builder, Children};

use super::template::{self, ReadText};
use super::{Origin, Pair, Rule};
use crate::ast::{Arg, ArithOp, Call, CompareOp, Expr, ExprKind, MAX_NESTING, Name};
use crate::diagnostics::{NumberRange, TextSyntax, TooDeep};
use crate::source::Span;
use crate::unit::Unit;

/// An expression while it is built.
struct PartialExpr {
    expr: Expr,
    /// With the parentheses around it.
    outer: Span,
    /// Levels of the tree.
    height: usize,
}

/// Element of the flat list that the grammar gives.
enum Element {
    Not(Span),
    Infix(Rule),
    Operand(PartialExpr),
}

impl Builder {
    /// The expression inside a pair such as `within 20 s`.
    pub(super) fn expr_in(&mut self, pair: Option<Pair<'_>>, depth: usize) -> Option<Expr> {
        Children::of(pair?).next().map(|inner| self.expr(inner, depth))
    }

    /// An `expr` pair in a step that is in `depth` blocks.
    pub(super) fn expr(&mut self, pair: Pair<'_>, depth: usize) -> Expr {
        let built = self.build(pair);
        self.limit(&built, depth);
        built.expr
    }

    /// A `call` pair.
    pub(super) fn call(&mut self, pair: Pair<'_>, depth: usize) -> Option<Call> {
        let span = self.span(&pair);
        let (call, height) = self.call_of(pair)?;
        if depth + height > MAX_NESTING {
            self.found.push(TooDeep { span, limit: MAX_NESTING }.into());
        }
        Some(call)
    }

    /// An `expr` pair with the levels of its tree.
    pub(super) fn measured(&mut self, pair: Pair<'_>) -> (Expr, usize) {
        let built = self.build(pair);
        (built.expr, built.height)
    }

    fn limit(&mut self, built: &PartialExpr, depth: usize) {
        if depth + built.height > MAX_NESTING {
            self.found.push(TooDeep { span: built.outer, limit: MAX_NESTING }.into());
        }
    }

    fn build(&mut self, pair: Pair<'_>) -> PartialExpr {
        let span = self.span(&pair);
        let mut parts = Vec::with_capacity(1);
        for part in Children::of(pair) {
            parts.push(match part.as_rule() {
                Rule::operand => Element::Operand(self.operand(part)),
                Rule::kw_not => Element::Not(self.span(&part)),
                rule => Element::Infix(rule),
            });
        }
        let mut parts = parts.into_iter().peekable();
        self.alternatives(&mut parts).unwrap_or(PartialExpr {
            expr: Expr { kind: ExprKind::Any, span },
            outer: span,
            height: 1,
        })
    }

    fn alternatives(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        let first = self.conjunction(parts)?;
        self.chain(first, parts, Rule::kw_or, Self::conjunction, ExprKind::AnyOf)
    }

    fn conjunction(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        let first = self.negation(parts)?;
        self.chain(first, parts, Rule::kw_and, Self::negation, ExprKind::All)
    }

    /// `a and b and c` as one node.
    fn chain(
        &mut self,
        first: PartialExpr,
        parts: &mut Flat,
        operator: Rule,
        operand: fn(&mut Self, &mut Flat) -> Option<PartialExpr>,
        make: fn(Vec<Expr>) -> ExprKind,
    ) -> Option<PartialExpr> {
        if next_infix(parts, |rule| rule == operator).is_none() {
            return Some(first);
        }
        let (mut outer, mut height) = (first.outer, first.height);
        let mut members = vec![first.expr];
        loop {
            let next = operand(self, parts)?;
            outer = outer.to(next.outer);
            height = height.max(next.height);
            members.push(next.expr);
            if next_infix(parts, |rule| rule == operator).is_none() {
                break;
            }
        }
        Some(PartialExpr { expr: Expr { kind: make(members), span: outer }, outer, height: height + 1 })
    }

    fn negation(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        let mut nots = Vec::new();
        while let Some(Element::Not(span)) = parts.next_if(|part| matches!(part, Element::Not(_))) {
            nots.push(span);
        }
        let mut inner = self.comparison(parts)?;
        while let Some(span) = nots.pop() {
            let outer = span.to(inner.outer);
            let make = |expr: Expr| ExprKind::Not(Box::new(expr));
            inner = self.wrap(inner, outer, make);
        }
        Some(inner)
    }

    fn comparison(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        let left = self.sum(parts)?;
        let Some(rule) = next_infix(parts, |rule| compare_op(rule).is_some()) else { return Some(left) };
        let right = self.right_side(parts, Self::sum)?;
        let built = join(left, right, |left, right| match compare_op(rule) {
            Some(op) => ExprKind::Compare(op, left, right),
            None => ExprKind::Any,
        });
        if next_infix(parts, |rule| compare_op(rule).is_some()).is_some() {
            let next = self.right_side(parts, Self::sum)?;
            let help = "write two of them with `and`: `a < b and b < c`";
            let span = built.outer.to(next.outer);
            self.found.push(TextSyntax::new(span, "comparisons do not chain".into(), help).into());
            // The rest of a longer chain is in the same mistake.
            while next_infix(parts, |rule| compare_op(rule).is_some()).is_some() {
                self.right_side(parts, Self::sum)?;
            }
        }
        Some(built)
    }

    fn sum(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        let mut left = self.product(parts)?;
        while let Some(rule) = next_infix(parts, |rule| matches!(rule, Rule::plus | Rule::minus)) {
            let op = if rule == Rule::plus { ArithOp::Add } else { ArithOp::Subtract };
            let right = self.right_side(parts, Self::product)?;
            left = self.arithmetic(op, left, right);
        }
        Some(left)
    }

    fn product(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        let mut left = self.atom_of(parts)?;
        while let Some(rule) = next_infix(parts, |rule| matches!(rule, Rule::times | Rule::over)) {
            let op = if rule == Rule::times { ArithOp::Multiply } else { ArithOp::Divide };
            let right = self.right_side(parts, Self::atom_of)?;
            left = self.arithmetic(op, left, right);
        }
        Some(left)
    }

    fn arithmetic(&mut self, op: ArithOp, left: PartialExpr, right: PartialExpr) -> PartialExpr {
        if left.height.max(right.height) > MAX_NESTING {
            return left;
        }
        join(left, right, |left, right| ExprKind::Arith(op, left, right))
    }

    /// Right side of an operator that binds tighter than `not`: an operand, or a `not` with all that is in
    /// its reach.
    fn right_side(
        &mut self,
        parts: &mut Flat,
        operand: fn(&mut Self, &mut Flat) -> Option<PartialExpr>,
    ) -> Option<PartialExpr> {
        let Some(Element::Not(span)) = parts.peek() else { return operand(self, parts) };
        let span = *span;
        let message = "`not` stands after an operator that binds tighter".into();
        self.found.push(TextSyntax::new(span, message, "write it in parentheses: `(not a)`").into());
        while parts.next_if(|part| matches!(part, Element::Not(_))).is_some() {}
        operand(self, parts)
    }

    fn atom_of(&mut self, parts: &mut Flat) -> Option<PartialExpr> {
        match parts.next()? {
            Element::Operand(built) => Some(built),
            Element::Not(_) | Element::Infix(_) => None,
        }
    }

    /// An atom, and the fields and elements taken of it.
    fn operand(&mut self, pair: Pair<'_>) -> PartialExpr {
        let span = self.span(&pair);
        let mut parts = Children::of(pair);
        let nothing = PartialExpr { expr: Expr { kind: ExprKind::Any, span }, outer: span, height: 1 };
        let Some(mut built) = parts.next().and_then(|atom| self.atom(atom)) else { return nothing };
        for part in parts {
            let is_index = part.as_rule() == Rule::index;
            let end = self.span(&part);
            let Some(inner) = Children::of(part).next() else { continue };
            let outer = built.outer.to(end);
            built = if is_index {
                if inner.as_str() != "0" {
                    let message = format!("a list has no element `[{}]`", inner.as_str());
                    let help = "write `[0]` for the first element, or `each` for all of them";
                    self.found.push(TextSyntax::new(end, message, help).into());
                }
                self.wrap(built, outer, |expr| ExprKind::Call(first(expr, end)))
            } else {
                let name = self.name(inner);
                self.wrap(built, outer, |expr| ExprKind::Field(Box::new(expr), name))
            };
        }
        built
    }

    /// One level more, unless there are too many already.
    fn wrap(&mut self, inner: PartialExpr, outer: Span, make: impl FnOnce(Expr) -> ExprKind) -> PartialExpr {
        if inner.height > MAX_NESTING {
            return inner;
        }
        PartialExpr { expr: Expr { kind: make(inner.expr), span: outer }, outer, height: inner.height + 1 }
    }

    fn atom(&mut self, pair: Pair<'_>) -> Option<PartialExpr> {
        let outer = self.span(&pair);
        let leaf = |kind| PartialExpr { expr: Expr { kind, span: outer }, outer, height: 1 };
        Some(match pair.as_rule() {
            Rule::quantity => leaf(self.quantity(pair, outer)?),
            Rule::text => {
                let has_escapes = pair.as_str().contains('\\');
                let text = self.text(pair, outer);
                let origin = match self.origin {
                    Origin::At(..) if !has_escapes => Origin::At(outer.file, outer.start + 1),
                    Origin::At(..) | Origin::Within(_) => Origin::Within(outer),
                };
                let ReadText { kind, height, found } = template::read(text, origin, outer);
                self.found.extend(found);
                PartialExpr { height, ..leaf(kind) }
            }
            Rule::kw_true => leaf(ExprKind::Bool(true)),
            Rule::kw_false => leaf(ExprKind::Bool(false)),
            Rule::kw_any => leaf(ExprKind::Any),
            Rule::name => leaf(ExprKind::Name(self.name_text(&pair))),
            Rule::binding => {
                let name = pair.as_str().trim_start_matches('$').trim_matches('`');
                leaf(ExprKind::Binding(name.into()))
            }
            Rule::group => PartialExpr { outer, ..self.build(Children::of(pair).next()?) },
            Rule::list => {
                let mut height = 0;
                let mut members = Vec::new();
                for member in Children::of(pair) {
                    let built = self.build(member);
                    height = height.max(built.height);
                    members.push(built.expr);
                }
                PartialExpr { height: height + 1, ..leaf(ExprKind::List(members)) }
            }
            Rule::call => {
                let (call, height) = self.call_of(pair)?;
                PartialExpr { height, ..leaf(ExprKind::Call(call)) }
            }
            _ => return None,
        })
    }

    /// A call and its height.
    fn call_of(&mut self, pair: Pair<'_>) -> Option<(Call, usize)> {
        let span = self.span(&pair);
        let mut parts = Children::of(pair);
        let name = self.name(parts.next()?);
        let mut height = 0;
        let mut args = Vec::new();
        for arg in Children::of(parts.next()?) {
            let span = self.span(&arg);
            let mut parts = Children::of(arg);
            let name = parts.next_of(Rule::name).map(|name| self.name(name));
            let built = self.build(parts.next()?);
            height = height.max(built.height);
            args.push(Arg { name, value: built.expr, span });
        }
        Some((Call { name, args, span }, height + 1))
    }

    fn quantity(&mut self, pair: Pair<'_>, span: Span) -> Option<ExprKind> {
        let mut parts = Children::of(pair);
        let number = parts.next()?;
        let mut value: f64 = number.as_str().parse().unwrap_or(f64::INFINITY);
        if !value.is_finite() {
            let found = SmolStr::new(number.as_str());
            self.found.push(NumberRange { span, found, expected: None }.into());
            value = 0.0;
        }
        let unit = parts.next().and_then(|unit| Unit::parse(unit.as_str()));
        Some(unit.map_or(ExprKind::Number(value), |unit| ExprKind::Quantity(value, unit)))
    }

    /// The text between the quotes, escapes resolved.
    fn text(&mut self, pair: Pair<'_>, span: Span) -> SmolStr {
        let inner = Children::of(pair).next().map_or("", |inner| inner.as_str());
        if !inner.contains('\\') {
            return SmolStr::new(inner);
        }
        let mut text = String::with_capacity(inner.len());
        let mut rest = inner.chars();
        while let Some(character) = rest.next() {
            if character != '\\' {
                text.push(character);
                continue;
            }
            match rest.next() {
                Some('n') => text.push('\n'),
                Some('t') => text.push('\t'),
                Some('r') => text.push('\r'),
                Some('u') => {
                    let digits: String = rest.by_ref().skip(1).take_while(|c| *c != '}').collect();
                    let code = u32::from_str_radix(&digits, 16).ok().and_then(char::from_u32);
                    if code.is_none() {
                        let message = format!("`\\u{{{digits}}}` is not a character");
                        let help = "write the character itself, or its number in hex, at most `10ffff`";
                        self.found.push(TextSyntax::new(span, message, help).into());
                    }
                    text.extend(code);
                }
                Some(other) => text.push(other),
                None => {}
            }
        }
        SmolStr::from(text)
    }
}

/// `x[0]` as `first(x)`.
fn first(list: Expr, index: Span) -> Call {
    let span = list.span.to(index);
    let name = Name { text: SmolStr::new_static("first"), span: index };
    Call { name, args: vec![Arg { name: None, span: list.span, value: list }], span }
}

type Flat = std::iter::Peekable<std::vec::IntoIter<Element>>;

/// The operator that comes next, if it is one of these.
fn next_infix(parts: &mut Flat, is: impl Fn(Rule) -> bool) -> Option<Rule> {
    match parts.next_if(|part| matches!(part, Element::Infix(rule) if is(*rule)))? {
        Element::Infix(rule) => Some(rule),
        Element::Not(_) | Element::Operand(_) => None,
    }
}

fn join(
    left: PartialExpr,
    right: PartialExpr,
    make: impl FnOnce(Box<Expr>, Box<Expr>) -> ExprKind,
) -> PartialExpr {
    let outer = left.outer.to(right.outer);
    let height = left.height.max(right.height) + 1;
    PartialExpr {
        expr: Expr { kind: make(Box::new(left.expr), Box::new(right.expr)), span: outer },
        outer,
        height,
    }
}

fn compare_op(rule: Rule) -> Option<CompareOp> {
    match rule {
        Rule::eq => Some(CompareOp::Equal),
        Rule::ne => Some(CompareOp::Unequal),
        Rule::lt => Some(CompareOp::Less),
        Rule::le => Some(CompareOp::AtMost),
        Rule::gt => Some(CompareOp::More),
        Rule::ge => Some(CompareOp::AtLeast),
        _ => None,
    }
}
