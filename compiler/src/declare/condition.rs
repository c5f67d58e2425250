//! Elaboration of conditions: fluents, comparisons and connectives.

use motet_syntax::ast::{Arg, Call, CompareOp, Expr, ExprKind, Name};
use motet_syntax::unit::Dimension;
use smol_str::SmolStr;

use super::arithmetic::dimension;
use super::diagnostics::{MissingArgument, NotACondition, TooManyArguments, UnknownFluent, UnknownParameter};
use super::elaborator::{Elaborator, Expected, ValueRole};
use super::list_term::IS_EMPTY;
use super::name::{list, near};
use super::words;
use crate::ir::{Base, Condition, Fact, Term, Ty};

impl Elaborator<'_> {
    /// Elaborates a condition; [`Condition::Unknown`] after an error.
    pub(crate) fn condition(&mut self, expr: &Expr) -> Condition {
        match &expr.kind {
            ExprKind::Bool(value) => Condition::Literal(*value),
            ExprKind::Call(call) => self.fluent(call),
            ExprKind::Not(inner) => Condition::Not(Box::new(self.condition(inner))),
            ExprKind::All(parts) => Condition::All(parts.iter().map(|part| self.condition(part)).collect()),
            ExprKind::AnyOf(parts) => {
                Condition::AnyOf(parts.iter().map(|part| self.condition(part)).collect())
            }
            ExprKind::Compare(op, left, right) => self.compare(*op, left, right, expr),
            ExprKind::Name(_) | ExprKind::Binding(_) => match self.term(expr, None) {
                (term, Ty::BOOL) => Condition::Compare(CompareOp::Equal, term, Term::Bool(true)),
                (Term::Unknown, _) => Condition::Unknown,
                _ => self.no_condition(expr, "a value"),
            },
            ExprKind::Number(_) | ExprKind::Quantity(..) => self.no_condition(expr, "a number"),
            ExprKind::Text(_) | ExprKind::Template(_) | ExprKind::Plain(_) => {
                self.no_condition(expr, "a text")
            }
            ExprKind::List(_) => self.no_condition(expr, "a list"),
            ExprKind::Wrong(_) => Condition::Unknown,
            ExprKind::Any => self.no_condition(expr, "`any`"),
            ExprKind::Field(of, name) => match self.fact_as_field(of, name, expr.span) {
                Some(condition) => condition,
                None => self.no_condition(expr, "a value"),
            },
            ExprKind::Arith(..) => self.no_condition(expr, "a value"),
        }
    }

    fn no_condition(&mut self, expr: &Expr, found: &'static str) -> Condition {
        self.report(NotACondition { span: expr.span, found, wanted: "a condition" });
        Condition::Unknown
    }

    fn compare(&mut self, op: CompareOp, left: &Expr, right: &Expr, whole: &Expr) -> Condition {
        // The side that says its own type is read first, so that it decides how the other is read.
        let (a, b, left_ty, right_ty) = if needs_context(left, |name| self.scope.find(name).is_some()) {
            let (b, right_ty) = self.term(right, None);
            let (a, left_ty) = self.term(left, Some(beside(right_ty)));
            (a, b, left_ty, right_ty)
        } else {
            let (a, left_ty) = self.term(left, None);
            let (b, right_ty) = self.term(right, Some(beside(left_ty)));
            (a, b, left_ty, right_ty)
        };
        if left_ty.base == Base::Unknown || right_ty.base == Base::Unknown {
            // Unknown is an error already reported, or a number of a robot that is not given.
            return if a == Term::Unknown || b == Term::Unknown {
                Condition::Unknown
            } else {
                Condition::Compare(op, a, b)
            };
        }
        let joined = match (dimension(left_ty), dimension(right_ty)) {
            (Some(left), Some(right)) => {
                left == right
                    && (left != Dimension::NONE || plain(left_ty) == plain(right_ty) || computed(&a, &b))
            }
            _ => {
                let alike = self.library.fits(left_ty, right_ty) || self.library.fits(right_ty, left_ty);
                let is_failure = left_ty.base == Base::Failure || right_ty.base == Base::Failure;
                alike && !is_failure && matches!(op, CompareOp::Equal | CompareOp::Unequal)
            }
        };
        if joined && !computed(&a, &b) {
            for (term, ty, expr) in [(&a, left_ty, left), (&b, right_ty, right)] {
                if let (Term::Number(value), Ty::RATIO) = (term, ty)
                    && self.ratio(*value, expr, "a ratio") == Term::Unknown
                {
                    return Condition::Unknown;
                }
            }
        }
        if !joined {
            self.mismatch(op.symbol(), left_ty, right_ty, whole.span);
            return Condition::Unknown;
        }
        Condition::Compare(op, a, b)
    }

    fn fluent(&mut self, call: &Call) -> Condition {
        if call.name.text == "monitored" {
            return self.monitored(call);
        }
        if !self.library.names.fluents.contains_key(&call.name.text)
            && let Some(condition) = self.is_empty_list(call)
        {
            return condition;
        }
        match self.fact(call) {
            Some(fact) => Condition::Fact(fact),
            None => Condition::Unknown,
        }
    }

    /// Elaborates a fluent applied to arguments; `None` after an error.
    pub(crate) fn fact(&mut self, call: &Call) -> Option<Fact> {
        let library = self.library;
        let Some(id) = library.names.fluents.get(&call.name.text).copied() else {
            if self.has_value(&call.name.text) {
                self.report(NotACondition { span: call.span, found: "a value", wanted: "a condition" });
            } else {
                let own = [IS_EMPTY];
                let known = library.fluents.iter().map(|def| &def.name).chain(&own);
                self.report(UnknownFluent::new(&call.name, "fluent", known));
            }
            return None;
        };
        let def = library.fluent(id)?;
        let args = self.arguments(call, &def.params);
        (!args.contains(&Some(Term::Unknown))).then_some(Fact { fluent: id, args })
    }

    fn monitored(&mut self, call: &Call) -> Condition {
        let Some(Arg { value, .. }) = call.args.first() else {
            let (callee, param) = (call.name.text.clone(), SmolStr::new("what"));
            self.report(MissingArgument {
                span: call.span,
                callee,
                param,
                ty: "a measure or a fluent".to_owned(),
            });
            return Condition::Unknown;
        };
        let name = match &value.kind {
            ExprKind::Name(name) | ExprKind::Plain(name) => name.clone(),
            ExprKind::Call(call) => call.name.text.clone(),
            _ => SmolStr::default(),
        };
        if let Some(id) = self.library.names.measures.get(&name) {
            return Condition::MonitoredMeasure(*id);
        }
        if let Some(id) = self.library.names.fluents.get(&name) {
            return Condition::MonitoredFluent(*id);
        }
        let known = self.library.measures.iter().map(|def| &def.name);
        let known = known.chain(self.library.fluents.iter().map(|def| &def.name));
        let name = Name { text: name, span: value.span };
        self.report(UnknownFluent::new(&name, "measure or fluent", known));
        Condition::Unknown
    }

    /// Elaborates the arguments of a fluent or measure, in the order of its parameters; `None` stands for
    /// `any`.
    pub(crate) fn arguments(&mut self, call: &Call, params: &[(SmolStr, Ty)]) -> Vec<Option<Term>> {
        let callee = call.name.text.as_str();
        let mut args: Vec<Option<Option<Term>>> = vec![None; params.len()];
        for (position, arg) in call.args.iter().enumerate() {
            let index = match &arg.name {
                None => Some(position),
                Some(name) => match params.iter().position(|(param, _)| *param == name.text) {
                    Some(index) => Some(index),
                    None => {
                        let names = || params.iter().map(|(param, _)| param.as_str());
                        let meant = words::parameter(&name.text, names()).map(SmolStr::new);
                        let near = meant.or_else(|| near(&name.text, names()));
                        let known = list(params.iter().map(|(param, _)| param.clone()));
                        let (name, span) = (name.text.clone(), name.span);
                        self.report(UnknownParameter { span, name, callee: callee.into(), near, known });
                        continue;
                    }
                },
            };
            let slot = index.and_then(|index| Some((params.get(index)?, args.get_mut(index)?)));
            let Some(((param, ty), slot)) = slot else {
                self.report(TooManyArguments {
                    span: arg.span,
                    callee: callee.into(),
                    most: params.len(),
                    twice: None,
                });
                continue;
            };
            if slot.is_some() {
                let twice = Some(param.clone());
                self.report(TooManyArguments {
                    span: arg.span,
                    callee: callee.into(),
                    most: params.len(),
                    twice,
                });
                continue;
            }
            *slot = Some(match &arg.value.kind {
                ExprKind::Any => None,
                _ => Some(
                    self.term_of(&arg.value, Expected { ty: *ty, place: ValueRole::Param(param, callee) }),
                ),
            });
        }
        for ((param, ty), slot) in params.iter().zip(&mut args) {
            if slot.is_none() {
                let ty = self.library.type_name(*ty);
                self.report(MissingArgument {
                    span: call.span,
                    callee: callee.into(),
                    param: param.clone(),
                    ty,
                });
                *slot = Some(Some(Term::Unknown));
            }
        }
        args.into_iter().map(Option::flatten).collect()
    }
}

/// Checks if the other side of a comparison decides how an expression is read.
pub(crate) fn needs_context(expr: &Expr, is_bound: impl Fn(&SmolStr) -> bool) -> bool {
    match &expr.kind {
        ExprKind::Name(name) => !is_bound(name),
        ExprKind::Number(_) | ExprKind::Plain(_) | ExprKind::List(_) => true,
        _ => false,
    }
}

fn beside(ty: Ty) -> Expected<'static> {
    Expected { ty, place: ValueRole::Named("the other side of this comparison") }
}

fn plain(ty: Ty) -> bool {
    matches!(ty.base, Base::Int | Base::Number)
}

/// Returns whether a side is computed: a quotient of two lengths may be compared with a ratio.
fn computed(a: &Term, b: &Term) -> bool {
    matches!(a, Term::Arith(..)) || matches!(b, Term::Arith(..))
}
